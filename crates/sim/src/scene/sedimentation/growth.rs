//! How a bed has grown: what its thickness over time says.

/// Share of the run, at its end, whose mean thickness counts as final [-].
const END: f64 = 0.1;
/// Band around the final thickness in which it counts as reached [-].
const REACHED: f64 = 0.02;
/// Between these shares of the time to the plateau the growth is compared with a straight line [-].
const GROWING: [f64; 2] = [0.125, 0.875];
/// Share of the time to the plateau over which the thickness is averaged for that: its top is that of
/// one grain, which counts as unsettled whenever another one hits it [-].
const SMOOTHED: f64 = 0.125;

/// Growth of a bed; NaN throughout where there is none.
#[derive(Clone, Copy, Debug)]
pub struct Growth {
    /// Time from which on the thickness stays within 2 % of its mean over the last tenth of the run [s];
    /// the end of the run where it never does.
    pub plateau_time: f64,
    /// r² of the straight line through the thickness, averaged over 1/8 of that time, from 1/8 to 7/8
    /// of it [-].
    pub linearity: f64,
    /// Slope of the straight line through the last tenth of the run [m/s].
    pub final_rate: f64,
}

impl Growth {
    /// Times [s], rising, and thicknesses [m].
    pub fn of(times: &[f64], thicknesses: &[f64]) -> Growth {
        let rows: Vec<(f64, f64)> = times.iter().copied().zip(thicknesses.iter().copied()).collect();
        let between = |from: f64, to: f64| -> Vec<(f64, f64)> {
            let inside = |row: &&(f64, f64)| row.0 >= from && row.0 <= to;
            rows.iter().filter(inside).copied().collect()
        };
        let end = rows.last().map_or(0.0, |row| row.0);
        let last = between((1.0 - END) * end, end);
        let thickness = mean(&last);
        if thickness.is_nan() || thickness <= 0.0 {
            return Growth {
                plateau_time: f64::NAN,
                linearity: f64::NAN,
                final_rate: f64::NAN,
            };
        }
        let outside = rows
            .iter()
            .rposition(|row| (row.1 - thickness).abs() > REACHED * thickness);
        let reached = outside.map_or(0, |row| (row + 1).min(rows.len() - 1));
        let plateau_time = rows[reached].0;
        let [from, to] = GROWING.map(|share| share * plateau_time);
        let reach = 0.5 * SMOOTHED * plateau_time;
        let smoothed: Vec<(f64, f64)> = between(from, to)
            .iter()
            .map(|row| (row.0, mean(&between(row.0 - reach, row.0 + reach))))
            .collect();
        Growth {
            plateau_time,
            linearity: line(&smoothed).1,
            final_rate: line(&last).0,
        }
    }
}

/// Mean of the second numbers; NaN for none.
fn mean(points: &[(f64, f64)]) -> f64 {
    points.iter().map(|point| point.1).sum::<f64>() / points.len() as f64
}

/// Slope of the straight line of least squares, and its r²; NaN for fewer than three points.
fn line(points: &[(f64, f64)]) -> (f64, f64) {
    if points.len() < 3 {
        return (f64::NAN, f64::NAN);
    }
    let count = points.len() as f64;
    let average = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (average(|point| point.0), average(|point| point.1));
    let sum = |of: &dyn Fn(f64, f64) -> f64| {
        points
            .iter()
            .map(|point| of(point.0 - x, point.1 - y))
            .sum::<f64>()
    };
    let (xx, yy, xy) = (sum(&|x, _| x * x), sum(&|_, y| y * y), sum(&|x, y| x * y));
    let r_squared = if yy > 0.0 { xy * xy / (xx * yy) } else { f64::NAN };
    (xy / xx, r_squared)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A second of a bed that grows to 2 mm as `growth` of its share of `until` says.
    fn bed(until: f64, growth: fn(f64) -> f64) -> Growth {
        let times: Vec<f64> = (0..=200).map(|row| f64::from(row) * 5e-3).collect();
        let thicknesses: Vec<f64> = times
            .iter()
            .map(|time| 2e-3 * growth((time / until).min(1.0)))
            .collect();
        Growth::of(&times, &thicknesses)
    }

    #[test]
    fn a_bed_that_grows_steadily_and_stops_is_told_when() {
        let growth = bed(0.4, |share| share);
        assert!((growth.plateau_time - 0.98 * 0.4).abs() < 6e-3, "{growth:?}");
        assert!((growth.linearity - 1.0).abs() < 1e-9, "{growth:?}");
        assert!(growth.final_rate.abs() < 1e-12, "{growth:?}");
    }

    #[test]
    fn growth_that_slows_down_or_comes_late_is_less_straight() {
        let slowing = bed(0.4, |share| 1.0 - (1.0 - share).powi(3));
        let late = bed(0.4, |share| share.powi(6));
        assert!(slowing.linearity < 0.97, "{slowing:?}");
        assert!(late.linearity < 0.8, "{late:?}");
    }

    #[test]
    fn a_top_that_flickers_does_not_bend_the_growth() {
        let flickering = |share: f64| {
            share
                - if ((share * 1e4) as u32).is_multiple_of(3) {
                    0.2 * share
                } else {
                    0.0
                }
        };
        let times: Vec<f64> = (0..=200).map(|row| f64::from(row) * 5e-3).collect();
        let thicknesses: Vec<f64> = times
            .iter()
            .map(|time| if *time < 0.4 { flickering(time / 0.4) } else { 1.0 })
            .collect();
        let growth = Growth::of(&times, &thicknesses);
        assert!(growth.linearity > 0.98, "{growth:?}");
    }

    #[test]
    fn a_bed_still_growing_has_no_plateau_before_the_end() {
        let growth = bed(2.0, |share| share);
        assert_eq!(growth.plateau_time, 1.0);
        assert!((growth.final_rate / 1e-3 - 1.0).abs() < 1e-9, "{growth:?}");
    }

    #[test]
    fn nothing_is_said_of_no_bed() {
        for growth in [Growth::of(&[], &[]), Growth::of(&[0.0, 1.0], &[0.0, 0.0])] {
            assert!(growth.plateau_time.is_nan() && growth.linearity.is_nan());
        }
        assert!(bed(0.4, |_| 1.0).linearity.is_nan());
    }
}
