//! Contacts that keep to one branch of their law between chords: for frames.
//!
//! A chord a step moves a memory at every step, and friction is swept as often. At a constant depth one edge drags over one piece
//! of the memory for many steps: one chord to its end is the same as many, and until then a force costs one M. So the memory
//! of such a contact stays behind, and its branch is looked at where steps end. A piece that is used up, or a sense that has
//! turned, cuts the step where the cubic through both its ends says that it did, but never to less than an eighth: the work of
//! a step is bounded, and of several ends within an eighth the later ones cost the error of a kink in so short a time. Where an edge
//! of a damped contact uses up its piece the step ends there, however soon: with the springs that stick goes a force of many times what
//! friction holds. Of such pieces there are at most as many as a memory has turning points.
//!
//! A contact under a normal that moves keeps to none: it goes by the whole law of its memory, one chord a step. A chord across a touch or a
//! change of what drags leaves a turning point in the memory that lies off the path by the square of the step, for good: steps are cut
//! there, too.

use super::Chords;
use super::way::{Way, end_of, kink};
use crate::RunError;
use crate::contact::{Contact, Mode, Motion};
use crate::interval::Interval;
use crate::method::Method;
use crate::state::State;
use crate::{Model, record::Record};
use stickslip_contact::{Apex, Branch, Memory, Segment};

/// Turning points that a contact remembers.
pub(super) const KNOTS: usize = 256;
/// The same where a normal moves: a contact that grows leaves one at each step.
pub(super) const GROWING_KNOTS: usize = 1024;

/// Ends of branches so near to each other, in shares of a step, are one.
const TOGETHER: f64 = 1e-6;
/// What may be left of a piece that is used up, in u_c.
const NEAR: f64 = 1e-6;

/// What stuck springs resist by their damping, of what they hold, from which on it matters how it gives way.
// With 0, a swing of 0.11 kg on a flat, damped by 59 ns, is ten times as far off at 1e-4.
const STRONG: f64 = 0.1;

/// Part of the springs of a contact that still stick up to which it gives way, and how far it slides in a step meanwhile, in u_c: the root
/// of the accuracy that is asked for, between these.
const HELD: f64 = 1e-3;
const PARTS: (f64, f64) = (1.0 / 512.0, 1.0 / 32.0);

/// How the damping of a contact weakens where an edge has used up its piece: with the springs that stick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::run) enum Weakening {
    /// A loop closes.
    Loop,
    /// It gives way: the last of the springs begin to slip, and until then the force goes with the root of the time that is left.
    Away,
}

/// What is known between two ends of branches.
pub(in crate::run) struct Branches<'a> {
    pub(super) interval: Interval<'a>,
    /// Whether the interval is that of the state.
    pub(super) current: bool,
    /// Contacts whose branches end with the step, and the senses of the next ones.
    pub(super) ended: Vec<(usize, f64)>,
    /// Those that were found to end where the step was cut, whatever the last bit says, likewise.
    due: Vec<(usize, f64)>,
    /// How far a damped contact under a normal that moves may slide in a step while it gives way, in u_c.
    part: f64,
}

impl<'a> Branches<'a> {
    /// Of frames that are asked for so much accuracy.
    pub(super) fn of(model: &'a Model, accuracy: f64) -> Self {
        let room = || Vec::with_capacity(model.contacts.len());
        let part = accuracy.sqrt().clamp(PARTS.0, PARTS.1);
        Self { interval: Interval::of(model), current: false, ended: room(), due: room(), part }
    }

    /// What is left of the piece of contact `c` in a motion, m: as whoever [glides](Chords::glides) sees it, to the last bit.
    fn left(&self, c: usize, branch: &Branch, motion: &Motion) -> f64 {
        match self.interval.closed_form(c) {
            Some(closed) => closed.margin(motion.u),
            None => branch.margin(motion.d, motion.u),
        }
    }

    /// Whether all contacts of a model keep to branches of closed form.
    #[inline]
    fn holds_all(&self, model: &Model) -> bool {
        self.current && self.interval.closed.len() == model.contacts.len()
    }
}

