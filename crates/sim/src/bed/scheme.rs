//! Beds under the general schemes of time integration, to compare them.
//!
//! The bed's own kick and drift is velocity Verlet, fused into one pass and with drag integrated
//! exactly. Here any scheme evaluates the same forces, drag among them, as accelerations: slower, and
//! with a step that drag limits.

use std::f64::consts::PI;

use crate::drag::{self, LiftLaw, Magnus, Whirl};
use crate::integrator::{Accelerations, Bodies, Forces, Integrator};
use crate::math::{Vec3, Vector};
use crate::neighbours::Record;

use super::pairs::{History, PairList};
use super::{Astray, Bed, Listing};

/// A scheme with the motion it integrates, by numbers of grains.
pub struct Scheme<I> {
    integrator: I,
    bodies: Bodies,
    memory: Memory,
}

/// What belongs to the last accepted state.
#[derive(Clone, Default)]
struct Memory {
    pairs: (Vec<History>, Vec<bool>),
    walls: (Vec<History>, Vec<bool>),
    /// Positions at which the lists were made, by number [m].
    listed: Vec<Vec3>,
}

impl Memory {
    fn of(bed: &Bed) -> Memory {
        let kept = |list: &PairList| (list.histories.clone(), list.live.clone());
        Memory {
            pairs: kept(&bed.pairs),
            walls: kept(&bed.walls.list),
            listed: Vec::new(),
        }
    }

    fn keep(&mut self, bed: &Bed) {
        for (kept, list) in [(&mut self.pairs, &bed.pairs), (&mut self.walls, &bed.walls.list)] {
            kept.0.clone_from(&list.histories);
            kept.1.clone_from(&list.live);
        }
    }

    fn restore(&self, bed: &mut Bed) {
        for (kept, list) in [(&self.pairs, &mut bed.pairs), (&self.walls, &mut bed.walls.list)] {
            list.histories.copy_from_slice(&kept.0);
            list.live.copy_from_slice(&kept.1);
        }
    }
}

impl<I: Integrator> Scheme<I> {
    /// Begins where the bed is.
    pub fn start(bed: &mut Bed) -> Self {
        bed.join_lists();
        let bodies = bodies(bed);
        let mut memory = Memory::of(bed);
        memory.listed.clone_from(&bodies.position);
        let integrator = I::start(
            &bodies,
            &mut Evaluation {
                bed,
                memory: &mut memory,
            },
        );
        Scheme {
            integrator,
            bodies,
            memory,
        }
    }

    /// Advances the bed by `steps` time steps.
    ///
    /// # Errors
    /// A grain whose way in one step is longer than half the smallest diameter, or no number.
    pub fn advance(&mut self, bed: &mut Bed, steps: u64) -> Result<(), Astray> {
        let dt = bed.interaction.time_step;
        let limit = bed.speed_limit();
        for _ in 0..steps {
            let mut forces = Evaluation {
                bed,
                memory: &mut self.memory,
            };
            self.integrator.step(&mut self.bodies, &mut forces, dt);
            place(bed, &self.bodies);
            bed.work.steps += 1;
            let fastest = self
                .bodies
                .velocity
                .iter()
                .map(Vec3::norm)
                .fold(0.0, |most: f64, speed| {
                    // What is no number must not get lost.
                    if speed <= most { most } else { speed }
                });
            if !(fastest < limit || self.bodies.velocity.is_empty()) {
                return Err(bed.astray(limit));
            }
            self.follow(bed, fastest, dt);
        }
        Ok(())
    }

