//! How many events a run may be expected to have: corners are counted, what contacts do is estimated.
//!
//! A contact reverses with the ringing of the modes that move it, for as long as damping lets them ring after each corner, and
//! with the turns of what drives it; bodies that fly land once per flight. Each kind brings a number of events of its own,
//! counted once on the examples. Meant to a factor of two there, and elsewhere as a guess: for the size of a table and the length
//! of a wait.

use super::Setup;
use crate::equations::Equations;
use crate::scene::{Contact, Freedom, Normal, Scene, Side, Varying};

use crate::{Linearised, NormalMode, Plan, Waveform};
use std::f64::consts::TAU;
use stickslip_stepper::System;

/// Events of a contact in a period of ringing: two reversals, and about one loop closes; where bodies press it by their
/// own motion it reverses, grows in full stick and slips again, and one loop closes.
const PER_RINGING: Pace = Pace { pressed: 3.0, coupled: 4.0 };
/// Events of a contact that a smooth waveform drives, or that is walked, in a period: two turns, and with each one the end
/// of gross slip or a loop that closes; where bodies press it by their own motion twice as much, growth or flight with it.
const PER_TURNS: Pace = Pace { pressed: 4.0, coupled: 8.0 };
/// Events of a contact from one landing to the next: it touches, slips, turns and leaves.
const PER_LANDING: f64 = 4.0;
/// Of a free body under a waveform with corners: gross slip begins and ends once, the rest is ringing.
const PER_FLYBACK: f64 = 2.0;
/// Time constants after which a damped ringing is over (5 %).
// Counted on a stage on its stack: 350 events, for 219 estimated; 0.3 would say 58, 30 would say 1 532.
const DECAY: f64 = 3.0;
/// Displacement of a contact in a mode, as a share of the mode's largest in m, below which the mode does not ring there.
const MOVED: f64 = 0.05;
/// Kinks that a block puts into a period of what it reads, at least: limits begin and end, hysteresis turns twice.
const KINKS: f64 = 2.0;
/// A ringing from the start below this share of u_c is none: an equilibrium is found to some last places.
const SEEN: f64 = 1e-6;
/// One above this share of it slips as a whole in no time, and is soon over.
const LOST: f64 = 0.5;
/// A corner this near to the end of a period, in periods, belongs to it.
const SAME: f64 = 1e-9;

/// Events that depend on what presses the contact.
struct Pace {
    /// A given force, indentation or radius.
    pressed: f64,
    /// The motion of its bodies.
    coupled: f64,
}

impl Pace {
    fn of(&self, normal: Normal) -> f64 {
        if normal == Normal::Coupled { self.coupled } else { self.pressed }
    }
}

/// Events of a whole run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedEvents {
    /// Corners of waveforms, counted.
    pub corners: f64,
    /// Events of contacts and blocks, estimated: within a factor of two on the examples, a guess elsewhere.
    pub contacts: f64,
}

impl ExpectedEvents {
    /// Those of a run along a plan.
    pub fn of(setup: Setup<'_>, plan: &Plan) -> Self {
        let Setup { scene, model, start } = setup;
        let linear = model.linearised(start, |d| d.most);
        // As deep as it gets: the stiffest ringing has the most events.
        let modes = linear.modes();
        let of = |c| of_contact(setup, c, plan.duration, (&linear, &modes));
        let contacts: f64 = (0..scene.contacts.len()).map(of).sum();
        let blocks: f64 = (0..scene.blocks.len()).map(|k| of_block(scene, k, plan.duration)).sum();
        // At fixed steps corners are crossed, not located.
        let located = model.effective(plan.stepper).locates_events();
        let corners = scene.waveforms.iter().map(|w| corners(&w.part, plan.duration));
        // The sum of nothing is -0.
        let corners = if located { corners.fold(0.0, |sum, corners| sum + corners) } else { 0.0 };
        Self { corners, contacts: contacts + blocks }
    }

    /// All events.
    pub fn total(&self) -> f64 {
        self.corners + self.contacts
    }
}

