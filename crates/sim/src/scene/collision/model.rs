//! The collision scene as plain data in SI units.

use crate::contact::normal::{damping_ratio, effective_modulus};
use crate::contact::{
    AnyNormal, EffectiveMass, HertzLiteral, HertzTsuji, HertzViscoelastic, LinearSpringDashpot,
};
pub use crate::contact::{AnyRolling as Rolling, AnyTangential as Tangential};
use crate::scene::Grains;

/// A grain meets another one, or a flat wall, in empty space; the run ends when they part.
#[derive(Clone, Debug, PartialEq)]
pub struct BinaryCollision {
    pub grains: Grains,
    pub partner: Partner,
    /// Speed of approach along the normal [m/s].
    pub speed: f64,
    /// Speed of the grain's centre across the normal, relative to the partner [m/s].
    pub tangential_speed: f64,
    /// Spin of the grain about the axis across both [rad/s]; positive adds to the slip that
    /// `tangential_speed` makes.
    pub spin: f64,
    pub normal: Normal,
    pub tangential: Tangential,
    pub rolling: Rolling,
    pub integrator: IntegratorChoice,
    /// Time step over the contact time of the normal law [-].
    pub time_step_over_contact_time: f64,
    /// Time step [s]; `None` takes it from `time_step_over_contact_time`.
    pub time_step: Option<f64>,
    /// Accept a step beyond the safe one.
    pub unsafe_time_step: bool,
}

/// What the grain meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Partner {
    /// A grain like itself.
    Equal,
    /// Another grain.
    Grain(Grains),
    /// A flat wall of the same material, fixed in place.
    Wall,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Normal {
    LinearSpringDashpot {
        /// k [N/m]
        stiffness: f64,
        /// e [-]
        restitution: f64,
        effective_mass: EffectiveMass,
    },
    HertzViscoelastic {
        material: Material,
        /// γ_n [s]
        damping_time: f64,
    },
    HertzTsuji {
        material: Material,
        /// e [-]
        restitution: f64,
    },
    HertzLiteral {
        material: Material,
        /// γ_n [-]
        damping: f64,
    },
}

impl Normal {
    /// The law with its derived constants.
    pub fn law(&self) -> AnyNormal {
        let modulus = |material: &Material| effective_modulus(material.young_modulus, material.poisson_ratio);
        match self {
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

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus E [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio ν [-].
    pub poisson_ratio: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntegratorChoice {
    VelocityVerlet,
    Gear5,
    Gear6,
    RungeKutta4,
}
