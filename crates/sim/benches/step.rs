//! Speed of the fluid step, alone and coupled: prints lines `BENCH <name> <value> <unit>`.
//!
//! Rates are steps of fluid particles per second on one core, the median of several batches. The
//! shares say where a coupled step spends its time; they come from a second, instrumented pass.

use std::f64::consts::PI;
use std::time::Instant;

use kynch_sim::contact::LinearSpringDashpot;
use kynch_sim::coupling::{
    Basin, Breathing, Exchange, ExchangeRules, Field, GrainSize, PorosityRules, PorositySums,
    SelfInducedFlow, grain_porosity,
};
use kynch_sim::drag::DiFelice;
use kynch_sim::fluid::kernel::Sharpening;
use kynch_sim::fluid::{Continuity, EquationOfState, FluidParticles, Numerics};
use kynch_sim::math::Vec3;
use kynch_sim::simulation::{CouplingRules, GrainPorosity, RigidGrain, RigidGrains, Simulation, SlipRule};

const WIDTH: f64 = 4e-3;
/// 20 × 20 × 33 particles.
const HEIGHT: f64 = 6.6e-3;
const SPACING: f64 = 2e-4;
const DIAMETER: f64 = 1e-4;
/// Three diameters: exchange length and porosity length alike.
const LENGTH: f64 = 3e-4;
const SIZE: GrainSize = GrainSize {
    diameter: DIAMETER,
    length: LENGTH,
};
const DENSITY: f64 = 1000.0;
const VISCOSITY: f64 = 0.89e-3;
const SOUND_SPEED: f64 = 0.94;
/// Fluid steps between refreshes of the weights of a block, as the scene sets it.
const BLOCK_REFRESH: u64 = 8;
const STEP: f64 = 1e-5;
const BATCHES: usize = 7;
/// Grains that fill 4 × 4 × 6 mm at porosity 0.9.
const SUSPENSION: usize = 18_335;

fn main() {
    let mut fluid = fluid();
    let count = fluid.len();
    fluid.sum_rates(0.0);
    report(
        &format!("fluid_step_{count}"),
        rate(count, 30, || bare_step(&mut fluid)),
    );

    let mut single = coupled(vec![Vec3::new(2e-3, 2e-3, 4.8e-3)], true, 1);
    report("fluid_step_1_grain", rate(count, 30, || single.step(STEP)));

    for (name, refresh) in [
        ("fluid_step_18335_grains", BLOCK_REFRESH),
        ("fluid_step_18335_grains_refreshed_every_step", 1),
    ] {
        let mut suspension = coupled(suspension(), false, refresh);
        let step_rate = rate(count, 16, || suspension.step(STEP));
        report(name, step_rate);
    }
    shares(coupled(suspension(), false, BLOCK_REFRESH));
}

fn report(name: &str, rate: f64) {
    println!("BENCH {name} {rate:.3e} particle-steps/s");
}

/// Median over several batches of the particle-steps per second of `step`.
fn rate(particles: usize, steps: usize, mut step: impl FnMut()) -> f64 {
    step();
    median(|| (particles * steps) as f64 / seconds(|| (0..steps).for_each(|_| step())))
}

