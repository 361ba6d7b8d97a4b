//! Contacts that keep to one branch of their law between chords: for frames.
//!
//! A chord a step moves a memory at every step, and friction is swept as often. At a constant depth one edge drags over one piece
//! of the memory for many steps: one chord to its end is the same as many, and until then a force costs one M. So the memory
//! of such a contact stays behind, and its branch is looked at where steps end. A piece that is used up, or a sense that has
//! turned, cuts the step where the cubic through both its ends says that it did, but never to less than an eighth: the work of
//! a step is bounded, and of several ends within an eighth the later ones cost the error of a kink in so short a time.

use super::Chords;
use crate::RunError;
use crate::contact::{Contact, Mode, Motion};
use crate::interval::Interval;
use crate::method::Method;
use crate::state::State;
use crate::{Model, record::Record};
use stickslip_contact::{Apex, Branch, Memory, Segment};

/// Turning points that a contact remembers.
pub(in crate::run) const KNOTS: usize = 64;

/// Ends of branches so near to each other, in shares of a step, are one.
const TOGETHER: f64 = 1e-6;
/// What may be left of a piece that is used up, in u_c.
const NEAR: f64 = 1e-6;

/// What is known between two ends of branches.
pub(in crate::run) struct Branches<'a> {
    pub(super) interval: Interval<'a>,
    /// Whether the interval is that of the state.
    pub(super) current: bool,
    /// Contacts whose branches end with the step, and the senses of the next ones.
    ended: Vec<(usize, f64)>,
    /// Those that were found to end where the step was cut, whatever the last bit says, likewise.
    due: Vec<(usize, f64)>,
}

impl<'a> Branches<'a> {
    pub(super) fn of(model: &'a Model) -> Self {
        let room = || Vec::with_capacity(model.contacts.len());
        Self { interval: Interval::of(model), current: false, ended: room(), due: room() }
    }

    /// Whether all contacts of a model keep to branches of closed form.
    #[inline]
    fn holds_all(&self, model: &Model) -> bool {
        self.current && self.interval.closed.len() == model.contacts.len()
    }
}

impl<'a> Chords<'a> {
    /// Works out what stays the same until a branch ends, where it is not known.
    #[inline]
    pub(in crate::run) fn prepare(&mut self, state: &State) {
        if let Some(branches) = &mut self.branches
            && !branches.current
        {
            branches.interval.begin(self.model, state);
            branches.current = true;
        }
    }

    /// The motions of the contacts at time t in y.
    #[inline]
    pub(super) fn move_contacts(&mut self, state: &State, t: f64, y: &[f64]) {
        let mut motions = std::mem::take(&mut self.motions);
        let n = self.layout.free;
        motions.clear();
        match &self.branches {
            Some(branches) if branches.holds_all(self.model) => {
                let closed = &branches.interval.closed;
                motions.extend(closed.iter().map(|closed| closed.motion(t, |i| y[i], |i| y[n + i])));
            }
            _ => {
                let eq = self.equations(state);
                motions.extend(self.model.contacts.iter().map(|contact| eq.motion(contact, t, |i| y[i])));
            }
        }
        self.motions = motions;
    }

    /// Whether all contacts keep to their branches through the step to time t in y, and nobody wants to see it: then it is
    /// accepted, and no memory moves.
    #[inline]
    pub(in crate::run) fn glides(
        &mut self,
        state: &mut State,
        (t, y): (f64, &[f64]),
        record: &mut dyn Record,
    ) -> bool {
        match &self.branches {
            Some(branches) if branches.holds_all(self.model) && self.model.blocks.is_empty() => {}
            _ => return false,
        }
        if t > self.horizon.end || self.output.due(t) || record.wants_events() {
            return false;
        }
        self.move_contacts(state, t, y);
        let closed = self.branches.iter().flat_map(|branches| &branches.interval.closed);
        // Not a number keeps to nothing.
        if !closed.zip(&self.motions).all(|(closed, motion)| closed.keeps(motion)) {
            return false;
        }
        std::mem::swap(&mut self.before, &mut self.motions);
        state.y.copy_from_slice(y);
        state.t = t;
        state.counts.steps += 1;
        state.tally.step(Method::AskedFor);
        true
    }

