//! A scenario that was found good, with everything its run needs.

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
use stickslip_scenario::{Scenario, ScenarioError, Stage};
use thiserror::Error;

/// A checked scenario: no input can be wrong any more.
pub struct Job {
    /// The scenario's name: that of its file, without ending.
    pub name: String,
    /// Where its results go.
    pub folder: PathBuf,
    /// What is to be run.
    pub setting: Setting,
    /// Columns of the trace and the events.
    pub columns: Columns,
    /// Springs to write down of each contact, where any are asked for.
    pub grids: Vec<Option<Arc<Springs>>>,
    /// The scenario as it is run, in canonical JSON.
    pub resolved: String,
    /// SHA-256 of [`Self::resolved`], in hexadecimal digits.
    pub hash: String,
    /// Name and version of the program that computes the results, or did.
    pub program: String,
}

/// Why a file makes no job.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Refusal {
    /// Something in the scenario.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A file without a name to call the results by.
    #[error("{}: expected the name of a file", .0.display())]
    NoName(PathBuf),
    /// A file whose name, without its ending, is no name of a folder.
    #[error("{}: its results would go to \"{name}\", which is no folder of its own\n   help: give the file another name, such as drive.json", .file.display())]
    NoFolder {
        /// The file.
        file: PathBuf,
        /// Its name without ending.
        name: String,
    },
    /// Two files of one name.
    #[error("{}: its results would go to {}, like those of {}\n   help: give one of the files another name, or run them apart", .file.display(), .folder.display(), .other.display())]
    SameFolder {
        /// The later file.
        file: PathBuf,
        /// Where both would go.
        folder: PathBuf,
        /// The earlier file.
        other: PathBuf,
    },
}

/// What a job runs is asked for by its own names: `job.model`, `job.scenario`.
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
    /// Reads a scenario, builds it and checks everything that can be wrong with the input; writes nothing. Pairs in
    /// `set` are overrides; the results of `NAME.json` would go to `out/NAME`.
    ///
    /// # Errors
    /// Whatever is wrong with the scenario, with its place, or a file without a name.
    pub fn prepare(file: &Path, set: &[(String, String)], out: &Path) -> Result<Self, Refusal> {
        let overrides: Vec<(&str, &str)> = set.iter().map(|(p, v)| (p.as_str(), v.as_str())).collect();
        let scenario = Scenario::load_with(file, &overrides)?;
        let stem = file.file_stem().ok_or_else(|| Refusal::NoName(file.to_owned()))?;
        // That of "...json" is "..": its results would go, and their old pictures be removed, outside of the folder.
        if !matches!(Path::new(stem).components().collect::<Vec<_>>()[..], [Component::Normal(_)]) {
            return Err(Refusal::NoFolder {
                file: file.to_owned(),
                name: stem.to_string_lossy().into_owned(),
            });
        }
        Ok(Self::new(scenario, stem.to_string_lossy().into_owned(), out.join(stem))?)
    }

    /// Builds a scenario and checks everything that can still be wrong with it; `folder` is for its results, and may be empty
    /// where none are written.
    ///
    /// # Errors
    /// Whatever is wrong with the scenario, with its place.
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
        let estimates = [
            limits::check_rows(&scenario, channels.len()),
            limits::check_curves(&scenario),
            limits::check_fields(&scenario),
        ];
        // None of them depends on another.
        let wrong = started.as_ref().err().into_iter().chain(columns.as_ref().err()).cloned();
        let wrong = wrong.chain(estimates.into_iter().filter_map(Result::err));
        if let Some(error) = ScenarioError::joined(wrong) {
            // Memory is estimated of a whole job.
            return Err(error.without(&[Stage::Limits]));
        }
        let ((start, grids), columns) = (started?, columns?);
        let resolved = scenario.resolved();
        let hash = hash(&resolved);
        let program = this_program();
        let setting = Setting { scenario, model, start };
        let job = Self { name, folder, setting, columns, grids, resolved, hash, program };
        excess::check(&job)?;
        Ok(job)
    }

    /// The same job with further overrides after its own.
    ///
    /// # Errors
    /// Whatever is wrong with one of them, with its place.
    pub fn with(&self, set: &[(String, String)]) -> Result<Self, ScenarioError> {
        Self::new(self.scenario.with(set)?, self.name.clone(), self.folder.clone())
    }

    /// The same job as its results tell it: with the text and the program that they were computed from.
    pub fn with_origin(self, resolved: String, program: String) -> Self {
        Self { hash: hash(&resolved), resolved, program, ..self }
    }

    /// The scenario's title, or else its name.
    pub fn title(&self) -> &str {
        if self.scenario.title.is_empty() { &self.name } else { &self.scenario.title }
    }
}
