//! The filtration scene as plain data in SI units.

use crate::scene::Sedimentation;

/// A suspension is driven through a filter medium; its grains stay behind and form a cake.
///
/// What it shares with a sedimentation is one: `bed` holds the grains, the cell, the laws, the forces
/// and the numerics, and here means:
///
/// - `bed.classes`: the grains that are fed in the whole run, `number` of each class;
/// - `bed.container`: the cell. Its floor is the filter medium, its height that of the clear channel
///   over the medium. A flow across needs sides that are periodic along x;
/// - `bed.arrangement`: read for [`Feed::AtStart`] only;
/// - `bed.fluid`: what the filtrate flux is superposed on. `Column`: no volume flux but the filtrate's,
///   u_f = (−q e_z − (1 − ε)⟨v⟩)/ε. `Still`: u_f = −q e_z, as printed in Alvim (2016);
/// - `bed.until`: `Settled` ends the run when all grains have been fed and lie in the cake or have
///   passed through the medium.
#[derive(Clone, Debug, PartialEq)]
pub struct Filtration {
    pub bed: Sedimentation,
    pub feed: Feed,
    pub filtrate: Filtrate,
    /// `None` is dead-end filtration.
    pub crossflow: Option<Crossflow>,
    pub deposited: Deposited,
}

/// How grains come into the cell. They start with the velocity of the fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feed {
    /// All are there at the start, as the arrangement of the bed says.
    AtStart,
    /// So many in a second [1/s], in equal intervals, into the top of the cell.
    Rate { rate: f64, layers: f64 },
    /// With the suspension that the filtrate draws in.
    Suspension {
        /// Solids fraction φ_0 of the suspension [-].
        solids_fraction: f64,
        /// Whether grains settle into the cell as well: dN/dt V = φ_0 (q + w) A in place of φ_0 q A, with the
        /// settling speed w among others at φ_0.
        settling: bool,
        /// Height of the zone that grains are fed into, in largest diameters from the top of the cell [-].
        layers: f64,
    },
}

/// How the filtrate is driven, and what resists it. ΔP = μ q₀ R_m ties the pressure drop, the flux and
/// the resistance of the medium at the start: two of the three are given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filtrate {
    pub held: Held,
    /// ΔP, at constant flux ΔP₀ at the start [Pa].
    pub pressure_drop: Option<f64>,
    /// q₀, filtrate volume per area and time before there is a cake [m/s].
    pub initial_flux: Option<f64>,
    /// R_m [1/m].
    pub medium_resistance: Option<f64>,
    pub resistance: Resistance,
    pub length: CakeLength,
    pub permeability: CakePermeability,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    Pressure,
    Flux,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resistance {
    /// Medium and cake in series: ΔP = μ q (R_m + L/k).
    Series,
    /// The cake alone, ΔP = μ q L/k, and the flux no more than q₀: Alvim (2016) eqs. 94–95.
    DarcyCapped,
}

/// The length L that the filtrate takes through the cake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CakeLength {
    Thickness,
    /// The height of the cell as soon as there is a cake: what reproduces a flux in print.
    CellHeight,
}

/// What the permeability k of the cake follows from, by Kozeny and Carman with the Sauter diameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CakePermeability {
    /// The porosity of the cake's central slice (of areas in two dimensions).
    Mean,
    /// The porosities of its layers, one largest diameter thick: their resistances in series.
    Layered,
}

/// Flow along x over the medium: u_x = 6 ū (z/H − z²/H²), Alvim (2016) eq. 88, under a flat lid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossflow {
    /// ū, mean over the height [m/s].
    pub mean_velocity: f64,
    /// Whether grains that lag or lead in the shear are lifted (Saffman). That of spinning grains
    /// (Magnus) is `bed.lift`.
    pub shear_lift: bool,
}

/// Which grains belong to the cake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deposited {
    /// Those slower than a tenth of the terminal speed that a chain of contacts among their like carries.
    /// A growing cake gives way, slowly.
    Slow,
    /// Those that have settled as in a sedimentation: slower than a hundredth of the terminal speed,
    /// hardly moved in 10 ms, and carried by a chain of contacts among their like.
    Settled,
    /// All that a chain of contacts carries.
    Carried,
}
