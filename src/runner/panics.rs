//! Panics of a point, caught with their message and without noise on the terminal.

use std::cell::{Cell, RefCell};
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::Once;

thread_local! {
    static QUIET: Cell<bool> = const { Cell::new(false) };
    static PLACE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Runs `work`; a panic comes back as its message with the place in the sources.
pub(super) fn caught<Value>(work: impl FnOnce() -> Value) -> Result<Value, String> {
    static INSTALL: Once = Once::new();
    INSTALL.call_once(|| {
        let loud = panic::take_hook();
        panic::set_hook(Box::new(
            move |info| if QUIET.get() { note(info) } else { loud(info) },
        ));
    });
    QUIET.set(true);
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    QUIET.set(false);
    result.map_err(|payload| {
        let text = payload.downcast_ref::<&str>().map(|text| text.to_string());
        let text = text.or_else(|| payload.downcast_ref::<String>().cloned());
        let text = text.unwrap_or_else(|| "a panic without a message".into());
        PLACE
            .take()
            .map_or(text.clone(), |place| format!("{text} ({place})"))
    })
}

fn note(info: &PanicHookInfo) {
    // A path outside the project is of this machine only, and results must not depend on it.
    let place = info
        .location()
        .filter(|place| !std::path::Path::new(place.file()).is_absolute());
    PLACE.set(place.map(|place| format!("{}:{}", place.file(), place.line())));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_message_and_its_place_are_kept() {
        let number = std::hint::black_box(3);
        let text = caught(|| panic!("grain {number} lost")).unwrap_err();
        assert!(
            text.starts_with("grain 3 lost (") && text.contains("panics.rs:"),
            "{text}"
        );
        assert_eq!(caught(|| 7), Ok(7));
    }
}
