//! A job: a checked scenario with its model, initial state and output settings.

use crate::columns::Columns;
use crate::excess;
use crate::limits;
use crate::program::this_program;
use crate::seal::hash;
use std::ops::{Deref, DerefMut};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use stickslip_contact::Springs;
use stickslip_drive::{Model, SceneError};
use stickslip_measure::Setting;
use stickslip_scenario::{Interface, Scenario, ScenarioError, Stage};
use thiserror::Error;

/// A checked scenario, ready to run.
pub struct Job {
    /// Name of the scenario: its file name without extension.
    pub name: String,
    /// Folder for the results.
    pub folder: PathBuf,
    /// Scenario, model and initial state.
    pub setting: Setting,
    /// Columns of the trace and the event table.
    pub columns: Columns,
    /// Inputs, outputs and parameters that another program sees.
    pub interface: Interface,
    /// Springs of each contact that are written to `springs.csv`, if requested.
    pub grids: Vec<Option<Arc<Springs>>>,
    /// Resolved scenario in canonical JSON.
    pub resolved: String,
    /// SHA-256 of [`Self::resolved`] in hexadecimal digits.
    pub hash: String,
    /// Name and version of the program that computes or computed the results.
    pub program: String,
}

/// Error of preparing a job.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Refusal {
    /// The scenario is invalid.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The path contains no file name.
    #[error("{}: expected a file name", .0.display())]
    NoName(PathBuf),
    /// The file name without extension cannot be a folder name.
    #[error("{}: \"{name}\" cannot be the name of its results folder\n   help: give the file another name, such as drive.json", .file.display())]
    NoFolder {
        /// Path of the file.
        file: PathBuf,
        /// File name without extension.
        name: String,
    },
    /// Two scenario files have the same results folder.
    #[error("{}: its results folder {} is also that of {}\n   help: rename one of the files, or run them separately", .file.display(), .folder.display(), .other.display())]
    SameFolder {
        /// Path of the later file.
        file: PathBuf,
        /// Results folder of both files.
        folder: PathBuf,
        /// Path of the earlier file.
        other: PathBuf,
    },
}

/// Makes the fields of `job.setting` accessible as `job.model`, `job.scenario` and `job.start`.
impl Deref for Job {
    type Target = Setting;

    fn deref(&self) -> &Setting {
        &self.setting
    }
}

impl DerefMut for Job {
    fn deref_mut(&mut self) -> &mut Setting {
        &mut self.setting
    }
}

impl Job {
    /// Reads a scenario and checks it. Nothing is written.
    ///
    /// The pairs of key and value in `set` override values of the file. The results folder of `NAME.json` is `out/NAME`.
    ///
    /// # Errors
    /// The scenario is invalid, or the file name cannot name a folder.
    pub fn prepare(file: &Path, set: &[(String, String)], out: &Path) -> Result<Self, Refusal> {
        let overrides: Vec<(&str, &str)> = set.iter().map(|(p, v)| (p.as_str(), v.as_str())).collect();
        let scenario = Scenario::load_with(file, &overrides)?;
        let stem = file.file_stem().ok_or_else(|| Refusal::NoName(file.to_owned()))?;
        // The stem of "...json" is "..". Results would then be written, and old plots removed, outside of the folder.
        if !matches!(Path::new(stem).components().collect::<Vec<_>>()[..], [Component::Normal(_)]) {
            return Err(Refusal::NoFolder {
                file: file.to_owned(),
                name: stem.to_string_lossy().into_owned(),
            });
        }
        Ok(Self::new(scenario, stem.to_string_lossy().into_owned(), out.join(stem))?)
    }

    /// Builds the model of a scenario and checks it. `folder` is the results folder. The path may be empty if no results are written.
    ///
    /// # Errors
    /// The scenario is invalid. The errors contain their positions in the file.
    pub fn new(scenario: Scenario, name: String, folder: PathBuf) -> Result<Self, ScenarioError> {
        let locate = |error: SceneError| scenario.refusal(&error);
        let model = Model::new(&scenario.scene).map_err(locate)?;
        let channels = model.channels();
        let started = model.start(&scenario.plan).map_err(locate).and_then(|start| {
            let grids = limits::grids(&scenario, &model, &start)?;
            Ok((start, grids))
        });
        let columns = scenario.columns(&channels).map(|chosen| match chosen {
            Some(places) => Columns::chosen(&channels, &places),
            None => Columns::all(&channels),
        });
        let interface = scenario.interface(&channels);
        let estimates = [
            limits::check_rows(&scenario, channels.len()),
            limits::check_curves(&scenario),
            limits::check_fields(&scenario),
        ];
        // Independent checks are all made, so that their errors are reported together.
        let wrong = started.as_ref().err().into_iter().chain(columns.as_ref().err());
        let wrong = wrong.chain(interface.as_ref().err()).cloned();
        let wrong = wrong.chain(estimates.into_iter().filter_map(Result::err));
        if let Some(error) = ScenarioError::joined(wrong) {
            // The memory is estimated for complete jobs only.
            return Err(error.without(&[Stage::Limits]));
        }
        let ((start, grids), columns, interface) = (started?, columns?, interface?);
        let resolved = scenario.resolved();
        let hash = hash(&resolved);
        let program = this_program();
        let setting = Setting { scenario, model, start };
        let job = Self { name, folder, setting, columns, interface, grids, resolved, hash, program };
        excess::check(&job)?;
        Ok(job)
    }

    /// Returns the job with additional overrides.
    ///
    /// # Errors
    /// An override is invalid.
    pub fn with(&self, set: &[(String, String)]) -> Result<Self, ScenarioError> {
        Self::new(self.scenario.with(set)?, self.name.clone(), self.folder.clone())
    }

    /// Returns the job with the resolved scenario and the program name that stored results contain.
    pub fn with_origin(self, resolved: String, program: String) -> Self {
        Self { hash: hash(&resolved), resolved, program, ..self }
    }

    /// Returns the title of the scenario, or its name if it has no title.
    pub fn title(&self) -> &str {
        if self.scenario.title.is_empty() { &self.name } else { &self.scenario.title }
    }
}
