//! Largest expected indentation of a coupled contact, for natural scales and rows of springs.

use super::contact::Surroundings;
use super::{Free, Measure, Stroke};
use crate::scene::{Axis, Normal, Scene, Side};
use stickslip_contact::Interface;

/// Assumed indentation of a contact that no initial load presses, m.
const SHALLOW: f64 = 1e-9;
/// Number of bisection steps between two powers of two.
const HALVINGS: u32 = 50;
/// Safety factor of the expected indentation.
// A larger factor reduces accuracy through the tolerances, a smaller factor may make rows of springs too narrow.
const MARGIN: f64 = 1.2;

/// Fraction of a profile's extent that limits the width of a row of springs.
const NEARLY: f64 = 0.9;

/// Returns the largest expected indentation of one of `count` contacts, m.
///
/// The indentation d follows from an energy balance: kinetic energy ½mḋ² plus work F(g + d) of loads equals E\*N(d). g is the gap, m the
/// effective mass along d, and F the largest force of loads, preloads and strokes. The range of prescribed motions is added. The result is
/// negative if the contact is never pressed. Bodies in equilibrium have neither motion nor height of fall.
pub(super) fn deepest(law: &Interface, count: f64, d: &Measure, around: &Surroundings<'_>) -> f64 {
    let first = around.at_start(d);
    // 0 if only prescribed motions move it.
    let mobility = d.mobility(|i| around.free[i].mobility);
    let rate: f64 = d.free.iter().map(|(i, a)| a * around.free[*i].start.1).sum::<f64>()
        + d.driven.iter().map(|(w, a)| a * around.signals.first(*w).rate).sum::<f64>();
    let falls = !around.equilibrium;
    let kinetic = if falls && mobility > 0.0 { 0.5 * rate * rate / mobility } else { 0.0 };
    let gap = if falls { (-first).max(0.0) } else { 0.0 };
    let pile = |i: usize| around.piled[i].iter().map(|other| pressing(*other, around)).sum::<f64>();
    let force = d.free.iter().map(|(i, a)| (pressing(*i, around) + pile(*i)) / a.abs()).fold(0.0, f64::max);
    let reached = |d: f64| count * law.normal_energy(d) >= kinetic + force * (gap + d);
    let dynamic = if kinetic + force > 0.0 { bracket(reached) } else { 0.0 };
    let span = |w: usize| around.signals.range(w);
    let driven: f64 = d
        .driven
        .iter()
        .map(|(w, a)| (a * span(*w).0).max(a * span(*w).1) - a * around.signals.first(*w).value)
        .sum();
    // Largest indentation by prescribed motions alone.
    let driven = if d.driven.is_empty() { first } else { first + driven };
    let settled = settled(law, count, d, around);
    if d.free.is_empty() && driven < 0.0 && settled == 0.0 {
        return driven;
    }
    let deepest = MARGIN * dynamic.max(driven).max(first).max(settled);
    if deepest > 0.0 { deepest } else { SHALLOW }
}

/// Returns the indentation that a row of springs must allow for one of `count` contacts, m. The result is at least `deepest`, and covers
/// all energy of the connected bodies.
///
/// The bound is E\*N(d) ≤ E\*N(d₀) + F(g + d - d₀) + T + V with the initial indentation d₀. F are the forces on all connected bodies, g the
/// gaps of their contacts. T is the kinetic energy along z and in pitch, V the energy of springs along z and of other contacts. Motion
/// along x is neglected. Bodies in equilibrium have none of these energies.
pub(super) fn widest(
    (law, count): (&Interface, f64),
    d: &Measure,
    deepest: f64,
    (pile, around): (&Pile, &Surroundings<'_>),
) -> f64 {
    if around.equilibrium || d.free.is_empty() || deepest <= 0.0 {
        return deepest;
    }
    let first = around.at_start(d).max(0.0);
    // Its own energy is part of the total.
    let reached = |d: f64| count * law.normal_energy(d) >= pile.energy + pile.force * (pile.gaps + d - first);
    let most = law.profile().reach().map_or(f64::INFINITY, |reach| NEARLY * reach);
    // At least the initial indentation.
    deepest.max((MARGIN * bracket(|d| d >= first && reached(d))).min(most))
}

/// Initial energies and forces of bodies that contacts connect along z.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pile {
    /// Kinetic energy along z and in pitch, energy of springs along z and of contacts, J.
    energy: f64,
    /// Sum of the gaps of the bodies' contacts, m.
    gaps: f64,
    /// Sum of the largest forces on the bodies along z, N.
    force: f64,
}

