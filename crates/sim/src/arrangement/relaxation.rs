//! Pushes overlapping grains apart.
//!
//! Grains repel by linear springs where they overlap, and the energy is minimised: O'Hern, Silbert, Liu
//! and Nagel (2003), doi:10.1103/PhysRevE.68.011306. Below the jamming density the minimum is zero. The
//! minimiser is FIRE of Bitzek, Koskinen, Gähler, Moseler and Gumbsch (2006),
//! doi:10.1103/PhysRevLett.97.170201, with its published parameters. Lengths keep their unit; stiffness
//! and the smallest mass are one, so that the time step is a pure number.

use super::levels::Levels;
use super::{CLEARANCE, Region};
use crate::math::Vec3;

/// Longest step; the stiffest motion of a dozen touching neighbours stays stable at 0.4.
const LONGEST_STEP: f64 = 0.25;
const FIRST_STEP: f64 = 0.1;
const MIXING: f64 = 0.1;
const STEPS_BEFORE_FASTER: u32 = 5;
/// Reach of the pair list beyond contact over the mean radius [-].
const SLACK: f64 = 0.3;

pub(super) struct Relaxation<'a> {
    region: &'a Region,
    /// Radii that are pushed apart, a share larger than the true ones [m].
    radii: Vec<f64>,
    masses: Vec<f64>,
    positions: Vec<Vec3>,
    velocities: Vec<Vec3>,
    forces: Vec<Vec3>,
    pairs: Vec<(u32, u32)>,
    slack: f64,
    /// Where grains were when the pairs were listed.
    listed: Vec<Vec3>,
    /// True distance of contact, with its clearance, over the one that is pushed to [-].
    shrinkage: f64,
}

/// Where grains got to, and their largest overlap over the distance of contact [-].
pub(super) type Jam = (Vec<Vec3>, f64);

/// How the minimiser walks at the moment.
struct Pace {
    step: f64,
    mixing: f64,
    downhill: u32,
}

impl<'a> Relaxation<'a> {
    /// `excess` [-] is how much larger than true the radii are while grains push each other.
    pub(super) fn new(region: &'a Region, radii: &[f64], mut positions: Vec<Vec3>, excess: f64) -> Self {
        let smallest = radii.iter().copied().fold(f64::INFINITY, f64::min);
        let mean = radii.iter().sum::<f64>() / radii.len() as f64;
        for (position, &radius) in positions.iter_mut().zip(radii) {
            for axis in 0..3 {
                position[axis] = region.confine(axis, radius, position[axis]);
            }
        }
        let zeros = vec![Vec3::zeros(); radii.len()];
        let mut relaxation = Relaxation {
            region,
            radii: radii.iter().map(|r| r * (1.0 + excess)).collect(),
            // A large grain has neighbours in proportion to its surface: all are equally stiff this way.
            masses: radii.iter().map(|r| (r / smallest) * (r / smallest)).collect(),
            listed: positions.clone(),
            positions,
            velocities: zeros.clone(),
            forces: zeros,
            pairs: Vec::new(),
            slack: SLACK * mean,
            shrinkage: (1.0 + CLEARANCE) / (1.0 + excess),
        };
        relaxation.list();
        relaxation
    }

    /// Relaxes until true radii overlap no more, in at most so many steps.
    pub(super) fn run(mut self, most_steps: usize) -> Result<Vec<Vec3>, Jam> {
        let mut pace = Pace {
            step: FIRST_STEP,
            mixing: MIXING,
            downhill: 0,
        };
        let mut worst = f64::INFINITY;
        for _ in 0..most_steps {
            worst = self.push();
            if worst <= 0.0 {
                return Ok(self.positions);
            }
            let moved = self.advance(&mut pace);
            if 2.0 * moved > self.slack {
                self.list();
            }
        }
        Err((self.positions, worst))
    }

