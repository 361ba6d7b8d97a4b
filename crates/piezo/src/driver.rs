//! Driver electronics: what voltage a stack gets of the voltage that is commanded.
//!
//! ```text
//! command e ──► window ──► second order ──► output stage: R, ±I ──► voltage V at the capacitance C
//! ```
//!
//! The window cuts the command, e' = min(max(e, lo), hi). A bandwidth makes f of it, f̈ = ω²(e' - f) - 2ζω ḟ; without one f = e'.
//! The output stage charges C through R, V̇ = (f - V)/RC, or follows, V = f, where there is no R; and V̇ stays between -I₋/C and I₊/C.
//! Where the limit ends, V̇ or V meets what it would be without it: that, and the beginning, are events.
//!
//! All signals are free strokes of the stack, αe, αf and αV with α its stroke per volt: a scene knows lengths alone. Columns
//! are volts and amperes.
//!
//! Its books are its own. The output stage is fed with f·I, I = C V̇, stores ½CV² and loses (f - V)I, in R and in what limits the
//! current; both are integrated beside the voltage, so that source = stored + lost is a check. The mechanical side takes nothing out of
//! them: what a stack's charge has from its strain is left out (one-way), a share κ = k α²/C of the energy.
//!
//! With [`Driver::reciprocal`] it is there: Q = CV + kα(e - αV), C the free capacitance and e the elongation. As a stroke the current is
//! αI/C = (1 - κ)αV̇ + κė, which is what flows through R and what the limit holds; stored are ½CV² - k αV(αV - e), and the
//! source gives the work of the stroke ∫k(αV - e)α dV beside: source = stored + lost + worked.

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

/// Driver electronics as a block.
#[derive(Debug)]
pub struct Driver {
    spec: Spec,
    /// The command, and the elongation of a stack whose strain acts back.
    inputs: Vec<Input>,
    strain: Option<Strain>,
    /// Widest range of its command, as a stroke, m: the scale of its states.
    span: f64,
    /// Shortest time between two turns of its command, s.
    quickest: f64,
    /// Guards of each law.
    guards: Vec<Vec<usize>>,
}

impl Driver {
    /// A driver that reads the signal at this place of the scene, which moves within `range` (m, as a stroke).
    #[must_use]
    pub fn new(spec: Spec, signal: usize, range: (f64, f64)) -> Self {
        let span = (range.1 - range.0).max(range.0.abs()).max(range.1.abs());
        let span = if span > 0.0 && span.is_finite() { span } else { spec.gain };
        let guards = Course::all().map(|course| course.guards(&spec)).collect();
        let inputs = vec![Input::Signal(signal)];
        Self { spec, inputs, strain: None, span, quickest: f64::INFINITY, guards }
    }

    /// The same with the shortest time between two turns of its command, s: what the voltage lags by is as small as RC is beside it, and
    /// current and losses are made of that.
    #[must_use]
    pub fn commanded_within(self, quickest: f64) -> Self {
        Self { quickest, ..self }
    }

    /// The same with the charge that the strain of its stack makes: `coupling` κ, above 0 and below 1, and the elongation, a
    /// [`Input::Length`].
    #[must_use]
    pub fn reciprocal(mut self, coupling: f64, elongation: Input) -> Self {
        self.inputs.push(elongation);
        self.strain = Some(Strain { coupling });
        self
    }

    /// The same for a scene.
    #[must_use]
    pub fn shared(self) -> SharedBlock {
        SharedBlock(Arc::new(self))
    }
}
