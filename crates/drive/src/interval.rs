//! The smooth interval between two events, with everything worked out that stays the same in it.
//!
//! Between events each contact follows one law and each waveform one piece. Most contacts of most scenes are then pressed
//! at a constant indentation, cut one piece of their memory and are dragged by a sum of sines or by straight waveforms: for
//! these u is linear in the coordinates, and the force is one closed form of u. Contacts that are apart act on nothing and are
//! not looked at until their gap closes. What is left goes through the general [`Equations`](crate::equations::Equations).
//!
//! An interval is made anew after each event, from the state alone, or takes up the laws of those contacts that fired; it is
//! read by everybody until the next: evaluations ask it
//! for forces, the watch for guards, the leap for the swing of a single slider. What is done about each contact is decided by
//! [`treatment`](crate::method::treatment), by which method the interval is taken by [`choice`](crate::method::choice).

mod closed;
mod followed;
mod kernel;
mod slider;
mod swing;

use crate::contact::{Guard, Mode};
pub(crate) use closed::Closed;
use closed::closed_form;
pub(crate) use followed::Followed;
pub(crate) use kernel::Kernel;
pub(crate) use slider::{Pull, Slider};
pub(crate) use swing::{PhasePoint, Swing};

use crate::method::{IntervalTraits, SceneTraits, Tally, Treatment, is_undamped, treatment};
use crate::model::{Free, Model};
use crate::state::State;
use stickslip_contact::Branch;

/// What evaluations between two events need. Scratch: made anew after each event.
#[derive(Debug, Clone)]
pub(crate) struct Interval<'a> {
    /// Contacts whose force is a closed form of u: pressed at a constant depth, dragged in one sense.
    pub(crate) closed: Vec<Closed<'a>>,
    /// Contacts that go through the general equations.
    pub(crate) others: Vec<usize>,
    /// Contacts that are apart and may touch.
    pub(crate) apart: Vec<usize>,
    /// By contact: its place among those of closed form.
    places: Vec<Option<usize>>,
    /// What decides the method: of the scene, and of the interval.
    pub(crate) scene: SceneTraits,
    pub(crate) traits: IntervalTraits,
    /// That slider, where nothing but contacts of closed form acts on it.
    pub(crate) slider: Option<Slider>,
    /// What its contacts make of it.
    pub(crate) pulls: Vec<Pull<'a>>,
    /// All that acts, laid out for evaluations, where it has such a form.
    pub(crate) kernel: Kernel<'a>,
}

/// A list without its items, which may borrow from what is gone soon, as room for others: a list is collected in the room of the
/// one that it comes from.
fn emptied<T, U>(list: Vec<T>) -> Vec<U> {
    list.into_iter().filter_map(|_| None).collect()
}

impl<'a> Interval<'a> {
    /// Room for all contacts of a model.
    pub(crate) fn of(model: &Model) -> Self {
        let count = model.contacts.len();
        Self {
            closed: Vec::with_capacity(count),
            others: Vec::with_capacity(count),
            apart: Vec::with_capacity(count),
            places: Vec::with_capacity(count),
            pulls: Vec::with_capacity(count),
            scene: SceneTraits::of(model),
            traits: IntervalTraits::default(),
            slider: None,
            kernel: Kernel::default(),
        }
    }

    /// Room for all contacts of another model.
    pub(crate) fn renewed(mut self, model: &Model) -> Self {
        self.closed.reserve(model.contacts.len());
        self.pulls.reserve(model.contacts.len());
        [&mut self.others, &mut self.apart].into_iter().for_each(|list| list.clear());
        self.places.clear();
        self.kernel.reserve(model);
        Self { scene: SceneTraits::of(model), traits: IntervalTraits::default(), slider: None, ..self }
    }

