//! Porosity in horizontal slices, and what moves between them and the grains.
//!
//! ```text
//! 1 − ε_k = Σ_i V_ik / (A Δ),   φ_i = Σ_k V_ik φ_k / V_i
//! ```
//!
//! V_ik is the part of grain i in slice k. What a grain reads is the transpose of what it gives. A
//! grain is at most one slice high, so it lies in two slices at the most. Fixed grains of a floor or a
//! filter medium are left out by not being given.

use std::f64::consts::PI;

/// Porosity below which the voidage functions are not asked [-].
pub const POROSITY_FLOOR: f64 = 0.3;
/// Slices at most: whatever flies higher counts in the last.
const MOST: usize = 1 << 16;

/// How much of a grain a slice holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The exact volume of the sphere between the two planes.
    Exact,
    /// The whole sphere in the slice of its centre.
    Centre,
    /// The whole disc in the slice of its centre: areas in place of volumes.
    Areas,
}

/// The slices a grain lies in.
#[derive(Clone, Copy, Debug)]
struct Place {
    lower: u32,
    /// Share of the grain in the lower slice, the rest in the one above.
    share: f64,
    /// V_i [m³], or the area of the disc [m²].
    content: f64,
}

#[derive(Clone, Debug)]
pub struct Slices {
    bottom: f64,
    height: f64,
    /// A Δ.
    capacity: f64,
    measure: Measure,
    places: Vec<Place>,
    porosity: Vec<f64>,
    sums: Vec<f64>,
    clips: u64,
}

impl Slices {
    /// Slices of `height` Δ [m], no less than the largest diameter, from `bottom` [m] up.
    ///
    /// `area` A is the cross-section of the container [m²]: in two dimensions its width times the
    /// largest diameter, as spheres in a slab so deep; for [`Measure::Areas`] its width alone [m].
    pub fn new(bottom: f64, height: f64, area: f64, measure: Measure) -> Slices {
        Slices {
            bottom,
            height,
            capacity: area * height,
            measure,
            places: Vec::new(),
            porosity: Vec::new(),
            sums: Vec::new(),
            clips: 0,
        }
    }

    /// Slices begin at this height [m] from the next call of [`place`](Self::place) on.
    pub fn begin(&mut self, bottom: f64) {
        self.bottom = bottom;
    }

    /// Takes grains with their heights [m] and radii [m]; slices reach over the highest of them.
    ///
    /// Everything else refers to the grains in this order.
    pub fn place(&mut self, grains: impl Iterator<Item = (f64, f64)>) {
        let (bottom, height, per_height) = (self.bottom, self.height, 1.0 / self.height);
        self.places.clear();
        match self.measure {
            Measure::Exact => self.places.extend(grains.map(|(z, radius)| {
                let lower = level((z - radius - bottom) * per_height);
                let plane = bottom + height * f64::from(lower + 1);
                let content = 4.0 / 3.0 * PI * radius * radius * radius;
                let share = share_below((plane - z) / radius);
                Place {
                    lower,
                    share,
                    content,
                }
            })),
            Measure::Centre | Measure::Areas => {
                let areas = self.measure == Measure::Areas;
                self.places.extend(grains.map(|(z, radius)| {
                    let thickness = if areas { 1.0 } else { 4.0 / 3.0 * radius };
                    Place {
                        lower: level((z - bottom) * per_height),
                        share: 1.0,
                        content: PI * radius * radius * thickness,
                    }
                }));
            }
        }
        let highest = self.places.iter().map(|place| place.lower).max();
        // One more than the lower slices, for the part above.
        self.sums
            .resize(highest.map_or(0, |lower| lower as usize + 2), 0.0);
        self.sum_porosity();
    }

