//! Kill -9 in the middle of runs, again and again.

use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use kynch::runner::{Options, run};
use kynch::store::Store;
use kynch::study::model::{Rehearsal, Study};

use crate::rehearsals::{results, scales, study};

const STORE: &str = "KYNCH_TEST_STORE";
const KILLS: u32 = 20;

fn slow_study() -> Study {
    study(
        scales(24)
            .into_iter()
            .map(|scene| Rehearsal {
                delay: 0.012,
                ..scene
            })
            .collect(),
    )
}

/// Not a test: what the interrupted process does.
#[test]
#[ignore = "run by ctrl_c_keeps_what_is_finished in a process of its own"]
fn interrupted_child() {
    let Some(dir) = std::env::var_os(STORE).map(PathBuf::from) else {
        return;
    };
    let store = Store::open(&dir).unwrap();
    let long = study(
        scales(200)
            .into_iter()
            .map(|scene| Rehearsal { delay: 0.05, ..scene })
            .collect(),
    );
    let summary = run(
        &long,
        &store,
        &Options {
            jobs: Some(2),
            ..Options::default()
        },
    )
    .unwrap();
    assert!(
        summary.interrupted && summary.completed > 0 && summary.failed.is_empty(),
        "{summary:?}"
    );
    assert_eq!(summary.completed + summary.not_run, 200);
    assert_eq!(store.finished().unwrap().len(), summary.completed);
}

#[test]
#[cfg(unix)]
fn ctrl_c_keeps_what_is_finished() {
    let dir = tempfile::tempdir().unwrap();
    let mut child = start_child("crash::interrupted_child", dir.path());
    // Until some points are finished.
    while Store::read(dir.path()).map_or(0, |store| store.finished().unwrap().len()) < 3 {
        assert_eq!(
            child.try_wait().unwrap(),
            None,
            "the child ended before it was interrupted"
        );
        std::thread::sleep(Duration::from_millis(20));
    }
    // SAFETY: a signal to a child that has not been waited for.
    assert_eq!(unsafe { libc::kill(child.id() as i32, libc::SIGINT) }, 0);
    assert!(child.wait().unwrap().success());
    assert_eq!(Store::inspect(dir.path()).unwrap(), []);
    let kept = Store::read(dir.path()).unwrap().finished().unwrap().len();
    assert!((3..200).contains(&kept), "{kept}");
}

/// Not a test: what the killed process does.
#[test]
#[ignore = "run by kill_nine_loses_only_points_in_flight in a process of its own"]
fn child() {
    let Some(dir) = std::env::var_os(STORE).map(PathBuf::from) else {
        return;
    };
    let store = Store::open(&dir).unwrap();
    let fresh = Options {
        jobs: Some(2),
        fresh: true,
        ..Options::default()
    };
    loop {
        run(&slow_study(), &store, &fresh).unwrap();
    }
}

fn start_child(test: &str, dir: &std::path::Path) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--ignored", "--exact", test])
        .env(STORE, dir)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Until the child has the store open, so that the kill hits its work however slowly it starts.
fn wait_for_lock(child: &Child, dir: &std::path::Path) {
    let start = Instant::now();
    while std::fs::read_to_string(dir.join(".lock")).unwrap_or_default() != child.id().to_string() {
        assert!(
            start.elapsed() < Duration::from_secs(60),
            "the child does not start"
        );
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn kill_nine_loses_only_points_in_flight() {
    let dir = tempfile::tempdir().unwrap();
    let mut kept = 0;
    for kill in 0..KILLS {
        let mut child = start_child("crash::child", dir.path());
        wait_for_lock(&child, dir.path());
        std::thread::sleep(Duration::from_millis(10 + 16 * u64::from(kill)));
        child.kill().unwrap();
        let status = child.wait().unwrap();
        assert_eq!(status.code(), None, "the child ended by itself in round {kill}");
        let store = Store::open(dir.path()).unwrap();
        assert_eq!(store.verify().unwrap(), [], "after kill {kill}");
        let now = store.finished().unwrap().len();
        assert!(now >= kept, "kill {kill} lost finished points: {now} of {kept}");
        kept = now;
    }
    assert!(kept > 0, "no child came far enough to be interrupted");
    let undisturbed = tempfile::tempdir().unwrap();
    for dir in [dir.path(), undisturbed.path()] {
        let store = Store::open(dir).unwrap();
        let summary = run(&slow_study(), &store, &Options::default()).unwrap();
        assert_eq!(summary.completed + summary.cached, 24);
        assert_eq!(store.verify().unwrap(), []);
    }
    assert!(
        results(dir.path()) == results(undisturbed.path()),
        "result files differ"
    );
}
