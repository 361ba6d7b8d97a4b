//! Initial state of a run: given by the user, or the static equilibrium at t = 0.
//!
//! With friction the equilibrium is not unique. The loads are increased in proportion, and the slip memories of contacts record this path.
//! The energy balance begins at the equilibrium. Before, a millionth of the loads sets down bodies that are above their support.

mod balance;
mod balanced;
mod elimination;
mod statics;

use crate::contact::Contact;
use crate::equations::Equations;
use crate::model::{Free, Model};
use crate::record;
use crate::scene::Axis;
use crate::state::State;
use crate::{Accuracy, Field, Part as Place, Plan, SceneError, SceneFault, Stepper, Waveform};
use balance::{Balance, NEWTON, Search};
use nalgebra::DVector;
use statics::Answer;
use std::cell::RefCell;
use std::rc::Rc;
use stickslip_contact::{Apex, Memory, Segment};

/// Number of load increments if several coordinates share the loads.
const PARTS: u32 = 64;
/// Largest number of free coordinates for an equilibrium; the cost grows with the cube of their number.
const MOST: usize = 200;
/// Initial pseudo-time of a search without a known nearby equilibrium.
const TAU: f64 = 1.0;
/// Fraction of the loads that sets bodies down on their supports, so small that this path hardly loads the contacts.
const LANDING: f64 = 1e-6;
/// Slip in u_c beyond which a second equilibrium is sought, and the ratio of distances below which this second one is chosen.
const FAR: f64 = 100.0;
const NEARER: f64 = 0.5;

impl Model {
    /// Returns the initial state of a run, at t = 0, for the settings of a [`Plan`].
    ///
    /// # Errors
    ///
    /// [`SceneError`]: a number of the [`Plan`] is out of range, or there is no static equilibrium. The same error is returned if the
    /// stepper cannot follow jumps of waveforms, or its fixed step is unstable.
    pub fn start(&self, plan: &Plan) -> Result<State, SceneError> {
        let mut state = State::blank();
        self.start_in(plan, &mut state, &mut Vec::new())?;
        Ok(state)
    }

    /// Computes the initial state in existing storage; `row` is scratch memory. After an error the state is undefined.
    pub(crate) fn start_in(
        &self,
        plan: &Plan,
        state: &mut State,
        row: &mut Vec<f64>,
    ) -> Result<(), SceneError> {
        plan.check()?;
        // After a jump the motion of a free mass depends on a step ending there.
        let jumps = !self.free.is_empty() && self.waveforms.iter().any(Waveform::has_jumps);
        let follows =
            plan.stepper.locates_events() || plan.stepper.follows_jumps() && self.balanced.is_empty();
        if jumps && !follows {
            return Err(SceneFault::UnlocatedJump.of(Place::Run, Field::Stepper));
        }
        self.check_step(plan.stepper)?;
        self.begin(state, row)
    }

    /// Computes the initial state for a valid [`Plan`].
    fn begin(&self, state: &mut State, row: &mut Vec<f64>) -> Result<(), SceneError> {
        self.put_at_rest(state);
        if self.equilibrium && !self.free.is_empty() {
            // Clones need less memory than the run, which makes the search faster.
            state.memories = state.memories.clone();
            Settling::new(self, state).settle(state)?;
            state.memories.iter_mut().for_each(Memory::make_room);
        }
        self.balance_first(state)?;
        self.open_books(state, row);
        Ok(())
    }

    /// Starts the energy balance at a state: supplied and dissipated energy are set to zero.
    pub(crate) fn open_books(&self, state: &mut State, row: &mut Vec<f64>) {
        let layout = state.layout(self);
        (state.y[layout.input()], state.y[layout.damping()]) = (0.0, 0.0);
        (0..layout.growing).for_each(|slot| state.y[layout.friction(slot)] = 0.0);
        state.friction.fill(0.0);
        (state.lost, state.origin) = (0.0, 0.0);
        // The work of normal loads and weight is computed from the state; its initial value is subtracted.
        let varying = self.contacts.iter().filter(|c| c.press.waveform().is_some());
        let equations = self.equations(state);
        let stored = |c: &Contact| c.count * equations.normal_energy(c, state.t, |i| state.y[i]);
        state.jumps = -varying.map(stored).sum::<f64>() - self.lifted(|i| state.shifts[i] + state.y[i]);
        // Uses the last column of a record row, so that the balance is exactly closed at the start.
        record::fill(&self.equations(state), state, state.t, &|i| state.y[i], row);
        // The balance error of the row is minus the stored energy.
        state.origin = -row.last().copied().unwrap_or(0.0);
    }

