//! Stokes drag on one sphere: factor 1.
//!
//! Source: Stokes (1851); valid for Re ≪ 1.

use super::DragLaw;
use crate::math::Number;

#[derive(Clone, Copy, Debug)]
pub struct Stokes;

impl DragLaw for Stokes {
    #[inline(always)]
    fn factor<N: Number>(&self, _re: N, _porosity: N) -> N {
        N::splat(1.0)
    }
}
