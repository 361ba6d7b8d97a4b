//! Drift directions of a drive, along which only the position changes.
//!
//! If no spring, actuator, coupled contact or block depends on a coordinate, a shift of the coordinate and of its slip memories changes no
//! force. Bodies that are only connected with each other drift together.

use crate::Model;
use crate::model::{Measure, Wire};

/// Relative size below which the coefficient of a coordinate in a length counts as zero.
const NOTHING: f64 = 1e-12;

/// Direction in which the drive may travel from period to period.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Drift {
    /// Coordinate that measures the drift.
    pub(super) pivot: usize,
    /// Displacement of each free coordinate per unit displacement of the coordinate `pivot`.
    pub(super) shape: Vec<f64>,
}

/// Returns all drift directions, each measured by a different coordinate.
pub(super) fn drifts(model: &Model) -> Vec<Drift> {
    let count = model.free.len();
    let mut rows: Vec<Vec<f64>> = measures(model).map(|measure| row(measure, count)).collect();
    // Elimination starts with the last coordinate, so that the first of connected coordinates measures the drift.
    let mut leading: Vec<(usize, usize)> = Vec::new();
    let mut next = 0;
    for column in (0..count).rev() {
        let largest =
            (next..rows.len()).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()));
        let Some(pivot) = largest.filter(|r| rows[*r][column].abs() > NOTHING) else { continue };
        rows.swap(next, pivot);
        let head = rows[next][column];
        rows[next].iter_mut().for_each(|entry| *entry /= head);
        let own = rows[next].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(r, _)| *r != next) {
            let factor = row[column];
            row.iter_mut().zip(&own).for_each(|(entry, own)| *entry -= factor * own);
        }
        leading.push((column, next));
        next += 1;
    }
    let is_free = |i: &usize| leading.iter().all(|(column, _)| column != i);
    let shape = |i: usize| {
        let mut shape = vec![0.0; count];
        shape[i] = 1.0;
        for (column, r) in &leading {
            shape[*column] = -rows[*r][i];
        }
        Drift { pivot: i, shape }
    };
    (0..count).filter(is_free).map(shape).collect()
}

/// Returns the lengths on which forces depend.
fn measures(model: &Model) -> impl Iterator<Item = &Measure> {
    // A damper alone does not fix a position.
    let holding = model.links.iter().filter(|link| link.stiffness != 0.0);
    let links = holding.map(|link| &link.elongation);
    let pulls = model.balanced.iter().flat_map(|b| b.pull.links.iter().chain(&b.own.links));
    let pressing = model.contacts.iter().filter_map(|contact| contact.coupling());
    let lengths = model.blocks.iter().flat_map(|block| &block.wires).filter_map(|wire| match wire {
        Wire::Length(measure) => Some(measure),
        Wire::Signal(_) => None,
    });
    links.chain(pulls.map(|(link, _)| &link.elongation)).chain(pressing).chain(lengths)
}

fn row(measure: &Measure, count: usize) -> Vec<f64> {
    let mut row = vec![0.0; count];
    measure.free.iter().for_each(|(i, a)| row[*i] += a);
    // Normalised by the largest entry, because arms of a pitch are lengths.
    let largest = row.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
    if largest > 0.0 {
        row.iter_mut().for_each(|a| *a /= largest);
    }
    row
}
