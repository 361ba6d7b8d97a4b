//! What a run will take: steps, rows, files, memory.

use super::events::Events;
use serde::Serialize;
use stickslip_drive::Stepper;
use stickslip_results::Job;
use stickslip_results::Real;
use stickslip_results::Series;

/// Bytes of a number with its comma in a table: 13.9 to 19.7 on the examples.
const BYTES_PER_VALUE: f64 = 19.0;
/// Bytes of a line of `springs.csv`: 67.9 and 68.6 on the examples.
const BYTES_PER_SPRING: f64 = 68.0;
/// What the program takes by itself, its pictures included, B.
const BASE: f64 = 20e6;
/// Memory over what is kept: growing lists, and the copies that become figures. 1.56 with a million rows.
const OVERHEAD: f64 = 1.6;
/// A row this near to the end of the run, in intervals, is the last one.
const SAME: f64 = 1e-9;

/// How time is stepped, and what fixed steps could be.
#[derive(Debug, Serialize)]
pub(super) struct Stepping {
    pub(super) stepper: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) tolerance: Option<Real>,
    #[serde(rename = "step_s", skip_serializing_if = "Option::is_none")]
    pub(super) step: Option<Real>,
    #[serde(rename = "duration_s")]
    pub(super) duration: Real,
    /// Largest change of a step, relative, at which the run ends earlier.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) until_steady: Option<Real>,
    /// Longest stable steps with all contacts stuck and as deep as they get; none where nothing swings.
    #[serde(rename = "longest_verlet_step_s", skip_serializing_if = "Option::is_none")]
    pub(super) longest_verlet: Option<Real>,
    #[serde(rename = "longest_rk4_step_s", skip_serializing_if = "Option::is_none")]
    pub(super) longest_rk4: Option<Real>,
}

/// What a run to its end is expected to write and to hold.
#[derive(Debug, Serialize)]
pub(super) struct Expected {
    /// Steps of a stepper at fixed step.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) steps: Option<Real>,
    pub(super) events: Events,
    pub(super) rows: Real,
    pub(super) columns: usize,
    #[serde(rename = "trace_B")]
    pub(super) trace: Real,
    #[serde(rename = "events_B")]
    pub(super) events_file: Real,
    /// Lines of `springs.csv`, and its size.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) spring_lines: Option<Real>,
    #[serde(rename = "springs_B", skip_serializing_if = "Option::is_none")]
    pub(super) springs_file: Option<Real>,
    /// Curves in `memory.csv`; an open contact has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) memory_curves: Option<Real>,
    #[serde(rename = "memory_B")]
    pub(super) memory: Real,
}

impl Stepping {
    pub(super) fn of(job: &Job) -> Self {
        let (stepper, word, value) = job.stepper();
        let value_if = |wanted| (word == wanted).then_some(Real(value));
        let longest = |stepper| job.model.longest_step(stepper).filter(|step| step.is_finite()).map(Real);
        Self {
            stepper,
            tolerance: value_if("tolerance"),
            step: value_if("step_s"),
            duration: Real(job.scenario.plan.duration),
            until_steady: job.scenario.plan.until_steady.map(|asked| Real(asked.change)),
            longest_verlet: longest(Stepper::Verlet { step: 0.0 }),
            longest_rk4: longest(Stepper::Rk4 { step: 0.0 }),
        }
    }
}

impl Expected {
    pub(super) fn of(job: &Job) -> Self {
        let plan = &job.scenario.plan;
        let events = Events::of(job);
        // The grid strictly inside the run, and both its ends.
        let rows = plan.every.map_or(2.0, |every| (plan.duration / every - SAME).ceil().max(1.0) + 1.0);
        let columns = job.columns.len();
        let series = Series::new(&job.model.channels(), &job.scenario.plots);
        let kept = series.width() as f64 * (rows + events.total());
        let steps = match job.model.effective(plan.stepper) {
            Stepper::Verlet { step } | Stepper::Rk4 { step } => {
                Some(Real((plan.duration / step - SAME).ceil()))
            }
            Stepper::Event { .. } | Stepper::Dopri5 { .. } => None,
        };
        let springs: usize = job.grids.iter().flatten().map(|grid| grid.count()).sum();
        let spring_lines =
            job.scenario.springs.as_ref().map(|asked| springs as f64 * asked.moments.count(plan.duration));
        let contacts = job.scenario.scene.contacts.len() as f64;
        let curves = job.scenario.memory.as_ref().map(|asked| contacts * asked.moments.count(plan.duration));
        Self {
            steps,
            spring_lines: spring_lines.map(Real),
            springs_file: spring_lines.map(|lines| Real(lines * BYTES_PER_SPRING)),
            memory_curves: curves.map(Real),
            rows: Real(rows),
            columns,
            trace: Real(rows * columns as f64 * BYTES_PER_VALUE),
            // Two words more in each row.
            events_file: Real(events.total() * (columns + 2) as f64 * BYTES_PER_VALUE),
            memory: Real(BASE + OVERHEAD * kept * size_of::<f64>() as f64),
            events,
        }
    }
}
