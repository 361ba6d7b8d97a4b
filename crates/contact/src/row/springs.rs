//! Constant data of a row of springs.

use crate::Profile;
use crate::profile::Sums;
use thiserror::Error;

/// Springs of a row: heights and lengths of the foundation's cells.
///
/// Springs of equal height, such as mirror images, are stored as one distinct spring with their common length.
#[derive(Debug, Clone, PartialEq)]
pub struct Springs {
    /// Heights of the distinct springs, m, ascending, so that springs in contact come first.
    heights: Vec<f64>,
    /// Lengths of the distinct springs, m.
    lengths: Vec<f64>,
    /// Radius covered by the distinct springs before each spring, m: half of their total length. The last entry refers to all springs.
    radii: Vec<f64>,
    /// Integrals m, M and N of the row at the height of each distinct spring.
    sums: Vec<Sums>,
    /// Position x of every spring, m, ascending.
    positions: Vec<f64>,
    /// Index of the distinct spring for every position.
    ranks: Vec<usize>,
    /// Largest indentation of the row, m.
    reach: f64,
}

/// Consecutive distinct springs: their heights and lengths.
#[derive(Clone, Copy)]
pub(super) struct Cells<'a> {
    pub(super) heights: &'a [f64],
    pub(super) lengths: &'a [f64],
}

/// Reason why a row of springs is invalid.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SpringsError {
    /// The number of springs is 0 or above [`Springs::MAX_COUNT`].
    #[error("expected between 1 and {max} springs, got {0}", max = Springs::MAX_COUNT)]
    Count(usize),
    /// The span of the row is not above 0 or not finite, m.
    #[error("expected a span above 0 m, got {0}")]
    Span(f64),
    /// The span is smaller than the width of a flat punch, which touches along its full width.
    #[error("expected a span of at least the width {width:e} m of the punch, got {span:e} m")]
    Narrow {
        /// Span given, m.
        span: f64,
        /// Width of the flat punch, m.
        width: f64,
    },
}

impl Springs {
    /// Largest number of springs in a row.
    pub const MAX_COUNT: usize = 10_000_000;

    /// Creates springs at the midpoints of `count` equal cells of `span` (m), centred on the contact.
    ///
    /// A profile that is a list of springs is used as it is; `count` and `span` are ignored.
    ///
    /// # Errors
    ///
    /// Fails if the number of springs is 0 or too large, or if the span is not above 0 or narrower than a flat punch.
    pub fn new(profile: &Profile, count: usize, span: f64) -> Result<Self, SpringsError> {
        if let Some(foundation) = profile.as_foundation() {
            return Ok(Self::of_list(foundation.heights(), foundation.lengths(), foundation.ranks()));
        }
        if !(1..=Self::MAX_COUNT).contains(&count) {
            return Err(SpringsError::Count(count));
        }
        if !(span > 0.0 && span.is_finite()) {
            return Err(SpringsError::Span(span));
        }
        // With springs at cell midpoints, force and work converge with the square of the number of springs.
        let reach = reach(profile, span)?;
        let cell = span / count as f64;
        // Position i and its mirror image belong to distinct spring |2i+1-count|/2, counted from the centre.
        let ranks: Vec<usize> = (0..count).map(|i| (2 * i + 1).abs_diff(count) / 2).collect();
        let position = |twice: f64| 0.5 * twice * cell;
        let positions = (0..count).map(|i| position((2 * i + 1) as f64 - count as f64)).collect();
        let distinct = count.div_ceil(2);
        let odd = count % 2 == 1;
        let from_centre = |rank: usize| if odd { 2 * rank } else { 2 * rank + 1 };
        let heights: Vec<f64> = (0..distinct)
            .map(|rank| profile.height_of_reduced_stiffness(2.0 * position(from_centre(rank) as f64)))
            .collect();
        let alone = |rank: usize| odd && rank == 0;
        let lengths = (0..distinct).map(|rank| if alone(rank) { cell } else { 2.0 * cell }).collect();
        Ok(Self::assemble(heights, lengths, positions, ranks, reach))
    }

    /// Creates a row from a list of springs, placed side by side in the given order.
    fn of_list(heights: &[f64], lengths: &[f64], ranks: &[usize]) -> Self {
        let total: f64 = lengths.iter().sum();
        let mut edge = -0.5 * total;
        let position = |&rank: &usize| {
            let centre = edge + 0.5 * lengths[rank];
            edge += lengths[rank];
            centre
        };
        let positions = ranks.iter().map(position).collect();
        Self::assemble(heights.to_vec(), lengths.to_vec(), positions, ranks.to_vec(), f64::INFINITY)
    }

    /// Creates the row from its parts and computes the sums.
    fn assemble(
        heights: Vec<f64>,
        lengths: Vec<f64>,
        positions: Vec<f64>,
        ranks: Vec<usize>,
        reach: f64,
    ) -> Self {
        let mut sum = 0.0;
        let mut radii = vec![0.0];
        radii.extend(lengths.iter().map(|length| {
            sum += 0.5 * length;
            sum
        }));
        let sums = Sums::of(&heights, &lengths);
        Self { heights, lengths, radii, sums, positions, ranks, reach }
    }

    /// Returns the number of springs, including mirror images.
    pub fn count(&self) -> usize {
        self.positions.len()
    }

