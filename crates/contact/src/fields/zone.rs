//! Rings of a contact that stick or slip.

use super::Fields;
use super::pieces::LAID_BY_SLIP;
use crate::ContactState;

/// State of the springs in a ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ZoneKind {
    /// The springs stick and have not slipped since they touched.
    Stick,
    /// The springs stick, with the stretch distribution of an earlier slip in this direction (+1 or -1).
    Frozen(i8),
    /// The springs slip in this direction (+1 or -1).
    Slip(i8),
}

/// Ring of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zone {
    /// Inner radius, m.
    pub from: f64,
    /// Outer radius, m.
    pub to: f64,
    /// State of the springs.
    pub kind: ZoneKind,
}

impl Fields<'_> {
    /// Returns the rings from the centre to the edge; empty for an open contact.
    ///
    /// At most the outermost ring slips, because the friction limit decreases with height.
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
