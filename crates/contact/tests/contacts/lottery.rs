//! Pseudo-random numbers, the same on every machine.

/// Simple generator of random numbers in [0, 1).
pub(crate) struct Lottery(pub(crate) u64);

impl Lottery {
    pub(crate) fn draw(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Approximately normal random number with rms 1.
    pub(crate) fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.draw()).sum::<f64>() - 6.0
    }
}
