//! A scene that starts where an earlier run has ended.

use super::model::{Dimensions, Floor, GrainClass, Placed, Sedimentation, Snapshot};
use crate::bed::Grain;
use crate::contact::Body;
use crate::math::Vec3;
use crate::scene::check::{List, millimetres};

const PATH: &str = "arrangement.snapshot.file";
/// Share of its radius by which a resting grain may reach into a wall [-]: a run ends beyond it.
const DEEPEST: f64 = 0.1;
/// Admitted rounding of a length, relative.
const ROUNDING: f64 = 1e-9;

/// The grains of a checked snapshot, none of them turning.
pub fn grains(scene: &Sedimentation, snapshot: &Snapshot) -> Vec<Grain> {
    let placed = snapshot.grains.iter().flat_map(|grains| grains.iter());
    placed
        .filter_map(|grain| {
            let density = scene.classes.get(grain.class)?.density;
            Some(Grain {
                body: Body::sphere(2.0 * grain.radius, density),
                class: grain.class as u16,
                position: grain.position,
                velocity: grain.velocity,
                angular_velocity: Vec3::zeros(),
            })
        })
        .collect()
}

/// Whether the grains of a snapshot are those of the scene.
pub fn holds(scene: &Sedimentation, snapshot: &Snapshot, list: &mut List) -> bool {
    let (message, help) = match &snapshot.grains {
        Err(reason) => (
            reason.clone(),
            "name the stored table `snapshots` of a sedimentation; a relative path begins at the folder \
             of the study, else at the working directory",
        ),
        Ok(grains) => {
            let found = of_other_classes(scene, grains)
                .map(|message| {
                    (
                        message,
                        "make the classes those of the run that left the snapshot",
                    )
                })
                .or_else(|| {
                    let outside = outside(scene, grains)?;
                    Some((
                        outside,
                        "make the container that of the run that left the snapshot",
                    ))
                });
            match found {
                Some(found) => found,
                None => return true,
            }
        }
    };
    list.add(PATH, message, help);
    false
}

/// Numbers and sizes that differ from those of the classes.
fn of_other_classes(scene: &Sedimentation, grains: &[Placed]) -> Option<String> {
    let classes = scene.classes.len();
    if let Some(grain) = grains.iter().find(|grain| grain.class >= classes) {
        let class = grain.class;
        let noun = if classes == 1 { "class" } else { "classes" };
        return Some(format!(
            "the snapshot has grains of class {class}, counted from 0; the scene has {classes} {noun}"
        ));
    }
    for (class, kind) in scene.classes.iter().enumerate() {
        let members = || grains.iter().filter(|grain| grain.class == class);
        let (number, written) = (members().count(), kind.number);
        if number != written as usize {
            return Some(format!(
                "the snapshot has {number} grains of class {class}, the scene {written}"
            ));
        }
        let (least, most) = (
            kind.diameter * (1.0 - ROUNDING),
            kind.largest() * (1.0 + ROUNDING),
        );
        let other = |grain: &&Placed| !(least..=most).contains(&(2.0 * grain.radius));
        if let Some(grain) = members().find(other) {
            return Some(format!(
                "the snapshot has a grain of class {class} with a diameter of {}, the class has {}",
                millimetres(2.0 * grain.radius),
                diameters(kind)
            ));
        }
    }
    None
}

fn diameters(kind: &GrainClass) -> String {
    let smallest = millimetres(kind.diameter);
    match kind.largest_diameter {
        Some(largest) => format!("{smallest} to {}", millimetres(largest)),
        None => smallest,
    }
}

/// The first grain that lies outside the box.
fn outside(scene: &Sedimentation, grains: &[Placed]) -> Option<String> {
    let container = &scene.container;
    let [along, across] = scene.periodic();
    let between = |value: f64, margin: f64, side: f64| value >= margin && value <= side - margin;
    let inside = |grain: &Placed| {
        let (position, margin) = (grain.position, (1.0 - DEEPEST) * grain.radius);
        let level = match container.floor {
            Floor::Flat => margin,
            Floor::Grains(_) => 0.0,
        };
        let deep = match scene.dimensions {
            Dimensions::Two => position.y.abs() <= ROUNDING * grain.radius,
            Dimensions::Three => across || between(position.y, margin, container.depth),
        };
        let wide = along || between(position.x, margin, container.width);
        wide && deep && position.z >= level && position.z <= container.height
    };
    let number = grains.iter().position(|grain| !inside(grain))?;
    let position = grains[number].position;
    Some(format!(
        "grain {number} of the snapshot lies outside the box: x {}, y {}, z {}",
        millimetres(position.x),
        millimetres(position.y),
        millimetres(position.z)
    ))
}
