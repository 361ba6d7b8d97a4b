//! Steps whose stages crowd towards an end, where forces go with the root of the time from there.

/// How the moments of a step lie in it: its stages run evenly over σ from 0 to 1, time goes as φ(σ).
///
/// A force that goes with a power 3/2 of the time from a singular moment (a contact that begins or ends, the last of its
/// springs that begin to slip) costs every method its order. In √ of that time it is smooth: where the singular moment is
/// an end of the step, a step of full length keeps all of the order.
// For ẍ = (35/4) s^{3/2} - 9(x - s^{7/2}) up to s = 0 one step of 0.1 misses by 2e-6 even and by 3e-8 graded, one of 0.2 by
// 1e-5 and 3e-6; one of 0.4 by 7e-5 and 3e-4: where the step is long for the swing itself, even stages see more of it. Who
// takes a step grades it only where the singular moment is an end of it; inside it neither helps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Grade {
    /// φ = σ.
    #[default]
    Even,
    /// φ = σ as well, and few of them: the pair of order 5, for a step that something near will end.
    Few,
    /// φ = σ²: the step starts at a singular moment.
    Start,
    /// φ = 1 - (1-σ)²: it ends at one.
    End,
}

impl Grade {
    /// Whether the stages lie evenly.
    #[inline]
    pub(crate) fn is_even(self) -> bool {
        matches!(self, Self::Even | Self::Few)
    }

    /// φ(σ), the part of the time.
    #[inline]
    pub(super) fn time(self, s: f64) -> f64 {
        match self {
            Self::Even | Self::Few => s,
            Self::Start => s * s,
            Self::End => s * (2.0 - s),
        }
    }

    /// φ'(σ).
    #[inline]
    pub(super) fn pace(self, s: f64) -> f64 {
        match self {
            Self::Even | Self::Few => 1.0,
            Self::Start => 2.0 * s,
            Self::End => 2.0 * (1.0 - s),
        }
    }

    /// σ at a part of the time, with the part that is left.
    #[inline]
    pub(super) fn fraction(self, done: f64, left: f64) -> f64 {
        match self {
            Self::Even | Self::Few => done,
            Self::Start => done.max(0.0).sqrt(),
            Self::End => 1.0 - left.max(0.0).sqrt(),
        }
    }
}
