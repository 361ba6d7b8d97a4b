//! The law of Bouc and Wen as a block.

use super::bouc_wen::BoucWen;
use super::heading::{TURNED, heading};
use crate::Reading;
use stickslip_drive::component::{
    Block, Component, Input, Moment, Passage, Powers, Refused, Standing, States,
};
use stickslip_drive::{EventKind, Sample};

/// y = v - z of [`BoucWen`] for a signal v, with z as its state.
///
/// A law of the block is the sense of the input and the sign of z: 0 and 1 with z ≥ 0, 2 and 3 with z < 0, the odd ones going
/// down. It ends where the input turns, and where z, going back, comes through 0. Memory is the input as it was committed last:
/// from there a jump goes straight on.
#[derive(Debug)]
pub struct BoucWenBlock {
    law: BoucWen,
    inputs: [Input; 1],
    reading: Reading,
}

/// The guards: the input's rate, and z.
const TURNS: usize = 0;
const CROSSES: usize = 1;
/// Part of z_m that counts as 0 where laws are chosen afresh.
const AROUND_ZERO: f64 = 1e-9;

impl BoucWenBlock {
    /// The law on a signal.
    pub fn new(law: BoucWen, reading: Reading) -> Self {
        Self { law, inputs: [Input::Signal(reading.signal)], reading }
    }

    /// dz/dv and its derivative by z.
    fn gradient(&self, law: usize, at: &Moment<'_, [Sample]>) -> (f64, f64) {
        let (sense, side) = split(law);
        self.law.gradient(at.states[0], sense, side)
    }
}

/// The sense of the input in a law, and the sign of z.
fn split(law: usize) -> (f64, f64) {
    (if law.is_multiple_of(2) { 1.0 } else { -1.0 }, if law < 2 { 1.0 } else { -1.0 })
}

fn joined(sense: f64, side: f64) -> usize {
    usize::from(sense < 0.0) + 2 * usize::from(side < 0.0)
}

impl Component for BoucWenBlock {
    type Law = usize;
    type Memory = Vec<f64>;
    type Guard = usize;
    type Inputs = [Sample];
    type Segment = Passage;
    type Error = Refused;

    fn states(&self) -> States {
        States { scales: vec![self.law.limit()], integrals: 0 }
    }

    /// Growing, z does not come through 0.
    fn guards(&self, law: &usize) -> &[usize] {
        let (sense, side) = split(*law);
        if sense == side { &[TURNS] } else { &[TURNS, CROSSES] }
    }

    fn guard(&self, guard: usize, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> f64 {
        let (sense, side) = split(*standing.law);
        if guard == TURNS { sense * at.inputs[0].rate } else { side * at.states[0] }
    }

    fn next(
        &self,
        guard: usize,
        standing: Standing<'_, usize, Vec<f64>>,
        _: &Moment<'_, [Sample]>,
    ) -> (EventKind, usize) {
        let (sense, side) = split(*standing.law);
        if guard == TURNS {
            (EventKind::Own(TURNED), joined(-sense, side))
        } else {
            (EventKind::Own("lag turns"), joined(sense, sense))
        }
    }

    fn commit(&self, memory: &mut Vec<f64>, passage: &Passage) -> Result<f64, Refused> {
        memory[0] = passage.inputs[0].value;
        Ok(0.0)
    }

    fn energy(&self, _: Standing<'_, usize, Vec<f64>>, _: &Moment<'_, [Sample]>) -> f64 {
        0.0
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![self.reading.column]
    }
}

impl Block for BoucWenBlock {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn laws(&self) -> usize {
        4
    }

    fn start(&self, inputs: &[Sample]) -> (Vec<f64>, Vec<f64>) {
        let v = inputs[0].value;
        (vec![self.law.along(0.0, v)], vec![v])
    }

    fn slopes(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
        slopes: &mut [f64],
        _: &mut [f64],
    ) -> Powers {
        slopes[0] = self.gradient(*standing.law, at).0 * at.inputs[0].rate;
        Powers::default()
    }

    fn signal(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> Sample {
        let ((gradient, bend), input) = (self.gradient(*standing.law, at), &at.inputs[0]);
        let passed = 1.0 - gradient;
        Sample {
            value: input.value - at.states[0],
            rate: passed * input.rate,
            // d/dt of the gradient: bend ż, ż = gradient v̇.
            acceleration: passed * input.acceleration - bend * gradient * input.rate.powi(2),
        }
    }

    fn range(&self, inputs: &[(f64, f64)]) -> (f64, f64) {
        let (low, high) = inputs[0];
        (low - self.law.limit(), high + self.law.limit())
    }

    fn turn(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
    ) -> Option<(EventKind, usize)> {
        let (old, z) = (split(*standing.law).0, at.states[0]);
        let sense = heading(&at.inputs[0], self.reading.swings).unwrap_or(old);
        // About 0 it will have the sign of the way: there both branches are one but for a power of z.
        let side = if z.abs() <= AROUND_ZERO * self.law.limit() { sense } else { z.signum() };
        let law = joined(sense, side);
        (law != *standing.law).then_some((EventKind::Own(TURNED), law))
    }

    fn jump(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, states: &mut [f64]) {
        states[0] = self.law.along(at.states[0], at.inputs[0].value - standing.memory[0]);
    }

    fn passes_jumps(&self) -> bool {
        true
    }

    fn guard_scale(&self, guard: usize) -> f64 {
        if guard == TURNS { self.reading.span * self.reading.swings } else { self.law.limit() }
    }

    fn rate(&self) -> f64 {
        self.reading.turns
    }

    /// Near its end z settles at n (A/z_m)|v̇|: with the fastest that the input may go, as a sine of its span between its turns.
    fn eigenvalues(&self, _: &[Sample]) -> Vec<(f64, f64)> {
        let fastest = 0.25 * self.reading.span * self.reading.turns;
        vec![(-self.law.settling() * fastest, 0.0)]
    }

    /// The turn, and z coming back through 0.
    fn events_per_turn(&self) -> u32 {
        2
    }

    fn fill(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, row: &mut Vec<f64>) {
        row.push(self.signal(standing, at).value);
    }
}
