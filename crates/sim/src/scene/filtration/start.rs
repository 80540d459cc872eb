//! The bed a scene starts from.

use super::model::{Feed, Filtration};
use super::operation::Operation;
use crate::arrangement::Fault;
use crate::bed::{Bed, Grains, Stream, Wall};
use crate::math::Vec3;
use crate::scene::sedimentation::floor::{floor_grains, walls};
use crate::scene::sedimentation::start::{interaction, listing, moving_grains, slices, surroundings};
use crate::scene::sedimentation::step::{Drive, Limits, limits_under};

/// Greatest velocity of a stream over its mean [-].
const PEAK: f64 = 1.5;

impl Filtration {
    /// The flow over the medium.
    pub fn stream(&self) -> Option<Stream> {
        self.crossflow.map(|crossflow| Stream {
            mean: crossflow.mean_velocity,
            bottom: self.bed.floor_top(),
            height: self.bed.container.height,
        })
    }

    /// What the flow does to the grains beside their weight.
    pub fn drive(&self) -> Drive {
        let Some(operation) = self.operation() else {
            return Drive::default();
        };
        let along = self.crossflow.map_or(0.0, |flow| PEAK * flow.mean_velocity);
        let (_, cake) = self.expected_cake();
        let (flux, _) = self.filtrate.with_cake(&operation, self.viscosity(), cake);
        Drive {
            speed: operation.flux + along.abs(),
            // What of the pressure drop falls off in the cake is carried by its grains.
            force: self.viscosity() * flux * cake * self.area(),
        }
    }

    /// Contact times and the time step.
    pub fn limits(&self) -> Limits {
        limits_under(&self.bed, &self.drive())
    }
}

/// The cell with the grains that are there at the start.
///
/// # Errors
/// Grains that do not find room.
pub fn start(scene: &Filtration, operation: &Operation) -> Result<Bed, Fault> {
    let bed = &scene.bed;
    let moving = match scene.feed {
        Feed::AtStart => moving_grains(bed)?,
        Feed::Rate { .. } | Feed::Suspension { .. } => Vec::new(),
    };
    let mut surroundings = surroundings(bed);
    surroundings.stream = scene.stream();
    surroundings.shear_lift = scene.crossflow.is_some_and(|flow| flow.shear_lift);
    // Slices reach down to where grains leave, with a plane at z = 0.
    let below = (-bed.floor_bottom() / bed.largest_diameter()).ceil();
    let mut porosity = slices(bed).from_height(-below * bed.largest_diameter());
    porosity.draw(operation.flux);
    let mut walls = walls(bed);
    if scene.crossflow.is_some() {
        walls.push(Wall {
            normal: -Vec3::z(),
            point: Vec3::new(0.0, 0.0, scene.top()),
        });
    }
    let grains = Grains::new(&moving, &floor_grains(bed));
    let interaction = interaction(bed, scene.limits().time_step);
    let started = Bed::new(
        grains,
        &walls,
        interaction,
        surroundings,
        listing(bed),
        Some(porosity),
    )
    .with_threads(bed.threads as usize);
    Ok(if bed.sleeping {
        started.with_sleeping()
    } else {
        started
    })
}
