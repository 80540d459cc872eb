//! Horizontal means over the height of a column, linear between equidistant levels.

#[derive(Clone, Debug)]
pub struct Layers {
    /// Distance of the levels [m].
    width: f64,
    sums: Vec<(f64, f64)>,
    means: Vec<f64>,
}

impl Layers {
    /// Levels every `width` [m] up to a little over `height` [m].
    pub fn new(height: f64, width: f64) -> Self {
        let levels = (height / width).ceil() as usize + 4;
        Layers {
            width,
            sums: vec![(0.0, 0.0); levels],
            means: vec![0.0; levels],
        }
    }

    /// Takes the means of values given with their heights [m].
    pub fn average(&mut self, values: impl Iterator<Item = (f64, f64)>) {
        self.sums.fill((0.0, 0.0));
        for (z, value) in values {
            let (level, share) = self.place(z);
            for (level, weight) in [(level, 1.0 - share), (level + 1, share)] {
                self.sums[level].0 += weight * value;
                self.sums[level].1 += weight;
            }
        }
        for (mean, (sum, weight)) in self.means.iter_mut().zip(&self.sums) {
            *mean = if *weight > 0.0 { sum / weight } else { 0.0 };
        }
    }

    /// The mean at height z [m].
    pub fn at(&self, z: f64) -> f64 {
        let (level, share) = self.place(z);
        (1.0 - share) * self.means[level] + share * self.means[level + 1]
    }

    /// Level below a height and the share of the one above.
    fn place(&self, z: f64) -> (usize, f64) {
        let last = self.means.len() - 2;
        let position = (z / self.width + 0.5).clamp(0.0, last as f64 + 1.0);
        let level = (position as usize).min(last);
        (level, position - level as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reproduces_a_linear_profile_between_its_levels() {
        let mut layers = Layers::new(1.0, 0.1);
        layers.average((0..10_000).map(|i| i as f64 * 1e-4).map(|z| (z, 3.0 * z)));
        assert!((layers.at(0.5) - 1.5).abs() < 1e-3);
    }

    #[test]
    fn is_zero_where_nothing_was_given() {
        let mut layers = Layers::new(1.0, 0.1);
        layers.average(std::iter::empty());
        assert_eq!(layers.at(0.3), 0.0);
    }
}
