//! The engines behind one contract.

use crate::{
    Apex, Branch, ContactError, Course, Curve, Dragged, Interface, Merged, Move, Outcome, Response, Row,
    Segment, SpringState, Springs, Timed,
};
use std::sync::Arc;

/// How the tangential problem of a contact is solved. Constant.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Engine {
    /// The exact memory curve.
    #[default]
    Curve,
    /// A row of springs.
    Row(Arc<Springs>),
}

impl Engine {
    /// The memory of an untouched contact at an apex.
    pub fn memory(&self, law: &Interface, at: Apex) -> Memory {
        match self {
            Self::Curve => Memory::Curve(Curve::new(law, at)),
            Self::Row(springs) => {
                Memory::Row(SpringRow { row: Row::at(springs, at), springs: Arc::clone(springs) })
            }
        }
    }

    /// Makes a memory that of an untouched contact at an apex: a curve in the room it has, a row anew.
    pub fn begin(&self, memory: &mut Memory, law: &Interface, at: Apex) {
        match (self, memory) {
            (Self::Curve, Memory::Curve(curve)) => curve.begin(law, at),
            (engine, memory) => *memory = engine.memory(law, at),
        }
    }

    /// Whether its memories can freeze smooth branches: the capability that [`Tangential::branching`] gives.
    pub fn branches(&self) -> bool {
        matches!(self, Self::Curve)
    }

    /// Springs that every evaluation asks; 0 for an engine without.
    pub fn springs(&self) -> usize {
        match self {
            Self::Curve => 0,
            Self::Row(springs) => springs.count(),
        }
    }
}

/// What every engine's memory answers. Evaluation borrows shared and leaves no trace; only [`commit`](Self::commit) moves
/// the memory.
pub trait Tangential {
    /// Where the contact stands.
    fn apex(&self) -> Apex;
    /// Counts displacements from another origin, `by` (m) further back.
    fn shift(&mut self, by: f64);
    /// Force and tangents that a move would give: what an implicit or a whole law needs.
    fn trial(&self, law: &Interface, to: Timed<Move>) -> Response;
    /// F_x that a chord would give, N: the cheapest question.
    fn force(&self, law: &Interface, to: Apex) -> f64;
    /// Everything that a chord would give, its friction work included.
    fn preview(&self, law: &Interface, to: Apex) -> Outcome;
    /// Accepts a segment and returns its friction work, J. Fails without a trace.
    fn commit(&mut self, law: &Interface, segment: Timed<Segment>) -> Result<f64, ContactError>;
    /// The same, of friction work only what no power of a branch tells.
    fn commit_beside_power(&mut self, law: &Interface, segment: Timed<Segment>) -> Result<f64, ContactError>;
    /// The smooth branches of an engine that has them. None where the law has kinks of its own between any two moves:
    /// then the whole law is integrated, and only reversals of sliding are events.
    fn branching(&self) -> Option<&dyn Branching> {
        None
    }
}

/// Smooth branches of the hysteresis, for steppers that integrate from event to event.
// A capability and not a part of the contract: a row's force has a kink wherever one of its springs begins to slip, so that
// its branches are as short as the steps. Asked for once an event, by a call through a table.
pub trait Branching {
    /// The course of a contact in motion, from ḋ and u̇, m/s.
    fn course(&self, law: &Interface, dd: f64, du: f64) -> Course;
    /// The branch of a sense (+1 or -1) that starts at the committed apex; knots within `slack` (m) of the edge count as
    /// reached.
    fn branch(&self, law: &Interface, sense: f64, slack: f64) -> Branch;
    /// What a chord gives, dragged by the edge of a sense.
    fn dragged(&self, law: &Interface, sense: f64, to: Apex) -> Dragged;
    /// Friction work of a chord, J, besides what the power of a branch adds up to, where the chord gives up a path of growth.
    fn beside_growth(&self, law: &Interface, to: Apex) -> f64;
    /// How far an apex lies above the curve at its own height, m, and the slope of the curve there; none while open and beyond
    /// its end.
    fn beside(&self, at: Apex) -> Option<[f64; 2]>;
}

/// A row of springs with its springs.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringRow {
    /// Anchors: what moves.
    pub row: Row,
    /// The springs, shared with the model.
    pub springs: Arc<Springs>,
}

/// The state of a contact: all that its future depends on.
#[derive(Debug, Clone, PartialEq)]
pub enum Memory {
    /// The exact memory curve.
    Curve(Curve),
    /// A row of springs.
    Row(SpringRow),
}

/// One spring of a contact as it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// Position x, m.
    pub x: f64,
    /// Stretch u - p, m; 0 while it does not touch.
    pub stretch: f64,
    /// State after the last move that was not zero.
    pub state: SpringState,
    /// Height g(x), m: the indentation at which it touches.
    pub height: f64,
    /// Its share Δx of the foundation, m.
    pub length: f64,
}

