//! Memory curve: the exact slip memory of a contact as a piecewise linear function.
//!
//! All springs of equal height h have the same history. The slip memory is therefore one function p(h), 0 ≤ h ≤ d, the rest position of
//! springs at height h. Their stretch is u - p(h). The apex (d, u) is the current point. Friction limits the rest positions to the wedge
//! |p-u| ≤ κ(d-h). The two sides of the wedge, p = u - σκ(d-h) with direction σ = ±1, are the limit lines. When the apex moves, a limit
//! line shifts the part of the curve that would be outside the wedge. No piece is steeper than κ, so this part always begins at the edge of
//! the contact. A stack of breakpoints (h, p) represents the curve.
//!
//! The curve corresponds to the reversal memory of a Preisach or Prandtl–Ishlinskii model. Each reversal also has a height, because
//! the normal load changes the friction limit of all springs.
//!
//! Let m(h) be the length of the foundation below a height, and M, N its first and second integrals. Then
//!
//! * F_x = G\* ∫ p' m dh, a sum of slope × ΔM over the pieces;
//! * tangential elastic energy = ½G\* ∫ (u-p)² dm, by the recursion of [`knot::Knot`];
//! * friction work = G\* ∫ dm ∫ κ(d-h) |dp|, over the shifted pieces ([`sweep`]).
//!
//! Special cases are Cattaneo–Mindlin, Jäger and Ciavarella (4.30–4.33) and Masing's rules. The algorithm is known as the method of
//! memory diagrams (Aleshin, Bou Matar, Van Den Abeele, Int. J. Solids Struct. 2015).

mod ahead;
mod branch;
mod course;
mod cut;
mod fixed_depth;
mod front;
mod knot;
mod legs;
mod stack;
mod sweep;
mod thinning;
mod trial;
mod words;

pub use ahead::Since;
pub use branch::{Branch, Dragged, Lead};
pub use course::Course;
pub use fixed_depth::FixedDepthBranch;
pub use legs::Legs;

use crate::breaking::Rest;
use crate::{Apex, ContactError, ContactState, Interface, Segment, SpringState};
use cut::Drag;
use front::Front;
use knot::Knot;
use stack::{KNOTS_PER_MOVE, SlopeRange};
use sweep::Told;

/// Exact slip memory of a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Breakpoints from the centre to the edge; the last one is the apex. Empty for an open contact.
    knots: Vec<Knot>,
    /// Current indentation and displacement.
    apex: Apex,
    front: Front,
    /// Direction in which the contact slides after it has broken loose; 0 otherwise, and always with one friction coefficient.
    slides: f64,
    pub(crate) rest: Rest,
    /// Slopes at which collinear growth may be merged into the last piece.
    range: SlopeRange,
    /// Largest number of breakpoints.
    capacity: usize,
    merged: Merged,
}

/// Accumulated error due to the limited number of breakpoints.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Merged {
    /// Number of breakpoints that were removed from the memory curve.
    pub knots: u64,
    /// Upper bound of the error of F_x, N.
    pub force: f64,
    /// Upper bound of the error of the elastic energy, J.
    pub energy: f64,
}

impl Curve {
    /// Default limit of the number of breakpoints. A freely decaying oscillation adds two breakpoints per period.
    pub const DEFAULT_CAPACITY: usize = 16_384;
    /// Number of breakpoints that are allocated initially.
    const ROOM: usize = 256;
    /// Smallest capacity.
    const LEAST_CAPACITY: usize = 8;

    /// Creates the memory of an untouched contact: open for d ≤ 0, pressed with unstretched springs for d > 0.
    pub fn new(law: &Interface, at: Apex) -> Self {
        Self::with_capacity(law, at, Self::DEFAULT_CAPACITY)
    }

    /// Creates the memory of an untouched contact with a given capacity (at least 8 breakpoints).
    pub fn with_capacity(law: &Interface, at: Apex, capacity: usize) -> Self {
        let capacity = capacity.max(Self::LEAST_CAPACITY);
        let mut curve = Self {
            knots: Vec::with_capacity(capacity.min(Self::ROOM)),
            apex: at,
            front: Front::STICK,
            slides: 0.0,
            rest: Rest::NONE,
            range: SlopeRange::ALL,
            capacity,
            merged: Merged::default(),
        };
        curve.begin(law, at);
        curve
    }

