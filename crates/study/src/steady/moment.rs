//! Choice of the instant of the Poincaré section.
//!
//! Gross slip and lift-off erase the slip memory of a contact. After gross slip of all contacts, the state has positions and velocities
//! only. Two simulated periods determine the best instant: the first records events, the second compares midpoints between events.

use super::SteadyError;
use super::map::{Image, Map};
use super::newton::Fixed;
use crate::grip::{Grip, Loose};
use stickslip_drive::scene::Axis;
use stickslip_drive::{Entry, EventKind, Model, Record, Source, State, Wants};

/// Maximum number of compared midpoints. The longest intervals between events are preferred.
const MOST: usize = 256;
/// Largest deviation after two periods, relative to the defect of the fixed point; disturbances may grow in this time.
const AGAIN: f64 = 1e6;
/// Upper limit of the deviation after two periods, in natural scales.
const OFF: f64 = 1e-3;
/// Number of simulated periods for the check that the step length remains constant, and largest relative change of the step length.
const LASTING: u32 = 16;
const LASTS: f64 = 1e-3;
/// Upper limit of the extrapolated change of the step length, as a multiple of the last change.
const LEFT: f64 = 30.0;
/// Shortest interval between events whose midpoint is considered, as a fraction of the period.
const SHORTEST: f64 = 1e-4;

/// State after the first simulated periods, with its contacts.
pub(super) struct Settled {
    /// State at the chosen instant.
    pub(super) state: State,
    /// Contacts without gross slip and without lift-off in the last period.
    pub(super) never_gave_way: Vec<usize>,
}

/// Recorder of event times, s, of contacts that slip grossly or lift off, and of whether contacts hold the body named in `figures`.
struct Moments {
    times: Vec<f64>,
    gave_way: Vec<bool>,
    /// Channel indices of the stick radii, used only for models with jumps of the velocity.
    stick: Vec<Option<usize>>,
    jumps: bool,
    grip: Option<Grip>,
}

impl Moments {
    /// Creates the recorder for a run from `state`.
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
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Event(event, row) = entry {
            self.times.push(event.t);
            self.grip.iter_mut().for_each(|grip| grip.event(event));
            match (event.source, event.kind) {
                (Source::Contact(c), EventKind::GrossSlip | EventKind::BreaksLoose | EventKind::LiftOff) => {
                    self.gave_way.get_mut(c).into_iter().for_each(|gave_way| *gave_way = true);
                }
                // During a jump of the velocity, a contact may slip grossly without an event. Its stick radius is then 0.
                (_, EventKind::Jump) => {
                    let sticks = |place: usize| row.get(place).is_none_or(|radius| *radius > 0.0);
                    for (gave_way, place) in self.gave_way.iter_mut().zip(&self.stick) {
                        *gave_way |= place.is_some_and(|place| !sticks(place));
                    }
                }
                _ => {}
            }
        }
    }

    fn wants(&self) -> Wants {
        if self.jumps { Wants::default() } else { Wants::bare_events() }
    }
}

/// Simulates at least two periods after all waveforms have become periodic. Returns the state at the instant of a period with the smallest
/// slip memory.
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

/// Simulates two more periods. Returns the state at the instant of the second period with the smallest slip memory.
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

/// Simulates two periods from a fixed point to verify that the motion is periodic.
///
/// Returns the contacts without gross slip. Also returns the state of the observed body if no contact held it in the second period.
///
/// # Errors
/// Returns [`SteadyError::NoConvergence`] if the state after two periods deviates too much from the fixed point.
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

/// Returns the remaining change of the step length, m, due to slip memories that are not unknowns of the map.
///
/// The change is measured in further simulated periods and extrapolated geometrically. If a contact with such a memory never slips grossly
/// (`holds`), any significant change makes the whole step length uncertain.
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

/// Returns the intervals between events as (midpoint, length), s, in the order of midpoints. Short intervals are omitted.
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

/// Returns the state at the midpoint with the smallest slip memory, one period later. If several midpoints have the smallest slip memory,
/// the midpoint of the longest interval is chosen.
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

/// Returns the size of the slip memories: the number of breakpoints in contacts without gross slip. A contact with discrete springs counts
/// more than any piecewise linear memory.
fn remembered(model: &Model, state: &State) -> usize {
    let of = |(c, memory): (usize, &stickslip_contact::Memory)| match memory.knot_count() {
        _ if state.has_given_way(model, c) => 0,
        0 => stickslip_contact::Memory::DEFAULT_CAPACITY,
        count => count,
    };
    state.memories().iter().enumerate().map(of).sum()
}
