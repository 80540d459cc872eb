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
    /// Whether anything turns them.
    pub turn: bool,
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
            let forces = W::gather(self.forces, places);
            let state = [
                W::gather(self.motion, places),
                forces,
                W::gather(self.launches, places),
            ];
            let (motion, launches, squared) = kick(&self.stride, state);
            let (motion, launches) = (W::records(motion), W::records(launches));
            for (lane, &place) in places.iter().enumerate() {
                let place = place as usize;
                self.motion[place] = motion[lane];
                self.launches[place] = launches[lane];
                if self.stride.drift > 0.0 {
                    self.forces[place] = Record([0.0; 8]);
                }
            }
            if self.turn {
                let spin = W::records(turn(&self.stride, W::gather(self.spin, places), forces));
                for (lane, &place) in places.iter().enumerate() {
                    self.spin[place as usize] = spin[lane];
                }
            }
            let sound = squared.below(limit);
            fastest = W::select(sound, fastest.max(squared), W::splat(f64::INFINITY));
        }
        fastest.lanes().into_iter().fold(0.0, f64::max).sqrt()
    }
}

/// New motion and launches of eight grains, and their speeds squared.
#[inline(always)]
fn kick<W: Wide>(stride: &Stride, [motion, forces, launch]: [[W; 8]; 3]) -> ([W; 8], [W; 8], W) {
    let kick = W::splat(stride.kick);
    let [x, y, z, radius, vx, vy, vz, inverse_mass] = motion;
    let [cx, cy, cz, rate, sx, sy, sz, changed] = launch;
    let velocity = Vector::new(vx, vy, vz);
    let force = Vector::new(forces[0], forces[1], forces[2]);
    let push = force * inverse_mass + (Vector::new(cx, cy, cz) - velocity * rate);
    let gain = push * (kick * mean_decay(rate * kick));
    let v = velocity + gain;
    let given = Vector::new(sx, sy, sz) + force * kick;
    let position = Vector::new(x, y, z) + v * W::splat(stride.drift);
    // Zero, but no number where a coordinate is none or infinite.
    let nothing = (position.x + position.y + position.z) * W::splat(0.0);
    let changed = changed + gain.norm();
    (
        [
            position.x,
            position.y,
            position.z,
            radius,
            v.x,
            v.y,
            v.z,
            inverse_mass,
        ],
        [cx, cy, cz, rate, given.x, given.y, given.z, changed],
        v.norm_squared() + nothing,
    )
}

/// New spin of eight grains.
#[inline(always)]
fn turn<W: Wide>(stride: &Stride, spin: [W; 8], forces: [W; 8]) -> [W; 8] {
    let [wx, wy, wz, inverse_inertia, porosity, fluid, neighbours, awake] = spin;
    let turn = inverse_inertia * W::splat(stride.kick);
    [
        wx + forces[4] * turn,
        wy + forces[5] * turn,
        wz + forces[6] * turn,
        inverse_inertia,
        porosity,
        fluid,
        neighbours,
        awake,
    ]
}
