//! Contacts that keep to one branch of their force law over several steps; used by the `frames` stepper.
//!
//! On a branch, slip passes along one linear piece of the slip memory, and the force law is smooth. At a constant indentation, one memory
//! piece lasts for many steps. One straight path to the end of the piece is equivalent to many short ones. The slip memory is therefore
//! committed only where a branch ends: at the end of its memory piece or at a reversal of the motion.
//!
//! At a branch end the step is cut, at the time given by the cubic interpolant of the step. A cut step has at least one eighth of the full
//! length, which bounds the work. A further branch end within that eighth causes an error like a kink.
//!
//! A contact under a varying normal force uses no branch. Such a contact follows the full force law, with one straight path per step. Steps
//! are cut where such a contact touches or separates, and where a slip edge starts or stops. Without these cuts, the slip memory would
//! store a reversal with an error of second order in the step.

use super::way::{Way, end_of, kink};
use super::{Chords, is_at_rest};
use crate::Model;
use crate::RunError;
use crate::contact::{Contact, Motion};
use crate::interval::Interval;
use crate::method::Method;
use crate::record::{Record, wants_events};
use crate::state::State;
use stickslip_contact::{Apex, Branch, Law, Memory, Segment};

/// Largest number of reversals that a slip memory keeps.
pub(super) const KNOTS: usize = 256;
/// Largest number of reversals under a varying normal force, where a growing contact adds one per step.
pub(super) const GROWING_KNOTS: usize = 1024;

/// Largest distance of two branch ends that count as simultaneous, as a fraction of the step.
const TOGETHER: f64 = 1e-6;
/// Largest remaining length of a memory piece at which its end counts as reached, in u_c.
const NEAR: f64 = 1e-6;

/// Closed forms and branch ends of the contacts between two changes of a branch.
pub(in crate::run) struct Branches<'a> {
    pub(super) interval: Interval<'a>,
    /// Whether `interval` belongs to the current state.
    pub(super) current: bool,
    /// Contacts whose branches end with the step, and the senses of their next branches.
    pub(super) ended: Vec<(usize, f64)>,
    /// Contacts whose branches end at the cut of the step, even if rounding contradicts, and the senses of their next branches.
    due: Vec<(usize, f64)>,
}

impl<'a> Branches<'a> {
    /// Creates the branches of a model.
    pub(super) fn of(model: &'a Model) -> Self {
        let room = || Vec::with_capacity(model.contacts.len());
        Self { interval: Interval::without_growth(model), current: false, ended: room(), due: room() }
    }

    /// Returns the remaining length of the memory piece of contact `c`, m. [`Chords::glides`] uses the same value, bit by bit.
    fn left(&self, c: usize, branch: &Branch, motion: &Motion) -> f64 {
        match self.interval.closed_form(c) {
            Some(closed) => closed.margin(motion.u),
            None => branch.margin(motion.d, motion.u),
        }
    }

    /// Whether every contact of the model is on a branch with a closed-form force.
    #[inline]
    fn holds_all(&self, model: &Model) -> bool {
        self.current && self.interval.closed.len() == model.contacts.len()
    }
}

impl<'a> Chords<'a> {
    /// Computes the constants of the time interval after a branch has changed.
    ///
    /// The contact motions at the start of the step are computed with the formulas used at its end. A continued run
    /// thus gives the same bits.
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

