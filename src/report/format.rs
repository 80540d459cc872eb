//! Numbers, units and names as people read them.

/// A unit with an SI prefix that keeps numbers between 1 and 1000.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// What an SI value is multiplied by.
    pub factor: f64,
    /// `mm/s`; empty when dimensionless.
    pub label: String,
}

impl Unit {
    /// Relative errors: in percent, as long as that is readable.
    pub fn of_errors(largest: f64) -> Unit {
        if largest >= 1e-6 || largest == 0.0 {
            return Unit {
                factor: 100.0,
                label: "%".to_owned(),
            };
        }
        Unit {
            factor: 1.0,
            label: String::new(),
        }
    }

    /// ` (mm/s)`, or nothing.
    pub fn in_brackets(&self) -> String {
        if self.label.is_empty() {
            String::new()
        } else {
            format!(" ({})", self.label)
        }
    }
}

/// Units that take a prefix on their first letter. A kilogram has one already.
const PREFIXED: [&str; 10] = ["m", "s", "m/s", "m/s2", "N", "Pa", "Pa s", "J", "W", "N/m"];
const PREFIXES: [(f64, &str); 10] = [
    (1e6, "M"),
    (1e3, "k"),
    (1.0, ""),
    (1e-3, "m"),
    (1e-6, "µ"),
    (1e-9, "n"),
    (1e-12, "p"),
    (1e-15, "f"),
    (1e-18, "a"),
    (1e-21, "z"),
];

/// The readable form of an SI unit for numbers up to `largest`.
pub fn readable(unit: &str, largest: f64) -> Unit {
    let plain = Unit {
        factor: 1.0,
        label: pretty_unit(unit),
    };
    let length = unit.starts_with('m');
    let largest = largest.abs();
    if !PREFIXED.contains(&unit) || largest == 0.0 || !largest.is_finite() {
        return plain;
    }
    // Nobody measures speed in km/s here, or time in ks.
    let allowed: Vec<_> = PREFIXES
        .iter()
        .filter(|(size, _)| *size <= 1.0 || !(length || unit == "s"))
        .collect();
    let fitting = allowed.iter().find(|(size, _)| largest >= *size * 0.999_999);
    let best = fitting.or(allowed.last());
    match best {
        Some((size, prefix)) => Unit {
            factor: 1.0 / size,
            label: format!("{prefix}{}", pretty_unit(unit)),
        },
        None => plain,
    }
}

/// `kg/m³` for `kg/m3`; nothing for a dimensionless one.
pub fn pretty_unit(unit: &str) -> String {
    match unit {
        "1" | "-" | "" => String::new(),
        unit => unit.replace('3', "³").replace('2', "²"),
    }
}

/// The measure of work that runs are compared by unless told.
pub const RUN_TIME: &str = "timings.wall";

/// A quantity in words: `counters.searched_pairs` is `searched pairs`, `timings.cpu` is `CPU time`.
pub fn measure(name: &str) -> String {
    match name {
        RUN_TIME => "run time".to_owned(),
        "timings.cpu" => "CPU time".to_owned(),
        name => words(name.trim_start_matches("counters.")),
    }
}

/// `spacing / diameter` for `spacing_over_diameter`; people keep their capitals.
pub fn words(name: &str) -> String {
    name.replace("_over_", " / ")
        .replace('_', " ")
        .replace("stokes", "Stokes")
        .replace("start up", "start-up")
        .replace("self disturbance", "self-disturbance")
}

/// An SI value with a readable unit: `4.870 mm/s`.
pub fn quantity(value: f64, unit: &str) -> String {
    let unit = readable(unit, value);
    format!("{} {}", four_digits(value * unit.factor), unit.label)
        .trim_end()
        .to_owned()
}

/// A mean over seeds with the half width of its confidence interval: `4.870 ± 0.012 mm/s`.
pub fn measured(value: f64, half_width: Option<f64>, unit: &str) -> String {
    let Some(half_width) = half_width.filter(|width| width.is_finite()) else {
        return quantity(value, unit);
    };
    let unit = readable(unit, value);
    format!(
        "{} {}",
        plus_minus(value * unit.factor, half_width * unit.factor),
        unit.label
    )
    .trim_end()
    .to_owned()
}

/// `4.870 ± 0.012`
pub fn plus_minus(value: f64, half_width: f64) -> String {
    format!("{} ± {}", four_digits(value), two_digits(half_width))
}

/// Two significant digits: uncertainties.
fn two_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    number(rounded)
}

/// A quantity as the title of an axis.
pub fn title_words(name: &str) -> String {
    match name {
        "spacing_over_diameter" => "particle spacing / grain diameter".to_owned(),
        name => words(name),
    }
}

/// First letter large.
pub fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

/// At most four significant digits: settings and ticks.
pub fn number(value: f64) -> String {
    rounded(value, trimmed)
}

/// Four significant digits, zeros included: results, which stand below each other.
pub fn four_digits(value: f64) -> String {
    rounded(value, |digits| digits)
}

