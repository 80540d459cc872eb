//! Grains of one to four classes in a rigid set, and how they stand among each other.

use std::f64::consts::PI;

use super::SuspendedClass;
use crate::drag::{PolydisperseLaw, polydisperse_coefficient};

/// Classes by share of the number of all grains.
#[derive(Clone, Debug, PartialEq)]
pub struct Mixture {
    pub classes: Vec<SuspendedClass>,
}

/// Volume of a grain [m³].
pub fn volume(class: &SuspendedClass) -> f64 {
    PI / 6.0 * class.diameter * class.diameter * class.diameter
}

/// Mass of a grain [kg].
pub fn mass(class: &SuspendedClass) -> f64 {
    class.density * volume(class)
}

impl Mixture {
    /// Mean over the number of all grains.
    pub fn mean(&self, value: impl Fn(&SuspendedClass) -> f64) -> f64 {
        self.classes.iter().map(|class| class.share * value(class)).sum()
    }

    /// The smallest diameter [m].
    pub fn smallest(&self) -> f64 {
        let diameters = self.classes.iter().map(|class| class.diameter);
        diameters.fold(f64::INFINITY, f64::min)
    }

    /// The largest diameter [m].
    pub fn largest(&self) -> f64 {
        self.classes
            .iter()
            .map(|class| class.diameter)
            .fold(0.0, f64::max)
    }

    /// ⟨d⟩ = Σ s d³ / Σ s d² [m]; Raso (2014), eq. 2.80.
    pub fn sauter_mean(&self) -> f64 {
        self.mean(|class| class.diameter.powi(3)) / self.mean(|class| class.diameter.powi(2))
    }

    /// Mean drag per superficial slip of a grain [kg/s] where all share the slip speed `slip` [m/s], in a
    /// fluid of these density [kg/m³] and viscosity [Pa s].
    pub fn coefficient(&self, law: &impl PolydisperseLaw, fluid: [f64; 2], slip: f64, porosity: f64) -> f64 {
        let sauter = self.sauter_mean();
        self.mean(|class| {
            let sizes = [class.diameter, class.diameter / sauter];
            polydisperse_coefficient(law, fluid, sizes, slip, porosity)
        })
    }

    /// Superficial slip speed [m/s] that all share when the mean drag equals `force` [N].
    pub fn balance(&self, law: &impl PolydisperseLaw, fluid: [f64; 2], force: f64, porosity: f64) -> f64 {
        let drag = |slip: f64| slip * self.coefficient(law, fluid, slip, porosity) - force;
        let mut high = force / (3.0 * PI * fluid[1] * self.smallest());
        while drag(high) < 0.0 {
            high *= 2.0;
        }
        crate::math::bisect(0.0, high, drag)
    }

    /// Class of each site of a lattice, site by site along x, then y, then z: numbers by the shares, rounded,
    /// mixed as evenly as the lattice allows.
    ///
    /// Equal shares alternate along all axes. Others follow a sequence of low discrepancy (Roberts 2018):
    /// in any region there are nearly as many of each class as in any other of its size.
    pub fn arrange(&self, side: usize, layers: usize) -> Vec<usize> {
        let sites = side * side * layers;
        let order = |site: usize| {
            let (x, y, z) = (site % side, site / side % side, site / side / side);
            if self
                .classes
                .iter()
                .all(|class| class.share == self.classes[0].share)
            {
                return ((x + y + z) % self.classes.len()) as f64;
            }
            const BASE: f64 = 1.220_744_084_605_759_5;
            let turn = x as f64 / BASE + y as f64 / (BASE * BASE) + z as f64 / (BASE * BASE * BASE);
            (0.5 + turn).fract()
        };
        let mut ranked: Vec<(f64, usize)> = (0..sites).map(|site| (order(site), site)).collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut class_of = vec![0; sites];
        let (mut first, mut share) = (0, 0.0);
        for (class, SuspendedClass { share: own, .. }) in self.classes.iter().enumerate() {
            share += own;
            let end = if class + 1 == self.classes.len() {
                sites
            } else {
                ((share * sites as f64).round() as usize).clamp(first, sites)
            };
            for (_, site) in &ranked[first..end] {
                class_of[*site] = class;
            }
            first = end;
        }
        class_of
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drag::{BeetstraCello, DiFelice, DragScale};

    const WATER: [f64; 2] = [1000.0, 0.89e-3];

    fn glass(diameters: &[f64], shares: &[f64]) -> Mixture {
        let class = |(&diameter, &share): (&f64, &f64)| SuspendedClass {
            diameter,
            density: 2500.0,
            share,
        };
        Mixture {
            classes: diameters.iter().zip(shares).map(class).collect(),
        }
    }

    #[test]
    fn blocks_of_two_sizes_settle_as_fast_as_raso_s_equation_4_5_corrected() {
        // Equal numbers: 5.92309 mm/s at 150 and 100 µm, 10.3972 mm/s at 200 and 100 µm.
        for (large, porosity, speed) in [(1.5e-4, 0.9, 5.92309e-3), (2e-4, 0.906, 10.3972e-3)] {
            let mixture = glass(&[large, 1e-4], &[0.5, 0.5]);
            let weight = mixture.mean(|class| 1500.0 * volume(class) * 9.81);
            let found = mixture.balance(&BeetstraCello, WATER, porosity * weight, porosity);
            assert!((found / speed - 1.0).abs() < 2e-5, "{found}");
        }
    }

    #[test]
    fn one_class_and_the_same_class_twice_are_equal_grains() {
        let scale = DragScale {
            diameter: 1e-4,
            density: WATER[0],
            viscosity: WATER[1],
        };
        let alone = scale.balance(&DiFelice, 7e-9, 0.9);
        for mixture in [glass(&[1e-4], &[1.0]), glass(&[1e-4, 1e-4], &[0.3, 0.7])] {
            let found = mixture.balance(&DiFelice, WATER, 7e-9, 0.9);
            assert!((found / alone - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn equal_shares_alternate() {
        let sites = glass(&[2e-4, 1e-4], &[0.5, 0.5]).arrange(4, 3);
        for (site, class) in sites.iter().enumerate() {
            let (x, y, z) = (site % 4, site / 4 % 4, site / 16);
            assert_eq!(*class, (x + y + z) % 2);
        }
    }

    #[test]
    fn every_part_of_a_lattice_has_its_share_of_each_class() {
        let shares = [0.5, 0.3, 0.2];
        let (side, layers) = (12, 12);
        let sites = glass(&[2e-4, 1.5e-4, 1e-4], &shares).arrange(side, layers);
        for (class, share) in shares.iter().enumerate() {
            let count = |part: &[usize]| part.iter().filter(|&&other| other == class).count() as f64;
            assert!((count(&sites) - share * sites.len() as f64).abs() <= 1.0);
            for layer in sites.chunks(side * side) {
                let expected = share * layer.len() as f64;
                assert!((count(layer) - expected).abs() < 0.05 * layer.len() as f64);
            }
        }
    }
}
