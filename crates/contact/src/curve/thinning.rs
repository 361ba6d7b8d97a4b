//! A full stack: the knots that matter least go, a sixteenth of the stack at a time.
//!
//! Without a knot two pieces are one, and anchors change by a triangle between the knot and the chord of its neighbours. With
//! rises r₁, r₂ and swells ΔM₁, ΔM₂ of pieces of slopes k₁, k₂ the shear below a height changes by no more than
//!
//! T = ∫|δp| dm = |k₂-k₁| |r₂ΔM₁ - r₁ΔM₂| / (r₁+r₂),
//!
//! in m², now and after any later move: an anchor is clamped by every move, which never widens a difference. Sums of the knots
//! above follow, but where both pieces are of one path of growth: there they were integrated, and stay. Pieces of growth carry,
//! beside what their slopes give, what the path between their ends has added; what of that is shared out anew is booked, too.

use super::knot::Knot;
use super::stack::SlopeRange;
use super::{Curve, Merged};
use crate::{Apex, Interface};

/// Part of the stack that goes at once.
// One at a time looks through the whole stack for every knot that is laid down. With a sixteenth, of which at least half go
// where the least are all neighbours, a knot laid down costs two looks at no more than 32 others, however deep the stack.
const SHARE: usize = 16;
/// So many knots are found by looking for the least of all, more by counting classes.
const FEW: usize = 8;
/// Classes of triangles by their power of two: as many as a double has exponents.
// An order of all triangles would ask for room beside the stack, at a moment when nothing may be allocated.
const CLASSES: usize = 2048;

/// Which knots may still go: all of lower classes than one, and some of that.
struct Quota {
    class: usize,
    of_class: usize,
    left: usize,
}

/// Two pieces in a row, each knot on the one before.
struct Joint {
    base: Knot,
    middle: Knot,
    end: Knot,
}

impl Curve {
    /// Gives up a sixteenth of the knots, those whose triangles are least to within a factor of two, and books what each
    /// changes. Of two neighbours one stays until the next time.
    // Giving up the oldest instead books 0.32 of the limit force over a decay of 40 000 swings by a stack of 64, and this
    // 2.5e-5: the first swings are the largest, and the centre remembers them longest.
    pub(super) fn thin(&mut self, law: &Interface) {
        let mut quota = self.quota();
        let (count, apex) = (self.knots.len(), self.apex);
        let Some(&first) = self.knots.first() else { return };
        let mut merged = self.merged;
        // What a knot stood on, and how many have been kept: no more than have been looked at.
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

    /// What to give up.
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
    /// The same for a small stack, of which no more than [`FEW`] go.
    // Eight least of sixty by insertion take 700 instructions, the count of all classes 12 000: too long for a frame of real time.
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
    /// Whether a knot of a triangle goes; it then counts.
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
    /// The same knot on another base than the one it stood on: at its height, of other sums.
    fn moved(&self, from: &Self, to: &Self) -> Self {
        // To the last bit as it was, where nothing has changed below.
        if from.shear == to.shear && from.square == to.square {
            return *self;
        }
        let moved = to.extend(self.h, self.p, self.slope, self.gain, self.reduced_force, self.reduced_energy);
        Self { square: moved.square + from.beside(self)[1], joined: self.joined, ..moved }
    }

    /// What a piece of growth that starts here has beside what its slope gives: in shear, and in square beside its gain.
    pub(super) fn beside(&self, end: &Self) -> [f64; 2] {
        if !end.is_uneven() {
            return [0.0; 2];
        }
        let plain = self.extend(end.h, end.p, end.slope, end.gain, end.reduced_force, end.reduced_energy);
        [(end.gain - end.slope) * (end.reduced_force - self.reduced_force), end.square - plain.square]
    }
}

impl Joint {
    /// Both pieces as one, and what that changes booked.
    fn merge(&self, law: &Interface, apex: Apex, merged: &mut Merged) -> Knot {
        let Self { base, middle, end } = self;
        let (lower, upper) = (middle.h - base.h, end.h - middle.h);
        let inner = middle.reduced_force - base.reduced_force;
        let (outer, swell) =
            (end.reduced_force - middle.reduced_force, end.reduced_force - base.reduced_force);
        // From slopes and not from anchors: of a contact that has travelled far those have lost digits.
        let slope = (middle.slope * lower + end.slope * upper) / (lower + upper);
        let triangle = (end.slope - middle.slope) * (upper * inner - lower * outer) / (lower + upper);
        let ([first, energy], [second, more]) = (base.beside(middle), middle.beside(end));
        let beside = if middle.joined { first + second - triangle } else { first + second };
        let gain = if swell > 0.0 { slope + beside / swell } else { slope };
        let whole = base.extend(end.h, end.p, slope, gain, end.reduced_force, end.reduced_energy);
        let (shear, square) =
            if middle.joined { (end.shear, end.square) } else { (whole.shear, whole.square + energy + more) };

        // What the path has added goes with M now, over the whole of it.
        let shared = (gain - slope) * inner - first;
        let step = law.tangential_modulus() * (triangle.abs() + shared.abs());
        let stretch = [base, middle, end].map(|knot| (apex.u - knot.p).abs()).into_iter().fold(0.0, f64::max);
        merged.knots += 1;
        merged.force += step;
        merged.energy += step * stretch;
        Knot { shear, square, joined: end.joined, ..whole }
    }
}

/// Twice the area, m², by which the anchors change without the middle one of three knots.
fn triangle(a: &Knot, b: &Knot, c: &Knot) -> f64 {
    ((c.slope - b.slope) * (b.h - a.h) * (c.h - b.h)).abs()
}

/// Class of a triangle: the exponent of the double. Not negative, so that no sign stands above it.
fn class(triangle: f64) -> usize {
    ((triangle.to_bits() >> 52) as usize).min(CLASSES - 1)
}
