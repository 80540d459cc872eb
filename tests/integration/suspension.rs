//! The suspension scene from a study file to the plain data that runs, to the store and back.

use std::path::Path;

use kynch::judge::model::Outcome;
use kynch::runner::Options;
use kynch::store::Store;
use kynch::study::model::{AxisValue, Point, Study, Work};
use kynch::study::{self};
use kynch_sim::scene::{
    Drag, Homogeneity, Scene, Scheme, SharpeningChoice, SuspendedClass, SuspendingFluid, Suspension,
};

const SHORT: &str = "
question: How fast does the interface fall?
scene:
  suspension:
    grains: {diameter: 100 um, density: 2500}
    porosity: 0.9
    column: {width: 2 mm, height: 2 mm}
    drag: di_felice
    fluid: {sph: {density: 1000, viscosity: 0.89 mPa s, spacing_over_diameter: 2}}
    duration: 1 s
";

const WRITTEN_OUT: &str = "
question: How fast does the interface fall?
scene:
  suspension:
    classes: [{diameter: 100 um, density: 2500, share: 1}]
    porosity: 90 %
    column: {width: 2 mm, height: 2 mm}
    arrangement: even
    drag: di_felice
    fluid: {sph: {density: 1000, viscosity: 0.89 mPa s, spacing_over_diameter: 2, scheme: {sharpening: none}}}
    contact: {stiffness: automatic, restitution: 0.9, friction: none}
    duration: 1 s
    gravity: 9.81
    steps_per_contact: 20
    time_step: automatic
    unsafe_time_step: false
    threads: 1
    snapshots: 11
";

pub const OTHER: &str = "
question: How do two kinds of grains part?
scene:
  suspension:
    classes:
      - {diameter: 150 um, density: 2450, share: 40 %}
      - {diameter: 0.1 mm, density: 1500, share: 0.6}
    porosity: 0.85
    column: {width: 2 mm, height: 3 mm}
    arrangement: random
    drag: beetstra_cello
    fluid: {sph: {density: 1000, viscosity: 1 cP, spacing_over_diameter: 2, scheme: {sharpening: conservative}}}
    contact: {stiffness: 12 N/m, restitution: 0.5, friction: 0.3}
    top_grains: 7
    duration: 100 ms
    time_step: 100 ns
    threads: 4
    snapshots: 0
";

pub const VARIED: &str = "
question: How fast does the interface fall?
scene:
  suspension:
    grains: {diameter: 250 um, density: 2500}
    porosity: 0.9
    column: {width: 0.8 mm, height: 3 mm}
    drag: di_felice
    fluid: {column: {density: 1000, viscosity: 1 mPa s}}
    contact: {friction: none}
    duration: 300 ms
    snapshots: 2
vary:
  porosity: {path: scene.porosity, values: [0.7, 90 %]}
  drag: {path: scene.drag, values: [di_felice, beetstra]}
  friction: {path: scene.contact.friction, values: [none, 0.3]}
seeds: [7, 8]
";

fn parsed(text: &str) -> Study {
    study::parse(Path::new("suspension.yaml"), text).unwrap_or_else(|error| panic!("{error}"))
}

fn scene(point: &Point) -> &Suspension {
    match &point.work {
        Work::Simulation(Scene::Suspension(scene)) => scene,
        _ => panic!("a suspension"),
    }
}

fn scheme(scene: &Suspension) -> &Scheme {
    match &scene.fluid {
        SuspendingFluid::Sph(fluid) => &fluid.scheme,
        SuspendingFluid::Column(_) => panic!("a fluid of particles"),
    }
}

#[test]
fn what_is_left_out_is_what_stands_there_by_default() {
    let (short, long) = (parsed(SHORT), parsed(WRITTEN_OUT));
    assert_eq!(scene(&short.plan.points[0]), scene(&long.plan.points[0]));
    assert_eq!(scheme(scene(&short.plan.points[0])), &Scheme::for_random_grains());
}

