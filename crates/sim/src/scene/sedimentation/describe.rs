//! A sedimentation scene in words and numbers.

use super::model::{
    Arrangement, Detection, Dimensions, Floor, GrainDrag, Lift, Sedimentation, Sides, SlicePorosity,
    StillFluid, Voidage,
};
use super::step::{Limits, limits};
use super::warnings::warnings;
use crate::contact::Body;
use crate::scene::collision::{describe_laws, integrator};
use crate::scene::{Description, IntegratorChoice};

/// Cost of a grain's step over that of a fluid particle.
const GRAIN_COST: f64 = 0.25;
/// Cost of trying one pair over that of a fluid particle.
const TRIAL_COST: f64 = 1e-3;
/// Memory of a run without grains [bytes].
const MEMORY: f64 = 1e6;
/// Memory of a grain: its state, contacts and row of the list of pairs [bytes].
const GRAIN_MEMORY: f64 = 1000.0;
/// Memory of a grain in a snapshot [bytes]: eleven columns, twice while they are handed over.
pub const ROW_MEMORY: f64 = 11.0 * 8.0 * 2.0;

pub fn describe(scene: &Sedimentation) -> Description {
    let limits = limits(scene);
    let mut description = work(scene, &limits, scene.grains() as f64);
    grains_in_words(scene, &start_in_words(scene), &mut description);
    describe_laws(&scene.normal, &scene.tangential, &scene.rolling, &mut description);
    let fluid = match scene.fluid {
        StillFluid::Still(_) => "fluid at rest everywhere",
        StillFluid::Column(_) => "closed column: the fluid flows back through the grains",
    };
    forces_in_words(scene, fluid, &mut description);
    run_in_words(scene, &mut description);
    numbers(scene, &limits, &mut description);
    warnings(scene, &limits, fall(scene), &mut description);
    description
}

/// Steps and the work of so many grains, on average, over the whole run.
pub fn work(scene: &Sedimentation, limits: &Limits, grains: f64) -> Description {
    let steps = (scene.duration / limits.time_step).ceil().max(1.0);
    Description {
        grains: scene.grains(),
        steps: steps as u64,
        work: steps * grains * step_cost(scene, grains),
        memory: (MEMORY + grains * (GRAIN_MEMORY + f64::from(scene.snapshots) * ROW_MEMORY)) as u64,
        ..Description::default()
    }
}

/// Cost of a grain's step among so many, over that of a fluid particle.
fn step_cost(scene: &Sedimentation, grains: f64) -> f64 {
    let evaluations = match scene.integrator {
        IntegratorChoice::RungeKutta4 => 4.0,
        _ => 1.0,
    };
    let search = match scene.detection {
        Detection::List { .. } => 0.0,
        Detection::Cells => GRAIN_COST,
        Detection::BruteForce => 0.5 * grains * TRIAL_COST,
    };
    evaluations * (GRAIN_COST + search)
}

/// `start at random …`
pub fn start_in_words(scene: &Sedimentation) -> String {
    match &scene.arrangement {
        Arrangement::Random => "start at random, without overlap, over the whole box".to_owned(),
        Arrangement::Even => "start at random, without overlap, evenly over the whole box".to_owned(),
        Arrangement::Lattice => "start on a cubic lattice shaken by a hundredth of its pitch".to_owned(),
        Arrangement::Packed { solids_fraction } => {
            format!("start packed at random to a solids fraction of {solids_fraction}")
        }
        Arrangement::Snapshot(snapshot) => format!(
            "start where the last instant of `{}` left them, without spin, contacts without a history",
            snapshot.file
        ),
    }
}

