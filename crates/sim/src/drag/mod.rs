//! Drag on one grain as a correction to Stokes drag, so that rest needs no branch.
//!
//! Force on the grain, with the superficial slip u_s = ε (u_f − v) and Re = ρ_f d |u_s| / μ:
//!
//! ```text
//! f = 3π μ d · factor(Re) · voidage(ε, Re) · u_s
//! ```
//!
//! This is the drag of model A, which leaves the pressure gradient force apart; model B
//! divides it by ε and uses the buoyancy of the pure fluid.

mod any;
mod beetstra;
mod beetstra_cello;
mod coulson_richardson;
mod dallavalle;
mod di_felice;
pub mod lift;
mod polydisperse;
mod schiller_naumann;
mod stokes;
pub mod voidage;

pub use any::{AnyDrag, AnyVoidage, SphereDrag};
pub use beetstra::Beetstra;
pub use beetstra_cello::BeetstraCello;
pub use coulson_richardson::CoulsonRichardson;
pub use dallavalle::Dallavalle;
pub use di_felice::DiFelice;
pub use lift::{LiftLaw, Magnus, Saffman, Whirl};
pub use polydisperse::{PolydisperseLaw, polydisperse_coefficient};
pub use schiller_naumann::SchillerNaumann;
pub use stokes::Stokes;
pub use voidage::{Hindered, VoidageLaw};

use std::f64::consts::PI;

use crate::math::Number;

/// A drag law: parameters in, numbers out.
pub trait DragLaw: Copy {
    /// Drag over Stokes drag at Reynolds number `re` [-] and porosity `porosity` [-].
    fn factor<N: Number>(&self, re: N, porosity: N) -> N;
}

/// No drag at all.
impl DragLaw for () {
    #[inline(always)]
    fn factor<N: Number>(&self, _re: N, _porosity: N) -> N {
        N::splat(0.0)
    }
}

/// Drag per superficial slip β [kg/s] of grains of `diameter` [m] at slip speed `slip` [m/s] in a
/// fluid of `density` [kg/m³] and `viscosity` [Pa s].
#[inline(always)]
pub fn coefficient<N: Number>(
    law: &impl DragLaw,
    [density, viscosity]: [f64; 2],
    diameter: N,
    slip: N,
    porosity: N,
) -> N {
    let re = N::splat(density) * diameter * slip / N::splat(viscosity);
    N::splat(3.0 * PI * viscosity) * diameter * law.factor(re, porosity)
}

/// The fluid and the size a drag coefficient needs.
#[derive(Clone, Copy, Debug)]
pub struct DragScale {
    /// Grain diameter d [m].
    pub diameter: f64,
    /// Fluid density ρ_f [kg/m³].
    pub density: f64,
    /// Fluid viscosity μ [Pa s].
    pub viscosity: f64,
}

impl DragScale {
    /// Reynolds number of a superficial slip speed [-].
    pub fn reynolds(&self, slip: f64) -> f64 {
        self.density * self.diameter * slip / self.viscosity
    }

    /// Drag per superficial slip β [kg/s] at slip speed `slip` [m/s].
    #[inline]
    pub fn coefficient(&self, law: &impl DragLaw, slip: f64, porosity: f64) -> f64 {
        let fluid = [self.density, self.viscosity];
        coefficient(law, fluid, self.diameter, slip, porosity)
    }

    /// Superficial slip speed [m/s] at which the drag equals `force` [N].
    pub fn balance(&self, law: &impl DragLaw, force: f64, porosity: f64) -> f64 {
        let drag = |slip: f64| slip * self.coefficient(law, slip, porosity) - force;
        let mut high = force / (3.0 * PI * self.viscosity * self.diameter);
        while drag(high) < 0.0 {
            high *= 2.0;
        }
        crate::math::bisect(0.0, high, drag)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "x86_64")]
    use crate::neighbours::{Avx2, Avx512};
    use crate::neighbours::{Plain, Wide};

    const WATER: DragScale = DragScale {
        diameter: 1e-4,
        density: 1000.0,
        viscosity: 0.89e-3,
    };

    #[test]
    fn balance_returns_the_slip_that_carries_the_force() {
        for law in [0.3, 0.6, 0.95] {
            let slip = WATER.balance(&DiFelice, 7.0e-9, law);
            let force = slip * WATER.coefficient(&DiFelice, slip, law);
            assert!((force / 7.0e-9 - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn hindered_settling_of_the_reference_suspension_is_4_91_millimetres_per_second() {
        // Force balance of Raso (2014) eq. 4.4 with 0.63² at porosity 0.9: 4.912 mm/s.
        let weight = PI / 6.0 * 1e-12 * 1500.0 * 9.81;
        let speed = WATER.balance(&DiFelice, 0.9 * weight, 0.9);
        assert!((speed - 4.91237e-3).abs() < 2e-8, "{speed}");
    }

    fn on_lanes<W: Wide>(law: &impl DragLaw) {
        for group in 0..64 {
            let re: [f64; 8] =
                std::array::from_fn(|lane| (0.05 * f64::from(group * 8 + lane as i32)).powi(3));
            let porosity: [f64; 8] = std::array::from_fn(|lane| 1.0 - 0.08 * lane as f64);
            let wide = law.factor(W::from_lanes(re), W::from_lanes(porosity)).lanes();
            let single: [f64; 8] = std::array::from_fn(|lane| law.factor(re[lane], porosity[lane]));
            assert_eq!(wide, single);
            let sizes: [f64; 8] = std::array::from_fn(|lane| 0.4 + 0.3 * lane as f64);
            let mixed = BeetstraCello;
            let wide = PolydisperseLaw::factor(
                &mixed,
                W::from_lanes(re),
                W::from_lanes(porosity),
                W::from_lanes(sizes),
            );
            let single: [f64; 8] = std::array::from_fn(|lane| {
                PolydisperseLaw::factor(&mixed, re[lane], porosity[lane], sizes[lane])
            });
            assert_eq!(wide.lanes(), single);
        }
    }

    fn on_all_registers(law: impl DragLaw) {
        on_lanes::<Plain>(&law);
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                on_lanes::<Avx2>(&law);
            }
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                on_lanes::<Avx512>(&law);
            }
        }
    }

    #[test]
    fn eight_grains_side_by_side_drag_as_each_alone() {
        on_all_registers(Stokes);
        on_all_registers(Dallavalle);
        on_all_registers(SchillerNaumann);
        on_all_registers(CoulsonRichardson);
        on_all_registers(DiFelice);
        on_all_registers(Beetstra);
        on_all_registers(Hindered {
            sphere: SchillerNaumann,
            voidage: voidage::AlvimLiteral,
        });
    }
}
