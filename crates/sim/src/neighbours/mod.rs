//! Who is near whom: a cell grid for the search, rows of neighbours for the sums, and copies of
//! particles beyond a periodic side so that no sum ever wraps a distance.

mod cells;
mod rows;

pub use cells::CellGrid;
pub use rows::{Image, LANES, Rows, images};
