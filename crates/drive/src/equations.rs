//! The equations of motion, evaluated on borrowed memory.

use crate::model::{Contact, Motion, Place, Press, Stroke};
use crate::state::{Layout, Mode, State};
use crate::{Model, Piece, Sample};
use stickslip_contact::{Branch, Memory};
use stickslip_stepper::System;

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
}

impl<'a> Equations<'a> {
    /// The equations on a state as it stands.
    pub(crate) fn on(model: &'a Model, state: &'a State, layout: Layout, crossing: bool) -> Self {
        let State { pieces, memories, modes, .. } = state;
        Self { model, pieces, memories, modes, layout, crossing }
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

    /// Position and velocity of a place; `y` reads a component.
    #[inline(always)]
    pub(crate) fn place(&self, place: Place, t: f64, y: impl Fn(usize) -> f64) -> (f64, f64) {
        match place {
            Place::Held(x) => (x, 0.0),
            Place::Free(i) => (y(i), y(self.layout.velocity(i))),
            Place::Driven(w) => {
                let sample = self.sample(w, t);
                (sample.value, sample.rate)
            }
        }
    }

    /// Motion of a contact; `y` reads a component.
    #[inline]
    pub(crate) fn motion(&self, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> Motion {
        let ends = (self.place(contact.first, t, &y), self.place(contact.second, t, &y));
        self.relative(contact, t, ends)
    }

    /// Motion of a contact from position and velocity of its two sides.
    #[inline(always)]
    fn relative(&self, contact: &Contact, t: f64, ((x1, v1), (x2, v2)): ((f64, f64), (f64, f64))) -> Motion {
        let (d, dd) = match contact.press {
            Press::Constant { d, .. } => (d, 0.0),
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) => contact.pressed(self.sample(w, t)),
        };
        Motion { d, u: x1 - x2 - contact.offset, dd, du: v1 - v2 }
    }

    /// F_x of one contact, N, under its decreed law.
    #[inline(always)]
    pub(crate) fn force(&self, c: usize, motion: &Motion, y: impl Fn(usize) -> f64) -> f64 {
        let contact = &self.model.contacts[c];
        match &self.modes[c] {
            Mode::Slip(branch) if !branch.covers(motion.d, motion.u) => self.dragged(c, branch, motion).0,
            Mode::Slip(branch) => {
                let area = match contact.press {
                    Press::Constant { area, .. } => area,
                    _ => contact.law.profile().area(motion.d),
                };
                branch.force(&contact.law, motion.d, motion.u, area)
            }
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

    #[inline(always)]
    fn contacts(&self, sides: &Sides<'_>, y: &[f64], sum: &mut Sum<'_>, extra: &mut [f64]) {
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let (first, second) = (sides.of(contact.first), sides.of(contact.second));
            let force = match (&self.modes[c], contact.press) {
                // What nearly all evaluations of nearly all scenes are.
                (Mode::Slip(branch), Press::Constant { d, area }) => {
                    branch.force(&contact.law, d, first.0 - second.0 - contact.offset, area)
                }
                _ => self.contact(c, sides.t, (first, second), y, extra),
            };
            let force = contact.count * force;
            sum.apply(contact.first, first.1, -force);
            sum.apply(contact.second, second.1, force);
        }
    }

    /// Any contact in any mode: F_x of one, and the slopes of its extra components.
    #[inline(never)]
    fn contact(&self, c: usize, t: f64, ends: ((f64, f64), (f64, f64)), y: &[f64], extra: &mut [f64]) -> f64 {
        let contact = &self.model.contacts[c];
        let motion = self.relative(contact, t, ends);
        let force = self.force(c, &motion, |i| y[i]);
        if let (Some(slot), true) = (contact.slot, self.layout.growing > 0) {
            self.grow(c, slot, &motion, force, extra);
        }
        force
    }

    #[inline(never)]
    fn links(&self, sides: &Sides<'_>, sum: &mut Sum<'_>) {
        for link in &self.model.links {
            let ((x1, v1), (x2, v2)) = (sides.of(link.first), sides.of(link.second));
            let stroke = match link.stroke {
                Stroke::Constant(value) => Sample { value, rate: 0.0, acceleration: 0.0 },
                Stroke::Driven(w) => self.sample(w, sides.t),
            };
            let (stretch, rate) = (stroke.value - (x2 - x1), stroke.rate - (v2 - v1));
            let force = link.stiffness * stretch + link.damping * rate;
            sum.apply(link.first, v1, -force - link.preload);
            sum.apply(link.second, v2, force + link.preload);
            sum.input += force * stroke.rate;
            sum.damping += link.damping * rate * rate;
        }
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
        let (x, rest) = y.split_at(layout.free);
        let v = &rest[..layout.free];
        let sides = Sides { equations: self, t, x, v };
        let (dx, rest) = dy.split_at_mut(layout.free);
        let (dv, extra) = rest.split_at_mut(layout.free);
        let mut input = 0.0;
        for (((free, v), dx), dv) in self.model.free.iter().zip(v).zip(dx).zip(dv.iter_mut()) {
            *dx = *v;
            *dv = free.force;
            input += free.force * v;
        }
        let mut sum = Sum { dv, input, damping: 0.0 };
        self.contacts(&sides, y, &mut sum, extra);
        if !self.model.links.is_empty() {
            self.links(&sides, &mut sum);
        }
        for load in &self.model.loads {
            let force = self.sample(load.waveform, t).value;
            sum.dv[load.free] += force;
            sum.input += force * v[load.free];
        }
        for (free, dv) in self.model.free.iter().zip(sum.dv.iter_mut()) {
            *dv *= free.mobility;
        }
        let growing = layout.growing;
        (extra[growing], extra[growing + 1]) = (sum.input, sum.damping);
    }
}

/// Positions and velocities at one moment.
struct Sides<'a> {
    equations: &'a Equations<'a>,
    t: f64,
    x: &'a [f64],
    v: &'a [f64],
}

impl Sides<'_> {
    #[inline(always)]
    fn of(&self, place: Place) -> (f64, f64) {
        match place {
            Place::Held(x) => (x, 0.0),
            Place::Free(i) => (self.x[i], self.v[i]),
            Place::Driven(w) => {
                let sample = self.equations.sample(w, self.t);
                (sample.value, sample.rate)
            }
        }
    }
}

/// Forces on the free coordinates, and powers, as they add up.
struct Sum<'a> {
    dv: &'a mut [f64],
    input: f64,
    damping: f64,
}

impl Sum<'_> {
    /// Adds a force on a place that moves with velocity v. What drives a follower supplies the opposite force: its
    /// power is input.
    #[inline(always)]
    fn apply(&mut self, place: Place, v: f64, force: f64) {
        match place {
            Place::Held(_) => {}
            Place::Free(i) => self.dv[i] += force,
            Place::Driven(_) => self.input -= force * v,
        }
    }
}
