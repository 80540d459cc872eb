//! What a user should think about before running a sedimentation scene.

use super::describe::bond_number;
use super::model::{Sedimentation, Sides};
use super::step::Limits;
use crate::scene::Description;

/// Adds warnings; `fall` is the time [s] from the top of the box to its floor.
pub fn warnings(scene: &Sedimentation, limits: &Limits, fall: f64, description: &mut Description) {
    let mut warn = |holds: bool, words: String| {
        if holds {
            description.warnings.push(words);
        }
    };
    warn(
        scene.duration < fall && fall.is_finite(),
        format!(
            "the run lasts {}, a grain falls from the top in about {}",
            seconds(scene.duration),
            seconds(fall)
        ),
    );
    warn(
        limits.time_step > limits.longest * (1.0 + 1e-9),
        format!(
            "the time step {:.3e} s is beyond its limit {} of {:.3e} s",
            limits.time_step, limits.name, limits.longest
        ),
    );
    warn(
        limits.overlap > 0.02,
        format!(
            "contacts are soft: impacts overlap by {:.1} % of a diameter",
            100.0 * limits.overlap
        ),
    );
    let bond = bond_number(scene).unwrap_or_default();
    let hang = match (scene.container.sides, scene.cohesion) {
        (Sides::Walls | Sides::PeriodicAlongX, Some(cohesion)) if cohesion.walls => {
            ", and grains may hang on the walls"
        }
        _ => "",
    };
    warn(
        bond > 1.0,
        format!("cohesion is {bond:.1} times the weight of a grain: the bed will be loose{hang}"),
    );
    let lightest = scene
        .present()
        .map(|class| class.density)
        .fold(f64::INFINITY, f64::min);
    warn(
        lightest < scene.fluid.medium().density,
        "some grains are lighter than the fluid: they rise and leave the box at its open top".to_owned(),
    );
    warn(scene.gravity == 0.0, "without gravity nothing settles".to_owned());
    warn(
        scene.threads > 1 && scene.grains() < 20_000,
        "several threads seldom pay below 20000 grains".to_owned(),
    );
}

/// A time with three digits.
fn seconds(time: f64) -> String {
    if (0.01..1e4).contains(&time) {
        format!("{time:.3} s")
    } else {
        format!("{time:.2e} s")
    }
}
