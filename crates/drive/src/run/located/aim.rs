//! Where the next step ends, and how its stages lie in it.
//!
//! A step that an event cuts is lost beyond it, and one that stops well short of it costs another step. So
//! the first event is predicted from the motion at the start of the step. A prediction that misses costs
//! evaluations and no digits: the event itself is located on the dense output of whatever step was tried.
//!
//! Where a contact begins, ends or goes into gross slip its force is a power 3/2 of the time to that moment
//! (Hertz, and F_x = μF_N[1 - (1 - u/u_c)^{3/2}]): even steps across such a moment are of order 1.5 to 2,
//! whatever their method. A graded step ends or begins there with its stages crowded towards it, and keeps
//! its order. Where a force begins or ends with a whole power, as that of a cone or a flat punch, there is nothing to crowd for,
//! and even steps are a hundred times as exact.

use super::Located;
use crate::contact::{Contact, Guard, Mode};
use crate::equations::Equations;
use crate::model::Measure;
use crate::quadrature;
use crate::state::State;
use stickslip_stepper::{Attempt, Grade};

/// What the next step is to be.
#[derive(Clone, Copy)]
pub(super) struct Aim {
    /// Where it ends, s.
    pub(super) target: f64,
    /// How its stages lie in it: even, or crowded towards its start or its end.
    pub(super) grade: Grade,
    /// The longest that it may become, s.
    pub(super) most: f64,
    /// Time to a singular moment ahead, s; ∞ without one.
    pub(super) singular: f64,
    /// The guard whose singular fall is expected at its end.
    pub(super) closes: Option<(usize, Guard)>,
}

/// An expected end of a law: s from now, and the guard that falls.
#[derive(Clone, Copy)]
struct Expected {
    /// s from the start of the step; positive.
    left: f64,
    contact: usize,
    /// Which of its guards is expected to fall.
    guard: Guard,
}

