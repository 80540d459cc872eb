//! The weights between grains and fluid by what they do.

use super::*;
use crate::fluid::{Continuity, EquationOfState, Numerics};
use crate::neighbours::{Plain, WideWork};

fn fluid() -> FluidParticles {
    let state = EquationOfState {
        density: 1000.0,
        sound_speed: 1.0,
    };
    let numerics = Numerics {
        spacing: 0.1,
        viscosity: 1e-3,
        artificial: 0.0,
        bulk: 0.0,
        lucy: false,
        gravity: 0.0,
        continuity: Continuity::MixtureFlux,
        state,
    };
    FluidParticles::lattice(numerics, 1.0, 1.2)
}

/// Scattered grains, some of them next to a periodic side.
fn grains() -> Vec<Vec3> {
    let share = |i: usize, step: f64| (0.5 + i as f64 * step).fract();
    (0..40)
        .map(|i| Vec3::new(share(i, 0.819), share(i, 0.671), 0.3 + 0.6 * share(i, 0.549)))
        .collect()
}

/// Grains of two sizes, each with its own length.
fn sizes() -> Vec<GrainSize> {
    let size = |i: usize| GrainSize {
        diameter: [0.05, 0.06][i % 2],
        length: [0.15, 0.18][i % 2],
    };
    (0..40).map(size).collect()
}

fn volume() -> f64 {
    sizes().iter().map(GrainSize::volume).sum()
}

fn falling() -> Vec<Vec3> {
    vec![Vec3::new(0.0, 0.0, -1.0); 40]
}

fn over(fluid: &FluidParticles, position: &[Vec3], floor_images: bool) -> Exchange {
    let rules = ExchangeRules {
        sharpening: Sharpening::SECOND_ORDER,
        floor_images,
        cut: 2.0,
    };
    let mut exchange = Exchange::new(sizes(), rules, fluid, position);
    exchange.refresh(fluid, 0.0, position, &falling());
    exchange
}

fn exchange(fluid: &FluidParticles) -> Exchange {
    over(fluid, &grains(), false)
}

/// What all fluid particles together know of a sum over the grains.
fn all(fluid: &FluidParticles, values: &[f64]) -> f64 {
    (0..fluid.len()).map(|a| values[a] * fluid.volume(a)).sum()
}

fn samples(exchange: &Exchange, fields: &[Field]) -> Vec<Field> {
    let mut means = Vec::new();
    exchange.sample_all(fields, &mut means);
    means
}

#[test]
fn a_constant_field_is_sampled_exactly_and_an_impulse_arrives_whole() {
    let fluid = fluid();
    let exchange = exchange(&fluid);
    let constant = Field::new(Vec3::new(1.0, -2.0, 3.0), Vec3::repeat(4.0), 0.5, 7.0);
    let fields = vec![constant; fluid.len()];
    let mut impulses = vec![[0.0; 4]; fluid.len()];
    let given: Vec<Vec3> = grains().iter().map(|x| x - Vec3::repeat(0.5)).collect();
    for mean in samples(&exchange, &fields) {
        assert!((mean.velocity() - constant.velocity()).norm() < 1e-14);
    }
    let numbers: Vec<[f64; 4]> = given.iter().map(|i| [i.x, i.y, i.z, 0.0]).collect();
    exchange.spread(&numbers, &mut impulses);
    let arrived = impulses
        .iter()
        .fold(Vec3::zeros(), |sum, i| sum + Vec3::new(i[0], i[1], i[2]));
    assert!((arrived - given.iter().sum::<Vec3>()).norm() < 1e-14);
}

#[test]
fn each_grain_finds_its_own_row_among_all() {
    let fluid = fluid();
    let exchange = exchange(&fluid);
    let fields: Vec<Field> = (fluid.position.iter())
        .map(|x| Field::new(*x, Vec3::zeros(), 1.0, 0.0))
        .collect();
    for (grain, mean) in grains().iter().zip(samples(&exchange, &fields)) {
        let mean = mean.velocity();
        // Away from the periodic sides the mean position is that of the grain.
        if (grain - Vec3::new(0.5, 0.5, grain.z)).amax() < 0.15 && (grain.z - 0.6).abs() < 0.2 {
            assert!((mean - grain).norm() < 0.02, "{grain}");
        }
    }
}

#[test]
fn solids_flux_and_surface_of_all_particles_are_those_of_the_grains() {
    let fluid = fluid();
    let solids = exchange(&fluid).solids;
    let volume = volume();
    let held = all(&fluid, &solids.fraction);
    assert!((held / volume - 1.0).abs() < 5e-3, "{held}");
    let surface: f64 = sizes().iter().map(|size| size.volume() / size.diameter).sum();
    assert!((all(&fluid, &solids.surface) / surface - 1.0).abs() < 5e-3);
    for (flux, fraction) in solids.flux.iter().zip(&solids.fraction) {
        assert_eq!(*flux, Vec3::new(0.0, 0.0, -fraction));
    }
}

