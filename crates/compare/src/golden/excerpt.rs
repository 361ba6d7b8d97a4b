//! Excerpt of results that a golden stores: some rows, the first events and the summary values.

use super::GoldenError;
use crate::{LENGTHS, Results};
use serde_json::{Map, Value, json};
use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::Path;
use stickslip_run::files::{EVENTS, SCENARIO, SUMMARY, TRACE};
use stickslip_run::{Seal, hash};

/// Maximum size of the rows between the first and the last row, in bytes. At least `FEWEST` of these rows are kept.
const BYTES: usize = 12_000;
const FEWEST: usize = 10;
const MOST: usize = 40;
/// Maximum number of events, of which the first are kept, and maximum number of step lengths.
const EVENTS_KEPT: usize = 300;
const STEPS_KEPT: usize = 200;
/// Parts of the summary that an excerpt contains.
const PARTS: [&str; 7] = ["program", "stepper", "status", "simulated_s", "contacts", "steps", "energy"];

/// Returns the names and contents of the files of an excerpt.
pub(super) fn of(folder: &Path) -> Result<Vec<(&'static str, String)>, GoldenError> {
    let results = Results::read(folder).map_err(GoldenError::Damaged)?;
    let read = |name: &str, source| GoldenError::File { path: folder.join(name), source };
    let trace = rows(&folder.join(TRACE), results.trace.rows()).map_err(|source| read(TRACE, source))?;
    let (events, until) = events(&folder.join(EVENTS)).map_err(|source| read(EVENTS, source))?;
    let scenario = fs::read_to_string(folder.join(SCENARIO)).map_err(|source| read(SCENARIO, source))?;
    let mut summary = Map::new();
    summary.insert("excerpt".to_owned(), true.into());
    for key in PARTS {
        summary.extend(results.summary.get(key).map(|value| (key.to_owned(), value.clone())));
    }
    if let Some(Value::Object(steps)) = summary.get_mut("steps")
        && steps.get(LENGTHS).and_then(Value::as_array).is_some_and(|lengths| lengths.len() > STEPS_KEPT)
    {
        steps.remove(LENGTHS);
    }
    let mut counts = json!({ "rows": results.summary["counts"]["rows"] });
    let whole = until.map_or(results.events_until, |until| until.min(results.events_until));
    if whole.is_finite() {
        counts["events_whole_until_s"] = whole.into();
    }
    summary.insert("counts".to_owned(), counts);
    // Hashes of the complete tables show whether another run is byte-identical to the recorded run.
    let [rows, happened] = results.hashes();
    summary.insert("excerpt_of".to_owned(), json!({ TRACE: rows, EVENTS: happened }));
    summary.insert("scenario_sha256".to_owned(), hash(&scenario).into());
    let seal = |text: &str| Seal { rows: text.lines().count() as u64 - 1, sha256: hash(text) };
    summary.insert("tables".to_owned(), json!({ TRACE: seal(&trace), EVENTS: seal(&events) }));
    let summary = serde_json::to_string_pretty(&summary).unwrap_or_default() + "\n";
    Ok(vec![(TRACE, trace), (EVENTS, events), (SCENARIO, scenario), (SUMMARY, summary)])
}

/// Returns the heading, the first row, the last row and some rows between them.
///
/// The rows are spread by the golden ratio, so they sample many phases of the drive period.
fn rows(path: &Path, count: usize) -> std::io::Result<String> {
    let mut lines = BufReader::new(File::open(path)?).lines();
    let head = lines.next().transpose()?.unwrap_or_default();
    let (mut places, mut kept) = (Vec::new(), Vec::new());
    for (place, line) in lines.enumerate() {
        let line = line?;
        if place == 0 {
            places = spread(count, (BYTES / line.len().max(1)).clamp(FEWEST, MOST));
        }
        if places.binary_search(&place).is_ok() {
            kept.push(line);
        }
    }
    Ok([head].into_iter().chain(kept).map(|line| line + "\n").collect())
}

fn spread(rows: usize, between: usize) -> Vec<usize> {
    let ratio = (5_f64.sqrt() - 1.0) / 2.0;
    let between = (1..=between).map(|k| ((k as f64 * ratio).fract() * rows as f64) as usize);
    let mut places: Vec<usize> = between.chain([0, rows.saturating_sub(1)]).collect();
    places.sort_unstable();
    places.dedup();
    places
}

/// Returns time, source and kind of the first events. If there are more events, also returns the time of the last returned event.
fn events(path: &Path) -> std::io::Result<(String, Option<f64>)> {
    let mut lines = BufReader::new(File::open(path)?).lines();
    let mut kept = Vec::new();
    for line in lines.by_ref().take(EVENTS_KEPT + 1) {
        let line = line?;
        kept.push(line.split(',').take(3).collect::<Vec<_>>().join(",") + "\n");
    }
    let last = kept.last().and_then(|line| line.split(',').next()?.parse().ok());
    Ok((kept.concat(), lines.next().transpose()?.and(last)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_spread_over_all_phases() {
        assert_eq!(spread(1, 10), [0]);
        let places = spread(1001, 40);
        assert!(places.len() > 38 && places.first() == Some(&0) && places.last() == Some(&1000));
        // Of a period of a tenth of the run, each phase is sampled at most six times.
        for phase in 0..10 {
            assert!(places.iter().filter(|place| *place % 100 / 10 == phase).count() <= 6, "{places:?}");
        }
    }
}
