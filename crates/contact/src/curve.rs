//! The memory curve: the exact state of a contact, without springs.
//!
//! All springs of one height h share one history, so the state is a curve p(h), 0 ≤ h ≤ d: the position at
//! which a spring of height h is anchored; its stretch is u - p(h). The pair (d, u) is the apex of a wedge
//! |p-u| ≤ κ(d-h) that may never leave the curve outside: moving the apex drags the curve. No piece is steeper
//! than κ, so a drag cuts the curve from the edge inwards only, and a stack of knots holds it.
//!
//! Read from the edge inwards it is what a Preisach or Prandtl–Ishlinskii model keeps of its turning points; here each has
//! its height, because the normal load moves the limit of all springs at once.
//!
//! With m the length below a height, and M, N its first and second integrals,
//!
//! * F_x = G\* ∫ p' m dh, a sum of slope × ΔM over the pieces,
//! * elastic energy = ½G\* ∫ (u-p)² dm, by the recursion of [`knot::Knot`],
//! * friction work = G\* ∫ dm ∫ κ(d-h) |dp|, over the swept pieces ([`sweep`]).
//!
//! Contains Cattaneo–Mindlin, Jäger and Ciavarella (4.30–4.33) and Masing's rules as special cases. The same
//! idea is published as the method of memory diagrams (Aleshin, Bou Matar, Van Den Abeele, Int. J. Solids
//! Struct. 2015).

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

pub use branch::{Branch, Dragged};
pub use course::Course;
pub use fixed_depth::FixedDepthBranch;
pub use legs::Legs;

use crate::{Apex, ContactError, ContactState, Interface, Segment, SpringState};
use cut::Drag;
use front::Front;
use knot::Knot;
use stack::{KNOTS_PER_MOVE, SlopeRange};
use sweep::Told;

/// State of a contact that remembers exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// From the centre to the edge, the last one is the apex; empty while the contact is open.
    knots: Vec<Knot>,
    /// Where the contact stands, open or not.
    apex: Apex,
    front: Front,
    /// What collinear growth may merge into the top piece.
    range: SlopeRange,
    /// Most knots.
    capacity: usize,
    merged: Merged,
}

/// What bounding the stack has cost.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Merged {
    /// Number of knots given up.
    pub knots: u64,
    /// Sum of what each has changed F_x by, at most, N: now, or where an edge stops at its height.
    pub force: f64,
    /// Sum of what each has changed the elastic energy by, at most, J: of the force the largest stretch at its pieces.
    pub energy: f64,
}

impl Curve {
    /// Knots kept by default; a free decay adds two per period, for ever.
    // A decay of 40 000 swings, each a bit smaller than the one before, then has 8.4e-6 of the limit force in all its merges,
    // and 2.5e-5 by a stack of 64: what is given up first is small. Room, not exactness, is what it is chosen for: 1.2 MB.
    pub const DEFAULT_CAPACITY: usize = 16_384;
    /// Knots that there is room for from the start.
    // What most histories need, 18 kB; a thousand contacts should not take the full stack each.
    const ROOM: usize = 256;
    /// Fewest knots a stack is made for.
    const LEAST_CAPACITY: usize = 8;

    /// The untouched contact: open or just touching (d ≤ 0) or pressed with unstretched springs (d > 0).
    pub fn new(law: &Interface, at: Apex) -> Self {
        Self::with_capacity(law, at, Self::DEFAULT_CAPACITY)
    }

    /// The same with a stack of another capacity (at least 8 knots).
    pub fn with_capacity(law: &Interface, at: Apex, capacity: usize) -> Self {
        let capacity = capacity.max(Self::LEAST_CAPACITY);
        let mut curve = Self {
            knots: Vec::with_capacity(capacity.min(Self::ROOM)),
            apex: at,
            front: Front::STICK,
            range: SlopeRange::ALL,
            capacity,
            merged: Merged::default(),
        };
        curve.begin(law, at);
        curve
    }

    /// Becomes the curve of an untouched contact at an apex, in the room there is; its capacity stays.
    pub(crate) fn begin(&mut self, law: &Interface, at: Apex) {
        self.knots.clear();
        if at.d > 0.0 {
            let first = Knot::touch(at.u);
            self.knots.push(first);
            self.knots.push(first.grow(law, at.d, 0.0, at.u));
        }
        (self.apex, self.front, self.range) = (at, Front::STICK, SlopeRange::ALL);
        self.merged = Merged::default();
    }

    /// Makes the room that a new curve has: a copy, or a curve read from words, has none but for what it holds.
    pub(crate) fn make_room(&mut self) {
        let room = self.capacity.min(Self::ROOM);
        self.knots.reserve(room.saturating_sub(self.knots.len()));
    }

    /// Becomes another curve's copy, in the room there is.
    pub(crate) fn copy(&mut self, from: &Self) {
        let Self { knots, apex, front, range, capacity, merged } = from;
        self.knots.clone_from(knots);
        (self.apex, self.front, self.range) = (*apex, *front, *range);
        (self.capacity, self.merged) = (*capacity, *merged);
    }

    /// Remembers no more than so many knots (at least 8) from here on; with more of them the least go, and are booked.
    pub fn bound(&mut self, law: &Interface, capacity: usize) {
        self.capacity = capacity.max(Self::LEAST_CAPACITY);
        while self.knots.len() > self.capacity {
            self.thin(law);
        }
    }

