//! Logarithmic creep law L(t) = L₁[1 + γ lg(t/t₀)] as a sum of exponentials.

use nalgebra::{DMatrix, DVector};

/// Logarithmic creep after a step at t = 0, L(t) = L₁[1 + γ lg(t/t₀)], approximated by a sum of exponentials:
///
/// ```text
/// L(t)/L₁ = 1 + γ{c₀ + Σ cᵢ[1 - exp(-t/τᵢ)]}
/// ```
///
/// The time constants are τᵢ = 10^{0.1}·t₀·10^{iD/(n-1)}, i = 0 … n-1, with n = D + 2 for D decades after t₀. The cᵢ are a
/// least-squares fit of lg(t/t₀) over these decades. [`Creep::misfit`] is the largest error of the fit. This error is 0.0086 decades
/// for D = 5 and at most 0.01 decades.
///
/// The response to a step starts at 1 + c₀γ with c₀ from -0.58 to -0.54. Beyond the last decade the response settles within one decade. The
/// model is linear in the input.
///
/// Source: Kuhnen and Krejčí, IEEE Transactions on Automatic Control 54 (2009) 537; for the logarithm: Jung and Gweon, Review of Scientific
/// Instruments 71 (2000) 1896.
#[derive(Debug, Clone, PartialEq)]
pub struct Creep {
    /// Immediate response to a unit step, 1 + γ c₀.
    direct: f64,
    /// Time constants τᵢ, s.
    times: Vec<f64>,
    /// Weights γ cᵢ.
    weights: Vec<f64>,
    misfit: f64,
}

/// Reason why creep parameters are invalid.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CreepError {
    /// The creep per decade γ is out of range.
    #[error("expected creep above 0 and below {most} per decade, got {got}", most = Creep::STRONGEST)]
    Strength {
        /// Value of γ that was given.
        got: f64,
    },
    /// The time t₀ is not above 0 or not finite.
    #[error("expected a time above 0 for the start of creep, got {0} s")]
    From(f64),
    /// The number of decades D is out of range.
    #[error("expected 1 to {most} decades, got {got}", most = Creep::LONGEST)]
    Decades {
        /// Number of decades that was given.
        got: usize,
    },
}

/// Offset of the first and last time constant from the start and end of the decades, lg(τ₀/t₀).
const BEYOND: f64 = 0.1;
/// Number of fit points per decade.
const PER_DECADE: usize = 48;

impl Creep {
    /// Default time t₀ after a step at which creep starts, s.
    pub const FROM: f64 = 0.1;
    /// Default number of decades.
    pub const DECADES: usize = 5;
    /// Largest number of decades.
    pub const LONGEST: usize = 6;
    /// Upper limit of the creep per decade γ.
    pub const STRONGEST: f64 = 0.5;

    /// Creates the law from the creep γ per decade, the time t₀ in s, and the number of decades.
    ///
    /// # Errors
    ///
    /// Fails if a parameter is out of its range.
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

    /// Returns the immediate response to a step, relative to L₁.
    pub fn direct(&self) -> f64 {
        self.direct
    }

    /// Returns the final response to a step, relative to L₁.
    pub fn settled(&self) -> f64 {
        self.direct + self.weights.iter().sum::<f64>()
    }

    /// Returns the time constants τᵢ, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Returns the weights γ cᵢ of the exponentials, relative to L₁.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Returns the largest difference between the sum of exponentials and the logarithm within the fitted decades, relative to L₁.
    pub fn misfit(&self) -> f64 {
        self.misfit
    }

    /// Returns L(t)/L₁ at time t after a step, s.
    pub fn response(&self, t: f64) -> f64 {
        let crept =
            self.times.iter().zip(&self.weights).map(|(time, weight)| -weight * math::exp_m1(-t / time));
        self.direct + crept.sum::<f64>()
    }
}

/// Fits c₀ and the cᵢ for given lg τᵢ/t₀ by least squares. Returns the coefficients and the largest error in decades.
fn fitted(decades: usize, logs: &[f64]) -> (Vec<f64>, f64) {
    let places: Vec<f64> = (0..=decades * PER_DECADE).map(|i| i as f64 / PER_DECADE as f64).collect();
    let term = |i: usize, j: usize| match j {
        0 => 1.0,
        _ => -math::exp_m1(-math::powf(10.0, places[i] - logs[j - 1])),
    };
    let matrix = DMatrix::from_fn(places.len(), logs.len() + 1, term);
    let wanted = DVector::from_vec(places);
    // The time constants are at least a third of a decade apart, so the matrix is well conditioned.
    let weights =
        matrix.clone().svd(true, true).solve(&wanted, 0.0).unwrap_or_else(|_| DVector::zeros(logs.len() + 1));
    let misfit = (matrix * &weights - wanted).amax();
    (weights.as_slice().to_vec(), misfit)
}

#[cfg(test)]
mod tests;
