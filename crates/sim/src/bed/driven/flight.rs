//! Flights of grains that meet nobody: one closed form over the whole span.
//!
//! ```text
//! dv/dt = c − λ v:   v₁ = v₀ + T φ(λT) (c − λ v₀),   x₁ = x₀ + T v₀ + T² ψ(λT) (c − λ v₀)
//! φ(x) = (1 − e^{−x})/x,   ψ(x) = (1 − φ(x))/x
//! ```

use std::f64::consts::PI;

use super::Drive;
use crate::bed::motion::{Surroundings, mean_decay};
use crate::math::{Number, Vector};
use crate::neighbours::{LANES, Record, Wide, WideWork};

/// Below this ψ is a series [-].
const NEAR: f64 = 0.5;
/// Drives written at a time before they are read eight by eight: who reads at once waits for the writes.
const TAKEN: usize = 64;

/// Flies grains through a span on paper.
pub struct Flights<'a> {
    pub surroundings: &'a Surroundings,
    pub motion: &'a [Record],
    /// Numbers of the grains, by which the drives go.
    pub number: &'a [u32],
    pub drives: &'a [Drive],
    /// What they fly by: c_x, c_y, c_z [m/s²], λ [1/s], four zeros.
    pub launches: &'a mut [Record],
    /// Where they arrive: x, y, z [m], change of velocity [m/s], v_x, v_y, v_z [m/s], change of v_z by
    /// weight and buoyancy [m/s].
    pub flights: &'a mut [Record],
    /// T [s].
    pub span: f64,
}

/// Returns the greatest speed and the greatest change of velocity [m/s]: infinite speed where a flight
/// leads nowhere.
impl WideWork for Flights<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run<W: Wide>(self) -> [f64; 2] {
        let (mut fastest, mut change) = (W::splat(0.0), W::splat(0.0));
        let count = self.flights.len();
        let mut drives = [Record([0.0; 8]); TAKEN];
        for first in (0..count).step_by(TAKEN) {
            let last = (first + TAKEN).min(count);
            for (record, number) in drives.iter_mut().zip(&self.number[first..last]) {
                let Drive { drag, flow, force } = &self.drives[*number as usize];
                *record = Record([force.x, force.y, force.z, *drag, flow.x, flow.y, flow.z, 0.0]);
            }
            for start in (first..last).step_by(LANES) {
                let end = (start + LANES).min(last);
                let [mut members, mut rows] = [[0; LANES]; 2];
                for lane in 0..LANES {
                    // Empty lanes do what the last grain does.
                    let grain = (start + lane).min(end - 1);
                    (members[lane], rows[lane]) = (grain as u32, (grain - first) as u32);
                }
                let motion = W::gather(self.motion, &members);
                let launch = launch(self.surroundings, &motion, W::gather(&drives, &rows));
                let (arrived, squared) = fly(&motion, &launch, self.span);
                let sound = squared.below(W::splat(f64::INFINITY));
                fastest = W::select(sound, fastest.max(squared), W::splat(f64::INFINITY));
                change = change.max(arrived[3]);
                let [cx, cy, cz, rate, own] = launch;
                let zero = W::splat(0.0);
                let launch = [cx, cy, cz, rate, zero, zero, zero, zero];
                let [x, y, z, changed, vx, vy, vz] = arrived;
                let arrived = [x, y, z, changed, vx, vy, vz, own * W::splat(self.span)];
                self.launches[start..end].copy_from_slice(&W::records(launch)[..end - start]);
                self.flights[start..end].copy_from_slice(&W::records(arrived)[..end - start]);
            }
        }
        let greatest = |lanes: W| lanes.lanes().into_iter().fold(0.0, f64::max);
        [greatest(fastest).sqrt(), greatest(change)]
    }
}

/// c, λ and what weight and buoyancy give to c_z.
#[inline(always)]
fn launch<W: Wide>(surroundings: &Surroundings, motion: &[W; 8], drive: [W; 8]) -> [W; 5] {
    let (radius, inverse_mass) = (motion[3], motion[7]);
    let rate = drive[3] * inverse_mass;
    let displaced = W::splat(4.0 / 3.0 * PI * surroundings.fluid_density * surroundings.gravity);
    let buoyancy = displaced * radius * radius * radius * inverse_mass;
    let own = buoyancy - W::splat(surroundings.gravity);
    [
        drive[0] * inverse_mass + drive[4] * rate,
        drive[1] * inverse_mass + drive[5] * rate,
        drive[2] * inverse_mass + drive[6] * rate + own,
        rate,
        own,
    ]
}

/// Where eight grains arrive, and the greatest of their speeds squared.
#[inline(always)]
fn fly<W: Wide>(motion: &[W; 8], launch: &[W; 5], span: f64) -> ([W; 7], W) {
    let time = W::splat(span);
    let velocity = Vector::new(motion[4], motion[5], motion[6]);
    let rate = launch[3];
    let push = Vector::new(launch[0], launch[1], launch[2]) - velocity * rate;
    let [first, second] = mean_decays(rate * time);
    let gain = push * (time * first);
    let arrival = velocity + gain;
    let way = velocity * time + push * (time * time * second);
    let nothing = (way.x + way.y + way.z) * W::splat(0.0);
    let flight = [
        motion[0] + way.x,
        motion[1] + way.y,
        motion[2] + way.z,
        gain.norm(),
        arrival.x,
        arrival.y,
        arrival.z,
    ];
    let squared = velocity.norm_squared().max(arrival.norm_squared());
    (flight, squared + nothing)
}

/// φ and ψ for x ≥ 0: 1 and ½ at zero.
#[inline(always)]
fn mean_decays<N: Number>(x: N) -> [N; 2] {
    let (one, near) = (N::splat(1.0), N::splat(NEAR));
    // ψ = 1/2! − x/3! + x²/4! − …: fourteen terms reach rounding here.
    let mut series = one;
    for count in (3..=16).rev() {
        series = one - x * N::splat(1.0 / f64::from(count)) * series;
    }
    series = N::splat(0.5) * series;
    let first = mean_decay(x);
    if !N::any(near.below(x)) {
        return [one - x * series, series];
    }
    let far = near.below(x);
    let second = N::select(far, (one - first) / x, series);
    [N::select(far, first, one - x * series), second]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_means_are_smooth_from_rest_to_the_stiffest_drag() {
        for x in [1e-300_f64, 1e-12, 1e-3, 0.1, 0.4999, 0.5001, 0.9, 5.0, 300.0, 1e6] {
            let [first, second] = mean_decays(x);
            let exact = -(-x).exp_m1() / x;
            assert!((first / exact - 1.0).abs() < 1e-15, "{x}: {first} for {exact}");
            // x − 1 + e^{−x} by its own series where it cancels.
            let mut terms = (2..40).scan(1.0, |term, count| {
                *term *= -x / f64::from(count);
                Some(*term)
            });
            let exact = if x < 1.0 {
                terms.by_ref().map(|term| -term).sum::<f64>() / x
            } else {
                (1.0 - exact) / x
            };
            assert!((second / exact - 1.0).abs() < 2e-15, "{x}: {second} for {exact}");
        }
        assert_eq!(mean_decays(0.0), [1.0, 0.5]);
    }
}
