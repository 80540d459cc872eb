//! What a suspension scene can be asked for.

use super::model::Suspension;
use crate::scene::Observable;
use crate::scene::ObservableKind::{self, Profile, Scalar, Series};

type Row = (&'static str, &'static str, ObservableKind, &'static str);

#[rustfmt::skip]
const ALWAYS: &[Row] = &[
    ("bed_porosity", "1", Scalar, "porosity of the deposit at the end, central 80 % of its height"),
    ("bed_thickness", "m", Scalar, "height of the front between deposit and suspension at the end"),
    ("deposit_fraction", "1", Scalar, "solids fraction of the deposit at the end"),
    ("solids_fraction", "1", Scalar, "solids fraction of the suspension at the start"),
    ("momentum_error", "1", Scalar, "largest rate of momentum not closed in a step over the weight of the grains"),
    ("largest_overlap", "1", Scalar, "largest overlap in the run over the smaller diameter"),
    ("porosity_clips", "1", Scalar, "times that a porosity was held at its floor of 0.3"),
    ("settled_share", "1", Scalar, "share of the grains whose centres lie in the deposit at the end"),
    ("grain_number", "1", Scalar, "number of grains"),
    ("time_step", "s", Scalar, "step of the run: the fluid's, or the grains' where no fluid is solved"),
    ("interface_height", "m", Series, "mean height of the highest grains"),
    ("interface_front", "m", Series, "height above which the porosity exceeds the mean of clear fluid and suspension"),
    ("bed_front", "m", Series, "height of the front between deposit and suspension"),
    ("centre_of_mass", "m", Series, "height of the grains' centre of mass"),
    ("velocity_fluctuation", "m/s", Series, "rms of the vertical velocity of suspended grains about the mean of their class"),
    ("velocity_fluctuation_horizontal", "m/s", Series, "rms of a horizontal velocity component of suspended grains"),
    ("porosity_map", "1", Profile, "porosity over time and height, by exact volumes"),
    ("snapshots", "1", Profile, "every grain at the kept times: place, size, velocity and contacts"),
];

/// Series of one class each, by its place.
#[rustfmt::skip]
const OF_CLASS: [&[Row]; 4] = [
    &[
        ("interface_height_1", "m", Series, "mean height of the highest grains of the first class"),
        ("centre_of_mass_1", "m", Series, "height of the centre of mass of the first class"),
        ("slip_1", "m/s", Series, "mean superficial slip of suspended grains of the first class, upward positive"),
        ("settling_speed_1", "m/s", Series, "mean speed of suspended grains of the first class, downward positive"),
    ],
    &[
        ("interface_height_2", "m", Series, "mean height of the highest grains of the second class"),
        ("centre_of_mass_2", "m", Series, "height of the centre of mass of the second class"),
        ("slip_2", "m/s", Series, "mean superficial slip of suspended grains of the second class, upward positive"),
        ("settling_speed_2", "m/s", Series, "mean speed of suspended grains of the second class, downward positive"),
    ],
    &[
        ("interface_height_3", "m", Series, "mean height of the highest grains of the third class"),
        ("centre_of_mass_3", "m", Series, "height of the centre of mass of the third class"),
        ("slip_3", "m/s", Series, "mean superficial slip of suspended grains of the third class, upward positive"),
        ("settling_speed_3", "m/s", Series, "mean speed of suspended grains of the third class, downward positive"),
    ],
    &[
        ("interface_height_4", "m", Series, "mean height of the highest grains of the fourth class"),
        ("centre_of_mass_4", "m", Series, "height of the centre of mass of the fourth class"),
        ("slip_4", "m/s", Series, "mean superficial slip of suspended grains of the fourth class, upward positive"),
        ("settling_speed_4", "m/s", Series, "mean speed of suspended grains of the fourth class, downward positive"),
    ],
];

pub fn observables(scene: &Suspension) -> Vec<Observable> {
    let kept = |row: &&Row| row.0 != "snapshots" || scene.snapshots > 0;
    let of_class = OF_CLASS.iter().take(scene.classes.len()).copied().flatten();
    let observable = |&(name, unit, kind, meaning): &Row| Observable {
        name,
        unit,
        kind,
        meaning,
    };
    ALWAYS
        .iter()
        .filter(kept)
        .chain(of_class)
        .map(observable)
        .collect()
}
