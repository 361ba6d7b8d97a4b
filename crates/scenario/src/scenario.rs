//! Scenario: the result of reading a file, with the model and the plan of the run.

use crate::document::{Document, SourceKind};
use crate::error::{Report, ScenarioError, Stage, Warning};
use crate::fault::{Fault, Mend};
use crate::form::Form;
use crate::meaning::warnings::Oddity;
use crate::meaning::{
    self, FieldsOutput, Figures, Meaning, MemoryOutput, OwnPlot, Piezo, SpringsOutput, Written,
};
use crate::path::{At, KeyPath};
use crate::place::Span;
use crate::plot_name::PlotName;
use crate::reader::Reader;
use crate::{document, mistakes, named, overrides, refusal, resolved, suggest, syntax, tables, text};
use serde_json::Value;
use std::path::Path;
use stickslip_drive::{Channel, Plan, Scene, SceneError};

/// Version of the file format that this program reads.
const VERSION: u64 = 1;
/// Maximum number of warnings of one scenario.
const MAX_WARNINGS: usize = 20;

/// Scenario that has been read and checked.
#[derive(Debug, Clone)]
pub struct Scenario {
    /// Title; may be empty.
    pub title: String,
    /// Model: bodies, contacts, springs, actuators, loads and waveforms.
    pub scene: Scene,
    /// Duration, time integrator and limits of the run.
    pub plan: Plan,
    /// Waveform and body that define periods and steps.
    pub figures: Figures,
    /// Whether the periodic orbit is computed in addition to the run: always, never, or by default only at low cost.
    pub steady_motion: Option<bool>,
    /// Columns of the trace; `None` for all.
    pub channels: Option<Vec<String>>,
    /// Output of spring states over time, if requested.
    pub springs: Option<SpringsOutput>,
    /// Output of memory curves, if requested.
    pub memory: Option<MemoryOutput>,
    /// Output of stresses and displacements under the contacts, if requested.
    pub fields: Option<FieldsOutput>,
    /// Selection and format of written rows and events.
    pub written: Written,
    /// Memory limit of the run, B; `None` for no limit.
    pub memory_limit: Option<f64>,
    /// Plots to draw.
    pub plots: Vec<PlotName>,
    /// User-defined plots of channels over a channel, which are part of `plots`.
    pub own_plots: Vec<OwnPlot>,
    /// Data of each actuator in addition to those in the model.
    pub stacks: Vec<Piezo>,
    /// Warnings about values that are allowed but implausible, with their positions.
    pub warnings: Vec<Warning>,
    pub(crate) form: Form,
    document: Document,
}

