//! Spheres of several sizes and densities, evenly mixed in a fluid: what each of them slips.
//!
//! ```text
//! 3πμ d_i F_i(|s_i|) s_i = V_i (ρ_i − ρ_mix) g,     ρ_mix = ε ρ_f + Σ_k φ_k ρ_k
//! ```
//!
//! s_i: superficial slip, positive downwards; F_i: drag over Stokes drag under the scene's law, with
//! y_i = d_i/⟨d⟩ and the Sauter mean ⟨d⟩ = φ/Σ_k(φ_k/d_k). The pressure gradient is that of the mixture, so
//! a grain lighter than the mixture rises through it.

use super::drag_law::DragLaw;
use super::grain::Grain;
use super::root::rising_root;

/// Grains with their volume fractions in a fluid that all of them share.
#[derive(Clone, Debug)]
pub struct Mixture {
    pub law: DragLaw,
    pub grains: Vec<Grain>,
    /// φ_i [-]
    pub fractions: Vec<f64>,
}

impl Mixture {
    /// Grains by share of their number, at a porosity.
    pub fn by_number(law: DragLaw, classes: &[(Grain, f64)], porosity: f64) -> Mixture {
        let volume: f64 = classes.iter().map(|(grain, share)| share * grain.volume()).sum();
        Mixture {
            law,
            grains: classes.iter().map(|(grain, _)| *grain).collect(),
            fractions: classes
                .iter()
                .map(|(grain, share)| (1.0 - porosity) * share * grain.volume() / volume)
                .collect(),
        }
    }

    /// ε [-]
    pub fn porosity(&self) -> f64 {
        1.0 - self.fractions.iter().sum::<f64>()
    }

    /// ρ_mix [kg/m³]
    pub fn density(&self) -> f64 {
        let fluid = self.grains.first().map_or(0.0, |grain| grain.fluid_density);
        let solids: f64 = self
            .each()
            .map(|(grain, fraction)| fraction * grain.density)
            .sum();
        self.porosity() * fluid + solids
    }

    /// ⟨d⟩ [m]; where no grain is left, that of equal parts.
    pub fn sauter_diameter(&self) -> f64 {
        let solid: f64 = self.fractions.iter().sum();
        let surface: f64 = self
            .each()
            .map(|(grain, fraction)| fraction / grain.diameter)
            .sum();
        solid / surface
    }

    /// s_i [m/s].
    pub fn slips(&self) -> Vec<f64> {
        let density = self.density();
        let slip = |grain: &Grain| {
            // Buoyancy of the mixture in place of the fluid's.
            let pull = (grain.density - density) * grain.volume() * grain.gravity;
            pull.signum() * self.slip_under(grain, pull.abs())
        };
        self.grains.iter().map(slip).collect()
    }

    /// Drag on a grain at a superficial slip [N], both positive downwards or both upwards.
    pub fn drag(&self, grain: &Grain, slip: f64) -> f64 {
        let y = grain.diameter / self.sauter_diameter();
        let force = self.law.sized_force(grain.reynolds(slip), self.porosity(), y);
        force * unit_force(grain)
    }

    /// Superficial slip [m/s] at which the drag is a force [N], neither negative.
    fn slip_under(&self, grain: &Grain, force: f64) -> f64 {
        let speed = |re: f64| re * grain.viscosity / (grain.fluid_density * grain.diameter);
        let guess = force / unit_force(grain);
        let root = rising_root(|re| self.drag(grain, speed(re)) - force, guess);
        root.map_or(0.0, speed)
    }

    fn each(&self) -> impl Iterator<Item = (&Grain, f64)> {
        self.grains.iter().zip(self.fractions.iter().copied())
    }
}

/// 3πμ²/ρ_f [N]: Stokes drag at a Reynolds number of 1.
fn unit_force(grain: &Grain) -> f64 {
    3.0 * std::f64::consts::PI * grain.viscosity * grain.viscosity / grain.fluid_density
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::force_balance::ForceBalance;
    use crate::reference::grain::tests::GLASS;

    #[test]
    fn equal_grains_slip_as_their_force_balance_however_they_are_split() {
        for law in [DragLaw::DiFelice, DragLaw::BeetstraCello] {
            let alone = ForceBalance {
                grain: GLASS,
                law,
                porosity: 0.85,
            };
            let split = Mixture::by_number(law, &[(GLASS, 0.3), (GLASS, 0.7)], 0.85);
            for slip in split.slips() {
                assert!((slip / alone.settling_velocity() - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn drags_carry_the_weight_that_the_pressure_of_the_pure_fluid_leaves() {
        // Σ n_i (drag + pressure of the mixture) = Σ n_i buoyant weight: with φ_i = n_i V_i, all over ε.
        let heavy = Grain {
            density: 2450.0,
            diameter: 1.5e-4,
            ..GLASS
        };
        let light = Grain {
            density: 1100.0,
            ..GLASS
        };
        let mixture = Mixture::by_number(DragLaw::BeetstraCello, &[(heavy, 0.5), (light, 0.5)], 0.7);
        let slips = mixture.slips();
        assert!(slips[0] > 0.0 && slips[1] < 0.0, "{slips:?}");
        let grains = || mixture.each().zip(&slips);
        let drag: f64 = grains()
            .map(|((grain, fraction), slip)| {
                fraction / grain.volume() * slip.signum() * mixture.drag(grain, slip.abs())
            })
            .sum();
        let weight: f64 = grains()
            .map(|((grain, fraction), _)| fraction * (grain.density - grain.fluid_density) * grain.gravity)
            .sum();
        assert!((drag / (0.7 * weight) - 1.0).abs() < 1e-10);
    }
}
