//! Grains in a fluid that is not solved for.

use std::f64::consts::PI;

use kynch_sim::bed::{Bed, Grain, Porosity, Surroundings, Wall};
use kynch_sim::coupling::slices::Measure;
use kynch_sim::drag::{AnyDrag, AnyVoidage, SphereDrag};
use kynch_sim::math::Vec3;

use super::{Setup, all_laws, grain, normals, smooth, states};

const GRAVITY: f64 = 9.81;

fn water(viscosity: f64, sphere: SphereDrag, voidage: AnyVoidage) -> Surroundings {
    Surroundings {
        gravity: GRAVITY,
        fluid_density: 1000.0,
        viscosity,
        drag: Some(AnyDrag { sphere, voidage }),
        lift: false,
        stream: None,
        shear_lift: false,
    }
}

#[test]
fn one_grain_falls_as_stokes_says_at_every_viscosity() {
    let (diameter, density) = (250e-6, 2460.0);
    // From a motion that drag hardly feels to one it stops within a tenth of a step.
    for viscosity in [1e-5, 1e-3, 0.1, 10.0] {
        let relaxation = density * diameter * diameter / (18.0 * viscosity);
        let terminal = (density - 1000.0) * GRAVITY * diameter * diameter / (18.0 * viscosity);
        let dt = 1e-5;
        let mut setup = Setup::new(
            vec![grain(diameter, density, Vec3::zeros())],
            smooth(normals()[0]),
            dt,
        );
        setup.surroundings = water(viscosity, SphereDrag::Stokes, AnyVoidage::None);
        let mut bed = setup.bed();
        for steps in [1, 9, 90, 900, 9000] {
            bed.advance(steps).expect("no grain leaps");
            let time = bed.work.steps as f64 * dt;
            let expected = terminal * -(-time / relaxation).exp_m1();
            let speed = -bed.grains.velocity(0).z;
            assert!(
                (speed / expected - 1.0).abs() < 1e-10,
                "{speed:e} for {expected:e} at {viscosity}"
            );
            if dt < relaxation && steps > 9 {
                let way = terminal * (time + relaxation * (-time / relaxation).exp_m1());
                let error = -bed.grains.position(0).z / way - 1.0;
                // Of second order in the step over the relaxation time.
                let allowed = 1e-6 + 0.5 * (dt / relaxation).powi(2);
                assert!(error.abs() < allowed, "{error:e} at {viscosity}");
            }
        }
    }
}

#[test]
fn a_bed_in_honey_is_stable_at_the_step_of_its_contacts() {
    let diameter = 250e-6;
    let grains: Vec<Grain> = (0..40)
        .map(|i| {
            let cell = Vec3::new((i % 3) as f64, (i / 3 % 3) as f64, (i / 9) as f64);
            let tilt = Vec3::new(1e-3 * f64::from(i), 2e-3 * f64::from(i % 7), 0.52);
            grain(
                diameter,
                2460.0,
                diameter * (cell * 1.01 + tilt + Vec3::new(0.5, 0.5, 0.0)),
            )
        })
        .collect();
    let mut setup = Setup::new(grains, all_laws()[15], 1e-5);
    setup.walls = vec![Wall {
        normal: Vec3::z(),
        point: Vec3::zeros(),
    }];
    setup.surroundings = water(10.0, SphereDrag::Stokes, AnyVoidage::None);
    let terminal = 1460.0 * GRAVITY * diameter * diameter / 180.0;
    let mut bed = setup.bed();
    for _ in 0..20 {
        bed.advance(500).expect("no grain leaps");
        for state in states(&bed) {
            assert!(state[1].norm() < 1.01 * terminal, "{}", state[1]);
        }
    }
    assert!(bed.deepest < 0.01, "{}", bed.deepest);
}

/// Grains spread evenly over a box, without contacts, as one slice sees them.
fn suspension(size: Vec3, counts: [usize; 3], kinds: &[Grain], mixed: bool, closed: bool) -> Setup {
    let [a, b, c] = counts;
    let grains = (0..a * b * c).map(|i| {
        let cell = Vec3::new((i % a) as f64, (i / a % b) as f64, (i / a / b) as f64);
        let count = Vec3::new(a as f64, b as f64, c as f64);
        Grain {
            position: (cell + Vec3::repeat(0.5))
                .component_div(&count)
                .component_mul(&size),
            ..kinds[(i + i / a + i / a / b) % kinds.len()]
        }
    });
    let mut setup = Setup::new(grains.collect(), smooth(normals()[0]), 1e-4);
    setup.interaction.period = [size.x, size.y, 0.0];
    setup.porosity = Some(Porosity::new(
        size.z,
        size.x * size.y,
        Measure::Exact,
        closed,
        mixed,
        1e-3,
    ));
    setup
}

/// Mean downward speed [m/s] of a class.
fn falling(bed: &Bed, class: u16) -> f64 {
    let of_class = (0..bed.grains.len()).filter(|&grain| bed.grains.class[grain] == class);
    let speeds: Vec<f64> = of_class.map(|grain| -bed.grains.velocity(grain).z).collect();
    speeds.iter().sum::<f64>() / speeds.len() as f64
}

