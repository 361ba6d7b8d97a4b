//! Half a row of springs, eight lanes: the handbook's algorithm (chapter 11) as a loop would have it, tuned.

use super::Tie;

const LANES: usize = 8;

/// The springs on one side of the middle; the other side is their mirror image.
#[derive(Debug, Clone)]
pub(super) struct Half {
    /// Stretches, m.
    stretch: Vec<[f64; LANES]>,
    /// Heights, m; where the load is constant the limits of the stretches, m.
    height: Vec<[f64; LANES]>,
    /// Tangential and normal stiffness of a spring and its image, N/m.
    stiffness: (f64, f64),
    /// κ.
    slope: f64,
}

impl Half {
    /// A row of `springs` (a multiple of 16) over `span` m as it stands at the start of a contact.
    pub(super) fn new(tie: &Tie, springs: usize, span: f64) -> Self {
        let (count, law) = (springs / 2, &tie.law);
        let width = span / springs as f64;
        let heights: Vec<f64> = (0..count).map(|i| law.profile().depth((i as f64 + 0.5) * width)).collect();
        let lanes = |value: &dyn Fn(f64) -> f64| {
            let blocks = heights.chunks_exact(LANES);
            blocks.map(|block| std::array::from_fn(|lane| value(block[lane]))).collect::<Vec<_>>()
        };
        let pair = 2.0 * width;
        // The springs carry the load among them: as deep as they go, not as the profile would.
        let held = law.normal_force(tie.start.apex().d) / (pair * law.normal_modulus());
        let (slope, d) = (law.stick_slope(), depth(&heights, held));
        let height: &dyn Fn(f64) -> f64 =
            if tie.press.is_some() { &|h| h } else { &|h| slope * (d - h).max(0.0) };
        Self {
            stretch: lanes(&|h| tie.start.stretch(h)),
            height: lanes(height),
            stiffness: (pair * law.tangential_modulus(), pair * law.normal_modulus()),
            slope,
        }
    }

    /// Moves all springs by `du` m under a constant load; their force, N.
    #[inline]
    pub(super) fn slide(&mut self, du: f64) -> f64 {
        let mut sums = [0.0; LANES];
        for (stretch, limit) in self.stretch.iter_mut().zip(&self.height) {
            for lane in 0..LANES {
                let mut s = stretch[lane] + du;
                if s > limit[lane] {
                    s = limit[lane];
                }
                if s < -limit[lane] {
                    s = -limit[lane];
                }
                stretch[lane] = s;
                sums[lane] += s;
            }
        }
        self.stiffness.0 * sums.iter().sum::<f64>()
    }

    /// Moves all springs by `du` to the indentation `d`, m; tangential and normal force, N. A spring that does not touch
    /// has no room to stretch.
    #[inline]
    pub(super) fn press(&mut self, du: f64, d: f64) -> (f64, f64) {
        let (mut shear, mut depth) = ([0.0; LANES], [0.0; LANES]);
        for (stretch, height) in self.stretch.iter_mut().zip(&self.height) {
            for lane in 0..LANES {
                let mut rise = d - height[lane];
                if rise < 0.0 {
                    rise = 0.0;
                }
                let limit = self.slope * rise;
                let mut s = stretch[lane] + du;
                if s > limit {
                    s = limit;
                }
                if s < -limit {
                    s = -limit;
                }
                stretch[lane] = s;
                shear[lane] += s;
                depth[lane] += rise;
            }
        }
        (self.stiffness.0 * shear.iter().sum::<f64>(), self.stiffness.1 * depth.iter().sum::<f64>())
    }
}

/// Where Σ(d-h) over the springs that touch reaches a value, m; heights ascend.
fn depth(heights: &[f64], held: f64) -> f64 {
    let mut below = 0.0;
    for (k, height) in heights.iter().enumerate() {
        below += height;
        let d = (held + below) / (k + 1) as f64;
        if heights.get(k + 1).is_none_or(|next| d <= *next) {
            return d;
        }
    }
    0.0
}
