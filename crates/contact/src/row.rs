//! Row of springs: the algorithm of the handbook (chapter 11), exact along straight paths in (d, u).
//!
//! A spring of height h touches while h < d. The tangential force is G\* times length and stretch; the stretch is limited to ±κ(d-h)
//! (4.22). The state contains one rest position p per spring. While a spring sticks, its rest position does not change, so rounding
//! errors do not accumulate. The handbook instead stores stretches and adds Δu in every step.
//!
//! The row has no force formula in common with [`Curve`](crate::Curve), so that each engine is a test of the other.

mod chord;
mod lanes;
mod lull;
mod springs;
mod words;

pub use lull::{Change, Lull, Slack};
pub use springs::{Springs, SpringsError};

use crate::breaking::Rest;
use crate::{Apex, ContactError, ContactState, Interface, Move, Outcome, Response, Segment, SpringState};
use chord::Chord;

/// State of a row of springs. All methods need the same [`Springs`] and interface with which the row was created.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    apex: Apex,
    /// Rest position of each distinct spring in order of height, m; 0 for springs out of contact.
    anchors: Vec<f64>,
    /// Number of distinct springs in contact; these are the springs of lowest height.
    touching: usize,
    /// Direction in which the contact slides after it has broken loose; 0 otherwise, and always with one friction coefficient.
    slides: f64,
    pub(crate) rest: Rest,
    /// Whether u decreased in the last move in which it changed. The flag gives the sign of slip where the friction limit is 0.
    backward: bool,
}

impl Row {
    /// Creates an untouched row at d = 0, u = 0.
    pub fn new(springs: &Springs) -> Self {
        Self::at(springs, Apex::default())
    }

    /// Creates a row with unstretched springs at an apex.
    pub fn at(springs: &Springs, apex: Apex) -> Self {
        let touching = springs.below(apex.d);
        let mut anchors = vec![0.0; springs.heights().len()];
        anchors[..touching].fill(apex.u);
        Self { apex, anchors, touching, slides: 0.0, rest: Rest::NONE, backward: false }
    }

    /// Copies another row with the same number of springs into this one and reuses the allocated space.
    pub(crate) fn copy(&mut self, from: &Self) {
        let Self { apex, anchors, touching, slides, rest, backward } = from;
        self.rest.clone_from(rest);
        self.anchors.clone_from(anchors);
        (self.apex, self.touching, self.slides, self.backward) = (*apex, *touching, *slides, *backward);
    }

    /// Returns the current indentation and displacement.
    pub fn apex(&self) -> Apex {
        self.apex
    }

    /// Moves the origin of displacements: u and all rest positions grow by `by` (m).
    pub fn shift(&mut self, by: f64) {
        self.apex.u += by;
        self.anchors[..self.touching].iter_mut().for_each(|anchor| *anchor += by);
    }

    /// Returns the number of distinct springs in contact at the indentation d.
    #[inline]
    fn touching_at(&self, springs: &Springs, d: f64) -> usize {
        if d == self.apex.d { self.touching } else { springs.below_near(d, self.touching) }
    }

    /// Returns the tangential force `F_x` at the end of a straight path, N.
    #[inline]
    pub fn force(&self, springs: &Springs, law: &Interface, to: Apex) -> f64 {
        let slope = law.stick_slope();
        let after = self.touching_at(springs, to.d);
        let kept = after.min(self.touching);
        let mut sum = lanes::shear(springs.first(kept), &self.anchors[..kept], to, slope);
        if after > kept {
            let stretch = Chord::new(self.apex, to, slope).fresh_stretch_per_rise();
            sum += stretch * lanes::pressed_force(springs.range(kept, after), to.d);
        }
        law.tangential_modulus() * sum
    }

    /// Returns the force F_x of a row with damping at the end of a straight path, N.
    ///
    /// Every spring carries G\*(s + lead), limited to its friction limit; `lead` is βu̇, m.
    pub fn ahead(&self, springs: &Springs, law: &Interface, to: Apex, lead: f64) -> f64 {
        let slope = law.stick_slope();
        let chord = Chord::new(self.apex, to, slope);
        let after = self.touching_at(springs, to.d);
        let all = springs.first(after);
        let force = |(i, (&h, &length)): (usize, (&f64, &f64))| {
            let anchor = if i < self.touching { self.anchors[i] } else { chord.touching_anchor(h) };
            let limit = chord.limit(h);
            length * lanes::clamp(lanes::clamp(to.u - anchor, limit) + lead, limit)
        };
        law.tangential_modulus() * all.heights.iter().zip(all.lengths).enumerate().map(force).sum::<f64>()
    }

