//! How long the next step is.

/// Step control with a proportional and a weak integral part.
///
/// factor = safety · ε^-α · ε₋₁^β with α = 1/k - 0.75 β, β = 0.2/k for an estimate that falls with hᵏ; ε the error of
/// this step, ε₋₁ that of the last accepted one, 1 = just at the tolerance.
/// After a second rejection in a row α is 1/p with the power p that both show, no weaker than before and 1 at most.
/// Source: Hairer, Nørsett, Wanner, *Solving ODEs I*, 2nd ed., section II.4 and Hairer, Wanner, *Solving ODEs II*,
/// section IV.2 (PI control); Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533 (rejections in a row).
///
/// A proportional part alone (the plain control of that section II.4) overshoots where the error wanders; see
/// [`StepControl::new`] for what was measured. All that it remembers is part of a run's state: cloneable and comparable.
#[derive(Debug, Clone, PartialEq)]
pub struct StepControl {
    limits: StepLimits,
    alpha: f64,
    beta: f64,
    history: StepHistory,
}

/// What a [`StepControl`] may do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepLimits {
    /// Aimed-at part of the step that would just meet the tolerance; 0.5 to 1, default 0.9.
    pub safety: f64,
    /// Strongest shortening at once, a factor below 1, default 0.2.
    pub shrink: f64,
    /// Strongest lengthening at once, a factor above 1, default 6.
    pub grow: f64,
    /// Longest step, s; default unbounded.
    pub longest: f64,
}

impl Default for StepLimits {
    fn default() -> Self {
        // Those of Hairer's DOP853, but for 0.2 in place of 1/3. Tried on slopes with a root of the time in the middle of
        // every unit of it (order 8, tolerance 1e-9, 15 944 evaluations): safety 0.8 takes 6 % more and 0.95 3 %, `grow` 2
        // takes 7 % more and 10 6 %, `shrink` 0.5 2 %. On a smooth orbit the safety alone tells, by 2 to 15 % either way.
        Self { safety: 0.9, shrink: 0.2, grow: 6.0, longest: f64::INFINITY }
    }
}

/// What the control remembers of earlier steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepHistory {
    /// Natural logarithm of the last accepted error, in units of the tolerance; not below that of
    /// [`StepHistory::FLOOR`].
    pub log_error: f64,
    /// The last attempt, if it was rejected. The next step does not grow then.
    pub rejected: Option<Rejection>,
}

/// An attempt that was rejected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rejection {
    /// Its length, s.
    pub step: f64,
    /// Natural logarithm of its error; ∞ where nothing follows from it.
    pub log_error: f64,
}

impl StepHistory {
    /// Errors below this count as this: a step that fell far below the tolerance says nothing about the next one.
    // Hairer's value. 1e-8 takes 5 % more evaluations where a root of the time passes by, 1e-2 3 %; smooth motions do not
    // feel it.
    pub const FLOOR: f64 = 1e-4;
    /// Nothing remembered: as after a step with the error [`StepHistory::FLOOR`], which makes the first factor cautious.
    pub const BLANK: Self = Self { log_error: -9.210_340_371_976_182, rejected: None };
}

/// What becomes of an attempt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// Whether the step met the tolerance.
    pub accepted: bool,
    /// Length of the next attempt, with the sign of this one.
    pub next: f64,
}

impl StepControl {
    /// Control for an error estimate that falls with the power `order` of the step (8 for [`DormandPrince`](crate::DormandPrince)).
    #[must_use]
    pub fn new(order: u32, limits: StepLimits) -> Self {
        let order = f64::from(order.max(1));
        // Without the integral part van der Pol's oscillator (μ = 20, tolerance 1e-9) rejects 185 of 1 671 attempts instead
        // of 100 of 1 700, for 2 % fewer evaluations; on slopes with roots of the time 524 instead of 450, for 4 % more.
        // Twice as much of it rejects 48 and takes a third more evaluations: what is left of α answers too weakly.
        let beta = 0.2 / order;
        Self { limits, alpha: 1.0 / order - 0.75 * beta, beta, history: StepHistory::BLANK }
    }

    /// Judges an attempt of length `h` with this `error`; anything but a number up to 1 is rejected.
    #[inline]
    pub fn propose(&mut self, error: f64, h: f64) -> Verdict {
        let StepLimits { safety, shrink, grow, .. } = self.limits;
        if !error.is_finite() {
            // Nothing is known but that it was too long: the strongest shortening, and no power is read off it later.
            self.history.rejected = Some(Rejection { step: h, log_error: f64::INFINITY });
            return Verdict { accepted: false, next: h * shrink };
        }
        if error > 1.0 {
            let log_error = math::ln(error);
            let rejection = Rejection { step: h, log_error };
            let factor = safety * math::exp(-self.decay(rejection) * log_error);
            self.history.rejected = Some(rejection);
            return Verdict { accepted: false, next: h * factor.max(shrink) };
        }
        // Below the smallest normal number the logarithm would leave the range of the exponential.
        let log_error = math::ln(error.max(f64::MIN_POSITIVE));
        let factor = safety * math::exp(self.beta * self.history.log_error - self.alpha * log_error);
        // A step that grew at once after a rejection would be rejected again: 619 times instead of 450 on slopes with
        // roots of the time, an eighth more evaluations.
        let ceiling = if self.history.rejected.is_some() { 1.0 } else { grow };
        self.history = StepHistory { log_error: log_error.max(StepHistory::BLANK.log_error), rejected: None };
        Verdict { accepted: true, next: self.limit(h * factor.max(shrink).min(ceiling)) }
    }

