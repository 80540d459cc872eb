//! The grains of a suspension as a bed: contacts, step and start.
//!
//! In a closed column a suspension is a sedimentation that begins everywhere; what both need is that of the
//! sedimentation scene.

use super::model::{Homogeneity, SuspendedClass, Suspension};
use crate::contact::{Body, CundallStrack, EffectiveMass, LinearSpringDashpot};
use crate::scene::sedimentation::{
    Arrangement, Container, Detection, Dimensions, Floor, GrainClass, GrainDrag, Lift, Sedimentation, Sides,
    SlicePorosity, StillFluid, Until, Voidage,
};
use crate::scene::{Drag, IntegratorChoice, Normal, Rolling, Tangential};

/// Overlap [-] that the picked stiffness allows, over the smallest diameter.
const OVERLAP: f64 = 0.0025;
/// Stiffness of the tangential spring over that of the normal one: a sphere's slip is resisted by 2/7 of
/// its mass, so that slip and approach swing at the same rate.
const TANGENTIAL: f64 = 2.0 / 7.0;

impl Suspension {
    /// The same grains as a sedimentation in a closed column.
    pub fn as_sedimentation(&self) -> Sedimentation {
        let (drag, voidage) = drag(self.drag);
        let mut scene = Sedimentation {
            dimensions: Dimensions::Three,
            classes: self.grain_classes(),
            container: Container {
                width: self.column.width,
                depth: self.column.width,
                height: self.column.height,
                sides: Sides::Periodic,
                floor: Floor::Flat,
            },
            arrangement: match self.arrangement {
                Homogeneity::Even => Arrangement::Even,
                Homogeneity::Random => Arrangement::Random,
            },
            normal: self.normal(1.0),
            tangential: Tangential::None,
            rolling: Rolling::None,
            cohesion: None,
            charge: None,
            drag,
            voidage,
            porosity: SlicePorosity::Exact,
            lift: Lift::None,
            fluid: StillFluid::Column(self.fluid.medium()),
            gravity: self.gravity,
            duration: self.duration,
            until: Until::Duration,
            integrator: IntegratorChoice::VelocityVerlet,
            detection: Detection::List { skin: None },
            sleeping: true,
            central_slice: 0.8,
            steps_per_contact: self.steps_per_contact,
            time_step: self.time_step,
            unsafe_time_step: self.unsafe_time_step,
            threads: self.threads,
            seed: self.seed,
            snapshots: self.snapshots,
        };
        let stiffness = self.contact.stiffness.unwrap_or_else(|| softest(&scene));
        scene.normal = self.normal(stiffness);
        scene.tangential = self.tangential(stiffness);
        scene
    }

    fn grain_classes(&self) -> Vec<GrainClass> {
        let class = |(class, number): (&SuspendedClass, u64)| GrainClass {
            diameter: class.diameter,
            largest_diameter: None,
            density: class.density,
            number: u32::try_from(number).unwrap_or(u32::MAX),
        };
        self.classes.iter().zip(self.numbers()).map(class).collect()
    }

    fn normal(&self, stiffness: f64) -> Normal {
        Normal::LinearSpringDashpot {
            stiffness,
            restitution: self.contact.restitution,
            effective_mass: EffectiveMass::Reduced,
        }
    }

    /// Slip is damped as approach is, for the lightest pair.
    fn tangential(&self, stiffness: f64) -> Tangential {
        let Some(friction) = self.contact.friction else {
            return Tangential::None;
        };
        let masses = self.classes.iter().map(|class| sphere(class).mass);
        let lightest = masses.fold(f64::INFINITY, f64::min);
        let law = LinearSpringDashpot::with_restitution(stiffness, self.contact.restitution);
        let damping = 2.0 * law.damping_ratio * (0.5 * lightest * stiffness).sqrt();
        Tangential::CundallStrack(CundallStrack {
            stiffness: TANGENTIAL * stiffness,
            damping: TANGENTIAL * damping,
            friction,
        })
    }
}

pub fn sphere(class: &SuspendedClass) -> Body {
    Body::sphere(class.diameter, class.density)
}

/// Drag of a sphere and what the neighbours make of it.
fn drag(drag: Drag) -> (GrainDrag, Voidage) {
    match drag {
        Drag::Stokes => (GrainDrag::Stokes, Voidage::None),
        Drag::Dallavalle => (GrainDrag::Dallavalle, Voidage::None),
        Drag::SchillerNaumann => (GrainDrag::SchillerNaumann, Voidage::None),
        Drag::DiFelice => (GrainDrag::Dallavalle, Voidage::DiFelice),
        Drag::CoulsonRichardson => (GrainDrag::CoulsonRichardson, Voidage::None),
        Drag::Beetstra => (GrainDrag::Beetstra, Voidage::None),
        Drag::BeetstraCello => (GrainDrag::BeetstraCello, Voidage::None),
    }
}

/// The softest spring [N/m] that keeps the impact of the fastest isolated grain and the load of the settled
/// bed on its lowest layer within the overlap.
fn softest(scene: &Sedimentation) -> f64 {
    let grains = scene.extremes();
    let overlap = OVERLAP * scene.smallest_diameter();
    let fastest = grains
        .iter()
        .map(|(grain, density)| scene.greatest_speed(grain, *density))
        .fold(0.0, f64::max);
    let impact = |(grain, _): &(Body, f64)| {
        LinearSpringDashpot::stiffness_for_overlap(0.5 * grain.mass, fastest, overlap)
    };
    let area = scene.container.width * scene.depth();
    let carried = scene.load() * (scene.largest_diameter().powi(2) / area).min(1.0);
    grains.iter().map(impact).fold(carried / overlap, f64::max)
}
