//! Other people's readers understand a store.

use std::process::Command;

use kynch::runner::{Options, run};
use kynch::store::Store;
use kynch::study::model::{Rehearsal, RehearsalEnding};

use crate::rehearsals::{rehearsal, scales, study};

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
