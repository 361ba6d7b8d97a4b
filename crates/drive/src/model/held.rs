//! Whether anything holds the free coordinates.

use super::{Body, Contact, Free, Link, Measure};
use crate::SceneError;
use crate::scene::Axis;

/// Refuses a free z or pitch that no contact, spring or actuator acts on: such a body falls or turns away for ever,
/// which nobody means. One that slides freely along x is a scene in its own right.
pub(super) fn check(
    bodies: &[Body],
    free: &[Free],
    contacts: &[Contact],
    links: &[Link],
) -> Result<(), SceneError> {
    for (i, coordinate) in free.iter().enumerate().filter(|(_, coordinate)| coordinate.axis != Axis::X) {
        let moves = |measure: &Measure| measure.free.iter().any(|(free, _)| *free == i);
        let contact = |c: &Contact| !c.inert && moves(&c.u) || c.coupling().is_some_and(moves);
        let link = |l: &Link| (l.stiffness > 0.0 || l.damping > 0.0) && moves(&l.elongation);
        if contacts.iter().any(contact) || links.iter().any(link) {
            continue;
        }
        let key = coordinate.axis.key();
        let help = match coordinate.axis {
            Axis::Pitch => {
                "give a contact, spring or actuator of this body a point \"at\" beside its reference point, or make \
                 pitch \"fixed\""
            }
            Axis::X | Axis::Z => {
                "make the \"normal\" of a contact of this body \"coupled\", add a spring with \"direction\": \"z\", or \
                 make z \"fixed\""
            }
        };
        let path = format!("bodies.{}.{key}", bodies[coordinate.body].name);
        return Err(SceneError::new(path, format!("nothing holds {key}, which is free")).help(help));
    }
    Ok(())
}
