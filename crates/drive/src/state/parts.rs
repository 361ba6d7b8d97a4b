//! The state of a whole and those of its parts.
//!
//! Between two calls the state of the whole has all: components, memories and modes are those of the parts side by side, and
//! what parts do not share, such as a time and a step of their own, is kept beside them.

use super::{Counts, State, Underway};
use crate::method::Tally;
use crate::model::Part;
use crate::{Model, Piece};

/// What is a part's own beside its components, memories and modes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PartWay {
    /// Where it stands, s: between two steps of its own, at most one of them before the whole.
    pub(crate) t: f64,
    pub(crate) step: f64,
    pub(crate) stuck_step: f64,
    pub(crate) pieces: Vec<Piece>,
    pub(crate) energies: Energies,
    /// What the whole has counted of it.
    pub(crate) counts: Counts,
    pub(crate) tally: Tally,
    pub(crate) underway: Option<Underway>,
}

/// Energies that add up in the whole, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Energies {
    /// Put in and taken by dampers, as integrals.
    pub(crate) input: f64,
    pub(crate) damping: f64,
    /// As in the [`State`].
    pub(crate) jumps: f64,
    pub(crate) lost: f64,
    pub(crate) origin: f64,
}

impl State {
    /// What its parts have for themselves; none where it was never parted.
    pub(crate) fn parts(&self) -> Option<&[PartWay]> {
        match &self.underway {
            Some(Underway::Parts(ways)) => Some(ways),
            Some(Underway::Located(_) | Underway::Fixed(_)) | None => None,
        }
    }

    /// Whether all its parts stand where it stands.
    pub(crate) fn is_level(&self) -> bool {
        self.parts().is_none_or(|ways| ways.iter().all(|way| way.t == self.t))
    }

    /// Sees to it that every part has what is its own. Where the run before knew no parts, their laws are chosen anew, and the
    /// first one has the energies that cannot be told apart.
    pub(crate) fn divide(&mut self, model: &Model) {
        if self.parts().is_some() {
            return;
        }
        let layout = self.layout(model);
        let all = Energies {
            input: self.y[layout.input()],
            damping: self.y[layout.damping()],
            jumps: self.jumps,
            lost: self.lost,
            origin: self.origin,
        };
        let way = |(k, part): (usize, &Part)| PartWay {
            t: self.t,
            step: self.step,
            stuck_step: f64::INFINITY,
            pieces: part.waveforms.iter().map(|w| self.pieces[*w]).collect(),
            energies: if k == 0 { all } else { Energies::default() },
            counts: Counts::default(),
            tally: Tally::of(part.contacts.len()),
            underway: None,
        };
        self.underway = Some(Underway::Parts(model.parts.iter().enumerate().map(way).collect()));
    }

    /// Copies what is of part `k` into its own state, in the room there is.
    pub(crate) fn hand_out(&self, model: &Model, k: usize, to: &mut Self) {
        let (part, Some(way)) = (&model.parts[k], self.parts().and_then(|ways| ways.get(k))) else { return };
        let layout = to.layout(&part.model);
        (to.t, to.step, to.stuck_step) = (way.t, way.step, way.stuck_step);
        to.pieces.clone_from(&way.pieces);
        part.components.iter().for_each(|(own, place)| to.y[*own] = self.y[*place]);
        (to.y[layout.input()], to.y[layout.damping()]) = (way.energies.input, way.energies.damping);
        (to.jumps, to.lost, to.origin) = (way.energies.jumps, way.energies.lost, way.energies.origin);
        for (own, i) in part.free.iter().enumerate() {
            to.shifts[own] = self.shifts[*i];
        }
        for (own, c) in part.contacts.iter().enumerate() {
            to.memories[own].copy(&self.memories[*c]);
            (to.modes[own], to.grew[own]) = (self.modes[*c], self.grew[*c]);
            to.friction[own] = self.friction[*c];
        }
        to.counts = way.counts;
        to.tally.clone_from(&way.tally);
        Underway::copy(&mut to.underway, &way.underway);
    }

