//! Speed of beds of grains: prints `BENCH bed_<grains> <rate> particle-steps/s` on one core.
//!
//! ```text
//! cargo bench -p kynch-sim --bench beds -- BEDFILE [--walls] [--steps N] [--rolling | --no-rolling]
//! ```
//!
//! A bed file holds `width depth height` and then `x y z radius` of every grain, in metres. Hertz
//! contacts with Mindlin friction, damping time 20 µs, Stokes drag, six rigid walls. A settled bed first
//! runs the same steps untimed, since its contacts begin without history. Without a file a loose lattice is
//! dropped. The time is that of the processor, where the system tells it.
//!
//! With `--driven` the beds of `driven.rs` run instead.

mod driven;

use std::time::Instant;

use kynch_sim::bed::{Bed, Grain, Grains, Interaction, Listing, Surroundings, Wall};
use kynch_sim::contact::normal::effective_modulus;
use kynch_sim::contact::{
    AnyNormal, AnyRolling, AnyTangential, Body, ContactLaws, Couple, HertzViscoelastic, Mindlin,
    RollingResistance, SlipLimit,
};
use kynch_sim::drag::{AnyDrag, AnyVoidage, SphereDrag};
use kynch_sim::math::Vec3;

const DENSITY: f64 = 2460.0;
const FLUID_DENSITY: f64 = 1005.1;
const VISCOSITY: f64 = 1e-3;
const STEP: f64 = 1e-5;

fn main() {
    if std::env::args().any(|argument| argument == "--driven") {
        return driven::main();
    }
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench")
        .collect();
    let steps = arguments
        .iter()
        .position(|argument| argument == "--steps")
        .and_then(|at| arguments.get(at + 1)?.parse().ok())
        .unwrap_or(500);
    let rolling = !arguments.iter().any(|argument| argument == "--no-rolling");
    let walls = arguments.iter().any(|argument| argument == "--walls");
    let file = arguments.first().filter(|argument| !argument.starts_with("--"));
    let (size, spheres) = match file {
        Some(path) => read(path),
        None => loose(),
    };
    let mut bed = bed(size, &spheres, walls || file.is_none(), rolling);
    if !bed.contacts().pairs.is_empty() {
        bed.advance(steps).expect("the bed stays where it is");
    }
    let work = bed.work;
    let clock = Clock::start();
    bed.advance(steps).expect("the bed stays where it is");
    let time = clock.seconds();
    let count = spheres.len();
    println!(
        "BENCH bed_{count} {:.4e} particle-steps/s",
        (count as u64 * steps) as f64 / time
    );
    println!(
        "pairs per grain {:.2}, lists made {}, greatest overlap {:.4} of d",
        (bed.work.pairs - work.pairs) as f64 / (steps as f64 * count as f64),
        bed.work.lists - work.lists,
        bed.deepest
    );
}

/// Time of this thread on the processor; the time of day where the system does not tell it.
struct Clock {
    processor: Option<f64>,
    day: Instant,
}

impl Clock {
    fn start() -> Clock {
        Clock {
            processor: processor_time(),
            day: Instant::now(),
        }
    }

    fn seconds(&self) -> f64 {
        match (self.processor, processor_time()) {
            (Some(start), Some(end)) => end - start,
            _ => self.day.elapsed().as_secs_f64(),
        }
    }
}

fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? * 1e-9)
}

/// Sides of the box, and position and radius of every grain [m].
fn read(path: &str) -> (Vec3, Vec<(Vec3, f64)>) {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut rows = text.lines().map(|line| {
        let numbers: Vec<f64> = line
            .split_whitespace()
            .map(|word| word.parse().expect("a number"))
            .collect();
        numbers
    });
    let size = rows.next().expect("a first line with the sides of the box");
    let spheres = rows
        .map(|row| (Vec3::new(row[0], row[1], row[2]), row[3]))
        .collect();
    (Vec3::new(size[0], size[1], size[2]), spheres)
}

/// A thousand grains at a solids fraction of 13 per cent.
fn loose() -> (Vec3, Vec<(Vec3, f64)>) {
    let size = Vec3::new(2.5e-3, 2.5e-3, 10e-3);
    let place = |i: usize, side: f64, count: f64| side * (i as f64 + 0.5) / count;
    let spheres = (0..1000)
        .map(|i| {
            let shaken = 1.0 + 0.02 * ((i * 7919 % 1000) as f64 / 1000.0 - 0.5);
            let centre = Vec3::new(
                place(i % 7, size.x, 7.0) * shaken,
                place(i / 7 % 7, size.y, 7.0) * shaken,
                place(i / 49, size.z, 21.0),
            );
            (centre, 1.25e-4)
        })
        .collect();
    (size, spheres)
}

fn bed(size: Vec3, spheres: &[(Vec3, f64)], walls: bool, rolling: bool) -> Bed {
    let grains: Vec<Grain> = spheres
        .iter()
        .map(|&(position, radius)| Grain {
            body: Body::sphere(2.0 * radius, DENSITY),
            class: 0,
            position,
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
        })
        .collect();
    let wall = |normal: Vec3, point: Vec3| Wall { normal, point };
    let zero = Vec3::zeros();
    let planes = [
        wall(Vec3::x(), zero),
        wall(-Vec3::x(), size),
        wall(Vec3::y(), zero),
        wall(-Vec3::y(), size),
        wall(Vec3::z(), zero),
        wall(-Vec3::z(), size),
    ];
    let body = grains[0].body;
    let interaction = Interaction {
        laws: ContactLaws {
            normal: AnyNormal::Viscoelastic(HertzViscoelastic {
                effective_modulus: effective_modulus(1e6, 0.29),
                damping_time: 2e-5,
            }),
            tangential: AnyTangential::Mindlin(Mindlin {
                friction: 0.3,
                poisson_ratio: 0.29,
                slip_limit: SlipLimit::Correct,
            }),
            rolling: if rolling {
                AnyRolling::Resistance(RollingResistance { friction: 0.002 })
            } else {
                AnyRolling::None
            },
        },
        attraction: None,
        couple: Some(Couple::new(&body, &body)),
        period: [0.0; 3],
        time_step: STEP,
    };
    let surroundings = Surroundings {
        gravity: 9.81,
        fluid_density: FLUID_DENSITY,
        viscosity: VISCOSITY,
        drag: Some(AnyDrag {
            sphere: SphereDrag::Stokes,
            voidage: AnyVoidage::None,
        }),
        lift: false,
    };
    let planes = if walls { &planes[..] } else { &[] };
    Bed::new(
        Grains::new(&grains, &[]),
        planes,
        interaction,
        surroundings,
        Listing::Skin(None),
        None,
    )
}
