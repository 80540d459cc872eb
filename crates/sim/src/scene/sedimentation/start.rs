//! The bed a scene starts from.

use std::f64::consts::PI;

use super::floor::{floor_grains, walls};
use super::model::{
    Arrangement, Detection, Dimensions, Floor, GrainDrag, Lift, Sedimentation, SlicePorosity, StillFluid,
    Voidage,
};
use super::snapshot;
use super::step::limits;
use crate::arrangement::{self, Fault, Region};
use crate::bed::{self, Attraction, Bed, Grain, Grains, Interaction, Listing, Porosity, Surroundings};
use crate::cohesion::VanDerWaals;
use crate::contact::{Body, ContactLaws, Couple};
use crate::coupling::slices::Measure;
use crate::math::{Random, Vec3, along_curve};
use crate::neighbours::Search;

/// Everything a scene starts from.
///
/// # Errors
/// Grains that do not find room.
pub fn start(scene: &Sedimentation) -> Result<Bed, Fault> {
    let grains = Grains::new(&moving_grains(scene)?, &floor_grains(scene));
    let interaction = interaction(scene, limits(scene).time_step);
    let bed = Bed::new(
        grains,
        &walls(scene),
        interaction,
        surroundings(scene),
        listing(scene),
        porosity(scene),
    )
    .with_threads(scene.threads as usize);
    Ok(if scene.sleeping { bed.with_sleeping() } else { bed })
}

pub fn surroundings(scene: &Sedimentation) -> Surroundings {
    let fluid = scene.fluid.medium();
    Surroundings {
        gravity: scene.gravity,
        fluid_density: fluid.density,
        viscosity: fluid.viscosity,
        drag: scene.drag_law(),
        lift: scene.lift == Lift::Magnus,
        stream: None,
        shear_lift: false,
    }
}

pub fn listing(scene: &Sedimentation) -> Listing {
    match scene.detection {
        Detection::List { skin } => Listing::Skin(skin),
        Detection::Cells => Listing::EveryStep(Search::Grid),
        Detection::BruteForce => Listing::EveryStep(Search::BruteForce),
    }
}

/// The grains as the scene arranges them.
///
/// # Errors
/// Grains that do not find room.
pub fn moving_grains(scene: &Sedimentation) -> Result<Vec<Grain>, Fault> {
    let mut random = Random::new(scene.seed);
    let region = Region {
        width: scene.container.width,
        depth: scene.depth(),
        height: scene.container.height,
        periodic: scene.periodic(),
        dimensions: match scene.dimensions {
            Dimensions::Two => arrangement::Dimensions::Two,
            Dimensions::Three => arrangement::Dimensions::Three,
        },
    };
    let bodies = bodies(scene, &mut random);
    let radii: Vec<f64> = bodies.iter().map(|(body, _)| body.radius).collect();
    let positions = match &scene.arrangement {
        Arrangement::Random => arrangement::random(&region, &radii, &mut random),
        Arrangement::Even => arrangement::even(&region, &radii, &mut random),
        Arrangement::Lattice => arrangement::lattice(&region, &radii, &mut random),
        Arrangement::Packed { solids_fraction } => {
            arrangement::packed(&region, &radii, *solids_fraction, &mut random)
        }
        Arrangement::Snapshot(snapshot) => return Ok(snapshot::grains(scene, snapshot)),
    }?;
    let mut placed: Vec<_> = bodies.into_iter().zip(positions).collect();
    if scene.arrangement == Arrangement::Even {
        // A suspension keeps its neighbours for long: what goes by number then stays together in memory.
        placed = along_the_column(&placed);
    }
    Ok(placed
        .into_iter()
        .map(|((body, class), position)| Grain {
            body,
            class,
            // Grains start above the tops of those that make the floor.
            position: position + Vec3::new(0.0, 0.0, scene.floor_top()),
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
        })
        .collect())
}

/// Grains in an order in which neighbours follow each other.
fn along_the_column<G: Copy>(placed: &[((Body, G), Vec3)]) -> Vec<((Body, G), Vec3)> {
    let places: Vec<[f64; 3]> = placed.iter().map(|(_, position)| (*position).into()).collect();
    let widest = placed
        .iter()
        .map(|((body, _), _)| body.radius)
        .fold(0.0, f64::max);
    let order = along_curve(&places, 2.0 * widest);
    order.into_iter().map(|grain| placed[grain as usize]).collect()
}

