//! Graded steps: stages are concentrated near one end, because forces vary with a power 3/2 of the time to that end.

/// Distribution of the stages in a step. Stages are evenly distributed over a variable σ from 0 to 1; the fraction of time is φ(σ).
///
/// Some forces vary with the power 3/2 of the time to a singular moment, for example where gross slip begins. Every Runge–Kutta method
/// loses its order there. The force is smooth in the square root of that time, so a graded step keeps the order.
// A step is graded only if the singular moment is one of its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Grade {
    /// φ = σ.
    #[default]
    Even,
    /// φ = σ with few stages: the method of order 5(4), for a step that an event is expected to cut.
    Few,
    /// φ = σ²: the step begins at a singular moment.
    Start,
    /// φ = 1 - (1-σ)²: the step ends at a singular moment.
    End,
}

impl Grade {
    /// Whether the stages are evenly distributed in time.
    #[inline]
    pub(crate) fn is_even(self) -> bool {
        matches!(self, Self::Even | Self::Few)
    }

    /// Returns φ(σ), the fraction of time.
    #[inline]
    pub(super) fn time(self, s: f64) -> f64 {
        match self {
            Self::Even | Self::Few => s,
            Self::Start => s * s,
            Self::End => s * (2.0 - s),
        }
    }

    /// Returns the derivative φ'(σ) of the fraction of time.
    #[inline]
    pub(super) fn pace(self, s: f64) -> f64 {
        match self {
            Self::Even | Self::Few => 1.0,
            Self::Start => 2.0 * s,
            Self::End => 2.0 * (1.0 - s),
        }
    }

    /// Returns σ at the fraction of time `done`. The argument `left` is 1 - `done`.
    #[inline]
    pub(super) fn fraction(self, done: f64, left: f64) -> f64 {
        match self {
            Self::Even | Self::Few => done,
            Self::Start => done.max(0.0).sqrt(),
            Self::End => 1.0 - left.max(0.0).sqrt(),
        }
    }
}
