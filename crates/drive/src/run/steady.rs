//! Steps of a periodic drive, watched until they are constant.

use crate::model::Binding;
use crate::scene::Axis;
use crate::state::{State, Stepped};
use crate::{Model, Plan, UntilSteady};

/// How many times running a step must agree with the one before it.
pub(super) const AGREEING: u32 = 3;
/// A moment this near to the end of a period, relative to the time, is the end: a corner is a rounded sum.
const SAME: f64 = 4.0 * f64::EPSILON;

/// The ends of the periods, and what the steps between them have come to.
#[derive(Clone, Copy)]
pub(super) struct Steps {
    /// Place of the body's x among the free coordinates.
    pub(super) coordinate: usize,
    /// Start of the first period and length of all, s.
    start: f64,
    period: f64,
    /// Number of whole periods; may be infinite.
    periods: f64,
    /// When the next end is due, s; infinite after the last.
    due: f64,
    /// From when on a moment is as good as that, s.
    nearly: f64,
    /// Largest change of a step, as a share of it or of the body's natural length, m.
    change: f64,
    natural: f64,
    /// So far.
    so_far: Stepped,
}

impl Steps {
    /// The steps that a plan asks for; never due where it does not, or where there are none.
    pub(super) fn of(model: &Model, plan: &Plan) -> Self {
        plan.until_steady.and_then(|asked| Self::asked(model, asked)).unwrap_or(Self::NEVER)
    }

    /// Begins with the first period that begins now or later: what was before the state is not known.
    pub(super) fn begin(&mut self, state: &State) {
        // Not period by period: a state may come from any time.
        let passed = ((state.t - self.start) / self.period).floor() - 1.0;
        if passed > self.so_far.next && passed < self.periods {
            self.so_far.next = passed;
            self.look_ahead();
        }
        while self.due * (1.0 + SAME) < state.t {
            self.advance();
        }
        if self.due(state.t).is_some() {
            self.take(state.shifts[self.coordinate], state.y[self.coordinate]);
        }
    }

    /// What they have come to, where they are asked for.
    pub(super) fn so_far(&self) -> Option<Stepped> {
        (self.period > 0.0).then_some(self.so_far)
    }

    /// Goes on from there.
    pub(super) fn take_up(&mut self, so_far: Stepped, state: &State) {
        if self.period > 0.0 {
            self.so_far = so_far;
            self.look_ahead();
            // No run leaves an end behind that it has passed.
            if self.due * (1.0 + SAME) < state.t {
                self.so_far = Self::NEVER.so_far;
                self.look_ahead();
                self.begin(state);
            }
        }
    }

    const NEVER: Self = Self {
        coordinate: 0,
        start: 0.0,
        period: 0.0,
        periods: 0.0,
        due: f64::INFINITY,
        nearly: f64::INFINITY,
        change: 0.0,
        natural: 0.0,
        so_far: Stepped { next: 0.0, place: None, step: None, agreed: 0 },
    };

    /// None where the waveform has no period or the body's x is not free.
    fn asked(model: &Model, UntilSteady { waveform, body, change }: UntilSteady) -> Option<Self> {
        let waveform = model.waveforms.get(waveform)?;
        let Binding::Free(coordinate) = model.bodies.get(body)?.bindings[Axis::X as usize] else {
            return None;
        };
        let (period, timing) = (waveform.period()?, waveform.timing());
        Some(Self {
            coordinate,
            start: timing.delay,
            period,
            periods: timing.cycles.unwrap_or(f64::INFINITY).floor(),
            due: timing.delay,
            nearly: timing.delay * (1.0 - SAME),
            change,
            natural: model.free[coordinate].scale.0,
            ..Self::NEVER
        })
    }

    /// The next end of a period, if it lies at `t` or before it; `t` itself where it is as good as there.
    #[inline]
    pub(super) fn due(&self, t: f64) -> Option<f64> {
        if t < self.nearly {
            return None;
        }
        Some(if t > self.due * (1.0 + SAME) { self.due } else { t })
    }

    /// Takes the place at the end of a period, its origin and what is counted from there, m. Tells whether the steps have
    /// become constant.
    ///
    /// Constant are steps of which three running differ from the one before by no more than the asked share
    /// of the step or, if that is longer, of the body's natural length: steps of nothing agree, too.
    pub(super) fn take(&mut self, origin: f64, place: f64) -> bool {
        self.advance();
        let Some(before) = self.so_far.place.replace((origin, place)) else { return false };
        // Differences of origins and of places apart: a sum of both would have lost the digits that shifting
        // keeps.
        let step = (origin - before.0) + (place - before.1);
        let last = self.so_far.step.replace(step);
        let agrees =
            last.is_some_and(|last| (step - last).abs() <= self.change * step.abs().max(self.natural));
        let agreed = &mut self.so_far.agreed;
        *agreed = if agrees { *agreed + 1 } else { 0 };
        *agreed >= AGREEING
    }

    /// The next end is a product, not a sum of periods: it does not drift.
    fn advance(&mut self) {
        self.so_far.next += 1.0;
        self.look_ahead();
    }

    fn look_ahead(&mut self) {
        let next = self.so_far.next;
        self.due = if next <= self.periods { self.start + next * self.period } else { f64::INFINITY };
        self.nearly = self.due * (1.0 - SAME);
    }
}
