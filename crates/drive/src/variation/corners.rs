//! Corners and jumps of waveforms, which come when the waveforms say, and move with numbers of the scene.
//!
//! At a corner one law gives way to another at a time t that a number moves by δt: what is led along by the law of before goes on by
//! that of after, δ + (f₋ - f₊)δt.

use super::{Variation, VariationError};
use crate::contact::Contact;
use crate::equations::Equations;
use crate::state::State;
use stickslip_contact::{Apex, Memory};
use stickslip_stepper::System;

/// Corners that move apart by less than this, as a part of their way, move together.
const TOGETHER: f64 = 1e-6;

/// A corner at which an interval ends, as the law of before has it.
#[derive(Debug)]
pub(super) struct Corner {
    /// By how much each number of the scene moves it, s.
    times: Vec<f64>,
    /// Where contacts stand.
    places: Vec<Apex>,
    /// Slopes of the components where a number moves it.
    slopes: Vec<f64>,
}

/// Bodies that are this far apart before and after a corner, in natural scales, have not jumped.
const ROUNDING: f64 = 1e-9;

impl Variation<'_> {
    /// The corner at which an interval ends; none where it ends at none.
    pub(super) fn corner_at(&self, to: &State) -> Result<Option<Corner>, VariationError> {
        let turns = |w: &usize| to.pieces[*w].end <= to.t;
        let turning: Vec<usize> = (0..to.pieces.len()).filter(turns).collect();
        if turning.is_empty() {
            return Ok(None);
        }
        let mut times = Vec::with_capacity(self.parameters.len());
        for parameter in self.parameters {
            let mut moves = turning.iter().map(|w| parameter.corner(*w, &to.pieces[*w]));
            let first = moves.next().unwrap_or(0.0);
            if !first.is_finite() {
                return Err(VariationError::NotSmooth { t: to.t });
            }
            if moves.any(|other| (other - first).abs() > TOGETHER * first.abs().max(other.abs())) {
                return Err(VariationError::MovesApart { t: to.t });
            }
            times.push(first);
        }
        let slopes = if times.iter().all(|time| *time == 0.0) { Vec::new() } else { self.slopes(to) };
        Ok(Some(Corner { times, places: self.places(to), slopes }))
    }

    /// (δu, δd) of a contact by each number where an interval ends or begins, at a corner that moves with them.
    pub(super) fn moved_at_corner(&self, contact: &Contact, at: &State) -> Vec<(f64, f64)> {
        let mut moved = self.moved(contact, self.moment(at));
        let Some(corner) = self.corner.as_ref().filter(|corner| !corner.slopes.is_empty()) else {
            return moved;
        };
        let motion = Equations::on(self.model, at, self.layout, false).motion(contact, at.t, |i| at.y[i]);
        for (moved, time) in moved.iter_mut().rev().zip(corner.times.iter().rev()) {
            *moved = (moved.0 + motion.du * time, moved.1 + motion.dd * time);
        }
        moved
    }

    /// Follows bodies that jump, in no time, and leads derivatives over a corner that moves.
    pub(super) fn turn_corner(&mut self, state: &State) {
        let Some(corner) = &self.corner else { return };
        let apart = |(c, (before, after)): (usize, (&Apex, Apex))| {
            let natural = &self.model.contacts[c].natural;
            let [u, d] = [(after.u - before.u) / natural.displacement, (after.d - before.d) / natural.depth];
            (u.abs().max(d.abs()) > ROUNDING).then_some((c, d > ROUNDING))
        };
        let places = corner.places.iter().zip(self.places(state));
        let jumped: Vec<(usize, bool)> = places.enumerate().filter_map(apart).collect();
        for (c, has_grown) in jumped {
            let (contact, memory) = (&self.model.contacts[c], &state.memories[c]);
            if !contact.inert {
                // What an edge swept on the way has moved as the apex has.
                let (moved, steeper) = (self.moved_at_corner(contact, state), self.steeper(c));
                let has_edge = has_grown || ends_in_an_edge(contact, memory);
                self.anchors[c].follow((contact, memory), (&moved, &steeper), has_edge);
            }
        }
        let Some(Corner { times, slopes, .. }) =
            self.corner.take().filter(|corner| !corner.slopes.is_empty())
        else {
            return;
        };
        let (after, free, dimension) = (self.slopes(state), self.layout.free, self.layout.dimension());
        let first = self.count() - times.len();
        let powers = |slopes: &[f64]| [slopes[self.layout.input()], slopes[self.layout.damping()]];
        let powers = [&slopes, &after].map(|slopes| powers(slopes));
        if self.works.are_led() {
            times.iter().enumerate().for_each(|(j, time)| self.works.turn(j, powers, *time));
        }
        for (column, time) in self.columns.chunks_exact_mut(dimension).skip(first).zip(times) {
            for i in free..dimension {
                column[i] += (slopes[i] - after[i]) * time;
            }
        }
    }

    /// Where contacts stand, u counted from where bodies started: a corner may be the moment at which that is counted anew.
    fn places(&self, state: &State) -> Vec<Apex> {
        let eq = Equations::on(self.model, state, self.layout, false);
        let place = |contact: &Contact| {
            let at = eq.motion(contact, state.t, |i| state.y[i]).apex();
            Apex { u: at.u + state.shift(contact), ..at }
        };
        self.model.contacts.iter().map(place).collect()
    }

    /// Slopes of all components where the run stands.
    pub(super) fn slopes(&self, state: &State) -> Vec<f64> {
        let mut slopes = vec![0.0; self.layout.total()];
        Equations::on(self.model, state, self.layout, false).slopes(state.t, &state.y, &mut slopes);
        slopes
    }
}

/// Whether the last piece of a memory is one that an edge has made.
fn ends_in_an_edge(contact: &Contact, memory: &Memory) -> bool {
    let Memory::Curve(curve) = memory else { return false };
    let legs = curve.legs();
    legs.slopes.len().checked_sub(1).is_some_and(|last| legs.sense(&contact.interface, last).is_some())
}
