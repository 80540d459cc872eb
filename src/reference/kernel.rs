//! Smoothing kernels seen from a horizontal layer.
//!
//! A layer of grains, infinitely wide, is smoothed in the vertical alone, by the kernel's marginal
//!
//! ```text
//! g(z) = 2π ∫_|z|^R W(r) r dr,     ∫ g dz = ∫ W dV = 1
//! ```
//!
//! Spreading a force with a kernel and sampling the result with it again smooths by g convolved with itself.
//!
//! Sources: Wendland (1995), Adv. Comput. Math. 4, 389; Lucy (1977), Astron. J. 82, 1013; the marginal is
//! geometry.

use std::f64::consts::PI;

/// Wendland C2 in three dimensions, support 2h [1/m³] at a distance [m].
///
/// W = 21/(16π h³) (1 − q/2)⁴ (1 + 2q), q = r/h.
pub fn wendland_c2(distance: f64, length: f64) -> f64 {
    let q = distance / length;
    if q >= 2.0 {
        return 0.0;
    }
    21.0 / (16.0 * PI * length.powi(3)) * (1.0 - q / 2.0).powi(4) * (1.0 + 2.0 * q)
}

/// Lucy's kernel on a support of 2h [1/m³] at a distance [m].
///
/// W = 105/(16π R³) (1 + 3r/R)(1 − r/R)³, R = 2h.
pub fn lucy(distance: f64, length: f64) -> f64 {
    let reach = 2.0 * length;
    let q = distance / reach;
    if q >= 1.0 {
        return 0.0;
    }
    105.0 / (16.0 * PI * reach.powi(3)) * (1.0 + 3.0 * q) * (1.0 - q).powi(3)
}

/// Coefficients (a, b) that make (a − b r²) W a kernel of integral one whose moment of the given power
/// vanishes. Without the second moment smoothing keeps parabolas; without the first, a slab with sharp
/// edges keeps its own mean, since a marginal's mean height is half the kernel's mean distance.
pub fn without_moment(power: i32, kernel: impl Fn(f64) -> f64, reach: f64) -> (f64, f64) {
    let moment = |power: i32| simpson(|r| 4.0 * PI * r.powi(2 + power) * kernel(r), 0.0, reach, 400);
    // a m_0 − b m_2 = 1 and a m_p − b m_(p+2) = 0.
    let (low, high) = (moment(power), moment(power + 2));
    let determinant = moment(0) * high - moment(2) * low;
    (high / determinant, low / determinant)
}

/// Share of space [-] that grains of `volume` [m³] on a square lattice of `pitch` [m] in a plane take at a
/// distance `height` [m] right above one of them, seen through a radial kernel [1/m³].
pub fn lattice_sheet(kernel: impl Fn(f64) -> f64, reach: f64, volume: f64, pitch: f64, height: f64) -> f64 {
    let sites = (reach / pitch) as i32 + 1;
    let mut solid = 0.0;
    for i in -sites..=sites {
        for j in -sites..=sites {
            let distance = (f64::from(i * i + j * j) * pitch * pitch + height * height).sqrt();
            if distance < reach {
                solid += volume * kernel(distance);
            }
        }
    }
    solid
}

/// An even function of height with bounded support, tabulated, linear between its nodes.
#[derive(Clone, Debug)]
pub struct Marginal {
    step: f64,
    /// At z = 0, step, 2 step, …; the last is zero.
    nodes: Vec<f64>,
}

/// Nodes on one side of a kernel's marginal: linear interpolation is then good to 1e-5 of the peak.
const NODES: usize = 400;

impl Marginal {
    /// Marginal of a radial kernel [1/m³] that vanishes beyond `reach` [m].
    pub fn of(kernel: impl Fn(f64) -> f64, reach: f64) -> Marginal {
        let step = reach / NODES as f64;
        let nodes = (0..=NODES)
            .map(|node| 2.0 * PI * simpson(|r| kernel(r) * r, node as f64 * step, reach, 200))
            .collect();
        Marginal { step, nodes }
    }

    /// Convolved with itself: spread, then sampled with the same kernel.
    pub fn with_itself(&self) -> Marginal {
        self.with(self)
    }

    /// Convolved with another: spread with one kernel, sampled with the other.
    pub fn with(&self, other: &Marginal) -> Marginal {
        let last = self.nodes.len() as isize - 1;
        let length = ((self.reach() + other.reach()) / self.step).ceil() as isize;
        let nodes = (0..=length)
            .map(|shift| {
                let overlap = (-last..=last).map(|index| {
                    self.nodes[index.unsigned_abs()] * other.at((shift - index) as f64 * self.step)
                });
                self.step * overlap.sum::<f64>()
            })
            .collect();
        Marginal {
            step: self.step,
            nodes,
        }
    }

