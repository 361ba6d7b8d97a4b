//! Run that its caller advances.

use super::advance::Advance;
use super::fixed::{Fixed, Frame, Moved};
use super::horizon::Goal;
use super::located::located;
use super::output::Opening;
use crate::method::{self, Method, SceneTraits};
use crate::record::{Entry, Record, Wants};
use crate::waveform::Command;
use crate::{CommandError, InputError, Model, Plan, RunError, State, Stepper};
use stickslip_stepper::{Nystrom4, Rk4, Verlet};

/// Run that its caller advances. A `Run` owns the state and the workspace and borrows the model.
///
/// Between two calls, [`Run::state`] contains everything that the future of the run depends on. A run created from a copy of this state, in
/// this process or another, continues with the same bits.
///
/// After the first call nothing is allocated, unless a slip memory becomes deeper than before.
pub struct Run<'m> {
    model: &'m Model,
    plan: Plan,
    state: State,
    way: Box<dyn Advance + 'm>,
    /// Whether an earlier run has written the output up to the state.
    resumed: bool,
    /// Whether the first call has been made.
    begun: bool,
}

/// Returns the workspace of a run with the stepper of its plan.
fn advance<'m>(model: &'m Model, plan: &Plan) -> Result<Box<dyn Advance + 'm>, RunError> {
    let one = |step| Frame { length: step, steps: 1.0 };
    Ok(match model.effective(plan.stepper) {
        Stepper::Event { tolerance } => located(model, plan, tolerance),
        Stepper::Verlet { step } => Box::new(Fixed::<Verlet>::new(model, plan, one(step), Moved::All)?),
        Stepper::Rk4 { step } => Box::new(Fixed::<Rk4>::new(model, plan, one(step), Moved::All)?),
        Stepper::Frames { length, accuracy } => {
            let frame = Frame { length, steps: model.substeps(length, accuracy) };
            match method::stepping(&SceneTraits::of(model)).0 {
                Method::Nystrom => {
                    Box::new(Fixed::<Nystrom4>::new(model, plan, frame, Moved::WithoutDamping)?)
                }
                _ => Box::new(Fixed::<Rk4>::new(model, plan, frame, Moved::All)?),
            }
        }
        Stepper::Dopri5 { .. } => return Err(RunError::NotHeld { stepper: plan.stepper.name() }),
    })
}

/// Starts or continues a run from a state.
fn set_out(
    way: &mut dyn Advance,
    model: &Model,
    state: &mut State,
    opening: Opening,
    record: &mut dyn Record,
) {
    // A copied or restored memory has no spare capacity. Each stepper limits the depth itself.
    for (memory, contact) in state.memories.iter_mut().zip(&model.contacts) {
        memory.bound(&contact.interface, way.remembers());
        memory.make_room();
    }
    way.set_out(state, opening, record);
}

/// Advances a state to the end of its plan.
pub(super) fn to_the_end(
    model: &Model,
    plan: &Plan,
    state: &mut State,
    record: &mut dyn Record,
) -> Result<(), RunError> {
    let mut way = advance(model, plan)?;
    state.check_inputs(model, plan.duration)?;
    set_out(&mut *way, model, state, Opening::Row, record);
    let outcome = way.go(state, Goal::End(plan.duration), record);
    if outcome.is_err() {
        way.write_now(state, record);
    }
    way.settle_books(state);
    outcome
}

/// Record that keeps the first row of a run.
struct First<'r>(&'r mut Vec<f64>);

impl Record for First<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Row(values) = entry {
            self.0.clear();
            self.0.extend_from_slice(values);
        }
    }

    fn wants(&self) -> Wants {
        Wants::no_events()
    }
}

impl<'m> Run<'m> {
    /// Creates a run that begins at a state.
    ///
    /// The end of the plan has an effect in [`Self::approach`] and [`Self::finish`] only.
    ///
    /// # Errors
    ///
    /// Returns [`RunError::Unstable`] for a fixed step beyond the stability limit. Returns [`RunError::NotHeld`] for
    /// the stepper [`Stepper::Dopri5`].
    pub fn new(model: &'m Model, plan: &Plan, state: State) -> Result<Self, RunError> {
        let way = advance(model, plan)?;
        Ok(Self { model, plan: *plan, state, way, resumed: false, begun: false })
    }

    /// Creates a run that continues an earlier one.
    ///
    /// Rows and snapshots ([`Entry::Look`](crate::Entry::Look)) up to the time of the state are not written again. A run created by
    /// [`Self::new`] continues with the same bits, but begins with a row.
    ///
    /// # Errors
    ///
    /// The errors of [`Self::new`].
    pub fn resume(model: &'m Model, plan: &Plan, state: State) -> Result<Self, RunError> {
        Ok(Self { resumed: true, ..Self::new(model, plan, state)? })
    }

