//! The floor of a box, its side walls, and the fixed grains that may make the floor.

use super::model::{Dimensions, Floor, FloorGrains, Sedimentation};
use crate::bed::{Grain, Wall};
use crate::contact::Body;
use crate::math::Vec3;

/// Least distance of two layers of fixed grains, over their diameter [-]: nets with wide gaps would
/// otherwise lie in one plane.
const LEAST_DROP: f64 = 0.5;

impl FloorGrains {
    /// Number of grains along a side [m]. Gaps are no wider than asked for: the last ones may overlap a
    /// little.
    pub fn along(&self, side: f64) -> u32 {
        // A side made of whole pitches may be off by rounding.
        (side / (self.diameter + self.gap) * (1.0 - 1e-9)).ceil().max(1.0) as u32
    }

    /// Distance of neighbours along a side [m].
    pub fn pitch(&self, side: f64) -> f64 {
        side / f64::from(self.along(side))
    }

    /// Height of a layer's centres over those of the next one below [m].
    fn drop(&self, scene: &Sedimentation) -> f64 {
        let half = |side: f64| 0.5 * self.pitch(side);
        let sideways = match scene.dimensions {
            Dimensions::Two => half(scene.container.width).powi(2),
            Dimensions::Three => half(scene.container.width).powi(2) + half(scene.container.depth).powi(2),
        };
        let least = LEAST_DROP * self.diameter;
        (self.diameter * self.diameter - sideways)
            .max(least * least)
            .sqrt()
    }

    /// Lowest point of the lowest layer [m].
    fn bottom(&self, scene: &Sedimentation) -> f64 {
        let under = f64::from(self.layers.max(1) - 1);
        -under * self.drop(scene) - 0.5 * self.diameter
    }

    /// Diameter [m] of the largest sphere that falls through the widest hole of a layer.
    pub fn hole(&self, scene: &Sedimentation) -> f64 {
        let widths = [self.pitch(scene.container.width), self.pitch(scene.depth())];
        let across = match scene.dimensions {
            Dimensions::Two => widths[0],
            Dimensions::Three => widths[0].hypot(widths[1]),
        };
        across - self.diameter
    }
}

impl Sedimentation {
    /// Height of the floor's highest points [m].
    pub fn floor_top(&self) -> f64 {
        match self.container.floor {
            Floor::Flat => 0.0,
            Floor::Grains(floor) => 0.5 * floor.diameter,
        }
    }

    /// Height below which no point of the floor lies [m].
    pub fn floor_bottom(&self) -> f64 {
        match self.container.floor {
            Floor::Flat => 0.0,
            Floor::Grains(floor) => floor.bottom(self),
        }
    }

    /// Height of the flat wall that ends the box below [m]. Under a floor of grains it only catches what
    /// falls through.
    pub fn bottom_wall(&self) -> f64 {
        match self.container.floor {
            Floor::Flat => 0.0,
            Floor::Grains(floor) => floor.bottom(self) - 0.5 * floor.diameter - self.largest_diameter(),
        }
    }
}

/// Fixed grains of the floor, layer by layer from the top, centres of the first at z = 0.
pub fn floor_grains(scene: &Sedimentation) -> Vec<Grain> {
    let Floor::Grains(floor) = scene.container.floor else {
        return Vec::new();
    };
    let container = &scene.container;
    let rows = match scene.dimensions {
        Dimensions::Two => 1,
        Dimensions::Three => floor.along(container.depth),
    };
    let mut grains = Vec::new();
    for layer in 0..floor.layers.max(1) {
        // Every other layer lies in the hollows.
        let shift = if layer % 2 == 0 { 0.5 } else { 1.0 };
        let place = |count: u32, side: f64| floor.pitch(side) * (f64::from(count) + shift);
        for row in 0..rows {
            for column in 0..floor.along(container.width) {
                let y = match scene.dimensions {
                    Dimensions::Two => 0.0,
                    Dimensions::Three => place(row, container.depth),
                };
                let z = -f64::from(layer) * floor.drop(scene);
                grains.push(Grain {
                    body: Body::sphere(floor.diameter, 1.0),
                    class: u16::MAX,
                    position: Vec3::new(place(column, container.width), y, z),
                    velocity: Vec3::zeros(),
                    angular_velocity: Vec3::zeros(),
                });
            }
        }
    }
    grains
}

/// The bottom wall first, then those at the sides.
pub fn walls(scene: &Sedimentation) -> Vec<Wall> {
    let mut walls = vec![Wall {
        normal: Vec3::z(),
        point: Vec3::new(0.0, 0.0, scene.bottom_wall()),
    }];
    let far = Vec3::new(scene.container.width, scene.depth(), 0.0);
    let mut pair = |normal: Vec3| {
        walls.push(Wall {
            normal,
            point: Vec3::zeros(),
        });
        walls.push(Wall {
            normal: -normal,
            point: far,
        });
    };
    let [along, across] = scene.periodic();
    if !along {
        pair(Vec3::x());
    }
    if scene.dimensions == Dimensions::Three && !across {
        pair(Vec3::y());
    }
    walls
}