impl<'a> Chords<'a> {
    /// Works out what stays the same until a branch ends, where it is not known.
    ///
    /// The motions as the step begins with it, by the same formulas as at its end: whoever takes up a state has no others.
    #[inline]
    pub(in crate::run) fn prepare(&mut self, state: &State) {
        if let Some(branches) = &mut self.branches
            && !branches.current
        {
            branches.interval.begin(self.model, state);
            branches.current = true;
            self.move_contacts(state, state.t, &state.y);
            std::mem::swap(&mut self.before, &mut self.motions);
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

    /// When the first branch ends in the step to time t in y, or the law of a contact under a moving normal has its first kink, s; none
    /// where none does: then what was found before holds.
    pub(in crate::run) fn first_end(&mut self, state: &State, (t, y): (f64, &[f64])) -> Option<f64> {
        self.branches.as_ref()?;
        self.move_contacts(state, t, y);
        let duration = t - state.t;
        let Some(branches) = &mut self.branches else { return None };
        let mut first = f64::INFINITY;
        for (c, (from, to)) in self.before.iter().zip(&self.motions).enumerate() {
            let (contact, way) = (&self.model.contacts[c], Way { from, to, duration });
            let end = match &state.modes[c] {
                Mode::Slip(branch) => end_of(branch, branches.left(c, branch, to), way),
                _ if contact.is_constant() => None,
                // Without a branch there is no next one.
                _ => kink(contact.interface.stick_slope(), way).map(|share| (share, 0.0)),
            };
            let Some((share, sense)) = end else { continue };
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

    /// How the damping of a contact weakens where the step was found to end; none where no edge of a damped contact has used up its piece
    /// there.
    pub(in crate::run) fn weakens(&self, state: &State) -> Option<Weakening> {
        let due = self.branches.iter().flat_map(|branches| &branches.due);
        let damped = due.filter(|(c, _)| self.model.contacts[*c].is_damped());
        let ways = damped.filter_map(|(c, sense)| match &state.modes[*c] {
            Mode::Slip(branch) if branch.sense() == *sense && self.gives_way(*c, branch) => {
                Some(Weakening::Away)
            }
            Mode::Slip(branch) if branch.sense() == *sense => Some(Weakening::Loop),
            _ => None,
        });
        ways.max()
    }

    /// Whether the damping of contact `c` gives way where its piece ends, and matters at its speed: where it does not stages see more of
    /// the motion that lie evenly.
    fn gives_way(&self, c: usize, branch: &Branch) -> bool {
        let contact = &self.model.contacts[c];
        let resisted = contact.interface.damping() * self.motions[c].du.abs();
        branch.ends_in_the_centre() && resisted > STRONG * contact.natural.displacement
    }

    /// Longest step, s, that sees damped springs give way under a normal that moves, where no branch tells when.
    pub(in crate::run) fn longest(&self, state: &State) -> f64 {
        let Some(Branches { part, .. }) = self.branches.as_ref().filter(|_| self.is_damped) else {
            return f64::INFINITY;
        };
        let eq = self.plain(state);
        let struck =
            self.model.contacts.iter().filter(|contact| contact.is_damped() && !contact.is_constant());
        let longest = struck.filter_map(|contact| {
            let motion = eq.motion(contact, state.t, |i| state.y[i]);
            let (law, speed, way) = (&contact.interface, motion.du.abs(), contact.natural.displacement);
            if law.damping() * speed <= STRONG * way {
                return None;
            }
            let all = law.viscosity(law.stick_stiffness(motion.d));
            let holds = contact.viscosity(eq.law(contact.place), &motion) > HELD * all;
            holds.then(|| part * way / speed)
        });
        longest.fold(f64::INFINITY, f64::min)
    }

    /// When the damping of a contact will give way after the step to time t in y, s, at its speed there; none where none is to.
    pub(in crate::run) fn gives_way_after(&mut self, state: &State, (t, y): (f64, &[f64])) -> Option<f64> {
        if !self.is_damped {
            return None;
        }
        self.move_contacts(state, t, y);
        let branches = self.branches.as_ref()?;
        let ends = state.modes.iter().enumerate().filter_map(|(c, mode)| {
            let Mode::Slip(branch) = mode else { return None };
            let speed = branch.sense() * self.motions[c].du;
            let left = branches.left(c, branch, &self.motions[c]);
            (left >= 0.0 && speed > 0.0 && self.gives_way(c, branch)).then(|| t + left / speed)
        });
        ends.reduce(f64::min)
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
                    None if !turned && branches.left(c, branch, motion) >= 0.0 => continue,
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

    /// Where a run sets out: contacts that move take their first branches.
    pub(super) fn branch_at_start(&mut self, state: &mut State) {
        if self.branches.is_none() {
            return;
        }
        self.measure(state);
        for (c, motion) in self.motions.iter().enumerate() {
            state.modes[c] =
                next_mode(&self.model.contacts[c], &state.memories[c], motion, (motion.du.signum(), 0.0));
            if let Mode::Slip(branch) = &state.modes[c] {
                self.senses[c] = branch.sense();
            }
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
            let turns = match &state.modes[c] {
                Mode::Slip(branch) => branch.sense() * motion.du < 0.0,
                // At rest until now.
                _ => {
                    state.memories[c].branching().is_some()
                        && keeps_to_branches(&self.model.contacts[c], motion)
                }
            };
            if let (true, Some(branches)) = (turns, &mut self.branches) {
                branches.ended.push((c, motion.du.signum()));
                self.ledger.push(c, t, Segment::Straight(motion.apex()));
            }
        }
        self.ledger.commit((self.model, self.layout), t, state)?;
        self.ledger.tell(record);
        self.branch(state);
        self.notice_turns(state, record);
        Ok(())
    }

    /// The motions of the contacts where the state is.
    fn measure(&mut self, state: &State) {
        let mut motions = std::mem::take(&mut self.motions);
        let eq = self.plain(state);
        motions.clear();
        motions.extend(self.model.contacts.iter().map(|contact| eq.motion(contact, state.t, |i| state.y[i])));
        self.motions = motions;
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
        Some(branching) if keeps_to_branches(contact, motion) => {
            let slack = if left < NEAR * contact.natural.displacement { left.max(0.0) } else { 0.0 };
            Mode::Slip(branching.branch(&contact.interface, sense, slack))
        }
        _ => Mode::Whole { sense: 0.0 },
    }
}

/// Whether a contact that moves so keeps to branches of its law.
fn keeps_to_branches(contact: &Contact, motion: &Motion) -> bool {
    contact.is_constant() && !contact.inert && motion.d > 0.0 && motion.du != 0.0
}
