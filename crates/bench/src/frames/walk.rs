//! Inputs that change in every frame: seeded random walks within their ranges.

use stickslip_realtime::plant::{Input, Takes};

/// Seed of all walks.
const SEED: u64 = 0x5EED_2026;

/// Returns the range of an input. Signs and counts keep their initial value.
fn range(input: &Input) -> (f64, f64) {
    match input.takes {
        Takes::Range(low, high) => (low, high),
        Takes::Sign | Takes::Count => (input.initial, input.initial),
    }
}

/// Random walks of all inputs. In each frame a value changes by at most a fraction of half its range and is reflected at its limits.
/// Equal frame numbers give equal values.
#[derive(Debug, Clone)]
pub(super) struct Walk {
    seed: u64,
    ranges: Vec<(f64, f64)>,
    share: f64,
    values: Vec<f64>,
}

impl Walk {
    /// Returns walks that start at the initial values.
    pub(super) fn new(inputs: &[Input], share: f64) -> Self {
        Self {
            seed: SEED,
            ranges: inputs.iter().map(range).collect(),
            share,
            values: inputs.iter().map(|input| input.initial).collect(),
        }
    }

    /// Returns the current values.
    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// Advances to the next frame without allocation.
    pub(super) fn step(&mut self) {
        for place in 0..self.values.len() {
            let (low, high) = self.ranges[place];
            let reach = 0.5 * self.share * (high - low);
            let value = self.values[place] + reach * (2.0 * self.draw() - 1.0);
            // Reflected, because a value that stays at its limit would not change.
            let turned = if value > high { 2.0 * high - value } else { value };
            let turned = if turned < low { 2.0 * low - turned } else { turned };
            self.values[place] = turned.clamp(low, high);
        }
    }

    /// Returns a uniform random number in [0, 1): SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
    fn draw(&mut self) -> f64 {
        self.seed = self.seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.seed;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / 2_f64.powi(53)
    }
}

#[cfg(test)]
mod tests {
    use super::Walk;
    use std::path::Path;
    use stickslip_realtime::plant::inputs;
    use stickslip_run::Job;

    #[test]
    fn a_walk_moves_in_every_frame_and_stays_in_its_range() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/realtime/contacts_1.json");
        let job = Job::prepare(&file, &[], Path::new("")).unwrap();
        let mut walk = Walk::new(&inputs(&job.scenario.scene).unwrap(), 0.5);
        let (mut low, mut high, mut mean) = (0.0_f64, 0.0_f64, 0.0);
        for _ in 0..10_000 {
            let before = walk.values()[0];
            walk.step();
            let now = walk.values()[0];
            assert!(now != before && (now - before).abs() <= 0.25e-6 && now.abs() <= 0.5e-6, "{now:e}");
            (low, high, mean) = (low.min(now), high.max(now), mean + 1e-4 * now);
        }
        assert!(low < -0.45e-6 && high > 0.45e-6 && mean.abs() < 0.05e-6, "{low:e}, {high:e}, {mean:e}");
    }
}