    fn sum_porosity(&mut self) {
        spread(&self.places, std::iter::repeat(1.0), &mut self.sums);
        let per_capacity = 1.0 / self.capacity;
        self.porosity.clear();
        self.porosity
            .extend(self.sums.iter().map(|solids| 1.0 - solids * per_capacity));
        for porosity in &mut self.porosity {
            if *porosity < POROSITY_FLOOR {
                *porosity = POROSITY_FLOOR;
                self.clips += 1;
            }
        }
    }

    /// Number of slices.
    pub fn count(&self) -> usize {
        self.porosity.len()
    }

    /// Porosity [-] of every slice, from the bottom; above the last it is 1.
    pub fn porosity(&self) -> &[f64] {
        &self.porosity
    }

    /// Slices held at [`POROSITY_FLOOR`] so far, once per call of [`place`](Self::place).
    pub fn clips(&self) -> u64 {
        self.clips
    }

    /// Σ_i V_ik w_i / (A Δ) of every slice for one weight w per grain: with the velocities, the volume
    /// flux of the grains [m/s].
    pub fn deposit(&self, weights: impl Iterator<Item = f64>, densities: &mut Vec<f64>) {
        densities.clear();
        densities.resize(self.count(), 0.0);
        spread(&self.places, weights, densities);
        let per_capacity = 1.0 / self.capacity;
        densities.iter_mut().for_each(|sum| *sum *= per_capacity);
    }

    /// Upward velocity [m/s] of the fluid in every slice of a closed vessel, from those of the grains:
    /// u_f = −(1 − ε)⟨v⟩/ε, no net volume flux.
    pub fn return_flow(&self, speeds: impl Iterator<Item = f64>, flow: &mut Vec<f64>) {
        self.deposit(speeds, flow);
        for (flow, porosity) in flow.iter_mut().zip(&self.porosity) {
            *flow = -*flow / porosity;
        }
    }

    /// Mean of a field, one value per slice, over the slices a grain lies in.
    #[inline(always)]
    pub fn sample(&self, grain: usize, field: &[f64]) -> f64 {
        let place = &self.places[grain];
        let lower = place.lower as usize;
        let pair = &field[lower..lower + 2];
        pair[1] + place.share * (pair[0] - pair[1])
    }
}

/// Adds the shares of all grains to the slices' sums.
#[inline(always)]
fn spread(places: &[Place], weights: impl Iterator<Item = f64>, sums: &mut [f64]) {
    sums.fill(0.0);
    for (place, weight) in places.iter().zip(weights) {
        let whole = place.content * weight;
        let part = whole * place.share;
        let lower = place.lower as usize;
        let pair = &mut sums[lower..lower + 2];
        pair[0] += part;
        pair[1] += whole - part;
    }
}

/// The slice of a height in slices; the lowest for what is under the bottom or no number.
#[inline(always)]
fn level(position: f64) -> u32 {
    position.max(0.0).min((MOST - 1) as f64) as u32
}

/// Share of a sphere below a plane x radii over its centre: (1 + x)² (2 − x)/4.
#[inline(always)]
fn share_below(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    0.25 * (1.0 + x) * (1.0 + x) * (2.0 - x)
}

/// Volume [m³] of the part between two heights [m] of a sphere with its centre at height `z` [m].
///
/// Exact to rounding of the part itself where it is a thin slab, of the whole sphere otherwise.
pub fn sphere_volume_between(z: f64, radius: f64, low: f64, high: f64) -> f64 {
    let from = (low - z).clamp(-radius, radius);
    let to = (high - z).clamp(-radius, radius);
    let mean_square = (from * from + from * to + to * to) / 3.0;
    (PI * (to - from) * (radius * radius - mean_square)).max(0.0)
}

/// Volume [m³] between two heights [m] of spheres given by their heights [m] and radii [m].
pub fn solid_volume_between(grains: impl Iterator<Item = (f64, f64)>, low: f64, high: f64) -> f64 {
    grains
        .map(|(z, radius)| sphere_volume_between(z, radius, low, high))
        .sum()
}

#[cfg(test)]
mod tests;
