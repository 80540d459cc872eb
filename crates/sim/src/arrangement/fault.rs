//! Why grains cannot be arranged as asked.

use thiserror::Error;

/// What is wrong with a box or its grains; [`Fault::help`] says what to do.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Fault {
    #[error("the {name} of the box is {length} m, it must be above 0")]
    Length { name: &'static str, length: f64 },
    #[error("the radius of grain {grain} is {radius} m, it must be above 0")]
    Radius { grain: usize, radius: f64 },
    #[error(
        "grain {grain} has a diameter of {diameter:.4e} m, more than the {name} of the box, {length:.4e} m"
    )]
    GrainTooLarge {
        grain: usize,
        diameter: f64,
        name: &'static str,
        length: f64,
    },
    #[error("the grains would fill {fraction:.4} of the box, at most {limit:.2} can be arranged at random")]
    TooDense { fraction: f64, limit: f64 },
    #[error("a solids fraction of {fraction} cannot be packed, it must lie above 0 and up to {limit:.2}")]
    Fraction { fraction: f64, limit: f64 },
    #[error(
        "at a solids fraction of {fraction} the packing is {needed:.4e} m high, the box only {height:.4e} m"
    )]
    TooHigh { fraction: f64, needed: f64, height: f64 },
    #[error(
        "at a solids fraction of {fraction} the packing is {needed:.4e} m high, less than the largest \
         grain's diameter, {diameter:.4e} m"
    )]
    TooLow {
        fraction: f64,
        needed: f64,
        diameter: f64,
    },
    #[error(
        "no arrangement without overlap was found at a solids fraction of {fraction:.4}: pairs still \
         overlap by up to {overlap:.1e} of their distance"
    )]
    Jammed { fraction: f64, overlap: f64 },
    #[error(
        "a lattice of {grains} grains has a pitch of {pitch:.4e} m, less than the largest diameter, \
         {diameter:.4e} m"
    )]
    LatticeTooTight {
        grains: usize,
        pitch: f64,
        diameter: f64,
    },
}

impl Fault {
    /// What to do about it.
    pub fn help(&self) -> &'static str {
        match self {
            Fault::Length { .. } | Fault::Radius { .. } => "write a positive, finite number",
            Fault::GrainTooLarge { .. } => "take smaller grains or a larger box",
            Fault::TooDense { .. } => "take fewer or smaller grains, or a larger box",
            Fault::Fraction { .. } => "write a solids fraction within the limits",
            Fault::TooHigh { .. } => "take a higher box, fewer grains or a larger solids fraction",
            Fault::TooLow { .. } => "take a narrower box, more grains or a smaller solids fraction",
            Fault::Jammed { .. } => {
                "take a smaller solids fraction; walls less than ten diameters apart lower what can be reached"
            }
            Fault::LatticeTooTight { .. } => {
                "take fewer or smaller grains, a larger box, or arrange at random"
            }
        }
    }
}
