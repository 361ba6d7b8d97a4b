//! Expected number of events of a run: corners are counted, events of contacts are estimated.
//!
//! A contact slips back and forth with the free oscillations of its normal modes, which decay after each corner, and with its drive. Bodies
//! in flight land once per flight. The numbers of events per oscillation were counted on the examples. The estimates are within a factor of
//! two there, and otherwise rough. The results serve to predict the size of a table and the run time.

use super::Setup;
use crate::equations::Equations;
use crate::scene::{Contact, Freedom, Normal, Scene, Side, Varying};

use crate::{Linearised, NormalMode, Plan, Waveform};
use std::f64::consts::TAU;
use stickslip_stepper::System;

/// Events of a contact per period of a free oscillation: two reversals and about one closed hysteresis loop. If moving bodies press the
/// contact, full stick and renewed slip are added.
const PER_RINGING: Pace = Pace { pressed: 3.0, coupled: 4.0 };
/// Events of a contact per period of a smooth drive: two reversals, each with an end of gross slip or a closed loop. If moving bodies press
/// the contact, growth of the contact or flight doubles the number.
const PER_TURNS: Pace = Pace { pressed: 4.0, coupled: 8.0 };
/// Events of a contact per landing: touch, slip, reversal, lift-off.
const PER_LANDING: f64 = 4.0;
/// Events of a contact without friction per landing: touch and lift-off.
const PER_SMOOTH_LANDING: f64 = 2.0;
/// Events of a free body per corner of a waveform, without oscillations: beginning and end of gross slip.
const PER_FLYBACK: f64 = 2.0;
/// Number of time constants until a damped oscillation has decayed to 5 %.
const DECAY: f64 = 3.0;
/// Relative displacement of a contact in a normal mode below which this mode causes no events in the contact.
const MOVED: f64 = 0.05;
/// Smallest number of kinks that a block adds per period of its input signal, by limits or hysteresis.
const KINKS: f64 = 2.0;
/// Amplitude relative to u_c below which no oscillation begins at the start; equilibria are accurate to rounding only.
const SEEN: f64 = 1e-6;
/// Amplitude relative to u_c above which an initial oscillation is short, because friction in gross slip damps it.
const LOST: f64 = 0.5;
/// Distance at which a corner counts as the end of a period, in periods.
const SAME: f64 = 1e-9;

/// Number of events by the type of normal load.
struct Pace {
    /// Number for a prescribed normal force, indentation or contact radius.
    pressed: f64,
    /// Number for a normal load by the motion of bodies.
    coupled: f64,
}

impl Pace {
    fn of(&self, normal: Normal) -> f64 {
        if normal == Normal::Coupled { self.coupled } else { self.pressed }
    }
}

/// Expected number of events of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedEvents {
    /// Exact number of corners of waveforms.
    pub corners: f64,
    /// Estimated number of events of contacts and blocks, within a factor of two on the examples.
    pub contacts: f64,
}

impl ExpectedEvents {
    /// Returns the expected numbers of events for a [`Plan`].
    pub fn of(setup: Setup<'_>, plan: &Plan) -> Self {
        let Setup { scene, model, start } = setup;
        let linear = model.linearised(start, |d| d.most);
        // The deepest indentation has the fastest oscillation and the most events.
        let modes = linear.modes();
        let of = |c| of_contact(setup, c, plan.duration, (&linear, &modes));
        let contacts: f64 = (0..scene.contacts.len()).map(of).sum();
        let blocks: f64 = (0..scene.blocks.len()).map(|k| of_block(scene, k, plan.duration)).sum();
        // Fixed steps do not locate corners.
        let located = model.effective(plan.stepper).locates_events();
        let corners = scene.waveforms.iter().map(|w| corners(&w.part, plan.duration));
        // An empty sum would be -0.
        let corners = if located { corners.fold(0.0, |sum, corners| sum + corners) } else { 0.0 };
        Self { corners, contacts: contacts + blocks }
    }

    /// Returns the expected number of all events.
    pub fn total(&self) -> f64 {
        self.corners + self.contacts
    }
}

/// Returns the number of periods of a waveform until the time `duration`, s.
fn cycles(waveform: &Waveform, period: f64, duration: f64) -> f64 {
    let timing = waveform.timing();
    ((duration - timing.delay) / period).min(timing.cycles.unwrap_or(f64::INFINITY)).max(0.0)
}

/// Returns the number of corners of a waveform between two times, s.
fn corners_until(waveform: &Waveform, start: f64, end: f64) -> f64 {
    let mut piece = waveform.piece_at(start);
    let mut corners = 0.0;
    while piece.end <= end {
        corners += 1.0;
        piece = waveform.after(&piece);
    }
    corners
}

/// Returns the number of corners of a waveform in one period after the delay, including a corner at the end of the period.
fn corners_per_period(waveform: &Waveform, period: f64) -> f64 {
    let start = waveform.timing().delay;
    corners_until(waveform, start, start + (1.0 + SAME) * period)
}

