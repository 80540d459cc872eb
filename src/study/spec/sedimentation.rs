//! The sedimentation scene as a study file writes it.

use kynch_sim::scene::Snapshot;
use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};

use super::collision::{IntegratorSpec, NormalSpec, RollingSpec, TangentialSpec, automatic};
use super::quantity::{
    Acceleration, Charge, Density, Energy, Fraction, Length, SkinSpec, Time, TimeStepSpec,
};
use super::scene::{MediumSpec, gravity};

/// Many grains settle through a fluid onto the floor of a box and form a bed.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct SedimentationSpec {
    #[serde(flatten)]
    pub bed: BedSpec,
    pub fluid: StillFluidSpec,
}

/// What every scene of many grains in a box has, whatever its fluid.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct BedSpec {
    /// 2 or 3. In two dimensions the centres of the spheres stay in a plane.
    #[serde(default = "three")]
    pub dimensions: u32,
    /// The grains, when there is one class of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grains: Option<GrainClassSpec>,
    /// Several classes of grains, in place of `grains`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub classes: Option<Vec<GrainClassSpec>>,
    pub container: ContainerSpec,
    /// Where the grains start.
    #[serde(default = "ArrangementSpec::random")]
    pub arrangement: ArrangementSpec,
    /// Normal contact law.
    pub normal: NormalSpec,
    /// Tangential contact law.
    #[serde(default = "TangentialSpec::none")]
    pub tangential: TangentialSpec,
    /// Rolling resistance.
    #[serde(default = "RollingSpec::none")]
    pub rolling: RollingSpec,
    /// Attraction of grains that do not touch.
    #[serde(default = "CohesionSpec::none")]
    pub cohesion: CohesionSpec,
    /// Electric charge of every grain.
    #[serde(default = "ChargeSpec::none")]
    pub charge: ChargeSpec,
    /// Drag on one grain alone.
    #[serde(default = "GrainDragSpec::schiller_naumann")]
    pub drag: GrainDragSpec,
    /// What its neighbours make of the drag.
    #[serde(default = "VoidageSpec::di_felice")]
    pub voidage: VoidageSpec,
    /// How the porosity around a grain is found.
    #[serde(default = "SlicePorositySpec::exact")]
    pub porosity: SlicePorositySpec,
    /// Force across the slip.
    #[serde(default = "LiftSpec::none")]
    pub lift: LiftSpec,
    #[serde(default = "gravity")]
    pub gravity: Acceleration,
    /// Longest simulated time.
    pub duration: Time,
    /// When the run ends.
    #[serde(default = "UntilSpec::duration")]
    pub until: UntilSpec,
    #[serde(default = "IntegratorSpec::verlet")]
    pub integrator: IntegratorSpec,
    /// How pairs in contact are found; it changes no result.
    #[serde(default = "DetectionSpec::list")]
    pub detection: DetectionSpec,
    /// Whether grains at rest are left out until something moves them.
    #[serde(default = "SwitchSpec::off")]
    pub sleeping: SwitchSpec,
    /// Share of the bed's thickness that counts as its central slice.
    #[serde(default = "four_fifths")]
    pub central_slice: Fraction,
    /// Steps per contact time where the step is picked.
    #[serde(default = "twenty")]
    pub steps_per_contact: Fraction,
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

/// Spheres of one density.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct GrainClassSpec {
    pub diameter: Length,
    /// Diameters are spread between `diameter` and this; left out, all are equal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_diameter: Option<Length>,
    pub density: Density,
    /// Number of grains.
    pub number: u32,
}

