//! Smooth branch of the hysteresis, valid from one event to the next.
//!
//! A branch is valid while the limit line of direction σ crosses the same piece of the memory curve. The force of the branch is
//!
//! F_x = σG\*[S₁ + γ(M(h_c)-M₁) + κ(M(d)-M(h_c))],  h_c = h₁ + (ℓ₁-L)/(κ-σk),  L = σu - κd.
//!
//! The force continues smoothly beyond both ends of the piece. A time step may therefore cross the end of a branch and locate the
//! event afterwards. The event is a zero crossing of [`Branch::margin`] or of the sliding velocity.
//!
//! Symbols: direction σ; slope κ of the friction limit; slip front h_c; level L of the limit line. The piece has the slope k and the gain γ
//! (force per ΔM). The breakpoint below the piece has the height h₁, level ℓ₁ and sums S₁, M₁.

use super::{Curve, cut, knot::Knot};
use crate::words::{Words, push};
use crate::{Apex, Interface, Motion};

/// Branch of the hysteresis: a slip direction and the piece of the memory curve that the limit line crosses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// Slope κ of the friction limit.
    pub(super) slope: f64,
    /// Factor G\*σ; its sign is the direction σ.
    pub(super) factor: f64,
    pub(super) piece: Piece,
}

/// Piece of the memory curve that the limit line of a direction σ crosses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    /// Level ℓ₁ at which the piece ends; ∞ in gross slip.
    pub(super) level: f64,
    /// Level of the limit line at which the piece begins; -∞ for a single piece. At lower levels the limit line still crosses later pieces
    /// of the same growth path.
    entry: f64,
    /// Ratio -dh_c/dL = 1/(κ-σk).
    pub(super) flow: f64,
    /// Height h₁, m.
    pub(super) height: f64,
    /// Difference S₁ - γM₁, for direction σ.
    pub(super) offset: f64,
    /// Difference γ - κ, for direction σ.
    pub(super) excess: f64,
}

impl Piece {
    /// No piece: all of the contact slips.
    const GROSS: Self = Self {
        level: f64::INFINITY,
        entry: f64::NEG_INFINITY,
        flow: 0.0,
        height: 0.0,
        offset: 0.0,
        excess: 0.0,
    };

    fn shift(&mut self, by: f64) {
        self.level += by;
        self.entry += by;
    }

    fn write(&self, words: &mut Vec<u64>) {
        push(words, [self.level, self.entry, self.flow, self.height, self.offset, self.excess]);
    }

    fn read(words: &mut Words<'_>) -> Option<Self> {
        let [level, entry, flow, height, offset, excess] = [(); 6].map(|()| words.number());
        Some(Self {
            level: level?,
            entry: entry?,
            flow: flow?,
            height: height?,
            offset: offset?,
            excess: excess?,
        })
    }
}

impl Branch {
    /// Smallest positive height of a slip front, m. At this height the reduced stiffness m(h) is the width of the profile's flat, if any.
    pub const CENTRE: f64 = f64::MIN_POSITIVE;

    /// Returns whether the branch is gross slip.
    pub fn is_gross(&self) -> bool {
        self.piece.level == f64::INFINITY
    }

    /// Returns whether gross slip follows at the end of the branch.
    pub fn ends_in_gross_slip(&self, law: &Interface) -> bool {
        self.piece.height <= law.profile().lowest() && !self.is_gross()
    }

    /// Returns the height of the breakpoint below the piece, m.
    pub fn foot(&self) -> f64 {
        self.piece.height
    }

    /// Returns whether the branch is valid at (d, u).
    ///
    /// While the limit line still crosses later pieces of a growth path, the branch of its first piece is not valid.
    /// [`Curve::dragged`] then gives the force.
    #[inline]
    pub fn covers(&self, d: f64, u: f64) -> bool {
        self.sense() * u - self.slope * d >= self.piece.entry
    }

    /// Returns the tangential force F_x at (d, u), N. `reduced_force` is M(d), m².
    #[inline]
    pub fn force(&self, law: &Interface, d: f64, u: f64, reduced_force: f64) -> f64 {
        let front = if self.is_gross() {
            0.0
        } else {
            self.piece.excess * law.profile().reduced_force(self.front(d, u)) + self.piece.offset
        };
        self.factor * (front + self.slope * reduced_force)
    }

    /// Returns the height h_c of the slip front at (d, u), m. Beyond the ends of the piece the front continues linearly.
    #[inline]
    pub fn front(&self, d: f64, u: f64) -> f64 {
        self.piece.height + self.margin(d, u) * self.piece.flow
    }

