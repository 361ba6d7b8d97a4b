//! Foundation given as a list of springs.
//!
//! m(h) = Σ lᵢ, M(h) = Σ lᵢ (h-hᵢ) and N(h) = Σ lᵢ (h-hᵢ)²/2, over the springs with hᵢ < h. Between two heights they are constant,
//! linear and quadratic.

use super::kind::Kind;
use super::{Profile, ProfileError, Shape};

/// Springs in order of height, with the integrals m, M and N at each.
///
/// Between two heights, M and N follow from the integrals at the lower height by adding positive terms, without cancellation.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Foundation {
    /// Heights, m, ascending.
    heights: Vec<f64>,
    /// Length of each spring, m, above 0. The position of a spring does not affect forces.
    lengths: Vec<f64>,
    /// Index in `heights` of each spring in the given order.
    ranks: Vec<usize>,
    /// Integrals at each height; m includes the spring of that height.
    sums: Vec<Sums>,
}

/// Integrals m, M and N at a height.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Sums {
    /// Reduced stiffness m, m.
    pub(crate) reduced_stiffness: f64,
    /// Reduced force M, m².
    pub(crate) reduced_force: f64,
    /// Reduced energy N, m³.
    pub(crate) reduced_energy: f64,
}

impl Sums {
    /// Computes the integrals at every finite height, for heights in ascending order.
    pub(crate) fn of(heights: &[f64], lengths: &[f64]) -> Vec<Self> {
        let (mut stiffness, mut force, mut energy) =
            (Compensated::default(), Compensated::default(), Compensated::default());
        let (mut at, mut last) = (Self::default(), 0.0);
        let step = |(&height, &own): (&f64, &f64)| {
            let rise = height - last;
            let before = at;
            at.reduced_energy =
                energy.add((before.reduced_force + 0.5 * before.reduced_stiffness * rise) * rise);
            at.reduced_force = force.add(before.reduced_stiffness * rise);
            at.reduced_stiffness = stiffness.add(own);
            last = height;
            at
        };
        heights.iter().take_while(|height| height.is_finite()).zip(lengths).map(step).collect()
    }

    /// Returns the integrals at a height that is `rise` (m) larger but below the next spring: M is linear and N quadratic.
    #[inline]
    pub(crate) fn at(self, rise: f64) -> Self {
        Self {
            reduced_energy: self.reduced_energy
                + (self.reduced_force + 0.5 * self.reduced_stiffness * rise) * rise,
            reduced_force: self.reduced_force + self.reduced_stiffness * rise,
            ..self
        }
    }

    /// Returns the integrals at a height h (m), from ascending `heights` and the integrals at each.
    #[inline]
    pub(crate) fn below(sums: &[Self], heights: &[f64], h: f64) -> Self {
        let count = heights.partition_point(|&height| height < h).min(sums.len());
        if count == 0 { Self::default() } else { sums[count - 1].at(h - heights[count - 1]) }
    }

    /// Returns the height at which the reduced force M > 0 (m²) is reached, m.
    pub(crate) fn height_of_reduced_force(sums: &[Self], heights: &[f64], reduced_force: f64) -> f64 {
        // Between two heights M is linear, so the inverse is a division. At the lowest height M is 0.
        let index = sums.partition_point(|sums| sums.reduced_force < reduced_force).max(1) - 1;
        let sums = sums[index];
        heights[index] + (reduced_force - sums.reduced_force) / sums.reduced_stiffness
    }
}

/// Compensated sum (Neumaier, ZAMM 54, 1974).
// Plain sums would lose digits for millions of springs.
#[derive(Default)]
struct Compensated {
    sum: f64,
    error: f64,
}

impl Compensated {
    /// Adds a term and returns the sum.
    fn add(&mut self, term: f64) -> f64 {
        let sum = self.sum + term;
        let (big, small) = if self.sum.abs() >= term.abs() { (self.sum, term) } else { (term, self.sum) };
        self.error += (big - sum) + small;
        self.sum = sum;
        self.sum + self.error
    }
}

impl Profile {
    /// Creates a profile from a list of springs: heights (m, at least 0, in any order) and the length of each (m).
    ///
    /// A rough line g(x) can be given in this way, because only the distribution of its heights matters.
    pub fn foundation(heights: &[f64], lengths: &[f64]) -> Result<Self, ProfileError> {
        Ok(Self { shape: Shape::Foundation(Foundation::new(heights, lengths)?) })
    }
}

