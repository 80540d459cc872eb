//! The flow a dilute grain drags along with its own reaction, and samples back.
//!
//! The drag law wants the undisturbed velocity. The fluid, however, carries the grain's reaction,
//! spread over the exchange kernel W, and the grain samples its own wake with the same kernel. In the
//! linear limit the wake is a sum of Fourier modes of the column (periodic sides, stress-free top,
//! the floor far away), each driven by the force history and decaying by viscosity:
//!
//! ```text
//! dA_k/dt = −λ(k) A_k + F sin(k_z z),      λ(k) = ν k² in the continuum
//! u_self  = Σ_k (2/(ρ L² H)) Ŵ(k)² (k_⊥²/k²) A_k sin(k_z z)
//! ```
//!
//! The k_⊥ = 0 modes are missing because a closed column has no net flux. λ is the symbol of the
//! viscous operator of the particles, 8π ν ∫ (−W_h′)(1 − sin kr/kr) r dr, which damps wavelengths near
//! h less than νk². In the limit of a wide column and long times u_self tends to the Stokeslet of the
//! smeared force, F/(6πμ) ⟨1/r⟩. Correction for self-induced flow: Horwitz & Mani (2016),
//! J. Comput. Phys. 318, 85; Ireland & Desjardins (2017), J. Comput. Phys. 338, 405.
//!
//! Valid for one grain (solids fraction of some per cent at most) and u_self ≪ v.

use std::f64::consts::PI;

use crate::fluid::kernel::{Kernel, Sharpening, WendlandC2, integrate};

/// What the wake depends on besides the force.
#[derive(Clone, Copy, Debug)]
pub struct Basin {
    /// Side of the periodic cross-section L [m].
    pub width: f64,
    /// Fluid height H [m].
    pub height: f64,
    /// Fluid density ρ [kg/m³].
    pub density: f64,
    /// Kinematic viscosity ν [m²/s].
    pub viscosity: f64,
    /// Smoothing length h of the viscous operator [m].
    pub smoothing: f64,
    /// Exchange length h_x [m] and its sharpening.
    pub exchange: f64,
    pub sharpening: Sharpening,
}

/// Modes with equal k_z, side by side.
struct Layer {
    vertical: f64,
    /// (2/(ρ L² H)) Ŵ² k_⊥²/k² times the number of modes with this k_⊥ [1/kg].
    weight: Vec<f64>,
    decay: Vec<f64>,
    /// Share of each amplitude that a step keeps, e^(−λ dt).
    kept: Vec<f64>,
    amplitude: Vec<f64>,
}

pub struct SelfInducedFlow {
    layers: Vec<Layer>,
    /// ∫ W* W dV, the share of the grain's own solids fraction it samples, times V/3 [-].
    displacement: f64,
    /// Step the kept shares belong to [s].
    step: f64,
}

/// Wavenumbers beyond which the kernel lets nothing through, times h_x.
const CUT: f64 = 16.0;

impl SelfInducedFlow {
    /// The wake of a grain of `volume` [m³] at rest so far.
    pub fn new(basin: &Basin, volume: f64) -> Self {
        let kernel = |k: f64| transform(|q| basin.sharpening.value(q), k * basin.exchange);
        let cut = CUT / basin.exchange;
        let unit = 2.0 * PI / basin.width;
        let sides = (cut / unit) as usize;
        // Number of wave vectors with i² + j² = s.
        let mut multiplicity = vec![0u32; 2 * sides * sides + 1];
        let reach = sides as i64;
        for i in -reach..=reach {
            for j in -reach..=reach {
                multiplicity[(i * i + j * j) as usize] += 1;
            }
        }
        let table = Table::new(CUT * 1.5, |kh| {
            let value = kernel(kh / basin.exchange);
            value * value
        });
        let ratio = basin.smoothing / basin.exchange;
        let damping = Table::new(CUT * 1.5 * ratio, viscous_symbol);
        let layers = (1..=(cut * basin.height / PI) as usize)
            .map(|n| {
                let vertical = PI * n as f64 / basin.height;
                let mut layer = Layer {
                    vertical,
                    weight: Vec::new(),
                    decay: Vec::new(),
                    kept: Vec::new(),
                    amplitude: Vec::new(),
                };
                for (s, &count) in multiplicity
                    .iter()
                    .enumerate()
                    .skip(1)
                    .filter(|(_, count)| **count > 0)
                {
                    let across2 = unit * unit * s as f64;
                    let k = (across2 + vertical * vertical).sqrt();
                    if k > cut {
                        break;
                    }
                    let transverse = across2 / (k * k);
                    let norm = 2.0 / (basin.density * basin.width * basin.width * basin.height);
                    layer
                        .weight
                        .push(norm * count as f64 * transverse * table.at(k * basin.exchange));
                    let h = basin.smoothing;
                    layer.decay.push(basin.viscosity / (h * h) * damping.at(k * h));
                    layer.amplitude.push(0.0);
                }
                layer
            })
            .collect();
        let overlap = integrate(|q| 4.0 * PI * q * q * basin.sharpening.value(q) * WendlandC2.value(q));
        SelfInducedFlow {
            layers,
            displacement: volume / 3.0 * overlap / basin.exchange.powi(3),
            step: 0.0,
        }
    }

