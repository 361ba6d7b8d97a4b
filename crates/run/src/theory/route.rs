//! Load history as a path in the (d, u) plane. Displacements of corners with a given force are computed.

use super::TheoryError;
use super::history::{Corner, History, Normal, Tangential};
use stickslip_contact::{Apex, Curve, FirstLoadingError, Interface, Memory, NormalGiven, Segment};

/// Tolerance of a given force relative to the friction limit.
const ON_IT: f64 = 1e-15;

/// Returns the points of the load history in the (d, u) plane, beginning with the start.
pub(super) fn route(law: &Interface, pressed: f64, history: &History) -> Result<Vec<Apex>, TheoryError> {
    let corners = &history.corners;
    let depth = |k: usize, normal: Normal| {
        let given = match normal {
            Normal::Indentation(d) => NormalGiven::Indentation(d),
            Normal::Force(force) => NormalGiven::Force(force),
        };
        given.indentation(law).map_err(|error| refused(k + 1, error))
    };
    let mut at = Apex { d: pressed, u: 0.0 };
    let mut first = 0;
    if let Some(Corner { normal: Some(normal), tangential }) = corners.first() {
        at.d = depth(0, *normal)?;
        // A single corner, or a force other than 0, needs a section from the start.
        let begins = match *tangential {
            _ if corners.len() == 1 => None,
            Tangential::Displacement(u) => Some(u),
            Tangential::Force(force) => (force == 0.0).then_some(0.0),
        };
        if let Some(u) = begins {
            (at.u, first) = (u, 1);
        }
    }
    let mut memory = Memory::Curve(Curve::new(law, at));
    let mut route = vec![at];
    for (k, corner) in corners.iter().enumerate().skip(first) {
        let d = corner.normal.map_or(Ok(at.d), |normal| depth(k, normal))?;
        let u = match corner.tangential {
            Tangential::Displacement(u) => u,
            Tangential::Force(force) => {
                push(law, &memory, d, force).map_err(|error| refused(k + 1, error))?
            }
        };
        at = Apex { d, u };
        let done = memory.commit(law, Segment::Straight(at));
        done.map_err(|_| refused(k + 1, FirstLoadingError::Displacement(u)))?;
        route.push(at);
    }
    Ok(route)
}

/// Returns the displacement u, m, nearest to the current displacement, at which a straight path to (`d`, u) gives the force `force`, N.
fn push(law: &Interface, memory: &Memory, d: f64, force: f64) -> Result<f64, FirstLoadingError> {
    let from = memory.apex();
    let limit = law.friction() * law.normal_force(d);
    if force.is_nan() || force.abs() > limit {
        return Err(FirstLoadingError::TangentialForce { force, limit });
    }
    let reached = |u: f64| memory.force(law, Apex { d, u });
    let at_rest = reached(from.u);
    if at_rest == force {
        return Ok(from.u);
    }
    let sense = if force > at_rest { 1.0 } else { -1.0 };
    // A displacement by this distance leads to gross slip.
    let most = 2.0 * law.gross_slip_displacement(from.d.max(d));
    let is_there = |u: f64| sense * (reached(u) - force) >= -ON_IT * limit;
    let (mut near, mut far) = (from.u, from.u + sense * most);
    loop {
        let middle = 0.5 * (near + far);
        if middle == near || middle == far {
            return Ok(far);
        }
        if is_there(middle) { far = middle } else { near = middle }
    }
}

/// Returns the error for the corner with the number `corner`, from 1.
pub(super) fn refused(corner: usize, source: FirstLoadingError) -> TheoryError {
    TheoryError::Corner { corner, source }
}
