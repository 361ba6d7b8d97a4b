//! Estimated time and size of a study, from some of its cases.

use super::quick::Shortcut;
use super::worker::{Fault, Worker};
use super::{Study, StudyError};
use schemars::JsonSchema;
use serde::Serialize;
use std::time::Instant;
use stickslip_quantity::Real;
use stickslip_run::Watcher;

/// Number of cases that are run for the estimate, evenly distributed over the study.
const DRAWN: u64 = 10;
/// Shortest total wall time of the cases for the estimate, s. Cases are repeated until this time is reached.
const LEAST: f64 = 0.05;
/// Mean number of bytes of a number in a compressed part.
const BYTES: u64 = 7;
/// Size of a part without rows, bytes.
const EMPTY: u64 = 2500;

/// Estimated time and size of a study.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Forecast {
    /// number of cases
    pub cases: u64,
    /// number of parts
    pub chunks: u64,
    /// estimated wall time of all cases on the given number of threads
    pub expected_s: Real,
    /// mean wall time of one case on one thread, from ten cases
    pub case_s: Real,
    /// estimated size of all parts in bytes
    pub bytes: u64,
    /// number of threads for which the time is estimated
    pub threads: usize,
    /// number and reason of each failed case among the ten
    pub failed: Vec<(u64, String)>,
}

impl Study {
    /// Estimates time and size of the study on a number of threads.
    ///
    /// # Errors
    /// The estimate was interrupted.
    pub fn forecast(&self, threads: usize, watcher: &(dyn Watcher + Sync)) -> Result<Forecast, StudyError> {
        let shortcut = Shortcut::of(self);
        let mut worker = Worker::new(self, shortcut.as_ref(), watcher);
        let drawn = self.cases().min(DRAWN);
        let cases: Vec<u64> =
            (0..drawn).map(|k| (k as f64 / drawn as f64 * self.cases() as f64) as u64).collect();
        let mut results = Vec::new();
        let mut failed = Vec::new();
        let mut pass = |failed: &mut Vec<(u64, String)>| -> Result<f64, StudyError> {
            let begun = Instant::now();
            for case in &cases {
                match worker.run(*case, &mut results) {
                    Ok(()) => {}
                    Err(Fault::Failed(why)) => failed.push((*case, why)),
                    Err(Fault::Interrupted) => return Err(StudyError::Interrupted),
                }
            }
            results.clear();
            Ok(begun.elapsed().as_secs_f64() / drawn as f64)
        };
        // The first pass includes reading the scenario, which takes negligible time in a long study.
        let first = pass(&mut failed)?;
        let mut rest = Vec::new();
        while first * drawn as f64 + rest.iter().sum::<f64>() * (drawn as f64) < LEAST {
            rest.push(pass(&mut Vec::new())?);
        }
        let case = if rest.is_empty() { first } else { rest.iter().sum::<f64>() / rest.len() as f64 };
        let columns = (self.design.axes.len() + self.wanted.len()) as u64;
        Ok(Forecast {
            cases: self.cases(),
            chunks: self.parts(),
            expected_s: Real(case * self.cases() as f64 / threads as f64),
            case_s: Real(case),
            bytes: self.cases() * columns * BYTES + self.parts() * EMPTY,
            threads,
            failed,
        })
    }
}
