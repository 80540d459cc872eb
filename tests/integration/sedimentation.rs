//! The sedimentation scene from a study file to the plain data that runs.

use std::path::Path;

use kynch::runner::{Options, survey};
use kynch::store::Store;
use kynch::study::model::{AxisValue, Study, Work};
use kynch::study::{self};
use kynch_sim::scene::{
    Arrangement, Charge, Cohesion, Detection, Dimensions, Floor, FloorGrains, GrainDrag, IntegratorChoice,
    Lift, Scene, Sedimentation, Sides, SlicePorosity, StillFluid, Until, Voidage,
};

const SHORT: &str = "
question: Does a bed form?
scene:
  sedimentation:
    grains: {diameter: 250 um, density: 2460, number: 1000}
    container: {width: 2.5 mm, depth: 2.5 mm, height: 10 mm}
    normal: {hertz_viscoelastic: {young_modulus: 1 MPa, poisson_ratio: 0.29, damping_time: 20 us}}
    fluid: {still: {density: 1000, viscosity: 1 mPa s}}
    duration: 1 s
";

const WRITTEN_OUT: &str = "
question: Does a bed form?
scene:
  sedimentation:
    dimensions: 3
    classes: [{diameter: 250 um, density: 2460, number: 1000}]
    container: {width: 2.5 mm, depth: 2.5 mm, height: 10 mm, sides: walls, floor: flat}
    arrangement: random
    normal: {hertz_viscoelastic: {young_modulus: 1 MPa, poisson_ratio: 0.29, damping_time: 20 us}}
    tangential: none
    rolling: none
    cohesion: none
    charge: none
    drag: schiller_naumann
    voidage: di_felice
    porosity: exact
    lift: none
    fluid: {still: {density: 1000, viscosity: 1 mPa s}}
    gravity: 9.81
    duration: 1 s
    until: duration
    integrator: velocity_verlet
    detection: list
    sleeping: off
    central_slice: 0.8
    steps_per_contact: 20
    time_step: automatic
    unsafe_time_step: false
    threads: 1
    snapshots: 11
";

pub const OTHER: &str = "
question: Does a bed form?
scene:
  sedimentation:
    dimensions: 2
    classes:
      - {diameter: 250 um, density: 4200, number: 100}
      - {diameter: 100 um, largest_diameter: 0.3 mm, density: 2500, number: 20}
    container: {width: 12.5 mm, height: 17.5 mm, sides: periodic, floor: {grains: {diameter: 300 um}}}
    arrangement: {packed: {solids_fraction: 50 %}}
    normal: {linear_spring_dashpot: {stiffness: 13 N/m, restitution: 0.3}}
    tangential: {haff_werner: {damping: 10, friction: 0.3}}
    cohesion: {van_der_waals: {hamaker: 65 zJ, walls: false}}
    charge: {coulomb: {charge: -2 fC, relative_permittivity: 78.4}}
    drag: none
    voidage: none
    porosity: areas
    lift: magnus
    fluid: {column: {density: 1000, viscosity: 1 cP}}
    duration: 100 ms
    until: settled
    integrator: gear_5
    detection: {list: {skin: 10 %}}
    sleeping: on
    time_step: 100 ns
    threads: 4
    snapshots: 0
";

pub const VARIED: &str = "
question: Does a bed form?
scene:
  sedimentation:
    grains: {diameter: 250 um, density: 2460, number: 1000}
    container: {width: 2.5 mm, depth: 2.5 mm, height: 10 mm}
    normal: {hertz_viscoelastic: {young_modulus: 1 MPa, poisson_ratio: 0.29, damping_time: 20 us}}
    cohesion: {van_der_waals: {hamaker: 6.5e-20 J}}
    fluid: {still: {density: 1000, viscosity: 1 mPa s}}
    detection: list
    duration: 1 s
vary:
  number: {path: scene.grains.number, values: [500, 1000]}
  density: {path: scene.fluid.still.density, values: [500, 1500 kg/m3]}
  hamaker: {path: scene.cohesion.van_der_waals.hamaker, values: [5.7e-21 J, 65 zJ]}
  skin: {path: scene.detection.list.skin, values: [0.2]}
  drag: {path: scene.drag, values: [stokes, schiller_naumann]}
seeds: [7, 8]
";

fn parsed(text: &str) -> Study {
    study::parse(Path::new("bed.yaml"), text).unwrap_or_else(|error| panic!("{error}"))
}

