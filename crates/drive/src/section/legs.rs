//! Memory coordinates of a contact.

use super::Unknown;
use crate::contact::Contact;
use stickslip_contact::{Apex, Legs, Memory, Segment};

/// Returns the coordinates of a slip memory: heights of its breakpoints, and slopes of pieces formed in full stick.
pub(super) fn unknowns(contact: &Contact, c: usize, legs: &Legs) -> Vec<Unknown> {
    let heights = (0..legs.heights.len()).map(|k| Unknown::Height(c, k));
    let grown = (0..legs.slopes.len()).filter(|k| legs.sense(&contact.interface, *k).is_none());
    heights.chain(grown.map(|k| Unknown::Slope(c, k))).collect()
}

/// Relative distance of a breakpoint from the centre or the contact edge below which it may result from rounding.
const ROUNDING: f64 = 1e-6;

/// Whether a slip memory has a breakpoint that cannot result from rounding.
pub(super) fn holds(legs: &Legs, d: f64) -> bool {
    legs.heights.iter().any(|height| height.min(d - height) > ROUNDING * d)
}

/// Returns the difference of two slip memories in one coordinate. None if their numbers of pieces or senses of slip differ.
pub(super) fn difference(unknown: Unknown, of: [&Memory; 2], contact: &Contact) -> Option<f64> {
    let [Memory::Curve(one), Memory::Curve(other)] = of else { return None };
    let (one, other) = (one.legs(), other.legs());
    let law = &contact.interface;
    let alike = one.slopes.len() == other.slopes.len()
        && (0..one.slopes.len()).all(|k| one.sense(law, k) == other.sense(law, k));
    match unknown {
        _ if !alike => None,
        Unknown::Height(_, k) => Some(one.heights.get(k)? - other.heights.get(k)?),
        Unknown::Slope(_, k) => Some(one.slopes.get(k)? - other.slopes.get(k)?),
        Unknown::Place(_) | Unknown::Speed(_) | Unknown::Own(_) => None,
    }
}

/// Returns the slip memory of a contact after a displacement `gone` of (d, u), m, with coordinates changed by `numbers`. The memory shifts
/// with u; a row of springs follows d on a straight path.
pub(super) fn moved(
    contact: &Contact,
    memory: &Memory,
    gone: (f64, f64),
    numbers: impl Iterator<Item = (Unknown, f64)>,
) -> Option<Memory> {
    let to = Apex { d: memory.apex().d + gone.0, u: memory.apex().u + gone.1 };
    if let Memory::Curve(curve) = memory
        && !contact.balanced
    {
        let mut legs = curve.legs();
        reform(&mut legs, contact, numbers)?;
        return curve.standing(&contact.interface, to, &legs).map(Memory::Curve);
    }
    follow(memory, (contact, to), gone)
}

/// Returns the slip memory of a contact for another model, displaced by `gone` in (d, u), m, with coordinates changed by `numbers`. Pieces
/// formed by slip get the slope of the other material pair.
pub(super) fn take_over(
    (contact, from): (&Contact, &Contact),
    memory: &Memory,
    gone: (f64, f64),
    numbers: impl Iterator<Item = (Unknown, f64)>,
) -> Option<Memory> {
    let to = Apex { d: memory.apex().d + gone.0, u: memory.apex().u + gone.1 };
    if contact.inert {
        // An inert contact has no force and needs no memory.
        return Some(contact.engine.memory(&contact.interface, to));
    }
    let Memory::Curve(curve) = memory else { return follow(memory, (contact, to), gone) };
    if contact.balanced {
        return follow(memory, (contact, to), gone);
    }
    let Memory::Curve(fresh) = contact.engine.memory(&contact.interface, to) else { return None };
    let mut legs = curve.legs();
    for piece in 0..legs.slopes.len() {
        if let Some(sense) = legs.sense(&from.interface, piece) {
            legs.slopes[piece] = sense * contact.interface.stick_slope();
        }
    }
    reform(&mut legs, contact, numbers)?;
    fresh.standing(&contact.interface, to, &legs).map(Memory::Curve)
}

/// Adds the given amounts to the coordinates of a contact's slip memory.
fn reform(legs: &mut Legs, contact: &Contact, numbers: impl Iterator<Item = (Unknown, f64)>) -> Option<()> {
    for (unknown, by) in numbers {
        match unknown {
            Unknown::Height(c, k) if c == contact.place => *legs.heights.get_mut(k)? += by,
            Unknown::Slope(c, k) if c == contact.place => *legs.slopes.get_mut(k)? += by,
            _ => {}
        }
    }
    Some(())
}

/// Returns a slip memory shifted with u and, if d changes, moved on a straight path to the point `to`.
fn follow(memory: &Memory, (contact, to): (&Contact, Apex), gone: (f64, f64)) -> Option<Memory> {
    let mut memory = memory.clone();
    memory.shift(gone.1);
    if gone.0 != 0.0 {
        memory.commit(&contact.interface, Segment::Straight(to)).ok()?;
    }
    Some(memory)
}
