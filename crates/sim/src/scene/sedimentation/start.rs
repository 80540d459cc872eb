//! The bed a scene starts from.

use std::f64::consts::PI;

use super::model::{
    Arrangement, Detection, Dimensions, Floor, GrainDrag, Lift, Sedimentation, Sides, SlicePorosity,
    StillFluid, Voidage,
};
use super::snapshot;
use super::step::limits;
use crate::arrangement::{self, Fault, Region};
use crate::bed::{self, Attraction, Bed, Grain, Grains, Interaction, Listing, Porosity, Surroundings, Wall};
use crate::cohesion::VanDerWaals;
use crate::contact::{Body, ContactLaws, Couple};
use crate::coupling::slices::Measure;
use crate::math::{Random, Vec3};
use crate::neighbours::Search;

/// Everything a scene starts from.
///
/// # Errors
/// Grains that do not find room.
pub fn start(scene: &Sedimentation) -> Result<Bed, Fault> {
    let grains = Grains::new(&moving_grains(scene)?, &floor_grains(scene));
    let fluid = scene.fluid.medium();
    let surroundings = Surroundings {
        gravity: scene.gravity,
        fluid_density: fluid.density,
        viscosity: fluid.viscosity,
        drag: scene.drag_law(),
        lift: scene.lift == Lift::Magnus,
    };
    let listing = match scene.detection {
        Detection::List { skin } => Listing::Skin(skin),
        Detection::Cells => Listing::EveryStep(Search::Grid),
        Detection::BruteForce => Listing::EveryStep(Search::BruteForce),
    };
    let bed = Bed::new(
        grains,
        &walls(scene),
        interaction(scene),
        surroundings,
        listing,
        porosity(scene),
    )
    .with_threads(scene.threads as usize);
    Ok(if scene.sleeping { bed.with_sleeping() } else { bed })
}

fn moving_grains(scene: &Sedimentation) -> Result<Vec<Grain>, Fault> {
    let mut random = Random::new(scene.seed);
    let region = Region {
        width: scene.container.width,
        depth: scene.depth(),
        height: scene.container.height,
        periodic: scene.container.sides == Sides::Periodic,
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
    let placed = bodies.into_iter().zip(positions);
    Ok(placed
        .map(|((body, class), position)| Grain {
            body,
            class,
            position: position + lift_of_floor(scene),
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
        })
        .collect())
}

/// Sizes and classes of all moving grains; sizes of a spread class are drawn in turn.
fn bodies(scene: &Sedimentation, random: &mut Random) -> Vec<(Body, u16)> {
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

/// Grains start above the tops of those that make the floor.
fn lift_of_floor(scene: &Sedimentation) -> Vec3 {
    match scene.container.floor {
        Floor::Flat => Vec3::zeros(),
        Floor::Grains { diameter } => Vec3::new(0.0, 0.0, 0.5 * diameter),
    }
}

/// Fixed grains side by side along x, their centres at z = 0.
fn floor_grains(scene: &Sedimentation) -> Vec<Grain> {
    let Floor::Grains { diameter } = scene.container.floor else {
        return Vec::new();
    };
    let width = scene.container.width;
    // Without a gap: the last ones may overlap a little.
    let count = (width / diameter).ceil() as u32;
    (0..count)
        .map(|i| Grain {
            body: Body::sphere(diameter, 1.0),
            class: u16::MAX,
            position: Vec3::new(width * (f64::from(i) + 0.5) / f64::from(count), 0.0, 0.0),
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
        })
        .collect()
}

fn walls(scene: &Sedimentation) -> Vec<Wall> {
    let mut walls = vec![Wall {
        normal: Vec3::z(),
        // Under a floor of grains it only catches what falls through.
        point: match scene.container.floor {
            Floor::Flat => Vec3::zeros(),
            Floor::Grains { diameter } => Vec3::new(0.0, 0.0, -diameter - scene.largest_diameter()),
        },
    }];
    if scene.container.sides == Sides::Walls {
        let far = Vec3::new(scene.container.width, scene.depth(), 0.0);
        let mut pair = |normal: Vec3| {
            walls.push(Wall {
                normal,
                point: Vec3::zeros(),
            });
            walls.push(Wall {
                normal: -normal,
                point: far,
            });
        };
        pair(Vec3::x());
        if scene.dimensions == Dimensions::Three {
            pair(Vec3::y());
        }
    }
    walls
}

fn interaction(scene: &Sedimentation) -> Interaction {
    let extremes = scene.extremes();
    let uniform = extremes.len() == 1 && scene.container.floor == Floor::Flat;
    let period = match scene.container.sides {
        Sides::Walls => [0.0; 3],
        Sides::Periodic if scene.dimensions == Dimensions::Two => [scene.container.width, 0.0, 0.0],
        Sides::Periodic => [scene.container.width, scene.container.depth, 0.0],
    };
    Interaction {
        laws: ContactLaws {
            normal: scene.normal.law(),
            tangential: scene.tangential,
            rolling: scene.rolling,
        },
        attraction: attraction(scene),
        couple: uniform.then(|| Couple::new(&extremes[0].0, &extremes[0].0)),
        period,
        time_step: limits(scene).time_step,
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
    let extremes = scene.extremes();
    let (_, density) = extremes.first()?;
    let mixed = extremes.iter().any(|(_, other)| other != density) && scene.drag != GrainDrag::None;
    let alone = match scene.drag {
        GrainDrag::None => true,
        GrainDrag::Beetstra | GrainDrag::BeetstraCello => false,
        _ => scene.voidage == Voidage::None,
    };
    if !(closed || mixed) && alone {
        return None;
    }
    let viscosity = scene.fluid.medium().viscosity;
    let relaxation = extremes
        .iter()
        .map(|(body, _)| body.mass / (6.0 * PI * viscosity * body.radius))
        .fold(f64::INFINITY, f64::min);
    let (measure, area) = match scene.porosity {
        SlicePorosity::Exact => (Measure::Exact, scene.container.width * scene.depth()),
        SlicePorosity::Centre => (Measure::Centre, scene.container.width * scene.depth()),
        SlicePorosity::Areas => (Measure::Areas, scene.container.width),
    };
    Some(Porosity::new(
        scene.largest_diameter(),
        area,
        measure,
        closed,
        mixed,
        relaxation,
    ))
}
