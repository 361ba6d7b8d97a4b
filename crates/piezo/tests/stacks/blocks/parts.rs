//! Common parts of the tests: chains of blocks and their inputs.

use crate::parts::named;
pub(crate) use crate::parts::{PERIOD, column, every, plan, scene, trace};
use std::sync::Arc;
use stickslip_drive::component::{Block, SharedBlock};
use stickslip_drive::scene::Named;
use stickslip_drive::{Plan, Stepper, Waveform};
use stickslip_piezo::Reading;

/// Natural span of the inputs in these tests, m.
pub(crate) const SPAN: f64 = 1e-6;

pub(crate) fn shared(name: &str, block: impl Block + 'static) -> Named<SharedBlock> {
    named(name, SharedBlock(Arc::new(block)))
}

/// Input with the given index of the signal: waveform 0, then blocks.
pub(crate) fn reading(signal: usize) -> Reading {
    let rate = std::f64::consts::TAU / PERIOD;
    Reading { signal, span: SPAN, swings: rate, turns: rate, column: "stroke_m" }
}

/// Table of (ms, μm).
pub(crate) fn table(points: &[(f64, f64)]) -> Waveform {
    crate::parts::table(points, 1e-6)
}

pub(crate) fn event(duration: f64) -> Plan {
    plan(Stepper::Event { tolerance: 1e-9 }, duration)
}
