//! The weights between grains and fluid by what they do.

use super::*;
use crate::fluid::{Continuity, EquationOfState, Numerics};

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

const VOLUME: f64 = 1e-4;

fn exchange(fluid: &FluidParticles) -> Exchange {
    let mut exchange = Exchange::new(0.15, Sharpening::SECOND_ORDER, fluid, &grains());
    exchange.refresh(fluid, &grains(), VOLUME, Vec3::new(0.0, 0.0, -1.0));
    exchange
}

#[test]
fn a_constant_field_is_sampled_exactly_and_an_impulse_arrives_whole() {
    let fluid = fluid();
    let exchange = exchange(&fluid);
    let constant = Field::new(Vec3::new(1.0, -2.0, 3.0), Vec3::repeat(4.0), 0.5);
    let fields = vec![constant; fluid.len()];
    let mut impulses = vec![[0.0; 4]; fluid.len()];
    let given: Vec<Vec3> = grains().iter().map(|x| x - Vec3::repeat(0.5)).collect();
    for (i, impulse) in given.iter().enumerate() {
        exchange.spread(i, [impulse.x, impulse.y, impulse.z, 0.0], &mut impulses);
        let mean = exchange.sample(i, &fields);
        assert!((mean.velocity() - constant.velocity()).norm() < 1e-14);
    }
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
        .map(|x| Field::new(*x, Vec3::zeros(), 1.0))
        .collect();
    for (i, grain) in grains().iter().enumerate() {
        let mean = exchange.sample(i, &fields).velocity();
        // Away from the periodic sides the mean position is that of the grain.
        if (grain - Vec3::new(0.5, 0.5, grain.z)).amax() < 0.15 && (grain.z - 0.6).abs() < 0.2 {
            assert!((mean - grain).norm() < 0.02, "{grain}");
        }
    }
}

#[test]
fn solids_of_all_particles_are_the_volume_of_the_grains() {
    let fluid = fluid();
    let exchange = exchange(&fluid);
    let solids: f64 = (0..fluid.len())
        .map(|a| exchange.solids[a] * fluid.volume(a))
        .sum();
    assert!((solids / (40.0 * VOLUME) - 1.0).abs() < 5e-3, "{solids}");
}

#[test]
fn the_rate_of_the_solids_is_how_they_change_when_the_grains_move() {
    let fluid = fluid();
    let (here, dt) = (exchange(&fluid), 1e-6);
    let moved: Vec<Vec3> = grains().iter().map(|x| x - Vec3::new(0.0, 0.0, dt)).collect();
    let mut later = exchange(&fluid);
    later.refresh(&fluid, &moved, VOLUME, Vec3::new(0.0, 0.0, -1.0));
    for a in 0..fluid.len() {
        let change = (later.solids[a] - here.solids[a]) / dt;
        let rate = 0.5 * (later.solids_rate[a] + here.solids_rate[a]);
        assert!((change - rate).abs() < 1e-7, "{change} {rate}");
    }
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let fluid = fluid();
    let dispatched = exchange(&fluid);
    let mut plain = exchange(&fluid);
    plain.weights.clear(plain.candidates.len_padded());
    plain.sums.fill([0.0; 2]);
    plain.weigh_wide::<Plain>(&grains(), VOLUME);
    for (a, sums) in plain.sums.iter().enumerate() {
        assert_eq!(*sums, [dispatched.solids[a], dispatched.solids_rate[a]]);
    }
    for i in 0..grains().len() {
        assert_eq!(plain.weights.row(i), dispatched.weights.row(i));
    }
}

#[test]
fn the_visiting_order_names_every_grain_once() {
    let fluid = fluid();
    let mut order = exchange(&fluid).order().to_vec();
    order.sort_unstable();
    assert!(order.into_iter().eq(0..grains().len() as u32));
}
