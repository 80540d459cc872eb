//! Noise with a seed.

/// Permuted congruential generator (O'Neill 2014, PCG-XSH-RR).
pub struct Noise(u64);

impl Noise {
    pub fn new(seed: u64) -> Noise {
        let mut noise = Noise(
            seed.wrapping_mul(0x9E37_79B9_7F4A_7C15)
                .wrapping_add(0xDA3E_39CB_94B9_5BDB),
        );
        noise.uniform();
        noise
    }

    /// In (0, 1).
    fn uniform(&mut self) -> f64 {
        let old = self.0;
        self.0 = old
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let mixed = (((old >> 18) ^ old) >> 27) as u32;
        (f64::from(mixed.rotate_right((old >> 59) as u32)) + 0.5) / 4_294_967_296.0
    }

    /// Of mean 0 and deviation 1 (Box & Muller 1958).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }

    pub fn independent(mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.normal()).collect()
    }

    /// x_i = ρ x_{i−1} + e_i, of deviation 1.
    pub fn with_memory(mut self, memory: f64, count: usize) -> Vec<f64> {
        let mut value = self.normal();
        let fresh = (1.0 - memory * memory).sqrt();
        let mut values = Vec::new();
        for _ in 0..count {
            values.push(value);
            value = memory * value + fresh * self.normal();
        }
        values
    }
}
