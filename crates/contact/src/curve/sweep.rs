//! Friction work of a straight path, integrated over the shifted part of the memory curve.
//!
//! A spring at height h, once at its friction limit, slips by Δ(h) under a limit κ(d-h) that changes linearly along the path. The
//! work per length dm is G\*κ q with
//!
//! q = e Δ - ½ r Δ²,  e = max(d₁-h, 0),  r = dd/dL.
//!
//! Here L = ±u - κd is the level of the limit line. A spring that leaves the contact slips until it leaves. q is a parabola in h on
//! every piece of the old curve. q is continuous and 0 at both ends, or at h = 0, where m = 0. Hence ∫q dm = -∫q' m dh. A piece
//! contributes -[q'M] + q''ΔN, which is exact for every profile, including lists of springs.

use super::cut::{Edge, anchor};
use super::knot::Knot;
use crate::{Apex, Interface, Profile};

/// Part of the friction work to compute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Told {
    /// Total friction work.
    All,
    /// Only the part that [`super::Branch::friction_power`] does not contain.
    BesidePower,
}

/// Returns the friction work of a straight path, J. `knots` is the old curve with at least one breakpoint; it ends at `from`.
pub(super) fn work(law: &Interface, knots: &[Knot], from: Apex, to: Apex) -> f64 {
    let Some((sweep, edge, top)) = Sweep::of(law, knots, from, to) else { return 0.0 };
    let foot = edge.foot(law, knots, sweep.to);
    sweep.swept(knots, top, &edge, &foot) + sweep.beside(knots, &edge)
}

/// Returns the part of [`work`] that is due to the difference between growth paths and their chords, J.
pub(super) fn beside(law: &Interface, knots: &[Knot], from: Apex, to: Apex) -> f64 {
    let Some((sweep, edge, _)) = Sweep::of(law, knots, from, to) else { return 0.0 };
    sweep.beside(knots, &edge)
}

/// Returns the friction work of a straight path within contact, J, for a known limit line and its first breakpoint.
pub(super) fn slipped(
    law: &Interface,
    knots: &[Knot],
    [from, to]: [Apex; 2],
    (edge, foot): (&Edge, &Knot),
    told: Told,
) -> f64 {
    let Some(top) = knots.last() else { return 0.0 };
    let sweep = Sweep::new(law, [from, to], edge.sense);
    let beside = if knots[edge.kept.max(1).min(knots.len())..].iter().any(Knot::is_uneven) {
        sweep.beside(knots, edge)
    } else {
        0.0
    };
    if told == Told::BesidePower { beside } else { sweep.swept(knots, top, edge, foot) + beside }
}

/// Straight path of the apex and the limit line at its end.
struct Sweep<'a> {
    law: &'a Interface,
    from: Apex,
    to: Apex,
    /// Change Δd, m.
    rise: f64,
    /// Change Δu, m.
    travel: f64,
    /// Direction of the limit line.
    sense: f64,
    /// Level of the limit line at the end, m.
    level: f64,
    /// Ratio r = dd/dL of indentation change to slip distance.
    curl: f64,
}

