//! One smooth branch of the hysteresis, frozen: what an event-aware stepper integrates between two events.
//!
//! While the edge of the wedge drags in one sense and cuts one and the same piece of the old curve,
//!
//! F_x = σG\*[S₁ + γ(M(h_c)-M₁) + κ(M(d)-M(h_c))],  h_c = h₁ + (ℓ₁-L)/(κ-σk),  L = σu - κd,
//!
//! with ℓ₁ the level of the knot below the piece. The force goes on smoothly beyond both ends of its piece, so a
//! step that oversteps an event meets no kink; the event is found afterwards, where [`Branch::margin`] or the
//! sense of sliding changes sign.
//!
//! Symbols: σ the sense, κ the slope of the stick limit, k and γ slope and gain of the piece, S₁ and M₁ the sums of the
//! knot below it, h₁ its height, L the level of the edge.

use super::{Curve, cut, knot::Knot};
use crate::words::{Words, push};
use crate::{Apex, Interface, Motion};

/// A frozen branch: a sense and the piece of the curve that it cuts.
// A force by it takes 4.4 ns where a trial takes 36, and has no knot to look for; 72 bytes, made once an event (10 ns).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// σ.
    pub(super) sense: f64,
    /// κ.
    pub(super) slope: f64,
    /// G\*σ.
    pub(super) factor: f64,
    /// ℓ₁, the level at which the piece ends; ∞ in gross slip.
    pub(super) level: f64,
    /// Level at which the piece begins, above it the edge still cuts later pieces of the same path of growth; -∞ for a
    /// piece on its own.
    entry: f64,
    /// 1/(κ-σk).
    pub(super) flow: f64,
    /// h₁, m.
    pub(super) height: f64,
    /// S₁ - γM₁ in the frame of the sense.
    pub(super) offset: f64,
    /// γ - κ in the frame of the sense.
    pub(super) excess: f64,
}

impl Branch {
    /// The lowest height of a slip front, m: m is there what a profile has of flat.
    pub const CENTRE: f64 = f64::MIN_POSITIVE;

    /// Whether every spring slips.
    pub fn is_gross(&self) -> bool {
        self.level == f64::INFINITY
    }

    /// Whether the last of the springs begin to slip where the piece ends: gross slip comes next.
    pub fn ends_in_the_centre(&self) -> bool {
        self.height == 0.0 && !self.is_gross()
    }

    /// Height of the knot below the piece that it cuts, m.
    pub fn foot(&self) -> f64 {
        self.height
    }

    /// Whether this branch holds at (d, u): not yet, where the edge still cuts later pieces of the path of
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

    /// ∂F_x/∂u and ∂F_x/∂d at (d, u), N/m.
    ///
    /// With the front at h_c: ∂F/∂u = G\*(κ-γ)/(κ-σk) m(h_c), which is G\*m(h_c) on a straight piece (γ = σk), and
    /// ∂F/∂d = σκ[G\*m(d) - ∂F/∂u].
    pub fn tangents(&self, law: &Interface, d: f64, u: f64) -> [f64; 2] {
        let gain = -self.excess * self.flow;
        let stiffness =
            if self.is_gross() { 0.0 } else { gain * law.profile().reduced_stiffness(self.front(d, u)) };
        let modulus = law.tangential_modulus();
        let coupling = self.sense * self.slope * (law.profile().reduced_stiffness(d) - stiffness);
        [modulus * stiffness, modulus * coupling]
    }

    /// How far beyond gross slip (d, u) lies, m: the way of the edge since the last spring stuck. Below zero while any does;
    /// -∞ in gross slip, which has no end.
    pub fn beyond(&self, d: f64, u: f64) -> f64 {
        if self.is_gross() { f64::NEG_INFINITY } else { -self.front(d, u) / self.flow }
    }

    /// u at which the branch gives the force F_x (N) at an indentation d, with M(d) at hand; none in gross slip. Beyond
    /// μF_N the front goes on below the centre as if the springs there had the stiffness of the whole contact, so that every
    /// force has its place.
    pub fn displacement(&self, law: &Interface, d: f64, force: f64, reduced_force: f64) -> Option<f64> {
        if self.is_gross() {
            return None;
        }
        let reduced = (force / self.factor - self.slope * reduced_force - self.offset) / self.excess;
        let profile = law.profile();
        let front = if reduced > 0.0 {
            profile.height_of_reduced_force(reduced)
        } else {
            reduced * (-self.excess) / profile.reduced_stiffness(d) * self.flow
        };
        let margin = (front - self.height) / self.flow;
        Some(self.sense * (self.level - margin + self.slope * d))
    }

    /// How far the edge may still move before the piece is used up, m; ∞ in gross slip.
    #[inline]
    pub fn margin(&self, d: f64, u: f64) -> f64 {
        self.level - (self.sense * u - self.slope * d)
    }

    /// Writes the state: what [`Self::read`] needs beside the interface.
    pub fn write(&self, words: &mut Vec<u64>) {
        words.push(u64::from(self.sense > 0.0));
        push(words, [self.level, self.entry, self.flow, self.height, self.offset, self.excess]);
    }

