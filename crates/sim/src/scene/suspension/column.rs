//! A suspension in a closed column whose fluid is not solved: it flows back through the grains.

use super::model::Suspension;
use super::run::Settling;
use crate::arrangement::Fault;
use crate::bed::Bed;
use crate::outcome::{Counters, Scalar};
use crate::scene::course::work_of;
use crate::scene::divergence::leapt;
use crate::scene::sedimentation::{limits, start};

pub struct InColumn {
    bed: Bed,
    dt: f64,
    done: u64,
}

impl InColumn {
    /// # Errors
    /// Grains that do not find room.
    pub fn start(scene: &Suspension) -> Result<InColumn, Fault> {
        let scene = scene.as_sedimentation();
        Ok(InColumn {
            bed: start(&scene)?,
            dt: limits(&scene).time_step,
            done: 0,
        })
    }
}

impl Settling for InColumn {
    fn time_step(&self) -> f64 {
        self.dt
    }

    fn patience(&self) -> u64 {
        (2_000_000 / (self.bed.grains.len() as u64 + 1)).clamp(1, 1000)
    }

    fn advance(&mut self, steps: u64) -> Result<(), String> {
        self.done += steps;
        let time = self.done as f64 * self.dt;
        self.bed.advance(steps).map_err(|astray| leapt(&astray, time))
    }

    fn bed(&self) -> &Bed {
        &self.bed
    }

    fn forget_deepest(&mut self) {
        self.bed.deepest = 0.0;
    }

    fn slip(&self, place: usize) -> f64 {
        let grains = &self.bed.grains;
        let [porosity, flow] = grains.seen(place);
        porosity * (flow - grains.velocity(place).z)
    }

    fn scalars(&self) -> Vec<Scalar> {
        Vec::new()
    }

    fn counters(&self) -> Counters {
        work_of(&self.bed)
    }

    fn momentum_gap(&self) -> f64 {
        self.bed.unbalanced_force()
    }
}
