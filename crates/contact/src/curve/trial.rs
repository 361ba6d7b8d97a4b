//! Trial evaluations of a move, which leave the memory unchanged.
//!
//! A trial returns force and derivatives. A preview also returns energies and state. Both functions read only the committed curve.

use super::cut::Drag;
use super::front::Front;
use super::knot::Knot;
use super::stack::SlopeRange;
use super::{Curve, sweep};
use crate::{Apex, Interface, Move, Outcome, Response};

impl Curve {
    /// Returns the direction in which the contact slides after it has broken loose; 0 otherwise.
    #[inline]
    pub(crate) fn slides(&self) -> f64 {
        self.slides
    }

    /// Lets a sliding contact stick again.
    pub(crate) fn hold(&mut self) {
        if self.slides != 0.0 {
            (self.slides, self.front) = (0.0, Front::STICK);
        }
    }

    /// Replaces the curve by the limit line of a direction and returns the released elastic energy, J.
    pub(crate) fn break_loose(&mut self, kinetic: &Interface, sense: f64) -> f64 {
        let (at, before) = (self.apex, self.elastic(kinetic));
        self.knots.clear();
        (self.slides, self.range) = (sense, SlopeRange::NONE);
        self.front = Front { sense, height: f64::NEG_INFINITY };
        let slope = sense * kinetic.stick_slope();
        let centre = Knot::touch(at.u - slope * at.d);
        self.knots.push(centre);
        if at.d > 0.0 {
            self.knots.push(centre.grow(kinetic, at.d, slope, at.u));
        }
        (before - self.elastic(kinetic)).max(0.0)
    }

    /// Returns force and derivatives at the end of a move. The cost is proportional to the number of pieces that the move would
    /// remove, usually one.
    pub fn trial(&self, law: &Interface, to: Move) -> Response {
        match to {
            Move::Grown { to, force } => {
                Response { force, stiffness: law.stick_stiffness(to.d), coupling: 0.0 }
            }
            Move::Chord(to) => {
                // The curve of an open contact is the point at which the path touches.
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

    /// Returns the tangential force F_x at the end of a straight path, N: [`Self::trial`] without derivatives.
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

    /// Returns force, energies and state at the end of a straight path, including the friction work.
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

/// Returns force and derivatives at the end of a straight path, for a curve of at least one breakpoint.
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
