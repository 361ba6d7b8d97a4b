//! Either engine behind one contract.

use crate::{
    Apex, ContactError, Curve, Interface, Move, Outcome, Response, Row, Segment, SpringState, Springs,
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

/// One spring of a contact as it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// Place, m.
    pub x: f64,
    /// Stretch u - p, m; 0 while it does not touch.
    pub stretch: f64,
    /// State after the last move that was not zero.
    pub state: SpringState,
}

impl Memory {
    /// Where the contact stands.
    pub fn apex(&self) -> Apex {
        match self {
            Self::Curve(curve) => curve.apex(),
            Self::Row { row, .. } => row.apex(),
        }
    }

    /// Counts displacements from another place, `by` further on.
    pub fn shift(&mut self, by: f64) {
        match self {
            Self::Curve(curve) => curve.shift(by),
            Self::Row { row, .. } => row.shift(by),
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

    /// The springs of the contact, by ascending place: a row's own; of the curve those that would stand on `grid`.
    pub fn springs<'a>(
        &'a self,
        law: &'a Interface,
        grid: &'a Springs,
    ) -> Box<dyn Iterator<Item = Spring> + 'a> {
        match self {
            Self::Curve(curve) => {
                let places = grid.positions().iter().zip(grid.heights_in_place());
                Box::new(places.map(|(&x, h)| Spring {
                    x,
                    stretch: curve.stretch(h),
                    state: curve.spring_state(h),
                }))
            }
            Self::Row { row, springs } => {
                let places = springs.positions().iter();
                let insides = row.stretches(springs, law).zip(row.states(springs, law));
                Box::new(places.zip(insides).map(|(&x, (stretch, state))| Spring { x, stretch, state }))
            }
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
