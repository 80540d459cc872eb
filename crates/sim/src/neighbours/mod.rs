//! Who is near whom: a cell grid for the search, rows of neighbours for the sums, and copies of
//! particles beyond a periodic side so that no sum ever wraps a distance.

mod cells;
mod gather;
mod rows;

pub use cells::CellGrid;
#[cfg(target_arch = "x86_64")]
pub(crate) use gather::gather_avx512;
pub(crate) use gather::{Lanes, Record, gather};
pub use rows::{Image, LANES, Rows, images};
