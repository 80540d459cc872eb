//! Lift: the part of the fluid's force across the slip.

use std::f64::consts::PI;

use crate::math::{Number, Vector};

/// The fluid around a grain, and how the grain moves in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whirl<N = f64> {
    /// Fluid velocity less that of the grain, u_f − v [m/s].
    pub slip: Vector<N>,
    /// ω_c = ∇ × u_f [1/s].
    pub vorticity: Vector<N>,
    /// Angular velocity ω of the grain [rad/s].
    pub spin: Vector<N>,
}

pub trait LiftLaw: Copy {
    /// Force [N] on a grain of `diameter` [m] in a fluid of density [kg/m³] and viscosity [Pa s].
    fn force<N: Number>(&self, fluid: [f64; 2], diameter: N, whirl: &Whirl<N>) -> Vector<N>;
}

/// No lift.
impl LiftLaw for () {
    #[inline(always)]
    fn force<N: Number>(&self, _: [f64; 2], _: N, _: &Whirl<N>) -> Vector<N> {
        Vector::zeros()
    }
}

/// Lift of a sphere that turns against the fluid:
///
/// ```text
/// F = (π/8) d³ ρ_f (½ ∇×u_f − ω) × (u_f − v)
/// ```
///
/// Valid for Re ≪ 1; an overestimate above. Source: Rubinow & Keller (1961), J. Fluid Mech. 11,
/// 447–459.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Magnus;

/// Lift of a sphere that lags or leads in a shear flow:
///
/// ```text
/// F = 1.61 d² √(μ ρ_f) |ω_c|^−½ (u_f − v) × ω_c
/// ```
///
/// Zero without vorticity. Valid for Re ≪ √Re_shear ≪ 1. Source: Saffman (1965), J. Fluid Mech. 22,
/// 385–400; corrigendum (1968) 31, 624.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saffman;

impl LiftLaw for Magnus {
    #[inline(always)]
    fn force<N: Number>(&self, [density, _]: [f64; 2], diameter: N, whirl: &Whirl<N>) -> Vector<N> {
        let turning = whirl.vorticity * N::splat(0.5) - whirl.spin;
        let strength = N::splat(PI / 8.0 * density) * diameter * diameter * diameter;
        turning.cross(&whirl.slip) * strength
    }
}

impl LiftLaw for Saffman {
    #[inline(always)]
    fn force<N: Number>(&self, [density, viscosity]: [f64; 2], diameter: N, whirl: &Whirl<N>) -> Vector<N> {
        let magnitude = whirl.vorticity.norm();
        let zero = N::splat(0.0);
        let root = (N::splat(viscosity * density) / magnitude).sqrt();
        let strength = N::splat(1.61) * diameter * diameter * root;
        let turns = zero.below(magnitude);
        whirl.slip.cross(&whirl.vorticity) * N::select(turns, strength, zero)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLUID: [f64; 2] = [1000.0, 1e-3];
    const DIAMETER: f64 = 2e-4;

    fn whirl() -> Whirl {
        Whirl {
            slip: Vector::new(0.01, -0.02, 0.03),
            vorticity: Vector::new(4.0, 5.0, -6.0),
            spin: Vector::new(-1.0, 7.0, 2.0),
        }
    }

    #[test]
    fn lift_does_no_work_on_the_slip() {
        for force in [
            Magnus.force(FLUID, DIAMETER, &whirl()),
            Saffman.force(FLUID, DIAMETER, &whirl()),
        ] {
            assert!(force.norm() > 0.0);
            assert!(force.dot(&whirl().slip).abs() < 1e-15 * force.norm());
        }
    }

    #[test]
    fn a_ball_with_backspin_is_lifted() {
        // Forward along x, the top going backwards: ω along −y. Rubinow & Keller: π R³ ρ |ω| |v|.
        let ball = Whirl {
            slip: Vector::new(-0.1, 0.0, 0.0),
            vorticity: Vector::zeros(),
            spin: Vector::new(0.0, -50.0, 0.0),
        };
        let lift = Magnus.force(FLUID, DIAMETER, &ball);
        assert!((lift.z / (PI * 1e-12 * 1000.0 * 50.0 * 0.1) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_sphere_that_turns_with_the_fluid_feels_no_magnus_force() {
        let carried = Whirl {
            spin: whirl().vorticity * 0.5,
            ..whirl()
        };
        assert_eq!(Magnus.force(FLUID, DIAMETER, &carried), Vector::zeros());
    }

    #[test]
    fn a_sphere_that_lags_is_drawn_to_the_faster_side_and_not_at_all_without_shear() {
        // u = γ z along x: vorticity +y. The fluid passes the lagging sphere along +x.
        let shear = |rate: f64| Whirl {
            slip: Vector::new(0.01, 0.0, 0.0),
            vorticity: Vector::new(0.0, rate, 0.0),
            spin: Vector::zeros(),
        };
        let lift = |rate| Saffman.force(FLUID, DIAMETER, &shear(rate)).z;
        assert!(lift(10.0) > 0.0);
        assert!((lift(40.0) / lift(10.0) - 2.0).abs() < 1e-12);
        assert_eq!(lift(0.0), 0.0);
        assert!(lift(1e-300).is_finite());
    }
}
