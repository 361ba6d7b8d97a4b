//! A rough line: a foundation of so many heights that finding one takes longer than all the rest.

use super::foundation::{Foundation, Sums};
use super::kind::{Kind, Peak};
use super::{Profile, ProfileError, SelfAffine, Shape};
use std::sync::Arc;

/// Steps of the index per height.
const STEPS_PER_HEIGHT: usize = 4;

/// A foundation with an index by height.
///
/// Heights are parted into equal steps, four times as many as there are springs. Of a line whose heights are spread like those of a surface the
/// index leaves one or two to look at, and of any line a range that is searched by halves.
// By halves alone a trial of the curve anywhere among 1e5 heights takes 4.5 times as long as a paraboloid's, most of it in waiting for
// memory; with the index, and all that belongs to a height side by side, 2.1 times. As many steps as springs: 2.6 times.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rough {
    foundation: Foundation,
    levels: Vec<Level>,
    /// Number of heights below each step.
    starts: Vec<u32>,
    /// Steps per height, 1/m.
    scale: f64,
}

/// A height with the sums there, its own spring included in m.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Level {
    /// m.
    height: f64,
    sums: Sums,
}

impl Profile {
    /// Most heights of a rough line: as many as [`SelfAffine`] makes.
    pub const MAX_HEIGHTS: usize = SelfAffine::MAX_POINTS;

    /// A rough line given by heights (m, outwards from the body, above any level) at equal distances (m): the highest touches first, and
    /// g at each is what it lacks of the highest.
    ///
    /// The line is that of the one-dimensional equivalent. Only the distribution of its heights matters.
    ///
    /// # Errors
    ///
    /// Without a height, with more than [`Self::MAX_HEIGHTS`], for one that is not finite and for a distance not above 0.
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
    /// The index of a foundation of at least one spring, at most 2³² of them.
    fn new(foundation: Foundation) -> Self {
        let heights = foundation.heights();
        let levels: Vec<Level> =
            heights.iter().zip(foundation.sums()).map(|(&height, &sums)| Level { height, sums }).collect();
        let steps = STEPS_PER_HEIGHT * levels.len();
        let scale = match heights.last() {
            Some(&last) if last > 0.0 && (steps as f64 / last).is_finite() => steps as f64 / last,
            _ => 0.0,
        };
        // A product and its whole part do not fall as a height rises: no height is looked for in the wrong step.
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

    /// The sums at h > 0.
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

    /// [`Foundation::moment`].
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

    fn lowest(&self) -> f64 {
        self.foundation.lowest()
    }

    fn depth(&self, a: f64) -> f64 {
        self.foundation.depth(a)
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

    fn has_kinks(&self) -> bool {
        true
    }

    fn as_foundation(&self) -> Option<&Foundation> {
        Some(&self.foundation)
    }
}
