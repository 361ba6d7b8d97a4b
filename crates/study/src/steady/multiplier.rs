//! Floquet multipliers of a periodic orbit.
//!
//! A disturbance along an eigenvector of the Jacobian of the Poincaré map is multiplied by λ per period. The disturbance decays if |λ| < 1
//! and grows if |λ| > 1. The disturbance oscillates with a period of 2π/|arg λ| drive periods, or alternates in sign if λ < 0.
//!
//! An error δA of the Jacobian changes an eigenvalue by κ δA, where 1/κ = |y* x| for its left and right unit eigenvectors (Stewart and Sun,
//! *Matrix Perturbation Theory*, 1990, section IV.2.2). A double eigenvalue with one eigenvector, as of an undamped bouncing body, changes
//! by √δA, and κ is about 1/√δA.

use super::map::Gradient;
use nalgebra::{Complex, ComplexField, DMatrix, SVD, Schur};
use std::f64::consts::TAU;

/// Relative tolerances of the Schur decomposition, tried in this order.
const WITHIN: [f64; 3] = [f64::EPSILON, 1e-14, 1e-12];
/// Iterations of the Schur decomposition per row.
const SWEEPS: usize = 100;
/// Smallest error of a multiplier. A multiplier whose modulus differs from 1 by less than this error is neutral.
const NEUTRAL: f64 = 1e-6;
/// Error of the entries of the Jacobian relative to its norm, as a multiple of the tolerance or of the remaining defect.
const ENTRIES: f64 = 20.0;
/// Error of |λ| above which a neutral multiplier is described as uncertain.
const KNOWN: f64 = 1e-4;
/// Modulus below which a disturbance counts as vanishing within a period.
const FORGOTTEN: f64 = 1e-3;
/// Arguments of a multiplier that differ from 0 or π by less than this angle are due to rounding errors.
const ANGLE: f64 = 1e-6;

/// Floquet multiplier: an eigenvalue of the Jacobian of the Poincaré map.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part, not negative; one entry represents both multipliers of a complex pair.
    pub im: f64,
    /// Error of the multiplier. A multiplier whose modulus differs from 1 by less than this error is neutral.
    pub error: f64,
}

/// Behaviour of a disturbance along the eigenvector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The disturbance vanishes within a period.
    Forgotten,
    /// It decays.
    Fades,
    /// The disturbance is neutral: it neither decays nor grows.
    Stays,
    /// The disturbance grows: a run leaves this orbit.
    Grows,
}

impl Multiplier {
    /// Returns the modulus |λ|.
    #[must_use]
    pub fn modulus(&self) -> f64 {
        math::hypot(self.re, self.im)
    }

    /// Returns the error if it is visible in the six digits of the output.
    #[must_use]
    pub fn doubt(&self) -> Option<f64> {
        (self.error > NEUTRAL).then_some(self.error)
    }

