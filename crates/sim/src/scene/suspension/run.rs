//! The run of a suspension, in any fluid.

use super::column::InColumn;
use super::model::{SuspendingFluid, Suspension};
use super::sph::InParticles;
use super::watch::Watch;
use crate::bed::Bed;
use crate::outcome::{Control, Counters, Failure, FailureKind, Outcome, Scalar};
use crate::scene::divergence::diverged;
use crate::scene::setup::with_law;

/// Rows of the time series, at least and at most in a run.
const ROWS: [f64; 2] = [100.0, 400.0];
/// Time between two rows [s] where the duration allows for it.
const ROW: f64 = 5e-3;

/// Grains on their way through a fluid.
pub trait Settling {
    /// Step [s].
    fn time_step(&self) -> f64;

    /// Steps between two questions whether to stop.
    fn patience(&self) -> u64;

    /// Goes on by so many steps.
    ///
    /// # Errors
    /// Why the state can no longer be trusted.
    fn advance(&mut self, steps: u64) -> Result<(), String>;

    fn bed(&self) -> &Bed;

    /// Forgets the deepest overlap so far.
    fn forget_deepest(&mut self);

    /// Superficial slip of the grain at a place [m/s], upward positive.
    fn slip(&self, place: usize) -> f64;

    /// What only this fluid has to say.
    fn scalars(&self) -> Vec<Scalar>;

    fn counters(&self) -> Counters;

    /// Largest rate of momentum that was not closed so far [N].
    fn momentum_gap(&self) -> f64;
}

/// Runs the scene to its end.
///
/// # Errors
/// Grains without room, overlaps beyond 5 % of a diameter, a grain that leaps, a fluid that diverges, or a
/// stop from outside.
pub fn run(scene: &Suspension, control: &Control) -> Result<Outcome, Box<Failure>> {
    match &scene.fluid {
        SuspendingFluid::Column(_) => settle(scene, InColumn::start(scene), control),
        SuspendingFluid::Sph(sph) => {
            with_law!(scene.drag, law => settle(scene, InParticles::start(scene, sph, law), control))
        }
    }
}

fn settle<S: Settling>(
    scene: &Suspension,
    start: Result<S, crate::arrangement::Fault>,
    control: &Control,
) -> Result<Outcome, Box<Failure>> {
    let settling = start.map_err(|fault| {
        let reason = format!("the grains do not find room: {fault}; {}", fault.help());
        failed(FailureKind::Diverged, reason, Outcome::default())
    })?;
    let dt = settling.time_step();
    let steps = (scene.duration / dt * (1.0 - 1e-12)).ceil().max(1.0) as u64;
    // No row without a step since the last one.
    let rows = (scene.duration / ROW)
        .ceil()
        .clamp(ROWS[0], ROWS[1])
        .min(steps as f64);
    let mut watch = Watch::new(scene, settling);
    watch.look(0);
    let mut done = 0;
    for row in 1..=rows as u64 {
        let target = (row as f64 / rows * steps as f64).round() as u64;
        while done < target {
            let batch = (target - done).min(watch.settling.patience());
            if let Err(reason) = watch.settling.advance(batch) {
                return Err(failed(FailureKind::Diverged, reason, watch.outcome()));
            }
            done += batch;
            if (control.stop)() {
                let reason = "stopped from outside".to_owned();
                return Err(failed(FailureKind::Stopped, reason, watch.outcome()));
            }
        }
        watch.look(done);
        if let Some(reason) = watch.diverged() {
            return Err(failed(FailureKind::Diverged, reason, watch.outcome()));
        }
        (control.progress)(row as f64 / rows);
    }
    Ok(watch.outcome())
}

impl<S: Settling> Watch<'_, S> {
    /// Why the run makes no sense any more.
    fn diverged(&self) -> Option<String> {
        let last = self.rows.last()?;
        // Nothing can move faster than the fall through the whole column makes it.
        let most = 2.0 * self.load * self.scene.column.height;
        diverged(self.settling.bed(), last.deepest, most, last.time)
    }
}

fn failed(kind: FailureKind, reason: String, partial: Outcome) -> Box<Failure> {
    Box::new(Failure {
        kind,
        reason,
        partial,
    })
}
