//! What a simulation is made of and how its parts are coupled.

use crate::contact::LinearSpringDashpot;
use crate::coupling::{Breathing, SelfInducedFlow};
use crate::drag::DragScale;
use crate::math::Vec3;

/// Grains that move as one.
#[derive(Clone, Debug)]
pub struct RigidGrains {
    pub position: Vec<Vec3>,
    /// Common velocity [m/s].
    pub velocity: Vec3,
    pub diameter: f64,
    /// Volume of one grain [m³].
    pub volume: f64,
    /// Mass of one grain [kg].
    pub mass: f64,
    /// Weight less buoyancy of one grain, or full weight where the fluid carries its whole pressure [N].
    pub weight: f64,
    /// Held in place: feels the fluid and pushes it, but does not move.
    pub held: bool,
}

/// Which velocity and porosity enter the drag law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlipRule {
    /// Mixture flux less the grain's velocity: the superficial slip of a grain among others. The
    /// mixture flux ε u + (1 − ε) v_s is smooth where ε is not, so sampling it costs no accuracy.
    MixtureFlux,
    /// Fluid velocity less the grain's own velocity, for an isolated grain.
    Isolated,
    /// Local porosity times the interstitial slip.
    PorosityTimesInterstitial,
    /// Interstitial slip in place of the superficial one: a published defect.
    Interstitial,
}

/// Where a grain's porosity comes from.
#[derive(Clone, Debug)]
pub enum GrainPorosity {
    /// Constant values: one per grain.
    Known(Vec<f64>),
    /// Sampled from the fluid.
    Sampled,
}

/// How the coupling is done.
pub struct CouplingRules<L> {
    pub law: L,
    pub scale: DragScale,
    pub slip: SlipRule,
    pub porosity: GrainPorosity,
    /// ϱ in place of ρ = ε ϱ in the stress on a grain: a published defect.
    pub intrinsic_stress: bool,
    /// Buoyancy of one grain that is carried analytically [N].
    pub buoyancy: f64,
    /// Whether the fluid feels the grains.
    pub two_way: bool,
    pub own_flow: Option<SelfInducedFlow>,
    /// Damper of compression waves through the whole column.
    pub breathing: Option<Breathing>,
    pub floor: LinearSpringDashpot,
    /// Grain steps per contact time [-].
    pub contact_steps: f64,
    /// Fluid steps between refreshes of the weights.
    pub refresh_interval: u64,
}

/// What the last step did, for observation.
#[derive(Clone, Debug, Default)]
pub struct StepReport {
    /// Mean drag per grain [N], upward positive.
    pub drag: f64,
    /// Mean force of the fluid stress per grain [N], upward positive.
    pub stress: f64,
    /// Mean superficial slip speed [m/s].
    pub slip: f64,
    /// Fluid velocity sampled by the grains, mean, downward positive [m/s].
    pub sampled: f64,
    /// Own flow taken out of it, downward positive [m/s].
    pub own_flow: f64,
    /// Largest overlap with the floor over the diameter [-].
    pub overlap: f64,
    /// Impulse handed to the fluid in this step [N s].
    pub impulse: f64,
    /// Impulse of the floor on the grains in this step [N s].
    pub floor_impulse: f64,
    /// Mean velocity of the grains over the step [m/s].
    pub mean_velocity: Vec3,
}
