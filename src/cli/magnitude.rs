//! Times, sizes and numbers, as people type and read them.

use std::time::Duration;

/// Reads a time: `90s`, `10m`, `1.5 h`, `500ms`; a bare number is in seconds.
///
/// # Errors
/// In words, for anything that is not a positive, finite time below 1000 days.
pub fn duration(text: &str) -> Result<f64, String> {
    let units = [
        ("", 1.0),
        ("s", 1.0),
        ("ms", 1e-3),
        ("m", 60.0),
        ("min", 60.0),
        ("h", 3600.0),
        ("d", 86400.0),
    ];
    let seconds = with_unit(text, &units).filter(|seconds| *seconds > 0.0 && *seconds < 8.64e7);
    seconds.ok_or_else(|| format!("`{text}` is no time; write 90s, 10m or 2h"))
}

/// Reads a size in bytes: `500MB`, `2GiB`; a bare number is in bytes.
///
/// # Errors
/// In words, for anything that is not at least one byte.
pub fn bytes(text: &str) -> Result<u64, String> {
    let units = [
        ("", 1.0),
        ("B", 1.0),
        ("kB", 1e3),
        ("MB", 1e6),
        ("GB", 1e9),
        ("TB", 1e12),
        ("KiB", 1024.0),
        ("MiB", 1_048_576.0),
        ("GiB", 1_073_741_824.0),
        ("TiB", 1_099_511_627_776.0),
    ];
    let size = with_unit(text, &units).filter(|size| *size >= 1.0 && *size < 9e18);
    size.map(|size| size as u64)
        .ok_or_else(|| format!("`{text}` is no size; write 500MB or 2GiB"))
}

fn with_unit(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    let text = text.trim();
    let digits = text
        .find(|letter: char| !letter.is_ascii_digit() && letter != '.')
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    let (_, factor) = units.iter().find(|(name, _)| *name == unit.trim())?;
    number.parse::<f64>().ok().map(|number| number * factor)
}

/// At most four significant digits, without a tail of zeros: `0.003968`, `1.2e-7`, `2e6`.
pub fn number(value: f64) -> String {
    if !value.is_finite() {
        return value.to_string();
    }
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if size != 0.0 && !(1e-4..1e5).contains(&size) {
        format!("{rounded:e}")
    } else {
        format!("{rounded}")
    }
}

/// The shortest text that reads back as the same number: for axis values, which identify a point.
pub fn exact(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-4..1e7).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

/// `0.3 s`, `42 s`, `3 min 05 s`, `2 h 10 min`.
pub fn time(duration: Duration) -> String {
    let seconds = duration.as_secs_f64();
    let whole = seconds.round() as u64;
    if seconds < 9.95 {
        format!("{seconds:.1} s")
    } else if whole < 60 {
        format!("{whole} s")
    } else if whole < 3600 {
        format!("{} min {:02} s", whole / 60, whole % 60)
    } else {
        format!("{} h {:02} min", whole / 3600, whole % 3600 / 60)
    }
}

/// `3 points`, `1 point`.
pub fn count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

/// `1.5 GiB`, `12 MiB`.
pub fn size(bytes: u64) -> String {
    let bytes = bytes as f64;
    let (factor, unit) = match bytes {
        b if b >= 1_073_741_824.0 => (1_073_741_824.0, "GiB"),
        b if b >= 1_048_576.0 => (1_048_576.0, "MiB"),
        _ => (1024.0, "KiB"),
    };
    format!("{} {unit}", (bytes / factor * 10.0).round() / 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_in_their_unit() {
        for (text, seconds) in [
            ("90", 90.0),
            ("90s", 90.0),
            ("10m", 600.0),
            ("10 min", 600.0),
            ("1.5h", 5400.0),
        ] {
            assert_eq!(duration(text), Ok(seconds), "{text}");
        }
        for text in [
            "",
            "m",
            "-1s",
            "0",
            "1 week",
            "1e3s",
            "nan",
            "1.2.3 s",
            "99999999999 d",
        ] {
            assert!(duration(text).is_err(), "{text}");
        }
    }

    #[test]
    fn sizes_tell_decimal_from_binary() {
        assert_eq!(bytes("2GB"), Ok(2_000_000_000));
        assert_eq!(bytes("2 GiB"), Ok(2_147_483_648));
        assert_eq!(bytes("12"), Ok(12));
        for text in ["", "0", "GiB", "2G", "0.2", "-1MB", "99999999999999 TB"] {
            assert!(bytes(text).is_err(), "{text}");
        }
    }

    #[test]
    fn numbers_are_short_and_still_close() {
        for value in [0.0, 0.00396789, 1.0, 123456.0, 2e6, 1.25e-7, -3.5, 99999.6, 1e-4] {
            let text = number(value);
            let back: f64 = text.parse().unwrap();
            assert!((back - value).abs() <= 5e-4 * value.abs(), "{value} {text}");
            assert!(text.len() <= 9, "{text}");
        }
        assert_eq!(number(f64::NAN), "NaN");
    }

    #[test]
    fn exact_numbers_read_back_as_themselves() {
        for value in [0.1 + 0.2, 4.2e-3, 1e-4, 1.23456789e-9, 1e22, -0.0, 0.9] {
            assert_eq!(exact(value).parse::<f64>(), Ok(value));
        }
    }

    #[test]
    fn times_are_told_in_the_largest_fitting_unit() {
        for (seconds, text) in [
            (0.04, "0.0 s"),
            (9.96, "10 s"),
            (59.4, "59 s"),
            (59.6, "1 min 00 s"),
            (7800.0, "2 h 10 min"),
        ] {
            assert_eq!(time(Duration::from_secs_f64(seconds)), text);
        }
    }
}
