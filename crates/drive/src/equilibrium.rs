//! The start of a run: given, or the static equilibrium under what acts at t = 0.
//!
//! The loads are put on in proportion, and the contacts remember the way: which of them slips depends on it. A body that
//! is drawn above what will hold it is first set down by a millionth of its loads.
//!
//! A balance under all loads at once is not enough: with friction there are many, and the one that loads put
//! on in proportion come to is taken. Nothing moves here and no time passes. The state at t = 0 also begins
//! the books: what is stored then is where energies count from.

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

/// Parts in which the loads are put on where several coordinates share them.
// Each part leaves a knot, whose loop closes later: with 640 a climber has 2 528 events in ten cycles instead of 1 370 and ends
// 4e-6 u_c elsewhere; with a single one 2e-5 u_c.
const PARTS: u32 = 64;
/// Most free coordinates whose equilibrium is sought: the work grows with the cube of their number, seconds for these.
const MOST: usize = 200;
/// The pseudo-time with which a search begins whose place may lie anywhere.
const TAU: f64 = 1.0;
/// Share of the loads that sets the bodies down: what the contacts remember of the way through the air is as small.
// With ten times or a tenth as much a climber ends less than 1e-6 u_c elsewhere.
const LANDING: f64 = 1e-6;
/// A slide that is worth a second look, in u_c, and what part of the way another balance has to be near to be taken instead.
const FAR: f64 = 100.0;
const NEARER: f64 = 0.5;

impl Model {
    /// The state at t = 0 of a plan's run.
    ///
    /// Fails where a number of the plan is out of its range, where an equilibrium is asked for and there is none, where the
    /// plan's stepper cannot follow the model's waveforms, and where its fixed step is unstable.
    pub fn start(&self, plan: &Plan) -> Result<State, SceneError> {
        let mut state = State::blank();
        self.start_in(plan, &mut state, &mut Vec::new())?;
        Ok(state)
    }

    /// The same in the room of another state; `row` is scratch. After an error the state is of no use.
    pub(crate) fn start_in(
        &self,
        plan: &Plan,
        state: &mut State,
        row: &mut Vec<f64>,
    ) -> Result<(), SceneError> {
        plan.check()?;
        // A free mass does not follow a jump: only a step that ends there can tell its two sides apart.
        let jumps = !self.free.is_empty() && self.waveforms.iter().any(Waveform::has_jumps);
        let follows =
            plan.stepper.locates_events() || plan.stepper.ends_at_corners() && self.balanced.is_empty();
        if jumps && !follows {
            return Err(SceneFault::UnlocatedJump.of(Place::Run, Field::Stepper));
        }
        self.check_step(plan.stepper)?;
        self.begin(state, row)
    }

    /// The state at t = 0 where nothing is wrong with a plan.
    fn begin(&self, state: &mut State, row: &mut Vec<f64>) -> Result<(), SceneError> {
        self.put_at_rest(state);
        if self.equilibrium && !self.free.is_empty() {
            // Copies hold what they must and no more: the room that a run needs lies so far apart that looking through ten
            // thousand of them took seven times as long.
            state.memories = state.memories.clone();
            Settling::new(self, state).settle(state)?;
            state.memories.iter_mut().for_each(Memory::make_room);
        }
        self.balance_first(state)?;
        self.open_books(state, row);
        Ok(())
    }

    /// Begins the books of energies with a state: nothing has been put in or lost before it.
    pub(crate) fn open_books(&self, state: &mut State, row: &mut Vec<f64>) {
        let layout = state.layout(self);
        (state.y[layout.input()], state.y[layout.damping()]) = (0.0, 0.0);
        (0..layout.growing).for_each(|slot| state.y[layout.friction(slot)] = 0.0);
        state.friction.fill(0.0);
        (state.lost, state.origin) = (0.0, 0.0);
        // What pressed and lifted before the start is no work of the run: it is read off the present state,
        // and taken off here.
        let varying = self.contacts.iter().filter(|c| c.press.waveform().is_some());
        let equations = self.equations(state);
        let pressed = |c: &Contact| c.interface.normal_energy(equations.pressed(c, state.t).0);
        state.jumps = -varying.map(|c| c.count * pressed(c)).sum::<f64>()
            - self.lifted(|i| state.shifts[i] + state.y[i]);
        // By the row itself: whatever it counts as stored, the books close on it at the start.
        record::fill(&self.equations(state), state, state.t, &|i| state.y[i], row);
        // The books' error there is minus what is stored: that is where they start.
        state.origin = -row.last().copied().unwrap_or(0.0);
    }

