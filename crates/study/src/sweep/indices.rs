//! Variance-based sensitivity indices (Sobol indices): fraction of the variance of a result that each parameter
//! explains.

use super::sobol_indices::{Accumulator, Index};
use super::{Study, StudyError};
use schemars::JsonSchema;
use serde::Serialize;
use std::path::{Path, PathBuf};
use stickslip_quantity::Real;
use stickslip_scenario::Sampling;

/// Sobol indices of all results.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Indices {
    /// estimators of the indices
    pub scheme: String,
    /// number N of base samples. For k parameters, N (k + 2) cases were run.
    pub samples: u64,
    /// number of base samples omitted because one of their cases has no such result, by result
    pub left_out: IndexTable<u64>,
    /// indices by result and by varied parameter: `first` (first-order index: fraction of the variance that the
    /// parameter explains alone), `total` (total index: fraction that remains if all other parameters are fixed), and
    /// their standard errors `first_error`, `total_error`
    pub indices: IndexTable<IndexTable<IndexOf>>,
}

/// Map from names to values, in order.
pub type IndexTable<T> = stickslip_run::Parts<T>;

/// Sobol indices of a result for one parameter.
#[derive(Debug, Clone, Copy, Serialize, JsonSchema)]
pub struct IndexOf {
    /// first-order index: fraction of the variance that the parameter explains alone
    pub first: Real,
    /// standard error of the first-order index
    pub first_error: Real,
    /// total index: fraction of the variance that remains if all other parameters are fixed
    pub total: Real,
    /// standard error of the total index
    pub total_error: Real,
}

impl Study {
    /// Returns the study with the cases for the indices, and the folder of its parts. A study with Saltelli's sampling is returned
    /// unchanged. For other samplings, the returned study has one base sample per sample of this study.
    ///
    /// # Errors
    /// The study has grids or lists, or no distribution.
    pub fn for_indices(&self, out: &Path) -> Result<(Self, PathBuf), StudyError> {
        let mut file = self.file.clone();
        if self.design.spreads == 0 {
            return Err(StudyError::Unasked(
                "indices need distributions; grids and lists have no variance".to_owned(),
            ));
        }
        let is_own = self.design.sampling == Sampling::Saltelli;
        file.sampling = Some(Sampling::Saltelli);
        let mut folder = out.as_os_str().to_owned();
        folder.push("-indices");
        let folder = if is_own { out.to_owned() } else { PathBuf::from(folder) };
        Ok((Self::new(file)?, folder))
    }

    /// Computes the indices from the parts of a study sampled by Saltelli's scheme.
    ///
    /// # Errors
    /// Parts are missing or cannot be read.
    pub fn indices(&self, folder: &Path) -> Result<Indices, StudyError> {
        self.check_complete(folder)?;
        let k = self.design.spreads;
        let (mut left_out, mut all) = (Vec::new(), Vec::new());
        for (result, wanted) in self.wanted.iter().enumerate().filter(|(_, wanted)| wanted.codes.is_none()) {
            let (mut accumulator, mut missing) = (Accumulator::new(k), 0);
            let mut block = Vec::with_capacity(k + 2);
            self.each_part(folder, |_, open| {
                for value in open.result(self, result)? {
                    block.push(value);
                    if block.len() < k + 2 {
                        continue;
                    }
                    if block.iter().all(|value| value.is_finite()) {
                        accumulator.take(block[0], block[k + 1], &block[1..=k]);
                    } else {
                        missing += 1;
                    }
                    block.clear();
                }
                Ok(())
            })?;
            let of = |index: Index| IndexOf {
                first: Real(index.first),
                first_error: Real(index.first_error),
                total: Real(index.total),
                total_error: Real(index.total_error),
            };
            let paths = self.design.axes.iter().map(|axis| axis.path.clone());
            let indices = paths.zip(accumulator.finish().into_iter().map(of)).collect();
            all.push((wanted.name.clone(), stickslip_run::Parts(indices)));
            left_out.push((wanted.name.clone(), missing));
        }
        if all.is_empty() {
            return Err(StudyError::Unasked(
                "indices need a numeric result; all results of this study are words".to_owned(),
            ));
        }
        Ok(Indices {
            scheme: "samples of the Sobol sequence by Saltelli's scheme; first order by Saltelli (2010), total by Jansen (1999)".to_owned(),
            samples: self.design.samples,
            left_out: stickslip_run::Parts(left_out),
            indices: stickslip_run::Parts(all),
        })
    }
}
