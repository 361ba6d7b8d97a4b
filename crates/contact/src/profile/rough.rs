//! Rough line: a list of many springs with an index for fast search.

use super::foundation::{Foundation, Sums};
use super::kind::Kind;
use super::{Profile, ProfileError, SelfAffine, Shape};
use std::sync::Arc;

/// Number of index intervals per height.
const STEPS_PER_HEIGHT: usize = 4;

/// List of springs with an index by height.
///
/// The index divides the range of heights into equal intervals, four per spring. For typical surfaces an interval contains one or two
/// heights; a binary search handles fuller intervals.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rough {
    foundation: Foundation,
    levels: Vec<Level>,
    /// Number of heights below each interval.
    starts: Vec<u32>,
    /// Number of intervals per height, 1/m.
    scale: f64,
}

/// Height with the integrals there; m includes the spring of that height.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Level {
    /// Height, m.
    height: f64,
    sums: Sums,
}

impl Profile {
    /// Largest number of heights of a rough line, equal to the limit of [`SelfAffine`].
    pub const MAX_HEIGHTS: usize = SelfAffine::MAX_POINTS;

    /// Creates a rough line from heights (m, measured outwards from the body) at equal distances `spacing` (m).
    ///
    /// The highest point touches first. g at each point is its depth below the highest point. The line is the one-dimensional profile g(x),
    /// so only the distribution of heights matters.
    ///
    /// # Errors
    ///
    /// Fails without a height, with more than [`Self::MAX_HEIGHTS`], for a height that is not finite, and for a spacing not above 0.
    pub fn rough(heights: &[f64], spacing: f64) -> Result<Self, ProfileError> {
        if heights.len() > Self::MAX_HEIGHTS {
            return Err(ProfileError::TooManyHeights(heights.len()));
        }
        let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if let Some(index) = heights.iter().position(|height| !(highest - height).is_finite()) {
            return Err(ProfileError::LineHeight { index, value: heights[index] });
        }
        let lacks: Vec<f64> = heights.iter().map(|height| highest - height).collect();
        let lengths = vec![spacing; lacks.len()];
        let foundation = Foundation::new(&lacks, &lengths).map_err(|error| match error {
            ProfileError::Length { value, .. } => ProfileError::Spacing(value),
            other => other,
        })?;
        Ok(Self { shape: Shape::Rough(Arc::new(Rough::new(foundation))) })
    }
}

impl Rough {
    /// Creates the index of a list of at least one and at most 2³² springs.
    fn new(foundation: Foundation) -> Self {
        let heights = foundation.heights();
        let levels: Vec<Level> =
            heights.iter().zip(foundation.sums()).map(|(&height, &sums)| Level { height, sums }).collect();
        let steps = STEPS_PER_HEIGHT * levels.len();
        let scale = match heights.last() {
            Some(&last) if last > 0.0 && (steps as f64 / last).is_finite() => steps as f64 / last,
            _ => 0.0,
        };
        // The rounded product is monotone, so a height is always searched in the right interval.
        let step = |height: f64| ((height * scale) as usize).min(steps);
        let mut starts = vec![0; steps + 2];
        for level in &levels {
            starts[step(level.height) + 1] += 1;
        }
        for k in 1..starts.len() {
            starts[k] += starts[k - 1];
        }
        Self { levels, starts, scale, foundation }
    }

    /// Returns the integrals at h > 0.
    #[inline]
    fn below(&self, h: f64) -> Sums {
        let step = ((h * self.scale) as usize).min(self.starts.len() - 2);
        let (from, to) = (self.starts[step] as usize, self.starts[step + 1] as usize);
        let count = from + self.levels[from..to].partition_point(|level| level.height < h);
        match self.levels.get(count.wrapping_sub(1)) {
            Some(level) => level.sums.at(h - level.height),
            None => Sums::default(),
        }
    }

    /// Returns the list of its springs.
    pub(super) fn foundation(&self) -> &Foundation {
        &self.foundation
    }

    /// See [`Foundation::moment`].
    pub(super) fn moment(&self, heights: [f64; 2], straight: [f64; 2]) -> f64 {
        self.foundation.moment(heights, straight)
    }
}

impl Kind for Rough {
    fn reduced_stiffness(&self, h: f64) -> f64 {
        self.below(h).reduced_stiffness
    }

    fn reduced_force(&self, h: f64) -> f64 {
        self.below(h).reduced_force
    }

    fn reduced_energy(&self, h: f64) -> f64 {
        self.below(h).reduced_energy
    }

    fn height_of_reduced_force(&self, force: f64) -> f64 {
        self.foundation.height_of_reduced_force(force)
    }

    fn depth(&self, a: f64) -> f64 {
        self.foundation.depth(a)
    }

    fn depth_slope(&self, _a: f64) -> f64 {
        0.0
    }

    fn is_strictly_convex(&self) -> bool {
        false
    }

    fn has_kinks(&self) -> bool {
        true
    }
}
