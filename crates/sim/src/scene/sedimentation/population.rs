//! What a scene's grains are together: extremes, number, volume and the room they have.

use std::f64::consts::PI;

use super::model::{Dimensions, GrainClass, Sedimentation, Sides};
use crate::contact::Body;

impl GrainClass {
    /// Largest diameter in the class [m].
    pub fn largest(&self) -> f64 {
        self.largest_diameter.unwrap_or(self.diameter).max(self.diameter)
    }

    /// Mean of d² over the class [m²]; with p(R) = R₁R₂/((R₂ − R₁)R²) it is d₁ d₂.
    pub fn mean_square(&self) -> f64 {
        self.diameter * self.largest()
    }

    /// Mean of d³ over the class [m³]; with the same density d₁ d₂ (d₁ + d₂)/2.
    pub fn mean_cube(&self) -> f64 {
        self.mean_square() * 0.5 * (self.diameter + self.largest())
    }
}

impl Sedimentation {
    /// Classes that have grains; all of them where none has.
    pub fn present(&self) -> impl Iterator<Item = &GrainClass> {
        let empty = self.grains() == 0;
        self.classes.iter().filter(move |class| empty || class.number > 0)
    }

    /// Number of grains.
    pub fn grains(&self) -> u64 {
        self.classes.iter().map(|class| u64::from(class.number)).sum()
    }

    /// Largest diameter [m]; zero without classes.
    pub fn largest_diameter(&self) -> f64 {
        self.present().map(GrainClass::largest).fold(0.0, f64::max)
    }

    /// Smallest diameter [m].
    pub fn smallest_diameter(&self) -> f64 {
        self.present()
            .map(|class| class.diameter)
            .fold(f64::INFINITY, f64::min)
    }

    /// Extent of the box along y [m]: one largest diameter in two dimensions.
    pub fn depth(&self) -> f64 {
        match self.dimensions {
            Dimensions::Two => self.largest_diameter(),
            Dimensions::Three => self.container.depth,
        }
    }

    /// Whether the box repeats itself along x, along y.
    pub fn periodic(&self) -> [bool; 2] {
        match self.container.sides {
            Sides::Walls => [false; 2],
            Sides::Periodic => [true; 2],
            Sides::PeriodicAlongX => [true, false],
        }
    }

    /// Expected share of the box that the grains fill [-]: of its volume, in two dimensions of its area.
    pub fn filled(&self) -> f64 {
        let plane = self.container.width * self.container.height;
        let number = |class: &GrainClass| f64::from(class.number);
        match self.dimensions {
            Dimensions::Two => {
                let areas = self
                    .classes
                    .iter()
                    .map(|class| number(class) * class.mean_square());
                PI / 4.0 * areas.sum::<f64>() / plane
            }
            Dimensions::Three => self.solids() / (plane * self.depth()),
        }
    }

    /// Expected volume of all grains [m³].
    pub fn solids(&self) -> f64 {
        let volumes = self
            .classes
            .iter()
            .map(|class| f64::from(class.number) * class.mean_cube());
        PI / 6.0 * volumes.sum::<f64>()
    }

    /// Diameter [m] of equal spheres with as much surface per volume, expected.
    pub fn sauter_diameter(&self) -> f64 {
        let sum = |mean: fn(&GrainClass) -> f64| -> f64 {
            self.present()
                .map(|class| f64::from(class.number) * mean(class))
                .sum()
        };
        sum(GrainClass::mean_cube) / sum(GrainClass::mean_square)
    }

    /// Volume fraction of the grains in the box as the fluid sees it [-].
    pub fn solids_fraction(&self) -> f64 {
        self.solids() / (self.container.width * self.container.height * self.depth())
    }

    /// The smallest and the largest grain of every class, with its density [kg/m³].
    pub fn extremes(&self) -> Vec<(Body, f64)> {
        let both = |class: &GrainClass| {
            let (small, large) = (class.diameter, class.largest());
            let diameters = if large > small {
                vec![small, large]
            } else {
                vec![small]
            };
            let density = class.density;
            diameters
                .into_iter()
                .map(move |diameter| (Body::sphere(diameter, density), density))
        };
        self.present().flat_map(both).collect()
    }

    /// Weight less buoyancy of all grains [N], each counted with its sign off.
    pub fn load(&self) -> f64 {
        let medium = self.fluid.medium();
        let excess = |class: &GrainClass| {
            f64::from(class.number) * class.mean_cube() * (class.density - medium.density).abs()
        };
        PI / 6.0 * self.gravity * self.classes.iter().map(excess).sum::<f64>()
    }
}