impl Scenario {
    /// Reads a scenario file.
    ///
    /// # Errors
    /// All errors of the file, with their positions.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, ScenarioError> {
        Self::load_with(path, &[])
    }

    /// Reads a scenario file and overrides values. Overrides are pairs of key path and value, as in `--set run.duration="20 ms"`. A value
    /// is parsed as JSON if it is JSON; otherwise it is a string.
    ///
    /// # Errors
    /// All errors of the file and the overrides, with their positions.
    pub fn load_with(path: impl AsRef<Path>, overrides: &[(&str, &str)]) -> Result<Self, ScenarioError> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let text = read(path, &name)?;
        let base = path.parent().unwrap_or(Path::new(""));
        Self::from_str_with(&text, &name, base, overrides)
    }

    /// Reads a scenario from a text. `name` is the file name in messages, `base` the folder of files that the scenario names.
    ///
    /// # Errors
    /// All errors of the text, with their positions.
    pub fn from_str(text: &str, name: &str, base: impl AsRef<Path>) -> Result<Self, ScenarioError> {
        Self::from_str_with(text, name, base, &[])
    }

    /// Reads a scenario like [`Self::from_str`], with overrides as in [`Self::load_with`].
    ///
    /// # Errors
    /// All errors of the text and the overrides, with their positions.
    pub fn from_str_with(
        text: &str,
        name: &str,
        base: impl AsRef<Path>,
        overrides: &[(&str, &str)],
    ) -> Result<Self, ScenarioError> {
        Self::read(text, (name, "--set"), Some(base.as_ref()), overrides)
    }

    /// Reads a scenario without a folder, such as one that is embedded in a plot. Such a scenario may not name files.
    ///
    /// # Errors
    /// All errors of the text, with their positions.
    pub fn from_str_alone(text: &str, name: &str) -> Result<Self, ScenarioError> {
        Self::read(text, (name, "--set"), None, &[])
    }

    /// Reads the same scenario again with additional overrides after its own.
    ///
    /// # Errors
    /// All errors of the overrides, with their positions.
    pub fn with(&self, set: &[(String, String)]) -> Result<Self, ScenarioError> {
        let Document { sources, word, base, .. } = &self.document;
        let overrides = sources.iter().filter(|source| source.kind == SourceKind::Override);
        let own = overrides.filter_map(|source| source.name.split_once('='));
        let all: Vec<_> =
            own.chain(set.iter().map(|(path, value)| (path.as_str(), value.as_str()))).collect();
        Self::read(&sources[0].text, (&sources[0].name, word), base.as_deref(), &all)
    }

    /// Reads a scenario from a text. `name` is the file name in messages, `word` the name of overrides, such as `--set`. `base` is the
    /// folder of files that the scenario names; without it, the scenario may not name files. Overrides are pairs as in
    /// [`Self::load_with`].
    ///
    /// # Errors
    /// All errors of the text and the overrides, with their positions.
    pub fn read(
        text: &str,
        (name, word): (&str, &'static str),
        base: Option<&Path>,
        overrides: &[(&str, &str)],
    ) -> Result<Self, ScenarioError> {
        let (mut document, mut faults) = Document::read(name, text)?;
        document.base = base.map(Path::to_owned);
        document.word = word;
        faults.extend(check_version(&document).err());
        for (path, value) in overrides {
            faults.extend(overrides::apply(&mut document, path, value));
        }
        if !faults.is_empty() {
            return Err(mistakes::all(document, faults));
        }
        let Interpreted { form, inlined, meaning } = match interpret(&mut document) {
            Ok(interpreted) => interpreted,
            Err(fault) => return Err(mistakes::all(document, vec![fault])),
        };
        let is_written = |path: &KeyPath| document.root.deepest(path).1 == path.0.len();
        let odd = meaning::warnings::of(&form, &meaning, is_written);
        let scenario = Self {
            title: form.title.clone(),
            scene: meaning.scene,
            plan: meaning.plan,
            figures: meaning.figures,
            steady_motion: form.figures.steady_motion,
            channels: meaning.channels,
            springs: meaning.springs,
            memory: meaning.memory,
            fields: meaning.fields,
            written: meaning.written,
            memory_limit: meaning.memory_limit,
            plots: meaning.plots,
            own_plots: meaning.own_plots,
            stacks: meaning.stacks,
            warnings: warnings(&document, odd),
            form,
            document,
        };
        scenario.check_size(inlined)?;
        Ok(scenario)
    }

    /// Checks that the resolved scenario, which a run writes, is small enough to be read again.
    fn check_size(&self, inlined: bool) -> Result<(), ScenarioError> {
        if self.resolved().len() <= syntax::MAX_BYTES {
            return Ok(());
        }
        let (root, limit) = (At::ROOT, syntax::MAX_BYTES);
        let fault = if inlined {
            let message = format!("the scenario including its tables would have more than {limit} bytes");
            root.key("waveforms").fault(message).help("keep fewer points")
        } else {
            let message = format!("written out in full the scenario would have more than {limit} bytes");
            root.fault(message).help("use fewer parts and points, or move long tables into CSV files")
        };
        Err(ScenarioError::from(self.document.report(fault)).without(&[Stage::Equilibrium, Stage::Limits]))
    }

    /// Returns the scenario as canonical JSON: SI numbers, overrides applied, defaults written out, tables inlined. Reading it gives the
    /// same model, bit for bit.
    pub fn resolved(&self) -> String {
        // The form contains only finite numbers and string keys, so serialization cannot fail.
        serde_json::to_value(&self.form).map(|value| resolved::print(&value)).unwrap_or_default()
    }

    /// Converts an error of model or plan to an error with positions in the file, together with all other errors of the file.
    pub fn refusal(&self, error: &SceneError) -> ScenarioError {
        let fault = meaning::refused::fault(&self.scene, self.plan, error);
        mistakes::all(self.document.clone(), vec![fault])
    }

    /// Converts an error of another plan, such as a plan with a time integrator from the command line. The report has no position in the
    /// file.
    pub fn refusal_of(&self, plan: Plan, error: &SceneError) -> Report {
        self.document.report(meaning::refused::fault(&self.scene, plan, error))
    }

    /// Returns the indices of the requested columns among all channels, or `None` if all are requested. The channels of user-defined
    /// plots are also checked.
    ///
    /// # Errors
    /// Unknown names, or a name that occurs twice.
    pub fn columns(&self, channels: &[Channel]) -> Result<Option<Vec<usize>>, ScenarioError> {
        let asked = self
            .channels
            .as_ref()
            .map(|names| meaning::channels::places(["output", "channels"], names, channels));
        let drawn = meaning::plots::check(&self.own_plots, channels);
        let places = asked.transpose().and_then(|places| drawn.map(|()| places));
        places.map_err(|fault| self.fault(fault))
    }

    /// Converts a fault of a later check to an error with its position in the file.
    pub(crate) fn fault(&self, fault: Fault) -> ScenarioError {
        mistakes::all(self.document.clone(), vec![fault])
    }

    /// Returns a warning of a later check, with its position in the file. `path` is a key path such as `contacts.ball.normal`.
    pub fn warning(&self, kind: &'static str, path: &str, message: String, help: &str) -> Warning {
        Warning { kind, report: self.locate(path, message, Some(help.to_owned())).into_first() }
    }

    /// Returns an error of a later check, with its position in the file. `path` is a key path such as `contacts.ball.friction`.
    pub fn locate(&self, path: &str, message: impl Into<String>, help: Option<String>) -> ScenarioError {
        let steps = KeyPath::parse(path).unwrap_or_default();
        let report = self.document.report(Fault::new(steps, message).maybe_help(help));
        ScenarioError::from(Report { path: path.to_owned(), ..report })
    }
}

