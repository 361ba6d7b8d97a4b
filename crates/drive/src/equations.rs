//! The equations of motion, evaluated on borrowed memory.
//!
//! M q̈ = Σ forces of contacts, links, loads and blocks, beside it the integrals on which nothing depends
//! (work put in, dissipation, elastic energy and friction of growing contacts). Steppers ask for slopes or,
//! where no force depends on a velocity, for accelerations alone; records and guards read motions and signals
//! of a moment by the same functions.
//!
//! Nothing here is written to but the slopes: a trial evaluation has no way to leave a trace. Nothing here
//! chooses a law or knows an event: laws go on smoothly beyond the moment that will end them.

mod balance;
mod blocks;
mod forces;
mod sum;

use crate::contact::{Contact, Mode, Motion, Press};
pub(crate) use balance::Instant;
pub(crate) use sum::{Components, Reading, View};

use crate::interval::{Interval, Kernel, Pull};
use crate::model::{Binding, BlockState, Measure};
use crate::state::{Generating, Layout, State};
use crate::{Model, Piece, Sample};
use stickslip_contact::Memory;
use stickslip_stepper::{Conservative, System};
use sum::{Positions, Sum};

/// How far beyond a piece, in its lengths, a step that may cross corners still counts as on it.
// It need not be sharp: no run differs at 1e-8 or 1e-10.
const CORNER_SLACK: f64 = 1e-9;

/// Right-hand side of a drive: shared borrows only, so that no evaluation leaves a trace.
#[derive(Clone, Copy)]
pub(crate) struct Equations<'a> {
    pub(crate) model: &'a Model,
    /// The smooth piece of each waveform.
    pub(crate) pieces: &'a [Piece],
    /// What each waveform generates; empty where none does.
    pub(crate) generators: &'a [Option<Generating>],
    /// What the contacts remember, as committed last.
    pub(crate) memories: &'a [Memory],
    /// The law of each contact.
    pub(crate) modes: &'a [Mode],
    pub(crate) blocks: &'a [BlockState],
    pub(crate) layout: Layout,
    /// Whether a step may cross corners of waveforms, as fixed steps do.
    pub(crate) crossing: bool,
    /// What is known to stay the same until the next event.
    pub(crate) interval: Option<&'a Interval<'a>>,
}

impl<'a> Equations<'a> {
    /// The equations on a state as it stands.
    ///
    /// `layout` may leave out the components of growing contacts, as runs by chords do.
    pub(crate) fn on(model: &'a Model, state: &'a State, layout: Layout, crossing: bool) -> Self {
        let State { pieces, generators, memories, modes, blocks, .. } = state;
        Self { model, pieces, generators, memories, modes, blocks, layout, crossing, interval: None }
    }
}

impl<'a> Equations<'a> {
    /// What a contact remembers, and its mode.
    pub(crate) fn law(&self, c: usize) -> (&'a Memory, &'a Mode) {
        (&self.memories[c], &self.modes[c])
    }

    /// Waveform `w` at time t. Within a smooth piece this is exact up to and including its end.
    #[inline(always)]
    pub(crate) fn sample(&self, w: usize, t: f64) -> Sample {
        let (waveform, piece) = (&self.model.waveforms[w], &self.pieces[w]);
        if self.crossing {
            return self.across(w, t);
        }
        waveform.sample(piece, t)
    }

    /// The same for a step that may cross corners.
    ///
    /// Beyond its piece by more than 1e-9 of the piece's length the right one is looked for.
    #[inline(never)]
    fn across(&self, w: usize, t: f64) -> Sample {
        let (waveform, piece) = (&self.model.waveforms[w], &self.pieces[w]);
        // A step aligned with a corner may miss it by rounding; that is still the same piece.
        let slack = CORNER_SLACK * (piece.end - piece.start);
        if t < piece.start - slack || t > piece.end + slack {
            let beside = match self.generators.get(w) {
                Some(Some(generating)) => generating.piece_at(t).unwrap_or(*piece),
                _ => waveform.piece_at(t),
            };
            return waveform.sample(&beside, t);
        }
        waveform.sample(piece, t)
    }

