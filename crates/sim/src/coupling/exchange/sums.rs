//! The sums of a refresh: weights of the grains, solids of the fluid.

use super::{Exchange, GrainSize, unwrapped};
use crate::fluid::kernel::{Kernel, WendlandC2};
use crate::math::Vec3;
use crate::neighbours::{LANES, Wide, WideWork};

/// Weights and solids of eight candidates at a time. Lanes never mix before the end of a row.
pub(super) struct Weigh<'a> {
    pub exchange: &'a mut Exchange,
    /// Of the grains [m, m/s].
    pub position: &'a [Vec3],
    pub velocity: &'a [Vec3],
    /// Side of the periodic cross-section [m].
    pub width: f64,
}

/// A grain in every lane.
#[derive(Clone, Copy)]
struct Source<W> {
    position: [W; 3],
    velocity: [W; 3],
    per_length: W,
    /// V/h³, V/h⁵ and 1/d.
    unit: W,
    slope_unit: W,
    per_diameter: W,
}

impl WideWork for Weigh<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Wide>(self) {
        let exchange = self.exchange;
        let cut = exchange.rules.cut;
        for (row, &i) in exchange.order.iter().enumerate() {
            let i = i as usize;
            let size = &exchange.sizes[i];
            let place = unwrapped(&self.position[i], &exchange.grain_anchor[i], self.width);
            let grain = Source::<W>::new(size, exchange.given[i], &place, &self.velocity[i]);
            // What is smoothed once more is kept apart until then.
            let sums = match &mut exchange.twice {
                Some(twice) if twice.marked[i] => &mut twice.sums,
                _ => &mut exchange.sums,
            };
            let mirrored = exchange.rules.floor_images && place.z < 2.0 * size.length;
            for members in exchange.candidates.row(row).as_chunks::<LANES>().0 {
                let fields = W::gather(&exchange.points, members);
                let (q, solids) = grain.solids(&fields);
                let weight = fields[6] * exchange.rules.sharpening.value(q);
                let (q, weight) = (q.lanes(), weight.lanes());
                let records = match mirrored {
                    true => W::records(grain.with_image(&fields, solids)),
                    false => W::records(solids),
                };
                for lane in 0..LANES {
                    let source = exchange.source_of[members[lane] as usize];
                    let sum = &mut sums[source as usize].0;
                    for (sum, value) in sum.iter_mut().zip(&records[lane].0) {
                        *sum += value;
                    }
                    exchange.weights.offer(source, weight[lane], q[lane] < cut);
                }
            }
            exchange.weights.close();
        }
    }
}

impl<W: Wide> Source<W> {
    #[inline(always)]
    fn new(size: &GrainSize, given: f64, position: &Vec3, velocity: &Vec3) -> Self {
        let volume = given * size.volume();
        let per_length = 1.0 / size.length;
        let unit = volume * (per_length * per_length * per_length);
        Source {
            position: [W::splat(position.x), W::splat(position.y), W::splat(position.z)],
            velocity: [W::splat(velocity.x), W::splat(velocity.y), W::splat(velocity.z)],
            per_length: W::splat(per_length),
            unit: W::splat(unit),
            slope_unit: W::splat(unit * per_length * per_length),
            per_diameter: W::splat(1.0 / size.diameter),
        }
    }

    /// r/h of eight fluid particles and what the grain adds to their sums.
    #[inline(always)]
    fn solids(&self, fluid: &[W; 8]) -> (W, [W; 8]) {
        let r = [
            fluid[0] - self.position[0],
            fluid[1] - self.position[1],
            fluid[2] - self.position[2],
        ];
        let approach = r[0] * (fluid[3] - self.velocity[0])
            + r[1] * (fluid[4] - self.velocity[1])
            + r[2] * (fluid[5] - self.velocity[2]);
        let q = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt() * self.per_length;
        let solids = self.unit * WendlandC2.value(q);
        let rate = self.slope_unit * WendlandC2.slope(q) * approach;
        let zero = W::splat(0.0);
        let sums = [
            solids,
            rate,
            solids * self.velocity[0],
            solids * self.velocity[1],
            solids * self.velocity[2],
            solids * self.per_diameter,
            zero,
            zero,
        ];
        (q, sums)
    }

    /// The same with the grain's mirror image at the floor: every particle above the floor is nearer to
    /// the grain than to the image, so the grain's candidates are enough.
    #[inline(always)]
    fn with_image(&self, fluid: &[W; 8], mut sums: [W; 8]) -> [W; 8] {
        let zero = W::splat(0.0);
        let image = Source {
            position: [self.position[0], self.position[1], zero - self.position[2]],
            velocity: [self.velocity[0], self.velocity[1], zero - self.velocity[2]],
            ..*self
        };
        let (_, added) = image.solids(fluid);
        for field in 0..8 {
            sums[field] = sums[field] + added[field];
        }
        sums
    }
}
