//! The run of a sedimentation scene.

use super::model::Sedimentation;
use crate::outcome::{Control, Failure, FailureKind, Outcome};

/// Runs the scene to its end.
///
/// # Errors
/// Always: beds of grains cannot be run yet.
pub fn run(_scene: &Sedimentation, _control: &Control) -> Result<Outcome, Box<Failure>> {
    Err(Box::new(Failure {
        kind: FailureKind::Diverged,
        reason: "a sedimentation scene cannot be run yet: it can only be checked and described".to_owned(),
        partial: Outcome::default(),
    }))
}
