//! The sweep over eight pairs against one pair after the other, and contacts at rest.

mod exchange;
mod oracle;
mod registers;
mod rest;
mod sweep;

use super::{Attraction, Bed, Charge, Grain, Grains, Interaction, Laws, Listing, Surroundings, Wall};
use crate::cohesion::{Coulomb, VanDerWaals};
use crate::contact::normal::effective_modulus;
use crate::contact::{
    AnyNormal, AnyRolling, AnyTangential, Body, CundallStrack, EffectiveMass, HaffWerner, HertzLiteral,
    HertzTsuji, HertzViscoelastic, LinearSpringDashpot, Mindlin, RollingResistance, SlipLimit,
};
use crate::math::{Random, Vec3};

const STEP: f64 = 1e-6;
/// Side of the box that holds the cloud [m]: a whole number of them makes a metre.
const SIDE: f64 = 6.25e-4;

const SPACE: Surroundings = Surroundings {
    gravity: 0.0,
    fluid_density: 0.0,
    viscosity: 0.0,
    drag: None,
    lift: false,
    stream: None,
    shear_lift: false,
};

fn normals() -> Vec<AnyNormal> {
    let modulus = effective_modulus(1e6, 0.29);
    let linear = LinearSpringDashpot::with_restitution(20.0, 0.6);
    vec![
        AnyNormal::Linear(linear),
        AnyNormal::Linear(LinearSpringDashpot {
            effective_mass: EffectiveMass::Arithmetic,
            ..linear
        }),
        AnyNormal::Viscoelastic(HertzViscoelastic {
            effective_modulus: modulus,
            damping_time: 5e-6,
        }),
        AnyNormal::Tsuji(HertzTsuji::with_restitution(modulus, 0.7)),
        AnyNormal::Literal(HertzLiteral {
            effective_modulus: modulus,
            damping: 0.1,
        }),
    ]
}

fn tangentials() -> Vec<AnyTangential> {
    let mindlin = Mindlin {
        friction: 0.3,
        poisson_ratio: 0.29,
        slip_limit: SlipLimit::Correct,
    };
    vec![
        AnyTangential::None,
        AnyTangential::HaffWerner(HaffWerner {
            damping: 1e-3,
            friction: 0.4,
        }),
        AnyTangential::CundallStrack(CundallStrack {
            stiffness: 15.0,
            damping: 1e-4,
            friction: 0.5,
        }),
        AnyTangential::Mindlin(mindlin),
        AnyTangential::Mindlin(Mindlin {
            slip_limit: SlipLimit::Literal,
            ..mindlin
        }),
    ]
}

/// Every normal law with every tangential and every rolling law.
fn all_laws() -> Vec<Laws> {
    let rollings = [
        AnyRolling::None,
        AnyRolling::Resistance(RollingResistance { friction: 0.05 }),
    ];
    let mut laws = Vec::new();
    for normal in normals() {
        for tangential in tangentials() {
            laws.extend(rollings.map(|rolling| Laws {
                normal,
                tangential,
                rolling,
            }));
        }
    }
    laws
}

fn attraction() -> Attraction {
    Attraction {
        van_der_waals: Some(VanDerWaals {
            hamaker: 6.5e-19,
            smallest_gap: 1e-9,
            cut_off_gap: 2e-6,
        }),
        walls: true,
        charge: Some(Charge {
            law: Coulomb {
                relative_permittivity: 78.4,
            },
            charge: 2e-13,
            cut_off_gap: 4e-5,
        }),
    }
}

/// Grains that overlap a little, of sizes up to the double and three densities, in every state of
/// motion; `count` of them move, the rest is fixed.
fn cloud(count: usize, seed: u64) -> Grains {
    let mut random = Random::new(seed);
    let mut vector = |size: f64| Vec3::from_fn(|_, _| random.between(-size, size));
    let pitch = 0.25 * SIDE;
    let mut grains: Vec<Grain> = (0..64)
        .map(|i| {
            let corner = Vec3::new((i % 4) as f64, (i / 4 % 4) as f64, (i / 16) as f64);
            let radius = pitch * (0.5 + 0.17 * vector(1.0).x);
            Grain {
                body: Body::sphere(2.0 * radius, 1000.0 + 750.0 * (i % 3) as f64),
                class: 0,
                position: (corner + Vec3::repeat(0.5)) * pitch + vector(0.08 * pitch),
                velocity: vector(0.05),
                angular_velocity: vector(500.0),
            }
        })
        .collect();
    let fixed = grains.split_off(count);
    Grains::new(&grains, &fixed)
}

/// Six walls that the outer grains of the cloud press against, the first on the far side.
fn walls() -> Vec<Wall> {
    let (low, high) = (Vec3::repeat(0.02 * SIDE), Vec3::repeat(0.98 * SIDE));
    let mut walls = Vec::new();
    for normal in [Vec3::x(), Vec3::y(), Vec3::z()] {
        walls.push(Wall {
            normal: -normal,
            point: high,
        });
        walls.push(Wall { normal, point: low });
    }
    walls
}

fn interaction(laws: Laws) -> Interaction {
    Interaction {
        laws,
        attraction: None,
        couple: None,
        period: [0.0; 3],
        time_step: STEP,
    }
}

/// Contacts, attraction and friction at once.
fn busy_laws() -> Laws {
    Laws {
        normal: normals()[2],
        tangential: tangentials()[3],
        rolling: AnyRolling::Resistance(RollingResistance { friction: 0.05 }),
    }
}

fn bed(grains: Grains, walls: &[Wall], interaction: Interaction) -> Bed {
    Bed::new(grains, walls, interaction, SPACE, Listing::Skin(Some(0.1)), None)
}
