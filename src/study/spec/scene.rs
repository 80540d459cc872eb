//! Scenes as a study file writes them. Serialised, they are the canonical settings of a point.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::collision::CollisionSpec;
use super::quantity::{
    Acceleration, CoefficientSpec, Density, Fraction, Length, SoundSpeedSpec, StiffnessSpec, Time,
    TimeStepSpec, Viscosity,
};
use super::sedimentation::SedimentationSpec;
use super::suspension::{SuspendedClassSpec, SuspensionSpec};

/// A scene: its name with its fields.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SceneSpec {
    /// One grain falls from rest in a column of fluid, away from the walls.
    SingleSphere(SingleSphereSpec),
    /// A rigid lattice of grains falls through the whole cross-section of a column of fluid.
    ConstantPorosityBlock(BlockSpec),
    /// A grain meets another one or a flat wall: contact laws and integrators on their own.
    BinaryCollision(CollisionSpec),
    /// Many grains settle through a fluid onto the floor of a box and form a bed.
    Sedimentation(SedimentationSpec),
    /// A homogeneous suspension of grains settles in a column of fluid onto its floor.
    Suspension(SuspensionSpec),
    /// No physics: returns a known series, to try out plans, stores, verdicts and reports.
    Rehearsal(RehearsalSpec),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct SingleSphereSpec {
    pub grains: GrainsSpec,
    pub drag: DragSpec,
    pub fluid: FluidSpec,
    pub column: ColumnSpec,
    /// Release height over column height.
    #[serde(default = "release_height")]
    pub release_height: Fraction,
    #[serde(default = "CouplingSpec::two_way")]
    pub coupling: CouplingSpec,
    /// Whether the grain's own disturbance is taken out of the fluid velocity it sees.
    #[serde(default = "SelfDisturbanceSpec::corrected")]
    pub self_disturbance: SelfDisturbanceSpec,
    /// Whether an accelerating grain carries half its volume of fluid along; for fluids `still` and `column`.
    #[serde(default)]
    pub added_mass: Switch,
    /// Simulated time.
    pub duration: Time,
    #[serde(default = "gravity")]
    pub gravity: Acceleration,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct BlockSpec {
    /// The grains, when there is one class of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grains: Option<GrainsSpec>,
    /// One to four classes of grains, mixed evenly on the lattice, in place of `grains`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub classes: Option<Vec<SuspendedClassSpec>>,
    pub drag: DragSpec,
    pub fluid: FluidSpec,
    pub column: ColumnSpec,
    /// Porosity of the block.
    pub porosity: Fraction,
    /// Height of the block, rounded to whole layers; `layers` may be given in its place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness: Option<Length>,
    /// Grains along each horizontal side; left out, the count that makes the lattice most nearly cubic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grains_per_side: Option<u32>,
    /// Horizontal layers of grains; left out, taken from `thickness`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layers: Option<u32>,
    /// Held in place rather than falling.
    #[serde(default)]
    pub held: bool,
    /// Simulated time.
    pub duration: Time,
    #[serde(default = "gravity")]
    pub gravity: Acceleration,
}

/// Equal spheres.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct GrainsSpec {
    pub diameter: Length,
    pub density: Density,
}

