//! Numbers with units: `0.89 mPa s`, `100 um`, `1 %`. Everything becomes SI.

use std::fmt;

/// Exponents of kilogram, metre, second and ampere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension([i8; 4]);

impl Dimension {
    pub const NONE: Dimension = Dimension([0, 0, 0, 0]);
    pub const LENGTH: Dimension = Dimension([0, 1, 0, 0]);
    pub const TIME: Dimension = Dimension([0, 0, 1, 0]);
    pub const DENSITY: Dimension = Dimension([1, -3, 0, 0]);
    pub const VISCOSITY: Dimension = Dimension([1, -1, -1, 0]);
    pub const SPEED: Dimension = Dimension([0, 1, -1, 0]);
    pub const ACCELERATION: Dimension = Dimension([0, 1, -2, 0]);
    pub const STIFFNESS: Dimension = Dimension([1, 0, -2, 0]);
    pub const PRESSURE: Dimension = Dimension([1, -1, -2, 0]);
    pub const DAMPING: Dimension = Dimension([1, 0, -1, 0]);
    pub const FREQUENCY: Dimension = Dimension([0, 0, -1, 0]);
    pub const RESISTANCE: Dimension = Dimension([0, -1, 0, 0]);
    pub const ENERGY: Dimension = Dimension([1, 2, -2, 0]);
    pub const CHARGE: Dimension = Dimension([0, 0, 1, 1]);

    /// What a quantity of this dimension is called, where it has a name.
    pub fn name(self) -> Option<&'static str> {
        NAMED.iter().find(|entry| entry.0 == self).map(|entry| entry.1)
    }

    /// The SI unit, `1` when dimensionless.
    pub fn unit(self) -> String {
        match NAMED.iter().find(|entry| entry.0 == self) {
            Some(entry) => entry.2.to_owned(),
            None => self.powers(),
        }
    }

    pub fn named(name: &str) -> Option<Dimension> {
        NAMED.iter().find(|entry| entry.1 == name).map(|entry| entry.0)
    }

    fn powers(self) -> String {
        let parts: Vec<String> = ["kg", "m", "s", "A"]
            .iter()
            .zip(self.0)
            .filter(|(_, power)| *power != 0)
            .map(|(symbol, power)| match power {
                1 => (*symbol).to_owned(),
                _ => format!("{symbol}^{power}"),
            })
            .collect();
        parts.join(" ")
    }

    fn raised(self, power: i8) -> Dimension {
        Dimension(self.0.map(|exponent| exponent.saturating_mul(power)))
    }

    fn times(self, other: Dimension) -> Dimension {
        let mut sum = self.0;
        for (exponent, more) in sum.iter_mut().zip(other.0) {
            *exponent = exponent.saturating_add(more);
        }
        Dimension(sum)
    }
}

/// "a length (m)", "a pure number", "a quantity in kg m^2".
impl fmt::Display for Dimension {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match self.name() {
            Some("number") => write!(out, "a pure number"),
            Some(name) => {
                let article = if name.starts_with(['a', 'e']) { "an" } else { "a" };
                write!(out, "{article} {name} ({})", self.unit())
            }
            None => write!(out, "a quantity in {}", self.powers()),
        }
    }
}

const NAMED: &[(Dimension, &str, &str)] = &[
    (Dimension::NONE, "number", "1"),
    (Dimension::LENGTH, "length", "m"),
    (Dimension::TIME, "time", "s"),
    (Dimension([1, 0, 0, 0]), "mass", "kg"),
    (Dimension([0, 2, 0, 0]), "area", "m²"),
    (Dimension([0, 3, 0, 0]), "volume", "m³"),
    (Dimension::DENSITY, "density", "kg/m³"),
    (Dimension::SPEED, "speed", "m/s"),
    (Dimension::ACCELERATION, "acceleration", "m/s²"),
    (Dimension::VISCOSITY, "viscosity", "Pa s"),
    (Dimension::PRESSURE, "pressure", "Pa"),
    (Dimension([1, 1, -2, 0]), "force", "N"),
    (Dimension::STIFFNESS, "stiffness", "N/m"),
    (Dimension::DAMPING, "damping coefficient", "N s/m"),
    (Dimension::ENERGY, "energy", "J"),
    (Dimension([1, 2, -3, 0]), "power", "W"),
    (Dimension([0, 2, -1, 0]), "diffusivity", "m²/s"),
    (Dimension::FREQUENCY, "frequency", "1/s"),
    (Dimension::RESISTANCE, "resistance", "1/m"),
    (Dimension::CHARGE, "charge", "C"),
];