    /// Lists the pairs that may touch before anybody has moved half the slack.
    fn list(&mut self) {
        let mut levels = Levels::new(self.region, &self.radii, self.slack);
        for (grain, position) in self.positions.iter().enumerate() {
            levels.insert(grain, position);
        }
        self.pairs.clear();
        for (i, position) in self.positions.iter().enumerate() {
            let reach = self.radii[i] + self.slack;
            levels.any_as_large_near(i, position, reach, |j| {
                // Within a level both see each other, between levels only the smaller sees the larger.
                if levels.level(i) != levels.level(j) || j < i {
                    let difference = self.region.nearest(position - self.positions[j]);
                    let within = reach + self.radii[j];
                    if difference.norm_squared() < within * within {
                        self.pairs.push((i as u32, j as u32));
                    }
                }
                false
            });
        }
        self.listed.copy_from_slice(&self.positions);
    }

    /// Forces of all overlaps; gives back the largest overlap of true radii over their sum [-].
    fn push(&mut self) -> f64 {
        self.forces.fill(Vec3::zeros());
        let mut worst = 0.0f64;
        for &(i, j) in &self.pairs {
            let (i, j) = (i as usize, j as usize);
            let contact = self.radii[i] + self.radii[j];
            let difference = self.region.nearest(self.positions[i] - self.positions[j]);
            let squared = difference.norm_squared();
            if squared >= contact * contact {
                continue;
            }
            let distance = squared.sqrt();
            worst = worst.max(self.shrinkage - distance / contact);
            let direction = match distance > 0.0 {
                true => difference / distance,
                false => Vec3::z(),
            };
            let force = direction * (contact - distance);
            self.forces[i] += force;
            self.forces[j] -= force;
        }
        worst
    }

    /// One step of FIRE; gives back how far any grain is from where it was listed [m].
    fn advance(&mut self, pace: &mut Pace) -> f64 {
        self.rest_on_walls();
        let (mut power, mut speed, mut force) = (0.0, 0.0, 0.0);
        for i in 0..self.positions.len() {
            // Velocity and force in the coordinates in which all masses are one.
            power += self.velocities[i].dot(&self.forces[i]);
            speed += self.velocities[i].norm_squared() * self.masses[i];
            force += self.forces[i].norm_squared() / self.masses[i];
        }
        pace.adapt(power);
        let mixing = if power > 0.0 { pace.mixing } else { 0.0 };
        let turn = match force > 0.0 {
            true => mixing * (speed / force).sqrt(),
            false => 0.0,
        };
        let keep = if power > 0.0 { 1.0 - mixing } else { 0.0 };
        let mut farthest = 0.0f64;
        for i in 0..self.positions.len() {
            let pull = self.forces[i] / self.masses[i];
            let velocity = self.velocities[i] * keep + pull * (turn + pace.step);
            let step = velocity * pace.step;
            self.velocities[i] = velocity;
            for axis in 0..3 {
                let moved = self.positions[i][axis] + step[axis];
                self.positions[i][axis] = self.region.confine(axis, self.true_radius(i), moved);
            }
            let moved = self.region.nearest(self.positions[i] - self.listed[i]);
            farthest = farthest.max(moved.norm_squared());
        }
        farthest.sqrt()
    }

    /// Takes away what pushes a grain into the wall it lies at.
    fn rest_on_walls(&mut self) {
        for axis in 0..3 {
            if self.region.wraps(axis) {
                continue;
            }
            for i in 0..self.positions.len() {
                let (low, high) = self.region.bounds(axis, self.true_radius(i));
                let position = self.positions[i][axis];
                let (force, velocity) = (&mut self.forces[i][axis], &mut self.velocities[i][axis]);
                if position <= low {
                    (*force, *velocity) = (force.max(0.0), velocity.max(0.0));
                }
                if position >= high {
                    (*force, *velocity) = (force.min(0.0), velocity.min(0.0));
                }
            }
        }
    }

    fn true_radius(&self, grain: usize) -> f64 {
        self.radii[grain] * self.shrinkage
    }
}

impl Pace {
    fn adapt(&mut self, power: f64) {
        if power > 0.0 {
            self.downhill += 1;
            if self.downhill > STEPS_BEFORE_FASTER {
                self.step = (1.1 * self.step).min(LONGEST_STEP);
                self.mixing *= 0.99;
            }
        } else {
            *self = Pace {
                step: 0.5 * self.step,
                mixing: MIXING,
                downhill: 0,
            };
        }
    }
}
