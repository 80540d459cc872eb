//! Terminal velocities and start-up against closed forms.

use kynch_sim::scene::{Coupling, Drag, Fluid, Scheme, SelfDisturbance, SingleSphere};

use crate::scenes::{
    GLASS, WATER, block, particles, run_block, run_sphere, scalar, series, sphere, stokes_speed,
};

fn relative(value: f64, expected: f64) -> f64 {
    value / expected - 1.0
}

fn terminal_error(scene: &SingleSphere) -> f64 {
    relative(
        scalar(&run_sphere(scene), "terminal_velocity"),
        stokes_speed(&GLASS, &WATER),
    )
}

#[test]
fn a_sphere_in_still_fluid_falls_at_the_stokes_speed() {
    let error = terminal_error(&sphere(Fluid::Still(WATER)));
    assert!(error.abs() < 1e-8, "{error:e}");
}

#[test]
fn a_one_way_coupled_sphere_falls_at_the_stokes_speed_within_a_thousandth() {
    let mut scene = sphere(particles(4.0, Scheme::default()));
    scene.coupling = Coupling::OneWay;
    let error = terminal_error(&scene);
    assert!(error.abs() < 1e-3, "{error:e}");
}

/// Largest departure from v_t (1 − e^(−t/t_d)), over v_t.
fn start_up_error(scene: &SingleSphere) -> f64 {
    let outcome = run_sphere(scene);
    let terminal = stokes_speed(&GLASS, &WATER);
    let relaxation = GLASS.density * GLASS.diameter.powi(2) / (18.0 * WATER.viscosity);
    (series(&outcome, "time").iter().zip(series(&outcome, "velocity")))
        .map(|(t, v)| (v / terminal + (-t / relaxation).exp_m1()).abs())
        .fold(0.0, f64::max)
}

#[test]
fn the_start_in_still_fluid_is_exact_at_every_time() {
    let error = start_up_error(&sphere(Fluid::Still(WATER)));
    assert!(error < 1e-12, "{error:e}");
}

#[test]
fn the_way_fallen_is_exact_in_still_fluid_and_in_particles_that_feel_nothing() {
    let mut one_way = sphere(particles(4.0, Scheme::default()));
    one_way.coupling = Coupling::OneWay;
    let terminal = stokes_speed(&GLASS, &WATER);
    let relaxation = GLASS.density * GLASS.diameter.powi(2) / (18.0 * WATER.viscosity);
    for scene in [sphere(Fluid::Still(WATER)), one_way] {
        let outcome = run_sphere(&scene);
        let (time, height) = (series(&outcome, "time"), series(&outcome, "height"));
        for (t, z) in time.iter().zip(height) {
            let way = terminal * (t + relaxation * (-t / relaxation).exp_m1());
            assert!((height[0] - z - way).abs() < 1e-6 * GLASS.diameter, "after {t} s");
        }
    }
}

#[test]
fn the_start_in_particle_fluid_keeps_within_half_a_per_cent() {
    let mut scene = sphere(particles(4.0, Scheme::default()));
    scene.coupling = Coupling::OneWay;
    let error = start_up_error(&scene);
    assert!(error < 5e-3, "one-way: {error:e}");
    scene.coupling = Coupling::TwoWay;
    let error = start_up_error(&scene);
    assert!(error < 5e-3, "two-way: {error:e}");
}

#[test]
fn a_sphere_that_drags_the_fluid_along_falls_right_only_when_its_own_flow_is_taken_out() {
    let mut scene = sphere(particles(4.0, Scheme::default()));
    let corrected = run_sphere(&scene);
    let error = relative(
        scalar(&corrected, "terminal_velocity"),
        stokes_speed(&GLASS, &WATER),
    );
    assert!(error.abs() < 1e-2, "corrected: {error:e}");
    // What is taken out is what the fluid really carries.
    let gap = scalar(&corrected, "self_disturbance_error");
    assert!(gap < 0.1, "{gap}");

    scene.self_disturbance = SelfDisturbance::Uncorrected;
    let outcome = run_sphere(&scene);
    let error = relative(
        scalar(&outcome, "terminal_velocity"),
        stokes_speed(&GLASS, &WATER),
    );
    assert!((0.015..0.06).contains(&error), "uncorrected: {error:e}");
    // It falls too fast by about as much as the fluid at the grain falls with it.
    let share = scalar(&outcome, "disturbance_share");
    assert!((error / share - 1.0).abs() < 0.25, "{error} and {share}");
}

#[test]
fn a_dilute_block_falls_at_its_force_balance() {
    // Raso (2014) eq. 4.4 with 0.63² at porosity 0.9.
    let outcome = run_block(&block(particles(4.0, Scheme::default()), 0.9, 4e-3));
    let error = relative(scalar(&outcome, "terminal_velocity"), 4.912e-3);
    assert!(error.abs() < 0.02, "{error:e}");
    let drift = scalar(&outcome, "terminal_velocity_drift");
    assert!(drift.abs() < 2e-3 * 4.912e-3, "{drift:e}");
}

#[test]
fn a_block_in_a_closed_column_falls_at_its_force_balance_without_particles() {
    let scene = block(Fluid::Column(WATER), 0.9, 4e-3);
    let error = relative(scalar(&run_block(&scene), "terminal_velocity"), 4.91237e-3);
    assert!(error.abs() < 1e-5, "{error:e}");
    // In a fluid at rest the slip is ε v, so the speed is larger by 1/ε.
    let still = block(Fluid::Still(WATER), 0.9, 4e-3);
    let error = relative(0.9 * scalar(&run_block(&still), "terminal_velocity"), 4.91237e-3);
    assert!(error.abs() < 1e-5, "{error:e}");
}

#[test]
fn every_drag_law_ends_where_drag_equals_weight_less_buoyancy() {
    // Coefficients at the terminal Reynolds number, written as C_D of the published laws.
    type Coefficient = fn(f64) -> f64;
    let cases: [(Drag, Coefficient); 4] = [
        (Drag::Stokes, |re| 24.0 / re),
        (Drag::Dallavalle, |re| (0.63 + 4.8 / re.sqrt()).powi(2)),
        (Drag::SchillerNaumann, |re| {
            24.0 / re * (1.0 + 0.15 * re.powf(0.687))
        }),
        (Drag::CoulsonRichardson, |re| {
            2.0 * (1.84 * re.powf(-0.31) + 0.293 * re.powf(0.06)).powf(3.45)
        }),
    ];
    for (drag, coefficient) in cases {
        let mut scene = sphere(Fluid::Still(WATER));
        scene.drag = drag;
        let speed = scalar(&run_sphere(&scene), "terminal_velocity");
        let re = WATER.density * GLASS.diameter * speed / WATER.viscosity;
        // (4/3) Ar = C_D Re².
        let archimedes =
            GLASS.diameter.powi(3) * WATER.density * (GLASS.density - WATER.density) * scene.gravity
                / WATER.viscosity.powi(2);
        let error = relative(coefficient(re) * re * re, 4.0 / 3.0 * archimedes);
        assert!(error.abs() < 1e-6, "{drag:?}: {error:e}");
    }
}
