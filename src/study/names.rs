//! The names a study may use: observables of a scene and references.

use kynch_sim::scene::{Observable, ObservableKind};

use super::model::Work;

/// What a scene can be asked for.
pub fn observables(work: &Work) -> Vec<Observable> {
    match work {
        Work::Simulation(_) => SIMULATION.iter().map(observable).collect(),
        Work::Rehearsal(_) => REHEARSAL.iter().map(observable).collect(),
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

const SIMULATION: &[Row] = &[
    (
        "terminal_velocity",
        "m/s",
        Scalar,
        "settling speed in the terminal window, positive down",
    ),
    (
        "terminal_velocity_drift",
        "1",
        Scalar,
        "relative change over the terminal window",
    ),
    (
        "momentum_error",
        "1",
        Scalar,
        "momentum not closed over the impulse exchanged",
    ),
    (
        "self_disturbance_error",
        "1",
        Scalar,
        "measured over analytic self-induced flow, minus one",
    ),
    (
        "start_up_error",
        "1",
        Scalar,
        "largest departure from the start-up curve over the terminal velocity",
    ),
    (
        "spurious_velocity",
        "m/s",
        Scalar,
        "largest fluid speed where there should be rest",
    ),
    ("porosity", "1", Scalar, "porosity of the block"),
    ("overlap", "1", Scalar, "largest overlap over diameter"),
    ("sound_speed", "m/s", Scalar, "numerical speed of sound"),
    ("time_step", "s", Scalar, "fluid time step"),
    ("fluid_particles", "1", Scalar, "number of fluid particles"),
    ("grains", "1", Scalar, "number of grains"),
    ("velocity", "m/s", Series, "settling speed, positive down"),
    ("slip_velocity", "m/s", Series, "superficial slip velocity"),
    ("drag_force", "N", Series, "drag on a grain"),
    ("fluid_acceleration", "m/s²", Series, "acceleration of the fluid"),
    (
        "disturbance",
        "m/s",
        Series,
        "fluid velocity at the grain that the grain itself causes",
    ),
    (
        "disturbance_analytic",
        "m/s",
        Series,
        "the same from the analytic solution",
    ),
    ("momentum_error_history", "1", Series, "momentum error over time"),
    ("porosity_profile", "1", Profile, "porosity over height"),
    (
        "fluid_velocity_profile",
        "m/s",
        Profile,
        "fluid velocity over height",
    ),
    ("pressure_profile", "Pa", Profile, "pressure over height"),
];

const REHEARSAL: &[Row] = &[
    ("limit", "1", Scalar, "limit of the series"),
    ("scale", "1", Scalar, "scale that the error depends on"),
    ("value", "1", Series, "the series"),
];

/// References by name, and whether each is a curve.
pub const REFERENCES: &[(&str, ObservableKind)] = &[
    ("stokes_start_up", Series),
    ("terminal_velocity", Scalar),
    ("force_balance", Scalar),
    ("smoothed_balance", Scalar),
    ("known_limit", Scalar),
    ("known_series", Series),
];
