//! The equations of motion, evaluated on borrowed memory.

mod sum;

pub(crate) use sum::{Components, Reading, View};

use crate::interval::{Interval, Pull};
use crate::model::{Contact, Link, Measure, Motion, Place, Press, Stroke};
use crate::state::{Layout, Mode, State};
use crate::{Model, Piece, Sample};
use stickslip_contact::{Branch, Memory, Move};
use stickslip_stepper::{Conservative, System};
use sum::{Positions, Sum};

/// How far beyond a piece, in its lengths, a step that may cross corners still counts as on it.
const CORNER_SLACK: f64 = 1e-9;

/// Right-hand side of a drive: shared borrows only, so that no evaluation leaves a trace.
#[derive(Clone, Copy)]
pub(crate) struct Equations<'a> {
    pub(crate) model: &'a Model,
    pub(crate) pieces: &'a [Piece],
    pub(crate) memories: &'a [Memory],
    pub(crate) modes: &'a [Mode],
    pub(crate) layout: Layout,
    /// Whether a step may cross corners of waveforms, as fixed steps do.
    pub(crate) crossing: bool,
    /// What is known to stay the same until the next event.
    pub(crate) interval: Option<&'a Interval<'a>>,
}

impl<'a> Equations<'a> {
    /// The equations on a state as it stands.
    pub(crate) fn on(model: &'a Model, state: &'a State, layout: Layout, crossing: bool) -> Self {
        let State { pieces, memories, modes, .. } = state;
        Self { model, pieces, memories, modes, layout, crossing, interval: None }
    }
}

