//! Kick and drift: velocities from forces, positions from velocities, eight grains at a time.
//!
//! ```text
//! v ← v + φ(λτ) τ (a + λ (u − v)),   φ(x) = (1 − e^{−x})/x,   x ← x + v Δt
//! ```
//!
//! a holds contacts, gravity and buoyancy; drag with its rate λ = b/m is integrated exactly over the
//! kick, so that no viscosity limits the step. Without drag this is velocity Verlet.

use std::f64::consts::PI;

use crate::drag::{self, AnyDrag, LiftLaw, Magnus, Whirl};
use crate::math::{Number, Vector, elementary};
use crate::neighbours::{LANES, Record, Wide, WideWork};

/// Below this the mean decay is a series [-].
const NEAR: f64 = 0.05;

/// What acts on every grain without a partner.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings {
    /// g, downwards [m/s²].
    pub gravity: f64,
    /// ρ_f [kg/m³], zero in empty space.
    pub fluid_density: f64,
    /// μ [Pa s].
    pub viscosity: f64,
    /// Drag of the superficial slip; `None` leaves drag out.
    pub drag: Option<AnyDrag>,
    /// Whether a grain that spins is lifted across its slip (Magnus).
    pub lift: bool,
}

/// Moves grains on and clears their forces.
pub struct KickAndDrift<'a> {
    pub surroundings: &'a Surroundings,
    pub motion: &'a mut [Record],
    pub spin: &'a mut [Record],
    pub forces: &'a mut [Record],
    pub stride: Stride,
}

/// How far a pass moves the grains on.
#[derive(Clone, Copy, Debug)]
pub struct Stride {
    /// Time over which the forces act [s].
    pub kick: f64,
    /// Time over which the grains fly [s]. Forces are cleared when they have flown.
    pub drift: f64,
    /// Speed that no grain may reach [m/s].
    pub limit: f64,
}

