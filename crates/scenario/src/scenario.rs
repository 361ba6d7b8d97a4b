//! A scenario: the only door from a file to a scene and a plan.

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

/// Version of the form that this program reads.
const VERSION: u64 = 1;
/// Most warnings of one scenario.
const MAX_WARNINGS: usize = 20;

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
    /// Whether the motion that the drive would settle on is looked for beside its run: at all it costs, or not; by default at little cost.
    pub steady_motion: Option<bool>,
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
    /// Those of channels over a channel among them.
    pub own_plots: Vec<OwnPlot>,
    /// What is known of each actuator beside what the scene holds.
    pub stacks: Vec<Piezo>,
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
        Self::read(text, (name, "--set"), Some(base.as_ref()), overrides)
    }

    /// Reads a scenario that has no folder, such as one carried by a picture: it may name no files.
    ///
    /// # Errors
    /// Whatever is wrong with it, with its place.
    pub fn from_str_alone(text: &str, name: &str) -> Result<Self, ScenarioError> {
        Self::read(text, (name, "--set"), None, &[])
    }

    /// The same scenario, read again with further overrides after its own.
    ///
    /// # Errors
    /// Whatever is wrong with one of them, with its place.
    pub fn with(&self, set: &[(String, String)]) -> Result<Self, ScenarioError> {
        let Document { sources, word, base, .. } = &self.document;
        let overrides = sources.iter().filter(|source| source.kind == SourceKind::Override);
        let own = overrides.filter_map(|source| source.name.split_once('='));
        let all: Vec<_> =
            own.chain(set.iter().map(|(path, value)| (path.as_str(), value.as_str()))).collect();
        Self::read(&sources[0].text, (&sources[0].name, word), base.as_deref(), &all)
    }

    /// Reads a scenario from a text: `name` stands in errors, which call overrides by `word`; files are looked for in `base`, and there
    /// may be none without it. Overrides are pairs as in [`Self::load_with`].
    ///
    /// # Errors
    /// Whatever is wrong with the text or an override, with its place.
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
        Err(ScenarioError::from(self.document.report(fault)).without(&[Stage::Equilibrium, Stage::Limits]))
    }

    /// The scenario as canonical JSON: SI numbers, overrides applied, defaults written out, tables inlined. Read back, it
    /// means the same to the last bit.
    pub fn resolved(&self) -> String {
        // The form holds finite numbers and string keys only: serde_json has nothing to refuse.
        serde_json::to_value(&self.form).map(|value| resolved::print(&value)).unwrap_or_default()
    }

    /// What the scene or the plan is refused for, pointed into the file, and what else is.
    pub fn refusal(&self, error: &SceneError) -> ScenarioError {
        let fault = meaning::refused::fault(&self.scene, self.plan, error);
        mistakes::all(self.document.clone(), vec![fault])
    }

    /// What is wrong with another plan than the scenario's own, such as a stepper from a command line; it has no place in the file.
    pub fn refusal_of(&self, plan: Plan, error: &SceneError) -> Report {
        self.document.report(meaning::refused::fault(&self.scene, plan, error))
    }

    /// The places of the columns that are asked for among all channels; none where all are. Those that pictures are drawn over are
    /// known, too.
    ///
    /// # Errors
    /// Names that none of them has, or one twice.
    pub fn columns(&self, channels: &[Channel]) -> Result<Option<Vec<usize>>, ScenarioError> {
        let asked = self.channels.as_ref().map(|names| meaning::channels::places(names, channels));
        let drawn = meaning::plots::check(&self.own_plots, channels);
        let places = asked.transpose().and_then(|places| drawn.map(|()| places));
        places.map_err(|fault| mistakes::all(self.document.clone(), vec![fault]))
    }

    /// Something odd that a later check finds, pointed into the file; `path` as in the file, such as `contacts.ball.normal`.
    pub fn warning(&self, kind: &'static str, path: &str, message: String, help: &str) -> Warning {
        Warning { kind, report: self.locate(path, message, Some(help.to_owned())).into_first() }
    }

    /// An error of a later check, pointed into the file: `path` as in the file, such as `contacts.ball.friction`.
    pub fn locate(&self, path: &str, message: impl Into<String>, help: Option<String>) -> ScenarioError {
        let steps = KeyPath::parse(path).unwrap_or_default();
        let report = self.document.report(Fault::new(steps, message).maybe_help(help));
        ScenarioError::from(Report { path: path.to_owned(), ..report })
    }
}

/// A form and what it means.
pub(crate) struct Interpreted {
    pub(crate) form: Form,
    /// Whether points of its tables lie in files.
    pub(crate) inlined: bool,
    pub(crate) meaning: Meaning,
}

/// Gives a document its meaning, or the first thing that is wrong with it.
pub(crate) fn interpret(document: &mut Document) -> Result<Interpreted, Fault> {
    formed(document).and_then(|form| meant(document, form))
}

/// Every value by itself, or the first that is wrong.
pub(crate) fn formed(document: &Document) -> Result<Form, Fault> {
    check_version(document)?;
    let mut form: Form = serde_path_to_error::deserialize(Reader(&document.value))
        .map_err(|error| refusal::fault(document, &error))?;
    named::fill(&mut form);
    Ok(form)
}

/// What values are to each other, or the first that does not fit.
pub(crate) fn meant(document: &mut Document, mut form: Form) -> Result<Interpreted, Fault> {
    let inlined = tables::inline(&mut form, document)?;
    let mut meaning = meaning::of(&form)?;
    if meaning::shown::fill(&mut form, &meaning, |key| document.value.get(key).is_some()) {
        meaning = meaning::of(&form)?;
    }
    Ok(Interpreted { form, inlined, meaning })
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

/// The text of a file.
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
        let help = "long tables fit into a CSV file of their own";
        failed(format!("a scenario has at most {limit} bytes, this file has more"), Some(help))
    })?;
    text::decode(bytes).map_err(|garbled| {
        let span = Span { source: 0, start: garbled.range.start, end: garbled.range.end };
        let fault = Fault::new(KeyPath::default(), garbled.message).at_span(span).help(garbled.help);
        ScenarioError::from(Document::new(name, &garbled.text).report(fault)).unread()
    })
}

/// The version comes first: everything else may differ in another one.
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
            let one = at.fault(message).help("the version of the form, a number without quotes");
            Err(one.mend(Mend::With(VERSION.into())))
        }
        Some(version) => {
            let newer = version.as_f64().is_some_and(|v| v > VERSION as f64);
            let help =
                if newer { "this file needs a newer program" } else { "the version of the form, a number" };
            // In another version everything may mean something else.
            Err(at.expected(VERSION).help(help).mend(Mend::Nothing))
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
