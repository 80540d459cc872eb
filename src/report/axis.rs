//! From numbers to places on paper, and where ticks go.

use super::format;

/// One axis: displayed numbers (already in their readable unit) to hundredths of a millimetre.
#[derive(Clone, Debug)]
pub struct Scale {
    pub logarithmic: bool,
    pub low: f64,
    pub high: f64,
    ticks: Vec<Tick>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    pub at: f64,
    /// `None` for a minor tick.
    pub label: Option<String>,
}

impl Scale {
    /// Covers the values with a margin on either side; includes zero when it is near.
    pub fn linear(values: impl IntoIterator<Item = f64>) -> Scale {
        let (mut low, mut high) = range(values).unwrap_or((0.0, 1.0));
        if low > 0.0 && low < 0.4 * high {
            low = 0.0;
        }
        if high - low <= 1e-9 * high.abs().max(low.abs()) {
            let half = if high == 0.0 { 1.0 } else { 0.05 * high.abs() };
            (low, high) = (low - half, high + half);
        }
        let margin = 0.05 * (high - low);
        let low = if low == 0.0 { 0.0 } else { low - margin };
        let high = high + margin;
        Scale {
            logarithmic: false,
            low,
            high,
            ticks: linear_ticks(low, high, TICKS),
        }
    }

    /// Exactly from the smallest to the largest value: the time axis of a series. Begins at zero when
    /// the smallest is near.
    pub fn tight(values: impl IntoIterator<Item = f64>) -> Scale {
        match range(values) {
            Some((low, high)) if high > low => {
                let low = if low > 0.0 && low < 0.1 * high { 0.0 } else { low };
                Scale {
                    logarithmic: false,
                    low,
                    high,
                    ticks: linear_ticks(low, high, TICKS),
                }
            }
            Some((low, _)) => Scale::linear([low]),
            None => Scale::linear([]),
        }
    }

    /// Fewer ticks, for a small linear axis.
    pub fn with_at_most(mut self, count: u32) -> Scale {
        if !self.logarithmic {
            self.ticks = linear_ticks(self.low, self.high, count);
        }
        self
    }

    /// Covers positive values, with at least a factor of three between the ends.
    pub fn logarithmic(values: impl IntoIterator<Item = f64>) -> Scale {
        let positive = values.into_iter().filter(|value| *value > 0.0);
        let (low, high) = range(positive).unwrap_or((1.0, 10.0));
        let spread = (3.0 / (high / low)).max(1.0).sqrt();
        let margin = (high / low).powf(0.07).max(1.12) * spread;
        let (low, high) = (low / margin, high * margin);
        Scale {
            logarithmic: true,
            low,
            high,
            ticks: logarithmic_ticks(low, high),
        }
    }

    /// Covers positive values that span less than a decade, with a small margin and ticks at round numbers.
    pub fn logarithmic_tight(values: impl IntoIterator<Item = f64>) -> Scale {
        let (low, high) = range(values.into_iter().filter(|value| *value > 0.0)).unwrap_or((1.0, 10.0));
        let margin = (high / low).powf(0.05).max(1.005);
        let (low, high) = (low / margin, high * margin);
        Scale {
            logarithmic: true,
            low,
            high,
            ticks: match high / low < 5.0 {
                true => linear_ticks(low, high, TICKS),
                false => logarithmic_ticks(low, high),
            },
        }
    }

    /// Ticks at the values themselves, where they are few: a sweep's own resolutions.
    pub fn with_ticks_at(mut self, values: &[f64]) -> Scale {
        let mut values = values.to_vec();
        values.sort_by(f64::total_cmp);
        values.dedup();
        let apart = values
            .windows(2)
            .all(|pair| (self.fraction(pair[1]) - self.fraction(pair[0])) > 0.06);
        if values.len() > 1 && values.len() <= 9 && apart {
            self.ticks = values
                .into_iter()
                .map(|at| Tick {
                    at,
                    label: Some(format::number(at)),
                })
                .collect();
        }
        self
    }

    pub fn is_logarithmic(&self) -> bool {
        self.logarithmic
    }

    pub fn ticks(&self) -> &[Tick] {
        &self.ticks
    }

    /// 0 at the low end, 1 at the high end.
    pub fn fraction(&self, value: f64) -> f64 {
        if self.logarithmic {
            return (value / self.low).ln() / (self.high / self.low).ln();
        }
        (value - self.low) / (self.high - self.low)
    }
}

fn range(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values
        .into_iter()
        .filter(|value| value.is_finite())
        .fold(None, |range, value| match range {
            None => Some((value, value)),
            Some((low, high)) => Some((low.min(value), high.max(value))),
        })
}

/// Steps of a linear axis: not more.
const TICKS: u32 = 7;

