//! The gradient of the map, by differences.

use super::{Image, Map};
use crate::steady::SteadyError;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};
use stickslip_drive::State;

/// Difference on the way, in natural scales, by the tolerance t of the runs: √t leaves as much of an error from these as from a bend of 1.
pub(in crate::steady) fn near(tolerance: f64) -> f64 {
    tolerance.sqrt()
}

/// Differences to both sides at the end, a tenth of the cube root of t: at 1e-12 an error of 1e-7 from steps, and of 1e-10 from a bend
/// of 1. Twice as far something else happens more often.
fn fine(tolerance: f64) -> f64 {
    0.1 * math::cbrt(tolerance)
}

/// The gradient of a map.
#[derive(Clone, Serialize, Deserialize)]
pub(in crate::steady) struct Gradient {
    /// Of the numbers, in natural scales.
    pub(in crate::steady) numbers: DMatrix<f64>,
    /// Of the way of each free coordinate, m or rad per natural scale.
    pub(in crate::steady) way: DMatrix<f64>,
    /// Numbers whose columns are not known: disturbed by one of them memories come back with other knots.
    pub(in crate::steady) unknown: Vec<usize>,
    /// What differences miss where the map bends between them, by the root of the sum of squares of all entries.
    pub(in crate::steady) missed: f64,
}

/// What an image changes by with one number, by differences.
struct Slope {
    numbers: DVector<f64>,
    /// Of the way.
    way: Vec<f64>,
    /// By how much the slopes of both sides, or of two distances, differ, and what is missed; none where there is one difference alone.
    bend: Option<[f64; 2]>,
}

/// Bends of a column that are no more than this may be a corner: what is missed is less than a multiplier is told by.
const CORNER: f64 = 1e-6;
/// How many times nearer differences are taken where they are more.
const NEARER: f64 = 4.0;

impl Slope {
    /// With by how much the slopes of both sides, or of two distances, differ. What a smooth bend leaves goes with the square of that.
    fn bent_by(self, bend: f64) -> Self {
        let size = self.numbers.norm();
        let missed = if bend < size { bend * bend / size } else { bend };
        Self { bend: Some([bend, missed]), ..self }
    }

    /// The slope by differences that lie nearer, where both are not the same but for noise: between the farther ones lies a corner.
    fn or_nearer(self, inner: Self, noise: f64) -> Self {
        let off = (&self.numbers - &inner.numbers).norm();
        if off <= noise {
            return self;
        }
        // A corner between the nearer ones misleads them by no more than their sides differ.
        let bend = inner.bend.map_or(off, |[bend, _]| bend.min(off));
        Self { bend: Some([bend; 2]), ..inner }
    }
}

impl Gradient {
    /// How far entries may be off by runs that are led by a tolerance: differences of images magnify that by their distance.
    // Of bouncing bodies that nothing damps along z, |λ| = 1 by differences was up to 1.8e-4 off at 1e-9, and 7e-3 at 1e-6.
    pub(in crate::steady) fn noise(tolerance: f64) -> f64 {
        3.0 * tolerance / fine(tolerance)
    }
}

impl Map<'_> {
    /// The gradient at a state whose image is known, by one difference for each number, so far apart in natural scales.
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

    /// The gradient by differences to both sides, or to one, twice as far as well, where the other is of another kind: its memories
    /// have other knots, or something else happens on the way.
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

    /// What a number changes by a difference of two images, ahead and behind, that lie so far apart.
    fn slope(&self, [ahead, behind]: [&Image; 2], apart: f64) -> Option<Slope> {
        let difference = self.difference(&ahead.state, &behind.state)?;
        let way = ahead.way.iter().zip(&behind.way).map(|(ahead, behind)| (ahead - behind) / apart);
        Some(Slope { numbers: difference / apart, way: way.collect(), bend: None })
    }

    /// The same by images so far ahead and behind of one.
    fn central(&self, [ahead, image, behind]: [&Image; 3], by: f64) -> Option<Slope> {
        let half = self.slope([ahead, image], by)?;
        let slope = self.slope([ahead, behind], 2.0 * by)?;
        let bend = 2.0 * (half.numbers - &slope.numbers).norm();
        Some(slope.bent_by(bend))
    }

    /// The same to one side alone, by an image so far off and one twice as far: (4f₁ - f₂ - 3f₀)/2h, which a bend does not move.
    fn aside(&self, image: &Image, [one, far]: [&Image; 2], by: f64) -> Option<Slope> {
        let near = self.slope([one, image], by)?;
        let twice = self.slope([far, image], 2.0 * by)?;
        let way = near.way.iter().zip(&twice.way).map(|(near, twice)| 2.0 * near - twice).collect();
        let bend = (&near.numbers - &twice.numbers).norm();
        Some(Slope { numbers: near.numbers * 2.0 - twice.numbers, way, bend: None }.bent_by(bend))
    }

    /// A gradient from what each number changes. One that cannot be moved leaves nothing behind, and its column is not known.
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
        // One difference to one side alone tells nothing of a bend: those of the others stand for it.
        let unseen = if known > 0.0 { bends * (all - known) / known } else { 0.0 };
        gradient.missed = (missed + unseen).sqrt();
        Ok(gradient)
    }

    /// The image of a state with one number moved, if both have the knots of the others.
    fn beside(&mut self, state: &State, (j, by): (usize, f64)) -> Result<Option<Image>, SteadyError> {
        let mut along = DVector::zeros(self.scales.len());
        along[j] = by;
        let Some(moved) = self.moved(state, &along) else { return Ok(None) };
        let image = self.image(&moved, 1.0)?;
        let alike = self.difference(&image.state, state).is_some();
        Ok(alike.then_some(image))
    }
}
