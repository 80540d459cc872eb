//! A suspension in words and numbers.

use super::model::Suspension;
use crate::scene::Description;

pub fn describe(scene: &Suspension) -> Description {
    Description {
        grains: scene.grains(),
        ..Description::default()
    }
}
