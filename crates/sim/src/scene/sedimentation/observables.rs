//! What a sedimentation scene can be asked for.

use super::model::{Dimensions, Sedimentation};
use crate::scene::Observable;
use crate::scene::ObservableKind::{self, Profile, Scalar, Series};

type Row = (&'static str, &'static str, ObservableKind, &'static str);

const PLANE: &[Row] = &[(
    "area_porosity",
    "1",
    Scalar,
    "porosity of the bed's central slice by areas of discs",
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
    let plane = match scene.dimensions {
        Dimensions::Two => PLANE,
        Dimensions::Three => &[],
    };
    // Without snapshots there is no table of them.
    let kept = |row: &&Row| scene.snapshots > 0 || row.0 != "snapshots";
    let observable = |&(name, unit, kind, meaning): &Row| Observable {
        name,
        unit,
        kind,
        meaning,
    };
    plane.iter().chain(ALWAYS).filter(kept).map(observable).collect()
}
