//! One smooth branch of the hysteresis, frozen: what an event-aware stepper integrates between two events.
//!
//! While the edge of the wedge drags in one sense and cuts one and the same piece of the old curve,
//!
//! F_x = σG\*[S₁ + γ(M(h_c)-M₁) + κ(M(d)-M(h_c))],  h_c = h₁ + (ℓ₁-L)/(κ-σk),  L = σu - κd,
//!
//! with ℓ₁ the level of the knot below the piece. The law goes on smoothly beyond both ends of its piece, so a
//! step that oversteps an event meets no kink; the event is found afterwards, where [`Branch::margin`] or the
//! sense of sliding changes sign.

use super::{Curve, cut, knot::Knot};
use crate::{Apex, Interface, Profile};

/// What a contact is doing, from the signs of s₊ = u̇-κḋ and s₋ = u̇+κḋ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Course {
    /// No contact.
    #[default]
    Open,
    /// The contact grows in full stick: s₊ ≤ 0 ≤ s₋; its force depends on the path and is a state.
    Grow,
    /// The lower edge of the wedge drags: s₊ > 0.
    Forward,
    /// The upper edge of the wedge drags: s₋ < 0.
    Backward,
}

impl Course {
    /// +1 forward, -1 backward, 0 otherwise.
    pub fn sense(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
            Self::Open | Self::Grow => 0.0,
        }
    }
}

/// A frozen branch: a sense and the piece of the curve that it cuts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    sense: f64,
    slope: f64,
    /// G\*σ.
    factor: f64,
    /// ℓ₁, the level at which the piece ends; ∞ in gross slip.
    level: f64,
    /// Level at which the piece begins, above it the edge still cuts later pieces of the same path of growth; -∞ for a
    /// piece on its own.
    entry: f64,
    /// 1/(κ-σk).
    flow: f64,
    height: f64,
    /// S₁ - γM₁ in the frame of the sense.
    offset: f64,
    /// γ - κ in the frame of the sense.
    excess: f64,
}

impl Branch {
    /// Whether every spring slips.
    pub fn is_gross(&self) -> bool {
        self.level == f64::INFINITY
    }

    /// Whether the last of the springs begin to slip where the piece ends: gross slip comes next.
    pub fn ends_in_the_centre(&self) -> bool {
        self.height == 0.0 && !self.is_gross()
    }

    /// Whether the law of this branch holds at (d, u): not yet, where the edge still cuts later pieces of the path of
    /// growth at whose foot the branch lies. Those are for [`Curve::dragged`] to find.
    #[inline]
    pub fn covers(&self, d: f64, u: f64) -> bool {
        self.sense * u - self.slope * d >= self.entry
    }

    /// F_x at (d, u), N, with M(d) at hand.
    #[inline]
    pub fn force(&self, law: &Interface, d: f64, u: f64, reduced_force: f64) -> f64 {
        let front = if self.is_gross() {
            0.0
        } else {
            self.excess * law.profile().reduced_force(self.front(d, u)) + self.offset
        };
        self.factor * (front + self.slope * reduced_force)
    }

    /// Height h_c of the slip front at (d, u), m; beyond its piece the branch goes on straight.
    #[inline]
    pub fn front(&self, d: f64, u: f64) -> f64 {
        self.height + self.margin(d, u) * self.flow
    }

    /// How far the edge may still move before the piece is used up, m; ∞ in gross slip.
    #[inline]
    pub fn margin(&self, d: f64, u: f64) -> f64 {
        self.level - (self.sense * u - self.slope * d)
    }
}

/// A branch at constant indentation: F_x = F₀ + G\*σ(γ-κ) M(h_c), a function of u alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyBranch {
    sense: f64,
    /// Level of the knot below the piece, over that of the apex at u = 0, m.
    level: f64,
    flow: f64,
    height: f64,
    /// Force with the slip front in the centre, N.
    base: f64,
    /// G\*σ(γ-κ); 0 in gross slip.
    gain: f64,
}

impl SteadyBranch {
    /// The slip front as a straight function of u, h_c = h₀ + su: (h₀ in m, s).
    pub fn front(&self) -> (f64, f64) {
        (self.height + self.level * self.flow, -self.sense * self.flow)
    }

    /// The force as a straight function of M at the slip front, F = F₀ + gM: (F₀ in N, g in N/m²), g = 0 in gross slip.
    pub fn forces(&self) -> (f64, f64) {
        (self.base, self.gain)
    }

    /// +1 forward, -1 backward.
    #[inline(always)]
    pub fn sense(&self) -> f64 {
        self.sense
    }

    /// Whether every spring slips.
    #[inline(always)]
    pub fn is_gross(&self) -> bool {
        self.gain == 0.0
    }

    /// How far the edge may still move at u before the piece is used up, m; 0 - σu in gross slip, where no piece ends.
    #[inline(always)]
    pub fn margin(&self, u: f64) -> f64 {
        self.level - self.sense * u
    }

    /// F_x at u, N.
    #[inline(always)]
    pub fn force(&self, profile: &Profile, u: f64) -> f64 {
        let front = self.height + self.margin(u) * self.flow;
        self.base + self.gain * profile.reduced_force(front)
    }
}

