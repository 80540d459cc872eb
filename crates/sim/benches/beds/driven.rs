//! A suspension of grains driven by a fluid that is solved elsewhere, and the bed it leaves: prints
//! `BENCH driven_<what> <time> ms/span`.
//!
//! ```text
//! cargo bench -p kynch-sim --bench beds -- --driven [--spans N] [--only NAME]
//! ```
//!
//! Grains of 100 µm and 2500 kg/m³ in water fill 4 × 4 × 6 mm to a tenth, periodic sideways. The fluid is
//! at rest, its drag Stokes' times Di Felice's ε^−β; spans last 1e-4 s. The bed is what comes of a
//! shaken lattice of the same grains. Without flights a reach without force makes everybody busy.

use std::f64::consts::PI;

use kynch_sim::bed::{Attraction, Bed, Drive, Grain, Grains, Interaction, Laws, Listing, Surroundings, Wall};
use kynch_sim::cohesion::VanDerWaals;
use kynch_sim::contact::{
    AnyNormal, AnyRolling, AnyTangential, Body, Couple, CundallStrack, LinearSpringDashpot, RollingResistance,
};
use kynch_sim::math::{Random, Vec3};

use super::Clock;

const DIAMETER: f64 = 1e-4;
const SIZE: [f64; 3] = [4e-3, 4e-3, 6e-3];
const SOLIDS: f64 = 0.1;
const SPAN: f64 = 1e-4;
/// Spring constant of overlaps of 0.3 per cent when grains meet at 9 mm/s [N/m].
const STIFFNESS: f64 = 1.0;
const RESTITUTION: f64 = 0.6;
const STEP: f64 = 4e-6;

pub fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let told = |name: &str| {
        let at = arguments.iter().position(|argument| argument == name)?;
        arguments.get(at + 1)
    };
    let spans = told("--spans")
        .and_then(|number| number.parse().ok())
        .unwrap_or(40);
    let wanted = |name: &str| told("--only").is_none_or(|only| name.contains(only.as_str()));
    let grains = suspension();
    for (name, laws) in [("smooth", smooth()), ("friction", friction())] {
        for flights in [true, false] {
            let what = if flights { "flights" } else { "substeps" };
            let name = format!("suspension_{name}_{what}");
            if !wanted(&name) {
                continue;
            }
            let mut bed = bed(&grains, laws, flights);
            let drives = drives(grains.len(), 1.0, 0.9);
            run(&mut bed, &drives, spans.max(50), None);
            run(&mut bed, &drives, spans, Some(&name));
        }
    }
    for (name, laws) in [("smooth", smooth()), ("friction", friction())] {
        let name = format!("bed_{name}_flights");
        if !wanted(&name) {
            continue;
        }
        let loose = loose(grains.len());
        let mut settled = bed(&loose, laws, true);
        run(&mut settled, &drives(loose.len(), 0.1, 1.0), 300, None);
        let drives = drives(loose.len(), 1.0, 0.45);
        run(&mut settled, &drives, 100, None);
        run(&mut settled, &drives, spans, Some(&name));
    }
}

fn run(bed: &mut Bed, drives: &[Drive], spans: u64, name: Option<&str>) {
    let mut impulses = vec![Vec3::zeros(); drives.len()];
    let work = bed.work;
    bed.deepest = 0.0;
    let clock = Clock::start();
    for _ in 0..spans {
        bed.drive(drives, SPAN, &mut impulses)
            .expect("the bed stays where it is");
    }
    let time = clock.seconds();
    let Some(name) = name else { return };
    let per_span = |now: u64, before: u64| (now - before) as f64 / spans as f64;
    let sub_steps = (bed.work.sub_steps - work.sub_steps) as f64;
    println!(
        "BENCH driven_{name} {:.4} ms/span, {:.3e} particle-sub-steps/s",
        1e3 * time / spans as f64,
        sub_steps / time
    );
    println!(
        "flights per span {:.0}, grains sub-stepped {:.0}, pairs {:.0}, lists {:.2}, repeats {:.2}, \
         greatest overlap {:.4} of d",
        per_span(bed.work.flights, work.flights),
        sub_steps / spans as f64 / (SPAN / STEP).round(),
        per_span(bed.work.pairs, work.pairs) / (SPAN / STEP).round(),
        per_span(bed.work.lists, work.lists),
        per_span(bed.work.repeats, work.repeats),
        bed.deepest
    );
}

/// Stokes' drag over ε^2.7 and Archimedes.
fn drives(count: usize, viscosity: f64, porosity: f64) -> Vec<Drive> {
    let drive = Drive {
        drag: 3.0 * PI * 0.89e-3 * viscosity * DIAMETER * f64::powf(porosity, -2.7),
        flow: Vec3::zeros(),
        force: Vec3::new(0.0, 0.0, PI / 6.0 * DIAMETER.powi(3) * 1000.0 * 9.81),
    };
    vec![drive; count]
}