/// Sizes and classes of all moving grains; sizes of a spread class are drawn in turn.
pub fn bodies(scene: &Sedimentation, random: &mut Random) -> Vec<(Body, u16)> {
    let mut bodies = Vec::new();
    for (class, kind) in scene.classes.iter().enumerate() {
        for _ in 0..kind.number {
            let diameter = match kind.largest_diameter {
                Some(largest) => 2.0 * arrangement::spread(random, 0.5 * kind.diameter, 0.5 * largest),
                None => kind.diameter,
            };
            bodies.push((Body::sphere(diameter, kind.density), class as u16));
        }
    }
    bodies
}

/// Contacts and attraction over a time step [s].
pub fn interaction(scene: &Sedimentation, time_step: f64) -> Interaction {
    let extremes = scene.extremes();
    let uniform = extremes.len() == 1 && scene.container.floor == Floor::Flat;
    let [along, across] = scene.periodic();
    let period = [
        if along { scene.container.width } else { 0.0 },
        if across && scene.dimensions == Dimensions::Three {
            scene.container.depth
        } else {
            0.0
        },
        0.0,
    ];
    Interaction {
        laws: ContactLaws {
            normal: scene.normal.law(),
            tangential: scene.tangential,
            rolling: scene.rolling,
        },
        attraction: attraction(scene),
        couple: uniform.then(|| Couple::new(&extremes[0].0, &extremes[0].0)),
        period,
        time_step,
    }
}

fn attraction(scene: &Sedimentation) -> Option<Attraction> {
    if scene.cohesion.is_none() && scene.charge.is_none() {
        return None;
    }
    let least = scene
        .extremes()
        .iter()
        .map(|(body, _)| body.mass * scene.gravity)
        .fold(f64::INFINITY, f64::min);
    let largest = 0.5 * scene.largest_diameter();
    Some(Attraction {
        van_der_waals: scene.cohesion.map(|cohesion| {
            VanDerWaals::weaker_than(
                cohesion.cut_off * least,
                cohesion.hamaker,
                cohesion.smallest_gap,
                largest,
            )
        }),
        walls: scene.cohesion.is_some_and(|cohesion| cohesion.walls),
        charge: scene.charge.map(|charged| {
            let law = charged.law();
            let at_a_metre = law.force(1.0_f64, charged.charge, charged.charge).abs();
            bed::Charge {
                law,
                charge: charged.charge,
                cut_off_gap: (at_a_metre / (charged.cut_off * least)).sqrt(),
            }
        }),
    })
}

/// Slices, where anything depends on them.
fn porosity(scene: &Sedimentation) -> Option<Porosity> {
    let closed = matches!(scene.fluid, StillFluid::Column(_));
    let alone = match scene.drag {
        GrainDrag::None => true,
        GrainDrag::Beetstra | GrainDrag::BeetstraCello => false,
        _ => scene.voidage == Voidage::None,
    };
    (closed || mixed(scene) || !alone).then(|| slices(scene))
}

/// Whether grains of several densities share the drag on the mixture.
fn mixed(scene: &Sedimentation) -> bool {
    let extremes = scene.extremes();
    let differ = extremes.iter().any(|(_, other)| *other != extremes[0].1);
    differ && scene.drag != GrainDrag::None
}

/// Slices one largest diameter high.
pub fn slices(scene: &Sedimentation) -> Porosity {
    let viscosity = scene.fluid.medium().viscosity;
    let relaxation = scene
        .extremes()
        .iter()
        .map(|(body, _)| body.mass / (6.0 * PI * viscosity * body.radius))
        .fold(f64::INFINITY, f64::min);
    let (measure, area) = match scene.porosity {
        SlicePorosity::Exact => (Measure::Exact, scene.container.width * scene.depth()),
        SlicePorosity::Centre => (Measure::Centre, scene.container.width * scene.depth()),
        SlicePorosity::Areas => (Measure::Areas, scene.container.width),
    };
    Porosity::new(
        scene.largest_diameter(),
        area,
        measure,
        matches!(scene.fluid, StillFluid::Column(_)),
        mixed(scene),
        relaxation,
    )
}
