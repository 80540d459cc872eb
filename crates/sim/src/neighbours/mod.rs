//! Who is near whom: a cell grid for the search, rows of neighbours for the sums, and copies of
//! particles beyond a periodic side so that no sum ever wraps a distance.

mod cells;
mod near_pairs;
mod rows;
mod wide;

pub use cells::CellGrid;
pub(crate) use near_pairs::squared_distance;
pub use near_pairs::{Period, Search, visit_near_pairs};
pub use rows::{Image, LANES, Rows, images};
#[cfg(test)]
pub(crate) use wide::Plain;
pub use wide::Record;
#[cfg(all(test, target_arch = "x86_64"))]
pub(crate) use wide::{Avx2, Avx512};
pub(crate) use wide::{Wide, WideWork, in_widest, prefetch};