    /// Reads what [`Self::write`] wrote of a branch of a contact with this interface; none for words that it did not write.
    pub fn read(law: &Interface, words: &mut Words<'_>) -> Option<Self> {
        let sense = if words.flag()? { 1.0 } else { -1.0 };
        let [level, entry, flow, height, offset, excess] = [(); 6].map(|()| words.number());
        Some(Self {
            level: level?,
            entry: entry?,
            flow: flow?,
            height: height?,
            offset: offset?,
            excess: excess?,
            ..Self::gross(law, sense)
        })
    }

    /// The branch of a sense in gross slip.
    fn gross(law: &Interface, sense: f64) -> Self {
        Self {
            sense,
            slope: law.stick_slope(),
            factor: law.tangential_modulus() * sense,
            level: f64::INFINITY,
            entry: f64::NEG_INFINITY,
            flow: 0.0,
            height: 0.0,
            offset: 0.0,
            excess: 0.0,
        }
    }

    /// Counts displacements from another origin, `by` further back.
    pub fn shift(&mut self, by: f64) {
        self.level += self.sense * by;
        self.entry += self.sense * by;
    }

    /// +1 forward, -1 backward.
    pub fn sense(&self) -> f64 {
        self.sense
    }

    /// Force, N, friction power, W, and m at the slip front, m, of a moving apex with M(d) at hand, as [`Branch::force`] and
    /// [`Branch::friction_power`] have them: what they need of the profile is asked for once. m is the length that sticks, none
    /// in gross slip. A step that oversteps an event meets no kink: where the apex of a shrinking contact has crossed the old curve
    /// the front lies above d, and where the last of the springs have begun to slip below the centre, and m goes on as the force does.
    #[inline(always)]
    pub fn drag(&self, law: &Interface, at: &Motion, reduced_force: f64) -> [f64; 3] {
        let Motion { d, u, dd, du } = *at;
        let drive = law.tangential_modulus() * self.slope * (self.sense * du - self.slope * dd);
        if self.is_gross() {
            return [self.factor * (self.slope * reduced_force), drive * reduced_force, 0.0];
        }
        let (profile, front) = (law.profile(), self.front(d, u));
        let [inner, stuck] = if front > 0.0 {
            profile.reduced_force_and_stiffness(front)
        } else {
            let flat = profile.reduced_stiffness(Self::CENTRE);
            [flat * front, flat]
        };
        let force = self.factor * (self.excess * inner + self.offset + self.slope * reduced_force);
        [force, drive * (reduced_force - inner - (d - front) * stuck), stuck]
    }

    /// Friction power, W: G\*κL̇∫(d-h)dm over the springs at their limit, those higher than `front`,
    /// = G\*κL̇[M(d) - M(h_c) - (d-h_c)m(h_c)].
    pub fn friction_power(&self, law: &Interface, front: f64, at: &Motion) -> f64 {
        let Motion { d, dd, du, .. } = *at;
        let profile = law.profile();
        let front = if self.is_gross() { 0.0 } else { front.max(Self::CENTRE) };
        let limit = profile.reduced_force(d)
            - profile.reduced_force(front)
            - (d - front) * profile.reduced_stiffness(front);
        law.tangential_modulus() * self.slope * (self.sense * du - self.slope * dd) * limit
    }
}

/// What an edge gives at the end of a chord.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dragged {
    /// F_x, N.
    pub force: f64,
    /// Height of the slip front, m.
    pub front: f64,
}

impl Curve {
    /// The branch of a sense (+1 or -1) that starts at the committed apex. Knots within `slack` (m) of the
    /// edge count as reached: the caller has just located the end of the piece there.
    // Without slack rounding of that place decides, and the same event is found again and again.
    pub fn branch(&self, law: &Interface, sense: f64, slack: f64) -> Branch {
        let slope = law.stick_slope();
        let level = sense * self.apex.u - slope * self.apex.d + slack;
        let gross = Branch::gross(law, sense);
        // A piece along the edge itself has no crossing: the edge takes it whole.
        let crosses = |w: &[Knot]| w[0].level(sense, slope) > level && !cut::runs_along(slope, sense, &w[1]);
        let Some(top) = self.knots.windows(2).rposition(crosses) else { return gross };
        // The pieces of one path of growth are one: the branch ends where the path began. Its knots were put there by steps and
        // are no events: an impact would locate one for each step of its approach.
        let foot = (0..=top).rev().find(|i| !self.knots[*i].joined).unwrap_or(0);
        // Of one along the edge, but for rounding of its last piece, that piece is all that is crossed.
        let foot = if cut::runs_along(slope, sense, &self.knots[foot + 1]) { top } else { foot };
        let (base, end) = (&self.knots[foot], &self.knots[foot + 1]);
        let gain = sense * end.gain;
        Branch {
            level: base.level(sense, slope),
            entry: if foot < top { end.level(sense, slope) } else { f64::NEG_INFINITY },
            flow: 1.0 / (slope - sense * end.slope),
            height: base.h,
            offset: sense * base.shear - gain * base.reduced_force,
            excess: gain - slope,
            ..gross
        }
    }

    /// What a chord to an apex inside contact gives, dragged by the edge of a sense.
    ///
    /// As with a branch the force goes on smoothly where it no longer holds: where the apex of a shrinking contact lies on
    /// the other side of the old curve, and where the edge has turned back.
    pub fn dragged(&self, law: &Interface, sense: f64, to: Apex) -> Dragged {
        let (shear, front) = cut::onward(law, &self.knots, sense, to);
        Dragged { force: law.tangential_modulus() * shear, front }
    }
}
