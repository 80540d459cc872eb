//! Flat walls: rigid planes that act by the contact laws of the grains.

use crate::contact::{Couple, Meeting, Motion, Touch};
use crate::math::{Vec3, Vector};
use crate::neighbours::{Record, Wide, WideWork};

use super::contacts::{Interaction, add, effort, remember, remembered};
use super::grains::Grains;
use super::pairs::{History, PairList, Standing};

/// A plane that grains stay on one side of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// Unit normal into the room.
    pub normal: Vec3,
    /// Any point of the plane [m].
    pub point: Vec3,
}

impl Wall {
    /// Normal and distance from the origin, as a record of the sweep.
    fn record(&self) -> Record {
        let n = &self.normal;
        Record([n.x, n.y, n.z, n.dot(&self.point), 0.0, 0.0, 0.0, 0.0])
    }
}

/// The walls and the grains near them.
#[derive(Clone, Debug, Default)]
pub struct Walls {
    walls: Vec<Wall>,
    records: Vec<Record>,
    pub list: PairList,
}

impl Walls {
    pub fn new(walls: &[Wall]) -> Self {
        Walls {
            walls: walls.to_vec(),
            records: walls.iter().map(Wall::record).collect(),
            list: PairList::default(),
        }
    }

    /// Normal and distance from the origin.
    pub fn record(&self, wall: usize) -> &Record {
        &self.records[wall]
    }

    /// Height of a grain's lowest point over a wall [m].
    pub fn gap(&self, grains: &Grains, grain: usize, wall: usize) -> f64 {
        let [x, y, z, distance, ..] = self.records[wall].0;
        let position = grains.position(grain);
        x * position.x + y * position.y + z * position.z - distance - grains.radius(grain)
    }

    /// Lists the grains nearer than `reach` [m] to a wall; contacts keep their histories.
    pub fn renew(&mut self, grains: &Grains, reach: f64, memories: &super::pairs::Memories) {
        if self.walls.is_empty() {
            return;
        }
        let mut pairs = Vec::new();
        for grain in 0..grains.moving {
            for wall in 0..self.walls.len() {
                if self.gap(grains, grain, wall) < reach {
                    pairs.push([grain as u32, wall as u32]);
                }
            }
        }
        let standing = |[grain, wall]: [u32; 2]| {
            if self.gap(grains, grain as usize, wall as usize) < 0.0 {
                Standing::Touching
            } else {
                Standing::Apart
            }
        };
        self.list = PairList::new(pairs.into_iter(), standing, [grains.len() as u32, 0]);
        self.list.recall(|places| names(grains, places), memories);
    }

    /// What the contacts with walls remember, to outlive the list.
    pub fn memories(&self, grains: &Grains) -> super::pairs::Memories {
        let count = grains.len() + self.walls.len();
        self.list.memories(|places| names(grains, places), count)
    }
}

/// Walls are named after the last grain.
fn names(grains: &Grains, [grain, wall]: [u32; 2]) -> [u32; 2] {
    [grains.number[grain as usize], grains.len() as u32 + wall]
}

/// Adds the forces of the walls. Returns the greatest overlap over the diameter.
pub struct WallSweep<'a> {
    pub interaction: &'a Interaction,
    pub grains: &'a Grains,
    pub walls: &'a mut Walls,
    pub elapsed: f64,
    pub forces: &'a mut [Record],
}

impl WideWork for WallSweep<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<W: Wide>(self) -> f64 {
        let mut deepest = W::splat(0.0);
        let Walls { records, list, .. } = self.walls;
        let PairList {
            blocks,
            histories,
            live,
            active,
            ..
        } = list;
        let active = blocks[..*active].iter();
        let (zero, one) = (W::splat(0.0), W::splat(1.0));
        for ((block, history), live) in active.zip(histories).zip(live) {
            let [first, second] = &block.members;
            let wall = W::gather(records, second);
            let a = W::gather(&self.grains.motion, first);
            let normal = Vector::new(wall[0], wall[1], wall[2]);
            let position = Vector::new(a[0], a[1], a[2]);
            let height = normal.dot(&position) - wall[3];
            let mut meeting = Meeting::of_sphere_and_wall(a[3], height, normal);
            // What empty lanes point at may lie behind the wall.
            meeting.overlap = W::select(zero.below(a[3]), meeting.overlap, W::splat(f64::NEG_INFINITY));
            let reach = match &self.interaction.attraction {
                Some(attraction) => attraction.reach(),
                None => 0.0,
            };
            if !W::any(W::splat(-reach).below(meeting.overlap)) {
                if *live {
                    *history = History::default();
                    *live = false;
                }
                continue;
            }
            let spin = W::gather(&self.grains.spin, first);
            // Empty lanes have no mass: any will do.
            let mass = one / W::select(zero.below(a[7]), a[7], one);
            let inertia = one / W::select(zero.below(spin[3]), spin[3], one);
            let couple = Couple {
                reduced_mass: mass,
                mean_mass: mass,
                reduced_radius: a[3],
                reduced_inertia: inertia,
                smaller_radius: a[3],
            };
            let grain = Motion {
                position,
                velocity: Vector::new(a[4], a[5], a[6]),
                angular_velocity: Vector::new(spin[0], spin[1], spin[2]),
            };
            let still = Motion {
                position: Vector::zeros(),
                velocity: Vector::zeros(),
                angular_velocity: Vector::zeros(),
            };
            let touches = zero.below(meeting.overlap);
            let touch = Touch::new(&couple, &meeting, [&grain, &still]);
            let interaction = self.interaction;
            let (reaction, displacement) =
                interaction
                    .laws
                    .react(&touch, remembered(history), self.elapsed, interaction.time_step);
            *live = remember(history, touches, displacement);
            let mut force = Vector::select(touches, reaction.force, Vector::zeros());
            let torque = Vector::select(touches, reaction.torques[0], Vector::zeros());
            deepest = deepest.max(W::select(touches, meeting.overlap / (a[3] + a[3]), zero));
            if let Some(attraction) = &interaction.attraction {
                force = force - normal * attraction.to_wall(&meeting, a[3]);
            }
            let efforts = effort(force, torque);
            for (grain, effort) in first.iter().zip(&efforts) {
                add(&mut self.forces[*grain as usize], effort);
            }
        }
        deepest.lanes().into_iter().fold(0.0, f64::max)
    }
}