    /// Returns ∂F_x/∂u and ∂F_x/∂d at (d, u), N/m.
    ///
    /// ∂F/∂u = G\*(κ-γ)/(κ-σk) m(h_c), which is G\*m(h_c) on a straight piece (γ = σk). ∂F/∂d = σκ[G\*m(d) - ∂F/∂u].
    pub fn tangents(&self, law: &Interface, d: f64, u: f64) -> [f64; 2] {
        let gain = -self.piece.excess * self.piece.flow;
        let stiffness =
            if self.is_gross() { 0.0 } else { gain * law.profile().reduced_stiffness(self.front(d, u)) };
        let modulus = law.tangential_modulus();
        let coupling = self.sense() * self.slope * (law.profile().reduced_stiffness(d) - stiffness);
        [modulus * stiffness, modulus * coupling]
    }

    /// Returns the distance that the limit line has moved since the last sticking spring began to slip, m.
    ///
    /// The value is negative while any spring sticks and -∞ in gross slip, which has no end.
    pub fn beyond(&self, law: &Interface, d: f64, u: f64) -> f64 {
        let below = || law.profile().lowest() - self.front(d, u);
        if self.is_gross() { f64::NEG_INFINITY } else { below() / self.piece.flow }
    }

    /// Returns the displacement u at which the branch has the force F_x (N) at indentation d; `None` in gross slip.
    ///
    /// `reduced_force` is M(d), m². For |F_x| above μF_N the branch is continued with the stiffness of the whole contact, so that
    /// every force has a solution.
    pub fn displacement(&self, law: &Interface, d: f64, force: f64, reduced_force: f64) -> Option<f64> {
        if self.is_gross() {
            return None;
        }
        let reduced =
            (force / self.factor - self.slope * reduced_force - self.piece.offset) / self.piece.excess;
        let profile = law.profile();
        let front = if reduced > 0.0 {
            profile.height_of_reduced_force(reduced)
        } else {
            profile.lowest() + reduced * (-self.piece.excess) / profile.reduced_stiffness(d) * self.piece.flow
        };
        let margin = (front - self.piece.height) / self.piece.flow;
        Some(self.sense() * (self.piece.level - margin + self.slope * d))
    }

    /// Returns the distance that the limit line can move until the end of the piece, m; ∞ in gross slip.
    #[inline]
    pub fn margin(&self, d: f64, u: f64) -> f64 {
        self.piece.level - (self.sense() * u - self.slope * d)
    }

    /// Writes the state of the branch as words.
    pub fn write(&self, words: &mut Vec<u64>) {
        words.push(u64::from(self.sense() > 0.0));
        self.piece.write(words);
    }

    /// Reads a branch that [`Self::write`] wrote, for a contact with this interface. Returns `None` for invalid words.
    pub fn read(law: &Interface, words: &mut Words<'_>) -> Option<Self> {
        let sense = if words.flag()? { 1.0 } else { -1.0 };
        let piece = Piece::read(words)?;
        let law = law.kinetic().filter(|_| piece.level == f64::INFINITY).unwrap_or(law);
        Some(Self { piece, ..Self::gross(law, sense) })
    }

    /// Returns the gross slip branch of a direction.
    fn gross(law: &Interface, sense: f64) -> Self {
        Self { slope: law.stick_slope(), factor: law.tangential_modulus() * sense, piece: Piece::GROSS }
    }

    /// Moves the origin of displacements: all displacements grow by `by` (m).
    pub fn shift(&mut self, by: f64) {
        self.piece.shift(self.sense() * by);
    }

    /// Returns the slip direction: +1 forward, -1 backward.
    #[inline(always)]
    pub fn sense(&self) -> f64 {
        1.0_f64.copysign(self.factor)
    }

    /// Returns the slope κ of its friction limit.
    #[inline]
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// Returns force, N, and friction power, W, of a moving apex. `reduced_force` is M(d), m².
    ///
    /// Both equal [`Branch::force`] and [`Branch::friction_power`], with one evaluation of the profile. The values continue smoothly beyond
    /// the ends of the branch, also for a front above d or below the centre.
    #[inline(always)]
    pub fn drag(&self, law: &Interface, at: &Motion, reduced_force: f64) -> [f64; 2] {
        let Motion { d, u, dd, du } = *at;
        let drive = law.tangential_modulus() * self.slope * (self.sense() * du - self.slope * dd);
        if self.is_gross() {
            return [self.factor * (self.slope * reduced_force), drive * reduced_force];
        }
        let (profile, front) = (law.profile(), self.front(d, u));
        let [inner, stuck] = if front > 0.0 {
            profile.reduced_force_and_stiffness(front)
        } else {
            let flat = profile.reduced_stiffness(Self::CENTRE);
            [flat * front, flat]
        };
        let force =
            self.factor * (self.piece.excess * inner + self.piece.offset + self.slope * reduced_force);
        [force, drive * (reduced_force - inner - (d - front) * stuck)]
    }

