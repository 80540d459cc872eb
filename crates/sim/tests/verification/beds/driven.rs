//! Grains driven by a fluid that is solved elsewhere.

use std::f64::consts::PI;

use kynch_sim::bed::{Bed, Drive, Grain, Laws, Listing, Wall};
use kynch_sim::contact::{AnyNormal, LinearSpringDashpot};
use kynch_sim::math::{Random, Vec3};

use super::{Setup, all_laws, grain, normals, rolling, smooth, states, tangentials};

const DIAMETER: f64 = 1e-4;
const DENSITY: f64 = 2500.0;
const GRAVITY: f64 = 9.81;
const STEP: f64 = 5e-6;
const SPAN: f64 = 1e-4;

fn mass(grain: &Grain) -> f64 {
    grain.body.mass
}

/// What Stokes' drag in water at rest and Archimedes do to each grain, `factor` times the drag.
fn water(grains: &[Grain], factor: f64) -> Vec<Drive> {
    let drive = |grain: &Grain| Drive {
        drag: factor * 6.0 * PI * 0.89e-3 * grain.body.radius,
        flow: Vec3::zeros(),
        force: Vec3::new(
            0.0,
            0.0,
            4.0 / 3.0 * PI * grain.body.radius.powi(3) * 1000.0 * GRAVITY,
        ),
    };
    grains.iter().map(drive).collect()
}

fn linear() -> AnyNormal {
    AnyNormal::Linear(LinearSpringDashpot::with_restitution(1.0, 0.6))
}

/// A random suspension of this solids fraction over a floor, periodic in x and y, of grains that move at
/// random; `sizes` are over the diameter.
fn suspension(counts: [usize; 3], solids: f64, speed: f64, sizes: &[f64], laws: Laws) -> Setup {
    let mut random = Random::new(11);
    let volume = sizes
        .iter()
        .map(|size| PI / 6.0 * (size * DIAMETER).powi(3))
        .sum::<f64>();
    let pitch = (volume / sizes.len() as f64 / solids).cbrt();
    let [a, b, c] = counts;
    let grains = (0..a * b * c).map(|i| {
        let cell = Vec3::new((i % a) as f64, (i / a % b) as f64, (i / a / b) as f64);
        let size = sizes[(i * 7919 % 104_729) % sizes.len()];
        let play = (0.5 * (pitch - size * DIAMETER)).max(0.0);
        Grain {
            position: (cell + Vec3::repeat(0.5)) * pitch + Vec3::from_fn(|_, _| random.between(-play, play)),
            velocity: Vec3::from_fn(|_, _| random.between(-speed, speed)),
            ..grain(size * DIAMETER, DENSITY, Vec3::zeros())
        }
    });
    let mut setup = Setup::new(grains.collect(), laws, STEP);
    setup.interaction.period = [a as f64 * pitch, b as f64 * pitch, 0.0];
    setup.walls = vec![Wall {
        normal: Vec3::z(),
        point: Vec3::zeros(),
    }];
    setup.surroundings.gravity = GRAVITY;
    setup
}

fn run(bed: &mut Bed, drives: &[Drive], spans: u32) -> Vec<Vec3> {
    let mut sum = vec![Vec3::zeros(); drives.len()];
    let mut impulses = sum.clone();
    for _ in 0..spans {
        bed.drive(drives, SPAN, &mut impulses).expect("no grain leaps");
        sum.iter_mut()
            .zip(&impulses)
            .for_each(|(sum, impulse)| *sum += impulse);
    }
    sum
}

