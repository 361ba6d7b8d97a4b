//! Table of all runs.

use crate::family::{Family, Setting};
use std::io::{self, Write};

const HEAD: [&str; 16] = [
    "method",
    "engine",
    "springs",
    "tolerance",
    "step_s",
    "end_error",
    "trajectory_error",
    "known_error",
    "processor_s_per_s",
    "wall_s_per_s",
    "turns",
    "evaluations",
    "steps",
    "rejected",
    "events",
    "note",
];

/// Writes a line for each run. `duration` is the simulated time, s. Fields of runs without a result are empty.
pub(crate) fn write(file: impl Write, families: &[Family<'_>], duration: f64) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(file);
    writer.write_record(HEAD)?;
    for family in families {
        for run in &family.runs {
            let method = family.method;
            let value = number(run.value);
            let (tolerance, step) = match method.setting() {
                Setting::Tolerance => (value, String::new()),
                Setting::Step => (String::new(), value),
                Setting::Nothing => Default::default(),
            };
            let mut line = vec![
                method.name().to_owned(),
                method.engine().to_owned(),
                method.springs().map_or(String::new(), |n| n.to_string()),
                tolerance,
                step,
            ];
            match &run.result {
                Some(result) => {
                    let counts = result.counts;
                    line.extend([result.errors.end, result.errors.trajectory].map(number));
                    line.push(result.known.map_or(String::new(), number));
                    line.push(number(result.cost.processor / duration));
                    line.push(number(result.cost.wall / duration));
                    line.push(result.turns.to_string());
                    let work = [counts.evaluations, counts.steps, counts.rejected, counts.events];
                    line.extend(work.map(|count| count.to_string()));
                }
                None => line.extend(std::iter::repeat_n(String::new(), 10)),
            }
            line.push(run.note.clone());
            writer.write_record(&line)?;
        }
    }
    writer.flush()
}

fn number(value: f64) -> String {
    format!("{value:e}")
}