    /// Returns the friction power of the slipping springs, W. `front` is the height h_c of the slip front, m.
    ///
    /// The power is G\*κL̇∫(d-h)dm = G\*κL̇[M(d) - M(h_c) - (d-h_c)m(h_c)].
    pub fn friction_power(&self, law: &Interface, front: f64, at: &Motion) -> f64 {
        let Motion { d, dd, du, .. } = *at;
        let profile = law.profile();
        let front = if self.is_gross() { 0.0 } else { front.max(Self::CENTRE) };
        let limit = profile.reduced_force(d)
            - profile.reduced_force(front)
            - (d - front) * profile.reduced_stiffness(front);
        law.tangential_modulus() * self.slope * (self.sense() * du - self.slope * dd) * limit
    }
}

/// Branch of the memory curve that a damped contact reaches with its lead βu̇, ahead of the slip front.
///
/// It has the direction and the limit of the branch of the slip front, with which it is used.
// Kept small: laws are copied at every event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lead {
    piece: Piece,
    /// Level of the limit line at which the branch begins, m: -∞ where the slip front itself is on the branch, ∞ for a lead against the
    /// direction of slip, the largest number if there is none.
    floor: f64,
}

impl Lead {
    /// No branch: the slip memory gives the force.
    pub const NONE: Self = Self { piece: Piece::GROSS, floor: f64::MAX };

    fn branch(&self, front: &Branch) -> Branch {
        Branch { piece: self.piece, ..*front }
    }

    /// Returns whether there is a branch.
    #[inline]
    pub fn is_some(&self) -> bool {
        self.floor != f64::MAX
    }

    /// Returns whether the lead points against the direction of slip, as in a contact that shrinks while it is held back.
    #[inline]
    pub fn is_turned(&self) -> bool {
        self.floor == f64::INFINITY
    }

    /// Returns the force F_x (N) of a contact at (d, u) with a lead (m); `None` where no smooth form is valid.
    ///
    /// `front` is the branch of the slip front, with the force `elastic` (N). `reduced_force` returns M(d), m². The force continues
    /// smoothly where the lead or the slip front turns.
    #[inline]
    pub fn force(
        &self,
        law: &Interface,
        front: &Branch,
        ((d, u), lead): ((f64, f64), f64),
        (elastic, reduced_force): (f64, impl FnOnce() -> f64),
    ) -> Option<f64> {
        if !self.is_turned() {
            let branch = self.branch(front);
            let holds = self.is_some() && branch.covers(d, u + lead);
            return holds.then(|| branch.force(law, d, u + lead, reduced_force()));
        }
        // The lead turns back on the limit line.
        let least = if front.is_gross() { 0.0 } else { front.front(d, u).max(0.0) };
        let height = d + front.sense() * lead / (2.0 * front.slope);
        let turned = || reduced_force() - law.profile().reduced_force(height);
        let holds = front.covers(d, u) && height >= least;
        holds.then(|| elastic - 2.0 * front.factor * front.slope * turned())
    }

    /// Returns how far the lead may still grow and shrink until it leaves the branch, m; `u` includes the lead.
    #[inline]
    pub fn margins(&self, front: &Branch, d: f64, u: f64) -> [f64; 2] {
        if self.is_turned() || !self.is_some() {
            return [f64::INFINITY; 2];
        }
        [self.branch(front).margin(d, u), front.sense() * u - front.slope * d - self.floor]
    }

    pub(crate) fn shift(&mut self, by: f64) {
        if self.is_some() {
            self.piece.shift(by);
            self.floor += by;
        }
    }

    pub(crate) fn write(&self, words: &mut Vec<u64>) {
        self.piece.write(words);
        push(words, [self.floor]);
    }

    pub(crate) fn read(words: &mut Words<'_>) -> Option<Self> {
        Some(Self { piece: Piece::read(words)?, floor: words.number()? })
    }
}

/// Force and slip front at the end of a straight path.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dragged {
    /// Tangential force F_x, N.
    pub force: f64,
    /// Height of the slip front, m.
    pub front: f64,
}

