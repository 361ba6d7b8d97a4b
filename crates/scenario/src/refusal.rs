//! Converts errors of the deserializer to errors with message and path.

use crate::document::{Document, shown};
use crate::fault::{Fault, Mend};
use crate::guide::{Guide, Help};
use crate::misfit::{Misfit, Wanted};
use crate::path::{KeyPath, Step};
use crate::quantity::number_help;
use crate::suggest;
use serde_json::Value;
use serde_path_to_error::Segment;

/// Converts an error of the deserializer.
pub(crate) fn fault(document: &Document, error: &serde_path_to_error::Error<Misfit>) -> Fault {
    let refusal = Refusal { document, guide: document.guide, path: path(document, error.path()) };
    refusal.fault(error.inner()).of_shape()
}

/// Returns the part of a path that exists in the file; serde also counts variants that are bare strings.
fn path(document: &Document, path: &serde_path_to_error::Path) -> KeyPath {
    let steps = path.iter().map_while(|segment| match segment {
        Segment::Seq { index } => Some(Step::Index(*index)),
        Segment::Map { key } | Segment::Enum { variant: key } => Some(Step::Key(key.clone())),
        Segment::Unknown => None,
    });
    let mut path = KeyPath(steps.collect());
    path.0.truncate(depth(document, &path));
    path
}

/// Returns the number of steps of a path that exist in the document.
fn depth(document: &Document, path: &KeyPath) -> usize {
    let mut here = Some(&document.value);
    let mut enter = |step: &Step| {
        here = here.and_then(|value| match step {
            Step::Key(key) => value.get(key),
            Step::Index(index) => value.get(index),
        });
        here.is_some()
    };
    path.0.iter().take_while(|step| enter(step)).count()
}

/// Value that does not fit, with its path.
struct Refusal<'a> {
    document: &'a Document,
    guide: &'static Guide,
    path: KeyPath,
}

