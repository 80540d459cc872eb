//! Ctrl-C: the first press ends the run with everything finished kept, the second ends the process.

use std::sync::Once;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Exit status of a process ended by Ctrl-C.
const ABORTED: i32 = 130;

static PRESSES: AtomicUsize = AtomicUsize::new(0);
static WATCHERS: AtomicUsize = AtomicUsize::new(0);

/// As long as one is alive, the first Ctrl-C only asks for an end.
pub(super) struct Watch;

impl Watch {
    pub fn start() -> Watch {
        static INSTALL: Once = Once::new();
        // Someone else may have a handler already: theirs stands then.
        INSTALL.call_once(|| drop(ctrlc::set_handler(pressed)));
        if WATCHERS.fetch_add(1, Ordering::SeqCst) == 0 {
            PRESSES.store(0, Ordering::SeqCst);
        }
        Watch
    }

    pub fn interrupted(&self) -> bool {
        PRESSES.load(Ordering::Relaxed) > 0
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        WATCHERS.fetch_sub(1, Ordering::SeqCst);
    }
}

fn pressed() {
    let before = PRESSES.fetch_add(1, Ordering::SeqCst);
    if WATCHERS.load(Ordering::SeqCst) == 0 || before > 0 {
        std::process::exit(ABORTED);
    }
    eprintln!("\nstopping: finished points are kept; press Ctrl-C again to abort at once");
}
