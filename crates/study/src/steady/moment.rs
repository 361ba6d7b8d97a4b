//! At which moment of the period the map is taken.
//!
//! Where all contacts slip grossly or are apart their memories are wiped, and a state is places and speeds and nothing else. A
//! few plain periods show when that is: in the last of them but one events are noted, in the last the middle of each stretch
//! between two of them is looked at.

use super::SteadyError;
use super::map::{Image, Map};
use super::newton::Fixed;
use crate::grip::{Grip, Loose};
use stickslip_drive::scene::Axis;
use stickslip_drive::{Event, EventKind, Model, Record, Source, State};

/// Stretches that are looked at, the longest first.
const MOST: usize = 256;
/// By how much the second of two periods may be off, in defects of the first: disturbances may grow.
const AGAIN: f64 = 1e6;
/// Most of it, in natural scales.
const OFF: f64 = 1e-3;
/// Plain periods after which a step has to be the same, and by which share of it it may differ.
const LASTING: u32 = 16;
const LASTS: f64 = 1e-3;
/// How many times its last change a step may still have to go.
const LEFT: f64 = 30.0;
/// Shorter ones are too near to an event on either side, as a part of the period.
const SHORTEST: f64 = 1e-4;

/// Where a few plain periods have led.
pub(super) struct Settled {
    /// The state at the moment that was chosen.
    pub(super) state: State,
    /// Contacts that have not slipped grossly, nor been apart, in the last period.
    pub(super) never_gave_way: Vec<usize>,
}

/// Moments of events, s, the contacts that gave way, and what holds the figures' body.
struct Moments {
    times: Vec<f64>,
    gave_way: Vec<bool>,
    /// Places of the stick radii among all channels; none are asked for where nothing jumps.
    stick: Vec<Option<usize>>,
    jumps: bool,
    grip: Option<Grip>,
}

impl Moments {
    /// From a state on.
    fn from(model: &Model, state: &State, grip: Option<Grip>) -> Self {
        let channels = model.channels();
        let place = |name: &str| {
            let name = format!("{name}.stick_m");
            channels.iter().position(|channel| channel.name == name)
        };
        let (gave_way, stick) = model
            .contacts()
            .enumerate()
            .map(|(c, (name, _))| (state.has_given_way(model, c), place(name)))
            .unzip();
        Self { times: Vec::new(), gave_way, stick, jumps: model.jumps(), grip }
    }
}

impl Record for Moments {
    fn row(&mut self, _: &[f64]) {}
    fn event(&mut self, event: &Event, row: &[f64]) {
        self.times.push(event.t);
        self.grip.iter_mut().for_each(|grip| grip.event(event));
        match (event.source, event.kind) {
            (Source::Contact(c), EventKind::GrossSlip | EventKind::LiftOff) => self.gave_way[c] = true,
            // Within a jump a contact gives way without an event: nothing of it sticks then.
            (_, EventKind::Jump) => {
                let sticks = |place: usize| row.get(place).is_none_or(|radius| *radius > 0.0);
                for (gave_way, place) in self.gave_way.iter_mut().zip(&self.stick) {
                    *gave_way |= place.is_some_and(|place| !sticks(place));
                }
            }
            _ => {}
        }
    }
    fn wants_event_rows(&self) -> bool {
        self.jumps
    }
}

/// Goes a few plain periods, at least two, from where everything repeats itself, and stands at the moment of the period at which
/// memories are shortest.
pub(super) fn settle(
    map: &mut Map<'_>,
    begins: f64,
    start: State,
    periods: u32,
) -> Result<Settled, SteadyError> {
    let period = map.period();
    let first = (begins / period).ceil() * period;
    let end = |count: u32| first + f64::from(count) * period;
    let state = map.lead(start, end(periods.max(2) - 2), &mut ())?;
    again(map, state)
}

/// Goes two more plain periods from a state, and stands at the moment of the second at which memories are shortest.
pub(super) fn again(map: &mut Map<'_>, state: State) -> Result<Settled, SteadyError> {
    let (model, period, from) = (map.model(), map.period(), state.time());
    let contacts = model.contacts().count();
    let mut moments = Moments::from(model, &state, None);
    let state = map.lead(state, from + period, &mut moments)?;
    let stretches = stretches(&moments.times, (from, from + period));
    let chosen = choose(map, &state, &stretches)?;
    let never_gave_way = (0..contacts).filter(|c| !moments.gave_way[*c]).collect();
    Ok(Settled { state: chosen, never_gave_way })
}

