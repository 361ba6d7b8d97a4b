//! What a row of springs is made of. Constant.

use crate::Profile;
use crate::profile::Sums;
use thiserror::Error;

/// The springs of a row: heights and lengths of the foundation's cells.
///
/// Springs of equal height and history are held once with their common length, so a symmetric profile costs
/// half its springs.
#[derive(Debug, Clone, PartialEq)]
pub struct Springs {
    /// Heights of the distinct springs, m, ascending, so that those in contact come first.
    heights: Vec<f64>,
    /// Length of each distinct spring, m.
    lengths: Vec<f64>,
    /// Half the length of the distinct springs before each, m; one more entry for all of them: the radius of the zone that
    /// reaches up to each.
    radii: Vec<f64>,
    /// m, M and N of the row at the height of each.
    sums: Vec<Sums>,
    /// Position x of every spring, m, ascending.
    positions: Vec<f64>,
    /// Index among the distinct springs of every spring.
    ranks: Vec<usize>,
    /// Largest indentation that the row can follow, m.
    reach: f64,
}

/// Some distinct springs in a row: heights and lengths, equally many.
#[derive(Clone, Copy)]
pub(super) struct Cells<'a> {
    pub(super) heights: &'a [f64],
    pub(super) lengths: &'a [f64],
}

/// Why a row of springs cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SpringsError {
    /// The number of springs is 0 or above [`Springs::MAX_COUNT`].
    #[error("expected between 1 and {max} springs, got {0}", max = Springs::MAX_COUNT)]
    Count(usize),
    /// The span of a row must be positive and finite, m.
    #[error("expected a span above 0 m, got {0}")]
    Span(f64),
    /// A flat punch touches along its whole width at once, m.
    #[error("expected a span of at least the width {width:e} m of the punch, got {span:e} m")]
    Narrow {
        /// Span asked for, m.
        span: f64,
        /// Width of the flat punch, m.
        width: f64,
    },
}

impl Springs {
    /// Most springs in a row.
    pub const MAX_COUNT: usize = 10_000_000;