#[test]
fn one_grain_falls_as_the_closed_form_says_over_any_span() {
    let grains = vec![grain(DIAMETER, DENSITY, Vec3::new(0.0, 0.0, 1.0))];
    for factor in [0.0, 1e-9, 1e-3, 1.0, 50.0, 1e4, 1e7] {
        let drives = water(&grains, factor);
        let rate = drives[0].drag / mass(&grains[0]);
        let weight = 0.6 * GRAVITY;
        for span in [1e-7, 1e-4, 3.3e-3, 0.1] {
            let mut setup = Setup::new(grains.clone(), smooth(normals()[0]), STEP);
            setup.surroundings.gravity = GRAVITY;
            let mut bed = setup.bed();
            let mut impulses = [Vec3::zeros()];
            bed.drive(&drives, span, &mut impulses).expect("no grain leaps");
            assert_eq!((bed.work.flights, bed.work.sub_steps), (1, 0));
            let x = rate * span;
            // Where the closed form cancels its series is as good.
            let (speed, way) = if x < 1e-4 {
                let (a, b) = (
                    1.0 - x / 2.0 + x * x / 6.0 - x * x * x / 24.0,
                    0.5 - x / 6.0 + x * x / 24.0,
                );
                (weight * span * a, weight * span * span * b)
            } else {
                let speed = weight / rate * -(-x).exp_m1();
                (speed, (weight * span - speed) / rate)
            };
            let found = -bed.grains.velocity(0).z;
            assert!((found / speed - 1.0).abs() < 1e-14, "{found:e} for {speed:e}");
            // Heights are known to the rounding of a metre, which the start is at.
            let fallen = 1.0 - bed.grains.position(0).z;
            let allowed = 4e-16 + 3e-12 * way;
            assert!(
                (fallen - way).abs() < allowed,
                "{fallen:e} for {way:e} at {factor} {span}"
            );
            let gained = mass(&grains[0]) * (GRAVITY * span - speed);
            assert!((impulses[0].z - gained).abs() < 1e-14 * mass(&grains[0]) * GRAVITY * span);
        }
    }
}

/// Sum of m v.
fn momentum(bed: &Bed) -> Vec3 {
    (0..bed.grains.len())
        .map(|i| bed.grains.velocity(i) * bed.grains.mass(i))
        .sum()
}

#[test]
fn momentum_of_grains_closes_to_rounding_under_all_laws() {
    for laws in all_laws() {
        let mut setup = suspension([6, 6, 6], 0.45, 0.02, &[1.0, 0.8, 1.2], laws);
        // Without a floor nobody but the fluid takes momentum.
        setup.walls.clear();
        let drives = water(&setup.grains, 3.0);
        let mut bed = setup.bed();
        let weight: f64 = setup.grains.iter().map(mass).sum::<f64>() * GRAVITY;
        for _ in 0..20 {
            let before = momentum(&bed);
            let given: Vec3 = run(&mut bed, &drives, 1).iter().sum();
            let open = momentum(&bed) - before - given + Vec3::new(0.0, 0.0, weight * SPAN);
            assert!(
                open.norm() < 1e-12 * weight * SPAN,
                "{:e}",
                open.norm() / weight / SPAN
            );
        }
        assert!(bed.work.sub_steps > 0 && bed.deepest > 1e-4);
    }
}

#[test]
fn each_grain_in_contact_gets_what_drag_gives_it() {
    // Pressed to the floor by the flow: no slip but the flow, all momentum goes to the floor.
    let grains = vec![grain(DIAMETER, DENSITY, Vec3::new(0.0, 0.0, 0.499 * DIAMETER))];
    let mut setup = Setup::new(grains.clone(), smooth(linear()), STEP);
    setup.walls = vec![Wall {
        normal: Vec3::z(),
        point: Vec3::zeros(),
    }];
    setup.surroundings.gravity = GRAVITY;
    let mut drives = water(&grains, 20.0);
    drives[0].flow = Vec3::new(1e-3, 0.0, -2e-3);
    let mut bed = setup.bed();
    run(&mut bed, &drives, 400);
    let impulse = run(&mut bed, &drives, 1)[0];
    let expected = (drives[0].force.z + drives[0].drag * -2e-3) * SPAN;
    assert!(
        (impulse.z / expected - 1.0).abs() < 1e-9,
        "{} {}",
        impulse.z,
        expected
    );
    assert!((bed.grains.velocity(0).x - 1e-3).abs() < 1e-9);
    assert!(impulse.x.abs() < 1e-9 * expected.abs());
}

/// Greatest difference of positions round periodic sides, over the diameter.
fn difference(a: &Bed, b: &Bed) -> f64 {
    states(a)
        .into_iter()
        .zip(states(b))
        .map(|(one, other)| a.nearest(one[0] - other[0]).norm() / DIAMETER)
        .fold(0.0, f64::max)
}

