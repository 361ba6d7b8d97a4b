//! Time interval between two events, in which all force laws are smooth, with precomputed constants.
//!
//! Between events each contact obeys one law, and each waveform one smooth piece. Most contacts have constant indentation and one direction
//! of slip, and their prescribed motions are linear or sinusoidal in time. Their force is a closed form of u, which is linear in the
//! coordinates. Open contacts exert no force. Other contacts use the general [`Equations`](crate::equations::Equations).
//!
//! After each event the data of the interval are rebuilt from the state, or only updated for the contacts with an event. Evaluations use
//! these data for forces, event location for event functions, and the closed-form solution for the oscillation of a single slider. See
//! [`treatment`](crate::method::treatment) for the treatment of a contact and [`choice`](crate::method::choice) for the integration method.

mod closed;
mod followed;
mod kernel;
mod slider;
mod swing;

pub(crate) use closed::Closed;
use closed::closed_form;
pub(crate) use followed::Followed;
pub(crate) use kernel::{Kernel, Lever, Row, Sparse};
pub(crate) use slider::{Pull, Slider};
pub(crate) use swing::{PhasePoint, Swing};

use crate::contact::Motion;
use crate::equations::Equations;
use crate::method::{IntervalTraits, SceneTraits, Tally, Treatment, is_undamped, treatment};
use crate::model::{Free, Model};
use crate::state::State;
use stickslip_contact::{Branch, Guard};

/// Precomputed data of the time interval between two events, in which all laws are smooth. Scratch memory, recomputed after each event.
#[derive(Debug, Clone)]
pub(crate) struct Interval<'a> {
    /// Contacts at constant indentation and with one sense of slip, whose force is a closed form of u.
    pub(crate) closed: Vec<Closed<'a>>,
    /// Contacts that use the general equations.
    pub(crate) others: Vec<usize>,
    /// Open contacts that may touch.
    pub(crate) apart: Vec<usize>,
    /// Index of each contact in the list `closed`, if its force has a closed form.
    places: Vec<Option<usize>>,
    /// Motions of contacts without a closed-form force, laid out flat where prescribed motions permit it, by contact.
    pub(crate) levers: Vec<Option<Lever<'a, Sparse>>>,
    /// Whether forces of contacts growing in full stick are states. Otherwise such contacts follow the full force law.
    grows: bool,
    /// Properties of model and interval that determine the integration method.
    pub(crate) scene: SceneTraits,
    pub(crate) traits: IntervalTraits,
    /// Constants of a single slider on which only contacts with a closed-form force act.
    pub(crate) slider: Option<Slider>,
    /// Contributions of the contacts to the slider's acceleration.
    pub(crate) pulls: Vec<Pull<'a>>,
    /// Precomputed forces of the interval, if all forces have such a form.
    pub(crate) kernel: Kernel<'a>,
}

/// Returns the allocated memory of a list, empty, for items of another type.
fn emptied<T, U>(list: Vec<T>) -> Vec<U> {
    list.into_iter().filter_map(|_| None).collect()
}

impl<'a> Interval<'a> {
    /// Returns empty interval data with allocated memory for all contacts of a model.
    pub(crate) fn of(model: &Model) -> Self {
        let count = model.contacts.len();
        Self {
            closed: Vec::with_capacity(count),
            others: Vec::with_capacity(count),
            apart: Vec::with_capacity(count),
            places: Vec::with_capacity(count),
            levers: Vec::with_capacity(count),
            pulls: Vec::with_capacity(count),
            grows: true,
            scene: SceneTraits::of(model),
            traits: IntervalTraits::default(),
            slider: None,
            kernel: Kernel::of(model),
        }
    }

    /// Returns empty interval data for steps that follow the full force law where the indentation varies.
    pub(crate) fn without_growth(model: &Model) -> Self {
        Self { grows: false, ..Self::of(model) }
    }

    /// Reuses the allocated memory for another model.
    pub(crate) fn renewed(mut self, model: &Model) -> Self {
        self.closed.reserve(model.contacts.len());
        self.pulls.reserve(model.contacts.len());
        [&mut self.others, &mut self.apart].into_iter().for_each(|list| list.clear());
        self.places.clear();
        self.levers.clear();
        let kernel = self.kernel.renewed(model);
        Self {
            kernel,
            scene: SceneTraits::of(model),
            traits: IntervalTraits::default(),
            slider: None,
            ..self
        }
    }

