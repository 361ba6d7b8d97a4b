//! How works change: what followers, strokes and loads put in, what dampers take, and what growing contacts store.
//!
//! They are integrals of powers, on which nothing depends: each is led along as one more row of the linear equations, that of its power,
//! δP = δF·ẇ + F·δẇ, which is summed up over the nodes of a step. A corner that a number moves by δt adds (P₋ - P₊)δt.

use super::parameter::{Moment, Parameter};
use super::steps::Passed;
use super::tangent::Laws;
use crate::contact::{Contact, Mode};
use crate::equations;
use crate::model::Link;
use crate::state::{Layout, State};
use stickslip_stepper::{Coefficients, NODES};

/// Rows of the powers: what is put in, what dampers take, and then what each growing contact stores.
const INPUT: usize = 0;
const DAMPING: usize = 1;
const STORED: usize = 2;

/// Works by all numbers.
#[derive(Debug, Clone, Default)]
pub(super) struct Works {
    /// What was stored when the books began, and what had been put in, J, by each number.
    books: Vec<[f64; 2]>,
    /// What jumps had put in by then, J: whatever a jump puts in later is not led along.
    jumps: f64,
    has_jumped: bool,
    count: usize,
    /// J, row by row.
    sums: Vec<f64>,
    /// Powers at the nodes of a step.
    pub(super) powers: Vec<Coefficients>,
}

impl Works {
    /// Of a run from a state.
    pub(super) fn new(books: Vec<[f64; 2]>, start: &State) -> Self {
        Self { count: books.len(), jumps: start.jumps, books, ..Self::default() }
    }

    /// From here on led along.
    pub(super) fn led(mut self, layout: Layout) -> Self {
        self.sums = vec![0.0; (STORED + layout.growing) * self.count];
        self.powers = vec![Coefficients::default(); NODES];
        self
    }

    /// What was stored when the books began, and what had been put in, J.
    pub(super) fn beginning(&self, j: usize) -> Option<[f64; 2]> {
        self.books.get(j).copied().filter(|_| self.are_led() && !self.has_jumped)
    }

    /// What is put in, J.
    pub(super) fn input(&self, j: usize) -> f64 {
        self.sums[INPUT * self.count + j]
    }

    /// What dampers take, J.
    pub(super) fn damping(&self, j: usize) -> f64 {
        self.sums[DAMPING * self.count + j]
    }

    /// A contact begins to grow with so much stored along the slide, J.
    pub(super) fn store(&mut self, slot: usize, j: usize, stored: f64) {
        self.sums[(STORED + slot) * self.count + j] = stored;
    }

    /// What a contact that grows stores along the slide, J.
    pub(super) fn grown(&self, slot: usize, j: usize) -> f64 {
        self.sums[(STORED + slot) * self.count + j]
    }

    /// Whether they are led along.
    pub(super) fn are_led(&self) -> bool {
        !self.sums.is_empty()
    }

    /// Room for all sums of a step.
    pub(super) fn sums(&mut self) -> (&[Coefficients], &mut [f64]) {
        (&self.powers, &mut self.sums)
    }

    /// Passes a corner which number `j` moves by so much, s, the powers being these on its sides, W: input and damping.
    pub(super) fn turn(&mut self, j: usize, [before, after]: [[f64; 2]; 2], time: f64) {
        for row in [INPUT, DAMPING] {
            self.sums[row * self.count + j] += (before[row] - after[row]) * time;
        }
    }

    /// Looks whether a waveform has jumped.
    pub(super) fn look(&mut self, state: &State) {
        self.has_jumped |= state.jumps != self.jumps;
    }
}

/// What a link does at a moment.
struct Pull {
    /// k(s - e) + c(ṡ - ė), N.
    force: f64,
    /// ṡ - ė, that of the stroke, and what followers make of ė, m/s.
    speed: f64,
    stroke: f64,
    driven: f64,
    stretch: f64,
}

