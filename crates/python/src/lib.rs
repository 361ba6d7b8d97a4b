//! Extension module `stickslip._core`, the basis of the Python package `stickslip`.
//!
//! It exchanges texts and arrays; the Python API is implemented in `python/stickslip`. Modules in reading order:
//! `watch` (signals during long computations), `scenario`, `run`, `sim`, `study`, `tables` (measured loops, fits,
//! comparisons).

mod run;
mod scenario;
mod sim;
mod study;
mod tables;
mod watch;

use pyo3::prelude::*;

pyo3::import_exception!(stickslip._errors, ScenarioError);
pyo3::import_exception!(stickslip._errors, RunError);

/// Error message with its help, if there is any.
fn text(message: &impl ToString, help: &str) -> String {
    if help.is_empty() { message.to_string() } else { format!("{}\n   help: {help}", message.to_string()) }
}

/// Converts a text with or without a unit to a number in the SI unit.
#[pyfunction]
fn quantity(text: &str, unit: &str) -> PyResult<f64> {
    stickslip_scenario::quantity(text, unit).map_err(pyo3::exceptions::PyValueError::new_err)
}

/// Returns the JSON Schema of scenario files.
#[pyfunction]
fn schema() -> String {
    stickslip_scenario::schema()
}

#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<scenario::Scenario>()?;
    module.add_class::<run::Run>()?;
    module.add_class::<sim::Sim>()?;
    module.add_class::<study::Study>()?;
    module.add("STATES", run::states())?;
    module.add_function(wrap_pyfunction!(scenario::run_many, module)?)?;
    module.add_function(wrap_pyfunction!(tables::measure, module)?)?;
    module.add_function(wrap_pyfunction!(tables::fit, module)?)?;
    module.add_function(wrap_pyfunction!(tables::compare, module)?)?;
    module.add_function(wrap_pyfunction!(quantity, module)?)?;
    module.add_function(wrap_pyfunction!(schema, module)?)
}