#[test]
fn flights_are_what_ever_smaller_sub_steps_come_to() {
    let setup = suspension([6, 6, 6], 0.1, 0.02, &[1.0], smooth(linear()));
    let drives = water(&setup.grains, 1.0);
    let mut errors = Vec::new();
    for refined in [1.0, 2.0, 4.0] {
        let mut setup = setup.clone();
        setup.interaction.time_step = STEP / refined;
        let mut bed = setup.bed();
        run(&mut bed, &drives, 10);
        // Attraction too weak to be felt makes everybody busy.
        setup.interaction.attraction = Some(nothing_far());
        let mut stepped = setup.bed();
        run(&mut stepped, &drives, 10);
        let flights = bed.work.flights;
        assert!(flights > 1000 && bed.deepest > 1e-3, "{flights}, {}", bed.deepest);
        assert_eq!(stepped.work.flights, 0);
        errors.push(difference(&bed, &stepped));
    }
    assert!(errors[0] < 1e-6, "{errors:?}");
    for pair in errors.windows(2) {
        assert!(pair[0] / pair[1] > 3.5, "{errors:?}");
    }
}

/// Attraction of a reach beyond every neighbour and of no strength.
fn nothing_far() -> kynch_sim::bed::Attraction {
    kynch_sim::bed::Attraction {
        van_der_waals: Some(kynch_sim::cohesion::VanDerWaals {
            hamaker: 1e-300,
            smallest_gap: 1e-9,
            cut_off_gap: 1.5 * DIAMETER,
        }),
        walls: false,
        charge: None,
    }
}

#[test]
fn no_contact_is_missed_among_fast_grains() {
    // At half a metre per second grains cross half a diameter in a span.
    for (speed, solids, spans) in [(0.05, 0.1, 20), (0.5, 0.1, 4), (0.5, 0.3, 2)] {
        let setup = suspension([5, 5, 5], solids, speed, &[1.0, 0.7], smooth(linear()));
        let drives = water(&setup.grains, 1.0);
        let mut busy = setup.clone();
        busy.interaction.attraction = Some(nothing_far());
        let (mut bed, mut reference) = (setup.bed(), busy.bed());
        run(&mut bed, &drives, spans);
        run(&mut reference, &drives, spans);
        assert!(reference.deepest > 1e-3);
        assert!(
            (bed.deepest / reference.deepest - 1.0).abs() < 1e-3,
            "{} for {}",
            bed.deepest,
            reference.deepest
        );
        assert!(
            difference(&bed, &reference) < 1e-3,
            "{}",
            difference(&bed, &reference)
        );
    }
}

#[test]
fn stiff_drag_does_not_limit_the_step() {
    let setup = suspension([4, 4, 8], 0.5, 0.01, &[1.0], all_laws()[5]);
    for factor in [1e2, 1e4, 1e6] {
        let drives = water(&setup.grains, factor);
        let rate = drives[0].drag / mass(&setup.grains[0]);
        let terminal = 0.6 * GRAVITY / rate;
        let mut bed = setup.bed();
        run(&mut bed, &drives, 100);
        for state in states(&bed) {
            assert!(state[1].norm() < 1.1 * terminal, "{} {terminal}", state[1]);
        }
        assert!(bed.deepest < 0.01, "{}", bed.deepest);
    }
}

#[test]
fn the_order_in_which_grains_are_given_changes_no_bit() {
    let laws = Laws {
        normal: linear(),
        tangential: tangentials(0.3)[2],
        rolling: rolling(0.02),
    };
    let setup = suspension([4, 4, 6], 0.3, 0.02, &[1.0, 0.8], laws);
    let drives = water(&setup.grains, 2.0);
    let mut bed = setup.bed();
    let reference_impulses = run(&mut bed, &drives, 100);
    let reference = states(&bed);
    let mut order: Vec<usize> = (0..setup.grains.len()).collect();
    Random::new(17).shuffle(&mut order);
    let shuffled = Setup {
        grains: order.iter().map(|&i| setup.grains[i]).collect(),
        ..setup.clone()
    };
    let mut bed = shuffled.bed();
    let drives: Vec<Drive> = order.iter().map(|&i| drives[i]).collect();
    let impulses = run(&mut bed, &drives, 100);
    assert!(bed.work.flights > 0 && bed.deepest > 0.0);
    let found = states(&bed);
    for (place, &number) in order.iter().enumerate() {
        assert_eq!(found[place], reference[number]);
        assert_eq!(impulses[place], reference_impulses[number]);
    }
}

