//! A run that its caller holds.

use super::fixed::{Fixed, Frame, Moved};
use super::horizon::Goal;
use super::located::LocatedRun;
use super::output::Opening;
use crate::method::{self, Method, SceneTraits};
use crate::record::Record;
use crate::waveform::Command;
use crate::{CommandError, InputError, Model, Plan, RunError, State, Stepper};
use stickslip_stepper::{Nystrom4, Rk4, Verlet};

/// A run that its caller moves on: it owns the state and the workspace, and borrows the model.
///
/// Between two calls it stands between two steps, and [`Run::state`] is all that its future depends on: a run made from a
/// copy of it, in this process or another, goes on to the same bits. After the first call nothing is allocated, but by a
/// memory that grows deeper than it ever was.
pub struct Run<'m> {
    model: &'m Model,
    plan: Plan,
    state: State,
    way: Way<'m>,
    /// Whether an earlier run has written what lies up to the state.
    resumed: bool,
    /// Whether the first call has been made.
    begun: bool,
}

/// The workspace of a run, by its stepper.
enum Way<'m> {
    Located(LocatedRun<'m>),
    Verlet(Box<Fixed<'m, Verlet>>),
    Rk4(Box<Fixed<'m, Rk4>>),
    Nystrom(Box<Fixed<'m, Nystrom4>>),
}

impl<'m> Way<'m> {
    fn new(model: &'m Model, plan: &Plan) -> Result<Self, RunError> {
        let one = |step| Frame { length: step, steps: 1.0 };
        Ok(match model.effective(plan.stepper) {
            Stepper::Event { tolerance } => Self::Located(LocatedRun::new(model, plan, tolerance)),
            Stepper::Verlet { step } => {
                Self::Verlet(Box::new(Fixed::new(model, plan, one(step), Moved::All)?))
            }
            Stepper::Rk4 { step } => Self::Rk4(Box::new(Fixed::new(model, plan, one(step), Moved::All)?)),
            Stepper::Frames { length, accuracy } => {
                let frame = Frame { length, steps: model.substeps(length, accuracy) };
                match method::stepping(&SceneTraits::of(model)).0 {
                    Method::Nystrom => {
                        Self::Nystrom(Box::new(Fixed::new(model, plan, frame, Moved::WithoutDamping)?))
                    }
                    _ => Self::Rk4(Box::new(Fixed::new(model, plan, frame, Moved::All)?)),
                }
            }
            Stepper::Dopri5 { .. } => return Err(RunError::NotHeld { stepper: plan.stepper.name() }),
        })
    }
}

/// One method of whichever run it is.
macro_rules! each {
    ($way:expr, $run:ident => $call:expr) => {
        match $way {
            Way::Located($run) => $call,
            Way::Verlet($run) => $call,
            Way::Rk4($run) => $call,
            Way::Nystrom($run) => $call,
        }
    };
}

/// Moves a state to the end of its plan.
pub(super) fn to_the_end(
    model: &Model,
    plan: &Plan,
    state: &mut State,
    record: &mut dyn Record,
) -> Result<(), RunError> {
    let mut way = Way::new(model, plan)?;
    state.check_inputs(model, plan.duration)?;
    way.set_out(model, state, Opening::Row, record);
    let outcome = way.go(state, Goal::End(plan.duration), record);
    if outcome.is_err() {
        way.write_now(state, record);
    }
    way.settle(state);
    outcome
}

impl Way<'_> {
    fn set_out(&mut self, model: &Model, state: &mut State, opening: Opening, record: &mut dyn Record) {
        // Of a state that was copied or restored; others have it. Bounded as deep as this stepper wants it, whoever came before.
        let most = each!(self, run => run.remembers());
        for (memory, contact) in state.memories.iter_mut().zip(&model.contacts) {
            memory.bound(&contact.interface, most);
            memory.make_room();
        }
        each!(self, run => run.set_out(state, opening, record));
    }

    fn go(&mut self, state: &mut State, goal: Goal, record: &mut dyn Record) -> Result<(), RunError> {
        each!(self, run => run.go(state, goal, record))
    }

    fn write_now(&mut self, state: &mut State, record: &mut dyn Record) {
        each!(self, run => run.write_now(state, record));
    }

    /// The range of a body since its last mark is told: nobody remembers it beyond this call.
    fn hand_over(&mut self, record: &mut dyn Record) {
        each!(self, run => run.hand_over(record));
    }

    fn touched(&self) -> u64 {
        each!(self, run => run.touched())
    }

    /// Memories come to where the state is.
    fn settle(&mut self, state: &mut State) {
        each!(self, run => run.settle_books(state));
    }
}

/// Keeps the row that a run sets out with.
struct First<'r>(&'r mut Vec<f64>);

impl Record for First<'_> {
    fn row(&mut self, values: &[f64]) {
        self.0.clear();
        self.0.extend_from_slice(values);
    }

    fn event(&mut self, _: &crate::Event, _: &[f64]) {}

    fn wants_events(&self) -> bool {
        false
    }
}

impl<'m> Run<'m> {
    /// A run that begins with a state.
    ///
    /// Of the plan its stepper, its limits and the interval of its rows count; its end only for [`Self::approach`] and
    /// [`Self::finish`].
    ///
    /// # Errors
    ///
    /// A fixed step too long for the scene, or the stepper of another library, whose state nobody can hold.
    pub fn new(model: &'m Model, plan: &Plan, state: State) -> Result<Self, RunError> {
        let way = Way::new(model, plan)?;
        Ok(Self { model, plan: *plan, state, way, resumed: false, begun: false })
    }

