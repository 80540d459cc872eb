//! Roots of functions that rise.

/// The positive root of a function that rises from a negative value at zero, found by bisection of the
/// logarithm to the last bit or so; `None` where no sign change lies within 60 decades of the guess.
pub fn rising_root(function: impl Fn(f64) -> f64, guess: f64) -> Option<f64> {
    let (mut low, mut high) = (guess, guess);
    let mut decades = 0;
    let brackets = |low, high| function(low) < 0.0 && function(high) >= 0.0;
    while !brackets(low, high) {
        low /= 10.0;
        high *= 10.0;
        decades += 1;
        if decades > 60 {
            return None;
        }
    }
    // 60 halvings of 120 decades leave 1e-16 decades.
    for _ in 0..70 {
        let middle = (low * high).sqrt();
        if function(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some((low * high).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_roots_far_from_the_guess() {
        for root in [1e-12, 3e-3, 1.0, 7e8] {
            let found = rising_root(|x| x * x - root * root, 1.0).unwrap();
            assert!((found / root - 1.0).abs() < 1e-13, "{found} for {root}");
        }
    }

    #[test]
    fn gives_up_where_there_is_none() {
        assert_eq!(rising_root(|_| -1.0, 1.0), None);
        assert_eq!(rising_root(|_| f64::NAN, 1.0), None);
    }
}
