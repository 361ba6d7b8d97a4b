//! Leaps of a variation: the derivatives at the end of an arc of a swing, in closed form but for one quadrature.
//!
//! An arc is made of few quantities ([`rates`]), and whatever changes a run changes these where the arc begins: the speed along the
//! slide, the acceleration b₀, and of each contact in partial slip how steeply its force falls and where its front is. With the line
//! δp = a + bh by which the piece below the front moves, s = dh/du and η = δ ln s
//!
//! δh₀ = s[δu - σκδd - σδκ(d - h) - (a + bh)],  η = s(σδκ - b),  δ ln λ = η,  δ ln α = δ ln(G\*/m) - η,
//!
//! since αλ = G\*/m whatever the piece is. Where all contacts slide the arc is a parabola.

use super::Variation;
use super::anchors::Held;
use super::parameter::{Moment, Shift};
use super::steps::Passed;
use crate::contact::{Contact, Mode, Press};
use crate::interval::{Rates, Stretch, rates};
use crate::record::Stride;
use crate::state::State;
use stickslip_stepper::Coefficients;

/// Relative error that is allowed of how times change, in tolerances of the run's own steps.
const ALLOWED: f64 = 100.0;
/// By how much, as a part of it, what a piece pulls may be another stiffness than that of its springs: a path of growth that bends.
const BENT: f64 = 1e-9;
/// Difference of the speeds of two followers, as a part of them, that is rounding.
const ALIKE: f64 = 1e-9;

/// What arcs are led by. Scratch.
#[derive(Debug, Default)]
pub(super) struct Arc {
    rates: Rates,
    /// By how much each number changes each quantity, quantity by quantity.
    changes: Vec<f64>,
    /// By how much it changes the speed of the followers along the coordinate, m/s.
    drifts: Vec<f64>,
}

/// A contact in partial slip where an arc begins.
struct Slip<'a> {
    contact: &'a Contact,
    held: &'a Held,
    /// The piece of the memory that it cuts, where that moves.
    piece: Option<usize>,
    /// s and σ.
    lean: f64,
    sense: f64,
    /// d and the height of the front, m.
    depth: f64,
    front: f64,
}

impl<'a> Slip<'a> {
    /// None where it does not swing by the stiffness of its springs.
    fn of(contact: &'a Contact, held: &'a Held, (mode, u): (&Mode, f64)) -> Option<Self> {
        let (Mode::Slip(branch), Press::Constant { d, reduced_force }) = (mode, &contact.press) else {
            return None;
        };
        let (foot, branch) = (branch.foot(), branch.at_depth(*d, *reduced_force));
        let ((_, lean), (_, gain)) = (branch.front(), branch.forces());
        let modulus = contact.interface.tangential_modulus();
        let is_straight = (gain * lean - modulus).abs() <= BENT * modulus;
        let front = foot + branch.margin(u).max(0.0) * lean.abs();
        // In the middle of what is left of it no rounding takes another piece for it.
        let piece = held.piece(0.5 * (foot + front));
        is_straight.then_some(Self { contact, held, piece, lean, sense: branch.sense(), depth: *d, front })
    }

    /// Changes of ln α but for G\*/m, of ln λ and of h₀, by those of its place, of κ, and of what it holds by number `j`.
    fn changes(&self, (du, dd): (f64, f64), steeper: f64, j: usize) -> [f64; rates::EACH] {
        let [a, b] = self.piece.map_or([0.0; 2], |piece| self.held.line(piece, j));
        let (steeper, slope) = (self.sense * steeper, self.sense * self.contact.interface.stick_slope());
        let edge = du - slope * dd - steeper * (self.depth - self.front);
        let steepens = self.lean * (steeper - b);
        [-steepens, steepens, self.lean * (edge - (a + b * self.front))]
    }
}

