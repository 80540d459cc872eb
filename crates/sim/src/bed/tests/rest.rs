//! Contacts of grains at rest.

use std::collections::BTreeMap;

use super::oracle::kept;
use super::*;
use crate::contact::{Body, Couple, Meeting, Motion, Touch};
use crate::drag::{AnyDrag, AnyVoidage, SphereDrag};
use crate::math::Vector;

const DIAMETER: f64 = 250e-6;

/// Normal and tangential force [N] of every contact between grains or with walls, by the names of the
/// partners.
fn forces(bed: &Bed, walls: &[Wall]) -> BTreeMap<[u32; 2], Vec3> {
    let grains = &bed.grains;
    let histories = kept(bed);
    let contacts = bed.contacts();
    let motion = |place: usize| Motion {
        position: grains.position(place).into(),
        velocity: grains.velocity(place).into(),
        angular_velocity: grains.angular_velocity(place).into(),
    };
    let body = |place: usize| Body::sphere(2.0 * grains.radius(place), 2460.0);
    let react = |touch: &Touch, names: [u32; 2]| {
        let history = histories.get(&names).copied().unwrap_or(Vector::zeros());
        let (reaction, _) = bed
            .interaction
            .laws
            .react(touch, history, 0.0, bed.interaction.time_step);
        (names, Vec3::from(reaction.force))
    };
    let pairs = contacts.pairs.iter().map(|pair| {
        let mut pair = *pair;
        pair.sort_by_key(|&place| grains.number[place as usize]);
        let [a, b] = pair.map(|place| place as usize);
        let touch = Touch::of_spheres([&body(a), &body(b)], [&motion(a), &motion(b)]);
        react(&touch, pair.map(|place| grains.number[place as usize]))
    });
    let at_walls = contacts.walls.iter().map(|&(place, number)| {
        let (wall, a) = (&walls[number as usize], place as usize);
        let height = (grains.position(a) - wall.point).dot(&wall.normal);
        let meeting = Meeting::of_sphere_and_wall(grains.radius(a), height, wall.normal.into());
        let still = Motion {
            position: wall.point.into(),
            velocity: Vector::zeros(),
            angular_velocity: Vector::zeros(),
        };
        let couple = Couple::new(&body(a), &Body::WALL);
        let touch = Touch::new(&couple, &meeting, [&motion(a), &still]);
        react(&touch, [grains.number[a], grains.len() as u32 + number])
    });
    pairs.chain(at_walls).collect()
}

fn grains(positions: impl Iterator<Item = Vec3>) -> Grains {
    let grains: Vec<Grain> = positions
        .map(|position| Grain {
            body: Body::sphere(DIAMETER, 2460.0),
            class: 0,
            position,
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
        })
        .collect();
    Grains::new(&grains, &[])
}

fn box_of(width: f64) -> Vec<Wall> {
    let wall = |normal: Vec3, point: Vec3| Wall { normal, point };
    let (near, far) = (Vec3::zeros(), Vec3::repeat(width));
    vec![
        wall(Vec3::z(), near),
        wall(Vec3::x(), near),
        wall(-Vec3::x(), far),
        wall(Vec3::y(), near),
        wall(-Vec3::y(), far),
    ]
}

fn settled(grains: Grains, walls: &[Wall], laws: Laws, steps: u64) -> Bed {
    let interaction = Interaction {
        time_step: 1e-5,
        ..interaction(laws)
    };
    // Grains come to rest in a thick fluid.
    let water = Surroundings {
        gravity: 9.81,
        fluid_density: 1000.0,
        viscosity: 1e-2,
        drag: Some(AnyDrag {
            sphere: SphereDrag::Stokes,
            voidage: AnyVoidage::None,
        }),
        lift: false,
        stream: None,
        shear_lift: false,
    };
    let mut bed = Bed::new(grains, walls, interaction, water, Listing::Skin(None), None);
    bed.advance(steps).expect("no grain leaps");
    bed
}

/// Greatest change of a contact force over the greatest force, after so many more steps.
fn change(bed: &mut Bed, walls: &[Wall], steps: u64) -> f64 {
    let before = forces(bed, walls);
    bed.advance(steps).expect("no grain leaps");
    let after = forces(bed, walls);
    let most = before.values().map(Vec3::norm).fold(0.0, f64::max);
    assert_eq!(
        before.keys().collect::<Vec<_>>(),
        after.keys().collect::<Vec<_>>(),
        "contacts come or go"
    );
    let changes = before.iter().map(|(names, force)| (after[names] - force).norm());
    changes.fold(0.0, f64::max) / most
}

