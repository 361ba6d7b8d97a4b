//! What the parts have written, put together by time.

use super::lane::Lane;
use super::sheet::key;
use crate::event::{Event, Source};
use crate::model::{ENERGIES, Model};
use crate::record::{Extent, Record};
use crate::run::output::{Grid, Opening, SAME_MARK};
use stickslip_contact::Memory;

/// What of the whole is due, and its rows.
pub(super) struct Merged {
    grid: Grid,
    /// Whether the run begins with a row.
    opens: bool,
    /// When the record looks and marks next, s; infinite where it does no more.
    look: f64,
    mark: f64,
    row: Vec<f64>,
    /// Waveforms that have turned at the moment at hand.
    turned: (f64, Vec<usize>),
}

impl Merged {
    pub(super) fn new(model: &Model) -> Self {
        let never = f64::INFINITY;
        Self {
            grid: Grid::new(None, 0.0, [0.0, never]),
            opens: false,
            look: never,
            mark: never,
            row: vec![0.0; model.channel_count()],
            turned: (f64::NEG_INFINITY, Vec::with_capacity(model.waveforms.len())),
        }
    }

    /// Begins at a time, s.
    pub(super) fn set_out(
        &mut self,
        (every, t): (Option<f64>, f64),
        opening: Opening,
        record: &mut dyn Record,
    ) {
        self.grid = Grid::new(every, t, record.rows_within());
        self.opens = opening.has_row(every, t);
        let is_told = |due: f64| due < t || opening == Opening::Resumed && due == t;
        (self.look, self.mark) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        while is_told(self.look) {
            self.look = after(self.look, record.next_look());
        }
        while is_told(self.mark) {
            self.mark = after(self.mark, record.next_mark());
        }
    }

    /// Ends the rows at a time, s.
    pub(super) fn end_at(&mut self, end: f64) {
        self.grid.end_at(end);
    }

    /// Whether something is to be written of the time at which the run stands, s.
    pub(super) fn opens_at(&self, t: f64) -> bool {
        self.opens || self.wanted() <= t
    }

    /// The next moment at which the record itself looks or marks, s.
    pub(super) fn wanted(&self) -> f64 {
        self.look.min(self.mark)
    }

    /// Tells a part when it is to be read in a stretch: at moments of the calendar, and where the record says.
    pub(super) fn ask(
        &self,
        lane: &mut Lane<'_>,
        moments: impl Iterator<Item = f64>,
        (t, until): (f64, f64),
    ) {
        // Where it is as good as there it would not be read again.
        let behind = lane.state.t < t * (1.0 - SAME_MARK);
        lane.sheet.ask_anew(behind && !self.opens);
        if self.opens || lane.sheet.watches() && behind {
            lane.sheet.ask(t);
        }
        moments.for_each(|t| lane.sheet.ask(t));
        if self.mark <= until {
            lane.sheet.ask_amid(self.mark);
        }
        if self.look <= until {
            lane.sheet.look_at(self.look);
        }
    }

