//! The plain explicit reference: Dormand–Prince 5(4), one call per smooth stretch, no events.

use super::chords::Chords;
use super::horizon::Goal;
use super::output::Opening;
use crate::record::Record;
use crate::{Model, Plan, RunError, State, Waveform};
use stickslip_stepper::System;
use stickslip_stepper::reference::{Accepting, ReferenceError, ReferenceOptions, integrate};

/// Longest step, in quarters of the shortest wave. In gross slip nothing in the equations tells of a wave that goes by under
/// a long step, nor of the short time in which it holds a body.
// Ten times as much: a sine drive ends 1.6 u_c away at a tolerance of 1e-6, instead of 0.3. A tenth: 2e-3 u_c at 1e-9, for 2.5
// times the work.
const SEEN: f64 = 0.125;

/// A run whose steps a solver chooses by itself: it asks for slopes on shared borrows and hands each accepted step to the
/// chords, which commit it. An error of a commit waits here until the solver returns.
struct Driven<'a> {
    chords: Chords<'a>,
    state: &'a mut State,
    record: &'a mut dyn Record,
    outcome: Result<(), RunError>,
}

impl System for Driven<'_> {
    fn dimension(&self) -> usize {
        self.chords.layout.dimension()
    }

    fn positions(&self) -> usize {
        self.chords.layout.free
    }

    fn total(&self) -> usize {
        self.chords.layout.total()
    }

    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.chords.equations(self.state).slopes(t, y, dy);
    }
}

impl Accepting for Driven<'_> {
    /// What does not advance time is no step of the run's.
    fn accept(&mut self, t: f64, y: &[f64]) -> bool {
        if t > self.state.t {
            self.chords.take_steps(self.state, t, y);
            self.outcome = self.chords.accept(self.state, (t, y), self.record).map(drop);
        }
        self.outcome.is_ok() && self.chords.goes_on(self.state)
    }
}

/// Runs from corner to corner.
///
/// Between two corners the solver chooses its steps by `tolerance`, relative to natural lengths,
/// speeds and the scales of blocks' states; at each corner a new call begins with the step the last one
/// ended with. Fails as its solver does, with too many steps or one too small, or as [`Chords::accept`] does.
pub(super) fn run(
    model: &Model,
    plan: &Plan,
    tolerance: f64,
    state: &mut State,
    record: &mut dyn Record,
) -> Result<(), RunError> {
    let scale: Vec<f64> = model.free.iter().map(|f| tolerance * f.scale.0).collect();
    let speed = model.free.iter().map(|f| tolerance * f.scale.1);
    let own = model.blocks.iter().flat_map(|wired| &wired.states.scales).map(|natural| tolerance * natural);
    let scale: Vec<f64> = scale.into_iter().chain(speed).chain(own).collect();
    let mut chords = Chords::new(model, plan);
    state.underway = None;
    chords.set_out(state, Opening::Row, record);
    chords.aim(Goal::End(plan.duration));
    let mut driven = Driven { chords, state, record, outcome: Ok(()) };
    let waves = model.waveforms.iter().map(Waveform::resolution).fold(f64::INFINITY, f64::min);
    // In gross slip nothing in its equations says that a wave goes by: it leapt over several, at every
    // tolerance.
    let longest = SEEN * waves;
    let mut options = ReferenceOptions { longest, ..ReferenceOptions::default() };
    while driven.chords.goes_on(driven.state) && driven.outcome.is_ok() {
        let t = driven.state.t;
        let corner = driven.state.pieces.iter().map(|p| p.end).fold(plan.duration, f64::min);
        let y = driven.state.y.clone();
        let limit = plan.limits.steps.saturating_sub(driven.state.counts.steps);
        options.steps = u32::try_from(limit).unwrap_or(u32::MAX);
        let stretch = integrate(&mut driven, t..corner, &y, &scale, &options)
            .map_err(|error| failure(&error, plan, driven.state.t));
        match stretch {
            Ok(stretch) => {
                // The step goes on across a corner: each stretch would otherwise begin with a guess of its
                // own.
                options.first = Some(stretch.step);
                driven.state.counts.rejected += stretch.rejected;
                driven.state.counts.evaluations += stretch.evaluations;
            }
            // A step that was refused ends the stretch, too: its own reason counts, not the solver's.
            Err(error) if driven.outcome.is_ok() => driven.outcome = Err(error),
            Err(_) => {}
        }
        driven.turn_corners(model);
        let layout = driven.chords.layout;
        driven.state.choose_block_laws(model, layout);
    }
    if driven.outcome.is_err() {
        driven.chords.write_now(driven.state, driven.record);
    }
    driven.outcome
}

impl Driven<'_> {
    /// Puts every waveform whose piece is over on its next piece.
    fn turn_corners(&mut self, model: &Model) {
        let state = &mut *self.state;
        for (w, waveform) in model.waveforms.iter().enumerate() {
            while state.pieces[w].end <= state.t {
                let Some(next) = state.next_piece(w, waveform) else { break };
                state.pieces[w] = next;
            }
        }
    }
}

/// The solver's error in a run's words, at the time reached.
fn failure(error: &ReferenceError, plan: &Plan, t: f64) -> RunError {
    match error {
        ReferenceError::TooManySteps { .. } => RunError::TooManySteps { t, limit: plan.limits.steps },
        _ => RunError::StepTooSmall { t, step: 0.0 },
    }
}
