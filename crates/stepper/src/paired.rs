//! Nyström's method, combined with DOP853 for steps that begin or end at a singular moment.
//!
//! In a graded step the acceleration with respect to σ contains a velocity term. A Nyström method would lose its order, so the few graded
//! steps use [`DormandPrince`].
//!
//! Both methods integrate the same motion: before an attempt, a method takes over the state of the other one.

use crate::{
    Attempt, Completion, Conservative, DormandPrince, End, Hand, Many, Method, Nystrom, One, Span, Step,
    Storage, System, Target,
};

/// Pair of methods for one motion: [`Nystrom`] for even steps and [`DormandPrince`] for graded steps.
#[derive(Debug, Clone)]
pub struct Paired<N: Storage = Many> {
    /// Method for even steps.
    even: Nystrom<N>,
    /// Method for graded steps.
    graded: DormandPrince,
    /// Method of the last attempt, which contains the current state.
    last: By,
    /// Whether the other method contains the current state, too.
    both: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum By {
    Even,
    Graded,
}

impl Paired {
    /// Returns a workspace for `positions` positions and `quadratures` quadratures; `total` is [`System::total`].
    #[must_use]
    pub fn new(positions: usize, quadratures: usize, total: usize) -> Self {
        Self::of(Nystrom::new(positions, quadratures), DormandPrince::new(2 * positions, total))
    }
}

impl Paired<One> {
    /// Returns a workspace for one position and one quadrature; `total` is [`System::total`].
    #[must_use]
    pub fn one(total: usize) -> Self {
        Self::of(Nystrom::one(), DormandPrince::new(2, total))
    }
}

impl<N: Storage> Paired<N> {
    /// Returns the pair of methods without a starting point.
    fn of(even: Nystrom<N>, graded: DormandPrince) -> Self {
        Self { even, graded, last: By::Even, both: false }
    }

    /// Selects a method for the next attempt and gives it the current state.
    fn take<S: System + Conservative + ?Sized>(&mut self, system: &S, by: By) {
        // Costs one evaluation at a change of method, and none if the other method is at the same start, as after a rejection.
        if self.last != by && !self.both {
            match by {
                By::Even => {
                    let Span { time, begin, .. } = self.graded.span();
                    self.even.start(system, time, begin);
                }
                By::Graded => {
                    let Span { time, begin, .. } = self.even.span();
                    self.graded.start(system, time, begin);
                }
            }
            self.both = true;
        }
        self.last = by;
    }

    /// Attempts a graded step. Separate from `attempt`, because even attempts are inlined into the loop of a run.
    fn attempt_graded<S: System + Conservative + ?Sized>(
        &mut self,
        system: &S,
        to: Target,
        scale: &[f64],
    ) -> f64 {
        self.take(system, By::Graded);
        self.graded.attempt(system, to, scale)
    }
}

/// Calls the method that made the last attempt.
macro_rules! last {
    ($self:ident, $method:ident($($argument:expr),*)) => {
        match $self.last {
            By::Even => $self.even.$method($($argument),*),
            By::Graded => $self.graded.$method($($argument),*),
        }
    };
}

impl<N: Storage> Method for Paired<N> {
    fn stability_limit(&self) -> f64 {
        self.even.stability_limit()
    }

    fn coasts(&self) -> bool {
        false
    }

    fn evaluations(&self) -> u64 {
        self.even.evaluations() + self.graded.evaluations()
    }

    fn hand(&self) -> Hand {
        Hand { graded: self.last == By::Graded, both: self.both }
    }

    fn set_hand(&mut self, hand: Hand) {
        (self.last, self.both) = (if hand.graded { By::Graded } else { By::Even }, hand.both);
    }
}

impl<N: Storage> Step for Paired<N> {
    #[inline]
    fn span(&self) -> Span<'_> {
        last!(self, span())
    }

    #[inline]
    fn slope(&self, i: usize, at: End) -> f64 {
        last!(self, slope(i, at))
    }

    #[inline]
    fn value_at(&self, i: usize, part: f64) -> f64 {
        last!(self, value_at(i, part))
    }

    #[inline]
    fn part(&self, t: f64) -> f64 {
        last!(self, part(t))
    }

    fn moment(&self, part: f64) -> [f64; 2] {
        last!(self, moment(part))
    }

    fn cut(&mut self, t: f64) {
        last!(self, cut(t));
    }

    fn accept(&mut self) {
        last!(self, accept());
        self.both = false;
    }

    fn first_slopes(&self, slopes: &mut Vec<f64>) {
        last!(self, first_slopes(slopes));
    }
}

impl<S: System + Conservative + ?Sized, N: Storage> Attempt<S> for Paired<N> {
    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        self.even.start(system, t, y);
        (self.last, self.both) = (By::Even, false);
    }

    /// `slopes` belong to the method of the last attempt. The other method starts at the same state if [`Hand::both`] is set.
    fn take_up(&mut self, system: &S, at: (f64, &[f64]), hand: Hand, slopes: &[f64]) {
        let (t, y) = at;
        match (hand.graded, hand.both) {
            (true, both) => {
                self.graded.take_up(system, at, hand, slopes);
                if both {
                    self.even.start(system, t, y);
                }
            }
            (false, both) => {
                self.even.take_up(system, at, hand, slopes);
                if both {
                    self.graded.start(system, t, y);
                }
            }
        }
        self.set_hand(hand);
    }

    fn first_step(&mut self, system: &S, longest: f64, scale: &[f64]) -> f64 {
        self.take(system, By::Even);
        self.even.first_step(system, longest, scale)
    }

    #[inline]
    fn attempt(&mut self, system: &S, to: Target, scale: &[f64]) -> f64 {
        if to.grade.is_even() {
            self.take(system, By::Even);
            self.even.attempt(system, to, scale)
        } else {
            self.attempt_graded(system, to, scale)
        }
    }

    fn complete(&mut self, system: &S, what: Completion) {
        last!(self, complete(system, what));
    }
}
