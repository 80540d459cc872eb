//! The same bits in every kind of register.

use super::encounters::{Encounters, Suspects};
use super::flight::Flights;
use super::sub_steps::KickSome;
use super::*;
use crate::bed::contacts::{Interaction, Laws};
use crate::bed::motion::Stride;
use crate::bed::{Grain, Grains, Listing, Surroundings};
use crate::contact::{AnyNormal, AnyRolling, AnyTangential, Body, LinearSpringDashpot};
use crate::math::Random;
#[cfg(target_arch = "x86_64")]
use crate::neighbours::{Avx2, Avx512};
use crate::neighbours::{Plain, Wide, WideWork};

const SPAN: f64 = 1e-4;

/// Forty-five grains at random, with drives from none to stiff.
fn cloud() -> (Bed, Vec<Drive>) {
    let mut random = Random::new(21);
    let mut vector = |size: f64| Vec3::from_fn(|_, _| random.between(-size, size));
    let grains: Vec<Grain> = (0..45)
        .map(|_| Grain {
            body: Body::sphere(1e-4 * (1.0 + 0.5 * vector(1.0).x), 2500.0),
            class: 0,
            position: vector(2.5e-4),
            velocity: vector(0.01),
            angular_velocity: vector(300.0),
        })
        .collect();
    let drives = (0..45).map(|i| Drive {
        drag: 1e-9 * f64::from(i * i * i) * 1e-3,
        flow: vector(0.02),
        force: vector(1e-8),
    });
    let drives = drives.collect();
    let interaction = Interaction {
        laws: Laws {
            normal: AnyNormal::Linear(LinearSpringDashpot::with_restitution(1.0, 0.6)),
            tangential: AnyTangential::None,
            rolling: AnyRolling::None,
        },
        attraction: None,
        couple: None,
        period: [7e-4, 0.0, 0.0],
        time_step: 5e-6,
    };
    let surroundings = Surroundings {
        gravity: 9.81,
        fluid_density: 1000.0,
        viscosity: 0.0,
        drag: None,
        lift: false,
        stream: None,
        shear_lift: false,
    };
    let grains = Grains::new(&grains, &[]);
    let listing = Listing::Skin(Some(2.0));
    (
        Bed::new(grains, &[], interaction, surroundings, listing, None),
        drives,
    )
}

fn bits<W: Wide>() -> Vec<u64> {
    let (mut bed, drives) = cloud();
    let count = bed.grains.motion.len();
    let [mut launches, mut flights] = [vec![Record::default(); count], vec![Record::default(); count]];
    let [fastest, change] = Flights {
        surroundings: &bed.surroundings,
        motion: &bed.grains.motion,
        number: &bed.grains.number,
        drives: &drives,
        launches: &mut launches[..45],
        flights: &mut flights[..45],
        span: SPAN,
    }
    .run::<W>();
    let mut found = Vec::new();
    Suspects {
        encounters: Encounters {
            interaction: &bed.interaction,
            motion: &bed.grains.motion,
            flights: &flights,
            span: SPAN,
            floor: 1e-7,
        },
        change,
        blocks: &bed.pairs.blocks,
        first: 1,
        found: &mut found,
    }
    .run::<W>();
    assert!(
        found.len() > 2 && found.len() < bed.pairs.blocks.len() - 2,
        "{}",
        found.len()
    );
    let places: Vec<u32> = (0..45).filter(|place| place % 3 > 0).collect();
    let some: Vec<[u32; LANES]> = places
        .chunks(LANES)
        .map(|chunk| std::array::from_fn(|lane| chunk.get(lane).copied().unwrap_or(45)))
        .collect();
    let fastest_kicked = KickSome {
        motion: &mut bed.grains.motion,
        spin: &mut bed.grains.spin,
        forces: &mut bed.forces,
        launches: &mut launches,
        some: &some,
        stride: Stride {
            kick: 5e-6,
            drift: 5e-6,
            limit: 10.0,
        },
        turn: true,
    }
    .run::<W>();
    let records = [
        &launches,
        &flights,
        &bed.grains.motion,
        &bed.grains.spin,
        &bed.forces,
    ];
    let numbers = records
        .into_iter()
        .flatten()
        .flat_map(|record| record.0)
        .chain([fastest, change, fastest_kicked])
        .chain(found.into_iter().map(f64::from));
    numbers.map(f64::to_bits).collect()
}

#[test]
fn all_registers_fly_and_kick_to_the_same_bits() {
    let plain = bits::<Plain>();
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx2") {
            assert!(bits::<Avx2>() == plain);
        }
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
            assert!(bits::<Avx512>() == plain);
        }
    }
    assert!(plain.iter().all(|bits| f64::from_bits(*bits).is_finite()));
}