impl Pile {
    /// Returns energies, gaps and forces for the bodies of a coupled contact and all bodies connected with them. `pressed` are the coupled
    /// contacts of the model.
    pub(super) fn of<'c>(
        d: &Measure,
        pressed: impl Iterator<Item = (&'c Interface, f64, Measure)>,
        around: &Surroundings<'_>,
    ) -> Self {
        let own = d.free.iter().map(|(i, _)| *i);
        let bodies: Vec<usize> = own
            .flat_map(|i| std::iter::once(i).chain(around.piled[i].iter().copied()))
            .map(|i| around.free[i].body)
            .collect();
        let is_member = |i: usize| around.free[i].axis != Axis::X && bodies.contains(&around.free[i].body);
        let mut pile = Self::default();
        let mut carried = 0.0_f64;
        for (law, count, d) in pressed.filter(|(_, _, d)| d.free.iter().any(|(i, _)| is_member(*i))) {
            let first = around.at_start(&d);
            pile.energy += count * law.normal_energy(first.max(0.0));
            pile.gaps += (-first).max(0.0);
            let rate: f64 = d.driven.iter().map(|(w, a)| a * around.signals.first(*w).rate).sum();
            carried = carried.max(rate.abs());
        }
        for (i, free) in around.free.iter().enumerate().filter(|(i, _)| is_member(*i)) {
            let carried = if free.axis == Axis::Z { carried } else { 0.0 };
            pile.energy += 0.5 * free.mass * (free.start.1.abs() + carried).powi(2);
            pile.force += if free.axis == Axis::Z { pressing(i, around) } else { 0.0 };
        }
        for link in around.links.iter().filter(|link| link.elongation.free.iter().any(|(i, _)| is_member(*i)))
        {
            let stroke = match link.stroke {
                Stroke::Constant(s) => s,
                Stroke::Driven(w) => around.signals.first(w).value,
            };
            pile.energy += 0.5 * link.stiffness * (stroke - around.at_start(&link.elongation)).powi(2);
        }
        pile
    }
}

/// Returns the indentation at which one of `count` contacts alone carries all loads of quasi-static coordinates along z, m; 0 if no load
/// presses the contact.
fn settled(law: &Interface, count: f64, d: &Measure, around: &Surroundings<'_>) -> f64 {
    if !around.is_balanced(d) {
        return 0.0;
    }
    let along = around.signals.balanced.iter().filter(|b| b.axis == Axis::Z);
    let push: f64 = along.map(|b| b.own.widest(|w| around.signals.range(w))).sum();
    if push > 0.0 { law.indentation(push / count) } else { 0.0 }
}

/// Returns, for each free coordinate, the z coordinates of other bodies that coupled contacts connect with its body; empty without coupled
/// contacts.
pub(super) fn piled(scene: &Scene, free: &[Free]) -> Vec<Vec<usize>> {
    if scene.contacts.iter().all(|named| named.part.normal != Normal::Coupled) && scene.stops.is_empty() {
        return Vec::new();
    }
    let mut pile: Vec<usize> = (0..scene.bodies.len()).collect();
    let joined = scene.contacts.iter().filter(|named| named.part.normal == Normal::Coupled);
    for between in joined.map(|named| named.part.between) {
        if let [Side::Body(a), Side::Body(b)] = between
            && a < pile.len()
            && b < pile.len()
            && [a, b].iter().all(|body| free.iter().any(|f| f.body == *body && f.axis == Axis::Z))
        {
            let (from, to) = (pile[a], pile[b]);
            pile.iter_mut().filter(|own| **own == from).for_each(|own| *own = to);
        }
    }
    let mut members = vec![Vec::new(); pile.len()];
    for (i, own) in free.iter().enumerate().filter(|(_, own)| own.axis == Axis::Z) {
        members[pile[own.body]].push(i);
    }
    let others = |own: &Free| -> Vec<usize> {
        let members = if own.axis == Axis::Z { &members[pile[own.body]][..] } else { &[] };
        members.iter().copied().filter(|i| free[*i].body != own.body).collect()
    };
    free.iter().map(others).collect()
}

/// Returns the largest force on a free coordinate, N or N m.
///
/// The force is an upper bound: the sum of magnitudes of gravity, constant loads, extreme values of varying loads, preloads, and springs at
/// their largest stroke.
pub(super) fn pressing(i: usize, around: &Surroundings<'_>) -> f64 {
    let widest = |w: usize| {
        let (low, high) = around.signals.range(w);
        low.abs().max(high.abs())
    };
    let loads: f64 =
        around.loads.iter().filter(|l| l.free == i).map(|l| (l.arm * widest(l.waveform)).abs()).sum();
    let links = around.links.iter().map(|link| {
        let arm = link.elongation.free.iter().find(|(free, _)| *free == i).map_or(0.0, |(_, a)| a.abs());
        let stroke = match link.stroke {
            Stroke::Constant(s) => s.abs(),
            Stroke::Driven(w) => widest(w),
        };
        let driven: f64 = link.elongation.driven.iter().map(|(w, a)| (a * widest(*w)).abs()).sum();
        arm * (link.preload.abs() + link.stiffness * (stroke + driven))
    });
    around.free[i].force.abs() + loads + links.sum::<f64>()
}

/// Returns the smallest indentation for which `reached` holds, m; at most 1.2e18 m.
///
/// The search tries powers of two, then bisects, so that models in units that differ by a power of two give the same digits.
fn bracket(reached: impl Fn(f64) -> bool) -> f64 {
    // Starts well below any depth, as a profile is undefined beyond its extent.
    let mut high = 2.0_f64.powi(-60);
    while !reached(high) && high < 1e18 {
        high *= 2.0;
    }
    while reached(0.5 * high) && high > f64::MIN_POSITIVE {
        high *= 0.5;
    }
    let mut low = 0.5 * high;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if reached(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}
