//! Evaluation of a run while it proceeds. The memory used does not depend on the length of the run.

use crate::Setting;
use crate::Stride;
use crate::account::{Accounts, SLIP};
use crate::contact_cycles::{CycleFigures, Loops};
use crate::excursions::Excursions;
use crate::foot::Foot;
use crate::periods::{Periods, Tracker};
use crate::strides::StrideList;
use std::collections::HashMap;
use stickslip_drive::scene::Freedom;
use stickslip_drive::{EventKind, Extent, Source};

/// Empty range.
const NOWHERE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// Evaluations of a run.
pub struct Tally {
    contacts: Vec<ContactTally>,
    walker: Option<Walker>,
    accounts: Option<Accounts>,
    excursions: Excursions,
    /// Extents of the positions of the stepping body and of the foot in the current period, and of the foot in the last whole period.
    extents: [Extent; 2],
    foot: Option<Extent>,
    /// Driver voltage of the stack that moves the foot: extents in the current and in the last whole period, and channel index.
    voltages: [Extent; 2],
    voltage_place: Option<usize>,
}

/// Extremes of a contact over all rows and events.
pub struct ContactTally {
    /// Channel indices of `fx_N`, `fn_N` and `d_m`.
    places: [Option<usize>; 3],
    /// Channel index of `state`.
    state: Option<usize>,
    /// Largest magnitudes of the tangential and normal force, N.
    pub peaks: [f64; 2],
    /// Minimum and maximum of the normal force, N, and of the indentation, m.
    pub ranges: [[f64; 2]; 2],
    /// Total time in which the contact was open, s.
    pub open: f64,
    /// Time since which the contact has been open, s. `None` while it is closed.
    pub open_since: Option<f64>,
    /// Time since which the contact has neither slipped grossly nor been open, s. `None` while it does, and before the first such event.
    pub at_rest_since: Option<f64>,
    /// Time of the first sample, s, and time, s, and indentation, m, of the last sample.
    first: f64,
    last: Option<[f64; 2]>,
    /// Detection of the cycles of the contact. `None` if the contact has no cycles.
    loops: Option<Loops>,
}

/// Detection of the steps of the stepping body.
struct Walker {
    /// Channel index of x of the body.
    place: usize,
    tracker: Tracker,
    /// Position at the start of the current period, m, and position at its end if the end has been reached.
    ends: [Option<f64>; 2],
    strides: StrideList,
    /// First and last position in the run, m.
    way: Option<[f64; 2]>,
}

impl Tally {
    /// Creates the evaluations for a setting.
    pub fn new(setting: &Setting) -> Self {
        let channels = setting.model.channels();
        let places: HashMap<&str, usize> =
            channels.iter().enumerate().map(|(place, channel)| (channel.name.as_str(), place)).collect();
        let names = setting.model.contacts().map(|(name, _)| name).enumerate();
        let contacts: Vec<_> =
            names.map(|(c, name)| ContactTally::new((setting, c), name, &places)).collect();
        let voltage_place = Foot::of(setting)
            .and_then(|foot| foot.voltage(setting))
            .and_then(|name| places.get(name.as_str()).copied());
        let (walker, accounts) = (Walker::of(setting, &places), Accounts::of(setting, &places));
        let excursions = Excursions::new(setting, &places);
        Self {
            contacts,
            walker,
            accounts,
            excursions,
            extents: [Extent::NONE; 2],
            foot: None,
            voltages: [Extent::NONE; 2],
            voltage_place,
        }
    }

    /// Sets the file that stores older strides.
    pub fn spill(&mut self, file: std::fs::File) {
        if let Some(walker) = &mut self.walker {
            walker.strides.spill(file);
        }
    }

    /// Adds a row, or the row of an event.
    pub fn row(&mut self, values: &[f64]) {
        self.contacts.iter_mut().for_each(|contact| contact.row(values));
        self.excursions.row(values);
        if let Some(walker) = &mut self.walker
            && let Some(x) = values.get(walker.place)
        {
            let [first, _] = walker.way.unwrap_or([*x; 2]);
            walker.way = Some([first, *x]);
        }
    }

    /// Adds a sample: the state after an event or at a sampling time. Cycles that end are appended to `ended` with their contact index.
    pub fn moment(
        &mut self,
        setting: &Setting,
        (values, is_event): (&[f64], bool),
        ended: &mut Vec<(usize, CycleFigures)>,
    ) {
        for (c, (contact, (_, law))) in self.contacts.iter_mut().zip(setting.model.contacts()).enumerate() {
            let figures = contact.loops.as_mut().and_then(|loops| loops.take(law, values, is_event));
            ended.extend(figures.map(|figures| (c, figures)));
        }
        if let Some(walker) = &mut self.walker {
            walker.moment(values);
        }
    }

