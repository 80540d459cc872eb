//! Momentum, angular momentum and energy.

use kynch_sim::bed::{Attraction, Bed, Charge, Laws, Listing};
use kynch_sim::cohesion::{Coulomb, VanDerWaals};
use kynch_sim::contact::{AnyNormal, Body, Contact, NormalLaw};
use kynch_sim::math::Vec3;

use super::{Setup, all_laws, cube, elastic_normals, gas, rolling, smooth, tangentials};

const SIDE: f64 = 6e-4;
const STEP: f64 = 1e-6;

/// Momentum [N s] and angular momentum [N m s], and the sums of their parts' sizes.
fn momenta(bed: &Bed) -> [(Vec3, f64); 2] {
    let grains = &bed.grains;
    let mut sums = [(Vec3::zeros(), 0.0); 2];
    for i in 0..grains.len() {
        let linear = grains.velocity(i) * grains.mass(i);
        let spin = grains.angular_velocity(i) * grains.inertia(i);
        let orbit = grains.position(i).cross(&linear);
        for (sum, part) in [(0, linear), (1, spin), (1, orbit)] {
            sums[sum].0 += part;
            sums[sum].1 += part.norm();
        }
    }
    sums
}

fn keeps_momenta(setup: &Setup, steps: u64) {
    let mut bed = setup.bed();
    let before = momenta(&bed);
    bed.advance(steps).expect("no grain leaps");
    let after = momenta(&bed);
    assert!(bed.deepest > 1e-3, "nobody met anybody");
    for (name, end) in [("momentum", 0), ("angular momentum", 1)] {
        let error = (after[end].0 - before[end].0).norm() / before[end].1;
        assert!(error < 2e-14, "{name}: {error:e}, {:?}", setup.interaction.laws);
    }
}

/// A cloud that falls in on itself.
fn collapsing(laws: Laws, seed: u64) -> Setup {
    let mut grains = gas(64, SIDE, seed);
    for grain in &mut grains {
        grain.velocity -= (grain.position - Vec3::repeat(0.5 * SIDE)) * 500.0;
    }
    Setup::new(grains, laws, STEP)
}

#[test]
fn a_cloud_of_unequal_grains_keeps_momentum_and_angular_momentum_under_every_law() {
    for (seed, laws) in all_laws().into_iter().enumerate() {
        keeps_momenta(&collapsing(laws, seed as u64), 1000);
    }
}

#[test]
fn attraction_keeps_them_as_well() {
    let mut setup = collapsing(all_laws()[31], 3);
    setup.interaction.attraction = Some(Attraction {
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
    });
    keeps_momenta(&setup, 1000);
}

/// Elastic energy of a contact without damping [J]: the force integrated over the overlap.
fn stored(law: AnyNormal, overlap: f64, reduced_radius: f64) -> f64 {
    let force = law.force(&Contact {
        overlap,
        rate: 0.0,
        reduced_mass: 1.0,
        mean_mass: 1.0,
        reduced_radius,
    });
    let share = if matches!(law, AnyNormal::Linear(_)) {
        0.5
    } else {
        0.4
    };
    share * force * overlap
}

fn kinetic(bed: &Bed) -> f64 {
    let grains = &bed.grains;
    let energy = |i: usize| {
        0.5 * grains.mass(i) * grains.velocity(i).norm_squared()
            + 0.5 * grains.inertia(i) * grains.angular_velocity(i).norm_squared()
    };
    (0..grains.len()).map(energy).sum()
}

/// Kinetic and elastic energy in a cube [J].
fn energy(bed: &Bed) -> f64 {
    let grains = &bed.grains;
    let law = bed.interaction.laws.normal;
    let contacts = bed.contacts();
    let pairs = contacts.pairs.iter().map(|pair| {
        let [i, j] = pair.map(|place| place as usize);
        let (a, b) = (grains.radius(i), grains.radius(j));
        let distance = (grains.position(i) - grains.position(j)).norm();
        stored(law, a + b - distance, a * b / (a + b))
    });
    let at_walls = contacts.walls.iter().map(|&(place, wall)| {
        let (place, wall) = (place as usize, cube(SIDE)[wall as usize]);
        let height = (grains.position(place) - wall.point).dot(&wall.normal);
        stored(law, grains.radius(place) - height, grains.radius(place))
    });
    kinetic(bed) + pairs.chain(at_walls).sum::<f64>()
}

#[test]
fn elastic_grains_keep_their_energy_for_a_million_steps() {
    for normal in elastic_normals() {
        let mut setup = Setup::new(gas(8, SIDE, 5), smooth(normal), 0.25 * STEP);
        setup.walls = cube(SIDE);
        setup.listing = Listing::Skin(Some(0.3));
        let mut bed = setup.bed();
        let start = energy(&bed);
        let mut worst = 0.0_f64;
        for _ in 0..1000 {
            bed.advance(1000).expect("no grain leaps");
            worst = worst.max((energy(&bed) / start - 1.0).abs());
        }
        assert!(bed.deepest > 1e-3);
        assert!(worst < 1e-3, "{worst:e} {normal:?}");
    }
}

/// Kinetic energies [J] at the instants at which nobody touches anything.
fn free_energies(laws: Laws) -> Vec<f64> {
    let mut setup = Setup::new(gas(4, SIDE, 9), laws, 0.5 * STEP);
    for grain in &mut setup.grains {
        grain.body = Body::sphere(grain.body.radius, 1500.0);
    }
    setup.walls = cube(SIDE);
    let mut bed = setup.bed();
    let mut energies = Vec::new();
    for _ in 0..4000 {
        bed.advance(20).expect("no grain leaps");
        let contacts = bed.contacts();
        if contacts.pairs.is_empty() && contacts.walls.is_empty() {
            energies.push(kinetic(&bed));
        }
    }
    energies
}

#[test]
fn collisions_take_energy_and_never_give_any() {
    let mut laws = all_laws();
    for normal in elastic_normals() {
        laws.extend(tangentials(0.3)[1..].iter().map(|&tangential| Laws {
            normal,
            tangential,
            rolling: rolling(0.05),
        }));
    }
    for laws in laws {
        let energies = free_energies(laws);
        assert!(energies.len() > 50, "{}", energies.len());
        let mut most = 0.0_f64;
        for pair in energies.windows(2) {
            most = most.max(pair[1] / pair[0] - 1.0);
        }
        let left = energies[energies.len() - 1] / energies[0];
        assert!(most < 1e-9 && left < 0.5, "{most:e} {left} {laws:?}");
    }
}
