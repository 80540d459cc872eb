//! The filtration scene as a study file writes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantity::{Density, Fraction, Frequency, MediumResistance, Pressure, Speed, Viscosity};
use super::scene::Switch;
use super::sedimentation::BedSpec;

/// A suspension is driven through a filter medium, the floor of its box; the grains stay behind and form a cake.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct FiltrationSpec {
    #[serde(flatten)]
    pub bed: BedSpec,
    pub fluid: FiltratingFluidSpec,
    pub feed: FeedSpec,
    pub filtrate: FiltrateSpec,
    /// Which grains belong to the cake.
    #[serde(default = "DepositedSpec::slow")]
    pub deposited: DepositedSpec,
}

/// The fluid that flows through.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FiltratingFluidSpec {
    /// Down through the medium, everywhere alike.
    Uniform(UniformSpec),
    /// Down through the medium, and across over it: a parabola between medium and lid.
    Parabolic(ParabolicSpec),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct UniformSpec {
    pub density: Density,
    pub viscosity: Viscosity,
    /// What the filtrate flux makes of the velocity between the grains.
    #[serde(default = "FlowSpec::consistent")]
    pub flow: FlowSpec,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct ParabolicSpec {
    pub density: Density,
    pub viscosity: Viscosity,
    #[serde(default = "FlowSpec::consistent")]
    pub flow: FlowSpec,
    /// Mean over the height of the flow across.
    pub mean_velocity: Speed,
    /// Whether grains that lag or lead in the shear are lifted.
    #[serde(default)]
    pub shear_lift: Switch,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FlowSpec {
    /// The volume of fluid and grains is kept: faster where grains take room.
    Consistent,
    /// The flux itself, as printed: too slow between grains.
    Literal,
}

/// How grains come into the cell.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FeedSpec {
    /// All are there at the start.
    AtStart,
    /// So many in a second, into the top of the cell.
    Rate(RateSpec),
    /// With the suspension that the filtrate draws in.
    Suspension(SuspensionFeedSpec),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct RateSpec {
    /// Grains per second.
    pub rate: Frequency,
    /// Height of the zone they come into, in largest diameters from the top of the cell.
    #[serde(default = "five")]
    pub layers: Fraction,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct SuspensionFeedSpec {
    /// Of the suspension.
    pub solids_fraction: Fraction,
    /// Whether grains settle into the cell as well, faster than the filtrate draws them.
    #[serde(default)]
    pub settling: Switch,
    /// Height of the zone they come into, in largest diameters from the top of the cell.
    #[serde(default = "five")]
    pub layers: Fraction,
}

/// How the filtrate is driven. Pressure drop, flux and resistance of the medium at the start are tied to each
/// other: two of the three are given.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct FiltrateSpec {
    /// What stays constant.
    pub held: HeldSpec,
    /// Pressure drop, at constant flux that at the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure_drop: Option<Pressure>,
    /// Volume per area and time before there is a cake.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub initial_flux: Option<Speed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub medium_resistance: Option<MediumResistance>,
    #[serde(default = "ResistanceSpec::series")]
    pub resistance: ResistanceSpec,
    /// The length that the filtrate takes through the cake.
    #[serde(default = "CakeLengthSpec::thickness")]
    pub length: CakeLengthSpec,
    #[serde(default = "CakePermeabilitySpec::mean")]
    pub permeability: CakePermeabilitySpec,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum HeldSpec {
    Pressure,
    Flux,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ResistanceSpec {
    /// Medium and cake, one behind the other.
    Series,
    /// The cake alone, and the flux no more than at the start, as printed.
    DarcyCapped,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CakeLengthSpec {
    Thickness,
    /// The height of the cell as soon as there is a cake: gives a flux in print.
    CellHeight,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CakePermeabilitySpec {
    /// From the porosity of the central slice.
    Mean,
    /// From the porosities of layers one largest diameter thick.
    Layered,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DepositedSpec {
    /// Those slower than a tenth of the terminal speed that a chain of contacts among their like carries.
    Slow,
    /// Those that have settled as in a sedimentation: slower than a hundredth of it, hardly moved, and carried.
    Settled,
    /// All that a chain of contacts carries.
    Carried,
}

macro_rules! default_choice {
    ($($choice:ident :: $function:ident = $variant:ident;)+) => {
        $(impl $choice {
            fn $function() -> Self {
                $choice::$variant
            }
        })+
    };
}

default_choice! {
    FlowSpec::consistent = Consistent;
    ResistanceSpec::series = Series;
    CakeLengthSpec::thickness = Thickness;
    CakePermeabilitySpec::mean = Mean;
    DepositedSpec::slow = Slow;
}

fn five() -> Fraction {
    Fraction(5.0)
}