    /// Resets the curve to an untouched contact at an apex. Capacity and allocated space remain.
    pub(crate) fn begin(&mut self, law: &Interface, at: Apex) {
        self.knots.clear();
        if at.d > 0.0 {
            let first = Knot::touch(at.u);
            self.knots.push(first);
            self.knots.push(first.grow(law, at.d, 0.0, at.u));
        }
        (self.apex, self.front, self.range) = (at, Front::STICK, SlopeRange::ALL);
        (self.slides, self.rest, self.merged) = (0.0, Rest::NONE, Merged::default());
    }

    /// Allocates the space of a new curve, which a copy or a deserialized curve lacks.
    pub(crate) fn make_room(&mut self) {
        let room = self.capacity.min(Self::ROOM);
        self.knots.reserve(room.saturating_sub(self.knots.len()));
    }

    /// Copies another curve into this one and reuses the allocated space.
    pub(crate) fn copy(&mut self, from: &Self) {
        let Self { knots, apex, front, slides, rest, range, capacity, merged } = from;
        self.rest.clone_from(rest);
        self.knots.clone_from(knots);
        (self.apex, self.front, self.range) = (*apex, *front, *range);
        (self.slides, self.capacity, self.merged) = (*slides, *capacity, *merged);
    }

    /// Limits the number of breakpoints (at least 8). Excess breakpoints with the smallest effect are removed, and their error is recorded.
    pub fn bound(&mut self, law: &Interface, capacity: usize) {
        self.capacity = capacity.max(Self::LEAST_CAPACITY);
        while self.knots.len() > self.capacity {
            self.thin(law);
        }
    }

    /// Returns the current indentation and displacement.
    pub fn apex(&self) -> Apex {
        self.apex
    }

    /// Moves the origin of displacements: u and all rest positions grow by `by` (m). Forces and energies do not change.
    // Large displacements lose accuracy: the rounding of u is 1e-12 of the limit force at 10³ u_c and 1e-9 at 10⁶ u_c.
    pub fn shift(&mut self, by: f64) {
        self.apex.u += by;
        self.knots.iter_mut().for_each(|knot| knot.p += by);
    }

    /// Returns the number of breakpoints.
    pub fn knot_count(&self) -> usize {
        self.knots.len()
    }

    /// Returns the breakpoints (h, p) from the centre to the apex, m.
    pub fn knots(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.knots.iter().map(|k| (k.h, k.p))
    }

