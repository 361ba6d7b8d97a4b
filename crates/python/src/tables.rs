//! Measured loops, fits, and comparisons of results.

use crate::RunError;
use crate::scenario::{Scenario, cores};
use crate::watch::wait;
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::Path;
use stickslip_compare::{Comparison, Results, Terms};
use stickslip_record::{Named, Recipe};
use stickslip_run::measured::{Correct, How, Measured, Rig, table};
use stickslip_study::fit::{Asked, fit as search};

/// Names of the columns of a file for time, displacement and force; the same as arrays.
type Names = (Option<String>, Option<String>, Option<String>);
type Arrays<'py> =
    (Option<PyReadonlyArray1<'py, f64>>, PyReadonlyArray1<'py, f64>, PyReadonlyArray1<'py, f64>);

/// Reads a measured record from a file or from arrays.
fn measured(
    file: Option<&str>,
    names: Names,
    arrays: Option<Arrays<'_>>,
    recipe: Option<&str>,
) -> PyResult<Measured> {
    let invalid = |error: &dyn ToString| PyValueError::new_err(error.to_string());
    match (file, arrays) {
        (Some(file), _) => {
            let (time, displacement, force) = names;
            let named = Named { time, displacement, force, normal: None };
            let recipe = recipe.map(|text| Recipe::from_text(text, "recipe")).transpose();
            let recipe = recipe.map_err(|error| invalid(&error))?.unwrap_or_default().with(&named);
            Measured::read(Path::new(file), &recipe).map_err(|error| invalid(&error))
        }
        (None, Some((t, u, force))) => {
            let list = |array: &PyReadonlyArray1<'_, f64>| array.as_array().to_vec();
            let (u, force) = (list(&u), list(&force));
            let has_time = t.is_some();
            let t = t.map_or_else(|| (0..u.len()).map(|k| k as f64).collect(), |t| list(&t));
            if t.len() != u.len() || force.len() != u.len() {
                let message = format!(
                    "expected arrays of equal length, got {} times, {} displacements and {} forces",
                    t.len(),
                    u.len(),
                    force.len()
                );
                return Err(PyValueError::new_err(message));
            }
            Ok(Measured {
                file: "arrays".to_owned(),
                t,
                has_time,
                u,
                force,
                normal: None,
                is_turned: false,
                notes: Vec::new(),
            })
        }
        (None, None) => Err(PyValueError::new_err("expected a file, or displacements and forces")),
    }
}

/// Evaluates a measured record. Returns its cycles as a CSV table, and its results with confidence intervals as JSON.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "one for each keyword of Python's function")]
pub(crate) fn measure(
    py: Python<'_>,
    file: Option<&str>,
    names: Names,
    arrays: Option<Arrays<'_>>,
    recipe: Option<&str>,
    period: Option<f64>,
    normal_force: Option<f64>,
    correct: (bool, bool),
    rig_stiffness: Option<f64>,
) -> PyResult<(String, String)> {
    let mut measured = measured(file, names, arrays, recipe)?;
    py.detach(|| {
        let (lag, drift) = correct;
        let rig = rig_stiffness.map(Rig::Stiffness);
        let how = How { period, correct: Correct { lag, drift }, rig, ..How::default() };
        let evaluated = measured.evaluate(&how).map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok((table(&evaluated.cycles, normal_force), evaluated.json(&measured).to_string()))
    })
}

/// Fits parameters of a scenario to a measured record; returns the fit as JSON.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "one for each keyword of Python's function")]
pub(crate) fn fit(
    py: Python<'_>,
    scenario: PyRef<'_, Scenario>,
    file: Option<&str>,
    names: Names,
    arrays: Option<Arrays<'_>>,
    recipe: Option<&str>,
    free: Vec<String>,
    channels: (Option<String>, Option<String>, Option<String>),
    noise: Option<f64>,
    bootstrap: usize,
    threads: usize,
) -> PyResult<String> {
    let mut measured = measured(file, names, arrays, recipe)?;
    let (contact, displacement, force) = channels;
    let asked = Asked { free, contact, displacement, force, noise, bootstrap };
    let job = scenario.job.clone();
    wait(py, |flag| search(&job, (&mut measured, &How::default()), &asked, (cores(threads), flag)))?
        .map(|fit| fit.json().to_string())
        .map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Compares two result folders; returns the comparison as JSON.
#[pyfunction]
pub(crate) fn compare(
    py: Python<'_>,
    folders: (String, String),
    exact: bool,
    tolerance: Option<f64>,
    absolute: Vec<(String, String)>,
    time_tolerance: Option<f64>,
    ignore: Vec<String>,
) -> PyResult<String> {
    py.detach(|| {
        let read = |folder: &str| {
            Results::read(Path::new(folder)).map_err(|error| PyValueError::new_err(error.to_string()))
        };
        let (a, b) = (read(&folders.0)?, read(&folders.1)?);
        let terms = Terms { exact, tolerance, absolute, time_tolerance, ignore };
        let (comparison, _) =
            Comparison::new(&a, &b, &terms).map_err(|error| PyValueError::new_err(error.to_string()))?;
        serde_json::to_string(&comparison).map_err(|error| RunError::new_err(error.to_string()))
    })
}