    /// Value at a height [1/m].
    pub fn at(&self, height: f64) -> f64 {
        let position = height.abs() / self.step;
        let index = position as usize;
        match (self.nodes.get(index), self.nodes.get(index + 1)) {
            (Some(below), Some(above)) => below + (above - below) * (position - index as f64),
            _ => 0.0,
        }
    }

    /// Height beyond which it vanishes [m].
    pub fn reach(&self) -> f64 {
        self.step * (self.nodes.len() - 1) as f64
    }
}

/// Simpson's rule over an even number of intervals.
fn simpson(function: impl Fn(f64) -> f64, from: f64, to: f64, intervals: usize) -> f64 {
    let step = (to - from) / intervals as f64;
    let inner: f64 = (1..intervals)
        .map(|index| {
            let weight = if index % 2 == 1 { 4.0 } else { 2.0 };
            weight * function(from + index as f64 * step)
        })
        .sum();
    step / 3.0 * (function(from) + inner + function(to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::library::tests::{assert_printed, dataset};

    const LENGTH: f64 = 3e-4;

    fn wendland() -> Marginal {
        Marginal::of(|r| wendland_c2(r, LENGTH), 2.0 * LENGTH)
    }

    /// ∫ |z|^power g dz
    fn moment(marginal: &Marginal, power: i32) -> f64 {
        2.0 * simpson(
            |z| z.powi(power) * marginal.at(z),
            0.0,
            marginal.reach(),
            2 * (marginal.nodes.len() - 1),
        )
    }

    fn near(value: f64, expected: f64, tolerance: f64) {
        assert!((value - expected).abs() < tolerance, "{value} for {expected}");
    }

    #[test]
    fn kernel_constants_are_the_published_table() {
        let table = dataset("sph_kernel_constants_analytic.csv");
        let first =
            |kernel: &dyn Fn(f64) -> f64| simpson(|r| 4.0 * PI * r.powi(3) * kernel(r), 0.0, 2.0, 2000);
        for (row, name, kernel) in [
            (
                0,
                "Wendland C2",
                &(|r| wendland_c2(r, 1.0)) as &dyn Fn(f64) -> f64,
            ),
            (2, "Lucy rescaled to support 2h", &|r| lucy(r, 1.0)),
        ] {
            assert_eq!(table.text("kernel_3d", row), name);
            assert_printed(kernel(0.0), table.text("normalisation_W0_h3", row));
            assert_printed(first(kernel), table.text("first_moment_M1", row));
        }
    }

    #[test]
    fn marginals_integrate_to_one() {
        let lucy = Marginal::of(|r| lucy(r, LENGTH), 2.0 * LENGTH);
        for marginal in [wendland(), wendland().with_itself(), lucy] {
            near(moment(&marginal, 0), 1.0, 1e-5);
        }
    }

    #[test]
    fn mean_height_of_wendland_is_five_twelfths_of_its_length() {
        near(moment(&wendland(), 1) / LENGTH, 5.0 / 12.0, 1e-5);
    }

    #[test]
    fn convolution_doubles_variance_and_reach() {
        let once = wendland();
        let twice = once.with_itself();
        near(moment(&twice, 2) / moment(&once, 2), 2.0, 1e-4);
        near(twice.reach() / once.reach(), 2.0, 1e-2);
    }

    #[test]
    fn convolution_of_two_kernels_adds_variances_either_way() {
        let (narrow, wide) = (wendland(), Marginal::of(|r| lucy(r, 2.0 * LENGTH), 4.0 * LENGTH));
        let sum = moment(&narrow, 2) + moment(&wide, 2);
        for both in [narrow.with(&wide), wide.with(&narrow)] {
            near(moment(&both, 2) / sum, 1.0, 1e-3);
            near(moment(&both, 0), 1.0, 1e-4);
        }
    }

    #[test]
    fn even_and_zero_beyond_reach() {
        let marginal = wendland();
        assert_eq!(marginal.at(-1e-4), marginal.at(1e-4));
        assert_eq!(marginal.at(2.0 * LENGTH), 0.0);
        assert_eq!(marginal.at(1.0), 0.0);
    }

    #[test]
    fn second_order_kernels_have_no_variance() {
        let (a, b) = without_moment(2, |r| wendland_c2(r, LENGTH), 2.0 * LENGTH);
        let sharp = Marginal::of(|r| (a - b * r * r) * wendland_c2(r, LENGTH), 2.0 * LENGTH);
        near(moment(&sharp, 0), 1.0, 1e-4);
        near(moment(&sharp, 2) / moment(&wendland(), 2), 0.0, 1e-4);
        assert!(sharp.at(0.0) > wendland().at(0.0));
    }
}