    /// Returns the heights of the breakpoints from index `place` on, counted from the centre, m.
    pub fn heights_from(&self, place: usize) -> impl Iterator<Item = f64> + '_ {
        self.knots.get(place..).unwrap_or_default().iter().map(|k| k.h)
    }

    /// Returns the index of the first breakpoint above a height (m), or the number of breakpoints if there is none.
    pub fn above(&self, height: f64) -> usize {
        self.knots.partition_point(|knot| knot.h <= height)
    }

    /// Returns the linear pieces from the centre to the apex: heights of both ends, m, slope dp/dh, and force per ΔM over G\*.
    pub(crate) fn pieces(&self) -> impl Iterator<Item = [f64; 4]> + '_ {
        self.knots.windows(2).map(|pair| [pair[0].h, pair[1].h, pair[1].slope, pair[1].gain])
    }

    /// Returns the accumulated error due to the limited number of breakpoints.
    pub fn merged(&self) -> Merged {
        self.merged
    }

    /// Returns the tangential force F_x, N.
    pub fn force(&self, law: &Interface) -> f64 {
        law.tangential_modulus() * self.knots.last().map_or(0.0, |k| k.shear)
    }

    /// Returns the tangential elastic energy ½G\*∫(u-p)²dm, J.
    pub fn elastic(&self, law: &Interface) -> f64 {
        0.5 * law.tangential_modulus() * self.knots.last().map_or(0.0, |k| k.square)
    }

    /// Returns the state of the whole contact after the last move of non-zero length.
    pub fn state(&self, law: &Interface) -> ContactState {
        self.front.zone(law, self.apex.d).0
    }

    /// Returns the stick radius, m; all springs inside this radius stick.
    pub fn stick_radius(&self, law: &Interface) -> f64 {
        self.front.zone(law, self.apex.d).1
    }

    /// Returns the rest position p(h) of springs at height h, m; `None` outside the contact.
    pub fn anchor(&self, h: f64) -> Option<f64> {
        if self.knots.is_empty() || !(0.0..=self.apex.d).contains(&h) {
            return None;
        }
        Some(cut::anchor(&self.knots, h))
    }

    /// Returns the distance u - p between a point (d, u) and the memory curve at h = d, m, and the slope dp/dh there.
    ///
    /// Returns `None` for an open contact and for d above the indentation of the curve.
    pub fn beside(&self, at: Apex) -> Option<[f64; 2]> {
        let inside = self.knots.len() > 1 && at.d <= self.apex.d;
        inside.then(|| {
            let [anchor, slope] = cut::anchor_and_slope(&self.knots, at.d);
            [at.u - anchor, slope]
        })
    }

    /// Returns the stretch u - p(h) of springs at height h, m; 0 outside the contact.
    pub fn stretch(&self, h: f64) -> f64 {
        self.anchor(h).map_or(0.0, |p| self.apex.u - p)
    }

    /// Returns the state of the springs at height h after the last move of non-zero length.
    pub fn spring_state(&self, h: f64) -> SpringState {
        if h >= self.apex.d || self.knots.is_empty() {
            SpringState::Open
        } else if self.front.sense == 0.0 || h <= self.front.height {
            SpringState::Stick
        } else if self.front.sense > 0.0 {
            SpringState::SlipForward
        } else {
            SpringState::SlipBackward
        }
    }

    /// Returns the friction work of a straight path that [`Branch::friction_power`] does not contain, J.
    ///
    /// The curve stores a curved growth path as chords. When a later path erases these chords, their difference to the path appears as this
    /// work.
    pub fn beside_growth(&self, law: &Interface, to: Apex) -> f64 {
        if self.knots.is_empty() { 0.0 } else { sweep::beside(law, &self.knots, self.apex, to) }
    }

    /// Commits a segment and returns the friction work, J. No other method changes the memory.
    ///
    /// Fails if the motion is not finite or exceeds the last point of the profile. The memory is then unchanged.
    pub fn commit(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError> {
        self.accept(law, segment, Told::All)
    }

    /// Commits a segment and returns the part of its friction work that [`Branch::friction_power`] does not contain, J
    /// ([`Self::beside_growth`]).
    ///
    /// # Errors
    /// As [`Self::commit`].
    pub fn commit_beside_power(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError> {
        self.accept(law, segment, Told::BesidePower)
    }

    fn accept(&mut self, law: &Interface, segment: Segment, told: Told) -> Result<f64, ContactError> {
        let to = segment.end();
        if !(to.d.is_finite() && to.u.is_finite()) {
            return Err(ContactError::NotFinite { d: to.d, u: to.u });
        }
        if let Segment::Grown { force, energy, .. } = segment
            && !(force.is_finite() && energy.is_finite())
        {
            return Err(ContactError::SumsNotFinite { force, energy });
        }
        if to == self.apex {
            return Ok(0.0);
        }
        // Only a commit checks the end of the profile; a trial may exceed it.
        law.profile().check_end(to.d)?;
        // Breakpoints are removed before the move. Otherwise the new breakpoint would contain the sums of the old stack, and later merges
        // would count the error again.
        while self.knots.len() + KNOTS_PER_MOVE > self.capacity {
            self.thin(law);
        }
        if let Segment::Grown { to, force, energy, joins } = segment {
            // A growth path that ends no deeper than it began is due to rounding and is treated as a straight path.
            if to.d > self.apex.d.max(0.0) {
                self.grow(law, to, (force, energy), joins);
                return Ok(0.0);
            }
        }
        if self.knots.is_empty() && to.d > 0.0 {
            let touch = self.touching(to);
            self.knots.push(touch);
            self.apex = touch.apex();
            self.range = SlopeRange::ALL;
        }
        let friction = match Drag::of(law, &self.knots, to) {
            Drag::Open => {
                let from = self.apex;
                let friction = match told {
                    _ if self.knots.is_empty() => 0.0,
                    Told::All => sweep::work(law, &self.knots, from, to),
                    Told::BesidePower => sweep::beside(law, &self.knots, from, to),
                };
                self.knots.clear();
                (self.front, self.slides) = (Front::STICK, 0.0);
                friction
            }
            Drag::Rest => 0.0,
            Drag::Stick => {
                self.front = Front::STICK;
                self.push_grown(law, to);
                0.0
            }
            Drag::Slip(edge) => self.push_cut(law, (edge, to), told),
        };
        self.apex = to;
        Ok(friction)
    }

    /// Returns the first breakpoint of an open contact, where the path to `to` crosses d = 0.
    fn touching(&self, to: Apex) -> Knot {
        let Apex { d, u } = self.apex;
        let share = if to.d > d { (-d / (to.d - d)).clamp(0.0, 1.0) } else { 0.0 };
        Knot::touch(u + share * (to.u - u))
    }
}
