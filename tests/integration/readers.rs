//! Other people's readers understand a store.

use std::process::Command;

use kynch::export::{Format, Wanted, export};
use kynch::runner::{Options, run};
use kynch::store::Store;
use kynch::study::model::{Rehearsal, RehearsalEnding};

use crate::rehearsals::{rehearsal, scales, study};

#[test]
#[ignore = "installs Python packages: cargo test --test integration readers -- --ignored"]
fn vtk_reads_exported_grains() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(&dir.path().join("store")).unwrap();
    let scene = Rehearsal {
        grains: 64,
        ..rehearsal(1.0)
    };
    run(&study(vec![scene]), &store, &Options::default()).unwrap();
    let ids: Vec<_> = store.summaries().into_iter().map(|run| run.id).collect();
    let wanted = Wanted {
        format: Format::Vtk,
        time: None,
        table: None,
    };
    let out = dir.path().join("out");
    export(&store.load(&ids).unwrap()[0], &wanted, &out).unwrap();
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/readers/read_grains.sh");
    let done = Command::new("sh").arg(script).arg(&out).output().unwrap();
    let text = String::from_utf8_lossy(&done.stdout) + String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{text}");
}

#[test]
#[ignore = "installs Python packages: cargo test --test integration readers -- --ignored"]
fn duckdb_polars_and_pandas_read_a_store() {
    let dir = tempfile::tempdir().unwrap();
    let mut scenes = scales(5);
    scenes.push(Rehearsal {
        ending: RehearsalEnding::Diverges,
        ..rehearsal(9.0)
    });
    run(
        &study(scenes),
        &Store::open(dir.path()).unwrap(),
        &Options::default(),
    )
    .unwrap();
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/readers/run.sh");
    let done = Command::new("sh").arg(script).arg(dir.path()).output().unwrap();
    let text = String::from_utf8_lossy(&done.stdout) + String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{text}");
}
