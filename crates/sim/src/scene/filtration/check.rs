//! What of a filtration scene cannot be simulated.

use super::model::{Crossflow, Feed, Filtrate, Filtration};
use crate::scene::check::{List, millimetres};
use crate::scene::sedimentation::check::{check_parts, time_step};
use crate::scene::{Arrangement, GrainDrag, StillFluid};

/// Densest suspension that flows [-]: grains are fed at random.
const DENSEST: f64 = 0.3;

pub fn check(scene: &Filtration, list: &mut List) {
    let mut own = List::default();
    let mut sound = check_parts(&scene.bed, &mut own);
    list.take(own, |path| path_of(scene, path));
    sound &= filtrate(&scene.filtrate, list);
    sound &= crossflow(scene, list);
    // Diameters and the height must make sense first.
    if sound && feed(scene, list) {
        let mut own = List::default();
        time_step(&scene.bed, &scene.limits(), &mut own);
        list.take(own, |path| path);
    }
}

/// The fluid of the bed has a name of its own here.
fn path_of(scene: &Filtration, path: String) -> String {
    let name = match scene.bed.fluid {
        StillFluid::Still(_) => "fluid.still",
        StillFluid::Column(_) => "fluid.column",
    };
    let own = match scene.crossflow {
        None => "fluid.uniform",
        Some(_) => "fluid.parabolic",
    };
    path.strip_prefix(name)
        .map_or(path.clone(), |rest| format!("{own}{rest}"))
}

fn filtrate(filtrate: &Filtrate, list: &mut List) -> bool {
    let given = [
        ("pressure_drop", filtrate.pressure_drop),
        ("initial_flux", filtrate.initial_flux),
        ("medium_resistance", filtrate.medium_resistance),
    ];
    let mut sound = true;
    let mut count = 0;
    for (name, value) in given {
        if let Some(value) = value {
            count += 1;
            sound &= list.positive(&format!("filtrate.{name}"), value);
        }
    }
    if count != 2 {
        let message = format!(
            "the pressure drop is the flux times viscosity and resistance of the medium: {count} of the three are \
             given, 2 are needed"
        );
        let help = "give two of `pressure_drop`, `initial_flux` and `medium_resistance`";
        list.add("filtrate", message, help);
        sound = false;
    }
    sound
}

fn crossflow(scene: &Filtration, list: &mut List) -> bool {
    let Some(Crossflow { mean_velocity, .. }) = scene.crossflow else {
        return true;
    };
    let sound = list.finite("fluid.parabolic.mean_velocity", mean_velocity);
    let [along, _] = scene.bed.periodic();
    if !along {
        let message = "the flow across carries grains along x, and the cell ends there".to_owned();
        let help =
            "write `sides: periodic_along_x`, or `periodic`: what leaves at one end comes in at the other";
        list.add("container.sides", message, help);
    }
    sound && along
}

fn feed(scene: &Filtration, list: &mut List) -> bool {
    let drags = scene.bed.drag != GrainDrag::None;
    let (kind, layers, mut sound) = match scene.feed {
        Feed::AtStart => return true,
        Feed::Rate { rate, layers } => ("rate", layers, list.positive("feed.rate.rate", rate)),
        Feed::Suspension {
            solids_fraction,
            settling,
            layers,
        } => {
            let mut sound = dilute(solids_fraction, list);
            if settling && !drags {
                let message = "without drag grains have no settling speed to come with".to_owned();
                list.add(
                    "feed.suspension.settling",
                    message,
                    "give a drag law, or leave it off",
                );
                sound = false;
            }
            ("suspension", layers, sound)
        }
    };
    if scene.bed.arrangement != Arrangement::Random {
        let message = "grains that are fed are not arranged: their places are drawn as they come".to_owned();
        list.add("arrangement", message, "leave it out, or write `feed: at_start`");
        sound = false;
    }
    zone(scene, &format!("feed.{kind}.layers"), layers, list) && sound
}

fn dilute(solids_fraction: f64, list: &mut List) -> bool {
    let path = "feed.suspension.solids_fraction";
    let sound = solids_fraction > 0.0 && solids_fraction <= DENSEST;
    if !sound {
        let message =
            format!("`solids_fraction` is {solids_fraction}, it must lie above 0 and be {DENSEST} at most");
        list.add(path, message, "denser suspensions do not flow in grain by grain");
    }
    sound
}

/// Grains must fit into the zone they are fed into, and that into the cell.
fn zone(scene: &Filtration, path: &str, layers: f64, list: &mut List) -> bool {
    if !list.positive(path, layers) {
        return false;
    }
    let (largest, height) = (scene.bed.largest_diameter(), scene.bed.container.height);
    if layers < 1.0 {
        let message = format!("a zone {layers} diameters high has no room for a grain: none can ever be fed");
        list.add(path, message, "write 1 or more");
        return false;
    }
    let zone = layers * largest;
    if zone > height * (1.0 + 1e-9) {
        let message = format!(
            "grains are fed into a zone {} high, the cell is {} high",
            millimetres(zone),
            millimetres(height)
        );
        let help = format!("at most {:.0} diameters fit", (height / largest).floor());
        list.add(path, message, &help);
        return false;
    }
    true
}
