//! A coupled column put together by hand, for grains that stand where no scene puts them.

use kynch_sim::contact::LinearSpringDashpot;
use kynch_sim::coupling::{Exchange, ExchangeRules, GrainSize, PorosityRules, grain_porosity};
use kynch_sim::drag::DiFelice;
use kynch_sim::fluid::kernel::Sharpening;
use kynch_sim::fluid::{Continuity, EquationOfState, FluidParticles, Numerics};
use kynch_sim::math::Vec3;
use kynch_sim::simulation::{CouplingRules, GrainPorosity, RigidGrain, RigidGrains, Simulation, SlipRule};

use crate::scenes::{GLASS, GRAVITY, WATER, volume};

pub const SPACING: f64 = 4e-4;
pub const WIDTH: f64 = 6.0 * SPACING;
const HEIGHT: f64 = 10.0 * SPACING;
const LENGTH: f64 = 1.2 * SPACING;
/// Grains along each side and in height.
const SIDE: usize = 14;
const LAYERS: usize = 6;

/// A lattice of grains shifted by `shift` [m] in x, wrapped into the column.
pub fn lattice(shift: f64) -> Vec<Vec3> {
    let pitch = WIDTH / SIDE as f64;
    (0..SIDE * SIDE * LAYERS)
        .map(|i| {
            let (x, y, z) = (i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE);
            let place = Vec3::new(x as f64 + 0.5, y as f64 + 0.5, z as f64 + 0.5) * pitch;
            Vec3::new((place.x + shift).rem_euclid(WIDTH), place.y, place.z + 2e-3)
        })
        .collect()
}

/// The speed [m/s] at which the grains fall after so many steps of 0.1 ms from rest.
pub fn fallen_speed(position: Vec<Vec3>, steps: usize) -> f64 {
    let fluid = FluidParticles::lattice(
        Numerics {
            spacing: SPACING,
            viscosity: WATER.viscosity,
            artificial: 0.0,
            bulk: 0.1,
            lucy: false,
            gravity: 0.0,
            continuity: Continuity::MixtureFlux,
            state: EquationOfState {
                density: WATER.density,
                sound_speed: 0.6,
            },
        },
        WIDTH,
        HEIGHT,
    );
    let volume = volume(&GLASS);
    let size = |length: f64| GrainSize {
        diameter: GLASS.diameter,
        length,
    };
    let porosity = grain_porosity(
        &position,
        vec![size(3.0 * GLASS.diameter); position.len()],
        PorosityRules::SHARP_LATTICE,
        WIDTH,
    );
    let rules = CouplingRules {
        law: DiFelice,
        fluid: [WATER.density, WATER.viscosity],
        slip: SlipRule::MixtureFlux,
        porosity: GrainPorosity::Known(porosity),
        intrinsic_stress: false,
        buoyancy: WATER.density * GRAVITY,
        two_way: true,
        own_flow: None,
        breathing: None,
        refresh_interval: 8,
    };
    let grain = |&position: &Vec3| RigidGrain {
        position,
        diameter: GLASS.diameter,
        mass: GLASS.density * volume,
        weight: (GLASS.density - WATER.density) * volume * GRAVITY,
    };
    let grains = RigidGrains {
        grains: position.iter().map(grain).collect(),
        velocity: Vec3::zeros(),
        held: false,
        floor: LinearSpringDashpot::with_restitution(1.0, 1.0),
        contact_steps: 20.0,
    };
    let exchange_rules = ExchangeRules {
        sharpening: Sharpening::SECOND_ORDER,
        floor_images: false,
        cut: 2.0,
    };
    let sizes = vec![size(LENGTH); position.len()];
    let exchange = Exchange::new(sizes, exchange_rules, &fluid, &position);
    let mut simulation = Simulation::new(fluid, grains, exchange, rules);
    (0..steps).for_each(|_| simulation.step(1e-4));
    -simulation.grains.velocity.z
}
