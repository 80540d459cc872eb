//! A drag law chosen at run time.

use super::voidage::{AlvimLiteral, DiFelice as DiFeliceVoidage, VoidageLaw};
use super::{
    Beetstra, BeetstraCello, CoulsonRichardson, Dallavalle, DragLaw, PolydisperseLaw, SchillerNaumann, Stokes,
};
use crate::math::Number;

/// Drag before the voidage function: that of a sphere alone, but for the last two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SphereDrag {
    Stokes,
    Dallavalle,
    SchillerNaumann,
    CoulsonRichardson,
    /// Holds the neighbours already: goes with [`AnyVoidage::None`].
    Beetstra,
    /// Holds the neighbours and their sizes already: goes with [`AnyVoidage::None`].
    BeetstraCello,
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
        PolydisperseLaw::factor(self, re, porosity, N::splat(1.0))
    }
}

impl PolydisperseLaw for AnyDrag {
    #[inline(always)]
    fn factor<N: Number>(&self, re: N, porosity: N, relative_diameter: N) -> N {
        let alone = match self.sphere {
            SphereDrag::Stokes => DragLaw::factor(&Stokes, re, porosity),
            SphereDrag::Dallavalle => DragLaw::factor(&Dallavalle, re, porosity),
            SphereDrag::SchillerNaumann => DragLaw::factor(&SchillerNaumann, re, porosity),
            SphereDrag::CoulsonRichardson => DragLaw::factor(&CoulsonRichardson, re, porosity),
            SphereDrag::Beetstra => DragLaw::factor(&Beetstra, re, porosity),
            SphereDrag::BeetstraCello => {
                PolydisperseLaw::factor(&BeetstraCello, re, porosity, relative_diameter)
            }
        };
        match self.voidage {
            AnyVoidage::None => alone,
            AnyVoidage::DiFelice => alone * DiFeliceVoidage.voidage(re, porosity),
            AnyVoidage::AlvimLiteral => alone * AlvimLiteral.voidage(re, porosity),
        }
    }
}
