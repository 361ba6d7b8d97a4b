//! The equations of motion, evaluated on borrowed memory.

use crate::model::{Contact, Motion, Place, Press, Stroke};
use crate::state::{Layout, Mode};
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

impl Equations<'_> {
    /// Waveform `w` at time t. Within a smooth piece this is exact up to and including its end.
    #[inline(always)]
    pub(crate) fn sample(&self, w: usize, t: f64) -> Sample {
        let (waveform, piece) = (&self.model.waveforms[w], &self.pieces[w]);
        if self.crossing {
            // A step aligned with a corner may miss it by rounding; that is still the same piece.
            let slack = CORNER_SLACK * (piece.end - piece.start);
            if t < piece.start - slack || t > piece.end + slack {
                return waveform.sample(&waveform.piece_at(t), t);
            }
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
    #[inline]
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
            Mode::Whole { .. } => self.memories[c].force(&contact.law, motion.apex()),
            Mode::Grow => contact.slot.map_or(0.0, |slot| y(self.layout.force(slot))),
            Mode::Open => 0.0,
        }
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

    /// Slopes of the extra components of a growing contact: Ḟ = G\*m(d)u̇ and Ė = Fu̇ in full stick, friction
    /// power where an edge drags.
    fn grow(&self, c: usize, slot: usize, motion: &Motion, force: f64, dy: &mut [f64]) {
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
        dy[self.layout.force(slot)] = rate;
        dy[self.layout.elastic(slot)] = elastic;
        dy[self.layout.friction(slot)] = friction;
    }

    fn contacts(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let first = self.place(contact.first, t, |i| y[i]);
            let second = self.place(contact.second, t, |i| y[i]);
            let motion = self.relative(contact, t, (first, second));
            let one = self.force(c, &motion, |i| y[i]);
            if let (Some(slot), true) = (contact.slot, self.layout.growing > 0) {
                self.grow(c, slot, &motion, one, dy);
            }
            let force = contact.count * one;
            self.apply(contact.first, first.1, -force, dy);
            self.apply(contact.second, second.1, force, dy);
        }
    }

    fn links(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        for link in &self.model.links {
            let (x1, v1) = self.place(link.first, t, |i| y[i]);
            let (x2, v2) = self.place(link.second, t, |i| y[i]);
            let stroke = match link.stroke {
                Stroke::Constant(value) => Sample { value, rate: 0.0, acceleration: 0.0 },
                Stroke::Driven(w) => self.sample(w, t),
            };
            let (stretch, rate) = (stroke.value - (x2 - x1), stroke.rate - (v2 - v1));
            let force = link.stiffness * stretch + link.damping * rate;
            self.apply(link.first, v1, -force - link.preload, dy);
            self.apply(link.second, v2, force + link.preload, dy);
            dy[self.layout.input()] += force * stroke.rate;
            dy[self.layout.damping()] += link.damping * rate * rate;
        }
    }

    /// Adds a force on a place that moves with velocity v. What drives a follower supplies the opposite force: its
    /// power is input.
    #[inline]
    fn apply(&self, place: Place, v: f64, force: f64, dy: &mut [f64]) {
        match place {
            Place::Held(_) => {}
            Place::Free(i) => dy[self.layout.velocity(i)] += force,
            Place::Driven(_) => dy[self.layout.input()] -= force * v,
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
        let mut input = 0.0;
        for (i, free) in self.model.free.iter().enumerate() {
            let v = y[layout.velocity(i)];
            dy[i] = v;
            dy[layout.velocity(i)] = free.force;
            input += free.force * v;
        }
        dy[layout.input()] = input;
        dy[layout.damping()] = 0.0;
        self.contacts(t, y, dy);
        self.links(t, y, dy);
        for load in &self.model.loads {
            let force = self.sample(load.waveform, t).value;
            dy[layout.velocity(load.free)] += force;
            dy[layout.input()] += force * y[layout.velocity(load.free)];
        }
        for (i, free) in self.model.free.iter().enumerate() {
            dy[layout.velocity(i)] *= free.mobility;
        }
    }
}
