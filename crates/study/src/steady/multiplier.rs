//! Floquet multipliers, and what they mean.
//!
//! A disturbance along an eigenvector of the gradient of a period's map comes back λ times as large. |λ| says how it fades or
//! grows, the angle of λ how it turns: a beat of 2π/|arg λ| periods, or a change of sides every period where λ < 0.
//!
//! A gradient that is off by δA moves an eigenvalue by κ δA, 1/κ = |y* x| of its left and right eigenvectors of length 1 (G. W. Stewart and
//! J. Sun, Matrix Perturbation Theory, 1990, sec. IV.2.2). Where two are one with one eigenvector, as of a body that bounces by itself as long as a period lasts,
//! they part by the root of δA, and κ is as large as its inverse.

use super::map::Gradient;
use nalgebra::{Complex, ComplexField, DMatrix, SVD, Schur};
use std::f64::consts::TAU;

/// To which share of its neighbours the eigenvalue iteration lets an entry go.
// With the first alone it did not come to an end for eight numbers that come back as they are, and none of 19 multipliers was told.
const WITHIN: [f64; 3] = [f64::EPSILON, 1e-14, 1e-12];
/// Sweeps of the eigenvalue iteration per row.
const SWEEPS: usize = 100;
/// A modulus this near to 1 neither fades nor grows: what a gradient is exact to that variations tell.
const NEUTRAL: f64 = 1e-6;
/// How far entries of a gradient may be off, as a share of the size of all, in tolerances of the runs or in defects.
// Of six bodies that bounce by themselves twins parted at tolerances of 1e-13 to 1e-8 as if by up to 12.
const ENTRIES: f64 = 20.0;
/// A modulus that is off by more may say anything of what stays as it is.
const KNOWN: f64 = 1e-4;
/// A multiplier below is forgotten within the period.
const FORGOTTEN: f64 = 1e-3;
/// An angle this small, or this near to π, is none but for rounding.
const ANGLE: f64 = 1e-6;

/// An eigenvalue of the gradient of a period's map.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part, at least 0: of a pair, the one above.
    pub im: f64,
    /// How far it may be off: a modulus this near to 1 neither fades nor grows.
    pub error: f64,
}

/// What becomes of a disturbance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// It is gone after a period.
    Forgotten,
    /// It fades.
    Fades,
    /// It stays as it is.
    Stays,
    /// It grows: a run leaves this motion.
    Grows,
}

impl Multiplier {
    /// |λ|.
    #[must_use]
    pub fn modulus(&self) -> f64 {
        math::hypot(self.re, self.im)
    }

    /// How far it may be off, where that is more than its six digits.
    #[must_use]
    pub fn doubt(&self) -> Option<f64> {
        (self.error > NEUTRAL).then_some(self.error)
    }

    /// What becomes of a disturbance along it.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self.modulus() {
            modulus if modulus < FORGOTTEN => Kind::Forgotten,
            modulus if modulus < 1.0 - self.error => Kind::Fades,
            modulus if modulus <= 1.0 + self.error => Kind::Stays,
            _ => Kind::Grows,
        }
    }

    /// Periods of a beat, more than 2; none where a disturbance does not turn, or changes sides every period.
    #[must_use]
    pub fn beat(&self) -> Option<f64> {
        let angle = math::atan2(self.im, self.re).abs();
        let least = ANGLE.max(self.error / self.modulus());
        (angle > least && angle < 0.5 * TAU - least).then(|| TAU / angle)
    }

    /// Whether a disturbance changes sides every period.
    #[must_use]
    pub fn alternates(&self) -> bool {
        self.beat().is_none() && self.re < 0.0
    }

    /// Periods after which a disturbance is e times smaller, or larger where it grows; none where it stays, or is forgotten.
    #[must_use]
    pub fn periods(&self) -> Option<f64> {
        match self.kind() {
            Kind::Fades | Kind::Grows => Some(1.0 / math::ln(self.modulus()).abs()),
            Kind::Forgotten | Kind::Stays => None,
        }
    }

    /// In words.
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
            Kind::Forgotten => "is gone after a period".to_owned(),
            Kind::Fades => format!("decays by {change} % per period (time constant {periods} periods)"),
            Kind::Stays if self.error > KNOWN => {
                format!("is neutral, decays or grows: |λ| is known to ± {} only", digits(self.error))
            }
            Kind::Stays => "neither decays nor grows".to_owned(),
            Kind::Grows => format!(
                "grows by {change} % per period (time constant {periods} periods): a run leaves this motion"
            ),
        };
        turns + &becomes
    }
}

/// Three digits that count.
fn digits(x: f64) -> String {
    if !x.is_finite() || x == 0.0 {
        return x.to_string();
    }
    // Rounded first: 0.09996 has the places of 0.1.
    let x: f64 = format!("{x:.2e}").parse().unwrap_or(x);
    let places = (2 - math::log10(x.abs()).floor() as i32).clamp(0, 12);
    format!("{x:.*}", usize::try_from(places).unwrap_or(0))
}

/// The multipliers of a gradient that was led along by runs of a tolerance near a fixed point, where so large a defect is left, the
/// largest first; of a pair one stands for both. None where its numbers are not finite.
///
/// Where columns are not known those of the others are multipliers as long as none of the others moves what is not known: the gradient is
/// then a triangle of blocks. Else there are none.
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

/// How far an eigenvalue may be off where entries may be by so much: κ times that, and no more than a double one.
fn moved(matrix: &DMatrix<f64>, value: Complex<f64>, entries: f64) -> f64 {
    let count = matrix.nrows();
    let shifted =
        matrix.map(|entry| Complex::new(entry, 0.0)) - DMatrix::from_diagonal_element(count, count, value);
    let svd = SVD::try_new(shifted, true, true, f64::EPSILON, count * SWEEPS);
    let double = (entries * matrix.norm()).sqrt();
    svd.and_then(|svd| svd.u.zip(svd.v_t)).map_or(double, |(left, right)| {
        // Those of the least singular value, which is 0 but for rounding.
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
            "grows by 0.100 % per period (time constant 1000 periods): a run leaves this motion"
        );
        assert_eq!(
            words(-0.5),
            "alternates in sign and decays by 50.0 % per period (time constant 1.44 periods)"
        );
        assert_eq!(
            (words(1.0).as_str(), words(1e-4).as_str()),
            ("neither decays nor grows", "is gone after a period")
        );
        // Differences that may be off by 1e-3 say nothing of a ten-thousandth.
        let coarse = |re: f64| Multiplier { re, im: 0.0, error: 1e-3 }.kind();
        assert_eq!((coarse(1.0001), coarse(0.9999), coarse(1.01)), (Kind::Stays, Kind::Stays, Kind::Grows));
    }

    /// A body that bounces by itself: what it is late by stays, and grows with what its bounce is too long by. Rounding parts its two
    /// multipliers by the root of that. Those of a turn that grows by as much stand alone, and are told.
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