    /// The room that it takes, empty: it knows no model.
    pub(crate) fn emptied(self) -> Interval<'static> {
        Interval {
            closed: emptied(self.closed),
            pulls: emptied(self.pulls),
            kernel: self.kernel.emptied(),
            others: self.others,
            apart: self.apart,
            places: self.places,
            scene: self.scene,
            traits: self.traits,
            slider: None,
        }
    }

    /// Contact `c`, if its form is closed.
    #[inline]
    pub(crate) fn closed_form(&self, c: usize) -> Option<&Closed<'a>> {
        self.places.get(c).copied().flatten().map(|place| &self.closed[place])
    }

    /// The contacts whose motion a contact of closed form's closed forms do not give.
    #[inline(always)]
    pub(crate) fn open_form(&self) -> impl Iterator<Item = usize> + '_ {
        self.others.iter().chain(&self.apart).copied()
    }

    /// Whether there are none.
    #[inline(always)]
    pub(crate) fn is_closed(&self) -> bool {
        self.others.is_empty() && self.apart.is_empty()
    }

    /// Takes up the new laws of some contacts, all else being as it was before the event; false, with nothing done, where one
    /// of them has no closed form before and after it.
    pub(crate) fn renew(
        &mut self,
        model: &'a Model,
        state: &State,
        changed: impl Iterator<Item = usize> + Clone,
    ) -> bool {
        let stays = |c: usize| {
            let has_form = |branch: &Branch| is_undamped(&model.contacts[c], branch);
            self.closed_form(c).is_some() && matches!(&state.modes[c], Mode::Slip(branch) if has_form(branch))
        };
        if !changed.clone().all(stays) {
            return false;
        }
        for c in changed {
            if let (Some(place), Mode::Slip(branch)) = (self.places[c], &state.modes[c]) {
                self.closed[place].renew(branch, Guard::of(&model.contacts[c], &state.modes[c]));
                self.kernel.renew(place, self.closed[place].branch);
            }
        }
        self.traits.slides = self.slides(state);
        self.traits.asked = false;
        // All else that the kernel lays out is as it was.
        if !self.kernel.is_whole() {
            self.act(model, state);
        }
        true
    }

    /// Whether every contact that is not apart is in gross slip.
    fn slides(&self, state: &State) -> bool {
        state.modes.iter().all(|mode| mode.is_gross() || *mode == Mode::Open)
    }

    /// Works out what stays the same from a state on.
    pub(crate) fn begin(&mut self, model: &'a Model, state: &State) {
        self.closed.clear();
        self.others.clear();
        self.apart.clear();
        self.places.clear();
        for (c, (contact, mode)) in model.contacts.iter().zip(&state.modes).enumerate() {
            let place = self.closed.len();
            let mut followed = None;
            let of = || {
                followed = Followed::of(&contact.u, model, state);
                followed.is_some()
            };
            match treatment(contact, mode, of).0 {
                Treatment::Spared => {}
                Treatment::Apart => self.apart.push(c),
                Treatment::Closed => self.closed.extend(closed_form(c, (contact, mode), followed)),
                Treatment::General => self.others.push(c),
            }
            self.places.push((place < self.closed.len()).then_some(place));
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

    /// What acts: the contacts on a single slider, or all that the kernel lays out.
    fn act(&mut self, model: &'a Model, state: &State) {
        self.pulls.clear();
        self.slider = match &model.free[..] {
            [slider] if self.scene.velocities.is_none() && self.traits.is_simple(&self.scene) => {
                self.pull(slider)
            }
            _ => None,
        };
        // A single slider has a shorter form still.
        match self.slider {
            Some(_) => self.kernel.clear(),
            None => self.kernel.lay_out((model, state), &self.closed, &self.others),
        }
    }

    /// Whether the motion is to be taken in one leap to the next event.
    #[inline(always)]
    pub(crate) fn leaps(&self) -> bool {
        self.traits.leaps(&self.scene)
    }

    /// Counts what is done about each contact.
    pub(crate) fn count(&self, tally: &mut Tally) {
        self.closed.iter().for_each(|closed| tally.interval(closed.index, Treatment::Closed));
        self.others.iter().for_each(|c| tally.interval(*c, Treatment::General));
        self.apart.iter().for_each(|c| tally.interval(*c, Treatment::Apart));
    }

    /// Whether accelerations and powers are the same throughout.
    #[inline(always)]
    pub(crate) fn is_constant(&self) -> bool {
        self.traits.is_constant(&self.scene)
    }

    /// The contacts of closed form as they act on a single slider; none where a follower moves at no constant rate.
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