impl Foundation {
    /// Sorts the springs and computes their integrals. Fails for an empty list, unequal numbers of heights and lengths, and invalid
    /// values.
    pub(super) fn new(heights: &[f64], lengths: &[f64]) -> Result<Self, ProfileError> {
        check(heights, lengths)?;
        let mut order: Vec<usize> = (0..heights.len()).collect();
        order.sort_by(|&i, &j| heights[i].total_cmp(&heights[j]));
        let mut ranks = vec![0; order.len()];
        for (rank, &index) in order.iter().enumerate() {
            ranks[index] = rank;
        }
        let heights: Vec<f64> = order.iter().map(|&i| heights[i].abs()).collect();
        let lengths: Vec<f64> = order.iter().map(|&i| lengths[i]).collect();
        let sums = Sums::of(&heights, &lengths);
        Ok(Self { heights, lengths, ranks, sums })
    }

    /// Returns the integrals at each height.
    pub(super) fn sums(&self) -> &[Sums] {
        &self.sums
    }

    /// Returns the heights, m, ascending.
    pub(crate) fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Returns the length of each spring, m.
    pub(crate) fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// Returns the index among the ascending heights of each spring in the given order.
    pub(crate) fn ranks(&self) -> &[usize] {
        &self.ranks
    }

    /// Returns the integrals at h.
    #[inline]
    fn below(&self, h: f64) -> Sums {
        Sums::below(&self.sums, &self.heights, h)
    }

    /// Returns ∫ w m dh between two heights, for a linear w with start value and slope: one term for each height in between.
    pub(super) fn moment(&self, [from, to]: [f64; 2], [value, slope]: [f64; 2]) -> f64 {
        let (mut at, mut length, mut sum) = (from, self.below(from).reduced_stiffness, 0.0);
        let first = self.heights.partition_point(|&height| height < from);
        let inside = self.heights[first..].iter().zip(&self.sums[first..]).take_while(|(h, _)| **h < to);
        for (edge, next) in inside.map(|(h, sums)| (*h, sums.reduced_stiffness)).chain([(to, 0.0)]) {
            let middle = value + slope * (0.5 * ((at - from) + (edge - from)));
            sum += length * middle * (edge - at);
            (at, length) = (edge, next);
        }
        sum
    }

    /// Returns the lowest height at which the length m > 0 is in contact; infinite beyond all springs.
    fn height_of_reduced_stiffness(&self, length: f64) -> f64 {
        let index = self.sums.partition_point(|sums| sums.reduced_stiffness < length);
        self.heights.get(index).copied().unwrap_or(f64::INFINITY)
    }
}

impl Kind for Foundation {
    fn reduced_stiffness(&self, h: f64) -> f64 {
        self.below(h).reduced_stiffness
    }

    fn reduced_force(&self, h: f64) -> f64 {
        self.below(h).reduced_force
    }

    fn reduced_energy(&self, h: f64) -> f64 {
        self.below(h).reduced_energy
    }

    /// Returns the height at which M > 0 is reached.
    fn height_of_reduced_force(&self, reduced_force: f64) -> f64 {
        Sums::height_of_reduced_force(&self.sums, &self.heights, reduced_force)
    }

    fn depth(&self, a: f64) -> f64 {
        self.height_of_reduced_stiffness(2.0 * a)
    }

    fn depth_slope(&self, _a: f64) -> f64 {
        0.0
    }

    fn is_strictly_convex(&self) -> bool {
        false
    }

    /// Returns that the stiffness jumps at each spring.
    fn has_kinks(&self) -> bool {
        true
    }
}

/// Returns the first error in a list of springs.
fn check(heights: &[f64], lengths: &[f64]) -> Result<(), ProfileError> {
    if heights.len() != lengths.len() {
        return Err(ProfileError::Unpaired { heights: heights.len(), lengths: lengths.len() });
    }
    if heights.is_empty() {
        return Err(ProfileError::Empty);
    }
    let wrong_height = heights.iter().position(|h| !(*h >= 0.0 && h.is_finite()));
    if let Some(index) = wrong_height {
        return Err(ProfileError::Height { index, value: heights[index] });
    }
    let wrong_length = lengths.iter().position(|l| !(*l > 0.0 && l.is_finite()));
    match wrong_length {
        Some(index) => Err(ProfileError::Length { index, value: lengths[index] }),
        None => Ok(()),
    }
}
