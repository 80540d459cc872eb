//! The numbers of a suspension in a particle fluid: spacing, sound speed, step.

use super::model::Suspension;
use crate::scene::setup::{COURANT, POROSITY_LENGTH};
use crate::scene::{CouplingLengths, Hydrostatics, SoundSpeed, SphFluid};

/// Density change of the fluid under the weight that the grains put on it [-].
const COMPRESSION: f64 = 0.01;
/// Porosity of the densest bed that grains settle to [-].
const PACKED: f64 = 0.36;
/// Way of the fastest grains between two refreshes of the weights, over the exchange length [-]. From 0.01 to
/// 0.04 the interface's speed changes by 2e-4, to 0.08 by 8e-4.
const WAY: f64 = 0.06;
/// Solids in the cube of an exchange length, over those in the cube of a diameter where they fill it [-]. In
/// glass and water at a porosity of 0.9 the velocities of the grains scatter more and more below 5, the
/// faster the fewer they are; from 7 to 22 the scatter falls and the interface's speed stays within 0.6 %.
const CROWD: f64 = 7.0;

/// A suspension in its particle fluid.
#[derive(Clone, Copy)]
pub struct Particles<'a> {
    pub scene: &'a Suspension,
    pub sph: &'a SphFluid,
}

impl Particles<'_> {
    /// Particle spacing [m], adjusted to divide the width.
    pub fn spacing(&self) -> f64 {
        let width = self.scene.column.width;
        let wanted = self.sph.spacing_over_diameter * self.scene.smallest_diameter();
        width / (width / wanted).round().max(1.0)
    }

    /// Porosity length of grains of a diameter [m].
    pub fn porosity_length(&self, diameter: f64) -> f64 {
        match self.sph.scheme.coupling_lengths {
            CouplingLengths::Smallest => POROSITY_LENGTH * self.scene.smallest_diameter(),
            CouplingLengths::Largest => POROSITY_LENGTH * self.scene.largest_diameter(),
            _ => POROSITY_LENGTH * diameter,
        }
    }

    /// Exchange length of grains of a diameter [m]. With fewer grains in a kernel their disorder stirs the
    /// fluid, which disorders them more.
    pub fn exchange_length(&self, diameter: f64) -> f64 {
        let porosity_length = self.porosity_length(diameter);
        let diameter = porosity_length / POROSITY_LENGTH;
        let crowded = diameter * (CROWD / (1.0 - self.scene.porosity)).cbrt();
        porosity_length.max(1.2 * self.spacing()).max(crowded)
    }

    /// Weight less buoyancy of the solids over their volume [N/m³].
    pub fn drive(&self) -> f64 {
        (self.scene.solids_density() - self.sph.medium.density) * self.scene.gravity
    }

    /// Largest excess pressure: that under all grains at their terminal speed [Pa].
    pub fn excess_pressure(&self) -> f64 {
        (1.0 - self.scene.porosity) * self.drive() * self.scene.column.height
    }

    /// Sound speed [m/s]: ten times any speed, and one per cent of density change.
    pub fn sound_speed(&self) -> f64 {
        let (density, height) = (self.sph.medium.density, self.scene.column.height);
        match self.sph.scheme.sound_speed {
            SoundSpeed::Value(value) => value,
            SoundSpeed::FreeFall => 20.0 * (2.0 * self.scene.gravity * height).sqrt(),
            SoundSpeed::Automatic => {
                let carried = match self.sph.scheme.hydrostatics {
                    Hydrostatics::Split => 0.0,
                    Hydrostatics::Carried => density * self.scene.gravity * height,
                };
                let pressure = self.excess_pressure() + carried;
                let compression = (pressure / (COMPRESSION * density)).sqrt();
                compression.max(10.0 * self.scene.greatest_settling_speed())
            }
        }
    }

    /// Speed of sound in the densest bed over that in the fluid alone [-].
    ///
    /// A pressure gradient moves the fluid and the grains, each by its own density, while only the fluid is
    /// compressed: ρ c² ∇·((ε/ρ + φ/ρ_s) ∇p) = ε ∂²p/∂t². Grains as dense as the fluid make it 1/√ε, Raso
    /// (2014) eq. 2.59; drag that locks grains to the fluid makes it less.
    fn haste_of_sound(&self) -> f64 {
        let lightest = (self.scene.classes.iter().map(|class| class.density)).fold(f64::INFINITY, f64::min);
        let grains = (1.0 - PACKED) / PACKED * self.sph.medium.density / lightest;
        (1.0 + grains).sqrt()
    }

    /// Longest safe fluid step [s] and the limit that sets it.
    pub fn step_limit(&self) -> (f64, &'static str) {
        let medium = self.sph.medium;
        let h = 1.5 * self.spacing();
        let acoustic = COURANT * h / (self.haste_of_sound() * self.sound_speed());
        let artificial = self.sph.scheme.artificial_viscosity.unwrap_or(0.0);
        let nu = medium.viscosity / medium.density + artificial * self.sound_speed() * h / 9.0;
        let viscous = 0.125 * h * h / nu;
        if viscous < acoustic {
            (viscous, "0.125 h²/ν")
        } else {
            (acoustic, "0.4 h/c in the bed")
        }
    }

    /// Step [s] of the run: the given or the longest safe one, shortened to divide the duration.
    pub fn step(&self) -> f64 {
        let wanted = self.sph.scheme.time_step.unwrap_or(self.step_limit().0);
        self.scene.duration / (self.scene.duration / wanted).ceil().max(1.0)
    }

    /// Steps between refreshes of the weights.
    pub fn refresh_interval(&self) -> u64 {
        let length = self.exchange_length(self.scene.smallest_diameter());
        let way = self.scene.greatest_settling_speed() * self.step();
        ((WAY * length / way) as u64).max(1)
    }

    /// Fluid particles, wall layers left out.
    pub fn count(&self) -> u64 {
        let side = (self.scene.column.width / self.spacing()).round() as u64;
        side * side * (self.scene.column.height / self.spacing()).round() as u64
    }
}
