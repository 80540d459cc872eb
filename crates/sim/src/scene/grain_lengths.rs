//! Over which lengths the grains of a rigid set are coupled to the fluid.

use super::run_sph::exchange_sharpening;
use super::setup::{POROSITY_LENGTH, Settling};
use super::{CouplingLengths, PorosityPath, SharpeningChoice, SphFluid, SuspendedClass};
use crate::coupling::{Exchange, ExchangeRules, GrainSize, PorosityRules, grain_porosity};
use crate::fluid::FluidParticles;
use crate::fluid::kernel::Sharpening;
use crate::math::Vec3;

/// Weights between the fluid and the grains at their places [m].
pub fn exchange(settling: &Settling, sph: &SphFluid, fluid: &FluidParticles, position: &[Vec3]) -> Exchange {
    let rules = ExchangeRules {
        sharpening: match sph.scheme.porosity {
            PorosityPath::OnePass => exchange_sharpening(settling, sph),
            PorosityPath::TwoPass => Sharpening::NONE,
        },
        floor_images: false,
        cut: 2.0,
    };
    let size = |class: &SuspendedClass| GrainSize {
        diameter: class.diameter,
        length: match sph.scheme.porosity {
            PorosityPath::OnePass => settling.exchange_length_of(sph, class),
            PorosityPath::TwoPass => fluid.numerics.smoothing(),
        },
    };
    let classes = settling.grains();
    let sizes = classes.iter().map(|class| size(class)).collect();
    let exchange = Exchange::new(sizes, rules, fluid, position);
    let smallest = settling.mixture.smallest();
    match sph.scheme.coupling_lengths {
        CouplingLengths::DoubleSmoothing => {
            let larger = classes.iter().map(|class| class.diameter > smallest).collect();
            let finest = (POROSITY_LENGTH * smallest).max(1.2 * fluid.numerics.spacing);
            exchange.smoothing_twice(larger, finest, fluid)
        }
        CouplingLengths::DoubleSmoothingLiteral => {
            exchange.giving(literal_shares(settling, &classes, position))
        }
        _ => exchange,
    }
}

/// What Raso (2014), eq. 3.10 as printed leaves of the volume of each grain: the solids fraction of the larger
/// classes where it is, over their own length.
fn literal_shares(settling: &Settling, classes: &[&SuspendedClass], position: &[Vec3]) -> Vec<f64> {
    let smallest = settling.mixture.smallest();
    let is_larger = |class: &&SuspendedClass| class.diameter > smallest;
    let (larger, places): (Vec<GrainSize>, Vec<Vec3>) = (classes.iter().zip(position))
        .filter(|(class, _)| is_larger(class))
        .map(|(class, place)| {
            let size = GrainSize {
                diameter: class.diameter,
                length: POROSITY_LENGTH * class.diameter,
            };
            (size, *place)
        })
        .unzip();
    let rules = PorosityRules {
        sharpening: Sharpening::NONE,
        ..PorosityRules::SHARP_LATTICE
    };
    let mut porosity = grain_porosity(&places, larger, rules, settling.column.width).into_iter();
    (classes.iter())
        .map(|class| match is_larger(class) {
            true => porosity.next().map_or(1.0, |porosity| 1.0 - porosity),
            false => 1.0,
        })
        .collect()
}

/// Porosity of every grain of a block.
pub fn lattice_porosity(settling: &Settling, sph: &SphFluid, position: &[Vec3]) -> Vec<f64> {
    let rules = PorosityRules {
        sharpening: match sph.scheme.sharpening {
            SharpeningChoice::Conservative => Sharpening::EDGE_NEUTRAL,
            SharpeningChoice::None => Sharpening::NONE,
        },
        ..PorosityRules::SHARP_LATTICE
    };
    let size = |class: &SuspendedClass| GrainSize {
        diameter: class.diameter,
        length: settling.porosity_length_of(sph, class),
    };
    let sizes = settling.grains().into_iter().map(size).collect();
    grain_porosity(position, sizes, rules, settling.column.width)
}
