//! Events of a period: numbers by source and kind.

use super::error::Trouble;
use super::place::{Bench, Place};
use crate::grip::{Grip, Loose};
use crate::steady::map::Map;
use crate::steady::tally::tells;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use stickslip_drive::{Entry, Event, Record, Source, State, Wants};

/// Numbers of events in a period by source and kind.
pub(super) type Happened = BTreeMap<(String, String), usize>;

/// Events of one period of an orbit.
#[derive(Debug, Clone)]
pub(super) struct Period {
    pub(super) happened: Happened,
    /// Events in chronological order.
    pub(super) order: Vec<(String, String)>,
    /// True if the body named in `figures` slips on all its contacts during the whole period.
    pub(super) is_dragged: bool,
    /// Relative distance of the Poincaré section from the nearest event: 0.5 midway between two events, 0 at an event.
    pub(super) margin: f64,
}

/// Difference of the event counts of neighbouring orbits.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Change {
    /// Name of the contact or piezo material.
    pub source: String,
    /// Kind of event.
    pub kind: String,
    /// Number of such events per period at parameter values below the change.
    pub below: usize,
    /// Number of such events per period at parameter values above the change.
    pub above: usize,
}

#[derive(Default)]
struct Events(Vec<Event>);

impl Record for Events {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Event(event, _) = entry {
            self.0.push(*event);
        }
    }

    fn wants(&self) -> Wants {
        Wants::bare_events()
    }
}

impl Period {
    /// Simulates the period of an orbit and records its events.
    pub(super) fn of(bench: &Bench<'_>, place: &Place) -> Result<Self, Trouble> {
        // The period that starts at the image is simulated, because an event exactly at the start of the previous period could be missed.
        let (state, period) = (&place.fixed.image.state, place.variant.drive.period);
        let (from, job) = (state.time(), &place.variant.job);
        let mut grip = job.scenario.figures.body.map(|body| Grip::new(job, body));
        let (_, events, loose) = stretch(&mut bench.map_at(place)?, state.clone(), period, grip.as_mut())?;
        let names: Vec<&str> = place.variant.drive.model.contacts().map(|(name, _)| name).collect();
        let blocks = &place.variant.job.scenario.scene.blocks;
        let (mut happened, mut order) = (Happened::new(), Vec::new());
        for event in &events {
            let source = match event.source {
                Source::Contact(c) => names.get(c).map(|name| (*name).to_owned()),
                Source::Block(b) => blocks.get(b).map(|block| block.name.clone()),
                Source::Waveform(_) => None,
            };
            let source = source.filter(|_| tells(event));
            if let Some(source) = source {
                let one = (source, event.kind.name().to_owned());
                order.push(one.clone());
                *happened.entry(one).or_default() += 1;
            }
        }
        let times = || events.iter().map(|event| event.t - from);
        let (after, before) = (times().fold(period, f64::min), period - times().fold(0.0, f64::max));
        let margin = after.min(before) / (after + before);
        Ok(Self { happened, order, is_dragged: loose == Some(Loose::Slides), margin })
    }
}

/// Simulates a state for some time, s. Returns the end state, the events, and the state of the observed body if no contact held it.
pub(super) fn stretch(
    map: &mut Map<'_>,
    state: State,
    time: f64,
    grip: Option<&mut Grip>,
) -> Result<(State, Vec<Event>, Option<Loose>), Trouble> {
    let (until, mut events) = (state.time() + time, Events::default());
    let state = map.lead(state, until, &mut events)?;
    let mut loose = None;
    if let Some(grip) = grip {
        grip.begin();
        events.0.iter().for_each(|event| grip.event(event));
        loose = grip.loose(map.model(), &map.held(state.clone())?);
    }
    Ok((state, events.0, loose))
}

/// Returns the differences between the event counts at a smaller and at a larger parameter value.
pub(super) fn changes(below: &Happened, above: &Happened) -> Vec<Change> {
    let mut keys: Vec<_> = below.keys().chain(above.keys()).collect();
    keys.sort();
    keys.dedup();
    let change = |key: &(String, String)| {
        let [below, above] = [below, above].map(|of| of.get(key).copied().unwrap_or(0));
        Change { source: key.0.clone(), kind: key.1.clone(), below, above }
    };
    keys.into_iter().map(change).filter(|change| change.below != change.above).collect()
}

/// Returns the first two events whose order differs, or `None` if the order is the same.
pub(super) fn swap(orders: [&[(String, String)]; 2]) -> Option<[(String, String); 2]> {
    let mut pairs = orders[0].iter().zip(orders[1]);
    pairs.find(|(below, above)| below != above).map(|(below, above)| [below.clone(), above.clone()])
}

#[cfg(test)]
mod tests {
    use super::super::bifurcation::Bifurcation;
    use super::*;

    #[test]
    fn changes_are_told_from_below() {
        let touch = |count: usize| Happened::from([(("end".to_owned(), "touch".to_owned()), count)]);
        let found = changes(&Happened::new(), &touch(1));
        assert_eq!((found[0].below, found[0].above), (0, 1));
        assert_eq!(Bifurcation::Event(found).words(), "touch of end appears above (1 per period)");
        assert!(changes(&touch(2), &touch(2)).is_empty());
    }

    #[test]
    fn events_that_change_places_are_told_apart() {
        let [one, other] = ["touch", "reversal"].map(|kind| ("end".to_owned(), kind.to_owned()));
        let below = [one.clone(), other.clone()];
        assert_eq!(swap([&below, &[other.clone(), one.clone()]]), Some([one, other]));
        assert_eq!(swap([&below, &below]), None);
    }
}
