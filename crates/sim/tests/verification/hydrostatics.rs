//! Sums over the lattice: kernels, pressure gradient, wall, and the start in equilibrium.

use kynch_sim::fluid::kernel::{Kernel, Lucy, WendlandC2};
use kynch_sim::fluid::{Continuity, EquationOfState, FluidParticles, Numerics};

use crate::scenes::{GRAVITY, WATER};

const SPACING: f64 = 4e-4;
const HEIGHT: f64 = 6e-3;

fn fluid(gravity: f64) -> FluidParticles {
    let numerics = Numerics {
        spacing: SPACING,
        viscosity: WATER.viscosity,
        artificial: 0.0,
        bulk: 0.0,
        lucy: false,
        gravity,
        continuity: Continuity::MixtureFlux,
        state: EquationOfState {
            density: WATER.density,
            sound_speed: 2.5,
        },
    };
    FluidParticles::lattice(numerics, 4e-3, HEIGHT)
}

/// Σ W V and Σ x ∂W/∂x V over a cubic lattice with h = 1.5 spacings; both are −1 or 1 as integrals.
fn lattice_sums(kernel: impl Kernel) -> (f64, f64) {
    const SMOOTHING: f64 = 1.5;
    let (mut value, mut gradient) = (0.0, 0.0);
    for x in -3..=3 {
        for y in -3..=3 {
            for z in -3..=3 {
                let q = f64::from(x * x + y * y + z * z).sqrt() / SMOOTHING;
                value += kernel.value(q) / SMOOTHING.powi(3);
                gradient += kernel.slope(q) / SMOOTHING.powi(5) * f64::from(x * x);
            }
        }
    }
    (value, gradient)
}

#[test]
fn kernels_keep_their_integral_and_their_gradient_on_the_lattice() {
    let (value, gradient) = lattice_sums(WendlandC2);
    assert!(
        (value - 1.0).abs() < 4e-3 && (gradient + 1.0).abs() < 1e-3,
        "{value} {gradient}"
    );
    let (value, gradient) = lattice_sums(Lucy);
    assert!(
        (value - 1.0).abs() < 2e-2 && (gradient + 1.0).abs() < 2e-2,
        "{value} {gradient}"
    );
}

/// A porosity between 0.4 and 1 without any order.
fn ragged(fluid: &FluidParticles) -> Vec<f64> {
    (0..fluid.len())
        .map(|a| 1.0 - 0.6 * (a as f64 * 0.618_033_988_749_895).fract())
        .collect()
}

#[test]
fn a_constant_pressure_moves_nothing_however_ragged_the_porosity() {
    let mut fluid = fluid(0.0);
    let porosity = ragged(&fluid);
    let pressure = 50.0;
    fluid.prepare(&porosity, |_| pressure);
    fluid.sum_rates(0.0);
    let beneath_the_top = |a: &usize| fluid.position[*a].z < HEIGHT - 3.5 * SPACING;
    let strongest = (0..fluid.len())
        .filter(beneath_the_top)
        .map(|a| fluid.stress[a].norm())
        .fold(0.0, f64::max);
    assert!(strongest < 1e-12 * pressure / SPACING, "{strongest:e}");
}

#[test]
fn the_hydrostatic_start_is_in_balance_down_to_the_floor() {
    let mut fluid = fluid(GRAVITY);
    let porosity = ragged(&fluid);
    // Weight hangs on the mass, and a ragged porosity makes the mass ragged: the stress must not follow.
    fluid.prepare(&porosity, |x| WATER.density * GRAVITY * (HEIGHT - x.z));
    fluid.sum_rates(0.0);
    let mut worst = [0.0_f64; 2];
    for a in (0..fluid.len()).filter(|&a| fluid.position[a].z < HEIGHT - 3.5 * SPACING) {
        let unbalanced = (fluid.stress[a].z / (WATER.density * GRAVITY) - 1.0).abs();
        let near_floor = (fluid.position[a].z < 3.5 * SPACING) as usize;
        worst[near_floor] = worst[near_floor].max(unbalanced);
    }
    // The gradient of the lattice is short by 6 in 10⁴; the wall must add nothing to that.
    assert!(worst[0] < 1e-3, "inside {worst:?}");
    assert!(worst[1] < 1e-3, "at the floor {worst:?}");
}

#[test]
fn the_floor_carries_the_weight_of_the_column() {
    let mut fluid = fluid(GRAVITY);
    let pure = vec![1.0; fluid.len()];
    fluid.prepare(&pure, |x| WATER.density * GRAVITY * (HEIGHT - x.z));
    fluid.sum_rates(0.0);
    let weight = fluid.mass.iter().sum::<f64>() * GRAVITY;
    let carried = fluid.wall_force().z / weight;
    assert!((carried - 1.0).abs() < 0.02, "{carried}");
}
