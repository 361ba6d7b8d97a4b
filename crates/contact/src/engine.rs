//! Common interface of the two contact engines: memory curve and row of springs.

use crate::{
    Apex, Branch, ContactError, Course, Curve, Dragged, Interface, Lead, Merged, Motion, Move, Outcome,
    Response, Row, Segment, Since, SpringState, Springs,
};
use std::sync::Arc;

/// Method that solves the tangential contact problem.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Engine {
    /// The exact memory curve.
    #[default]
    Curve,
    /// A row of springs.
    Row(Arc<Springs>),
}

impl Engine {
    /// Creates the memory of an untouched contact at an apex.
    pub fn memory(&self, law: &Interface, at: Apex) -> Memory {
        match self {
            Self::Curve => Memory::Curve(Curve::new(law, at)),
            Self::Row(springs) => {
                Memory::Row(SpringRow { row: Row::at(springs, at), springs: Arc::clone(springs) })
            }
        }
    }

    /// Resets a memory to the memory of an untouched contact at an apex. A curve keeps its allocated space.
    pub fn begin(&self, memory: &mut Memory, law: &Interface, at: Apex) {
        match (self, memory) {
            (Self::Curve, Memory::Curve(curve)) => curve.begin(law, at),
            (engine, memory) => *memory = engine.memory(law, at),
        }
    }

    /// Returns whether the memories of this engine have smooth branches; see [`Tangential::branching`].
    pub fn branches(&self) -> bool {
        matches!(self, Self::Curve)
    }

    /// Returns the number of springs; 0 for the memory curve.
    pub fn springs(&self) -> usize {
        match self {
            Self::Curve => 0,
            Self::Row(springs) => springs.count(),
        }
    }
}

/// Interface of a contact's memory. All methods except [`commit`](Self::commit), `commit_beside_power` and `shift` leave the memory
/// unchanged.
pub trait Tangential {
    /// Returns the current indentation and displacement.
    fn apex(&self) -> Apex;
    /// Moves the origin of displacements by `by` (m): all displacements grow by that amount.
    fn shift(&mut self, by: f64);
    /// Returns the tangential force and its derivatives at the end of a move.
    fn trial(&self, law: &Interface, to: Move) -> Response;
    /// Returns the tangential force F_x at the end of a straight path, N.
    fn force(&self, law: &Interface, to: Apex) -> f64;
    /// Returns force, energies and state at the end of a straight path, including the friction work.
    fn preview(&self, law: &Interface, to: Apex) -> Outcome;
    /// Commits a segment and returns its friction work, J. After an error the memory is unchanged.
    fn commit(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError>;
    /// Commits a segment and returns the part of its friction work that [`Branch::friction_power`] does not contain, J.
    fn commit_beside_power(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError>;
    /// Returns the smooth branches of the hysteresis; `None` for an engine without branches.
    ///
    /// The force of an engine without branches has a kink whenever a spring touches, slips or sticks. For such an engine the full force law
    /// is integrated, and only reversals are events.
    fn branching(&self) -> Option<&dyn Branching> {
        None
    }
}

/// Smooth branches of the hysteresis, for event-based time integration.
pub trait Branching {
    /// Returns the kind of motion of a contact, from the rates ḋ and u̇, m/s.
    fn course(&self, law: &Interface, dd: f64, du: f64) -> Course;
    /// Returns the branch with direction `sense` (+1 or -1) that starts at the committed apex.
    ///
    /// Breakpoints within `slack` (m) of the limit line count as reached.
    fn branch(&self, law: &Interface, sense: f64, slack: f64) -> Branch;
    /// Returns the branch that a damped contact reaches ahead of its slip front; see [`Curve::lead`].
    fn lead(
        &self,
        law: &Interface,
        branch: &Branch,
        at: &Motion,
        lengths: (f64, f64, f64),
        turned: bool,
    ) -> Lead;
    /// Returns force and slip front at the end of a straight path, along the limit line of direction `sense`.
    fn dragged(&self, law: &Interface, sense: f64, to: Apex) -> Dragged;
    /// Returns the friction work of a straight path that [`Branch::friction_power`] does not contain, J.
    ///
    /// This work is not 0 where the path erases curved growth pieces; see [`Curve::beside_growth`].
    fn beside_growth(&self, law: &Interface, to: Apex) -> f64;
    /// Returns the distance u - p between a point (d, u) and the memory curve at h = d, m, and the slope dp/dh there.
    ///
    /// Returns `None` for an open contact and for d above the indentation of the curve.
    fn beside(&self, at: Apex) -> Option<[f64; 2]>;
}

/// Row of springs: constant data and state.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringRow {
    /// Rest positions, the state of the row.
    pub row: Row,
    /// Constant data of the springs, shared with the model.
    pub springs: Arc<Springs>,
}

/// State of a contact; together with the interface it determines all later forces.
#[derive(Debug, Clone, PartialEq)]
pub enum Memory {
    /// The exact memory curve.
    Curve(Curve),
    /// A row of springs.
    Row(SpringRow),
}

/// State of one spring of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// Position x, m.
    pub x: f64,
    /// Stretch u - p, m; 0 for a spring out of contact.
    pub stretch: f64,
    /// State after the last move of non-zero length.
    pub state: SpringState,
    /// Height g(x), m: the indentation at which the spring touches.
    pub height: f64,
    /// Width Δx of the spring's cell, m.
    pub length: f64,
}