    /// Returns the tangential force `F_x` at the end of a move and its derivatives.
    ///
    /// ∂F/∂u is G\* times the length that sticks. ∂F/∂d is G\*κ times the difference of the lengths that slip forward and backward. A
    /// growth path is treated as the straight path to its end.
    pub fn trial(&self, springs: &Springs, law: &Interface, to: Move) -> Response {
        let (to, slope) = (to.end(), law.stick_slope());
        let after = self.touching_at(springs, to.d);
        let kept = after.min(self.touching);
        let mut tally = lanes::tally(springs.first(kept), &self.anchors[..kept], to, slope);
        if after > kept {
            let stretch = Chord::new(self.apex, to, slope).fresh_stretch_per_rise();
            let fresh = springs.range(kept, after);
            tally.shear += stretch * lanes::pressed_force(fresh, to.d);
            let length: f64 = fresh.lengths.iter().sum();
            match stretch {
                _ if stretch >= slope => tally.slip += length,
                _ if stretch <= -slope => tally.slip -= length,
                _ => tally.stick += length,
            }
        }
        let modulus = law.tangential_modulus();
        Response {
            force: modulus * tally.shear,
            stiffness: modulus * tally.stick,
            coupling: modulus * slope * tally.slip,
        }
    }

    /// Returns force, energies and state at the end of a move, including the friction work.
    pub fn preview(&self, springs: &Springs, law: &Interface, to: Move) -> Outcome {
        let chord = Chord::new(self.apex, to.end(), law.stick_slope());
        let after = self.touching_at(springs, chord.to.d);
        let all = springs.first(after);
        let (mut shear, mut square) = (0.0, 0.0);
        let mut work = chord.leaving_work(springs, &self.anchors, after, self.touching);
        let (mut first_slip, mut slipping) = (None, 0);
        for (i, (&h, &length)) in all.heights.iter().zip(all.lengths).enumerate() {
            let anchor = if i < self.touching { self.anchors[i] } else { chord.touching_anchor(h) };
            let slide = chord.slide(h, anchor);
            shear += length * slide.stretch;
            square += length * slide.stretch * slide.stretch;
            work += length * slide.work;
            if slide.stretch.abs() >= chord.limit(h) {
                slipping += 1;
                first_slip = first_slip.or(Some(i));
            }
        }
        let modulus = law.tangential_modulus();
        Outcome {
            force: modulus * shear,
            elastic: 0.5 * modulus * square,
            friction: (modulus * work).max(0.0),
            stick_radius: law
                .profile()
                .radius_of_reduced_stiffness(2.0 * springs.inner_radius(first_slip.unwrap_or(after))),
            state: whole_state(after, slipping),
        }
    }

    /// Commits a segment and returns its friction work, J, at least 0.
    ///
    /// Every segment is treated as the straight path to its end. Under a growing load the steps must therefore be short enough to
    /// resolve a curved path.
    ///
    /// # Errors
    ///
    /// Fails if the end is not finite, or exceeds the range of the row or the last point of its profile. The state is then unchanged.
    pub fn commit(
        &mut self,
        springs: &Springs,
        law: &Interface,
        segment: Segment,
    ) -> Result<f64, ContactError> {
        let to = segment.end();
        if !(to.d.is_finite() && to.u.is_finite()) {
            return Err(ContactError::NotFinite { d: to.d, u: to.u });
        }
        law.profile().check_end(to.d)?;
        if to.d > springs.reach() {
            return Err(ContactError::Outgrown { d: to.d, reach: springs.reach() });
        }
        // All errors have been checked; the commit cannot fail from here on.
        let chord = Chord::new(self.apex, to, law.stick_slope());
        let (before, after) = (self.touching, self.touching_at(springs, to.d));
        let mut work = chord.leaving_work(springs, &self.anchors, after, before);
        if after < before {
            self.anchors[after..before].fill(0.0);
        } else {
            let fresh = springs.range(before, after);
            for (anchor, &h) in self.anchors[before..after].iter_mut().zip(fresh.heights) {
                *anchor = chord.touching_anchor(h);
            }
        }
        work += lanes::slide(springs.first(after), &mut self.anchors[..after], &chord);
        if to.u != self.apex.u {
            self.backward = to.u < self.apex.u;
        }
        (self.apex, self.touching) = (to, after);
        if after == 0 {
            self.slides = 0.0;
        }
        // Each term is at least 0 except for rounding.
        Ok((law.tangential_modulus() * work).max(0.0))
    }

    /// Returns the direction in which the contact slides after it has broken loose; 0 otherwise.
    #[inline]
    pub(crate) fn slides(&self) -> f64 {
        self.slides
    }