/// What the grains are, where they start, and what holds them.
pub fn grains_in_words(scene: &Sedimentation, start: &str, description: &mut Description) {
    let dimensions = match scene.dimensions {
        Dimensions::Two => "spheres whose centres stay in a plane",
        Dimensions::Three => "spheres in space",
    };
    description.active.push(format!("{dimensions}; they {start}"));
    let sizes = scene.classes.iter().any(|class| class.largest() > class.diameter);
    if sizes {
        description
            .active
            .push("diameters spread within a class, small ones more frequent: p(R) ~ 1/R²".to_owned());
    }
    let floor = match scene.container.floor {
        Floor::Flat => "a flat floor",
        Floor::Grains(_) => "a floor of fixed grains",
    };
    match scene.container.sides {
        Sides::Walls => description.active.push(format!(
            "flat side walls and {floor} with the contact law of the grains"
        )),
        Sides::PeriodicAlongX => {
            description.active.push(format!(
                "flat walls across y and {floor} with the contact law of the grains"
            ));
            description
                .left_out
                .push("walls across x: the box repeats itself along x".to_owned());
        }
        Sides::Periodic => {
            description
                .active
                .push(format!("{floor} with the contact law of the grains"));
            description
                .left_out
                .push("side walls: the box repeats itself sideways".to_owned());
        }
    }
}

/// What acts on the grains, but for the fluid's flow.
pub fn forces_in_words(scene: &Sedimentation, fluid: &str, description: &mut Description) {
    let mut force = |active: Option<String>, left_out: &str| match active {
        Some(words) => description.active.push(words),
        None => description.left_out.push(left_out.to_owned()),
    };
    force(
        scene.cohesion.map(|cohesion| {
            let walls = if cohesion.walls {
                ", walls attract too"
            } else {
                ", walls do not attract"
            };
            format!(
                "van der Waals attraction, no stronger than at a gap of {} nm{walls}",
                1e9 * cohesion.smallest_gap
            )
        }),
        "cohesion: none is asked for",
    );
    force(
        scene
            .charge
            .map(|_| "Coulomb's force between the charges of the grains".to_owned()),
        "charge: the grains carry none",
    );
    force(drag(scene), "drag: grains fall freely but for buoyancy");
    let lift = (scene.lift == Lift::Magnus).then(|| "Magnus lift of spinning grains".to_owned());
    force(lift, "lift: none is asked for");
    force(Some(format!("{fluid}; buoyancy of the pure fluid (model B)")), "");
    let slices = match scene.porosity {
        SlicePorosity::Exact => "exact volumes of spheres",
        SlicePorosity::Centre => "the slice that holds the centre",
        SlicePorosity::Areas => "areas of discs, by the slice that holds the centre",
    };
    let porosity = (scene.voidage != Voidage::None)
        .then(|| format!("porosity of slices one largest diameter high, by {slices}"));
    force(porosity, "local porosity: every grain is dragged as if alone");
    force(
        None,
        "added mass and history forces: no scene of this kind has them",
    );
}

/// The drag in words; `None` without one.
fn drag(scene: &Sedimentation) -> Option<String> {
    let law = match scene.drag {
        GrainDrag::None => return None,
        GrainDrag::Stokes => "Stokes drag",
        GrainDrag::Dallavalle => "Dallavalle drag",
        GrainDrag::SchillerNaumann => "Schiller–Naumann drag",
        GrainDrag::CoulsonRichardson => "Coulson–Richardson drag",
        GrainDrag::Beetstra => "Beetstra drag",
        GrainDrag::BeetstraCello => "Beetstra drag, shared out among the sizes after Cello",
    };
    let voidage = match scene.voidage {
        Voidage::None => "",
        Voidage::DiFelice => ", hindered by neighbours after Di Felice",
        Voidage::AlvimLiteral => {
            ", hindered as a published misprint of Di Felice has it: the slip lacks the square of the porosity"
        }
    };
    Some(format!("{law} on the superficial slip{voidage}"))
}