    /// Lists and porosities follow the motion.
    fn follow(&mut self, bed: &mut Bed, fastest: f64, dt: f64) {
        let moved = |(now, then): (&Vec3, &Vec3)| (now - then).norm();
        let way = self
            .bodies
            .position
            .iter()
            .zip(&self.memory.listed)
            .map(moved)
            .fold(0.0, f64::max);
        let every_step = matches!(bed.listing, Listing::EveryStep(_));
        // Stages lie up to a step ahead: half the slack is theirs.
        if every_step || way > 0.5 * bed.slack {
            bed.renew_lists(fastest);
            self.memory.keep(bed);
            self.memory.listed.clone_from(&self.bodies.position);
        }
        if let Some(porosity) = &mut bed.porosity {
            porosity.follow(&mut bed.grains, &bed.surroundings, fastest * dt, dt);
        }
    }
}

/// Motion of the moving grains by number.
fn bodies(bed: &Bed) -> Bodies {
    let grains = &bed.grains;
    let mut bodies = Bodies {
        position: vec![Vec3::zeros(); grains.moving],
        velocity: vec![Vec3::zeros(); grains.moving],
        angular_velocity: vec![Vec3::zeros(); grains.moving],
    };
    for grain in 0..grains.moving {
        let number = grains.number[grain] as usize;
        bodies.position[number] = grains.position(grain);
        bodies.velocity[number] = grains.velocity(grain);
        bodies.angular_velocity[number] = grains.angular_velocity(grain);
    }
    bodies
}

/// Writes the motion into the bed.
fn place(bed: &mut Bed, bodies: &Bodies) {
    let grains = &mut bed.grains;
    for grain in 0..grains.moving {
        let number = grains.number[grain] as usize;
        let (x, v, w) = (
            bodies.position[number],
            bodies.velocity[number],
            bodies.angular_velocity[number],
        );
        grains.motion[grain].0[..3].copy_from_slice(x.as_slice());
        grains.motion[grain].0[4..7].copy_from_slice(v.as_slice());
        grains.spin[grain].0[..3].copy_from_slice(w.as_slice());
    }
}

struct Evaluation<'a> {
    bed: &'a mut Bed,
    memory: &'a mut Memory,
}

impl Forces for Evaluation<'_> {
    fn evaluate(&mut self, bodies: &Bodies, elapsed: f64, accelerations: &mut Accelerations) {
        let bed = &mut *self.bed;
        place(bed, bodies);
        self.memory.restore(bed);
        bed.forces.fill(Record::default());
        bed.sum_forces(elapsed);
        for grain in 0..bed.grains.moving {
            let number = bed.grains.number[grain] as usize;
            let force = bed.forces[grain].0;
            let turning = Vec3::new(force[4], force[5], force[6]) / bed.grains.inertia(grain);
            accelerations.linear[number] = acceleration(bed, grain);
            accelerations.angular[number] = turning;
        }
    }

    fn accept(&mut self) {
        self.memory.keep(self.bed);
    }
}

/// Contacts, gravity, buoyancy and drag [m/s²].
fn acceleration(bed: &Bed, grain: usize) -> Vec3 {
    let (grains, surroundings) = (&bed.grains, &bed.surroundings);
    let radius = grains.radius(grain);
    let [.., porosity, flow, neighbours, _] = grains.spin[grain].0;
    let displaced = 4.0 / 3.0 * PI * radius.powi(3) * surroundings.fluid_density;
    let force = bed.forces[grain].0;
    let mut force = Vec3::new(
        force[0],
        force[1],
        force[2] + displaced * surroundings.gravity + neighbours,
    );
    let slip = Vec3::new(0.0, 0.0, flow) - grains.velocity(grain);
    let fluid = [surroundings.fluid_density, surroundings.viscosity];
    if surroundings.lift {
        let whirl = Whirl {
            slip: slip.into(),
            vorticity: Vector::zeros(),
            spin: grains.angular_velocity(grain).into(),
        };
        force += Vec3::from(Magnus.force(fluid, 2.0 * radius, &whirl));
    }
    if let Some(law) = &surroundings.drag {
        force += slip * drag::coefficient(law, fluid, 2.0 * radius, porosity * slip.norm(), porosity);
    }
    force / grains.mass(grain) - Vec3::new(0.0, 0.0, surroundings.gravity)
}
