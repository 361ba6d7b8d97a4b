//! The moments at which a run is asked for its figures: ends of periods, and parts of them.

use crate::account::Phases;
use crate::contact_path::is_walked;
use crate::cycles::table_of;
use crate::job::Job;
use crate::periods::Periods;
use stickslip_drive::Waveform;
use stickslip_drive::scene::{Freedom, Side};

/// Parts of a period at whose ends contacts are looked at whose force does not follow from the way alone: their loops have
/// extremes and corners that are no events. Those of the body that steps have no loops.
const PARTS: f64 = 512.0;
/// The same of a table, all of it.
const TABLE_PARTS: f64 = 4096.0;
/// A moment this near to an end, in periods, is the end.
const SAME: f64 = 1e-9;

/// Moments to come.
pub(crate) struct Marks {
    grids: Vec<Grid>,
    /// How many of them, the first, are not for the account of a period alone.
    common: usize,
    /// Whether contacts are looked at in parts of a period.
    pub(crate) are_dense: bool,
    /// Body whose way in each period is wanted.
    pub(crate) body: Option<usize>,
    /// Periods of the figures.
    figures: Option<Periods>,
    /// End of the run, s.
    end: f64,
}

/// Multiples of an interval.
struct Grid {
    start: f64,
    interval: f64,
    /// Number of the next, and of the last.
    next: f64,
    last: f64,
}

impl Marks {
    /// Those that the figures of a job need.
    pub(crate) fn of(job: &Job) -> Self {
        let (scene, figures, end) = (&job.scenario.scene, job.scenario.figures, job.scenario.plan.duration);
        // A run that goes on beyond this end has had the same marks before it.
        let for_ever = f64::INFINITY;
        let is_free =
            |body: &usize| scene.bodies.get(*body).is_some_and(|b| b.part.x.freedom == Freedom::Free);
        let body = figures.body.filter(is_free);
        let of_figures = || Periods::until(&scene.waveforms.get(figures.waveform?)?.part, for_ever);
        let figures = body.and_then(|_| of_figures());
        let mut grids: Vec<Grid> = figures.iter().map(|periods| Grid::of(periods, 1.0)).collect();
        let mut are_dense = false;
        for c in 0..scene.contacts.len() {
            let grids_of_contact = match (Periods::of_contact(job, c, for_ever), table_of(job, c)) {
                (Some(periods), _) => {
                    let steps = body.is_some_and(|body| touches(job, c, body));
                    let whole = steps || is_walked(job, c);
                    are_dense |= !whole;
                    vec![Grid::of(&periods, if whole { 1.0 } else { PARTS })]
                }
                (None, Some(table)) => {
                    are_dense |= !is_walked(job, c);
                    Grid::along(table, is_walked(job, c), end)
                }
                (None, None) => Vec::new(),
            };
            for grid in grids_of_contact {
                if !grids.iter().any(|other| other.is_same(&grid)) {
                    grids.push(grid);
                }
            }
        }
        let common = grids.len();
        grids.extend(figures.iter().flat_map(|periods| turns(job, periods)));
        Self { grids, common, are_dense, body: body.filter(|_| figures.is_some()), figures, end }
    }

    /// Whether a moment is one for all figures, and not for the account of a period alone.
    pub(crate) fn is_common(&self, t: f64) -> bool {
        self.common == self.grids.len() || self.grids.iter().take(self.common).any(|grid| grid.has(t))
    }

    /// The next moment, s.
    pub(crate) fn next(&mut self) -> Option<f64> {
        let next = self.grids.iter().filter_map(Grid::due).fold(f64::INFINITY, f64::min);
        for grid in &mut self.grids {
            // Those that rounding puts elsewhere are one.
            let same = if grid.interval.is_finite() { SAME * grid.interval } else { 0.0 };
            while grid.due().is_some_and(|due| due <= next + same) {
                grid.next += 1.0;
            }
        }
        // Periods and the end of a run are rounded apart.
        let end = self.end;
        (next < f64::INFINITY).then_some(if next > end && next < end * (1.0 + SAME) { end } else { next })
    }

    /// Periods of the figures.
    pub(crate) fn figures(&self) -> Option<Periods> {
        self.figures
    }

    /// Which period of the figures a moment ends, from 1; 0 for their beginning.
    pub(crate) fn period_ended(&self, t: f64) -> Option<u64> {
        let periods = self.figures?;
        let place = (t - periods.start) / periods.length;
        // Of many periods rounding of t is more.
        let same = SAME.max(4.0 * f64::EPSILON * place.abs());
        ((place - place.round()).abs() <= same && place > -0.5).then(|| place.round() as u64)
    }
}

/// Where the waveform of the figures turns without a corner, which would be an event.
fn turns(job: &Job, periods: &Periods) -> Vec<Grid> {
    let waveform = job.scenario.figures.waveform.and_then(|w| job.scenario.scene.waveforms.get(w));
    let curved = waveform.map(|it| &it.part).filter(|waveform| !waveform.is_straight());
    let Some(phases) = curved.and_then(Phases::of) else { return Vec::new() };
    let grid = |turn: f64| Grid { start: periods.start + turn, ..Grid::of(periods, 1.0) };
    phases.turns().map(grid).collect()
}

/// Whether a contact is one of a body.
fn touches(job: &Job, c: usize, body: usize) -> bool {
    let contact = job.scenario.scene.contacts.get(c);
    contact.is_some_and(|contact| contact.part.between.contains(&Side::Body(body)))
}

impl Grid {
    fn of(periods: &Periods, parts: f64) -> Self {
        let last = periods.count as f64 * parts;
        Self { start: periods.start, interval: periods.length / parts, next: 0.0, last }
    }

    /// Along a waveform without a period, for reversals: the beginning and the end of the run, which a reversal needs to be one,
    /// and where the contact's law does not tell what is between events, parts of the waveform.
    fn along(waveform: &Waveform, is_walked: bool, end: f64) -> Vec<Self> {
        let once = |start: f64| Self { start, interval: f64::INFINITY, next: 0.0, last: 0.0 };
        let (from, to) = waveform.window();
        let parts = Self { start: from, interval: (to - from) / TABLE_PARTS, next: 0.0, last: TABLE_PARTS };
        let parts = Some(parts).filter(|parts| !is_walked && parts.interval.is_finite());
        [Some(once(0.0)), Some(once(end)), parts].into_iter().flatten().collect()
    }

    fn due(&self) -> Option<f64> {
        let way = if self.next > 0.0 { self.next * self.interval } else { 0.0 };
        (self.next <= self.last).then_some(self.start + way)
    }

    /// Whether a moment is one of its multiples.
    fn has(&self, t: f64) -> bool {
        if self.interval == f64::INFINITY {
            return t == self.start;
        }
        let place = (t - self.start) / self.interval;
        (place - place.round()).abs() <= SAME.max(4.0 * f64::EPSILON * place.abs())
    }

    fn is_same(&self, other: &Self) -> bool {
        self.start == other.start && self.interval == other.interval && self.last == other.last
    }
}
