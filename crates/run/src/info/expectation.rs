//! What a run to its end is expected to write and to hold.

use crate::job::Job;
use crate::kept::draws_from_series;
use crate::selection::expected;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::facts::{ExpectedEvents, fixed_steps, rows};
use stickslip_measure::Series;
use stickslip_quantity::Real;
use stickslip_scenario::PlotName;

/// Bytes of a number with its comma in a table: 13.9 to 19.7 on the examples.
const BYTES_PER_VALUE: f64 = 19.0;
/// Bytes of a line of `springs.csv`: 149 and 150 on the examples.
const BYTES_PER_SPRING: f64 = 150.0;
/// What the program takes by itself, its pictures included, B.
const BASE: f64 = 20e6;
/// Memory over what is kept: growing lists, and the copies that become figures. 1.56 with a million rows.
const OVERHEAD: f64 = 1.6;

/// What a run to its end is expected to write and to hold.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Expectation {
    /// steps of a stepper of fixed step
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<Real>,
    /// Events.
    pub events: Events,
    /// rows of trace.csv
    pub rows: Real,
    /// its columns
    pub columns: usize,
    /// about the size of trace.csv, in bytes
    #[serde(rename = "trace_B")]
    pub trace: Real,
    /// about the size of events.csv, in bytes
    #[serde(rename = "events_B")]
    pub events_file: Real,
    /// lines of springs.csv
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spring_lines: Option<Real>,
    /// about its size, in bytes
    #[serde(rename = "springs_B", skip_serializing_if = "Option::is_none")]
    pub springs_file: Option<Real>,
    /// curves in memory.csv; an open contact has none
    #[serde(skip_serializing_if = "Option::is_none")]
    pub memory_curves: Option<Real>,
    /// lines of fields.csv, and of friction.csv
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field_lines: Option<Real>,
    /// Events in `events.csv`, estimated.
    #[serde(skip)]
    pub(crate) events_written: Real,
    /// What of it grows with the run: rows and events that pictures are drawn from, B.
    #[serde(skip)]
    pub(crate) kept: Real,
    /// about the memory that the program takes, in bytes
    #[serde(rename = "memory_B")]
    pub memory: Real,
}

/// Events of the whole run.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Events {
    /// corners of waveforms: those of a period times the periods, whole or not
    pub corners: Real,
    /// events of contacts and blocks, estimated: to a factor of two on the examples, elsewhere a guess
    pub contacts_estimate: Real,
    /// All in a period of the waveform of `figures`, on the average.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub per_period: Option<PerPeriod>,
}

/// Events in a period.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PerPeriod {
    /// the waveform of `figures`
    pub waveform: String,
    /// all events in a period of it, on the average
    pub estimate: Real,
}

impl Expectation {
    /// That of a job.
    pub fn of(job: &Job) -> Self {
        let plan = &job.scenario.plan;
        let events = ExpectedEvents::of(job.setup(), plan);
        let (rows, columns) = (written_rows(job), job.columns.len());
        let written = written_events(job, &events);
        let series = Series::new(&job.model.channels(), &job.scenario.plots);
        let width = if draws_from_series(&job.scenario.plots) { series.width() } else { 0 };
        // A picture of the events has the time of each.
        let times = if job.scenario.plots.contains(&PlotName::Events) { written } else { 0.0 };
        let kept = (width as f64 * (rows + written) + times) * size_of::<f64>() as f64;
        let springs: usize = job.grids.iter().flatten().map(|grid| grid.count()).sum();
        let spring_lines =
            job.scenario.springs.as_ref().map(|asked| springs as f64 * asked.moments.count(plan.duration));
        let contacts = job.scenario.scene.contacts.len() as f64;
        let curves = job.scenario.memory.as_ref().map(|asked| contacts * asked.moments.count(plan.duration));
        let fields = job.scenario.fields.as_ref();
        let fields = fields.map(|asked| contacts * asked.radii as f64 * asked.moments.count(plan.duration));
        Self {
            steps: fixed_steps(&job.model, plan).map(Real),
            spring_lines: spring_lines.map(Real),
            springs_file: spring_lines.map(|lines| Real(lines * BYTES_PER_SPRING)),
            memory_curves: curves.map(Real),
            field_lines: fields.map(Real),
            rows: Real(rows),
            columns,
            trace: Real(rows * columns as f64 * BYTES_PER_VALUE),
            // Two words more in each row.
            events_file: Real(written * (columns + 2) as f64 * BYTES_PER_VALUE),
            events_written: Real(written),
            kept: Real(kept),
            memory: Real(BASE + OVERHEAD * kept),
            events: Events::of(job, events),
        }
    }
}

/// Rows in the trace.
fn written_rows(job: &Job) -> f64 {
    let plan = &job.scenario.plan;
    let ([from, to], Some(every)) = (job.scenario.written.window, plan.every) else { return rows(plan) };
    // The first and the last are there anyway.
    rows(plan).min((to.min(plan.duration) - from).max(0.0) / every + 3.0)
}

/// Events in their table, about: of some kinds or contacts no more than of all.
fn written_events(job: &Job, events: &ExpectedEvents) -> f64 {
    let (written, duration) = (&job.scenario.written, job.scenario.plan.duration);
    let [from, to] = written.window;
    let share = ((to.min(duration) - from) / duration).clamp(0.0, 1.0);
    expected(share * events.total(), written.events.most)
}

impl Events {
    fn of(job: &Job, events: ExpectedEvents) -> Self {
        let (scene, duration) = (&job.scenario.scene, job.scenario.plan.duration);
        let named = job.scenario.figures.waveform.and_then(|w| scene.waveforms.get(w));
        let per_period = named.and_then(|named| {
            let share = named.part.period()? / duration;
            let estimate = Real(events.total() * share);
            (share <= 1.0).then(|| PerPeriod { waveform: named.name.clone(), estimate })
        });
        let ExpectedEvents { corners, contacts } = events;
        Self { corners: Real(corners), contacts_estimate: Real(contacts), per_period }
    }

    /// All events.
    pub fn total(&self) -> f64 {
        self.corners.0 + self.contacts_estimate.0
    }
}
