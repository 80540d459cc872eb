//! From a collision scene to bodies, contact time and step.

use super::model::{BinaryCollision, IntegratorChoice, Partner, Rolling, Tangential};
use super::pair::{NORMAL, Pair};
use crate::contact::AnyNormal;
use crate::contact::{Body, Contact, ContactLaws, NormalLaw, Slip, TangentialLaw};
use crate::integrator::Bodies;
use crate::math::{Vec3, Vector};

pub type ScenePair = Pair<AnyNormal, Tangential, Rolling>;

/// A collision with what follows from its fields.
pub struct Impact<'a> {
    pub scene: &'a BinaryCollision,
    pub bodies: [Body; 2],
    pub normal: AnyNormal,
    /// What the normal law sees at first touch.
    pub contact: Contact,
}

impl<'a> Impact<'a> {
    pub fn of(scene: &'a BinaryCollision) -> Self {
        let grain = Body::sphere(scene.grains.diameter, scene.grains.density);
        let other = match scene.partner {
            Partner::Equal => grain,
            Partner::Grain(grains) => Body::sphere(grains.diameter, grains.density),
            Partner::Wall => Body::WALL,
        };
        let mut impact = Impact {
            scene,
            bodies: [grain, other],
            normal: scene.normal.law(),
            contact: Contact {
                overlap: 0.0,
                rate: 0.0,
                reduced_mass: 0.0,
                mean_mass: 0.0,
                reduced_radius: 0.0,
            },
        };
        impact.contact = impact.pair(1.0).touch(&impact.start()).contact;
        // The distance of the centres is rounded; at first touch there is no overlap.
        impact.contact.overlap = 0.0;
        impact
    }

    pub fn pair(&self, time_step: f64) -> ScenePair {
        let laws = ContactLaws {
            normal: self.normal,
            tangential: self.scene.tangential,
            rolling: self.scene.rolling,
        };
        let mut pair = Pair::new(self.bodies, laws, time_step);
        pair.continued = true;
        pair
    }

    /// Both bodies at first touch, in the frame of their common centre of mass; a wall at rest.
    pub fn start(&self) -> Bodies {
        let [grain, other] = &self.bodies;
        let share = if other.is_wall() {
            1.0
        } else {
            other.mass / (grain.mass + other.mass)
        };
        let distance = grain.radius + if other.is_wall() { 0.0 } else { other.radius };
        let relative = Vec3::new(-self.scene.speed, self.scene.tangential_speed, 0.0);
        // A spin about −z moves the surface at −x towards +y.
        let spin = Vec3::new(0.0, 0.0, -self.scene.spin);
        Bodies {
            position: vec![NORMAL * (distance * share), NORMAL * (distance * (share - 1.0))],
            velocity: vec![relative * share, relative * (share - 1.0)],
            angular_velocity: vec![spin, Vec3::zeros()],
        }
    }

    /// Diameter of the smaller body [m].
    pub fn diameter(&self) -> f64 {
        2.0 * self.bodies[0].radius.min(self.bodies[1].radius)
    }

    /// Slip of the surfaces at first touch [m/s].
    pub fn slip(&self) -> f64 {
        self.scene.tangential_speed + self.bodies[0].radius * self.scene.spin
    }

    /// Contact time of the normal law [s].
    pub fn contact_time(&self) -> f64 {
        self.normal.contact_time(&self.contact)
    }

    /// Step of the run [s].
    pub fn time_step(&self) -> f64 {
        let wanted = self.contact_time() * self.scene.time_step_over_contact_time;
        self.scene.time_step.unwrap_or(wanted)
    }

    /// Longest safe step [s] and what sets it.
    ///
    /// Ten steps resolve a contact; the Gear schemes grow beyond ω₀ Δt = 0.165 (5 values) and 0.09
    /// (6 values) at a damping ratio of 0.9, so they need 20 and 40.
    pub fn step_limit(&self) -> (f64, String) {
        let fewest = match self.scene.integrator {
            IntegratorChoice::VelocityVerlet | IntegratorChoice::RungeKutta4 => 10.0,
            IntegratorChoice::Gear5 => 20.0,
            IntegratorChoice::Gear6 => 40.0,
        };
        let normal = self.contact_time() / fewest;
        let slip = Slip {
            velocity: Vector::zeros(),
            normal: NORMAL.into(),
            normal_force: 0.0,
            overlap: 0.0,
            reduced_mass: self.contact.reduced_mass,
            elapsed: 0.0,
            time_step: normal,
        };
        let tangential = self.scene.tangential.step_limit(slip.resisting_mass());
        if tangential < normal {
            (tangential, "of the tangential spring and dashpot".to_owned())
        } else {
            (normal, format!("t_c/{fewest}"))
        }
    }
}
