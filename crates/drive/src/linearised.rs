//! Equations of motion linearised with all contacts stuck: M ẍ + C ẋ + K x = 0.
//!
//! Rows of the model's Jacobian give the displacements of contacts and springs: a stiffness k along a row a adds k aᵢaⱼ to K. A stuck
//! contact of radius a has the stiffness 2G\*a along the slide and, if bodies press it, 2E\*a along the normal. Slip reduces the stiffness,
//! so the highest frequency with stuck contacts limits time steps.

mod blocks;
mod frame;
mod inputs;
mod paces;
mod parts;
mod reach;

pub(crate) use blocks::eigenvalues as block_eigenvalues;
pub use inputs::LinearInput;
pub(crate) use paces::Paces;
pub(crate) use reach::Reach;

use crate::model::Terms;
use crate::{Model, Sample, State, Stepper};
use nalgebra::{Complex, ComplexField, DMatrix, DVector, Schur, SymmetricEigen};
use reach::{longest, rk4_reach};
use std::f64::consts::SQRT_2;

/// Largest number of sweeps of an eigenvalue iteration per row.
const SWEEPS: usize = 100;
/// Range of a contact's indentation, m; negative when open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Indentations {
    /// Smallest indentation at any time.
    pub least: f64,
    /// Indentation at t = 0.
    pub start: f64,
    /// Largest indentation at any time.
    pub most: f64,
}

/// Mass, damping and stiffness matrix of the free coordinates with all contacts stuck, the stiffest state of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearised {
    coordinates: Vec<String>,
    /// Displacement of each contact as a list of (index of the coordinate, displacement per coordinate).
    contacts: Vec<Row>,
    mass: DVector<f64>,
    damping: DMatrix<f64>,
    stiffness: DMatrix<f64>,
}

/// Normal mode.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalMode {
    /// Undamped angular frequency, rad/s; 0 for a free motion.
    pub frequency: f64,
    /// Damping ratio φᵀCφ/(2ω φᵀMφ), exact if damping does not couple the modes; 0 at frequency 0.
    pub damping_ratio: f64,
    /// Displacement of each coordinate in the mode; the largest displacement is 1.
    pub shape: Vec<f64>,
    /// Relative displacement u of each contact in the mode.
    pub contacts: Vec<f64>,
}

/// Displacement as a linear form of the coordinates.
type Row = Vec<(usize, f64)>;

impl Model {
    /// Returns the range of the indentation of contact `index` from a state at t = 0, including waveform tables beyond the end of the run.
    /// For a coupled contact the largest indentation is an estimate from the initial loads and motions.
    pub fn indentations(&self, state: &State, index: usize) -> Option<Indentations> {
        self.indentations_from(state.memories().get(index)?.apex().d, index)
    }

    /// Returns the range of a contact's indentation for a given indentation `start` at t = 0, m.
    fn indentations_from(&self, start: f64, index: usize) -> Option<Indentations> {
        let contact = self.contacts.get(index)?;
        let Some(waveform) = contact.press.waveform() else {
            // A coupled contact may open, or reach its natural depth.
            let coupled = contact.coupling().is_some();
            let (least, most) =
                if coupled { (start.min(0.0), contact.natural.depth.max(start)) } else { (start, start) };
            return Some(Indentations { least, start, most });
        };
        let at = |value| contact.pressed(Sample { value, rate: 0.0, acceleration: 0.0 }, None).0;
        let (low, high) = self.waveforms[waveform].range();
        Some(Indentations { least: at(low), start, most: at(high) })
    }

    /// Returns the linearised equations about a `state` with all contacts stuck, each at the indentation (m) that `depth` selects.
    pub fn linearised(&self, state: &State, depth: impl Fn(&Indentations) -> f64) -> Linearised {
        self.whole(|c| self.indentations(state, c).map_or(0.0, |d| depth(&d)))
    }

    /// Returns the resonance ω of contact `index` alone between its two bodies, rad/s, with all identical contacts stuck at indentation d
    /// (m). The square is ω² = k Σ 1/m over the free bodies. The result is 0 without friction, and `None` if neither body is free.
    pub fn contact_resonance(&self, index: usize, d: f64) -> Option<f64> {
        let contact = self.contacts.get(index)?;
        let mobility = contact.u.mobility(|i| self.free[i].mobility);
        let stiffness =
            if contact.inert { 0.0 } else { contact.count * contact.interface.stick_stiffness(d) };
        (mobility > 0.0).then(|| (stiffness * mobility).sqrt())
    }

