//! Measured loops and comparisons of results.

use crate::RunError;
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::Path;
use stickslip_compare::{Comparison, Results, Terms};
use stickslip_record::{Named, Recipe};
use stickslip_run::measured::{How, Measured, table};

/// The cycles of a measured record, from a file or from arrays, as a CSV table; and whether the force was turned round.
#[pyfunction]
#[pyo3(signature = (file, names, arrays, period, normal_force, recipe))]
#[allow(clippy::type_complexity, reason = "one for each keyword of Python's function")]
pub(crate) fn measure(
    py: Python<'_>,
    file: Option<&str>,
    names: (Option<String>, Option<String>, Option<String>),
    arrays: Option<(Option<PyReadonlyArray1<'_, f64>>, PyReadonlyArray1<'_, f64>, PyReadonlyArray1<'_, f64>)>,
    period: Option<f64>,
    normal_force: Option<f64>,
    recipe: Option<&str>,
) -> PyResult<(String, bool)> {
    let invalid = |error: &dyn ToString| PyValueError::new_err(error.to_string());
    let mut measured = match (file, arrays) {
        (Some(file), _) => {
            let (time, displacement, force) = names;
            let named = Named { time, displacement, force, normal: None };
            let recipe = recipe.map(|text| Recipe::from_text(text, "recipe")).transpose();
            let recipe = recipe.map_err(|error| invalid(&error))?.unwrap_or_default().with(&named);
            Measured::read(Path::new(file), &recipe).map_err(|error| invalid(&error))?
        }
        (None, Some((t, u, force))) => {
            let list = |array: &PyReadonlyArray1<'_, f64>| array.as_array().to_vec();
            let (u, force) = (list(&u), list(&force));
            let has_time = t.is_some();
            let t = t.map_or_else(|| (0..u.len()).map(|k| k as f64).collect(), |t| list(&t));
            if t.len() != u.len() || force.len() != u.len() {
                let message = format!(
                    "expected arrays of one length, got {} times, {} displacements and {} forces",
                    t.len(),
                    u.len(),
                    force.len()
                );
                return Err(PyValueError::new_err(message));
            }
            Measured { file: "arrays".to_owned(), t, has_time, u, force, is_turned: false, notes: Vec::new() }
        }
        (None, None) => return Err(PyValueError::new_err("expected a file, or displacements and forces")),
    };
    py.detach(|| {
        let how = How { period, ..How::default() };
        let evaluated = measured.evaluate(&how).map_err(|error| invalid(&error))?;
        Ok((table(&evaluated.cycles, normal_force), measured.is_turned))
    })
}

/// The comparison of two folders of results as JSON.
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