    /// Computes the contact motions at time t with components y.
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
            Some(branches) if branches.current => {
                let (eq, interval) = (self.equations(state), &branches.interval);
                let contacts = self.model.contacts.iter();
                motions.extend(contacts.map(|contact| interval.motion(&eq, contact.place, (t, y))));
            }
            _ => {
                let eq = self.equations(state);
                motions.extend(self.model.contacts.iter().map(|contact| eq.motion(contact, t, |i| y[i])));
            }
        }
        self.motions = motions;
    }

    /// Accepts the step to time t with components y if all contacts keep to their branches, so that no event happens.
    ///
    /// Returns whether the step was accepted. No slip memory changes.
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
        if t > self.horizon.end || wants_events(record) != self.watched {
            return false;
        }
        self.move_contacts(state, t, y);
        let closed = self.branches.iter().flat_map(|branches| &branches.interval.closed);
        // A motion that is NaN keeps to no branch.
        if !closed.zip(&self.motions).all(|(closed, motion)| closed.keeps(motion)) {
            return false;
        }
        self.write(state, t, (t, y), record);
        std::mem::swap(&mut self.before, &mut self.motions);
        state.y.copy_from_slice(y);
        state.t = t;
        state.counts.steps += 1;
        state.tally.step(Method::AskedFor);
        true
    }

    /// Lets every contact whose branch ends in the step to time t with components y follow the full force law. Returns whether there is any.
    ///
    /// Slip memories are committed to the start of the step, which must be repeated.
    pub(in crate::run) fn leaves(&mut self, state: &mut State, (t, y): (f64, &[f64])) -> bool {
        if self.cuts {
            return false;
        }
        self.move_contacts(state, t, y);
        let Some(branches) = &mut self.branches else { return false };
        branches.due.clear();
        for (c, motion) in self.motions.iter().enumerate() {
            let Some(branch) = state.modes[c].branch() else { continue };
            if !(branches.left(c, branch, motion) >= 0.0 && branch.sense() * motion.du >= 0.0) {
                branches.due.push((c, 0.0));
            }
        }
        if branches.due.is_empty() {
            return false;
        }
        self.settle(state);
        let due = self.branches.iter_mut().flat_map(|branches| {
            branches.current = false;
            branches.due.drain(..)
        });
        due.for_each(|(c, _)| state.modes[c] = Law::whole(0.0));
        true
    }

    /// Returns the first branch end in the step to time t with components y, s.
    ///
    /// For a contact under a varying normal force, a kink of its force law counts as a branch end. If no branch ends, the branch ends
    /// stored before stay unchanged.
    pub(in crate::run) fn first_end(&mut self, state: &State, (t, y): (f64, &[f64])) -> Option<f64> {
        self.branches.as_ref().filter(|_| self.cuts)?;
        self.move_contacts(state, t, y);
        let duration = t - state.t;
        let Some(branches) = &mut self.branches else { return None };
        let mut first = f64::INFINITY;
        for (c, (from, to)) in self.before.iter().zip(&self.motions).enumerate() {
            let (contact, way) = (&self.model.contacts[c], Way { from, to, duration });
            let end = match state.modes[c].branch() {
                Some(branch) => end_of(branch, branches.left(c, branch, to), way),
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

    /// Discards the branch ends found for a cut. The end of the step then determines them.
    pub(in crate::run) fn let_end_decide(&mut self) {
        if let Some(branches) = &mut self.branches {
            branches.due.clear();
        }
    }

    /// Collects the paths of a step of `duration` (s).
    ///
    /// Contacts that keep to their branch have no path.
    pub(super) fn write_down(&mut self, state: &State, duration: f64) {
        self.ledger.clear();
        let Some(branches) = &mut self.branches else {
            for (c, motion) in self.motions.iter().enumerate() {
                self.ledger.push(c, Segment::Straight(motion.apex()));
            }
            return;
        };
        branches.ended.clear();
        for (c, motion) in self.motions.iter().enumerate() {
            let mut sense = motion.du.signum();
            if let Some(branch) = state.modes[c].branch() {
                let due = branches.due.iter().find(|(due, _)| *due == c);
                let turned = branch.sense() * motion.du < 0.0;
                match due {
                    Some((_, next)) => sense = *next,
                    None if !turned && branches.left(c, branch, motion) >= 0.0 => continue,
                    None if turned => {
                        let way = Way { from: &self.before[c], to: motion, duration };
                        if let Some(share) = way.turn() {
                            let extremum = Apex { d: motion.d, u: way.at(share) };
                            self.ledger.push(c, Segment::Straight(extremum));
                        }
                    }
                    None => sense = branch.sense(),
                }
            }
            branches.ended.push((c, sense));
            self.ledger.push(c, Segment::Straight(motion.apex()));
        }
    }

    /// Sets the next branch of every contact whose branch has ended. Slip memories must be committed to the current state.
    #[inline]
    pub(super) fn branch(&mut self, state: &mut State) {
        let Some(branches) = &mut self.branches else { return };
        for &(c, sense) in &branches.ended {
            let Motion { d, u, .. } = self.motions[c];
            let left = state.modes[c].branch().map_or(0.0, |branch| branch.margin(d, u));
            let next =
                next_mode(&self.model.contacts[c], &state.memories[c], &self.motions[c], (sense, left));
            // The interval stays valid for a contact that keeps the full force law.
            branches.current &= state.modes[c].is_whole() && next.is_whole();
            state.modes[c] = next;
        }
    }

    /// Sets the first branch of every moving contact at the start of a run.
    pub(super) fn branch_at_start(&mut self, state: &mut State) {
        if self.branches.is_none() {
            return;
        }
        self.measure(state);
        for (c, motion) in self.motions.iter().enumerate() {
            state.modes[c] =
                next_mode(&self.model.contacts[c], &state.memories[c], motion, (motion.du.signum(), 0.0));
            if let Some(branch) = state.modes[c].branch() {
                self.senses[c] = branch.sense();
            }
        }
    }

    /// Commits the contacts that reverse at a corner and sets their next branches.
    ///
    /// Fails if a slip memory refuses its path.
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
            let turns = match state.modes[c].branch() {
                Some(branch) => branch.sense() * motion.du < 0.0,
                // At rest so far.
                None => {
                    state.memories[c].branching().is_some()
                        && keeps_to_branches(&self.model.contacts[c], motion)
                }
            };
            if let (true, Some(branches)) = (turns, &mut self.branches) {
                branches.ended.push((c, motion.du.signum()));
                self.ledger.push(c, Segment::Straight(motion.apex()));
            }
        }
        self.ledger.commit((self.model, self.layout), t, state)?;
        self.ledger.tell(record);
        self.branch(state);
        self.notice_turns(state, record);
        Ok(())
    }

    /// Computes the contact motions at the current state.
    fn measure(&mut self, state: &State) {
        let mut motions = std::mem::take(&mut self.motions);
        let eq = self.plain(state);
        motions.clear();
        motions.extend(self.model.contacts.iter().map(|contact| eq.motion(contact, state.t, |i| state.y[i])));
        self.motions = motions;
    }

    /// Commits every slip memory to the current state.
    ///
    /// The commit cannot fail, because the force law on the branch already covers this path.
    pub(in crate::run) fn settle(&mut self, state: &mut State) {
        if self.branches.is_none() {
            return;
        }
        self.measure(state);
        self.ledger.clear();
        for (c, motion) in self.motions.iter().enumerate() {
            if state.modes[c].branch().is_some() {
                self.ledger.push(c, Segment::Straight(motion.apex()));
            }
        }
        let _ = self.ledger.commit((self.model, self.layout), state.t, state);
    }
}

/// Returns the branch of a contact at constant indentation for the direction `sense`, otherwise the full force law.
///
/// `left` is the remaining length of the previous memory piece, m. A remaining length below [`NEAR`] is an error of the
/// cubic and counts as used up.
fn next_mode(contact: &Contact, memory: &Memory, motion: &Motion, (sense, left): (f64, f64)) -> Law {
    match memory.branching() {
        Some(branching) if keeps_to_branches(contact, motion) => {
            let slack = if left < NEAR * contact.natural.displacement { left.max(0.0) } else { 0.0 };
            Law::slip(branching.branch(memory.law(&contact.interface), sense, slack))
        }
        _ => Law::whole(0.0),
    }
}

/// Whether a contact with this motion can keep to a branch: sliding, closed, at constant indentation, and with one coefficient.
fn keeps_to_branches(contact: &Contact, motion: &Motion) -> bool {
    let jumps = contact.interface.kinetic().is_some();
    contact.is_constant() && !contact.inert && !jumps && motion.d > 0.0 && !is_at_rest(contact, motion)
}