impl Curve {
    /// Returns the branch of direction `sense` (+1 or -1) that starts at the committed apex.
    ///
    /// Breakpoints within `slack` (m) of the limit line count as reached, because the caller has just located the end of the piece there.
    // Without slack, rounding could find the same event repeatedly.
    pub fn branch(&self, law: &Interface, sense: f64, slack: f64) -> Branch {
        // A contact that has broken loose slides at its kinetic limit.
        if let Some(kinetic) = law.kinetic().filter(|_| self.slides == sense) {
            return Branch::gross(kinetic, sense);
        }
        self.crossed(law, sense, sense * self.apex.u - law.stick_slope() * self.apex.d + slack).0
    }

    /// Returns the branch of direction `sense` whose limit line has a level (m), and the index of the breakpoint above its crossing.
    fn crossed(&self, law: &Interface, sense: f64, level: f64) -> (Branch, usize) {
        let (slope, gross) = (law.stick_slope(), Branch::gross(law, sense));
        // A piece parallel to the limit line has no crossing and is shifted as a whole.
        let crosses = |w: &[Knot]| w[0].level(sense, slope) > level && !cut::runs_along(slope, sense, &w[1]);
        let Some(top) = self.knots.windows(2).rposition(crosses) else { return (gross, 0) };
        // The pieces of one growth path form one branch, which ends where the path began. The breakpoints between them come from time steps
        // and are no events.
        let foot = (0..=top).rev().find(|i| !self.knots[*i].joined).unwrap_or(0);
        // If the first piece is parallel to the limit line, only the last one is crossed.
        let mut foot = if cut::runs_along(slope, sense, &self.knots[foot + 1]) { top } else { foot };
        let (clipped, mut base);
        base = &self.knots[foot];
        // Gross slip begins where the lowest spring slips.
        let lowest = law.profile().lowest();
        if base.h < lowest {
            foot = self.above(lowest) - 1;
            if foot > top {
                return (gross, 0);
            }
            clipped = self.knots[foot].point(law, &self.knots[foot + 1], lowest);
            base = &clipped;
            if base.level(sense, slope) <= level {
                return (gross, 0);
            }
        }
        let end = &self.knots[foot + 1];
        let gain = sense * end.gain;
        let piece = Piece {
            level: base.level(sense, slope),
            entry: if foot < top { end.level(sense, slope) } else { f64::NEG_INFINITY },
            flow: 1.0 / (slope - sense * end.slope),
            height: base.h,
            offset: sense * base.shear - gain * base.reduced_force,
            excess: gain - slope,
        };
        (Branch { piece, ..gross }, top + 1)
    }

    /// Returns the branch that a damped contact reaches ahead of its slip front, where it slips along `branch`.
    ///
    /// `at` is the motion and `lead` is βu̇, m. The lead counts as longer by `slack` (m), which is negative where it has become shorter; lengths
    /// below `near` (m) count as zero.
    pub fn lead(
        &self,
        law: &Interface,
        branch: &Branch,
        at: &Motion,
        (lead, slack, near): (f64, f64, f64),
        turned: bool,
    ) -> Lead {
        let (sense, slope) = (branch.sense(), branch.slope);
        let level = sense * (at.u + lead) - slope * at.d + slack;
        let (Branch { piece, .. }, above) = self.crossed(law, sense, level);
        let same = (piece.level, piece.entry) == (branch.piece.level, branch.piece.entry);
        // A branch with an entry begins with its path; the memory gives the force on the later pieces.
        let is_path = piece.entry > f64::NEG_INFINITY;
        let later = self.knots.iter().skip(above).take_while(|knot| is_path && knot.joined).count();
        let lowest = law.profile().lowest();
        let begin = match self.knots.get(above + later) {
            _ if turned => return Lead { piece, floor: f64::INFINITY },
            // Gross slip begins where the lowest spring slips.
            Some(_) if !same && above == 0 && lowest > 0.0 => {
                sense * cut::anchor(&self.knots, lowest) - slope * lowest
            }
            Some(begin) if !same => begin.level(sense, slope),
            // The slip front itself is on this branch.
            _ => f64::NEG_INFINITY,
        };
        Lead { piece, floor: begin.min(level - near) }
    }

    /// Returns force and slip front at the end of a straight path, for the limit line of direction `sense`.
    ///
    /// The force continues smoothly where the direction is no longer valid: after a shrinking contact has crossed the curve, or after
    /// a reversal.
    pub fn dragged(&self, law: &Interface, sense: f64, to: Apex) -> Dragged {
        let (shear, front) = cut::onward(law, &self.knots, sense, to);
        Dragged { force: law.tangential_modulus() * shear, front }
    }
}
