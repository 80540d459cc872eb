//! Laws chosen at run time, behind the traits of the laws themselves.
//!
//! A choice is a branch that always goes the same way: next to the evaluation of eight pairs it costs
//! nothing, and one compiled loop serves all combinations of laws.

use super::{
    Contact, CundallStrack, HaffWerner, HertzLiteral, HertzTsuji, HertzViscoelastic, LinearSpringDashpot,
    Mindlin, NormalLaw, Rolling, RollingLaw, RollingResistance, Slip, TangentialLaw,
};
use crate::math::{Number, Vector};

/// A normal law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyNormal {
    Linear(LinearSpringDashpot),
    Viscoelastic(HertzViscoelastic),
    Tsuji(HertzTsuji),
    Literal(HertzLiteral),
}

impl NormalLaw for AnyNormal {
    #[inline(always)]
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

/// A tangential law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyTangential {
    None,
    HaffWerner(HaffWerner),
    CundallStrack(CundallStrack),
    Mindlin(Mindlin),
}

impl TangentialLaw for AnyTangential {
    #[inline(always)]
    fn force<N: Number>(&self, slip: &Slip<N>, history: Vector<N>) -> (Vector<N>, Vector<N>) {
        match self {
            AnyTangential::None => ().force(slip, history),
            AnyTangential::HaffWerner(law) => law.force(slip, history),
            AnyTangential::CundallStrack(law) => law.force(slip, history),
            AnyTangential::Mindlin(law) => law.force(slip, history),
        }
    }

    fn step_limit(&self, resisting_mass: f64) -> f64 {
        match self {
            AnyTangential::None => ().step_limit(resisting_mass),
            AnyTangential::HaffWerner(law) => law.step_limit(resisting_mass),
            AnyTangential::CundallStrack(law) => law.step_limit(resisting_mass),
            AnyTangential::Mindlin(law) => law.step_limit(resisting_mass),
        }
    }
}

/// A law of rolling resistance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyRolling {
    None,
    Resistance(RollingResistance),
}

impl RollingLaw for AnyRolling {
    #[inline(always)]
    fn torque<N: Number>(&self, rolling: &Rolling<N>) -> Vector<N> {
        match self {
            AnyRolling::None => ().torque(rolling),
            AnyRolling::Resistance(law) => law.torque(rolling),
        }
    }
}
