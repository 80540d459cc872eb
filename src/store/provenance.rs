//! Where a result comes from: fixed when the program was built, except for the processor.

use std::sync::OnceLock;
use std::time::{SystemTime, UNIX_EPOCH};

use super::model::Provenance;

impl Provenance {
    /// Of this program on this machine, now.
    pub fn current() -> Provenance {
        Provenance {
            version: env!("CARGO_PKG_VERSION").to_string(),
            commit: env!("KYNCH_COMMIT").to_string(),
            dirty: env!("KYNCH_DIRTY") == "true",
            lock_hash: env!("KYNCH_LOCK_HASH").to_string(),
            simulator_hash: Provenance::simulator_hash().to_string(),
            compiler: env!("KYNCH_COMPILER").to_string(),
            cpu: processor().to_string(),
            finished: now(),
        }
    }

    /// BLAKE3 of the simulator's sources.
    pub fn simulator_hash() -> &'static str {
        env!("KYNCH_SIMULATOR_HASH")
    }
}

fn processor() -> &'static str {
    static MODEL: OnceLock<String> = OnceLock::new();
    MODEL.get_or_init(|| {
        let list = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let model = list
            .lines()
            .find_map(|line| line.strip_prefix("model name")?.split_once(": "));
        model.map_or_else(
            || std::env::consts::ARCH.to_string(),
            |(_, name)| name.trim().to_string(),
        )
    })
}

fn now() -> String {
    let seconds = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .map_or(0, |since| since.as_secs());
    timestamp(seconds)
}

/// RFC 3339 from seconds since 1970-01-01 (days to date: Hinnant, `civil_from_days`).
fn timestamp(seconds: u64) -> String {
    let (days, second) = ((seconds / 86_400) as i64 + 719_468, seconds % 86_400);
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 {
        month_from_march + 3
    } else {
        month_from_march - 9
    };
    let year = year_of_era + era * 400 + i64::from(month <= 2);
    let (hour, minute) = (second / 3600, second / 60 % 60);
    format!(
        "{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{:02}Z",
        second % 60
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_of_known_instants() {
        assert_eq!(timestamp(0), "1970-01-01T00:00:00Z");
        assert_eq!(timestamp(951_782_400), "2000-02-29T00:00:00Z");
        assert_eq!(timestamp(1_000_000_000), "2001-09-09T01:46:40Z");
    }

    #[test]
    fn the_build_knows_its_sources() {
        let from = Provenance::current();
        assert_eq!(from.simulator_hash.len(), 64);
        assert_eq!(from.lock_hash.len(), 64);
        assert!(from.compiler.starts_with("rustc"), "{}", from.compiler);
        assert!(!from.cpu.is_empty());
    }
}
