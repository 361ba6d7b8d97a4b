//! Displacements between bodies as linear forms of the coordinates: the constant Jacobian of the model.

use super::{Binding, Body};
use crate::scene::{Direction, Point, Side};
use arrayvec::ArrayVec;

/// Terms of a linear form: index and coefficient. Two bodies, each with one axis and the pitch, give at most four terms.
pub(crate) type Terms = ArrayVec<(usize, f64), 4>;

/// Displacement between bodies as a linear form: constant + Σ coefficient · coordinate. The coefficients are a row of the Jacobian, which
/// also distributes a force along the displacement to the coordinates.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Measure {
    /// Constant, m.
    pub(crate) constant: f64,
    /// Indices of free coordinates with their coefficients, 1 or m/rad.
    pub(crate) free: Terms,
    /// Indices of prescribed signals with their coefficients.
    pub(crate) driven: Terms,
}

impl Measure {
    /// Returns the displacement of `ends[0]` minus that of `ends[1]`, each a point of a body or the ground. For small rotations a point at
    /// (X, Z) moves by x - Zθ along x and by z + Xθ along z.
    pub(super) fn between(ends: [(Side, Point); 2], direction: Direction, bodies: &[Body]) -> Self {
        let mut measure = Self::default();
        for ((side, point), sign) in ends.into_iter().zip([1.0, -1.0]) {
            let Side::Body(body) = side else { continue };
            let [x, z, pitch] = bodies[body].bindings;
            let (along, arm) = match direction {
                Direction::X => (x, -point.z),
                Direction::Z => (z, point.x),
            };
            measure.add(along, sign);
            measure.add(pitch, sign * arm);
        }
        measure
    }

    /// Adds a multiple of a coordinate. A fixed coordinate adds to the constant; coefficients of the same coordinate are summed.
    fn add(&mut self, place: Binding, coefficient: f64) {
        if coefficient == 0.0 {
            return;
        }
        let (terms, at) = match place {
            Binding::Held(position) => {
                self.constant += coefficient * position;
                return;
            }
            Binding::Free(i) => (&mut self.free, i),
            Binding::Driven(w) => (&mut self.driven, w),
        };
        match terms.iter_mut().find(|(known, _)| *known == at) {
            Some((_, sum)) => *sum += coefficient,
            None => terms.push((at, coefficient)),
        }
        // Two bodies that follow one waveform have no relative motion.
        terms.retain(|(_, sum)| *sum != 0.0);
    }

    /// Returns whether the linear form never changes.
    pub(crate) fn is_constant(&self) -> bool {
        self.free.is_empty() && self.driven.is_empty()
    }

    /// Returns the value for given coordinates and waveforms: constant + (Σ free + Σ driven), so that large displacements of two bodies
    /// cancel first.
    pub(crate) fn value(&self, free: impl Fn(usize) -> f64, driven: impl Fn(usize) -> f64) -> f64 {
        let own: f64 = self.free.iter().map(|(i, a)| a * free(*i)).sum();
        let followed: f64 = self.driven.iter().map(|(w, a)| a * driven(*w)).sum();
        self.constant + (own + followed)
    }

    /// Returns the distance of the free coordinates from their origins, m, which determines rounding. `x` returns a coordinate.
    #[inline]
    pub(crate) fn travel(&self, x: impl Fn(usize) -> f64) -> f64 {
        self.free.iter().map(|(i, a)| (a * x(*i)).abs()).sum()
    }

    /// Returns Σ coefficient² · mobility over free coordinates, 1/kg: the inverse effective mass along the displacement.
    pub(crate) fn mobility(&self, mobility: impl Fn(usize) -> f64) -> f64 {
        self.free.iter().map(|(i, a)| a * a * mobility(*i)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(bindings: [Binding; 3]) -> Body {
        Body { name: String::new(), bindings }
    }

    #[test]
    fn a_rolling_point_moves_with_the_pitch_and_a_held_one_counts_once() {
        let ball = body([Binding::Free(0), Binding::Free(1), Binding::Free(2)]);
        let below = Point { x: 0.0, z: -2.0 };
        let ends = [(Side::Ground, Point::default()), (Side::Body(0), below)];
        let u = Measure::between(ends, Direction::X, std::slice::from_ref(&ball));
        // u = 0 - (x - Zθ) = -x - 2θ: rolling without slip has x = -2θ.
        assert_eq!((&u.free[..], u.constant), (&[(0, -1.0), (2, -2.0)][..], 0.0));
        let beside = Point { x: 3.0, z: 0.0 };
        let ends = [(Side::Body(0), beside), (Side::Body(1), Point::default())];
        let d = Measure::between(
            ends,
            Direction::Z,
            &[ball, body([Binding::Held(1.0), Binding::Held(0.5), Binding::Held(0.0)])],
        );
        assert_eq!((&d.free[..], d.constant), (&[(1, 1.0), (2, 3.0)][..], -0.5));
    }

    #[test]
    fn what_follows_one_waveform_on_both_sides_does_not_move() {
        let foot = body([Binding::Driven(0), Binding::Held(0.0), Binding::Held(0.0)]);
        let ends = [(Side::Body(0), Point::default()), (Side::Body(1), Point::default())];
        assert!(Measure::between(ends, Direction::X, &[foot.clone(), foot]).is_constant());
    }
}
