//! What a scene can be asked for.

use super::ObservableKind::{Profile, Scalar, Series};
use super::setup::Settling;
use super::{Observable, ObservableKind, Scene};

type Row = (&'static str, &'static str, ObservableKind, &'static str);

const ALWAYS: &[Row] = &[
    (
        "terminal_velocity",
        "m/s",
        Scalar,
        "settling speed in the terminal window, positive down",
    ),
    (
        "terminal_velocity_drift",
        "m/s",
        Scalar,
        "second half of the terminal window less the first",
    ),
    ("porosity", "1", Scalar, "porosity the grains settle at"),
    ("grains", "1", Scalar, "number of grains"),
    ("time_step", "s", Scalar, "step of the run"),
    (
        "overlap",
        "1",
        Scalar,
        "largest overlap with the floor over the diameter",
    ),
    ("velocity", "m/s", Series, "settling speed, positive down"),
    ("height", "m", Series, "height of the first grain"),
    (
        "slip_velocity",
        "m/s",
        Series,
        "mean superficial slip, upward positive",
    ),
    ("drag_force", "N", Series, "mean drag on a grain, upward positive"),
    (
        "fluid_acceleration",
        "m/s²",
        Series,
        "acceleration of a grain by the fluid, buoyancy included",
    ),
];

const PRESCRIBED: &[Row] = &[
    (
        "largest_velocity",
        "m/s",
        Scalar,
        "largest settling speed until one diameter is left above the floor",
    ),
    (
        "terminal_time",
        "s",
        Scalar,
        "time from rest to 95 % of the terminal velocity",
    ),
];

const PARTICLES: &[Row] = &[
    (
        "terminal_slip",
        "m/s",
        Scalar,
        "mean superficial slip in the terminal window, upward positive",
    ),
    (
        "terminal_drag",
        "N",
        Scalar,
        "mean drag on a grain in the terminal window",
    ),
    (
        "terminal_stress_force",
        "N",
        Scalar,
        "mean force of pressure and viscous stress on a grain in the window",
    ),
    (
        "terminal_fluid_acceleration",
        "m/s²",
        Scalar,
        "acceleration of a grain by the fluid in the window",
    ),
    (
        "sound_speed",
        "m/s",
        Scalar,
        "sound speed of the equation of state",
    ),
    ("smoothing_length", "m", Scalar, "smoothing length of the fluid"),
    (
        "exchange_length",
        "m",
        Scalar,
        "length over which grains and fluid exchange momentum",
    ),
    (
        "fluid_particles",
        "1",
        Scalar,
        "number of fluid particles, walls left out",
    ),
    (
        "momentum_error",
        "1",
        Scalar,
        "momentum not closed in a step over the impulse exchanged",
    ),
    (
        "spurious_velocity",
        "m/s",
        Scalar,
        "largest fluid speed in the run: spurious where there should be rest",
    ),
    (
        "stress_force",
        "N",
        Series,
        "mean force of the fluid's pressure and viscous stress on a grain",
    ),
    (
        "momentum_error_history",
        "1",
        Series,
        "largest momentum error so far",
    ),
    (
        "porosity_profile",
        "1",
        Profile,
        "horizontal mean of the fluid's porosity over height",
    ),
    (
        "fluid_velocity_profile",
        "m/s",
        Profile,
        "horizontal mean of the fluid's vertical velocity over height",
    ),
    (
        "pressure_profile",
        "Pa",
        Profile,
        "horizontal mean of the excess pressure over height",
    ),
];

const SPHERE: &[Row] = &[
    (
        "disturbance_share",
        "1",
        Scalar,
        "largest fluid velocity at the grain over its speed",
    ),
    (
        "self_disturbance_error",
        "1",
        Scalar,
        "largest gap between measured and analytic self-induced flow over the flow",
    ),
    (
        "disturbance",
        "m/s",
        Series,
        "fluid velocity at the grain, downward positive",
    ),
    (
        "disturbance_analytic",
        "m/s",
        Series,
        "self-induced flow taken out of it, downward positive",
    ),
];

const BLOCK: &[Row] = &[
    (
        "plateau_porosity",
        "1",
        Scalar,
        "porosity of the fluid at the block's middle height at the end",
    ),
    (
        "porosity_ripple",
        "1",
        Scalar,
        "rms departure of the fluid's porosity from its mean, deep inside the block at the end, over the mean",
    ),
    (
        "edge_width",
        "m",
        Scalar,
        "solids fraction deep inside the block over the steepest slope of the porosity profile",
    ),
    (
        "slip_velocity_1",
        "m/s",
        Series,
        "slip of the first tracked grain, in the bottom layer",
    ),
    (
        "slip_velocity_2",
        "m/s",
        Series,
        "slip of the second tracked grain, at a third of the grains",
    ),
    (
        "slip_velocity_3",
        "m/s",
        Series,
        "slip of the third tracked grain, at two thirds",
    ),
    (
        "slip_velocity_4",
        "m/s",
        Series,
        "slip of the fourth tracked grain, in the top layer",
    ),
    ("drag_force_1", "N", Series, "drag on the first tracked grain"),
    ("drag_force_2", "N", Series, "drag on the second tracked grain"),
    ("drag_force_3", "N", Series, "drag on the third tracked grain"),
    ("drag_force_4", "N", Series, "drag on the fourth tracked grain"),
    (
        "grain_porosity",
        "1",
        Profile,
        "porosity each layer of grains sees",
    ),
    (
        "axis_porosity",
        "1",
        Profile,
        "porosity of the fluid particles around the middle of the cross-section over height",
    ),
    ("grain_slip", "m/s", Profile, "mean slip of each layer of grains"),
    ("grain_drag", "N", Profile, "mean drag on a grain of each layer"),
];

/// What a scene can be asked for, in a stable order.
pub fn observables(scene: &Scene) -> Vec<Observable> {
    let settling = match scene {
        Scene::SingleSphere(sphere) => Settling::of_sphere(sphere),
        Scene::ConstantPorosityBlock(block) => Settling::of_block(block),
        Scene::BinaryCollision(collision) => return super::collision::observables(collision),
        Scene::Sedimentation(scene) => return super::sedimentation::observables(scene),
        Scene::Suspension(scene) => return super::suspension::observables(scene),
    };
    let particles = if settling.sph().is_some() {
        PARTICLES
    } else {
        PRESCRIBED
    };
    let own = match (settling.sph().is_some(), settling.block.is_some()) {
        (false, _) => &[],
        (true, true) => BLOCK,
        (true, false) => SPHERE,
    };
    let observable = |&(name, unit, kind, meaning): &Row| Observable {
        name,
        unit,
        kind,
        meaning,
    };
    ALWAYS
        .iter()
        .chain(particles)
        .chain(own)
        .map(observable)
        .collect()
}
