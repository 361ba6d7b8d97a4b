//! Elimination of quasi-static coordinates without a contact.
//!
//! Springs connect quasi-static coordinates: K q = P - F with a symmetric K. Let s be the coordinates with contacts and l the others. Then
//! q_l = K_ll⁻¹(P_l - K_ls q_s), and the reduced stiffness is K_ss - K_sl K_ll⁻¹ K_ls. The reduced stiffness must be diagonal, as two
//! coupled coordinates with contacts are not supported.

use super::{Balanced, Pull, is_balanced, measure_of, split};
use crate::contact::Contact;
use crate::model::Link;
use crate::scene::Axis;
use crate::{Field, Part, SceneError, SceneFault};
use nalgebra::DMatrix;

/// Relative coupling stiffness that counts as rounding of the elimination.
const NONE: f64 = 1e-12;

/// Determines contacts, springs and reduced loads of each quasi-static coordinate. `first` is the signal index of the first coordinate.
///
/// Fails if no contact or spring holds a coordinate, or if two coordinates with contacts are coupled.
pub(in crate::model) fn assign(
    contacts: &[Contact],
    stiffness: &DMatrix<f64>,
    (first, all): (usize, &mut [Balanced]),
) -> Result<(), SceneError> {
    if all.is_empty() {
        return Ok(());
    }
    join(contacts, first, all)?;
    let (held, loose): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(|b| !all[*b].contacts.is_empty());
    let of = |rows: &[usize], columns: &[usize]| {
        DMatrix::from_fn(rows.len(), columns.len(), |i, j| stiffness[(rows[i], columns[j])])
    };
    let Some(inverse) = of(&loose, &loose).cholesky().map(|it| it.inverse()) else {
        // A coordinate without a spring, or the first of a chain without a fixed end.
        let free = loose.iter().find(|b| stiffness[(**b, **b)] == 0.0).or(loose.first()).unwrap_or(&0);
        let (part, axis) = (Part::Body(all[*free].body), all[*free].axis);
        return Err(SceneFault::Unbalanceable(axis).of(part, Field::Coordinate(axis)));
    };
    let handed = -(&inverse * of(&loose, &held));
    let left = of(&held, &held) + of(&held, &loose) * &handed;
    for i in 0..held.len() {
        for j in 0..i {
            let own = (stiffness[(held[i], held[i])] * stiffness[(held[j], held[j])]).sqrt();
            if left[(i, j)].abs() > NONE * own {
                let (body, axis) = (all[held[i]].body, all[held[i]].axis);
                return Err(SceneFault::BalancedTogether.of(Part::Body(body), Field::Coordinate(axis)));
            }
        }
    }
    let own: Vec<Pull> = all.iter().map(|b| b.own.clone()).collect();
    for (i, b) in held.iter().enumerate() {
        let mut pull = own[*b].clone();
        loose.iter().enumerate().for_each(|(l, other)| pull.add(&own[*other], handed[(l, i)]));
        (all[*b].stiffness, all[*b].pull) = (rounded(left[(i, i)], stiffness[(*b, *b)]), pull);
    }
    let mut slots = 0..;
    for b in &held {
        let may_grow = |(c, _): &(usize, f64)| contacts[*c].slot.is_some();
        if all[*b].axis == Axis::X && all[*b].contacts.iter().any(may_grow) {
            all[*b].slot = slots.next();
        }
    }
    for (l, b) in loose.iter().enumerate() {
        let mut pull = Pull::default();
        loose.iter().enumerate().for_each(|(m, other)| pull.add(&own[*other], inverse[(l, m)]));
        let led = held.iter().enumerate().map(|(i, b)| (*b, handed[(l, i)]));
        let led = led.filter(|(_, a)| *a != 0.0).collect();
        (all[*b].stiffness, all[*b].pull, all[*b].led) = (1.0, pull, led);
    }
    Ok(())
}

/// Assigns contacts to quasi-static coordinates. Fails for a contact between two quasi-static bodies.
fn join(contacts: &[Contact], first: usize, all: &mut [Balanced]) -> Result<(), SceneError> {
    for (c, contact) in contacts.iter().enumerate() {
        for axis in [Axis::X, Axis::Z] {
            let Some(measure) = measure_of(contact, axis) else { continue };
            let (own, _) = split(measure, first);
            match own[..] {
                [] => {}
                [(b, a)] => all[b].contacts.push((c, a)),
                _ => return Err(SceneFault::BalancedTogether.of(Part::Contact(c), Field::Between)),
            }
        }
    }
    Ok(())
}

/// Returns the stiffness after elimination, or 0 if the value is rounding.
// Otherwise rounding would act as a weak spring beyond the friction limit of a contact.
fn rounded(left: f64, whole: f64) -> f64 {
    if left > NONE * whole { left } else { 0.0 }
}

/// Returns the stiffness matrix of quasi-static coordinates, N/m, and adds the remaining forces of springs to the loads.
pub(in crate::model) fn springs(links: &[Link], (first, all): (usize, &mut [Balanced])) -> DMatrix<f64> {
    let mut stiffness = DMatrix::zeros(all.len(), all.len());
    for link in links.iter().filter(|link| is_balanced(&link.elongation, first)) {
        let (own, rest) = split(&link.elongation, first);
        for (b, a) in &own {
            for (other, with) in &own {
                stiffness[(*b, *other)] += link.stiffness * a * with;
            }
            // Force k(s - e) + preload with the rest of e.
            let end = Link { elongation: rest.clone(), ..link.clone() };
            all[*b].own.links.push((end, *a));
        }
    }
    stiffness
}
