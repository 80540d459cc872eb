//! The suspension scene as plain data in SI units.

use crate::scene::{Column, Drag, Medium, SphFluid};

/// A homogeneous suspension settles in a square column, periodic in x and y, with a floor at z = 0 and an
/// open top: grains fill the whole column at the start and fall through the fluid onto the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Suspension {
    /// Kinds of grains, one to four; all of them are mixed evenly at the start.
    pub classes: Vec<SuspendedClass>,
    /// Porosity ε₀ of the suspension at the start [-], from 0.6 up to below 1; the numbers of the grains
    /// follow from it.
    pub porosity: f64,
    pub column: Column,
    pub arrangement: Homogeneity,
    pub drag: Drag,
    pub fluid: SuspendingFluid,
    pub contact: SoftContact,
    /// Grains whose mean height is the interface [-], shared out to the classes by number; `None` takes 3 %
    /// of the grains, 600 at most.
    pub top_grains: Option<u32>,
    /// Simulated time [s].
    pub duration: f64,
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
    /// Grain steps per contact time [-] where the step is picked.
    pub steps_per_contact: f64,
    /// Step of the grains [s]; `None` picks the safe one. In a particle fluid, whose own step is
    /// `fluid.sph.scheme.time_step`, it is the longest sub-step.
    pub time_step: Option<f64>,
    /// Accept a `time_step` beyond the safe one.
    pub unsafe_time_step: bool,
    /// Threads inside the run; results do not depend on it.
    pub threads: u32,
    /// Seed of the starting arrangement.
    pub seed: u64,
    /// Snapshots kept, equally spaced in time, the first and the last included; 0 keeps none.
    pub snapshots: u32,
}

/// Equal spheres in a suspension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SuspendedClass {
    /// Diameter d [m].
    pub diameter: f64,
    /// Density ρ_s [kg/m³].
    pub density: f64,
    /// Share of the number of all grains [-]; the shares of a scene add up to 1.
    pub share: f64,
}

/// How even the concentration is at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Homogeneity {
    /// At random without overlap, but evenly over lengths of many grains, each class by itself. Concentration
    /// then differs from place to place only over short lengths, and hardly any convection starts. The
    /// default: with an `sph` fluid at porosity 0.9 the rms of the vertical velocity is a third of that after a
    /// random start, and the mean settling speed nearer to the balance of forces.
    Even,
    /// At random without overlap, each grain wherever it fits. The number of grains in a volume scatters
    /// as in a hard-sphere fluid, and denser regions sink through lighter ones: in an `sph` fluid grains settle
    /// faster by a few per cent than the balance of forces has it.
    Random,
}

/// What the grains settle in.
#[derive(Clone, Debug, PartialEq)]
pub enum SuspendingFluid {
    /// Closed vessel: no net volume flux through any height.
    Column(Medium),
    /// Two-way coupled, locally averaged Navier–Stokes equations on particles.
    /// `spacing_over_diameter` is over the diameter of the smallest class. The contact of the grains is
    /// the scene's: `stiffness` and `steps_per_contact` of the scheme must stay at their defaults.
    Sph(SphFluid),
}

impl SuspendingFluid {
    pub fn medium(&self) -> Medium {
        match self {
            SuspendingFluid::Column(medium) => *medium,
            SuspendingFluid::Sph(fluid) => fluid.medium,
        }
    }
}

/// Linear spring and dashpot between grains, and between grains and the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftContact {
    /// k [N/m]; `None` takes the softest spring that keeps impacts and the load of the settled bed at
    /// 0.25 % of the smallest diameter.
    pub stiffness: Option<f64>,
    /// Restitution e of a dry contact [-].
    pub restitution: f64,
    /// Coulomb's friction μ [-] of a Cundall–Strack spring of 2/7 of the normal stiffness, with which
    /// sliding and bouncing take the same time; `None` leaves friction and rotation out.
    pub friction: Option<f64>,
}

impl Suspension {
    /// Number of grains at which the start has the porosity of the scene: the solids over the mean volume.
    pub fn grains(&self) -> u64 {
        self.numbers().iter().sum()
    }

    /// Number of grains of each class, rounded; the shares differ from those asked for by half a grain.
    pub fn numbers(&self) -> Vec<u64> {
        let room = self.column.width * self.column.width * self.column.height;
        let volume = |class: &SuspendedClass| std::f64::consts::PI / 6.0 * class.diameter.powi(3);
        let mean: f64 = self.classes.iter().map(|class| class.share * volume(class)).sum();
        let all = (1.0 - self.porosity) * room / mean;
        self.classes
            .iter()
            .map(|class| (all * class.share).round() as u64)
            .collect()
    }

    /// Grains whose mean height is the interface.
    pub fn interface_grains(&self) -> u64 {
        let grains = self.grains();
        let picked = (grains * 3).div_ceil(100).min(600);
        self.top_grains.map_or(picked, u64::from).clamp(1, grains.max(1))
    }

    /// Diameter of the smallest class [m].
    pub fn smallest_diameter(&self) -> f64 {
        let diameters = self.classes.iter().map(|class| class.diameter);
        diameters.fold(f64::INFINITY, f64::min)
    }

    /// Diameter of the largest class [m].
    pub fn largest_diameter(&self) -> f64 {
        let diameters = self.classes.iter().map(|class| class.diameter);
        diameters.fold(0.0, f64::max)
    }
}