impl Spring {
    /// Normal force E\*Δx(d-g) at the indentation d (m), N (4.23); 0 while it does not touch.
    pub fn normal_force(&self, law: &Interface, d: f64) -> f64 {
        law.normal_modulus() * self.length * (d - self.height).max(0.0)
    }

    /// Tangential force G\*Δx u, N (4.23).
    pub fn tangential_force(&self, law: &Interface) -> f64 {
        law.tangential_modulus() * self.length * self.stretch
    }
}

impl Tangential for Curve {
    fn apex(&self) -> Apex {
        Self::apex(self)
    }
    fn shift(&mut self, by: f64) {
        Self::shift(self, by);
    }
    #[inline]
    fn trial(&self, law: &Interface, to: Timed<Move>) -> Response {
        let springs = Self::trial(self, law, to.path);
        damped(law, springs, self.apex(), to)
    }
    #[inline]
    fn force(&self, law: &Interface, to: Apex) -> f64 {
        self.force_at(law, to)
    }
    fn preview(&self, law: &Interface, to: Apex) -> Outcome {
        Self::preview(self, law, to)
    }
    fn commit(&mut self, law: &Interface, segment: Timed<Segment>) -> Result<f64, ContactError> {
        Self::commit(self, law, segment.path)
    }
    fn commit_beside_power(&mut self, law: &Interface, segment: Timed<Segment>) -> Result<f64, ContactError> {
        Self::commit_beside_power(self, law, segment.path)
    }
    fn branching(&self) -> Option<&dyn Branching> {
        Some(self)
    }
}

impl Branching for Curve {
    fn course(&self, law: &Interface, dd: f64, du: f64) -> Course {
        Self::course(self, law, dd, du)
    }
    fn branch(&self, law: &Interface, sense: f64, slack: f64) -> Branch {
        Self::branch(self, law, sense, slack)
    }
    fn dragged(&self, law: &Interface, sense: f64, to: Apex) -> Dragged {
        Self::dragged(self, law, sense, to)
    }
    fn beside_growth(&self, law: &Interface, to: Apex) -> f64 {
        Self::beside_growth(self, law, to)
    }
    fn beside(&self, at: Apex) -> Option<[f64; 2]> {
        Self::beside(self, at)
    }
}

impl Tangential for SpringRow {
    fn apex(&self) -> Apex {
        self.row.apex()
    }
    fn shift(&mut self, by: f64) {
        self.row.shift(by);
    }
    fn trial(&self, law: &Interface, to: Timed<Move>) -> Response {
        let springs = self.row.trial(&self.springs, law, to.path);
        damped(law, springs, self.row.apex(), to)
    }
    fn force(&self, law: &Interface, to: Apex) -> f64 {
        self.row.force(&self.springs, law, to)
    }
    fn preview(&self, law: &Interface, to: Apex) -> Outcome {
        self.row.preview(&self.springs, law, Move::Chord(to))
    }
    fn commit(&mut self, law: &Interface, segment: Timed<Segment>) -> Result<f64, ContactError> {
        self.row.commit(&self.springs, law, segment.path)
    }
    fn commit_beside_power(&mut self, law: &Interface, segment: Timed<Segment>) -> Result<f64, ContactError> {
        Self::commit(self, law, segment).map(|_| 0.0)
    }
}

/// What the springs that stick at the end of a move carry by their damping is added to their force.
#[inline]
fn damped(law: &Interface, springs: Response, from: Apex, Timed { path, duration }: Timed<Move>) -> Response {
    if duration == 0.0 || law.damping() == 0.0 {
        return springs;
    }
    let rate = (path.end().u - from.u) / duration;
    Response { force: springs.force + law.viscosity(springs.stiffness) * rate, ..springs }
}

/// One method of whichever engine it is.
// An enum so that memories can be cloned, compared and saved with the state of a run, not for speed: a force takes 25.6 ns by
// the match and 25.8 through a table.
macro_rules! either {
    ($memory:expr, $engine:ident => $call:expr) => {
        match $memory {
            Memory::Curve($engine) => $call,
            Memory::Row($engine) => $call,
        }
    };
}

impl Memory {
    /// Turning points that a curve remembers unless it is [bounded](Self::bound).
    pub const DEFAULT_CAPACITY: usize = Curve::DEFAULT_CAPACITY;

    /// Becomes another one's copy, in the room there is: between memories of one contact nothing is allocated once they have been
    /// as deep.
    pub fn copy(&mut self, from: &Self) {
        match (self, from) {
            (Self::Curve(own), Self::Curve(from)) => own.copy(from),
            (Self::Row(own), Self::Row(from)) => {
                own.row.copy(&from.row);
                own.springs.clone_from(&from.springs);
            }
            (own, from) => *own = from.clone(),
        }
    }

