//! Friction work from the swept pieces: what lies between the old curve and the new one.
//!
//! Along a chord a spring at height h, once at its limit, is dragged by Δ(h) under a limit κ(d-h) that moves
//! linearly with it, so its work is G\*κ q dm with
//!
//! q = e Δ - ½ r Δ²,  e = max(d₁-h, 0),  r = dd/dL,  L = ±u - κd the level of the dragging edge,
//!
//! a parabola in h on every piece of the old curve. A spring that leaves the contact is dragged until it
//! leaves. Since q is continuous and vanishes at both ends, or at h = 0 where m does, ∫q dm = -∫q' m dh, and a
//! piece gives -[q'M] + q''ΔN: exact for every profile, a list of heights included.
//!
//! Booking limit force × slip instead would miss most of the loss where the limit falls inside the step: 64 % where half of
//! the indentation is taken back, and all of it where the contact opens.

use super::cut::{Edge, anchor};
use super::knot::Knot;
use crate::{Apex, Interface, Profile};

/// Which friction work is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Told {
    /// All.
    All,
    /// What is beside that which the power of a branch adds up to.
    BesidePower,
}

/// Friction work of a chord, J. `knots` is the old curve (at least one knot) and ends at `from`.
pub(super) fn work(law: &Interface, knots: &[Knot], from: Apex, to: Apex) -> f64 {
    let Some((sweep, edge, top)) = Sweep::of(law, knots, from, to) else { return 0.0 };
    let foot = edge.foot(law, knots, sweep.to);
    sweep.swept(knots, top, &edge, &foot) + sweep.beside(knots, &edge)
}

/// The part of [`work`] by which a path of growth differs from its chords, J.
pub(super) fn beside(law: &Interface, knots: &[Knot], from: Apex, to: Apex) -> f64 {
    let Some((sweep, edge, _)) = Sweep::of(law, knots, from, to) else { return 0.0 };
    sweep.beside(knots, &edge)
}

/// Friction work of a chord that stays inside contact, J, its edge and foot known.
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

/// One chord of the apex and the edge that drags at its end.
struct Sweep<'a> {
    law: &'a Interface,
    from: Apex,
    to: Apex,
    /// Δd, m.
    rise: f64,
    /// Δu, m.
    travel: f64,
    /// Of the edge that drags at the end.
    sense: f64,
    /// Its level at the end, m.
    level: f64,
    /// How much deeper the contact gets per way of that edge.
    curl: f64,
}

impl<'a> Sweep<'a> {
    /// Of a chord up to where the contact opens, with the edge that drags and the last of the knots; none where nothing slips.
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

