//! Precomputed forces for any number of coordinates, at most two per force: chains, and sliders that springs connect.

use crate::equations::Equations;
use crate::interval::{Closed, Followed};
use crate::model::{Link, Measure, Model, Stroke, Terms};
use crate::state::State;
use stickslip_contact::{FixedDepthBranch, Profile};

/// Precomputed forces of an interval on any number of coordinates. Scratch memory, rebuilt after each event.
#[derive(Debug, Clone, Default)]
pub(super) struct Wide<'a> {
    steady: Vec<Steady<'a>>,
    springs: Vec<Spring>,
    ties: Vec<Tie<'a>>,
}

/// Sparse linear form Σ coefficient · coordinate.
#[derive(Debug, Clone, Copy)]
enum Ends {
    /// Form of one coordinate; a coefficient of 0 means no coordinate.
    One(End),
    /// Two coordinates.
    Two([End; 2]),
}

/// A coordinate and its coefficient.
#[derive(Debug, Clone, Copy)]
struct End {
    at: usize,
    arm: f64,
}

/// Linear form of coordinates that gives the direction of a force.
trait Along {
    /// Returns Σ coefficient · coordinate.
    fn dot(&self, x: &[f64]) -> f64;
    /// Adds a force to the forces on the coordinates.
    fn pull(&self, forces: &mut [f64], force: f64);
}

/// Contact at constant indentation on one branch of its slip memory, with a closed-form force.
#[derive(Debug, Clone)]
struct Steady<'a> {
    ends: Ends,
    followed: Followed<'a>,
    count: f64,
    branch: FixedDepthBranch,
    profile: &'a Profile,
}

/// Spring between free coordinates, without damper, input power and loss.
#[derive(Debug, Clone, Copy)]
struct Spring {
    ends: Ends,
    /// Elongation (Σ coefficient · coordinate) at which only the preload acts, m.
    rest: f64,
    stiffness: f64,
    preload: f64,
}

/// Spring with damping or prescribed motion, damper or actuator.
#[derive(Debug, Clone, Copy)]
struct Tie<'a> {
    ends: Ends,
    followed: Followed<'a>,
    stroke: Followed<'a>,
    stiffness: f64,
    damping: f64,
    preload: f64,
}

/// Sums of forces on the coordinates and of powers.
struct Sums<'f> {
    forces: &'f mut [f64],
    input: f64,
    damping: f64,
}

impl Ends {
    /// Returns the sparse form of a list of terms; `None` for more than two coordinates.
    fn of(terms: &Terms) -> Option<Self> {
        let end = |&(at, arm): &(usize, f64)| End { at, arm };
        match &terms[..] {
            [] => Some(Self::One(End { at: 0, arm: 0.0 })),
            [one] => Some(Self::One(end(one))),
            [one, other] => Some(Self::Two([end(one), end(other)])),
            _ => None,
        }
    }
}

impl Along for End {
    #[inline(always)]
    fn dot(&self, x: &[f64]) -> f64 {
        self.arm * x[self.at]
    }

    #[inline(always)]
    fn pull(&self, forces: &mut [f64], force: f64) {
        forces[self.at] += self.arm * force;
    }
}

impl Along for [End; 2] {
    #[inline(always)]
    fn dot(&self, x: &[f64]) -> f64 {
        self[0].dot(x) + self[1].dot(x)
    }

    #[inline(always)]
    fn pull(&self, forces: &mut [f64], force: f64) {
        self[0].pull(forces, force);
        self[1].pull(forces, force);
    }
}

/// Evaluates an expression for one or two coordinates, with a single branch.
macro_rules! along {
    ($ends:expr, $known:ident => $act:expr) => {
        match &$ends {
            Ends::One($known) => $act,
            Ends::Two($known) => $act,
        }
    };
}

impl Sums<'_> {
    /// Adds a force along a displacement with the prescribed rate `driven`; the input power is -force · driven.
    #[inline(always)]
    fn apply(&mut self, ends: &impl Along, driven: f64, force: f64) {
        ends.pull(self.forces, force);
        self.input -= force * driven;
    }
}

impl<'a> Steady<'a> {
    fn of(closed: &Closed<'a>) -> Option<Self> {
        Some(Self {
            ends: Ends::of(&closed.contact.u.free)?,
            followed: closed.followed,
            count: closed.contact.count,
            branch: closed.branch,
            profile: closed.contact.interface.profile(),
        })
    }

    #[inline(always)]
    fn act(&self, t: f64, x: &[f64], sums: &mut Sums<'_>) {
        along!(self.ends, ends => self.act_along(ends, t, x, sums));
    }

    #[inline(always)]
    fn act_along(&self, ends: &impl Along, t: f64, x: &[f64], sums: &mut Sums<'_>) {
        let followed = self.followed.at(t);
        let u = ends.dot(x) + followed.value;
        sums.apply(ends, followed.rate, -self.count * self.branch.force(self.profile, u));
    }
}

impl Spring {
    /// Returns a tie as a plain spring; `None` if the tie has damping or prescribed motion.
    fn of(tie: &Tie<'_>) -> Option<Self> {
        let ([place, 0.0, _], [slack, 0.0, _]) = (tie.followed.line()?, tie.stroke.line()?) else {
            return None;
        };
        let Tie { ends, stiffness, damping, preload, .. } = *tie;
        (damping == 0.0).then_some(Self { ends, rest: slack - place, stiffness, preload })
    }

