//! Nyström's method, and DOP853 for steps that end at a singular moment.
//!
//! Grading a step multiplies ẍ by the pace of time and adds a term with ẋ: what a Nyström method spares is lost there, and
//! with it its order. Such steps are few, one before each start of gross slip; they go by [`Dop853`].

use crate::{Attempt, Conservative, Dop853, Grade, Lanes, Many, Nystrom, One, System};

/// [`Nystrom`] for even steps, [`Dop853`] for graded ones, of one and the same motion.
#[derive(Debug, Clone)]
pub struct Paired<L: Lanes = Many> {
    even: Nystrom<L>,
    graded: Dop853,
    /// Which of both made the last attempt; it is where the motion is.
    last: Method,
    /// Whether the other one is there, too.
    both: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Method {
    Even,
    Graded,
}

impl Paired {
    /// Workspace for `positions` positions and `quadratures` quadratures; `total` components as [`System::total`] has them.
    #[must_use]
    pub fn new(positions: usize, quadratures: usize, total: usize) -> Self {
        Self::of(Nystrom::new(positions, quadratures), Dop853::new(2 * positions, total))
    }
}

impl Paired<One> {
    /// Workspace for one position and one quadrature.
    #[must_use]
    pub fn one(total: usize) -> Self {
        Self::of(Nystrom::one(), Dop853::new(2, total))
    }
}

impl<L: Lanes> Paired<L> {
    fn of(even: Nystrom<L>, graded: Dop853) -> Self {
        Self { even, graded, last: Method::Even, both: false }
    }

    /// Puts one of both where the motion is.
    fn take<S: System + Conservative + ?Sized>(&mut self, system: &S, method: Method) {
        if self.last != method && !self.both {
            match method {
                Method::Even => self.even.start(system, self.graded.time(), self.graded.begin()),
                Method::Graded => {
                    let time = Attempt::<S>::time(&self.even);
                    self.graded.start(system, time, Attempt::<S>::begin(&self.even));
                }
            }
            self.both = true;
        }
        self.last = method;
    }
}

/// What the one of both says that made the last attempt.
macro_rules! last {
    ($self:ident, $method:ident($($argument:expr),*)) => {
        match $self.last {
            Method::Even => Attempt::<S>::$method(&$self.even $(, $argument)*),
            Method::Graded => Attempt::<S>::$method(&$self.graded $(, $argument)*),
        }
    };
    (mut $self:ident, $method:ident($($argument:expr),*)) => {
        match $self.last {
            Method::Even => Attempt::<S>::$method(&mut $self.even $(, $argument)*),
            Method::Graded => Attempt::<S>::$method(&mut $self.graded $(, $argument)*),
        }
    };
}

impl<S: System + Conservative + ?Sized, L: Lanes> Attempt<S> for Paired<L> {
    fn reach(&self) -> f64 {
        Attempt::<S>::reach(&self.even)
    }

    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        self.even.start(system, t, y);
        (self.last, self.both) = (Method::Even, false);
    }

    fn restart_slopes(&mut self, system: &S) {
        last!(mut self, restart_slopes(system));
        self.both = false;
    }

    fn first_step(&mut self, system: &S, longest: f64, scale: &[f64]) -> f64 {
        self.take(system, Method::Even);
        self.even.first_step(system, longest, scale)
    }

    #[inline]
    fn attempt_until(&mut self, system: &S, end: f64, scale: &[f64]) -> f64 {
        self.take(system, Method::Even);
        self.even.attempt_until(system, end, scale)
    }

    fn attempt_graded(&mut self, system: &S, end: f64, scale: &[f64], grade: Grade) -> f64 {
        if grade == Grade::Even {
            return self.attempt_until(system, end, scale);
        }
        self.take(system, Method::Graded);
        self.graded.attempt_graded(system, end, scale, grade)
    }

    fn end_slopes(&mut self, system: &S) {
        last!(mut self, end_slopes(system));
    }

    fn dense(&mut self, system: &S) {
        last!(mut self, dense(system));
    }

    fn cut(&mut self, t: f64) {
        last!(mut self, cut(t));
    }

    fn accept(&mut self) {
        last!(mut self, accept());
        self.both = false;
    }

    #[inline]
    fn value(&self, i: usize, t: f64) -> f64 {
        last!(self, value(i, t))
    }

    #[inline]
    fn time(&self) -> f64 {
        last!(self, time())
    }

    #[inline]
    fn end_time(&self) -> f64 {
        last!(self, end_time())
    }

    #[inline]
    fn begin(&self) -> &[f64] {
        last!(self, begin())
    }

    fn begin_mut(&mut self) -> &mut [f64] {
        self.both = false;
        last!(mut self, begin_mut())
    }

    #[inline]
    fn end(&self) -> &[f64] {
        last!(self, end())
    }

    #[inline]
    fn begin_slope(&self, i: usize) -> f64 {
        last!(self, begin_slope(i))
    }

    #[inline]
    fn end_slope(&self, i: usize) -> f64 {
        last!(self, end_slope(i))
    }

    fn evaluations(&self) -> u64 {
        Attempt::<S>::evaluations(&self.even) + self.graded.evaluations()
    }
}
