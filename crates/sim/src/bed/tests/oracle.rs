//! All forces by brute force: every pair on its own, one number at a time.

use std::collections::BTreeMap;

use crate::bed::{Bed, Wall};
use crate::contact::{Body, Couple, Meeting, Motion, Touch};
use crate::math::{Vec3, Vector};

/// Force [N] and torque [N m] on one grain.
pub type Effort = [Vec3; 2];

/// Grains by their numbers, and what their contacts remember.
#[derive(Default)]
pub struct Oracle {
    pub histories: BTreeMap<[u32; 2], Vector<f64>>,
    pub deepest: f64,
    pub contacts: usize,
}

impl Oracle {
    /// Forces on all grains, by number; histories move on by `elapsed` [s].
    pub fn efforts(&mut self, bed: &Bed, walls: &[Wall], elapsed: f64) -> Vec<Effort> {
        let count = bed.grains.len();
        let mut efforts = vec![[Vec3::zeros(); 2]; count];
        self.contacts = 0;
        for i in 0..count {
            for j in i + 1..count {
                if let Some([first, second]) = self.pair(bed, [i, j], elapsed) {
                    add(&mut efforts[i], first);
                    add(&mut efforts[j], second);
                }
            }
        }
        for (i, sum) in efforts.iter_mut().enumerate() {
            for (number, wall) in walls.iter().enumerate() {
                if let Some(effort) = self.wall(bed, i, number, wall, elapsed) {
                    add(sum, effort);
                }
            }
        }
        efforts
    }

    fn pair(&mut self, bed: &Bed, [i, j]: [usize; 2], elapsed: f64) -> Option<[Effort; 2]> {
        let bodies = [body(bed, i), body(bed, j)];
        if bodies.iter().all(Body::is_wall) {
            return None;
        }
        let motions = [motion(bed, i), motion(bed, j)];
        let between = Vec3::from(motions[0].position - motions[1].position);
        let between = bed.nearest(between);
        let radii = bodies.map(|body| body.radius);
        let meeting = Meeting::of_spheres(radii, between.into());
        let couple = Couple::new(&bodies[0], &bodies[1]);
        let names = [i as u32, j as u32];
        let [mut first, mut second] = [[Vec3::zeros(); 2]; 2];
        if meeting.overlap > 0.0 {
            let touch = Touch::new(&couple, &meeting, [&motions[0], &motions[1]]);
            let (force, torques) = self.react(bed, names, &touch, elapsed);
            first = [force, torques[0]];
            second = [-force, torques[1]];
            let depth = 0.5 * meeting.overlap / couple.smaller_radius;
            self.deepest = self.deepest.max(depth);
        } else {
            self.histories.remove(&names);
        }
        if let Some(attraction) = &bed.interaction.attraction {
            let pull = attraction.between_grains(&meeting, radii[0] + radii[1], radii);
            let pull = Vec3::from(meeting.normal) * pull;
            first[0] -= pull;
            second[0] += pull;
        }
        Some([first, second])
    }

    fn wall(&mut self, bed: &Bed, i: usize, number: usize, wall: &Wall, elapsed: f64) -> Option<Effort> {
        let (sphere, grain) = (body(bed, i), motion(bed, i));
        if sphere.is_wall() {
            return None;
        }
        let still = Motion {
            position: Vector::zeros(),
            velocity: Vector::zeros(),
            angular_velocity: Vector::zeros(),
        };
        let height = (Vec3::from(grain.position) - wall.point).dot(&wall.normal);
        let meeting = Meeting::of_sphere_and_wall(sphere.radius, height, wall.normal.into());
        let names = [i as u32, (bed.grains.len() + number) as u32];
        let mut effort = [Vec3::zeros(); 2];
        if meeting.overlap > 0.0 {
            let couple = Couple::new(&sphere, &Body::WALL);
            let touch = Touch::new(&couple, &meeting, [&grain, &still]);
            let (force, torques) = self.react(bed, names, &touch, elapsed);
            effort = [force, torques[0]];
            self.deepest = self.deepest.max(0.5 * meeting.overlap / sphere.radius);
        } else {
            self.histories.remove(&names);
        }
        if let Some(attraction) = &bed.interaction.attraction {
            effort[0] -= wall.normal * attraction.to_wall(&meeting, sphere.radius);
        }
        Some(effort)
    }

    fn react(&mut self, bed: &Bed, names: [u32; 2], touch: &Touch, elapsed: f64) -> (Vec3, [Vec3; 2]) {
        let history = self.histories.get(&names).copied().unwrap_or(Vector::zeros());
        let interaction = &bed.interaction;
        let (reaction, history) = interaction
            .laws
            .react(touch, history, elapsed, interaction.time_step);
        self.histories.insert(names, history);
        self.contacts += 1;
        (reaction.force.into(), reaction.torques.map(Vec3::from))
    }
}

fn add(sum: &mut Effort, part: Effort) {
    sum[0] += part[0];
    sum[1] += part[1];
}

fn place(bed: &Bed, number: usize) -> usize {
    bed.grains.places()[number] as usize
}

fn body(bed: &Bed, number: usize) -> Body {
    let (grains, place) = (&bed.grains, place(bed, number));
    Body {
        radius: grains.radius(place),
        mass: grains.mass(place),
        inertia: grains.inertia(place),
    }
}

fn motion(bed: &Bed, number: usize) -> Motion {
    let (grains, place) = (&bed.grains, place(bed, number));
    Motion {
        position: grains.position(place).into(),
        velocity: grains.velocity(place).into(),
        angular_velocity: grains.angular_velocity(place).into(),
    }
}

/// Forces as the bed has summed them, by number.
pub fn summed(bed: &Bed) -> Vec<Effort> {
    let efforts = (0..bed.grains.len()).map(|number| {
        let [fx, fy, fz, _, tx, ty, tz, _] = bed.forces[place(bed, number)].0;
        [Vec3::new(fx, fy, fz), Vec3::new(tx, ty, tz)]
    });
    efforts.collect()
}

/// Histories as the bed keeps them, by the numbers of the partners; of the walls too.
pub fn kept(bed: &Bed) -> BTreeMap<[u32; 2], Vector<f64>> {
    use crate::neighbours::LANES;
    let count = bed.grains.len() as u32;
    let number = |place: u32| bed.grains.number[place as usize];
    let mut kept = BTreeMap::new();
    for (list, of_walls) in [(&bed.pairs, false), (&bed.walls.list, true)] {
        for pair in 0..list.count {
            let (block, lane) = (pair / LANES, pair % LANES);
            let [a, b] = list.blocks[block].members.map(|end| end[lane]);
            let names = [number(a), if of_walls { count + b } else { number(b) }];
            let [x, y, z] = list.histories[block].0;
            let history = Vector::new(x.0[lane], y.0[lane], z.0[lane]);
            if history == Vector::zeros() {
                continue;
            }
            if names[0] < names[1] {
                kept.insert(names, history);
            } else {
                kept.insert([names[1], names[0]], -history);
            }
        }
    }
    kept
}
