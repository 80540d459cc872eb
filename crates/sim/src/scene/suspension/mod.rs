//! Homogeneous suspensions that settle.

mod model;
mod observables;

pub use model::{Homogeneity, SoftContact, SuspendedClass, SuspendingFluid, Suspension};
pub use observables::observables;

use super::Description;
use super::check::List;
use crate::outcome::{Control, Failure, FailureKind, Outcome};

/// Most classes of grains.
const MOST_CLASSES: usize = 4;

pub(super) fn check(scene: &Suspension, list: &mut List) {
    if !(1..=MOST_CLASSES).contains(&scene.classes.len()) {
        let message = format!("there are {} classes, one to four are known", scene.classes.len());
        list.add(
            "classes",
            message,
            "leave out, or put together, what hardly differs",
        );
    }
}

pub fn describe(scene: &Suspension) -> Description {
    Description {
        grains: scene.grains(),
        ..Description::default()
    }
}

pub fn run(_scene: &Suspension, _control: &Control) -> Result<Outcome, Box<Failure>> {
    Err(Box::new(Failure {
        kind: FailureKind::Stopped,
        reason: "suspensions cannot be run yet".to_owned(),
        partial: Outcome::default(),
    }))
}
