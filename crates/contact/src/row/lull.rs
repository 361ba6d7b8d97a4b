//! A row between two changes of its springs.
//!
//! While no spring touches, parts, begins to slip or sticks again, the forces of a row are straight in d and u, whatever the
//! path: a spring that sticks at p carries G\*l(u-p), one that slips ±G\*lκ(d-h), and both press with E\*l(d-h). So a lull
//! is two straight lines and the five distances to its end; it goes on smoothly beyond, as a [`Branch`](crate::Branch) does,
//! so that a stepper of any order can look for the end inside a step.
//!
//! Anchors of springs that touch differ by at most κ times their heights. So those that slip are always the highest, all in
//! one sense, and the next to slip is the highest that sticks.

use super::{Row, Springs, lanes};
use crate::words::{Words, push};
use crate::{Apex, Interface, Motion};

/// What the last lull ended with, where that is known.
///
/// At that moment the motion says it within rounding only: it is decreed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Change {
    /// Not known: the motion says it.
    Any,
    /// The next spring has touched.
    Touches,
    /// The highest spring has parted.
    Parts,
    /// The highest spring that sticks has reached its limit in a sense, +1 or -1; unless it has parted at that moment.
    Slips(f64),
    /// The springs that slip come to stick: u̇ and κḋ are equal.
    Sticks,
}

/// How near to its change a spring counts as there, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slack {
    /// Of indentations.
    pub d: f64,
    /// Of stretches.
    pub u: f64,
}

/// The law of a row until the next change of a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lull {
    /// Where it began; all else is counted from there.
    from: Apex,
    /// Sense in which springs slip; 0 where none does.
    sense: f64,
    /// κ.
    slope: f64,
    /// `F_x` over G\* at the start, m².
    shear: f64,
    /// What of it slips, as a magnitude, m².
    limit: f64,
    /// Length that sticks, m.
    stick: f64,
    /// κ times the length that slips, m.
    slip: f64,
    /// `F_N` over E\* at the start, m².
    press: f64,
    /// Length that touches, m.
    touch: f64,
    /// Stretches that are left at the start until a spring slips forward and backward, m; infinite where none can.
    left: [f64; 2],
    /// Heights of the highest spring that touches and of the lowest that does not, m; infinite without any.
    heights: [f64; 2],
}

impl Row {
    /// The law of the row from where it stands, moving as `at` does, after a change. A row pressed by a `force` has one
    /// spring at least that holds it, however small that is; of such a row the length is told that touches by the law by which `at`
    /// sinks, m, 0 where none is known: it sinks slower the more springs touch.
    pub fn lull(
        &self,
        springs: &Springs,
        law: &Interface,
        (at, change): (&Motion, Change),
        slack: Slack,
        force: Option<f64>,
    ) -> Lull {
        // The lowest springs have all one height: under a force they part together or not at all.
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
            // A spring without stretch comes to its limits where it parts: that says nothing about the one below it.
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
        // What has only just touched is unstretched.
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

    /// Without friction: springs that press, of which the `lowest` never part.
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

    /// Stretch left until the distinct spring of a rank slips in a sense, m.
    fn left(&self, springs: &Springs, slope: f64, (rank, sense): (usize, f64)) -> f64 {
        let stretch = if rank < self.touching { self.apex.u - self.anchors[rank] } else { 0.0 };
        slope * (self.apex.d - springs.heights()[rank]) - sense * stretch
    }

    /// Number of distinct springs that touch after a change.
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
    /// Length that touches, m.
    #[inline]
    pub fn touch(&self) -> f64 {
        self.touch
    }

    /// Sense in which springs slip, +1 or -1; 0 where none does.
    #[inline]
    pub fn sense(&self) -> f64 {
        self.sense
    }

    /// `F_x`, N.
    #[inline]
    pub fn force(&self, law: &Interface, at: Apex) -> f64 {
        let (rise, way) = (at.d - self.from.d, at.u - self.from.u);
        law.tangential_modulus() * (self.shear + self.stick * way + self.sense * self.slip * rise)
    }

    /// M(d), m²: the normal force over E\*.
    #[inline]
    pub fn reduced_force(&self, d: f64) -> f64 {
        self.press + self.touch * (d - self.from.d)
    }

    /// Indentation at which M (m²) is reached, m, and its slope dd/dM, 1/m.
    #[inline]
    pub fn depth(&self, reduced_force: f64) -> (f64, f64) {
        (self.from.d + (reduced_force - self.press) / self.touch, 1.0 / self.touch)
    }

    /// Stiffness of the springs that stick, N/m.
    #[inline]
    pub fn stiffness(&self, law: &Interface) -> f64 {
        law.tangential_modulus() * self.stick
    }

    /// Friction power Σ G\*lκ(d-h)(σu̇ - κḋ) of the springs that slip, W.
    #[inline]
    pub fn friction_power(&self, law: &Interface, at: &Motion) -> f64 {
        let limit = self.limit + self.slip * (at.d - self.from.d);
        law.tangential_modulus() * limit * (self.sense * at.du - self.slope * at.dd)
    }

    /// Stretch left until a spring slips in a sense, m.
    #[inline]
    pub fn left(&self, sense: f64, at: Apex) -> f64 {
        let left = if sense > 0.0 { self.left[0] } else { self.left[1] };
        left + self.slope * (at.d - self.from.d) - sense * (at.u - self.from.u)
    }

    /// Height of the highest spring that touches, m; -∞ without one that may part.
    #[inline]
    pub fn top(&self) -> f64 {
        self.heights[0]
    }

    /// Height of the lowest spring that does not, m; ∞ without any.
    #[inline]
    pub fn next(&self) -> f64 {
        self.heights[1]
    }

    /// Counts displacements from another origin, `by` (m) further back.
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

    /// Reads what [`Self::write`] wrote of a contact with this interface.
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