    /// A coordinate and its rate.
    /// m and m/s, or rad and rad/s.
    pub(crate) fn place(&self, place: Binding, t: f64, y: impl Fn(usize) -> f64) -> [f64; 2] {
        match place {
            Binding::Held(x) => [x, 0.0],
            Binding::Free(i) => [y(i), y(self.layout.velocity(i))],
            Binding::Driven(w) => {
                let sample = self.signal(w, &Components { t, y });
                [sample.value, sample.rate]
            }
        }
    }

    /// A measure at one moment.
    ///
    /// constant + Σ aq + Σ bw over free coordinates q and followed signals w, with the rates of both. Without
    /// velocities the rate is that of the followers alone.
    #[inline(always)]
    pub(crate) fn read<V: View>(&self, measure: &Measure, at: &V) -> Reading {
        let (mut own, mut rate) = (0.0, 0.0);
        for &(i, a) in &measure.free {
            own += a * at.component(i);
            // Nyström's stages know no velocities: the branch is gone when compiled.
            if V::MOVES {
                rate += a * at.component(self.layout.velocity(i));
            }
        }
        let (mut followed, mut driven) = (0.0, 0.0);
        for &(w, a) in &measure.driven {
            let sample = self.signal(w, at);
            followed += a * sample.value;
            driven += a * sample.rate;
        }
        // Two bodies far from their start may be close to each other: their difference first.
        Reading { value: measure.constant + (own + followed), rate: rate + driven, driven }
    }

    /// The value of a measure at one moment, to the last bit that of [`Self::read`].
    #[inline(always)]
    fn length(&self, measure: &Measure, at: &impl View) -> f64 {
        let (mut own, mut followed) = (0.0, 0.0);
        for &(i, a) in &measure.free {
            own += a * at.component(i);
        }
        for &(w, a) in &measure.driven {
            followed += a * self.signal(w, at).value;
        }
        measure.constant + (own + followed)
    }

    /// Second derivative of a measure at a moment, m/s²; `free` gives that of a free coordinate.
    ///
    /// What the followers make of it is exact within a smooth piece.
    pub(crate) fn acceleration(&self, measure: &Measure, at: &impl View, free: impl Fn(usize) -> f64) -> f64 {
        let followed = measure.driven.iter().map(|(w, a)| a * self.signal(*w, at).acceleration);
        measure.free.iter().map(|(i, a)| a * free(*i)).sum::<f64>() + followed.sum::<f64>()
    }

    /// Motion of a contact; `y` reads a component.
    ///
    /// d, u (m) and their rates (m/s); u counted from its shifted origin, d below zero where the contact is
    /// apart.
    #[inline]
    pub(crate) fn motion(&self, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> Motion {
        let at = Components { t, y };
        let u = self.read(&contact.u, &at);
        let (d, dd) = match contact.coupling() {
            Some(measure) => {
                let d = self.read(measure, &at);
                (d.value, d.rate)
            }
            None => self.pressed(contact, t),
        };
        Motion { d, u: u.value, dd, du: u.rate }
    }

    /// Where a contact stands, d and u, m; no rates: for who asks for none.
    #[inline]
    pub(crate) fn standing(&self, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> Motion {
        let at = Components { t, y };
        let d = match contact.coupling() {
            Some(measure) => self.length(measure, &at),
            None => self.pressed(contact, t).0,
        };
        Motion { d, u: self.length(&contact.u, &at), ..Motion::default() }
    }

    /// u of a contact, m, from its shifted origin, and its rate, m/s.
    #[inline]
    pub(crate) fn slide(&self, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> Reading {
        self.read(&contact.u, &Components { t, y })
    }

    /// Prescribed indentation and its rate.
    #[inline(always)]
    pub(crate) fn pressed(&self, contact: &Contact, t: f64) -> (f64, f64) {
        match &contact.press {
            Press::Constant { d, .. } => (*d, 0.0),
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) => {
                let lull = match &self.modes[contact.place] {
                    Mode::Lull { lull, .. } => Some(lull),
                    _ => None,
                };
                contact.pressed(self.sample(*w, t), lull)
            }
            // The bodies say.
            Press::Coupled(_) => (0.0, 0.0),
        }
    }
}

impl Equations<'_> {
    /// All that acts until the next event, where it is laid out.
    #[inline(always)]
    fn kernel(&self) -> Option<&Kernel<'_>> {
        self.interval.map(|interval| &interval.kernel).filter(|kernel| kernel.is_whole())
    }

