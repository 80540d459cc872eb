//! The names a study may use: observables of a scene and references.

use kynch_sim::scene::{Observable, ObservableKind};

use super::model::Work;
use super::published::published;
use super::units::{self, Dimension};

/// What a scene can be asked for.
pub fn observables(work: &Work) -> Vec<Observable> {
    match work {
        Work::Simulation(scene) => kynch_sim::scene::observables(scene),
        Work::Rehearsal(scene) => {
            let snapshots = (scene.grains > 0).then_some(&SNAPSHOTS);
            REHEARSAL.iter().chain(snapshots).map(observable).collect()
        }
    }
}

type Row = (&'static str, &'static str, ObservableKind, &'static str);

fn observable(row: &Row) -> Observable {
    let (name, unit, kind, meaning) = *row;
    Observable {
        name,
        unit,
        kind,
        meaning,
    }
}

use ObservableKind::{Profile, Scalar, Series};

const REHEARSAL: &[Row] = &[
    ("limit", "m/s", Scalar, "limit of the series"),
    ("scale", "1", Scalar, "scale that the error depends on"),
    ("value", "m/s", Series, "the series"),
];

const SNAPSHOTS: Row = ("snapshots", "1", Profile, "every grain at some instants");

/// What every run is measured by, whatever its scene: `counters.NAME`, `timings.wall`, `timings.cpu`.
pub fn is_measured_work(name: &str) -> bool {
    COUNTERS.iter().chain(TIMINGS).any(|known| *known == name)
}

/// All of them.
pub fn measures_of_work() -> Vec<&'static str> {
    COUNTERS.iter().chain(TIMINGS).copied().collect()
}

/// Unit of a measure of work.
pub fn work_unit(name: &str) -> Option<Dimension> {
    match TIMINGS.contains(&name) {
        true => units::parse("1 s").ok().map(|second| second.dimension),
        false => Some(Dimension::NONE),
    }
}

const COUNTERS: &[&str] = &[
    "counters.steps",
    "counters.grain_steps",
    "counters.fluid_pairs",
    "counters.coupling_pairs",
    "counters.grain_pairs",
    "counters.searched_pairs",
    "counters.list_rebuilds",
    "counters.porosity_clips",
];

const TIMINGS: &[&str] = &["timings.wall", "timings.cpu"];

/// References by name, and whether each is a curve: solutions, then published data.
pub fn references() -> Vec<(&'static str, ObservableKind)> {
    let data = published().iter().map(|entry| (entry.name.as_str(), entry.kind));
    SOLUTIONS.iter().copied().chain(data).collect()
}

const SOLUTIONS: &[(&str, ObservableKind)] = &[
    ("stokes_start_up", Series),
    ("terminal_velocity", Scalar),
    ("force_balance", Scalar),
    ("first_settling_speed", Scalar),
    ("smoothed_balance", Scalar),
    ("collision_restitution", Scalar),
    ("collision_contact_time", Scalar),
    ("collision_overlap", Scalar),
    ("sliding_restitution", Scalar),
    ("all_pairs", Scalar),
    ("stable_step", Scalar),
    ("kozeny_carman", Scalar),
    ("kozeny_carman_unit_slip", Scalar),
    ("cake_growth", Series),
    ("cake_growth_rate", Scalar),
    ("cake_thickness", Scalar),
    ("darcy_flux", Scalar),
    ("darcy_pressure_drop", Scalar),
    ("ruth_line", Series),
    ("ruth_thickness", Series),
    ("ruth_growth", Scalar),
    ("ruth_slope", Scalar),
    ("ruth_intercept", Scalar),
    ("known_limit", Scalar),
    ("known_series", Series),
    ("wallis", Scalar),
    ("garside_al_dibouni", Scalar),
    ("rowe", Scalar),
    ("khan_richardson", Scalar),
    ("zero_net_flux_front_1", Scalar),
    ("zero_net_flux_front_2", Scalar),
    ("zero_net_flux_front_3", Scalar),
    ("zero_net_flux_front_4", Scalar),
    ("zero_net_flux_speed_1", Scalar),
    ("zero_net_flux_speed_2", Scalar),
    ("zero_net_flux_speed_3", Scalar),
    ("zero_net_flux_speed_4", Scalar),
    ("zero_net_flux_slip_1", Scalar),
    ("zero_net_flux_slip_2", Scalar),
    ("zero_net_flux_slip_3", Scalar),
    ("zero_net_flux_slip_4", Scalar),
    ("kynch_bed_front", Scalar),
    ("kynch_meeting_time", Scalar),
    ("kynch_meeting_height", Scalar),
    ("kynch_type", Scalar),
    ("kynch_interface", Series),
    ("kynch_bed_height", Series),
];