    /// Makes the room that a new memory has, for one that is a copy or was read from words: within it commits allocate
    /// nothing.
    pub fn make_room(&mut self) {
        match self {
            Self::Curve(curve) => curve.make_room(),
            // A row has all its springs.
            Self::Row(_) => {}
        }
    }

    /// Remembers no more than so many turning points from here on; a row has all its springs, and none.
    pub fn bound(&mut self, law: &Interface, capacity: usize) {
        if let Self::Curve(curve) = self {
            curve.bound(law, capacity);
        }
    }

    /// Turning points that it remembers; of a row none.
    pub fn knot_count(&self) -> usize {
        match self {
            Self::Curve(curve) => curve.knot_count(),
            Self::Row(_) => 0,
        }
    }

    /// What bounding its stack has cost so far; of a row nothing.
    pub fn merged(&self) -> Merged {
        match self {
            Self::Curve(curve) => curve.merged(),
            Self::Row(_) => Merged::default(),
        }
    }

    /// Where the contact stands.
    #[inline]
    pub fn apex(&self) -> Apex {
        either!(self, engine => Tangential::apex(engine))
    }

    /// Counts displacements from another origin, `by` further back.
    #[inline]
    pub fn shift(&mut self, by: f64) {
        either!(self, engine => Tangential::shift(engine, by));
    }

    /// Force and tangents that a move would give.
    #[inline]
    pub fn trial(&self, law: &Interface, to: impl Into<Timed<Move>>) -> Response {
        let to = to.into();
        either!(self, engine => Tangential::trial(engine, law, to))
    }

    /// F_x that a chord would give, N: the cheapest question.
    #[inline]
    pub fn force(&self, law: &Interface, to: Apex) -> f64 {
        either!(self, engine => Tangential::force(engine, law, to))
    }

    /// Everything that a chord would give, its friction work included.
    pub fn preview(&self, law: &Interface, to: Apex) -> Outcome {
        either!(self, engine => Tangential::preview(engine, law, to))
    }

    /// Accepts a segment and returns its friction work, J. Fails without a trace.
    pub fn commit(
        &mut self,
        law: &Interface,
        segment: impl Into<Timed<Segment>>,
    ) -> Result<f64, ContactError> {
        let segment = segment.into();
        either!(self, engine => Tangential::commit(engine, law, segment))
    }

    /// The same, of friction work only what is beside the power of branches, for whoever adds that up.
    ///
    /// # Errors
    /// As those of [`Self::commit`].
    pub fn commit_beside_power(
        &mut self,
        law: &Interface,
        segment: impl Into<Timed<Segment>>,
    ) -> Result<f64, ContactError> {
        let segment = segment.into();
        either!(self, engine => Tangential::commit_beside_power(engine, law, segment))
    }

    /// Contact radius at an indentation d (m), m: a(d), of a row of springs half the length of those that touch.
    pub fn radius(&self, law: &Interface, d: f64) -> f64 {
        match self {
            Self::Curve(_) => law.profile().radius(d),
            Self::Row(SpringRow { springs, .. }) => 0.5 * springs.reduced_stiffness(d),
        }
    }

    /// The smooth branches of an engine that has them.
    #[inline]
    pub fn branching(&self) -> Option<&dyn Branching> {
        either!(self, engine => Tangential::branching(engine))
    }

    /// The course of a contact at indentation d (m) in motion, from ḋ and u̇, m/s. Without smooth branches the sense of
    /// sliding alone tells.
    pub fn course(&self, law: &Interface, d: f64, dd: f64, du: f64) -> Course {
        match self.branching() {
            Some(branching) => branching.course(law, dd, du),
            None if d < 0.0 => Course::Open,
            None if du < 0.0 => Course::Backward,
            None => Course::Forward,
        }
    }

    /// The springs of the contact, by ascending position: a row's own; of the curve those that would stand on `grid`.
    pub fn springs<'a>(
        &'a self,
        law: &'a Interface,
        grid: &'a Springs,
    ) -> Box<dyn Iterator<Item = Spring> + 'a> {
        match self {
            Self::Curve(curve) => Box::new(grid.cells().map(|(x, height, length)| Spring {
                x,
                stretch: curve.stretch(height),
                state: curve.spring_state(height),
                height,
                length,
            })),
            Self::Row(SpringRow { row, springs }) => {
                let insides = row.stretches(springs, law).zip(row.states(springs, law));
                Box::new(springs.cells().zip(insides).map(|((x, height, length), (stretch, state))| Spring {
                    x,
                    stretch,
                    state,
                    height,
                    length,
                }))
            }
        }
    }
}
