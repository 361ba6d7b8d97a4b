//! Checked scenario with its runs and studies.

use crate::run::{Ended, Run};
use crate::sim::Sim;
use crate::watch::{Flag, Signals, is_main, wait};
use crate::{RunError, ScenarioError};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::available_parallelism;
use stickslip_contact::{NormalGiven, TangentialGiven};
use stickslip_run::linear::StateSpace;
use stickslip_run::theory::{self, Beside, Corner, History, Sheet, Subject, Tangential, Walk};
use stickslip_run::{Job, Watcher, folder::Folder};
use stickslip_scenario::{Report, Scenario as Read};
use stickslip_study::curve::holding::{self, Holding};
use stickslip_study::curve::{self, Curve, Kind, Range};
use stickslip_study::sensitivity::{self, Asked, Sensitivity};
use stickslip_study::steady::{self, Options};

type Pairs = Vec<(String, String)>;

/// A checked scenario.
#[pyclass(frozen, module = "stickslip._core")]
pub(crate) struct Scenario {
    pub(crate) job: Arc<Job>,
}

/// Exception for an invalid scenario, with its reports.
pub(crate) fn refused(error: &stickslip_scenario::ScenarioError) -> PyErr {
    Python::attach(|py| {
        let raised = ScenarioError::new_err(error.to_string());
        let reports: Vec<_> = error.reports().map(report).collect();
        // If the attribute cannot be set, the message remains.
        let _ = raised.value(py).call_method1("_set", (reports,));
        raised
    })
}

/// Path, line, column, message, help.
type Told = (String, Option<usize>, Option<usize>, String, Option<String>);

fn report(report: &Report) -> Told {
    let place = report.excerpt.as_ref().filter(|_| !report.is_override);
    let (line, column) = (place.map(|at| at.line), place.map(|at| at.column));
    (report.path.clone(), line, column, report.message.clone(), report.help.clone())
}

