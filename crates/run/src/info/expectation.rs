//! Expected size of the output of a run, and expected memory of the program.

use crate::job::Job;
use crate::kept::draws_from_series;
use crate::selection::expected;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::facts::{ExpectedEvents, fixed_steps, rows};
use stickslip_measure::Series;
use stickslip_quantity::Real;
use stickslip_scenario::PlotName;

/// Bytes of a number with its comma in a table; between 13.9 and 19.7 in the examples.
const BYTES_PER_VALUE: f64 = 19.0;
/// Bytes of a row of `springs.csv`.
const BYTES_PER_SPRING: f64 = 150.0;
/// Memory of the program without results, including plots, B.
const BASE: f64 = 20e6;
/// Ratio of the memory to the size of the stored time histories. The ratio exceeds 1 because lists grow and are copied.
const OVERHEAD: f64 = 1.6;

/// Expected output of a complete run.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Expectation {
    /// number of time steps of a run. Absent for adaptive time integrators.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<Real>,
    /// Events.
    pub events: Events,
    /// number of rows of trace.csv
    pub rows: Real,
    /// number of columns of trace.csv
    pub columns: usize,
    /// estimated size of trace.csv in bytes
    #[serde(rename = "trace_B")]
    pub trace: Real,
    /// estimated size of events.csv in bytes
    #[serde(rename = "events_B")]
    pub events_file: Real,
    /// number of rows of springs.csv. Absent if the file is not written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spring_lines: Option<Real>,
    /// estimated size of springs.csv in bytes. Absent if the file is not written.
    #[serde(rename = "springs_B", skip_serializing_if = "Option::is_none")]
    pub springs_file: Option<Real>,
    /// largest number of memory curves in memory.csv. Open contacts have none. Absent if the file is not written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub memory_curves: Option<Real>,
    /// number of rows of fields.csv and of friction.csv. Absent if the files are not written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field_lines: Option<Real>,
    /// Estimated number of rows of `events.csv`.
    #[serde(skip)]
    pub(crate) events_written: Real,
    /// Memory that grows with the run, B: rows and events for plots.
    #[serde(skip)]
    pub(crate) kept: Real,
    /// estimated memory of the program in bytes
    #[serde(rename = "memory_B")]
    pub memory: Real,
}

/// Events of the whole run.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Events {
    /// number of corners of waveforms: those of one period times the number of periods
    pub corners: Real,
    /// estimated number of events of contacts and blocks. Within a factor of two for the examples; other models may
    /// differ more. With static and kinetic friction there are more: the ringing each time that a contact sticks again is
    /// not counted.
    pub contacts_estimate: Real,
    /// Events in a period of the waveform named in `figures`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub per_period: Option<PerPeriod>,
}

/// Events in a period.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PerPeriod {
    /// name of the waveform named in `figures`
    pub waveform: String,
    /// estimated mean number of events in a period of the waveform named in `figures`
    pub estimate: Real,
}

impl Expectation {
    /// Returns the expected output of a job.
    pub fn of(job: &Job) -> Self {
        let plan = &job.scenario.plan;
        let events = ExpectedEvents::of(job.setup(), plan);
        let (rows, columns) = (written_rows(job), job.columns.len());
        let written = written_events(job, &events);
        let series = Series::new(&job.model.channels(), &job.scenario.plots);
        let width = if draws_from_series(&job.scenario.plots) { series.width() } else { 0 };
        // The plot of events needs the time of each event.
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
            // Each row of the event table has two additional words, source and kind.
            events_file: Real(written * (columns + 2) as f64 * BYTES_PER_VALUE),
            events_written: Real(written),
            kept: Real(kept),
            memory: Real(BASE + OVERHEAD * kept),
            events: Events::of(job, events),
        }
    }
}

/// Returns the number of rows of `trace.csv`.
fn written_rows(job: &Job) -> f64 {
    let plan = &job.scenario.plan;
    let ([from, to], Some(every)) = (job.scenario.written.window, plan.every) else { return rows(plan) };
    // The first and last row are always written.
    rows(plan).min((to.min(plan.duration) - from).max(0.0) / every + 3.0)
}

/// Returns the estimated number of rows of `events.csv`. A selection of kinds or contacts is not taken into account.
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

    /// Returns the number of all events.
    pub fn total(&self) -> f64 {
        self.corners.0 + self.contacts_estimate.0
    }
}
