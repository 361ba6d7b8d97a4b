//! Result of a run: columns, events, summary, plots.

use crate::scenario::refused;
use crate::watch::{Signals, is_main, lock};
use crate::{RunError, text};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use stickslip_drive::{Channel, Entry, Event, Record, Wants};
use stickslip_figures::{Colours, Format, Look, Sources, draw_one};
use stickslip_quantity::{columns::TRACE, names};
use stickslip_run::files::InsideTables;
use stickslip_run::{Job, Outcome, SealedTable, Table, Watcher};
use stickslip_scenario::PlotName;

/// Names of the contact states by their codes.
pub(crate) fn states() -> Vec<&'static str> {
    (0..4).map(|code| stickslip_drive::state_name(f64::from(code))).collect()
}

/// Maximum duration of a run whose summary data are not kept. If the summary is requested, the run is repeated.
const BRIEF: Duration = Duration::from_millis(50);

/// Result of a completed run.
pub(crate) struct Ended {
    table: Table,
    /// Reason why the run ended early.
    error: Option<String>,
    /// Time reached, s.
    end: f64,
    /// Data for the summary; `None` for a brief run, which is repeated for it.
    outcome: Option<Outcome>,
}

impl Ended {
    /// Runs a job and keeps its rows and events.
    pub(crate) fn of(job: &Job, watcher: &dyn Watcher) -> Self {
        Self::brief(job, watcher).unwrap_or_else(|| {
            let mut outcome = job.run_with_table(watcher);
            let (error, excess) = (outcome.error.as_ref(), outcome.excess.as_ref());
            let why = error.map(|error| text(error, error.advice()));
            let error = excess.map(ToString::to_string).or(why);
            let table = outcome.table.take().unwrap_or_else(|| Table::of(&job.columns));
            Self { table, error, end: outcome.kept.end(), outcome: Some(outcome) }
        })
    }

    /// Runs a job without summary data. `None` if it takes too long, or if its tables do not contain all rows and
    /// events.
    fn brief(job: &Job, watcher: &dyn Watcher) -> Option<Self> {
        let written = &job.scenario.written;
        let has_all = written.window == [0.0, f64::INFINITY] && written.digits.is_none();
        let events = &written.events;
        if !has_all
            || events.kinds.is_some()
            || events.contacts.is_some()
            || job.scenario.memory_limit.is_some()
            || job.scenario.plan.limits.wall.is_some()
        {
            return None;
        }
        // Initial capacity only; the table grows if necessary.
        let rows = stickslip_drive::facts::rows(&job.scenario.plan).min(1e5) as usize;
        let mut watched = Brief {
            table: Table::of(&job.columns).with_room(rows),
            watcher,
            begun: Instant::now(),
            calls: 0,
            is_late: false,
        };
        let mut state = job.start.clone();
        let error = stickslip_drive::run(&job.model, &job.scenario.plan, &mut state, &mut watched).err();
        let has_all = !watched.is_late && watched.table.events().len() as u64 <= events.most;
        let error = error.map(|error| text(&error, error.advice()));
        has_all.then(|| Self { table: watched.table, error, end: state.time(), outcome: None })
    }
}

/// Records rows and events until the run takes too long.
struct Brief<'a> {
    table: Table,
    watcher: &'a dyn Watcher,
    begun: Instant,
    calls: u32,
    is_late: bool,
}

impl Record for Brief<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        self.table.take(entry);
    }

    fn wants(&self) -> Wants {
        Wants::bare_events()
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.calls = self.calls.wrapping_add(1);
        self.is_late |= self.calls.is_multiple_of(64) && self.begun.elapsed() > BRIEF;
        !self.is_late && self.watcher.goes_on()
    }
}

/// Result of a run.
#[pyclass(frozen, module = "stickslip._core")]
pub(crate) struct Run {
    job: Arc<Job>,
    outcome: Mutex<Option<Outcome>>,
    error: Option<(String, f64)>,
    /// Columns: name with unit, whether the values are codes of states, values.
    columns: Vec<(String, bool, Py<PyArray1<f64>>)>,
    events: Vec<Event>,
}

impl Run {
    /// Runs a job. An early end is reported in [`Self::error`].
    pub(crate) fn new(py: Python<'_>, job: &Arc<Job>) -> PyResult<Self> {
        let is_main = is_main(py)?;
        let ended = py.detach(|| {
            let signals = Signals::new(is_main);
            let ended = Ended::of(job, &signals);
            signals.take().map(|()| ended)
        })?;
        Ok(Self::of(py, job, ended))
    }

    /// Creates a result, with its columns moved into `NumPy` arrays.
    pub(crate) fn of(py: Python<'_>, job: &Arc<Job>, ended: Ended) -> Self {
        let Ended { table, error, end, outcome } = ended;
        let (channels, events) = (table.channels().to_vec(), table.events().to_vec());
        let has_words = |channel: &Channel| channel.is_state && !job.scenario.written.state_numbers;
        let columns = channels.into_iter().zip(table.into_columns()).map(|(channel, values)| {
            let is_state = has_words(&channel);
            (channel.name, is_state, values.into_pyarray(py).unbind())
        });
        Self {
            job: Arc::clone(job),
            outcome: Mutex::new(outcome),
            error: error.map(|error| (error, end)),
            columns: columns.collect(),
            events,
        }
    }

