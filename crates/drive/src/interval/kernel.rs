//! Precomputed forces of the time interval between two events (kernel).
//!
//! Each step evaluates the equations about ten times. For up to [`WIDTH`] free coordinates, all data until the next event are stored
//! contiguously: padded rows of Jacobians, prescribed motions in closed form, and laws of contacts. Larger models use sparse rows
//! ([`wide`]). Curved prescribed motions, rows of springs, the full force law, blocks and varying loads require the general [`Equations`],
//! with the same result.

mod contacts;
mod length;
mod ties;
mod wide;

use super::{Closed, emptied};
use crate::equations::Equations;
use crate::model::Model;
use crate::state::State;
use contacts::{Moving, Steady};
use length::{Row, Sums};
use stickslip_contact::FixedDepthBranch;
use ties::Tie;
use wide::Wide;

/// Largest number of free coordinates with padded rows: two bodies in two directions.
pub(crate) const WIDTH: usize = 4;

/// Precomputed forces of the time interval between two events. Scratch memory, rebuilt after each event.
#[derive(Debug, Clone, Default)]
pub(crate) struct Kernel<'a> {
    extent: Extent,
    /// Sum of gravity and constant loads, N or N m, and inverse mass of each coordinate.
    forces: Row,
    mobilities: Row,
    steady: Vec<Steady<'a>>,
    moving: Vec<Moving<'a>>,
    links: Vec<Tie<'a>>,
    wide: Wide<'a>,
}

/// Completeness of the precomputed forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Extent {
    /// Incomplete: the general equations are used.
    #[default]
    Part,
    /// Complete, with padded rows.
    Narrow,
    /// Complete, with sparse rows.
    Wide,
}

impl<'a> Kernel<'a> {
    /// Returns whether the forces of a model may be precomputed.
    fn fits(model: &Model) -> bool {
        !model.free.is_empty()
            && model.loads.is_empty()
            && model.blocks.is_empty()
            && model.balanced.is_empty()
    }

    /// Reserves memory for the forces of a model.
    pub(super) fn reserve(&mut self, model: &Model) {
        self.clear();
        if model.free.len() > WIDTH {
            return self.wide.reserve(model);
        }
        self.steady.reserve(model.contacts.len());
        self.moving.reserve(model.contacts.len());
        self.links.reserve(model.links.len());
    }

