//! A steady motion of the branch, with all that leads on from it.

use super::corrector::matrix;
use super::error::Trouble;
use super::happened::{Happened, Period};
use super::place::{Bench, Place, Slopes};
use crate::steady::{Kind, Multiplier, bound, multiplier};
use nalgebra::DVector;
use serde::{Deserialize, Serialize};
use stickslip_drive::scene::Axis;

/// A steady motion of the branch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// What is varied, SI.
    pub value: f64,
    /// Way of the figures' body along x in a period, m; none where no body is named or it is not free.
    pub step: Option<f64>,
    /// By how much that may be off, m.
    pub bound: f64,
    /// Period, s.
    pub period: f64,
    /// Floquet multipliers, the largest first.
    pub multipliers: Vec<Multiplier>,
    /// How many numbers the map of a period has.
    pub unknowns: usize,
    /// Which smooth piece of the branch it is on: another one begins where an event appears or vanishes.
    pub piece: usize,
}

/// The same with what leads on from it.
#[derive(Clone)]
pub(super) struct Standing {
    pub(super) place: Place,
    pub(super) slopes: Slopes,
    /// Along the branch, one long in its own length: numbers, then the varied one as a share of its range.
    pub(super) tangent: DVector<f64>,
    pub(super) happened: Happened,
    /// How well the map's moment keeps off the events before and after it: 0.5 in the middle between them, 0 at one.
    pub(super) margin: f64,
    /// Whether the figures' body slides all through and keeps any speed that it has: what pulls it is as much as friction holds.
    pub(super) is_loose: bool,
    pub(super) point: Point,
}

/// How lengths along a branch are counted.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    /// Length of a natural scale of a number, where the range of the varied one is 1.
    pub(super) weight: f64,
}

impl Measure {
    /// The range of the varied number counts as much as what the motion does in it, by its tangent (dx/dq, 1), at most.
    pub(super) fn of(tangent: &DVector<f64>) -> Self {
        let count = tangent.len() - 1;
        let change = tangent.rows(0, count).norm() / tangent[count].abs();
        Self { weight: 1.0 / change.max(1.0) }
    }

    /// The row that measures lengths along a tangent.
    pub(super) fn row(self, tangent: &DVector<f64>) -> DVector<f64> {
        let mut row = tangent * (self.weight * self.weight);
        let last = tangent.len() - 1;
        row[last] = tangent[last];
        row
    }

    pub(super) fn length(self, of: &DVector<f64>) -> f64 {
        self.row(of).dot(of).sqrt()
    }
}

/// The direction in which only the varied number counts.
pub(super) fn by_value(count: usize, sense: f64) -> DVector<f64> {
    let mut row = DVector::zeros(count + 1);
    row[count] = sense;
    row
}

impl Standing {
    /// A place made out: slopes, tangent, multipliers. The tangent goes on in the sense of a row.
    pub(super) fn of(
        bench: &Bench<'_>,
        place: Place,
        period: Period,
        (measure, row): (Option<Measure>, &DVector<f64>),
    ) -> Result<Self, Trouble> {
        let mut map = bench.map_at(&place)?;
        let body = place.variant.job.scenario.figures.body;
        let found = bound::bound(&mut map, &place.fixed, body)?;
        let section = map.section();
        let step = section.zip(body).and_then(|(s, body)| s.of_body(&place.fixed.image.way, body, Axis::X));
        drop(map);
        let slopes = Slopes { gradient: found.gradient, by_value: bench.by_value(&place)? };
        let count = slopes.by_value.len();
        let solved = matrix(&slopes, row).lu().solve(&by_value(count, 1.0));
        let solved = solved.filter(|t| t.iter().all(|x| x.is_finite()) && t.amax() > 0.0);
        let tangent = solved.ok_or(Trouble::Diverged)?;
        let measure = measure.unwrap_or_else(|| Measure::of(&tangent));
        let length = Some(measure.length(&tangent)).filter(|length| *length > 0.0 && length.is_finite());
        let tangent = tangent / length.ok_or(Trouble::Diverged)?;
        let point = Point {
            value: place.variant.value,
            step,
            bound: found.step,
            period: place.variant.drive.period,
            multipliers: multiplier::of(
                &slopes.gradient,
                (bench.options.tolerance, place.fixed.defect.amax()),
            ),
            unknowns: count,
            piece: 0,
        };
        let Period { happened, is_dragged, margin, .. } = period;
        let keeps = |multiplier: &Multiplier| multiplier.re > 0.0 && multiplier.kind() == Kind::Stays;
        let is_loose = is_dragged && point.multipliers.iter().any(keeps);
        Ok(Self { place, slopes, tangent, happened, margin, is_loose, point })
    }

    /// How many numbers the map has.
    pub(super) fn count(&self) -> usize {
        self.slopes.by_value.len()
    }

    /// How the varied number changes along the branch.
    pub(super) fn pace(&self) -> f64 {
        self.tangent[self.count()]
    }
}