    /// Work of everything that is swept, J. `top` is the last of the knots.
    // From the pieces swept and not from the change of energies: work done less energy gained is the same sum, but of a small
    // loop it is the difference of numbers a million times larger. One chord to 0.9 u_c has the work of a hundred thousand
    // short ones to 1e-14.
    fn swept(&self, knots: &[Knot], top: &Knot, edge: &Edge, foot: &Knot) -> f64 {
        let mut lower = if edge.is_gross() { &knots[0] } else { foot };
        // The dragging begins with 0 at the cut; in gross slip the centre is dragged as well.
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

    /// What is lost besides, J, where the edge gives up a path of growth: the curve keeps its chords, with the sums of the path.
    ///
    /// A piece of slope k and gain γ, with the energy ½G\*c(h-h₁) beside that of its gain, holds force and energy in balance if an edge
    /// of slope s = σκ whose front passes the height h loses G\*[c/2 + s(γ-k)(d-h)m(h)] per height besides.
    // Derived from F_x du = dE + dW along u = p(h) + s(d-h). Small, of third order in the length of a piece; without it what a cone lost
    // that was pressed and slid at once was 1e-6 of it off at a tolerance of 1e-9.
    // Apart from what every cut asks for: most give up no path of growth.
    #[inline(never)]
    fn beside(&self, knots: &[Knot], edge: &Edge) -> f64 {
        let first = edge.kept.max(1);
        let is_uneven = |k: &usize| knots[*k].is_uneven();
        let Some(last) = (first..knots.len()).rev().find(is_uneven) else { return 0.0 };
        let (slope, end) = (self.law.stick_slope(), edge.height.max(knots[0].h));
        let begin = self.sense * self.from.u - slope * self.from.d;
        // The front is at a height when the level of the edge is that of the old curve there.
        let depth =
            |level: f64| self.from.d + self.rise * ((level - begin) / (self.level - begin)).clamp(0.0, 1.0);
        let piece = |k: usize| {
            let (lower, upper) = (&knots[k - 1], &knots[k]);
            let energy = lower.beside(upper)[1] / (upper.h - lower.h);
            let lean = self.sense * slope * (upper.gain - upper.slope);
            // Pieces are short: one place stands for each.
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

    /// ∫q dm over one piece of the old curve, split where the edge of the contact ends up.
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

    /// How the dragging grows with height on the piece that ends in a knot.
    fn rate(&self, upper: &Knot) -> f64 {
        self.law.stick_slope() - self.sense * upper.slope
    }

    /// Springs that end on the edge of the wedge, dragged by `drag` at the lower end of the piece. The drag is
    /// carried upwards from the cut: taken from level and anchors it would not fit the heights to the last
    /// place of κd, and q would not close.
    fn staying(&self, lower: &Knot, upper: &Knot, drag: f64) -> f64 {
        let rate = self.rate(upper);
        let tilt = |h: f64, drag: f64| -drag + (self.to.d - h) * rate - self.curl * drag * rate;
        let beyond = drag + rate * (upper.h - lower.h);
        strip(self.law.profile(), lower, upper, tilt(lower.h, drag), tilt(upper.h, beyond))
    }

    /// Springs that leave the contact where the path crosses their height; on both sides of the old curve if
    /// the path of a shrinking contact crosses it.
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

    /// Springs that leave, all dragged in one sense: by `below` at the lower end of the piece, `beyond` at the upper one.
    fn leaving_one_way(&self, lower: &Knot, upper: &Knot, below: f64, beyond: f64, rate: f64) -> f64 {
        let sense = if below + beyond >= 0.0 { 1.0 } else { -1.0 };
        let curl = curl(self.law, [self.rise, self.travel], sense);
        strip(self.law.profile(), lower, upper, -curl * below * rate, -curl * beyond * rate)
    }
}

/// r = dd/dL for the edge of a sense, along a chord.
fn curl(law: &Interface, [rise, travel]: [f64; 2], sense: f64) -> f64 {
    let climb = sense * travel - law.stick_slope() * rise;
    if rise == 0.0 || climb <= 0.0 { 0.0 } else { rise / climb }
}

/// Strips thinner than this share of their height are summed over m itself.
const THIN: f64 = 1.0 / 16.0;

/// -∫q' m dh over a piece with q' linear between its values at the ends.
///
/// M and N are known to the last place of their value at the edge, which a thin strip does not forgive: a loop of
/// amplitude U would have a relative error of ε(u_c/U)³, an edge that leaves by a last place of d all of its work.
// Measured of a loop in a Hertzian contact, by differences alone: 1e-9 at U = 1e-2 u_c, 1e-6 at 1e-3, 6e-4 at 1e-4, 1.1 at 1e-5;
// as it stands 8e-14, 5e-13, 6e-12, 3e-11. Quadrature everywhere would end its exactness: below 1/2 in place of 1/16 the loop
// at 0.3 u_c is 1e-10 off instead of 1e-14.
fn strip(profile: &Profile, lower: &Knot, upper: &Knot, low: f64, high: f64) -> f64 {
    let width = upper.h - lower.h;
    if width < THIN * lower.h {
        return -profile.moment([lower.h, upper.h], [low, high]);
    }
    let curvature = (high - low) / width;
    curvature * (upper.reduced_energy - lower.reduced_energy)
        - (high * upper.reduced_force - low * lower.reduced_force)
}
