//! From the written filtration to the plain data that runs.

use kynch_sim::scene::{
    CakeLength, CakePermeability, Crossflow, Deposited, Feed, Filtrate, Filtration, Held, Medium, Resistance,
    StillFluid,
};

use super::sedimentation::bed;
use crate::study::spec::filtration::*;
use crate::study::spec::scene::Switch;

/// The scene with the first seed; a point sets its own.
pub fn filtration(spec: &FiltrationSpec) -> Filtration {
    let (fluid, crossflow) = fluid(&spec.fluid);
    Filtration {
        bed: bed(&spec.bed, fluid),
        feed: feed(&spec.feed),
        filtrate: filtrate(&spec.filtrate),
        crossflow,
        deposited: match spec.deposited {
            DepositedSpec::Slow => Deposited::Slow,
            DepositedSpec::Settled => Deposited::Settled,
            DepositedSpec::Carried => Deposited::Carried,
        },
    }
}

fn fluid(spec: &FiltratingFluidSpec) -> (StillFluid, Option<Crossflow>) {
    let (density, viscosity, flow, crossflow) = match spec {
        FiltratingFluidSpec::Uniform(uniform) => (uniform.density, uniform.viscosity, uniform.flow, None),
        FiltratingFluidSpec::Parabolic(parabolic) => {
            let crossflow = Crossflow {
                mean_velocity: parabolic.mean_velocity.0,
                shear_lift: parabolic.shear_lift == Switch::On,
            };
            (
                parabolic.density,
                parabolic.viscosity,
                parabolic.flow,
                Some(crossflow),
            )
        }
    };
    let medium = Medium {
        density: density.0,
        viscosity: viscosity.0,
    };
    let fluid = match flow {
        FlowSpec::Consistent => StillFluid::Column(medium),
        FlowSpec::Literal => StillFluid::Still(medium),
    };
    (fluid, crossflow)
}

fn feed(spec: &FeedSpec) -> Feed {
    match spec {
        FeedSpec::AtStart => Feed::AtStart,
        FeedSpec::Rate(fed) => Feed::Rate {
            rate: fed.rate.0,
            layers: fed.layers.0,
        },
        FeedSpec::Suspension(fed) => Feed::Suspension {
            solids_fraction: fed.solids_fraction.0,
            settling: fed.settling == Switch::On,
            layers: fed.layers.0,
        },
    }
}

fn filtrate(spec: &FiltrateSpec) -> Filtrate {
    Filtrate {
        held: match spec.held {
            HeldSpec::Pressure => Held::Pressure,
            HeldSpec::Flux => Held::Flux,
        },
        pressure_drop: spec.pressure_drop.map(|pressure| pressure.0),
        initial_flux: spec.initial_flux.map(|flux| flux.0),
        medium_resistance: spec.medium_resistance.map(|resistance| resistance.0),
        resistance: match spec.resistance {
            ResistanceSpec::Series => Resistance::Series,
            ResistanceSpec::DarcyCapped => Resistance::DarcyCapped,
        },
        length: match spec.length {
            CakeLengthSpec::Thickness => CakeLength::Thickness,
            CakeLengthSpec::CellHeight => CakeLength::CellHeight,
        },
        permeability: match spec.permeability {
            CakePermeabilitySpec::Mean => CakePermeability::Mean,
            CakePermeabilitySpec::Layered => CakePermeability::Layered,
        },
    }
}
