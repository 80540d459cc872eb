//! The one pass over all fluid pairs: continuity, pressure and viscosity at once.
//!
//! With V = m/(εϱ), F = W′(r)/r ≤ 0, r = x_a − x_b and v the difference of the velocities in the
//! records (mixture flux or fluid velocity), summed over b:
//!
//! ```text
//! ∇·u      = −Σ V_b F v·r
//! V_a σ_a  =  Σ V_a V_b F [ 2μ v − (p_a + p_b) r + K (v·r)/|r| r ]
//! ```
//!
//! The force is a sum over volumes, not masses: it vanishes for constant pressure whatever the
//! porosity does, and it is antisymmetric in a and b, so momentum is kept to rounding. The viscous
//! term yields μ∇²u (Morris et al. 1997, J. Comput. Phys. 136, 214); K = α ρ₀ c gives the always-on
//! artificial viscosity α c h/9 of Monaghan (1992) for Wendland C2. A record of the sweep holds
//! x, y, z, u_x, u_y, u_z, V, p.

use super::kernel::Kernel;
pub(super) use crate::neighbours::Record;
use crate::neighbours::{LANES, Rows, Wide, WideWork};

/// Constants of a sweep.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients {
    /// Smoothing length h [m].
    pub smoothing: f64,
    /// Viscosity μ of the Morris form [Pa s].
    pub viscosity: f64,
    /// K = α ρ₀ c [kg/(m² s)] of the artificial form.
    pub artificial: f64,
}

/// What the sweep gives each particle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rates {
    /// Force density σ = −∇p + ∇·τ [N/m³].
    pub stress: [f64; 3],
    /// ∇·u [1/s].
    pub divergence: f64,
}

/// Writes the rates of the particles that own the rows. `ARTIFICIAL` compiles the K term in.
pub struct Sweep<'a, K, const ARTIFICIAL: bool> {
    pub kernel: K,
    pub coefficients: Coefficients,
    pub records: &'a [Record],
    pub rows: &'a Rows,
    pub rates: &'a mut [Rates],
}

impl<K: Kernel, const ARTIFICIAL: bool> WideWork for Sweep<'_, K, ARTIFICIAL> {
    type Output = ();

    #[inline(always)]
    fn run<W: Wide>(self) {
        let Sweep {
            kernel,
            coefficients,
            records,
            rows,
            rates,
        } = self;
        let slope_unit = (1.0 / coefficients.smoothing).powi(5);
        let per_smoothing = W::splat(1.0 / coefficients.smoothing);
        let artificial = W::splat(coefficients.artificial);
        let viscous = 2.0 * coefficients.viscosity;
        for (target, rate) in rates.iter_mut().enumerate() {
            let mut own = [W::splat(0.0); 8];
            for (own, value) in own.iter_mut().zip(&records[target].0) {
                *own = W::splat(*value);
            }
            let mut pressed = [W::splat(0.0); 3];
            let mut sheared = [W::splat(0.0); 3];
            let mut approached = W::splat(0.0);
            for members in rows.row(target).as_chunks::<LANES>().0 {
                let other = W::gather(records, members);
                let r = [own[0] - other[0], own[1] - other[1], own[2] - other[2]];
                let v = [own[3] - other[3], own[4] - other[4], own[5] - other[5]];
                let distance = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
                let slope = other[6] * kernel.slope(distance * per_smoothing);
                let approach = v[0] * r[0] + v[1] * r[1] + v[2] * r[2];
                let mut along = slope * (own[7] + other[7]);
                if ARTIFICIAL {
                    along = along - slope * artificial * approach / distance;
                }
                for axis in 0..3 {
                    pressed[axis] = pressed[axis] + along * r[axis];
                    sheared[axis] = sheared[axis] + slope * v[axis];
                }
                approached = approached + slope * approach;
            }
            for axis in 0..3 {
                let stress = viscous * sheared[axis].total() - pressed[axis].total();
                rate.stress[axis] = stress * slope_unit;
            }
            rate.divergence = -approached.total() * slope_unit;
        }
    }
}
