//! Totals and peak values of a driver, stored in the memory of its block.

use crate::driver::Spec;

/// Number of values in a driver's memory.
pub(crate) const COUNT: usize = 15;

/// Memory of a driver, with one field for each value.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Kept {
    /// Difference between the voltage and the voltage state, as a stroke, m.
    pub(crate) offset: f64,
    /// Voltage at the end of the last step, as a stroke, m.
    pub(crate) last: f64,
    /// Work of the source up to the end of the last step, J.
    pub(crate) work: f64,
    /// Total charge moved in both directions, as a stroke, m: ∫|αI/C| dt.
    pub(crate) way: f64,
    /// Energy drawn from the source, J: the integral of the positive part of the source power.
    pub(crate) drawn: f64,
    /// Largest current, as a stroke rate, m/s.
    pub(crate) fastest: f64,
    /// Times at the upper and lower current limit and at the lower and upper end of the window, s.
    pub(crate) limited: [f64; 4],
    /// Total time, s.
    pub(crate) time: f64,
    /// End of the last step, s.
    pub(crate) at: f64,
    /// Elongation of the stack at the end of the last step, m; used only with strain coupling.
    pub(crate) elongation: f64,
    /// Current as a stroke rate, m/s, and power of the source, W, at the end of the last step.
    pub(crate) flow: f64,
    pub(crate) power: f64,
}

/// State of a driver at the end of the last step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Last {
    /// Voltage, as a stroke, m.
    pub(crate) stroke: f64,
    /// Elongation of the stack, m.
    pub(crate) elongation: f64,
    /// Time of the end of the step, s.
    pub(crate) at: f64,
}

/// Returns the state at the end of the last step from a driver's memory.
pub(crate) fn last(memory: &[f64]) -> Last {
    let of = |kept: Kept| Last { stroke: kept.last, elongation: kept.elongation, at: kept.at };
    Kept::read(memory).map_or_else(Last::default, of)
}

impl Kept {
    /// Reads the values of a memory. Returns `None` if the memory does not have [`COUNT`] values.
    pub(crate) fn read(memory: &[f64]) -> Option<Self> {
        let &[
            offset,
            last,
            work,
            way,
            drawn,
            fastest,
            up,
            down,
            below,
            above,
            time,
            at,
            elongation,
            flow,
            power,
        ] = memory
        else {
            return None;
        };
        Some(Self {
            offset,
            last,
            work,
            way,
            drawn,
            fastest,
            limited: [up, down, below, above],
            time,
            at,
            elongation,
            flow,
            power,
        })
    }

    /// Returns the values in the order in which the memory stores them.
    pub(crate) fn numbers(&self) -> [f64; COUNT] {
        let [up, down, below, above] = self.limited;
        let Self { offset, last, work, way, drawn, fastest, time, at, elongation, flow, power, .. } = *self;
        [offset, last, work, way, drawn, fastest, up, down, below, above, time, at, elongation, flow, power]
    }
}

/// Results of a driver since the start of the evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figures {
    /// Energy drawn from the source, J: integral of the positive part of the source power. Energy returned to the source is not subtracted.
    pub drawn: f64,
    /// Largest current, A.
    pub peak_current: f64,
    /// Mean of the current's magnitude |I|, A.
    pub mean_current: f64,
    /// Fractions of the time at the upper and lower current limit and at the lower and upper end of the window.
    pub limited: [f64; 4],
}

impl Figures {
    /// Computes the results from a driver's memory. Returns `None` for the memory of another block.
    #[must_use]
    pub fn of(memory: &[f64], spec: &Spec) -> Option<Self> {
        let kept = Kept::read(memory)?;
        let farads = spec.capacitance / spec.gain;
        let over = |value: f64| if kept.time > 0.0 { value / kept.time } else { 0.0 };
        Some(Self {
            drawn: kept.drawn,
            peak_current: farads * kept.fastest,
            mean_current: farads * over(kept.way),
            limited: kept.limited.map(over),
        })
    }
}