impl Equations<'_> {
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
    #[inline(never)]
    fn across(&self, w: usize, t: f64) -> Sample {
        let (waveform, piece) = (&self.model.waveforms[w], &self.pieces[w]);
        // A step aligned with a corner may miss it by rounding; that is still the same piece.
        let slack = CORNER_SLACK * (piece.end - piece.start);
        if t < piece.start - slack || t > piece.end + slack {
            return waveform.sample(&waveform.piece_at(t), t);
        }
        waveform.sample(piece, t)
    }

    /// A coordinate and its rate.
    pub(crate) fn place(&self, place: Place, t: f64, y: impl Fn(usize) -> f64) -> [f64; 2] {
        match place {
            Place::Held(x) => [x, 0.0],
            Place::Free(i) => [y(i), y(self.layout.velocity(i))],
            Place::Driven(w) => {
                let sample = self.sample(w, t);
                [sample.value, sample.rate]
            }
        }
    }

    /// A measure at one moment.
    #[inline(always)]
    pub(crate) fn read<V: View>(&self, measure: &Measure, at: &V) -> Reading {
        let (mut own, mut rate) = (0.0, 0.0);
        for &(i, a) in &measure.free {
            own += a * at.component(i);
            if V::MOVES {
                rate += a * at.component(self.layout.velocity(i));
            }
        }
        let (mut followed, mut driven) = (0.0, 0.0);
        for &(w, a) in &measure.driven {
            let sample = self.sample(w, at.time());
            followed += a * sample.value;
            driven += a * sample.rate;
        }
        // Two bodies far from their start may be close to each other: their difference first.
        Reading { value: measure.constant + (own + followed), rate: rate + driven, driven }
    }

    /// Second derivative of a measure, m/s²; `free` gives that of a free coordinate.
    pub(crate) fn acceleration(&self, measure: &Measure, t: f64, free: impl Fn(usize) -> f64) -> f64 {
        let followed = measure.driven.iter().map(|(w, a)| a * self.sample(*w, t).acceleration);
        measure.free.iter().map(|(i, a)| a * free(*i)).sum::<f64>() + followed.sum::<f64>()
    }

    /// Motion of a contact; `y` reads a component.
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

    /// Prescribed indentation and its rate.
    #[inline(always)]
    fn pressed(&self, contact: &Contact, t: f64) -> (f64, f64) {
        match &contact.press {
            Press::Constant { d, .. } => (*d, 0.0),
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) => contact.pressed(self.sample(*w, t)),
            // The bodies say.
            Press::Coupled(_) => (0.0, 0.0),
        }
    }

    /// F_x of one contact, N, under its decreed law.
    #[inline(always)]
    pub(crate) fn force(&self, c: usize, motion: &Motion, y: impl Fn(usize) -> f64) -> f64 {
        let contact = &self.model.contacts[c];
        match &self.modes[c] {
            Mode::Slip(branch) if !branch.covers(motion.d, motion.u) => self.dragged(c, branch, motion).0,
            Mode::Slip(branch) => {
                let area = match &contact.press {
                    Press::Constant { area, .. } => *area,
                    _ => contact.law.profile().area(motion.d),
                };
                branch.force(&contact.law, motion.d, motion.u, area)
            }
            Mode::Whole { .. } if contact.inert => 0.0,
            Mode::Whole { .. } => self.whole(c, motion),
            Mode::Grow => contact.slot.map_or(0.0, |slot| y(self.layout.force(slot))),
            Mode::Open => 0.0,
        }
    }

    /// Force by the whole law on the committed memory.
    #[inline(never)]
    fn whole(&self, c: usize, motion: &Motion) -> f64 {
        self.memories[c].force(&self.model.contacts[c].law, motion.apex())
    }

    /// Force and slip front where the edge cuts through a path of growth, found on the committed memory.
    #[inline(never)]
    fn dragged(&self, c: usize, branch: &Branch, motion: &Motion) -> (f64, f64) {
        match &self.memories[c] {
            Memory::Curve(curve) => curve.dragged(&self.model.contacts[c].law, branch.sense(), motion.apex()),
            Memory::Row { .. } => (0.0, 0.0),
        }
    }

    /// Height of the slip front, m.
    pub(crate) fn front(&self, c: usize, branch: &Branch, motion: &Motion) -> f64 {
        if branch.covers(motion.d, motion.u) {
            branch.front(motion.d, motion.u)
        } else {
            self.dragged(c, branch, motion).1
        }
    }

    /// Stiffness of the springs that stick, N/m: what carries a contact's own damping.
    pub(crate) fn stuck_stiffness(&self, c: usize, motion: &Motion) -> f64 {
        let law = &self.model.contacts[c].law;
        match &self.modes[c] {
            Mode::Open => 0.0,
            Mode::Grow => law.stick_stiffness(motion.d),
            Mode::Slip(branch) if branch.is_gross() => 0.0,
            Mode::Slip(branch) => {
                law.stick_stiffness(self.front(c, branch, motion).clamp(0.0, motion.d.max(0.0)))
            }
            Mode::Whole { .. } => self.memories[c].trial(law, Move::Chord(motion.apex())).stiffness,
        }
    }

    /// Slopes of the extra components of a growing contact: Ḟ = G\*m(d)u̇ and Ė = Fu̇ in full stick, friction power
    /// where an edge drags. `extra` begins after the velocities.
    #[inline(never)]
    fn grow(&self, c: usize, slot: usize, motion: &Motion, force: f64, extra: &mut [f64]) {
        let contact = &self.model.contacts[c];
        let (mut rate, mut elastic, mut friction) = (0.0, 0.0, 0.0);
        match &self.modes[c] {
            Mode::Grow => {
                rate = contact.law.stick_stiffness(motion.d) * motion.du;
                elastic = force * motion.du;
            }
            Mode::Slip(branch) => {
                let front = self.front(c, branch, motion);
                friction = branch.friction_power(&contact.law, front, (motion.d, motion.dd), motion.du);
            }
            Mode::Open | Mode::Whole { .. } => {}
        }
        let from = 2 * self.layout.free;
        extra[self.layout.force(slot) - from] = rate;
        extra[self.layout.elastic(slot) - from] = elastic;
        extra[self.layout.friction(slot) - from] = friction;
    }

    /// Forces of all contacts, and the slopes of their extra components.
    #[inline(always)]
    fn contacts(&self, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        let Some(interval) = self.interval else {
            (0..self.model.contacts.len()).for_each(|c| self.contact(c, at, sum, extra));
            return;
        };
        for steady in &interval.steady {
            let force = steady.force(steady.displacement(at.time(), |i| at.component(i)));
            sum.apply(&steady.contact.u.free, steady.driven(), force);
        }
        for &c in &interval.others {
            self.contact(c, at, sum, extra);
        }
    }

    /// Any contact in any mode: its forces, and the slopes of its extra components.
    #[inline(never)]
    fn contact(&self, c: usize, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        let contact = &self.model.contacts[c];
        let u = self.read(&contact.u, at);
        let (d, dd, area) = match &contact.press {
            Press::Coupled(measure) => {
                let d = self.read(measure, at);
                let area = contact.law.profile().area(d.value);
                // Decreed apart, it is so beyond the touch that will end the step.
                if self.modes[c] != Mode::Open {
                    let press = contact.count * (contact.law.normal_modulus() * area);
                    sum.apply(&measure.free, d.driven, -press);
                }
                (d.value, d.rate, area)
            }
            _ => {
                let (d, dd) = self.pressed(contact, at.time());
                (d, dd, contact.law.profile().area(d))
            }
        };
        let motion = Motion { d, u: u.value, dd, du: u.rate };
        let mut force = match (&self.modes[c], contact.slot.filter(|_| self.layout.growing > 0)) {
            (Mode::Slip(branch), Some(slot)) if branch.covers(d, u.value) => {
                let [force, friction] = branch.drag(&contact.law, (d, dd), (u.value, u.rate), area);
                extra[self.layout.friction(slot) - 2 * self.layout.free] = friction;
                force
            }
            (_, slot) => {
                let force = self.force(c, &motion, |i| at.component(i));
                if let Some(slot) = slot {
                    self.grow(c, slot, &motion, force, extra);
                }
                force
            }
        };
        if contact.damping > 0.0 {
            let damping = contact.damping * self.stuck_stiffness(c, &motion);
            sum.damping += contact.count * damping * motion.du * motion.du;
            force += damping * motion.du;
        }
        sum.apply(&contact.u.free, u.driven, -contact.count * force);
    }

    #[inline(never)]
    fn links(&self, at: &impl View, sum: &mut Sum<'_>) {
        for link in &self.model.links {
            let elongation = self.read(&link.elongation, at);
            let stroke = self.stroke(link, at.time());
            let (stretch, rate) = (stroke.value - elongation.value, stroke.rate - elongation.rate);
            let force = link.stiffness * stretch + link.damping * rate;
            sum.apply(&link.elongation.free, elongation.driven, force + link.preload);
            sum.input += force * stroke.rate;
            sum.damping += link.damping * rate * rate;
        }
    }

    /// Free stroke of a link.
    pub(crate) fn stroke(&self, link: &Link, t: f64) -> Sample {
        match link.stroke {
            Stroke::Constant(value) => Sample { value, rate: 0.0, acceleration: 0.0 },
            Stroke::Driven(w) => self.sample(w, t),
        }
    }
}