    /// A run that goes on where an earlier one stood: rows and [looks](Record::look) up to there have been written, and are not
    /// again. By [`Self::new`] the run would go on to the same bits, and begin with a row.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn resume(model: &'m Model, plan: &Plan, state: State) -> Result<Self, RunError> {
        Ok(Self { resumed: true, ..Self::new(model, plan, state)? })
    }

    /// Moves on to time `until`, s, and stands there. Rows are written where the plan has them, none because of the stop.
    ///
    /// Many short advances come to what one long one does: to the bit where motion has a closed form (a single slider on
    /// paraboloids, straight waveforms), elsewhere within the tolerance, since a step that would go further is cut. A plan
    /// without rows (`every: None`) and `&mut ()` for a record cost least.
    ///
    /// # Errors
    ///
    /// As a run; and a time before the present one, or an input that has no value up to there. What was computed before is in
    /// the state.
    pub fn advance(&mut self, until: f64, record: &mut dyn Record) -> Result<(), RunError> {
        let t = self.state.t;
        // Not a number is no time to go on to, either.
        if until.is_nan() || until < t || until == f64::INFINITY {
            return Err(RunError::Backwards { t, until });
        }
        self.go(Goal::Moment(until), Opening::Grid, until, record)
    }

    /// Goes on as far as whole steps do before the end of the plan, and stands before the one that would reach it.
    ///
    /// What is written up to there does not depend on when the run ends; a run resumed from there may end at another time.
    ///
    /// # Errors
    ///
    /// As a run. After [`RunError::Interrupted`] it can be called again and goes on as if nobody had asked.
    pub fn approach(&mut self, record: &mut dyn Record) -> Result<(), RunError> {
        let end = self.plan.duration;
        self.go(Goal::BeforeEnd(end), Opening::Row, end, record)
    }

    /// Goes on to the end of the plan and writes the last row, or the row of where the run stopped.
    ///
    /// # Errors
    ///
    /// As a run.
    pub fn finish(&mut self, record: &mut dyn Record) -> Result<(), RunError> {
        let end = self.plan.duration;
        let outcome = self.go(Goal::End(end), Opening::Row, end, record);
        if outcome.is_err() {
            self.stop(record);
        } else {
            self.way.settle(&mut self.state);
        }
        outcome
    }

    /// Writes the row of where the run stands, which ends it here; nothing before the first call.
    pub fn stop(&mut self, record: &mut dyn Record) {
        if self.begun {
            self.way.write_now(&mut self.state, record);
            self.way.settle(&mut self.state);
        }
    }

    /// Holds an input, the waveform at place `input` of the scene, at a value from the present time on: a jump where the
    /// value is another one. Waveforms have their places in the order of the scenario file.
    ///
    /// A contact whose body jumps moves along its path straight and in no time, and the work of that is booked. For inputs
    /// that are held; one that is linear stays where it is by [`Self::lead`] to the value that it has.
    ///
    /// # Errors
    ///
    /// No input that is held, or a value out of its range.
    pub fn hold(&mut self, input: usize, value: f64) -> Result<(), InputError> {
        self.state.hold(self.model, input, value)
    }

    /// Leads an input, the waveform at place `input` of the scene, straight to `value` at time `until`, s, from where its last
    /// piece ends, or from where it is. One piece may be supplied ahead of the present one. Before the first piece an input
    /// holds its initial value, for as long as the caller likes; after one it has no value, and the run does not go there.
    ///
    /// # Errors
    ///
    /// No input that is linear, a value out of its range, a time that is not after the piece before, or a piece too many.
    pub fn lead(&mut self, input: usize, until: f64, value: f64) -> Result<(), InputError> {
        self.state.lead(self.model, input, (until, value))
    }

    /// Commands a generator, the waveform at place `generator` of the scene: what its cycles are that begin at the present time or
    /// later. A cycle that is under way goes on to its end as it began; a generator that rests begins at once.
    ///
    /// [`State::generated`] tells what it does and how many steps are left.
    ///
    /// # Errors
    ///
    /// No generator, a stroke or a frequency out of its range.
    pub fn command(&mut self, generator: usize, command: Command) -> Result<(), CommandError> {
        self.state.command(self.model, generator, command)
    }

    /// Where the run stands, and all that its future depends on. Memories of contacts may wait for the next event, where one
    /// move leads them further.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Turning points of contacts that this run has made or given up: with the steps of [`State::counts`] what a frame's work
    /// is counted in.
    pub fn touched(&self) -> u64 {
        self.way.touched()
    }

    /// The same, given away.
    pub fn into_state(self) -> State {
        self.state
    }

    /// The values of all channels where the run stands, into the room of `row`; their names and units are those of
    /// [`Model::channels`], in that order. Before the first advance it is the first row that the run will write.
    pub fn row(&self, row: &mut Vec<f64>) {
        if self.begun || self.resumed {
            return self.state.write_row(self.model, row);
        }
        let mut state = self.state.clone();
        if let Ok(mut way) = Way::new(self.model, &self.plan) {
            // As its first row will be: a run that sets out works out what a start leaves open.
            row.clear();
            way.set_out(self.model, &mut state, Opening::Row, &mut First(row));
            if row.is_empty() {
                way.write_now(&mut state, &mut First(row));
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
            self.way.set_out(self.model, &mut self.state, opening, record);
            self.begun = true;
        }
        let outcome = self.way.go(&mut self.state, goal, record);
        self.way.hand_over(record);
        outcome
    }
}