/// Goes two plain periods from a fixed point, the second from where the first has led: that it comes by as much again shows that
/// nothing was forgotten of what the motion depends on. Tells which contacts did not give way in it, and what the body of
/// `grip` did in it if nothing held it.
pub(super) fn twice(
    map: &mut Map<'_>,
    fixed: &Fixed,
    grip: Option<Grip>,
) -> Result<(Vec<usize>, Option<Loose>), SteadyError> {
    let model = map.model();
    let contacts = model.contacts().count();
    let mut moments = Moments::from(model, &fixed.state, grip);
    let (from, period) = (fixed.state.time(), map.period());
    let first = map.lead(fixed.state.clone(), from + period, &mut ())?;
    let second = map.lead(first, from + 2.0 * period, &mut moments)?;
    let loose = match &mut moments.grip {
        Some(grip) => grip.loose(model, &map.held(second.clone())?),
        None => None,
    };
    let off = map.missed_after(second, (fixed, 2.0));
    if off > (AGAIN * map.tolerance().max(fixed.defect.amax())).min(OFF) {
        return Err(SteadyError::NoConvergence { best: off, periods: map.work() });
    }
    let never_gave_way = (0..contacts).filter(|c| !moments.gave_way[*c]).collect();
    Ok((never_gave_way, loose))
}

/// What the step of a motion may still be to lose, m, of which a contact remembers what is no number of the map: what it has changed by after
/// some plain periods more, and what is left of that as changes fall. Where the contact never gives way (`holds`) it is all of it, if it has
/// changed: a drive that walks by partial slip keeps it.
pub(super) fn creep(
    map: &mut Map<'_>,
    (fixed, holds): (&Fixed, bool),
    body: Option<usize>,
) -> Result<f64, SteadyError> {
    let step = |map: &Map<'_>, image: &Image| {
        body.zip(map.section()).and_then(|(body, at)| at.of_body(&image.way, body, Axis::X)).unwrap_or(0.0)
    };
    let (own, mut state) = (step(map, &fixed.image), fixed.image.state.clone());
    let mut steps = vec![own];
    for _ in 0..LASTING {
        let image = map.image(&state, 1.0)?;
        steps.push(step(map, &image));
        state = image.state;
    }
    let [middle, last] = [LASTING / 2, LASTING].map(|k| steps[k as usize]);
    if holds {
        return Ok(if (last - own).abs() > LASTS * own.abs() { own.abs() } else { 0.0 });
    }
    let [before, after] = [middle - own, last - middle].map(f64::abs);
    let share = after / before;
    let left = if share < 1.0 { share / (1.0 - share) } else { f64::INFINITY };
    Ok(if after == 0.0 { before } else { before + after * (1.0 + left.min(LEFT)) })
}

/// Stretches between two events as (middle, length), s, by their middle; those that are too short are left out.
fn stretches(times: &[f64], (from, to): (f64, f64)) -> Vec<(f64, f64)> {
    let mut times: Vec<f64> = times.iter().copied().filter(|t| (from..to).contains(t)).collect();
    times.insert(0, from);
    times.push(to);
    times.sort_by(f64::total_cmp);
    let pairs = times.windows(2).map(|pair| (0.5 * (pair[0] + pair[1]), pair[1] - pair[0]));
    let mut stretches: Vec<_> = pairs.filter(|(_, length)| *length > SHORTEST * (to - from)).collect();
    stretches.sort_by(|a, b| b.1.total_cmp(&a.1));
    stretches.truncate(MOST);
    stretches.sort_by(|a, b| a.0.total_cmp(&b.0));
    stretches
}

/// The state in the middle of the stretch with the shortest memories, the longest of those, a period after it was found.
fn choose(map: &mut Map<'_>, state: &State, stretches: &[(f64, f64)]) -> Result<State, SteadyError> {
    let period = map.period();
    let mut best: Option<((usize, f64), State)> = None;
    let mut state = state.clone();
    for (middle, length) in stretches {
        state = map.lead(state, middle + period, &mut ())?;
        let worth = (remembered(map.model(), &state), -length);
        let better = best
            .as_ref()
            .is_none_or(|(least, _)| worth.0 < least.0 || worth.0 == least.0 && worth.1 < least.1);
        if better {
            best = Some((worth, state.clone()));
        }
    }
    Ok(best.map_or(state, |(_, state)| state))
}

/// How much the contacts remember: knots of those that have not given way; a row of springs more than any knots.
fn remembered(model: &Model, state: &State) -> usize {
    let of = |(c, memory): (usize, &stickslip_contact::Memory)| match memory.knot_count() {
        _ if state.has_given_way(model, c) => 0,
        0 => stickslip_contact::Memory::DEFAULT_CAPACITY,
        count => count,
    };
    state.memories().iter().enumerate().map(of).sum()
}
