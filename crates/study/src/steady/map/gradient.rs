//! Jacobian of the Poincaré map by finite differences.

use super::{Image, Map};
use crate::steady::SteadyError;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};
use stickslip_drive::State;

/// Returns the distance of one-sided differences during the search, in natural scales: √t for the tolerance t. The error from integration
/// then equals the error from a curvature of 1.
pub(in crate::steady) fn near(tolerance: f64) -> f64 {
    tolerance.sqrt()
}

/// Returns the distance of central differences at the fixed point: a tenth of the cube root of the tolerance t. At t = 1e-12, errors are
/// 1e-7 from integration and 1e-10 from a curvature of 1.
fn fine(tolerance: f64) -> f64 {
    0.1 * math::cbrt(tolerance)
}

/// Jacobian of the Poincaré map.
#[derive(Clone, Serialize, Deserialize)]
pub(in crate::steady) struct Gradient {
    /// Derivatives of the unknowns, in natural scales.
    pub(in crate::steady) numbers: DMatrix<f64>,
    /// Derivatives of the displacement of each free coordinate, m or rad per natural scale.
    pub(in crate::steady) way: DMatrix<f64>,
    /// Indices of columns without derivative, because a disturbance of these unknowns changes the number of breakpoints of a slip memory.
    pub(in crate::steady) unknown: Vec<usize>,
    /// Error of the finite differences due to curvature, as Frobenius norm.
    pub(in crate::steady) missed: f64,
}

/// Derivative of the image with respect to one unknown.
struct Slope {
    numbers: DVector<f64>,
    /// Derivative of the displacements with respect to this unknown.
    way: Vec<f64>,
    /// Difference between both one-sided derivatives or two distances, and estimated error. `None` for a single difference.
    bend: Option<[f64; 2]>,
}

/// Difference of one-sided derivatives above which a corner is possible. Smaller differences cause errors below the resolution of
/// multipliers.
const CORNER: f64 = 1e-6;
/// Ratio of the two distances that distinguish curvature from a corner.
const NEARER: f64 = 4.0;

impl Slope {
    /// Sets the difference of the one-sided derivatives. For a smooth map the error is proportional to the square of this difference.
    fn bent_by(self, bend: f64) -> Self {
        let size = self.numbers.norm();
        let missed = if bend < size { bend * bend / size } else { bend };
        Self { bend: Some([bend, missed]), ..self }
    }

    /// Returns the derivative from closer differences if both derivatives differ by more than noise, as at a corner in between.
    fn or_nearer(self, inner: Self, noise: f64) -> Self {
        let off = (&self.numbers - &inner.numbers).norm();
        if off <= noise {
            return self;
        }
        // A corner within the closer differences causes an error below the difference of the one-sided derivatives.
        let bend = inner.bend.map_or(off, |[bend, _]| bend.min(off));
        Self { bend: Some([bend; 2]), ..inner }
    }
}

impl Gradient {
    /// Returns the error of the entries due to the tolerance of the runs: integration error divided by distance.
    pub(in crate::steady) fn noise(tolerance: f64) -> f64 {
        3.0 * tolerance / fine(tolerance)
    }
}

