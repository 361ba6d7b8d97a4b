//! Static and kinetic friction: a contact breaks loose as a whole and sticks again as a whole.
//!
//! Partial slip obeys the static coefficient μ_s. When the last spring, the lowest one, reaches its limit, the limits of all springs
//! fall from κ_s(d-h) to κ_k(d-h) at once. The released elastic energy is friction work. The contact slides at μ_k while
//! σu̇ > κ_kḋ. Then it sticks again, and partial slip obeys μ_s from the stretches ±κ_k(d-h).
//!
//! The static coefficient may grow while the contact rests, in stairs of 1/1024 of its scale.
//!
//! Both engines share this logic. Along a straight path the limits of the lowest spring are linear, so that a path consists of legs
//! with one coefficient each.

use crate::words::{Words, push};
use crate::{Apex, ContactError, Interface, Memory, Move, Outcome, Response, Segment, SpringRow};
use std::sync::Arc;

/// Rest of a contact whose static friction coefficient grows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Rest {
    /// Time at which the rest began, s; ∞ while the contact slides or is open.
    since: f64,
    /// Stair of the growth.
    stair: u32,
    /// Interface with the coefficient of the stair; `None` on stair 0.
    law: Option<Arc<Interface>>,
}

impl Rest {
    /// No rest.
    pub(crate) const NONE: Self = Self { since: f64::INFINITY, stair: 0, law: None };

    /// Writes the rest as words.
    pub(crate) fn write(&self, words: &mut Vec<u64>) {
        push(words, [self.since]);
        words.push(u64::from(self.stair));
    }

    /// Reads a rest that [`Self::write`] wrote.
    pub(crate) fn read(law: &Interface, words: &mut Words<'_>) -> Option<Self> {
        let since = words.number()?;
        let stair =
            u32::try_from(words.word()?).ok().filter(|stair| law.growth().is_some() || *stair == 0)?;
        let law = (stair > 0).then(|| Arc::new(law.on_stair(stair)));
        Some(Self { since, stair, law })
    }
}

/// First part of a straight path that obeys one coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Leg {
    /// The contact slides at μ_k along the whole path.
    Slides,
    /// The contact does not break loose.
    Holds,
    /// The contact breaks loose at a point of the path, in a direction.
    Breaks(Apex, f64),
}

/// Largest number of times that a contact breaks loose along one straight path.
///
/// A second time needs a path on which the load falls, and is in the opposite direction; a third one is rounding.
const MOST_BREAKS: usize = 4;

impl Memory {
    /// Returns the direction in which the contact slides after it has broken loose; 0 otherwise.
    #[inline]
    pub fn slides(&self) -> f64 {
        match self {
            Self::Curve(curve) => curve.slides(),
            Self::Row(SpringRow { row, .. }) => row.slides(),
        }
    }

    fn rest(&self) -> &Rest {
        match self {
            Self::Curve(curve) => &curve.rest,
            Self::Row(SpringRow { row, .. }) => &row.rest,
        }
    }

    fn rest_mut(&mut self) -> &mut Rest {
        match self {
            Self::Curve(curve) => &mut curve.rest,
            Self::Row(SpringRow { row, .. }) => &mut row.rest,
        }
    }

    /// Returns the interface with the present static friction coefficient, which may grow at rest.
    #[inline]
    pub fn law<'a>(&'a self, law: &'a Interface) -> &'a Interface {
        match law.growth() {
            None => law,
            Some(_) => self.rest().law.as_deref().unwrap_or(law),
        }
    }

    /// Lets the static friction coefficient grow up to time t (s), if the contact rests. Returns whether it has changed.
    ///
    /// The rest begins at the first call at which the contact is closed and does not slide.
    pub fn grow(&mut self, law: &Interface, t: f64) -> bool {
        let Some(growth) = law.growth() else { return false };
        let rests = self.slides() == 0.0 && self.apex().d > 0.0;
        let rest = self.rest_mut();
        let before = rest.stair;
        if !rests {
            *rest = Rest::NONE;
        } else if rest.since == f64::INFINITY {
            *rest = Rest { since: t, ..Rest::NONE };
        } else {
            let mut stair = growth.stair(t - rest.since).saturating_sub(1).max(before);
            // Exactly as in `next_growth`.
            while rest.since + growth.time(stair + 1) <= t {
                stair += 1;
            }
            if stair > before {
                *rest = Rest { stair, law: Some(Arc::new(law.on_stair(stair))), ..*rest };
            }
        }
        self.rest().stair != before
    }

