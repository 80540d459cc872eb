//! The drag on all grains, eight side by side.

use crate::drag::{PolydisperseLaw, polydisperse_coefficient};
use crate::neighbours::{LANES, Wide, WideWork};

/// What the drag on a grain depends on.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct DragState {
    /// d [m] and d over the local Sauter mean [-].
    pub diameter: f64,
    pub relative_diameter: f64,
    /// Superficial slip speed [m/s].
    pub slip: f64,
    /// ε [-].
    pub porosity: f64,
}

/// β [kg/s] of every grain.
pub(super) struct DragOnAll<'a, L> {
    pub law: L,
    /// Density [kg/m³] and viscosity [Pa s].
    pub fluid: [f64; 2],
    pub states: &'a [DragState],
    pub coefficients: &'a mut [f64],
}

impl<L: PolydisperseLaw> WideWork for DragOnAll<'_, L> {
    type Output = ();

    #[inline(always)]
    fn run<W: Wide>(self) {
        for (states, coefficients) in self.states.chunks(LANES).zip(self.coefficients.chunks_mut(LANES)) {
            let [mut diameter, mut relative, mut slip, mut porosity] = [[1.0; LANES]; 4];
            for (lane, state) in states.iter().enumerate() {
                diameter[lane] = state.diameter;
                relative[lane] = state.relative_diameter;
                slip[lane] = state.slip;
                porosity[lane] = state.porosity;
            }
            let sizes = [W::from_lanes(diameter), W::from_lanes(relative)];
            let (slip, porosity) = (W::from_lanes(slip), W::from_lanes(porosity));
            let lanes = polydisperse_coefficient(&self.law, self.fluid, sizes, slip, porosity).lanes();
            coefficients.copy_from_slice(&lanes[..coefficients.len()]);
        }
    }
}
