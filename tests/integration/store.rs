//! Round trips, damage, and places that cannot be written.

use std::path::Path;

use kynch::runner::{Options, RunError, run as run_study};
use kynch::store::model::{Column, PointId, Provenance, Run, Scalar, Status, Table, Timing};
use kynch::store::{Store, StoreError};
use kynch::study::model::AxisValue;

use crate::rehearsals::{rehearsal, results, scales, study};

fn scalar(name: &str, unit: &str, value: f64) -> Scalar {
    Scalar {
        name: name.into(),
        unit: unit.into(),
        value,
    }
}

/// A run with everything that is hard to keep.
fn awkward(id: &str) -> Run {
    let column = |name: &str, unit: &str, values: &[f64]| Column {
        name: name.into(),
        unit: unit.into(),
        values: values.to_vec(),
    };
    Run {
        id: PointId(id.into()),
        study: "étude".into(),
        scene: "block".into(),
        axes: vec![
            ("z".into(), AxisValue::Number(1.0 / 3.0)),
            ("a".into(), AxisValue::Word("di_felice".into())),
            ("m".into(), AxisValue::Flag(true)),
            ("infinite".into(), AxisValue::Number(f64::INFINITY)),
        ],
        seed: u64::MAX,
        settings: serde_json::json!({"block": {"width": 4.1e-3, "layers": 3, "drag": "stokes", "list": [1, 2.5],
            "none": null, "fluid": {"sph": {"viscosity": 8.9e-4}}}}),
        status: Status::Diverged,
        reason: Some("grain 3: \"NaN\"\nat t = 0".into()),
        scalars: vec![
            scalar("speed", "m/s", f64::MIN_POSITIVE / 3.0),
            scalar("seed", "1", -0.0),
            scalar("id", "m", f64::NEG_INFINITY),
            scalar("wall", "m", 3.0),
        ],
        counters: vec![("steps".into(), u64::MAX), ("a_counter".into(), 0)],
        tables: vec![
            Table {
                name: "time_series".into(),
                columns: vec![
                    column("time", "s", &[0.0, 0.1, 0.2]),
                    column("v", "m/s", &[-0.0, 5e-324, f64::MAX]),
                ],
            },
            Table {
                name: "porosity_profile".into(),
                columns: vec![column("height", "m", &[]), column("x", "1", &[])],
            },
            Table {
                name: "empty".into(),
                columns: Vec::new(),
            },
        ],
        derived: Vec::new(),
        timing: Timing {
            wall: 1.25,
            cpu: 1.125,
            peak_memory: 1 << 40,
            split: vec![("fluid".into(), 0.75), ("grains".into(), 0.25)],
            provenance: Provenance {
                dirty: true,
                cpu: "a processor".into(),
                ..Provenance::current()
            },
        },
    }
}

/// The same quantity in other units, other settings, no tables.
fn plain(id: &str) -> Run {
    Run {
        study: "a".into(),
        settings: serde_json::json!({"block": {"width": "wide", "layers": 2.5}}),
        axes: vec![("z".into(), AxisValue::Word("none".into()))],
        status: Status::Completed,
        reason: None,
        scalars: vec![
            scalar("speed", "mm/s", 1.0),
            scalar("only here", "1", f64::INFINITY),
        ],
        tables: Vec::new(),
        ..awkward(id)
    }
}

#[test]
fn runs_come_back_bit_for_bit_before_and_after_compaction_and_reopening() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let (one, other) = (awkward("one"), plain("other"));
    let ids = [
        PointId("other".into()),
        PointId("absent".into()),
        PointId("one".into()),
    ];
    store.append(&one).unwrap();
    store.append(&other).unwrap();
    assert_eq!(store.load(&ids).unwrap(), [other.clone(), one.clone()]);
    store.compact().unwrap();
    assert_eq!(store.load(&ids).unwrap(), [other.clone(), one.clone()]);
    drop(store);
    let store = Store::open(dir.path()).unwrap();
    assert_eq!(store.load(&ids).unwrap(), [other, one]);
    assert_eq!(
        store.finished().unwrap()[&PointId("one".into())],
        Status::Diverged
    );
    assert_eq!(store.verify().unwrap(), []);
}

#[test]
fn two_things_of_one_name_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let mut run = awkward("twice");
    run.scalars.push(scalar("speed", "m/s", 1.0));
    let error = store.append(&run).unwrap_err();
    assert!(error.to_string().contains("`speed`"), "{error}");
    assert!(store.finished().unwrap().is_empty());
    let escaping = Run {
        id: PointId("../out".into()),
        ..plain("x")
    };
    assert!(matches!(store.append(&escaping), Err(StoreError::Invalid { .. })));
}

#[test]
fn a_flipped_bit_anywhere_is_found_and_named() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let mut with_profile = awkward("one");
    with_profile.tables[1].columns[0].values = vec![1.0];
    with_profile.tables[1].columns[1].values = vec![2.0];
    store.append(&with_profile).unwrap();
    store.compact().unwrap();
    store.append(&plain("other")).unwrap();
    drop(store);
    let files = results(dir.path());
    let folders: Vec<&str> = files.keys().map(|name| name.split('/').next().unwrap()).collect();
    for expected in ["runs.parquet", "columns.parquet", "series", "profiles", "pending"] {
        assert!(folders.contains(&expected), "{folders:?}");
    }
    for (name, bytes) in &files {
        for position in (0..16).map(|part| part * (bytes.len() - 1) / 15) {
            let mut altered = bytes.clone();
            altered[position] ^= 1 << (position % 8);
            std::fs::write(dir.path().join(name), &altered).unwrap();
            let found = Store::inspect(dir.path()).unwrap();
            assert_eq!(found.len(), 1, "{name} at byte {position}: {found:?}");
            assert_eq!(&found[0].file, name);
        }
        std::fs::remove_file(dir.path().join(name)).unwrap();
        let found = Store::inspect(dir.path()).unwrap();
        assert!(
            found[0].problem.contains("missing") && &found[0].file == name,
            "{found:?}"
        );
        std::fs::write(dir.path().join(name), bytes).unwrap();
    }
    assert_eq!(Store::inspect(dir.path()).unwrap(), []);
}