/// Symbol, dimension, power of ten and the factor beside it.
type Unit = (&'static str, Dimension, i32, f64);

/// Units taken as they stand; looked up before prefixes are split off.
const WHOLE: &[Unit] = &[
    ("%", Dimension::NONE, -2, 1.0),
    ("rad", Dimension::NONE, 0, 1.0),
    ("min", Dimension::TIME, 0, 60.0),
    ("h", Dimension::TIME, 0, 3600.0),
    ("kg", Dimension([1, 0, 0, 0]), 0, 1.0),
    ("bar", Dimension([1, -1, -2, 0]), 5, 1.0),
    ("mbar", Dimension([1, -1, -2, 0]), 2, 1.0),
];

const PREFIXED: &[Unit] = &[
    ("Pa", Dimension([1, -1, -2, 0]), 0, 1.0),
    ("Hz", Dimension([0, 0, -1, 0]), 0, 1.0),
    ("m", Dimension::LENGTH, 0, 1.0),
    ("s", Dimension::TIME, 0, 1.0),
    ("g", Dimension([1, 0, 0, 0]), -3, 1.0),
    ("N", Dimension([1, 1, -2, 0]), 0, 1.0),
    ("J", Dimension::ENERGY, 0, 1.0),
    ("C", Dimension::CHARGE, 0, 1.0),
    ("A", Dimension([0, 0, 0, 1]), 0, 1.0),
    ("W", Dimension([1, 2, -3, 0]), 0, 1.0),
    ("P", Dimension::VISCOSITY, -1, 1.0),
];

const PREFIXES: &[(&str, i32)] = &[
    ("", 0),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("u", -6),
    ("µ", -6),
    ("μ", -6),
    ("n", -9),
    ("p", -12),
    ("f", -15),
    ("a", -18),
    ("z", -21),
];

/// A number in SI units with its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    pub value: f64,
    pub dimension: Dimension,
}

/// Dimension of a unit alone; `1` and nothing at all are pure numbers.
pub fn dimension(unit: &str) -> Option<Dimension> {
    match unit {
        "" | "1" => Some(Dimension::NONE),
        unit => scale(unit).ok().map(|scale| scale.dimension),
    }
}

/// Unit of one quantity over another: `m/s` for `m` and `s`.
pub fn per(unit: &str, over: &str) -> Option<String> {
    Some(dimension(unit)?.times(dimension(over)?.raised(-1)).unit())
}

/// Reads `number unit`.
///
/// # Errors
/// A sentence when the number, the unit or the unit's spelling is wrong.
pub fn parse(text: &str) -> Result<Measured, String> {
    let text = text.trim();
    let (number, unit) = split(text).ok_or_else(|| format!("`{text}` is not a number with a unit"))?;
    if unit.is_empty() {
        return Err(format!("`{text}` is text without a unit"));
    }
    let scale = scale(unit)?;
    let value = shifted(number, scale.tens).map(|value| value * scale.factor);
    match value {
        Some(value) if value.is_finite() => Ok(Measured {
            value,
            dimension: scale.dimension,
        }),
        _ => Err(format!("`{text}` is out of range")),
    }
}

/// Reads a number with a unit of one given dimension.
///
/// # Errors
/// As [`parse`], and when the dimension differs: the sentence names both.
pub fn parse_as(text: &str, wanted: Dimension) -> Result<f64, String> {
    let found = parse(text)?;
    if found.dimension == wanted {
        Ok(found.value)
    } else {
        Err(format!("`{}` is {}, not {wanted}", text.trim(), found.dimension))
    }
}

fn split(text: &str) -> Option<(&str, &str)> {
    let longest = text
        .char_indices()
        .map(|(start, letter)| start + letter.len_utf8())
        .take(40)
        .filter(|end| is_number(&text[..*end]))
        .last()?;
    Some((&text[..longest], text[longest..].trim()))
}

fn is_number(text: &str) -> bool {
    text.ends_with(|letter: char| letter.is_ascii_digit() || letter == '.')
        && text
            .chars()
            .all(|letter| letter.is_ascii_digit() || "+-.eE".contains(letter))
        && text.parse::<f64>().is_ok()
}

/// Shifts the decimal point in the digits themselves, so that `100 um` is exactly the double `1e-4`.
fn shifted(number: &str, tens: i32) -> Option<f64> {
    let (digits, exponent) = match number.split_once(['e', 'E']) {
        Some((digits, exponent)) => (digits, exponent.parse::<i32>().ok()?),
        None => (number, 0),
    };
    format!("{digits}e{}", exponent.checked_add(tens)?).parse().ok()
}

