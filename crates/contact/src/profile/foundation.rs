//! A foundation given spring by spring: m, M and N are piecewise constant, straight and quadratic in h.
//!
//! m(h) = Σ lᵢ, M(h) = Σ lᵢ (h-hᵢ), N(h) = Σ lᵢ (h-hᵢ)²/2 over the springs with hᵢ < h.

use super::kind::{Kind, Peak};
use super::{Profile, ProfileError, Shape};

/// Springs by ascending height, with the sums up to each.
///
/// Between two heights m is constant, so M and N follow from the sums at the lower one by adding positive
/// terms: nothing cancels, however many springs there are.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Foundation {
    /// Heights, m, ascending.
    heights: Vec<f64>,
    /// Length of each, m, above 0: a share of the contact's length, at whichever positions.
    lengths: Vec<f64>,
    /// Index in `heights` of each spring in the order given.
    ranks: Vec<usize>,
    /// Sums at each height, the spring of that height included in m.
    sums: Vec<Sums>,
}

/// m, M and N at a height.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Sums {
    /// m, m.
    pub(crate) reduced_stiffness: f64,
    /// M, m².
    pub(crate) reduced_force: f64,
    /// N, m³.
    pub(crate) reduced_energy: f64,
}

impl Sums {
    /// At every height, in ascending order, from the lowest on; of heights that no indentation reaches there are none.
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

    /// The same `rise` (m) higher, below the next height: M is straight and N a parabola.
    #[inline]
    pub(crate) fn at(self, rise: f64) -> Self {
        Self {
            reduced_energy: self.reduced_energy
                + (self.reduced_force + 0.5 * self.reduced_stiffness * rise) * rise,
            reduced_force: self.reduced_force + self.reduced_stiffness * rise,
            ..self
        }
    }

    /// At a height h (m) above springs at `heights`, in ascending order, with the sums of each.
    #[inline]
    pub(crate) fn below(sums: &[Self], heights: &[f64], h: f64) -> Self {
        let count = heights.partition_point(|&height| height < h).min(sums.len());
        if count == 0 { Self::default() } else { sums[count - 1].at(h - heights[count - 1]) }
    }

    /// Height at which M > 0 (m²) is reached.
    pub(crate) fn height_of_reduced_force(sums: &[Self], heights: &[f64], reduced_force: f64) -> f64 {
        // Between two heights M is straight: the inverse is a division, and no iteration can miss it.
        // M is 0 at the lowest height, so at least one spring lies below.
        let index = sums.partition_point(|sums| sums.reduced_force < reduced_force).max(1) - 1;
        let sums = sums[index];
        heights[index] + (reduced_force - sums.reduced_force) / sums.reduced_stiffness
    }
}

/// A sum with the rounding error it has made so far (Neumaier, ZAMM 54, 1974).
// Plain sums over springs of random height are 4e-14 off for a million of them and 1e-13 for ten million, in each of m, M
// and N; these 2e-16, whatever their number. It is paid once, when a profile is built.
#[derive(Default)]
struct Compensated {
    sum: f64,
    error: f64,
}

impl Compensated {
    /// The sum with one more term, its error taken off.
    fn add(&mut self, term: f64) -> f64 {
        let sum = self.sum + term;
        let (big, small) = if self.sum.abs() >= term.abs() { (self.sum, term) } else { (term, self.sum) };
        self.error += (big - sum) + small;
        self.sum = sum;
        self.sum + self.error
    }
}

impl Profile {
    /// A foundation given spring by spring: heights (m, at least 0, in any order) and the length of each (m).
    ///
    /// So enters a rough line g(x), monotone or not: the distribution of its heights alone matters.
    pub fn foundation(heights: &[f64], lengths: &[f64]) -> Result<Self, ProfileError> {
        Ok(Self { shape: Shape::Foundation(Foundation::new(heights, lengths)?) })
    }
}

impl Foundation {
    /// Sorted springs with their sums; fails for lists that are empty, of unlike lengths, or with a number out of range.
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

    /// Sums at each height.
    pub(super) fn sums(&self) -> &[Sums] {
        &self.sums
    }

    /// Heights, m, ascending.
    pub(crate) fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Length of each, m.
    pub(crate) fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// Index among the ascending heights of each spring in the order given.
    pub(crate) fn ranks(&self) -> &[usize] {
        &self.ranks
    }

    /// The sums at h.
    #[inline]
    fn below(&self, h: f64) -> Sums {
        Sums::below(&self.sums, &self.heights, h)
    }

    /// ∫ w m dh between two heights, w straight from a value with a slope: one term per height in between.
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

    /// Lowest height whose spring completes the length m > 0; infinite beyond all springs.
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

    /// Height at which M > 0 is reached.
    fn height_of_reduced_force(&self, reduced_force: f64) -> f64 {
        Sums::height_of_reduced_force(&self.sums, &self.heights, reduced_force)
    }

    fn lowest(&self) -> f64 {
        self.heights[0]
    }

    fn depth(&self, a: f64) -> f64 {
        self.height_of_reduced_stiffness(2.0 * a)
    }

    fn depth_slope(&self, _a: f64) -> f64 {
        0.0
    }

    fn gap(&self, _r: f64) -> Option<f64> {
        None
    }

    fn peak(&self) -> Option<Peak> {
        None
    }

    fn is_strictly_convex(&self) -> bool {
        false
    }

    /// At each of its springs.
    fn has_kinks(&self) -> bool {
        true
    }

    fn as_foundation(&self) -> Option<&Foundation> {
        Some(self)
    }
}

/// The first thing wrong with a list, if anything is.
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
