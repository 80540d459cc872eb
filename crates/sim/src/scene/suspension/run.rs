//! The run of a suspension, in any fluid.

use super::column::InColumn;
use super::model::{SuspendingFluid, Suspension};
use super::sph::InParticles;
use super::watch::Watch;
use crate::bed::Bed;
use crate::outcome::{Control, Counters, Failure, Outcome, Scalar};
use crate::scene::course::{follow, without_room};
use crate::scene::setup::with_law;

/// Rows of the time series at most.
const MOST_ROWS: f64 = 400.0;

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

    /// What the run spent its time on so far [s], by name.
    fn split_of_time(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }

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
    let settling = start.map_err(|fault| without_room(&fault))?;
    let steps = (scene.duration / settling.time_step() * (1.0 - 1e-12))
        .ceil()
        .max(1.0) as u64;
    let watch = Watch::new(scene, settling);
    follow(watch, scene.duration, steps, MOST_ROWS, control)
}
