//! Prediction of the next event; choice of the end and the stages of the next step.
//!
//! The part of a step beyond an event is wasted. A step that ends well before the event costs another step. The first event is therefore
//! predicted from the motion at the start of the step. A wrong prediction costs evaluations, but no accuracy, because the event is located
//! on the dense output.
//!
//! Where a contact touches, separates or begins gross slip, its force varies with the power 3/2 of the time to that singular moment.
//! Examples are Hertz' force and F_x = μF_N[1 - (1 - u/u_c)^{3/2}]. Steps with even stages then have only the order 1.5 to 2. A graded step
//! begins or ends at the singular moment, with stages concentrated near it, and keeps its order.
//!
//! Forces with an integer power, as for a cone or a flat punch, need no graded steps.

use super::Located;
use crate::contact::Contact;
use crate::equations::Equations;
use crate::model::Measure;
use crate::quadrature;
use crate::state::State;
use stickslip_contact::Guard;
use stickslip_stepper::{Attempt, Grade};

/// End, distribution of stages and limits of the next step.
#[derive(Clone, Copy)]
pub(super) struct Aim {
    /// End of the step, s.
    pub(super) target: f64,
    /// Distribution of the stages: even, or concentrated near the start or the end.
    pub(super) grade: Grade,
    /// Largest length that the step may have, s.
    pub(super) most: f64,
    /// Time to the next singular moment, s; ∞ without one.
    pub(super) singular: f64,
    /// Contact and event function whose singular zero is expected at the end of the step.
    pub(super) closes: Option<(usize, Guard)>,
}

/// Predicted end of the current law of a contact.
#[derive(Clone, Copy)]
struct Expected {
    /// Time from the start of the step to the event, s; positive.
    left: f64,
    contact: usize,
    /// Event function that is expected to cross zero.
    guard: Guard,
}

