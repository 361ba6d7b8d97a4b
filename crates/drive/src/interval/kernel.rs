//! The forces of an interval, laid out for its evaluations.
//!
//! Steps evaluate the equations some ten times each, and most scenes have few free coordinates. For up to [`WIDTH`] of them
//! everything that an evaluation needs until the next event is gathered here when the interval begins: rows of Jacobians side
//! by side with zeros where a coordinate does not count, what followers make of a length in closed form, the law of each
//! contact; for more of them the same without zeros ([`wide`]). What has no such form (curved followers, rows in a lull, the whole law, blocks, varying loads) leaves the scene to
//! the general [`Equations`], of which this is a copy that asks nothing twice.

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

/// Most free coordinates of a kernel: two bodies along both directions.
pub(crate) const WIDTH: usize = 4;

/// The forces of an interval. Scratch, made anew with it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Kernel<'a> {
    extent: Extent,
    /// Gravity and constant loads, N or N m, and inverse masses.
    forces: Row,
    mobilities: Row,
    steady: Vec<Steady<'a>>,
    moving: Vec<Moving<'a>>,
    links: Vec<Tie<'a>>,
    wide: Wide<'a>,
}

/// What of all that acts is in a kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Extent {
    /// Not all: the general equations hold.
    #[default]
    Part,
    /// All, side by side.
    Narrow,
    /// All, on more coordinates than there is room for in a row.
    Wide,
}

impl<'a> Kernel<'a> {
    /// Whether a model has room in one.
    fn fits(model: &Model) -> bool {
        !model.free.is_empty()
            && model.loads.is_empty()
            && model.blocks.is_empty()
            && model.balanced.is_empty()
    }

    /// Room for all that acts in a model.
    pub(super) fn reserve(&mut self, model: &Model) {
        self.clear();
        if model.free.len() > WIDTH {
            return self.wide.reserve(model);
        }
        self.steady.reserve(model.contacts.len());
        self.moving.reserve(model.contacts.len());
        self.links.reserve(model.links.len());
    }

    /// The room that it takes, empty.
    pub(super) fn emptied(self) -> Kernel<'static> {
        let (steady, moving, links) = (emptied(self.steady), emptied(self.moving), emptied(self.links));
        Kernel { steady, moving, links, wide: self.wide.emptied(), ..Kernel::default() }
    }

    /// No interval: the general equations hold.
    pub(super) fn clear(&mut self) {
        self.extent = Extent::Part;
        self.steady.clear();
        self.moving.clear();
        self.links.clear();
        self.wide.clear();
    }

    /// Lays out what acts between two events; leaves it to the general equations where something has no form here.
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

    /// Takes up another branch of a contact of closed form, by its place among these.
    pub(super) fn renew(&mut self, place: usize, branch: FixedDepthBranch) {
        match self.extent {
            Extent::Part => {}
            Extent::Narrow => self.steady[place].renew(branch),
            Extent::Wide => self.wide.renew(place, branch),
        }
    }

    /// Whether all that acts is in it.
    #[inline(always)]
    pub(crate) fn is_whole(&self) -> bool {
        self.extent != Extent::Part
    }

    /// Slopes of all components, as [`Equations::slopes`](stickslip_stepper::System::slopes) has them.
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

    /// The same without velocities: accelerations, and the power put in.
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

    /// Sums that begin with the constant forces.
    #[inline(always)]
    fn sums<const N: usize>(&self) -> Sums<N> {
        Sums { forces: std::array::from_fn(|i| self.forces[i]), input: 0.0, damping: 0.0 }
    }

    /// `MOVING` is whether any contact has no constant depth or is damped: their laws take all the registers there are.
    ///
    /// In the order of who asks, so that nothing need be moved on the way here.
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
        // Beside the powers there are only the slopes of what grows: blocks and places without mass have no kernel.
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
