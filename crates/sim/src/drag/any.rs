//! A drag law chosen at run time.

use super::voidage::{AlvimLiteral, DiFelice as DiFeliceVoidage, VoidageLaw};
use super::{Dallavalle, DragLaw, SchillerNaumann, Stokes};
use crate::math::Number;

/// Drag of a sphere alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SphereDrag {
    Stokes,
    Dallavalle,
    SchillerNaumann,
}

/// What the neighbours make of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnyVoidage {
    None,
    DiFelice,
    /// As printed in Alvim (2016), eq. 55.
    AlvimLiteral,
}

/// A drag law with its voidage function; next to the evaluation of eight grains the choice is free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AnyDrag {
    pub sphere: SphereDrag,
    pub voidage: AnyVoidage,
}

impl DragLaw for AnyDrag {
    #[inline(always)]
    fn factor<N: Number>(&self, re: N, porosity: N) -> N {
        let alone = match self.sphere {
            SphereDrag::Stokes => Stokes.factor(re, porosity),
            SphereDrag::Dallavalle => Dallavalle.factor(re, porosity),
            SphereDrag::SchillerNaumann => SchillerNaumann.factor(re, porosity),
        };
        match self.voidage {
            AnyVoidage::None => alone,
            AnyVoidage::DiFelice => alone * DiFeliceVoidage.voidage(re, porosity),
            AnyVoidage::AlvimLiteral => alone * AlvimLiteral.voidage(re, porosity),
        }
    }
}
