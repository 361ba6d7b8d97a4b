//! Linear force law of a row of springs between two changes of its springs.
//!
//! A change of a spring is first touch, lift-off, onset of slip or onset of stick. Between two changes the forces are linear in d and u for
//! any path. A sticking spring with rest position p carries G\*l(u-p), a slipping one ±G\*lκ(d-h), and both carry the normal force
//! E\*l(d-h). The laws continue smoothly beyond the next change, as the laws of a [`Branch`](crate::Branch), so that an integrator can
//! locate the change within a step.
//!
//! Rest positions of neighbouring springs differ by at most κ times their difference in height. Slipping springs are therefore always the
//! highest springs, all in one direction. The next spring to slip is the highest one that sticks.

use super::{Row, Springs, lanes};
use crate::words::{Words, push};
use crate::{Apex, Interface, Motion};

/// Change of a spring (event) at which the previous interval ended, if known.
///
/// At the event, the motion determines the change only within rounding, so the known change takes precedence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Change {
    /// The change is unknown and is determined from the motion.
    Any,
    /// The next spring has touched.
    Touches,
    /// The highest spring has lifted off.
    Parts,
    /// The highest sticking spring has reached its friction limit in a direction, +1 or -1, unless the spring has just lifted off.
    Slips(f64),
    /// The slipping springs begin to stick: σu̇ = κḋ for the slip direction σ.
    Sticks,
}

/// Tolerances within which a spring counts as having reached an event, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slack {
    /// Tolerance of indentations, m.
    pub d: f64,
    /// Tolerance of stretches, m.
    pub u: f64,
}

/// Linear force law of a row until the next change of a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lull {
    /// Apex at the start of the interval, to which all sums refer.
    from: Apex,
    /// Direction in which springs slip; 0 if no spring slips.
    sense: f64,
    /// Slope κ of the friction limit.
    slope: f64,
    /// Tangential force over G\* at the start, m².
    shear: f64,
    /// Magnitude of the slipping springs' force over G\* at the start, m².
    limit: f64,
    /// Length that sticks, m.
    stick: f64,
    /// Length that slips, times κ, m.
    slip: f64,
    /// Normal force over E\* at the start, m².
    press: f64,
    /// Length in contact, m.
    touch: f64,
    /// Stretches left until a spring slips forward and backward, m, at the start of the interval; infinite if no spring can slip.
    left: [f64; 2],
    /// Heights of the highest spring in contact and of the lowest spring out of contact, m; infinite if there is no such spring.
    heights: [f64; 2],
}

impl Row {
    /// Returns the linear force law of the row after a change, for a motion `at`.
    ///
    /// `force` is `Some` for a row under a given normal force, in which at least the lowest spring stays in contact. The value is the
    /// length in contact for which the rate of indentation in `at` was computed, m, or 0 if unknown.
    pub fn lull(
        &self,
        springs: &Springs,
        law: &Interface,
        (at, change): (&Motion, Change),
        slack: Slack,
        force: Option<f64>,
    ) -> Lull {
        // The lowest springs have equal heights and lift off together.
        let lowest = if force.is_some() { springs.up_to(springs.heights()[0]) } else { 0 };
        let touching = self.touching_after(springs, (at, change), slack.d).max(lowest);
        let still = self.still(springs, law, (lowest, touching));
        if still.slope == 0.0 || touching == 0 {
            return still;
        }
        let left = |rank: usize, sense: f64| self.left(springs, still.slope, (rank, sense));
        let top = touching - 1;
        let near = |sense: f64| left(top, sense) <= slack.u;
        let slower = force.filter(|touched| *touched > 0.0).map_or(1.0, |touched| touched / still.touch);
        let reached = |sense: f64| sense * at.du > still.slope * slower * at.dd && near(sense);
        let sense = match change {
            Change::Sticks => 0.0,
            // A spring without stretch reaches its limit when it lifts off. This does not determine the state of the spring below.
            Change::Slips(sense) if near(sense) => sense,
            _ if reached(1.0) => 1.0,
            _ if reached(-1.0) => -1.0,
            _ => 0.0,
        };
        let mut stick = touching;
        while sense != 0.0 && stick > 0 && left(stick - 1, sense) <= slack.u {
            stick -= 1;
        }
        let ahead = |it: f64| if stick > 0 && sense != -it { left(stick - 1, it) } else { f64::INFINITY };
        let inner = springs.sums_of(stick, still.from.d);
        let limit = still.slope * (still.press - inner.reduced_force);
        // A spring that has just touched is unstretched.
        let old = stick.min(self.touching);
        Lull {
            sense,
            shear: lanes::stuck(springs.first(old), &self.anchors[..old], still.from.u) + sense * limit,
            limit,
            stick: inner.reduced_stiffness,
            slip: still.slope * (still.touch - inner.reduced_stiffness),
            left: [ahead(1.0), ahead(-1.0)],
            ..still
        }
    }

