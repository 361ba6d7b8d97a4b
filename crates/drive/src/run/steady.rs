//! Detection of a steady step length of a periodic drive.

use crate::model::Binding;
use crate::scene::Axis;
use crate::state::{State, Stepped};
use crate::{Model, Plan, UntilSteady};

/// Number of consecutive step lengths that must agree with the previous one.
pub(super) const AGREEING: u32 = 3;
/// Largest relative distance from a period end that counts as rounding.
const SAME: f64 = 4.0 * f64::EPSILON;

/// Period ends and the step lengths between them.
#[derive(Clone, Copy)]
pub(super) struct Steps {
    /// Index of the body's x among the free coordinates.
    pub(super) coordinate: usize,
    /// Start of the first period (`start`) and length of a period (`period`), s.
    start: f64,
    period: f64,
    /// Number of whole periods of the waveform; may be infinite.
    periods: f64,
    /// Next period end, s; ∞ after the last one.
    due: f64,
    /// Time from which on the time `due` counts as reached, s.
    nearly: f64,
    /// Largest change of a steady step length (`change`), relative to the step length or to `natural`, m, if that is longer.
    change: f64,
    natural: f64,
    /// Period ends and step lengths found so far.
    so_far: Stepped,
}

impl Steps {
    /// Returns the detection that a plan requests. Without a request or a periodic waveform no period end is ever due.
    pub(super) fn of(model: &Model, plan: &Plan) -> Self {
        plan.until_steady.and_then(|asked| Self::asked(model, asked)).unwrap_or(Self::NEVER)
    }

    /// Begins with the first period end at or after the current time, because earlier positions are unknown.
    pub(super) fn begin(&mut self, state: &State) {
        // Skips all past periods at once, because the state may have any time.
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

    /// Returns the step lengths found so far; `None` if the plan requests no detection.
    pub(super) fn so_far(&self) -> Option<Stepped> {
        (self.period > 0.0).then_some(self.so_far)
    }

    /// Continues the detection from results saved in the state.
    pub(super) fn take_up(&mut self, so_far: Stepped, state: &State) {
        if self.period > 0.0 {
            self.so_far = so_far;
            self.look_ahead();
            // A period end in the past shows that the saved results do not belong to this run.
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

    /// Returns the requested detection. `None` if the waveform has no period or the body's x is not free.
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

    /// Returns the time of the next period end, if that is at or before `t`. A time that agrees with `t` within rounding is `t` itself.
    #[inline]
    pub(super) fn due(&self, t: f64) -> Option<f64> {
        if t < self.nearly {
            return None;
        }
        Some(if t > self.due * (1.0 + SAME) { self.due } else { t })
    }

    /// Adds the position at a period end, as an origin and the distance from it, m. Returns whether the step length is steady.
    ///
    /// The step length is steady if [`AGREEING`] consecutive values each differ little from the previous one. The allowed difference is
    /// `change` times the step length, or times the body's natural length if that is longer. Steps of zero length agree.
    pub(super) fn take(&mut self, origin: f64, place: f64) -> bool {
        self.advance();
        let Some(before) = self.so_far.place.replace((origin, place)) else { return false };
        // Origins and distances are subtracted separately, so that no digits are lost.
        let step = (origin - before.0) + (place - before.1);
        let last = self.so_far.step.replace(step);
        let agrees =
            last.is_some_and(|last| (step - last).abs() <= self.change * step.abs().max(self.natural));
        let agreed = &mut self.so_far.agreed;
        *agreed = if agrees { *agreed + 1 } else { 0 };
        *agreed >= AGREEING
    }

    /// Moves to the next period end. The time is computed as a product, so rounding does not accumulate.
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
