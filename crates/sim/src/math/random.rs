//! Random numbers that depend on a seed and on nothing else.

/// The generator SplitMix64: Steele, Lea and Flood (2014), Fast splittable pseudorandom number
/// generators, OOPSLA '14, doi:10.1145/2660193.2660195, with the constants of Vigna's `splitmix64.c`.
///
/// Period 2⁶⁴; every seed, zero included, is as good as any other. Not for cryptography.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The sequence of this seed.
    pub fn new(seed: u64) -> Self {
        Random { state: seed }
    }

    /// The next 64 bits.
    #[inline]
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1), a multiple of 2⁻⁵³.
    #[inline]
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform between two limits, in their unit; `low` where they are equal.
    #[inline]
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.uniform() * (high - low)
    }

    /// Uniform among 0, 1, … `count` − 1; zero where `count` is zero.
    ///
    /// The high half of a product (Lemire 2019, doi:10.1145/3230636) without its rejection: no number
    /// is favoured by more than `count`/2⁶⁴.
    #[inline]
    pub fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.bits()) * count as u128) >> 64) as usize
    }

    /// Every order of the items with equal probability (Fisher and Yates 1938; Durstenfeld 1964).
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, self.below(last + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gives_the_published_sequences() {
        let first = |seed: u64| {
            let mut random = Random::new(seed);
            [random.bits(), random.bits(), random.bits()]
        };
        let of_zero = [
            0xe220_a839_7b1d_cdaf,
            0x6e78_9e6a_a1b9_65f4,
            0x06c4_5d18_8009_454f,
        ];
        assert_eq!(first(0), of_zero);
        let of_1234567 = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
        ];
        assert_eq!(first(1_234_567), of_1234567);
    }

    #[test]
    fn uniform_numbers_fill_the_unit_interval_evenly() {
        let mut random = Random::new(7);
        let mut counts = [0u32; 20];
        for _ in 0..200_000 {
            let value = random.uniform();
            assert!((0.0..1.0).contains(&value));
            counts[(value * 20.0) as usize] += 1;
        }
        // Chi squared with 19 degrees of freedom lies below 43.8 with probability 0.999.
        let chi: f64 = counts
            .iter()
            .map(|&n| (f64::from(n) - 10_000.0).powi(2) / 10_000.0)
            .sum();
        assert!(chi < 43.8, "{chi}");
    }

    #[test]
    fn shuffling_keeps_every_item_and_reaches_every_order() {
        let mut random = Random::new(3);
        let mut seen = std::collections::BTreeMap::new();
        for _ in 0..6000 {
            let mut items = [0, 1, 2];
            random.shuffle(&mut items);
            *seen.entry(items).or_insert(0) += 1;
        }
        assert_eq!(seen.len(), 6);
        assert!(seen.values().all(|&n| (850..1150).contains(&n)), "{seen:?}");
    }

    #[test]
    fn neighbouring_seeds_are_unrelated() {
        let (mut one, mut two) = (Random::new(41), Random::new(42));
        let product: f64 = (0..100_000)
            .map(|_| (one.uniform() - 0.5) * (two.uniform() - 0.5))
            .sum();
        // Standard deviation 1/12 of each term.
        assert!(product.abs() < 4.0 * 100_000f64.sqrt() / 12.0, "{product}");
    }
}
