//! What a study will take, from some of its cases.

use super::quick::Shortcut;
use super::worker::{Fault, Worker};
use super::{Study, StudyError};
use schemars::JsonSchema;
use serde::Serialize;
use std::time::Instant;
use stickslip_quantity::Real;
use stickslip_run::Watcher;

/// Cases that are run for the forecast, evenly over the study.
const DRAWN: u64 = 10;
/// Least wall time that they are measured over, s: where a case takes microseconds they are run again and again.
const LEAST: f64 = 0.05;
/// Bytes of a number in a part, about: split by bytes and compressed, its sign and the high bits of its exponent take next to none.
const BYTES: u64 = 7;
/// Bytes of a part without rows, about.
const EMPTY: u64 = 2500;

/// What a study will take.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Forecast {
    /// number of cases
    pub cases: u64,
    /// number of parts
    pub chunks: u64,
    /// wall time of all cases on the number of threads, from ten of them
    pub expected_s: Real,
    /// wall time of one case on one thread: the mean of these ten
    pub case_s: Real,
    /// size of all parts, an estimate
    pub bytes: u64,
    /// number of parallel threads that is reckoned with
    pub threads: usize,
    /// of the ten cases those that failed, with the reason
    pub failed: Vec<(u64, String)>,
}

impl Study {
    /// What the study will take on so many threads.
    ///
    /// # Errors
    /// Somebody interrupted it.
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
        // The first one reads each number once, which a long study does not feel.
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
