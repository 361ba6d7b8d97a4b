//! Studies: many runs of a scenario with different parameters.

use crate::RunError;
use crate::scenario::{cores, refused};
use crate::watch::wait;
use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use std::path::{Path, PathBuf};
use stickslip_study::sweep::{self, Shard, StudyError};

/// Checked study.
#[pyclass(frozen, module = "stickslip._core")]
pub(crate) struct Study {
    study: sweep::Study,
}

fn failed(error: StudyError) -> PyErr {
    match error {
        StudyError::Scenario(error) => refused(&error),
        StudyError::Interrupted | StudyError::Damaged { .. } => RunError::new_err(error.to_string()),
        StudyError::Disk { .. } => PyOSError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

#[pymethods]
impl Study {
    /// Reads a study from a text, or from a file if there is no text.
    #[new]
    fn new(py: Python<'_>, text: Option<&str>, file: &str, stem: &str, folder: &str) -> PyResult<Self> {
        let study = py.detach(|| match text {
            Some(text) => sweep::Study::from_str(text, (file, stem), Path::new(folder)),
            None => sweep::Study::load(Path::new(file)),
        });
        study.map(|study| Self { study }).map_err(|error| refused(&error))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.study.job.name
    }

    #[getter]
    fn cases(&self) -> u64 {
        self.study.cases()
    }

    #[getter]
    fn parts(&self) -> u64 {
        self.study.parts()
    }

    #[getter]
    fn hash(&self) -> &str {
        &self.study.hash
    }

    /// Paths of the varied parameters.
    #[getter]
    fn varied(&self) -> Vec<&str> {
        self.study.varied().map(|(path, _)| path).collect()
    }

    /// Names of the results; for coded results also the words of the codes.
    #[getter]
    fn results(&self) -> Vec<(&str, Option<Vec<String>>)> {
        let results = self.study.results().enumerate();
        results.map(|(place, name)| (name, self.study.codes(place).map(<[String]>::to_vec))).collect()
    }

    fn portable(&self) -> String {
        self.study.portable()
    }

    fn overrides(&self, case: u64) -> PyResult<Vec<(String, String)>> {
        if case >= self.study.cases() {
            return Err(pyo3::exceptions::PyIndexError::new_err(format!(
                "case {case}: the study has {}",
                self.study.cases()
            )));
        }
        Ok(self.study.overrides(case))
    }

    /// Returns the number of existing parts, the indices of missing parts (damaged ones included), and the indices of
    /// damaged parts.
    fn status(&self, py: Python<'_>, out: PathBuf) -> PyResult<(u64, Vec<u64>, Vec<u64>)> {
        let status = py.detach(|| self.study.status(&out)).map_err(failed)?;
        Ok((status.parts, status.missing, status.damaged))
    }

    fn remove(&self, py: Python<'_>, out: PathBuf) -> PyResult<()> {
        py.detach(|| self.study.remove(&out)).map_err(failed)
    }

    /// Computes the missing parts of shard `index` (from 0) of `count`.
    fn run(&self, py: Python<'_>, out: PathBuf, index: u64, count: u64, threads: usize) -> PyResult<()> {
        let shard = Shard::new(index, count)
            .ok_or_else(|| PyValueError::new_err(format!("no shard {} of {count}", index + 1)))?;
        let ran = wait(py, |flag| self.study.run(&out, (shard, cores(threads)), flag))?.map_err(failed)?;
        if ran.interrupted { Err(failed(StudyError::Interrupted)) } else { Ok(()) }
    }

    fn forecast(&self, py: Python<'_>, threads: usize) -> PyResult<String> {
        let told = wait(py, |flag| self.study.forecast(cores(threads), flag))?.map_err(failed)?;
        text(&told)
    }

    fn statistics(&self, py: Python<'_>, out: PathBuf) -> PyResult<String> {
        text(&py.detach(|| self.study.statistics(&out)).map_err(failed)?)
    }

    fn indices(&self, py: Python<'_>, out: PathBuf, threads: usize) -> PyResult<String> {
        let found = wait(py, |flag| {
            let (study, out) = self.study.for_indices(&out)?;
            if study.run(&out, (Shard::WHOLE, cores(threads)), flag)?.interrupted {
                return Err(StudyError::Interrupted);
            }
            study.indices(&out)
        })?;
        text(&found.map_err(failed)?)
    }

    /// Returns a result for all cases: numbers or codes, NaN without a result.
    fn column<'py>(
        &self,
        py: Python<'py>,
        out: PathBuf,
        result: usize,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let column = py.detach(|| self.study.column(&out, result)).map_err(failed)?;
        Ok(column.into_pyarray(py))
    }

    fn errors(&self, py: Python<'_>, out: PathBuf) -> PyResult<Vec<Option<String>>> {
        py.detach(|| self.study.errors(&out)).map_err(failed)
    }

    /// Returns the values of the varied parameter with index `axis` for all cases.
    fn values<'py>(&self, py: Python<'py>, axis: usize) -> Bound<'py, PyArray1<f64>> {
        let all = py.detach(|| {
            let value = |case| self.study.values(case).get(axis).copied().unwrap_or(f64::NAN);
            (0..self.study.cases()).map(value).collect::<Vec<f64>>()
        });
        all.into_pyarray(py)
    }
}

fn text(told: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_string(told).map_err(|error| RunError::new_err(error.to_string()))
}
