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
#[cfg(target_arch = "x86_64")]
use crate::neighbours::gather_avx512;
use crate::neighbours::{LANES, Lanes, Rows, gather};

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

/// Rates of the particles that own the rows. `ARTIFICIAL` compiles the K term in.
pub fn sweep<K: Kernel, const ARTIFICIAL: bool>(
    kernel: K,
    coefficients: &Coefficients,
    records: &[Record],
    rows: &Rows,
    rates: &mut [Rates],
) {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
            // SAFETY: the features were just detected.
            return unsafe { sweep_avx512::<K, ARTIFICIAL>(kernel, coefficients, records, rows, rates) };
        }
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the feature was just detected.
            return unsafe { sweep_avx2::<K, ARTIFICIAL>(kernel, coefficients, records, rows, rates) };
        }
    }
    sweep_lanes::<K, ARTIFICIAL>(kernel, coefficients, records, rows, rates, gather);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn sweep_avx512<K: Kernel, const ARTIFICIAL: bool>(
    kernel: K,
    coefficients: &Coefficients,
    records: &[Record],
    rows: &Rows,
    rates: &mut [Rates],
) {
    sweep_lanes::<K, ARTIFICIAL>(kernel, coefficients, records, rows, rates, |records, members| {
        gather_avx512(records, members)
    });
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn sweep_avx2<K: Kernel, const ARTIFICIAL: bool>(
    kernel: K,
    coefficients: &Coefficients,
    records: &[Record],
    rows: &Rows,
    rates: &mut [Rates],
) {
    sweep_lanes::<K, ARTIFICIAL>(kernel, coefficients, records, rows, rates, gather);
}

#[inline(always)]
fn sweep_lanes<K: Kernel, const ARTIFICIAL: bool>(
    kernel: K,
    coefficients: &Coefficients,
    records: &[Record],
    rows: &Rows,
    rates: &mut [Rates],
    gather: impl Fn(&[Record], &[u32; LANES]) -> [Lanes; 8],
) {
    let per_smoothing = 1.0 / coefficients.smoothing;
    let slope_unit = per_smoothing.powi(5);
    for (target, rate) in rates.iter_mut().enumerate() {
        let own = records[target].0;
        let mut sums = [[0.0; LANES]; 7];
        for members in rows.row(target).as_chunks::<LANES>().0 {
            let fields = gather(records, members);
            for lane in 0..LANES {
                let r = [
                    own[0] - fields[0][lane],
                    own[1] - fields[1][lane],
                    own[2] - fields[2][lane],
                ];
                let v = [
                    own[3] - fields[3][lane],
                    own[4] - fields[4][lane],
                    own[5] - fields[5][lane],
                ];
                let distance = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
                let slope = fields[6][lane] * kernel.slope(distance * per_smoothing);
                let approach = v[0] * r[0] + v[1] * r[1] + v[2] * r[2];
                let mut along = slope * (own[7] + fields[7][lane]);
                if ARTIFICIAL {
                    along -= slope * coefficients.artificial * approach / distance;
                }
                for axis in 0..3 {
                    sums[axis][lane] += along * r[axis];
                    sums[3 + axis][lane] += slope * v[axis];
                }
                sums[6][lane] += slope * approach;
            }
        }
        let total = sums.map(|lanes| lanes.iter().sum::<f64>() * slope_unit);
        let viscous = 2.0 * coefficients.viscosity;
        *rate = Rates {
            stress: [0, 1, 2].map(|axis| viscous * total[3 + axis] - total[axis]),
            divergence: -total[6],
        };
    }
}