    /// Lets the grain push with `force` [N] (downward positive) for `dt` [s] at height `z` [m].
    pub fn advance(&mut self, force: f64, z: f64, dt: f64) {
        if dt != self.step {
            self.step = dt;
            for layer in &mut self.layers {
                layer.kept = layer.decay.iter().map(|decay| (-decay * dt).exp()).collect();
            }
        }
        for layer in &mut self.layers {
            let drive = force * (layer.vertical * z).sin();
            for ((amplitude, decay), kept) in layer.amplitude.iter_mut().zip(&layer.decay).zip(&layer.kept) {
                // Exact for a force constant over the step.
                let steady = drive / decay;
                *amplitude = steady + (*amplitude - steady) * kept;
            }
        }
    }

    /// Flow [m/s], downward positive, that a grain at height `z` [m] moving down at `speed` [m/s]
    /// samples of its own: the wake less the backflow of the fluid it displaces.
    pub fn velocity(&self, z: f64, speed: f64) -> f64 {
        let wake: f64 = self
            .layers
            .iter()
            .map(|layer| {
                let sum: f64 = layer
                    .weight
                    .iter()
                    .zip(&layer.amplitude)
                    .map(|(w, a)| w * a)
                    .sum();
                sum * (layer.vertical * z).sin()
            })
            .sum();
        wake - self.displacement * speed
    }

    /// Rate of change of the wake in place [m/s²] while `force` [N] acts.
    pub fn acceleration(&self, force: f64, z: f64) -> f64 {
        self.layers
            .iter()
            .map(|layer| {
                let sine = (layer.vertical * z).sin();
                let sum: f64 = (layer.weight.iter().zip(&layer.amplitude).zip(&layer.decay))
                    .map(|((w, a), decay)| w * (force * sine - decay * a))
                    .sum();
                sum * sine
            })
            .sum()
    }
}

/// Fourier transform of a radial kernel of unit h and support 2, at k [1].
fn transform(value: impl Fn(f64) -> f64, k: f64) -> f64 {
    integrate(|q| 4.0 * PI * q * q * value(q) * sinc(k * q))
}

/// h² λ/ν of the viscous operator of the particles at kh: k²h² for long waves.
fn viscous_symbol(k: f64) -> f64 {
    integrate(|q| -8.0 * PI * WendlandC2.slope(q) * q * q * (1.0 - sinc(k * q)))
}

fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 {
        1.0 - x * x / 6.0
    } else {
        x.sin() / x
    }
}

/// A smooth function of one variable on equidistant nodes, linear in between.
struct Table {
    per_step: f64,
    values: Vec<f64>,
}

impl Table {
    fn new(end: f64, f: impl Fn(f64) -> f64) -> Self {
        const NODES: usize = 600;
        let step = end / NODES as f64;
        Table {
            per_step: 1.0 / step,
            values: (0..=NODES + 1).map(|i| f(i as f64 * step)).collect(),
        }
    }

    fn at(&self, x: f64) -> f64 {
        let position = (x * self.per_step).min((self.values.len() - 2) as f64);
        let node = position as usize;
        let share = position - node as f64;
        self.values[node] * (1.0 - share) + self.values[node + 1] * share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wide(viscosity: f64) -> Basin {
        Basin {
            width: 8e-3,
            height: 8e-3,
            density: 1000.0,
            viscosity,
            smoothing: 0.5e-4,
            exchange: 3e-4,
            sharpening: Sharpening::NONE,
        }
    }

    #[test]
    fn long_waves_decay_by_viscosity() {
        assert!((viscous_symbol(0.05) / 0.0025 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn tends_to_the_stokeslet_of_the_smeared_force_less_the_periodic_backflow() {
        let mut flow = SelfInducedFlow::new(&wide(0.89e-6), 0.0);
        let (force, z) = (7.7e-9, 4e-3);
        flow.advance(force, z, 1e3);
        let viscosity = 0.89e-3;
        // ⟨1/r⟩ of two points drawn from Wendland C2 is that of Gaussians with s = 0.516 h; a periodic
        // cube takes away 2.837 F/(6πμL) (Hasimoto 1959), and so does, nearly, this column.
        let stokeslet = force / (6.0 * PI.powf(1.5) * viscosity * 0.516 * 3e-4);
        let backflow = 2.837 * force / (6.0 * PI * viscosity * 8e-3);
        let ratio = flow.velocity(z, 0.0) / (stokeslet - backflow);
        assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
    }

    #[test]
    fn early_wake_is_two_thirds_of_the_impulse() {
        let mut flow = SelfInducedFlow::new(&wide(1e-12), 0.0);
        flow.advance(1e-9, 4e-3, 1e-3);
        // u = (2/3) F t ∫W² / ρ before viscosity acts; ∫W² = 0.14997/h³ for Wendland C2 is stored nowhere.
        let square = integrate(|q| 4.0 * PI * q * q * WendlandC2.value(q).powi(2)) / 3e-4_f64.powi(3);
        let expected = 2.0 / 3.0 * 1e-9 * 1e-3 * square / 1000.0;
        assert!((flow.velocity(4e-3, 0.0) / expected - 1.0).abs() < 0.01);
    }

    #[test]
    fn the_wake_stays_behind_when_the_grain_moves_away() {
        let mut flow = SelfInducedFlow::new(&wide(0.89e-6), 0.0);
        flow.advance(7.7e-9, 4e-3, 0.05);
        assert!(flow.velocity(3e-3, 0.0) < 0.3 * flow.velocity(4e-3, 0.0));
        assert!(flow.velocity(4e-3, 1.0) == flow.velocity(4e-3, 0.0));
    }
}