/// How the run goes.
pub fn run_in_words(scene: &Sedimentation, description: &mut Description) {
    description.active.push(integrator(scene.integrator));
    description.active.push(match scene.detection {
        Detection::List { .. } => "list of near pairs with a skin".to_owned(),
        Detection::Cells => "grid of cells, searched in every step".to_owned(),
        Detection::BruteForce => "every pair tried in every step".to_owned(),
    });
    if let Detection::BruteForce | Detection::Cells = scene.detection {
        description
            .left_out
            .push("list of near pairs: pairs are searched in every step".to_owned());
    }
    if scene.sleeping {
        description
            .active
            .push("grains at rest sleep until something moves them".to_owned());
    } else {
        description
            .left_out
            .push("sleeping: grains at rest are computed like all others".to_owned());
    }
    if scene.threads > 1 {
        description
            .active
            .push(format!("{} threads, with the results of one", scene.threads));
    } else {
        description.left_out.push("threads inside the run".to_owned());
    }
}

/// The grain that falls fastest, with its density [kg/m³] and speed [m/s].
fn fastest(scene: &Sedimentation) -> Option<(Body, f64, f64)> {
    let grains = scene.extremes().into_iter();
    grains
        .map(|(grain, density)| (grain, density, scene.greatest_speed(&grain, density)))
        .max_by(|one, other| one.2.total_cmp(&other.2))
}

/// Dimensionless numbers, speeds, contacts and the step.
pub fn numbers(scene: &Sedimentation, limits: &Limits, description: &mut Description) {
    let Some((grain, density, speed)) = fastest(scene) else {
        return;
    };
    let medium = scene.fluid.medium();
    let weight = grain.mass * scene.gravity;
    let archimedes =
        (2.0 * grain.radius).powi(3) * medium.density * (density - medium.density) * scene.gravity
            / medium.viscosity.powi(2);
    let reynolds = scene.reynolds(&grain, speed);
    let solids = scene.solids_fraction();
    let mut add = |name: &str, value: f64, unit| description.numbers.push((name.to_owned(), value, unit));
    add("Archimedes number", archimedes, "1");
    add("greatest speed of an isolated grain", speed, "m/s");
    add("Reynolds number at that speed", reynolds, "1");
    add(
        "Stokes number at that speed",
        density / medium.density * reynolds / 9.0,
        "1",
    );
    add("solids fraction of the box", solids, "1");
    let among = scene.settling_speed(&grain, density, 1.0 - solids);
    if let Some(speed) = among {
        add("settling speed at that solids fraction", speed, "m/s");
    }
    let bond = bond_number(scene);
    if let Some(bond) = bond {
        add("Bond number: cohesion over weight", bond, "1");
    }
    add("impact speed the step is picked for", limits.impact_speed, "m/s");
    add("contact time", limits.contact_time, "s");
    add("expected overlap over diameter", limits.overlap, "1");
    add("time step", limits.time_step, "s");
    add("longest safe time step", limits.longest, "s");
    add(
        "contact time over time step",
        limits.contact_time / limits.time_step,
        "1",
    );
    let repulsion = scene.charge.map(|charged| {
        charged
            .law()
            .force(2.0 * grain.radius, charged.charge, charged.charge)
            .abs()
    });
    if let Some(force) = repulsion.filter(|_| weight > 0.0) {
        add("Coulomb's force in contact over weight", force / weight, "1");
    }
}

/// Time in which a grain falls through the box [s].
fn fall(scene: &Sedimentation) -> f64 {
    let Some((grain, density, speed)) = fastest(scene) else {
        return 0.0;
    };
    let among = scene.settling_speed(&grain, density, 1.0 - scene.solids_fraction());
    scene.container.height / among.map_or(speed, |among| among.min(speed))
}

/// Largest attraction of two equal grains over the weight of one, H R/(12 h² m g).
pub fn bond_number(scene: &Sedimentation) -> Option<f64> {
    let cohesion = scene.cohesion?;
    let ratio = |(grain, _): &(Body, f64)| {
        let force = cohesion.hamaker * grain.radius / (12.0 * cohesion.smallest_gap.powi(2));
        force / (grain.mass * scene.gravity)
    };
    scene.extremes().iter().map(ratio).reduce(f64::max)
}
