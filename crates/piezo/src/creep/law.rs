//! L(t) = L₁[1 + γ lg(t/t₀)] as a sum of exponentials.

use nalgebra::{DMatrix, DVector};

/// Creep after a step at t = 0: L(t) = L₁[1 + γ lg(t/t₀)], by
///
/// ```text
/// L(t)/L₁ = 1 + γ{c₀ + Σ cᵢ[1 - exp(-t/τᵢ)]}
/// ```
///
/// with τᵢ = 10^{0.1}·t₀·10^{iD/(n-1)}, i = 0 … n-1, n = D + 2 for D decades from t₀ on. The cᵢ are the least squares of lg(t/t₀) over
/// those decades; [`Creep::misfit`] is what they leave, 0.0086 decades for D = 5 and at most 0.01, so that the stroke is off
/// by at most 0.01 γ L₁ (2 % per decade: 2e-4 of the stroke). Before t₀ the response begins at 1 + c₀γ (c₀ = -0.54 to -0.58) instead of falling for
/// ever; beyond the last decade it settles within another one and stays, where the law would grow for ever. Both ends are
/// physics, too: the logarithm is a fit, made between about 0.1 s and hours.
///
/// In between the response to any input is that sum, linear in it: a stack that has stood at a voltage for long has crept, and
/// creeps back when it is taken away.
///
/// Source: K. Kuhnen, P. Krejčí, IEEE Transactions on Automatic Control 54 (2009) 537; the logarithm: H. Jung, D.-G. Gweon,
/// Review of Scientific Instruments 71 (2000) 1896.
#[derive(Debug, Clone, PartialEq)]
pub struct Creep {
    /// γ c₀ + 1: what answers at once.
    direct: f64,
    /// τᵢ, s.
    times: Vec<f64>,
    /// γ cᵢ.
    weights: Vec<f64>,
    misfit: f64,
}

/// Why a law cannot be.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CreepError {
    /// γ.
    #[error("expected creep above 0 and below {most} per decade, got {got}", most = Creep::STRONGEST)]
    Strength {
        /// As given.
        got: f64,
    },
    /// t₀.
    #[error("expected a time above 0 from which on it creeps, got {0} s")]
    From(f64),
    /// D.
    #[error("expected 1 to {most} decades, got {got}", most = Creep::LONGEST)]
    Decades {
        /// As given.
        got: usize,
    },
}

/// lg(τ₀/t₀), and by how much the last τ lies beyond the last decade: least misfit among tenths, for 5 decades.
const BEYOND: f64 = 0.1;
/// Places per decade at which the logarithm is fitted.
const PER_DECADE: usize = 48;

impl Creep {
    /// Usual t₀, s.
    pub const FROM: f64 = 0.1;
    /// Usual number of decades.
    pub const DECADES: usize = 5;
    /// Most decades: states of a block are few.
    pub const LONGEST: usize = 6;
    /// Largest γ.
    pub const STRONGEST: f64 = 0.5;

    /// With γ per decade, from t₀ on (s), over a number of decades.
    ///
    /// # Errors
    ///
    /// Where one of them is out of its range.
    pub fn new(per_decade: f64, from: f64, decades: usize) -> Result<Self, CreepError> {
        if !(per_decade > 0.0 && per_decade < Self::STRONGEST) {
            return Err(CreepError::Strength { got: per_decade });
        }
        if !(from > 0.0 && from < f64::INFINITY) {
            return Err(CreepError::From(from));
        }
        if !(1..=Self::LONGEST).contains(&decades) {
            return Err(CreepError::Decades { got: decades });
        }
        let span = decades as f64;
        let last = (decades + 1) as f64;
        let logs: Vec<f64> = (0..decades + 2).map(|i| BEYOND + span * i as f64 / last).collect();
        let (weights, misfit) = fitted(decades, &logs);
        Ok(Self {
            direct: 1.0 + per_decade * weights[0],
            times: logs.iter().map(|log| from * math::powf(10.0, *log)).collect(),
            weights: weights[1..].iter().map(|c| per_decade * c).collect(),
            misfit: per_decade * misfit,
        })
    }

    /// What answers to a step at once, in parts of L₁.
    pub fn direct(&self) -> f64 {
        self.direct
    }

    /// What answers to it in the end, in parts of L₁.
    pub fn settled(&self) -> f64 {
        self.direct + self.weights.iter().sum::<f64>()
    }

    /// τᵢ, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Parts of L₁ that come with them.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Largest distance from the logarithm over the decades of the fit, in parts of L₁.
    pub fn misfit(&self) -> f64 {
        self.misfit
    }

    /// L(t)/L₁ at a time after a step, s.
    pub fn response(&self, t: f64) -> f64 {
        let crept =
            self.times.iter().zip(&self.weights).map(|(time, weight)| -weight * math::exp_m1(-t / time));
        self.direct + crept.sum::<f64>()
    }
}

/// c₀ and the cᵢ for lg τᵢ/t₀, by least squares, and what they leave at most, decades.
fn fitted(decades: usize, logs: &[f64]) -> (Vec<f64>, f64) {
    let places: Vec<f64> = (0..=decades * PER_DECADE).map(|i| i as f64 / PER_DECADE as f64).collect();
    let term = |i: usize, j: usize| match j {
        0 => 1.0,
        _ => -math::exp_m1(-math::powf(10.0, places[i] - logs[j - 1])),
    };
    let matrix = DMatrix::from_fn(places.len(), logs.len() + 1, term);
    let wanted = DVector::from_vec(places);
    // Well conditioned, by a third of a decade and more from one to the next: the singular values never vanish.
    let weights =
        matrix.clone().svd(true, true).solve(&wanted, 0.0).unwrap_or_else(|_| DVector::zeros(logs.len() + 1));
    let misfit = (matrix * &weights - wanted).amax();
    (weights.as_slice().to_vec(), misfit)
}

#[cfg(test)]
mod tests;