    /// When the first branch ends in the step to time t in y, s; none where none does.
    pub(in crate::run) fn first_end(&mut self, state: &State, (t, y): (f64, &[f64])) -> Option<f64> {
        self.branches.as_ref()?;
        self.move_contacts(state, t, y);
        let duration = t - state.t;
        let Some(branches) = &mut self.branches else { return None };
        branches.due.clear();
        let mut first = f64::INFINITY;
        for (c, (from, to)) in self.before.iter().zip(&self.motions).enumerate() {
            let Mode::Slip(branch) = &state.modes[c] else { continue };
            let Some((share, sense)) = end_of(branch, Way { from, to, duration }) else { continue };
            if share < first - TOGETHER {
                branches.due.clear();
            }
            if share < first + TOGETHER {
                branches.due.push((c, sense));
            }
            first = first.min(share);
        }
        (first < f64::INFINITY).then_some(state.t + first * duration)
    }

    /// A step was not cut, or not where the first branch ends: its end decides.
    pub(in crate::run) fn let_end_decide(&mut self) {
        if let Some(branches) = &mut self.branches {
            branches.due.clear();
        }
    }

    /// Writes down the paths of a step of `duration` (s) that ends at time t: of contacts whose branches end with it, and of
    /// those that keep to none.
    pub(super) fn write_down(&mut self, state: &State, (t, duration): (f64, f64)) {
        self.ledger.clear();
        let Some(branches) = &mut self.branches else {
            for (c, motion) in self.motions.iter().enumerate() {
                self.ledger.push(c, t, Segment::Straight(motion.apex()));
            }
            return;
        };
        branches.ended.clear();
        for (c, motion) in self.motions.iter().enumerate() {
            let mut sense = motion.du.signum();
            if let Mode::Slip(branch) = &state.modes[c] {
                let due = branches.due.iter().find(|(due, _)| *due == c);
                let turned = branch.sense() * motion.du < 0.0;
                match due {
                    Some((_, next)) => sense = *next,
                    None if !turned && branch.margin(motion.d, motion.u) >= 0.0 => continue,
                    None if turned => {
                        let way = Way { from: &self.before[c], to: motion, duration };
                        if let Some(share) = way.turn() {
                            let extremum = Apex { d: motion.d, u: way.at(share) };
                            self.ledger.push(c, t - (1.0 - share) * duration, Segment::Straight(extremum));
                        }
                    }
                    None => sense = branch.sense(),
                }
            }
            branches.ended.push((c, sense));
            self.ledger.push(c, t, Segment::Straight(motion.apex()));
        }
    }

    /// Contacts whose branches have ended, and whose memories have come to where the state is, take the next ones.
    #[inline]
    pub(super) fn branch(&mut self, state: &mut State) {
        let Some(branches) = &mut self.branches else { return };
        for &(c, sense) in &branches.ended {
            let left = match &state.modes[c] {
                Mode::Slip(branch) => branch.margin(self.motions[c].d, self.motions[c].u),
                _ => 0.0,
            };
            let next =
                next_mode(&self.model.contacts[c], &state.memories[c], &self.motions[c], (sense, left));
            // The whole law stays what it is.
            branches.current &= matches!((&state.modes[c], &next), (Mode::Whole { .. }, Mode::Whole { .. }));
            state.modes[c] = next;
        }
    }

    /// After a corner: contacts that turn there come to where the state is, and take their next branches.
    ///
    /// Fails where a memory refuses its path.
    pub(super) fn branch_at_corner(
        &mut self,
        state: &mut State,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let t = state.t;
        if let Some(branches) = &mut self.branches {
            branches.current = false;
            branches.ended.clear();
        }
        self.measure(state);
        self.ledger.clear();
        for (c, motion) in self.motions.iter().enumerate() {
            let turns = matches!(&state.modes[c], Mode::Slip(branch) if branch.sense() * motion.du < 0.0);
            if let (true, Some(branches)) = (turns, &mut self.branches) {
                branches.ended.push((c, motion.du.signum()));
                self.ledger.push(c, t, Segment::Straight(motion.apex()));
            }
        }
        self.ledger.commit((self.model, self.layout), t, state)?;
        self.ledger.tell(record);
        self.branch(state);
        Ok(())
    }

    /// The motions of the contacts where the state is, as the step begins.
    pub(super) fn measure(&mut self, state: &State) {
        let y = std::mem::take(&mut self.last);
        let mut motions = std::mem::take(&mut self.motions);
        let eq = self.plain(state);
        motions.clear();
        motions.extend(self.model.contacts.iter().map(|contact| eq.motion(contact, state.t, |i| state.y[i])));
        self.before.clone_from(&motions);
        (self.motions, self.last) = (motions, y);
    }