    /// Writes what the parts have up to a time, s: of that time itself events last, as at the end of a step.
    pub(super) fn write(&mut self, lanes: &mut [Lane<'_>], t: f64, record: &mut dyn Record) {
        if std::mem::take(&mut self.opens) {
            self.compose(lanes, t, |lane| lane.sheet.read_at(t));
            record.row(&self.row);
        }
        for lane in lanes.iter_mut() {
            lane.sheet.tell_paths(lane.part, record);
        }
        while let Some(due) = self.grid.due(t) {
            while self.event(lanes, |at| at < due, record) {}
            self.grid.pass(due);
            if self.compose(lanes, due, |lane| lane.sheet.row_at(due)) {
                record.row(&self.row);
            }
        }
        while self.event(lanes, |at| at < t, record) {}
        if self.mark <= t {
            self.tell_range(lanes, record);
            // Where a step ends as good as there the moment is that end.
            let mark = self.mark;
            let read = |lane: &mut Lane<'_>| lane.sheet.read_at(mark).map_or(mark, |row| row[0]);
            let at = lanes.iter_mut().map(read).fold(mark, f64::min);
            self.compose(lanes, at, |lane| lane.sheet.read_at(mark));
            record.mark(&self.row);
            self.mark = after(self.mark, record.next_mark());
        }
        if self.look <= t {
            if let Some(memories) = memories(lanes) {
                record.look(self.look, &memories);
            }
            self.look = after(self.look, record.next_look());
        }
        while self.event(lanes, |at| at <= t, record) {}
        lanes.iter_mut().for_each(|lane| lane.sheet.go_on_from(t));
    }

    /// Writes the first event among those at some time; false where there is none. A corner of a waveform is one event of all parts.
    fn event(
        &mut self,
        lanes: &mut [Lane<'_>],
        is_due: impl Fn(f64) -> bool,
        record: &mut dyn Record,
    ) -> bool {
        let first = |(k, lane): (usize, &Lane<'_>)| {
            let event = lane.sheet.event().filter(|event| is_due(event.t))?;
            Some((event.t, key(lane.part, event.source), k, *event))
        };
        let all = lanes.iter().enumerate().filter_map(first);
        let Some((t, order, k, event)) = all.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))) else {
            return false;
        };
        let source = lanes[k].part.source(event.source);
        if let Source::Waveform(w) = source {
            for lane in lanes.iter_mut() {
                let same = |own: &Event| own.t == t && key(lane.part, own.source) == order;
                if lane.sheet.event().is_some_and(same) {
                    lane.sheet.pass_event();
                }
            }
            if self.turned.0 != t {
                self.turned.1.clear();
                self.turned.0 = t;
            }
            if self.turned.1.contains(&w) {
                return true;
            }
            self.turned.1.push(w);
        } else {
            lanes[k].sheet.pass_event();
        }
        self.compose(lanes, t, |lane| lane.sheet.row_of(t));
        record.event(&Event { source, ..event }, &self.row);
        true
    }

    /// Puts the row of a time, s, together from those of the parts; false where one of them has none.
    fn compose<'l>(
        &mut self,
        lanes: &'l mut [Lane<'_>],
        t: f64,
        values: impl for<'a> Fn(&'a mut Lane<'_>) -> Option<&'a [f64]>,
    ) -> bool {
        let first_energy = self.row.len() - ENERGIES;
        let (own, energies) = self.row.split_at_mut(first_energy);
        own[0] = t;
        energies.fill(0.0);
        let mut whole = true;
        for lane in lanes {
            let part = lane.part;
            let Some(values) = values(lane) else {
                whole = false;
                continue;
            };
            part.channels.iter().for_each(|(from, to)| own[*to] = values[*from]);
            let last = &values[values.len() - ENERGIES..];
            energies.iter_mut().zip(last).for_each(|(sum, energy)| *sum += energy);
        }
        whole
    }

    /// Writes the row of where all parts stand.
    pub(super) fn write_now(&mut self, lanes: &mut [Lane<'_>], t: f64, record: &mut dyn Record) {
        self.compose(lanes, t, |lane| lane.sheet.last_row());
        record.row(&self.row);
        lanes.iter_mut().for_each(|lane| lane.sheet.go_on_from(t));
    }

    /// Tells the range of a watched body so far.
    pub(super) fn tell_range(&mut self, lanes: &mut [Lane<'_>], record: &mut dyn Record) {
        for lane in lanes {
            lane.hand_over();
            let extents = std::mem::replace(&mut lane.sheet.extents, [Extent::NONE; 2]);
            if extents.iter().any(|extent| !extent.is_none()) {
                record.extents(extents);
            }
        }
    }
}

/// The moment that a record asks for after another; those that do not ascend end them.
fn after(last: f64, next: Option<f64>) -> f64 {
    next.filter(|next| *next > last).unwrap_or(f64::INFINITY)
}

/// The memories of all contacts at a look; none where one of them could not be followed.
fn memories(lanes: &mut [Lane<'_>]) -> Option<Vec<Memory>> {
    let mut all = Vec::new();
    for lane in lanes {
        let own = lane.sheet.memories.take();
        let own = own.or_else(|| lane.part.contacts.is_empty().then(Vec::new))?;
        all.extend(lane.part.contacts.iter().copied().zip(own));
    }
    all.sort_by_key(|(c, _)| *c);
    Some(all.into_iter().map(|(_, memory)| memory).collect())
}