    /// Step after one that an event or a corner cut short.
    ///
    /// A step cut to a tenth has an error of 1e-8 of the uncut one and says nothing about the next. The caller passes
    /// as `wished` the step it would have liked (what [`propose`](Self::propose) gave last before the cut); it comes
    /// back, at most the longest allowed, and the history is wiped. Do not call `propose` for the cut step.
    pub fn after_event(&mut self, wished: f64) -> f64 {
        self.history = StepHistory::BLANK;
        self.limit(wished)
    }

    /// What is remembered, to be saved with the state of a run.
    #[must_use]
    pub fn history(&self) -> StepHistory {
        self.history
    }

    /// Goes on from a saved history.
    pub fn set_history(&mut self, history: StepHistory) {
        self.history = history;
    }

    /// The power of the error with which a rejected step is shortened. Two rejections in a row show the power of the step
    /// with which the error falls: where something is not smooth, less than the method's.
    fn decay(&self, now: Rejection) -> f64 {
        // The method's own power throughout rejects 545 times instead of 450 there: an error that falls with h² is not met
        // by a step that would quarter one of order 8. Powers that seem stronger than the method's are chance.
        let power = |before: Rejection| (before.log_error - now.log_error) / math::ln(before.step / now.step);
        let shown = self.history.rejected.map(power).filter(|power| *power > 0.0);
        shown.map_or(self.alpha, |power| power.recip().clamp(self.alpha, 1.0))
    }

    fn limit(&self, h: f64) -> f64 {
        h.abs().min(self.limits.longest).copysign(h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn control() -> StepControl {
        StepControl::new(8, StepLimits::default())
    }

    #[test]
    fn blank_history_is_the_floor() {
        assert!((StepHistory::BLANK.log_error - StepHistory::FLOOR.ln()).abs() < 1e-15);
    }

    #[test]
    fn steady_error_settles_below_the_tolerance() {
        // error = C h^8 has its fixed point where safety · ε^(β-α) = 1.
        let mut control = control();
        let mut h = 1e-3;
        for _ in 0..200 {
            let verdict = control.propose((h / 0.37_f64).powi(8), h);
            h = verdict.next;
        }
        let (beta, order) = (0.025_f64, 8.0_f64);
        let settled = 0.9_f64.powf(1.0 / (1.0 / order - 1.75 * beta));
        assert!(((h / 0.37).powi(8) - settled).abs() < 1e-9, "{h} {settled}");
    }

    #[test]
    fn rejection_shrinks_and_the_next_step_does_not_grow() {
        let mut control = control();
        let no = control.propose(256.0, 1.0);
        assert!(!no.accepted && no.next < 0.5 && no.next > 0.2);
        let yes = control.propose(1e-9, no.next);
        assert!(yes.accepted);
        assert_eq!(yes.next, no.next);
        assert!(control.propose(1e-9, 1.0).next > 2.0);
    }

    /// An error that falls with h² is met by the third attempt.
    #[test]
    fn two_rejections_show_the_power() {
        let (mut control, mut h) = (control(), 1.0);
        for attempt in 1..4 {
            let verdict = control.propose(30.0 * h * h, h);
            assert_eq!(verdict.accepted, attempt == 3, "{attempt}: {h}");
            h = verdict.next;
        }
    }

    #[test]
    fn not_finite_is_rejected() {
        let mut control = control();
        for error in [f64::NAN, f64::INFINITY] {
            assert_eq!(control.propose(error, 2.0), Verdict { accepted: false, next: 0.4 });
        }
    }

    #[test]
    fn zero_error_grows_by_the_clamp_and_signs_survive() {
        let mut control = control();
        assert_eq!(control.propose(0.0, -1.0).next, -6.0);
    }

    #[test]
    fn an_event_does_not_shorten_the_next_step() {
        let limits = StepLimits { longest: 3.0, ..StepLimits::default() };
        let mut control = StepControl::new(8, limits);
        let wished = control.propose(0.5, 1.0).next;
        assert_eq!(control.after_event(wished), wished);
        assert_eq!(control.history(), StepHistory::BLANK);
        assert_eq!(control.after_event(7.0), 3.0);
    }

    #[test]
    fn history_is_all_that_it_remembers() {
        let mut one = control();
        one.propose(0.3, 1.0);
        let mut two = control();
        two.set_history(one.history());
        assert_eq!(one, two);
        assert_eq!(one.propose(0.7, 1.0), two.propose(0.7, 1.0));
    }
}
