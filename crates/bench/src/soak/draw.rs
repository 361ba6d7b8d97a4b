//! Random numbers from a seed.

/// `SplitMix64` (Steele, Lea, Flood, OOPSLA 2014). The generator gives the same bits on every machine and does not depend on the version
/// of a crate.
#[derive(Debug, Clone)]
pub(super) struct Draw(u64);

impl Draw {
    pub(super) fn new(seed: u64) -> Self {
        let mut draw = Self(seed);
        // Seeds that are neighbours give neighbouring states; one round makes them independent.
        draw.0 = draw.bits();
        draw
    }

    pub(super) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a number uniform between two bounds.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a number whose logarithm is uniform between the logarithms of two positive bounds.
    pub(super) fn spread(&mut self, low: f64, high: f64) -> f64 {
        math::exp(self.between(math::ln(low), math::ln(high)))
    }

    /// Returns an integer uniform in 0 to `count` - 1.
    pub(super) fn below(&mut self, count: u64) -> u64 {
        self.bits() % count.max(1)
    }

    /// Returns true with this probability.
    pub(super) fn chance(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }

    pub(super) fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }

    /// Returns a phase, rad.
    pub(super) fn phase(&mut self) -> f64 {
        self.between(0.0, std::f64::consts::TAU)
    }

    /// Returns one of several choices with weights.
    pub(super) fn among<T: Copy>(&mut self, choices: &[(f64, T)], otherwise: T) -> T {
        let sum: f64 = choices.iter().map(|(weight, _)| weight).sum();
        let mut left = self.between(0.0, sum);
        for (weight, choice) in choices {
            left -= weight;
            if left < 0.0 {
                return *choice;
            }
        }
        otherwise
    }
}

#[cfg(test)]
mod tests {
    use super::Draw;

    #[test]
    fn numbers_are_those_of_the_published_generator() {
        // The first three outputs for the state 1234567 (Rosetta Code, Pseudo-random numbers/Splitmix64).
        let mut draw = Draw(1_234_567);
        let expected = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!([draw.bits(), draw.bits(), draw.bits()], expected);
    }

    #[test]
    fn choices_come_as_often_as_they_weigh() {
        let mut draw = Draw::new(7);
        let rare = (0..10_000).filter(|_| draw.among(&[(1.0, true), (9.0, false)], false)).count();
        assert!((800..1200).contains(&rare), "{rare}");
        assert!((0..1000).all(|_| (2.0..3.0).contains(&draw.between(2.0, 3.0))));
    }
}
