//! Static and kinetic friction: a contact breaks loose as a whole and sticks again as a whole.
//!
//! Partial slip obeys the static coefficient μ_s. When the last spring, the lowest one, reaches its limit, the limits of all springs
//! fall from κ_s(d-h) to κ_k(d-h) at once. The released elastic energy is friction work. The contact slides at μ_k while
//! σu̇ > κ_kḋ. Then it sticks again, and partial slip obeys μ_s from the stretches ±κ_k(d-h).
//!
//! Both engines share this logic. Along a straight path the limits of the lowest spring are linear, so that a path consists of legs
//! with one coefficient each.

use crate::{Apex, ContactError, Interface, Memory, Move, Outcome, Response, Segment, SpringRow};

/// First part of a straight path that obeys one coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Leg {
    /// The contact slides at μ_k along the whole path.
    Slides(f64),
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
        match self {
            Self::Curve(curve) => curve.break_loose(kinetic, sense),
            Self::Row(SpringRow { row, springs }) => row.break_loose(springs, kinetic, sense),
        }
    }

    /// Returns the first leg of a straight path.
    fn leg(&self, [law, kinetic]: [&Interface; 2], to: Apex) -> Leg {
        let (from, sense) = (self.apex(), self.slides());
        let goes = |sense: f64| sense * (to.u - from.u) > kinetic.stick_slope() * (to.d - from.d);
        if sense != 0.0 && (to == from || goes(sense)) {
            return Leg::Slides(sense);
        }
        // A contact that touches on the way begins with unstretched springs.
        let (h, p, begin) = match self.lowest() {
            (h, Some(p)) => (h, p, from),
            (h, None) if to.d > h => {
                let u = from.u + (to.u - from.u) * ((h - from.d) / (to.d - from.d)).clamp(0.0, 1.0);
                (h, u, Apex { d: h, u })
            }
            (_, None) => return Leg::Holds,
        };
        let beyond = |sense: f64, at: Apex| sense * (at.u - p) - law.stick_slope() * (at.d - h);
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
    fn lowest(&self) -> (f64, Option<f64>) {
        match self {
            Self::Curve(curve) => (0.0, curve.anchor(0.0)),
            Self::Row(SpringRow { row, springs }) => (springs.lowest(), row.lowest_anchor()),
        }
    }

    /// Commits a straight path under two coefficients and returns its friction work, J.
    ///
    /// `one` commits a segment under one coefficient and returns its friction work.
    pub(crate) fn commit_breaking(
        &mut self,
        [law, kinetic]: [&Interface; 2],
        to: Apex,
        one: impl Fn(&mut Self, &Interface, Segment) -> Result<f64, ContactError>,
    ) -> Result<f64, ContactError> {
        self.check(law, to)?;
        let mut friction = 0.0;
        for _ in 0..MOST_BREAKS {
            match self.leg([law, kinetic], to) {
                Leg::Slides(_) => return Ok(friction + one(self, kinetic, Segment::Straight(to))?),
                Leg::Holds => break,
                Leg::Breaks(at, sense) => {
                    self.hold();
                    friction += one(self, law, Segment::Straight(at))?;
                    friction += self.break_loose(kinetic, sense);
                }
            }
        }
        self.hold();
        Ok(friction + one(self, law, Segment::Straight(to))?)
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
        match self.leg([law, kinetic], to) {
            Leg::Slides(_) => one(self, kinetic),
            Leg::Holds => one(self, law),
            Leg::Breaks(at, sense) => {
                if at == to || sense * (to.u - at.u) > kinetic.stick_slope() * (to.d - at.d) {
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
        match self.leg([law, kinetic], to) {
            Leg::Slides(_) => one(self, kinetic),
            Leg::Holds => one(self, law),
            Leg::Breaks(..) => {
                let mut after = self.clone();
                let Ok(friction) = after.commit(law, Segment::Straight(to)) else { return one(self, law) };
                Outcome { friction, ..after.preview(law, to) }
            }
        }
    }
}
