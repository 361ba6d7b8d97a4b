//! Eigenvalues (rates) of small motions with stuck contacts, and detection of stiff models.

use crate::Model;
use nalgebra::{Complex, ComplexField};
use std::f64::consts::FRAC_PI_2;

/// Ratio -Re λ/|λ| above which a motion e^{λt} counts as decaying, not oscillating.
const FADES: f64 = 0.5;
/// Ratio of the fastest decay rate to all other rates above which a model is stiff.
// Below this ratio explicit steps are as cheap as implicit ones.
const STIFF: f64 = 100.0;

/// Largest eigenvalues of small motions with stuck contacts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Paces {
    /// Largest |λ| of the motions e^{λt} of bodies, 1/s.
    pub(crate) fastest: f64,
    /// Largest |λ| of the decaying motions, 1/s; 0 if no motion decays.
    pub(crate) fading: f64,
    /// Whether the fastest decay, including states of blocks, is much faster than all oscillations and waveforms.
    pub(crate) stiff: bool,
}

/// Rates of small motions, 1/s.
#[derive(Default)]
struct Rates {
    /// Largest rate of a decaying motion.
    fading: f64,
    /// Largest rate of an oscillating motion.
    lasting: f64,
    /// Smallest rate.
    least: Option<f64>,
}

impl Model {
    /// Returns the largest eigenvalues with all contacts stuck at their largest indentation, as bounds for the whole run.
    pub(crate) fn paces(&self) -> Paces {
        let (mut fastest, mut all) = (0.0_f64, Rates::default());
        if let Some(frequency) = self.only_frequency() {
            fastest = frequency;
            all.add(&Complex { re: 0.0, im: frequency });
        } else {
            for part in self.parts(|d| d.most) {
                let frequency = part.highest_frequency();
                fastest = fastest.max(frequency);
                // Without dampers λ = ±iω: a symmetric matrix of half the size suffices.
                if part.damping.amax() == 0.0 {
                    all.add(&Complex { re: 0.0, im: frequency });
                    continue;
                }
                for rate in part.rates(if frequency > 0.0 { frequency } else { 1.0 }) {
                    fastest = fastest.max(rate.modulus());
                    all.add(&rate);
                }
            }
        }
        let fading = all.fading;
        self.block_eigenvalues().iter().for_each(|rate| all.add(rate));
        Paces { fastest, fading, stiff: all.fading > 0.0 && all.fading > STIFF * all.pace(self) }
    }
}

impl Rates {
    fn add(&mut self, rate: &Complex<f64>) {
        let size = rate.modulus();
        if size == 0.0 {
            return;
        }
        if -rate.re >= FADES * size {
            self.fading = self.fading.max(size);
        } else {
            self.lasting = self.lasting.max(size);
        }
        self.least = Some(self.least.map_or(size, |least| least.min(size)));
    }

    /// Returns the largest rate of oscillations and waveforms, 1/s; without oscillations and waveforms, the smallest rate.
    fn pace(&self, model: &Model) -> f64 {
        let waves = model.waveforms.iter().flat_map(|waveform| {
            [std::f64::consts::TAU / waveform.extent(), FRAC_PI_2 / waveform.resolution()]
        });
        let pace = waves.fold(self.lasting, f64::max);
        if pace > 0.0 { pace } else { self.least.unwrap_or(f64::INFINITY) }
    }
}
