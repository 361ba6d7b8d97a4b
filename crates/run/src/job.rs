//! A scenario that was found good, with everything its run needs.

use crate::columns::Columns;
use crate::excess;
use crate::limits;
use crate::marks::Marks;
use crate::plausibility;
use crate::program::this_program;
use crate::seal::hash;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use stickslip_contact::Springs;
use stickslip_drive::facts::{Setup, has_constant_load};
use stickslip_drive::scene::{Freedom, Normal, Side};
use stickslip_drive::{Accuracy, Model, SceneError, State, Stepper};
use stickslip_scenario::{Scenario, ScenarioError, Stage, Warning};
use thiserror::Error;

/// A checked scenario: no input can be wrong any more.
pub struct Job {
    /// The scenario's name: that of its file, without ending.
    pub name: String,
    /// Where its results go.
    pub folder: PathBuf,
    /// What is to be run.
    pub scenario: Scenario,
    /// Its constants, assembled.
    pub model: Model,
    /// The state at t = 0.
    pub start: State,
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
        let mut job = Self { name, folder, scenario, model, start, columns, grids, resolved, hash, program };
        if Marks::of(&job).are_dense {
            // Parts would wait for each other at every one of them: two damped sliders took ten times as long.
            job.model.keep_together();
            job.start = job.model.start(&job.scenario.plan).map_err(|error| job.scenario.refusal(&error))?;
        }
        excess::check(&job)?;
        Ok(job)
    }

    /// The same job as its results tell it: with the text and the program that they were computed from.
    pub fn with_origin(self, resolved: String, program: String) -> Self {
        Self { hash: hash(&resolved), resolved, program, ..self }
    }

    /// The scenario's title, or else its name.
    pub fn title(&self) -> &str {
        if self.scenario.title.is_empty() { &self.name } else { &self.scenario.title }
    }

    /// Number of identical contacts behind contact `c`.
    pub fn count(&self, c: usize) -> u32 {
        self.scenario.scene.contacts.get(c).map_or(1, |contact| contact.part.count)
    }

    /// What facts are told of.
    pub fn setup(&self) -> Setup<'_> {
        Setup { scene: &self.scenario.scene, model: &self.model, start: &self.start }
    }

    /// Whether the load of contact `c` never changes.
    pub fn has_constant_load(&self, c: usize) -> bool {
        self.scenario.scene.contacts.get(c).is_some_and(|contact| has_constant_load(&contact.part))
    }

    /// Whether the force of contact `c` follows from the way of its bodies along the slide alone.
    pub fn has_law_without_time(&self, c: usize) -> bool {
        self.has_constant_load(c) && !self.is_damped(c)
    }

    /// Whether contact `c` has damping of its own.
    pub fn is_damped(&self, c: usize) -> bool {
        self.scenario.scene.contacts.get(c).is_some_and(|contact| contact.part.interface.damping() > 0.0)
    }

    /// Whether a waveform of its scene jumps.
    pub(crate) fn has_jumps(&self) -> bool {
        self.scenario.scene.waveforms.iter().any(|waveform| waveform.part.has_jumps())
    }

    /// Whether nothing but friction loses energy beside contact `c`: no other damped contact, no damper, and no block.
    pub(crate) fn loses_nothing_beside(&self, c: usize) -> bool {
        let scene = &self.scenario.scene;
        let mut others = (0..scene.contacts.len()).filter(|other| *other != c);
        let dampers = scene.springs.iter().map(|it| it.part.damping);
        let mut dampers = dampers.chain(scene.actuators.iter().map(|it| it.part.damping));
        scene.blocks.is_empty() && !others.any(|other| self.is_damped(other)) && dampers.all(|it| it == 0.0)
    }

    /// Whether the bodies' motion presses contact `c`.
    pub fn is_coupled(&self, c: usize) -> bool {
        self.scenario.scene.contacts.get(c).is_some_and(|contact| contact.part.normal == Normal::Coupled)
    }

    /// Whether a body that is free along z presses contact `c`.
    pub fn is_pressed_freely(&self, c: usize) -> bool {
        let scene = &self.scenario.scene;
        let is_free = |side: &Side| match side {
            Side::Body(b) => scene.bodies.get(*b).is_some_and(|body| body.part.z.freedom == Freedom::Free),
            Side::Ground => false,
        };
        self.is_coupled(c)
            && scene.contacts.get(c).is_some_and(|contact| contact.part.between.iter().any(is_free))
    }

    /// Gross-slip displacement u_c (m) and normal force (N) of one contact of `c` at t = 0: in equilibrium, if the run
    /// starts there.
    pub fn contact_scale(&self, c: usize) -> (f64, f64) {
        let contact = self.model.contacts().zip(self.start.memories()).nth(c);
        contact.map_or((0.0, 0.0), |((_, law), memory)| {
            let d = memory.apex().d;
            (law.gross_slip_displacement(d), law.normal_force(d))
        })
    }

    /// Everything odd about the scenario: what its file alone tells, then what its scene comes to.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = self.scenario.warnings.clone();
        warnings.extend(plausibility::of(self));
        warnings
    }

    /// What is odd about the scenario if this stepper takes it in frames.
    pub fn warnings_of_frames(&self, stepper: Stepper) -> Vec<Warning> {
        plausibility::of_frames(self, stepper)
    }

    /// Name of the stepper that the run takes and its tolerance or step with that word.
    pub fn stepper(&self) -> (&'static str, &'static str, f64) {
        let stepper = self.model.effective(self.scenario.plan.stepper);
        match stepper.accuracy() {
            Accuracy::Tolerance(tolerance) => (stepper.name(), "tolerance", tolerance),
            Accuracy::Step(step) => (stepper.name(), "step_s", step),
            // The longest of its steps.
            Accuracy::Frame { length, error } => {
                (stepper.name(), "step_s", length / self.model.substeps(length, error))
            }
        }
    }
}