    /// Every memory comes to where the state is.
    ///
    /// A path of the past: it cannot be refused, for its branch has been where it leads.
    pub(in crate::run) fn settle(&mut self, state: &mut State) {
        if self.branches.is_none() {
            return;
        }
        self.measure(state);
        self.ledger.clear();
        for (c, motion) in self.motions.iter().enumerate() {
            if matches!(state.modes[c], Mode::Slip(_)) {
                self.ledger.push(c, state.t, Segment::Straight(motion.apex()));
            }
        }
        let _ = self.ledger.commit((self.model, self.layout), state.t, state);
    }
}

/// The branch of a contact at a constant depth that moves in a sense; the whole law of all others. What is `left` of the piece
/// before (m), by a cubic's error, counts as gone.
fn next_mode(contact: &Contact, memory: &Memory, motion: &Motion, (sense, left): (f64, f64)) -> Mode {
    match memory.branching() {
        Some(branching) if contact.is_constant() && !contact.inert && motion.d > 0.0 && motion.du != 0.0 => {
            let slack = if left < NEAR * contact.natural.displacement { left.max(0.0) } else { 0.0 };
            Mode::Slip(branching.branch(&contact.interface, sense, slack))
        }
        _ => Mode::Whole { sense: 0.0 },
    }
}

/// Where the branch of a contact ends on its way, as a share of it, and the sense of the next one.
fn end_of(branch: &Branch, way: Way<'_>) -> Option<(f64, f64)> {
    let sense = branch.sense();
    let turned = sense * way.to.du < 0.0;
    if branch.margin(way.to.d, way.to.u) < 0.0 {
        return Some((way.reaches(branch), sense));
    }
    turned.then(|| (way.turn().unwrap_or(0.0), -sense))
}

/// The way of a contact at constant depth in a step, by the cubic through both its ends.
#[derive(Clone, Copy)]
struct Way<'a> {
    from: &'a Motion,
    to: &'a Motion,
    /// s.
    duration: f64,
}

impl Way<'_> {
    /// u at a share of the time, m: s u₁ + (1-s) u₀ + hs(1-s)[(1-s)(u̇₀-m) - s(u̇₁-m)], m the mean rate.
    fn at(&self, s: f64) -> f64 {
        let way = self.to.u - self.from.u;
        let mean = way / self.duration;
        let bend = (1.0 - s) * (self.from.du - mean) - s * (self.to.du - mean);
        self.from.u + s * way + self.duration * s * (1.0 - s) * bend
    }

    /// Its derivative by the share, m: u̇₀ + 2(3m - 2u̇₀ - u̇₁)s + 3(u̇₀ + u̇₁ - 2m)s², times h.
    fn slope(&self, s: f64) -> f64 {
        let [a, b, c] = self.rates();
        self.duration * ((a * s + b) * s + c)
    }

    /// Coefficients of u̇ over the share, of the square first, m/s.
    fn rates(&self) -> [f64; 3] {
        let (v0, v1, mean) = (self.from.du, self.to.du, (self.to.u - self.from.u) / self.duration);
        [3.0 * (v0 + v1 - 2.0 * mean), 2.0 * (3.0 * mean - 2.0 * v0 - v1), v0]
    }

    /// Where u turns, as a share of the time; none where rounding leaves no turn.
    fn turn(&self) -> Option<f64> {
        let [a, b, c] = self.rates();
        let root = (b * b - 4.0 * a * c).sqrt();
        let q = -0.5 * (b + root.copysign(b));
        [c / q, q / a].into_iter().find(|s| (0.0..=1.0).contains(s))
    }

    /// Where a branch's piece is used up, as a share of the time.
    fn reaches(&self, branch: &Branch) -> f64 {
        let margin = |u: f64| branch.margin(self.to.d, u);
        let (first, last) = (margin(self.from.u), margin(self.to.u));
        let mut s = if first > 0.0 { first / (first - last) } else { 0.0 };
        // The chord is h² off, and each step of Newton's squares that.
        for _ in 0..2 {
            let step = margin(self.at(s)) / (branch.sense() * self.slope(s));
            s = if step.is_finite() { (s + step).clamp(0.0, 1.0) } else { s };
        }
        s
    }
}