/// What empty lanes hold, motion, spin and forces: a body in clear fluid that nothing moves.
const NOBODY: [Record; 3] = [
    Record([0.0; 8]),
    Record([0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
    Record([0.0; 8]),
];

/// Returns the greatest speed [m/s]: infinite where a grain is beyond the limit or has no number for
/// its velocity or its position.
impl WideWork for KickAndDrift<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<W: Wide>(self) -> f64 {
        let mut fastest = W::splat(0.0);
        let (motion, last_motion) = self.motion.as_chunks_mut::<LANES>();
        let (spin, last_spin) = self.spin.as_chunks_mut::<LANES>();
        let (forces, last_forces) = self.forces.as_chunks_mut::<LANES>();
        for ((motion, spin), forces) in motion.iter_mut().zip(spin).zip(forces) {
            fastest = advance(self.surroundings, &self.stride, motion, spin, forces, fastest);
        }
        if !last_motion.is_empty() {
            let count = last_motion.len();
            let [mut motion, mut spin, mut forces] =
                [[NOBODY[0]; LANES], [NOBODY[1]; LANES], [NOBODY[2]; LANES]];
            motion[..count].copy_from_slice(last_motion);
            spin[..count].copy_from_slice(last_spin);
            forces[..count].copy_from_slice(last_forces);
            fastest = advance(
                self.surroundings,
                &self.stride,
                &mut motion,
                &mut spin,
                &mut forces,
                fastest,
            );
            last_motion.copy_from_slice(&motion[..count]);
            last_spin.copy_from_slice(&spin[..count]);
            last_forces.copy_from_slice(&forces[..count]);
        }
        fastest.lanes().into_iter().fold(0.0, f64::max).sqrt()
    }
}

/// Moves eight grains on; gives back the greatest speed squared so far, infinite once one is beyond the
/// limit or no number.
#[inline(always)]
fn advance<W: Wide>(
    surroundings: &Surroundings,
    stride: &Stride,
    motion: &mut [Record; LANES],
    spin: &mut [Record; LANES],
    forces: &mut [Record; LANES],
    fastest: W,
) -> W {
    const ALL: [u32; LANES] = [0, 1, 2, 3, 4, 5, 6, 7];
    let lanes = [
        W::gather(motion, &ALL),
        W::gather(spin, &ALL),
        W::gather(forces, &ALL),
    ];
    let (moved, turned, squared) = eight(surroundings, stride, lanes);
    *motion = W::records(moved);
    *spin = W::records(turned);
    if stride.drift > 0.0 {
        *forces = [NOBODY[2]; LANES];
    }
    let sound = squared.below(W::splat(stride.limit * stride.limit));
    W::select(sound, fastest.max(squared), W::splat(f64::INFINITY))
}

/// New motion and spin of eight grains, and their speeds squared.
#[inline(always)]
fn eight<W: Wide>(
    surroundings: &Surroundings,
    stride: &Stride,
    [motion, spin, forces]: [[W; 8]; 3],
) -> ([W; 8], [W; 8], W) {
    let [x, y, z, radius, vx, vy, vz, inverse_mass] = motion;
    let [wx, wy, wz, inverse_inertia, porosity, fluid, neighbours, awake] = spin;
    let displaced = W::splat(4.0 / 3.0 * PI * surroundings.fluid_density * surroundings.gravity);
    let buoyancy = displaced * radius * radius * radius;
    let mut push = Vector::new(forces[0], forces[1], forces[2] + buoyancy + neighbours) * inverse_mass;
    push.z = push.z - W::splat(surroundings.gravity);
    let velocity = Vector::new(vx, vy, vz);
    if surroundings.lift {
        let whirl = Whirl {
            slip: Vector::new(W::splat(0.0), W::splat(0.0), fluid) - velocity,
            // Slices flow up or down as a whole.
            vorticity: Vector::zeros(),
            spin: Vector::new(wx, wy, wz),
        };
        let medium = [surroundings.fluid_density, surroundings.viscosity];
        push = push + Magnus.force(medium, radius + radius, &whirl) * inverse_mass;
    }
    let kick = W::splat(stride.kick);
    let velocity = match &surroundings.drag {
        None => velocity + push * kick,
        Some(drag) => {
            let slip = Vector::new(W::splat(0.0), W::splat(0.0), fluid) - velocity;
            // Model B: f/ε on the interstitial slip is β of the superficial one.
            let fluid = [surroundings.fluid_density, surroundings.viscosity];
            let superficial = porosity * slip.norm();
            let per_slip = drag::coefficient(drag, fluid, radius + radius, superficial, porosity);
            let rate = per_slip * inverse_mass;
            velocity + (push + slip * rate) * (kick * mean_decay(rate * kick))
        }
    };
    // Sleepers stay where they are.
    let velocity = velocity * awake;
    let turn = inverse_inertia * kick;
    let position = Vector::new(x, y, z) + velocity * W::splat(stride.drift);
    // Zero, but no number where a coordinate is none or infinite.
    let nothing = (position.x + position.y + position.z) * W::splat(0.0);
    (
        [
            position.x,
            position.y,
            position.z,
            radius,
            velocity.x,
            velocity.y,
            velocity.z,
            inverse_mass,
        ],
        [
            (wx + forces[4] * turn) * awake,
            (wy + forces[5] * turn) * awake,
            (wz + forces[6] * turn) * awake,
            inverse_inertia,
            porosity,
            fluid,
            neighbours,
            awake,
        ],
        velocity.norm_squared() + nothing,
    )
}

/// (1 − e^{−x})/x for x ≥ 0, 1 at zero.
#[inline(always)]
pub(super) fn mean_decay<N: Number>(x: N) -> N {
    let (one, near) = (N::splat(1.0), N::splat(NEAR));
    // Eight terms reach rounding here, where the closed form loses digits; most steps are as short.
    let mut series = one;
    for count in (2..=9).rev() {
        series = one - x * N::splat(1.0 / f64::from(count)) * series;
    }
    if !N::any(near.below(x)) {
        return series;
    }
    let closed = (one - elementary::exp(N::splat(0.0) - x)) / x;
    N::select(near.below(x), closed, series)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_decay_is_smooth_from_rest_to_the_stiffest_drag() {
        for x in [
            1e-300_f64, 1e-12, 1e-6, 1e-3, 0.0499, 0.0501, 0.1, 5.0, 300.0, 1e6,
        ] {
            let exact = -(-x).exp_m1() / x;
            assert!(
                (mean_decay(x) / exact - 1.0).abs() < 2e-14,
                "{x}: {} for {exact}",
                mean_decay(x)
            );
        }
        assert_eq!(mean_decay(0.0), 1.0);
    }
}
