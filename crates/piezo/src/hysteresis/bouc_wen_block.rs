//! Block of the Bouc–Wen model.

use super::bouc_wen::BoucWen;
use super::heading::{TURNED, heading};
use crate::Reading;
use stickslip_drive::component::{
    Block, Component, Input, Moment, Passage, Powers, Refused, Standing, States,
};
use stickslip_drive::{EventKind, Sample};

/// Bouc–Wen hysteresis y = v - z of a signal v, with z as the state; see [`BoucWen`].
///
/// A mode consists of the direction of the input and the sign of z. Modes 0 and 1 have z ≥ 0, modes 2 and 3 have z < 0. In modes 1 and 3
/// the input falls. A mode ends when the input reverses, or when a decreasing |z| reaches 0. The memory contains the input at the last
/// committed step, from which a jump is integrated.
#[derive(Debug)]
pub struct BoucWenBlock {
    law: BoucWen,
    inputs: [Input; 1],
    reading: Reading,
}

/// Indices of the event functions: rate of the input, and lag z.
const TURNS: usize = 0;
const CROSSES: usize = 1;
/// Fraction of z_m below which z counts as 0 when a mode is selected.
const AROUND_ZERO: f64 = 1e-9;

impl BoucWenBlock {
    /// Creates the block for a signal.
    pub fn new(law: BoucWen, reading: Reading) -> Self {
        Self { law, inputs: [Input::Signal(reading.signal)], reading }
    }

    /// Returns dz/dv and its derivative with respect to z, in a mode.
    fn gradient(&self, law: usize, at: &Moment<'_, [Sample]>) -> (f64, f64) {
        let (sense, side) = split(law);
        self.law.gradient(at.states[0], sense, side)
    }
}

/// Returns the direction of the input and the sign of z, in a mode.
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

    /// Returns the event functions of a mode. While |z| grows, z cannot cross 0.
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
            // Time derivative of the gradient: bend·ż with ż = gradient·v̇.
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
        // Near 0, z will have the sign of the motion. There, both branches differ only by a power of z.
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

    /// Returns the eigenvalue of z near its limit, -n (A/z_m)|v̇|. The largest |v̇| is estimated from the span and the shortest time
    /// between reversals.
    fn eigenvalues(&self, _: &[Sample]) -> Vec<(f64, f64)> {
        let fastest = 0.25 * self.reading.span * self.reading.turns;
        vec![(-self.law.settling() * fastest, 0.0)]
    }

    /// Returns 2, for the reversal of the input and the zero crossing of z.
    fn events_per_turn(&self) -> u32 {
        2
    }

    fn fill(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, row: &mut Vec<f64>) {
        row.push(self.signal(standing, at).value);
    }
}