    /// Lets a sliding contact stick again.
    pub(crate) fn hold(&mut self) {
        self.slides = 0.0;
    }

    /// Returns the rest position of the lowest spring, m; `None` if it is out of contact.
    pub(crate) fn lowest_anchor(&self) -> Option<f64> {
        self.anchors.first().copied().filter(|_| self.touching > 0)
    }

    /// Stretches all springs to their limits in a direction and returns the released elastic energy, J.
    pub(crate) fn break_loose(&mut self, springs: &Springs, kinetic: &Interface, sense: f64) -> f64 {
        // The stretches may exceed the limits of `kinetic`, which the energy of the row would clip.
        let energy = |row: &Self| {
            let touching = springs.first(row.touching);
            let square = |(&length, &anchor): (&f64, &f64)| length * (row.apex.u - anchor).powi(2);
            touching.lengths.iter().zip(&row.anchors).map(square).sum::<f64>()
        };
        let before = energy(self);
        let Apex { d, u } = self.apex;
        let touching = self.anchors[..self.touching].iter_mut().zip(springs.heights());
        touching.for_each(|(anchor, h)| *anchor = u - sense * kinetic.stick_slope() * (d - h));
        self.slides = sense;
        (0.5 * kinetic.tangential_modulus() * (before - energy(self))).max(0.0)
    }

    /// Returns the tangential elastic energy ½G\*Σ length·stretch², J.
    pub fn elastic(&self, springs: &Springs, law: &Interface) -> f64 {
        let touching = springs.first(self.touching);
        let square = |((&h, &length), &anchor): ((&f64, &f64), &f64)| {
            let stretch = lanes::clamp(self.apex.u - anchor, law.stick_slope() * (self.apex.d - h));
            length * stretch * stretch
        };
        let sum: f64 = touching.heights.iter().zip(touching.lengths).zip(&self.anchors).map(square).sum();
        0.5 * law.tangential_modulus() * sum
    }

    /// Returns the stretch u - p of every spring, m, in the order of [`Springs::positions`]; 0 for springs out of contact.
    pub fn stretches<'a>(
        &'a self,
        springs: &'a Springs,
        law: &'a Interface,
    ) -> impl Iterator<Item = f64> + 'a {
        springs.ranks().iter().map(move |&rank| self.stretch(springs, law, rank))
    }

    /// Returns height and rest position of every distinct spring in contact, m, from the lowest one on.
    pub(crate) fn anchors<'a>(
        &'a self,
        springs: &'a Springs,
        law: &'a Interface,
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        let touching = springs.heights().iter().enumerate().take(self.touching);
        touching.map(move |(rank, &h)| (h, self.apex.u - self.stretch(springs, law, rank)))
    }

    /// Returns the state of the lowest spring, which is the last spring to slip. If the lowest spring slips, the contact is in gross slip.
    pub fn lowest(&self, springs: &Springs, law: &Interface) -> SpringState {
        self.state(springs, law, 0)
    }

    /// Returns the state of every spring, in the order of [`Springs::positions`].
    pub fn states<'a>(
        &'a self,
        springs: &'a Springs,
        law: &'a Interface,
    ) -> impl Iterator<Item = SpringState> + 'a {
        springs.ranks().iter().map(move |&rank| self.state(springs, law, rank))
    }

    /// Returns the friction limit κ(d-h) of a distinct spring, m.
    fn limit(&self, springs: &Springs, law: &Interface, rank: usize) -> f64 {
        law.stick_slope() * (self.apex.d - springs.heights()[rank])
    }

    /// Returns the stretch of a distinct spring, m.
    fn stretch(&self, springs: &Springs, law: &Interface, rank: usize) -> f64 {
        if rank >= self.touching {
            return 0.0;
        }
        lanes::clamp(self.apex.u - self.anchors[rank], self.limit(springs, law, rank))
    }

    /// Returns the state of a distinct spring.
    fn state(&self, springs: &Springs, law: &Interface, rank: usize) -> SpringState {
        if rank >= self.touching {
            return SpringState::Open;
        }
        let (stretch, limit) = (self.stretch(springs, law, rank), self.limit(springs, law, rank));
        if stretch.abs() < limit {
            SpringState::Stick
        } else if stretch < 0.0 || (stretch == 0.0 && self.backward) {
            SpringState::SlipBackward
        } else {
            SpringState::SlipForward
        }
    }
}

/// Returns the state of the contact from the numbers of springs in contact and at their friction limit.
fn whole_state(touching: usize, slipping: usize) -> ContactState {
    match slipping {
        _ if touching == 0 => ContactState::Open,
        0 => ContactState::Stick,
        _ if slipping == touching => ContactState::Slip,
        _ => ContactState::Partial,
    }
}
