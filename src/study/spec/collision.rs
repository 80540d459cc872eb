//! The collision scene as a study file writes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantity::{AngularVelocity, Damping, Fraction, Pressure, Speed, Stiffness, Time, TimeStepSpec};
use super::scene::GrainsSpec;

/// A grain meets another one or a flat wall in empty space; the run ends when they part.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct CollisionSpec {
    pub grains: GrainsSpec,
    /// What the grain meets.
    #[serde(default = "PartnerSpec::equal")]
    pub partner: PartnerSpec,
    /// Speed of approach along the normal.
    pub speed: Speed,
    /// Speed of the grain across the normal.
    #[serde(default = "no_speed")]
    pub tangential_speed: Speed,
    /// Spin of the grain; positive adds to the slip of `tangential_speed`.
    #[serde(default = "no_spin")]
    pub spin: AngularVelocity,
    /// Normal contact law.
    pub normal: NormalSpec,
    /// Tangential contact law.
    #[serde(default = "TangentialSpec::none")]
    pub tangential: TangentialSpec,
    /// Rolling resistance.
    #[serde(default = "RollingSpec::none")]
    pub rolling: RollingSpec,
    #[serde(default = "IntegratorSpec::verlet")]
    pub integrator: IntegratorSpec,
    /// Time step over the contact time of the normal law.
    #[serde(default = "one_per_cent")]
    pub time_step_over_contact_time: Fraction,
    #[serde(default = "automatic")]
    pub time_step: TimeStepSpec,
    /// Accept a time step beyond the safe one.
    #[serde(default)]
    pub unsafe_time_step: bool,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PartnerSpec {
    /// A grain like itself.
    Equal,
    /// A flat wall of the same material, fixed in place.
    Wall,
    /// Another grain.
    Grain(GrainsSpec),
}

/// From overlap and approach to the force along the normal.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NormalSpec {
    /// One restitution at every speed, force linear in the overlap.
    LinearSpringDashpot(LinearSpringDashpotSpec),
    /// Hertz contact whose restitution falls with speed.
    HertzViscoelastic(HertzViscoelasticSpec),
    /// Hertz contact with one restitution at every speed.
    HertzTsuji(HertzTsujiSpec),
    /// Hertz contact with the damping of a published misprint.
    HertzLiteral(HertzLiteralSpec),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct LinearSpringDashpotSpec {
    pub stiffness: Stiffness,
    pub restitution: Fraction,
    /// Mass that the dashpot is computed with.
    #[serde(default = "EffectiveMassSpec::reduced")]
    pub effective_mass: EffectiveMassSpec,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EffectiveMassSpec {
    Reduced,
    Arithmetic,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct HertzViscoelasticSpec {
    pub young_modulus: Pressure,
    pub poisson_ratio: Fraction,
    /// Material time of the damping.
    pub damping_time: Time,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct HertzTsujiSpec {
    pub young_modulus: Pressure,
    pub poisson_ratio: Fraction,
    pub restitution: Fraction,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct HertzLiteralSpec {
    pub young_modulus: Pressure,
    pub poisson_ratio: Fraction,
    /// Damping as a pure number.
    pub damping: Fraction,
}

/// From slip and its history to friction.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TangentialSpec {
    None,
    /// Viscous friction capped by Coulomb's.
    HaffWerner(HaffWernerSpec),
    /// Spring and dashpot capped by Coulomb's friction.
    CundallStrack(CundallStrackSpec),
    /// Full-slip form of the Mindlin contact.
    Mindlin(MindlinSpec),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct HaffWernerSpec {
    pub damping: Damping,
    /// Coefficient of friction.
    pub friction: Fraction,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct CundallStrackSpec {
    pub stiffness: Stiffness,
    pub damping: Damping,
    /// Coefficient of friction.
    pub friction: Fraction,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct MindlinSpec {
    /// Coefficient of friction.
    pub friction: Fraction,
    pub poisson_ratio: Fraction,
    /// Which slip counts as full.
    #[serde(default = "SlipLimitSpec::correct")]
    pub slip_limit: SlipLimitSpec,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SlipLimitSpec {
    Correct,
    Literal,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RollingSpec {
    None,
    /// Torque of constant size against rolling.
    Resistance(ResistanceSpec),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct ResistanceSpec {
    /// Coefficient of rolling friction.
    pub friction: Fraction,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
pub enum IntegratorSpec {
    #[serde(rename = "velocity_verlet")]
    VelocityVerlet,
    #[serde(rename = "gear_5")]
    Gear5,
    #[serde(rename = "gear_6")]
    Gear6,
    #[serde(rename = "runge_kutta_4")]
    RungeKutta4,
}

impl PartnerSpec {
    fn equal() -> Self {
        PartnerSpec::Equal
    }
}

impl EffectiveMassSpec {
    fn reduced() -> Self {
        EffectiveMassSpec::Reduced
    }
}

impl SlipLimitSpec {
    fn correct() -> Self {
        SlipLimitSpec::Correct
    }
}

impl TangentialSpec {
    pub(super) fn none() -> Self {
        TangentialSpec::None
    }
}

impl RollingSpec {
    pub(super) fn none() -> Self {
        RollingSpec::None
    }
}

impl IntegratorSpec {
    pub(super) fn verlet() -> Self {
        IntegratorSpec::VelocityVerlet
    }
}

fn no_speed() -> Speed {
    Speed(0.0)
}

fn no_spin() -> AngularVelocity {
    AngularVelocity(0.0)
}

fn one_per_cent() -> Fraction {
    Fraction(0.01)
}

pub(super) fn automatic() -> TimeStepSpec {
    TimeStepSpec::Automatic
}
