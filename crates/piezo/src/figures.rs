//! What a driver has done: kept in its memory, step by step.

use crate::driver::Spec;

/// Numbers of a driver's memory.
pub(crate) const COUNT: usize = 15;

/// A driver's memory by its places.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Kept {
    /// By how much the voltage lies beyond its state, as a stroke, m.
    pub(crate) offset: f64,
    /// Voltage at the end of the last step, as a stroke, m.
    pub(crate) last: f64,
    /// Work of the source until then, J.
    pub(crate) work: f64,
    /// Way of the voltage, as a stroke, m.
    pub(crate) way: f64,
    /// Work drawn where any was, J.
    pub(crate) drawn: f64,
    /// Largest current, as a rate of the stroke, m/s.
    pub(crate) fastest: f64,
    /// Time at the upper and the lower limit of the current, and at the lower and the upper end of the window, s.
    pub(crate) limited: [f64; 4],
    /// Time in all, s.
    pub(crate) time: f64,
    /// When the last step ended, s.
    pub(crate) at: f64,
    /// Elongation of a stack whose strain makes charge, then, m.
    pub(crate) elongation: f64,
    /// Current then, as a rate of the stroke, m/s, and power of the source, W: with both the next step begins behind a resistance.
    pub(crate) flow: f64,
    pub(crate) power: f64,
}

/// Where a driver stood at the end of the last step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Last {
    /// Its voltage as a stroke, m.
    pub(crate) stroke: f64,
    /// Elongation of the stack, m.
    pub(crate) elongation: f64,
    /// When that was, s.
    pub(crate) at: f64,
}

/// Of a driver's memory.
pub(crate) fn last(memory: &[f64]) -> Last {
    let of = |kept: Kept| Last { stroke: kept.last, elongation: kept.elongation, at: kept.at };
    Kept::read(memory).map_or_else(Last::default, of)
}

impl Kept {
    /// Read from a memory; none where that is of another kind.
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

    /// As a memory.
    pub(crate) fn numbers(&self) -> [f64; COUNT] {
        let [up, down, below, above] = self.limited;
        let Self { offset, last, work, way, drawn, fastest, time, at, elongation, flow, power, .. } = *self;
        [offset, last, work, way, drawn, fastest, up, down, below, above, time, at, elongation, flow, power]
    }
}

/// What a driver has done since the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figures {
    /// Energy that its source gave where it gave any, J; what came back is not taken off.
    pub drawn: f64,
    /// Largest current, A.
    pub peak_current: f64,
    /// Mean of |I|, A.
    pub mean_current: f64,
    /// Share of the time at the current's upper and lower limit, and at the window's lower and upper end.
    pub limited: [f64; 4],
}

impl Figures {
    /// By the memory of a driver; none where it is another block's.
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
