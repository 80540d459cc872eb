//! What a simulation is made of and how its parts are coupled.

use crate::coupling::{Breathing, PorositySums, SelfInducedFlow};
use crate::math::Vec3;

/// Which velocity and porosity enter the drag law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlipRule {
    /// Mixture flux less the grain's velocity: the superficial slip of a grain among others. The
    /// mixture flux ε u + (1 − ε) v_s is smooth where ε is not, so sampling it costs no accuracy.
    MixtureFlux,
    /// The same for grains that do not move as one: the superficial slip ε (u − v_i) of a grain among
    /// others with the mean velocity v̄ is j − (1 − ε) v̄ − ε v_i with the mixture flux j. With j − v_i the
    /// heavy grains of a mixture fall 4 per cent too slowly, and the light ones too fast.
    FreeMixtureFlux,
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
    /// From the grains alone, summed anew with every refresh of the weights.
    OnePass(Box<PorositySums>),
}

/// How the coupling is done.
pub struct CouplingRules<L> {
    pub law: L,
    /// Density [kg/m³] and viscosity [Pa s] of the fluid.
    pub fluid: [f64; 2],
    pub slip: SlipRule,
    pub porosity: GrainPorosity,
    /// ϱ in place of ρ = ε ϱ in the stress on a grain: a published defect.
    pub intrinsic_stress: bool,
    /// Buoyancy per volume of grain that is carried analytically [N/m³].
    pub buoyancy: f64,
    /// Whether the fluid feels the grains.
    pub two_way: bool,
    pub own_flow: Option<SelfInducedFlow>,
    /// Damper of compression waves through the whole column.
    pub breathing: Option<Breathing>,
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
    /// Largest overlap of a contact over the diameter so far [-].
    pub overlap: f64,
    /// Impulse handed to the fluid in this step [N s].
    pub impulse: f64,
    /// Impulse of all but the fluid on the grains in this step [N s].
    pub outside: Vec3,
}