fn scene(work: &Work) -> &Sedimentation {
    match work {
        Work::Simulation(Scene::Sedimentation(scene)) => scene,
        _ => panic!("a sedimentation"),
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
    let study = parsed(OTHER);
    let bed = scene(&study.plan.points[0].work);
    assert_eq!(bed.dimensions, Dimensions::Two);
    assert_eq!(bed.classes.len(), 2);
    assert_eq!(bed.classes[1].largest_diameter, Some(3e-4));
    assert_eq!(bed.container.sides, Sides::Periodic);
    let side_by_side = FloorGrains {
        diameter: 3e-4,
        gap: 0.0,
        layers: 1,
    };
    assert_eq!(bed.container.floor, Floor::Grains(side_by_side));
    // Deep enough for the largest grain where no depth is given.
    assert_eq!(bed.container.depth, 3e-4);
    assert_eq!(bed.arrangement, Arrangement::Packed { solids_fraction: 0.5 });
    let cohesion = Cohesion {
        hamaker: 6.5e-20,
        smallest_gap: 1e-9,
        cut_off: 1e-3,
        walls: false,
    };
    let charge = Charge {
        charge: -2e-15,
        relative_permittivity: 78.4,
        cut_off: 1e-3,
    };
    assert_eq!((bed.cohesion, bed.charge), (Some(cohesion), Some(charge)));
    assert_eq!((bed.drag, bed.voidage), (GrainDrag::None, Voidage::None));
    assert_eq!((bed.porosity, bed.lift), (SlicePorosity::Areas, Lift::Magnus));
    assert!(matches!(bed.fluid, StillFluid::Column(medium) if medium.viscosity == 1e-3));
    assert_eq!(bed.until, Until::Settled);
    assert_eq!(bed.integrator, IntegratorChoice::Gear5);
    assert_eq!(bed.detection, Detection::List { skin: Some(0.1) });
    assert!(bed.sleeping);
    assert_eq!(bed.time_step, Some(1e-7));
    assert_eq!((bed.threads, bed.snapshots), (4, 0));
    assert_eq!(study.plan.points[0].work.threads(), 4);
}

#[test]
fn axes_reach_every_field_and_seeds_reach_the_scene() {
    let study = parsed(VARIED);
    assert_eq!(study.plan.points.len(), 2 * 2 * 2 * 2 * 2);
    for point in &study.plan.points {
        let bed = scene(&point.work);
        let axis = |name: &str| match point.parameter(name) {
            Some(AxisValue::Number(number)) => number,
            other => panic!("{name}: {other:?}"),
        };
        assert_eq!(f64::from(bed.classes[0].number), axis("number"));
        assert!(matches!(bed.fluid, StillFluid::Still(medium) if medium.density == axis("density")));
        assert_eq!(bed.cohesion.map(|law| law.hamaker), Some(axis("hamaker")));
        assert_eq!(bed.detection, Detection::List { skin: Some(0.2) });
        let stokes = point.parameter("drag") == Some(AxisValue::Word("stokes".into()));
        assert_eq!(bed.drag == GrainDrag::Stokes, stokes);
        assert_eq!(bed.seed, point.seed);
    }
}

#[test]
fn more_seeds_are_other_scenes() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = Store::open(folder.path()).expect("a store");
    let options = Options {
        seeds: Some(3),
        ..Options::default()
    };
    let planned = survey(&parsed(SHORT), &store, &options).expect("a plan");
    let seeds: Vec<u64> = planned
        .iter()
        .map(|planned| scene(&planned.point.work).seed)
        .collect();
    assert_eq!(seeds, [1, 2, 3]);
    let mut ids: Vec<_> = planned.iter().map(|planned| &planned.id.0).collect();
    ids.dedup();
    assert_eq!(ids.len(), 3);
}

#[test]
fn a_word_for_a_choice_with_fields_means_its_defaults() {
    let with = |detection: &str| {
        let text = SHORT.replace(
            "duration: 1 s",
            &format!("duration: 1 s\n    detection: {detection}"),
        );
        let study = parsed(&text);
        (
            scene(&study.plan.points[0].work).clone(),
            study.plan.points[0].settings.clone(),
        )
    };
    let word = with("list");
    assert_eq!(word, with("{list: {}}"));
    assert_eq!(word, with("{list: {skin: automatic}}"));
    assert_ne!(word.1, with("cells").1);
}

#[test]
fn names_that_are_numbers_and_series_serve_both() {
    let statements = "
expect:
  - value: {of: thickness, above: 1 mm}
figures:
  - time_series: {of: [thickness, porosity]}
  - profile: {of: porosity_profile}
";
    let study = parsed(&format!("{SHORT}{statements}"));
    assert_eq!((study.expect.len(), study.figures.len()), (1, 2));
    let error = study::parse(
        Path::new("bed.yaml"),
        &format!("{SHORT}expect:\n  - value: {{of: mean_speed, above: 0}}\n"),
    )
    .expect_err("a series");
    assert_eq!(
        error.problems[0].message,
        "`mean_speed` is a series, this needs a scalar"
    );
}