    /// Sets the time at which the rest of a contact began, s.
    pub fn rest_since(&mut self, t: f64) {
        *self.rest_mut() = Rest { since: t, ..Rest::NONE };
    }

    /// Returns the time at which the static friction coefficient grows next, s; ∞ if it does not.
    pub fn next_growth(&self, law: &Interface) -> f64 {
        let Rest { since, stair, .. } = self.rest();
        law.growth().map_or(f64::INFINITY, |growth| since + growth.time(stair + 1))
    }

    /// Lets a sliding contact stick again: further slip obeys the static coefficient.
    pub fn hold(&mut self) {
        match self {
            Self::Curve(curve) => curve.hold(),
            Self::Row(SpringRow { row, .. }) => row.hold(),
        }
    }

    /// Breaks the contact loose in a direction and returns the released elastic energy, J.
    ///
    /// All springs fall to the kinetic limit. The contact must be at its static limit.
    pub fn break_loose(&mut self, kinetic: &Interface, sense: f64) -> f64 {
        *self.rest_mut() = Rest::NONE;
        match self {
            Self::Curve(curve) => curve.break_loose(kinetic, sense),
            Self::Row(SpringRow { row, springs }) => row.break_loose(springs, kinetic, sense),
        }
    }

    /// Returns the first leg of what is left of a straight path that began at `start`.
    fn leg(&self, [law, kinetic]: [&Interface; 2], start: Apex, to: Apex) -> Leg {
        let (from, sense) = (self.apex(), self.slides());
        if sense != 0.0 && (to == from || goes_on(kinetic, sense, [start, to])) {
            return Leg::Slides;
        }
        // A contact that touches on the way begins with unstretched springs.
        let (h, p, begin) = match self.lowest(law) {
            (h, Some(p)) => (h, p, from),
            (h, None) if to.d > h => {
                let u = from.u + (to.u - from.u) * ((h - from.d) / (to.d - from.d)).clamp(0.0, 1.0);
                (h, u, Apex { d: h, u })
            }
            (_, None) => return Leg::Holds,
        };
        let slope = self.law(law).stick_slope();
        let beyond = |sense: f64, at: Apex| sense * (at.u - p) - slope * (at.d - h);
        let share = |sense: f64| {
            let (before, after) = (beyond(sense, begin).min(0.0), beyond(sense, to));
            if after > 0.0 { before / (before - after) } else { f64::INFINITY }
        };
        let (forward, backward) = (share(1.0), share(-1.0));
        let (share, sense) = if forward <= backward { (forward, 1.0) } else { (backward, -1.0) };
        if share == f64::INFINITY {
            return Leg::Holds;
        }
        let at = |from: f64, to: f64| if share < 1.0 { from + share * (to - from) } else { to };
        Leg::Breaks(Apex { d: at(begin.d, to.d), u: at(begin.u, to.u) }, sense)
    }

    /// Returns the height of the lowest spring, m, and its rest position if it is in contact, m.
    fn lowest(&self, law: &Interface) -> (f64, Option<f64>) {
        match self {
            Self::Curve(curve) => {
                let lowest = law.profile().lowest();
                (lowest, curve.anchor(lowest))
            }
            Self::Row(SpringRow { row, springs }) => (springs.lowest(), row.lowest_anchor()),
        }
    }

    /// Commits a segment under one or two coefficients and returns its friction work, J.
    ///
    /// `one` commits a segment under one coefficient and returns its friction work.
    #[inline]
    pub(crate) fn commit_by(
        &mut self,
        law: &Interface,
        segment: Segment,
        one: impl Fn(&mut Self, &Interface, Segment) -> Result<f64, ContactError>,
    ) -> Result<f64, ContactError> {
        match (law.kinetic(), segment) {
            (None, _) => one(self, law, segment),
            // Growth in full stick: a sliding contact has stuck again.
            (Some(_), Segment::Grown { .. }) => self.commit_as(law, segment, one).inspect(|_| self.hold()),
            (Some(kinetic), path) => self.commit_breaking([law, kinetic], path.end(), one),
        }
    }

    /// Commits a segment under the present static coefficient.
    fn commit_as(
        &mut self,
        law: &Interface,
        segment: Segment,
        one: impl Fn(&mut Self, &Interface, Segment) -> Result<f64, ContactError>,
    ) -> Result<f64, ContactError> {
        match self.rest().law.clone() {
            Some(grown) => one(self, &grown, segment),
            None => one(self, law, segment),
        }
    }