    /// Returns the allocated memory of the interval, empty and without a model.
    pub(crate) fn emptied(self) -> Interval<'static> {
        Interval {
            closed: emptied(self.closed),
            pulls: emptied(self.pulls),
            kernel: self.kernel.emptied(),
            levers: emptied(self.levers),
            others: self.others,
            apart: self.apart,
            places: self.places,
            grows: self.grows,
            scene: self.scene,
            traits: self.traits,
            slider: None,
        }
    }

    /// Returns the data of contact `c` if its force has a closed form.
    #[inline]
    pub(crate) fn closed_form(&self, c: usize) -> Option<&Closed<'a>> {
        self.places.get(c).copied().flatten().map(|place| &self.closed[place])
    }

    /// Returns the indices of contacts without a closed-form force, including open ones.
    #[inline(always)]
    pub(crate) fn open_form(&self) -> impl Iterator<Item = usize> + '_ {
        self.others.iter().chain(&self.apart).copied()
    }

    /// Returns the motion of a contact without a closed-form force at time t (s) with components y.
    #[inline(always)]
    pub(crate) fn motion(&self, eq: &Equations<'_>, c: usize, (t, y): (f64, &[f64])) -> Motion {
        let (contact, n) = (&eq.model.contacts[c], self.scene.free);
        match &self.levers[c] {
            Some(lever) => lever.motion(contact, t, (&y[..n], &y[n..2 * n])),
            None => eq.motion(contact, t, |i| y[i]),
        }
    }

    /// Returns whether all contacts have a closed-form force.
    #[inline(always)]
    pub(crate) fn is_closed(&self) -> bool {
        self.others.is_empty() && self.apart.is_empty()
    }

    /// Updates the laws of some contacts after an event that changed nothing else. Returns false if the interval must begin anew: where a
    /// contact opens or touches, or gets a law without precomputed forces.
    pub(crate) fn renew(
        &mut self,
        model: &'a Model,
        state: &State,
        changed: impl Iterator<Item = usize> + Clone,
    ) -> bool {
        let stays = |c: usize| {
            let has_form = |branch: &Branch| is_undamped(&model.contacts[c], branch);
            match self.places.get(c) {
                Some(Some(_)) => state.modes[c].branch().is_some_and(has_form),
                // A contact under constant load may get a closed form.
                _ => !model.contacts[c].is_constant() && self.others.contains(&c),
            }
        };
        if !changed.clone().all(stays) {
            return false;
        }
        for c in changed {
            match (self.places[c], state.modes[c].branch()) {
                (Some(place), Some(branch)) => {
                    self.closed[place].renew(branch, Guard::of(&model.contacts[c], &state.modes[c]));
                    self.kernel.renew(place, self.closed[place].branch);
                }
                _ if self.kernel.renew_moving(c, &state.modes[c]) => {}
                _ => return false,
            }
        }
        self.traits.slides = self.slides(state);
        self.traits.asked = false;
        // All other precomputed data is still valid.
        if !self.kernel.is_laid_out() {
            self.act(model, state);
        }
        true
    }

    /// Returns whether every contact is open or in gross slip.
    fn slides(&self, state: &State) -> bool {
        state.modes.iter().all(|mode| mode.is_gross() || mode.is_open())
    }

    /// Computes the constants of the interval that begins at a given state.
    pub(crate) fn begin(&mut self, model: &'a Model, state: &State) {
        self.closed.clear();
        self.others.clear();
        self.apart.clear();
        self.places.clear();
        self.levers.clear();
        for (c, (contact, mode)) in model.contacts.iter().zip(&state.modes).enumerate() {
            let place = self.closed.len();
            let mut followed = None;
            let of = || {
                followed = Followed::of(&contact.u, model, state);
                followed.is_some()
            };
            let treatment = treatment(contact, mode, of).0;
            match treatment {
                Treatment::Spared => {}
                Treatment::Apart => self.apart.push(c),
                Treatment::Closed => self.closed.extend(closed_form(c, (contact, mode), followed)),
                Treatment::General => self.others.push(c),
            }
            self.places.push((place < self.closed.len()).then_some(place));
            let is_open_form = matches!(treatment, Treatment::Apart | Treatment::General);
            self.levers.push(if is_open_form { Lever::of(contact, model, state) } else { None });
        }
        self.traits = IntervalTraits {
            slides: self.slides(state),
            straight: self.closed.iter().all(|closed| closed.followed.line().is_some()),
            general: !self.others.is_empty(),
            gap: self.apart.iter().any(|c| !model.contacts[*c].unguarded),
            asked: false,
        };
        self.act(model, state);
    }

    /// Computes the constants of the forces on a single slider, or else the general precomputed forces.
    fn act(&mut self, model: &'a Model, state: &State) {
        self.pulls.clear();
        self.slider = match &model.free[..] {
            [slider] if self.scene.velocities.is_none() && self.traits.is_simple(&self.scene) => {
                self.pull(slider)
            }
            _ => None,
        };
        // A single slider has an even shorter form, for methods that evaluate accelerations only.
        match self.slider {
            Some(_) if self.grows => self.kernel.clear(),
            _ => self.kernel.lay_out((model, state, self.grows), &self.closed, &self.others),
        }
    }

    /// Returns whether the interval is solved in one step to the next event.
    #[inline(always)]
    pub(crate) fn leaps(&self) -> bool {
        self.traits.leaps(&self.scene)
    }

    /// Adds the treatment of each contact in this interval to the counts of a run.
    pub(crate) fn count(&self, tally: &mut Tally) {
        self.closed.iter().for_each(|closed| tally.interval(closed.index, Treatment::Closed));
        self.others.iter().for_each(|c| tally.interval(*c, Treatment::General));
        self.apart.iter().for_each(|c| tally.interval(*c, Treatment::Apart));
    }

    /// Returns whether accelerations and powers are constant in the interval.
    #[inline(always)]
    pub(crate) fn is_constant(&self) -> bool {
        self.traits.is_constant(&self.scene)
    }

    /// Returns the constants of a single slider on which closed-form contacts act; `None` if a prescribed motion has no constant rate.
    fn pull(&mut self, slider: &Free) -> Option<Slider> {
        let mut sum = Slider { acceleration: slider.mobility * slider.force, power: 0.0 };
        for closed in &self.closed {
            let [constant, rate, start] = closed.followed.line()?;
            let arm = closed.arm;
            let ((front, lean), (force, gain)) = (closed.branch.front(), closed.branch.forces());
            let count = closed.contact.count;
            let (bend, work) = (-slider.mobility * arm * count, count * rate);
            sum.acceleration += bend * force;
            sum.power += work * force;
            if gain != 0.0 {
                self.pulls.push(Pull {
                    index: closed.index,
                    profile: closed.contact.interface.profile(),
                    front: front + lean * constant,
                    advance: lean * rate,
                    start,
                    lean: lean * arm,
                    acceleration: bend * gain,
                    power: work * gain,
                });
            }
        }
        Some(sum)
    }
}