    /// Returns whether a disturbance along the eigenvector decays, is neutral or grows.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self.modulus() {
            modulus if modulus < FORGOTTEN => Kind::Forgotten,
            modulus if modulus < 1.0 - self.error => Kind::Fades,
            modulus if modulus <= 1.0 + self.error => Kind::Stays,
            _ => Kind::Grows,
        }
    }

    /// Returns the period of the oscillation in drive periods, more than 2. Returns `None` if the disturbance does not oscillate or
    /// alternates in sign.
    #[must_use]
    pub fn beat(&self) -> Option<f64> {
        let angle = math::atan2(self.im, self.re).abs();
        let least = ANGLE.max(self.error / self.modulus());
        (angle > least && angle < 0.5 * TAU - least).then(|| TAU / angle)
    }

    /// Returns whether a disturbance alternates in sign from period to period.
    #[must_use]
    pub fn alternates(&self) -> bool {
        self.beat().is_none() && self.re < 0.0
    }

    /// Returns the time constant in drive periods, in which a disturbance changes by a factor of e. Returns `None` if the disturbance is
    /// neutral or vanishes within a period.
    #[must_use]
    pub fn periods(&self) -> Option<f64> {
        match self.kind() {
            Kind::Fades | Kind::Grows => Some(1.0 / math::ln(self.modulus()).abs()),
            Kind::Forgotten | Kind::Stays => None,
        }
    }

    /// Returns a description.
    #[must_use]
    pub fn words(&self) -> String {
        let turns = match self.beat() {
            _ if self.kind() == Kind::Forgotten => String::new(),
            Some(beat) => format!("oscillates with a period of {} drive periods and ", digits(beat)),
            None if self.alternates() => "alternates in sign and ".to_owned(),
            None => String::new(),
        };
        let change = digits(100.0 * (self.modulus() - 1.0).abs());
        let periods = self.periods().map_or_else(String::new, digits);
        let becomes = match self.kind() {
            Kind::Forgotten => "vanishes within a period".to_owned(),
            Kind::Fades => format!("decays by {change} % per period (time constant {periods} periods)"),
            Kind::Stays if self.error > KNOWN => {
                format!("is neutral, decays or grows: the error of |λ| is ± {}", digits(self.error))
            }
            Kind::Stays => "neither decays nor grows".to_owned(),
            Kind::Grows => format!(
                "grows by {change} % per period (time constant {periods} periods): a run leaves this orbit"
            ),
        };
        turns + &becomes
    }
}

/// Formats a number with three significant digits.
fn digits(x: f64) -> String {
    if !x.is_finite() || x == 0.0 {
        return x.to_string();
    }
    // The number is rounded first, because 0.09996 has as many decimal places as 0.1.
    let x: f64 = format!("{x:.2e}").parse().unwrap_or(x);
    let places = (2 - math::log10(x.abs()).floor() as i32).clamp(0, 12);
    format!("{x:.*}", usize::try_from(places).unwrap_or(0))
}

/// Returns the multipliers of a Jacobian in descending order of modulus, one for each complex pair.
///
/// `tolerance` is the tolerance of the runs, `defect` the remaining defect of the fixed point. Columns of unknown effect are excluded if
/// the other unknowns do not influence them, because the Jacobian is then block triangular. Otherwise, or if entries are not finite, no
/// multipliers are returned.
pub(super) fn of(gradient: &Gradient, (tolerance, defect): (f64, f64)) -> Vec<Multiplier> {
    let size = gradient.numbers.norm();
    let entries = ENTRIES * tolerance.max(defect) * size + gradient.missed + Gradient::noise(tolerance);
    let known: Vec<usize> = (0..gradient.numbers.ncols()).filter(|j| !gradient.unknown.contains(j)).collect();
    let columns = gradient.numbers.select_columns(&known);
    if gradient.unknown.iter().any(|i| columns.row(*i).amax() > entries.max(NEUTRAL)) {
        return Vec::new();
    }
    let numbers = columns.select_rows(&known);
    let error = |value| NEUTRAL.max(moved(&numbers, value, entries));
    let mut all: Vec<Multiplier> = eigenvalues(&numbers)
        .into_iter()
        .filter(|value| value.im >= 0.0)
        .map(|value| Multiplier { re: value.re, im: value.im, error: error(value) })
        .collect();
    all.sort_by(|a, b| b.modulus().total_cmp(&a.modulus()));
    all
}

/// Returns the error of an eigenvalue for a given error of the entries: κ times this error, at most the error of a double eigenvalue.
fn moved(matrix: &DMatrix<f64>, value: Complex<f64>, entries: f64) -> f64 {
    let count = matrix.nrows();
    let shifted =
        matrix.map(|entry| Complex::new(entry, 0.0)) - DMatrix::from_diagonal_element(count, count, value);
    let svd = SVD::try_new(shifted, true, true, f64::EPSILON, count * SWEEPS);
    let double = (entries * matrix.norm()).sqrt();
    svd.and_then(|svd| svd.u.zip(svd.v_t)).map_or(double, |(left, right)| {
        // The singular vectors belong to the smallest singular value, which is 0 except for rounding.
        let (y, x) = (left.column(count - 1), right.row(count - 1));
        let product: Complex<f64> = y.iter().zip(x.iter()).map(|(y, x)| y * x).sum();
        (entries / product.modulus()).min(double)
    })
}

fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<Complex<f64>> {
    if matrix.is_empty() || !matrix.iter().all(|entry| entry.is_finite()) {
        return Vec::new();
    }
    let solve = |within: f64| Schur::try_new(matrix.clone(), within, matrix.nrows() * SWEEPS);
    WITHIN
        .into_iter()
        .find_map(solve)
        .map_or_else(Vec::new, |schur| schur.complex_eigenvalues().iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn led(numbers: DMatrix<f64>) -> Gradient {
        let way = DMatrix::zeros(0, numbers.ncols());
        Gradient { numbers, way, unknown: Vec::new(), missed: 0.0 }
    }

    #[test]
    fn a_turn_that_shrinks_beats_and_fades() {
        let (modulus, angle) = (0.9967_f64, TAU / 12.3);
        let turn = DMatrix::from_row_slice(2, 2, &[angle.cos(), -angle.sin(), angle.sin(), angle.cos()]);
        let multipliers = of(&led(turn * modulus), (1e-12, 0.0));
        assert_eq!(multipliers.len(), 1);
        let words = multipliers[0].words();
        assert_eq!(
            words,
            "oscillates with a period of 12.3 drive periods and decays by 0.330 % per period (time constant 303 periods)"
        );
    }

    #[test]
    fn what_grows_and_what_changes_sides_is_told() {
        let words = |re: f64| Multiplier { re, im: 0.0, error: NEUTRAL }.words();
        assert_eq!(
            words(1.001),
            "grows by 0.100 % per period (time constant 1000 periods): a run leaves this orbit"
        );
        assert_eq!(
            words(-0.5),
            "alternates in sign and decays by 50.0 % per period (time constant 1.44 periods)"
        );
        assert_eq!(
            (words(1.0).as_str(), words(1e-4).as_str()),
            ("neither decays nor grows", "vanishes within a period")
        );
        // An error of 1e-3 does not decide about growth by 1e-4.
        let coarse = |re: f64| Multiplier { re, im: 0.0, error: 1e-3 }.kind();
        assert_eq!((coarse(1.0001), coarse(0.9999), coarse(1.01)), (Kind::Stays, Kind::Stays, Kind::Grows));
    }

    /// An undamped bouncing body has a double eigenvalue 1 with one eigenvector; an error splits it by its square root. The multipliers of
    /// a growing rotation are simple and have a small error.
    #[test]
    fn two_that_are_one_part_by_a_root() {
        let late = |off: f64| led(DMatrix::from_row_slice(2, 2, &[1.0, 3.0, off, 1.0]));
        for (tolerance, off) in [(1e-12, 3e-12), (1e-9, 3e-9)] {
            let kinds = of(&late(off), (tolerance, 0.0)).iter().map(Multiplier::kind).collect::<Vec<_>>();
            assert_eq!(kinds, [Kind::Stays; 2], "{tolerance}");
            let kinds = of(&late(-off), (tolerance, 0.0)).iter().map(Multiplier::kind).collect::<Vec<_>>();
            assert_eq!(kinds, [Kind::Stays], "{tolerance}");
        }
        let (modulus, angle) = (1.000_003_f64, 0.4_f64);
        let turn = DMatrix::from_row_slice(2, 2, &[angle.cos(), -angle.sin(), angle.sin(), angle.cos()]);
        assert_eq!(of(&led(turn * modulus), (1e-12, 0.0))[0].kind(), Kind::Grows);
    }
}
