//! Reconstruction of the recorded data of a run from its tables.

use crate::columns::Columns;
use crate::frame::FrameError;
use crate::kept::Kept;
use crate::results::ResultsError;
use crate::rows::Rows;
use crate::seal::SealedTable;
use crate::states::state_code;
use stickslip_drive::Channel;
use stickslip_scenario::PlotName;

/// Meaning of the last row of a trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LastRow {
    /// Planned end of the run, before the events at this time.
    End,
    /// State at which the run stopped, after all events.
    Stop,
}

/// Passes the rows of the trace and the events to a recorder in their original order. A row precedes events at the same time.
pub(crate) fn read(
    (trace, events): (&SealedTable, &SealedTable),
    columns: &Columns,
    (plots, last): (&[PlotName], LastRow),
) -> Result<Kept, ResultsError> {
    let channels = columns.channels();
    let mut kept = Kept::new(&channels, plots).for_pictures(plots).fingerprinted(Columns::all(&channels));
    let mut rows = Replay::open(trace, &channels, &[])?;
    let mut events = Replay::open(events, &channels, &["source", "kind"])?;
    let (mut row, mut next) = (Vec::new(), Vec::new());
    if !rows.advance(&mut row)? {
        return Err(ResultsError::Empty(trace.path.clone()));
    }
    let mut event = Vec::new();
    let mut has_event = events.advance(&mut event)?;
    loop {
        let is_last = !rows.advance(&mut next)?;
        let stops = is_last && last == LastRow::Stop;
        while has_event && (stops || time(&event) < time(&row)) {
            kept.event([events.rows.text(1), events.rows.text(2)], &event);
            has_event = events.advance(&mut event)?;
        }
        kept.row(&row);
        if is_last {
            break;
        }
        std::mem::swap(&mut row, &mut next);
    }
    while has_event {
        kept.event([events.rows.text(1), events.rows.text(2)], &event);
        has_event = events.advance(&mut event)?;
    }
    Ok(kept)
}

fn time(values: &[f64]) -> f64 {
    values.first().copied().unwrap_or(f64::NAN)
}

/// A table that is being read.
struct Replay<'a> {
    rows: Rows,
    channels: &'a [Channel],
    /// Number of text columns after the time.
    words: usize,
}

impl<'a> Replay<'a> {
    fn open(table: &SealedTable, channels: &'a [Channel], words: &[&str]) -> Result<Self, ResultsError> {
        let mut rows = Rows::open(table)?;
        let mut names: Vec<&str> = channels.iter().map(|channel| channel.name.as_str()).collect();
        names.splice(1..1, words.iter().copied());
        rows.check_head(&names)?;
        Ok(Self { rows, channels, words: words.len() })
    }

    /// Reads the channels of the next row. Returns `false` after the last row.
    fn advance(&mut self, values: &mut Vec<f64>) -> Result<bool, ResultsError> {
        values.clear();
        if !self.rows.advance()? {
            return Ok(false);
        }
        for (i, channel) in self.channels.iter().enumerate() {
            let column = if i == 0 { 0 } else { i + self.words };
            values.push(self.value(column, channel)?);
        }
        Ok(true)
    }

    fn value(&self, column: usize, channel: &Channel) -> Result<f64, ResultsError> {
        if !channel.is_state {
            return Ok(self.rows.number(column, &channel.name)?);
        }
        let text = self.rows.text(column);
        state_code(text).ok_or_else(|| {
            let text = text.escape_debug();
            self.rows
                .fault(format!("{}: expected open, stick, partial or slip, got \"{text}\"", channel.name))
                .into()
        })
    }
}

impl From<FrameError> for ResultsError {
    fn from(source: FrameError) -> Self {
        Self::Table { source }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::{EVENTS, TRACE};
    use crate::folder::Folder;
    use crate::job::Job;
    use crate::record::Recorder;
    use std::path::Path;

    /// Runs an example with overrides. Returns the recorded data and those read from the tables.
    fn kept_and_read(name: &str, set: &[(&str, &str)]) -> (Kept, Kept) {
        let root = tempfile::tempdir().unwrap();
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name);
        let set: Vec<_> = set.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
        let mut job = Job::prepare(&file, &set, root.path()).unwrap();
        job.scenario.plots = PlotName::ALL.to_vec();
        let mut folder = Folder::make(&job.folder).unwrap();
        let recorder = Recorder::new(&job, &()).fingerprinted().with_tables(&folder).unwrap();
        let (outcome, drafts) = job.run_recorded(recorder).unwrap();
        drafts.into_iter().for_each(|draft| folder.stage(draft.name, draft.file).unwrap());
        folder.publish().unwrap();
        let last = if outcome.error.is_some() { LastRow::Stop } else { LastRow::End };
        let [trace, events] = [TRACE, EVENTS].map(|name| job.folder.join(name).into());
        let read = read((&trace, &events), &job.columns, (&PlotName::ALL, last)).unwrap();
        (outcome.kept, read)
    }

    #[test]
    fn what_is_read_back_is_what_was_kept_also_where_rows_and_events_share_a_moment() {
        let jumps = ("waveforms.drive.sawtooth.flyback", "0");
        let cases: [(&str, &[(&str, &str)]); 5] = [
            // Corners and rows at equal times.
            ("p1.json", &[("output.every", "0.1 ms")]),
            ("p1.json", &[("output.every", "0.1 ms"), jumps]),
            ("quickstart.json", &[("output.every", "1 ms"), ("run.limits.steps", "1500"), jumps]),
            ("quickstart.json", &[("run.stepper", r#"{"rk4": {"step": "10 us"}}"#)]),
            ("oblique_loading.json", &[("output.every", "1 s")]),
        ];
        for (name, set) in cases {
            let (kept, read) = kept_and_read(name, set);
            assert!(kept.series.time().windows(2).any(|t| t[0] == t[1]), "{name}: no shared moment");
            assert!(kept.series == read.series, "{name} {set:?}");
            assert_eq!(kept.tracks, read.tracks, "{name} {set:?}");
            assert_eq!(kept.fingerprint(), read.fingerprint(), "{name} {set:?}");
        }
    }
}