    /// Takes over what is of part `k` from its own state, in the room there is; [`Self::sum_up`] follows once all have been.
    pub(crate) fn take_in(&mut self, model: &Model, k: usize, from: &Self) {
        let part = &model.parts[k];
        part.components.iter().for_each(|(own, place)| self.y[*place] = from.y[*own]);
        for (own, i) in part.free.iter().enumerate() {
            self.shifts[*i] = from.shifts[own];
        }
        for (own, c) in part.contacts.iter().enumerate() {
            self.memories[*c].copy(&from.memories[own]);
            (self.modes[*c], self.grew[*c]) = (from.modes[own], from.grew[own]);
            self.friction[*c] = from.friction[own];
        }
        let layout = from.layout(&part.model);
        let Some(Underway::Parts(ways)) = &mut self.underway else { return };
        let way = &mut ways[k];
        self.counts.add(&from.counts, &way.counts);
        self.tally.add(&from.tally, &way.tally, &part.contacts);
        (way.t, way.step, way.stuck_step) = (from.t, from.step, from.stuck_step);
        way.energies = Energies {
            input: from.y[layout.input()],
            damping: from.y[layout.damping()],
            jumps: from.jumps,
            lost: from.lost,
            origin: from.origin,
        };
        way.counts = from.counts;
        way.tally.clone_from(&from.tally);
        Underway::copy(&mut way.underway, &from.underway);
        // A corner of a waveform that moves several parts is one event, counted by the first that comes to it.
        for (own, w) in part.waveforms.iter().enumerate() {
            let (before, now) = (way.pieces[own].index, from.pieces[own].index);
            let known = self.pieces[*w].index.clamp(before, now.max(before));
            self.counts.events -= (known - before).min(self.counts.events);
            if now > self.pieces[*w].index {
                self.pieces[*w] = from.pieces[own];
            }
            way.pieces[own] = from.pieces[own];
        }
    }

    /// Adds up what the parts have put in and lost, and stands at time `t`, s.
    pub(crate) fn sum_up(&mut self, model: &Model, t: f64) {
        let layout = self.layout(model);
        let Some(Underway::Parts(ways)) = &self.underway else { return };
        let sum = |of: fn(&Energies) -> f64| ways.iter().map(|way| of(&way.energies)).sum::<f64>();
        let (input, damping) = (sum(|e| e.input), sum(|e| e.damping));
        (self.jumps, self.lost, self.origin) = (sum(|e| e.jumps), sum(|e| e.lost), sum(|e| e.origin));
        (self.y[layout.input()], self.y[layout.damping()]) = (input, damping);
        (self.t, self.step) = (t, 0.0);
    }

    /// Becomes the copy of another state of the same model, in the room there is.
    pub(crate) fn copy(&mut self, from: &Self) {
        (self.t, self.step, self.stuck_step) = (from.t, from.step, from.stuck_step);
        (self.jumps, self.lost, self.origin) = (from.jumps, from.lost, from.origin);
        self.y.clone_from(&from.y);
        self.shifts.clone_from(&from.shifts);
        self.memories.iter_mut().zip(&from.memories).for_each(|(own, from)| own.copy(from));
        self.modes.clone_from(&from.modes);
        self.grew.clone_from(&from.grew);
        self.blocks.clone_from(&from.blocks);
        self.pieces.clone_from(&from.pieces);
        self.friction.clone_from(&from.friction);
        Underway::copy(&mut self.underway, &from.underway);
        self.supplied.clone_from(&from.supplied);
        self.generators.clone_from(&from.generators);
        self.counts = from.counts;
        self.tally.clone_from(&from.tally);
    }
}

impl Counts {
    /// Adds what has come since before.
    fn add(&mut self, now: &Self, before: &Self) {
        self.steps += now.steps - before.steps;
        self.rejected += now.rejected - before.rejected;
        self.evaluations += now.evaluations - before.evaluations;
        self.events += now.events - before.events;
        self.detours += now.detours - before.detours;
        self.missed += now.missed - before.missed;
    }
}

impl Model {
    /// The state of a whole at t = 0, of those of its parts.
    pub(crate) fn joined(&self, parts: &[State]) -> State {
        let mut whole = self.rest();
        whole.divide(self);
        parts.iter().enumerate().for_each(|(k, part)| whole.take_in(self, k, part));
        whole.sum_up(self, 0.0);
        whole
    }
}
