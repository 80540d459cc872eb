//! Momentum of grains, fluid and walls: closed to rounding of what is exchanged in a step.
//!
//! Two options give this up. One-way coupling does by its nature and claims nothing. Without the
//! hydrostatic split the pairs carry the weight of the whole column, some 10⁵ times that of a single
//! grain, and so does their rounding: the error is held to rounding of the column's weight instead.

use kynch_sim::scene::{
    Coupling, Hydrostatics, KernelChoice, PorosityPath, SharpeningChoice, Slip, SoundSpeed, Start,
    StressDensity,
};
use kynch_sim::scene::{Scheme, SingleSphere};

use crate::scenes::{GLASS, GRAVITY, WATER, block, particles, run_block, run_sphere, scalar, sphere, volume};

fn schemes() -> Vec<(&'static str, Scheme)> {
    let scheme = Scheme::default;
    vec![
        ("default", scheme()),
        (
            "artificial viscosity",
            Scheme {
                artificial_viscosity: Some(0.1),
                ..scheme()
            },
        ),
        (
            "real viscosity in the artificial form",
            Scheme {
                viscosity_constant: Some(9.0),
                ..scheme()
            },
        ),
        (
            "Lucy kernel",
            Scheme {
                kernel: KernelChoice::Lucy,
                ..scheme()
            },
        ),
        (
            "two-pass porosity",
            Scheme {
                porosity: PorosityPath::TwoPass,
                ..scheme()
            },
        ),
        (
            "plain kernels",
            Scheme {
                sharpening: SharpeningChoice::None,
                ..scheme()
            },
        ),
        (
            "intrinsic density in the stress",
            Scheme {
                stress_density: StressDensity::Intrinsic,
                ..scheme()
            },
        ),
        (
            "interstitial slip",
            Scheme {
                slip: Slip::Interstitial,
                ..scheme()
            },
        ),
        (
            "fast sound",
            Scheme {
                sound_speed: SoundSpeed::Value(3.43),
                ..scheme()
            },
        ),
    ]
}

fn short_sphere(spacing_over_diameter: f64, scheme: Scheme) -> SingleSphere {
    let mut scene = sphere(particles(spacing_over_diameter, scheme));
    scene.column.width = 4.2e-3;
    scene.duration = 8e-3;
    scene
}

#[test]
fn is_closed_around_a_falling_sphere_under_every_scheme() {
    for (name, scheme) in schemes() {
        let error = scalar(&run_sphere(&short_sphere(3.0, scheme)), "momentum_error");
        assert!(error < 1e-12, "{name}: {error:e}");
    }
}

#[test]
fn is_closed_around_a_falling_block_under_every_scheme() {
    for (name, scheme) in schemes() {
        let mut scene = block(particles(4.0, scheme), 0.9, 4e-3);
        scene.duration = 6e-3;
        let error = scalar(&run_block(&scene), "momentum_error");
        assert!(error < 1e-12, "{name}: {error:e}");
    }
}

#[test]
fn is_closed_around_a_held_block_in_a_fluid_set_in_motion_by_its_own_pressure() {
    let scheme = Scheme {
        hydrostatics: Hydrostatics::Carried,
        ..Scheme::default()
    };
    let mut scene = block(particles(4.0, scheme), 0.9, 4e-3);
    scene.held = true;
    scene.duration = 6e-3;
    // The grains hand out their whole buoyancy, a tenth of the column's weight: rounding times ten.
    let error = scalar(&run_block(&scene), "momentum_error");
    assert!(error < 1e-11, "{error:e}");
}

#[test]
fn is_closed_through_the_damped_start() {
    let scheme = Scheme {
        start: Start::Relaxed,
        ..Scheme::default()
    };
    let error = scalar(&run_sphere(&short_sphere(4.0, scheme)), "momentum_error");
    assert!(error < 1e-12, "{error:e}");
}

#[test]
fn rounds_like_the_weight_of_the_column_where_the_fluid_carries_it() {
    let scheme = Scheme {
        hydrostatics: Hydrostatics::Carried,
        ..Scheme::default()
    };
    let scene = short_sphere(3.0, scheme);
    let error = scalar(&run_sphere(&scene), "momentum_error");
    let column = WATER.density * scene.column.width.powi(2) * scene.column.height * GRAVITY;
    let grain = (GLASS.density - WATER.density) * volume(&GLASS) * GRAVITY;
    assert!(error * grain / column < 1e-12, "{error:e}");
}

#[test]
fn one_way_coupling_claims_no_closed_momentum() {
    let mut scene = short_sphere(4.0, Scheme::default());
    scene.coupling = Coupling::OneWay;
    let scalars = run_sphere(&scene).scalars;
    assert!(scalars.iter().all(|scalar| scalar.name != "momentum_error"));
}
