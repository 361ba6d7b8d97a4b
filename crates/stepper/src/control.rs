//! Step-size control.

/// Proportional-integral (PI) step-size control.
///
/// factor = safety · ε^-α · ε₋₁^β with β = 0.2/k and α = 1/k - 0.75 β, for an error estimate of order hᵏ. ε is the error of this step and
/// ε₋₁ the error of the last accepted step, in units of the tolerance. After two rejections in a row, α is 1/p with the observed order p,
/// at least the usual α and at most 1.
///
/// Source: Hairer, Nørsett, Wanner, *Solving ODEs I*, 2nd ed., section II.4, and Hairer, Wanner, *Solving ODEs II*, section IV.2
/// (PI control); Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533 (rejections in a row).
///
/// The history of the control is part of the state of a run: it can be cloned and compared.
#[derive(Debug, Clone, PartialEq)]
pub struct StepControl {
    limits: StepLimits,
    alpha: f64,
    beta: f64,
    history: StepHistory,
}

/// Limits of a [`StepControl`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepLimits {
    /// Safety factor on the step that would just meet the tolerance; 0.5 to 1, default 0.9.
    pub safety: f64,
    /// Smallest ratio of two successive steps, below 1; default 0.2.
    pub shrink: f64,
    /// Largest ratio of two successive steps, above 1; default 6.
    pub grow: f64,
    /// Maximum step, s; unbounded by default.
    pub longest: f64,
}

impl Default for StepLimits {
    fn default() -> Self {
        // The values of Hairer's DOP853, except 0.2 in place of 1/3.
        Self { safety: 0.9, shrink: 0.2, grow: 6.0, longest: f64::INFINITY }
    }
}

/// Data of earlier attempts that a step-size control uses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepHistory {
    /// Natural logarithm of the error of the last accepted step, in units of the tolerance. At least the logarithm of
    /// [`StepHistory::FLOOR`].
    pub log_error: f64,
    /// Last attempt, if it was rejected. After a rejection the next step does not grow.
    pub rejected: Option<Rejection>,
}

/// A rejected attempt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rejection {
    /// Step length, s.
    pub step: f64,
    /// Natural logarithm of the error of the attempt; ∞ if the error was not finite.
    pub log_error: f64,
}

impl StepHistory {
    /// Smallest error in the history; smaller errors count as this value.
    // Hairer's value.
    pub const FLOOR: f64 = 1e-4;
    /// Empty history, equal to the history after a step with the error [`StepHistory::FLOOR`].
    pub const BLANK: Self = Self { log_error: -9.210_340_371_976_182, rejected: None };
}

/// Decision of a [`StepControl`] about an attempt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// Whether the step met the tolerance.
    pub accepted: bool,
    /// Length of the next attempt, s, with the sign of the present length.
    pub next: f64,
}

impl StepControl {
    /// Returns a control for an error estimate of order h^`order` (8 for [`DormandPrince`](crate::DormandPrince)).
    #[must_use]
    pub fn new(order: u32, limits: StepLimits) -> Self {
        let order = f64::from(order.max(1));
        // 0.2/k is a compromise: without the integral part more attempts are rejected, with more of it steps become shorter.
        let beta = 0.2 / order;
        Self { limits, alpha: 1.0 / order - 0.75 * beta, beta, history: StepHistory::BLANK }
    }

    /// Accepts or rejects an attempt of length `h` (s) with this `error`, and proposes the next length. Errors up to 1 are accepted; larger
    /// errors and NaN are rejected.
    #[inline]
    pub fn propose(&mut self, error: f64, h: f64) -> Verdict {
        let StepLimits { safety, shrink, grow, .. } = self.limits;
        if !error.is_finite() {
            // An infinite error shows no order: shorten as much as allowed.
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
        // The logarithm of a subnormal number would exceed the range of the exponential.
        let log_error = math::ln(error.max(f64::MIN_POSITIVE));
        let factor = safety * math::exp(self.beta * self.history.log_error - self.alpha * log_error);
        // A step that grows directly after a rejection is often rejected again.
        let ceiling = if self.history.rejected.is_some() { 1.0 } else { grow };
        self.history = StepHistory { log_error: log_error.max(StepHistory::BLANK.log_error), rejected: None };
        Verdict { accepted: true, next: self.limit(h * factor.max(shrink).min(ceiling)) }
    }

    /// Returns the next step length after an event or a corner has cut a step, and clears the history.
    ///
    /// `wished` is the last proposal of [`propose`](Self::propose) before the cut. The result is `wished`, limited to the maximum step.
    /// Do not call `propose` for the cut step: the small error of a cut step does not predict the next error.
    pub fn after_event(&mut self, wished: f64) -> f64 {
        self.history = StepHistory::BLANK;
        self.limit(wished)
    }

    /// Returns the history, to be saved with the state of a run.
    #[must_use]
    pub fn history(&self) -> StepHistory {
        self.history
    }

    /// Restores a history saved with the state of a run.
    pub fn set_history(&mut self, history: StepHistory) {
        self.history = history;
    }

    /// Returns the exponent of the error by which a rejected step is shortened. Two rejections in a row show the actual order of the error,
    /// which is lower than the order of the method if the right-hand side is not smooth.
    fn decay(&self, now: Rejection) -> f64 {
        // Observed orders above the method's are accidental and do not count.
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
