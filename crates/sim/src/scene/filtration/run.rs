//! The run of a filtration scene.

use super::model::Filtration;
use super::start::start;
use super::watch::Watch;
use crate::outcome::{Control, Failure, FailureKind, Outcome};
use crate::scene::Until;
use crate::scene::course::{Recorded, failed, follow, without_room};
use crate::scene::divergence::leapt;
use crate::scene::sedimentation::mover::Mover;

/// Rows of the time series at most.
const MOST_ROWS: f64 = 1000.0;
/// Time between two looks at who comes and who has passed [s].
const ROUND: f64 = 1e-3;

/// Runs the scene to its end.
///
/// # Errors
/// Grains without room at the start, overlaps beyond 5 % of a diameter, a grain that leaps, or a stop
/// from outside.
pub fn run(scene: &Filtration, control: &Control) -> Result<Outcome, Box<Failure>> {
    let Some(operation) = scene.operation() else {
        let reason = "pressure drop, flux and resistance of the medium do not go together".to_owned();
        return Err(failed(FailureKind::Diverged, reason, Outcome::default()));
    };
    let bed = start(scene, &operation).map_err(|fault| without_room(&fault))?;
    let limits = scene.limits();
    let dt = limits.time_step;
    let steps = (scene.bed.duration / dt).ceil().max(1.0) as u64;
    let mut watch = Watch::new(scene, bed, operation, &limits);
    let motion = Mover::start(scene.bed.integrator, &mut watch.bed);
    let running = Running {
        round: (ROUND / dt).ceil().max(1.0) as u64,
        dt,
        watch,
        motion,
    };
    follow(running, scene.bed.duration, steps, MOST_ROWS, control)
}

/// A cell at work.
struct Running<'a> {
    watch: Watch<'a>,
    motion: Mover,
    /// Steps between two looks at who comes and who has passed.
    round: u64,
    dt: f64,
}

impl Recorded for Running<'_> {
    fn patience(&self) -> u64 {
        self.round
    }

    fn advance(&mut self, done: u64, steps: u64) -> Result<(), String> {
        let done = done + steps;
        self.watch.part();
        let moved = self.motion.advance(&mut self.watch.bed, steps);
        moved.map_err(|astray| leapt(&astray, done as f64 * self.dt))?;
        if self.watch.exchange(done, steps) {
            self.motion = Mover::start(self.watch.scene.bed.integrator, &mut self.watch.bed);
        }
        Ok(())
    }

    fn look(&mut self, done: u64) {
        self.watch.look(done);
    }

    fn diverged(&self) -> Option<String> {
        self.watch.diverged()
    }

    fn is_over(&self) -> bool {
        self.watch.scene.bed.until == Until::Settled && self.watch.all_settled()
    }

    fn outcome(&mut self) -> Outcome {
        self.watch.outcome()
    }
}
