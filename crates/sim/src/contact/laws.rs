//! The laws of one contact together: from a touch to forces, torques and what they dissipate.

use super::normal::{Contact, NormalLaw};
use super::rolling::{Rolling, RollingLaw};
use super::tangential::{Slip, TangentialLaw};
use super::touch::Touch;
use crate::math::{Number, Vector};

/// A normal, a tangential and a rolling law.
#[derive(Clone, Copy, Debug)]
pub struct ContactLaws<N, T = (), R = ()> {
    pub normal: N,
    pub tangential: T,
    pub rolling: R,
}

/// What a contact does to its two bodies.
#[derive(Clone, Copy, Debug)]
pub struct Reaction<N = f64> {
    /// Normal force [N], repulsive positive.
    pub normal_force: N,
    /// Friction on the first body [N].
    pub friction: Vector<N>,
    /// Whole force on the first body [N]; the second gets the opposite.
    pub force: Vector<N>,
    /// Torques on the first and the second body about their centres [N m].
    pub torques: [Vector<N>; 2],
    pub dissipation: Dissipation<N>,
}

/// Power taken out of the motion [W]. A loaded tangential spring counts as dissipated: it is let go
/// of when the contact ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dissipation<N = f64> {
    pub normal: N,
    pub tangential: N,
    pub rolling: N,
}

impl<N: Number> Dissipation<N> {
    pub fn sum(&self) -> N {
        self.normal + self.tangential + self.rolling
    }
}

impl<N: NormalLaw, T: TangentialLaw, R: RollingLaw> ContactLaws<N, T, R> {
    /// Forces and torques of a touch, and the tangential history after `elapsed` [s] since `history`.
    ///
    /// `time_step` [s] is the step over which the forces will act: impulses are limited by it.
    #[inline(always)]
    pub fn react<Q: Number>(
        &self,
        touch: &Touch<Q>,
        history: Vector<Q>,
        elapsed: f64,
        time_step: f64,
    ) -> (Reaction<Q>, Vector<Q>) {
        let contact = &touch.contact;
        let normal_force = self.normal.force(contact);
        let elastic = self.normal.force(&Contact {
            rate: Q::splat(0.0),
            ..*contact
        });
        let pressing = normal_force.or_zero();
        let slip = Slip {
            velocity: touch.slip,
            normal: touch.normal,
            normal_force: pressing,
            overlap: contact.overlap.or_zero(),
            reduced_mass: contact.reduced_mass,
            elapsed,
            time_step,
        };
        let (friction, history) = self.tangential.force(&slip, history);
        let moment = self.rolling.torque(&Rolling {
            velocity: touch.rolling,
            normal_force: pressing,
            radius: touch.rolling_radius,
            reduced_inertia: touch.reduced_inertia,
            time_step,
        });
        let turn = -touch.normal.cross(&friction);
        let reaction = Reaction {
            normal_force,
            friction,
            force: touch.normal * normal_force + friction,
            torques: [turn * touch.levers[0] + moment, turn * touch.levers[1] - moment],
            dissipation: Dissipation {
                normal: (normal_force - elastic) * contact.rate,
                tangential: (-friction).dot(&touch.slip),
                rolling: (-moment).dot(&touch.rolling),
            },
        };
        (reaction, history)
    }
}
