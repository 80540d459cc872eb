//! Time integration of grains.

mod exact_drag;

pub use exact_drag::ExactDrag;
