//! Equations of motion, evaluated without any change of the contacts' slip memory.
//!
//! M q̈ = Σ forces of contacts, links, loads and blocks, plus integrals that do not influence the motion: work, dissipation, elastic energy
//! and friction work of contacts that grow in full stick. Integration methods evaluate slopes, or only accelerations if no force depends on
//! a velocity. Records and event functions use the same functions.
//!
//! An evaluation has no side effects and does not change force laws. A law is smooth beyond the event that ends it.

mod balance;
mod blocks;
mod forces;
mod sum;

use crate::contact::{Contact, Motion, Press};
pub(crate) use balance::Instant;
use blocks::Outputs;
use sum::Once;
pub(crate) use sum::{Components, Positions, Reading, Sum, View, accelerate, constant_forces};

use crate::interval::{Interval, Kernel, Pull};
use crate::model::{Binding, BlockState, Measure};
use crate::state::{Layout, State};
use crate::{Model, Piece, Sample};
use stickslip_contact::{Law, Memory};
use stickslip_stepper::{Conservative, System};

/// Right-hand side of the equations of motion. The struct holds shared references only, so evaluation has no side effects.
#[derive(Clone, Copy)]
pub(crate) struct Equations<'a> {
    pub(crate) model: &'a Model,
    /// Current smooth piece of each waveform.
    pub(crate) pieces: &'a [Piece],
    /// Slip memories of the contacts at the last accepted step.
    pub(crate) memories: &'a [Memory],
    /// Present law of each contact.
    pub(crate) modes: &'a [Law],
    pub(crate) blocks: &'a [BlockState],
    pub(crate) layout: Layout,
    /// Precomputed quantities that are constant until the next event.
    pub(crate) interval: Option<&'a Interval<'a>>,
}

impl<'a> Equations<'a> {
    /// Returns the equations for a state. `layout` may omit the state components of contacts that grow in full stick.
    pub(crate) fn on(model: &'a Model, state: &'a State, layout: Layout) -> Self {
        let State { pieces, memories, modes, blocks, .. } = state;
        Self { model, pieces, memories, modes, blocks, layout, interval: None }
    }
}

impl<'a> Equations<'a> {
    /// Returns memory and law of a contact.
    pub(crate) fn law(&self, c: usize) -> (&'a Memory, &'a Law) {
        (&self.memories[c], &self.modes[c])
    }

    /// Returns waveform `w` at time t; the value is exact within a smooth piece, including its end.
    #[inline(always)]
    pub(crate) fn sample(&self, w: usize, t: f64) -> Sample {
        self.model.waveforms[w].sample(&self.pieces[w], t)
    }

    /// Returns a coordinate and its rate: m and m/s, or rad and rad/s.
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

