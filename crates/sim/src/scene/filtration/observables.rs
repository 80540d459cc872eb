//! What a filtration scene can be asked for.

use super::model::Filtration;
use crate::scene::ObservableKind::{self, Profile, Scalar, Series};
use crate::scene::{Dimensions, Floor, Observable, Sides};

type Row = (&'static str, &'static str, ObservableKind, &'static str);

#[rustfmt::skip]
const PLANE: &[Row] = &[
    ("area_porosity", "1", Scalar, "porosity of the cake's central slice by areas of discs"),
    ("area_porosity_whole", "1", Scalar, "porosity from the lowest to the highest point of the cake by areas of discs"),
    ("area_porosity", "1", Series, "porosity of the cake's central slice by areas of discs"),
];

const BETWEEN_WALLS: &[Row] = &[(
    "porosity_interior",
    "1",
    Scalar,
    "porosity of the cake's central slice by exact volumes, one largest diameter away from the side walls",
)];

#[rustfmt::skip]
const MEDIUM: &[Row] = &[
    ("medium_grain_diameter", "m", Scalar, "diameter of the fixed grains that make the medium"),
    ("medium_grains", "1", Scalar, "number of fixed grains in the medium"),
    ("medium_pitch", "m", Scalar, "distance of neighbours in a layer of the medium, along x"),
];

#[rustfmt::skip]
const ACROSS: &[Row] = &[
    ("wall_shear", "Pa", Scalar, "shear stress of the flow across on the bare medium"),
    ("surface_shear", "Pa", Scalar, "shear stress of the flow across at the height of the cake's surface"),
    ("erosion_thickness", "m", Scalar, "mean thickness of the cake over the last tenth of the run where growth has stopped while grains are in flight, else no number"),
    ("grain_flux", "m/s", Scalar, "volume of grains carried along x per area and time, over the whole cell"),
    ("surface_shear", "Pa", Series, "shear stress of the flow across at the height of the cake's surface"),
    ("grain_flux", "m/s", Series, "volume of grains carried along x per area and time, over the whole cell"),
];

#[rustfmt::skip]
const ALWAYS: &[Row] = &[
    ("thickness", "m", Scalar, "thickness of the cake, from the lowest to the highest point of its grains"),
    ("thickness_mean", "m", Scalar, "mean height of the cake's surface over the medium"),
    ("porosity", "1", Scalar, "porosity of the cake's central slice by exact volumes"),
    ("porosity_half", "1", Scalar, "porosity of the cake's central half by exact volumes"),
    ("porosity_centre", "1", Scalar, "porosity of the cake's central slice by the grains whose centres lie in it"),
    ("porosity_whole", "1", Scalar, "porosity from the lowest to the highest point of the cake by exact volumes of its grains"),
    ("solids_fraction", "1", Scalar, "solids fraction of the cake's central slice"),
    ("permeability", "m²", Scalar, "permeability of the cake after Kozeny and Carman"),
    ("flux", "m/s", Scalar, "filtrate volume per area and time at the end"),
    ("initial_flux", "m/s", Scalar, "filtrate volume per area and time before there is a cake"),
    ("pressure_drop", "Pa", Scalar, "pressure drop over medium and cake at the end"),
    ("medium_resistance", "1/m", Scalar, "resistance of the medium"),
    ("cake_resistance", "1/m", Scalar, "resistance of the cake at the end"),
    ("specific_resistance", "m/kg", Scalar, "average specific resistance of the cake: its resistance over its mass per area"),
    ("filtrate_volume", "m", Scalar, "filtrate volume per area"),
    ("deposited", "1", Scalar, "number of grains in the cake"),
    ("deposited_volume", "m³", Scalar, "volume of the grains in the cake"),
    ("deposited_mass", "kg", Scalar, "mass of the grains in the cake"),
    ("fed", "1", Scalar, "number of grains that have come into the cell"),
    ("waiting", "1", Scalar, "number of grains that were due and have found no room yet"),
    ("in_flight", "1", Scalar, "number of grains in the cell that do not belong to the cake"),
    ("passed", "1", Scalar, "number of grains that have passed through the medium"),
    ("volume_error", "1", Scalar, "largest gap between the volume fed and that in flight, in the cake and passed, over the volume fed"),
    ("cake_solids_error", "1", Scalar, "largest gap between the volume of the grains in the cake and (1 − porosity_whole) times area and thickness, over the volume"),
    ("feed_depth", "1", Scalar, "depth under the top of the cell at which the lowest grain was fed, by its centre in largest diameters"),
    ("settled_share", "1", Scalar, "share of the grains fed that lie in the cake"),
    ("first_deposit_time", "s", Scalar, "time at which the cake begins"),
    ("deposit_onset", "s", Scalar, "time at which the straight line through the deposited volume, from 20 to 80 % of that at the end, begins"),
    ("flux_fall_time", "s", Scalar, "time at which the flux falls below 98 % of that at the start; the duration where it never does"),
    ("settling_time", "s", Scalar, "time from which on all grains fed lie in the cake or have passed"),
    ("plateau_time", "s", Scalar, "time from which on the thickness stays within 2 % of its mean over the last tenth of the run"),
    ("growth_linearity", "1", Scalar, "r² of the straight line through the smoothed thickness from 1/8 to 7/8 of the time to its plateau"),
    ("final_growth_rate", "m/s", Scalar, "slope of the straight line through the thickness over the last tenth of the run"),
    ("coordination", "1", Scalar, "mean number of contacts of a grain in the cake"),
    ("largest_overlap", "1", Scalar, "largest overlap in the run over the smaller diameter"),
    ("momentum_error", "1", Scalar, "sum of the forces between grains over the sum of their sizes, at the end"),
    ("time_step", "s", Scalar, "step of the run"),
    ("contact_time", "s", Scalar, "shortest contact time that the step was picked for"),
    ("pairs_per_search", "1", Scalar, "pairs looked at in one search for near ones, mean over the run"),
    ("thickness", "m", Series, "thickness of the cake, from the lowest to the highest point of its grains"),
    ("thickness_mean", "m", Series, "mean height of the cake's surface over the medium"),
    ("porosity", "1", Series, "porosity of the cake's central slice by exact volumes"),
    ("porosity_whole", "1", Series, "porosity from the lowest to the highest point of the cake by exact volumes of its grains"),
    ("permeability", "m²", Series, "permeability of the cake after Kozeny and Carman"),
    ("flux", "m/s", Series, "filtrate volume per area and time"),
    ("pressure_drop", "Pa", Series, "pressure drop over medium and cake"),
    ("cake_resistance", "1/m", Series, "resistance of the cake"),
    ("specific_resistance", "m/kg", Series, "average specific resistance of the cake"),
    ("filtrate_volume", "m", Series, "filtrate volume per area"),
    ("volume_since_deposit", "m", Series, "filtrate volume per area since the cake began: V"),
    ("time_over_volume", "s/m", Series, "time over filtrate volume per area, both since the cake began: t/V"),
    ("cake_solids_error", "1", Series, "gap between the volume of the grains in the cake and (1 − porosity_whole) times area and thickness, over the volume"),
    ("deposited", "1", Series, "number of grains in the cake"),
    ("deposited_volume", "m³", Series, "volume of the grains in the cake"),
    ("deposited_mass", "kg", Series, "mass of the grains in the cake"),
    ("fed", "1", Series, "number of grains that have come into the cell"),
    ("waiting", "1", Series, "number of grains that were due and have found no room yet"),
    ("in_flight", "1", Series, "number of grains in the cell that do not belong to the cake"),
    ("passed", "1", Series, "number of grains that have passed through the medium"),
    ("volume_error", "1", Series, "gap between the volume fed and that in flight, in the cake and passed, over the volume fed"),
    ("settled_share", "1", Series, "share of the grains fed that lie in the cake"),
    ("centre_of_mass", "m", Series, "height of the centre of mass of the grains in the cell"),
    ("top_height", "m", Series, "height of the top of the highest grain"),
    ("mean_speed", "m/s", Series, "mean speed of the grains in the cell"),
    ("kinetic_energy", "J", Series, "kinetic energy of all grains in the cell, spin included"),
    ("coordination", "1", Series, "mean number of contacts of a grain in the cake"),
    ("largest_overlap", "1", Series, "largest overlap over the smaller diameter"),
    ("porosity_profile", "1", Profile, "porosity over height at the end"),
    ("permeability_profile", "m²", Profile, "permeability of the cake's layers after Kozeny and Carman over height at the end"),
    ("snapshots", "1", Profile, "every grain at the kept times: place, size, velocity and contacts"),
];

pub fn observables(scene: &Filtration) -> Vec<Observable> {
    let bed = &scene.bed;
    let own = match (bed.dimensions, bed.container.sides) {
        (Dimensions::Two, _) => PLANE,
        (Dimensions::Three, Sides::Walls) => BETWEEN_WALLS,
        (Dimensions::Three, Sides::Periodic | Sides::PeriodicAlongX) => &[],
    };
    let medium = match bed.container.floor {
        Floor::Flat => &[],
        Floor::Grains { .. } => MEDIUM,
    };
    let across = if scene.crossflow.is_some() { ACROSS } else { &[] };
    // Without snapshots there is no table of them.
    let kept = |row: &&Row| row.0 != "snapshots" || bed.snapshots > 0;
    let observable = |&(name, unit, kind, meaning): &Row| Observable {
        name,
        unit,
        kind,
        meaning,
    };
    let rows = own.iter().chain(medium).chain(across).chain(ALWAYS);
    rows.filter(kept).map(observable).collect()
}