    #[inline(always)]
    fn act(&self, x: &[f64], forces: &mut [f64]) {
        along!(self.ends, ends => {
            ends.pull(forces, self.stiffness * (self.rest - ends.dot(x)) + self.preload);
        });
    }
}

impl<'a> Tie<'a> {
    fn of(link: &Link, model: &'a Model, state: &State) -> Option<Self> {
        let stroke = match link.stroke {
            Stroke::Constant(constant) => Followed::constant(constant),
            Stroke::Driven(w) => Followed::signal(w, model, state)?,
        };
        let elongation: &Measure = &link.elongation;
        let Link { stiffness, damping, preload, .. } = *link;
        let followed = Followed::of(elongation, model, state)?;
        Some(Self { ends: Ends::of(&elongation.free)?, followed, stroke, stiffness, damping, preload })
    }

    /// Adds the forces of the spring, damper or actuator, see [`ties`](super::ties).
    #[inline(always)]
    fn act(&self, t: f64, (x, v): (&[f64], Option<&[f64]>), sums: &mut Sums<'_>) {
        let (followed, stroke) = (self.followed.at(t), self.stroke.at(t));
        let dot = |of: &[f64]| along!(self.ends, ends => ends.dot(of));
        let stretch = stroke.value - (dot(x) + followed.value);
        let own = v.map_or(0.0, dot);
        let rate = stroke.rate - (own + followed.rate);
        let force = self.stiffness * stretch + self.damping * rate;
        along!(self.ends, ends => sums.apply(ends, followed.rate, force + self.preload));
        sums.input += force * stroke.rate;
        sums.damping += self.damping * rate * rate;
    }
}

impl<'a> Wide<'a> {
    /// Reserves memory for the forces of a model.
    pub(super) fn reserve(&mut self, model: &Model) {
        self.clear();
        self.steady.reserve(model.contacts.len());
        self.springs.reserve(model.links.len());
        self.ties.reserve(model.links.len());
    }

    /// Returns the allocated memory of this kernel, empty.
    pub(super) fn emptied(self) -> Wide<'static> {
        let (steady, ties) = (super::emptied(self.steady), super::emptied(self.ties));
        Wide { steady, springs: self.springs, ties }
    }

    pub(super) fn clear(&mut self) {
        self.steady.clear();
        self.springs.clear();
        self.ties.clear();
    }

    /// Computes the data of all forces; `None` if an element has no precomputed form.
    pub(super) fn lay_out(
        &mut self,
        (model, state): (&'a Model, &State),
        closed: &[Closed<'a>],
    ) -> Option<()> {
        for closed in closed {
            self.steady.push(Steady::of(closed)?);
        }
        for link in &model.links {
            let tie = Tie::of(link, model, state)?;
            match Spring::of(&tie) {
                Some(spring) => self.springs.push(spring),
                None => self.ties.push(tie),
            }
        }
        Some(())
    }

    /// Sets another branch of the slip memory for a contact, given by its index among those with a closed-form force.
    pub(super) fn renew(&mut self, place: usize, branch: FixedDepthBranch) {
        if let Some(steady) = self.steady.get_mut(place) {
            steady.branch = branch;
        }
    }

    /// Writes the slopes of all components; input and damping power are the last two.
    #[inline(never)]
    pub(super) fn slopes(&self, eq: &Equations<'_>, (t, y): (f64, &[f64]), dy: &mut [f64]) {
        let n = eq.layout.free;
        let (x, v) = (&y[..n], &y[n..2 * n]);
        let (dx, rest) = dy.split_at_mut(n);
        let (dv, extra) = rest.split_at_mut(n);
        dx.copy_from_slice(v);
        extra.fill(0.0);
        let first = eq.layout.input() - 2 * n;
        (extra[first], extra[first + 1]) = self.accelerate(eq.model, t, (x, Some(v)), dv);
    }

    /// Writes the accelerations of the coordinates and the input power.
    #[inline(never)]
    pub(super) fn accelerations(&self, eq: &Equations<'_>, (t, x): (f64, &[f64]), out: &mut [f64]) {
        let (dv, input) = out.split_at_mut(x.len());
        (input[0], _) = self.accelerate(eq.model, t, (x, None), dv);
    }

    /// Computes the accelerations of the coordinates; returns input and damping power.
    #[inline(always)]
    fn accelerate(
        &self,
        model: &Model,
        t: f64,
        (x, v): (&[f64], Option<&[f64]>),
        dv: &mut [f64],
    ) -> (f64, f64) {
        for (dv, free) in dv.iter_mut().zip(&model.free) {
            *dv = free.force;
        }
        let mut sums = Sums { forces: dv, input: 0.0, damping: 0.0 };
        for steady in &self.steady {
            steady.act(t, x, &mut sums);
        }
        for spring in &self.springs {
            spring.act(x, sums.forces);
        }
        for tie in &self.ties {
            tie.act(t, (x, v), &mut sums);
        }
        let Sums { forces, input, damping } = sums;
        for (force, free) in forces.iter_mut().zip(&model.free) {
            *force *= free.mobility;
        }
        (input, damping)
    }
}
