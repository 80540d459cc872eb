//! Where the results of a report come from, taken from the runs themselves: a report made later or
//! elsewhere from the same store says the same.

use serde::Serialize;

use crate::store::model::Run;

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Facts {
    /// Commits of the runs, shortened; `modified` beside one with uncommitted changes.
    pub commits: Vec<String>,
    /// Processors.
    pub machines: Vec<String>,
    pub versions: Vec<String>,
    pub compilers: Vec<String>,
    /// BLAKE3 of the simulator's sources, shortened.
    pub simulators: Vec<String>,
    /// When the newest run finished (UTC).
    pub newest: Option<String>,
}

/// Characters of a hash that tell it from others.
const SHORT: usize = 12;

pub fn of(runs: &[Run]) -> Facts {
    let origin = || runs.iter().map(|run| &run.timing.provenance);
    let commit = |commit: &str, dirty: bool| {
        let short: String = commit.chars().take(SHORT).collect();
        if dirty && !short.is_empty() {
            format!("{short} (modified)")
        } else {
            short
        }
    };
    Facts {
        commits: distinct(origin().map(|origin| commit(&origin.commit, origin.dirty))),
        machines: distinct(origin().map(|origin| origin.cpu.clone())),
        versions: distinct(origin().map(|origin| origin.version.clone())),
        compilers: distinct(origin().map(|origin| origin.compiler.clone())),
        simulators: distinct(origin().map(|origin| origin.simulator_hash.chars().take(SHORT).collect())),
        newest: origin()
            .map(|origin| &origin.finished)
            .filter(|text| !text.is_empty())
            .max()
            .map(|text| date(text)),
    }
}

/// `2026-05-01 12:30 UTC` for `2026-05-01T12:30:11Z`; other forms are left as they are.
fn date(finished: &str) -> String {
    match finished.strip_suffix('Z').and_then(|text| text.split_once('T')) {
        Some((day, time)) if time.len() >= 5 && time.is_char_boundary(5) => {
            format!("{day} {} UTC", &time[..5])
        }
        _ => finished.to_owned(),
    }
}

fn distinct(texts: impl Iterator<Item = String>) -> Vec<String> {
    let mut texts: Vec<String> = texts.filter(|text| !text.is_empty()).collect();
    texts.sort();
    texts.dedup();
    texts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_readable_and_never_lost() {
        assert_eq!(date("2026-05-01T12:30:11Z"), "2026-05-01 12:30 UTC");
        assert_eq!(date("yesterday"), "yesterday");
        assert_eq!(date("2026-05-01T1Z"), "2026-05-01T1Z");
    }
}