/// A bed of two dozen grains that comes to rest.
const SMALL: &str = "
question: Does a bed form?
scene:
  sedimentation:
    grains: {diameter: 250 um, density: 2460, number: 24}
    container: {width: 1 mm, depth: 1 mm, height: 2 mm}
    normal: {hertz_viscoelastic: {young_modulus: 1 MPa, poisson_ratio: 0.29, damping_time: 20 us}}
    fluid: {still: {density: 1000, viscosity: 1 mPa s}}
    tangential: {mindlin: {friction: 0.3, poisson_ratio: 0.29}}
    arrangement: random
    duration: 1 s
    snapshots: 2
";

fn computed(study: &Study, store: &Store) -> kynch::store::model::Run {
    let summary = kynch::runner::run(study, store, &Options::default()).expect("a run");
    assert_eq!(summary.completed, 1, "{summary:?}");
    let id = kynch::runner::identify(&study.plan.points[0]);
    store.load(&[id]).expect("a stored run").remove(0)
}

#[test]
fn a_bed_goes_on_where_its_stored_snapshot_left_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = Store::open(&folder.path().join("store")).expect("a store");
    let first = parsed(SMALL);
    let before = computed(&first, &store);
    let stored = |inside: &str| {
        let entries = std::fs::read_dir(folder.path().join("store").join(inside)).expect("tables");
        let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
        paths.retain(|path| inside == "series" || path.to_string_lossy().contains("snapshots"));
        paths
    };
    let bed = folder.path().join("bed.parquet");
    let put = |table: &Path| std::fs::copy(table, &bed).expect("a copy");
    let kept = stored("profiles").remove(0);
    put(&kept);

    let study_file = folder.path().join("again.yaml");
    let text = SMALL
        .replace("random", "{snapshot: {file: bed.parquet}}")
        .replace("duration: 1 s", "duration: 20 ms");
    let again = |text: &str| study::parse(&study_file, text);
    let second = again(&text).unwrap_or_else(|error| panic!("{error}"));
    let after = computed(&second, &store);
    let of = |run: &kynch::store::model::Run, name: &str| {
        let mut scalars = run.scalars.iter();
        scalars
            .find(|scalar| scalar.name == name)
            .unwrap_or_else(|| panic!("no {name}"))
            .value
    };
    assert_eq!(of(&before, "settled_share"), 1.0);
    assert_eq!(of(&after, "settled_share"), 1.0);
    assert!(of(&before, "settling_time") > 0.02);
    assert!(
        of(&after, "settling_time") < 2e-3,
        "{}",
        of(&after, "settling_time")
    );
    let way = of(&after, "centre_of_mass") - of(&before, "centre_of_mass");
    assert!(way.abs() < 1e-3 * 250e-6, "{way:e}");

    let messages = |text: &str| -> Vec<String> {
        let error = again(text).expect_err("a faulty study");
        let problems = error.problems.iter();
        problems
            .map(|problem| format!("{}: {}", problem.field, problem.message))
            .collect()
    };
    const AT: &str = "scene.sedimentation.arrangement.snapshot.file";
    assert_eq!(
        messages(&text.replace("number: 24", "number: 25")),
        [format!(
            "{AT}: the snapshot has 24 grains of class 0, the scene 25"
        )]
    );
    assert_eq!(
        messages(&text.replace("bed.parquet", "no.parquet")),
        [format!("{AT}: there is no file `no.parquet`")]
    );
    // Another table in the same place is another point.
    let id = |study: &Study| kynch::runner::identify(&study.plan.points[0]);
    let known = id(&second);
    assert_eq!(id(&again(&text).expect("the same study")), known);
    let mut newer = stored("profiles");
    newer.retain(|path| *path != kept);
    put(&newer[0]);
    assert_ne!(id(&again(&text).expect("a study")), known);
    // Other tables and other files hold no grains.
    put(&stored("series")[0]);
    assert_eq!(
        messages(&text),
        [format!("{AT}: `bed.parquet` has no column `class`")]
    );
    std::fs::write(&bed, "no table").expect("a file");
    let wrong = messages(&text);
    assert!(
        wrong[0].starts_with(&format!("{AT}: `bed.parquet` is no Parquet table: ")),
        "{wrong:?}"
    );
}
