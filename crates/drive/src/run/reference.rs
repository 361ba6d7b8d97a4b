//! Plain adaptive reference integrator: Dormand–Prince 5(4), called once between two corners, without event location.

use super::chords::Chords;
use super::horizon::Goal;
use super::output::Opening;
use crate::record::Record;
use crate::{Model, Plan, RunError, State, Waveform};
use stickslip_stepper::System;
use stickslip_stepper::reference::{Accepting, ReferenceError, ReferenceOptions, integrate};

/// Maximum time step, as a fraction of the waveform resolution, which is a quarter of the shortest wave.
///
/// In gross slip the equations do not depend on the waveform. Without the limit, a long step would miss a wave in which
/// the contact sticks for a short time.
const SEEN: f64 = 0.125;

/// Reference run, whose solver chooses the steps itself.
///
/// The solver evaluates time derivatives and passes each accepted step to [`Chords`], which commits it. An error of the commit is stored in
/// `outcome` until the solver returns.
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
    /// Accepts a step. A step that does not advance the time is ignored.
    fn accept(&mut self, t: f64, y: &[f64]) -> bool {
        if t > self.state.t {
            self.chords.take_steps(self.state, t, y);
            self.outcome = self.chords.accept(self.state, (t, y), self.record).map(drop);
        }
        self.outcome.is_ok() && self.chords.goes_on(self.state)
    }
}

/// Runs a plan with one call of the solver from corner to corner.
///
/// The solver controls its steps by `tolerance`, relative to natural lengths, natural speeds and the scales of block
/// states. At a corner, a new call begins with the last step length.
///
/// Fails if steps are too many or too small, or as [`Chords::accept`] does.
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
                // A call begins with the last step length of the previous one.
                options.first = Some(stretch.step);
                driven.state.counts.rejected += stretch.rejected;
                driven.state.counts.evaluations += stretch.evaluations;
            }
            // A refused commit also ends the solver call; its own error counts.
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
    /// Moves every waveform whose piece has ended to its next piece.
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

/// Converts an error of the solver at time t to a run error.
fn failure(error: &ReferenceError, plan: &Plan, t: f64) -> RunError {
    match error {
        ReferenceError::TooManySteps { .. } => RunError::TooManySteps { t, limit: plan.limits.steps },
        _ => RunError::StepTooSmall { t, step: 0.0 },
    }
}
