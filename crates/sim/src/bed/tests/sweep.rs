//! Eight lanes against the oracle.

use super::oracle::{Oracle, kept, summed};
use super::*;
use crate::contact::Couple;
use crate::math::Vector;

/// Fixed grains in the cloud.
const FIXED: usize = 5;

/// Follows a bed for some steps and holds every force and history to the oracle's. Returns the
/// greatest number of contacts.
fn follow(grains: Grains, walls: &[Wall], interaction: Interaction, steps: u32) -> usize {
    let mut bed = bed(grains, walls, interaction);
    let mut oracle = Oracle::default();
    let mut contacts = 0;
    let mut expected = oracle.efforts(&bed, walls, 0.0);
    for step in 0..=steps {
        compare(&bed, &oracle, &expected);
        contacts = contacts.max(oracle.contacts);
        let fastest = bed.move_on(STEP, STEP).expect("no grain leaps");
        bed.slack -= fastest * STEP;
        if bed.slack < 0.0 || step % 3 == 1 {
            bed.renew_lists(fastest);
        }
        bed.sum_forces(STEP);
        expected = oracle.efforts(&bed, walls, STEP);
    }
    contacts
}

fn compare(bed: &Bed, oracle: &Oracle, expected: &[[Vec3; 2]]) {
    let laws = bed.interaction.laws;
    for (end, name) in ["force", "torque"].into_iter().enumerate() {
        let most = expected
            .iter()
            .map(|effort| effort[end].norm())
            .fold(0.0, f64::max);
        for (number, (found, expected)) in summed(bed).iter().zip(expected).enumerate() {
            let error = (found[end] - expected[end]).norm();
            assert!(
                error <= 1e-12 * most,
                "{name} on grain {number}: {} for {}, {laws:?}",
                found[end],
                expected[end]
            );
        }
    }
    assert!((bed.deepest - oracle.deepest).abs() <= 1e-12 * oracle.deepest);
    let kept = kept(bed);
    let longest = oracle
        .histories
        .values()
        .map(|way| way.norm())
        .fold(0.0, f64::max);
    for (names, way) in &oracle.histories {
        let found = kept.get(names).copied().unwrap_or(Vector::zeros());
        let error = (found - *way).norm();
        assert!(
            error <= 1e-12 * longest,
            "{names:?}: {found:?} for {way:?}, {laws:?}"
        );
    }
    let remembered = oracle.histories.values().filter(|way| way.norm() > 0.0).count();
    assert_eq!(kept.len(), remembered, "{laws:?}");
}

#[test]
fn agrees_with_one_pair_after_the_other_in_open_space_under_every_law() {
    for (seed, laws) in all_laws().into_iter().enumerate() {
        let contacts = follow(cloud(64 - FIXED, seed as u64), &[], interaction(laws), 6);
        assert!(contacts > 40, "{contacts}");
    }
}

#[test]
fn agrees_across_periodic_sides_under_every_law() {
    for (seed, laws) in all_laws().into_iter().enumerate() {
        let interaction = Interaction {
            period: [SIDE, SIDE, if seed % 2 == 0 { SIDE } else { 0.0 }],
            ..interaction(laws)
        };
        let contacts = follow(cloud(64, seed as u64), &[], interaction, 6);
        assert!(contacts > 60, "{contacts}");
    }
}

#[test]
fn agrees_between_walls_under_every_law() {
    for (seed, laws) in all_laws().into_iter().enumerate() {
        let contacts = follow(cloud(64 - FIXED, seed as u64), &walls(), interaction(laws), 6);
        assert!(contacts > 60, "{contacts}");
    }
}

#[test]
fn agrees_with_attraction_between_walls_and_across_periodic_sides() {
    for (seed, laws) in all_laws().into_iter().enumerate().step_by(7) {
        let attracting = Interaction {
            attraction: Some(attraction()),
            ..interaction(laws)
        };
        follow(cloud(64 - FIXED, seed as u64), &walls(), attracting, 6);
        let periodic = Interaction {
            period: [SIDE; 3],
            ..attracting
        };
        follow(cloud(63, seed as u64), &[], periodic, 6);
    }
}

#[test]
fn grains_of_a_tenth_of_the_size_are_no_exception() {
    let mut random = Random::new(11);
    let mut grain = |radius: f64, position: Vec3| Grain {
        body: Body::sphere(2.0 * radius, 2500.0),
        class: 0,
        position: position + Vec3::repeat(0.45 * SIDE),
        velocity: Vec3::from_fn(|_, _| random.between(-0.05, 0.05)),
        angular_velocity: Vec3::from_fn(|_, _| random.between(-500.0, 500.0)),
    };
    let large = 1e-4;
    let mut grains = vec![grain(large, Vec3::zeros()), grain(large, Vec3::x() * 1.99e-4)];
    // A shell of small ones around the first large one, pressed a little into it.
    for i in 0..100 {
        let height = 1.0 - 2.0 * (f64::from(i) + 0.5) / 100.0;
        let turn = 2.399_963 * f64::from(i);
        let flat = f64::sqrt(1.0 - height * height);
        let direction = Vec3::new(flat * turn.cos(), flat * turn.sin(), height);
        // Room for the other large one.
        if direction.x < 0.8 {
            grains.push(grain(0.1 * large, direction * 1.095 * large));
        }
    }
    let contacts = follow(Grains::new(&grains, &[]), &walls(), interaction(busy_laws()), 10);
    assert!(contacts > 80, "{contacts}");
}

#[test]
fn equal_grains_may_share_one_couple() {
    let mut grains = cloud(64, 3);
    let body = Body::sphere(0.25 * SIDE, 2500.0);
    for (motion, spin) in grains.motion[..64].iter_mut().zip(&mut grains.spin) {
        (motion.0[3], motion.0[7], spin.0[3]) = (body.radius, 1.0 / body.mass, 1.0 / body.inertia);
    }
    let shared = Interaction {
        couple: Some(Couple::new(&body, &body)),
        period: [SIDE; 3],
        ..interaction(busy_laws())
    };
    assert!(follow(grains, &[], shared, 10) > 60);
}
