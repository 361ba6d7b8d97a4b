//! Optimised half row of springs: the algorithm of chapter 11 of the handbook.

use super::walk::Contact;
use crate::baseline::Tie;
use pulp::Simd;

/// Number of independent sums, so that additions do not wait for each other.
const WAYS: usize = 4;

/// Springs on one side of the centre; the other side is their mirror image.
#[derive(Debug, Clone)]
pub(crate) struct Half {
    /// Stretches of the springs, m.
    stretch: Vec<f64>,
    /// Heights, m; under constant load the limits of the stretches, m.
    height: Vec<f64>,
    is_pressed: bool,
    /// Tangential and normal stiffness of a spring and its image together, N/m.
    stiffness: [f64; 2],
    /// κ.
    slope: f64,
    /// u, m.
    at: f64,
}

impl Half {
    /// Returns a row over `span`, m, in the initial state of a contact. The number of springs is a multiple of 64.
    pub(in crate::baseline) fn new(tie: &Tie, springs: usize, span: f64) -> Self {
        let (count, law) = (springs / 2, &tie.law);
        let width = span / springs as f64;
        let heights: Vec<f64> = (0..count).map(|i| law.profile().depth((i as f64 + 0.5) * width)).collect();
        let pair = 2.0 * width;
        // The indentation is that at which the springs carry the load, not that of the continuous profile.
        let held = law.normal_force(tie.start.apex().d) / (pair * law.normal_modulus());
        let (slope, d) = (law.stick_slope(), depth(&heights, held));
        let stretch = heights.iter().map(|h| tie.start.stretch(*h)).collect();
        let is_pressed = tie.press.is_some();
        let limit = |h: f64| slope * (d - h).max(0.0);
        let height = if is_pressed { heights } else { heights.into_iter().map(limit).collect() };
        let stiffness = [law.tangential_modulus(), law.normal_modulus()].map(|modulus| pair * modulus);
        Self { stretch, height, is_pressed, stiffness, slope, at: tie.start.apex().u }
    }

    /// Returns the sums of stretches and depths after a displacement `du`, m, at the indentation d. Springs out of contact have no
    /// stretch.
    #[inline(always)]
    fn sums<S: Simd, const KEEP: bool, const PRESSED: bool>(
        &mut self,
        simd: S,
        du: f64,
        d: f64,
    ) -> (f64, f64) {
        let zero = simd.splat_f64s(0.0);
        let (mut shear, mut depth) = ([zero; WAYS], [zero; WAYS]);
        let (du, d, slope) = (simd.splat_f64s(du), simd.splat_f64s(d), simd.splat_f64s(self.slope));
        let (stretch, _) = S::as_mut_simd_f64s(&mut self.stretch).0.as_chunks_mut::<WAYS>();
        let (height, _) = S::as_simd_f64s(&self.height).0.as_chunks::<WAYS>();
        for k in 0..stretch.len().min(height.len()) {
            for i in 0..WAYS {
                let mut limit = height[k][i];
                if PRESSED {
                    let rise = simd.max_f64s(simd.sub_f64s(d, limit), zero);
                    depth[i] = simd.add_f64s(depth[i], rise);
                    limit = simd.mul_f64s(slope, rise);
                }
                let moved = simd.min_f64s(simd.add_f64s(stretch[k][i], du), limit);
                let moved = simd.max_f64s(moved, simd.neg_f64s(limit));
                if KEEP {
                    stretch[k][i] = moved;
                }
                shear[i] = simd.add_f64s(shear[i], moved);
            }
        }
        (total(simd, shear), if PRESSED { total(simd, depth) } else { 0.0 })
    }
}

/// Returns the sum of all lanes.
#[inline(always)]
fn total<S: Simd>(simd: S, [a, b, c, d]: [S::f64s; WAYS]) -> f64 {
    simd.reduce_sum_f64s(simd.add_f64s(simd.add_f64s(a, b), simd.add_f64s(c, d)))
}

impl Contact for Half {
    const WIDE: bool = true;

    #[inline(always)]
    fn force<S: Simd, const KEEP: bool>(&mut self, simd: S, u: f64, d: f64) -> (f64, f64) {
        let du = u - self.at;
        if KEEP {
            self.at = u;
        }
        let (shear, depth) = if self.is_pressed {
            self.sums::<S, KEEP, true>(simd, du, d)
        } else {
            self.sums::<S, KEEP, false>(simd, du, d)
        };
        (self.stiffness[0] * shear, self.stiffness[1] * depth)
    }
}

/// Returns the indentation at which Σ(d-h) over the springs in contact equals a value, m. Heights ascend.
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
