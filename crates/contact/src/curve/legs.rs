//! Memory curve in a form that does not depend on the displacement: breakpoint heights and slopes.
//!
//! After gross slip this form has a single piece of slope ±κ.

use super::Curve;
use super::knot::Knot;
use super::stack::SlopeRange;
use crate::breaking::Rest;
use crate::{Apex, Interface};

/// Relative tolerance at which a slope counts as ±κ, so that the piece was made by slip.
const EDGE: f64 = 1e-9;

/// Form of a memory curve: breakpoint heights and slopes of its pieces.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Legs {
    /// Heights of the breakpoints between centre and apex, m, ascending.
    pub heights: Vec<f64>,
    /// Slopes dp/dh of all pieces from the centre outwards, one more than heights; empty for an open contact.
    pub slopes: Vec<f64>,
    /// Gain minus slope of each piece, where the gain is the force per ΔM over G\*; not 0 only for curved growth paths.
    pub bends: Vec<f64>,
}

impl Legs {
    /// Returns the slip direction ±1 of a piece made by slip, and `None` for a piece that grew in full stick.
    pub fn sense(&self, law: &Interface, piece: usize) -> Option<f64> {
        sense(*self.slopes.get(piece)?, law)
    }
}

/// Returns the slip direction that belongs to a slope, or `None` for a slope below κ.
fn sense(slope: f64, law: &Interface) -> Option<f64> {
    (slope.abs() >= law.stick_slope() * (1.0 - EDGE)).then(|| slope.signum())
}

impl Curve {
    /// Returns slope and slip direction (see [`Legs::sense`]) of the last piece; `None` for an open contact.
    pub fn last_piece(&self, law: &Interface) -> Option<(f64, Option<f64>)> {
        let [.., _, last] = self.knots.as_slice() else { return None };
        Some((last.slope, sense(last.slope, law)))
    }

    /// Returns the form of the curve.
    pub fn legs(&self) -> Legs {
        let Some(pieces) = self.knots.get(1..) else { return Legs::default() };
        Legs {
            heights: pieces.iter().rev().skip(1).rev().map(|knot| knot.h).collect(),
            slopes: pieces.iter().map(|knot| knot.slope).collect(),
            bends: pieces.iter().map(|knot| knot.gain - knot.slope).collect(),
        }
    }

    /// Creates the curve of a given form that ends at an apex. Returns `None` if the heights do not ascend from 0 to d.
    #[must_use]
    pub fn standing(&self, law: &Interface, at: Apex, legs: &Legs) -> Option<Self> {
        let mut curve =
            Self { knots: Vec::new(), apex: at, range: SlopeRange::NONE, rest: Rest::NONE, ..*self };
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