/// Square cross-section, periodic sideways, floor below, open above.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct ColumnSpec {
    /// Side of the cross-section.
    pub width: Length,
    /// Height of the fluid.
    pub height: Length,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DragSpec {
    Stokes,
    Dallavalle,
    SchillerNaumann,
    DiFelice,
    CoulsonRichardson,
    Beetstra,
    BeetstraCello,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Switch {
    On,
    #[default]
    Off,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CouplingSpec {
    OneWay,
    TwoWay,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SelfDisturbanceSpec {
    Corrected,
    Uncorrected,
}

/// The fluid model, cheapest first.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FluidSpec {
    /// At rest everywhere.
    Still(MediumSpec),
    /// Closed vessel: no net volume flux through any height.
    Column(MediumSpec),
    /// Two-way coupled averaged Navier–Stokes equations on particles.
    Sph(SphSpec),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct MediumSpec {
    pub density: Density,
    pub viscosity: Viscosity,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct SphSpec {
    pub density: Density,
    pub viscosity: Viscosity,
    /// Particle spacing over grain diameter.
    pub spacing_over_diameter: Fraction,
    #[serde(default)]
    pub scheme: SchemeSpec,
}

/// Numerical choices of the particle fluid; left out, the recommended ones.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(default)]
pub struct SchemeSpec {
    pub sound_speed: SoundSpeedSpec,
    pub hydrostatics: HydrostaticsSpec,
    pub kernel: KernelSpec,
    /// Coefficient α of the artificial viscosity; `none` leaves the term out.
    pub artificial_viscosity: CoefficientSpec,
    /// Constant between α and the real viscosity; `none` takes the Morris form.
    pub viscosity_constant: CoefficientSpec,
    pub porosity: PorosityPathSpec,
    /// Whether smoothing gives back what it takes from sharp edges.
    pub sharpening: SharpeningSpec,
    pub start: StartSpec,
    /// Density that multiplies the fluid stress on a grain.
    pub stress_density: PhaseSpec,
    /// Slip velocity that enters the drag law.
    pub slip: SlipSpec,
    /// Length over which each class of grains is coupled to the fluid, where there are several.
    pub coupling_lengths: CouplingLengthsSpec,
    /// Contact stiffness.
    pub stiffness: StiffnessSpec,
    /// Grain steps per contact time.
    pub steps_per_contact: Fraction,
    pub time_step: TimeStepSpec,
    /// Accept a time step beyond the safe one.
    pub unsafe_time_step: bool,
}

impl Default for SchemeSpec {
    fn default() -> Self {
        SchemeSpec {
            sound_speed: SoundSpeedSpec::Automatic,
            hydrostatics: HydrostaticsSpec::Split,
            kernel: KernelSpec::WendlandC2,
            artificial_viscosity: CoefficientSpec::None,
            viscosity_constant: CoefficientSpec::None,
            porosity: PorosityPathSpec::OnePass,
            sharpening: SharpeningSpec::Automatic,
            start: StartSpec::Exact,
            stress_density: PhaseSpec::Superficial,
            slip: SlipSpec::Superficial,
            coupling_lengths: CouplingLengthsSpec::PerClass,
            stiffness: StiffnessSpec::Automatic,
            steps_per_contact: Fraction(20.0),
            time_step: TimeStepSpec::Automatic,
            unsafe_time_step: false,
        }
    }
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum HydrostaticsSpec {
    Split,
    Carried,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum KernelSpec {
    #[serde(rename = "wendland_c2")]
    WendlandC2,
    Lucy,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PorosityPathSpec {
    OnePass,
    TwoPass,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SharpeningSpec {
    /// `conservative` for blocks and single grains, `none` among random grains, whose scatter it amplifies.
    Automatic,
    None,
    Conservative,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StartSpec {
    Exact,
    Relaxed,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PhaseSpec {
    Superficial,
    Intrinsic,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SlipSpec {
    Superficial,
    Interstitial,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CouplingLengthsSpec {
    /// Each class its own.
    PerClass,
    /// That of the smallest grains for all.
    Smallest,
    /// That of the largest grains for all.
    Largest,
    /// Larger grains over their own length to the fluid, then over the smallest among the fluid.
    DoubleSmoothing,
    /// The same as Raso (2014), eq. 3.10, prints it.
    DoubleSmoothingLiteral,
}

/// `value(t) = limit · (1 + error · scale^order) · (1 − exp(−t / time_constant))`.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(default)]
pub struct RehearsalSpec {
    pub limit: Fraction,
    pub time_constant: Time,
    pub duration: Time,
    /// Instants at which the series is sampled.
    pub samples: u32,
    pub scale: Fraction,
    pub order: Fraction,
    pub error: Fraction,
    /// Grains in the snapshots; 0 for no snapshots.
    pub grains: u32,
    /// Real time to spend.
    pub delay: Time,
    pub ending: EndingSpec,
}

impl Default for RehearsalSpec {
    fn default() -> Self {
        RehearsalSpec {
            limit: Fraction(1.0),
            time_constant: Time(1.0),
            duration: Time(10.0),
            samples: 101,
            scale: Fraction(1.0),
            order: Fraction(1.0),
            error: Fraction(0.0),
            grains: 0,
            delay: Time(0.0),
            ending: EndingSpec::Completes,
        }
    }
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EndingSpec {
    Completes,
    Diverges,
    Panics,
}

impl CouplingSpec {
    fn two_way() -> Self {
        CouplingSpec::TwoWay
    }
}

impl SelfDisturbanceSpec {
    fn corrected() -> Self {
        SelfDisturbanceSpec::Corrected
    }
}

fn release_height() -> Fraction {
    Fraction(0.8)
}

/// Standard gravity as both theses round it.
pub(super) fn gravity() -> Acceleration {
    Acceleration(9.81)
}