fn glass(tangential: AnyTangential, rolling: AnyRolling) -> Laws {
    Laws {
        normal: AnyNormal::Viscoelastic(HertzViscoelastic {
            effective_modulus: effective_modulus(1e6, 0.29),
            damping_time: 2e-5,
        }),
        tangential,
        rolling,
    }
}

#[test]
fn a_column_of_grains_keeps_its_contact_forces_for_a_hundred_thousand_steps() {
    let walls = box_of(1.0);
    for tangential in tangentials() {
        let grains = grains((0..5).map(|i| Vec3::new(0.5, 0.5, DIAMETER * (f64::from(i) + 0.5))));
        let laws = glass(
            tangential,
            AnyRolling::Resistance(RollingResistance { friction: 0.002 }),
        );
        let mut bed = settled(grains, &walls, laws, 50_000);
        let change = change(&mut bed, &walls, 100_000);
        assert!(change < 1e-9, "{change:e} {tangential:?}");
    }
}

/// Comes to rest in jerks, short ones for the fast tremblings and long ones for the slow: Mindlin's
/// contact has no dashpot, and nothing stops a grain that spins between two contacts.
fn quenched(bed: &mut Bed) {
    for jerk in 0..80 {
        let grains = &mut bed.grains;
        for (motion, spin) in grains.motion.iter_mut().zip(&mut grains.spin) {
            motion.0[4..7].fill(0.0);
            spin.0[..3].fill(0.0);
        }
        bed.advance([30, 150, 600, 1800][jerk % 4])
            .expect("no grain leaps");
    }
}

/// Sixty grains in a box four and a bit wide.
fn poured(laws: Laws) -> (Bed, Vec<Wall>) {
    let walls = box_of(4.2 * DIAMETER);
    let mut random = Random::new(4);
    let positions = (0..60).map(|i| {
        let cell = Vec3::new((i % 4) as f64, (i / 4 % 4) as f64, (i / 16) as f64);
        let shaken = Vec3::from_fn(|_, _| random.between(0.55, 0.57));
        DIAMETER * (cell * 1.03 + shaken)
    });
    let bed = settled(grains(positions), &walls, laws, 40_000);
    (bed, walls)
}

/// Holds for so many steps after as many to come to rest in.
fn keeps_its_forces(tangential: AnyTangential, rolling: AnyRolling, steps: u64) {
    let (mut bed, walls) = poured(glass(tangential, rolling));
    quenched(&mut bed);
    bed.advance(steps).expect("no grain leaps");
    let change = change(&mut bed, &walls, steps);
    assert!(change < 1e-9, "{change:e} {tangential:?}");
}

#[test]
fn a_poured_bed_keeps_its_contact_forces_for_a_hundred_thousand_steps_without_friction() {
    keeps_its_forces(AnyTangential::None, AnyRolling::None, 100_000);
}

#[test]
fn and_with_viscous_friction_that_yields_by_nothing_in_that_time() {
    // A force F lets the contact creep at F/γ: its load is gone after γ/k, here 10¹² s.
    let friction = AnyTangential::HaffWerner(HaffWerner {
        damping: 1e12,
        friction: 0.4,
    });
    keeps_its_forces(friction, AnyRolling::None, 100_000);
}

#[test]
fn and_with_tangential_springs() {
    keeps_its_forces(tangentials()[2], AnyRolling::None, 100_000);
}

#[test]
fn and_with_the_contacts_of_mindlin() {
    keeps_its_forces(tangentials()[3], AnyRolling::None, 100_000);
}

// Resistance to rolling has no spring: what it holds creeps, and the bed yields with it.
#[test]
fn and_yields_slowly_with_resistance_to_rolling() {
    let rolling = AnyRolling::Resistance(RollingResistance { friction: 0.002 });
    let (mut bed, walls) = poured(glass(tangentials()[3], rolling));
    quenched(&mut bed);
    let change = change(&mut bed, &walls, 25_000);
    assert!(change < 1e-3, "{change:e}");
}