    /// Returns the natural angular frequency of a single undamped coordinate at the largest indentations, rad/s, without a matrix.
    fn only_frequency(&self) -> Option<f64> {
        let [free] = &self.free[..] else { return None };
        let damped = self.links.iter().any(|link| link.damping != 0.0)
            || self.contacts.iter().any(|c| c.interface.damping() != 0.0 || c.normal_damping != 0.0);
        if damped {
            return None;
        }
        let along = |row: &Terms| row.first().map_or(0.0, |(_, a)| *a);
        let mut stiffness = 0.0;
        for link in &self.links {
            let a = along(&link.elongation.free);
            stiffness += link.stiffness * a * a;
        }
        for (c, contact) in self.contacts.iter().enumerate() {
            let d = self.indentations_from(self.indentation(contact), c)?.most;
            let (u, normal) = (along(&contact.u.free), contact.coupling().map_or(0.0, |d| along(&d.free)));
            if !contact.inert {
                stiffness += contact.count * contact.interface.stick_stiffness(d) * u * u;
            }
            if normal != 0.0 {
                stiffness += contact.count * contact.interface.normal_stiffness(d) * normal * normal;
            }
        }
        let root = free.mass.sqrt();
        let eigenvalue = stiffness / (root * root);
        eigenvalue.is_finite().then(|| eigenvalue.sqrt())
    }

    /// Returns whether the model is stiff: a decaying motion is much faster than all others. The stepper `event` then uses implicit steps.
    pub fn is_stiff(&self) -> bool {
        self.stiff
    }

    /// Returns the longest stable step of a fixed-step stepper, s, with all contacts stuck at their largest indentation, including states
    /// of blocks. The result is infinite without oscillation and decay, and `None` for adaptive steppers.
    pub fn longest_step(&self, stepper: Stepper) -> Option<f64> {
        Some(self.frequency_and_limit(stepper.reach()?).1)
    }

    /// Returns the highest angular frequency with all contacts stuck at their largest indentation, rad/s, and the longest stable step of a
    /// method, s, including states of blocks.
    fn frequency_and_limit(&self, Reach { motion, state }: Reach) -> (f64, f64) {
        let (mut swing, mut stable) = (0.0, f64::INFINITY);
        for part in self.parts(|d| d.most) {
            let frequency = part.highest_frequency();
            (swing, stable) = (frequency.max(swing), stable.min(motion(&part, frequency)));
        }
        (swing, self.block_eigenvalues().iter().map(state).fold(stable, f64::min))
    }
}

/// Adds value·rᵀr to a matrix, the contribution of a spring or damper along a row r.
fn add(matrix: &mut DMatrix<f64>, row: &[(usize, f64)], value: f64) {
    for (i, a) in row {
        for (j, b) in row {
            matrix[(*i, *j)] += value * a * b;
        }
    }
}

impl Linearised {
    /// Returns the names of the free coordinates, such as `slider.x`.
    pub fn coordinates(&self) -> &[String] {
        &self.coordinates
    }

    /// Returns the diagonal of the mass matrix M, kg.
    pub fn mass(&self) -> &DVector<f64> {
        &self.mass
    }

    /// Returns the damping matrix C, N s/m.
    pub fn damping(&self) -> &DMatrix<f64> {
        &self.damping
    }

    /// Returns the stiffness matrix K, N/m.
    pub fn stiffness(&self) -> &DMatrix<f64> {
        &self.stiffness
    }

    /// Returns the normal modes by increasing frequency; empty if the eigenvalue iteration fails.
    pub fn modes(&self) -> Vec<NormalMode> {
        if self.mass.is_empty() {
            return Vec::new();
        }
        let Some(eigen) = symmetric(self.by_mass(&self.stiffness)) else { return Vec::new() };
        // A free motion has the eigenvalue 0 up to rounding of either sign.
        let rounding = self.mass.len() as f64 * f64::EPSILON * eigen.eigenvalues.amax();
        let damping = self.by_mass(&self.damping);
        let mode = |(k, value): (usize, &f64)| {
            let frequency = if *value > rounding { value.sqrt() } else { 0.0 };
            self.mode(frequency, &eigen.eigenvectors.column(k).into_owned(), &damping)
        };
        let mut modes: Vec<NormalMode> = eigen.eigenvalues.iter().enumerate().map(mode).collect();
        modes.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        modes
    }

    /// Returns the normal mode that belongs to a unit eigenvector of M^{-1/2} K M^{-1/2}; `damping` is M^{-1/2} C M^{-1/2}.
    fn mode(&self, frequency: f64, vector: &DVector<f64>, damping: &DMatrix<f64>) -> NormalMode {
        let damped = vector.dot(&(damping * vector));
        let displaced = vector.zip_map(&self.mass, |x, mass| x / mass.sqrt());
        let largest = displaced.iter().fold(0.0, |most: f64, x| if x.abs() > most.abs() { *x } else { most });
        let shape: Vec<f64> = displaced.iter().map(|x| x / largest).collect();
        let moved = |row: &Row| row.iter().map(|(i, share)| share * shape[*i]).sum();
        NormalMode {
            frequency,
            // A free motion has no critical damping.
            damping_ratio: if frequency > 0.0 { 0.5 * damped / frequency } else { 0.0 },
            contacts: self.contacts.iter().map(moved).collect(),
            shape,
        }
    }

