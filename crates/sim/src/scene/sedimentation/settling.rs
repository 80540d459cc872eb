//! How fast grains fall before they meet anything: estimates for the step and for what is told.

use super::model::{Charge, GrainDrag, Sedimentation, StillFluid, Voidage};
use crate::cohesion::Coulomb;
use crate::contact::Body;
use crate::drag::{self, AnyDrag, AnyVoidage, SphereDrag};
use crate::math::bisect;
use crate::scene::Medium;

impl StillFluid {
    pub fn medium(&self) -> &Medium {
        match self {
            StillFluid::Still(medium) | StillFluid::Column(medium) => medium,
        }
    }
}

impl Charge {
    pub fn law(&self) -> Coulomb {
        Coulomb {
            relative_permittivity: self.relative_permittivity,
        }
    }
}

impl Sedimentation {
    /// Weight less buoyancy of a grain [N], sign off.
    pub fn excess_weight(&self, grain: &Body, density: f64) -> f64 {
        grain.mass * (1.0 - self.fluid.medium().density / density).abs() * self.gravity
    }

    /// Reynolds number of a grain at a superficial slip speed [m/s].
    pub fn reynolds(&self, grain: &Body, slip: f64) -> f64 {
        let medium = self.fluid.medium();
        medium.density * 2.0 * grain.radius * slip / medium.viscosity
    }

    /// Drag per superficial slip β [kg/s] at a slip speed [m/s] and a porosity [-]; zero without drag.
    pub fn drag_coefficient(&self, grain: &Body, slip: f64, porosity: f64) -> f64 {
        let medium = self.fluid.medium();
        self.drag_law().map_or(0.0, |law| {
            let fluid = [medium.density, medium.viscosity];
            drag::coefficient(&law, fluid, 2.0 * grain.radius, slip, porosity)
        })
    }

    /// The law that drags every grain; `None` without drag.
    pub fn drag_law(&self) -> Option<AnyDrag> {
        let sphere = match self.drag {
            GrainDrag::None => return None,
            GrainDrag::Stokes => SphereDrag::Stokes,
            GrainDrag::Dallavalle => SphereDrag::Dallavalle,
            GrainDrag::SchillerNaumann => SphereDrag::SchillerNaumann,
            GrainDrag::CoulsonRichardson => SphereDrag::CoulsonRichardson,
            GrainDrag::Beetstra => SphereDrag::Beetstra,
            GrainDrag::BeetstraCello => SphereDrag::BeetstraCello,
        };
        let voidage = match self.voidage {
            Voidage::None => AnyVoidage::None,
            Voidage::DiFelice => AnyVoidage::DiFelice,
            Voidage::AlvimLiteral => AnyVoidage::AlvimLiteral,
        };
        Some(AnyDrag { sphere, voidage })
    }

    /// Speed [m/s] at which a grain falls among others at `porosity` once it no longer gains speed;
    /// `None` where nothing stops it from gaining.
    pub fn settling_speed(&self, grain: &Body, density: f64, porosity: f64) -> Option<f64> {
        if self.drag == GrainDrag::None {
            return None;
        }
        // Buoyancy of the pure fluid: the drag is divided by the porosity.
        let force = porosity * self.excess_weight(grain, density);
        let balance = |slip: f64| slip * self.drag_coefficient(grain, slip, porosity) - force;
        let mut high = force / self.drag_coefficient(grain, 0.0, porosity);
        while balance(high) < 0.0 {
            high *= 2.0;
        }
        let slip = if force > 0.0 {
            bisect(0.0, high, balance)
        } else {
            0.0
        };
        Some(match self.fluid {
            StillFluid::Still(_) => slip / porosity,
            // The return flow takes the rest.
            StillFluid::Column(_) => slip,
        })
    }

    /// Greatest speed [m/s] of an isolated grain that falls from rest through the box.
    pub fn greatest_speed(&self, grain: &Body, density: f64) -> f64 {
        let acceleration = self.excess_weight(grain, density) / grain.mass;
        let free = (2.0 * acceleration * self.container.height).sqrt();
        self.settling_speed(grain, density, 1.0)
            .map_or(free, |speed| speed.min(free))
    }
}