    /// Returns an error if the fixed time step is unstable.
    fn check_step(&self, stepper: Stepper) -> Result<(), SceneError> {
        let Accuracy::Step(step) = stepper.accuracy() else { return Ok(()) };
        let limit = self.longest_step(stepper).unwrap_or(f64::INFINITY);
        if step < limit {
            return Ok(());
        }
        Err(SceneFault::Unstable { limit, step }.of(Place::Run, Field::Step))
    }

    fn equations<'s>(&'s self, state: &'s State) -> Equations<'s> {
        Equations::on(self, state, self.layout())
    }
}

/// Search for the static equilibrium at t = 0.
struct Settling<'m> {
    model: &'m Model,
    /// Prescribed indentations of the contacts, m; precomputed, because an indentation from a force requires a search.
    depths: Vec<f64>,
    /// Last computed response of each contact; reused, because most contacts do not move in most iterations.
    answers: RefCell<Vec<Answer>>,
}

impl<'m> Settling<'m> {
    fn new(model: &'m Model, state: &State) -> Self {
        let eq = model.equations(state);
        let depth = |contact| eq.motion(contact, 0.0, |i| state.y[i]).d;
        Self {
            model,
            depths: model.contacts.iter().map(depth).collect(),
            answers: RefCell::new(vec![Answer::NONE; model.contacts.len()]),
        }
    }

    /// Increases the loads in proportion and follows the equilibrium of the free coordinates.
    fn settle(&self, state: &mut State) -> Result<(), SceneError> {
        let n = self.model.free.len();
        if n > MOST {
            return Err(SceneFault::TooManyFree { most: MOST, count: n }.of(Place::Run, Field::Start));
        }
        // In equilibrium velocities are zero; initial velocities apply to a given start.
        for i in 0..n {
            state.y[self.model.layout().velocity(i)] = 0.0;
        }
        let given = state.clone();
        let initial = self.statics(state, &state.y).net;
        // For one coordinate with prescribed normal loads, the path is one chord.
        let alone = n == 1 && self.model.contacts.iter().all(|c| c.coupling().is_none());
        let parts = if alone { 1 } else { PARTS };
        let landing = (!alone).then_some(LANDING);
        let (mut reached, mut tau) = (false, TAU);
        for share in landing.into_iter().chain((1..=parts).map(|k| f64::from(k) / f64::from(parts))) {
            // The missing force is a fraction of the initial imbalance, including friction and springs.
            let missing = &initial * (1.0 - share);
            let balance = Search::new(self, state, (&missing, &vec![false; n])).from(&state.y, tau);
            tau = if balance.holds { NEWTON } else { TAU };
            if balance.holds {
                self.stand(state, &balance)?;
            // At full load the equilibrium is found coordinate by coordinate, or does not exist.
            } else if share == 1.0 {
                let balance = self.released(state)?;
                self.stand(state, &balance)?;
            } else if !reached {
                // Part of the loads may not yet press a body onto its support.
                self.released(state)?;
                reached = true;
            }
        }
        self.come_back(given, state)
    }

    /// Searches again from the given positions if a contact has slipped far. During proportional loading the friction limit may be too
    /// small at first, so that a body slides to a distant equilibrium.
    fn come_back(&self, given: State, state: &mut State) -> Result<(), SceneError> {
        let [from, to] = [&given, &*state].map(|state| self.apexes(state, &state.y).collect::<Vec<_>>());
        let mut ways = self.model.contacts.iter().zip(from.iter().zip(&to));
        let has_slid = |(contact, (from, to)): (&Contact, (&Apex, &Apex))| {
            (to.u - from.u).abs() > FAR * contact.natural.displacement && contact.friction_limit() > 0.0
        };
        if !ways.any(has_slid) {
            return Ok(());
        }
        let Ok(balance) = self.released(&given) else { return Ok(()) };
        let way = |y: &[f64]| {
            let places = self.model.free.iter().zip(y.iter().zip(&given.y));
            places.map(|(free, (y, from))| (y - from).abs() / free.scale.0).fold(0.0, f64::max)
        };
        if way(&balance.y) < NEARER * way(&state.y) {
            *state = given;
            self.stand(state, &balance)?;
        }
        Ok(())
    }

