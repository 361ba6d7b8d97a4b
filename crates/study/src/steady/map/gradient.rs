//! The gradient of the map: by the variation of a run where there is one, else by differences.

use super::{Image, Map};
use crate::steady::SteadyError;
use nalgebra::{DMatrix, DVector};
use stickslip_drive::State;
use stickslip_drive::section::Section;

/// Differences on the way, in natural scales: steps of 1e-12 leave an error of 1e-6, and so does a bend of 1.
const NEAR: f64 = 1e-6;
/// Differences to both sides at the end: an error of 1e-7 from steps, and of 1e-10 from a bend of 1.
const FINE: f64 = 1e-5;

/// The gradient of a map.
#[derive(Clone)]
pub(in crate::steady) struct Gradient {
    /// Of the numbers, in natural scales.
    pub(in crate::steady) numbers: DMatrix<f64>,
    /// Of the way of each free coordinate, m or rad per natural scale.
    pub(in crate::steady) way: DMatrix<f64>,
    /// Whether it is exact, but for the tolerance of the run.
    pub(in crate::steady) is_exact: bool,
    /// Numbers whose columns are not known: disturbed by one of them memories come back with other knots.
    pub(in crate::steady) unknown: Vec<usize>,
    /// What differences miss where the map bends between them, as a share of the size of all entries: of those to both sides in second
    /// order, of one to one side alone in first.
    pub(in crate::steady) missed: f64,
}

/// What an image changes by with one number, by differences.
struct Slope {
    numbers: DVector<f64>,
    /// Of the way.
    way: Vec<f64>,
    /// Squares of a second difference and of the first one; none where there is one difference alone.
    bend: Option<[f64; 2]>,
}

impl Gradient {
    /// How far entries may be off by runs that are led by a tolerance: differences of images magnify that by their distance.
    // Of bouncing bodies that nothing damps along z, |λ| = 1 by differences was up to 1.8e-4 off at 1e-9, and 7e-3 at 1e-6.
    pub(in crate::steady) fn noise(&self, tolerance: f64) -> f64 {
        if self.is_exact { 0.0 } else { 3.0 * tolerance / FINE }
    }
}

impl Map<'_> {
    /// The gradient at a state by the variation of a run, if it has one: that of its image, if that has come with it.
    fn exact_gradient(&mut self, state: &State, image: &Image) -> Result<Option<Gradient>, SteadyError> {
        let tolerance = self.options.tolerance;
        let varies = |section: &Section<'_>| section.variation((state, &[]), tolerance).is_ok();
        match &image.gradient {
            Some(gradient) => Ok(Some(gradient.clone())),
            None if self.section.as_ref().is_some_and(varies) => {
                Ok(self.image_with_gradient(state)?.gradient)
            }
            None => Ok(None),
        }
    }

    /// The gradient at a state whose image is known, else by one difference for each number.
    pub(in crate::steady) fn near_gradient(
        &mut self,
        state: &State,
        image: &Image,
    ) -> Result<Gradient, SteadyError> {
        if let Some(gradient) = self.exact_gradient(state, image)? {
            return Ok(gradient);
        }
        self.gradient(image, |map, j| {
            let beside = map.beside(state, (j, NEAR))?;
            Ok(beside.and_then(|beside| map.slope(([&beside, image], NEAR), None)))
        })
    }

    /// The gradient, else by differences to both sides, or to one, twice as far as well, where the other is of another kind: its memories
    /// have other knots, or something else happens on the way.
    pub(in crate::steady) fn fine_gradient(
        &mut self,
        state: &State,
        image: &Image,
    ) -> Result<Gradient, SteadyError> {
        if let Some(gradient) = self.exact_gradient(state, image)? {
            return Ok(gradient);
        }
        self.gradient(image, |map, j| {
            let [ahead, behind] = [map.beside(state, (j, FINE))?, map.beside(state, (j, -FINE))?];
            let sides = image.sides([ahead.as_ref(), behind.as_ref()]);
            let [ahead, behind] =
                [(ahead, sides[0]), (behind, sides[1])].map(|(side, counts)| side.filter(|_| counts));
            let (one, by) = match (ahead, behind) {
                (Some(ahead), Some(behind)) => {
                    return Ok(map.slope(([&ahead, &behind], 2.0 * FINE), Some([&ahead, image])));
                }
                (Some(one), None) => (one, FINE),
                (None, Some(one)) => (one, -FINE),
                (None, None) => return Ok(None),
            };
            let far = map.beside(state, (j, 2.0 * by))?.filter(|far| image.sides([Some(far), None])[0]);
            Ok(match far {
                Some(far) => map.aside(image, [&one, &far], by),
                None => map.slope(([&one, image], by), None),
            })
        })
    }

    /// What a number changes by a difference of two images, ahead and behind, that lie so far apart; of one to both sides by how much its
    /// halves differ tells the difference of one of them.
    fn slope(
        &self,
        ([ahead, behind], apart): ([&Image; 2], f64),
        half: Option<[&Image; 2]>,
    ) -> Option<Slope> {
        let difference = self.difference(&ahead.state, &behind.state)?;
        let bend = half.and_then(|[ahead, image]| self.difference(&ahead.state, &image.state));
        let bend = bend.map(|half| [(&half * 2.0 - &difference).norm_squared(), difference.norm_squared()]);
        let way = ahead.way.iter().zip(&behind.way).map(|(ahead, behind)| (ahead - behind) / apart);
        Some(Slope { numbers: difference / apart, way: way.collect(), bend })
    }

    /// The same to one side alone, by an image so far off and one twice as far: (4f₁ - f₂ - 3f₀)/2h, which a bend does not move.
    fn aside(&self, image: &Image, [one, far]: [&Image; 2], by: f64) -> Option<Slope> {
        let near = self.slope(([one, image], by), None)?;
        let twice = self.slope(([far, image], by), None)?;
        let bent = &twice.numbers - &near.numbers * 2.0;
        let numbers = &near.numbers * 2.0 - &twice.numbers * 0.5;
        let way = near.way.iter().zip(&twice.way).map(|(near, twice)| 2.0 * near - 0.5 * twice);
        let bend = Some([bent.norm_squared(), (&numbers * 2.0).norm_squared()]);
        Some(Slope { numbers, way: way.collect(), bend })
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
            is_exact: false,
            unknown: Vec::new(),
            missed: 0.0,
        };
        let (mut bends, mut changes, mut order) = (0.0, 0.0, 2);
        for j in 0..count {
            let Some(Slope { numbers, way, bend }) = slope(self, j)? else {
                gradient.unknown.push(j);
                continue;
            };
            match bend {
                Some([bend, change]) => (bends, changes) = (bends + bend, changes + change),
                // One difference to one side alone tells nothing of a bend.
                None => order = 1,
            }
            gradient.numbers.set_column(j, &numbers);
            gradient.way.set_column(j, &DVector::from_vec(way));
        }
        // Second differences to first ones.
        gradient.missed = if changes > 0.0 { f64::sqrt(bends / changes).powi(order) } else { 0.0 };
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