    /// Commits a straight path under two coefficients and returns its friction work, J.
    fn commit_breaking(
        &mut self,
        [law, kinetic]: [&Interface; 2],
        to: Apex,
        one: impl Fn(&mut Self, &Interface, Segment) -> Result<f64, ContactError>,
    ) -> Result<f64, ContactError> {
        self.check(law, to)?;
        let (start, mut friction) = (self.apex(), 0.0);
        for _ in 0..MOST_BREAKS {
            match self.leg([law, kinetic], start, to) {
                Leg::Slides => return Ok(friction + one(self, kinetic, Segment::Straight(to))?),
                Leg::Holds => break,
                Leg::Breaks(at, sense) => {
                    self.hold();
                    friction += self.commit_as(law, Segment::Straight(at), &one)?;
                    friction += self.break_loose(kinetic, sense);
                }
            }
        }
        self.hold();
        Ok(friction + self.commit_as(law, Segment::Straight(to), &one)?)
    }

    /// Fails if a path cannot end at an apex.
    fn check(&self, law: &Interface, to: Apex) -> Result<(), ContactError> {
        if !(to.d.is_finite() && to.u.is_finite()) {
            return Err(ContactError::NotFinite { d: to.d, u: to.u });
        }
        law.profile().check_end(to.d)?;
        match self {
            Self::Row(SpringRow { springs, .. }) if to.d > springs.reach() => {
                Err(ContactError::Outgrown { d: to.d, reach: springs.reach() })
            }
            _ => Ok(()),
        }
    }

    /// Returns the response at the end of a straight path under two coefficients.
    ///
    /// `one` returns the response of a memory under one coefficient.
    #[inline(never)]
    pub(crate) fn trial_breaking(
        &self,
        [law, kinetic]: [&Interface; 2],
        to: Apex,
        one: impl Fn(&Self, &Interface) -> Response,
    ) -> Response {
        match self.leg([law, kinetic], self.apex(), to) {
            Leg::Slides => one(self, kinetic),
            Leg::Holds => one(self, self.law(law)),
            Leg::Breaks(at, sense) => {
                if at == to || goes_on(kinetic, sense, [self.apex(), to]) {
                    return self.gross(kinetic, sense, to.d);
                }
                // It sticks again on the way, where the load falls: rare enough for a copy.
                let mut after = self.clone();
                match after.commit(law, Segment::Straight(to)) {
                    Ok(_) => after.trial(law, Move::Chord(to)),
                    Err(_) => self.gross(kinetic, sense, to.d),
                }
            }
        }
    }

    /// Returns the response of a contact in gross slip at an indentation d (m).
    fn gross(&self, kinetic: &Interface, sense: f64, d: f64) -> Response {
        let limit = sense * kinetic.tangential_modulus() * kinetic.stick_slope();
        let [reduced_force, reduced_stiffness] = match self {
            _ if d <= 0.0 => [0.0; 2],
            Self::Curve(_) => kinetic.profile().reduced_force_and_stiffness(d),
            Self::Row(SpringRow { springs, .. }) => [springs.reduced_force(d), springs.reduced_stiffness(d)],
        };
        Response { force: limit * reduced_force, stiffness: 0.0, coupling: limit * reduced_stiffness }
    }

    /// Returns force, energies and state at the end of a straight path under two coefficients, including the friction work.
    ///
    /// `one` returns the same of a memory under one coefficient.
    #[inline(never)]
    pub(crate) fn preview_breaking(
        &self,
        [law, kinetic]: [&Interface; 2],
        to: Apex,
        one: impl Fn(&Self, &Interface) -> Outcome,
    ) -> Outcome {
        match self.leg([law, kinetic], self.apex(), to) {
            Leg::Slides => one(self, kinetic),
            Leg::Holds => one(self, self.law(law)),
            Leg::Breaks(..) => {
                let mut after = self.clone();
                let Ok(friction) = after.commit(law, Segment::Straight(to)) else {
                    return one(self, self.law(law));
                };
                Outcome { friction, ..after.preview(law, to) }
            }
        }
    }
}

/// Returns whether a contact that slides in a direction goes on sliding along a straight path.
///
/// The whole path tells the direction. Of what is left of it where a contact breaks loose, only rounding may remain.
fn goes_on(kinetic: &Interface, sense: f64, [start, to]: [Apex; 2]) -> bool {
    sense * (to.u - start.u) > kinetic.stick_slope() * (to.d - start.d)
}
