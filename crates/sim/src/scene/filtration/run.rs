//! The run of a filtration scene.

use super::model::Filtration;
use super::start::start;
use super::watch::Watch;
use crate::outcome::{Control, Failure, FailureKind, Outcome};
use crate::scene::Until;
use crate::scene::sedimentation::mover::{Mover, failed, leapt};

/// Rows of the time series in a run, at least and at most.
const ROWS: [f64; 2] = [100.0, 1000.0];
/// Time between two rows [s] where the duration allows for it.
const ROW: f64 = 5e-3;
/// Time between two looks at who comes and who has passed [s].
const ROUND: f64 = 1e-3;

/// Runs the scene to its end.
///
/// # Errors
/// Grains without room at the start, overlaps beyond 5 % of a diameter, a grain that leaps, or a stop
/// from outside.
pub fn run(scene: &Filtration, control: &Control) -> Result<Outcome, Box<Failure>> {
    let refused = |reason: String| Err(failed(FailureKind::Diverged, reason, Outcome::default()));
    let Some(operation) = scene.operation() else {
        return refused("pressure drop, flux and resistance of the medium do not go together".to_owned());
    };
    let bed = match start(scene, &operation) {
        Ok(bed) => bed,
        Err(fault) => return refused(format!("the grains do not find room: {fault}; {}", fault.help())),
    };
    let limits = scene.limits();
    let dt = limits.time_step;
    let steps = (scene.bed.duration / dt).ceil().max(1.0) as u64;
    // No row without a step since the last one.
    let rows = (scene.bed.duration / ROW)
        .ceil()
        .clamp(ROWS[0], ROWS[1])
        .min(steps as f64);
    let round = (ROUND / dt).ceil().max(1.0) as u64;
    let mut watch = Watch::new(scene, bed, operation, &limits);
    watch.look(0);
    let mut motion = Mover::start(scene.bed.integrator, &mut watch.bed);
    let mut done = 0;
    for row in 1..=rows as u64 {
        let target = (row as f64 / rows * steps as f64).round() as u64;
        while done < target {
            let batch = (target - done).min(round);
            watch.part();
            if let Err(astray) = motion.advance(&mut watch.bed, batch) {
                let reason = leapt(&astray, (done + batch) as f64 * dt);
                return Err(failed(FailureKind::Diverged, reason, watch.outcome()));
            }
            done += batch;
            if watch.exchange(done, batch) {
                motion = Mover::start(scene.bed.integrator, &mut watch.bed);
            }
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
        if scene.bed.until == Until::Settled && watch.all_settled() {
            break;
        }
    }
    Ok(watch.outcome())
}
