//! The suspension scene as a study file writes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::collision::automatic;
use super::quantity::{
    Acceleration, CoefficientSpec, Density, Fraction, Length, StiffnessSpec, Time, TimeStepSpec,
};
use super::scene::{ColumnSpec, DragSpec, GrainsSpec, MediumSpec, SphSpec, gravity};

/// A homogeneous suspension of grains settles in a column of fluid onto its floor.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct SuspensionSpec {
    /// The grains, when there is one class of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grains: Option<GrainsSpec>,
    /// One to four classes of grains, in place of `grains`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub classes: Option<Vec<SuspendedClassSpec>>,
    /// Porosity of the suspension at the start; the number of grains follows from it.
    pub porosity: Fraction,
    /// Full of the suspension at the start.
    pub column: ColumnSpec,
    /// Where the grains start.
    #[serde(default = "HomogeneitySpec::even")]
    pub arrangement: HomogeneitySpec,
    pub drag: DragSpec,
    pub fluid: SuspendingFluidSpec,
    /// Contact of grains with each other and with the floor.
    #[serde(default)]
    pub contact: SoftContactSpec,
    /// Grains whose mean height is the interface, shared out to the classes by number; left out, 3 % of them
    /// and 600 at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub top_grains: Option<u32>,
    /// Simulated time.
    pub duration: Time,
    #[serde(default = "gravity")]
    pub gravity: Acceleration,
    /// Grain steps per contact time where the step is picked.
    #[serde(default = "twenty")]
    pub steps_per_contact: Fraction,
    /// Step of the grains; in a fluid `sph` the longest sub-step.
    #[serde(default = "automatic")]
    pub time_step: TimeStepSpec,
    /// Accept a time step beyond the safe one.
    #[serde(default)]
    pub unsafe_time_step: bool,
    /// Threads inside the run; it changes no result.
    #[serde(default = "one")]
    pub threads: u32,
    /// Snapshots kept, equally spaced in time, the first and the last among them.
    #[serde(default = "eleven")]
    pub snapshots: u32,
}

/// Equal spheres among others.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct SuspendedClassSpec {
    pub diameter: Length,
    pub density: Density,
    /// Share of the number of all grains; the shares add up to 1.
    pub share: Fraction,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum HomogeneitySpec {
    /// At random, the same number of grains in cells a few diameters wide.
    Even,
    /// At random, each grain wherever it fits.
    Random,
}

/// The fluid model, cheapest first.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SuspendingFluidSpec {
    /// Closed vessel: no net volume flux through any height.
    Column(MediumSpec),
    /// Two-way coupled averaged Navier–Stokes equations on particles; the spacing is over the diameter of the
    /// smallest class.
    Sph(SphSpec),
}

/// Linear spring and dashpot.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(default)]
pub struct SoftContactSpec {
    /// Left `automatic`, the softest that keeps overlaps at 0.25 % of the smallest diameter.
    pub stiffness: StiffnessSpec,
    /// Restitution of a dry contact.
    pub restitution: Fraction,
    /// Coulomb's friction; `none` leaves friction and rotation out.
    pub friction: CoefficientSpec,
}

impl Default for SoftContactSpec {
    fn default() -> Self {
        SoftContactSpec {
            stiffness: StiffnessSpec::Automatic,
            restitution: Fraction(0.9),
            friction: CoefficientSpec::None,
        }
    }
}

impl HomogeneitySpec {
    fn even() -> Self {
        HomogeneitySpec::Even
    }
}

fn twenty() -> Fraction {
    Fraction(20.0)
}

fn one() -> u32 {
    1
}

fn eleven() -> u32 {
    11
}
