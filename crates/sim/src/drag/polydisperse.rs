//! Drag among grains of several sizes.
//!
//! The local Sauter mean of the solid with volume fractions x_k is ⟨d⟩ = φ/Σ_k(φ_k/d_k) = 1/Σ_k(x_k/d_k); a
//! grain's relative diameter is y = d/⟨d⟩.

use std::f64::consts::PI;

use super::{
    Beetstra, CoulsonRichardson, Dallavalle, DiFelice, DragLaw, Hindered, SchillerNaumann, Stokes, VoidageLaw,
};
use crate::math::Number;

/// A drag law that may depend on the sizes of the neighbours.
pub trait PolydisperseLaw: Copy {
    /// Drag over Stokes drag 3πμ d u_s of the grain, at its own Reynolds number `re` [-] (laws that want
    /// that of the Sauter mean take re/y), `porosity` [-] and `relative_diameter` y [-].
    fn factor<N: Number>(&self, re: N, porosity: N, relative_diameter: N) -> N;
}

/// Laws in which the sizes of the neighbours have no say.
macro_rules! own_size_only {
    ($([$($parameter:ident: $bound:ident),*] $law:ty),+ $(,)?) => {
        $(impl<$($parameter: $bound),*> PolydisperseLaw for $law {
            #[inline(always)]
            fn factor<N: Number>(&self, re: N, porosity: N, _relative_diameter: N) -> N {
                DragLaw::factor(self, re, porosity)
            }
        })+
    };
}

own_size_only! {
    [] (),
    [] Stokes,
    [] Dallavalle,
    [] SchillerNaumann,
    [] CoulsonRichardson,
    [] DiFelice,
    [] Beetstra,
    [L: DragLaw, V: VoidageLaw] Hindered<L, V>,
}

/// Drag per superficial slip β [kg/s] of grains of `diameter` [m] and relative diameter y [-] at slip speed
/// `slip` [m/s] in a fluid of `density` [kg/m³] and `viscosity` [Pa s].
#[inline(always)]
pub fn polydisperse_coefficient<N: Number>(
    law: &impl PolydisperseLaw,
    [density, viscosity]: [f64; 2],
    [diameter, relative_diameter]: [N; 2],
    slip: N,
    porosity: N,
) -> N {
    let re = N::splat(density) * diameter * slip / N::splat(viscosity);
    N::splat(3.0 * PI * viscosity) * diameter * law.factor(re, porosity, relative_diameter)
}
