//! What of a suspension cannot be simulated.

use super::model::{SuspendingFluid, Suspension};
use super::particles::Particles;
use crate::scene::check::{self, List, millimetres, particle_fluid, threads_and_snapshots};
use crate::scene::sedimentation::{class_path, limits, time_step};
use crate::scene::{CouplingLengths, Drag, Scheme, SphFluid};

/// Least porosity that grains are spread evenly at [-].
const LEAST_POROSITY: f64 = 0.6;
/// Fewest largest diameters across the column: no grain may meet itself.
const FEWEST_ACROSS: f64 = 3.0;
/// Support of the exchange kernel with the skin of its lists, over its length [-].
const SUPPORT: f64 = 2.25;

pub fn check(scene: &Suspension, list: &mut List) {
    let mut sound = classes(scene, list);
    sound &= column(scene, list);
    sound &= contact(scene, list);
    sound &= switches(scene, list);
    sound &= sound && wide_enough(scene, list) && numbers(scene, list);
    if let (true, SuspendingFluid::Sph(fluid)) = (sound, &scene.fluid) {
        sound &= particle_fluid(fluid, scene.smallest_diameter(), &scene.column, list);
        sound &= scheme(fluid, list);
        sound = sound && kernels_fit(scene, fluid, list);
        if sound {
            fluid_step(scene, fluid, list);
        }
    }
    if sound {
        let bed = scene.as_sedimentation();
        time_step(&bed, &limits(&bed), list);
    }
}

fn classes(scene: &Suspension, list: &mut List) -> bool {
    let count = scene.classes.len();
    let mut sound = check::classes(&scene.classes, list);
    for (index, class) in scene.classes.iter().enumerate() {
        let path = |name: &str| format!("{}.{name}", class_path(count, index));
        let fluid = scene.fluid.medium().density;
        if class.density < fluid {
            let message = format!(
                "grains of {} kg/m³ float in a fluid of {fluid} kg/m³",
                class.density
            );
            list.add(
                &path("density"),
                message,
                "make them as heavy as the fluid or heavier",
            );
            sound = false;
        }
    }
    sound
}

fn column(scene: &Suspension, list: &mut List) -> bool {
    let model = match scene.fluid {
        SuspendingFluid::Column(_) => "column",
        SuspendingFluid::Sph(_) => "sph",
    };
    let medium = scene.fluid.medium();
    let mut sound = list.positive("column.width", scene.column.width);
    sound &= list.positive("column.height", scene.column.height);
    sound &= list.positive(&format!("fluid.{model}.density"), medium.density);
    sound &= list.positive(&format!("fluid.{model}.viscosity"), medium.viscosity);
    sound &= list.positive("gravity", scene.gravity);
    // The least porosity itself can be had.
    let low = LEAST_POROSITY * (1.0 - 1e-12);
    if !(scene.porosity >= low && scene.porosity < 1.0) {
        let message = format!(
            "`porosity` is {}, it must be {LEAST_POROSITY} or above, and below 1",
            scene.porosity
        );
        let help = "denser suspensions are packings: take a `sedimentation` with `arrangement: packed`";
        list.add("porosity", message, help);
        sound = false;
    }
    sound
}

fn contact(scene: &Suspension, list: &mut List) -> bool {
    let contact = &scene.contact;
    let given = [("stiffness", contact.stiffness), ("friction", contact.friction)];
    let mut sound = true;
    for (name, value) in given {
        if let Some(value) = value {
            sound &= list.positive(&format!("contact.{name}"), value);
        }
    }
    if !(contact.restitution > 0.0 && contact.restitution <= 1.0) {
        let message = format!(
            "`restitution` is {}, it must lie above 0 and be 1 at most",
            contact.restitution
        );
        list.add(
            "contact.restitution",
            message,
            "1 loses nothing, small values nearly all",
        );
        sound = false;
    }
    sound
}

fn switches(scene: &Suspension, list: &mut List) -> bool {
    let mut sound = list.positive("duration", scene.duration);
    sound &= list.positive("steps_per_contact", scene.steps_per_contact);
    if let Some(step) = scene.time_step {
        sound &= list.positive("time_step", step);
    }
    sound & threads_and_snapshots(scene.threads, scene.snapshots, list)
}

