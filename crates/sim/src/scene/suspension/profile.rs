//! Porosity over height, and the fronts in it.

use crate::bed::Bed;
use crate::coupling::slices::{solid_volume_between, sphere_volume_between};

/// Solids fractions of horizontal slabs by the exact volumes of spheres between their planes.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Height of a slab [m].
    pub slab: f64,
    /// 1 − ε of every slab, from the floor [-].
    pub solids: Vec<f64>,
}

impl Profile {
    /// Slabs from the floor up to `height` [m], no lower than `least` [m]; `area` is the cross-section [m²].
    pub fn of(bed: &Bed, height: f64, least: f64, area: f64) -> Profile {
        let count = (height / least).floor().max(1.0) as usize;
        let slab = height / count as f64;
        let mut solids = vec![0.0; count];
        let grains = &bed.grains;
        for grain in 0..grains.moving {
            let (z, radius) = (grains.position(grain).z, grains.radius(grain));
            let first = ((z - radius) / slab).floor().max(0.0) as usize;
            let last = (((z + radius) / slab).ceil().max(0.0) as usize).min(count);
            for (level, solids) in solids.iter_mut().enumerate().take(last).skip(first) {
                let low = level as f64 * slab;
                *solids += sphere_volume_between(z, radius, low, low + slab);
            }
        }
        solids.iter_mut().for_each(|solids| *solids /= area * slab);
        Profile { slab, solids }
    }

    /// Height [m] of the middle of a slab.
    pub fn middle(&self, level: usize) -> f64 {
        (level as f64 + 0.5) * self.slab
    }

    /// Height [m] below which the solids fraction exceeds `least` [-] without a gap from the floor on; zero
    /// where it does not.
    pub fn front_from_below(&self, least: f64) -> f64 {
        let level = self.solids.iter().position(|solids| *solids <= least);
        self.crossing(level.unwrap_or(self.solids.len()), least)
    }

    /// Height [m] above which the solids fraction stays below `most` [-]; zero where it always does.
    pub fn front_from_above(&self, most: f64) -> f64 {
        let level = self.solids.iter().rposition(|solids| *solids > most);
        self.crossing(level.map_or(0, |level| level + 1), most)
    }

    /// Where the profile, straight between the middles of slabs, falls through a value under slab `above`.
    fn crossing(&self, above: usize, value: f64) -> f64 {
        let Some(below) = above.checked_sub(1) else {
            return 0.0;
        };
        let under = self.solids[below];
        // Over the highest slab there is nothing.
        let over = self.solids.get(above).copied().unwrap_or(0.0);
        self.middle(below) + (under - value) / (under - over) * self.slab
    }
}

/// A deposit on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deposit {
    /// Height of its front [m].
    pub height: f64,
    /// Solids fraction of the central 80 % of its height [-]; no number without a deposit.
    pub solids: f64,
    /// Solids fraction of its front: the mean of suspension and deposit [-].
    pub threshold: f64,
}

/// Solids fraction of a poured bed of spheres [-], the first guess.
const POURED: f64 = 0.55;
/// Share of the deposit's height that its solids fraction is taken over [-].
const CENTRAL: f64 = 0.8;
/// Turns after which front and solids fraction agree with each other.
const TURNS: usize = 4;

impl Deposit {
    /// The deposit of a bed whose profile is given, under a suspension of a solids fraction [-] at the
    /// start, on a floor of `area` [m²].
    pub fn of(bed: &Bed, profile: &Profile, suspended: f64, area: f64) -> Deposit {
        let mut deposit = Deposit::guessed(profile, suspended);
        for _ in 0..TURNS {
            let margin = 0.5 * (1.0 - CENTRAL) * deposit.height;
            let (low, high) = (margin, deposit.height - margin);
            if high - low < profile.slab {
                deposit.solids = f64::NAN;
                break;
            }
            let grains = &bed.grains;
            let spheres = (0..grains.moving).map(|grain| (grains.position(grain).z, grains.radius(grain)));
            deposit.solids = solid_volume_between(spheres, low, high) / (area * (high - low));
            deposit.threshold = 0.5 * (suspended + deposit.solids);
            deposit.height = profile.front_from_below(deposit.threshold);
        }
        deposit
    }

    /// The same where the solids fraction of the deposit is that of any poured bed.
    pub fn guessed(profile: &Profile, suspended: f64) -> Deposit {
        let threshold = 0.5 * (suspended + POURED);
        Deposit {
            height: profile.front_from_below(threshold),
            solids: f64::NAN,
            threshold,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(solids: &[f64]) -> Profile {
        Profile {
            slab: 0.1,
            solids: solids.to_vec(),
        }
    }

    #[test]
    fn fronts_lie_where_the_profile_crosses_the_value() {
        let profile = steps(&[0.6, 0.6, 0.3, 0.1, 0.1, 0.05, 0.0]);
        assert!((profile.front_from_below(0.45) - 0.2).abs() < 1e-12);
        assert!((profile.front_from_below(0.2) - 0.3).abs() < 1e-12);
        assert!((profile.front_from_above(0.05 + 1e-9) - 0.55).abs() < 1e-6);
        assert!((profile.front_from_above(0.075) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn without_a_crossing_a_front_is_at_the_floor_or_over_the_highest_slab() {
        let dilute = steps(&[0.1, 0.1]);
        assert_eq!(dilute.front_from_below(0.3), 0.0);
        assert_eq!(dilute.front_from_above(0.3), 0.0);
        // The suspension ends at its lid: half a slab over the last middle at half the solids.
        assert!((dilute.front_from_above(0.05) - 0.2).abs() < 1e-12);
    }
}