    /// Returns the height of every spring, m, in the order of [`Self::positions`].
    pub fn heights_by_position(&self) -> impl Iterator<Item = f64> + '_ {
        self.ranks().iter().map(|rank| self.heights()[*rank])
    }

    /// Returns position, height and length of every spring, m, in the order of [`Self::positions`].
    pub fn cells(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        // Mirror images share one distinct spring with their common length.
        let mut shared = vec![0_u32; self.heights.len()];
        self.ranks.iter().for_each(|rank| shared[*rank] += 1);
        let cell = move |(&x, &rank): (&f64, &usize)| {
            (x, self.heights[rank], self.lengths[rank] / f64::from(shared[rank]))
        };
        self.positions.iter().zip(&self.ranks).map(cell)
    }

    /// Returns the position x of every spring, m, ascending. Springs of a list lie side by side in the given order.
    pub fn positions(&self) -> &[f64] {
        &self.positions
    }

    /// Returns the largest indentation of the row, m.
    ///
    /// The result is infinite for a flat punch, for a list, and for a row that spans all points of the profile.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Returns the reduced stiffness m(d) = Σ lᵢ over the springs with heights below d, m: the normal stiffness over E\*; 0 for d ≤
    /// 0.
    #[inline]
    pub fn reduced_stiffness(&self, d: f64) -> f64 {
        self.sums_at(d).reduced_stiffness
    }

    /// Returns the reduced force M(d) = Σ lᵢ(d-hᵢ), m²: the normal force over E\*, piecewise linear in d; 0 for d ≤ 0.
    #[inline]
    pub fn reduced_force(&self, d: f64) -> f64 {
        self.sums_at(d).reduced_force
    }

    /// Returns the reduced energy N(d) = Σ lᵢ(d-hᵢ)²/2, m³: the normal elastic energy over E\*; 0 for d ≤ 0.
    #[inline]
    pub fn reduced_energy(&self, d: f64) -> f64 {
        self.sums_at(d).reduced_energy
    }

    /// Returns the height at which the reduced force M (m²) is reached, m: the exact inverse of [`Self::reduced_force`].
    ///
    /// For M ≤ 0 this is the height of the lowest spring.
    pub fn height_of_reduced_force(&self, reduced_force: f64) -> f64 {
        Sums::height_of_reduced_force(&self.sums, &self.heights, reduced_force.max(0.0))
    }

    /// Returns m, M and N at an indentation.
    #[inline]
    fn sums_at(&self, d: f64) -> Sums {
        Sums::below(&self.sums, &self.heights, d)
    }

    /// Returns m, M and N of the first `count` distinct springs at an indentation d, as if exactly these springs were in contact.
    pub(super) fn sums_of(&self, count: usize, d: f64) -> Sums {
        let count = count.min(self.sums.len());
        if count == 0 { Sums::default() } else { self.sums[count - 1].at(d - self.heights[count - 1]) }
    }

    /// Returns the index of the distinct spring for every position, in the order of [`Self::positions`].
    pub(super) fn ranks(&self) -> &[usize] {
        &self.ranks
    }

    /// Returns the heights of the distinct springs, m, ascending.
    pub(super) fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Returns the height of the lowest spring, m.
    pub(crate) fn lowest(&self) -> f64 {
        self.heights[0]
    }

    /// Returns half the length of the first `count` distinct springs, m.
    pub(super) fn inner_radius(&self, count: usize) -> f64 {
        self.radii[count]
    }

    /// Returns the lowest `count` distinct springs.
    #[inline]
    pub(super) fn first(&self, count: usize) -> Cells<'_> {
        self.range(0, count)
    }

    /// Returns the distinct springs from index `start` to `end`.
    #[inline]
    pub(super) fn range(&self, start: usize, end: usize) -> Cells<'_> {
        Cells { heights: &self.heights[start..end], lengths: &self.lengths[start..end] }
    }

    /// Returns the number of distinct springs with heights up to d.
    pub(super) fn up_to(&self, d: f64) -> usize {
        self.heights.partition_point(|&height| height <= d)
    }

    /// Returns the number of distinct springs with heights below d.
    pub(super) fn below(&self, d: f64) -> usize {
        self.heights.partition_point(|&height| height < d)
    }

    /// Returns the number of distinct springs with heights below d. The search begins at the probable result `near`.
    #[inline]
    pub(super) fn below_near(&self, d: f64, near: usize) -> usize {
        // In most moves no spring touches or lifts off, so two comparisons suffice.
        let (low, high) = self.heights.split_at(near);
        let lower_touch = low.last().is_none_or(|&height| height < d);
        if lower_touch && high.first().is_none_or(|&height| height >= d) {
            return near;
        }
        self.below(d)
    }
}

/// Returns the largest indentation with a contact width of at most `span`, except for rounding.
fn reach(profile: &Profile, span: f64) -> Result<f64, SpringsError> {
    let depth = profile.height_of_reduced_stiffness(span * (1.0 + 4.0 * f64::EPSILON));
    // Only a flat punch has no indentation at this radius.
    if depth > 0.0 {
        // A row that spans all points of a profile has no limit of its own; the profile has one.
        let end = profile.reach().filter(|_| !profile.ends_at_a_point());
        return Ok(depth.min(end.unwrap_or(f64::INFINITY)));
    }
    let width = profile.reduced_stiffness(1.0);
    Err(SpringsError::Narrow { span, width })
}
