//! Block of logarithmic creep.

use super::law::Creep;
use crate::Reading;
use stickslip_drive::component::{
    Block, Component, Input, Moment, Passage, Powers, Refused, Standing, States,
};
use stickslip_drive::{EventKind, Sample};

/// Creep filter y = a v + Σ gᵢ xᵢ with τᵢ ẋᵢ = v - xᵢ, or its inverse from y to v; see [`Creep`].
///
/// Filter and inverse have the same states. In series and with equal initial states, filter and inverse cancel except for rounding. The
/// initial states are xᵢ = v, as after a long time with constant input.
#[derive(Debug)]
pub struct CreepBlock {
    law: Creep,
    way: Way,
    inputs: [Input; 1],
    reading: Reading,
}

/// Direction of the filter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Forward,
    Inverse,
}

impl CreepBlock {
    /// Creates the creep filter of a signal.
    pub fn new(law: Creep, reading: Reading) -> Self {
        Self { law, way: Way::Forward, inputs: [Input::Signal(reading.signal)], reading }
    }

    /// Creates the inverse filter: filtering its output by the creep law gives its input signal.
    pub fn inverse(law: Creep, reading: Reading) -> Self {
        Self { way: Way::Inverse, ..Self::new(law, reading) }
    }

    /// Returns input v and output y of the creep law, with their derivatives.
    fn both(&self, at: &Moment<'_, [Sample]>) -> [Sample; 2] {
        let input = at.inputs[0];
        // Σ gᵢxᵢ and the time derivatives of this sum follow from ẋᵢ = (v - xᵢ)/τᵢ and ẍᵢ = (v̇ - ẋᵢ)/τᵢ.
        let value = self.crept(|i| at.states[i]);
        let a = self.law.direct();
        let v = |known: f64, sum: f64| match self.way {
            Way::Forward => known,
            Way::Inverse => (known - sum) / a,
        };
        let times = self.law.times();
        let v0 = v(input.value, value);
        let slope = |i: usize| (v0 - at.states[i]) / times[i];
        let rate = self.crept(slope);
        let v1 = v(input.rate, rate);
        let acceleration = self.crept(|i| (v1 - slope(i)) / times[i]);
        let v2 = v(input.acceleration, acceleration);
        [
            Sample { value: v0, rate: v1, acceleration: v2 },
            Sample { value: a * v0 + value, rate: a * v1 + rate, acceleration: a * v2 + acceleration },
        ]
    }

    fn crept(&self, of: impl Fn(usize) -> f64) -> f64 {
        self.law.weights().iter().enumerate().map(|(i, weight)| weight * of(i)).sum()
    }
}

impl Component for CreepBlock {
    type Law = usize;
    type Memory = Vec<f64>;
    type Guard = usize;
    type Inputs = [Sample];
    type Segment = Passage;
    type Error = Refused;

    fn states(&self) -> States {
        States { scales: vec![self.reading.span; self.law.times().len()], integrals: 0 }
    }

    fn guards(&self, _: &usize) -> &[usize] {
        &[]
    }

    fn guard(&self, _: usize, _: Standing<'_, usize, Vec<f64>>, _: &Moment<'_, [Sample]>) -> f64 {
        f64::INFINITY
    }

    fn next(
        &self,
        _: usize,
        standing: Standing<'_, usize, Vec<f64>>,
        _: &Moment<'_, [Sample]>,
    ) -> (EventKind, usize) {
        (EventKind::Own("never"), *standing.law)
    }

    fn commit(&self, _: &mut Vec<f64>, _: &Passage) -> Result<f64, Refused> {
        Ok(0.0)
    }

    fn energy(&self, _: Standing<'_, usize, Vec<f64>>, _: &Moment<'_, [Sample]>) -> f64 {
        0.0
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![self.reading.column]
    }
}

impl Block for CreepBlock {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn start(&self, inputs: &[Sample]) -> (Vec<f64>, Vec<f64>) {
        let v = match self.way {
            Way::Forward => inputs[0].value,
            Way::Inverse => inputs[0].value / self.law.settled(),
        };
        (vec![v; self.law.times().len()], Vec::new())
    }

    fn slopes(
        &self,
        _: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
        slopes: &mut [f64],
        _: &mut [f64],
    ) -> Powers {
        let v = match self.way {
            Way::Forward => at.inputs[0].value,
            Way::Inverse => (at.inputs[0].value - self.crept(|i| at.states[i])) / self.law.direct(),
        };
        for ((slope, x), time) in slopes.iter_mut().zip(at.states).zip(self.law.times()) {
            *slope = (v - x) / time;
        }
        Powers::default()
    }

    fn signal(&self, _: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> Sample {
        let [input, output] = self.both(at);
        if self.way == Way::Forward { output } else { input }
    }

    /// Returns the range of the output for any history of the input within its range. The inverse overshoots after a sudden change.
    fn range(&self, inputs: &[(f64, f64)]) -> (f64, f64) {
        let ((low, high), law) = (inputs[0], &self.law);
        let (direct, settled) = (law.direct(), law.settled());
        // The range follows because v and all xᵢ are within the range of v: y = a v + Σ gx, or v = (y - Σ gx)/a.
        let (own, kept) = match self.way {
            Way::Forward => (direct, settled - direct),
            Way::Inverse => (direct.recip(), (1.0 - settled / direct) / settled),
        };
        let ends = [
            own * low + kept * low,
            own * low + kept * high,
            own * high + kept * low,
            own * high + kept * high,
        ];
        (ends.into_iter().fold(f64::INFINITY, f64::min), ends.into_iter().fold(f64::NEG_INFINITY, f64::max))
    }

    fn passes_jumps(&self) -> bool {
        true
    }

    fn guard_scale(&self, _: usize) -> f64 {
        1.0
    }

    fn rate(&self) -> f64 {
        self.reading.swings
    }

    fn fill(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, row: &mut Vec<f64>) {
        row.push(self.signal(standing, at).value);
    }
}
