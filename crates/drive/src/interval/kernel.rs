//! The forces of an interval, laid out for its evaluations.
//!
//! Steps evaluate the equations some ten times each, and most scenes have few free coordinates. For up to [`WIDTH`] of them
//! everything that an evaluation needs until the next event is gathered here when the interval begins: rows of Jacobians side
//! by side with zeros where a coordinate does not count, what followers make of a length in closed form, the law of each
//! contact. What has no such form (curved followers, rows in a lull, the whole law, blocks, varying loads) leaves the scene to
//! the general [`Equations`], of which this is a copy that asks nothing twice.

use super::{Closed, Followed, emptied};
use crate::contact::{Contact, Mode, Motion, Press};
use crate::equations::Equations;
use crate::model::{Link, Measure, Model, Stroke, Terms};
use crate::state::State;
use stickslip_contact::{Branch, FixedDepthBranch, Profile};

/// Most free coordinates of a kernel: two bodies along both directions.
pub(crate) const WIDTH: usize = 4;

/// Coefficients of all free coordinates.
type Row = [f64; WIDTH];

/// The forces of an interval. Scratch, made anew with it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Kernel<'a> {
    /// Whether all that acts is in it.
    whole: bool,
    /// Gravity and constant loads, N or N m, and inverse masses.
    forces: Row,
    mobilities: Row,
    steady: Vec<Steady<'a>>,
    moving: Vec<Moving<'a>>,
    links: Vec<Tie<'a>>,
}

/// A length: Σ coefficient · coordinate + what followers make of it.
#[derive(Debug, Clone, Copy)]
struct Length<'a> {
    row: Row,
    followed: Followed<'a>,
}

/// A length and its rates at a moment.
#[derive(Clone, Copy)]
struct Read {
    value: f64,
    rate: f64,
    /// The part of the rate that followers make.
    driven: f64,
}

/// A contact at constant depth on one branch.
#[derive(Debug, Clone)]
struct Steady<'a> {
    u: Length<'a>,
    count: f64,
    branch: FixedDepthBranch,
    profile: &'a Profile,
}

/// Any other contact.
#[derive(Debug, Clone)]
struct Moving<'a> {
    index: usize,
    contact: &'a Contact,
    u: Length<'a>,
    depth: Depth<'a>,
    law: Law,
    /// Places of its friction work, its force and its elastic energy among the components, where it grows.
    slot: Option<[usize; 3]>,
}

/// What presses it.
#[derive(Debug, Clone)]
enum Depth<'a> {
    /// Constant d (m) with M(d) (m²).
    Constant { d: f64, reduced_force: f64 },
    /// The bodies.
    Coupled(Length<'a>),
}

/// Its law.
#[derive(Debug, Clone)]
enum Law {
    Slip(Branch),
    Grow,
}

/// A spring, damper or actuator.
#[derive(Debug, Clone, Copy)]
struct Tie<'a> {
    elongation: Length<'a>,
    stroke: Followed<'a>,
    stiffness: f64,
    damping: f64,
    preload: f64,
}

/// Forces on N free coordinates, and powers, as they add up.
struct Sums<const N: usize> {
    forces: [f64; N],
    input: f64,
    damping: f64,
}

impl<'a> Kernel<'a> {
    /// Whether a model has room in one.
    fn fits(model: &Model) -> bool {
        (1..=WIDTH).contains(&model.free.len())
            && model.loads.is_empty()
            && model.blocks.is_empty()
            && model.balanced.is_empty()
    }

    /// Room for all that acts in a model.
    pub(super) fn reserve(&mut self, model: &Model) {
        self.clear();
        self.steady.reserve(model.contacts.len());
        self.moving.reserve(model.contacts.len());
        self.links.reserve(model.links.len());
    }

