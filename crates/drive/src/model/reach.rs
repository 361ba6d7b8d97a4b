//! How deep a coupled contact may be expected to go: its natural scale, and the span of a row of springs.

use super::contact::Surroundings;
use super::{Free, Measure, Stroke};
use crate::scene::{Axis, Normal, Scene, Side};
use stickslip_contact::Interface;

/// Indentation taken where nothing that is known at the start presses a contact, m.
const SHALLOW: f64 = 1e-9;
/// Halvings of a bracket of one power of two: all digits of a double but three.
const HALVINGS: u32 = 50;
/// Room left above what is expected: bodies share loads in ways that the estimate does not see.
// It sets natural scales: ten times as much makes tolerances mean less, and a rocking slider ends 5.6 u_c elsewhere at 1e-6
// instead of 0.06. With a tenth rows of springs are outgrown before the run, and the slider takes nearly six times the
// evaluations at 1e-9.
const MARGIN: f64 = 1.2;

/// Part of a profile's reach up to which a row is as wide as it need be.
const NEARLY: f64 = 0.9;

/// Largest indentation to be expected of one of `count` contacts, m.
///
/// Energy sets it: what moves at the start, ½mḋ², and the work of the loads on the way, F(g + d) with the gap g, are
/// stored as E\*N(d). m is the mass felt along d, F the largest force that a load, a preload or a stroke puts on it.
/// Followers press as deep as they go; where that is not at all, and nothing else moves, the contact is never pressed, and
/// what comes out is below zero. Bodies that start in equilibrium have neither motion nor a way to fall.
pub(super) fn deepest(law: &Interface, count: f64, d: &Measure, around: &Surroundings<'_>) -> f64 {
    let first = around.at_start(d);
    // 0 where only followers move it: then nothing has a mass to be stopped.
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
    // How deep followers alone press: their range counted from where they start.
    let driven = if d.driven.is_empty() { first } else { first + driven };
    let settled = settled(law, count, d, around);
    if d.free.is_empty() && driven < 0.0 && settled == 0.0 {
        return driven;
    }
    let deepest = MARGIN * dynamic.max(driven).max(first).max(settled);
    if deepest > 0.0 { deepest } else { SHALLOW }
}

/// How deep a row that is to be wide enough must reach for one of `count` contacts, m: at least `deepest`, and what all that its
/// pile has at the start could press into it alone.
///
/// E\*N(d) ≤ E\*N(d₀) + F(g + d - d₀) + T + V: d₀ its indentation at the start, F what pulls at all bodies of its pile, g the gaps of
/// all their contacts, T their energy of motion along z and in pitch against what carries them, V what their springs along z and
/// their other contacts have stored. Motion along x is left out: little of it is ever turned downwards. Bodies that start in
/// equilibrium have none of these.
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
    // Its own store is part of that of the pile.
    let reached = |d: f64| count * law.normal_energy(d) >= pile.energy + pile.force * (pile.gaps + d - first);
    let most = law.profile().reach().map_or(f64::INFINITY, |reach| NEARLY * reach);
    // Below where it starts nothing is asked.
    deepest.max((MARGIN * bracket(|d| d >= first && reached(d))).min(most))
}

/// What the bodies of a pile have at the start.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pile {
    /// Of motion along z and in pitch, of springs along z and of contacts, J.
    energy: f64,
    /// Gaps of its contacts, m.
    gaps: f64,
    /// Largest forces on its bodies along z, N.
    force: f64,
}

impl Pile {
    /// That of a coupled contact: its bodies, and those piled up with them. `pressed` are the coupled contacts of the scene, each
    /// with its law and its number.
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

/// Indentation at which one of `count` contacts alone carries all that pulls at balanced coordinates along its normal, m; 0
/// where none presses it.
fn settled(law: &Interface, count: f64, d: &Measure, around: &Surroundings<'_>) -> f64 {
    if !around.is_balanced(d) {
        return 0.0;
    }
    let along = around.signals.balanced.iter().filter(|b| b.axis == Axis::Z);
    let push: f64 = along.map(|b| b.own.widest(|w| around.signals.range(w))).sum();
    if push > 0.0 { law.indentation(push / count) } else { 0.0 }
}

/// Of each free coordinate along z those of all other bodies that coupled contacts join to its own, however many lie between.
/// Empty where no contact is coupled: only those ask.
pub(super) fn piled(scene: &Scene, free: &[Free]) -> Vec<Vec<usize>> {
    if scene.contacts.iter().all(|named| named.part.normal != Normal::Coupled) {
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

/// Largest force on a free coordinate, N or N m.
///
/// A bound, not a sum of what acts at once: magnitudes of gravity and constant loads, of the widest values of
/// those that vary, of preloads, and of springs at their widest stroke.
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

/// The indentation at which `reached` begins to hold, m; at most 1.2e18 m, so that a scene in which nothing holds ends, too.
///
/// Between neighbouring powers of two and then by halves: a scene in units that differ by a power of two has the same digits.
fn bracket(reached: impl Fn(f64) -> bool) -> f64 {
    // From far below any depth: beyond its reach a profile says nothing.
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
