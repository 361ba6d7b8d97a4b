//! Periodic orbit of a branch with all data for the next step.

use super::corrector::matrix;
use super::error::Trouble;
use super::happened::{Happened, Period};
use super::place::{Bench, Place, Slopes};
use crate::steady::{Kind, Multiplier, bound, multiplier};
use nalgebra::DVector;
use serde::{Deserialize, Serialize};
use stickslip_drive::scene::Axis;

/// Periodic orbit of a branch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Value of the parameter, SI.
    pub value: f64,
    /// Displacement of the body named in `figures` along x per period, m. `None` if no body is named or the body is not free.
    pub step: Option<f64>,
    /// Error of the step length, m.
    pub bound: f64,
    /// Period, s.
    pub period: f64,
    /// Floquet multipliers in descending order of modulus.
    pub multipliers: Vec<Multiplier>,
    /// Number of unknowns of the Poincaré map.
    pub unknowns: usize,
    /// Number of the smooth piece of the branch. A new piece starts where an event appears or vanishes.
    pub piece: usize,
}

/// Periodic orbit with its derivatives and tangent.
#[derive(Clone)]
pub(super) struct Standing {
    pub(super) place: Place,
    pub(super) slopes: Slopes,
    /// Unit tangent of the branch: unknowns, then the parameter as a fraction of its range.
    pub(super) tangent: DVector<f64>,
    pub(super) happened: Happened,
    /// Relative distance of the Poincaré section from the nearest event: 0.5 midway between two events, 0 at an event.
    pub(super) margin: f64,
    /// True if the body named in `figures` slides during the whole period at any velocity, because the load equals the friction limit.
    pub(super) is_loose: bool,
    pub(super) point: Point,
}

/// Metric of the arclength along a branch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    /// Weight of an unknown in natural scales; the parameter as a fraction of its range has weight 1.
    pub(super) weight: f64,
}

impl Measure {
    /// Returns the metric for the first tangent (dx/dq, 1). The state contributes at most as much as the parameter.
    pub(super) fn of(tangent: &DVector<f64>) -> Self {
        let count = tangent.len() - 1;
        let change = tangent.rows(0, count).norm() / tangent[count].abs();
        Self { weight: 1.0 / change.max(1.0) }
    }

    /// Returns the row vector whose product with a change of the unknowns is the length along the tangent.
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

/// Returns the row vector that selects the parameter.
pub(super) fn by_value(count: usize, sense: f64) -> DVector<f64> {
    let mut row = DVector::zeros(count + 1);
    row[count] = sense;
    row
}

impl Standing {
    /// Computes derivatives, tangent and multipliers of an orbit. The tangent points in the direction of `row`.
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

    /// Returns the number of unknowns of the map.
    pub(super) fn count(&self) -> usize {
        self.slopes.by_value.len()
    }

    /// Returns the change of the parameter per length of the branch: the component of the tangent along the parameter.
    pub(super) fn pace(&self) -> f64 {
        self.tangent[self.count()]
    }
}