    /// Advances the run to time `until`, s. Rows are written at the interval of the plan; the end of an advance adds no row.
    ///
    /// Many short advances give the same result as a long one. The bits are equal where the motion has a closed form (a single slider on
    /// paraboloids, straight waveforms). Otherwise results agree within the tolerance, because the last step of each advance is cut.
    ///
    /// A plan without rows (`every: None`) and the record `&mut ()`, which discards output, give the fastest run.
    ///
    /// # Errors
    ///
    /// Fails if `until` is before the current time or an input has no value up to `until`. Fails with other
    /// [`RunError`]s if the run stops. The state then contains the results before the error.
    pub fn advance(&mut self, until: f64, record: &mut dyn Record) -> Result<(), RunError> {
        let t = self.state.t;
        // NaN is refused, too.
        if until.is_nan() || until < t || until == f64::INFINITY {
            return Err(RunError::Backwards { t, until });
        }
        self.go(Goal::Moment(until), Opening::Grid, until, record)
    }

    /// Advances the run by whole steps and stops before the step that would reach the end of the plan.
    /// The output does not depend on the end of the plan. A run resumed here may have another end.
    ///
    /// # Errors
    ///
    /// Fails with a [`RunError`] if the run stops. After [`RunError::Interrupted`], another call continues the run with the same bits.
    pub fn approach(&mut self, record: &mut dyn Record) -> Result<(), RunError> {
        let end = self.plan.duration;
        self.go(Goal::BeforeEnd(end), Opening::Row, end, record)
    }

    /// Advances the run to the end of the plan and writes the last row. After an error, the last row contains the state reached.
    ///
    /// # Errors
    ///
    /// Fails with a [`RunError`] if the run stops.
    pub fn finish(&mut self, record: &mut dyn Record) -> Result<(), RunError> {
        let end = self.plan.duration;
        let outcome = self.go(Goal::End(end), Opening::Row, end, record);
        if outcome.is_err() {
            self.stop(record);
        } else {
            self.way.settle_books(&mut self.state);
        }
        outcome
    }

    /// Writes the current state as the last row and commits the slip memories. Does nothing before the first call.
    pub fn stop(&mut self, record: &mut dyn Record) {
        if self.begun {
            self.way.write_now(&self.state, record);
            self.way.settle_books(&mut self.state);
        }
    }

    /// Holds the input at index `input` of the waveforms at a value from the current time on.
    ///
    /// Waveforms are numbered in the order of the scenario file. A different value is a jump. Contacts of the moved
    /// body then follow a straight path in zero time, and the work of the jump counts as input work.
    ///
    /// A linear input is held at its current value by [`Self::lead`].
    ///
    /// # Errors
    ///
    /// Fails if the waveform is not a held input or the value is out of its range.
    pub fn hold(&mut self, input: usize, value: f64) -> Result<(), InputError> {
        self.state.hold(self.model, input, value)
    }

    /// Moves the linear input at index `input` of the waveforms on a straight line to `value` at time `until`, s.
    ///
    /// The line begins where the last supplied piece ends, or at the current value. One piece may be supplied in advance.
    ///
    /// Before its first piece, an input keeps its initial value. After its last piece it has no value, and the run cannot advance.
    ///
    /// # Errors
    ///
    /// Fails if the waveform is not a linear input, the value is out of range, or `until` is not after the previous
    /// piece. Fails if a piece has already been supplied in advance.
    pub fn lead(&mut self, input: usize, until: f64, value: f64) -> Result<(), InputError> {
        self.state.lead(self.model, input, (until, value))
    }

    /// Sets the command of the generator at index `generator` of the waveforms.
    ///
    /// The command applies to cycles that begin at the current time or later. The current cycle is completed unchanged;
    /// an idle generator starts at once. [`State::generated`] returns the activity and the number of remaining steps.
    ///
    /// # Errors
    ///
    /// Fails if the waveform is not a generator, or if stroke or frequency is out of range.
    pub fn command(&mut self, generator: usize, command: Command) -> Result<(), CommandError> {
        self.state.command(self.model, generator, command)
    }

    /// Returns the current state. Slip memories of contacts are not updated until their next event.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Returns the number of reversals that this run has added to or removed from slip memories.
    ///
    /// This number and the steps in [`State::counts`] measure the work of a frame.
    pub fn touched(&self) -> u64 {
        self.way.touched()
    }

    /// Returns the current state and drops the run.
    pub fn into_state(self) -> State {
        self.state
    }

    /// Writes the values of all channels at the current state into `row`.
    ///
    /// [`Model::channels`] has the names and units in the same order. Before the first advance, the values are those of
    /// the first row of the run.
    pub fn row(&self, row: &mut Vec<f64>) {
        if self.begun || self.resumed {
            return self.state.write_row(self.model, row);
        }
        let mut state = self.state.clone();
        if let Ok(mut way) = advance(self.model, &self.plan) {
            // The start of a run chooses contact laws, which the first row contains.
            row.clear();
            set_out(&mut *way, self.model, &mut state, Opening::Row, &mut First(row));
            if row.is_empty() {
                way.write_now(&state, &mut First(row));
            }
        }
    }

    fn go(
        &mut self,
        goal: Goal,
        opening: Opening,
        end: f64,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        self.state.check_inputs(self.model, end)?;
        if !self.begun {
            let opening = if self.resumed { Opening::Resumed } else { opening };
            set_out(&mut *self.way, self.model, &mut self.state, opening, record);
            self.begun = true;
        }
        let outcome = self.way.go(&mut self.state, goal, record);
        self.way.hand_over(record);
        outcome
    }
}