    /// Returns the value and the rates of a linear form of the coordinates at one time.
    ///
    /// The value is constant + Σ aq + Σ bw over free coordinates q and followed signals w. For a [`View`] without velocities, the rate is
    /// that of the signals only.
    #[inline(always)]
    pub(crate) fn read<V: View>(&self, measure: &Measure, at: &V) -> Reading {
        let (mut own, mut rate) = (0.0, 0.0);
        for &(i, a) in &measure.free {
            own += a * at.component(i);
            // A compile-time branch: Nyström stages have no velocities.
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
        // Large displacements of two bodies cancel first.
        Reading { value: measure.constant + (own + followed), rate: rate + driven, driven }
    }

    /// Returns the value of a linear form, bit-identical to [`Self::read`].
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

    /// Returns the second time derivative of a linear form, m/s²; `free` returns that of a free coordinate. Prescribed motions are exact
    /// within a smooth piece.
    pub(crate) fn acceleration(&self, measure: &Measure, at: &impl View, free: impl Fn(usize) -> f64) -> f64 {
        let followed = measure.driven.iter().map(|(w, a)| a * self.signal(*w, at).acceleration);
        measure.free.iter().map(|(i, a)| a * free(*i)).sum::<f64>() + followed.sum::<f64>()
    }

    /// Returns the motion of a contact; `y` returns a component of the state.
    ///
    /// The motion consists of d, u (m) and their rates (m/s). u counts from its shifted origin; d is negative for an open contact.
    #[inline]
    pub(crate) fn motion(&self, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> Motion {
        let at = Components { t, y };
        let u = self.read(&contact.u, &at);
        let (d, dd) = match contact.coupling() {
            Some(measure) if contact.normal_damping > 0.0 => self.damped(contact, measure, &at),
            Some(measure) => {
                let d = self.read(measure, &at);
                (d.value, d.rate)
            }
            None => self.pressed(contact, t),
        };
        Motion { d, u: u.value, dd, du: u.rate }
    }

    /// Returns the indentation d + βḋ of a contact with damping along the normal, m, and its rate, m/s.
    #[inline(never)]
    fn damped(&self, contact: &Contact, measure: &Measure, at: &impl View) -> (f64, f64) {
        let d = self.read(measure, at);
        let depth = contact.damped([d.value, d.rate], self.law(contact.place));
        if depth == d.value {
            return (d.value, d.rate);
        }
        let y: Vec<f64> = (0..self.layout.dimension()).map(|i| at.component(i)).collect();
        let mut slopes = vec![0.0; self.layout.dimension().max(self.layout.total())];
        self.all_slopes(at.time(), &y, &mut slopes);
        let bend = self.acceleration(measure, at, |i| slopes[self.layout.velocity(i)]);
        (depth, d.rate + contact.normal_damping * bend)
    }

    /// Returns the elastic energy of the normal deformation of one contact, J.
    ///
    /// With damping along the normal it is that of the distance d of the bodies, and 0 while bodies that press each other are apart.
    pub(crate) fn normal_energy(&self, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> f64 {
        let d = match &contact.press {
            Press::Coupled(_) if contact.normal_damping > 0.0 && self.modes[contact.place].is_open() => {
                return 0.0;
            }
            _ => self.distance(contact, t, y)[0],
        };
        contact.interface.normal_energy(d)
    }

    /// Returns the indentation of a contact without damping along the normal, d (m), and its rate (m/s).
    pub(crate) fn distance(&self, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> [f64; 2] {
        match &contact.press {
            Press::Coupled(measure) => {
                let Reading { value, rate, .. } = self.read(measure, &Components { t, y });
                [value, rate]
            }
            Press::Indentation(w) => {
                let Sample { value, rate, .. } = self.sample(*w, t);
                [value, rate]
            }
            _ => self.pressed(contact, t).into(),
        }
    }

    /// Returns indentation d and displacement u of a contact, m, without rates.
    #[inline]
    pub(crate) fn standing(&self, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> Motion {
        let at = Components { t, y };
        let d = match contact.coupling() {
            Some(measure) if contact.normal_damping > 0.0 => {
                let d = self.read(measure, &at);
                contact.damped([d.value, d.rate], self.law(contact.place))
            }
            Some(measure) => self.length(measure, &at),
            None => self.pressed(contact, t).0,
        };
        Motion { d, u: self.length(&contact.u, &at), ..Motion::default() }
    }

    /// Returns the displacement u of a contact from its shifted origin, m, and its rate, m/s.
    #[inline]
    pub(crate) fn slide(&self, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> Reading {
        self.read(&contact.u, &Components { t, y })
    }

    /// Returns the prescribed indentation (m) and its rate (m/s).
    #[inline(always)]
    pub(crate) fn pressed(&self, contact: &Contact, t: f64) -> (f64, f64) {
        match &contact.press {
            Press::Constant { d, .. } => (*d, 0.0),
            Press::Indentation(w) if contact.normal_damping > 0.0 => {
                let Sample { value, rate, acceleration } = self.sample(*w, t);
                let depth = contact.damped([value, rate], self.law(contact.place));
                let bend = if depth == value { 0.0 } else { contact.normal_damping * acceleration };
                (depth, rate + bend)
            }
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) => {
                contact.pressed(self.sample(*w, t), self.modes[contact.place].lull())
            }
            Press::Coupled(_) => (0.0, 0.0),
        }
    }
}

impl Equations<'_> {
    /// Returns the precomputed equations until the next event, if they contain all forces.
    #[inline(always)]
    fn kernel(&self) -> Option<&Kernel<'_>> {
        self.interval.map(|interval| &interval.kernel).filter(|kernel| kernel.is_laid_out())
    }

    /// Computes accelerations without velocities, and the input power, W.
    ///
    /// `out` receives q̈ of the free coordinates, then the input power. Valid only without dampers, varying loads, growth and blocks.
    #[inline(never)]
    fn accelerate(&self, at: &Positions<'_>, out: &mut [f64]) {
        let (dv, input) = out.split_at_mut(self.layout.free);
        let mut sum = Sum::new(&self.model.free, dv);
        self.contacts(at, &mut sum, &mut []);
        self.model.links.iter().for_each(|link| self.link(link, at, &mut sum));
        // Contacts compute their friction work from the memory; nothing else dissipates.
        input[0] = sum.input;
        accelerate(&self.model.free, dv);
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
            Some(kernel) => kernel.slopes(self, t, y, dy),
            None => self.all_slopes(t, y, dy),
        }
    }

    /// Returns whether forces are constant, as in flight and in gross slip under constant loads.
    fn coasts(&self) -> bool {
        self.interval.is_some_and(Interval::is_constant)
    }
}

impl Equations<'_> {
    /// Writes the slopes of all state components without precomputed equations. Not inlined, because this case is rare.
    #[inline(never)]
    fn all_slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        let layout = self.layout;
        let v = &y[layout.free..2 * layout.free];
        let (dx, rest) = dy.split_at_mut(layout.free);
        let (dv, extra) = rest.split_at_mut(layout.free);
        // Slopes of positions are the velocities of the state.
        dx.copy_from_slice(v);
        // Open contacts leave their slopes at zero.
        extra.fill(0.0);
        let mut sum = Sum::new(&self.model.free, dv);
        let at = Components { t, y: |i: usize| y[i] };
        let mut outputs = Outputs::new();
        // The output of a single block has one reader.
        if self.blocks.len() > 1 || !self.model.balanced.is_empty() {
            self.compute_outputs(&at, &mut outputs);
        }
        let at = Once { at: &at, outputs: &outputs };
        self.contacts(&at, &mut sum, extra);
        self.model.links.iter().for_each(|link| self.link(link, &at, &mut sum));
        self.loads(t, v, &mut sum);
        if !self.model.blocks.is_empty() {
            self.blocks(&at, &mut sum, extra);
        }
        if !self.model.balanced.is_empty() {
            self.balance(&at, &mut sum, extra);
        }
        let powers = [sum.input, sum.damping];
        accelerate(&self.model.free, dv);
        let first = layout.input() - 2 * layout.free;
        [extra[first], extra[first + 1]] = powers;
        for contact in self.model.contacts.iter().filter(|contact| contact.normal_damping > 0.0) {
            self.grow_damped(contact, &at, dv, extra);
        }
    }
}

impl Conservative for Equations<'_> {
    #[inline(always)]
    fn accelerations(&self, t: f64, x: &[f64], out: &mut [f64]) {
        match (x, out, self.interval) {
            // One slider, as in most drives: no loop over coordinates.
            ([x], [acceleration, input], Some(Interval { slider: Some(slider), pulls, .. })) => {
                (*acceleration, *input) = (slider.acceleration, slider.power);
                let mut add = |pull: &Pull<'_>| {
                    let reduced_force = pull.reduced_force(t, *x);
                    *acceleration += pull.acceleration * reduced_force;
                    *input += pull.power * reduced_force;
                };
                match &pulls[..] {
                    [pull] => add(pull),
                    pulls => pulls.iter().for_each(add),
                }
            }
            (x, out, Some(Interval { kernel, .. })) if kernel.is_laid_out() => {
                kernel.accelerations(self, (t, x), out);
            }
            (x, out, _) => self.accelerate(&Positions { t, x }, out),
        }
    }

    /// Returns whether the motion is a parabola, as in gross slip under constant loads.
    fn coasts(&self) -> bool {
        self.interval.is_some_and(Interval::is_constant)
    }
}
