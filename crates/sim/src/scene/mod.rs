//! The scenes the simulator knows, as plain data in SI units.

mod check;
mod collision;
mod course;
mod describe;
mod divergence;
mod filtration;
mod grain_lengths;
mod mixture;
mod observables;
mod passage;
mod profiles;
mod record;
mod run_prescribed;
mod run_sph;
mod sedimentation;
mod setup;
mod snapshots;
mod suspension;

pub use check::check;
pub use collision::{BinaryCollision, IntegratorChoice, Material, Normal, Partner, Rolling, Tangential};
pub use describe::describe;
pub use filtration::{
    CakeLength, CakePermeability, Crossflow, Deposited, Feed, Filtrate, Filtration, Held, Resistance,
};
pub use observables::observables;
pub use sedimentation::{
    Arrangement, Charge, Cohesion, Container, Detection, Dimensions, Floor, FloorGrains, GrainClass,
    GrainDrag, Lift, Placed, Sedimentation, Sides, SlicePorosity, Snapshot, StillFluid, Until, Voidage,
};
pub use suspension::{Homogeneity, SoftContact, SuspendedClass, SuspendingFluid, Suspension};

use crate::outcome::{Control, Failure, Outcome};

/// A complete, self-contained description of one simulation.
#[derive(Clone, Debug, PartialEq)]
pub enum Scene {
    SingleSphere(SingleSphere),
    ConstantPorosityBlock(ConstantPorosityBlock),
    BinaryCollision(BinaryCollision),
    Sedimentation(Sedimentation),
    Suspension(Suspension),
    Filtration(Filtration),
}

impl Scene {
    /// Threads that a run of it keeps busy.
    pub fn threads(&self) -> u32 {
        match self {
            Scene::Sedimentation(scene) => scene.threads,
            Scene::Suspension(scene) => scene.threads,
            Scene::Filtration(scene) => scene.bed.threads,
            Scene::SingleSphere(_) | Scene::ConstantPorosityBlock(_) | Scene::BinaryCollision(_) => 1,
        }
    }
}

/// One grain falls from rest in a column of fluid, away from the walls.
#[derive(Clone, Debug, PartialEq)]
pub struct SingleSphere {
    pub grains: Grains,
    pub drag: Drag,
    pub fluid: Fluid,
    pub column: Column,
    /// Release height over column height [-].
    pub release_height: f64,
    pub coupling: Coupling,
    /// Whether the grain's own disturbance is taken out of the fluid velocity it sees.
    pub self_disturbance: SelfDisturbance,
    /// Whether the grain carries fluid along when it accelerates: ½ρ_f V of added mass. For fluids that
    /// are not solved.
    pub added_mass: bool,
    /// Simulated time [s].
    pub duration: f64,
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
}

/// A rigid lattice of grains falls through the whole cross-section: every grain gets the mean force.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstantPorosityBlock {
    /// Classes of grains, one to four, mixed evenly on the lattice.
    pub classes: Vec<SuspendedClass>,
    pub drag: Drag,
    pub fluid: Fluid,
    pub column: Column,
    /// Porosity ε of the block [-], met exactly by the vertical pitch.
    pub porosity: f64,
    /// Grains along each horizontal side [-].
    pub grains_per_side: u32,
    /// Horizontal layers of grains [-].
    pub layers: u32,
    /// Held in place (to test rest) or falling.
    pub held: bool,
    /// Simulated time [s].
    pub duration: f64,
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
}

/// Equal spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grains {
    /// Diameter d [m].
    pub diameter: f64,
    /// Density ρ_p [kg/m³].
    pub density: f64,
}