impl Refusal<'_> {
    fn fault(self, misfit: &Misfit) -> Fault {
        match misfit {
            Misfit::UnknownKey { name, known } => self.unknown_key(name, known),
            Misfit::UnknownKind(name) => self.unknown_kind(name),
            Misfit::Missing(name) => Fault::missing(self.path, name),
            Misfit::NotOneKind => self.not_one_kind(),
            Misfit::Unfit(wanted) => self.unfit(wanted),
            Misfit::Length { wanted, got } => {
                Fault::new(self.path, format!("expected {wanted}, got {got} entries")).ask(Help::Shape)
            }
            Misfit::Said { message, help } => self.said(message, help.clone()),
        }
    }

    fn said(self, message: &str, help: Option<String>) -> Fault {
        let follow = self.follow_help();
        let ask = if self.value().is_some_and(Value::is_array) { Help::Shape } else { Help::Meaning };
        Fault::new(self.path, message).maybe_help(help).maybe_help(follow).ask(ask)
    }

    fn unknown_key(mut self, name: &str, known: &[&str]) -> Fault {
        let step = Step::Key(name.to_owned());
        let mut parent = self.path.clone();
        parent.0.pop_if(|last| *last == step);
        self.path = parent.clone();
        self.path.0.push(step);
        self.path.0.truncate(depth(self.document, &self.path));
        let known: Vec<&str> = known.iter().copied().filter(|key| self.guide.knows(&parent, key)).collect();
        let help = suggest::slip(name, &known).or_else(|| self.elsewhere(&parent, name, &known));
        let fault = Fault::new(self.path, "unknown key").on_key().maybe_help(help);
        let Some(meant) = suggest::meant(name, &known) else { return fault.mend(Mend::Stray) };
        parent.0.push(Step::Key(meant.to_owned()));
        fault.mend(Mend::Rename(meant.to_owned())).against_path(parent)
    }

    /// Returns help for an unknown key: the keys allowed in its object, and the objects that allow this key.
    fn elsewhere(&self, parent: &KeyPath, name: &str, known: &[&str]) -> Option<String> {
        let here = suggest::help("", known.iter().copied());
        match self.guide.homes(parent, name).as_slice() {
            [] => here,
            homes => {
                let homes = format!("\"{name}\" is a key of {}", homes.join(", "));
                Some(here.map(|here| format!("{homes}; {here}")).unwrap_or(homes))
            }
        }
    }

    fn unknown_kind(mut self, name: &str) -> Fault {
        let kinds = self.guide.kinds(&self.path);
        let known: Vec<&str> = kinds.iter().map(String::as_str).collect();
        let help = suggest::slip(name, &known);
        let follow = self.follow_help();
        let step = Step::Key(name.to_owned());
        self.path.0.push(step);
        let is_key = depth(self.document, &self.path) == self.path.0.len();
        if !is_key {
            self.path.0.pop();
        }
        let message = format!("expected {}, got \"{}\"", one_of(&kinds), shown(name));
        let ask = if is_key { Help::None } else { Help::Shape };
        let fault = Fault::new(self.path, message).maybe_help(help).maybe_help(follow).ask(ask);
        match suggest::meant(name, &known) {
            Some(meant) if is_key => fault.on_key().mend(Mend::Rename(meant.to_owned())),
            Some(meant) => fault.mend(Mend::With(meant.into())),
            None if is_key => fault.on_key(),
            None => fault,
        }
    }

    fn unfit(self, wanted: &Wanted) -> Fault {
        let kinds;
        let (called, ask) = match wanted {
            Wanted::Number => ("a number", Help::Meaning),
            Wanted::WholeNumber => ("a whole number", Help::Meaning),
            Wanted::Text => ("a string in double quotes", Help::Meaning),
            Wanted::List => ("a list", Help::Shape),
            Wanted::Object => ("an object", Help::Shape),
            Wanted::Shape(called) => (called.as_str(), Help::Shape),
            // The description of the visitor is complete.
            Wanted::Name(called) => (called.as_str(), Help::None),
            Wanted::Value(called) => (called.as_str(), Help::Meaning),
            Wanted::Kind => {
                kinds = one_of(&self.guide.kinds(&self.path));
                (kinds.as_str(), Help::Shape)
            }
            Wanted::Nothing => return self.with_inside(),
            Wanted::Inside => return self.without_inside(),
        };
        let message = match self.came() {
            Some(written) => format!("expected {called}, got {written}"),
            None => format!("expected {called}"),
        };
        let is_number = matches!(wanted, Wanted::Number | Wanted::WholeNumber);
        let quoted = || self.number_in_quotes().filter(|_| is_number);
        let help = self.follow_help().or_else(quoted).or_else(|| self.unnamed());
        let unnamed = self.unnamed().is_some();
        let section = KeyPath(self.path.0.iter().take(1).cloned().collect());
        let fault = Fault::new(self.path, message).maybe_help(help).ask(ask);
        if unnamed { fault.mend(Mend::Around(section)) } else { fault }
    }

    /// Returns the error for a variant that has contents although it allows none.
    fn with_inside(self) -> Fault {
        let kind = match self.path.0.last() {
            Some(Step::Key(kind)) => shown(kind),
            Some(Step::Index(_)) | None => String::new(),
        };
        Fault::new(self.path, format!("expected \"{kind}\" alone, without an object around it")).on_key()
    }

    /// Returns the error for a variant without its contents.
    fn without_inside(self) -> Fault {
        let kind = self.value().and_then(Value::as_str).unwrap_or("");
        let example = self.guide.example_of(&self.path, kind);
        let kind = shown(kind);
        let message = format!("expected an object such as {{\"{kind}\": …}}, got \"{kind}\"");
        Fault::new(self.path, message).maybe_help(example.map(|example| format!("write {example}")))
    }

    /// Returns the error for an object with no key or several keys, where exactly one key selects the variant.
    fn not_one_kind(mut self) -> Fault {
        let kinds = self.guide.kinds(&self.path);
        let given: Vec<String> = match self.value() {
            Some(Value::Object(entries)) => entries.keys().cloned().collect(),
            _ => Vec::new(),
        };
        let message = match given.as_slice() {
            [] => format!("expected {}, got an empty object", one_of(&kinds)),
            given => format!("expected one key, the kind, got {}", shown(&given.join(", "))),
        };
        let (known, strange): (Vec<_>, Vec<_>) = given.into_iter().partition(|key| kinds.contains(key));
        let (wrong, help) = match (known.as_slice(), strange.first()) {
            ([], None) => return Fault::new(self.path, message).on_key().ask(Help::Shape),
            ([], Some(_)) => {
                let help = format!("the kind is a key: {}", kinds.join(", "));
                let example = kinds.first().and_then(|kind| self.guide.example_of(&self.path, kind));
                let help = example.map(|example| format!("{help}; such as {example}"));
                return Fault::new(self.path, message).on_key().maybe_help(help);
            }
            ([kind], Some(strange)) => {
                (strange, format!("\"{}\" is not possible together with \"{kind}\"", shown(strange)))
            }
            ([_, second, ..], _) => (second, "keep one of them".to_owned()),
            ([only], None) => (only, "keep one of them".to_owned()),
        };
        self.path.0.push(Step::Key(wrong.clone()));
        Fault::new(self.path, message).on_key().help(help)
    }

    /// Returns help for a number in quotes where no unit is expected, or for a text that is not a number.
    fn number_in_quotes(&self) -> Option<String> {
        let text = self.value()?.as_str()?.trim();
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Some("write the number without quotes".to_owned()),
            _ => number_help(text).map(str::to_owned),
        }
    }

    /// Returns help for a key of a part in the position of the part's name.
    fn unnamed(&self) -> Option<String> {
        let [Step::Key(parts), Step::Key(name)] = self.path.0.as_slice() else { return None };
        let inside = KeyPath(vec![Step::Key(parts.clone()), Step::Key("NAME".to_owned())]);
        let named = self.guide.knows(&inside, name);
        named.then(|| format!("each part has a name: \"{parts}\": {{\"NAME\": {{\"{name}\": …}}}}"))
    }

    /// Returns the value as in the file, with strings in quotes.
    fn came(&self) -> Option<String> {
        let written = self.document.written(&self.path)?;
        // Overrides contain strings without quotes.
        let is_string = self.value().is_some_and(Value::is_string);
        Some(if is_string { format!("\"{written}\"") } else { written })
    }

    fn value(&self) -> Option<&Value> {
        self.path.0.iter().try_fold(&self.document.value, |value, step| match step {
            Step::Key(key) => value.get(key),
            Step::Index(index) => value.get(index),
        })
    }

    /// Returns help for the name of a waveform where a quantity is expected.
    fn follow_help(&self) -> Option<String> {
        let text = self.value()?.as_str()?;
        self.document.value.get("waveforms")?.get(text)?;
        Some(format!("to follow the waveform write {{\"follows\": \"{text}\"}}"))
    }
}

fn one_of(kinds: &[String]) -> String {
    match kinds {
        [] => "another value".to_owned(),
        [one] => format!("\"{one}\""),
        all => format!("one of {}", all.join(", ")),
    }
}
