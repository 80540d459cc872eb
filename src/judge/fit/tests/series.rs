//! Time series of known slopes.

use super::super::segmented::{Segmented, fit, meeting};
use super::noise::Noise;

fn times(count: usize) -> Vec<f64> {
    (0..count)
        .map(|index| index as f64 / (count - 1) as f64)
        .collect()
}

/// Falls, bends at each joint.
fn bent(times: &[f64], slopes: &[f64], joints: &[f64]) -> Vec<f64> {
    let line = |time: f64| {
        let bends = joints.iter().zip(slopes.windows(2));
        let bends: f64 = bends
            .map(|(joint, pair)| (pair[1] - pair[0]) * (time - joint).max(0.0))
            .sum();
        6.0 + slopes[0] * time + bends
    };
    times.iter().map(|time| line(*time)).collect()
}

fn noisy(values: &[f64], noise: &[f64], scatter: f64) -> Vec<f64> {
    values
        .iter()
        .zip(noise)
        .map(|(value, noise)| value + scatter * noise)
        .collect()
}

fn values_of(found: &Segmented) -> (Vec<f64>, Vec<f64>) {
    let values = |estimates: &[super::super::Estimate]| estimates.iter().map(|one| one.value).collect();
    (values(&found.slopes), values(&found.joints))
}

#[test]
fn exact_lines_are_found_exactly() {
    let times = times(301);
    for (slopes, joints) in [
        (vec![-5.0], vec![]),
        (vec![-5.0, 0.0], vec![0.618]),
        (vec![-1.0, -5.0, 0.0], vec![0.137, 0.711]),
        (vec![2.0, 3.0, -1.0], vec![0.4, 0.5]),
    ] {
        let found = fit(&times, &bent(&times, &slopes, &joints), slopes.len()).unwrap();
        let (found_slopes, found_joints) = values_of(&found);
        for (found, expected) in found_slopes
            .iter()
            .zip(&slopes)
            .chain(found_joints.iter().zip(&joints))
        {
            assert!((found - expected).abs() < 1e-5, "{found} for {expected}");
        }
    }
}

#[test]
fn a_start_and_a_plateau_do_not_bend_the_middle_slope() {
    // Accelerates over the first tenth, falls, comes to rest by and by.
    let times = times(400);
    let speed = |time: f64| -5.0 * (1.0 - (-time / 0.02).exp()) / (1.0 + ((time - 0.75) / 0.01).exp());
    let mut height = 6.0;
    let mut values = Vec::new();
    for time in &times {
        values.push(height);
        height += speed(*time) / 399.0;
    }
    let found = fit(&times, &values, 3).unwrap();
    assert!(
        (found.slopes[1].value / -5.0 - 1.0).abs() < 0.01,
        "{:?}",
        found.slopes
    );
    assert!((found.joints[1].value - 0.75).abs() < 0.01, "{:?}", found.joints);
}

#[test]
fn outliers_count_little() {
    let times = times(200);
    let mut values = noisy(
        &bent(&times, &[-5.0, 0.0], &[0.6]),
        &Noise::new(3).independent(200),
        0.01,
    );
    let clean = fit(&times, &values, 2).unwrap();
    for index in (7..200).step_by(23) {
        values[index] += 3.0;
    }
    let spoiled = fit(&times, &values, 2).unwrap();
    assert!((spoiled.slopes[0].value - clean.slopes[0].value).abs() < 0.02);
    assert!((spoiled.joints[0].value - clean.joints[0].value).abs() < 0.005);
}

/// How many of the intervals of a slope, of a joint and of a meeting hold what is true, of `rounds`.
fn covered(memory: f64, rounds: u64) -> [usize; 2] {
    let times = times(300);
    let line = bent(&times, &[-5.0, 0.0], &[0.6]);
    let mut counts = [0, 0];
    for seed in 0..rounds {
        let noise = Noise::new(seed).with_memory(memory, times.len());
        let found = fit(&times, &noisy(&line, &noise, 0.05), 2).unwrap();
        let truth = [(found.slopes[0], -5.0), (found.joints[0], 0.6)];
        for (count, (estimate, truth)) in counts.iter_mut().zip(truth) {
            *count += usize::from((estimate.value - truth).abs() <= estimate.half_width());
        }
    }
    counts
}

