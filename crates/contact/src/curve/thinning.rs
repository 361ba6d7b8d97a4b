//! Reduction of a full stack: a sixteenth of the breakpoints is removed at once, those with the smallest effect.
//!
//! Removing a breakpoint merges two pieces. The rest positions change by the triangle between the breakpoint and the chord of its
//! neighbours. Let the pieces have the rises r₁, r₂, increments ΔM₁, ΔM₂ and slopes k₁, k₂. The shear integral changes by at most
//!
//! T = ∫|δp| dm = |k₂-k₁| |r₂ΔM₁ - r₁ΔM₂| / (r₁+r₂), in m².
//!
//! The bound holds after any later move, because a move never enlarges a difference of rest positions. The integrals of the breakpoints
//! above change accordingly. If both pieces belong to one growth path, the integrals were computed along the path and remain. The
//! redistributed difference between path and chord is recorded as an error, too.

use super::knot::Knot;
use super::stack::SlopeRange;
use super::{Curve, Merged};
use crate::{Apex, Interface};

/// Fraction of the stack that is removed at once: one in 16 breakpoints.
// Removing several breakpoints at once keeps the cost per added breakpoint constant for any size of the stack.
const SHARE: usize = 16;
/// Largest number of breakpoints that is selected by insertion; a larger number is selected by a histogram of classes.
const FEW: usize = 8;
/// Number of classes of triangles: one per exponent of a double.
// A sort would have to allocate memory.
const CLASSES: usize = 2048;

/// Limit of the number of breakpoints to remove: all breakpoints of classes below `class`, and `of_class` breakpoints of the class `class`.
struct Quota {
    class: usize,
    of_class: usize,
    left: usize,
}

/// Two consecutive pieces.
struct Joint {
    base: Knot,
    middle: Knot,
    end: Knot,
}

impl Curve {
    /// Removes a sixteenth of the breakpoints, those with the smallest triangles to within a factor of two, and records the error.
    ///
    /// Of two neighbouring breakpoints only one is removed at a time.
    // Removing the oldest breakpoints instead would cause a much larger error, because they belong to the largest amplitudes.
    pub(super) fn thin(&mut self, law: &Interface) {
        let mut quota = self.quota();
        let (count, apex) = (self.knots.len(), self.apex);
        let Some(&first) = self.knots.first() else { return };
        let mut merged = self.merged;
        // `below` is the old breakpoint below breakpoint `i`, and `kept` the number of breakpoints kept so far.
        let (mut below, mut kept, mut i) = (first, 1, 1);
        while i < count {
            let (base, old) = (self.knots[kept - 1], self.knots[i]);
            let mut knot = old.moved(&below, &base);
            below = old;
            if i + 1 < count && quota.takes(triangle(&base, &old, &self.knots[i + 1])) {
                i += 1;
                let end = self.knots[i];
                let joint = Joint { base, middle: knot, end: end.moved(&old, &knot) };
                knot = joint.merge(law, apex, &mut merged);
                below = end;
                if i + 1 == count {
                    self.range = SlopeRange::NONE;
                }
            }
            self.knots[kept] = knot;
            kept += 1;
            i += 1;
        }
        self.knots.truncate(kept);
        self.merged = merged;
    }

    /// Determines which breakpoints to remove.
    fn quota(&self) -> Quota {
        let left = (self.capacity / SHARE).max(1);
        if left <= FEW {
            return self.quota_of_few(left);
        }
        let mut classes = [0_usize; CLASSES];
        for w in self.knots.windows(3) {
            classes[class(triangle(&w[0], &w[1], &w[2]))] += 1;
        }
        let mut of_class = left;
        for (class, members) in classes.into_iter().enumerate() {
            if members >= of_class {
                return Quota { class, of_class, left };
            }
            of_class -= members;
        }
        Quota { class: CLASSES, of_class, left }
    }
}