    /// The room that it takes, empty.
    pub(super) fn emptied(self) -> Kernel<'static> {
        let (steady, moving, links) = (emptied(self.steady), emptied(self.moving), emptied(self.links));
        Kernel { steady, moving, links, ..Kernel::default() }
    }

    /// No interval: the general equations hold.
    pub(super) fn clear(&mut self) {
        self.whole = false;
        self.steady.clear();
        self.moving.clear();
        self.links.clear();
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
        self.whole = true;
    }

    /// Whether all that acts is in it.
    #[inline(always)]
    pub(crate) fn is_whole(&self) -> bool {
        self.whole
    }

    /// Slopes of all components, as [`Equations::slopes`](stickslip_stepper::System::slopes) has them.
    #[inline(always)]
    pub(crate) fn slopes(&self, eq: &Equations<'_>, (t, y): (f64, &[f64]), dy: &mut [f64]) {
        match eq.layout.free {
            1 => self.slopes_of::<1>(eq, (t, y), dy),
            2 => self.slopes_of::<2>(eq, (t, y), dy),
            3 => self.slopes_of::<3>(eq, (t, y), dy),
            _ => self.slopes_of::<4>(eq, (t, y), dy),
        }
    }

    /// The same without velocities: accelerations, and the power put in.
    #[inline(always)]
    pub(crate) fn accelerations(&self, (t, x): (f64, &[f64]), out: &mut [f64]) {
        match x.len() {
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

    #[inline(never)]
    fn slopes_of<const N: usize>(&self, eq: &Equations<'_>, (t, y): (f64, &[f64]), dy: &mut [f64]) {
        let (Some((x, rest)), Some((dx, changes))) =
            (y.split_first_chunk::<N>(), dy.split_first_chunk_mut::<N>())
        else {
            return;
        };
        let (Some(v), Some((dv, extra))) = (rest.first_chunk::<N>(), changes.split_first_chunk_mut::<N>())
        else {
            return;
        };
        *dx = *v;
        for slope in extra.iter_mut() {
            *slope = 0.0;
        }
        let mut sums = self.sums::<N>();
        for steady in &self.steady {
            steady.act(t, x, &mut sums);
        }
        for moving in &self.moving {
            moving.act((eq, y), t, (x, v), (&mut sums, extra));
        }
        for tie in &self.links {
            tie.act(t, (x, Some(v)), &mut sums);
        }
        for ((slope, force), mobility) in dv.iter_mut().zip(sums.forces).zip(self.mobilities) {
            *slope = force * mobility;
        }
        let first = eq.layout.input() - 2 * N;
        (extra[first], extra[first + 1]) = (sums.input, sums.damping);
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

/// The coefficients of a measure, by coordinate.
fn row(terms: &Terms) -> Row {
    let mut row = [0.0; WIDTH];
    for &(i, a) in terms {
        row[i] = a;
    }
    row
}

/// Σ coefficient · coordinate.
#[inline(always)]
fn dot<const N: usize>(row: &Row, x: &[f64; N]) -> f64 {
    let mut sum = row[0] * x[0];
    for (a, x) in row.iter().zip(x).skip(1) {
        sum += a * x;
    }
    sum
}

impl<const N: usize> Sums<N> {
    /// Adds a force along a length whose followers move at the rate `driven`: what drives them puts in -force · driven.
    #[inline(always)]
    fn apply(&mut self, row: &Row, driven: f64, force: f64) {
        for (sum, a) in self.forces.iter_mut().zip(row) {
            *sum += a * force;
        }
        self.input -= force * driven;
    }
}

impl<'a> Length<'a> {
    fn of(measure: &Measure, model: &'a Model, state: &State) -> Option<Self> {
        Some(Self { row: row(&measure.free), followed: Followed::of(measure, model, state)? })
    }

    /// Two bodies far from their start may be close to each other: their difference first.
    #[inline(always)]
    fn at<const N: usize>(&self, t: f64, (x, v): (&[f64; N], &[f64; N])) -> Read {
        let followed = self.followed.at(t);
        let (value, rate) = (dot(&self.row, x) + followed.value, dot(&self.row, v) + followed.rate);
        Read { value, rate, driven: followed.rate }
    }
}

impl<'a> Steady<'a> {
    fn of(closed: &Closed<'a>) -> Self {
        let u = Length { row: row(&closed.contact.u.free), followed: closed.followed };
        let profile = closed.contact.interface.profile();
        Self { u, count: closed.contact.count, branch: closed.branch, profile }
    }

    #[inline(always)]
    fn act<const N: usize>(&self, t: f64, x: &[f64; N], sums: &mut Sums<N>) {
        let followed = self.u.followed.at(t);
        let u = dot(&self.u.row, x) + followed.value;
        sums.apply(&self.u.row, followed.rate, -self.count * self.branch.force(self.profile, u));
    }
}

impl<'a> Moving<'a> {
    fn of(index: usize, model: &'a Model, state: &State) -> Option<Self> {
        let contact = &model.contacts[index];
        let depth = match &contact.press {
            Press::Constant { d, reduced_force } => Depth::Constant { d: *d, reduced_force: *reduced_force },
            Press::Coupled(measure) => Depth::Coupled(Length::of(measure, model, state)?),
            Press::Force(_) | Press::Indentation(_) | Press::Radius(_) => return None,
        };
        let straight = contact.goes_straight(&state.pieces);
        let layout = model.layout();
        let slot = contact.slot.filter(|_| !straight);
        let law = match &state.modes[index] {
            Mode::Slip(branch) => Law::Slip(*branch),
            // Elsewhere the memory is asked.
            Mode::Grow if slot.is_some() => Law::Grow,
            _ => return None,
        };
        let u = Length::of(&contact.u, model, state)?;
        let slot = slot.map(|slot| [layout.friction(slot), layout.force(slot), layout.elastic(slot)]);
        Some(Self { index, contact, u, depth, law, slot })
    }

    /// Normal: -count·E\*M(d) along d, where the bodies press it. Tangential: -count·(F_x + βG\*m u̇) along u, the second term of
    /// the springs that stick.
    #[inline(always)]
    fn act<const N: usize>(
        &self,
        (eq, y): (&Equations<'_>, &[f64]),
        t: f64,
        at: (&[f64; N], &[f64; N]),
        (sums, extra): (&mut Sums<N>, &mut [f64]),
    ) {
        let (contact, u) = (self.contact, self.u.at(t, at));
        let law = &contact.interface;
        let (d, dd, reduced_force) = match &self.depth {
            Depth::Constant { d, reduced_force } => (*d, 0.0, *reduced_force),
            Depth::Coupled(length) => {
                let d = length.at(t, at);
                let reduced_force = law.reduced_force(d.value);
                let press = contact.count * (law.normal_modulus() * reduced_force);
                sums.apply(&length.row, d.driven, -press);
                (d.value, d.rate, reduced_force)
            }
        };
        let motion = Motion { d, u: u.value, dd, du: u.rate };
        let mut force = match (&self.law, self.slot) {
            (Law::Slip(branch), Some([friction, ..])) if branch.covers(d, u.value) => {
                let [force, power] = branch.drag(law, &motion, reduced_force);
                extra[friction - 2 * N] = power;
                force
            }
            (Law::Slip(branch), None) if branch.covers(d, u.value) => {
                branch.force(law, d, u.value, reduced_force)
            }
            // Growth, and beyond what the branch covers: the memory is asked.
            (_, slot) => {
                let grown = || slot.map_or(0.0, |[_, force, _]| y[force]);
                let force = contact.force(eq.law(self.index), &motion, grown);
                if let Some(places) = slot {
                    let rates = contact.growth_rates(eq.law(self.index), &motion, force);
                    for (place, rate) in places.into_iter().zip([rates.friction, rates.force, rates.elastic])
                    {
                        extra[place - 2 * N] = rate;
                    }
                }
                force
            }
        };
        if law.damping() > 0.0 {
            let damping = contact.viscosity(eq.law(self.index), &motion);
            // A power of its own, not friction: it is lost where springs stick.
            sums.damping += contact.count * damping * motion.du * motion.du;
            force += damping * motion.du;
        }
        sums.apply(&self.u.row, u.driven, -contact.count * force);
    }
}

impl<'a> Tie<'a> {
    fn of(link: &Link, model: &'a Model, state: &State) -> Option<Self> {
        let stroke = match link.stroke {
            Stroke::Constant(constant) => Followed::constant(constant),
            Stroke::Driven(w) => Followed::signal(w, model, state)?,
        };
        let elongation = Length::of(&link.elongation, model, state)?;
        let Link { stiffness, damping, preload, .. } = *link;
        Some(Self { elongation, stroke, stiffness, damping, preload })
    }

    /// k(s - e) + c(ṡ - ė) + preload along e. The stroke puts in (k(s - e) + c(ṡ - ė))ṡ; the preload's work is read off the
    /// length. Without velocities nothing is damped, and rates are the followers' alone.
    #[inline(always)]
    fn act<const N: usize>(&self, t: f64, (x, v): (&[f64; N], Option<&[f64; N]>), sums: &mut Sums<N>) {
        let (followed, stroke) = (self.elongation.followed.at(t), self.stroke.at(t));
        let stretch = stroke.value - (dot(&self.elongation.row, x) + followed.value);
        let own = v.map_or(0.0, |v| dot(&self.elongation.row, v));
        let rate = stroke.rate - (own + followed.rate);
        let force = self.stiffness * stretch + self.damping * rate;
        sums.apply(&self.elongation.row, followed.rate, force + self.preload);
        sums.input += force * stroke.rate;
        sums.damping += self.damping * rate * rate;
    }
}