impl Map<'_> {
    /// Computes the Jacobian at a state with known image, by one-sided differences of distance `near`, in natural scales.
    pub(in crate::steady) fn near_gradient(
        &mut self,
        (state, image): (&State, &Image),
        near: f64,
    ) -> Result<Gradient, SteadyError> {
        self.gradient(image, |map, j| {
            let beside = map.beside(state, (j, near))?;
            Ok(beside.and_then(|beside| map.slope([&beside, image], near)))
        })
    }

    /// Computes the Jacobian by central differences.
    ///
    /// If one side has other events or another number of breakpoints of the slip memory, two one-sided differences are used.
    pub(in crate::steady) fn fine_gradient(
        &mut self,
        state: &State,
        image: &Image,
    ) -> Result<Gradient, SteadyError> {
        let tolerance = self.options.tolerance;
        let fine = fine(tolerance);
        self.gradient(image, |map, j| {
            let pair = |map: &mut Self, by: f64| -> Result<[Option<Image>; 2], SteadyError> {
                let sides = [map.beside(state, (j, by))?, map.beside(state, (j, -by))?];
                let counts = image.sides([sides[0].as_ref(), sides[1].as_ref()]);
                let [ahead, behind] = sides;
                Ok([ahead.filter(|_| counts[0]), behind.filter(|_| counts[1])])
            };
            let [ahead, behind] = pair(map, fine)?;
            let (one, by) = match (ahead, behind) {
                (Some(ahead), Some(behind)) => {
                    let Some(outer) = map.central([&ahead, image, &behind], fine) else { return Ok(None) };
                    if outer.bend.is_none_or(|[bend, _]| bend <= CORNER) {
                        return Ok(Some(outer));
                    }
                    let [Some(ahead), Some(behind)] = pair(map, fine / NEARER)? else {
                        return Ok(Some(outer));
                    };
                    let Some(inner) = map.central([&ahead, image, &behind], fine / NEARER) else {
                        return Ok(Some(outer));
                    };
                    return Ok(Some(outer.or_nearer(inner, NEARER * Gradient::noise(tolerance))));
                }
                (Some(one), None) => (one, fine),
                (None, Some(one)) => (one, -fine),
                (None, None) => return Ok(None),
            };
            let far = map.beside(state, (j, 2.0 * by))?.filter(|far| image.sides([Some(far), None])[0]);
            Ok(match far {
                Some(far) => map.aside(image, [&one, &far], by),
                None => map.slope([&one, image], by),
            })
        })
    }

    /// Returns the derivative from two images of states at a distance of `apart`.
    fn slope(&self, [ahead, behind]: [&Image; 2], apart: f64) -> Option<Slope> {
        let difference = self.difference(&ahead.state, &behind.state)?;
        let way = ahead.way.iter().zip(&behind.way).map(|(ahead, behind)| (ahead - behind) / apart);
        Some(Slope { numbers: difference / apart, way: way.collect(), bend: None })
    }

    /// Returns the central difference from the images of states ahead and behind.
    fn central(&self, [ahead, image, behind]: [&Image; 3], by: f64) -> Option<Slope> {
        let half = self.slope([ahead, image], by)?;
        let slope = self.slope([ahead, behind], 2.0 * by)?;
        let bend = 2.0 * (half.numbers - &slope.numbers).norm();
        Some(slope.bent_by(bend))
    }

    /// Returns the one-sided difference of second order, (4f₁ - f₂ - 3f₀)/2h.
    fn aside(&self, image: &Image, [one, far]: [&Image; 2], by: f64) -> Option<Slope> {
        let near = self.slope([one, image], by)?;
        let twice = self.slope([far, image], 2.0 * by)?;
        let way = near.way.iter().zip(&twice.way).map(|(near, twice)| 2.0 * near - twice).collect();
        let bend = (&near.numbers - &twice.numbers).norm();
        Some(Slope { numbers: near.numbers * 2.0 - twice.numbers, way, bend: None }.bent_by(bend))
    }

    /// Assembles the Jacobian from its columns. Columns that cannot be computed are zero and are listed in `unknown`.
    fn gradient(
        &mut self,
        image: &Image,
        mut slope: impl FnMut(&mut Self, usize) -> Result<Option<Slope>, SteadyError>,
    ) -> Result<Gradient, SteadyError> {
        let count = self.scales.len();
        let mut gradient = Gradient {
            numbers: DMatrix::zeros(count, count),
            way: DMatrix::zeros(image.way.len(), count),
            unknown: Vec::new(),
            missed: 0.0,
        };
        let (mut bends, mut known, mut all, mut missed) = (0.0, 0.0, 0.0, 0.0);
        for j in 0..count {
            let Some(Slope { numbers, way, bend }) = slope(self, j)? else {
                gradient.unknown.push(j);
                continue;
            };
            let size = numbers.norm_squared();
            all += size;
            if let Some([bend, off]) = bend {
                (bends, known, missed) = (bends + bend * bend, known + size, missed + off * off);
            }
            gradient.numbers.set_column(j, &numbers);
            gradient.way.set_column(j, &DVector::from_vec(way));
        }
        // A single one-sided difference does not show curvature; the curvature of the other columns is used instead.
        let unseen = if known > 0.0 { bends * (all - known) / known } else { 0.0 };
        gradient.missed = (missed + unseen).sqrt();
        Ok(gradient)
    }

    /// Returns the image of a state with one changed unknown, or `None` if the number of breakpoints of a slip memory changes.
    fn beside(&mut self, state: &State, (j, by): (usize, f64)) -> Result<Option<Image>, SteadyError> {
        let mut along = DVector::zeros(self.scales.len());
        along[j] = by;
        let Some(moved) = self.moved(state, &along) else { return Ok(None) };
        let image = self.image(&moved, 1.0)?;
        let alike = self.difference(&image.state, state).is_some();
        Ok(alike.then_some(image))
    }
}
