//! A series between its samples.

/// Value at `time`, straight between neighbours; nothing outside of the series or where it is not finite.
pub fn at(times: &[f64], values: &[f64], time: f64) -> Option<f64> {
    let after = times.partition_point(|sample| *sample < time);
    let next = *times.get(after)?;
    if next == time {
        return values.get(after).copied();
    }
    let before = after.checked_sub(1)?;
    let share = (time - times[before]) / (next - times[before]);
    let (low, high) = (*values.get(before)?, *values.get(after)?);
    Some(low + share * (high - low))
}

#[cfg(test)]
mod tests {
    use super::at;

    const TIMES: [f64; 3] = [0.0, 1.0, 3.0];
    const VALUES: [f64; 3] = [1.0, 5.0, 1.0];

    #[test]
    fn meets_the_samples_and_is_straight_between_them() {
        for (time, value) in TIMES.iter().zip(VALUES) {
            assert_eq!(at(&TIMES, &VALUES, *time), Some(value));
        }
        assert_eq!(at(&TIMES, &VALUES, 0.25), Some(2.0));
        assert_eq!(at(&TIMES, &VALUES, 2.0), Some(3.0));
    }

    #[test]
    fn says_nothing_outside_of_the_series() {
        for time in [-1e-9, 3.0 + 1e-9, f64::NAN] {
            assert_eq!(at(&TIMES, &VALUES, time), None);
        }
        assert_eq!(at(&[], &[], 0.0), None);
    }
}
