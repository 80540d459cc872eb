//! Whether the grains of a scene fit their box.

use super::model::{Arrangement, Dimensions, Sedimentation, Sides};
use super::snapshot;
use crate::scene::check::{List, millimetres};

/// Densest packing of spheres that can be made, and of discs [-].
const DENSEST: [f64; 2] = [0.60, 0.80];
/// Fewest largest diameters across a periodic box: no grain may meet itself.
const FEWEST_ACROSS: f64 = 3.0;

/// Whether the grains fit the box.
pub fn fits(scene: &Sedimentation, list: &mut List) -> bool {
    let container = &scene.container;
    let mut sides = vec![("width", container.width)];
    if scene.dimensions == Dimensions::Three {
        sides.push(("depth", container.depth));
    }
    let across = match container.sides {
        Sides::Walls => 1.0,
        Sides::Periodic => FEWEST_ACROSS,
    };
    let narrow = sides
        .iter()
        .filter(|(name, side)| !wide_enough(scene, name, *side, across, list));
    let mut sound = narrow.count() == 0;
    sound &= wide_enough(scene, "height", container.height, 1.0, list);
    sound && dilute_enough(scene, list) && arranged(scene, list)
}

fn wide_enough(scene: &Sedimentation, name: &str, side: f64, across: f64, list: &mut List) -> bool {
    let largest = scene.largest_diameter();
    let least = across * largest;
    // A box made of whole diameters may be off by rounding.
    if side >= least * (1.0 - 1e-9) {
        return true;
    }
    let (side, diameter) = (millimetres(side), millimetres(largest));
    let message = if across > 1.0 {
        format!("a periodic `{name}` of {side} is below {across} diameters of {diameter}")
    } else {
        format!("a grain of {diameter} does not fit in a `{name}` of {side}")
    };
    let help = format!("make it at least {}, or the grains smaller", millimetres(least));
    list.add(&format!("container.{name}"), message, &help);
    false
}

/// What two and three dimensions fill.
fn filled(dimensions: Dimensions) -> (&'static str, f64) {
    match dimensions {
        Dimensions::Two => ("area", DENSEST[1]),
        Dimensions::Three => ("volume", DENSEST[0]),
    }
}

fn dilute_enough(scene: &Sedimentation, list: &mut List) -> bool {
    let (measure, most) = filled(scene.dimensions);
    let share = scene.filled();
    if share <= most {
        return true;
    }
    let path = if scene.classes.len() == 1 {
        "grains.number"
    } else {
        "classes"
    };
    let message = format!("the grains fill {share:.3} of the {measure} of the box, {most} is the most");
    let help = format!(
        "make the box at least {} high, or take at most {:.0} grains",
        millimetres(rounded_up(scene.container.height * share / most)),
        (scene.grains() as f64 * most / share).floor()
    );
    list.add(path, message, &help);
    false
}

/// A length [m] in whole micrometres.
fn rounded_up(length: f64) -> f64 {
    (1e6 * length).ceil() * 1e-6
}

fn arranged(scene: &Sedimentation, list: &mut List) -> bool {
    match &scene.arrangement {
        Arrangement::Random | Arrangement::Even => true,
        Arrangement::Lattice => on_a_lattice(scene, list),
        Arrangement::Packed { solids_fraction } => packed(scene, *solids_fraction, list),
        Arrangement::Snapshot(snapshot) => snapshot::holds(scene, snapshot, list),
    }
}

fn on_a_lattice(scene: &Sedimentation, list: &mut List) -> bool {
    let container = &scene.container;
    let sites = |side: f64| (side / scene.largest_diameter() * (1.0 + 1e-9)).floor();
    let deep = match scene.dimensions {
        Dimensions::Two => 1.0,
        Dimensions::Three => sites(container.depth),
    };
    let most = sites(container.width) * sites(container.height) * deep;
    let holds = scene.grains() as f64 <= most;
    if !holds {
        let message = format!(
            "a lattice has room for {most} grains in the box, there are {}",
            scene.grains()
        );
        list.add(
            "arrangement",
            message,
            "make the box larger, or write `arrangement: random`",
        );
    }
    holds
}

fn packed(scene: &Sedimentation, solids_fraction: f64, list: &mut List) -> bool {
    let path = "arrangement.packed.solids_fraction";
    let (measure, most) = filled(scene.dimensions);
    if !(solids_fraction > 0.0 && solids_fraction <= most) {
        let message = format!("`solids_fraction` is {solids_fraction}, it must lie between 0 and {most}");
        list.add(path, message, "random packings of equal grains are no denser");
        return false;
    }
    let share = scene.filled();
    if share > solids_fraction {
        let message = format!(
            "the grains fill {share:.3} of the {measure} of the box, the packing only {solids_fraction}"
        );
        list.add(path, message, "make the packing denser, or the box higher");
        return false;
    }
    true
}
