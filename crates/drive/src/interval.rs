//! The smooth interval between two events, with everything worked out that stays the same in it.
//!
//! Between events each contact follows one law and each waveform one piece. Most contacts of most scenes are then pressed
//! at a constant indentation, cut one piece of their memory and are dragged by a sum of sines or by straight waveforms: for
//! these u is linear in the coordinates, and the force is one closed form of u. Contacts that are apart act on nothing and are
//! not looked at until their gap closes. What is left goes through the general [`Equations`](crate::equations::Equations).

mod followed;
mod swing;

use crate::contact::{Contact, Guard, Mode, Motion, Press};
pub(crate) use followed::Followed;
pub(crate) use swing::{Place, Swing};

use crate::Sample;
use crate::method::{IntervalTraits, SceneTraits, Tally, Treatment, treatment};
use crate::model::{Free, Model};
use crate::state::State;
use stickslip_contact::{Profile, SteadyBranch};

/// What evaluations between two events need. Scratch: made anew after each event.
#[derive(Debug, Clone)]
pub(crate) struct Interval<'a> {
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
}

/// A single slider among contacts of closed form: its acceleration is a₀ + Σ a M(h_c) and the power put in P₀ + Σ P M(h_c), over
/// the contacts in partial slip.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Slider {
    /// a₀, m/s².
    pub(crate) acceleration: f64,
    /// P₀, W.
    pub(crate) power: f64,
}

/// What a contact in partial slip adds to a single slider. Kept so that as little as can be waits for the position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pull<'a> {
    profile: &'a Profile,
    /// h_c = front + advance (t - start) + lean · x.
    front: f64,
    advance: f64,
    start: f64,
    lean: f64,
    /// a, 1/(m s²).
    pub(crate) acceleration: f64,
    /// P, W/m².
    pub(crate) power: f64,
}

impl Pull<'_> {
    /// M at the slip front, m².
    #[inline(always)]
    pub(crate) fn reduced_force(&self, t: f64, x: f64) -> f64 {
        self.profile.reduced_force(self.height(t, x))
    }

    /// Height of the slip front, m.
    #[inline(always)]
    fn height(&self, t: f64, x: f64) -> f64 {
        (self.front + self.advance * (t - self.start)) + self.lean * x
    }

    /// N of one metre (m³), the height now (m) and how it leans on the coordinate, where M is a power 3/2 of the height.
    fn root_law(&self, t: f64, x: f64) -> Option<(f64, f64, f64)> {
        let is_paraboloid = self.profile.exponent() == Some(2.0);
        is_paraboloid.then(|| (self.profile.reduced_energy(1.0), self.height(t, x), self.lean))
    }
}

/// A contact at constant indentation on one branch.
#[derive(Debug, Clone)]
pub(crate) struct Closed<'a> {
    /// Its place among the contacts.
    pub(crate) index: usize,
    pub(crate) contact: &'a Contact,
    /// Those that end the interval.
    pub(crate) guards: &'static [Guard],
    d: f64,
    /// u = what followers make of it + Σ coefficient · coordinate.
    followed: Followed<'a>,
    /// Sum of the coefficients: what a single coordinate counts in u.
    pub(crate) arm: f64,
    branch: SteadyBranch,
}

