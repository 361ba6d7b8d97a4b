//! Check that a contact or spring holds each free coordinate along z and in pitch.

use super::{Free, Link, Measure};
use crate::contact::Contact;
use crate::scene::Axis;
use crate::{Field, Part, SceneError, SceneFault};

/// Returns an error for a free z or pitch without contact, spring or actuator. A body that slides freely along x is allowed.
///
/// A frictionless contact acts along d only; a spring without stiffness and damping does not act.
pub(super) fn check(free: &[Free], contacts: &[Contact], links: &[Link]) -> Result<(), SceneError> {
    for (i, coordinate) in free.iter().enumerate().filter(|(_, coordinate)| coordinate.axis != Axis::X) {
        let moves = |measure: &Measure| measure.free.iter().any(|(free, _)| *free == i);
        let contact = |c: &Contact| !c.inert && moves(&c.u) || c.coupling().is_some_and(moves);
        let link = |l: &Link| (l.stiffness > 0.0 || l.damping > 0.0) && moves(&l.elongation);
        if contacts.iter().any(contact) || links.iter().any(link) {
            continue;
        }
        let (part, axis) = (Part::Body(coordinate.body), coordinate.axis);
        return Err(SceneFault::Unheld(axis).of(part, Field::Coordinate(axis)));
    }
    Ok(())
}
