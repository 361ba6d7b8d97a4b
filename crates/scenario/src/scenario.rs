//! A scenario: the only door from a file to a scene and a plan.

use crate::document::Document;
use crate::error::{Report, ScenarioError, Warning};
use crate::fault::Fault;
use crate::form::Form;
use crate::meaning::warnings::Oddity;
use crate::meaning::{self, FieldsOutput, Figures, MemoryOutput, SpringsOutput, Written};
use crate::path::{At, KeyPath};
use crate::place::Span;
use crate::reader::Reader;
use crate::{document, overrides, refusal, resolved, suggest, syntax, tables, text};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;
use stickslip_drive::{Plan, Scene, SceneError};

/// Version of the form that this program reads.
const VERSION: u64 = 1;
/// Most warnings of one scenario.
const MAX_WARNINGS: usize = 20;

/// A picture a scenario asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PlotName {
    /// The scene to scale: bodies, contacts, springs, forces, and what is free or follows a waveform.
    Layout,
    /// Tangential force over displacement of each contact.
    Loop,
    /// Positions over time.
    Trajectory,
    /// Energies over time, and what their books miss.
    Energy,
    /// Velocity over displacement, of every free coordinate.
    Phase,
    /// Events over time.
    Events,
    /// What every spring does over time: open, stick, slip forward or backward; from `springs.csv`.
    State,
    /// The memory curve of each contact at some moments, in its wedge; from `memory.csv`.
    Memory,
    /// Pressure, shear stress, displacement and slip under each contact at some moments, rings of stick and slip shaded; from
    /// `fields.csv`.
    Fields,
    /// Each contact as its row of springs at some moments, pressed and sheared; from `memory.csv`.
    Substitute,
    /// Friction work over radius and time; from `friction.csv`.
    Friction,
}

impl PlotName {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Layout,
        Self::Loop,
        Self::Trajectory,
        Self::Energy,
        Self::Phase,
        Self::Events,
        Self::State,
        Self::Memory,
        Self::Fields,
        Self::Substitute,
        Self::Friction,
    ];

    /// The name in the file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Layout => "layout",
            Self::Loop => "loop",
            Self::Trajectory => "trajectory",
            Self::Energy => "energy",
            Self::Phase => "phase",
            Self::Events => "events",
            Self::State => "state",
            Self::Memory => "memory",
            Self::Fields => "fields",
            Self::Substitute => "substitute",
            Self::Friction => "friction",
        }
    }
}

/// A scenario, read and checked.
#[derive(Debug, Clone)]
pub struct Scenario {
    /// A line for people; may be empty.
    pub title: String,
    /// What is there.
    pub scene: Scene,
    /// How it is run.
    pub plan: Plan,
    /// Whose period and whose motion make steps and speeds.
    pub figures: Figures,
    /// Columns of the trace; none: all.
    pub channels: Option<Vec<String>>,
    /// What every spring does over time, if asked for.
    pub springs: Option<SpringsOutput>,
    /// The memory curves, if asked for.
    pub memory: Option<MemoryOutput>,
    /// Stress and displacement under the contacts, if asked for.
    pub fields: Option<FieldsOutput>,
    /// Which of the rows and events are written, and how.
    pub written: Written,
    /// Most memory that the run may keep, B; none without a limit.
    pub memory_limit: Option<f64>,
    /// Pictures to draw.
    pub plots: Vec<PlotName>,
    /// What is allowed and probably not meant, with its place.
    pub warnings: Vec<Warning>,
    pub(crate) form: Form,
    document: Document,
}