fn wide_enough(scene: &Suspension, list: &mut List) -> bool {
    let largest = scene.largest_diameter();
    let sides = [
        ("width", scene.column.width, FEWEST_ACROSS),
        ("height", scene.column.height, 1.0),
    ];
    let mut sound = true;
    for (name, side, across) in sides {
        let least = across * largest;
        if side < least * (1.0 - 1e-9) {
            let message = format!(
                "`{name}` {} is below {across} diameters of {}",
                millimetres(side),
                millimetres(largest)
            );
            let help = format!("make it at least {}, or the grains smaller", millimetres(least));
            list.add(&format!("column.{name}"), message, &help);
            sound = false;
        }
    }
    sound
}

/// Whether no kernel meets its own image across the periodic sides.
fn kernels_fit(scene: &Suspension, fluid: &SphFluid, list: &mut List) -> bool {
    let particles = Particles { scene, sph: fluid };
    let support = SUPPORT * particles.exchange_length(scene.largest_diameter());
    let width = scene.column.width;
    let fits = width >= support;
    if !fits {
        let message = format!(
            "`width` {} is below the {} over which a grain hands its drag to the fluid",
            millimetres(width),
            millimetres((support * 1e5).ceil() * 1e-5)
        );
        let help = "make the column wider, the grains smaller, or the suspension denser";
        list.add("column.width", message, help);
    }
    fits
}

/// Grains there are, and those of them that make the interface.
fn numbers(scene: &Suspension, list: &mut List) -> bool {
    let numbers = scene.numbers();
    let count = scene.grains();
    if numbers.contains(&0) || count > u64::from(u32::MAX) {
        let message = format!("the column holds {count} grains, {numbers:?} of the classes");
        let help =
            "every class needs a grain, and four billion are the most: change the column or `porosity`";
        list.add("column", message, help);
        return false;
    }
    let top = scene.top_grains.unwrap_or(1);
    let holds = (1..=count).contains(&u64::from(top));
    if !holds {
        let message = format!("`top_grains` is {top}, the column holds {count} grains");
        list.add(
            "top_grains",
            message,
            "the interface is the mean of the highest grains",
        );
    }
    holds
        && match (&scene.fluid, scene.drag) {
            (SuspendingFluid::Column(_), Drag::BeetstraCello) => sauter(scene, list),
            _ => true,
        }
}

/// A column that is not solved knows no mean size of the grains around a grain.
fn sauter(scene: &Suspension, list: &mut List) -> bool {
    let mixed = scene.largest_diameter() > scene.smallest_diameter();
    if mixed {
        let message = "`beetstra_cello` among several sizes needs an `sph` fluid".to_owned();
        let help = "take `fluid: sph`, or a drag law in which the sizes of the neighbours have no say";
        list.add("drag", message, help);
    }
    !mixed
}

/// Refuses a fluid step beyond the longest safe one.
fn fluid_step(scene: &Suspension, fluid: &SphFluid, list: &mut List) {
    let (limit, name) = Particles { scene, sph: fluid }.step_limit();
    match fluid.scheme.time_step {
        Some(step) if step > limit && !fluid.scheme.unsafe_time_step => {
            let message = format!("`time_step` is {step:.3e} s, its limit {name} is {limit:.3e} s");
            let help = "stay below the limit, leave it to `automatic`, or set `unsafe_time_step: true`";
            list.add("fluid.sph.scheme.time_step", message, help);
        }
        _ => {}
    }
}

/// What the scene says itself must not be said in the scheme.
fn scheme(fluid: &SphFluid, list: &mut List) -> bool {
    let usual = Scheme::for_random_grains();
    let mut sound = true;
    let mut refuse = |name: &str, given: bool, help: &str| {
        if given {
            let message = format!("the `{name}` of the contacts is that of the scene, not of the fluid");
            list.add(&format!("fluid.sph.scheme.{name}"), message, help);
            sound = false;
        }
    };
    refuse(
        "stiffness",
        fluid.scheme.stiffness.is_some(),
        "write `contact: {stiffness: …}`",
    );
    refuse(
        "steps_per_contact",
        fluid.scheme.steps_per_contact != usual.steps_per_contact,
        "write `steps_per_contact` beside `contact`",
    );
    let lengths = fluid.scheme.coupling_lengths;
    if let CouplingLengths::DoubleSmoothing | CouplingLengths::DoubleSmoothingLiteral = lengths {
        let message = "double smoothing is known of porosity blocks only".to_owned();
        let help = "write `coupling_lengths: per_class`";
        list.add("fluid.sph.scheme.coupling_lengths", message, help);
        sound = false;
    }
    sound
}