fn rounded(value: f64, shortened: fn(&str) -> &str) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "–".to_owned();
    }
    let exponent = value.abs().log10().floor() as i32;
    if (-4..6).contains(&exponent) {
        return signed(shortened(&format!("{value:.*}", (3 - exponent).max(0) as usize)));
    }
    let mantissa = format!("{:.3}", value / 10f64.powi(exponent));
    let mantissa = shortened(&mantissa);
    if mantissa == "1" {
        return power_of_ten(exponent);
    }
    signed(&format!("{mantissa} × {}", power_of_ten(exponent)))
}

/// An exact, shortest number for tables that programs read.
pub fn exact(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-5..1e15).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

/// A fraction in percent with at most three significant digits: bounds.
pub fn percent(fraction: f64) -> String {
    percentage(fraction, trimmed)
}

/// A fraction in percent with three significant digits, zeros included: errors found.
pub fn percent_found(fraction: f64) -> String {
    percentage(fraction, |digits| digits)
}

fn percentage(fraction: f64, shortened: fn(&str) -> &str) -> String {
    let value = fraction * 100.0;
    let size = value.abs();
    if !value.is_finite() {
        return "–".to_owned();
    }
    if size == 0.0 {
        return "0 %".to_owned();
    }
    if size < 1e-3 {
        let exponent = fraction.abs().log10().floor() as i32;
        let mantissa = fraction / 10f64.powi(exponent);
        return signed(&format!("{mantissa:.1} × {}", power_of_ten(exponent)));
    }
    let digits = (2 - size.log10().floor() as i32).max(0) as usize;
    signed(&format!("{} %", shortened(&format!("{value:.digits$}"))))
}

/// `10⁻³`.
pub fn power_of_ten(exponent: i32) -> String {
    let digits = exponent.to_string();
    let raised = digits.chars().map(|digit| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    });
    format!("10{}", raised.collect::<String>())
}

/// Seconds as people say them.
pub fn duration(seconds: f64) -> String {
    if seconds >= 7200.0 {
        return format!("{:.1} h", seconds / 3600.0);
    }
    if seconds >= 120.0 {
        return format!("{:.1} min", seconds / 60.0);
    }
    let unit = readable("s", seconds);
    let value = seconds * unit.factor;
    let digits = if value >= 100.0 { 0 } else { 1 };
    format!("{value:.digits$} {}", unit.label)
}

/// Bytes as people say them.
pub fn memory(bytes: u64) -> String {
    const STEP: f64 = 1024.0;
    let mut value = bytes as f64;
    for unit in ["B", "KiB", "MiB"] {
        if value < STEP {
            return format!("{value:.0} {unit}");
        }
        value /= STEP;
    }
    format!("{value:.1} GiB")
}

/// A count with thin spaces between thousands.
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) && digits.len() > 4 {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// `raso-fig5.18` as a citation.
pub fn thesis_figure(id: &str) -> String {
    let Some((author, figure)) = id.split_once("-fig") else {
        return id.to_owned();
    };
    let year = match author {
        "raso" => " (2014)",
        "alvim" => " (2016)",
        _ => "",
    };
    format!("{}{year}, figure {figure}", sentence(author))
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

/// With a true minus sign.
fn signed(text: &str) -> String {
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_follow_the_range() {
        assert_eq!(
            readable("m/s", 0.0085),
            Unit {
                factor: 1000.0,
                label: "mm/s".into()
            }
        );
        assert_eq!(readable("s", 0.062).label, "ms");
        assert_eq!(readable("J", 6.5e-20).label, "zJ");
        assert_eq!(readable("m", 5e-5).label, "µm");
        assert_eq!(readable("m", 4000.0).label, "m");
        assert_eq!(readable("Pa", 58_000.0).label, "kPa");
        assert_eq!(readable("kg/m3", 0.2).label, "kg/m³");
        assert_eq!(
            readable("1", 0.002),
            Unit {
                factor: 1.0,
                label: String::new()
            }
        );
    }

    #[test]
    fn numbers_are_short_and_true() {
        assert_eq!(number(0.004_913_2), "0.004913");
        assert_eq!(number(-12.0), "−12");
        assert_eq!(number(2.5e-9), "2.5 × 10⁻⁹");
        assert_eq!(number(13_200.0), "13200");
        assert_eq!(number(1e-12), "10⁻¹²");
        assert_eq!(percent(0.0123), "1.23 %");
        assert_eq!(percent(0.01), "1 %");
        assert_eq!(percent_found(0.002), "0.200 %");
        assert_eq!(percent_found(0.000_777_25), "0.0777 %");
        assert_eq!(quantity(0.004_870_1, "m/s"), "4.870 mm/s");
        assert_eq!(quantity(0.109_2, "1"), "0.1092");
        assert_eq!(percent(0.0), "0 %");
        assert_eq!(percent(3.0e-13), "3.0 × 10⁻¹³");
        assert_eq!(count(1_234_567), "1\u{202f}234\u{202f}567");
    }

    #[test]
    fn exact_numbers_read_back() {
        for value in [0.1 + 0.2, 6.1e-17, -3.0, 1.5e300, 0.0] {
            assert_eq!(exact(value).parse::<f64>().unwrap(), value);
        }
    }

    #[test]
    fn thesis_figures_are_cited() {
        assert_eq!(thesis_figure("raso-fig5.18"), "Raso (2014), figure 5.18");
        assert_eq!(thesis_figure("somebody"), "somebody");
    }
}