/// Periods that a waveform runs through until `duration`, s.
fn cycles(waveform: &Waveform, period: f64, duration: f64) -> f64 {
    let timing = waveform.timing();
    ((duration - timing.delay) / period).min(timing.cycles.unwrap_or(f64::INFINITY)).max(0.0)
}

/// Corners in a period, or until `end` for a waveform without period.
fn corners_until(waveform: &Waveform, start: f64, end: f64) -> f64 {
    let mut piece = waveform.piece_at(start);
    let mut corners = 0.0;
    while piece.end <= end {
        corners += 1.0;
        piece = waveform.after(&piece);
    }
    corners
}

/// Corners of one whole period from the delay on, that at its end included.
fn corners_per_period(waveform: &Waveform, period: f64) -> f64 {
    let start = waveform.timing().delay;
    corners_until(waveform, start, start + (1.0 + SAME) * period)
}

/// Corners until `duration`, s.
fn corners(waveform: &Waveform, duration: f64) -> f64 {
    match waveform.period() {
        Some(period) => cycles(waveform, period, duration) * corners_per_period(waveform, period),
        None => corners_until(waveform, 0.0, duration),
    }
}

/// Estimate for block `k`: two turns in each period of the waveform that it reads.
fn of_block(scene: &Scene, k: usize, duration: f64) -> f64 {
    let Some(block) = scene.blocks.get(k) else { return 0.0 };
    let waveform = scene.waveform_of(scene.waveforms.len() + k).and_then(|w| scene.waveforms.get(w));
    let turns = waveform.and_then(|it| Some(2.0 * cycles(&it.part, it.part.period()?, duration)));
    turns.unwrap_or(0.0) * f64::from(block.part.0.events_per_turn())
}

/// Whether a mode moves contact `c` along its slide. Angles do not compare with displacements.
fn rings_at(linear: &Linearised, mode: &NormalMode, c: usize) -> bool {
    let lengths = linear.coordinates().iter().zip(&mode.shape).filter(|(name, _)| !name.ends_with(".pitch"));
    let lengths = lengths.map(|(_, length)| length).chain(&mode.contacts);
    let largest = lengths.fold(0.0_f64, |most, length| most.max(length.abs()));
    mode.frequency > 0.0 && mode.contacts[c].abs() > MOVED * largest
}

/// Rate at which a contact's indentation starts to change, m/s, by the motion of its bodies.
fn closing(scene: &Scene, contact: &Contact) -> f64 {
    let rise = |i: usize| match contact.between[i] {
        Side::Body(body) => scene
            .bodies
            .get(body)
            .map_or(0.0, |body| body.part.z.velocity + contact.at[i].x * body.part.pitch.velocity),
        Side::Ground => 0.0,
    };
    rise(0) - rise(1)
}

/// Landings until `duration` (s) of a contact that starts apart by `height` (m) and closes at a `speed` (m/s): with nothing
/// lost it bounces as high as it falls, and without gravity it lands but once.
fn landings(scene: &Scene, (height, speed): (f64, f64), duration: f64) -> f64 {
    // Only what pulls along the normal brings it back.
    let (_, fall) = scene.gravity.components();
    match (height > 0.0, fall > 0.0) {
        (true, true) => duration * fall / (2.0 * (speed * speed + 2.0 * height * fall).sqrt()),
        (true, false) if speed * duration > height => 1.0,
        _ => 0.0,
    }
}