    /// Returns the equilibrium nearest to the positions y, with part of the loads still missing and some coordinates held.
    fn balance(&self, state: &State, missing: &DVector<f64>, y: &[f64], held: &[bool]) -> Rc<Balance> {
        Search::new(self, state, (missing, held)).from(y, TAU)
    }

    /// Accepts an equilibrium: the contacts move to it on straight paths, which their slip memories record.
    fn stand(&self, state: &mut State, balance: &Balance) -> Result<(), SceneError> {
        // Responses depend on the memories.
        self.answers.borrow_mut().fill(Answer::NONE);
        let apexes: Vec<Apex> = self.apexes(state, &balance.y).collect();
        let memories = self.model.contacts.iter().zip(&mut state.memories);
        for (i, ((contact, memory), to)) in memories.zip(apexes).enumerate() {
            memory
                .commit(&contact.interface, Segment::Straight(to))
                .map_err(|error| SceneFault::Settling(error).of(Place::Contact(i), Field::Engine))?;
        }
        state.y.clone_from(&balance.y);
        Ok(())
    }

    /// Returns the equilibrium under all loads by releasing the coordinates one by one: first z, which determines normal forces, then x,
    /// then pitch.
    fn released(&self, state: &State) -> Result<Rc<Balance>, SceneError> {
        let n = self.model.free.len();
        let (nothing, mut held) = (DVector::zeros(n), vec![true; n]);
        let mut balance = self.balance(state, &nothing, &state.y, &held);
        for axis in [Axis::Z, Axis::X, Axis::Pitch] {
            let along: Vec<usize> = (0..n).filter(|i| self.model.free[*i].axis == axis).collect();
            for &i in &along {
                held[i] = false;
                let next = self.balance(state, &nothing, &balance.y, &held);
                if !next.holds {
                    along.iter().for_each(|i| held[*i] = false);
                    return Err(self.lost(state, &balance.y, held, (i, &along)));
                }
                balance = next;
            }
        }
        Ok(balance)
    }

    /// Returns the error that names the coordinate without equilibrium: the coordinate in the list `along` without which all others are in
    /// balance, or else the `first` one that could not be released.
    fn lost(
        &self,
        state: &State,
        y: &[f64],
        mut held: Vec<bool>,
        (first, along): (usize, &[usize]),
    ) -> SceneError {
        let nothing = DVector::zeros(held.len());
        let gone = self.balance(state, &nothing, y, &held);
        if let Some(i) = gone.turned {
            let body = self.model.bodies[self.model.free[i].body].name.clone();
            return SceneFault::Turned { body, angle: gone.y[i] }.of(Place::Run, Field::Start);
        }
        let farthest = gone.farthest(&held);
        let mut without = |i: usize, y: &[f64]| {
            held[i] = true;
            let others = self.balance(state, &nothing, y, &held);
            held[i] = false;
            others
        };
        let place = along.iter().copied().find(|i| without(*i, y).holds).unwrap_or(first);
        // Held at the position that it reached when released.
        let held_there = without(place, &gone.y);
        // If its own force vanishes there, the coordinate farthest from balance is reported.
        let (place, unbalanced) = match farthest.filter(|_| !held_there.is_off(place)) {
            Some(other) => (other, gone.residual[other]),
            None => (place, held_there.residual[place]),
        };
        let Free { body, axis, .. } = self.model.free[place];
        let body = self.model.bodies[body].name.clone();
        // Whether other bodies act along the same axis.
        let shared = self.model.free.iter().filter(|free| free.axis == axis).count() > 1;
        SceneFault::NoEquilibrium { body, axis, unbalanced, shared }.of(Place::Run, Field::Start)
    }
}