/// Inner measures of the box; it is open above.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct ContainerSpec {
    pub width: Length,
    /// Needed in three dimensions only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depth: Option<Length>,
    /// Grains start below it.
    pub height: Length,
    #[serde(default = "SidesSpec::walls")]
    pub sides: SidesSpec,
    #[serde(default = "FloorSpec::flat")]
    pub floor: FloorSpec,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SidesSpec {
    /// Flat rigid walls.
    Walls,
    Periodic,
    /// Periodic along the width, flat rigid walls across the depth.
    PeriodicAlongX,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FloorSpec {
    /// A flat rigid wall.
    Flat,
    /// Fixed grains side by side.
    Grains(FloorGrainsSpec),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct FloorGrainsSpec {
    pub diameter: Length,
    /// Widest gap between neighbours: a whole number of them fills the width.
    #[serde(default = "no_length")]
    pub gap: Length,
    /// Layers of them, each in the hollows of the one over it.
    #[serde(default = "one")]
    pub layers: u32,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ArrangementSpec {
    /// At random without overlap, over the whole box.
    Random,
    /// A cubic lattice over the whole box, slightly shaken.
    Lattice,
    /// A dense random packing from the floor up.
    Packed(PackedSpec),
    /// Where the last instant of a stored table `snapshots` left them, with their velocities; contact
    /// histories and spins start afresh.
    Snapshot(Box<SnapshotSpec>),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct SnapshotSpec {
    /// Parquet table with the columns time, class, x, y, z, radius, speed_x, speed_y and speed_z of the
    /// stored table `snapshots`. A relative path begins at the folder of the study, else at the working
    /// directory. Fixed grains of a floor (class -1) are left out.
    pub file: String,
    /// BLAKE3 of the contents of the file: other contents are another point.
    #[serde(skip_deserializing, skip_serializing_if = "Option::is_none")]
    #[schemars(skip)]
    pub blake3: Option<String>,
    /// What the file holds, once it is read.
    #[serde(skip)]
    #[schemars(skip)]
    pub contents: Option<Snapshot>,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct PackedSpec {
    pub solids_fraction: Fraction,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CohesionSpec {
    None,
    /// Attraction between spheres, held below a smallest gap.
    VanDerWaals(VanDerWaalsSpec),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct VanDerWaalsSpec {
    /// Hamaker constant; 0 leaves the attraction out.
    pub hamaker: Energy,
    /// Gap below which the attraction grows no more.
    #[serde(default = "one_nanometre")]
    pub smallest_gap: Length,
    /// Share of a grain's weight below which the attraction is cut off.
    #[serde(default = "one_thousandth")]
    pub cut_off: Fraction,
    /// Whether walls attract as well.
    #[serde(default = "yes")]
    pub walls: bool,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ChargeSpec {
    None,
    /// Coulomb's force between centres.
    Coulomb(CoulombSpec),
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct CoulombSpec {
    /// Of every grain.
    pub charge: Charge,
    /// Permittivity of the fluid over that of the vacuum, 78.4 for water at 25 °C.
    pub relative_permittivity: Fraction,
    /// Share of a grain's weight below which the force is left out.
    #[serde(default = "one_thousandth")]
    pub cut_off: Fraction,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GrainDragSpec {
    None,
    Stokes,
    Dallavalle,
    SchillerNaumann,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum VoidageSpec {
    /// Every grain falls as if alone.
    None,
    DiFelice,
    /// Di Felice with the slip of a published misprint.
    AlvimLiteral,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SlicePorositySpec {
    /// By exact volumes of spheres between two planes.
    Exact,
    /// By the slice that holds the centre.
    Centre,
    /// By areas of discs, in two dimensions.
    Areas,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LiftSpec {
    None,
    /// Of a spinning grain.
    Magnus,
}

/// The fluid model, cheapest first.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StillFluidSpec {
    /// At rest everywhere.
    Still(MediumSpec),
    /// Closed vessel: no net volume flux through any height.
    Column(MediumSpec),
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum UntilSpec {
    /// The whole duration.
    Duration,
    /// All grains have settled, or the duration is over.
    Settled,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(transform = list_alone)]
pub enum DetectionSpec {
    /// A list of near pairs with a skin.
    List(ListSpec),
    /// A grid of cells, searched in every step.
    Cells,
    /// Every pair in every step.
    BruteForce,
}

#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
pub struct ListSpec {
    /// Skin over the smallest diameter.
    #[serde(default = "automatic_skin")]
    pub skin: SkinSpec,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SwitchSpec {
    Off,
    On,
}

/// The word `list` stands for a list with its defaults.
fn list_alone(schema: &mut Schema) {
    let alternatives = schema.get_mut("oneOf").and_then(|all| all.as_array_mut());
    if let Some(alternatives) = alternatives {
        alternatives.push(serde_json::json!({"type": "string", "const": "list"}));
    }
}

macro_rules! default_choice {
    ($($choice:ident :: $function:ident = $variant:expr;)+) => {
        $(impl $choice {
            fn $function() -> Self {
                use $choice::*;
                $variant
            }
        })+
    };
}

default_choice! {
    ArrangementSpec::random = Random;
    CohesionSpec::none = None;
    ChargeSpec::none = None;
    GrainDragSpec::schiller_naumann = SchillerNaumann;
    VoidageSpec::di_felice = DiFelice;
    SlicePorositySpec::exact = Exact;
    LiftSpec::none = None;
    UntilSpec::duration = Duration;
    DetectionSpec::list = List(ListSpec { skin: SkinSpec::Automatic });
    SwitchSpec::off = Off;
    SidesSpec::walls = Walls;
    FloorSpec::flat = Flat;
}

fn three() -> u32 {
    3
}

fn four_fifths() -> Fraction {
    Fraction(0.8)
}

fn twenty() -> Fraction {
    Fraction(20.0)
}

fn no_length() -> Length {
    Length(0.0)
}

fn one() -> u32 {
    1
}

fn eleven() -> u32 {
    11
}

fn one_nanometre() -> Length {
    Length(1e-9)
}

fn one_thousandth() -> Fraction {
    Fraction(1e-3)
}

fn yes() -> bool {
    true
}

fn automatic_skin() -> SkinSpec {
    SkinSpec::Automatic
}