impl Scenario {
    /// Reads a scenario file.
    ///
    /// # Errors
    /// Whatever is wrong with it, with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, ScenarioError> {
        Self::load_with(path, &[])
    }

    /// Reads a scenario file and overrides values: pairs of key path and value, as in `--set run.duration="20 ms"`.
    /// A value is JSON where it reads as JSON and a string otherwise.
    ///
    /// # Errors
    /// Whatever is wrong with the file or an override, with its place.
    pub fn load_with(path: impl AsRef<Path>, overrides: &[(&str, &str)]) -> Result<Self, ScenarioError> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let text = read(path, &name)?;
        let base = path.parent().unwrap_or(Path::new(""));
        Self::from_str_with(&text, &name, base, overrides)
    }

    /// Reads a scenario from a text; `name` stands in errors, `base` is the folder its files are looked for in.
    ///
    /// # Errors
    /// Whatever is wrong with it, with its place.
    pub fn from_str(text: &str, name: &str, base: impl AsRef<Path>) -> Result<Self, ScenarioError> {
        Self::from_str_with(text, name, base, &[])
    }

    /// [`Self::from_str`] with overrides as in [`Self::load_with`].
    ///
    /// # Errors
    /// Whatever is wrong with the text or an override, with its place.
    pub fn from_str_with(
        text: &str,
        name: &str,
        base: impl AsRef<Path>,
        overrides: &[(&str, &str)],
    ) -> Result<Self, ScenarioError> {
        Self::read(text, name, Some(base.as_ref()), overrides)
    }

    /// Reads a scenario that has no folder, such as one carried by a picture: it may name no files.
    ///
    /// # Errors
    /// Whatever is wrong with it, with its place.
    pub fn from_str_alone(text: &str, name: &str) -> Result<Self, ScenarioError> {
        Self::read(text, name, None, &[])
    }

    fn read(
        text: &str,
        name: &str,
        base: Option<&Path>,
        overrides: &[(&str, &str)],
    ) -> Result<Self, ScenarioError> {
        let mut document = Document::read(name, text)?;
        check_version(&document).map_err(|fault| document.report(fault))?;
        for (path, value) in overrides {
            overrides::apply(&mut document, path, value)?;
        }
        // Once more: an override may have touched it.
        check_version(&document).map_err(|fault| document.report(fault))?;
        let mut form: Form = serde_path_to_error::deserialize(Reader(&document.value))
            .map_err(|error| document.report(refusal::fault(&document, &error)))?;
        let inlined =
            tables::inline(&mut form, base, &mut document).map_err(|fault| document.report(fault))?;
        let meaning = meaning::of(&form).map_err(|fault| document.report(fault))?;
        let is_written = |path: &KeyPath| document.root.deepest(path).1 == path.0.len();
        let odd = meaning::warnings::of(&form, &meaning, is_written);
        let scenario = Self {
            title: form.title.clone(),
            scene: meaning.scene,
            plan: meaning.plan,
            figures: meaning.figures,
            channels: meaning.channels,
            springs: meaning.springs,
            memory: meaning.memory,
            fields: meaning.fields,
            written: meaning.written,
            memory_limit: meaning.memory_limit,
            plots: meaning.plots,
            warnings: warnings(&document, odd),
            form,
            document,
        };
        scenario.check_size(inlined)?;
        Ok(scenario)
    }

    /// What a run leaves as its scenario must be one that can be run.
    fn check_size(&self, inlined: bool) -> Result<(), ScenarioError> {
        if self.resolved().len() <= syntax::MAX_BYTES {
            return Ok(());
        }
        let (root, limit) = (At::ROOT, syntax::MAX_BYTES);
        let fault = if inlined {
            let message = format!("with its tables the scenario would have more than {limit} bytes");
            root.key("waveforms").fault(message).help("keep fewer points")
        } else {
            let message = format!("written out in full the scenario would have more than {limit} bytes");
            root.fault(message)
                .help("keep fewer parts and points; long tables fit into a CSV file of their own")
        };
        Err(self.document.report(fault).into())
    }

    /// The scenario as canonical JSON: SI numbers, overrides applied, defaults written out, tables inlined. Read back, it
    /// means the same to the last bit.
    pub fn resolved(&self) -> String {
        // The form holds finite numbers and string keys only: serde_json has nothing to refuse.
        serde_json::to_value(&self.form).map(|value| resolved::print(&value)).unwrap_or_default()
    }

    /// What the scene or the plan is refused for, pointed into the file.
    pub fn refusal(&self, error: &SceneError) -> ScenarioError {
        self.document.report(meaning::refused::fault(&self.scene, self.plan, error)).into()
    }

    /// Something odd that a later check finds, pointed into the file; `path` as in the file, such as `contacts.ball.normal`.
    pub fn warning(&self, kind: &'static str, path: &str, message: String, help: &str) -> Warning {
        let ScenarioError(report) = self.locate(path, message, Some(help.to_owned()));
        Warning { kind, report: *report }
    }

    /// An error of a later check, pointed into the file: `path` as in the file, such as `contacts.ball.friction`.
    pub fn locate(&self, path: &str, message: impl Into<String>, help: Option<String>) -> ScenarioError {
        let steps = KeyPath::parse(path).unwrap_or_default();
        let report = self.document.report(Fault::new(steps, message).maybe_help(help));
        ScenarioError::from(Report { path: path.to_owned(), ..report })
    }
}

