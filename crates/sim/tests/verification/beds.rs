//! Beds of grains: what must hold of them whatever they do.

mod conservation;
mod extremes;
mod fluid;
mod friction;
mod identity;
mod restitution;

use kynch_sim::bed::{Bed, Grain, Grains, Interaction, Laws, Listing, Porosity, Surroundings, Wall};
use kynch_sim::contact::normal::effective_modulus;
use kynch_sim::contact::{
    AnyNormal, AnyRolling, AnyTangential, Body, CundallStrack, EffectiveMass, HaffWerner, HertzLiteral,
    HertzTsuji, HertzViscoelastic, LinearSpringDashpot, Mindlin, RollingResistance, SlipLimit,
};
use kynch_sim::math::{Random, Vec3};

pub const SPACE: Surroundings = Surroundings {
    gravity: 0.0,
    fluid_density: 0.0,
    viscosity: 0.0,
    drag: None,
    lift: false,
    stream: None,
    shear_lift: false,
};

/// E* of soft glass [Pa].
pub fn modulus() -> f64 {
    effective_modulus(1e6, 0.29)
}

/// One damped law of every kind.
pub fn normals() -> [AnyNormal; 4] {
    [
        AnyNormal::Linear(LinearSpringDashpot::with_restitution(20.0, 0.6)),
        AnyNormal::Viscoelastic(HertzViscoelastic {
            effective_modulus: modulus(),
            damping_time: 5e-6,
        }),
        AnyNormal::Tsuji(HertzTsuji::with_restitution(modulus(), 0.7)),
        AnyNormal::Literal(HertzLiteral {
            effective_modulus: modulus(),
            damping: 0.1,
        }),
    ]
}

/// The laws without their damping.
pub fn elastic_normals() -> [AnyNormal; 2] {
    [
        AnyNormal::Linear(LinearSpringDashpot {
            stiffness: 20.0,
            damping_ratio: 0.0,
            effective_mass: EffectiveMass::Reduced,
        }),
        AnyNormal::Viscoelastic(HertzViscoelastic {
            effective_modulus: modulus(),
            damping_time: 0.0,
        }),
    ]
}

pub fn tangentials(friction: f64) -> [AnyTangential; 4] {
    [
        AnyTangential::None,
        AnyTangential::HaffWerner(HaffWerner {
            damping: 1e-3,
            friction,
        }),
        AnyTangential::CundallStrack(CundallStrack {
            stiffness: 15.0,
            damping: 1e-4,
            friction,
        }),
        AnyTangential::Mindlin(Mindlin {
            friction,
            poisson_ratio: 0.29,
            slip_limit: SlipLimit::Correct,
        }),
    ]
}

pub fn rolling(friction: f64) -> AnyRolling {
    AnyRolling::Resistance(RollingResistance { friction })
}

/// Every normal law with every tangential law, with and without rolling resistance.
pub fn all_laws() -> Vec<Laws> {
    let mut laws = Vec::new();
    for normal in normals() {
        for tangential in tangentials(0.3) {
            for rolling in [AnyRolling::None, rolling(0.05)] {
                laws.push(Laws {
                    normal,
                    tangential,
                    rolling,
                });
            }
        }
    }
    laws
}

pub fn smooth(normal: AnyNormal) -> Laws {
    Laws {
        normal,
        tangential: AnyTangential::None,
        rolling: AnyRolling::None,
    }
}

/// What a bed is made of.
#[derive(Clone)]
pub struct Setup {
    pub grains: Vec<Grain>,
    pub fixed: Vec<Grain>,
    pub walls: Vec<Wall>,
    pub interaction: Interaction,
    pub surroundings: Surroundings,
    pub listing: Listing,
    pub porosity: Option<Porosity>,
}

impl Setup {
    /// Grains in empty open space.
    pub fn new(grains: Vec<Grain>, laws: Laws, time_step: f64) -> Setup {
        Setup {
            grains,
            fixed: Vec::new(),
            walls: Vec::new(),
            interaction: Interaction {
                laws,
                attraction: None,
                couple: None,
                period: [0.0; 3],
                time_step,
            },
            surroundings: SPACE,
            listing: Listing::Skin(None),
            porosity: None,
        }
    }

    pub fn bed(&self) -> Bed {
        Bed::new(
            Grains::new(&self.grains, &self.fixed),
            &self.walls,
            self.interaction,
            self.surroundings,
            self.listing,
            self.porosity.clone(),
        )
    }

    /// The bed after some steps.
    pub fn after(&self, steps: u64) -> Bed {
        let mut bed = self.bed();
        bed.advance(steps).expect("no grain leaps");
        bed
    }
}

/// A grain at rest.
pub fn grain(diameter: f64, density: f64, position: Vec3) -> Grain {
    Grain {
        body: Body::sphere(diameter, density),
        class: 0,
        position,
        velocity: Vec3::zeros(),
        angular_velocity: Vec3::zeros(),
    }
}

/// `count` grains of up to the double in size that fly about in a cube of this side [m] without
/// touching yet.
pub fn gas(count: usize, side: f64, seed: u64) -> Vec<Grain> {
    let mut random = Random::new(seed);
    let per_side = (count as f64).cbrt().ceil() as usize;
    let pitch = side / per_side as f64;
    (0..count)
        .map(|i| {
            let cell = [i % per_side, i / per_side % per_side, i / per_side / per_side];
            let corner = Vec3::from_fn(|axis, _| cell[axis] as f64 + 0.5);
            let diameter = pitch * random.between(0.45, 0.9);
            Grain {
                position: corner * pitch + Vec3::from_fn(|_, _| pitch * random.between(-0.05, 0.05)),
                velocity: Vec3::from_fn(|_, _| random.between(-0.1, 0.1)),
                angular_velocity: Vec3::from_fn(|_, _| random.between(-500.0, 500.0)),
                ..grain(diameter, 1000.0 + 500.0 * (i % 4) as f64, Vec3::zeros())
            }
        })
        .collect()
}

/// The six walls of a cube.
pub fn cube(side: f64) -> Vec<Wall> {
    let mut walls = Vec::new();
    for normal in [Vec3::x(), Vec3::y(), Vec3::z()] {
        walls.push(Wall {
            normal,
            point: Vec3::zeros(),
        });
        walls.push(Wall {
            normal: -normal,
            point: Vec3::repeat(side),
        });
    }
    walls
}

/// Position, velocity, angular velocity of all grains, by their numbers.
pub fn states(bed: &Bed) -> Vec<[Vec3; 3]> {
    let grains = &bed.grains;
    let state = |place: u32| {
        let place = place as usize;
        [
            grains.position(place),
            grains.velocity(place),
            grains.angular_velocity(place),
        ]
    };
    grains.places().into_iter().map(state).collect()
}