/// Steps of 1, 2 or 5 times a power of ten, at most so many.
fn linear_ticks(low: f64, high: f64, count: u32) -> Vec<Tick> {
    let rough = (high - low) / f64::from(count);
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    let step = step
        .into_iter()
        .find(|step| *step >= rough * 0.999)
        .unwrap_or(10.0 * power);
    let digits = (-(step.log10() + 1e-9).floor()).max(0.0) as usize;
    let (first, last) = (
        (low / step - 1e-9).ceil() as i64,
        (high / step + 1e-9).floor() as i64,
    );
    let large = low.abs().max(high.abs()) >= 1e5;
    let label = |at: f64| {
        if digits > 5 || large {
            format::number(at)
        } else {
            format!("{at:.digits$}").replace('-', "−")
        }
    };
    (first..=last)
        .map(|index| index as f64 * step)
        .map(|at| Tick {
            at,
            label: Some(label(at)),
        })
        .collect()
}

/// 1, 2, 5 within three decades, decades beyond; the other digits are minor ticks. An axis so short
/// that fewer than three labels would be left shows all digits.
fn logarithmic_ticks(low: f64, high: f64) -> Vec<Tick> {
    let ticks = ticks_of_digits(low, high, &[1, 2, 5]);
    let labelled = ticks.iter().filter(|tick| tick.label.is_some()).count();
    if labelled < 3 {
        return ticks_of_digits(low, high, &[1, 2, 3, 4, 5, 6, 7, 8, 9]);
    }
    ticks
}

fn ticks_of_digits(low: f64, high: f64, labelled: &[i32]) -> Vec<Tick> {
    let decades = (high / low).log10();
    let every = (decades / 8.0).ceil().max(1.0) as i32;
    let mut ticks = Vec::new();
    for exponent in low.log10().floor() as i32..=high.log10().ceil() as i32 {
        for digit in 1..10 {
            // A quotient of exact numbers gives 0.2, where a product gives 0.2000…1.
            let at = match exponent {
                0.. => f64::from(digit) * 10f64.powi(exponent),
                _ => f64::from(digit) / 10f64.powi(-exponent),
            };
            if at < low || at > high {
                continue;
            }
            let is_labelled = match digit {
                1 => exponent.rem_euclid(every) == 0,
                digit => decades <= 3.0 && labelled.contains(&digit),
            };
            let label = is_labelled.then(|| logarithmic_label(at, exponent, digit));
            if every == 1 || digit == 1 {
                ticks.push(Tick { at, label });
            }
        }
    }
    ticks
}

fn logarithmic_label(at: f64, exponent: i32, digit: i32) -> String {
    if (-3..5).contains(&exponent) {
        return format::number(at);
    }
    match digit {
        1 => format::power_of_ten(exponent),
        digit => format!("{digit} × {}", format::power_of_ten(exponent)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: &Scale) -> Vec<String> {
        scale
            .ticks()
            .iter()
            .filter_map(|tick| tick.label.clone())
            .collect()
    }

    #[test]
    fn a_linear_axis_counts_in_ones_twos_and_fives() {
        assert_eq!(
            labels(&Scale::tight([0.0, 6.2])),
            ["0", "1", "2", "3", "4", "5", "6"]
        );
        assert_eq!(
            labels(&Scale::tight([0.0, 6.2]).with_at_most(4)),
            ["0", "2", "4", "6"]
        );
        assert_eq!(
            labels(&Scale::tight([-0.1, 0.1])),
            ["−0.10", "−0.05", "0.00", "0.05", "0.10"]
        );
    }

    #[test]
    fn a_logarithmic_axis_of_two_decades_shows_one_two_five() {
        let scale = Scale::logarithmic([0.12, 9.0]);
        assert_eq!(labels(&scale), ["0.1", "0.2", "0.5", "1", "2", "5", "10"]);
        assert!(scale.ticks().iter().any(|tick| tick.label.is_none()));
    }

    #[test]
    fn a_short_logarithmic_axis_is_still_readable() {
        assert!(labels(&Scale::logarithmic([0.4, 0.8])).len() >= 4);
    }

    #[test]
    fn many_decades_show_powers() {
        let labels = labels(&Scale::logarithmic([1e-13, 1e-6]));
        assert!(labels.contains(&"10⁻⁹".to_owned()), "{labels:?}");
    }

    #[test]
    fn every_axis_holds_its_values_and_two_ticks() {
        for values in [
            vec![3.0],
            vec![0.0, 0.0],
            vec![1e-9, 2e-9],
            vec![4.9, 4.95],
            vec![],
        ] {
            for scale in [Scale::linear(values.clone()), Scale::logarithmic(values.clone())] {
                assert!(labels(&scale).len() >= 2, "{values:?} {scale:?}");
                for value in values.iter().filter(|value| !scale.logarithmic || **value > 0.0) {
                    assert!((0.0..=1.0).contains(&scale.fraction(*value)));
                }
            }
        }
    }

    #[test]
    fn a_sweep_has_ticks_at_its_own_values() {
        let values = [1.5, 2.0, 3.0, 4.0, 6.0];
        assert_eq!(
            labels(&Scale::logarithmic(values).with_ticks_at(&values)),
            ["1.5", "2", "3", "4", "6"]
        );
        let crowded = [1.0, 1.001, 1.002, 50.0];
        assert_ne!(
            labels(&Scale::logarithmic(crowded).with_ticks_at(&crowded)).len(),
            4
        );
    }
}