/// Part by which a step aims beyond the expected end of a piece of memory, so that the end lies inside.
// Without it two contacts that grow take 47 % more evaluations, with 1.005 10 %; with 1.5 an eighth less, but at 1e-9 an error
// four times as large, and damped contacts 16 % more.
const OVERSTEP: f64 = 1.05;
/// Time goes by at most this much faster along a graded step than along an even one: so much less is its reach.
// With 20 some profiles end nearer, but a sine drive at 1e-6 no longer finds its steady step; with 1 a profile of power 4 has
// five times the error at 1e-9.
const FASTEST: f64 = 2.0;
/// From this tolerance on a graded step may be as long as an even one.
// At 1e-3 an oblique impact would take 22 % more evaluations, a sine drive 15 %, and at 1e-4 both 6 % less.
const LOOSE: f64 = 3e-4;
/// Shortest step of few stages, as a part of the longest: what turns sooner is as good as turning.
const LEAST: f64 = 0.05;
/// A step is not tried again with less than this part of it, and the next one is no shorter.
// Refused: 0.8, four times the error on a profile of power 3. With 0.02 no run differs.
pub(super) const SHRINK: f64 = 0.2;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// The next step: as long as its control wishes, but not far beyond the first event that is expected.
    ///
    /// In order: the solver coasts, and only corners and the longest step bind; nothing is expected within
    /// twice the step, or nothing singular, and the step is even and ends at most 5 % of the way beyond the
    /// event; something singular is within reach, and one graded step goes to it; it is not, and an even step
    /// goes half of the way.
    ///
    /// `corner` is the next moment that no step may cross, s. The target is never beyond it.
    pub(super) fn aim(&self, state: &State, corner: f64) -> Aim {
        let longest = self.motion.longest_now(state.t, self.setting.model.fastest);
        let even = |step: f64| Aim {
            target: end(state.t, step, corner),
            grade: Grade::Even,
            most: step,
            singular: f64::INFINITY,
            closes: None,
        };
        // Under constant forces a step of any length is exact: an event ahead cuts it and spoils nothing.
        if self.motion.solver.coasts() {
            return even(longest);
        }
        let step = state.step.min(longest);
        // What is left may be less than a last place of t; the step must get beyond it all the same.
        let rounding = 16.0 * f64::EPSILON * state.t;
        let within = |end: Expected| OVERSTEP * end.left + rounding;
        // Even steps have become short for what a graded one is spared.
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
        // Half of what may be missed, on the far side of the moment: its guard has then fallen inside the
        // step.
        let over = 0.5 * self.motion.pace.closeness * first.left;
        let to = first.left + over;
        let singular = if self.is_singular(state, first) { first.left } else { f64::INFINITY };
        // Too far for two steps, cut short by a corner, or with an overshoot of rounding: no graded step
        // would meet the moment.
        let far = first.left > 2.0 * step.max(most) || over < rounding || state.t + to >= corner;
        if far || singular == f64::INFINITY {
            return Aim { singular, ..start(step.min(within(first))) };
        }
        let fades = self.setting.model.contacts[first.contact].fades_evenly();
        let (grade, most) = if fades { (Grade::Even, step) } else { (Grade::End, most) };
        // Out of reach of one such step and within that of two: half of the way first, evenly.
        if to > most {
            return Aim { singular, ..start(step.min(0.5 * first.left)) };
        }
        let closes = Some((first.contact, first.guard));
        Aim { target: state.t + to, grade, most, singular: f64::INFINITY, closes }
    }

    /// A step of few stages, where something near will end it anyway: the law of a contact as it moves now, or a corner. Beyond
    /// that moment a longer step would be lost.
    fn brief(&self, state: &State, (step, left): (f64, f64), corner: f64) -> Option<Aim> {
        let short = self.motion.pace.short;
        // What few stages were refused is tried again with all.
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

    /// Whether a law ends with a force that goes with a power 3/2 of the time left, and enough of it to tell.
    ///
    /// What is left of the law is measured in the natural depth where the contact ends, in u_c where its slip
    /// front reaches the centre; below (tolerance)^{2/3} of it a power 3/2 is below the tolerance, and an
    /// even step does as well. Under a vibrating foot even steps of Nyström's method took ten steps and four
    /// rejections for each start of gross slip.
    fn is_singular(&self, state: &State, end: Expected) -> bool {
        let (contact, motion) =
            (&self.setting.model.contacts[end.contact], self.watch.from[end.contact].motion);
        if !self.motion.solver.grades() {
            return false;
        }
        let left = end.guard.value(contact, state.law(end.contact), &motion);
        let tells = |unit: f64| left > unit * self.motion.pace.resolved;
        match &state.modes[end.contact] {
            _ if end.guard == Guard::Contact => tells(contact.natural.depth),
            Mode::Slip(branch) => branch.ends_in_the_centre() && tells(contact.natural.displacement),
            _ => false,
        }
    }

    /// How long a graded step may be from here, s, where a contact has only just been touched whose force begins steeply; none
    /// where an even step does as well.
    fn graded_start(&self, state: &State, step: f64) -> Option<f64> {
        if !self.motion.solver.grades() {
            return None;
        }
        // What has a closed form has been pressed all along.
        let touched = self.interval.others.iter().filter(|c| self.is_touched(state, **c, step));
        let swing = touched.map(|c| self.touching_swing(*c)).reduce(f64::max)?;
        Some(self.motion.pace.start / swing.max(self.setting.model.fastest))
    }

    /// Whether a contact whose force begins steeply is, at its rate ḋ, no deeper than a step of [`Pace::closeness`] of this one
    /// would make it.
    ///
    /// [`Pace::closeness`]: super::motion::Pace::closeness
    fn is_touched(&self, state: &State, c: usize, step: f64) -> bool {
        let contact = &self.setting.model.contacts[c];
        let motion = self.watch.from[c].motion;
        // A depth that never changes has no first moment.
        !contact.is_constant()
            && matches!(state.modes[c], Mode::Grow | Mode::Slip(_))
            && motion.d <= self.motion.pace.closeness * motion.dd * step
            && contact.is_steep()
    }

    /// The rate at which a touch with the speed ḋ turns, 1/s: ḋ/L with the depth L at which gF_N(L)L = ḋ², g as in
    /// [`Self::leaves`].
    ///
    /// In L and L/ḋ all touches of one power law are the same motion. 0 of what bodies do not press.
    fn touching_swing(&self, c: usize) -> f64 {
        let contact = &self.setting.model.contacts[c];
        let speed = self.watch.from[c].motion.dd;
        let Some(measure) = contact.coupling().filter(|_| speed > 0.0) else { return 0.0 };
        let gain = contact.count * measure.mobility(|i| self.setting.model.free[i].mobility);
        let mut depth = contact.natural.depth;
        // Of a power law the first is exact; others are not far from one.
        for _ in 0..2 {
            let (force, slope) =
                (contact.interface.normal_force(depth), contact.interface.normal_stiffness(depth));
            depth *=
                math::powf(speed * speed / (gain * force * depth), (1.0 + slope * depth / force).recip());
        }
        let rate = speed / depth;
        if rate.is_finite() { rate } else { 0.0 }
    }

    /// About when the first piece of memory will be used up: a step much longer would only be thrown away.
    ///
    /// None where no edge will reach the end of its piece as it moves now.
    fn piece_end(&self, state: &State) -> Option<Expected> {
        let (eq, begin) = (self.setting.equations(state, &self.interval), self.motion.solver.span().begin);
        let steady = self.watch.expected_of_closed(&self.interval.closed, begin);
        let all = steady.into_iter().chain(
            self.interval.open_form().map(|c| (c, self.watch.expected_of(&eq, c, &self.motion.solver))),
        );
        let (contact, left) = all.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, left)| left.is_finite())?;
        Some(Expected { left, contact, guard: Guard::Piece })
    }

    /// About when the first contact will end, if within twice a step.
    ///
    /// Of contacts pressed by their bodies' motion only.
    fn lift_off(&self, state: &State, step: f64) -> Option<Expected> {
        let mut first: Option<Expected> = None;
        for &c in &self.interval.others {
            let contact = &self.setting.model.contacts[c];
            let Some(measure) = contact.coupling().filter(|_| state.modes[c] != Mode::Open) else { continue };
            if let Some(left) = self.leaves(c, contact, measure, 2.0 * step)
                && first.is_none_or(|first| left < first.left)
            {
                first = Some(Expected { left, contact: c, guard: Guard::Contact });
            }
        }
        first
    }

    /// Time to the end of a contact as if only its own normal force changed: then ḋ²/2 loses what the springs give,
    /// and ∫dd/ḋ is left.
    ///
    /// With d̈ = r - gF_N(d), g the mobility along d times the number of contacts and r what else accelerates
    /// them, ν²(x) = ḋ² - 2r(d-x) + 2g[E(d) - E(x)] with the normal energy E = E\*N (J), and the time is ∫₀ᵈ
    /// dx/ν. None where the contact does not open, would turn before it is apart, or is not apart `within`
    /// that time (s) at the speed of its end.
    fn leaves(&self, c: usize, contact: &Contact, measure: &Measure, within: f64) -> Option<f64> {
        let (motion, (bend, _)) = (self.watch.from[c].motion, self.watch.from[c].second);
        let (d, v) = (motion.d, motion.dd);
        if !(v < 0.0 && d > 0.0) {
            return None;
        }
        let gain = contact.count * measure.mobility(|i| self.setting.model.free[i].mobility);
        let rest = bend + gain * contact.interface.normal_force(d);
        let energy = contact.interface.normal_energy(d);
        // Others' forces are taken as they are now: in the last part of a contact its own changes most.
        let square = |x: f64| {
            v * v - 2.0 * rest * (d - x) + 2.0 * gain * (energy - contact.interface.normal_energy(x))
        };
        // d over the speed at the end is a cheap bound: the quadrature is spared where even that is too long.
        let end = square(0.0);
        if !(end > 0.0 && d < within * end.sqrt()) {
            return None;
        }
        // Any four nodes will do: the place is corrected by what the step finds there.
        let left = d * quadrature::mean(f64::INFINITY, 1.0, |shares| {
            shares.map(|share| square(d * share).sqrt().recip())
        })
        .value;
        left.is_finite().then_some(left)
    }
}