    /// Calls `of` with the data for summary and plots. Repeats the run if they were not kept.
    fn with_outcome<T>(
        &self,
        is_main: bool,
        of: impl FnOnce(&Outcome, &Signals) -> PyResult<T>,
    ) -> PyResult<T> {
        let mut outcome = lock(&self.outcome)?;
        let signals = Signals::new(is_main);
        let found = outcome.get_or_insert_with(|| {
            let mut outcome = self.job.run_with_table(&signals);
            // The columns are kept already.
            outcome.table = None;
            outcome
        });
        if let Err(error) = signals.take() {
            *outcome = None;
            return Err(error);
        }
        of(found, &signals)
    }
}

#[pymethods]
impl Run {
    /// Name with unit, name, unit, description, whether the values are codes of states, and values of each column.
    #[getter]
    #[allow(clippy::type_complexity, reason = "a tuple of a column for the Python side alone")]
    fn columns(
        &self,
        py: Python<'_>,
    ) -> Vec<(&str, &str, &'static str, &'static str, bool, Py<PyArray1<f64>>)> {
        let column = |(name, has_words, values): &'_ (String, bool, Py<PyArray1<f64>>)| {
            (names::unit(name), TRACE.text(name), *has_words, values.clone_ref(py))
        };
        let all = self.columns.iter().map(|one| (one.0.as_str(), names::bare(&one.0), column(one)));
        all.map(|(full, bare, (unit, text, has_words, values))| (full, bare, unit, text, has_words, values))
            .collect()
    }

    /// Time (s), source and kind of each event.
    #[getter]
    fn events(&self) -> Vec<(f64, String, &'static str)> {
        let waveforms = &self.job.scenario.scene.waveforms;
        let name = |w: usize| waveforms.get(w).map(|waveform| waveform.name.clone()).unwrap_or_default();
        let event =
            |event: &Event| (event.t, self.job.model.source_name(event.source, name), event.kind.name());
        self.events.iter().map(event).collect()
    }

    /// Number of events.
    #[getter]
    fn event_count(&self) -> usize {
        self.events.len()
    }

    /// Reason for an early end of the run and its time in s, or None.
    #[getter]
    fn error(&self) -> Option<(String, f64)> {
        self.error.clone()
    }

    /// Returns the content of `summary.json` without the files and the computing time.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        let is_main = is_main(py)?;
        py.detach(|| {
            self.with_outcome(is_main, |outcome, signals| {
                let (summary, _) = stickslip_study::summary(&self.job, outcome, &|| signals.goes_on());
                signals.take()?;
                summary.pretty().map_err(|error| RunError::new_err(error.to_string()))
            })
        })
    }

    /// Draws the plot of this name and returns the content of the picture file.
    fn picture<'p>(
        &self,
        py: Python<'p>,
        plot: &str,
        format: &str,
        theme: &str,
        scale: u32,
    ) -> PyResult<Bound<'p, PyBytes>> {
        let known = PlotName::ALL.into_iter().find(|known| known.name() == plot);
        let Some(plot) = known else {
            let names = PlotName::ALL.map(PlotName::name).join(", ");
            return Err(pyo3::exceptions::PyValueError::new_err(format!(
                "expected one of {names}, got {plot:?}"
            )));
        };
        let look = Look {
            formats: vec![if format == "svg" { Format::Svg } else { Format::Png }],
            themes: vec![if theme == "dark" { Colours::Dark } else { Colours::Light }],
            scale,
            ..Look::default()
        };
        let is_main = is_main(py)?;
        let bytes = py.detach(|| {
            if self.job.scenario.plots.contains(&plot) {
                return self.with_outcome(is_main, |outcome, _| drawn(&self.job, outcome, plot, &look));
            }
            // The data for this plot were not kept, so the run is repeated with it.
            let plots = [("plots".to_owned(), format!("[\"{}\"]", plot.name()))];
            let job = self.job.with(&plots).map_err(|error| refused(&error))?;
            let signals = Signals::new(is_main);
            let outcome = job.run_with_table(&signals);
            signals.take()?;
            drawn(&job, &outcome, plot, &look)
        })?;
        Ok(PyBytes::new(py, &bytes))
    }
}

fn drawn(job: &Job, outcome: &Outcome, plot: PlotName, look: &Look) -> PyResult<Vec<u8>> {
    // A run in memory writes no tables.
    let nowhere = || SealedTable::from(PathBuf::new());
    let insides =
        InsideTables { springs: nowhere(), memory: nowhere(), fields: nowhere(), friction: nowhere() };
    let sources = Sources { job, kept: &outcome.kept, insides };
    let pictures = draw_one(&sources, plot, look).map_err(|error| RunError::new_err(error.to_string()))?;
    let first = pictures.into_iter().next().map(|(_, bytes)| bytes);
    first.ok_or_else(|| RunError::new_err(format!("the run has no data for the plot {}", plot.name())))
}
