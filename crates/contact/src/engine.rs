//! Either engine behind one contract.

use crate::{Apex, ContactError, Curve, Interface, Move, Outcome, Response, Row, Segment, Springs};
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
            Self::Row(springs) => Memory::Row { row: Row::at(springs, at), springs: Arc::clone(springs) },
        }
    }
}

/// The state of a contact: all that its future depends on.
#[derive(Debug, Clone, PartialEq)]
pub enum Memory {
    /// The exact memory curve.
    Curve(Curve),
    /// A row of springs.
    Row {
        /// Stretches.
        row: Row,
        /// The springs, shared with the model.
        springs: Arc<Springs>,
    },
}

impl Memory {
    /// Where the contact stands.
    pub fn apex(&self) -> Apex {
        match self {
            Self::Curve(curve) => curve.apex(),
            Self::Row { row, .. } => row.apex(),
        }
    }

    /// Force and tangents that a move would give.
    #[inline]
    pub fn trial(&self, law: &Interface, to: Move) -> Response {
        match self {
            Self::Curve(curve) => curve.trial(law, to),
            Self::Row { row, springs } => row.trial(springs, law, to),
        }
    }

    /// F_x that a chord would give, N: the cheapest question.
    #[inline]
    pub fn force(&self, law: &Interface, to: Apex) -> f64 {
        match self {
            Self::Curve(curve) => curve.trial(law, Move::Chord(to)).force,
            Self::Row { row, springs } => row.force(springs, law, to),
        }
    }

    /// Everything that a chord would give, its friction work included.
    pub fn preview(&self, law: &Interface, to: Apex) -> Outcome {
        match self {
            Self::Curve(curve) => curve.preview(law, to),
            Self::Row { row, springs } => row.preview(springs, law, Move::Chord(to)),
        }
    }

    /// Accepts a segment and returns its friction work, J. Fails without a trace.
    pub fn commit(&mut self, law: &Interface, segment: Segment) -> Result<f64, ContactError> {
        match self {
            Self::Curve(curve) => curve.commit(law, segment),
            Self::Row { row, springs } => row.commit(springs, law, segment),
        }
    }
}
