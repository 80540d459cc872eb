//! What of a sedimentation scene cannot be simulated.

use super::model::{Detection, Dimensions, Floor, GrainClass, Sedimentation, SlicePorosity, StillFluid};
use super::room::fits;
use super::step::{FEWEST_STEPS, Limits, limits, overdamped};
use crate::contact::EffectiveMass;
use crate::scene::Normal;
use crate::scene::check::{List, millimetres, threads_and_snapshots};
use crate::scene::collision::check_laws;

/// Every class meets every other one when the step is picked.
const MOST_CLASSES: usize = 64;

pub fn check(scene: &Sedimentation, list: &mut List) {
    let mut sound = classes(scene, list);
    sound &= container(scene, list);
    sound &= check_laws(&scene.normal, &scene.tangential, &scene.rolling, list);
    sound &= forces(scene, list);
    sound &= switches(scene, list);
    if sound && fits(scene, list) && parts(scene, list) {
        time_step(scene, list);
    }
}

/// Path of a class: a scene with one of them calls it `grains`.
pub fn class_path(classes: usize, index: usize) -> String {
    if classes == 1 {
        "grains".to_owned()
    } else {
        format!("classes.{index}")
    }
}

fn classes(scene: &Sedimentation, list: &mut List) -> bool {
    if scene.classes.is_empty() {
        let help = "give one at least; `number: 0` leaves the box empty";
        list.add("classes", "there is no class of grains".to_owned(), help);
    }
    if scene.classes.len() > MOST_CLASSES {
        let message = format!(
            "there are {} classes, {MOST_CLASSES} is the most",
            scene.classes.len()
        );
        list.add(
            "classes",
            message,
            "`largest_diameter` spreads sizes within a class",
        );
    }
    let mut sound = (1..=MOST_CLASSES).contains(&scene.classes.len());
    for (index, class) in scene.classes.iter().enumerate() {
        sound &= one_class(&class_path(scene.classes.len(), index), class, list);
    }
    sound
}

fn one_class(path: &str, class: &GrainClass, list: &mut List) -> bool {
    let mut sound = list.positive(&format!("{path}.diameter"), class.diameter);
    sound &= list.positive(&format!("{path}.density"), class.density);
    let Some(largest) = class.largest_diameter else {
        return sound;
    };
    let field = format!("{path}.largest_diameter");
    sound &= list.positive(&field, largest);
    if sound && largest < class.diameter {
        let message = format!(
            "`largest_diameter` is {}, below the `diameter` {}",
            millimetres(largest),
            millimetres(class.diameter)
        );
        list.add(&field, message, "`diameter` is the smallest of the class");
        sound = false;
    }
    sound
}

fn container(scene: &Sedimentation, list: &mut List) -> bool {
    let container = &scene.container;
    let mut sound = list.positive("container.width", container.width);
    sound &= list.positive("container.height", container.height);
    if scene.dimensions == Dimensions::Three {
        sound &= list.positive("container.depth", container.depth);
    }
    if let Floor::Grains { diameter } = container.floor {
        sound &= list.positive("container.floor.grains.diameter", diameter);
        if scene.dimensions == Dimensions::Three {
            let message = "a floor of grains is known in two dimensions only".to_owned();
            list.add("container.floor", message, "write `floor: flat`");
            sound = false;
        }
    }
    sound
}

/// Whether there is a weight that a cut-off can be a share of.
fn weighs(scene: &Sedimentation, path: &str, list: &mut List) -> bool {
    let weightless = scene.gravity == 0.0;
    if weightless {
        let message = "without gravity the attraction is never cut off".to_owned();
        let help = "give `gravity`, however little: `cut_off` is a share of the weight";
        list.add(path, message, help);
    }
    !weightless
}

