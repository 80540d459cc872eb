//! One sphere in a fluid, and its dimensionless numbers.
//!
//! ```text
//! Ar = d³ ρ_f |ρ_p − ρ_f| g / μ²      Re = ρ_f d v / μ
//! ```

use std::f64::consts::PI;

/// A sphere, the fluid around it and gravity. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// d [m]
    pub diameter: f64,
    /// ρ_p [kg/m³]
    pub density: f64,
    /// ρ_f [kg/m³]
    pub fluid_density: f64,
    /// μ [Pa s]
    pub viscosity: f64,
    /// g [m/s²]
    pub gravity: f64,
}

impl Grain {
    /// V_p [m³].
    pub fn volume(&self) -> f64 {
        PI / 6.0 * self.diameter.powi(3)
    }

    /// [kg], without added mass.
    pub fn mass(&self) -> f64 {
        self.density * self.volume()
    }

    /// Weight less the buoyancy of the pure fluid [N]; negative for a grain that rises.
    pub fn buoyant_weight(&self) -> f64 {
        self.volume() * (self.density - self.fluid_density) * self.gravity
    }

    /// Archimedes number [-], never negative.
    pub fn archimedes(&self) -> f64 {
        let density_difference = (self.density - self.fluid_density).abs();
        self.diameter.powi(3) * self.fluid_density * density_difference * self.gravity
            / self.viscosity.powi(2)
    }

    /// Reynolds number at a speed [-].
    pub fn reynolds(&self, speed: f64) -> f64 {
        self.fluid_density * self.diameter * speed.abs() / self.viscosity
    }

    /// Settling velocity at a Reynolds number [m/s]: positive downwards, negative for a grain that rises.
    pub fn settling_velocity(&self, reynolds: f64) -> f64 {
        let speed = reynolds * self.viscosity / (self.fluid_density * self.diameter);
        if self.density < self.fluid_density {
            -speed
        } else {
            speed
        }
    }

    /// Stokes drag at a speed [N], 3πμ d v.
    pub fn stokes_drag(&self, speed: f64) -> f64 {
        3.0 * PI * self.viscosity * self.diameter * speed
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// 100 µm glass in water, the base case of Raso (2014).
    pub const GLASS: Grain = Grain {
        diameter: 1e-4,
        density: 2500.0,
        fluid_density: 1000.0,
        viscosity: 8.9e-4,
        gravity: 9.81,
    };

    #[test]
    fn velocity_and_reynolds_number_are_inverse() {
        let velocity = GLASS.settling_velocity(0.7);
        assert!((GLASS.reynolds(velocity) - 0.7).abs() < 1e-12);
    }

    #[test]
    fn a_light_grain_rises_with_the_same_archimedes_number() {
        let light = Grain {
            density: 500.0,
            ..GLASS
        };
        let heavy = Grain {
            density: 1500.0,
            ..GLASS
        };
        assert!((light.archimedes() / heavy.archimedes() - 1.0).abs() < 1e-12);
        assert!(light.settling_velocity(1.0) < 0.0 && light.buoyant_weight() < 0.0);
    }
}
