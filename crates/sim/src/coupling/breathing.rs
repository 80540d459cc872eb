//! Damping of the column's breathing: the one motion an incompressible column cannot make.
//!
//! A closed column of incompressible mixture has no net volume flux through any height. A weakly
//! compressible one breathes: started from rest it swings at its quarter wave 4H/c for a long time.
//! The damper is a body force against the horizontal mean j̄ of the mixture flux ε u + (1 − ε) v_s,
//!
//! ```text
//! du_z/dt = −σ j̄(z),   σ = π c / H: critical for the quarter wave
//! ```
//!
//! It vanishes in every motion an incompressible mixture can make, steady or not, so it damps the
//! compression waves and biases nothing. Its impulse is part of the momentum audit.

use std::f64::consts::PI;

use super::Layers;
use crate::fluid::FluidParticles;

#[derive(Clone, Debug)]
pub struct Breathing {
    /// σ [1/s].
    rate: f64,
    flux: Layers,
    /// Upward impulse given to the fluid by the last call [N s].
    pub impulse: f64,
}

impl Breathing {
    /// The critical damper of a column of `height` [m] with sound speed c [m/s], resolved by levels
    /// every `width` [m].
    pub fn new(sound_speed: f64, height: f64, width: f64) -> Self {
        Breathing {
            rate: PI * sound_speed / height,
            flux: Layers::new(height, width),
            impulse: 0.0,
        }
    }

    /// Damps over `dt` [s].
    pub fn damp(&mut self, fluid: &mut FluidParticles, dt: f64) {
        self.flux.average((0..fluid.len()).map(|a| {
            (
                fluid.position[a].z,
                fluid.porosity[a] * fluid.velocity[a].z + fluid.solid_flux[a].z,
            )
        }));
        let lost = -(-self.rate * dt).exp_m1();
        self.impulse = 0.0;
        for a in 0..fluid.len() {
            let kick = -lost * self.flux.at(fluid.position[a].z);
            fluid.velocity[a].z += kick;
            self.impulse += fluid.mass[a] * kick;
        }
    }
}