impl Laws<'_> {
    /// The powers where the motion has passed a node, with what numbers of the scene make of them.
    pub(super) fn lay_out_powers(&self, passed: &Passed, powers: &mut Coefficients) {
        let (eq, model, t, y) = (&self.eq, self.eq.model, passed.t, &passed.y[..]);
        let wide = self.components.positions + self.components.rates;
        let rows = STORED + eq.layout.growing;
        powers.matrix.clear();
        powers.matrix.resize(rows * wide, 0.0);
        powers.forcing.clear();
        powers.forcing.resize(rows * self.count, 0.0);
        let at = equations::Components { t, y: |i: usize| y[i] };
        for c in self.acting {
            let contact = &model.contacts[*c];
            let stand = self.stand(contact, eq.motion(contact, t, |i| y[i]), false);
            let motion = &stand.motion;
            let [along, across] = self.driven(contact, &at).map(|driven| contact.count * driven);
            let response = self.response(contact, &stand);
            if along != 0.0 {
                response.pull(along, &mut powers.matrix[..wide]);
                response.hold(along, powers.forcing.get_mut(..self.count));
            }
            if across != 0.0 {
                response.press(across, &mut powers.matrix[..wide]);
            }
            if let (Some(slot), Mode::Grow) = (contact.slot, eq.law(*c).1) {
                let (row, force) = ((STORED + slot) * wide, eq.layout.force(slot));
                powers.matrix[row + force] += motion.du;
                let velocity = |i: usize| row + eq.layout.velocity(i);
                contact.u.free.iter().for_each(|(k, b)| powers.matrix[velocity(*k)] += y[force] * b);
            }
        }
        for link in &model.links {
            let Pull { speed, stroke, driven, .. } = self.link(link, &at);
            for (k, b) in &link.elongation.free {
                let velocity = eq.layout.velocity(*k);
                powers.matrix[*k] -= (stroke - driven) * link.stiffness * b;
                powers.matrix[velocity] -= (stroke - driven) * link.damping * b;
                powers.matrix[DAMPING * wide + velocity] -= 2.0 * link.damping * speed * b;
            }
        }
        for load in &model.loads {
            let force = load.arm * eq.sample(load.waveform, t).value;
            powers.matrix[eq.layout.velocity(load.free)] += force;
        }
        self.move_powers(passed, powers);
    }

    /// Adds what numbers of the scene make of the powers.
    fn move_powers(&self, passed: &Passed, powers: &mut Coefficients) {
        let (eq, model, t, y) = (&self.eq, self.eq.model, passed.t, &passed.y[..]);
        let now = self.moment(passed);
        let at = equations::Components { t, y: |i: usize| y[i] };
        for (place, (j, parameter)) in self.numbers().enumerate() {
            let now = now.by(place);
            let [mut input, mut damping] = [0.0; 2];
            for (l, link) in model.links.iter().enumerate() {
                let pull = self.link(link, &at);
                let (rates, moved) = (parameter.link_rates(l), parameter.stretched(model, l, now));
                let force = parameter.link(model, l, [pull.stretch, pull.speed], now) - rates.preload;
                input += force * (pull.stroke - pull.driven) - rates.preload * pull.driven;
                input += pull.force * (moved.stroke_rate - moved.driven) - link.preload * moved.driven;
                damping += rates.damping * pull.speed * pull.speed
                    + 2.0 * link.damping * pull.speed * (moved.stroke_rate - moved.rate);
            }
            for (l, load) in model.loads.iter().enumerate() {
                let value = eq.sample(load.waveform, t).value;
                input += parameter.load(model, l, value, now) * y[eq.layout.velocity(load.free)];
            }
            powers.forcing[INPUT * self.count + j] += input;
            powers.forcing[DAMPING * self.count + j] += damping;
        }
        for c in self.acting {
            if self.parameters.iter().any(|parameter| parameter.touches(*c)) {
                self.move_contact_powers(&model.contacts[*c], (now, (t, y)), powers);
            }
        }
    }

    /// What all numbers of the scene make of them by way of one contact.
    fn move_contact_powers(
        &self,
        contact: &Contact,
        (now, (t, y)): (Moment<'_>, (f64, &[f64])),
        powers: &mut Coefficients,
    ) {
        let at = equations::Components { t, y: |i: usize| y[i] };
        let stand = self.stand(contact, self.eq.motion(contact, t, |i| y[i]), true);
        let driven = self.driven(contact, &at);
        let growing = contact.slot.filter(|_| *self.eq.law(contact.place).1 == Mode::Grow);
        let [force, press] = self.forces(contact, &stand, y);
        let own = |(_, (_, parameter)): &(usize, (usize, &Parameter))| parameter.touches(contact.place);
        for (place, (j, parameter)) in self.numbers().enumerate().filter(own) {
            let now = now.by(place);
            let shift = parameter.shift(contact, now);
            let [along, across] = self.pulls(contact, parameter, (now, &stand), &mut |_, _| ());
            let of_forces = along * driven[0] + across * driven[1];
            powers.forcing[INPUT * self.count + j] +=
                contact.count * (of_forces + force * shift.driven[0] + press * shift.driven[1]);
            if let Some(slot) = growing {
                powers.forcing[(STORED + slot) * self.count + j] += force * shift.du;
            }
        }
    }

    /// What followers make of the rates of u and d of a contact, m/s.
    fn driven(&self, contact: &Contact, at: &impl equations::View) -> [f64; 2] {
        let depth = contact.coupling().map_or(0.0, |d| self.eq.read(d, at).driven);
        [self.eq.read(&contact.u, at).driven, depth]
    }

    fn link(&self, link: &Link, at: &impl equations::View) -> Pull {
        let (length, stroke) = (self.eq.read(&link.elongation, at), self.eq.stroke(link, at));
        let (stretch, speed) = (stroke.value - length.value, stroke.rate - length.rate);
        let force = link.stiffness * stretch + link.damping * speed;
        Pull { force, speed, stroke: stroke.rate, driven: length.driven, stretch }
    }
}