impl Variation<'_> {
    /// Leads the derivatives over an arc of a swing; false, with nothing done, where that has no closed form.
    pub(super) fn leap(&mut self, from: &State, stride: &mut dyn Stride) -> bool {
        if self.works.are_led() || stride.arc().is_none() || self.layout.free != 1 {
            return false;
        }
        let (mut nodes, mut passed) = (std::mem::take(&mut self.nodes), std::mem::take(&mut self.passed));
        let mut arc = std::mem::take(&mut self.arc);
        let done = match (&mut nodes[..], &mut passed[..]) {
            ([node, ..], [passed, ..]) => {
                self.begin_arc(from, stride, (node, passed));
                stride.arc().is_some_and(|stretch| {
                    let known = self.finds(from, stretch, (node, passed), &mut arc);
                    if known {
                        self.go_on(stretch, node, &arc);
                    }
                    known
                })
            }
            _ => false,
        };
        (self.nodes, self.passed, self.arc) = (nodes, passed, arc);
        done
    }

    /// The equations where an arc begins.
    fn begin_arc(&mut self, from: &State, stride: &mut dyn Stride, at: (&mut Coefficients, &mut Passed)) {
        let (node, passed) = at;
        passed.y.resize(self.layout.total(), 0.0);
        let [t, _] = stride.at(0.0, &mut passed.y[..2]);
        (passed.t, passed.now) = (t, t);
        let laws = self.laws(from);
        laws.lay_out((t, &passed.y), node, &mut passed.stands);
        node.forcing.resize(self.count(), 0.0);
        if !self.parameters.is_empty() {
            laws.move_by_numbers(passed, node);
        }
    }

    /// Finds how the end of an arc changes; false where that has no closed form.
    fn finds(
        &self,
        from: &State,
        stretch: &Stretch<'_>,
        at: (&Coefficients, &Passed),
        arc: &mut Arc,
    ) -> bool {
        stretch.is_free()
            || self.changes(from, stretch, at, arc).is_some()
                && arc.rates.find(stretch, ALLOWED * self.tolerance)
    }

    /// By how much each number changes each quantity of an arc; none where it cannot be told by these.
    fn changes(
        &self,
        from: &State,
        stretch: &Stretch<'_>,
        (node, passed): (&Coefficients, &Passed),
        arc: &mut Arc,
    ) -> Option<()> {
        let (count, sense, laws) = (self.count(), stretch.sense(), self.laws(from));
        let [stiffness, damping, ..] = node.matrix[..] else { return None };
        let Arc { changes, drifts, .. } = arc;
        changes.clear();
        changes.resize(count * rates::place(stretch.slipping().count(), 0), 0.0);
        drifts.clear();
        drifts.resize(count, 0.0);
        for (slip, c) in stretch.slipping().enumerate() {
            let contact = &self.model.contacts[c];
            let arm: f64 = contact.u.free.iter().map(|(_, a)| a).sum();
            let motion = laws.eq.motion(contact, passed.t, |i| passed.y[i]);
            let it = Slip::of(contact, &self.held[c], (&from.modes[c], motion.u))?;
            let first = count - self.parameters.len();
            for (j, column) in self.columns.chunks_exact(self.layout.dimension()).enumerate() {
                let at = laws.moment(passed);
                let (shift, steeper, stiffer) = match j.checked_sub(first) {
                    Some(place) => self.shift(contact, at.by(place), place)?,
                    None => (Shift::default(), 0.0, 0.0),
                };
                let drift = shift.du / arm;
                if slip > 0 && (drift - drifts[j]).abs() > ALIKE * drift.abs() {
                    return None;
                }
                drifts[j] = drift;
                let [gain, lean, height] = it.changes((arm * column[0] + shift.u, shift.d), steeper, j);
                for (quantity, change) in [gain + stiffer, lean, height].into_iter().enumerate() {
                    changes[rates::place(slip, quantity) * count + j] = change;
                }
            }
        }
        for (j, column) in self.columns.chunks_exact(self.layout.dimension()).enumerate() {
            let pull = stiffness * column[0] + damping * column[1] + node.forcing[j];
            changes[rates::SPEED * count + j] = sense * (column[1] + drifts[j]);
            changes[rates::PUSH * count + j] = sense * pull;
        }
        Some(())
    }

    /// How the number at a place moves a contact, its κ, and G\*/m as a share; none where it moves its profile or its levers.
    fn shift(&self, contact: &Contact, at: Moment<'_>, place: usize) -> Option<(Shift, f64, f64)> {
        let (parameter, c) = (&self.parameters[place], contact.place);
        let [_, mobility] = parameter.coordinate(0);
        let stiffer = parameter.tangential(c) + mobility;
        let is_known = !parameter.shapes(c) && parameter.levers(c).iter().all(|levers| levers.is_empty());
        is_known.then(|| (parameter.shift(contact, at), parameter.slope(c), stiffer))
    }

    /// The derivatives at the end of an arc.
    fn go_on(&mut self, stretch: &Stretch<'_>, begin: &Coefficients, arc: &Arc) {
        let (sense, time, count) = (stretch.sense(), stretch.duration(), self.count());
        let columns = self.columns.chunks_exact_mut(self.layout.dimension());
        for (j, (column, pull)) in columns.zip(&begin.forcing).enumerate() {
            let [x, v, ..] = column else { continue };
            if stretch.is_free() {
                (*x, *v) = (*x + time * (*v + 0.5 * time * pull), *v + time * pull);
                continue;
            }
            let [mut way, mut speed] = [0.0; 2];
            for (rate, change) in arc.rates.ends.iter().zip(arc.changes.iter().skip(j).step_by(count)) {
                way += rate[0] * change;
                speed += rate[1] * change;
            }
            (*x, *v) = (*x + sense * way - arc.drifts[j] * time, sense * speed - arc.drifts[j]);
        }
    }
}