/// Whether a contact begins to ring in a mode at the start, by what is out of balance there: whether its ringing, of amplitude
/// a = [(u̇/ω)² + (ü/ω²)²]^½ with the rate and the second derivative that u begins with, turns u against what a stuck contact gives
/// way to a foot that moves by a sine, x̂(ω'/ω)² at ω'.
///
/// Of one that swings far below u_c friction takes little; one near to it is over before its dampers say so.
fn rings_from_start(Setup { scene, model, start }: Setup<'_>, c: usize, frequency: f64) -> bool {
    let (contact, layout) = (&model.contacts[c], model.layout());
    let eq = Equations::on(model, start, layout, false);
    let mut slopes = vec![0.0; layout.total()];
    eq.slopes(0.0, &start.y[..layout.dimension()], &mut slopes);
    let rate = eq.motion(contact, 0.0, |i| start.y[i]).du;
    let free: f64 = contact.u.free.iter().map(|(i, a)| a * slopes[layout.velocity(*i)]).sum();
    let driven: f64 = contact.u.driven.iter().map(|(w, a)| a * model.signals().first(*w).acceleration).sum();
    let amplitude = math::hypot(rate / frequency, (free + driven) / (frequency * frequency));
    let given = |w: usize| {
        let Some(waveform) = scene.waveforms.get(w).map(|named| &named.part) else { return 0.0 };
        let (low, high) = waveform.range();
        let turn = waveform.period().map_or(0.0, |period| TAU / period / frequency);
        0.5 * (high - low) * turn.powi(3)
    };
    let given: f64 = drivers(scene, c).into_iter().map(|(w, _)| given(w)).sum();
    amplitude > given && (SEEN..LOST).contains(&(amplitude / contact.natural.displacement))
}

/// Estimate for contact `c` over the whole run.
///
/// Turns by every waveform that reaches it, ringing by the one that keeps it up longest or by the start, and landings. 0 for
/// a contact without friction or never pressed.
fn of_contact(
    setup: Setup<'_>,
    c: usize,
    duration: f64,
    (linear, modes): (&Linearised, &[NormalMode]),
) -> f64 {
    let Setup { scene, model, start } = setup;
    let Some(contact) = scene.contacts.get(c).map(|contact| &contact.part) else { return 0.0 };
    let Some(d) = model.indentations(start, c) else { return 0.0 };
    // Never pressed, or nothing to remember: no event is its own.
    if d.most <= 0.0 || contact.interface.friction() == 0.0 {
        return 0.0;
    }
    let (per_ringing, per_turns) = (PER_RINGING.of(contact.normal), PER_TURNS.of(contact.normal));
    // The fastest mode that moves it: slower ones turn it less often.
    let ringing = modes.iter().rfind(|mode| rings_at(linear, mode, c));
    // Events of a ringing that corners keep up for at most `time`, s.
    let rings = |time: f64, corners: f64| {
        ringing.map_or(0.0, |mode| {
            // Without damping it is infinite, and the ringing lasts as long as the run.
            let decay = DECAY / (mode.damping_ratio * mode.frequency);
            per_ringing * mode.frequency / TAU * time.min(corners * decay)
        })
    };
    let (mut turns, mut most) = (0.0, 0.0_f64);
    for (w, is_kinked) in drivers(scene, c) {
        let waveform = &scene.waveforms[w].part;
        let kinks = if is_kinked { KINKS } else { 0.0 };
        let (events, ringing) = match waveform.period() {
            Some(period) => {
                let (cycles, corners) =
                    (cycles(waveform, period, duration), corners_per_period(waveform, period).max(kinks));
                // Corners make a free body ring; a smooth waveform, or a walk, makes turns only.
                let kicked = ringing.is_some() && corners > 0.0;
                let turns = if kicked { PER_FLYBACK } else { per_turns };
                (cycles * turns, if kicked { cycles * rings(period, corners) } else { 0.0 })
            }
            None => {
                let corners = corners(waveform, duration);
                (corners, rings(duration, corners))
            }
        };
        turns += events;
        // Several waveforms do not make a body ring faster.
        most = most.max(ringing);
    }
    // What corners keep up has begun anyway.
    let from_start = ringing.filter(|mode| rings_from_start(setup, c, mode.frequency));
    most = most.max(from_start.map_or(0.0, |_| rings(duration, 1.0)));
    turns + most + PER_LANDING * landings(scene, (-d.start, closing(scene, contact)), duration)
}