struct Scale {
    dimension: Dimension,
    tens: i32,
    factor: f64,
}

fn scale(unit: &str) -> Result<Scale, String> {
    let mut scale = Scale {
        dimension: Dimension::NONE,
        tens: 0,
        factor: 1.0,
    };
    for (position, part) in unit.split('/').enumerate() {
        let sign = if position == 0 { 1 } else { -1 };
        let mut atoms = part
            .split([' ', '*', '·'])
            .filter(|atom| !atom.is_empty())
            .peekable();
        if atoms.peek().is_none() {
            return Err(format!("`{unit}` is not a unit"));
        }
        for atom in atoms {
            if atom == "1" {
                continue;
            }
            let (symbol, power) = power(atom);
            let found = look_up(symbol).ok_or_else(|| unknown(symbol))?;
            let power = power.saturating_mul(sign);
            scale.dimension = scale.dimension.times(found.1.raised(power));
            scale.tens += found.2 * i32::from(power);
            scale.factor *= found.3.powi(i32::from(power));
        }
    }
    Ok(scale)
}

fn unknown(symbol: &str) -> String {
    format!("`{symbol}` is not a unit known here")
}

fn power(atom: &str) -> (&str, i8) {
    if let Some(symbol) = atom.strip_suffix('²') {
        return (symbol, 2);
    }
    if let Some(symbol) = atom.strip_suffix('³') {
        return (symbol, 3);
    }
    let symbol = atom.trim_end_matches(|letter: char| letter.is_ascii_digit() || letter == '-');
    match atom[symbol.len()..].parse() {
        Ok(power) => (symbol.trim_end_matches('^'), power),
        Err(_) => (atom, 1),
    }
}

fn look_up(symbol: &str) -> Option<Unit> {
    let whole = WHOLE.iter().find(|unit| unit.0 == symbol).copied();
    whole.or_else(|| {
        PREFIXED.iter().find_map(|unit| {
            let prefix = symbol.strip_suffix(unit.0)?;
            let (_, tens) = PREFIXES.iter().find(|entry| entry.0 == prefix)?;
            Some((unit.0, unit.1, unit.2 + tens, unit.3))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_become_si_without_rounding() {
        for (text, value, dimension) in [
            ("100 um", 1e-4, Dimension::LENGTH),
            ("100µm", 1e-4, Dimension::LENGTH),
            ("0.89 mPa s", 0.89e-3, Dimension::VISCOSITY),
            ("1 cP", 1e-3, Dimension::VISCOSITY),
            ("2.5 g/cm3", 2500.0, Dimension::DENSITY),
            ("1.1839 kg/m³", 1.1839, Dimension::DENSITY),
            ("62 ms", 0.062, Dimension::TIME),
            ("2 min", 120.0, Dimension::TIME),
            ("4.91 mm/s", 4.91e-3, Dimension::SPEED),
            ("9.81 m/s2", 9.81, Dimension::ACCELERATION),
            ("9.81 m/s^2", 9.81, Dimension::ACCELERATION),
            ("9.81 m s-2", 9.81, Dimension::ACCELERATION),
            ("1e3 N/m", 1000.0, Dimension::STIFFNESS),
            ("10 N s/m", 10.0, Dimension::DAMPING),
            ("20 rad/s", 20.0, Dimension::FREQUENCY),
            ("6.5e-20 J", 6.5e-20, Dimension::ENERGY),
            ("65 zJ", 6.5e-20, Dimension::ENERGY),
            ("2 fC", 2e-15, Dimension::CHARGE),
            ("2 pA s", 2e-12, Dimension::CHARGE),
            ("1 %", 0.01, Dimension::NONE),
            ("-3 mm", -3e-3, Dimension::LENGTH),
        ] {
            assert_eq!(parse(text), Ok(Measured { value, dimension }), "{text}");
        }
    }

    #[test]
    fn what_is_no_quantity_is_refused() {
        for text in [
            "",
            "mm",
            "4",
            "4 furlong",
            "4 m/",
            "e5 m",
            "1e999 m",
            "1e99999999999 m",
            "4 m^999",
            "- m",
        ] {
            assert!(parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_wrong_dimension_names_both() {
        let message = parse_as("4 mm/s", Dimension::LENGTH).unwrap_err();
        assert_eq!(message, "`4 mm/s` is a speed (m/s), not a length (m)");
    }
}
