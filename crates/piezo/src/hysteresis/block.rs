//! Block of the Prandtl–Ishlinskii model.

use super::heading::{TURNED, heading};
use super::plays::Plays;
use crate::Reading;
use stickslip_drive::component::{
    Block, Component, Input, Moment, Passage, Powers, Refused, Standing, States,
};
use stickslip_drive::{EventKind, Sample};

/// Prandtl–Ishlinskii hysteresis of a signal; see [`Plays`].
///
/// A mode consists of the direction of the input and the number k of engaged plays. The number of a mode is 2k for a rising and 2k + 1 for
/// a falling input. In each mode the output is linear in the input. A mode ends when the input engages the next play or reverses. The
/// memory contains the positions pᵢ of the plays, which are exact at every event. A jump of the input is treated as a monotone change in
/// zero time.
#[derive(Debug)]
pub struct PlayBlock {
    plays: Plays,
    inputs: [Input; 1],
    reading: Reading,
}

/// Indices of the event functions: distance to the next play, and rate of the input.
const ENGAGES: usize = 0;
const TURNS: usize = 1;
/// Name of the event at which a play is engaged.
const ENGAGED: &str = "play taken up";
/// Tolerances within which a play counts as engaged: a fraction of the span, and a multiple of the rounding of the input.
const SLACK: f64 = 1e-13;
const LAST_PLACES: f64 = 4.0;

impl PlayBlock {
    /// Creates the block for a signal.
    pub fn new(plays: Plays, reading: Reading) -> Self {
        Self { plays, inputs: [Input::Signal(reading.signal)], reading }
    }

    /// Returns the Prandtl–Ishlinskii model.
    pub fn plays(&self) -> &Plays {
        &self.plays
    }

    /// Returns the mode for an input with the value v that moves in a direction `sense`.
    fn law_at(&self, memory: &[f64], (v, sense): (f64, f64)) -> usize {
        let slack = SLACK * self.reading.span + LAST_PLACES * f64::EPSILON * v.abs();
        Self::law(self.plays.taken_up(memory, (v, sense), slack), sense)
    }

    fn law(taken_up: usize, sense: f64) -> usize {
        2 * taken_up + usize::from(sense < 0.0)
    }
}

/// Returns the number of engaged plays and the direction of a mode.
fn split(law: usize) -> (usize, f64) {
    (law / 2, if law.is_multiple_of(2) { 1.0 } else { -1.0 })
}

impl Component for PlayBlock {
    type Law = usize;
    type Memory = Vec<f64>;
    type Guard = usize;
    type Inputs = [Sample];
    type Segment = Passage;
    type Error = Refused;

    fn states(&self) -> States {
        States::default()
    }

    fn guards(&self, law: &usize) -> &[usize] {
        if split(*law).0 < self.plays.count() { &[ENGAGES, TURNS] } else { &[TURNS] }
    }

    fn guard(&self, guard: usize, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> f64 {
        let ((taken_up, sense), input) = (split(*standing.law), &at.inputs[0]);
        if guard == ENGAGES {
            self.plays.left(standing.memory, (input.value, sense), taken_up)
        } else {
            sense * input.rate
        }
    }

    fn next(
        &self,
        guard: usize,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
    ) -> (EventKind, usize) {
        let ((taken_up, sense), v) = (split(*standing.law), at.inputs[0].value);
        if guard == ENGAGES {
            // A step that does not locate events may have engaged several plays.
            let next = (taken_up + 1).min(self.plays.count());
            let reached = self.law_at(standing.memory, (v, sense));
            return (EventKind::Own(ENGAGED), reached.max(Self::law(next, sense)));
        }
        (EventKind::Own(TURNED), self.law_at(standing.memory, (v, -sense)))
    }

    /// Moves the plays to the input at the end of the step. The input does not reverse within a step.
    fn commit(&self, memory: &mut Vec<f64>, passage: &Passage) -> Result<f64, Refused> {
        self.plays.drag(memory, passage.inputs[0].value);
        Ok(0.0)
    }

    fn energy(&self, _: Standing<'_, usize, Vec<f64>>, _: &Moment<'_, [Sample]>) -> f64 {
        0.0
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![self.reading.column]
    }
}

impl Block for PlayBlock {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn laws(&self) -> usize {
        2 * (self.plays.count() + 1)
    }

    fn start(&self, inputs: &[Sample]) -> (Vec<f64>, Vec<f64>) {
        (Vec::new(), self.plays.start(inputs[0].value))
    }

    fn slopes(
        &self,
        _: Standing<'_, usize, Vec<f64>>,
        _: &Moment<'_, [Sample]>,
        _: &mut [f64],
        _: &mut [f64],
    ) -> Powers {
        Powers::default()
    }

    fn signal(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> Sample {
        let ((taken_up, sense), input) = (split(*standing.law), &at.inputs[0]);
        let (value, slope) = self.plays.output(standing.memory, (input.value, sense), taken_up);
        Sample { value, rate: slope * input.rate, acceleration: slope * input.acceleration }
    }

    fn range(&self, inputs: &[(f64, f64)]) -> (f64, f64) {
        self.plays.range(inputs[0])
    }

    /// Returns the mode after a corner or jump of the input. An input at rest keeps its direction.
    fn turn(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
    ) -> Option<(EventKind, usize)> {
        let (old, input) = (split(*standing.law).1, &at.inputs[0]);
        let sense = heading(input, self.reading.swings).unwrap_or(old);
        let law = self.law_at(standing.memory, (input.value, sense));
        let kind = EventKind::Own(if sense == old { ENGAGED } else { TURNED });
        (law != *standing.law).then_some((kind, law))
    }

    fn passes_jumps(&self) -> bool {
        true
    }

    fn guard_scale(&self, guard: usize) -> f64 {
        let Reading { span, swings, .. } = self.reading;
        if guard == ENGAGES { span } else { span * swings }
    }

    fn rate(&self) -> f64 {
        self.reading.turns
    }

    /// Returns the number of plays plus one: a reversal is one event, and after a reversal each play may be engaged.
    fn events_per_turn(&self) -> u32 {
        u32::try_from(1 + self.plays.count()).unwrap_or(u32::MAX)
    }

    fn fill(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, row: &mut Vec<f64>) {
        row.push(self.signal(standing, at).value);
    }
}
