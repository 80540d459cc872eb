//! The filtration scene from a study file to the plain data that runs.

use std::path::Path;

use kynch::study::model::{Study, Work};
use kynch::study::{self};
use kynch_sim::scene::{
    CakeLength, CakePermeability, Crossflow, Deposited, Dimensions, Feed, Filtration, Floor, FloorGrains,
    Held, Resistance, Scene, Sides, StillFluid,
};

const SHORT: &str = "
question: Does a cake form?
scene:
  filtration:
    grains: {diameter: 150 um, density: 2460, number: 1000}
    container: {width: 1.5 mm, depth: 1.5 mm, height: 6 mm, floor: {grains: {diameter: 150 um}}}
    feed: {rate: {rate: 1250}}
    filtrate: {held: pressure, pressure_drop: 2 kPa, initial_flux: 10 mm/s}
    normal: {hertz_viscoelastic: {young_modulus: 1 MPa, poisson_ratio: 0.29, damping_time: 20 us}}
    fluid: {uniform: {density: 1000, viscosity: 1 mPa s}}
    duration: 1 s
";

const WRITTEN_OUT: &str = "
question: Does a cake form?
scene:
  filtration:
    dimensions: 3
    classes: [{diameter: 150 um, density: 2460, number: 1000}]
    container:
      width: 1.5 mm
      depth: 1.5 mm
      height: 6 mm
      sides: walls
      floor: {grains: {diameter: 150 um, gap: 0 um, layers: 1}}
    feed: {rate: {rate: 1.25 kHz, layers: 5}}
    filtrate:
      held: pressure
      pressure_drop: 2 kPa
      initial_flux: 10 mm/s
      resistance: series
      length: thickness
      permeability: mean
    deposited: slow
    normal: {hertz_viscoelastic: {young_modulus: 1 MPa, poisson_ratio: 0.29, damping_time: 20 us}}
    drag: schiller_naumann
    voidage: di_felice
    fluid: {uniform: {density: 1000, viscosity: 1 mPa s, flow: consistent}}
    duration: 1 s
    snapshots: 11
";

pub const ACROSS: &str = "
question: Does a cake form?
scene:
  filtration:
    dimensions: 3
    grains: {diameter: 500 um, density: 2460, number: 100}
    container:
      width: 12.5 mm
      depth: 5 mm
      height: 5 mm
      sides: periodic_along_x
      floor: {grains: {diameter: 600 um, gap: 10 um, layers: 2}}
    feed: {suspension: {solids_fraction: 2 %, settling: on, layers: 3}}
    filtrate: {held: flux, initial_flux: 10 mm/s, medium_resistance: 2e8 1/m, resistance: darcy_capped, length: cell_height, permeability: layered}
    deposited: carried
    normal: {linear_spring_dashpot: {stiffness: 13 N/m, restitution: 0.3}}
    fluid: {parabolic: {density: 1000, viscosity: 1 cP, flow: literal, mean_velocity: 10 mm/s, shear_lift: on}}
    duration: 100 ms
vary:
  velocity: {path: scene.fluid.parabolic.mean_velocity, values: [0.1 mm/s, 100 mm/s]}
  flux: {path: scene.filtrate.initial_flux, values: [1 mm/s, 10 mm/s]}
seeds: [7]
";

fn parsed(text: &str) -> Study {
    study::parse(Path::new("cake.yaml"), text).unwrap_or_else(|error| panic!("{error}"))
}

fn scene(work: &Work) -> &Filtration {
    match work {
        Work::Simulation(Scene::Filtration(scene)) => scene,
        _ => panic!("a filtration"),
    }
}

#[test]
fn what_is_left_out_is_what_stands_there_by_default() {
    let (short, long) = (parsed(SHORT), parsed(WRITTEN_OUT));
    let of = |study: &Study| scene(&study.plan.points[0].work).clone();
    assert_eq!(of(&short), of(&long));
}

#[test]
fn every_choice_arrives_in_si_units() {
    let study = parsed(ACROSS);
    assert_eq!(study.plan.points.len(), 4);
    let cake = scene(&study.plan.points[1].work);
    assert_eq!(cake.bed.dimensions, Dimensions::Three);
    assert_eq!(cake.bed.container.sides, Sides::PeriodicAlongX);
    let net = FloorGrains {
        diameter: 600e-6,
        gap: 10e-6,
        layers: 2,
    };
    assert_eq!(cake.bed.container.floor, Floor::Grains(net));
    assert!(matches!(cake.bed.fluid, StillFluid::Still(medium) if medium.viscosity == 1e-3));
    let fed = Feed::Suspension {
        solids_fraction: 0.02,
        settling: true,
        layers: 3.0,
    };
    assert_eq!(cake.feed, fed);
    let across = Crossflow {
        mean_velocity: 1e-4,
        shear_lift: true,
    };
    assert_eq!(cake.crossflow, Some(across));
    let filtrate = &cake.filtrate;
    assert_eq!(
        (filtrate.held, filtrate.resistance),
        (Held::Flux, Resistance::DarcyCapped)
    );
    assert_eq!(
        (filtrate.length, filtrate.permeability),
        (CakeLength::CellHeight, CakePermeability::Layered)
    );
    assert_eq!(
        (filtrate.initial_flux, filtrate.pressure_drop),
        (Some(0.01), None)
    );
    assert_eq!(filtrate.medium_resistance, Some(2e8));
    assert_eq!(cake.deposited, Deposited::Carried);
}

#[test]
fn a_point_has_its_own_seed() {
    let study = parsed(ACROSS);
    let seeded = study.plan.points[0].work.seeded(study.plan.points[0].seed);
    assert_eq!(scene(&seeded).bed.seed, 7);
}

#[test]
fn the_two_ways_to_write_one_setting_are_one_point() {
    let settings = |text: &str| parsed(text).plan.points[0].settings.to_string();
    let other = SHORT
        .replace("2 kPa", "2000")
        .replace("150 um", "0.15 mm")
        .replace("1250", "1250 1/s");
    assert_eq!(settings(SHORT), settings(&other));
}
