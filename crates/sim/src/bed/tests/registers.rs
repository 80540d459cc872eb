//! The same bits in every kind of register, and as one number at a time.

use super::oracle::{Oracle, summed};
use super::*;
use crate::bed::Stream;
use crate::bed::contacts::PairSweep;
use crate::bed::motion::{KickAndDrift, Stride};
use crate::bed::walls::WallSweep;
use crate::contact::Couple;
use crate::drag::{AnyDrag, AnyVoidage, SphereDrag};
#[cfg(target_arch = "x86_64")]
use crate::neighbours::{Avx2, Avx512};
use crate::neighbours::{Plain, Record, Wide, WideWork};

/// Forces of pairs and walls and one kick with drag, three times over.
fn bits<W: Wide>(interaction: Interaction, walls: &[Wall], drag: AnyDrag, flows: bool) -> Vec<u64> {
    let mut bed = bed(cloud(61, 5), walls, interaction);
    let surroundings = Surroundings {
        gravity: 9.81,
        fluid_density: 1000.0,
        viscosity: 1e-3,
        drag: Some(drag),
        lift: flows,
        stream: flows.then_some(Stream {
            mean: 0.1,
            bottom: 0.0,
            height: 0.8 * SIDE,
        }),
        shear_lift: flows,
    };
    for spin in &mut bed.grains.spin {
        (spin.0[4], spin.0[5], spin.0[6]) = (0.7, 1e-3, 1e-9);
    }
    let mut numbers = Vec::new();
    for _ in 0..3 {
        bed.forces.fill(Record::default());
        let deepest = PairSweep {
            interaction: &bed.interaction,
            grains: &bed.grains,
            pairs: bed.pairs.whole(),
            elapsed: STEP,
            sink: &mut bed.forces[..],
        }
        .run::<W>();
        let at_walls = WallSweep {
            interaction: &bed.interaction,
            grains: &bed.grains,
            walls: &mut bed.walls,
            elapsed: STEP,
            forces: &mut bed.forces,
        }
        .run::<W>();
        numbers.extend([deepest, at_walls]);
        numbers.extend(bed.forces[..64].iter().flat_map(|force| force.0));
        let moving = bed.grains.moving;
        let fastest = KickAndDrift {
            surroundings: &surroundings,
            motion: &mut bed.grains.motion[..moving],
            spin: &mut bed.grains.spin[..moving],
            forces: &mut bed.forces[..moving],
            stride: Stride {
                kick: STEP,
                drift: STEP,
                limit: 1e3,
            },
        }
        .run::<W>();
        assert!(fastest.is_finite());
        numbers.push(fastest);
        numbers.extend(bed.grains.motion[..64].iter().flat_map(|record| record.0));
        numbers.extend(bed.grains.spin[..64].iter().flat_map(|record| record.0));
    }
    numbers.into_iter().map(f64::to_bits).collect()
}

#[test]
fn all_registers_give_the_same_bits_under_every_law() {
    let spheres = [
        SphereDrag::Stokes,
        SphereDrag::Dallavalle,
        SphereDrag::SchillerNaumann,
    ];
    let voidages = [AnyVoidage::None, AnyVoidage::DiFelice, AnyVoidage::AlvimLiteral];
    for (case, laws) in all_laws().into_iter().enumerate() {
        let drag = AnyDrag {
            sphere: spheres[case % 3],
            voidage: voidages[case / 3 % 3],
        };
        let interaction = Interaction {
            attraction: (case % 2 == 0).then(attraction),
            ..interaction(laws)
        };
        let flows = case % 5 < 2;
        let plain = bits::<Plain>(interaction, &walls(), drag, flows);
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                assert!(
                    bits::<Avx2>(interaction, &walls(), drag, flows) == plain,
                    "{laws:?}"
                );
            }
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                assert!(
                    bits::<Avx512>(interaction, &walls(), drag, flows) == plain,
                    "{laws:?}"
                );
            }
        }
        assert!(plain.iter().all(|bits| f64::from_bits(*bits).is_finite()));
    }
}

#[test]
fn pairs_on_their_own_have_the_bits_of_one_number_at_a_time() {
    let body = Body::sphere(2e-4, 2500.0);
    let mut random = Random::new(8);
    let grains: Vec<Grain> = (0..26)
        .map(|i| Grain {
            body,
            class: 0,
            position: Vec3::new(1e-3 * f64::from(i / 2), 1.97e-4 * f64::from(i % 2), 0.0)
                + Vec3::from_fn(|_, _| random.between(0.0, 1e-6)),
            velocity: Vec3::from_fn(|_, _| random.between(-0.05, 0.05)),
            angular_velocity: Vec3::from_fn(|_, _| random.between(-500.0, 500.0)),
        })
        .collect();
    for laws in all_laws() {
        let interaction = Interaction {
            couple: Some(Couple::new(&body, &body)),
            ..interaction(laws)
        };
        let mut bed = bed(Grains::new(&grains, &[]), &[], interaction);
        let mut oracle = Oracle::default();
        oracle.efforts(&bed, &[], 0.0);
        for _ in 0..10 {
            bed.move_on(STEP, STEP).expect("no grain leaps");
            bed.sum_forces(STEP);
            let expected = oracle.efforts(&bed, &[], STEP);
            // Which of two comes first is a matter of the list, and signs of zeros are none.
            assert!(summed(&bed) == expected, "{laws:?}");
        }
        assert_eq!(oracle.contacts, 13);
    }
}
