//! The gradient of the map of a period, by the variation of a run.

use super::{Section, Unknown};
use crate::contact::Contact;
use crate::variation::Anchors;
use crate::{Parameter, State, Variation, VariationError};
use stickslip_contact::{Legs, Memory};

/// How the state of a period later changes with the numbers of the one that it came from, both in natural scales, and with those of the
/// scene, where the state is led along by them.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// Derivatives of the numbers, row by row, each by every number, those of the scene last.
    pub numbers: Vec<Vec<f64>>,
    /// Derivatives of the way of each free coordinate, m or rad, likewise.
    pub way: Vec<Vec<f64>>,
}

impl<'m> Section<'m> {
    /// The variation of a run that begins with a state at the section, by all its numbers in natural scales, and by `parameters` of the
    /// scene, with which no number of the state moves. The run's own local error per step, `tolerance`, tells which turns are as good as
    /// none.
    ///
    /// # Errors
    ///
    /// A scene with a part whose variation is not known.
    pub fn variation(
        &self,
        (state, parameters): (&State, &'m [Parameter]),
        tolerance: f64,
    ) -> Result<Variation<'m>, VariationError> {
        let (model, layout) = (self.model, self.model.layout());
        // Another drift leads to other places.
        if self.drifts.iter().any(|drift| parameters.iter().any(|number| number.lengthens(&drift.shape))) {
            return Err(VariationError::Form);
        }
        let (count, scales) = (self.unknowns.len() + parameters.len(), self.scales());
        let mut columns = vec![0.0; count * layout.dimension()];
        for ((unknown, scale), column) in
            self.unknowns.iter().zip(&scales).zip(columns.chunks_exact_mut(layout.dimension()))
        {
            match *unknown {
                Unknown::Place(i) => column[i] = *scale,
                Unknown::Speed(i) => column[layout.velocity(i)] = *scale,
                Unknown::Own(k) => column[layout.block(k)] = *scale,
                Unknown::Height(..) | Unknown::Slope(..) => {}
            }
        }
        let anchors = model.contacts.iter().zip(&state.memories).map(|(contact, memory)| {
            let Memory::Curve(curve) = memory else { return Anchors::default() };
            let (legs, d) = (curve.legs(), memory.apex().d);
            let each = self.unknowns.iter().zip(&scales).zip(columns.chunks_exact(layout.dimension()));
            let by_state = each.map(|((unknown, scale), column)| {
                let [height, slope] = own(contact, *unknown, *scale);
                lines((&legs, d), height, |piece| at(slope, piece), apex(contact, column))
            });
            // Edges are as steep as the law has them.
            let by_scene = parameters.iter().map(|parameter| {
                let sense = |piece| legs.sense(&contact.interface, piece).unwrap_or(0.0);
                let turn = |piece| sense(piece) * parameter.slope(contact.place);
                lines((&legs, d), None, turn, parameter.moves(contact, model, state))
            });
            let by_number: Vec<Vec<[f64; 2]>> = by_state.chain(by_scene).collect();
            let lines =
                (0..legs.slopes.len()).flat_map(|piece| by_number.iter().map(move |lines| lines[piece]));
            Anchors::new(count, lines.collect())
        });
        let anchors = anchors.collect();
        Variation::new((model, parameters), (columns, anchors), tolerance)
    }

    /// What a [finished](Variation::finish) variation says of the state a period later, brought [back](Self::back) to the section;
    /// none where its memories have other knots than the section's.
    #[must_use]
    pub fn gradient(&self, variation: &Variation<'_>, end: &State) -> Option<Gradient> {
        let layout = self.model.layout();
        let (count, scales) = (variation.count(), self.scales());
        let of = |place: usize, j: usize| variation.column(j).map_or(0.0, |column| column[place]);
        let along = |i: usize, j: usize| -> f64 {
            self.drifts.iter().map(|drift| drift.shape[i] * of(drift.pivot, j)).sum()
        };
        let number = |unknown: &Unknown, j: usize| match *unknown {
            Unknown::Place(i) => Some(of(i, j) - along(i, j)),
            Unknown::Speed(i) => Some(of(layout.velocity(i), j)),
            Unknown::Own(k) => Some(of(layout.block(k), j)),
            Unknown::Height(c, k) => height(&end.memories[c], variation.anchors(c), (k, j)),
            Unknown::Slope(c, k) => variation.anchors(c).line(k, j).map(|[_, slope]| slope),
        };
        let row = |(unknown, scale): (&Unknown, &f64)| {
            (0..count).map(|j| number(unknown, j).map(|number| number / scale)).collect::<Option<Vec<f64>>>()
        };
        let numbers = self.unknowns.iter().zip(&scales).map(row).collect::<Option<Vec<_>>>()?;
        let way = (0..layout.free).map(|i| (0..count).map(|j| along(i, j)).collect()).collect();
        Some(Gradient { numbers, way })
    }
}

/// (δu, δd) of a contact.
fn apex(contact: &Contact, column: &[f64]) -> (f64, f64) {
    let of = |free: &[(usize, f64)]| free.iter().map(|(i, a)| a * column[*i]).sum();
    (of(&contact.u.free), contact.coupling().map_or(0.0, |d| of(&d.free)))
}

/// What a number is of a contact's memory: δh of a knot, or δk of a piece, by its place.
fn own(contact: &Contact, unknown: Unknown, scale: f64) -> [Option<(usize, f64)>; 2] {
    match unknown {
        Unknown::Height(c, k) if c == contact.place => [Some((k, scale)), None],
        Unknown::Slope(c, k) if c == contact.place => [None, Some((k, scale))],
        _ => [None; 2],
    }
}

/// By how much a number moves what has a place.
fn at(number: Option<(usize, f64)>, place: usize) -> f64 {
    number.filter(|(k, _)| *k == place).map_or(0.0, |(_, by)| by)
}

/// By how much anchors move, piece by piece from the centre, as a form changes that stands where its contact does: at a knot a
/// line goes on from the one above, δp = δp' + (k' - k)δh there, and at the apex from (δu, δd).
fn lines(
    (legs, d): (&Legs, f64),
    height: Option<(usize, f64)>,
    turn: impl Fn(usize) -> f64,
    apex: (f64, f64),
) -> Vec<[f64; 2]> {
    let mut lines = vec![[0.0; 2]; legs.slopes.len()];
    for piece in (0..lines.len()).rev() {
        let (top, k) = (legs.heights.get(piece).copied().unwrap_or(d), legs.slopes[piece]);
        let value = match (lines.get(piece + 1), legs.slopes.get(piece + 1)) {
            (Some([a, b]), Some(above)) => a + b * top + (above - k) * at(height, piece),
            _ => apex.0 - k * apex.1,
        };
        let turn = turn(piece);
        lines[piece] = [value - turn * top, turn];
    }
    lines
}

/// δh of a knot: where the lines of both its pieces meet.
fn height(memory: &Memory, anchors: &Anchors, (k, j): (usize, usize)) -> Option<f64> {
    let Memory::Curve(curve) = memory else { return None };
    let legs = curve.legs();
    let (h, bend) = (legs.heights.get(k)?, legs.slopes.get(k + 1)? - legs.slopes.get(k)?);
    let [below, above] = [anchors.line(k, j)?, anchors.line(k + 1, j)?];
    Some((below[0] - above[0] + (below[1] - above[1]) * h) / bend)
}
