//! Nyström's method, and DOP853 for steps that end at a singular moment.
//!
//! Grading a step multiplies ẍ by the pace of time and adds a term with ẋ: what a Nyström method spares is lost there, and
//! with it its order. Such steps are few, one before each start of gross slip; they go by [`DormandPrince`].
//!
//! Both carry one motion: whichever makes an attempt is first put where the other one has brought it.

use crate::{
    Attempt, Completion, Conservative, DormandPrince, End, Hand, Many, Method, Nystrom, One, Span, Step,
    Storage, System, Target,
};

/// [`Nystrom`] for even steps, [`DormandPrince`] for graded ones, of one and the same motion.
#[derive(Debug, Clone)]
pub struct Paired<N: Storage = Many> {
    /// For steps whose stages lie evenly: nearly all.
    even: Nystrom<N>,
    /// For those that end at a singular moment.
    graded: DormandPrince,
    /// Which of both made the last attempt; it is where the motion is.
    last: By,
    /// Whether the other one is there, too.
    both: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum By {
    Even,
    Graded,
}

impl Paired {
    /// Workspace for `positions` positions and `quadratures` quadratures; `total` components as [`System::total`] has them.
    #[must_use]
    pub fn new(positions: usize, quadratures: usize, total: usize) -> Self {
        Self::of(Nystrom::new(positions, quadratures), DormandPrince::new(2 * positions, total))
    }
}

impl Paired<One> {
    /// Workspace for one position and one quadrature.
    #[must_use]
    pub fn one(total: usize) -> Self {
        Self::of(Nystrom::one(), DormandPrince::new(2, total))
    }
}

impl<N: Storage> Paired<N> {
    /// Both where nothing has begun.
    fn of(even: Nystrom<N>, graded: DormandPrince) -> Self {
        Self { even, graded, last: By::Even, both: false }
    }

    /// Puts one of both where the motion is.
    fn take<S: System + Conservative + ?Sized>(&mut self, system: &S, by: By) {
        // One evaluation where the method changes, and none where the other one is at the same start already, as after an
        // attempt that was rejected. Starting both anew each time would cost that one in every step.
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

    /// Apart from even attempts, which are to be inlined into the loop of a run.
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

/// What the one of both says that made the last attempt.
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

    /// The slopes are those of the method that made the last attempt; the other one was started where it stands, if it is there.
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
