//! What a move would give; nothing moves.

use super::cut::Drag;
use super::front::Front;
use super::knot::Knot;
use super::{Curve, sweep};
use crate::{Apex, Interface, Move, Outcome, Response};

impl Curve {
    /// Force and tangents that a move would give. Costs the pieces that the move would cut, usually one.
    pub fn trial(&self, law: &Interface, to: Move) -> Response {
        match to {
            Move::Grown { to, force } => {
                Response { force, stiffness: law.stick_stiffness(to.d), coupling: 0.0 }
            }
            Move::Chord(to) => {
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

    /// Everything that a chord would give, its friction work included.
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
