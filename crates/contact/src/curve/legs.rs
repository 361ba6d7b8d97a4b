//! The memory curve as numbers: how high its knots stand and how steep the pieces between them are, seen from the apex.
//!
//! Where the contact has travelled to does not matter, and of a contact that slips grossly nothing is left but one piece of
//! slope ±κ: what a curve has beside that is what the contact will still answer to.

use super::Curve;
use super::knot::Knot;
use super::stack::SlopeRange;
use crate::{Apex, Interface};

/// A piece this near to ±κ, as a part of it, was made by an edge: its slope is no number of its own.
const EDGE: f64 = 1e-9;

/// Form of a memory curve.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Legs {
    /// Heights of the knots between the centre and the apex, m, ascending.
    pub heights: Vec<f64>,
    /// Slope dp/dh of every piece, from the centre outwards: one more than heights; none of an open contact.
    pub slopes: Vec<f64>,
    /// By how much a path of growth that bends pulls more than its chord: force per ΔM over G\* less the slope.
    pub bends: Vec<f64>,
}

impl Legs {
    /// Sense of a piece that an edge made, ±1; none of one that grew in full stick.
    pub fn sense(&self, law: &Interface, piece: usize) -> Option<f64> {
        sense(*self.slopes.get(piece)?, law)
    }
}

/// Sense of an edge that is so steep; none where it is no edge.
fn sense(slope: f64, law: &Interface) -> Option<f64> {
    (slope.abs() >= law.stick_slope() * (1.0 - EDGE)).then(|| slope.signum())
}

impl Curve {
    /// Slope of its last piece, and the sense of that as [`Legs::sense`] has it; none of an open contact.
    pub fn last_piece(&self, law: &Interface) -> Option<(f64, Option<f64>)> {
        let [.., _, last] = self.knots.as_slice() else { return None };
        Some((last.slope, sense(last.slope, law)))
    }

    /// Its form.
    pub fn legs(&self) -> Legs {
        let Some(pieces) = self.knots.get(1..) else { return Legs::default() };
        Legs {
            heights: pieces.iter().rev().skip(1).rev().map(|knot| knot.h).collect(),
            slopes: pieces.iter().map(|knot| knot.slope).collect(),
            bends: pieces.iter().map(|knot| knot.gain - knot.slope).collect(),
        }
    }

    /// The curve of a form that ends at an apex; none where heights do not ascend from the centre to there.
    #[must_use]
    pub fn standing(&self, law: &Interface, at: Apex, legs: &Legs) -> Option<Self> {
        let mut curve = Self { knots: Vec::new(), apex: at, range: SlopeRange::NONE, ..*self };
        if at.d <= 0.0 {
            return Some(curve);
        }
        let heights: Vec<f64> = [0.0].into_iter().chain(legs.heights.iter().copied()).chain([at.d]).collect();
        if heights.len() != legs.slopes.len() + 1 || !heights.windows(2).all(|pair| pair[0] < pair[1]) {
            return None;
        }
        let rises = heights.windows(2).map(|pair| pair[1] - pair[0]);
        let below: f64 = rises.zip(&legs.slopes).map(|(rise, slope)| rise * slope).sum();
        let mut last = Knot::touch(at.u - below);
        curve.knots.push(last);
        for ((pair, slope), bend) in heights.windows(2).zip(&legs.slopes).zip(&legs.bends) {
            let [reduced_force, reduced_energy] = law.profile().reduced_sums(pair[1]);
            let p = if pair[1] == at.d { at.u } else { last.p + slope * (pair[1] - pair[0]) };
            last = last.extend(pair[1], p, *slope, slope + bend, reduced_force, reduced_energy);
            curve.knots.push(last);
        }
        Some(curve)
    }
}