#[test]
fn an_automatic_sharpening_is_the_same_point_as_the_one_that_suits_the_scene() {
    let id = |scheme: &str| {
        let with = format!("spacing_over_diameter: 2, scheme: {{sharpening: {scheme}}}");
        let study = parsed(&SHORT.replace("spacing_over_diameter: 2", &with));
        kynch::runner::identify(&study.plan.points[0])
    };
    assert_eq!(id("automatic"), id("none"));
    assert_ne!(id("automatic"), id("conservative"));
    assert_eq!(
        id("automatic"),
        kynch::runner::identify(&parsed(SHORT).plan.points[0])
    );
}

#[test]
fn every_choice_arrives_in_si_units() {
    let study = parsed(OTHER);
    let suspension = scene(&study.plan.points[0]);
    let class = |diameter, density, share| SuspendedClass {
        diameter,
        density,
        share,
    };
    assert_eq!(
        suspension.classes,
        [class(1.5e-4, 2450.0, 0.4), class(1e-4, 1500.0, 0.6)]
    );
    assert_eq!(suspension.arrangement, Homogeneity::Random);
    assert_eq!(suspension.drag, Drag::BeetstraCello);
    assert_eq!(scheme(suspension).sharpening, SharpeningChoice::Conservative);
    assert_eq!(suspension.contact.stiffness, Some(12.0));
    assert_eq!(
        (suspension.contact.restitution, suspension.contact.friction),
        (0.5, Some(0.3))
    );
    assert_eq!(
        (suspension.top_grains, suspension.time_step),
        (Some(7), Some(1e-7))
    );
    assert_eq!((suspension.threads, suspension.snapshots), (4, 0));
    assert_eq!(study.plan.points[0].work.threads(), 4);
}

#[test]
fn axes_reach_every_field_and_seeds_reach_the_scene() {
    let study = parsed(VARIED);
    assert_eq!(study.plan.points.len(), 2 * 2 * 2 * 2);
    for point in &study.plan.points {
        let suspension = scene(point);
        let porosity = AxisValue::Number(suspension.porosity);
        assert_eq!(point.parameter("porosity"), Some(porosity));
        let beetstra = point.parameter("drag") == Some(AxisValue::Word("beetstra".into()));
        assert_eq!(suspension.drag == Drag::Beetstra, beetstra);
        let smooth = point.parameter("friction") == Some(AxisValue::Word("none".into()));
        assert_eq!(suspension.contact.friction.is_none(), smooth);
        assert_eq!(suspension.seed, point.seed);
    }
}

#[test]
fn a_settled_suspension_comes_back_from_the_store_and_meets_its_references() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = Store::open(folder.path()).expect("a store");
    let text = VARIED
        .replace("[0.7, 90 %]", "[0.7]")
        .replace("[di_felice, beetstra]", "[di_felice]")
        .replace("[none, 0.3]", "[none]")
        .replace("[7, 8]", "[7]");
    let statements = "
observe: [deposit_fraction, solids_fraction, settled_share, bed_thickness, interface_height, bed_front, porosity_map]
expect:
  - error: {of: bed_thickness, against: kynch_meeting_height, below: 15 %}
figures:
  - time_series: {of: interface_height, against: kynch_interface}
  - time_series: {of: bed_front, against: kynch_bed_height}
";
    let study = parsed(&format!("{text}{statements}"));
    let summary = kynch::runner::run(&study, &store, &Options::default()).expect("a run");
    assert_eq!(summary.completed, 1, "{summary:?}");
    let id = kynch::runner::identify(&study.plan.points[0]);
    let run = store.load(&[id]).expect("a stored run").remove(0);
    let of = |name: &str| {
        let found = run.scalars.iter().find(|scalar| scalar.name == name);
        found.unwrap_or_else(|| panic!("no {name}")).value
    };
    assert!(of("settled_share") > 0.8);
    assert!((of("solids_fraction") - 0.3).abs() < 2e-3);
    // Solids are kept: the settled bed is as high as its fraction says, to the loose layers at its ends.
    let height = 3e-3 * of("solids_fraction") / of("deposit_fraction");
    assert!((of("bed_thickness") / height - 1.0).abs() < 0.15, "{height}");
    let judged = kynch::judge::judge(&study, &[run]);
    assert_eq!(judged.len(), 1);
    assert_eq!(judged[0].verdict, Outcome::Holds, "{judged:?}");
}
