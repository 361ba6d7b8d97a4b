//! What figures are taken from while a run goes on: no more of it than figures need, however long the run.

use crate::Setting;
use crate::Stride;
use crate::account::Accounts;
use crate::contact_cycles::{CycleFigures, Loops};
use crate::excursions::Excursions;
use crate::foot::Foot;
use crate::periods::{Periods, Tracker};
use crate::strides::StrideList;
use std::collections::HashMap;
use stickslip_drive::scene::Freedom;
use stickslip_drive::{Extent, Source};

/// No place yet.
const NOWHERE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// What figures are taken from.
pub struct Tally {
    contacts: Vec<ContactTally>,
    walker: Option<Walker>,
    accounts: Option<Accounts>,
    excursions: Excursions,
    /// How far the body of the figures and its foot went in the period under way, and the foot in the last whole one.
    extents: [Extent; 2],
    foot: Option<Extent>,
    /// The same of the voltage behind the driver of the foot's stack, at events and marks, and its place among all channels.
    voltages: [Extent; 2],
    voltage_place: Option<usize>,
}

/// What a contact has come to, over all rows and events.
pub struct ContactTally {
    /// Places of `fx_N`, `fn_N` and `d_m` among all channels.
    places: [Option<usize>; 3],
    /// Largest magnitudes of the forces, N.
    pub peaks: [f64; 2],
    /// Least and largest normal force, N, and indentation, m.
    pub ranges: [[f64; 2]; 2],
    /// Time in which it was open, s.
    pub open: f64,
    /// Since when it has been open, s; none while it is closed.
    pub open_since: Option<f64>,
    /// The first moment and the last, s, and the indentation at the last, m.
    first: f64,
    last: Option<[f64; 2]>,
    /// Its cycles, where it may have any.
    loops: Option<Loops>,
}

/// The body whose steps are counted.
struct Walker {
    /// Place of its x among all channels.
    place: usize,
    tracker: Tracker,
    /// Where it was at the last end of a period, and whether the end of the present one has come, m.
    ends: [Option<f64>; 2],
    strides: StrideList,
    /// Where it was at first and at last, m.
    way: Option<[f64; 2]>,
}

impl Tally {
    /// Nothing yet, of the figures of a setting.
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

    /// Keeps what there is too much of in a file without a name.
    pub fn spill(&mut self, file: std::fs::File) {
        if let Some(walker) = &mut self.walker {
            walker.strides.spill(file);
        }
    }

    /// Takes a row, or the row of an event.
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

    /// Takes a moment that figures are taken at: after an event, where something bends, or else a mark.
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

    /// Takes a moment of the account of a period: an event, or a mark.
    pub fn account(&mut self, event: Option<(Source, &str)>, values: &[f64]) {
        if let Some(accounts) = &mut self.accounts {
            accounts.moment(event, values);
        }
        let voltage = self.voltage_place.and_then(|place| values.get(place));
        if let (Some(voltage), Some(t)) = (voltage, values.first()) {
            self.voltages[0] = self.voltages[0].join(Extent::at(*voltage, *t));
        }
    }

    /// How far bodies have turned, rolled and fallen.
    pub fn excursions(&self) -> &Excursions {
        &self.excursions
    }

    /// What happened in the last whole period, where that is told.
    pub fn accounts(&self) -> Option<&Accounts> {
        self.accounts.as_ref()
    }

    /// Takes how far the body of the figures and its foot went.
    pub fn extents(&mut self, [body, foot]: [Extent; 2]) {
        self.extents = [self.extents[0].join(body), self.extents[1].join(foot)];
    }

    /// Begins the first period of the figures: what was before it is none of theirs.
    pub fn begin_extents(&mut self) {
        self.extents = [Extent::NONE; 2];
        self.voltages[0] = Extent::NONE;
    }

    /// Ends a period of the figures.
    pub fn end_extents(&mut self) -> Option<Stride> {
        let [body, foot] = std::mem::replace(&mut self.extents, [Extent::NONE; 2]);
        self.foot = Some(foot).filter(|foot| !foot.is_none());
        self.voltages = [Extent::NONE, self.voltages[0]];
        self.walker.as_mut()?.end_stride(body)
    }

    /// How far the foot went in the last whole period of the figures; none of a foot that is not free.
    pub fn foot(&self) -> Option<Extent> {
        self.foot
    }

    /// How far the voltage behind the driver of its stack went meanwhile; none without a driver.
    pub fn voltage(&self) -> Option<Extent> {
        Some(self.voltages[1]).filter(|voltage| !voltage.is_none())
    }

    /// Why no more steps can be kept.
    pub fn take_failure(&mut self) -> Option<std::io::Error> {
        self.walker.as_mut()?.strides.take_failure()
    }

    /// What it takes, B.
    pub fn bytes(&self) -> usize {
        let loops = self.contacts.iter().filter_map(|contact| contact.loops.as_ref()).map(Loops::bytes);
        loops.sum::<usize>() + self.walker.as_ref().map_or(0, |walker| walker.strides.bytes())
    }

    /// The cycles that are known only at the end.
    pub fn finish(&mut self, setting: &Setting) -> Vec<(usize, CycleFigures)> {
        let mut found = Vec::new();
        for (c, (contact, (_, law))) in self.contacts.iter_mut().zip(setting.model.contacts()).enumerate() {
            let Some(loops) = &mut contact.loops else { continue };
            found.extend(loops.finish(law).into_iter().map(|figures| (c, figures)));
        }
        found
    }

    /// What contact `c` has come to.
    pub fn contact(&self, c: usize) -> Option<&ContactTally> {
        self.contacts.get(c)
    }

    /// The steps so far; none where no body makes any.
    pub fn strides(&self) -> Option<&StrideList> {
        self.walker.as_ref().map(|walker| &walker.strides)
    }

    /// The way of the body that steps, m.
    pub fn net_travel(&self) -> f64 {
        let way = self.walker.as_ref().and_then(|walker| walker.way);
        way.map_or(0.0, |[first, last]| last - first)
    }

    /// Moments that cycles are without, for there were too many of them.
    pub fn left_out(&self) -> u64 {
        self.contacts.iter().filter_map(|contact| contact.loops.as_ref()).map(|loops| loops.left_out).sum()
    }
}

impl ContactTally {
    fn new((setting, c): (&Setting, usize), name: &str, places: &HashMap<&str, usize>) -> Self {
        let place = |quantity| places.get(format!("{name}.{quantity}").as_str()).copied();
        Self {
            places: ["fx_N", "fn_N", "d_m"].map(place),
            peaks: [0.0; 2],
            ranges: [NOWHERE; 2],
            open: 0.0,
            open_since: None,
            first: 0.0,
            last: None,
            loops: Loops::of(setting, c, places),
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
        // Touching and lifting off are events: between two of these moments it is open or closed all the time.
        match self.last {
            None => self.first = t,
            Some([before, depth]) if depth + d <= 0.0 => self.open += t - before,
            Some(_) => {}
        }
        self.open_since = Some(self.open_since.unwrap_or(t)).filter(|_| d <= 0.0);
        self.last = Some([t, d]);
    }

    /// Share of the time in which it was open; none without a row.
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

    /// The step of a period in whose end it has come to stand; none of one whose end was not among the moments.
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
            peaks: [0.0; 2],
            ranges: [NOWHERE; 2],
            open: 0.0,
            open_since: None,
            first: 0.0,
            last: None,
            loops: None,
        };
        assert_eq!(tally.open_share(), None);
        // Falls, touches at 2, rests until 3, lifts off, flies until 8, touches.
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
