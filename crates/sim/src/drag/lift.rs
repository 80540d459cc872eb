//! Lift: the part of the fluid's force across the slip.

use std::f64::consts::PI;

use super::DragScale;
use crate::math::Vec3;

/// The fluid around a grain, and how the grain moves in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whirl {
    /// Fluid velocity less that of the grain, u_f − v [m/s].
    pub slip: Vec3,
    /// ω_c = ∇ × u_f [1/s].
    pub vorticity: Vec3,
    /// Angular velocity ω of the grain [rad/s].
    pub spin: Vec3,
}

pub trait LiftLaw: Copy {
    /// Force on the grain [N].
    fn force(&self, scale: &DragScale, whirl: &Whirl) -> Vec3;
}

/// No lift.
impl LiftLaw for () {
    #[inline]
    fn force(&self, _: &DragScale, _: &Whirl) -> Vec3 {
        Vec3::zeros()
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
    #[inline]
    fn force(&self, scale: &DragScale, whirl: &Whirl) -> Vec3 {
        let turning = 0.5 * whirl.vorticity - whirl.spin;
        PI / 8.0 * scale.diameter.powi(3) * scale.density * turning.cross(&whirl.slip)
    }
}

impl LiftLaw for Saffman {
    #[inline]
    fn force(&self, scale: &DragScale, whirl: &Whirl) -> Vec3 {
        let magnitude = whirl.vorticity.norm();
        if magnitude == 0.0 {
            return Vec3::zeros();
        }
        let strength = 1.61 * scale.diameter.powi(2) * (scale.viscosity * scale.density / magnitude).sqrt();
        strength * whirl.slip.cross(&whirl.vorticity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: DragScale = DragScale {
        diameter: 2e-4,
        density: 1000.0,
        viscosity: 1e-3,
    };

    fn whirl() -> Whirl {
        Whirl {
            slip: Vec3::new(0.01, -0.02, 0.03),
            vorticity: Vec3::new(4.0, 5.0, -6.0),
            spin: Vec3::new(-1.0, 7.0, 2.0),
        }
    }

    #[test]
    fn lift_does_no_work_on_the_slip() {
        for force in [Magnus.force(&WATER, &whirl()), Saffman.force(&WATER, &whirl())] {
            assert!(force.norm() > 0.0);
            assert!(force.dot(&whirl().slip).abs() < 1e-15 * force.norm());
        }
    }

    #[test]
    fn a_ball_with_backspin_is_lifted() {
        // Forward along x, the top going backwards: ω along −y. Rubinow & Keller: π R³ ρ |ω| |v|.
        let ball = Whirl {
            slip: Vec3::new(-0.1, 0.0, 0.0),
            vorticity: Vec3::zeros(),
            spin: Vec3::new(0.0, -50.0, 0.0),
        };
        let lift = Magnus.force(&WATER, &ball);
        assert!((lift.z / (PI * 1e-12 * 1000.0 * 50.0 * 0.1) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_sphere_that_turns_with_the_fluid_feels_no_magnus_force() {
        let carried = Whirl {
            spin: 0.5 * whirl().vorticity,
            ..whirl()
        };
        assert_eq!(Magnus.force(&WATER, &carried), Vec3::zeros());
    }

    #[test]
    fn a_sphere_that_lags_is_drawn_to_the_faster_side_and_not_at_all_without_shear() {
        // u = γ z along x: vorticity +y. The fluid passes the lagging sphere along +x.
        let shear = |rate: f64| Whirl {
            slip: Vec3::new(0.01, 0.0, 0.0),
            vorticity: Vec3::new(0.0, rate, 0.0),
            spin: Vec3::zeros(),
        };
        let lift = |rate| Saffman.force(&WATER, &shear(rate)).z;
        assert!(lift(10.0) > 0.0);
        assert!((lift(40.0) / lift(10.0) - 2.0).abs() < 1e-12);
        assert_eq!(lift(0.0), 0.0);
        assert!(lift(1e-300).is_finite());
    }
}
