//! Precomputed forces of the time interval between two events (kernel).
//!
//! Each step evaluates the equations about ten times. All data that stay until the next event are therefore stored contiguously: rows of
//! Jacobians, prescribed motions in closed form, and laws of contacts. Up to four coordinates, rows have a constant length. Elements
//! without such a form (curved prescribed motions, rows of springs, the full force law) use the general [`Equations`], with the same
//! result.

mod contacts;
mod length;
mod links;

use super::{Closed, emptied};
use crate::equations::{Components, Equations, Positions, Sum, View};
use crate::model::Model;
use crate::state::State;
pub(crate) use contacts::Lever;
use contacts::{Moving, Steady};
use length::Dense;
pub(crate) use length::{Row, Sparse};
use links::{Spring, Tie};
use std::mem::discriminant;
use stickslip_contact::{FixedDepthBranch, Law};

/// Precomputed forces of the time interval between two events. Scratch memory, rebuilt after each event.
#[derive(Debug, Clone, Default)]
pub(crate) enum Kernel<'a> {
    /// For models that need the general equations.
    #[default]
    None,
    One(Forces<'a, Dense<1>>),
    Two(Forces<'a, Dense<2>>),
    Three(Forces<'a, Dense<3>>),
    Four(Forces<'a, Dense<4>>),
    Many(Forces<'a, Sparse>),
}

/// Forces of all elements, with the rows of one number of coordinates.
#[derive(Debug, Clone)]
pub(crate) struct Forces<'a, R> {
    /// Whether the forces are those of the interval; otherwise the general equations are used.
    is_laid_out: bool,
    steady: Vec<Steady<'a, R>>,
    moving: Vec<Moving<'a, R>>,
    springs: Vec<Spring<R>>,
    ties: Vec<Tie<'a, R>>,
    /// Contacts and links that use the general equations, and whether there are any or varying loads.
    is_general: bool,
    others: Vec<usize>,
    links: Vec<usize>,
}

/// Evaluates an expression with the forces of the kernel, whatever their rows.
macro_rules! each {
    ($kernel:expr, $forces:ident => $act:expr, $none:expr) => {
        match $kernel {
            Self::None => $none,
            Self::One($forces) => $act,
            Self::Two($forces) => $act,
            Self::Three($forces) => $act,
            Self::Four($forces) => $act,
            Self::Many($forces) => $act,
        }
    };
}

impl<'a> Kernel<'a> {
    /// Returns a kernel without forces for a model.
    pub(super) fn of(model: &Model) -> Self {
        match rows(model) {
            Some(1) => Self::One(Forces::empty()),
            Some(2) => Self::Two(Forces::empty()),
            Some(3) => Self::Three(Forces::empty()),
            Some(4) => Self::Four(Forces::empty()),
            Some(_) => Self::Many(Forces::empty()),
            None => Self::None,
        }
    }

    /// Returns the kernel for another model, in the same memory if that has the same rows.
    pub(super) fn renewed(self, model: &Model) -> Self {
        let other = Self::of(model);
        if discriminant(&self) == discriminant(&other) { self } else { other }
    }

    /// Returns the allocated memory of the kernel, empty.
    pub(super) fn emptied(self) -> Kernel<'static> {
        match self {
            Self::None => Kernel::None,
            Self::One(forces) => Kernel::One(forces.emptied()),
            Self::Two(forces) => Kernel::Two(forces.emptied()),
            Self::Three(forces) => Kernel::Three(forces.emptied()),
            Self::Four(forces) => Kernel::Four(forces.emptied()),
            Self::Many(forces) => Kernel::Many(forces.emptied()),
        }
    }

    /// Clears the precomputed forces, so that the general equations are used.
    pub(super) fn clear(&mut self) {
        each!(self, forces => forces.clear(), {});
    }

    /// Computes the forces of an interval, whose contacts `closed` have closed-form forces; `others` are pressed, too. The flag says whether
    /// forces of contacts growing in full stick are states.
    pub(super) fn lay_out(&mut self, of: (&'a Model, &State, bool), closed: &[Closed<'a>], others: &[usize]) {
        each!(self, forces => forces.lay_out(of, closed, others), {});
    }

    /// Sets another branch of the slip memory for a contact, given by its index among those with a closed-form force.
    pub(super) fn renew(&mut self, place: usize, branch: FixedDepthBranch) {
        each!(self, forces => forces.steady.get_mut(place).into_iter().for_each(|it| it.renew(branch)), {});
    }

    /// Sets another law of contact `c`, which has no closed-form force. Returns false if the forces must be computed anew.
    pub(super) fn renew_moving(&mut self, c: usize, law: &Law) -> bool {
        each!(self, forces => forces.renew_moving(c, law), false)
    }

    /// Returns whether the kernel has the forces of the interval.
    #[inline(always)]
    pub(crate) fn is_laid_out(&self) -> bool {
        each!(self, forces => forces.is_laid_out, false)
    }

    /// Writes the slopes of all components, as [`Equations::slopes`](stickslip_stepper::System::slopes).
    #[inline(always)]
    pub(crate) fn slopes(&self, eq: &Equations<'_>, t: f64, y: &[f64], dy: &mut [f64]) {
        each!(self, forces => match forces.moving.is_empty() {
            true => Forces::slopes::<false>(eq, t, y, dy, forces),
            false => Forces::slopes::<true>(eq, t, y, dy, forces),
        }, {});
    }

    /// Writes accelerations, computed without velocities, and the input power.
    #[inline(always)]
    pub(crate) fn accelerations(&self, eq: &Equations<'_>, at: (f64, &[f64]), out: &mut [f64]) {
        each!(self, forces => forces.accelerations(eq, at, out), {});
    }
}

/// Returns the number of free coordinates, if the forces of the model may be precomputed.
fn rows(model: &Model) -> Option<usize> {
    // Blocks and balanced coordinates need the forces of all others first; so does the rate of an indentation with damping.
    let fits = !model.free.is_empty()
        && model.blocks.is_empty()
        && model.balanced.is_empty()
        && model.contacts.iter().all(|contact| contact.normal_damping == 0.0);
    fits.then_some(model.free.len())
}

impl<'a, R: Row> Forces<'a, R> {
    fn empty() -> Self {
        Self {
            is_laid_out: false,
            steady: Vec::new(),
            moving: Vec::new(),
            springs: Vec::new(),
            ties: Vec::new(),
            is_general: false,
            others: Vec::new(),
            links: Vec::new(),
        }
    }

    fn emptied(self) -> Forces<'static, R> {
        let mut forces = Forces {
            steady: emptied(self.steady),
            moving: emptied(self.moving),
            springs: self.springs,
            ties: emptied(self.ties),
            others: self.others,
            links: self.links,
            ..Forces::empty()
        };
        forces.clear();
        forces
    }

    fn clear(&mut self) {
        self.is_laid_out = false;
        self.steady.clear();
        self.moving.clear();
        self.springs.clear();
        self.ties.clear();
        self.others.clear();
        self.links.clear();
    }

    fn lay_out(
        &mut self,
        (model, state, grows): (&'a Model, &State, bool),
        closed: &[Closed<'a>],
        others: &[usize],
    ) {
        self.clear();
        // Room for any later interval: afterwards nothing is allocated.
        self.steady.reserve(model.contacts.len());
        self.moving.reserve(model.contacts.len());
        self.others.reserve(model.contacts.len());
        self.springs.reserve(model.links.len());
        self.ties.reserve(model.links.len());
        self.links.reserve(model.links.len());
        self.steady.extend(closed.iter().map(Steady::of));
        for &c in others {
            match Moving::of(c, model, state, grows) {
                Some(moving) => self.moving.push(moving),
                None => self.others.push(c),
            }
        }
        for (k, link) in model.links.iter().enumerate() {
            let tie = Tie::of(link, model, state);
            match (tie.as_ref().and_then(Spring::of), tie) {
                (Some(spring), _) => self.springs.push(spring),
                (None, Some(tie)) => self.ties.push(tie),
                (None, None) => self.links.push(k),
            }
        }
        self.is_general = !self.others.is_empty() || !self.links.is_empty() || !model.loads.is_empty();
        self.is_laid_out = true;
    }

    fn renew_moving(&mut self, c: usize, law: &Law) -> bool {
        self.moving.iter_mut().find(|moving| moving.index == c).is_some_and(|moving| moving.renew(law))
    }

    /// `MOVING` says whether any contact is of this kind, whose law needs all registers.
    // The order of the arguments avoids moves between registers at the call.
    #[inline(never)]
    fn slopes<const MOVING: bool>(eq: &Equations<'_>, t: f64, y: &[f64], dy: &mut [f64], forces: &Self) {
        // A constant for few coordinates: all lengths below are then constants, too.
        let n = R::COUNT.unwrap_or(eq.layout.free);
        let (x, v) = (&y[..n], &y[n..2 * n]);
        let (dx, rest) = dy.split_at_mut(n);
        let (dv, extra) = rest.split_at_mut(n);
        dx.copy_from_slice(v);
        if eq.layout.growing > 0 {
            extra.fill(0.0);
        }
        let mut powers = R::summed(eq.model, dv, |mut sum| {
            for steady in &forces.steady {
                steady.act(t, x, &mut sum);
            }
            if MOVING {
                for moving in &forces.moving {
                    moving.act((eq, y), t, (x, v), (&mut sum, extra));
                }
            }
            forces.act_on_links(t, (x, Some(v)), &mut sum);
            [sum.input, sum.damping]
        });
        if forces.is_general {
            let mut sum = Sum { dv, input: powers[0], damping: powers[1] };
            forces.act_generally(eq, &Components { t, y: |i: usize| y[i] }, &mut sum, extra);
            eq.loads(t, v, &mut sum);
            powers = [sum.input, sum.damping];
        }
        R::accelerate(eq.model, dv);
        let first = eq.layout.input() - 2 * n;
        [extra[first], extra[first + 1]] = powers;
    }

    #[inline(never)]
    fn accelerations(&self, eq: &Equations<'_>, (t, x): (f64, &[f64]), out: &mut [f64]) {
        let n = R::COUNT.unwrap_or(x.len());
        let (x, (dv, input)) = (&x[..n], out.split_at_mut(n));
        input[0] = R::summed(eq.model, dv, |mut sum| {
            for steady in &self.steady {
                steady.act(t, x, &mut sum);
            }
            self.act_on_links(t, (x, None), &mut sum);
            sum.input
        });
        if self.is_general || !self.moving.is_empty() {
            let (mut sum, at) = (Sum { dv, input: input[0], damping: 0.0 }, Positions { t, x });
            self.moving.iter().for_each(|moving| eq.contact(moving.index, &at, &mut sum, &mut []));
            self.act_generally(eq, &at, &mut sum, &mut []);
            input[0] = sum.input;
        }
        R::accelerate(eq.model, dv);
    }

    #[inline(always)]
    fn act_on_links(&self, t: f64, at: (&[f64], Option<&[f64]>), sum: &mut Sum<'_>) {
        for spring in &self.springs {
            spring.act(at.0, sum.dv);
        }
        for tie in &self.ties {
            tie.act(t, at, sum);
        }
    }

    /// Adds the forces of the elements without a precomputed form.
    #[inline(never)]
    fn act_generally(&self, eq: &Equations<'_>, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        self.others.iter().for_each(|c| eq.contact(*c, at, sum, extra));
        self.links.iter().for_each(|k| eq.link(&eq.model.links[*k], at, sum));
    }
}