#[test]
fn return_flow_slows_a_closed_column_from_21_95_to_19_08_millimetres_per_second() {
    let size = Vec3::new(2.5e-3, 2.5e-3, 10e-3);
    for (closed, expected) in [(false, 21.95e-3), (true, 19.08e-3)] {
        let kinds = [grain(250e-6, 2460.0, Vec3::zeros())];
        let mut setup = suspension(size, [8, 5, 25], &kinds, false, closed);
        setup.surroundings = water(1e-3, SphereDrag::SchillerNaumann, AnyVoidage::DiFelice);
        let bed = setup.after(500);
        let speed = falling(&bed, 0);
        assert!((speed - expected).abs() < 0.006e-3, "{speed:e} for {expected:e}");
        let solids = 1000.0 * PI / 6.0 * 250e-6_f64.powi(3) / (size.x * size.y * size.z);
        for spin in &bed.grains.spin[..1000] {
            let [.., porosity, flow, _, _] = spin.0;
            assert!((porosity - (1.0 - solids)).abs() < 1e-12);
            let flux = porosity * flow - solids * speed;
            assert!(!closed || flux.abs() < 1e-6 * solids * speed, "{flux:e}");
        }
    }
}

#[test]
fn no_slice_of_a_closed_vessel_passes_volume_while_grains_fall_at_different_speeds() {
    let size = Vec3::new(2.5e-3, 2.5e-3, 10e-3);
    let kinds = [grain(250e-6, 2460.0, Vec3::zeros())];
    let mut setup = suspension(size, [8, 5, 25], &kinds, false, true);
    // Whole grains in each of ten slices, every one at its own speed.
    let slice = 0.1 * size.z;
    setup.porosity = Some(Porosity::new(
        slice,
        size.x * size.y,
        Measure::Centre,
        true,
        false,
        1e-3,
    ));
    for (i, grain) in setup.grains.iter_mut().enumerate() {
        grain.velocity.z = -1e-3 * (i * 7919 % 101) as f64;
    }
    let bed = setup.bed();
    let grains = &bed.grains;
    let volume = PI / 6.0 * 250e-6_f64.powi(3);
    for level in 0..10 {
        let inside: Vec<usize> = (0..1000)
            .filter(|&i| (grains.position(i).z / slice) as usize == level)
            .collect();
        let capacity = size.x * size.y * slice;
        let solids: f64 = inside.iter().map(|&i| volume * grains.velocity(i).z).sum();
        let [.., porosity, flow, _, _] = grains.spin[inside[0]].0;
        let flux = porosity * flow + solids / capacity;
        assert!(
            solids != 0.0 && flux.abs() < 1e-12 * solids.abs() / capacity,
            "{flux:e} at {level}"
        );
    }
}

#[test]
fn grains_of_two_densities_fall_at_5_11_and_1_38_millimetres_per_second_when_drag_is_shared() {
    let diameter = 1e-4_f64;
    let volume = PI / 6.0 * diameter.powi(3);
    let heavy = grain(diameter, 2450.0, Vec3::zeros());
    let light = Grain {
        class: 1,
        ..grain(diameter, 1500.0, Vec3::zeros())
    };
    let counts = [6, 6, 20];
    let pitch = (volume / 0.1).cbrt();
    let size = Vec3::new(6.0, 6.0, 20.0) * pitch;
    for (mixed, expected) in [(true, [5.11e-3, 1.38e-3]), (false, [4.93e-3, 1.58e-3])] {
        let mut setup = suspension(size, counts, &[heavy, light], mixed, true);
        setup.surroundings = water(0.89e-3, SphereDrag::Dallavalle, AnyVoidage::DiFelice);
        setup.interaction.time_step = 2e-5;
        let bed = setup.after(600);
        for class in 0..2 {
            let speed = falling(&bed, class);
            assert!(
                (speed - expected[class as usize]).abs() < 0.006e-3,
                "{speed:e} for {expected:?}"
            );
        }
    }
}

#[test]
fn a_spinning_grain_drifts_across_its_fall_as_rubinow_and_keller_say() {
    let (diameter, viscosity, spin) = (250e-6, 1e-3, 40.0);
    let mut grains = vec![grain(diameter, 2460.0, Vec3::zeros())];
    grains[0].angular_velocity = Vec3::new(0.0, spin, 0.0);
    let mut setup = Setup::new(grains, smooth(normals()[0]), 1e-5);
    setup.surroundings = Surroundings {
        lift: true,
        stream: None,
        shear_lift: false,
        ..water(viscosity, SphereDrag::Stokes, AnyVoidage::None)
    };
    let mut bed = setup.bed();
    bed.advance(20_000).expect("no grain leaps");
    // Stokes drag against weight and a force k × the drag across the motion turns and slows the fall.
    let k = diameter * diameter * 1000.0 * spin / (24.0 * viscosity);
    let terminal = 1460.0 * GRAVITY * diameter * diameter / (18.0 * viscosity);
    let velocity = bed.grains.velocity(0);
    let (across, down) = (-velocity.x, -velocity.z);
    assert!((across / down / k - 1.0).abs() < 1e-6, "{across} to {down}, {k}");
    assert!((down * (1.0 + k * k) / terminal - 1.0).abs() < 1e-6);
}