impl Spring {
    /// Returns the normal force E\*Δx(d-g) at the indentation d (m), N (4.23); 0 for a spring out of contact.
    pub fn normal_force(&self, law: &Interface, d: f64) -> f64 {
        law.normal_modulus() * self.length * (d - self.height).max(0.0)
    }

    /// Returns the tangential force, N: G\*Δx times the stretch (4.23).
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
    fn trial(&self, law: &Interface, to: Move) -> Response {
        Self::trial(self, law, to)
    }
    #[inline]
    fn force(&self, law: &Interface, to: Apex) -> f64 {
        self.force_at(law, to)
    }
    fn preview(&self, law: &Interface, to: Apex) -> Outcome {
        Self::preview(self, law, to)
    }
    fn commit(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError> {
        Self::commit(self, law, segment)
    }
    fn commit_beside_power(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError> {
        Self::commit_beside_power(self, law, segment)
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
    fn lead(
        &self,
        law: &Interface,
        branch: &Branch,
        at: &Motion,
        lengths: (f64, f64, f64),
        turned: bool,
    ) -> Lead {
        Self::lead(self, law, branch, at, lengths, turned)
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
    fn trial(&self, law: &Interface, to: Move) -> Response {
        self.row.trial(&self.springs, law, to)
    }
    fn force(&self, law: &Interface, to: Apex) -> f64 {
        self.row.force(&self.springs, law, to)
    }
    fn preview(&self, law: &Interface, to: Apex) -> Outcome {
        self.row.preview(&self.springs, law, Move::Chord(to))
    }
    fn commit(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError> {
        self.row.commit(&self.springs, law, segment)
    }
    fn commit_beside_power(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError> {
        Self::commit(self, law, segment).map(|_| 0.0)
    }
}

/// Calls a method of the engine inside a [`Memory`].
macro_rules! either {
    ($memory:expr, $engine:ident => $call:expr) => {
        match $memory {
            Memory::Curve($engine) => $call,
            Memory::Row($engine) => $call,
        }
    };
}

impl Memory {
    /// Default number of reversals that a curve can store; see [`Self::bound`].
    pub const DEFAULT_CAPACITY: usize = Curve::DEFAULT_CAPACITY;

    /// Copies another memory into this one and reuses the allocated space.
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

    /// Allocates the space of a new memory, so that commits within it allocate nothing. Needed after a clone or deserialization.
    pub fn make_room(&mut self) {
        match self {
            Self::Curve(curve) => curve.make_room(),
            // A row is always fully allocated.
            Self::Row(_) => {}
        }
    }

    /// Limits the number of stored reversals of a curve. The method has no effect on a row.
    pub fn bound(&mut self, law: &Interface, capacity: usize) {
        if let Self::Curve(curve) = self {
            curve.bound(law, capacity);
        }
    }

    /// Returns the number of stored reversals of a curve; 0 for a row.
    pub fn knot_count(&self) -> usize {
        match self {
            Self::Curve(curve) => curve.knot_count(),
            Self::Row(_) => 0,
        }
    }

    /// Returns the accumulated error due to the limited number of reversals; 0 for a row.
    pub fn merged(&self) -> Merged {
        match self {
            Self::Curve(curve) => curve.merged(),
            Self::Row(_) => Merged::default(),
        }
    }

    /// Returns the current indentation and displacement.
    #[inline]
    pub fn apex(&self) -> Apex {
        either!(self, engine => Tangential::apex(engine))
    }

    /// Moves the origin of displacements by `by` (m): all displacements grow by that amount.
    #[inline]
    pub fn shift(&mut self, by: f64) {
        either!(self, engine => Tangential::shift(engine, by));
    }

    /// Returns the tangential force and its derivatives at the end of a move.
    #[inline]
    pub fn trial(&self, law: &Interface, to: Move) -> Response {
        match (law.kinetic(), to) {
            (Some(kinetic), Move::Chord(at)) => self.trial_breaking(
                [law, kinetic],
                at,
                |memory, law| either!(memory, engine => Tangential::trial(engine, law, to)),
            ),
            _ => either!(self, engine => Tangential::trial(engine, law, to)),
        }
    }

    /// Returns the tangential force F_x at the end of a straight path, N.
    #[inline]
    pub fn force(&self, law: &Interface, to: Apex) -> f64 {
        match law.kinetic() {
            Some(_) => self.trial(law, Move::Chord(to)).force,
            None => either!(self, engine => Tangential::force(engine, law, to)),
        }
    }

    /// Returns the force F_x of a damped contact for the motion at the end of a path, and the damping force in it, N.
    ///
    /// Every spring carries G\*(s + βu̇), limited to its friction limit, where s is its elastic stretch. The damping force is F_x minus
    /// the elastic force and opposes the motion. A row has straight paths only. `elastic` is the elastic force of the
    /// caller's law, N, and `known` whether it is that of the memory.
    pub fn damped(
        &self,
        law: &Interface,
        since: Since,
        at: &Motion,
        (elastic, known): (f64, bool),
    ) -> [f64; 2] {
        let law = law.kinetic().filter(|_| self.slides() != 0.0).unwrap_or_else(|| self.law(law));
        let ahead = |lead: f64| match self {
            Self::Curve(curve) => curve.ahead(law, since, at, lead),
            Self::Row(SpringRow { row, springs }) => row.ahead(springs, law, at.apex(), lead),
        };
        let lead = law.damping() * at.du;
        if lead == 0.0 || at.d <= 0.0 {
            return [elastic, 0.0];
        }
        let damped = ahead(lead);
        // Without rounding the force is `damped`.
        [elastic + (damped - elastic), damped - if known { elastic } else { ahead(0.0) }]
    }

    /// Returns force, energies and state at the end of a straight path, including the friction work.
    pub fn preview(&self, law: &Interface, to: Apex) -> Outcome {
        let one =
            |memory: &Self, law: &Interface| either!(memory, engine => Tangential::preview(engine, law, to));
        match law.kinetic() {
            Some(kinetic) => self.preview_breaking([law, kinetic], to, one),
            None => one(self, law),
        }
    }

    /// Commits a segment and returns its friction work, J. After an error the memory is unchanged.
    pub fn commit(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError> {
        self.commit_by(
            law,
            segment,
            |memory, law, path| either!(memory, engine => Tangential::commit(engine, law, path)),
        )
    }

    /// Commits a segment and returns the part of its friction work that [`Branch::friction_power`] does not contain, J.
    ///
    /// # Errors
    /// As [`Self::commit`].
    pub fn commit_beside_power(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError> {
        self.commit_by(
            law,
            segment,
            |memory, law, path| either!(memory, engine => Tangential::commit_beside_power(engine, law, path)),
        )
    }

    /// Returns the contact radius at an indentation d (m), m: a(d), or for a row half the length in contact.
    pub fn radius(&self, law: &Interface, d: f64) -> f64 {
        match self {
            Self::Curve(_) => law.profile().radius(d),
            Self::Row(SpringRow { springs, .. }) => {
                law.profile().radius_of_reduced_stiffness(springs.reduced_stiffness(d))
            }
        }
    }

    /// Returns the smooth branches of the hysteresis; `None` for an engine without branches.
    #[inline]
    pub fn branching(&self) -> Option<&dyn Branching> {
        either!(self, engine => Tangential::branching(engine))
    }

    /// Returns the kind of motion of a contact at indentation d (m), from the rates ḋ and u̇, m/s.
    ///
    /// For an engine without smooth branches the sign of u̇ alone determines the result.
    pub fn course(&self, law: &Interface, d: f64, dd: f64, du: f64) -> Course {
        match self.branching() {
            Some(branching) => branching.course(self.law(law), dd, du),
            None if d < 0.0 => Course::Open,
            None if du < 0.0 => Course::Backward,
            None => Course::Forward,
        }
    }

    /// Returns all springs in order of their position. A curve is evaluated at the springs of `grid`.
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
                let law = self.law(law);
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
