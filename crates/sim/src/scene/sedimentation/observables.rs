//! What a sedimentation scene can be asked for.

use super::model::{Dimensions, Floor, Sedimentation, Sides};
use crate::scene::Observable;
use crate::scene::ObservableKind::{self, Profile, Scalar, Series};

type Row = (&'static str, &'static str, ObservableKind, &'static str);

#[rustfmt::skip]
const PLANE: &[Row] = &[
    ("area_porosity", "1", Scalar, "porosity of the bed's central slice by areas of discs"),
    ("area_porosity_whole", "1", Scalar, "porosity from the lowest to the highest point of the settled bed by areas of discs"),
    ("porosity_drop", "1", Scalar, "porosity when the first grains have settled, less that at the end"),
    ("floor_grain_diameter", "m", Scalar, "diameter of the fixed grains that make the floor"),
    ("area_porosity", "1", Series, "porosity of the bed's central slice by areas of discs"),
];

const BETWEEN_WALLS: &[Row] = &[(
    "porosity_interior",
    "1",
    Scalar,
    "porosity of the bed's central slice by exact volumes, one largest diameter away from the side walls",
)];

#[rustfmt::skip]
const ALWAYS: &[Row] = &[
    ("porosity", "1", Scalar, "porosity of the bed's central slice by exact volumes"),
    ("porosity_half", "1", Scalar, "porosity of the bed's central half by exact volumes"),
    ("porosity_centre", "1", Scalar, "porosity of the bed's central slice by the grains whose centres lie in it"),
    ("solids_fraction", "1", Scalar, "solids fraction of the bed's central slice"),
    ("thickness", "m", Scalar, "thickness of the settled bed"),
    ("permeability", "m²", Scalar, "permeability of the bed after Kozeny and Carman, from its porosity"),
    ("settling_time", "s", Scalar, "time at which the last grain has settled"),
    ("plateau_time", "s", Scalar, "time from which on the thickness stays within 2 % of its mean over the last tenth of the run"),
    ("growth_linearity", "1", Scalar, "r² of the straight line through the smoothed thickness from 1/8 to 7/8 of the time to its plateau"),
    ("final_growth_rate", "m/s", Scalar, "slope of the straight line through the thickness over the last tenth of the run"),
    ("settled_share", "1", Scalar, "share of the grains that have settled"),
    ("coordination", "1", Scalar, "mean number of contacts of a settled grain"),
    ("largest_overlap", "1", Scalar, "largest overlap in the run over the smaller diameter"),
    ("momentum_error", "1", Scalar, "sum of the forces between grains over the sum of their sizes, at the end"),
    ("first_speed", "m/s", Scalar, "mean settling speed once the start-up is over, before anything settles"),
    ("centre_of_mass", "m", Scalar, "height of the centre of mass at the end"),
    ("time_step", "s", Scalar, "step of the run"),
    ("contact_time", "s", Scalar, "shortest contact time that the step was picked for"),
    ("grains_fallen_out", "1", Scalar, "number of grains that left the box"),
    ("pairs_per_search", "1", Scalar, "pairs looked at in one search for near ones, mean over the run"),
    ("thickness", "m", Series, "thickness of the settled bed"),
    ("porosity", "1", Series, "porosity of the bed's central slice by exact volumes"),
    ("settled_share", "1", Series, "share of the grains that have settled"),
    ("centre_of_mass", "m", Series, "height of the centre of mass"),
    ("top_height", "m", Series, "height of the top of the highest grain"),
    ("mean_speed", "m/s", Series, "mean speed of the grains"),
    ("kinetic_energy", "J", Series, "kinetic energy of all grains, spin included"),
    ("coordination", "1", Series, "mean number of contacts of a settled grain"),
    ("largest_overlap", "1", Series, "largest overlap over the smaller diameter"),
    ("porosity_profile", "1", Profile, "porosity over height at the end"),
    ("snapshots", "1", Profile, "every grain at the kept times: place, size, velocity and contacts"),
];

pub fn observables(scene: &Sedimentation) -> Vec<Observable> {
    let own = match (scene.dimensions, scene.container.sides) {
        (Dimensions::Two, _) => PLANE,
        (Dimensions::Three, Sides::Walls) => BETWEEN_WALLS,
        (Dimensions::Three, Sides::Periodic | Sides::PeriodicAlongX) => &[],
    };
    // Without snapshots there is no table of them, and without floor grains no size of theirs.
    let floor = scene.container.floor != Floor::Flat;
    let kept = |row: &&Row| match row.0 {
        "snapshots" => scene.snapshots > 0,
        "floor_grain_diameter" => floor,
        _ => true,
    };
    let observable = |&(name, unit, kind, meaning): &Row| Observable {
        name,
        unit,
        kind,
        meaning,
    };
    own.iter().chain(ALWAYS).filter(kept).map(observable).collect()
}