    /// Adds a sample to the evaluation of the drive periods: an event or a sampling time.
    pub fn account(&mut self, event: Option<(Source, &str)>, values: &[f64]) {
        if let (Some((Source::Contact(c), kind)), Some(t)) = (event, values.first())
            && let Some(contact) = self.contacts.get_mut(c)
        {
            contact.event(kind, (*t, values));
        }
        if let Some(accounts) = &mut self.accounts {
            accounts.moment(event, values);
        }
        let voltage = self.voltage_place.and_then(|place| values.get(place));
        if let (Some(voltage), Some(t)) = (voltage, values.first()) {
            self.voltages[0] = self.voltages[0].join(Extent::at(*voltage, *t));
        }
    }

    /// Returns the rotations, rolled distances and falls of bodies.
    pub fn excursions(&self) -> &Excursions {
        &self.excursions
    }

    /// Returns the evaluation of the drive periods, if the scenario has a drive that can be evaluated.
    pub fn accounts(&self) -> Option<&Accounts> {
        self.accounts.as_ref()
    }

    /// Adds the extents of the positions of the stepping body and of the foot in a part of the current period.
    pub fn extents(&mut self, [body, foot]: [Extent; 2]) {
        self.extents = [self.extents[0].join(body), self.extents[1].join(foot)];
    }

    /// Starts the first period. Extents before this time are discarded.
    pub fn begin_extents(&mut self) {
        self.extents = [Extent::NONE; 2];
        self.voltages[0] = Extent::NONE;
    }

    /// Ends a period and returns its stride.
    pub fn end_extents(&mut self) -> Option<Stride> {
        let [body, foot] = std::mem::replace(&mut self.extents, [Extent::NONE; 2]);
        self.foot = Some(foot).filter(|foot| !foot.is_none());
        self.voltages = [Extent::NONE, self.voltages[0]];
        self.walker.as_mut()?.end_stride(body)
    }

    /// Returns the extent of the foot's position in the last whole period. Returns `None` if the foot is not free.
    pub fn foot(&self) -> Option<Extent> {
        self.foot
    }

    /// Returns the extent of the driver voltage in the last whole period. Returns `None` without a driver.
    pub fn voltage(&self) -> Option<Extent> {
        Some(self.voltages[1]).filter(|voltage| !voltage.is_none())
    }

    /// Returns the error of the last failed write of strides and clears it.
    pub fn take_failure(&mut self) -> Option<std::io::Error> {
        self.walker.as_mut()?.strides.take_failure()
    }

    /// Returns the memory used, in bytes.
    pub fn bytes(&self) -> usize {
        let loops = self.contacts.iter().filter_map(|contact| contact.loops.as_ref()).map(Loops::bytes);
        loops.sum::<usize>() + self.walker.as_ref().map_or(0, |walker| walker.strides.bytes())
    }

    /// Returns the cycles that can only be evaluated at the end of the run, with their contact indices.
    pub fn finish(&mut self, setting: &Setting) -> Vec<(usize, CycleFigures)> {
        let mut found = Vec::new();
        for (c, (contact, (_, law))) in self.contacts.iter_mut().zip(setting.model.contacts()).enumerate() {
            let Some(loops) = &mut contact.loops else { continue };
            found.extend(loops.finish(law).into_iter().map(|figures| (c, figures)));
        }
        found
    }

    /// Returns the extremes of contact `c`.
    pub fn contact(&self, c: usize) -> Option<&ContactTally> {
        self.contacts.get(c)
    }

    /// Returns the strides so far. Returns `None` if no body steps.
    pub fn strides(&self) -> Option<&StrideList> {
        self.walker.as_ref().map(|walker| &walker.strides)
    }

    /// Returns the total displacement of the stepping body, m.
    pub fn net_travel(&self) -> f64 {
        let way = self.walker.as_ref().and_then(|walker| walker.way);
        way.map_or(0.0, |[first, last]| last - first)
    }

    /// Returns the number of samples that were dropped because a cycle had too many samples.
    pub fn left_out(&self) -> u64 {
        self.contacts.iter().filter_map(|contact| contact.loops.as_ref()).map(|loops| loops.left_out).sum()
    }
}

impl ContactTally {
    fn new((setting, c): (&Setting, usize), name: &str, places: &HashMap<&str, usize>) -> Self {
        let place = |quantity| places.get(format!("{name}.{quantity}").as_str()).copied();
        Self {
            places: ["fx_N", "fn_N", "d_m"].map(place),
            state: place("state"),
            peaks: [0.0; 2],
            ranges: [NOWHERE; 2],
            open: 0.0,
            open_since: None,
            at_rest_since: None,
            first: 0.0,
            last: None,
            loops: Loops::of(setting, c, places),
        }
    }