    /// Returns the linear law of the row without friction. The `lowest` springs never lift off.
    fn still(&self, springs: &Springs, law: &Interface, (lowest, touching): (usize, usize)) -> Lull {
        let sums = springs.sums_of(touching, self.apex.d);
        let top = if touching > lowest { springs.heights()[touching - 1] } else { f64::NEG_INFINITY };
        let next = springs.heights().get(touching).copied().unwrap_or(f64::INFINITY);
        Lull {
            from: self.apex,
            sense: 0.0,
            slope: law.stick_slope(),
            shear: 0.0,
            limit: 0.0,
            stick: 0.0,
            slip: 0.0,
            press: sums.reduced_force,
            touch: sums.reduced_stiffness,
            left: [f64::INFINITY; 2],
            heights: [top, next],
        }
    }

    /// Returns the stretch left until a distinct spring slips in a direction, m.
    fn left(&self, springs: &Springs, slope: f64, (rank, sense): (usize, f64)) -> f64 {
        let stretch = if rank < self.touching { self.apex.u - self.anchors[rank] } else { 0.0 };
        slope * (self.apex.d - springs.heights()[rank]) - sense * stretch
    }

    /// Returns the number of distinct springs in contact after a change.
    fn touching_after(&self, springs: &Springs, (at, change): (&Motion, Change), slack: f64) -> usize {
        let d = self.apex.d;
        match change {
            Change::Touches => springs.up_to(d + slack),
            Change::Parts => springs.below(d - slack),
            _ if at.dd > 0.0 => springs.up_to(d + slack),
            _ if at.dd < 0.0 => springs.below(d - slack),
            _ => self.touching,
        }
    }
}

impl Lull {
    /// Returns the length in contact, m.
    #[inline]
    pub fn touch(&self) -> f64 {
        self.touch
    }

    /// Returns the slope κ of the friction limit.
    #[inline]
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// Returns the direction in which all springs slip, +1 or -1; 0 if one sticks or none is in contact.
    pub fn gross(&self) -> f64 {
        if self.stick == 0.0 && self.touch > 0.0 { self.sense } else { 0.0 }
    }

    /// Returns the direction in which springs slip, +1 or -1; 0 if none does.
    #[inline]
    pub fn sense(&self) -> f64 {
        self.sense
    }

    /// Returns the tangential force `F_x`, N.
    #[inline]
    pub fn force(&self, law: &Interface, at: Apex) -> f64 {
        let (rise, way) = (at.d - self.from.d, at.u - self.from.u);
        law.tangential_modulus() * (self.shear + self.stick * way + self.sense * self.slip * rise)
    }

    /// Returns the reduced force M(d), m²: the normal force over E\*.
    #[inline]
    pub fn reduced_force(&self, d: f64) -> f64 {
        self.press + self.touch * (d - self.from.d)
    }

    /// Returns the indentation at a reduced force M (m²), m, and the derivative dd/dM, 1/m.
    #[inline]
    pub fn depth(&self, reduced_force: f64) -> (f64, f64) {
        (self.from.d + (reduced_force - self.press) / self.touch, 1.0 / self.touch)
    }

    /// Returns the tangential stiffness of the sticking springs, N/m.
    #[inline]
    pub fn stiffness(&self, law: &Interface) -> f64 {
        law.tangential_modulus() * self.stick
    }

    /// Returns the friction power of the slipping springs Σ G\*lκ(d-h)(σu̇ - κḋ), W.
    #[inline]
    pub fn friction_power(&self, law: &Interface, at: &Motion) -> f64 {
        let limit = self.limit + self.slip * (at.d - self.from.d);
        law.tangential_modulus() * limit * (self.sense * at.du - self.slope * at.dd)
    }

    /// Returns the stretch left until a spring slips in a direction, m.
    #[inline]
    pub fn left(&self, sense: f64, at: Apex) -> f64 {
        let left = if sense > 0.0 { self.left[0] } else { self.left[1] };
        left + self.slope * (at.d - self.from.d) - sense * (at.u - self.from.u)
    }

    /// Returns the height of the highest spring in contact, m; -∞ if no spring can lift off.
    #[inline]
    pub fn top(&self) -> f64 {
        self.heights[0]
    }

    /// Returns the height of the lowest spring out of contact, m; ∞ if there is none.
    #[inline]
    pub fn next(&self) -> f64 {
        self.heights[1]
    }

    /// Moves the origin of displacements: all displacements grow by `by` (m).
    pub fn shift(&mut self, by: f64) {
        self.from.u += by;
    }

    /// Writes the law as words.
    pub fn write(&self, words: &mut Vec<u64>) {
        push(words, [self.from.d, self.from.u, self.sense, self.shear, self.limit, self.stick, self.slip]);
        push(words, [self.press, self.touch]);
        push(words, self.left);
        push(words, self.heights);
    }

    /// Reads a law that [`Self::write`] wrote, for a contact with this interface.
    pub fn read(law: &Interface, words: &mut Words<'_>) -> Option<Self> {
        let from = words.apex()?;
        let sense = words.finite().filter(|sense| [1.0, 0.0, -1.0].contains(sense))?;
        let mut sums = [0.0; 6];
        for sum in &mut sums {
            *sum = words.finite()?;
        }
        let [shear, limit, stick, slip, press, touch] = sums;
        let left = [words.number()?, words.number()?];
        let heights = [words.number()?, words.number()?];
        let slope = law.stick_slope();
        Some(Self { from, sense, slope, shear, limit, stick, slip, press, touch, left, heights })
    }
}