/// Types of the keys, and the model made from them.
pub(crate) struct Interpreted {
    pub(crate) form: Form,
    /// Whether points of tables are in files.
    pub(crate) inlined: bool,
    pub(crate) meaning: Meaning,
}

/// Converts a document to model and plan, or returns the first error.
pub(crate) fn interpret(document: &mut Document) -> Result<Interpreted, Fault> {
    formed(document).and_then(|form| meant(document, form))
}

/// Reads each value by itself, or returns the first error.
pub(crate) fn formed(document: &Document) -> Result<Form, Fault> {
    check_version(document)?;
    let mut form: Form = serde_path_to_error::deserialize(Reader(&document.value))
        .map_err(|error| refusal::fault(document, &error))?;
    named::fill(&mut form);
    Ok(form)
}

/// Checks relations between values and builds model and plan, or returns the first error.
pub(crate) fn meant(document: &mut Document, mut form: Form) -> Result<Interpreted, Fault> {
    let inlined = tables::inline(&mut form, document)?;
    let mut meaning = meaning::of(&form)?;
    if meaning::shown::fill(&mut form, &meaning, |key| document.value.get(key).is_some()) {
        meaning = meaning::of(&form)?;
    }
    Ok(Interpreted { form, inlined, meaning })
}

/// Returns the first warnings with their positions, sorted by position.
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

/// Reads the text of a file.
pub(crate) fn read(path: &Path, name: &str) -> Result<String, ScenarioError> {
    let failed = |message: String, help: Option<&str>| {
        ScenarioError::from(Report {
            file: name.to_owned(),
            is_override: false,
            word: "",
            excerpt: None,
            path: String::new(),
            message,
            help: help.map(str::to_owned),
        })
        .unread()
    };
    let limit = syntax::MAX_BYTES;
    let bytes = text::read(path, limit).map_err(|error| {
        let (message, help) = text::unreadable(path, &error);
        failed(message, help.as_deref())
    })?;
    let bytes = bytes.ok_or_else(|| {
        let help = "move long tables into CSV files";
        failed(format!("a scenario has at most {limit} bytes, this file has more"), Some(help))
    })?;
    text::decode(bytes).map_err(|garbled| {
        let span = Span { source: 0, start: garbled.range.start, end: garbled.range.end };
        let fault = Fault::new(KeyPath::default(), garbled.message).at_span(span).help(garbled.help);
        ScenarioError::from(Document::new(name, &garbled.text).report(fault)).unread()
    })
}

/// Checks the version before all other keys, because other versions may have other keys.
fn check_version(document: &Document) -> Result<(), Fault> {
    let root = At::ROOT;
    let Some(entries) = document.value.as_object() else {
        return Err(root.fault("a scenario is a JSON object { … }").mend(Mend::Nothing));
    };
    if entries.contains_key("stickslip_study") && !entries.contains_key("stickslip") {
        let fault = root.key("stickslip_study").fault("this is a study, not a scenario").on_key();
        return Err(fault.help("`stickslip study run FILE` runs it").mend(Mend::Nothing));
    }
    let at = root.key("stickslip");
    match entries.get("stickslip") {
        Some(version) if version.as_f64() == Some(VERSION as f64) => Ok(()),
        Some(Value::String(text)) => {
            let message = format!("expected {VERSION}, got \"{}\"", document::shown(text));
            let one = at.fault(message).help("the version of the format, a number without quotes");
            Err(one.mend(Mend::With(VERSION.into())))
        }
        Some(version) => {
            let newer = version.as_f64().is_some_and(|v| v > VERSION as f64);
            let help = if newer {
                "this file needs a newer version of the program"
            } else {
                "the version of the format, a number"
            };
            // In another version, all keys may have other meanings.
            Err(at.expected(VERSION).help(help).mend(Mend::Nothing))
        }
        None => {
            let near = entries.keys().find(|key| suggest::slip(key, &["stickslip"]).is_some());
            let help = match near {
                Some(near) => format!("did you mean \"stickslip\" instead of \"{near}\"?"),
                None => "a scenario starts with { \"stickslip\": 1, the version of the format".to_owned(),
            };
            Err(root.missing("stickslip").help(help))
        }
    }
}
