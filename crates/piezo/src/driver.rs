//! Driver electronics: the block that converts the commanded voltage into the voltage of the stack.
//!
//! ```text
//! command e ──► window ──► second order ──► output stage: R, ±I ──► voltage V at the capacitance C
//! ```
//!
//! * The window limits the command: e' = min(max(e, lo), hi).
//! * The low-pass filters e': f̈ = ω²(e' - f) - 2ζω ḟ. Without a bandwidth, f = e'.
//! * The output stage charges C through R: V̇ = (f - V)/RC. Without a resistance, V = f.
//! * The current limits bound the voltage rate: -I₋/C ≤ V̇ ≤ I₊/C.
//!
//! The start and the end of a current limit are events. Without a resistance, a limit ends when V meets f. With a resistance, a limit ends
//! when the unlimited rate is within the limits.
//!
//! All signals are free strokes of the stack in m: αe, αf and αV, where α is the stroke per volt. Output columns are in V and A.
//!
//! The driver has a separate energy balance: source = stored + lost. The source supplies the power f·I with I = C V̇. The capacitance
//! stores ½CV². The output stage loses the power (f - V)I. The energies of source and losses are integrated as states. By default the
//! charge due to strain is neglected, which is a fraction κ = kα²/C of the energy.
//!
//! [`Driver::reciprocal`] adds the charge due to strain: Q = CV + kα(e - αV), where C is the free capacitance and e the elongation. As a
//! stroke rate, the current is αI/C = (1 - κ)αV̇ + κė. The current flows through R and is subject to the current limits. The stored energy
//! is ½CV² - kαV(αV - e). The work of the stack is ∫k(αV - e)α dV. The energy balance is then source = stored + lost + work.

mod block;
mod course;
mod spec;
mod stage;
mod strain;

pub use spec::{Control, Low, Spec, SpecError};

use course::{Course, Output, Window};
use std::sync::Arc;
use stickslip_drive::component::{Input, SharedBlock};
use strain::Strain;

/// Block of the driver electronics.
#[derive(Debug)]
pub struct Driver {
    spec: Spec,
    /// Signal of the command and, with strain coupling, the elongation of the stack.
    inputs: Vec<Input>,
    strain: Option<Strain>,
    /// Scale of the voltage as a stroke, m: the larger of the width of the command's range and its largest magnitude.
    span: f64,
    /// Shortest time between two reversals of the command, s.
    quickest: f64,
    /// Indices of the event functions of each mode.
    guards: Vec<Vec<usize>>,
}

impl Driver {
    /// Creates a driver for the command with index `signal` in the model.
    ///
    /// `range` is the smallest and largest value of the command as a stroke, m.
    #[must_use]
    pub fn new(spec: Spec, signal: usize, range: (f64, f64)) -> Self {
        let span = (range.1 - range.0).max(range.0.abs()).max(range.1.abs());
        let span = if span > 0.0 && span.is_finite() { span } else { spec.gain };
        let guards = Course::all().map(|course| course.guards(&spec)).collect();
        let inputs = vec![Input::Signal(signal)];
        Self { spec, inputs, strain: None, span, quickest: f64::INFINITY, guards }
    }

    /// Sets the shortest time between two reversals of the command, s.
    ///
    /// The driver computes the error scale of its voltage from this time and RC, so that current and losses are accurate.
    #[must_use]
    pub fn commanded_within(self, quickest: f64) -> Self {
        Self { quickest, ..self }
    }

    /// Adds the charge due to the strain of the stack.
    ///
    /// `coupling` is κ = kα²/C, above 0 and below 1. `elongation` is an [`Input::Length`].
    #[must_use]
    pub fn reciprocal(mut self, coupling: f64, elongation: Input) -> Self {
        self.inputs.push(elongation);
        self.strain = Some(Strain { coupling });
        self
    }

    /// Converts the driver into a shared block for a model.
    #[must_use]
    pub fn shared(self) -> SharedBlock {
        SharedBlock(Arc::new(self))
    }
}