#[test]
fn a_bed_under_steady_downward_flow_comes_to_rest() {
    let laws = Laws {
        normal: linear(),
        tangential: tangentials(0.3)[2],
        rolling: rolling(0.02),
    };
    let setup = suspension([5, 5, 6], 0.45, 0.0, &[1.0], laws);
    let mut drives = water(&setup.grains, 4.0);
    drives.iter_mut().for_each(|drive| drive.flow.z = -5e-3);
    let mut bed = setup.bed();
    run(&mut bed, &drives, 3000);
    let impulse: Vec3 = run(&mut bed, &drives, 1).iter().sum();
    let expected: f64 = drives.iter().map(|drive| drive.force.z - drive.drag * 5e-3).sum();
    for state in states(&bed) {
        assert!(state[1].norm() < 1e-6, "{}", state[1]);
    }
    assert!((impulse.z / (expected * SPAN) - 1.0).abs() < 1e-3);
    assert!(bed.deepest < 0.01);
}

#[test]
fn how_lists_are_made_is_no_part_of_the_result() {
    let mut setup = suspension([5, 5, 5], 0.2, 0.05, &[1.0, 0.6], smooth(linear()));
    let drives = water(&setup.grains, 1.0);
    let mut reference = setup.bed();
    run(&mut reference, &drives, 20);
    assert!(reference.deepest > 1e-3);
    for listing in [
        Listing::Skin(Some(0.02)),
        Listing::Skin(Some(0.5)),
        Listing::EveryStep(kynch_sim::neighbours::Search::BruteForce),
    ] {
        setup.listing = listing;
        let mut bed = setup.bed();
        run(&mut bed, &drives, 20);
        // Storage takes turns at other times, and with it the order of sums.
        let worst = difference(&bed, &reference);
        assert!(worst < 1e-3, "{worst:e} {listing:?}");
    }
}

#[test]
fn a_bed_goes_on_by_itself_after_it_was_driven() {
    let setup = suspension([5, 5, 5], 0.3, 0.05, &[1.0], smooth(linear()));
    let drives = water(&setup.grains, 1.0);
    for threads in [1, 2] {
        let mut bed = setup.bed().with_threads(threads);
        run(&mut bed, &drives, 2);
        // Forces of dashpots belong to the middle of a step: a bed that starts anew has others.
        while !(bed.contacts().pairs.is_empty() && bed.contacts().walls.is_empty()) {
            run(&mut bed, &drives, 1);
        }
        let mut grains = setup.grains.clone();
        for (grain, state) in grains.iter_mut().zip(states(&bed)) {
            (grain.position, grain.velocity) = (state[0], state[1]);
        }
        let mut fresh = Setup {
            grains,
            ..setup.clone()
        }
        .bed();
        bed.deepest = 0.0;
        for bed in [&mut bed, &mut fresh] {
            bed.advance(200).expect("no grain leaps");
        }
        assert!(bed.deepest > 1e-4, "{}", bed.deepest);
        assert!(difference(&bed, &fresh) < 1e-6, "{}", difference(&bed, &fresh));
    }
}

#[test]
fn sleepers_wake_when_they_are_driven() {
    let mut setup = suspension([4, 4, 2], 0.45, 0.0, &[1.0], all_laws()[3]);
    setup.surroundings.viscosity = 1e-3;
    let mut bed = setup.bed().with_sleeping();
    bed.advance(40_000).expect("no grain leaps");
    assert!(bed.asleep() > 0.2, "{}", bed.asleep());
    let mut drives = water(&setup.grains, 10.0);
    drives.iter_mut().for_each(|drive| drive.flow.z = 0.05);
    let before = states(&bed);
    run(&mut bed, &drives, 100);
    for (before, after) in before.iter().zip(states(&bed)) {
        assert!(after[0].z > before[0].z + DIAMETER);
    }
}
