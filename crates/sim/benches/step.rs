//! Speed of the fluid step: prints lines `BENCH <name> <value> <unit>`.

use std::time::Instant;

use kynch_sim::fluid::{Continuity, EquationOfState, FluidParticles, Numerics};

/// Median over several batches of the particle-steps per second of `step`.
fn rate(particles: usize, steps: usize, mut step: impl FnMut()) -> f64 {
    let mut rates: Vec<f64> = (0..7)
        .map(|_| {
            let start = Instant::now();
            (0..steps).for_each(|_| step());
            (particles * steps) as f64 / start.elapsed().as_secs_f64()
        })
        .collect();
    rates.sort_by(f64::total_cmp);
    rates[3]
}

fn main() {
    let numerics = Numerics {
        spacing: 2e-4,
        viscosity: 0.89e-3,
        artificial: 0.0,
        bulk: 0.1,
        lucy: false,
        gravity: 0.0,
        continuity: Continuity::MixtureFlux,
        state: EquationOfState {
            density: 1000.0,
            sound_speed: 0.94,
        },
    };
    let mut fluid = FluidParticles::lattice(numerics, 4e-3, 6.6e-3);
    let count = fluid.len();
    fluid.sum_rates(0.0);
    let dt = 1e-5;
    let value = rate(count, 30, || {
        fluid.kick_and_drift(dt);
        fluid.sum_rates(0.5 * dt);
        fluid.kick(dt);
    });
    println!("BENCH fluid_step_{count} {value:.3e} particle-steps/s");
}