impl Branch {
    /// The branch at a constant indentation d (m), with M(d) at hand.
    pub fn steady(&self, d: f64, reduced_force: f64) -> SteadyBranch {
        let limit = self.slope * reduced_force;
        if self.is_gross() {
            let base = self.factor * limit;
            return SteadyBranch { sense: self.sense, level: 0.0, flow: 0.0, height: 0.0, base, gain: 0.0 };
        }
        SteadyBranch {
            sense: self.sense,
            level: self.level + self.slope * d,
            flow: self.flow,
            height: self.height,
            base: self.factor * (self.offset + limit),
            gain: self.factor * self.excess,
        }
    }

    /// Counts displacements from another place, `by` further on.
    pub fn shift(&mut self, by: f64) {
        self.level += self.sense * by;
        self.entry += self.sense * by;
    }

    /// +1 forward, -1 backward.
    pub fn sense(&self) -> f64 {
        self.sense
    }

    /// Force, N, and friction power, W, of a moving apex with M(d) at hand, as [`Branch::force`] and
    /// [`Branch::friction_power`] have them: what both need of the profile is asked for once.
    #[inline]
    pub fn drag(
        &self,
        law: &Interface,
        (d, dd): (f64, f64),
        (u, du): (f64, f64),
        reduced_force: f64,
    ) -> [f64; 2] {
        let drive = law.tangential_modulus() * self.slope * (self.sense * du - self.slope * dd);
        if self.is_gross() {
            return [self.factor * (self.slope * reduced_force), drive * reduced_force];
        }
        let (profile, front) = (law.profile(), self.front(d, u));
        let inner = profile.reduced_force(front);
        let force = self.factor * (self.excess * inner + self.offset + self.slope * reduced_force);
        if front >= 0.0 && front <= d {
            return [force, drive * (reduced_force - inner - (d - front) * profile.reduced_stiffness(front))];
        }
        [force, self.friction_power(law, front, (d, dd), du)]
    }

    /// Friction power, W: G\*κL̇∫(d-h)dm over the springs at their limit, those higher than `front`,
    /// = G\*κL̇[M(d) - M(h_c) - (d-h_c)m(h_c)].
    pub fn friction_power(&self, law: &Interface, front: f64, (d, dd): (f64, f64), du: f64) -> f64 {
        let profile = law.profile();
        let front = if self.is_gross() { 0.0 } else { front.clamp(0.0, d.max(0.0)) };
        let limit = profile.reduced_force(d)
            - profile.reduced_force(front)
            - (d - front) * profile.reduced_stiffness(front);
        law.tangential_modulus() * self.slope * (self.sense * du - self.slope * dd) * limit
    }
}

impl Curve {
    /// The course of a contact in motion, from the signs of s₊ = u̇-κḋ and s₋ = u̇+κḋ. Where both edges close in
    /// on a shrinking contact, the side decides on which the path leaves the curve.
    pub fn course(&self, law: &Interface, dd: f64, du: f64) -> Course {
        let limit = law.stick_slope() * dd;
        if self.apex.d < 0.0 || self.apex.d == 0.0 && dd <= 0.0 {
            Course::Open
        } else if dd > 0.0 && du.abs() <= limit {
            Course::Grow
        } else if du.abs() > -limit {
            if du > 0.0 { Course::Forward } else { Course::Backward }
        } else {
            let slope = self.knots.last().map_or(0.0, |k| k.slope);
            if du > slope * dd { Course::Forward } else { Course::Backward }
        }
    }

    /// The branch of a sense (+1 or -1) that starts at the committed apex. Knots within `slack` (m) of the
    /// edge count as reached: the caller has just located the end of the piece there.
    pub fn branch(&self, law: &Interface, sense: f64, slack: f64) -> Branch {
        let slope = law.stick_slope();
        let factor = law.tangential_modulus() * sense;
        let reach = |k: &Knot| sense * k.p - slope * k.h;
        let level = sense * self.apex.u - slope * self.apex.d + slack;
        let gross = Branch {
            sense,
            slope,
            factor,
            level: f64::INFINITY,
            entry: f64::NEG_INFINITY,
            flow: 0.0,
            height: 0.0,
            offset: 0.0,
            excess: 0.0,
        };
        // A piece along the edge itself has no crossing: the edge takes it whole.
        let crosses = |w: &[Knot]| reach(&w[0]) > level && !cut::runs_along(slope, sense, &w[1]);
        let Some(top) = self.knots.windows(2).rposition(crosses) else { return gross };
        // The pieces of one path of growth are one: the branch ends where the path began.
        let foot = (0..=top).rev().find(|i| !self.knots[*i].joined).unwrap_or(0);
        let (base, end) = (&self.knots[foot], &self.knots[foot + 1]);
        let gain = sense * end.gain;
        Branch {
            level: reach(base),
            entry: if foot < top { reach(end) } else { f64::NEG_INFINITY },
            flow: 1.0 / (slope - sense * end.slope),
            height: base.h,
            offset: sense * base.shear - gain * base.reduced_force,
            excess: gain - slope,
            ..gross
        }
    }

    /// F_x (N) and height of the slip front (m) of a chord to an apex inside contact, dragged by the edge of a sense.
    ///
    /// As with a branch the law goes on smoothly where it no longer holds: where the apex of a shrinking contact lies on
    /// the other side of the old curve, and where the edge has turned back.
    pub fn dragged(&self, law: &Interface, sense: f64, to: Apex) -> (f64, f64) {
        let (shear, front) = cut::onward(law, &self.knots, sense, to);
        (law.tangential_modulus() * shear, front)
    }
}
