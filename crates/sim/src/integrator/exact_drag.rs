//! Motion under linear drag and a constant force, integrated exactly over a step.
//!
//! ```text
//! M dv/dt = Σ β_i (U_i − v) + G
//! v(t) = v_∞ + (v_0 − v_∞) e^{−λt},   λ = Σβ/M,   v_∞ = (Σ β_i U_i + G)/Σβ
//! ```
//!
//! A step of any length is stable, so a dense bed does not limit it. For drag that depends on speed,
//! β is frozen over the step: first order in the step, exact at rest and at the terminal speed.

use crate::math::Vec3;

/// A body of mass M [kg] under the sum of its drags.
#[derive(Clone, Copy, Debug)]
pub struct ExactDrag {
    pub mass: f64,
    /// Σ β_i [kg/s].
    pub drag: f64,
    /// Σ β_i U_i [N].
    pub pull: Vec3,
    /// All other forces G [N].
    pub force: Vec3,
}

impl ExactDrag {
    /// Velocity after `dt` [s] and the mean velocity over the step [m/s].
    pub fn advance(&self, velocity: Vec3, dt: f64) -> (Vec3, Vec3) {
        let x = self.drag / self.mass * dt;
        // expm1 keeps both limits: free flight for x → 0, equilibrium for x → ∞.
        let lost = -(-x).exp_m1();
        let mean_share = if x > 0.0 { lost / x } else { 1.0 };
        if x < 1e-12 {
            let gain = (self.force + self.pull - velocity * self.drag) * (dt / self.mass);
            return (velocity + gain, velocity + 0.5 * gain);
        }
        let terminal = (self.pull + self.force) / self.drag;
        (
            terminal + (velocity - terminal) * (1.0 - lost),
            terminal + (velocity - terminal) * mean_share,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fall(drag: f64) -> ExactDrag {
        ExactDrag {
            mass: 2.0,
            drag,
            pull: Vec3::zeros(),
            force: Vec3::new(0.0, 0.0, -4.0),
        }
    }

    #[test]
    fn two_half_steps_equal_one_step() {
        let body = fall(3.0);
        let start = Vec3::new(1.0, 0.0, 0.5);
        let (whole, mean) = body.advance(start, 0.8);
        let (half, first) = body.advance(start, 0.4);
        let (twice, second) = body.advance(half, 0.4);
        assert!((whole - twice).norm() < 1e-14);
        assert!((mean - 0.5 * (first + second)).norm() < 1e-14);
    }

    #[test]
    fn impulse_equals_momentum_gained() {
        let body = fall(3.0);
        let start = Vec3::new(1.0, 0.0, 0.5);
        let (end, mean) = body.advance(start, 0.8);
        let impulse = (body.force - mean * body.drag) * 0.8;
        assert!((impulse - (end - start) * body.mass).norm() < 1e-14);
    }

    #[test]
    fn falls_freely_without_drag_and_rests_at_once_with_infinite_drag() {
        assert!((fall(0.0).advance(Vec3::zeros(), 0.5).0.z + 1.0).abs() < 1e-15);
        assert!(fall(1e30).advance(Vec3::new(0.0, 0.0, 7.0), 0.5).0.norm() < 1e-28);
    }
}
