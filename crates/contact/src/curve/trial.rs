//! What a move would give; nothing moves.
//!
//! A trial asks for force and tangents and makes no knot; a preview asks for everything and makes those that a commit would.
//! Both read the committed curve alone: any number of them, in any order, leave the next one the same to the last bit.

use super::cut::Drag;
use super::front::Front;
use super::knot::Knot;
use super::{Curve, sweep};
use crate::{Apex, Interface, Move, Outcome, Response};

impl Curve {
    /// Force and tangents that a move would give. Costs the pieces that the move would cut, usually one.
    // 36 to 39 ns with 5 knots as with 3 002 (a preview 74 to 89): stacks are read from the top, and nobody searches them.
    pub fn trial(&self, law: &Interface, to: Move) -> Response {
        match to {
            Move::Grown { to, force } => {
                Response { force, stiffness: law.stick_stiffness(to.d), coupling: 0.0 }
            }
            Move::Chord(to) => {
                // An open contact touches on the way: its curve is the point where it does.
                let touch;
                let knots = match &self.knots[..] {
                    [] => {
                        touch = [self.touching(to)];
                        &touch[..]
                    }
                    knots => knots,
                };
                respond(law, knots, to)
            }
        }
    }

    /// F_x that a chord would give, N: [`Self::trial`] without its tangents.
    #[inline]
    pub fn force_at(&self, law: &Interface, to: Apex) -> f64 {
        let Some(top) = self.knots.last() else { return self.trial(law, Move::Chord(to)).force };
        let shear = match Drag::of(law, &self.knots, to) {
            Drag::Open => return 0.0,
            Drag::Rest => top.shear,
            Drag::Stick => top.stick(law, to).shear,
            Drag::Slip(edge) => edge.shear(law, &self.knots, to),
        };
        law.tangential_modulus() * shear
    }

    /// Everything that a chord would give, its friction work included.
    // By reading, without a copy of the memory: 92 ns where a clone that commits takes 197, and allocates.
    pub fn preview(&self, law: &Interface, to: Apex) -> Outcome {
        let touch = [self.touching(to)];
        let knots = if self.knots.is_empty() { &touch[..] } else { &self.knots[..] };
        let from = if self.knots.is_empty() { touch[0].apex() } else { self.apex };
        let modulus = law.tangential_modulus();
        let friction = sweep::work(law, knots, from, to);
        let top = knots[knots.len() - 1];
        let (end, front) = match Drag::of(law, knots, to) {
            Drag::Open => return Outcome { friction, ..Outcome::default() },
            Drag::Rest => (top, self.front),
            Drag::Stick => (top.stick(law, to), Front::STICK),
            Drag::Slip(edge) => (edge.end(law, &edge.foot(law, knots, to), Some(&top), to), edge.front()),
        };
        let (state, stick_radius) = front.zone(law, to.d);
        Outcome {
            force: modulus * end.shear,
            elastic: 0.5 * modulus * end.square,
            friction,
            stick_radius,
            state,
        }
    }
}

/// Force and tangents at the end of a chord from a curve of at least one knot.
#[inline]
fn respond(law: &Interface, knots: &[Knot], to: Apex) -> Response {
    let top = &knots[knots.len() - 1];
    let sticking = |shear: f64| Response {
        force: law.tangential_modulus() * shear,
        stiffness: law.stick_stiffness(to.d),
        coupling: 0.0,
    };
    match Drag::of(law, knots, to) {
        Drag::Open => Response::default(),
        Drag::Rest => sticking(top.shear),
        Drag::Stick => sticking(top.stick(law, to).shear),
        Drag::Slip(edge) => edge.response(law, knots, to),
    }
}
