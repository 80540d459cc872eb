//! Weakly compressible equation of state.
//!
//! ```text
//! p = B ((ϱ/ρ₀)^7 − 1),   B = ρ₀ c²/7,   ϱ = ρ/ε the intrinsic density
//! ```
//!
//! With the hydrostatic part carried analytically p is the excess p′ over it.
//! Source: Cole (1948), Underwater Explosions; use in SPH: Monaghan (1994), J. Comput. Phys. 110, 399.

#[derive(Clone, Copy, Debug)]
pub struct EquationOfState {
    /// Rest density ρ₀ [kg/m³].
    pub density: f64,
    /// Sound speed at rest c [m/s].
    pub sound_speed: f64,
}

impl EquationOfState {
    fn stiffness(&self) -> f64 {
        self.density * self.sound_speed * self.sound_speed / 7.0
    }

    /// Pressure [Pa] at intrinsic density ϱ [kg/m³].
    #[inline(always)]
    pub fn pressure(&self, density: f64) -> f64 {
        let s = density / self.density;
        let s2 = s * s;
        let s4 = s2 * s2;
        self.stiffness() * (s4 * s2 * s - 1.0)
    }

    /// Intrinsic density ϱ [kg/m³] at pressure p [Pa] > −B.
    pub fn density_at(&self, pressure: f64) -> f64 {
        self.density * (1.0 + pressure / self.stiffness()).powf(1.0 / 7.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: EquationOfState = EquationOfState {
        density: 1000.0,
        sound_speed: 0.9,
    };

    #[test]
    fn density_and_pressure_are_inverse() {
        for pressure in [-3.0, 0.0, 8.0] {
            assert!((WATER.pressure(WATER.density_at(pressure)) - pressure).abs() < 1e-10);
        }
    }

    #[test]
    fn slope_at_rest_is_the_sound_speed_squared() {
        let slope = (WATER.pressure(1000.01) - WATER.pressure(999.99)) / 0.02;
        assert!((slope.sqrt() - 0.9).abs() < 1e-6);
    }
}