/// Returns the number of corners of a waveform until the time `duration`, s.
fn corners(waveform: &Waveform, duration: f64) -> f64 {
    match waveform.period() {
        Some(period) => cycles(waveform, period, duration) * corners_per_period(waveform, period),
        None => corners_until(waveform, 0.0, duration),
    }
}

/// Returns the estimated number of events of block `k`: two reversals per period of its waveform, times the block's events per reversal.
fn of_block(scene: &Scene, k: usize, duration: f64) -> f64 {
    let Some(block) = scene.blocks.get(k) else { return 0.0 };
    let waveform = scene.waveform_of(scene.waveforms.len() + k).and_then(|w| scene.waveforms.get(w));
    let turns = waveform.and_then(|it| Some(2.0 * cycles(&it.part, it.part.period()?, duration)));
    turns.unwrap_or(0.0) * f64::from(block.part.0.events_per_turn())
}

/// Returns whether a normal mode moves contact `c` along the slide. Angles are not compared with displacements.
fn rings_at(linear: &Linearised, mode: &NormalMode, c: usize) -> bool {
    let lengths = linear.coordinates().iter().zip(&mode.shape).filter(|(name, _)| !name.ends_with(".pitch"));
    let lengths = lengths.map(|(_, length)| length).chain(&mode.contacts);
    let largest = lengths.fold(0.0_f64, |most, length| most.max(length.abs()));
    mode.frequency > 0.0 && mode.contacts[c].abs() > MOVED * largest
}

/// Returns the initial rate of a contact's indentation from the motion of its bodies, m/s.
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

/// Returns the number of landings until `duration` (s) for a contact with initial gap `height` (m) and closing `speed` (m/s). Impacts are
/// assumed elastic; without gravity there is at most one landing.
fn landings(scene: &Scene, (height, speed): (f64, f64), duration: f64) -> f64 {
    // Only gravity along the normal returns the body.
    let (_, fall) = scene.gravity.components();
    match (height > 0.0, fall > 0.0) {
        (true, true) => duration * fall / (2.0 * (speed * speed + 2.0 * height * fall).sqrt()),
        (true, false) if speed * duration > height => 1.0,
        _ => 0.0,
    }
}

/// Returns whether an initial imbalance excites a normal mode at a contact. The amplitude a = [(u̇/ω)² + (ü/ω²)²]^½ must exceed the
/// response x̂(ω'/ω)² to a sinusoidal motion of the driving body with amplitude x̂ and frequency ω'.
///
/// Very small oscillations do not count. Oscillations with amplitudes near u_c do not count either, because friction soon ends them.
fn rings_from_start(Setup { scene, model, start }: Setup<'_>, c: usize, frequency: f64) -> bool {
    let (contact, layout) = (&model.contacts[c], model.layout());
    let eq = Equations::on(model, start, layout);
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

/// Returns the estimated number of events of contact `c` in the run: reversals by waveforms, the longest free oscillation, and landings.
/// The number is 0 for a contact that is never pressed.
fn of_contact(
    setup: Setup<'_>,
    c: usize,
    duration: f64,
    (linear, modes): (&Linearised, &[NormalMode]),
) -> f64 {
    let Setup { scene, model, start } = setup;
    let Some(contact) = scene.contacts.get(c).map(|contact| &contact.part) else { return 0.0 };
    let Some(d) = model.indentations(start, c) else { return 0.0 };
    // Without load the contact has no events of its own, and without friction only those of its landings.
    if d.most <= 0.0 {
        return 0.0;
    }
    let landings = landings(scene, (-d.start, closing(scene, contact)), duration);
    if contact.interface.friction() == 0.0 {
        return PER_SMOOTH_LANDING * landings;
    }
    let (per_ringing, per_turns) = (PER_RINGING.of(contact.normal), PER_TURNS.of(contact.normal));
    // The fastest mode that moves it causes the most reversals.
    let ringing = modes.iter().rfind(|mode| rings_at(linear, mode, c));
    // Events of an oscillation that corners excite for at most `time`, s.
    let rings = |time: f64, corners: f64| {
        ringing.map_or(0.0, |mode| {
            // Without damping the decay time is infinite, and the oscillation lasts for the run.
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
                // Corners excite free oscillations; smooth waveforms and prescribed paths cause reversals only.
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
        // Several waveforms do not increase the frequency.
        most = most.max(ringing);
    }
    // Oscillations that corners excite are counted already.
    let from_start = ringing.filter(|mode| rings_from_start(setup, c, mode.frequency));
    most = most.max(from_start.map_or(0.0, |_| rings(duration, 1.0)));
    turns + most + PER_LANDING * landings
}

/// Returns the waveforms that move or load contact `c`, directly or through free bodies connected with it. The flag of a waveform is set if
/// a block with its kinks is in between.
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
    // Contacts, springs and actuators connect bodies; the ground does not.
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