#[test]
fn next_to_the_floor_a_grain_gives_all_its_volume_and_no_flux_through_it() {
    let fluid = fluid();
    let low: Vec<Vec3> = grains().iter().map(|x| Vec3::new(x.x, x.y, 0.06)).collect();
    let cut = all(&fluid, &over(&fluid, &low, false).solids.fraction) / volume();
    let mirrored = over(&fluid, &low, true).solids;
    let whole = all(&fluid, &mirrored.fraction) / volume();
    assert!(cut < 0.8, "{cut}");
    assert!((whole - 1.0).abs() < 5e-3, "{whole}");
    // The lowest layer is at half a spacing.
    let lowest: Vec<usize> = (0..fluid.len()).filter(|&a| fluid.position[a].z < 0.06).collect();
    let through = |a: usize| mirrored.flux[a].z / mirrored.fraction[a];
    let mean = lowest.iter().map(|&a| through(a)).sum::<f64>() / lowest.len() as f64;
    assert!(mean.abs() < 0.4, "{mean}");
}

#[test]
fn the_rate_of_the_solids_is_how_they_change_when_the_grains_move() {
    let fluid = fluid();
    let dt = 1e-6;
    for floor_images in [false, true] {
        let low: Vec<Vec3> = grains().iter().map(|x| Vec3::new(x.x, x.y, 0.5 * x.z)).collect();
        let here = over(&fluid, &low, floor_images).solids;
        let moved: Vec<Vec3> = low.iter().map(|x| x - Vec3::new(0.0, 0.0, dt)).collect();
        let later = over(&fluid, &moved, floor_images).solids;
        for a in 0..fluid.len() {
            let change = (later.fraction[a] - here.fraction[a]) / dt;
            let rate = 0.5 * (later.rate[a] + here.rate[a]);
            assert!((change - rate).abs() < 1e-7, "{change} {rate}");
        }
    }
}

#[test]
fn a_grain_that_crosses_a_periodic_side_keeps_its_row() {
    let fluid = fluid();
    let shifted = |x: f64| -> Vec<Vec3> {
        let place = |g: &Vec3| Vec3::new((g.x + x).rem_euclid(1.0), g.y, g.z);
        grains().iter().map(place).collect()
    };
    // Far less than the skin, yet across the side for those next to it.
    let moved = shifted(0.02);
    assert!(moved.iter().zip(&grains()).any(|(now, before)| now.x < before.x));
    let mut carried = exchange(&fluid);
    carried.refresh(&fluid, 0.0, &moved, &falling());
    assert_eq!(carried.collections, 1);
    let anew = over(&fluid, &moved, false);
    for a in 0..fluid.len() {
        assert!((carried.solids.fraction[a] - anew.solids.fraction[a]).abs() < 1e-14);
    }
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let fluid = fluid();
    let low: Vec<Vec3> = grains().iter().map(|x| Vec3::new(x.x, x.y, 0.5 * x.z)).collect();
    let dispatched = over(&fluid, &low, true);
    let mut plain = over(&fluid, &low, true);
    plain.weights.clear(plain.candidates.len_padded());
    plain.sums.fill(Record::default());
    let work = sums::Weigh {
        exchange: &mut plain,
        position: &low,
        velocity: &falling(),
        width: fluid.width,
    };
    WideWork::run::<Plain>(work);
    for (plain, dispatched) in plain.sums.iter().zip(&dispatched.sums) {
        assert_eq!(plain.0, dispatched.0);
    }
    for row in 0..grains().len() {
        assert!(plain.weights.row(row).eq(dispatched.weights.row(row)));
    }
    let fields: Vec<Field> = (fluid.position.iter())
        .map(|x| Field::new(*x, -x, 0.9, 2.0))
        .collect();
    let mut means = vec![Field::default(); grains().len()];
    WideWork::run::<Plain>(Sample {
        weights: &plain.weights,
        fields: &fields,
        order: &plain.order,
        means: &mut means,
    });
    for (plain, dispatched) in means.iter().zip(samples(&dispatched, &fields)) {
        assert_eq!(plain.0, dispatched.0);
    }
}

#[test]
fn the_visiting_order_names_every_grain_once() {
    let fluid = fluid();
    let mut order = exchange(&fluid).order;
    order.sort_unstable();
    assert!(order.into_iter().eq(0..grains().len() as u32));
}
