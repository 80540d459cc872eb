//! Who touches whom, and whether action equals reaction.

use crate::math::Vec3;
use crate::neighbours::in_widest;

use super::Bed;
use super::contacts::PairSweep;
use super::pairs::PairList;

/// Contacts by the places of the grains.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Touching {
    pub pairs: Vec<[u32; 2]>,
    /// A grain and the wall it touches.
    pub walls: Vec<(u32, u32)>,
}

impl Bed {
    /// All contacts now.
    pub fn contacts(&self) -> Touching {
        let grains = &self.grains;
        let pairs = members(&self.pairs)
            .filter(|&[i, j]| self.overlap(i as usize, j as usize) > 0.0)
            .collect();
        let walls = members(&self.walls.list)
            .filter(|&[grain, wall]| self.walls.gap(grains, grain as usize, wall as usize) < 0.0)
            .map(|[grain, wall]| (grain, wall))
            .collect();
        Touching { pairs, walls }
    }

    /// The shortest of all equal ways between two positions [m].
    pub fn nearest(&self, mut way: Vec3) -> Vec3 {
        for (axis, &side) in self.interaction.period.iter().enumerate() {
            if side > 0.0 {
                way[axis] -= side * (way[axis] / side).round();
            }
        }
        way
    }

    /// The same position within the sides of the periodic directions [m].
    pub fn inside(&self, mut position: Vec3) -> Vec3 {
        for (axis, &side) in self.interaction.period.iter().enumerate() {
            if side > 0.0 {
                let within = position[axis].rem_euclid(side);
                // Rounding may give the full side.
                position[axis] = if within < side { within } else { 0.0 };
            }
        }
        position
    }

    /// What the forces between grains sum up to, over the sum of their sizes [-]: zero but for rounding.
    pub fn momentum_error(&self) -> f64 {
        let mut forces = vec![crate::neighbours::Record::default(); self.forces.len()];
        let mut pairs = self.pairs.clone();
        in_widest(PairSweep {
            interaction: &self.interaction,
            grains: &self.grains,
            pairs: pairs.whole(),
            elapsed: 0.0,
            sink: &mut forces[..],
        });
        let (mut sum, mut sizes) = (Vec3::zeros(), 0.0);
        for force in &forces[..self.grains.len()] {
            let force = Vec3::new(force.0[0], force.0[1], force.0[2]);
            sum += force;
            sizes += force.norm();
        }
        if sizes > 0.0 { sum.norm() / sizes } else { 0.0 }
    }

    fn overlap(&self, i: usize, j: usize) -> f64 {
        let grains = &self.grains;
        let way = self.nearest(grains.position(i) - grains.position(j));
        grains.radius(i) + grains.radius(j) - way.norm()
    }

    /// The deepest contact of two grains: their numbers and the overlap over the smaller diameter.
    pub fn deepest_contact(&self) -> Option<([u32; 2], f64)> {
        let grains = &self.grains;
        let depth = |[i, j]: [u32; 2]| {
            let (i, j) = (i as usize, j as usize);
            self.overlap(i, j) / (2.0 * grains.radius(i).min(grains.radius(j)))
        };
        let deepest = members(&self.pairs).max_by(|a, b| depth(*a).total_cmp(&depth(*b)))?;
        Some((deepest.map(|place| grains.number[place as usize]), depth(deepest)))
    }
}

fn members(list: &PairList) -> impl Iterator<Item = [u32; 2]> + '_ {
    list.pairs().map(|(.., pair)| pair)
}