/// Square cross-section, periodic in x and y, floor at z = 0, open top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Side of the cross-section [m].
    pub width: f64,
    /// Fluid height H [m].
    pub height: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drag {
    Stokes,
    Dallavalle,
    SchillerNaumann,
    /// Dallavalle with the Di Felice voidage function.
    DiFelice,
    CoulsonRichardson,
    /// Beetstra, for beds of equal spheres.
    Beetstra,
    /// Beetstra shared out among grains of several sizes.
    BeetstraCello,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coupling {
    /// The grain feels the fluid, the fluid does not feel the grain.
    OneWay,
    TwoWay,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SelfDisturbance {
    Corrected,
    Uncorrected,
}

/// The fluid model, cheapest first.
#[derive(Clone, Debug, PartialEq)]
pub enum Fluid {
    /// At rest everywhere.
    Still(Medium),
    /// Closed vessel: no net volume flux through any height.
    Column(Medium),
    /// Two-way coupled, locally averaged Navier–Stokes equations on particles.
    Sph(SphFluid),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Density ρ_f [kg/m³].
    pub density: f64,
    /// Viscosity μ [Pa s].
    pub viscosity: f64,
}

#[derive(Clone, Debug, PartialEq)]
pub struct SphFluid {
    pub medium: Medium,
    /// Particle spacing over grain diameter [-].
    pub spacing_over_diameter: f64,
    pub scheme: Scheme,
}

/// Numerical choices of the particle fluid; [`Scheme::default`] is the recommended one, each
/// other variant a named departure from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Scheme {
    pub sound_speed: SoundSpeed,
    pub hydrostatics: Hydrostatics,
    pub kernel: KernelChoice,
    /// Coefficient α of the always-on artificial viscosity; `None` leaves the term out.
    pub artificial_viscosity: Option<f64>,
    /// Constant S between α and the real viscosity (9 for Wendland C2); only read by the
    /// α form of the real viscosity, `None` uses the Morris form.
    pub viscosity_constant: Option<f64>,
    pub porosity: PorosityPath,
    pub sharpening: SharpeningChoice,
    pub start: Start,
    /// Density that multiplies the fluid stress on a grain.
    pub stress_density: StressDensity,
    pub slip: Slip,
    pub coupling_lengths: CouplingLengths,
    /// Contact stiffness k [N/m]; `None` takes it from an overlap target of 0.3 % of d.
    pub stiffness: Option<f64>,
    /// Grain steps per contact time [-].
    pub steps_per_contact: f64,
    /// Time step [s]; `None` picks the safe one.
    pub time_step: Option<f64>,
    /// Accept a `time_step` beyond the safe one.
    pub unsafe_time_step: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SoundSpeed {
    Automatic,
    /// c = 20 √(2 g H), the choice of Raso (2014).
    FreeFall,
    /// [m/s]
    Value(f64),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hydrostatics {
    /// The hydrostatic part is carried analytically.
    Split,
    /// The equation of state carries the whole pressure.
    Carried,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KernelChoice {
    WendlandC2,
    Lucy,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PorosityPath {
    /// From the grains in one pass, with the length of the grain class.
    OnePass,
    /// From the grains to the fluid and back, both with the fluid's smoothing length.
    TwoPass,
}

/// Whether smoothing between grains and fluid gives back what it takes from sharp edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SharpeningChoice {
    /// Plain kernels.
    None,
    /// Exchange kernels of zero second moment, porosity kernels of zero mean distance.
    Conservative,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Exact equilibrium, no relaxation.
    Exact,
    /// Lattice at rest without pressure, damped for 1000 steps.
    Relaxed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StressDensity {
    Superficial,
    /// ρ₀ in place of ε ρ₀: a defect of a published program, kept to reproduce its results.
    Intrinsic,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slip {
    Superficial,
    /// Interstitial slip in a law that wants the superficial one: a defect of a published program.
    Interstitial,
}

/// Over which length a grain gives its volume to the fluid and is given its porosity, where there are
/// several classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CouplingLengths {
    /// Each class over its own.
    PerClass,
    /// All over that of the smallest class: large grains stand out of the field one by one.
    Smallest,
    /// All over that of the largest class: the fluid learns of the small ones as coarsely as of the large.
    Largest,
    /// Larger grains first over their own length to the fluid, then over the smallest among the fluid:
    /// Raso (2014), eqs. 3.8–3.10, with the volume of the fluid particle in the second sum.
    DoubleSmoothing,
    /// The same with the volume of the grain in the second sum, as eq. 3.10 is printed: a share φ_b² of the
    /// larger grains arrives in place of φ_b.
    DoubleSmoothingLiteral,
}

impl Scheme {
    /// The recommended scheme where grains lie at random: plain kernels. Sharpened ones give back the edges
    /// of a lattice block, but among random grains they amplify the noise of counting.
    pub fn for_random_grains() -> Scheme {
        Scheme {
            sharpening: SharpeningChoice::None,
            ..Scheme::default()
        }
    }
}

impl Default for Scheme {
    fn default() -> Self {
        Scheme {
            sound_speed: SoundSpeed::Automatic,
            hydrostatics: Hydrostatics::Split,
            kernel: KernelChoice::WendlandC2,
            artificial_viscosity: None,
            viscosity_constant: None,
            porosity: PorosityPath::OnePass,
            sharpening: SharpeningChoice::Conservative,
            start: Start::Exact,
            stress_density: StressDensity::Superficial,
            slip: Slip::Superficial,
            coupling_lengths: CouplingLengths::PerClass,
            stiffness: None,
            steps_per_contact: 20.0,
            time_step: None,
            unsafe_time_step: false,
        }
    }
}

/// Something in a scene that cannot be simulated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Where, as a path inside the scene: `fluid.sph.spacing_over_diameter`.
    pub path: String,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: String,
}

/// A quantity a scene can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Observable {
    pub name: &'static str,
    pub unit: &'static str,
    pub kind: ObservableKind,
    /// One line.
    pub meaning: &'static str,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObservableKind {
    Scalar,
    /// A column of the table `time_series`.
    Series,
    /// A table of its own.
    Profile,
}

/// A scene in words and numbers, for `explain` and `plan`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Description {
    /// Physics the scene compiles in, one line each.
    pub active: Vec<String>,
    /// Physics left out, with the reason.
    pub left_out: Vec<String>,
    /// Dimensionless numbers and derived values: name, value, unit.
    pub numbers: Vec<(String, f64, &'static str)>,
    pub warnings: Vec<String>,
    /// Particles, steps and their product: the work to expect.
    pub fluid_particles: u64,
    pub grains: u64,
    pub steps: u64,
    /// Estimated cost in particle-steps of the fluid plus coupling, for time estimates.
    pub work: f64,
    /// Estimated peak memory [bytes].
    pub memory: u64,
}

/// Runs the scene to its end.
///
/// # Errors
/// [`Failure`] when the run diverges or is stopped; it keeps what was computed.
pub fn run(scene: &Scene, control: &Control) -> Result<Outcome, Box<Failure>> {
    let settling = match scene {
        Scene::SingleSphere(sphere) => setup::Settling::of_sphere(sphere),
        Scene::ConstantPorosityBlock(block) => setup::Settling::of_block(block),
        Scene::BinaryCollision(collision) => return collision::run(collision, control),
        Scene::Sedimentation(scene) => return sedimentation::run(scene, control),
        Scene::Suspension(scene) => return suspension::run(scene, control),
        Scene::Filtration(scene) => return filtration::run(scene, control),
    };
    match settling.sph() {
        Some(sph) => setup::with_law!(settling.drag, law => run_sph::run(&settling, sph, law, control)),
        None => setup::with_law!(settling.drag, law => run_prescribed::run(&settling, law, control)),
    }
}