impl Curve {
    /// Determines which breakpoints to remove from a small stack, at most [`FEW`].
    // Insertion is faster than the histogram here.
    fn quota_of_few(&self, left: usize) -> Quota {
        let mut least = [CLASSES; FEW];
        let least = &mut least[..left];
        for w in self.knots.windows(3) {
            let mut class = class(triangle(&w[0], &w[1], &w[2]));
            for place in &mut *least {
                if class < *place {
                    std::mem::swap(place, &mut class);
                }
            }
        }
        let class = least[left - 1];
        let of_class = least.iter().filter(|other| **other == class).count();
        Quota { class, of_class, left }
    }
}

impl Quota {
    /// Returns whether a breakpoint with an error triangle of this area is removed, and counts it if so.
    fn takes(&mut self, triangle: f64) -> bool {
        let class = class(triangle);
        let goes = self.left > 0 && (class < self.class || class == self.class && self.of_class > 0);
        if goes {
            self.left -= 1;
            self.of_class -= usize::from(class == self.class);
        }
        goes
    }
}

impl Knot {
    /// Returns the breakpoint with integrals updated for a changed breakpoint below. The height remains.
    fn moved(&self, from: &Self, to: &Self) -> Self {
        // If nothing has changed below, the breakpoint stays identical to the last bit.
        if from.shear == to.shear && from.square == to.square {
            return *self;
        }
        let moved = to.extend(self.h, self.p, self.slope, self.gain, self.reduced_force, self.reduced_energy);
        Self { square: moved.square + from.beside(self)[1], joined: self.joined, ..moved }
    }

    /// Returns the difference between a growth path and its chord: in the shear integral and in the energy integral.
    pub(super) fn beside(&self, end: &Self) -> [f64; 2] {
        if !end.is_uneven() {
            return [0.0; 2];
        }
        let plain = self.extend(end.h, end.p, end.slope, end.gain, end.reduced_force, end.reduced_energy);
        [(end.gain - end.slope) * (end.reduced_force - self.reduced_force), end.square - plain.square]
    }
}

impl Joint {
    /// Merges both pieces and records the error.
    fn merge(&self, law: &Interface, apex: Apex, merged: &mut Merged) -> Knot {
        let Self { base, middle, end } = self;
        let (lower, upper) = (middle.h - base.h, end.h - middle.h);
        let inner = middle.reduced_force - base.reduced_force;
        let (outer, swell) =
            (end.reduced_force - middle.reduced_force, end.reduced_force - base.reduced_force);
        // Slopes are used because rest positions lose digits after a long displacement.
        let slope = (middle.slope * lower + end.slope * upper) / (lower + upper);
        let triangle = (end.slope - middle.slope) * (upper * inner - lower * outer) / (lower + upper);
        let ([first, energy], [second, more]) = (base.beside(middle), middle.beside(end));
        let beside = if middle.joined { first + second - triangle } else { first + second };
        let gain = if swell > 0.0 { slope + beside / swell } else { slope };
        let whole = base.extend(end.h, end.p, slope, gain, end.reduced_force, end.reduced_energy);
        let (shear, square) =
            if middle.joined { (end.shear, end.square) } else { (whole.shear, whole.square + energy + more) };

        // The difference between path and chord is now distributed in proportion to M over both pieces.
        let shared = (gain - slope) * inner - first;
        let step = law.tangential_modulus() * (triangle.abs() + shared.abs());
        let stretch = [base, middle, end].map(|knot| (apex.u - knot.p).abs()).into_iter().fold(0.0, f64::max);
        merged.knots += 1;
        merged.force += step;
        merged.energy += step * stretch;
        Knot { shear, square, joined: end.joined, ..whole }
    }
}

/// Returns twice the area, m², by which the rest positions change if the middle one of three breakpoints is removed.
fn triangle(a: &Knot, b: &Knot, c: &Knot) -> f64 {
    ((c.slope - b.slope) * (b.h - a.h) * (c.h - b.h)).abs()
}

/// Returns the class of a triangle: the exponent of the double, which is not negative.
fn class(triangle: f64) -> usize {
    ((triangle.to_bits() >> 52) as usize).min(CLASSES - 1)
}