impl Equations<'_> {
    /// Accelerations without any velocity, and the power put in, W.
    #[inline(never)]
    fn accelerate(&self, at: &Positions<'_>, out: &mut [f64]) {
        let (dv, input) = out.split_at_mut(self.layout.free);
        let mut sum = Sum::new(self.model, dv);
        self.contacts(at, &mut sum, &mut []);
        if !self.model.links.is_empty() {
            self.links(at, &mut sum);
        }
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

    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        let layout = self.layout;
        let v = &y[layout.free..2 * layout.free];
        let (dx, rest) = dy.split_at_mut(layout.free);
        let (dv, extra) = rest.split_at_mut(layout.free);
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
        let (input, damping) = sum.accelerate(self.model);
        let growing = layout.growing;
        (extra[growing], extra[growing + 1]) = (input, damping);
    }

    /// Flight and gross slip under constant loads.
    fn coasts(&self) -> bool {
        self.model.loads.is_empty() && self.interval.is_some_and(|interval| interval.constant)
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
                    let area = pull.area(t, *x);
                    *acceleration += pull.acceleration * area;
                    *input += pull.power * area;
                };
                match &pulls[..] {
                    [pull] => add(pull),
                    pulls => pulls.iter().for_each(add),
                }
            }
            (x, out, _) => self.accelerate(&Positions { t, x }, out),
        }
    }

    /// Gross slip under constant loads: a parabola.
    fn is_constant(&self) -> bool {
        self.interval.is_some_and(|interval| interval.constant)
    }
}