/// The longest graded step as a part of an even one.
///
/// What is aimed at further away is refused, and shortens the even steps after it, too, those of the next interval among them: a
/// slider on a sine took a refused step and two short ones for each start of gross slip.
pub(super) fn reach(tolerance: f64) -> f64 {
    if tolerance < LOOSE { FASTEST.recip() } else { 1.0 }
}

/// The longest graded step from a touch, in radians of the swing that the touch begins: what it misses is then a tenth of the tolerance.
///
/// Of d̈ = -dᵖ from a touch at the speed 1 a step of half a radian and more misses 8e-4 θ^{6.5} at most for 1 < p < 2. Its estimate stops growing at
/// half a radian and passes through 0 where p is nearly 2: by it alone steps of 0.7 to 1.2 rad were accepted at 1e-3 to 1e-5 that
/// missed up to 7e-4. All touches miss to one side, so that places are off by the square of their number.
pub(super) fn start(tolerance: f64) -> f64 {
    math::powf(0.1 * tolerance / 8e-4, 6.5_f64.recip())
}

/// End of the next step: the corner exactly, or so that no sliver is left before it.
///
/// A step that would leave less than its own length before the corner goes half of the way there, so that two
/// like steps follow instead of a whole one and a remainder.
fn end(t: f64, step: f64, corner: f64) -> f64 {
    let left = corner - t;
    // The corner to the last bit: a sum t + step would miss it by rounding.
    if step >= 0.999 * left {
        corner
    } else if 2.0 * step > left {
        t + 0.5 * left
    } else {
        t + step
    }
}
