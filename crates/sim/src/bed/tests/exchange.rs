//! Grains that come and go change nothing for those who stay.

use super::*;

/// Far over the cloud, where no wall is.
fn stranger(height: f64) -> Grain {
    Grain {
        body: Body::sphere(1e-4, 2000.0),
        class: 3,
        position: Vec3::new(0.5 * SIDE, 0.5 * SIDE, height),
        velocity: Vec3::new(0.0, 0.01, 0.0),
        angular_velocity: Vec3::zeros(),
    }
}

fn busy() -> Bed {
    bed(cloud(61, 5), &walls()[..4], interaction(busy_laws()))
}

/// Position and velocity of a number.
fn state(bed: &Bed, number: u32) -> [Vec3; 2] {
    let place = bed.grains.places()[number as usize] as usize;
    [bed.grains.position(place), bed.grains.velocity(place)]
}

fn assert_same(one: &Bed, other: &Bed, names: impl Fn(u32) -> u32, count: u32) {
    for number in 0..count {
        let [x, v] = state(one, number);
        let [y, w] = state(other, names(number));
        assert!((x - y).norm() < 1e-11 * SIDE, "{number}: {x:?} {y:?}");
        assert!((v - w).norm() < 1e-9 * (0.01 + v.norm()), "{number}: {v:?} {w:?}");
    }
}

#[test]
fn an_exchange_of_nobody_keeps_forces_and_histories() {
    let (mut left, mut alone) = (busy(), busy());
    for _ in 0..8 {
        left.advance(10).unwrap();
        left.exchange(&[], &[]);
        alone.advance(10).unwrap();
        // The same pauses: half a kick before and after.
        assert_same(&left, &alone, |number| number, 64);
    }
}

#[test]
fn strangers_come_unnoticed() {
    let (mut visited, mut alone) = (busy(), busy());
    for visits in 1..6_u32 {
        visited.advance(10).unwrap();
        alone.advance(10).unwrap();
        visited.exchange(&[], &[stranger(f64::from(4 + visits) * SIDE)]);
        let moving: u32 = 61 + visits;
        assert_eq!(visited.grains.moving, moving as usize);
        let place = visited.grains.places()[moving as usize - 1] as usize;
        assert_eq!(
            (visited.grains.class[place], visited.grains.radius(place)),
            (3, 5e-5)
        );
        // Fixed grains follow the moving ones.
        let name = |number| if number < 61 { number } else { number + visits };
        assert_same(&alone, &visited, name, 64);
    }
}

#[test]
fn who_leaves_is_no_longer_felt_and_numbers_close_up() {
    let mut bed = busy();
    bed.advance(5).unwrap();
    let before: Vec<[Vec3; 2]> = (0..64).map(|number| state(&bed, number)).collect();
    bed.exchange(&[7, 20], &[stranger(5.0 * SIDE), stranger(7.0 * SIDE)]);
    assert_eq!((bed.grains.moving, bed.grains.len()), (61, 64));
    let mut numbers = bed.grains.number.clone();
    numbers.sort_unstable();
    assert!(numbers.iter().copied().eq(0..64));
    let stayed: Vec<[Vec3; 2]> = (0..61)
        .filter(|number| ![7, 20].contains(number))
        .map(|number| before[number])
        .collect();
    for (number, kept) in stayed.iter().enumerate() {
        assert_eq!(state(&bed, number as u32), *kept);
    }
    assert!(bed.contacts().pairs.iter().flatten().all(|place| {
        let number = bed.grains.number[*place as usize];
        !(59..61).contains(&number)
    }));
    bed.advance(20).unwrap();
    assert!(bed.momentum_error() < 1e-14);
}

#[test]
fn an_empty_bed_fills() {
    let mut bed = bed(Grains::new(&[], &[]), &[], interaction(busy_laws()));
    bed.advance(3).unwrap();
    bed.exchange(&[], &[stranger(0.0), stranger(SIDE)]);
    bed.advance(10).unwrap();
    let [x, v] = state(&bed, 1);
    assert!((x.y - 0.5 * SIDE - 10.0 * STEP * 0.01).abs() < 1e-12 && v.y == 0.01);
    bed.exchange(&[0, 1], &[]);
    assert!(bed.grains.is_empty());
    bed.advance(3).unwrap();
}
