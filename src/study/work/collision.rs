//! From the written collision to the plain data that runs.

use kynch_sim::contact::{CundallStrack, EffectiveMass, HaffWerner, Mindlin, RollingResistance, SlipLimit};
use kynch_sim::scene::{BinaryCollision, IntegratorChoice, Material, Normal, Partner, Rolling, Tangential};

use super::grains;
use crate::study::spec::collision::*;
use crate::study::spec::quantity::{Fraction, Pressure, TimeStepSpec};

pub fn collision(spec: &CollisionSpec) -> BinaryCollision {
    BinaryCollision {
        grains: grains(&spec.grains),
        partner: match &spec.partner {
            PartnerSpec::Equal => Partner::Equal,
            PartnerSpec::Wall => Partner::Wall,
            PartnerSpec::Grain(other) => Partner::Grain(grains(other)),
        },
        speed: spec.speed.0,
        tangential_speed: spec.tangential_speed.0,
        spin: spec.spin.0,
        normal: normal(&spec.normal),
        tangential: tangential(&spec.tangential),
        rolling: rolling(&spec.rolling),
        integrator: integrator(spec.integrator),
        time_step_over_contact_time: spec.time_step_over_contact_time.0,
        time_step: match spec.time_step {
            TimeStepSpec::Automatic => None,
            TimeStepSpec::Value(step) => Some(step),
        },
        unsafe_time_step: spec.unsafe_time_step,
    }
}

pub(super) fn normal(spec: &NormalSpec) -> Normal {
    let material = |young: Pressure, poisson: Fraction| Material {
        young_modulus: young.0,
        poisson_ratio: poisson.0,
    };
    match spec {
        NormalSpec::LinearSpringDashpot(law) => Normal::LinearSpringDashpot {
            stiffness: law.stiffness.0,
            restitution: law.restitution.0,
            effective_mass: match law.effective_mass {
                EffectiveMassSpec::Reduced => EffectiveMass::Reduced,
                EffectiveMassSpec::Arithmetic => EffectiveMass::Arithmetic,
            },
        },
        NormalSpec::HertzViscoelastic(law) => Normal::HertzViscoelastic {
            material: material(law.young_modulus, law.poisson_ratio),
            damping_time: law.damping_time.0,
        },
        NormalSpec::HertzTsuji(law) => Normal::HertzTsuji {
            material: material(law.young_modulus, law.poisson_ratio),
            restitution: law.restitution.0,
        },
        NormalSpec::HertzLiteral(law) => Normal::HertzLiteral {
            material: material(law.young_modulus, law.poisson_ratio),
            damping: law.damping.0,
        },
    }
}

pub(super) fn tangential(spec: &TangentialSpec) -> Tangential {
    match spec {
        TangentialSpec::None => Tangential::None,
        TangentialSpec::HaffWerner(law) => Tangential::HaffWerner(HaffWerner {
            damping: law.damping.0,
            friction: law.friction.0,
        }),
        TangentialSpec::CundallStrack(law) => Tangential::CundallStrack(CundallStrack {
            stiffness: law.stiffness.0,
            damping: law.damping.0,
            friction: law.friction.0,
        }),
        TangentialSpec::Mindlin(law) => Tangential::Mindlin(Mindlin {
            friction: law.friction.0,
            poisson_ratio: law.poisson_ratio.0,
            slip_limit: match law.slip_limit {
                SlipLimitSpec::Correct => SlipLimit::Correct,
                SlipLimitSpec::Literal => SlipLimit::Literal,
            },
        }),
    }
}

pub(super) fn rolling(spec: &RollingSpec) -> Rolling {
    match spec {
        RollingSpec::None => Rolling::None,
        RollingSpec::Resistance(law) => Rolling::Resistance(RollingResistance {
            friction: law.friction.0,
        }),
    }
}

pub(super) fn integrator(spec: IntegratorSpec) -> IntegratorChoice {
    match spec {
        IntegratorSpec::VelocityVerlet => IntegratorChoice::VelocityVerlet,
        IntegratorSpec::Gear5 => IntegratorChoice::Gear5,
        IntegratorSpec::Gear6 => IntegratorChoice::Gear6,
        IntegratorSpec::RungeKutta4 => IntegratorChoice::RungeKutta4,
    }
}