    /// Accelerations without any velocity, and the power put in, W.
    ///
    /// `out` is q̈ of the free coordinates and then the one integral. Only for models without dampers,
    /// varying loads, growth and blocks: their powers need velocities.
    #[inline(never)]
    fn accelerate(&self, at: &Positions<'_>, out: &mut [f64]) {
        let (dv, input) = out.split_at_mut(self.layout.free);
        let mut sum = Sum::new(self.model, dv);
        self.contacts(at, &mut sum, &mut []);
        if !self.model.links.is_empty() {
            self.links(at, &mut sum);
        }
        // Nothing dissipates but contacts, which book for themselves.
        (input[0], _) = sum.accelerate(self.model);
    }
}

impl System for Equations<'_> {
    fn dimension(&self) -> usize {
        self.layout.dimension()
    }

    fn positions(&self) -> usize {
        self.layout.free
    }

    fn total(&self) -> usize {
        self.layout.total()
    }

    #[inline]
    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        match self.kernel() {
            Some(kernel) => kernel.slopes(self, (t, y), dy),
            None => self.all_slopes(t, y, dy),
        }
    }

    /// Flight and gross slip under constant loads.
    fn coasts(&self) -> bool {
        self.interval.is_some_and(Interval::is_constant)
    }
}

impl Equations<'_> {
    /// Slopes of all components, whatever acts. Apart: who asks the kernel, ten times a step, needs none of its registers.
    #[inline(never)]
    fn all_slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        let layout = self.layout;
        let v = &y[layout.free..2 * layout.free];
        let (dx, rest) = dy.split_at_mut(layout.free);
        let (dv, extra) = rest.split_at_mut(layout.free);
        // Positions first, then velocities: ẋ is part of the state itself.
        dx.copy_from_slice(v);
        // Contacts that are apart leave theirs alone.
        extra.fill(0.0);
        let mut sum = Sum::new(self.model, dv);
        let at = Components { t, y: |i: usize| y[i] };
        self.contacts(&at, &mut sum, extra);
        if !self.model.links.is_empty() {
            self.links(&at, &mut sum);
        }
        for load in &self.model.loads {
            let force = load.arm * self.sample(load.waveform, t).value;
            sum.dv[load.free] += force;
            sum.input += force * v[load.free];
        }
        if !self.model.blocks.is_empty() {
            self.blocks(&at, &mut sum, extra);
        }
        if !self.model.balanced.is_empty() {
            self.balance(&at, &mut sum, extra);
        }
        let (input, damping) = sum.accelerate(self.model);
        let first = layout.input() - 2 * layout.free;
        (extra[first], extra[first + 1]) = (input, damping);
    }
}

impl Conservative for Equations<'_> {
    #[inline(always)]
    fn accelerations(&self, t: f64, x: &[f64], out: &mut [f64]) {
        match (x, out, self.interval) {
            // One slider, as in most drives: no loop over coordinates is left.
            ([x], [acceleration, input], Some(Interval { slider: Some(slider), pulls, .. })) => {
                (*acceleration, *input) = (slider.acceleration, slider.power);
                let mut add = |pull: &Pull<'_>| {
                    let reduced_force = pull.reduced_force(t, *x);
                    *acceleration += pull.acceleration * reduced_force;
                    *input += pull.power * reduced_force;
                };
                // A single pull without a loop: the benchmark drive asks for nothing else.
                match &pulls[..] {
                    [pull] => add(pull),
                    pulls => pulls.iter().for_each(add),
                }
            }
            (x, out, Some(Interval { kernel, .. })) if kernel.is_whole() => {
                kernel.accelerations(self, (t, x), out);
            }
            (x, out, _) => self.accelerate(&Positions { t, x }, out),
        }
    }

    /// Gross slip under constant loads: a parabola.
    fn coasts(&self) -> bool {
        self.interval.is_some_and(Interval::is_constant)
    }
}