fn median(mut value: impl FnMut() -> f64) -> f64 {
    let mut values: Vec<f64> = (0..BATCHES).map(|_| value()).collect();
    values.sort_by(f64::total_cmp);
    values[BATCHES / 2]
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

fn fluid() -> FluidParticles {
    let numerics = Numerics {
        spacing: SPACING,
        viscosity: VISCOSITY,
        artificial: 0.0,
        bulk: 0.1,
        lucy: false,
        gravity: 0.0,
        continuity: Continuity::MixtureFlux,
        state: EquationOfState {
            density: DENSITY,
            sound_speed: SOUND_SPEED,
        },
    };
    FluidParticles::lattice(numerics, WIDTH, HEIGHT)
}

fn bare_step(fluid: &mut FluidParticles) {
    fluid.kick_and_drift(STEP);
    fluid.sum_rates(0.5 * STEP);
    fluid.kick(STEP);
}

/// Scattered places above the floor: a low-discrepancy sequence (Roberts 2018), the same every time.
fn suspension() -> Vec<Vec3> {
    const BASE: f64 = 1.220_744_084_605_759_5;
    let share = |i: usize, power: i32| (0.5 + i as f64 * BASE.powi(-power)).fract();
    (0..SUSPENSION)
        .map(|i| {
            Vec3::new(
                WIDTH * share(i, 1),
                WIDTH * share(i, 2),
                DIAMETER + 6e-3 * share(i, 3),
            )
        })
        .collect()
}

/// Grains that fall together through the fluid, coupled as the scenes couple them.
fn coupled(position: Vec<Vec3>, isolated: bool, refresh_interval: u64) -> Simulation<DiFelice> {
    let volume = PI / 6.0 * DIAMETER.powi(3);
    let sizes = vec![SIZE; position.len()];
    let fluid = fluid();
    let sharpening = if isolated {
        Sharpening::NONE
    } else {
        Sharpening::SECOND_ORDER
    };
    let porosity = if isolated {
        vec![1.0]
    } else {
        grain_porosity(&position, sizes.clone(), PorosityRules::SHARP_LATTICE, WIDTH)
    };
    let basin = Basin {
        width: WIDTH,
        height: HEIGHT,
        density: DENSITY,
        viscosity: VISCOSITY / DENSITY,
        smoothing: 1.5 * SPACING,
        exchange: LENGTH,
        sharpening,
    };
    let rules = CouplingRules {
        law: DiFelice,
        fluid: [DENSITY, VISCOSITY],
        slip: if isolated {
            SlipRule::Isolated
        } else {
            SlipRule::MixtureFlux
        },
        porosity: GrainPorosity::Known(porosity),
        intrinsic_stress: false,
        buoyancy: DENSITY * 9.81,
        two_way: true,
        own_flow: isolated.then(|| SelfInducedFlow::new(&basin, volume)),
        breathing: Some(Breathing::new(SOUND_SPEED, HEIGHT, SPACING)),
        refresh_interval,
    };
    let grain = |&position: &Vec3| RigidGrain {
        position,
        diameter: DIAMETER,
        mass: 2500.0 * volume,
        weight: 1500.0 * volume * 9.81,
    };
    let grains = RigidGrains {
        grains: position.iter().map(grain).collect(),
        velocity: Vec3::zeros(),
        held: false,
        floor: LinearSpringDashpot::with_restitution(1.0, 1.0),
        contact_steps: 20.0,
    };
    let exchange_rules = ExchangeRules {
        sharpening,
        floor_images: !isolated,
        cut: 2.0,
    };
    let exchange = Exchange::new(sizes, exchange_rules, &fluid, &position);
    Simulation::new(fluid, grains, exchange, rules)
}

/// Shares of a coupled step, in milliseconds per step.
fn shares(mut simulation: Simulation<DiFelice>) {
    let count = simulation.fluid.len();
    let position: Vec<Vec3> = (simulation.grains.grains.iter())
        .map(|grain| grain.position)
        .collect();
    let velocity = vec![Vec3::zeros(); position.len()];
    let fields = vec![Field::new(Vec3::repeat(1e-3), Vec3::repeat(1.0), 0.9, 1e3); count];
    let mut impulses = vec![[0.0; 4]; count];
    let milliseconds = |name: &str, value: f64| println!("BENCH {name} {:.3} ms/step", 1e3 * value);
    milliseconds(
        "share_step",
        median(|| seconds(|| (0..8).for_each(|_| simulation.step(STEP))) / 8.0),
    );
    milliseconds(
        "share_sweep",
        median(|| seconds(|| simulation.fluid.sum_rates(0.0))),
    );
    let exchange = &mut simulation.exchange;
    milliseconds(
        "share_refresh",
        median(|| seconds(|| exchange.refresh(&simulation.fluid, 0.0, &position, &velocity)))
            / BLOCK_REFRESH as f64,
    );
    let mut sums = PorositySums::new(PorosityRules::FREE, vec![SIZE; position.len()], WIDTH);
    // Far enough to be summed anew every time.
    let aside = |x: &Vec3| x + Vec3::new(0.1 * DIAMETER, 0.0, 0.0);
    let mut places = [position.clone(), position.iter().map(aside).collect()];
    milliseconds(
        "share_grain_porosity",
        median(|| {
            places.swap(0, 1);
            seconds(|| sums.refresh(&places[0]))
        }) / BLOCK_REFRESH as f64,
    );
    let mut samples = Vec::new();
    milliseconds(
        "share_sample",
        median(|| seconds(|| exchange.sample_all(&fields, &mut samples))),
    );
    let given = vec![[1.0; 4]; position.len()];
    milliseconds(
        "share_spread",
        median(|| seconds(|| exchange.spread(&given, &mut impulses))),
    );
    // The sums are used, so that nothing of the work can be left out.
    assert!(samples[0].0[0].is_finite() && impulses[0][0].is_finite());
}
