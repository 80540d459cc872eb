//! A suspension in words and numbers.

use super::model::{SuspendingFluid, Suspension};
use crate::scene::{Description, sedimentation};

pub fn describe(scene: &Suspension) -> Description {
    match scene.fluid {
        SuspendingFluid::Column(_) => sedimentation::describe(&scene.as_sedimentation()),
        SuspendingFluid::Sph(_) => Description::default(),
    }
}
