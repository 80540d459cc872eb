//! Fast beads in fluid at rest: added mass, nonlinear drag, and the way until the floor.

use kynch_sim::scene::{
    Column, Coupling, Drag, Fluid, Grains, Scene, Scheme, SelfDisturbance, SingleSphere, check,
};

use crate::scenes::{
    GLASS, GRAVITY, WATER, particles, run_sphere, scalar, series, sphere, stokes_speed, volume,
};

/// Glass of 1.5 mm in water: Re 370.
const BEAD: Grains = Grains {
    diameter: 1.5e-3,
    density: 2560.0,
};

fn bead(added_mass: bool) -> SingleSphere {
    SingleSphere {
        grains: BEAD,
        drag: Drag::SchillerNaumann,
        fluid: Fluid::Still(WATER),
        column: Column {
            width: 0.1,
            height: 2.0,
        },
        release_height: 0.9,
        coupling: Coupling::TwoWay,
        self_disturbance: SelfDisturbance::Corrected,
        added_mass,
        duration: 1.2,
        gravity: GRAVITY,
    }
}

/// (m + ½ρ_f V) dv/dt = (ρ_p − ρ_f) V g − drag, by the classical Runge–Kutta scheme in steps of 10 µs:
/// terminal velocity and time to 95 % of it.
fn fine_fall(added_share: f64) -> (f64, f64) {
    let mass = (BEAD.density + added_share * WATER.density) * volume(&BEAD);
    let weight = (BEAD.density - WATER.density) * volume(&BEAD) * GRAVITY;
    let acceleration = |v: f64| {
        let re = WATER.density * BEAD.diameter * v / WATER.viscosity;
        let stokes = 3.0 * std::f64::consts::PI * WATER.viscosity * BEAD.diameter * v;
        (weight - stokes * (1.0 + 0.15 * re.powf(0.687))) / mass
    };
    let step = 1e-5;
    let mut speeds = vec![0.0];
    for _ in 0..120_000 {
        let v = speeds[speeds.len() - 1];
        let a = acceleration(v);
        let b = acceleration(v + 0.5 * step * a);
        let c = acceleration(v + 0.5 * step * b);
        let d = acceleration(v + step * c);
        speeds.push(v + step / 6.0 * (a + 2.0 * b + 2.0 * c + d));
    }
    let terminal = speeds[speeds.len() - 1];
    let there = speeds.iter().filter(|speed| **speed < 0.95 * terminal).count();
    (terminal, there as f64 * step)
}

#[test]
fn a_fast_bead_comes_to_its_speed_when_a_fine_integration_does() {
    for (added_mass, share) in [(false, 0.0), (true, 0.5)] {
        let outcome = run_sphere(&bead(added_mass));
        let (terminal, time) = fine_fall(share);
        let found = scalar(&outcome, "terminal_velocity");
        assert!((found / terminal - 1.0).abs() < 1e-5, "{found} {terminal}");
        let found = scalar(&outcome, "terminal_time");
        assert!((found / time - 1.0).abs() < 2e-3, "{found} {time}");
    }
}

#[test]
fn added_mass_delays_a_stokes_sphere_by_its_share_of_the_mass() {
    let mut scene = sphere(Fluid::Still(WATER));
    scene.added_mass = true;
    let outcome = run_sphere(&scene);
    let terminal = stokes_speed(&GLASS, &WATER);
    let inertia = (GLASS.density + 0.5 * WATER.density) * GLASS.diameter.powi(2);
    let relaxation = inertia / (18.0 * WATER.viscosity);
    for (t, v) in series(&outcome, "time").iter().zip(series(&outcome, "velocity")) {
        assert!(
            (v / terminal + (-t / relaxation).exp_m1()).abs() < 1e-12,
            "after {t} s"
        );
    }
    // From rest: the fluid holds the weight less what the acceleration takes.
    let start = GRAVITY * (1.0 - WATER.density / GLASS.density) / (1.0 + 0.5 * WATER.density / GLASS.density);
    let felt = series(&outcome, "fluid_acceleration")[0];
    assert!((felt - (GRAVITY - start)).abs() < 1e-12, "{felt}");
}

#[test]
fn the_largest_velocity_is_that_above_the_floor_and_never_later() {
    let mut scene = bead(true);
    let outcome = run_sphere(&scene);
    let free = scalar(&outcome, "largest_velocity");
    assert!((free / scalar(&outcome, "terminal_velocity") - 1.0).abs() < 1e-6);
    // Released so low that it is still speeding up where the way ends, one diameter above the floor.
    scene.column.height = 0.02;
    scene.release_height = 0.5;
    let short = run_sphere(&scene);
    let (height, velocity) = (series(&short, "height"), series(&short, "velocity"));
    let end = 1.5 * BEAD.diameter;
    let above = height.iter().zip(velocity).filter(|(z, _)| **z >= end);
    let before = above.map(|(_, v)| *v).fold(0.0, f64::max);
    let later = velocity.iter().copied().fold(0.0, f64::max);
    let largest = scalar(&short, "largest_velocity");
    assert!(before <= largest && largest < later && later < 0.99 * free);
}

#[test]
fn added_mass_beside_fluid_particles_is_refused() {
    let mut scene = sphere(particles(4.0, Scheme::default()));
    scene.added_mass = true;
    let faults = check(&Scene::SingleSphere(scene));
    let told: Vec<_> = faults
        .iter()
        .map(|fault| (fault.path.as_str(), fault.message.as_str()))
        .collect();
    let message = "`added_mass: on` does not go with an `sph` fluid: its particles carry their own inertia";
    assert_eq!(told, [("added_mass", message)]);
}
