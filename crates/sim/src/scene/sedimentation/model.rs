//! The sedimentation scene as plain data in SI units.

use std::sync::Arc;

use crate::math::Vec3;
use crate::scene::{IntegratorChoice, Medium, Normal, Rolling, Tangential};

/// Grains fall through a fluid onto the floor of a box and form a bed.
#[derive(Clone, Debug, PartialEq)]
pub struct Sedimentation {
    pub dimensions: Dimensions,
    /// Kinds of grains; every one is placed.
    pub classes: Vec<GrainClass>,
    pub container: Container,
    pub arrangement: Arrangement,
    pub normal: Normal,
    pub tangential: Tangential,
    pub rolling: Rolling,
    /// `None` leaves cohesion out.
    pub cohesion: Option<Cohesion>,
    /// `None` leaves Coulomb's force out.
    pub charge: Option<Charge>,
    pub drag: GrainDrag,
    pub voidage: Voidage,
    pub porosity: SlicePorosity,
    pub lift: Lift,
    pub fluid: StillFluid,
    pub gravity: f64,
    /// Longest simulated time [s].
    pub duration: f64,
    pub until: Until,
    pub integrator: IntegratorChoice,
    pub detection: Detection,
    /// Whether grains that have come to rest are left out until something moves them.
    pub sleeping: bool,
    /// Share of the bed's thickness that counts as its central slice v_l [-].
    pub central_slice: f64,
    /// Steps per contact time where the step is picked [-].
    pub steps_per_contact: f64,
    /// Time step [s]; `None` picks the safe one.
    pub time_step: Option<f64>,
    /// Accept a `time_step` beyond the safe one.
    pub unsafe_time_step: bool,
    /// Threads inside the run; results do not depend on it.
    pub threads: u32,
    /// Seed of the starting arrangement.
    pub seed: u64,
    /// Snapshots kept, equally spaced in time, the first and the last included.
    pub snapshots: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimensions {
    /// Spheres whose centres stay in the plane y = 0; they turn about y only.
    Two,
    Three,
}

/// Equal spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrainClass {
    /// Diameter d [m].
    pub diameter: f64,
    /// Diameters are spread between `diameter` and this [m] by p(R) = R₁R₂/((R₂ − R₁)R²), Alvim
    /// (2016) eq. 91; `None` makes them equal.
    pub largest_diameter: Option<f64>,
    /// Density ρ_s [kg/m³].
    pub density: f64,
    /// Number of grains.
    pub number: u32,
}

/// The inner measures of the box [m]; floor at z = 0, open top above `height`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Container {
    /// Along x.
    pub width: f64,
    /// Along y; not read in two dimensions.
    pub depth: f64,
    /// Along z: grains start below it.
    pub height: f64,
    pub sides: Sides,
    pub floor: Floor,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// Flat rigid walls with the contact law of the grains.
    Walls,
    Periodic,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Floor {
    /// A flat rigid wall.
    Flat,
    /// Fixed grains side by side of this diameter [m], their centres at z = 0.
    Grains { diameter: f64 },
}

#[derive(Clone, Debug, PartialEq)]
pub enum Arrangement {
    /// At random without overlap, uniform over the whole box.
    Random,
    /// At random without overlap, but evenly: the concentration is the same everywhere over lengths of many
    /// grains, and that of each class by itself.
    Even,
    /// A cubic lattice over the whole box, shaken by a hundredth of the pitch.
    Lattice,
    /// A dense random packing of this solids fraction [-], from the floor up.
    Packed { solids_fraction: f64 },
    /// Where the grains of an earlier run were.
    Snapshot(Snapshot),
}

/// Grains as an earlier run left them. Spins and the histories of contacts are not among them: no
/// grain turns at the start, and every tangential spring starts relaxed.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// The file they come from, as it is called in messages.
    pub file: String,
    /// The grains, or why they cannot be read.
    pub grains: Result<Arc<[Placed]>, String>,
}

/// A moving grain of a snapshot. Its density is that of its class.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Position of its class among the classes of the scene.
    pub class: usize,
    /// [m]
    pub position: Vec3,
    /// [m/s]
    pub velocity: Vec3,
    /// [m]
    pub radius: f64,
}

/// Van der Waals attraction, Alvim (2016) eq. 49 with the second bracket squared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cohesion {
    /// H_a [J].
    pub hamaker: f64,
    /// Gap h_min [m] below which the attraction grows no more, in contact too.
    pub smallest_gap: f64,
    /// The attraction is cut off where it falls below this share of a grain's weight [-].
    pub cut_off: f64,
    /// Whether walls attract as well.
    pub walls: bool,
}

/// One charge on every grain; walls carry none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Charge {
    /// [C]
    pub charge: f64,
    /// ε_r of the fluid between the grains [-].
    pub relative_permittivity: f64,
    /// The force is left out where it falls below this share of a grain's weight [-].
    pub cut_off: f64,
}

/// Drag of an isolated grain; the last two hold their neighbours already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GrainDrag {
    None,
    Stokes,
    Dallavalle,
    SchillerNaumann,
    CoulsonRichardson,
    Beetstra,
    BeetstraCello,
}

/// What the neighbours make of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Voidage {
    /// Nothing: every grain falls as if alone.
    None,
    DiFelice,
    /// Di Felice as printed in Alvim (2016), eq. 55: the slip lacks ε².
    AlvimLiteral,
}

/// Porosity of horizontal slices one largest diameter high.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlicePorosity {
    /// By exact volumes of spheres between two planes.
    Exact,
    /// By the slice that holds the centre.
    Centre,
    /// By the slice that holds the centre, areas of discs: two dimensions only.
    Areas,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lift {
    None,
    /// Of a spinning grain.
    Magnus,
}

/// A fluid that is not solved for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StillFluid {
    /// At rest everywhere.
    Still(Medium),
    /// Closed vessel: no net volume flux through any height.
    Column(Medium),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Until {
    /// The whole duration.
    Duration,
    /// All grains have settled, or the duration is over.
    Settled,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Detection {
    /// A list of near pairs with a skin, rebuilt when a grain has moved half of it.
    List {
        /// Skin over the smallest diameter [-]; `None` picks it.
        skin: Option<f64>,
    },
    /// A grid of cells, searched in every step.
    Cells,
    /// Every pair in every step.
    BruteForce,
}
