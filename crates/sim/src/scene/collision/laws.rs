//! The laws that a collision scene names, behind the traits of the contact room.
//!
//! One pair is evaluated here, so a match per call costs nothing; a bed takes the laws as type
//! parameters instead.

use super::model::{Normal, Rolling, Tangential};
use crate::contact::normal::{damping_ratio, effective_modulus};
use crate::contact::{
    Contact, HertzLiteral, HertzTsuji, HertzViscoelastic, LinearSpringDashpot, NormalLaw, RollingLaw, Slip,
    TangentialLaw, rolling,
};
use crate::math::{Number, Vector};

/// A normal law with its derived constants.
#[derive(Clone, Copy, Debug)]
pub enum AnyNormal {
    Linear(LinearSpringDashpot),
    Viscoelastic(HertzViscoelastic),
    Tsuji(HertzTsuji),
    Literal(HertzLiteral),
}

impl AnyNormal {
    pub fn of(normal: &Normal) -> AnyNormal {
        let modulus =
            |material: &super::Material| effective_modulus(material.young_modulus, material.poisson_ratio);
        match normal {
            Normal::LinearSpringDashpot {
                stiffness,
                restitution,
                effective_mass,
            } => AnyNormal::Linear(LinearSpringDashpot {
                stiffness: *stiffness,
                damping_ratio: damping_ratio(*restitution),
                effective_mass: *effective_mass,
            }),
            Normal::HertzViscoelastic {
                material,
                damping_time,
            } => AnyNormal::Viscoelastic(HertzViscoelastic {
                effective_modulus: modulus(material),
                damping_time: *damping_time,
            }),
            Normal::HertzTsuji {
                material,
                restitution,
            } => AnyNormal::Tsuji(HertzTsuji::with_restitution(modulus(material), *restitution)),
            Normal::HertzLiteral { material, damping } => AnyNormal::Literal(HertzLiteral {
                effective_modulus: modulus(material),
                damping: *damping,
            }),
        }
    }
}

impl NormalLaw for AnyNormal {
    #[inline]
    fn force<N: Number>(&self, contact: &Contact<N>) -> N {
        match self {
            AnyNormal::Linear(law) => law.force(contact),
            AnyNormal::Viscoelastic(law) => law.force(contact),
            AnyNormal::Tsuji(law) => law.force(contact),
            AnyNormal::Literal(law) => law.force(contact),
        }
    }

    fn contact_time(&self, contact: &Contact) -> f64 {
        match self {
            AnyNormal::Linear(law) => law.contact_time(contact),
            AnyNormal::Viscoelastic(law) => law.contact_time(contact),
            AnyNormal::Tsuji(law) => law.contact_time(contact),
            AnyNormal::Literal(law) => law.contact_time(contact),
        }
    }
}

impl TangentialLaw for Tangential {
    #[inline]
    fn force<N: Number>(&self, slip: &Slip<N>, history: Vector<N>) -> (Vector<N>, Vector<N>) {
        match self {
            Tangential::None => ().force(slip, history),
            Tangential::HaffWerner(law) => law.force(slip, history),
            Tangential::CundallStrack(law) => law.force(slip, history),
            Tangential::Mindlin(law) => law.force(slip, history),
        }
    }

    fn step_limit(&self, resisting_mass: f64) -> f64 {
        match self {
            Tangential::None => ().step_limit(resisting_mass),
            Tangential::HaffWerner(law) => law.step_limit(resisting_mass),
            Tangential::CundallStrack(law) => law.step_limit(resisting_mass),
            Tangential::Mindlin(law) => law.step_limit(resisting_mass),
        }
    }
}

impl RollingLaw for Rolling {
    #[inline]
    fn torque<N: Number>(&self, rolling: &rolling::Rolling<N>) -> Vector<N> {
        match self {
            Rolling::None => ().torque(rolling),
            Rolling::Resistance(law) => law.torque(rolling),
        }
    }
}