    /// Where the contact stands.
    pub fn apex(&self) -> Apex {
        self.apex
    }

    /// Counts displacements from another origin, `by` further back: u and anchors grow by as much. Nothing else changes; a
    /// shift by which no digit is lost leaves forces and energies as they are to the last bit.
    // For contacts that travel: 10³ u_c from the origin rounding of u is 1e-12 of the limit force, 10⁶ u_c from it 1e-9.
    pub fn shift(&mut self, by: f64) {
        self.apex.u += by;
        self.knots.iter_mut().for_each(|knot| knot.p += by);
    }

    /// Number of knots in the stack.
    pub fn knot_count(&self) -> usize {
        self.knots.len()
    }

    /// Knots (h, p) from the centre to the apex, m.
    pub fn knots(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.knots.iter().map(|k| (k.h, k.p))
    }

    /// Heights of the knots from one of them on, by its place from the centre, m; none beyond the apex.
    pub fn heights_from(&self, place: usize) -> impl Iterator<Item = f64> + '_ {
        self.knots.get(place..).unwrap_or_default().iter().map(|k| k.h)
    }

    /// Place of the lowest knot that is above a height, m; that beyond the apex where none is.
    pub fn above(&self, height: f64) -> usize {
        self.knots.partition_point(|knot| knot.h <= height)
    }

    /// The straight pieces from the centre to the apex: heights of their ends, m, slope dp/dh and force per ΔM over G\*.
    pub(crate) fn pieces(&self) -> impl Iterator<Item = [f64; 4]> + '_ {
        self.knots.windows(2).map(|pair| [pair[0].h, pair[1].h, pair[1].slope, pair[1].gain])
    }

    /// What bounding the stack has cost so far.
    pub fn merged(&self) -> Merged {
        self.merged
    }

    /// Tangential force F_x, N.
    pub fn force(&self, law: &Interface) -> f64 {
        law.tangential_modulus() * self.knots.last().map_or(0.0, |k| k.shear)
    }

    /// Tangential elastic energy ½G\*∫(u-p)²dm, J.
    pub fn elastic(&self, law: &Interface) -> f64 {
        0.5 * law.tangential_modulus() * self.knots.last().map_or(0.0, |k| k.square)
    }

    /// State of the whole contact after the last move that was not zero.
    pub fn state(&self, law: &Interface) -> ContactState {
        self.front.zone(law, self.apex.d).0
    }

    /// Radius inside which no spring is at its limit, m.
    pub fn stick_radius(&self, law: &Interface) -> f64 {
        self.front.zone(law, self.apex.d).1
    }

    /// Anchor p(h) of the springs at height h, m; none outside the contact.
    pub fn anchor(&self, h: f64) -> Option<f64> {
        if self.knots.is_empty() || !(0.0..=self.apex.d).contains(&h) {
            return None;
        }
        Some(cut::anchor(&self.knots, h))
    }

    /// How far an apex lies above the curve at its own height, m, and the slope dp/dh of the curve there; none while open and
    /// beyond the end of the curve.
    pub fn beside(&self, at: Apex) -> Option<[f64; 2]> {
        let inside = self.knots.len() > 1 && at.d <= self.apex.d;
        inside.then(|| {
            let [anchor, slope] = cut::anchor_and_slope(&self.knots, at.d);
            [at.u - anchor, slope]
        })
    }

    /// Stretch u - p(h) of the springs at height h, m; zero outside the contact.
    pub fn stretch(&self, h: f64) -> f64 {
        self.anchor(h).map_or(0.0, |p| self.apex.u - p)
    }

    /// State of the springs at height h after the last move that was not zero.
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

    /// Friction work of a chord, J, besides what the front's way alone tells, which [`Branch::friction_power`] adds up: a path of growth
    /// is kept as chords.
    pub fn beside_growth(&self, law: &Interface, to: Apex) -> f64 {
        if self.knots.is_empty() { 0.0 } else { sweep::beside(law, &self.knots, self.apex, to) }
    }

    /// Accepts a segment: the only thing that moves the memory. Returns the friction work, J.
    ///
    /// Fails, leaving everything as it was, for a motion that is not finite or leaves the points that the profile is given by.
    pub fn commit(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError> {
        self.accept(law, segment, Told::All)
    }

    /// The same, of friction work only what is beside the power of branches, J ([`Self::beside_growth`]): for whoever adds that up.
    ///
    /// # Errors
    /// As those of [`Self::commit`].
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
        // Only here and in no trial: a stepper may look beyond, and go another way.
        law.profile().check_end(to.d)?;
        // Before the move: a knot made first would carry the sums of the stack as it was, the error be hidden in a
        // step at the apex and booked again by every later merge.
        while self.knots.len() + KNOTS_PER_MOVE > self.capacity {
            self.thin(law);
        }
        if let Segment::Grown { to, force, energy, joins } = segment {
            // A path that ends no deeper than it began has not grown: rounding, left to the chord below.
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
                self.front = Front::STICK;
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

    /// The knot an open contact touches with on its way to `to`: the path crosses d = 0 there.
    fn touching(&self, to: Apex) -> Knot {
        let Apex { d, u } = self.apex;
        let share = if to.d > d { (-d / (to.d - d)).clamp(0.0, 1.0) } else { 0.0 };
        Knot::touch(u + share * (to.u - u))
    }
}