fn invalid(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Number of threads; 0 stands for all cores.
pub(crate) fn cores(threads: usize) -> usize {
    if threads > 0 { threads } else { available_parallelism().map_or(1, usize::from) }
}

fn stopped(error: impl ToString) -> PyErr {
    RunError::new_err(error.to_string())
}

impl Scenario {
    fn with(&self, py: Python<'_>, set: &[(String, String)]) -> PyResult<Job> {
        py.detach(|| self.job.with(set)).map_err(|error| refused(&error))
    }

    /// Copies the job for a study that owns it.
    fn again(&self, py: Python<'_>) -> PyResult<Job> {
        self.with(py, &[])
    }
}

#[pymethods]
impl Scenario {
    #[new]
    fn new(
        py: Python<'_>,
        text: &str,
        name: &str,
        stem: &str,
        folder: Option<&str>,
        set: Pairs,
    ) -> PyResult<Self> {
        let pairs: Vec<(&str, &str)> =
            set.iter().map(|(path, value)| (path.as_str(), value.as_str())).collect();
        let job = py.detach(|| {
            let scenario = Read::read(text, (name, "set"), folder.map(Path::new), &pairs)?;
            Job::new(scenario, stem.to_owned(), std::path::PathBuf::new())
        });
        job.map(|job| Self { job: Arc::new(job) }).map_err(|error| refused(&error))
    }

    fn set(&self, py: Python<'_>, set: Pairs) -> PyResult<Self> {
        Ok(Self { job: Arc::new(self.with(py, &set)?) })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.job.name
    }

    #[getter]
    fn title(&self) -> &str {
        self.job.title()
    }

    /// Returns the complete scenario as canonical JSON: SI numbers, with all defaults.
    fn resolved(&self) -> &str {
        &self.job.resolved
    }

    /// Returns kind and text of each warning.
    fn warnings(&self, py: Python<'_>) -> Vec<(&'static str, String)> {
        let warnings = py.detach(|| self.job.warnings());
        warnings.iter().map(|warning| (warning.kind, warning.to_string())).collect()
    }

    fn run(&self, py: Python<'_>) -> PyResult<Run> {
        Run::new(py, &self.job)
    }

    fn start(&self) -> PyResult<Sim> {
        Sim::new(&self.job)
    }

    fn info(&self, py: Python<'_>) -> PyResult<String> {
        let is_main = is_main(py)?;
        py.detach(|| {
            let signals = Signals::new(is_main);
            let info = stickslip_study::Info::of(&self.job, &|| signals.goes_on());
            signals.take()?;
            serde_json::to_string(&info).map_err(stopped)
        })
    }

    fn steady(&self, py: Python<'_>, tolerance: f64) -> PyResult<String> {
        if !(1e-13..=1e-6).contains(&tolerance) {
            return Err(invalid(format!("expected a tolerance from 1e-13 to 1e-6, got {tolerance}")));
        }
        wait(py, |flag: &Flag| {
            let options = Options { tolerance, goes_on: &|| flag.goes_on(), ..Options::default() };
            let found = steady::find(&self.job, &options)?;
            let aftermath = found.aftermath(&self.job, &options)?;
            Ok::<_, steady::SteadyError>(steady::Report::of(&self.job, &found, aftermath.as_ref()).line())
        })?
        .map_err(stopped)
    }

    /// Computes a curve given by its name, or over the parameter at a path, as JSON.
    #[allow(clippy::too_many_arguments, reason = "one for each keyword of Python's function")]
    fn curve(
        &self,
        py: Python<'_>,
        kind: &str,
        vary: Option<String>,
        range: Option<(String, String)>,
        points: usize,
        log: bool,
        tolerance: f64,
        threads: usize,
    ) -> PyResult<String> {
        let job = self.again(py)?;
        let ends = |unit: &str| {
            let text = range.as_ref().map(|(from, to)| format!("{from}..{to}"));
            text.map(|text| Range::ends(&text, unit).map_err(invalid)).transpose()
        };
        let values =
            |[from, to]: [f64; 2]| Range { from, to, points, decades: log }.values().map_err(invalid);
        if kind == holding::NAME {
            let holding = Holding::new(job, vary.as_deref()).map_err(invalid)?;
            let found = match ends(holding.variation.unit)? {
                Some(ends) => ends,
                None => holding.range().map_err(invalid)?,
            };
            let values = values(found)?;
            let traced = wait(py, |flag| {
                let points = holding.trace(&values, tolerance, cores(threads), flag)?;
                Ok::<_, curve::CurveError>(holding::json(&holding, &points))
            })?;
            return traced.map_err(invalid);
        }
        let kind = match vary {
            Some(path) => Kind::Vary(path),
            None => Kind::of_name(kind).ok_or_else(|| {
                invalid(format!(
                    "expected step-amplitude, speed-frequency, force-speed, step-load, preload or holding-force, got {kind:?}"
                ))
            })?,
        };
        let curve = Curve::new(job, kind).map_err(invalid)?;
        let asked = ends(curve.variation.unit)?;
        let found = match asked {
            Some(ends) => Some(ends),
            None => wait(py, |flag| curve.range(flag))?,
        };
        let values = values(found.ok_or_else(|| invalid(curve.no_range()))?)?;
        wait(py, |flag| {
            let mut traced = curve.trace(&values, cores(threads), flag);
            curve.mark(&mut traced, tolerance, cores(threads), flag)?;
            Ok::<_, curve::CurveError>(curve::json(&[(&curve, &traced)]))
        })?
        .map_err(invalid)
    }

    fn sensitivity(
        &self,
        py: Python<'_>,
        of: Vec<String>,
        to: Vec<String>,
        steady: bool,
        tolerance: f64,
        threads: usize,
    ) -> PyResult<String> {
        let job = self.again(py)?;
        let asked = Asked { of, to, steady, tolerance };
        wait(py, |flag| {
            let asked = Sensitivity::new(job, &asked, flag)?;
            let taken = asked.take(cores(threads), flag);
            Ok::<_, sensitivity::SensitivityError>(sensitivity::json(&asked, &taken))
        })?
        .map_err(invalid)
    }

    /// Computes a single contact and returns the results as JSON. Writes its tables to the folder `out`.
    #[allow(clippy::too_many_arguments, reason = "one for each keyword of Python's function")]
    fn contact(
        &self,
        py: Python<'_>,
        name: Option<&str>,
        normal: Option<(&str, f64)>,
        tangential: Option<(&str, f64)>,
        history: Option<&str>,
        points: usize,
        out: &str,
    ) -> PyResult<String> {
        let normal = normal.map(|(what, value)| match what {
            "indentation" => NormalGiven::Indentation(value),
            "radius" => NormalGiven::Radius(value),
            _ => NormalGiven::Force(value),
        });
        let tangential = tangential.map(|(what, value)| match what {
            "displacement" => TangentialGiven::Displacement(value),
            "stick_radius" => TangentialGiven::StickRadius(value),
            _ => TangentialGiven::Force(value),
        });
        py.detach(|| {
            let subject = Subject::find(&self.job, name)?;
            let normal = normal.unwrap_or_else(|| subject.pressed());
            let sheet = Sheet::of(&subject, normal, tangential, points)?;
            let history = match (history, &sheet.loading) {
                (Some(text), _) => History::parse(text)?,
                (None, found) => {
                    let corner = |u| Corner { normal: None, tangential: Tangential::Displacement(u) };
                    History { corners: found.iter().map(|found| corner(found.u.0)).collect() }
                }
            };
            let walk = Walk::of(&subject, normal, &history, false)?;
            let beside = Beside { pictures: &[], stale: Vec::new(), notes: Vec::new() };
            let folder = Folder::make(Path::new(out)).map_err(|error| theory_failure(out, error))?;
            theory::write(folder, &sheet, &walk, beside).map_err(|error| theory_failure(out, error))?;
            Ok::<_, theory::TheoryError>(theory::json(&sheet, None))
        })
        .map_err(invalid)
    }

    /// Returns the linear system with all contacts sticking, as JSON. `at` selects the indentation: start, least or
    /// most.
    fn linear(&self, py: Python<'_>, at: &str) -> PyResult<String> {
        let found = py.detach(|| match at {
            "least" => StateSpace::of(&self.job, |d| d.least),
            "most" => StateSpace::of(&self.job, |d| d.most),
            _ => StateSpace::of(&self.job, |d| d.start),
        });
        found.map_err(invalid).and_then(|found| serde_json::to_string(&found).map_err(stopped))
    }
}

fn theory_failure(path: &str, source: std::io::Error) -> theory::TheoryError {
    let words = stickslip_run::complaint::words(&source);
    theory::TheoryError::Write { path: path.to_owned(), words, source }
}

/// Runs scenarios on a number of threads; returns the results in their order.
#[pyfunction]
pub(crate) fn run_many(py: Python<'_>, scenarios: Vec<Py<Scenario>>, threads: usize) -> PyResult<Vec<Run>> {
    let jobs: Vec<Arc<Job>> = scenarios.iter().map(|scenario| Arc::clone(&scenario.get().job)).collect();
    let all = wait(py, |flag| {
        let next = AtomicUsize::new(0);
        let work = || {
            let mut own = Vec::new();
            while flag.goes_on() {
                let k = next.fetch_add(1, Ordering::Relaxed);
                let Some(job) = jobs.get(k) else { break };
                own.push((k, Ended::of(job, flag)));
            }
            own
        };
        let mut all = std::thread::scope(|scope| {
            let others: Vec<_> = (1..cores(threads).min(jobs.len())).map(|_| scope.spawn(work)).collect();
            let own = work();
            own.into_iter()
                .chain(others.into_iter().flat_map(|other| other.join().unwrap_or_default()))
                .collect::<Vec<_>>()
        });
        all.sort_by_key(|(k, _)| *k);
        all
    })?;
    Ok(all.into_iter().map(|(k, ended)| Run::of(py, &jobs[k], ended)).collect())
}