impl Closed<'_> {
    /// The part of u that does not depend on the free coordinates, m, and its derivatives.
    #[inline(always)]
    pub(crate) fn followed(&self, t: f64) -> Sample {
        self.followed.at(t)
    }

    /// Its rate where it is the same at all times, m/s.
    pub(crate) fn constant_rate(&self) -> Option<f64> {
        self.followed.line().map(|[_, rate, _]| rate)
    }

    /// Force along u on the coordinates, N: what the contacts exert, less than zero forward.
    #[inline(always)]
    pub(crate) fn force(&self, u: f64) -> f64 {
        -self.contact.count * self.branch.force(self.contact.interface.profile(), u)
    }

    /// u at time t, s; `x` reads positions of free coordinates.
    #[inline(always)]
    pub(crate) fn displacement(&self, t: f64, x: impl Fn(usize) -> f64) -> f64 {
        // Two bodies far from their start may be close to each other: their difference first.
        self.own(x) + self.followed(t).value
    }

    /// Motion at time t, s; `x` and `v` read positions and velocities of free coordinates.
    #[inline(always)]
    pub(crate) fn motion(&self, t: f64, x: impl Fn(usize) -> f64, v: impl Fn(usize) -> f64) -> Motion {
        let Sample { value, rate, .. } = self.followed(t);
        Motion { d: self.d, u: self.own(x) + value, dd: 0.0, du: self.own(v) + rate }
    }

    /// Value of one of its guards at time t, s: the margin of its piece, or else the speed of its edge.
    #[inline(always)]
    pub(crate) fn guard(
        &self,
        guard: Guard,
        t: f64,
        x: impl Fn(usize) -> f64,
        v: impl Fn(usize) -> f64,
    ) -> f64 {
        match guard {
            Guard::Piece => self.branch.margin(self.displacement(t, x)),
            _ => self.branch.sense() * (self.own(v) + self.followed(t).rate),
        }
    }

    /// Its rate at time t, s; `v` and `a` read velocities and accelerations.
    #[inline(always)]
    pub(crate) fn guard_rate(
        &self,
        guard: Guard,
        t: f64,
        v: impl Fn(usize) -> f64,
        a: impl Fn(usize) -> f64,
    ) -> f64 {
        let followed = self.followed(t);
        match guard {
            Guard::Piece => -self.branch.sense() * (self.own(v) + followed.rate),
            _ => self.branch.sense() * (self.own(a) + followed.acceleration),
        }
    }

    /// +1 forward, -1 backward.
    pub(crate) fn sense(&self) -> f64 {
        self.branch.sense()
    }

    /// How far a single coordinate at x (m) may still move before a piece of memory ends, m; ∞ in gross slip.
    #[inline(always)]
    pub(crate) fn reach(&self, t: f64, x: f64) -> f64 {
        let u = self.arm * x + self.followed(t).value;
        if self.branch.is_gross() { f64::INFINITY } else { self.branch.margin(u) / self.arm.abs() }
    }

    /// What the free coordinates make of u, or their derivatives of its own.
    #[inline(always)]
    pub(crate) fn own(&self, of: impl Fn(usize) -> f64) -> f64 {
        self.contact.u.free.iter().map(|(i, a)| a * of(*i)).sum()
    }
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
            slides: state.modes.iter().all(|mode| mode.is_gross() || *mode == Mode::Open),
            straight: self.closed.iter().all(|closed| closed.followed.line().is_some()),
            general: !self.others.is_empty(),
            gap: self.apart.iter().any(|c| !model.contacts[*c].unguarded),
            asked: false,
        };
        self.pulls.clear();
        self.slider = match &model.free[..] {
            [slider] if self.scene.velocities.is_none() && self.traits.is_simple(&self.scene) => {
                self.pull(slider)
            }
            _ => None,
        };
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

    /// The contacts of closed form as a single slider feels them; none where a follower moves at no constant rate.
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

/// A contact whose followers make a closed form of u.
fn closed_form<'a>(
    c: usize,
    (contact, mode): (&'a Contact, &Mode),
    followed: Option<Followed<'a>>,
) -> Option<Closed<'a>> {
    let (Mode::Slip(branch), Press::Constant { d, reduced_force }) = (mode, &contact.press) else {
        return None;
    };
    Some(Closed {
        index: c,
        contact,
        guards: Guard::of(contact, mode),
        d: *d,
        followed: followed?,
        arm: contact.u.free.iter().map(|(_, a)| a).sum(),
        branch: branch.steady(*d, *reduced_force),
    })
}
