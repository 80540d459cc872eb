//! Failures at every single write.

use std::collections::BTreeMap;
use std::sync::atomic::Ordering;

use super::model::{Column, Scalar, Table};
use super::*;

fn run(number: u64, value: f64) -> Run {
    let column = |name: &str, values| Column {
        name: name.into(),
        unit: "s".into(),
        values,
    };
    Run {
        id: PointId(format!("point{number}")),
        study: "rehearsed".into(),
        scene: "scene".into(),
        axes: Vec::new(),
        seed: number,
        settings: serde_json::json!({ "rehearsal": { "limit": number } }),
        status: Status::Completed,
        reason: None,
        scalars: vec![Scalar {
            name: "limit".into(),
            unit: "m/s".into(),
            value,
        }],
        counters: vec![("steps".into(), number)],
        tables: vec![Table {
            name: "time_series".into(),
            columns: vec![column("time", vec![0.0, value])],
        }],
        derived: Vec::new(),
        timing: Timing::default(),
    }
}

/// Appends, compacts, does a run again with another result, compacts.
fn work(store: &Store) -> Result<(), StoreError> {
    store.append(&run(1, 1.0))?;
    store.append(&run(2, 2.0))?;
    store.compact()?;
    store.append(&run(2, 2.5))?;
    store.append(&run(3, 3.0))?;
    store.append(&run(3, 3.5))?;
    store.compact()
}

fn contents(dir: &Path) -> BTreeMap<String, String> {
    let disk = Disk::read(dir);
    let folders = std::iter::once("").chain(disk::FOLDERS);
    let files = folders.flat_map(|folder| disk.files(folder).unwrap());
    files
        .map(|name| (name.clone(), disk.sum(&name).unwrap().unwrap()))
        .collect()
}

#[test]
fn a_disk_full_at_any_write_loses_nothing_that_was_kept() {
    let whole = tempfile::tempdir().unwrap();
    work(&Store::open(whole.path()).unwrap()).unwrap();
    let mut failures = 0;
    for writes in 0.. {
        let dir = tempfile::tempdir().unwrap();
        let store = Store::open(dir.path()).unwrap();
        store.disk.writes_left.store(writes, Ordering::Relaxed);
        let result = work(&store);
        drop(store);
        let store = Store::open(dir.path()).unwrap();
        assert_eq!(store.verify().unwrap(), [], "after {writes} writes");
        match result {
            Ok(()) => break,
            Err(error @ StoreError::Full { .. }) => {
                assert!(error.to_string().contains("free some space"), "{error}");
                failures += 1;
            }
            Err(other) => panic!("after {writes} writes: {other}"),
        }
        work(&store).unwrap();
        assert_eq!(
            contents(dir.path()),
            contents(whole.path()),
            "after {writes} writes"
        );
    }
    assert!(failures > 15, "{failures}");
}

#[test]
fn a_run_is_there_once_append_has_returned() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    for (step, value) in [1.0, f64::NAN, f64::NEG_INFINITY, -0.0].into_iter().enumerate() {
        store.append(&run(7, value)).unwrap();
        if step == 1 {
            store.compact().unwrap();
        }
        let seen = Store::read(dir.path())
            .unwrap()
            .load(&[PointId("point7".into())])
            .unwrap();
        assert_eq!(seen[0].scalars[0].value.to_bits(), value.to_bits());
        assert_eq!(seen[0].tables[0].columns[0].values[1].to_bits(), value.to_bits());
    }
    let files = contents(dir.path());
    let series = files.keys().filter(|name| name.starts_with("series/"));
    assert_eq!(series.count(), 1, "{files:?}");
}

#[test]
fn reading_does_not_need_or_touch_the_lock() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    assert!(matches!(Store::open(dir.path()), Err(StoreError::InUse { .. })));
    let reader = Store::read(dir.path()).unwrap();
    assert!(matches!(
        reader.append(&run(1, 1.0)),
        Err(StoreError::NotWritable { .. })
    ));
    drop(store);
    assert!(Store::open(dir.path()).is_ok());
}

#[test]
fn a_run_that_could_not_be_kept_leaves_no_files() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    store.append(&run(1, 1.0)).unwrap();
    let before = contents(dir.path());
    for writes in 0..2 {
        store.disk.writes_left.store(writes, Ordering::Relaxed);
        store.append(&run(2, 2.0)).unwrap_err();
        assert_eq!(contents(dir.path()), before, "after {writes} writes");
    }
    // The same run in the place of itself: its files are still wanted.
    store.disk.writes_left.store(1, Ordering::Relaxed);
    store.append(&run(1, 1.0)).unwrap_err();
    assert_eq!(contents(dir.path()), before);
    assert_eq!(store.verify().unwrap(), []);
}
