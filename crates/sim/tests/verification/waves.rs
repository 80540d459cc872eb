//! Waves of known decay and frequency in the particle fluid, at half height, far from floor and top.

use std::f64::consts::PI;

use kynch_sim::fluid::{Continuity, EquationOfState, FluidParticles, Numerics};

use crate::scenes::order;

/// Side of the periodic cross-section and wavelength [m].
const LENGTH: f64 = 4e-3;
const DENSITY: f64 = 1000.0;
/// Small enough that the lattice does not change.
const SPEED: f64 = 1e-9;

/// A cube and a half of fluid at `count` spacings per wavelength.
fn fluid(count: u32, viscosity: f64, sound_speed: f64) -> FluidParticles {
    let numerics = Numerics {
        spacing: LENGTH / f64::from(count),
        viscosity,
        artificial: 0.0,
        bulk: 0.0,
        lucy: false,
        gravity: 0.0,
        continuity: Continuity::MixtureFlux,
        state: EquationOfState {
            density: DENSITY,
            sound_speed,
        },
    };
    FluidParticles::lattice(numerics, LENGTH, 1.5 * LENGTH)
}

fn step(fluid: &mut FluidParticles, dt: f64) {
    fluid.kick_and_drift(dt);
    fluid.sum_rates(0.5 * dt);
    fluid.kick(dt);
}

/// Sets u_x to a sine of the coordinate `along`, x or y.
fn excite(fluid: &mut FluidParticles, along: usize) {
    for a in 0..fluid.len() {
        fluid.velocity[a].x = SPEED * (2.0 * PI / LENGTH * fluid.position[a][along]).sin();
    }
    fluid.sum_rates(0.0);
}

/// Amplitude of that sine over the one set, in the two layers next to half height.
fn amplitude(fluid: &FluidParticles, along: usize) -> f64 {
    let middle = 0.75 * LENGTH;
    let near = (0..fluid.len()).filter(|&a| (fluid.position[a].z - middle).abs() < fluid.numerics.spacing);
    let (sum, count) = near.fold((0.0, 0u32), |(sum, count), a| {
        let sine = (2.0 * PI / LENGTH * fluid.position[a][along]).sin();
        (sum + 2.0 * fluid.velocity[a].x * sine, count + 1)
    });
    sum / f64::from(count) / SPEED
}

/// Amplitude of a shear wave u_x(y) after νk²t = 0.16.
fn sheared(count: u32, steps: u32) -> f64 {
    let viscosity = 1e-3;
    // Sound plays no part: nothing is compressed.
    let mut fluid = fluid(count, viscosity, 1e-6);
    excite(&mut fluid, 1);
    let time = 0.16 * DENSITY / viscosity * (LENGTH / (2.0 * PI)).powi(2);
    (0..steps).for_each(|_| step(&mut fluid, time / f64::from(steps)));
    amplitude(&fluid, 1)
}

#[test]
fn a_shear_wave_decays_by_viscosity_at_second_order_in_the_spacing() {
    let error = |count: u32| (sheared(count, count * count / 16) / (-0.16_f64).exp() - 1.0).abs();
    let errors = [8, 16, 32].map(error);
    let orders = [order(errors[0], errors[1], 2.0), order(errors[1], errors[2], 2.0)];
    assert!((orders[0] - 2.0).abs() < 0.2, "{orders:?} of {errors:?}");
    assert!(errors[2] < 2e-3, "{errors:?}");
}

#[test]
fn the_fluid_step_is_of_second_order_in_time_under_viscosity() {
    let amplitudes = [8, 16, 32].map(|steps| sheared(8, steps));
    let observed = order(
        (amplitudes[0] - amplitudes[1]).abs(),
        (amplitudes[1] - amplitudes[2]).abs(),
        2.0,
    );
    assert!((observed - 2.0).abs() < 0.2, "{observed}");
}

/// First zero of a standing compression wave u_x(x), over the quarter period of sound.
fn quarter_period(count: u32, courant: f64) -> f64 {
    let sound_speed = 1.0;
    let mut fluid = fluid(count, 0.0, sound_speed);
    excite(&mut fluid, 0);
    let quarter = 0.25 * LENGTH / sound_speed;
    let dt = courant * fluid.numerics.smoothing() / sound_speed;
    let (mut before, mut time) = (amplitude(&fluid, 0), 0.0);
    loop {
        step(&mut fluid, dt);
        let now = amplitude(&fluid, 0);
        if now <= 0.0 {
            return (time + dt * before / (before - now)) / quarter;
        }
        assert!(time < 2.0 * quarter, "the wave does not swing");
        (before, time) = (now, time + dt);
    }
}

#[test]
fn a_standing_compression_wave_swings_with_the_sound_speed() {
    let errors = [8, 16, 32].map(|count| quarter_period(count, 0.1) - 1.0);
    let orders = [order(errors[0], errors[1], 2.0), order(errors[1], errors[2], 2.0)];
    assert!((orders[0] - 2.0).abs() < 0.3, "{orders:?} of {errors:?}");
    assert!(errors[2].abs() < 0.015, "{errors:?}");
}