/// Each warning looks up its line; a file full of oddities is told of the first.
fn warnings(document: &Document, odd: Vec<Oddity>) -> Vec<Warning> {
    let rest = odd.len().saturating_sub(MAX_WARNINGS);
    let told = |odd: Oddity| Warning { kind: odd.kind, report: document.report(odd.fault) };
    let mut warnings: Vec<Warning> = odd.into_iter().take(MAX_WARNINGS).map(told).collect();
    let place = |report: &Report| report.excerpt.as_ref().map(|excerpt| (excerpt.line, excerpt.column));
    warnings.sort_by_key(|warning| (warning.is_override, place(warning)));
    if let (Some(last), 1..) = (warnings.last_mut(), rest) {
        let (more, help) = (format!("{rest} more warnings are not shown"), &mut last.report.help);
        *help = Some(help.take().map_or(more.clone(), |help| format!("{help}; {more}")));
    }
    warnings
}

fn read(path: &Path, name: &str) -> Result<String, ScenarioError> {
    let failed = |message: String, help: Option<&str>| {
        ScenarioError::from(Report {
            file: name.to_owned(),
            is_override: false,
            excerpt: None,
            path: String::new(),
            message,
            help: help.map(str::to_owned),
        })
    };
    let limit = syntax::MAX_BYTES;
    let bytes = text::read(path, limit).map_err(|error| {
        let (message, help) = text::unreadable(path, &error);
        failed(message, help.as_deref())
    })?;
    let bytes = bytes.ok_or_else(|| {
        let help = "long tables fit into a CSV file of their own";
        failed(format!("a scenario has at most {limit} bytes, this file has more"), Some(help))
    })?;
    text::decode(bytes).map_err(|garbled| {
        let span = Span { source: 0, start: garbled.range.start, end: garbled.range.end };
        let fault = Fault::new(KeyPath::default(), garbled.message).at_span(span).help(garbled.help);
        Document::new(name, &garbled.text).report(fault).into()
    })
}

/// The version comes first: everything else may differ in another one.
fn check_version(document: &Document) -> Result<(), Fault> {
    let root = At::ROOT;
    let Some(entries) = document.value.as_object() else {
        return Err(root.fault("a scenario is a JSON object { … }"));
    };
    let at = root.key("stickslip");
    match entries.get("stickslip") {
        Some(version) if version.as_f64() == Some(VERSION as f64) => Ok(()),
        Some(Value::String(text)) => {
            let message = format!("expected {VERSION}, got \"{}\"", document::shown(text));
            Err(at.fault(message).help("the version of the form, a number without quotes"))
        }
        Some(version) => {
            let newer = version.as_f64().is_some_and(|v| v > VERSION as f64);
            let help =
                if newer { "this file needs a newer program" } else { "the version of the form, a number" };
            Err(at.expected(VERSION).help(help))
        }
        None => {
            let near = entries.keys().find(|key| suggest::slip(key, &["stickslip"]).is_some());
            let help = match near {
                Some(near) => format!("did you mean \"stickslip\" where \"{near}\" stands?"),
                None => "a scenario starts with { \"stickslip\": 1, the version of its form".to_owned(),
            };
            Err(root.missing("stickslip").help(help))
        }
    }
}