/// The waveforms whose motion reaches contact `c`: those that its sides follow and that press it, and all that act on
/// the free bodies that hang together with it.
///
/// Each with whether it comes through a block, whose laws put kinks into what is smooth.
fn drivers(scene: &Scene, c: usize) -> Vec<(usize, bool)> {
    let Some(contact) = scene.contacts.get(c) else { return Vec::new() };
    let edges = || {
        let contacts = scene.contacts.iter().map(|part| part.part.between);
        let springs = scene.springs.iter().map(|part| part.part.between);
        contacts.chain(springs).chain(scene.actuators.iter().map(|part| part.part.between))
    };
    let is_free = |side: &Side| match side {
        Side::Body(body) => {
            scene.bodies.get(*body).is_some_and(|body| body.part.is_free() || body.part.is_balanced())
        }
        Side::Ground => false,
    };
    let mut reached: Vec<Side> = contact.part.between.into_iter().filter(is_free).collect();
    let mut next = 0;
    // Bodies are joined by whatever acts between them; the ground joins nothing.
    while let Some(side) = reached.get(next).copied() {
        next += 1;
        for other in edges().filter(|edge| edge.contains(&side)).flatten().filter(is_free) {
            if !reached.contains(&other) {
                reached.push(other);
            }
        }
    }
    let hangs_on = |between: &[Side; 2]| between.iter().any(|side| reached.contains(side));
    let mut sides: Vec<Side> = edges().filter(hangs_on).flatten().collect();
    sides.extend(contact.part.between);
    let bodies = sides.into_iter().filter_map(|side| match side {
        Side::Body(body) => scene.bodies.get(body),
        Side::Ground => None,
    });
    let followed = bodies.flat_map(|body| body.part.coordinates()).filter_map(|(_, coordinate)| {
        match coordinate.freedom {
            Freedom::Follows(waveform) => Some(waveform),
            Freedom::Fixed | Freedom::Free | Freedom::Balanced => None,
        }
    });
    let pressing =
        scene.contacts.iter().enumerate().filter(|(i, part)| *i == c || hangs_on(&part.part.between));
    let pressing = pressing.map(|(_, part)| match part.part.normal {
        Normal::Force(value) | Normal::Indentation(value) | Normal::Radius(value) => value,
        Normal::Coupled => Varying::Constant(0.0),
    });
    let strokes =
        scene.actuators.iter().filter(|part| hangs_on(&part.part.between)).map(|part| part.part.stroke);
    let loads = scene.loads.iter().filter(|load| reached.contains(&Side::Body(load.on)));
    let loads = loads.flat_map(|load| [load.x, load.z, load.pitch]);
    let varying = pressing.chain(strokes).chain(loads).filter_map(|value| match value {
        Varying::Follows(waveform) => Some(waveform),
        Varying::Constant(_) => None,
    });
    let signals = followed.chain(varying);
    let is_block = |signal: usize| signal >= scene.waveforms.len();
    let mut waveforms: Vec<(usize, bool)> =
        signals.filter_map(|signal| Some((scene.waveform_of(signal)?, is_block(signal)))).collect();
    waveforms.sort_unstable();
    waveforms.dedup();
    waveforms
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Shape, Timing};

    #[test]
    fn corners_are_counted_within_the_time_they_run() {
        let saw = Shape::Sawtooth { stroke: 1.0, flyback: 0.1 };
        let timing = Timing { delay: 0.5, cycles: Some(3.0), ..Timing::every(1.0) };
        let waveform = Waveform::new(saw, timing).unwrap();
        assert_eq!([0.4, 2.5, 99.0].map(|end| corners(&waveform, end)), [0.0, 4.0, 6.0]);
        let table = Shape::Table { points: vec![(0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (3.0, 5.0)] };
        let waveform = Waveform::new(table, Timing::every(1.0)).unwrap();
        assert_eq!(corners(&waveform, 2.5), 2.0);
        let sine = Waveform::new(Shape::Sine { amplitude: 1.0, phase: 0.3, offset: 0.0 }, Timing::every(1.0))
            .unwrap();
        assert_eq!(corners(&sine, 10.0), 0.0);
    }
}