#[test]
fn intervals_hold_the_truth_in_about_nineteen_of_twenty_series_with_memory() {
    for memory in [0.0, 0.7] {
        for count in covered(memory, 200) {
            assert!((176..=199).contains(&count), "{count} of 200 at {memory}");
        }
    }
}

#[test]
fn memory_widens_the_interval() {
    let times = times(300);
    let line = bent(&times, &[-5.0], &[]);
    let width = |memory| {
        let noise = Noise::new(9).with_memory(memory, times.len());
        fit(&times, &noisy(&line, &noise, 0.05), 1).unwrap().slopes[0].half_width()
    };
    assert!(width(0.8) > 2.0 * width(0.0), "{} and {}", width(0.8), width(0.0));
}

#[test]
fn units_and_origin_of_time_change_nothing_else() {
    let times = times(150);
    let values = noisy(
        &bent(&times, &[-5.0, 0.0], &[0.6]),
        &Noise::new(5).with_memory(0.5, 150),
        0.05,
    );
    let one = fit(&times, &values, 2).unwrap();
    let moved: Vec<f64> = times.iter().map(|time| 100.0 + 1e-3 * time).collect();
    let small: Vec<f64> = values.iter().map(|value| 1e-3 * value).collect();
    let other = fit(&moved, &small, 2).unwrap();
    assert!((other.slopes[0].value / one.slopes[0].value - 1.0).abs() < 1e-6);
    assert!((other.slopes[0].half_width() / one.slopes[0].half_width() - 1.0).abs() < 1e-4);
    assert!(((other.joints[0].value - 100.0) / 1e-3 - one.joints[0].value).abs() < 1e-6);
}

#[test]
fn lines_meet_where_they_cross_with_an_honest_interval() {
    let times = times(120);
    let mut held = 0;
    for seed in 0..200 {
        let falling = noisy(
            &bent(&times, &[-4.0], &[]),
            &Noise::new(seed).independent(120),
            0.05,
        );
        let rising: Vec<f64> = times.iter().map(|time| 1.0 + time).collect();
        let rising = noisy(&rising, &Noise::new(1000 + seed).independent(120), 0.05);
        let lines = [falling, rising].map(|values| fit(&times, &values, 1).unwrap().straight(0));
        // 6 − 4 t = 1 + t at t = 1, y = 2.
        let [time, value] = meeting(&lines[0], &lines[1]).unwrap();
        held += usize::from((time.value - 1.0).abs() <= time.half_width());
        held += usize::from((value.value - 2.0).abs() <= value.half_width());
    }
    assert!((360..=398).contains(&held), "{held} of 400");
    let line = fit(&times, &bent(&times, &[-4.0], &[]), 1).unwrap().straight(0);
    assert!(meeting(&line, &line).is_err());
}

#[test]
fn the_line_of_a_later_segment_is_that_segment() {
    let times = times(200);
    let found = fit(&times, &bent(&times, &[-1.0, -5.0, 0.0], &[0.2, 0.7]), 3).unwrap();
    for segment in 0..3 {
        let line = found.straight(segment);
        let middle = [0.1, 0.45, 0.9][segment];
        let value = line.intercept + line.slope.value * (middle - line.origin);
        assert!((value - found.at(middle)).abs() < 1e-5, "{segment}");
    }
}

#[test]
fn what_cannot_be_parted_is_refused() {
    let few = times(9);
    let message = |result: Result<Segmented, super::super::FitError>| result.unwrap_err().0;
    assert!(message(fit(&few, &few, 2)).contains("9 samples for 2 segments, 10 are needed"));
    let mut broken = times(30);
    broken[3] = f64::NAN;
    assert!(message(fit(&times(30), &broken, 1)).contains("not finite"));
    broken[3] = 0.9;
    assert!(message(fit(&broken, &times(30), 1)).contains("do not rise"));
}
