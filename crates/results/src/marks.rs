//! The moments at which a run is asked for its figures: ends of periods, and parts of them.

use crate::contact_path::is_walked;
use crate::job::Job;
use crate::periods::Periods;
use stickslip_drive::scene::Freedom;

/// Parts of a period at whose ends contacts are looked at whose force does not follow from the way alone: their loops have
/// extremes and corners that are no events.
const PARTS: f64 = 64.0;
/// A moment this near to an end, in periods, is the end.
const SAME: f64 = 1e-9;

/// Moments to come.
pub(crate) struct Marks {
    grids: Vec<Grid>,
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
        for c in 0..scene.contacts.len() {
            if let Some(periods) = Periods::of_contact(job, c, for_ever) {
                let parts = if is_walked(job, c) { 1.0 } else { PARTS };
                let grid = Grid::of(&periods, parts);
                if !grids.iter().any(|other| other.is_same(&grid)) {
                    grids.push(grid);
                }
            }
        }
        Self { grids, body: body.filter(|_| figures.is_some()), figures, end }
    }

    /// The next moment, s.
    pub(crate) fn next(&mut self) -> Option<f64> {
        let next = self.grids.iter().filter_map(Grid::due).fold(f64::INFINITY, f64::min);
        for grid in &mut self.grids {
            // Those that rounding puts elsewhere are one.
            while grid.due().is_some_and(|due| due <= next + SAME * grid.interval) {
                grid.next += 1.0;
            }
        }
        // Periods and the end of a run are rounded apart.
        let end = self.end;
        (next < f64::INFINITY).then_some(if next > end && next < end * (1.0 + SAME) { end } else { next })
    }

    /// Whether a moment ends a period of the figures; their beginning ends none.
    pub(crate) fn ends_period(&self, t: f64) -> bool {
        self.figures.is_some_and(|periods| {
            let place = (t - periods.start) / periods.length;
            place > 0.5 && (place - place.round()).abs() <= SAME
        })
    }
}

impl Grid {
    fn of(periods: &Periods, parts: f64) -> Self {
        let last = periods.count as f64 * parts;
        Self { start: periods.start, interval: periods.length / parts, next: 0.0, last }
    }

    fn due(&self) -> Option<f64> {
        (self.next <= self.last).then_some(self.start + self.next * self.interval)
    }

    fn is_same(&self, other: &Self) -> bool {
        self.start == other.start && self.interval == other.interval && self.last == other.last
    }
}