/// Cohesion, charge, fluid and gravity.
fn forces(scene: &Sedimentation, list: &mut List) -> bool {
    let mut sound = true;
    if let Some(cohesion) = &scene.cohesion {
        let path = |name: &str| format!("cohesion.van_der_waals.{name}");
        sound &= list.positive(&path("hamaker"), cohesion.hamaker);
        sound &= list.positive(&path("smallest_gap"), cohesion.smallest_gap);
        sound &= list.positive(&path("cut_off"), cohesion.cut_off);
        sound &= weighs(scene, &path("cut_off"), list);
    }
    if let Some(charge) = &scene.charge {
        let path = |name: &str| format!("charge.coulomb.{name}");
        sound &= list.finite(&path("charge"), charge.charge);
        sound &= list.positive(&path("relative_permittivity"), charge.relative_permittivity);
        sound &= list.positive(&path("cut_off"), charge.cut_off);
        sound &= weighs(scene, &path("cut_off"), list);
    }
    let (name, medium) = match &scene.fluid {
        StillFluid::Still(medium) => ("still", medium),
        StillFluid::Column(medium) => ("column", medium),
    };
    sound &= list.positive(&format!("fluid.{name}.density"), medium.density);
    sound &= list.positive(&format!("fluid.{name}.viscosity"), medium.viscosity);
    sound & list.not_negative("gravity", scene.gravity)
}

/// Everything that says how the run goes.
fn switches(scene: &Sedimentation, list: &mut List) -> bool {
    let mut sound = list.positive("duration", scene.duration);
    sound &= list.positive("steps_per_contact", scene.steps_per_contact);
    if let Some(step) = scene.time_step {
        sound &= list.positive("time_step", step);
    }
    if let Detection::List { skin: Some(skin) } = scene.detection {
        sound &= list.positive("detection.list.skin", skin);
    }
    if !(scene.central_slice > 0.0 && scene.central_slice <= 1.0) {
        let message = format!(
            "`central_slice` is {}, it must lie above 0 and be 1 at most",
            scene.central_slice
        );
        list.add("central_slice", message, "1 takes the whole bed");
        sound = false;
    }
    sound &= threads_and_snapshots(scene.threads, scene.snapshots, list);
    if scene.porosity == SlicePorosity::Areas && scene.dimensions == Dimensions::Three {
        let message = "`areas` is known in two dimensions only".to_owned();
        list.add(
            "porosity",
            message,
            "write `exact` or `centre`, or `dimensions: 2`",
        );
        sound = false;
    }
    sound
}

/// An overdamped contact never ends.
fn parts(scene: &Sedimentation, list: &mut List) -> bool {
    let holds = !overdamped(scene);
    if !holds {
        let arithmetic = matches!(
            scene.normal,
            Normal::LinearSpringDashpot {
                effective_mass: EffectiveMass::Arithmetic,
                ..
            }
        );
        let (path, message) = if arithmetic {
            let message = "with the arithmetic mass some contacts are overdamped and never end";
            ("normal.linear_spring_dashpot.effective_mass", message)
        } else {
            ("normal", "some contacts never end")
        };
        list.add(
            path,
            message.to_owned(),
            "raise `restitution`, or take the reduced mass",
        );
    }
    holds
}

/// Refuses a step beyond the longest safe one.
pub fn time_step(scene: &Sedimentation, list: &mut List) {
    if scene.unsafe_time_step {
        return;
    }
    let limits = limits(scene);
    match scene.time_step {
        // A step exactly at the limit is meant to be safe.
        Some(step) if step > limits.longest * (1.0 + 1e-9) => {
            let Limits { longest, name, .. } = limits;
            let message = format!("the time step is {step:.3e} s, its limit {name} is {longest:.3e} s");
            let help = "stay below the limit, leave it to `automatic`, or set `unsafe_time_step: true`";
            list.add("time_step", message, help);
        }
        // The picked step gives way to every other limit.
        None if scene.steps_per_contact < FEWEST_STEPS => {
            let message = format!(
                "`steps_per_contact` is {}, a contact needs {FEWEST_STEPS}",
                scene.steps_per_contact
            );
            let help = "write 20 or more, or set `unsafe_time_step: true`";
            list.add("steps_per_contact", message, help);
        }
        _ => {}
    }
}
