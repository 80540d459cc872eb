//! Stokes drag on one sphere: factor 1.
//!
//! Source: Stokes (1851); valid for Re ≪ 1.

use super::DragLaw;

#[derive(Clone, Copy, Debug)]
pub struct Stokes;

impl DragLaw for Stokes {
    #[inline]
    fn factor(&self, _re: f64, _porosity: f64) -> f64 {
        1.0
    }
}