    /// Returns the allocated memory of the kernel, empty.
    pub(super) fn emptied(self) -> Kernel<'static> {
        let (steady, moving, links) = (emptied(self.steady), emptied(self.moving), emptied(self.links));
        Kernel { steady, moving, links, wide: self.wide.emptied(), ..Kernel::default() }
    }

    /// Clears the precomputed forces, so that the general equations are used.
    pub(super) fn clear(&mut self) {
        self.extent = Extent::Part;
        self.steady.clear();
        self.moving.clear();
        self.links.clear();
        self.wide.clear();
    }

    /// Computes the forces of an interval. The kernel stays incomplete if an element has no precomputed form.
    pub(super) fn lay_out(
        &mut self,
        (model, state): (&'a Model, &State),
        closed: &[Closed<'a>],
        others: &[usize],
    ) {
        self.clear();
        if !Self::fits(model) {
            return;
        }
        if model.free.len() > WIDTH {
            if others.is_empty() && self.wide.lay_out((model, state), closed).is_some() {
                self.extent = Extent::Wide;
            }
            return;
        }
        for (i, free) in model.free.iter().enumerate() {
            (self.forces[i], self.mobilities[i]) = (free.force, free.mobility);
        }
        self.steady.extend(closed.iter().map(Steady::of));
        for &c in others {
            let Some(moving) = Moving::of(c, model, state) else { return };
            self.moving.push(moving);
        }
        for link in &model.links {
            let Some(tie) = Tie::of(link, model, state) else { return };
            self.links.push(tie);
        }
        self.extent = Extent::Narrow;
    }

    /// Sets another branch of the slip memory for a contact, given by its index among those with a closed-form force.
    pub(super) fn renew(&mut self, place: usize, branch: FixedDepthBranch) {
        match self.extent {
            Extent::Part => {}
            Extent::Narrow => self.steady[place].renew(branch),
            Extent::Wide => self.wide.renew(place, branch),
        }
    }

    /// Returns whether the kernel contains all forces.
    #[inline(always)]
    pub(crate) fn is_whole(&self) -> bool {
        self.extent != Extent::Part
    }

    /// Writes the slopes of all components, as [`Equations::slopes`](stickslip_stepper::System::slopes).
    #[inline(always)]
    pub(crate) fn slopes(&self, eq: &Equations<'_>, (t, y): (f64, &[f64]), dy: &mut [f64]) {
        match (eq.layout.free, self.moving.is_empty()) {
            _ if self.extent == Extent::Wide => self.wide.slopes(eq, (t, y), dy),
            (1, true) => Self::slopes_of::<1, false>(eq, t, y, dy, self),
            (2, true) => Self::slopes_of::<2, false>(eq, t, y, dy, self),
            (3, true) => Self::slopes_of::<3, false>(eq, t, y, dy, self),
            (_, true) => Self::slopes_of::<4, false>(eq, t, y, dy, self),
            (1, false) => Self::slopes_of::<1, true>(eq, t, y, dy, self),
            (2, false) => Self::slopes_of::<2, true>(eq, t, y, dy, self),
            (3, false) => Self::slopes_of::<3, true>(eq, t, y, dy, self),
            (_, false) => Self::slopes_of::<4, true>(eq, t, y, dy, self),
        }
    }

    /// Writes accelerations, computed without velocities, and the input power.
    #[inline(always)]
    pub(crate) fn accelerations(&self, eq: &Equations<'_>, (t, x): (f64, &[f64]), out: &mut [f64]) {
        match x.len() {
            _ if self.extent == Extent::Wide => self.wide.accelerations(eq, (t, x), out),
            1 => self.accelerations_of::<1>((t, x), out),
            2 => self.accelerations_of::<2>((t, x), out),
            3 => self.accelerations_of::<3>((t, x), out),
            _ => self.accelerations_of::<4>((t, x), out),
        }
    }

    /// Returns sums of forces that initially contain the constant forces.
    #[inline(always)]
    fn sums<const N: usize>(&self) -> Sums<N> {
        Sums { forces: std::array::from_fn(|i| self.forces[i]), input: 0.0, damping: 0.0 }
    }

    /// Writes the slopes for N coordinates. `MOVING` says whether a contact has variable depth or damping; these laws need all registers.
    ///
    /// The order of the arguments avoids moves between registers at the call.
    #[inline(never)]
    fn slopes_of<const N: usize, const MOVING: bool>(
        eq: &Equations<'_>,
        t: f64,
        y: &[f64],
        dy: &mut [f64],
        kernel: &Self,
    ) {
        let (Some((coordinates, _)), Some((slopes, extra))) =
            (y.split_at_checked(2 * N), dy.split_at_mut_checked(2 * N))
        else {
            return;
        };
        let (([x, v], _), ([dx, dv], _)) = (coordinates.as_chunks::<N>(), slopes.as_chunks_mut::<N>()) else {
            return;
        };
        *dx = *v;
        // Besides powers there are only slopes of growing contacts; models with blocks or balanced coordinates have no kernel.
        let growing = eq.layout.growing;
        if growing > 0 {
            extra.fill(0.0);
        }
        let mut sums = kernel.sums::<N>();
        for steady in &kernel.steady {
            steady.act(t, x, &mut sums);
        }
        if MOVING {
            for moving in &kernel.moving {
                moving.act((eq, y), t, (x, v), (&mut sums, extra));
            }
        }
        for tie in &kernel.links {
            tie.act(t, (x, Some(v)), &mut sums);
        }
        for ((slope, force), mobility) in dv.iter_mut().zip(sums.forces).zip(kernel.mobilities) {
            *slope = force * mobility;
        }
        if let Some([input, damping, ..]) = extra.get_mut(growing..) {
            (*input, *damping) = (sums.input, sums.damping);
        }
    }

    #[inline(never)]
    fn accelerations_of<const N: usize>(&self, (t, x): (f64, &[f64]), out: &mut [f64]) {
        let (Some(x), Some((dv, input))) = (x.first_chunk::<N>(), out.split_first_chunk_mut::<N>()) else {
            return;
        };
        let mut sums = self.sums::<N>();
        for steady in &self.steady {
            steady.act(t, x, &mut sums);
        }
        for tie in &self.links {
            tie.act(t, (x, None), &mut sums);
        }
        for ((slope, force), mobility) in dv.iter_mut().zip(sums.forces).zip(self.mobilities) {
            *slope = force * mobility;
        }
        input[0] = sums.input;
    }
}
