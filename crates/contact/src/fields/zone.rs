//! The rings of a contact: what sticks, what slips, and where earlier slip is frozen in.

use super::Fields;
use super::pieces::LAID_BY_SLIP;
use crate::ContactState;

/// What the springs of a ring do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ZoneKind {
    /// They stick, and have since they touched.
    Stick,
    /// They stick as an earlier slip in this direction (+1 or -1) has left them: it is frozen in.
    Frozen(i8),
    /// They slip in this direction.
    Slip(i8),
}

/// A ring of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zone {
    /// Inner radius, m.
    pub from: f64,
    /// Outer radius, m.
    pub to: f64,
    /// What goes on there.
    pub kind: ZoneKind,
}

impl Fields<'_> {
    /// The rings from the centre to the edge; none while the contact is open. At most one of them slips, the outermost: limits
    /// fall with height, so that slip goes from the edge inwards whatever the history was.
    pub fn zones(&self) -> Vec<Zone> {
        let mut zones: Vec<Zone> = Vec::new();
        let slips = matches!(self.state, ContactState::Partial | ContactState::Slip);
        for piece in &self.pieces {
            let sense = if piece.slope < 0.0 { -1 } else { 1 };
            let at_limit = 1.0 - piece.share.abs() <= LAID_BY_SLIP && piece.slope != 0.0;
            let kind = match at_limit {
                true if slips && piece.to.x > self.stick_radius => ZoneKind::Slip(sense),
                true => ZoneKind::Frozen(sense),
                false => ZoneKind::Stick,
            };
            match zones.last_mut() {
                Some(last) if last.kind == kind => last.to = piece.to.x,
                _ if piece.to.x > piece.from.x => {
                    zones.push(Zone { from: piece.from.x, to: piece.to.x, kind });
                }
                _ => {}
            }
        }
        zones
    }
}