impl<'a> Sweep<'a> {
    /// Returns the path up to the opening of the contact, the limit line and the last breakpoint; `None` if nothing slips.
    fn of<'k>(law: &'a Interface, knots: &'k [Knot], from: Apex, to: Apex) -> Option<(Self, Edge, &'k Knot)> {
        let (rise, travel) = (to.d - from.d, to.u - from.u);
        let slope = law.stick_slope();
        let sticks = rise >= 0.0 && travel.abs() <= slope * rise;
        let top = knots.last()?;
        if sticks || from.d <= 0.0 && to.d <= 0.0 {
            return None;
        }
        let to = if to.d > 0.0 { to } else { Apex { d: 0.0, u: from.u - from.d * travel / rise } };
        let (rise, travel) = (to.d - from.d, to.u - from.u);
        let forward = if travel.abs() >= -slope * rise { travel > 0.0 } else { to.u > anchor(knots, to.d) };
        let sense = if forward { 1.0 } else { -1.0 };
        Some((Self::new(law, [from, to], sense), Edge::find(law, knots, sense, to), top))
    }

    fn new(law: &'a Interface, [from, to]: [Apex; 2], sense: f64) -> Self {
        let level = sense * to.u - law.stick_slope() * to.d;
        let (rise, travel) = (to.d - from.d, to.u - from.u);
        Self { law, from, to, rise, travel, sense, level, curl: curl(law, [rise, travel], sense) }
    }

    /// Returns the friction work on the shifted part of the memory curve, J. `top` is the last breakpoint.
    // A direct integral avoids the cancellation of work and energy change in small loops.
    fn swept(&self, knots: &[Knot], top: &Knot, edge: &Edge, foot: &Knot) -> f64 {
        let mut lower = if edge.is_gross() { &knots[0] } else { foot };
        // The slip distance is 0 at the intersection. In gross slip the centre slips, too.
        let slope = self.law.stick_slope();
        let mut drag =
            if edge.is_gross() { self.level + slope * lower.h - self.sense * lower.p } else { 0.0 };
        let mut total = 0.0;
        for upper in &knots[edge.kept.max(1).min(knots.len())..] {
            total += self.piece(lower, upper, drag);
            drag += self.rate(upper) * (upper.h - lower.h);
            lower = upper;
        }
        if self.rise > 0.0 {
            total +=
                self.piece(top, &top.grow(self.law, self.to.d, self.travel / self.rise, self.to.u), drag);
        }
        self.law.tangential_modulus() * slope * total
    }

    /// Returns the friction work, J, due to the difference between erased growth paths and their chords.
    ///
    /// Consider a piece of slope k and gain γ with the additional energy ½G\*c(h-h₁). A limit line has the slope s = σκ. When its
    /// front passes the height h, it dissipates the additional work G\*[c/2 + s(γ-k)(d-h)m(h)] per height.
    // Follows from F_x du = dE + dW along u = p(h) + s(d-h). The work is of third order in the length of a piece.
    #[inline(never)]
    fn beside(&self, knots: &[Knot], edge: &Edge) -> f64 {
        let first = edge.kept.max(1);
        let is_uneven = |k: &usize| knots[*k].is_uneven();
        let Some(last) = (first..knots.len()).rev().find(is_uneven) else { return 0.0 };
        let (slope, end) = (self.law.stick_slope(), edge.height.max(knots[0].h));
        let begin = self.sense * self.from.u - slope * self.from.d;
        // The front reaches a height when the limit line has the level of the old curve there.
        let depth =
            |level: f64| self.from.d + self.rise * ((level - begin) / (self.level - begin)).clamp(0.0, 1.0);
        let piece = |k: usize| {
            let (lower, upper) = (&knots[k - 1], &knots[k]);
            let energy = lower.beside(upper)[1] / (upper.h - lower.h);
            let lean = self.sense * slope * (upper.gain - upper.slope);
            // Pieces are short, so the midpoint is sufficient.
            let low = lower.h.max(end);
            let middle = 0.5 * (low + upper.h);
            let level = upper.level(self.sense, slope) + self.rate(upper) * (upper.h - middle);
            let swell = match low > lower.h {
                true => self.law.profile().reduced_stiffness(middle) * (upper.h - low),
                false => upper.reduced_force - lower.reduced_force,
            };
            0.5 * energy * (upper.h - low) + lean * (depth(level) - middle).max(0.0) * swell
        };
        self.law.tangential_modulus() * (first..=last).filter(is_uneven).map(piece).sum::<f64>()
    }

    /// Returns ∫q dm over one piece of the old curve, split at the new edge of the contact.
    fn piece(&self, lower: &Knot, upper: &Knot, drag: f64) -> f64 {
        if upper.h <= lower.h {
            return 0.0;
        }
        let edge = self.to.d;
        if upper.h <= edge {
            return self.staying(lower, upper, drag);
        }
        if lower.h >= edge {
            return self.leaving(lower, upper);
        }
        let middle = lower.point(self.law, upper, edge);
        self.staying(lower, &middle, drag) + self.leaving(&middle, upper)
    }

    /// Returns the derivative of the slip distance with respect to height, on the piece that ends in a breakpoint.
    fn rate(&self, upper: &Knot) -> f64 {
        self.law.stick_slope() - self.sense * upper.slope
    }

    /// Returns the work of springs that stay in contact. `drag` is the slip distance at the lower end of the piece.
    ///
    /// The slip distance is accumulated from the intersection upwards, to avoid the rounding of levels and rest positions.
    fn staying(&self, lower: &Knot, upper: &Knot, drag: f64) -> f64 {
        let rate = self.rate(upper);
        let tilt = |h: f64, drag: f64| -drag + (self.to.d - h) * rate - self.curl * drag * rate;
        let beyond = drag + rate * (upper.h - lower.h);
        strip(self.law.profile(), lower, upper, tilt(lower.h, drag), tilt(upper.h, beyond))
    }

    /// Returns the work of springs that leave the contact. The path of a shrinking contact may cross the old curve.
    fn leaving(&self, lower: &Knot, upper: &Knot) -> f64 {
        let path = self.travel / self.rise;
        let drag = |k: &Knot| self.from.u + (k.h - self.from.d) * path - k.p;
        let (below, beyond) = (drag(lower), drag(upper));
        let rate = path - upper.slope;
        if below * beyond < 0.0 {
            let h = lower.h - below / rate;
            if h > lower.h && h < upper.h {
                let middle = lower.point(self.law, upper, h);
                return self.leaving_one_way(lower, &middle, below, 0.0, rate)
                    + self.leaving_one_way(&middle, upper, 0.0, beyond, rate);
            }
        }
        self.leaving_one_way(lower, upper, below, beyond, rate)
    }

    /// Returns the work of leaving springs that slip in one direction, by `below` at the lower and `beyond` at the upper end of the piece.
    fn leaving_one_way(&self, lower: &Knot, upper: &Knot, below: f64, beyond: f64, rate: f64) -> f64 {
        let sense = if below + beyond >= 0.0 { 1.0 } else { -1.0 };
        let curl = curl(self.law, [self.rise, self.travel], sense);
        strip(self.law.profile(), lower, upper, -curl * below * rate, -curl * beyond * rate)
    }
}

/// Returns r = dd/dL for the limit line of a direction, along a straight path.
fn curl(law: &Interface, [rise, travel]: [f64; 2], sense: f64) -> f64 {
    let climb = sense * travel - law.stick_slope() * rise;
    if rise == 0.0 || climb <= 0.0 { 0.0 } else { rise / climb }
}

/// Width relative to height below which a strip is integrated over m instead of differences of M and N.
const THIN: f64 = 1.0 / 16.0;

/// Returns -∫q' m dh over a piece, with q' linear between its values at the ends.
///
/// Differences of M and N lose accuracy on a thin strip: a loop of amplitude U would have a relative error of ε(u_c/U)³.
fn strip(profile: &Profile, lower: &Knot, upper: &Knot, low: f64, high: f64) -> f64 {
    let width = upper.h - lower.h;
    if width < THIN * lower.h {
        return -profile.moment([lower.h, upper.h], [low, high]);
    }
    let curvature = (high - low) / width;
    curvature * (upper.reduced_energy - lower.reduced_energy)
        - (high * upper.reduced_force - low * lower.reduced_force)
}
