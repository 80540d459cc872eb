//! A flow along x that is not solved for.

use crate::math::{Number, Vector};

/// Flow between a floor and a lid: u_x = 6 ū (s − s²), s from 0 at the floor to 1 at the lid, nothing
/// beyond them. Source: Hwang & Wang (2001), after Alvim (2016), eq. 88.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stream {
    /// Mean velocity ū over the height [m/s].
    pub mean: f64,
    /// Height of the floor [m].
    pub bottom: f64,
    /// From the floor to the lid [m].
    pub height: f64,
}

impl Stream {
    /// Share of the height [-], held between floor and lid.
    #[inline(always)]
    fn share<N: Number>(&self, z: N) -> N {
        let share = (z - N::splat(self.bottom)) * N::splat(1.0 / self.height);
        share.max(N::splat(0.0)).min(N::splat(1.0))
    }

    /// u_x at a height [m/s].
    #[inline(always)]
    pub fn velocity<N: Number>(&self, z: N) -> N {
        let share = self.share(z);
        N::splat(6.0 * self.mean) * share * (N::splat(1.0) - share)
    }

    /// Shear rate du_x/dz at a height [1/s]; that of the floor and of the lid beyond them.
    #[inline(always)]
    pub fn shear<N: Number>(&self, z: N) -> N {
        let share = self.share(z);
        N::splat(6.0 * self.mean / self.height) * (N::splat(1.0) - share - share)
    }

    /// ∇ × u at a height [1/s].
    #[inline(always)]
    pub fn vorticity<N: Number>(&self, z: N) -> Vector<N> {
        Vector::new(N::splat(0.0), self.shear(z), N::splat(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STREAM: Stream = Stream {
        mean: 0.1,
        bottom: 2e-4,
        height: 5e-3,
    };

    #[test]
    fn the_mean_over_the_height_is_that_of_the_stream_and_the_walls_hold_it() {
        let count = 1000;
        let at = |place: i32| STREAM.bottom + (f64::from(place) + 0.5) / f64::from(count) * STREAM.height;
        let sum: f64 = (0..count).map(|place| STREAM.velocity(at(place))).sum();
        assert!((sum / f64::from(count) / STREAM.mean - 1.0).abs() < 1e-6);
        for beyond in [STREAM.bottom - 1e-3, STREAM.bottom + STREAM.height + 1e-3] {
            assert_eq!(STREAM.velocity(beyond), 0.0);
        }
    }

    #[test]
    fn the_shear_is_the_slope_of_the_velocity() {
        for share in [0.1, 0.4, 0.5, 0.9] {
            let z = STREAM.bottom + share * STREAM.height;
            let step = 1e-7;
            let slope = (STREAM.velocity(z + step) - STREAM.velocity(z - step)) / (2.0 * step);
            assert!(
                (slope - STREAM.shear(z)).abs() < 1e-6 * STREAM.shear(STREAM.bottom),
                "{share}"
            );
        }
    }
}