#[test]
fn damaged_files_are_never_read() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    store.append(&awkward("one")).unwrap();
    store.compact().unwrap();
    let series = results(dir.path())
        .into_keys()
        .find(|name| name.starts_with("series/"))
        .unwrap();
    flip(&dir.path().join(&series));
    let error = store.load(&[PointId("one".into())]).unwrap_err();
    assert!(
        matches!(&error, StoreError::Damaged { file, .. } if *file == series),
        "{error}"
    );
    assert!(error.to_string().contains("--fresh"), "{error}");
    // Done again, the run is whole again.
    store.append(&awkward("one")).unwrap();
    assert_eq!(store.load(&[PointId("one".into())]).unwrap(), [awkward("one")]);
    store.compact().unwrap();
    drop(store);
    flip(&dir.path().join("runs.parquet"));
    let error = Store::open(dir.path()).unwrap_err();
    assert!(
        matches!(&error, StoreError::Damaged { file, .. } if file == "runs.parquet"),
        "{error}"
    );
}

fn flip(path: &Path) {
    let mut bytes = std::fs::read(path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    std::fs::write(path, bytes).unwrap();
}

#[test]
fn leftovers_are_reported_then_cleared_by_opening() {
    let dir = tempfile::tempdir().unwrap();
    drop(Store::open(dir.path()).unwrap());
    for name in [
        ".tmp-4711-0",
        "series/gone-0123456789abcdef.parquet",
        "pending/torn-0123456789abcdef.parquet",
    ] {
        std::fs::write(dir.path().join(name), b"PAR1 half a file").unwrap();
    }
    let found: Vec<String> = Store::inspect(dir.path())
        .unwrap()
        .into_iter()
        .map(|found| found.problem)
        .collect();
    assert!(
        found.len() == 3 && found[0].starts_with("torn") && found[1].starts_with("orphan"),
        "{found:?}"
    );
    let store = Store::open(dir.path()).unwrap();
    assert_eq!(store.verify().unwrap(), []);
}

#[test]
fn a_finished_run_outside_the_manifest_is_taken_in() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let before = std::fs::read(dir.path().join("manifest.blake3")).ok();
    store.append(&awkward("one")).unwrap();
    drop(store);
    // As if the process had died between the rename of the row and that of the manifest.
    match before {
        Some(bytes) => std::fs::write(dir.path().join("manifest.blake3"), bytes).unwrap(),
        None => std::fs::remove_file(dir.path().join("manifest.blake3")).unwrap(),
    }
    assert_eq!(Store::inspect(dir.path()).unwrap().len(), 3);
    let store = Store::open(dir.path()).unwrap();
    assert_eq!(store.load(&[PointId("one".into())]).unwrap(), [awkward("one")]);
    assert_eq!(store.verify().unwrap(), []);
}

#[test]
fn an_unwritable_place_is_named() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("file");
    std::fs::write(&file, b"").unwrap();
    for place in [file.clone(), file.join("store")] {
        let error = Store::open(&place).unwrap_err();
        assert!(matches!(error, StoreError::NotWritable { .. }), "{error}");
        assert!(error.to_string().contains("--store"), "{error}");
    }
}

#[test]
fn a_full_disk_ends_the_run_and_keeps_what_there_was() {
    let dir = tempfile::tempdir().unwrap();
    let Some(_mounted) = SmallDisk::mount(dir.path()) else {
        eprintln!("skipped: mounting a small disk needs more rights");
        return;
    };
    let store = Store::open(&dir.path().join("store")).unwrap();
    let first = study(scales(2));
    run_study(&first, &store, &Options::default()).unwrap();
    let ballast = dir.path().join("ballast");
    let _ = std::fs::write(&ballast, vec![1; 1 << 20]);
    let second = study(vec![kynch::study::model::Rehearsal {
        samples: 3000,
        ..rehearsal(7.0)
    }]);
    let error = run_study(&second, &store, &Options::default()).unwrap_err();
    assert!(
        matches!(error, RunError::Store(StoreError::Full { .. })),
        "{error}"
    );
    assert_eq!(store.verify().unwrap(), []);
    std::fs::remove_file(&ballast).unwrap();
    let summary = run_study(&second, &store, &Options::default()).unwrap();
    assert_eq!(summary.completed, 1);
    assert_eq!(store.finished().unwrap().len(), 3);
    assert_eq!(store.verify().unwrap(), []);
}

/// A disk in memory of 512 KiB.
struct SmallDisk<'a>(&'a Path);

impl SmallDisk<'_> {
    fn mount(place: &Path) -> Option<SmallDisk<'_>> {
        let mut mount = std::process::Command::new("mount");
        let mount = mount.args(["-t", "tmpfs", "-o", "size=512k", "tmpfs"]).arg(place);
        mount.output().ok()?.status.success().then_some(SmallDisk(place))
    }
}

impl Drop for SmallDisk<'_> {
    fn drop(&mut self) {
        let _ = std::process::Command::new("umount")
            .args(["-l"])
            .arg(self.0)
            .output();
    }
}