    /// Returns the matrix A scaled by masses, M^{-1/2} A M^{-1/2}.
    fn by_mass(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let root = self.mass.map(f64::sqrt);
        DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] / (root[i] * root[j]))
    }

    /// Returns the largest angular frequency of all normal modes, rad/s; 0 without modes.
    fn highest_frequency(&self) -> f64 {
        largest(self.by_mass(&self.stiffness)).map_or(0.0, |value| value.max(0.0).sqrt())
    }

    /// Returns the longest stable step of velocity Verlet with the predicted velocity in the damping, s; see `stickslip_stepper::Verlet`.
    /// The largest angular frequency is given.
    ///
    /// A motion x ξⁿ satisfies [ξ M + h²K ξ²/(ξ-1)² + hC (3ξ-1)/(2(ξ-1))] x = 0. The step becomes unstable at ξ = -1, where an eigenvalue
    /// of M⁻¹(h²K/4 + hC) reaches 1. Without damping h = 2/ω; with one damped mode (hω)² + 8ζhω = 4.
    fn longest_verlet_step(&self, frequency: f64) -> f64 {
        let (stiffness, damping) = (self.by_mass(&self.stiffness), self.by_mass(&self.damping));
        let undamped = 2.0 / frequency;
        let rate = damping.amax();
        if rate == 0.0 {
            return undamped;
        }
        // A positive semidefinite matrix has an eigenvalue of at least its largest entry, so no step above 1/rate is stable.
        longest(undamped.min(1.0 / rate), |h| {
            largest(&stiffness * (0.25 * h * h) + &damping * h).is_some_and(|value| value <= 1.0)
        })
    }

    /// Returns the longest stable step of the classical Runge–Kutta method, s: |1 + z + z²/2 + z³/6 + z⁴/24| ≤ 1 with z = hλ for every
    /// eigenvalue λ of λ²M + λC + K. Without damping h = √8/ω, with the given largest angular frequency ω.
    fn longest_rk4_step(&self, frequency: f64) -> f64 {
        if self.damping.amax() == 0.0 {
            return 2.0 * SQRT_2 / frequency;
        }
        let rates = self.rates(if frequency > 0.0 { frequency } else { 1.0 });
        rates.iter().filter(|rate| rate.modulus() > 0.0).map(rk4_reach).fold(f64::INFINITY, f64::min)
    }

    /// Returns all eigenvalues λ of λ²M + λC + K, 1/s, from a first-order system in x and v/`frequency`.
    fn rates(&self, frequency: f64) -> Vec<Complex<f64>> {
        let n = self.mass.len();
        let mut matrix = DMatrix::zeros(2 * n, 2 * n);
        // This scaling gives entries of similar size, for accurate eigenvalues.
        matrix.view_mut((0, n), (n, n)).fill_diagonal(frequency);
        matrix.view_mut((n, 0), (n, n)).copy_from(&(self.by_mass(&self.stiffness) / -frequency));
        matrix.view_mut((n, n), (n, n)).copy_from(&-self.by_mass(&self.damping));
        eigenvalues(matrix)
    }
}

/// Returns all eigenvalues of a matrix; empty if an entry is not finite or the iteration fails.
fn eigenvalues(matrix: DMatrix<f64>) -> Vec<Complex<f64>> {
    let sweeps = matrix.nrows() * SWEEPS;
    let schur = finite(matrix).and_then(|matrix| Schur::try_new(matrix, f64::EPSILON, sweeps.max(1)));
    schur.map_or_else(Vec::new, |schur| schur.complex_eigenvalues().iter().copied().collect())
}

/// Returns the matrix if all entries and the sum of their squares are finite, because otherwise the iterations of nalgebra would not end.
fn finite(matrix: DMatrix<f64>) -> Option<DMatrix<f64>> {
    matrix.norm_squared().is_finite().then_some(matrix)
}

/// Returns the largest eigenvalue of a symmetric matrix; `None` if the matrix is empty or an entry is not finite.
fn largest(matrix: DMatrix<f64>) -> Option<f64> {
    let matrix = finite(matrix).filter(|matrix| !matrix.is_empty())?;
    Some(matrix.symmetric_eigenvalues().max())
}

/// Returns eigenvalues and eigenvectors of a symmetric matrix; `None` if an entry is not finite or the iteration fails.
fn symmetric(matrix: DMatrix<f64>) -> Option<SymmetricEigen<f64, nalgebra::Dyn>> {
    let sweeps = matrix.nrows() * SWEEPS;
    SymmetricEigen::try_new(finite(matrix)?, f64::EPSILON, sweeps.max(1))
}
