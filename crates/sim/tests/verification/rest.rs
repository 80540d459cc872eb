//! A held block in a fluid at rest: nothing may move.

use kynch_sim::scene::{Hydrostatics, Scheme};

use crate::scenes::{block, particles, profile, run_block, scalar};

/// Largest fluid speed [m/s] around a held block of porosity 0.9 in 0.1 s.
fn spurious(hydrostatics: Hydrostatics) -> f64 {
    let scheme = Scheme {
        hydrostatics,
        ..Scheme::default()
    };
    let mut scene = block(particles(4.0, scheme), 0.9, 4e-3);
    scene.held = true;
    scene.duration = 0.1;
    let outcome = run_block(&scene);
    // The block is there: the fluid inside it has its porosity.
    let porosity = profile(&outcome, "porosity_profile", "porosity_profile");
    let densest = porosity.iter().copied().fold(1.0, f64::min);
    assert!((densest - 0.9).abs() < 0.02, "{densest}");
    scalar(&outcome, "spurious_velocity")
}

#[test]
fn nothing_moves_around_a_held_block_when_the_hydrostatic_part_is_split_off() {
    assert!(spurious(Hydrostatics::Split) < 1e-6);
}

#[test]
fn stored_number_spurious_motion_when_the_equation_of_state_carries_the_whole_pressure() {
    // No law gives this number: 7.4e-5 m/s was measured, 1.5 per cent of the settling speed.
    let speed = spurious(Hydrostatics::Carried);
    assert!((3.7e-5..1.5e-4).contains(&speed), "{speed:e} m/s");
}
