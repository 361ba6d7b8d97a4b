//! How fast the small motions of a scene go, and whether some of them are stiff.

use crate::Model;
use nalgebra::{Complex, ComplexField};
use std::f64::consts::FRAC_PI_2;

/// Share of a motion e^{λt} that is decay, -Re λ/|λ|, from which on it is gone before it has swung.
const FADES: f64 = 0.5;
/// How many times faster than all else a motion must fade to be stiff.
// Until then explicit steps, which follow it, are no more work than implicit ones, which solve equations to ignore it.
const STIFF: f64 = 100.0;

/// How fast small motions go.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Paces {
    /// Largest |λ|, 1/s, of the motions e^{λt} of bodies.
    pub(crate) fastest: f64,
    /// The same of those that fade, 0 without any.
    pub(crate) fading: f64,
    /// Whether the fastest of all motions that fade, states of blocks among them, is far faster than what does not fade and
    /// what the waveforms do.
    pub(crate) stiff: bool,
}

/// Rates of a scene, 1/s.
#[derive(Default)]
struct Rates {
    /// Largest of a motion that fades.
    fading: f64,
    /// Largest of one that swings on.
    lasting: f64,
    /// Smallest of all.
    least: Option<f64>,
}

impl Model {
    /// With all contacts stuck and as deep as they get: stiffness grows with the indentation, and a bound must hold throughout
    /// the run.
    pub(crate) fn paces(&self) -> Paces {
        let (mut fastest, mut all) = (0.0_f64, Rates::default());
        if let Some(frequency) = self.only_frequency() {
            fastest = frequency;
            all.add(&Complex { re: 0.0, im: frequency });
        } else {
            for part in self.parts(|d| d.most) {
                let frequency = part.highest_frequency();
                fastest = fastest.max(frequency);
                // Without dampers λ = ±iω: the symmetric matrix is half as large and exact to rounding.
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

    /// What goes on beside that which fades, 1/s: the fastest swing, the waveforms' periods and waves. Where there is nothing of
    /// all that, the slowest motion.
    fn pace(&self, model: &Model) -> f64 {
        let waves = model.waveforms.iter().flat_map(|waveform| {
            [std::f64::consts::TAU / waveform.extent(), FRAC_PI_2 / waveform.resolution()]
        });
        let pace = waves.fold(self.lasting, f64::max);
        if pace > 0.0 { pace } else { self.least.unwrap_or(f64::INFINITY) }
    }
}
