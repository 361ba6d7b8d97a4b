//! What came of a run: columns, events, the summary, pictures.

use crate::scenario::refused;
use crate::watch::{Signals, is_main, lock};
use crate::{RunError, text};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use stickslip_drive::{Channel, Event, Record};
use stickslip_figures::{Colours, Format, Look, Sources, draw_one};
use stickslip_quantity::{columns::TRACE, names};
use stickslip_run::files::InsideTables;
use stickslip_run::{Job, Outcome, SealedTable, Table, Watcher};
use stickslip_scenario::PlotName;

/// Words of the states of a contact, by their codes.
pub(crate) fn states() -> Vec<&'static str> {
    (0..4).map(|code| stickslip_drive::state_name(f64::from(code))).collect()
}

/// How long a run may take that has no account of its periods: longer ones are not done twice where the summary is asked for.
const BRIEF: Duration = Duration::from_millis(50);

/// What a run left.
pub(crate) struct Ended {
    table: Table,
    /// Why it ended early.
    error: Option<String>,
    /// Time reached, s.
    end: f64,
    /// What the summary is made from; a brief run is repeated for it.
    outcome: Option<Outcome>,
}

impl Ended {
    /// Runs a job. Rows and events are those of its tables.
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

    /// The same of a run that takes no longer than it may, and whose tables have all rows and events.
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
        // What a brief run can have at most; more rows find their room.
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

/// Records rows and events until a run takes too long.
struct Brief<'a> {
    table: Table,
    watcher: &'a dyn Watcher,
    begun: Instant,
    calls: u32,
    is_late: bool,
}

impl Record for Brief<'_> {
    fn row(&mut self, values: &[f64]) {
        self.table.row(values);
    }

    fn event(&mut self, event: &Event, values: &[f64]) {
        self.table.event(event, values);
    }

    fn wants_event_rows(&self) -> bool {
        false
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.calls = self.calls.wrapping_add(1);
        self.is_late |= self.calls.is_multiple_of(64) && self.begun.elapsed() > BRIEF;
        !self.is_late && self.watcher.goes_on()
    }
}

/// A run that has ended.
#[pyclass(frozen, module = "stickslip._core")]
pub(crate) struct Run {
    job: Arc<Job>,
    outcome: Mutex<Option<Outcome>>,
    error: Option<(String, f64)>,
    /// Name with unit, whether it holds words, values.
    columns: Vec<(String, bool, Py<PyArray1<f64>>)>,
    events: Vec<Event>,
}

impl Run {
    /// Runs a job; what ends it early stands in [`Self::error`].
    pub(crate) fn new(py: Python<'_>, job: &Arc<Job>) -> PyResult<Self> {
        let is_main = is_main(py)?;
        let ended = py.detach(|| {
            let signals = Signals::new(is_main);
            let ended = Ended::of(job, &signals);
            signals.take().map(|()| ended)
        })?;
        Ok(Self::of(py, job, ended))
    }

    /// With the columns of a run moved into arrays.
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

    /// What the summary and pictures are made from.
    fn with_outcome<T>(
        &self,
        is_main: bool,
        of: impl FnOnce(&Outcome, &Signals) -> PyResult<T>,
    ) -> PyResult<T> {
        let mut outcome = lock(&self.outcome)?;
        let signals = Signals::new(is_main);
        let found = outcome.get_or_insert_with(|| {
            let mut outcome = self.job.run_with_table(&signals);
            // The columns are there already.
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
    /// Name with unit, name, unit, text, whether it holds words, values of every column.
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

    /// Time, source and kind of every event.
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

    /// Why the run ended early, and when.
    #[getter]
    fn error(&self) -> Option<(String, f64)> {
        self.error.clone()
    }

    /// `summary.json` but for the files and the time taken.
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

    /// The program's picture of a name, as bytes.
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
            width: None,
        };
        let is_main = is_main(py)?;
        let bytes = py.detach(|| {
            if self.job.scenario.plots.contains(&plot) {
                return self.with_outcome(is_main, |outcome, _| drawn(&self.job, outcome, plot, &look));
            }
            // What this picture needs was not kept: the same run again, with it.
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
    // A run in memory has none of them.
    let nowhere = || SealedTable::from(PathBuf::new());
    let insides =
        InsideTables { springs: nowhere(), memory: nowhere(), fields: nowhere(), friction: nowhere() };
    let sources = Sources { job, kept: &outcome.kept, insides };
    let pictures = draw_one(&sources, plot, look).map_err(|error| RunError::new_err(error.to_string()))?;
    let first = pictures.into_iter().next().map(|(_, bytes)| bytes);
    first.ok_or_else(|| RunError::new_err(format!("{} has nothing to draw here", plot.name())))
}
