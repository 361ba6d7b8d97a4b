//! The Prandtl–Ishlinskii law as a block.

use super::heading::{TURNED, heading};
use super::plays::Plays;
use crate::Reading;
use stickslip_drive::component::{
    Block, Component, Input, Moment, Passage, Powers, Refused, Standing, States,
};
use stickslip_drive::{EventKind, Sample};

/// y of [`Plays`] for a signal v.
///
/// A law of the block is a sense of the input and a number of plays taken up: 2k going up, 2k + 1 going down. In between y is a
/// straight line in v, whose derivatives pass with its slope. It ends where the input takes up the next play, or turns. Memory
/// is the list of pᵢ, exact from event to event; a jump of the input is its straight way in no time, and y jumps, too.
#[derive(Debug)]
pub struct PlayBlock {
    plays: Plays,
    inputs: [Input; 1],
    reading: Reading,
}

/// The guards: how far it is to the next play, and the input's rate.
const ENGAGES: usize = 0;
const TURNS: usize = 1;
/// Name of the event in which a play is taken up.
const ENGAGED: &str = "play taken up";
/// Part of the span, and of the input in units of 2⁻⁵², within which a play counts as taken up: what an input on the two sides of
/// a corner differs by.
const SLACK: f64 = 1e-13;
const LAST_PLACES: f64 = 4.0;

impl PlayBlock {
    /// The law on a signal.
    pub fn new(plays: Plays, reading: Reading) -> Self {
        Self { plays, inputs: [Input::Signal(reading.signal)], reading }
    }

    /// The law.
    pub fn plays(&self) -> &Plays {
        &self.plays
    }

    /// The law for an input at v that goes on in a sense.
    fn law_at(&self, memory: &[f64], (v, sense): (f64, f64)) -> usize {
        let slack = SLACK * self.reading.span + LAST_PLACES * f64::EPSILON * v.abs();
        Self::law(self.plays.taken_up(memory, (v, sense), slack), sense)
    }

    fn law(taken_up: usize, sense: f64) -> usize {
        2 * taken_up + usize::from(sense < 0.0)
    }
}

/// How many plays a law has taken up, and its sense.
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
            // Steps that locate nothing may have passed several.
            let next = (taken_up + 1).min(self.plays.count());
            let reached = self.law_at(standing.memory, (v, sense));
            return (EventKind::Own(ENGAGED), reached.max(Self::law(next, sense)));
        }
        (EventKind::Own(TURNED), self.law_at(standing.memory, (v, -sense)))
    }

    /// Between two events the input does not turn.
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

    /// Where the input stands its sense stays: the output stands on whatever line leads through it.
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

    /// Each play may be taken up on one way, thresholds as close together as they like.
    fn events_per_turn(&self) -> u32 {
        u32::try_from(1 + self.plays.count()).unwrap_or(u32::MAX)
    }

    fn fill(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, row: &mut Vec<f64>) {
        row.push(self.signal(standing, at).value);
    }
}
