//! The box that grains are arranged in.

use super::{CLEARANCE, Fault};
use crate::math::Vec3;
use std::f64::consts::PI;

/// Whether grains fill a space or a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimensions {
    /// Discs in the plane y = 0.
    Two,
    /// Spheres.
    Three,
}

/// A box 0 ≤ x ≤ width, 0 ≤ y ≤ depth, 0 ≤ z ≤ height. Floor and lid hold every grain's surface inside,
/// and so do the sides unless they are periodic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Along x [m].
    pub width: f64,
    /// Along y [m]; not read in two dimensions.
    pub depth: f64,
    /// Along z [m].
    pub height: f64,
    /// Whether what leaves through a side across x, across y comes back through the opposite one.
    pub periodic: [bool; 2],
    pub dimensions: Dimensions,
}

impl Region {
    /// Volume of the box [m³], in two dimensions the area of its plane [m²].
    pub fn measure(&self) -> f64 {
        match self.dimensions {
            Dimensions::Two => self.width * self.height,
            Dimensions::Three => self.width * self.depth * self.height,
        }
    }

    /// Share of the box filled by spheres of these radii [m], in two dimensions by their discs [-].
    pub fn solids_fraction(&self, radii: &[f64]) -> f64 {
        solids(self.dimensions, radii) / self.measure()
    }

    /// The shortest vector [m] among those that differ by whole periods; `difference` is that of two
    /// points inside.
    #[inline(always)]
    pub fn nearest(&self, mut difference: Vec3) -> Vec3 {
        if self.periodic[0] {
            difference.x = nearest(difference.x, self.width);
        }
        if self.periodic[1] {
            difference.y = nearest(difference.y, self.depth);
        }
        difference
    }

    /// Whether an axis (0, 1, 2 for x, y, z) is periodic.
    pub(super) fn wraps(&self, axis: usize) -> bool {
        axis < 2 && self.periodic[axis] && (axis == 0 || self.dimensions == Dimensions::Three)
    }

    /// The box along x, y, z [m]; flat in two dimensions.
    pub(super) fn lengths(&self) -> [f64; 3] {
        let depth = match self.dimensions {
            Dimensions::Two => 0.0,
            Dimensions::Three => self.depth,
        };
        [self.width, depth, self.height]
    }

    /// Where the centre of a grain may lie along an axis [m].
    pub(super) fn bounds(&self, axis: usize, radius: f64) -> (f64, f64) {
        let length = self.lengths()[axis];
        let margin = radius * (1.0 + CLEARANCE);
        if self.wraps(axis) {
            (0.0, length)
        } else if 2.0 * margin >= length {
            (0.5 * length, 0.5 * length)
        } else {
            (margin, length - margin)
        }
    }

    /// Brings a coordinate [m] back inside: by whole periods, or to the nearest place a grain may have.
    #[inline]
    pub(super) fn confine(&self, axis: usize, radius: f64, coordinate: f64) -> f64 {
        let (low, high) = self.bounds(axis, radius);
        if !self.wraps(axis) {
            return coordinate.max(low).min(high);
        }
        if (0.0..high).contains(&coordinate) {
            return coordinate;
        }
        let wrapped = coordinate - high * (coordinate / high).floor();
        // What lies just below zero rounds to the full period.
        if wrapped < high { wrapped } else { 0.0 }
    }

    /// Whether the box and grains of these radii [m] make sense at all.
    pub(super) fn check(&self, radii: &[f64]) -> Result<(), Fault> {
        let used = match self.dimensions {
            Dimensions::Two => vec![("width", self.width), ("height", self.height)],
            Dimensions::Three => vec![
                ("width", self.width),
                ("depth", self.depth),
                ("height", self.height),
            ],
        };
        for &(name, length) in &used {
            if !(length > 0.0 && length.is_finite()) {
                return Err(Fault::Length { name, length });
            }
        }
        if let Some((grain, &radius)) = radii
            .iter()
            .enumerate()
            .find(|(_, r)| !(**r > 0.0 && r.is_finite()))
        {
            return Err(Fault::Radius { grain, radius });
        }
        let Some((grain, radius)) = largest(radii) else {
            return Ok(());
        };
        match used.into_iter().find(|&(_, length)| 2.0 * radius > length) {
            Some((name, length)) => Err(Fault::GrainTooLarge {
                grain,
                diameter: 2.0 * radius,
                name,
                length,
            }),
            None => Ok(()),
        }
    }
}

/// Volume of spheres [m³], in two dimensions the area of their discs [m²].
pub(super) fn solids(dimensions: Dimensions, radii: &[f64]) -> f64 {
    match dimensions {
        Dimensions::Two => radii.iter().map(|r| PI * r * r).sum(),
        Dimensions::Three => radii.iter().map(|r| 4.0 / 3.0 * PI * r * r * r).sum(),
    }
}

fn largest(radii: &[f64]) -> Option<(usize, f64)> {
    radii
        .iter()
        .copied()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

#[inline(always)]
fn nearest(difference: f64, period: f64) -> f64 {
    if difference > 0.5 * period {
        difference - period
    } else if difference < -0.5 * period {
        difference + period
    } else {
        difference
    }
}
