//! The row of springs: the handbook's algorithm (chapter 11), exact along straight chords.
//!
//! A spring at height h touches while h < d and carries G\* times its length and stretch, with the stretch
//! clamped to ±κ(d-h) (4.22). Kept per spring is its anchor p, where it would be unstretched: while it sticks
//! nothing changes, so nothing drifts, however many steps there are. The handbook keeps stretches and adds Δu to each of them
//! in every step.
//!
//! The row shares no formula of forces with the [`Curve`](crate::Curve): each is the other's test.

mod chord;
mod lanes;
mod lull;
mod springs;
mod words;

pub use lull::{Change, Lull, Slack};
pub use springs::{Springs, SpringsError};

use crate::{Apex, ContactError, ContactState, Interface, Move, Outcome, Response, Segment, SpringState};
use chord::Chord;

/// The state of a row of springs: all that its future depends on.
///
/// Every method wants the [`Springs`] the row was made for and the interface it belongs to.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    apex: Apex,
    /// Anchor of each distinct spring by ascending height, m; 0 while it does not touch.
    anchors: Vec<f64>,
    /// Number of distinct springs that touch: the lowest ones.
    touching: usize,
    /// Whether u fell in the last move in which it changed. Tells the sign of slip where the limit is 0.
    backward: bool,
}

impl Row {
    /// An untouched row at d = 0, u = 0.
    pub fn new(springs: &Springs) -> Self {
        Self::at(springs, Apex::default())
    }

    /// A row at an apex, springs unstretched.
    pub fn at(springs: &Springs, apex: Apex) -> Self {
        let touching = springs.below(apex.d);
        let mut anchors = vec![0.0; springs.heights().len()];
        anchors[..touching].fill(apex.u);
        Self { apex, anchors, touching, backward: false }
    }

    /// Becomes the copy of another row of as many springs, in the room there is.
    pub(crate) fn copy(&mut self, from: &Self) {
        let Self { apex, anchors, touching, backward } = from;
        self.anchors.clone_from(anchors);
        (self.apex, self.touching, self.backward) = (*apex, *touching, *backward);
    }

    /// Where the row stands.
    pub fn apex(&self) -> Apex {
        self.apex
    }

    /// Counts displacements from another origin, `by` further back: u and anchors grow by as much. Nothing else changes.
    pub fn shift(&mut self, by: f64) {
        self.apex.u += by;
        self.anchors[..self.touching].iter_mut().for_each(|anchor| *anchor += by);
    }

    /// Number of distinct springs that touch once the indentation is d.
    #[inline]
    fn touching_at(&self, springs: &Springs, d: f64) -> usize {
        if d == self.apex.d { self.touching } else { springs.below_near(d, self.touching) }
    }

    /// `F_x` at the end of a chord, N: the cheapest question.
    // 19 ns by a row of 64 springs, 2.5e-4 of the limit force off on the way back from 0.7 u_c; 205 ns and 1e-6 by one of 1024,
    // whose friction work is 1e-5 off. The exact curve takes 26.
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

    /// `F_x` at the end of a move and its tangents there: ∂F/∂u = G\* times the length that sticks,
    /// ∂F/∂d = G\*κ times the length that slips forward less the length that slips backward.
    ///
    /// A row has no use for an integrated force: growth along a curved path is taken as the chord to its end.
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

    /// Everything that a move would give, its friction work included. Costs several trials.
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
            stick_radius: springs.inner_radius(first_slip.unwrap_or(after)),
            state: whole_state(after, slipping),
        }
    }

    /// Accepts a segment and returns its friction work, J, at least 0. Every kind of segment is taken as the
    /// chord to its end: a row under a growing load wants steps that leave its path no bend.
    ///
    /// # Errors
    ///
    /// If the end is not finite, outgrows the row or lies beyond the points of its profile; the state is then untouched.
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
        // All that can fail has been asked: from here on the row moves, and moves whole.
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
        // No term is below zero but for its rounding: work is never taken back.
        Ok((law.tangential_modulus() * work).max(0.0))
    }

    /// Tangential elastic energy ½G\*Σ length·stretch², J.
    pub fn elastic(&self, springs: &Springs, law: &Interface) -> f64 {
        let touching = springs.first(self.touching);
        let square = |((&h, &length), &anchor): ((&f64, &f64), &f64)| {
            let stretch = lanes::clamp(self.apex.u - anchor, law.stick_slope() * (self.apex.d - h));
            length * stretch * stretch
        };
        let sum: f64 = touching.heights.iter().zip(touching.lengths).zip(&self.anchors).map(square).sum();
        0.5 * law.tangential_modulus() * sum
    }

    /// Stretch u - p of every spring, m, in the order of [`Springs::positions`]; 0 while it does not touch.
    pub fn stretches<'a>(
        &'a self,
        springs: &'a Springs,
        law: &'a Interface,
    ) -> impl Iterator<Item = f64> + 'a {
        springs.ranks().iter().map(move |&rank| self.stretch(springs, law, rank))
    }

    /// Height and anchor of every distinct spring that touches, m, from the lowest one on.
    pub(crate) fn anchors<'a>(
        &'a self,
        springs: &'a Springs,
        law: &'a Interface,
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        let touching = springs.heights().iter().enumerate().take(self.touching);
        touching.map(move |(rank, &h)| (h, self.apex.u - self.stretch(springs, law, rank)))
    }

    /// State of the lowest spring, the last to slip: where it does, all that touch do.
    pub fn lowest(&self, springs: &Springs, law: &Interface) -> SpringState {
        self.state(springs, law, 0)
    }

    /// State of every spring, in the order of [`Springs::positions`].
    pub fn states<'a>(
        &'a self,
        springs: &'a Springs,
        law: &'a Interface,
    ) -> impl Iterator<Item = SpringState> + 'a {
        springs.ranks().iter().map(move |&rank| self.state(springs, law, rank))
    }

    /// Limit κ(d-h) of the distinct spring of a rank, m.
    fn limit(&self, springs: &Springs, law: &Interface, rank: usize) -> f64 {
        law.stick_slope() * (self.apex.d - springs.heights()[rank])
    }

    /// Its stretch, m.
    fn stretch(&self, springs: &Springs, law: &Interface, rank: usize) -> f64 {
        if rank >= self.touching {
            return 0.0;
        }
        lanes::clamp(self.apex.u - self.anchors[rank], self.limit(springs, law, rank))
    }

    /// Its state.
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

/// State of a row from the number of springs that touch and that are at their limit.
fn whole_state(touching: usize, slipping: usize) -> ContactState {
    match slipping {
        _ if touching == 0 => ContactState::Open,
        0 => ContactState::Stick,
        _ if slipping == touching => ContactState::Slip,
        _ => ContactState::Partial,
    }
}