/// Grains put one after the other where none is yet.
fn suspension() -> Vec<Grain> {
    let count = (SOLIDS * SIZE.iter().product::<f64>() / (PI / 6.0 * DIAMETER.powi(3))).round() as usize;
    let body = Body::sphere(DIAMETER, 2500.0);
    let cells = SIZE.map(|side| (side / DIAMETER) as usize);
    let mut members = vec![Vec::<Vec3>::new(); cells.iter().product()];
    let mut random = Random::new(3);
    let mut grains = Vec::new();
    while grains.len() < count {
        let place = Vec3::new(
            random.between(0.0, SIZE[0]),
            random.between(0.0, SIZE[1]),
            random.between(0.5 * DIAMETER, SIZE[2] - 0.5 * DIAMETER),
        );
        let home = [0, 1, 2].map(|axis| (place[axis] / SIZE[axis] * cells[axis] as f64) as usize);
        let cell = |at: [usize; 3]| (at[2] * cells[1] + at[1]) * cells[0] + at[0];
        let free = (0..27).all(|i| {
            let at = [i % 3, i / 3 % 3, i / 9];
            let at = [0, 1, 2].map(|axis| (home[axis] + cells[axis] + at[axis] - 1) % cells[axis]);
            members[cell(at)].iter().all(|other| {
                let mut way = place - other;
                for axis in 0..2 {
                    way[axis] -= SIZE[axis] * (way[axis] / SIZE[axis]).round();
                }
                way.norm() > DIAMETER
            })
        });
        if free {
            members[cell(home)].push(place);
            grains.push(Grain {
                body,
                class: 0,
                position: place,
                velocity: Vec3::from_fn(|_, _| random.between(-1e-3, 1e-3)),
                angular_velocity: Vec3::zeros(),
            });
        }
    }
    grains
}

/// A shaken lattice that falls together to a bed.
fn loose(count: usize) -> Vec<Grain> {
    let mut random = Random::new(4);
    let per_side = (SIZE[0] / (1.15 * DIAMETER)) as usize;
    let pitch = Vec3::new(SIZE[0], SIZE[1], 1.02 * DIAMETER * per_side as f64) / per_side as f64;
    let grain = |i: usize| {
        let cell = [i % per_side, i / per_side % per_side, i / per_side / per_side];
        let corner = Vec3::from_fn(|axis, _| pitch[axis] * (cell[axis] as f64 + 0.5));
        let play = DIAMETER * 0.07;
        let shaken = Vec3::new(random.between(-play, play), random.between(-play, play), 0.0);
        Grain {
            body: Body::sphere(DIAMETER, 2500.0),
            class: 0,
            position: corner + shaken,
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
        }
    };
    (0..count).map(grain).collect()
}

fn smooth() -> Laws {
    Laws {
        normal: AnyNormal::Linear(LinearSpringDashpot::with_restitution(STIFFNESS, RESTITUTION)),
        tangential: AnyTangential::None,
        rolling: AnyRolling::None,
    }
}

fn friction() -> Laws {
    Laws {
        tangential: AnyTangential::CundallStrack(CundallStrack {
            stiffness: 2.0 / 7.0 * STIFFNESS,
            damping: 0.0,
            friction: 0.3,
        }),
        rolling: AnyRolling::Resistance(RollingResistance { friction: 0.002 }),
        ..smooth()
    }
}

fn bed(grains: &[Grain], laws: Laws, flights: bool) -> Bed {
    let body = grains[0].body;
    let reach = Attraction {
        van_der_waals: Some(VanDerWaals {
            hamaker: 1e-300,
            smallest_gap: 1e-9,
            cut_off_gap: DIAMETER,
        }),
        walls: false,
        charge: None,
    };
    let interaction = Interaction {
        laws,
        attraction: (!flights).then_some(reach),
        couple: Some(Couple::new(&body, &body)),
        period: [SIZE[0], SIZE[1], 0.0],
        time_step: STEP,
    };
    let surroundings = Surroundings {
        gravity: 9.81,
        fluid_density: 0.0,
        viscosity: 0.0,
        drag: None,
        lift: false,
        stream: None,
        shear_lift: false,
    };
    let floor = Wall {
        normal: Vec3::z(),
        point: Vec3::zeros(),
    };
    Bed::new(
        Grains::new(grains, &[]),
        &[floor],
        interaction,
        surroundings,
        Listing::Skin(None),
        None,
    )
}