    /// Refuses a fixed step with which the stiffest motion grows.
    fn check_step(&self, stepper: Stepper) -> Result<(), SceneError> {
        let Accuracy::Step(step) = stepper.accuracy() else { return Ok(()) };
        let limit = self.longest_step(stepper).unwrap_or(f64::INFINITY);
        if step < limit {
            return Ok(());
        }
        Err(SceneFault::Unstable { limit, step }.of(Place::Run, Field::Step))
    }

    fn equations<'s>(&'s self, state: &'s State) -> Equations<'s> {
        Equations::on(self, state, self.layout(), false)
    }
}

/// A model on its way to an equilibrium at t = 0.
struct Settling<'m> {
    model: &'m Model,
    /// Indentations that bodies do not set, m: no place changes them, and one that follows a force takes a search each time.
    depths: Vec<f64>,
    /// What each contact answered last: of many sliders most stand still while the others find their place.
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

    /// Puts the loads on in proportion and follows the equilibrium.
    fn settle(&self, state: &mut State) -> Result<(), SceneError> {
        let n = self.model.free.len();
        if n > MOST {
            return Err(SceneFault::TooManyFree { most: MOST, count: n }.of(Place::Run, Field::Start));
        }
        // In equilibrium nothing moves; velocities that the scene names are of a start that is given.
        for i in 0..n {
            state.y[self.model.layout().velocity(i)] = 0.0;
        }
        let given = state.clone();
        let initial = self.statics(state, &state.y).net;
        // One coordinate and no contact pressed by it: the way under a growing load is one chord, whatever
        // its parts.
        let alone = n == 1 && self.model.contacts.iter().all(|c| c.coupling().is_none());
        let parts = if alone { 1 } else { PARTS };
        let landing = (!alone).then_some(LANDING);
        let (mut reached, mut tau) = (false, TAU);
        for share in landing.into_iter().chain((1..=parts).map(|k| f64::from(k) / f64::from(parts))) {
            // In proportion: the forces still missing are a share of the imbalance at the start, friction and
            // springs included.
            let missing = &initial * (1.0 - share);
            let balance = Search::new(self, state, (&missing, &vec![false; n])).from(&state.y, tau);
            tau = if balance.holds { NEWTON } else { TAU };
            if balance.holds {
                self.stand(state, &balance)?;
            // Under the whole load nothing more will come: now it is found coordinate by coordinate, or there
            // is none.
            } else if share == 1.0 {
                let balance = self.released(state)?;
                self.stand(state, &balance)?;
            } else if !reached {
                // A part of the loads may not yet press a body against what holds it in the end.
                self.released(state)?;
                reached = true;
            }
        }
        self.come_back(given, state)
    }

    /// What has slid far is looked for once more where it began. While loads grow in proportion friction may hold less of them than in the
    /// end, and a body that slides for want of it stays wherever it is when there is enough: metres away, and in balance.
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

    /// The balance nearest to y with some forces still missing and some coordinates held.
    fn balance(&self, state: &State, missing: &DVector<f64>, y: &[f64], held: &[bool]) -> Rc<Balance> {
        Search::new(self, state, (missing, held)).from(y, TAU)
    }

    /// Takes over a balance: the contacts go there on straight paths.
    fn stand(&self, state: &mut State, balance: &Balance) -> Result<(), SceneError> {
        // With their memories their answers change.
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

    /// The balance under all loads, found by letting go of one coordinate after the other: first those along z, which
    /// set the normal forces, then those along x, which live on friction, then pitch.
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

    /// Names the coordinate without an equilibrium: one of those `along` an axis without which all others are in
    /// balance, or else the `first` that could not be let go of.
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
        // Held where it went when nothing held it.
        let held_there = without(place, &gone.y);
        // What tips or comes loose may find all its own forces gone, and it is another coordinate that is left without balance.
        let (place, unbalanced) = match farthest.filter(|_| !held_there.is_off(place)) {
            Some(other) => (other, gone.residual[other]),
            None => (place, held_there.residual[place]),
        };
        let Free { body, axis, .. } = self.model.free[place];
        let body = self.model.bodies[body].name.clone();
        // Alone along its axis it bears nothing but its own.
        let shared = self.model.free.iter().filter(|free| free.axis == axis).count() > 1;
        SceneFault::NoEquilibrium { body, axis, unbalanced, shared }.of(Place::Run, Field::Start)
    }
}
