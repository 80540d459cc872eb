//! Flights of grains that meet nobody: one closed form over the whole span.
//!
//! ```text
//! dv/dt = c − λ v:   v₁ = v₀ + T φ(λT) (c − λ v₀),   x₁ = x₀ + T v₀ + T² ψ(λT) (c − λ v₀)
//! φ(x) = (1 − e^{−x})/x,   ψ(x) = (1 − φ(x))/x
//! ```

use crate::bed::motion::mean_decay;
use crate::math::{Number, Vector};
use crate::neighbours::{LANES, Record, Wide, WideWork};

/// Below this ψ is a series [-].
const NEAR: f64 = 0.5;

/// Flies all grains through a span on paper.
pub struct Flights<'a> {
    pub motion: &'a [Record],
    /// c_x, c_y, c_z [m/s²], λ [1/s], and more.
    pub launches: &'a [Record],
    /// Where they arrive: x, y, z [m], greatest change of velocity [m/s], v_x, v_y, v_z [m/s], spare.
    pub flights: &'a mut [Record],
    /// T [s].
    pub span: f64,
}

/// Returns the greatest speed [m/s]: infinite where a flight leads nowhere.
impl WideWork for Flights<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<W: Wide>(self) -> f64 {
        let mut fastest = W::splat(0.0);
        let count = self.flights.len();
        for (chunk, flights) in self.flights.chunks_mut(LANES).enumerate() {
            let mut members = [0; LANES];
            for (lane, member) in members.iter_mut().enumerate() {
                *member = (chunk * LANES + lane).min(count - 1) as u32;
            }
            let (arrived, squared) = fly(
                W::gather(self.motion, &members),
                W::gather(self.launches, &members),
                self.span,
            );
            flights.copy_from_slice(&W::records(arrived)[..flights.len()]);
            let sound = squared.below(W::splat(f64::INFINITY));
            fastest = W::select(sound, fastest.max(squared), W::splat(f64::INFINITY));
        }
        fastest.lanes().into_iter().fold(0.0, f64::max).sqrt()
    }
}

/// Where eight grains arrive, and the greatest of their speeds squared.
#[inline(always)]
fn fly<W: Wide>(motion: [W; 8], launch: [W; 8], span: f64) -> ([W; 8], W) {
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
        W::splat(0.0),
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