/// Ratio of the step length to the predicted time of an event, so that the event lies inside the step.
const OVERSTEP: f64 = 1.05;
/// Largest rate of time within a graded step, relative to an even one. The longest graded step is shorter by this factor.
const FASTEST: f64 = 2.0;
/// Smallest tolerance at which a graded step may be as long as an even one.
const LOOSE: f64 = 3e-4;
/// Shortest step of the order-5 method with few stages, as a fraction of its maximum step.
const LEAST: f64 = 0.05;
/// Smallest ratio of the length of a repeated or following step to the present length.
pub(super) const SHRINK: f64 = 0.2;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Chooses the next step: as long as step control permits, but not far beyond the first expected event.
    ///
    /// * While accelerations are constant, only corners and the longest time step limit the step.
    /// * If no singular event is expected, the step is even and ends at most 5 % beyond the first event.
    /// * If a singular event is within reach, one graded step ends there.
    /// * Otherwise an even step covers half of the time to the singular event.
    ///
    /// `corner` is the next time that no step may cross, s.
    pub(super) fn aim(&self, state: &State, corner: f64) -> Aim {
        let longest = self.motion.longest_now(state.t, self.setting.model.fastest);
        let even = |step: f64| Aim {
            target: end(state.t, step, corner),
            grade: Grade::Even,
            most: step,
            singular: f64::INFINITY,
            closes: None,
        };
        // Under constant forces a step of any length is exact, and an event may cut it.
        if self.motion.solver.coasts() {
            return even(longest);
        }
        let step = state.step.min(longest);
        // The time left may be less than the rounding of t, and the step must still pass the event.
        let rounding = 16.0 * f64::EPSILON * state.t;
        let within = |end: Expected| OVERSTEP * end.left + rounding;
        // Even steps shorten before a singular event; a graded step can keep the earlier length.
        let most = (self.motion.pace.reach * step)
            .max(self.motion.pace.gait.proven / FASTEST)
            .min(longest / FASTEST);
        let first = [self.piece_end(state), self.lift_off(state, step.max(most))].into_iter().flatten();
        let start = |step: f64| match self.graded_start(state, step) {
            Some(longest) => Aim { grade: Grade::Start, ..even(step.min(longest)) },
            None => even(step),
        };
        let first = first.min_by(|a, b| a.left.total_cmp(&b.left));
        if self.graded_start(state, step).is_none()
            && first.is_none_or(|first| !self.is_singular(state, first))
            && let Some(brief) = self.brief(state, (step, first.map_or(f64::INFINITY, within)), corner)
        {
            return brief;
        }
        let Some(first) = first else { return start(step) };
        // Half of the allowed distance beyond the event, so that the event function crosses zero inside the step.
        let over = 0.5 * self.motion.pace.closeness * first.left;
        let to = first.left + over;
        let singular = if self.is_singular(state, first) { first.left } else { f64::INFINITY };
        // The event is too far for two steps, beyond a corner, or closer than rounding: a graded step would not end there.
        let far = first.left > 2.0 * step.max(most) || over < rounding || state.t + to >= corner;
        if far || singular == f64::INFINITY {
            return Aim { singular, ..start(step.min(within(first))) };
        }
        let fades = self.setting.model.contacts[first.contact].fades_evenly();
        let (grade, most) = if fades { (Grade::Even, step) } else { (Grade::End, most) };
        // Two steps are needed; the first one is even and covers half of the time.
        if to > most {
            return Aim { singular, ..start(step.min(0.5 * first.left)) };
        }
        let closes = Some((first.contact, first.guard));
        Aim { target: state.t + to, grade, most, singular: f64::INFINITY, closes }
    }

    /// Returns a step with few stages (order 5) if an event or corner will end the step soon. A longer step would be wasted.
    fn brief(&self, state: &State, (step, left): (f64, f64), corner: f64) -> Option<Aim> {
        let short = self.motion.pace.short;
        // A step that was rejected with few stages is repeated with all stages.
        if short == 0.0 || self.control.history().rejected.is_some() {
            return None;
        }
        let eq = self.setting.equations(state, &self.interval);
        let ends = left.min(OVERSTEP * self.watch.turn(&eq)).min(corner - state.t);
        let brief = |step: f64| Aim {
            target: end(state.t, step, corner),
            grade: Grade::Few,
            most: step,
            singular: f64::INFINITY,
            closes: None,
        };
        (ends <= short.min(step)).then(|| brief(ends.max(LEAST * short).min(step)))
    }

    /// Whether a law ends with a force of power 3/2 in the time left, and the rest of the law is long enough to matter.
    ///
    /// The remaining length of the law is compared with the natural depth before separation, and with u_c before gross slip. Below
    /// tolerance^{2/3} of that scale the singular part is within the tolerance, and an even step is sufficient.
    fn is_singular(&self, state: &State, end: Expected) -> bool {
        let (contact, motion) =
            (&self.setting.model.contacts[end.contact], self.watch.from[end.contact].motion);
        if !self.motion.solver.grades() {
            return false;
        }
        let left = end.guard.value(contact, state.law(end.contact), &motion);
        let tells = |unit: f64| left > unit * self.motion.pace.resolved;
        match state.modes[end.contact].branch() {
            _ if end.guard == Guard::Contact => tells(contact.natural.depth),
            Some(branch) => {
                branch.ends_in_gross_slip(&contact.interface) && tells(contact.natural.displacement)
            }
            None => false,
        }
    }

    /// Returns the longest graded step just after a touch, s. `None` if an even step is sufficient.
    ///
    /// Graded steps are needed where the force begins with a power of d between 1 and 2.
    fn graded_start(&self, state: &State, step: f64) -> Option<f64> {
        if !self.motion.solver.grades() {
            return None;
        }
        // Contacts with closed-form forces have a constant indentation and cannot just have touched.
        let touched = self.interval.others.iter().filter(|c| self.is_touched(state, **c, step));
        let swing = touched.map(|c| self.touching_swing(*c)).reduce(f64::max)?;
        Some(self.motion.pace.start / swing.max(self.setting.model.fastest))
    }

    /// Whether a contact has only just touched, with a force that begins with a power of d between 1 and 2.
    ///
    /// A contact has just touched if its indentation is at most [`closeness`](super::motion::Pace::closeness) times the step times ḋ.
    fn is_touched(&self, state: &State, c: usize, step: f64) -> bool {
        let contact = &self.setting.model.contacts[c];
        let motion = self.watch.from[c].motion;
        // A contact with constant indentation has no touch.
        !contact.is_constant()
            && (state.modes[c].grows() || state.modes[c].branch().is_some())
            && motion.d <= self.motion.pace.closeness * motion.dd * step
            && contact.is_steep()
    }

    /// Returns the angular frequency of the oscillation that begins with a touch at the speed ḋ, 1/s.
    ///
    /// The frequency is ḋ/L with the depth L at which gF_N(L)L = ḋ², with g as in [`Self::leaves`]. In units of L and L/ḋ all touches of
    /// one power law are the same motion. The result is 0 for contacts that no body presses.
    fn touching_swing(&self, c: usize) -> f64 {
        let contact = &self.setting.model.contacts[c];
        let speed = self.watch.from[c].motion.dd;
        let Some(measure) = contact.coupling().filter(|_| speed > 0.0) else { return 0.0 };
        let gain = contact.count * measure.mobility(|i| self.setting.model.free[i].mobility);
        let mut depth = contact.natural.depth;
        // The first iteration is exact for a power law. Other profiles are close to one.
        for _ in 0..2 {
            let (force, slope) =
                (contact.interface.normal_force(depth), contact.interface.normal_stiffness(depth));
            depth *=
                math::powf(speed * speed / (gain * force * depth), (1.0 + slope * depth / force).recip());
        }
        let rate = speed / depth;
        if rate.is_finite() { rate } else { 0.0 }
    }

    /// Returns when slip is expected to reach the end of the first memory piece, so that the step is not much longer.
    ///
    /// `None` if no slip edge reaches the end of its piece with the current motion.
    fn piece_end(&self, state: &State) -> Option<Expected> {
        let (eq, begin) = (self.setting.equations(state, &self.interval), self.motion.solver.span().begin);
        let steady = self.watch.expected_of_closed(&self.interval.closed, begin);
        let all = steady.into_iter().chain(
            self.interval.open_form().map(|c| (c, self.watch.expected_of(&eq, c, &self.motion.solver))),
        );
        let (contact, left) = all.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, left)| left.is_finite())?;
        Some(Expected { left, contact, guard: Guard::Piece })
    }

    /// Returns when the first contact is expected to separate, if this happens within two steps.
    ///
    /// Applies to contacts that are pressed by the motion of bodies.
    fn lift_off(&self, state: &State, step: f64) -> Option<Expected> {
        let mut first: Option<Expected> = None;
        for &c in &self.interval.others {
            let contact = &self.setting.model.contacts[c];
            let Some(measure) = contact.coupling().filter(|_| !state.modes[c].is_open()) else { continue };
            if let Some(left) = self.leaves(c, contact, measure, 2.0 * step)
                && first.is_none_or(|first| left < first.left)
            {
                first = Some(Expected { left, contact: c, guard: Guard::Contact });
            }
        }
        first
    }

    /// Returns the time to the separation of a contact, s, calculated as if only the normal force of this contact changed.
    ///
    /// With d̈ = r - gF_N(d), the squared speed is ν²(x) = ḋ² - 2r(d-x) + 2g[E(d) - E(x)], and the time is ∫₀ᵈ dx/ν. The gain g is the
    /// mobility along d times the number of contacts, and r is the acceleration by other forces. E = E\*N is the normal energy (J).
    ///
    /// `None` if the contact does not open, turns before it separates, or needs more than `within` (s) at its final speed.
    fn leaves(&self, c: usize, contact: &Contact, measure: &Measure, within: f64) -> Option<f64> {
        let (motion, (bend, _)) = (self.watch.from[c].motion, self.watch.from[c].second);
        let (d, v) = (motion.d, motion.dd);
        if !(v < 0.0 && d > 0.0) {
            return None;
        }
        let gain = contact.count * measure.mobility(|i| self.setting.model.free[i].mobility);
        let rest = bend + gain * contact.interface.normal_force(d);
        let energy = contact.interface.normal_energy(d);
        // Other forces are taken as constant: shortly before separation the contact's own force changes most.
        let square = |x: f64| {
            v * v - 2.0 * rest * (d - x) + 2.0 * gain * (energy - contact.interface.normal_energy(x))
        };
        // A cheap bound that may spare the quadrature: d divided by the final speed.
        let end = square(0.0);
        if !(end > 0.0 && d < within * end.sqrt()) {
            return None;
        }
        // Four nodes are sufficient, because the end of the step is corrected later.
        let left = d * quadrature::mean(f64::INFINITY, 1.0, |shares| {
            shares.map(|share| square(d * share).sqrt().recip())
        })
        .value;
        left.is_finite().then_some(left)
    }
}

/// Returns the longest graded step as a fraction of an even one.
///
/// A longer graded step would be rejected and would also shorten the following even steps.
pub(super) fn reach(tolerance: f64) -> f64 {
    if tolerance < LOOSE { FASTEST.recip() } else { 1.0 }
}

/// Returns the longest graded step after a touch, in radians of the oscillation that begins with the touch.
///
/// The error of that step is a tenth of the tolerance. For d̈ = -dᵖ, 1 < p < 2, at unit speed, a step of θ rad has an
/// error of at most 8e-4 θ^{6.5}. Beyond half a radian the embedded estimate is unreliable.
pub(super) fn start(tolerance: f64) -> f64 {
    math::powf(0.1 * tolerance / 8e-4, 6.5_f64.recip())
}

/// Returns the end of the next step: exactly the corner, or a time that leaves no short remainder before it.
///
/// If the step would leave less than its own length before the corner, two equal steps cover the time to the corner.
fn end(t: f64, step: f64, corner: f64) -> f64 {
    let left = corner - t;
    // The sum t + step could differ from the corner by rounding.
    if step >= 0.999 * left {
        corner
    } else if 2.0 * step > left {
        t + 0.5 * left
    } else {
        t + step
    }
}
