//! Kicks and drifts of the grains that meet others, under drag with a frozen rate.
//!
//! ```text
//! v ← v + τ φ(λτ) (F/m + c − λ v),   x ← x + v Δt
//! ```

use crate::bed::motion::{Stride, mean_decay};
use crate::math::Vector;
use crate::neighbours::{LANES, Record, Wide, WideWork};

/// Moves some of the grains on and clears the forces on them when they have flown.
pub struct KickSome<'a> {
    pub motion: &'a mut [Record],
    pub spin: &'a mut [Record],
    pub forces: &'a mut [Record],
    /// c_x, c_y, c_z [m/s²], λ [1/s], impulse of the contacts so far [N s], sum of the changes of
    /// velocity so far [m/s].
    pub launches: &'a mut [Record],
    /// Places of those who move, in eights.
    pub some: &'a [[u32; LANES]],
    pub stride: Stride,
}

/// Returns the greatest speed [m/s]: infinite where a grain is beyond the limit or has no number for
/// its velocity or its position.
impl WideWork for KickSome<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<W: Wide>(self) -> f64 {
        let mut fastest = W::splat(0.0);
        let limit = W::splat(self.stride.limit * self.stride.limit);
        for places in self.some {
            let state = [
                W::gather(self.motion, places),
                W::gather(self.spin, places),
                W::gather(self.forces, places),
                W::gather(self.launches, places),
            ];
            let (moved, squared) = eight(&self.stride, state);
            let [motion, spin, launches] = [W::records(moved[0]), W::records(moved[1]), W::records(moved[2])];
            for (lane, &place) in places.iter().enumerate() {
                let place = place as usize;
                self.motion[place] = motion[lane];
                self.spin[place] = spin[lane];
                self.launches[place] = launches[lane];
                if self.stride.drift > 0.0 {
                    self.forces[place] = Record([0.0; 8]);
                }
            }
            let sound = squared.below(limit);
            fastest = W::select(sound, fastest.max(squared), W::splat(f64::INFINITY));
        }
        fastest.lanes().into_iter().fold(0.0, f64::max).sqrt()
    }
}

/// New motion, spin and launches of eight grains, and their speeds squared.
#[inline(always)]
fn eight<W: Wide>(stride: &Stride, [motion, spin, forces, launch]: [[W; 8]; 4]) -> ([[W; 8]; 3], W) {
    let kick = W::splat(stride.kick);
    let [x, y, z, radius, vx, vy, vz, inverse_mass] = motion;
    let [cx, cy, cz, rate, sx, sy, sz, changed] = launch;
    let velocity = Vector::new(vx, vy, vz);
    let force = Vector::new(forces[0], forces[1], forces[2]);
    let push = force * inverse_mass + (Vector::new(cx, cy, cz) - velocity * rate);
    let gain = push * (kick * mean_decay(rate * kick));
    let velocity = velocity + gain;
    let given = Vector::new(sx, sy, sz) + force * kick;
    let position = Vector::new(x, y, z) + velocity * W::splat(stride.drift);
    let turn = spin[3] * kick;
    let nothing = (position.x + position.y + position.z) * W::splat(0.0);
    let motion = [
        position.x,
        position.y,
        position.z,
        radius,
        velocity.x,
        velocity.y,
        velocity.z,
        inverse_mass,
    ];
    let spin = [
        spin[0] + forces[4] * turn,
        spin[1] + forces[5] * turn,
        spin[2] + forces[6] * turn,
        spin[3],
        spin[4],
        spin[5],
        spin[6],
        spin[7],
    ];
    let launch = [cx, cy, cz, rate, given.x, given.y, given.z, changed + gain.norm()];
    ([motion, spin, launch], velocity.norm_squared() + nothing)
}