    fn event(&mut self, kind: &str, (t, values): (f64, &[f64])) {
        let slips = || self.state.and_then(|place| values.get(place)) == Some(&SLIP);
        let is = |others: [EventKind; 3]| others.iter().any(|other| kind == other.name());
        if is([EventKind::GrossSlip, EventKind::BreaksLoose, EventKind::LiftOff]) {
            self.at_rest_since = None;
        } else if is([EventKind::GrossSlipEnds, EventKind::SticksAgain, EventKind::Touch]) {
            // A contact that slips from its touch on has no other event.
            self.at_rest_since = Some(t).filter(|_| kind != EventKind::Touch.name() || !slips());
        }
    }

    fn row(&mut self, values: &[f64]) {
        let at = |place: Option<usize>| place.and_then(|place| values.get(place)).copied();
        let (Some(t), [Some(tangential), Some(normal), Some(d)]) = (at(Some(0)), self.places.map(at)) else {
            return;
        };
        for (peak, force) in self.peaks.iter_mut().zip([tangential, normal]) {
            *peak = force.abs().max(*peak);
        }
        for (range, value) in self.ranges.iter_mut().zip([normal, d]) {
            *range = [range[0].min(value), range[1].max(value)];
        }
        // Touch and lift-off are events, so the contact is either open or closed between two samples.
        match self.last {
            None => self.first = t,
            Some([before, depth]) if depth + d <= 0.0 => self.open += t - before,
            Some(_) => {}
        }
        self.open_since = Some(self.open_since.unwrap_or(t)).filter(|_| d <= 0.0);
        self.last = Some([t, d]);
    }

    /// Returns the fraction of time in which the contact was open. Returns `None` if the run has no rows.
    pub fn open_share(&self) -> Option<f64> {
        let [last, _] = self.last?;
        let total = last - self.first;
        Some(if total > 0.0 { self.open / total } else { 0.0 })
    }
}

impl Walker {
    fn of(setting: &Setting, places: &HashMap<&str, usize>) -> Option<Self> {
        let (scene, figures) = (&setting.scenario.scene, setting.scenario.figures);
        let body = scene.bodies.get(figures.body?)?;
        let waveform = scene.waveforms.get(figures.waveform?)?;
        let periods = Periods::until(&waveform.part, f64::INFINITY)?;
        let place = *places.get(format!("{}.x_m", body.name).as_str())?;
        (body.part.x.freedom == Freedom::Free).then(|| Self {
            place,
            tracker: Tracker::new(periods),
            ends: [None; 2],
            strides: StrideList::default(),
            way: None,
        })
    }

    fn moment(&mut self, values: &[f64]) {
        let (Some(t), Some(x)) = (values.first(), values.get(self.place)) else { return };
        match self.tracker.pass(*t) {
            Some(0) => self.ends = [Some(*x), None],
            Some(_) => self.ends[1] = Some(*x),
            None => {}
        }
    }

    /// Returns the stride of the current period. Returns `None` if a sample at its start or end is missing.
    fn end_stride(&mut self, extent: Extent) -> Option<Stride> {
        let [start, end] = self.ends;
        let Extent { least: [least, _], most: [most, _], fall, rise } = extent;
        let stride = Stride { start: start?, end: end?, least, most, fall, rise };
        self.ends = [end, None];
        self.strides.push(stride);
        Some(stride)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bouncing_contact_is_open_between_its_events() {
        let mut tally = ContactTally {
            places: [Some(2), Some(2), Some(1)],
            state: None,
            peaks: [0.0; 2],
            ranges: [NOWHERE; 2],
            open: 0.0,
            open_since: None,
            at_rest_since: None,
            first: 0.0,
            last: None,
            loops: None,
        };
        assert_eq!(tally.open_share(), None);
        // The body falls, touches at 2, rests until 3, lifts off, flies until 8 and touches again.
        let rows =
            [[0.0, -1.0, 0.0], [2.0, 1e-20, 0.0], [2.5, 3.0, 7.0], [3.0, -1e-20, 0.0], [5.0, -9.0, 0.0]];
        rows.iter().for_each(|row| tally.row(row));
        assert_eq!(tally.open_since, Some(3.0));
        [[8.0, 1e-20, 0.0], [10.0, 2.0, 4.0]].iter().for_each(|row| tally.row(row));
        assert_eq!(tally.open_since, None);
        assert_eq!((tally.open_share(), tally.ranges), (Some(0.7), [[0.0, 7.0], [-9.0, 3.0]]));
        assert_eq!(tally.peaks, [7.0, 7.0]);
    }
}
