//! Writing of a state, in the order of [`read`](super::read).

use super::FIXED;
use crate::model::Model;
use crate::state::{Ahead, Books, Counts, Grip, Whereabouts};
use crate::state::{Booked, Detour, FixedWay, Gait, LocatedWay, State, Stepped, Takeoff, Underway, Window};
use crate::{Piece, Waveform};
use stickslip_stepper::StepHistory;

/// Words written so far.
pub(super) struct Page<'a>(&'a mut Vec<u64>);

pub(super) fn state(state: &State, model: &Model, words: &mut Vec<u64>) {
    let mut page = Page(words);
    page.flag(state.layout(model).growing > 0);
    page.reals([state.t, state.jumps, state.lost, state.origin, state.step, state.stuck_step]);
    page.reals(state.y.iter().copied());
    page.reals(state.shifts.iter().copied());
    page.reals(state.friction.iter().copied());
    for c in 0..state.memories.len() {
        page.flag(state.grew[c]);
        state.memories[c].write(page.0);
        state.modes[c].write(page.0);
    }
    for block in &state.blocks {
        page.0.extend([block.law as u64, block.memory.len() as u64]);
        page.reals(block.memory.iter().copied());
    }
    for (w, waveform) in model.waveforms.iter().enumerate() {
        page.piece(waveform, &state.pieces[w]);
        if let Some(supplied) = state.supplied.get(w) {
            page.option(supplied.as_ref(), |page, piece| page.piece(waveform, piece));
        }
        if let Some(Some(generating)) = state.generators.get(w) {
            page.generating(generating);
        }
    }
    page.counts(&state.counts);
    state.tally.write(page.0);
    page.option(state.underway.as_ref(), Page::underway);
}

impl Page<'_> {
    fn flag(&mut self, flag: bool) {
        self.0.push(u64::from(flag));
    }

    fn real(&mut self, real: f64) {
        self.0.push(real.to_bits());
    }

    pub(super) fn reals(&mut self, reals: impl IntoIterator<Item = f64>) {
        self.0.extend(reals.into_iter().map(f64::to_bits));
    }

    pub(super) fn words(&mut self, words: impl IntoIterator<Item = u64>) {
        self.0.extend(words);
    }

    pub(super) fn option<T>(&mut self, value: Option<&T>, write: impl FnOnce(&mut Self, &T)) {
        self.flag(value.is_some());
        if let Some(value) = value {
            write(self, value);
        }
    }

    /// Writes the index of a piece. For inputs and generators, whose pieces have no index, writes its ends.
    fn piece(&mut self, waveform: &Waveform, piece: &Piece) {
        match (waveform.interpolation(), waveform.generator()) {
            (None, None) => self.0.push(piece.index),
            _ => self.reals(piece.supplied()),
        }
    }

    fn history(&mut self, history: &StepHistory) {
        self.real(history.log_error);
        self.option(history.rejected.as_ref(), |page, rejected| {
            page.reals([rejected.step, rejected.log_error]);
        });
    }

    fn underway(&mut self, underway: &Underway) {
        match underway {
            Underway::Located(way) => {
                self.0.push(0);
                self.located(way);
            }
            Underway::Fixed(way) => {
                self.0.push(1);
                self.fixed(way);
            }
        }
    }

    fn counts(&mut self, counts: &Counts) {
        self.0.extend([counts.steps, counts.rejected, counts.evaluations, counts.events]);
        self.0.extend([counts.detours, counts.missed]);
    }

    fn located(&mut self, way: &LocatedWay) {
        self.real(way.tolerance);
        self.flag(way.whereabouts == Whereabouts::Here);
        self.flag(way.hand.graded);
        self.flag(way.hand.both);
        self.0.push(way.slopes.len() as u64);
        self.reals(way.slopes.iter().copied());
        self.history(&way.history);
        let Gait { proven, ahead, grip } = way.gait;
        self.real(proven);
        self.flag(ahead == Ahead::Shortens);
        self.0.push(match grip {
            Grip::Slips => 0,
            Grip::Sticks => 1,
            Grip::Rests => 2,
        });
        self.reals(way.allowed.scale.iter().copied());
        self.real(way.allowed.power);
        self.booked(&way.booked);
        self.flag(way.asked);
        self.option(way.leap.as_ref(), |page, Takeoff { from, input }| {
            page.reals([from.t, from.x, from.v, *input]);
        });
        self.option(way.detour.as_ref(), |page, Detour { end, length, step }| {
            page.reals([*end, *length, *step]);
        });
        self.reals([way.last_detour.end, way.last_detour.length, way.last_detour.step]);
        self.windows(&way.windows);
        self.0.extend([way.crawl.since.to_bits(), way.crawl.attempts]);
        self.option(way.steps.as_ref(), Self::stepped);
    }

    fn fixed(&mut self, way: &FixedWay) {
        // Compared as text, because there are few.
        let stepper = FIXED.iter().position(|name| *name == way.stepper);
        self.0.push(stepper.unwrap_or(0) as u64);
        self.reals([way.grid.start, way.grid.step, way.grid.count]);
        self.flag(!way.slopes.is_empty());
        self.reals(way.slopes.iter().copied());
        self.reals(way.senses.iter().copied());
        self.booked(&way.booked);
        self.windows(&way.windows);
        self.option(way.steps.as_ref(), Self::stepped);
    }

    fn booked(&mut self, booked: &Booked) {
        self.real(booked.blocks);
        self.flag(booked.books == Books::Behind);
    }

    fn windows(&mut self, windows: &[Window]) {
        for window in windows {
            self.0.extend([window.start.to_bits(), u64::from(window.count)]);
        }
    }

    fn stepped(&mut self, stepped: &Stepped) {
        self.real(stepped.next);
        self.option(stepped.place.as_ref(), |page, place| page.reals([place.0, place.1]));
        self.option(stepped.step.as_ref(), |page, step| page.real(*step));
        self.0.push(u64::from(stepped.agreed));
    }
}