    /// Springs at the midpoints of `count` equal cells of `span` (m) centred on the contact.
    ///
    /// A foundation given spring by spring is taken as it is: `count` and `span` are ignored.
    ///
    /// # Errors
    ///
    /// If there is no spring or too many, or the span is not positive or narrower than a flat punch.
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
        // At the midpoints of their cells: force and work then converge with the square of the number of springs.
        let reach = reach(profile, span)?;
        let cell = span / count as f64;
        // Position i and its mirror image are spring |2i+1-count|/2, counted from the centre.
        let ranks: Vec<usize> = (0..count).map(|i| (2 * i + 1).abs_diff(count) / 2).collect();
        let position = |twice: f64| 0.5 * twice * cell;
        let positions = (0..count).map(|i| position((2 * i + 1) as f64 - count as f64)).collect();
        let distinct = count.div_ceil(2);
        let odd = count % 2 == 1;
        let from_centre = |rank: usize| if odd { 2 * rank } else { 2 * rank + 1 };
        let heights: Vec<f64> =
            (0..distinct).map(|rank| profile.depth(position(from_centre(rank) as f64))).collect();
        let alone = |rank: usize| odd && rank == 0;
        let lengths = (0..distinct).map(|rank| if alone(rank) { cell } else { 2.0 * cell }).collect();
        Ok(Self::assemble(heights, lengths, positions, ranks, reach))
    }

    /// A list of springs, laid side by side in the order given.
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

    /// Takes the parts over and adds the lengths up.
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

    /// Number of springs, mirror images counted.
    pub fn count(&self) -> usize {
        self.positions.len()
    }

    /// Height of every spring, m, in the order of [`Self::positions`].
    pub fn heights_by_position(&self) -> impl Iterator<Item = f64> + '_ {
        self.ranks().iter().map(|rank| self.heights()[*rank])
    }

    /// Position, height and length of every spring, m, in the order of [`Self::positions`].
    pub fn cells(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        // Two springs of one height, mirror images of each other, are held as one with their common length.
        let mut shared = vec![0_u32; self.heights.len()];
        self.ranks.iter().for_each(|rank| shared[*rank] += 1);
        let cell = move |(&x, &rank): (&f64, &usize)| {
            (x, self.heights[rank], self.lengths[rank] / f64::from(shared[rank]))
        };
        self.positions.iter().zip(&self.ranks).map(cell)
    }

    /// Position x of every spring, m, ascending; springs of a list lie side by side in the order given.
    pub fn positions(&self) -> &[f64] {
        &self.positions
    }

    /// Largest indentation that the row can follow, m; infinite for a flat punch, for a list, and where it spans all points that the
    /// profile is given by.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// m(d) = Σ lᵢ over the springs with heights below d, m: the normal stiffness of the row over E\*. 0 for d ≤ 0, as the
    /// two that follow.
    #[inline]
    pub fn reduced_stiffness(&self, d: f64) -> f64 {
        self.sums_at(d).reduced_stiffness
    }

    /// M(d) = Σ lᵢ(d-hᵢ), m²: its normal force over E\*. Straight between two heights.
    #[inline]
    pub fn reduced_force(&self, d: f64) -> f64 {
        self.sums_at(d).reduced_force
    }

    /// N(d) = Σ lᵢ(d-hᵢ)²/2, m³: its normal elastic energy over E\*.
    #[inline]
    pub fn reduced_energy(&self, d: f64) -> f64 {
        self.sums_at(d).reduced_energy
    }

    /// Height at which M > 0 (m²) is reached, m: the inverse of [`Self::reduced_force`], exact but for rounding. For M ≤ 0
    /// the height of the lowest spring, where M begins to grow.
    pub fn height_of_reduced_force(&self, reduced_force: f64) -> f64 {
        Sums::height_of_reduced_force(&self.sums, &self.heights, reduced_force.max(0.0))
    }

    /// m, M and N at an indentation.
    #[inline]
    fn sums_at(&self, d: f64) -> Sums {
        Sums::below(&self.sums, &self.heights, d)
    }

    /// m, M and N at an indentation as if the first `count` distinct springs touched and no other, whatever d.
    pub(super) fn sums_of(&self, count: usize, d: f64) -> Sums {
        let count = count.min(self.sums.len());
        if count == 0 { Sums::default() } else { self.sums[count - 1].at(d - self.heights[count - 1]) }
    }

    /// Index among the distinct springs of every spring, in the order of [`Self::positions`].
    pub(super) fn ranks(&self) -> &[usize] {
        &self.ranks
    }

    /// Heights of the distinct springs, m, ascending.
    pub(super) fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Half the length of the first `count` distinct springs, m.
    pub(super) fn inner_radius(&self, count: usize) -> f64 {
        self.radii[count]
    }

    /// The lowest `count` distinct springs.
    #[inline]
    pub(super) fn first(&self, count: usize) -> Cells<'_> {
        self.range(0, count)
    }

    /// The distinct springs from one index up to another.
    #[inline]
    pub(super) fn range(&self, start: usize, end: usize) -> Cells<'_> {
        Cells { heights: &self.heights[start..end], lengths: &self.lengths[start..end] }
    }

    /// Number of distinct springs with heights up to d.
    pub(super) fn up_to(&self, d: f64) -> usize {
        self.heights.partition_point(|&height| height <= d)
    }

    /// Number of distinct springs with heights below d.
    pub(super) fn below(&self, d: f64) -> usize {
        self.heights.partition_point(|&height| height < d)
    }

    /// The same, where `near` is likely the answer.
    #[inline]
    pub(super) fn below_near(&self, d: f64, near: usize) -> usize {
        // Most moves touch and leave nothing: two comparisons take 1.4 ns where the search among a thousand takes 10.
        let (low, high) = self.heights.split_at(near);
        let lower_touch = low.last().is_none_or(|&height| height < d);
        if lower_touch && high.first().is_none_or(|&height| height >= d) {
            return near;
        }
        self.below(d)
    }
}

/// Largest indentation whose contact lies within the span, give or take its rounding: a span of 2a(d) reaches d.
fn reach(profile: &Profile, span: f64) -> Result<f64, SpringsError> {
    let depth = profile.depth(0.5 * span * (1.0 + 4.0 * f64::EPSILON));
    // Only a flat punch has no depth at a radius.
    if depth > 0.0 {
        // A row that holds all points of a profile is never outgrown: what ends is the profile, and a move says so.
        let end = profile.reach().filter(|_| !profile.ends_at_a_point());
        return Ok(depth.min(end.unwrap_or(f64::INFINITY)));
    }
    let width = profile.reduced_stiffness(1.0);
    Err(SpringsError::Narrow { span, width })
}
