//! Finds all errors of a scenario and suppresses follow-on errors.
//!
//! Reading stops at the first error. The search then replaces the invalid value by a valid one and reads the scenario again, until no
//! error remains. An error whose check depended on a replaced value may be a follow-on error and is not reported. A scenario without
//! errors is read only once, and no check has to handle incomplete scenarios.

use crate::document::Document;
use crate::error::{Beyond, Report, ScenarioError, Stage};
use crate::fault::{Fault, Mend};
use crate::guide::Guide;
use crate::meaning;
use crate::path::{KeyPath, Step};
use crate::scenario::{formed, meant};
use serde_json::Value;
use std::collections::{HashMap, VecDeque};
use stickslip_drive::scene::Start;

/// Maximum number of reported errors.
const TOLD: usize = 20;
/// Maximum number of searched errors. The first of them in the file are reported.
const SOUGHT: usize = 64;
/// Number of replacements of a value before its parent is replaced.
const TRIES: u32 = 2;
/// Limit of the bytes read in all repetitions, and minimum number of bytes counted per repetition. Bytes instead of time are limited, so
/// that reports are equal on all machines.
const WORK: usize = 8 << 20;
const LEAST_WORK: usize = 64 << 10;

/// Pairs of keys of which one may be given instead of the other.
const KIN: [(&str, &str); 3] = [("period", "frequency"), ("frequency", "period"), ("duration", "length")];

/// Returns all errors, beginning with the given ones.
pub(crate) fn all(mut document: Document, first: Vec<Fault>) -> ScenarioError {
    let mut mistakes = Mistakes::default();
    let mut known = VecDeque::from(first);
    let mut not_checked = false;
    let mut is_judged = false;
    while mistakes.found.len() < SOUGHT {
        let fault = match known.pop_front() {
            Some(fault) => fault,
            None => match mistakes.judge(&mut document) {
                Some(Ok(())) => {
                    is_judged = true;
                    break;
                }
                Some(Err(fault)) => fault,
                None => {
                    not_checked = true;
                    break;
                }
            },
        };
        // An error after which nothing can be checked needs no note about unchecked parts.
        let is_all = fault.bearing.mend == Mend::Nothing;
        if !mistakes.take(&mut document, fault) && known.is_empty() {
            not_checked = !is_all;
            break;
        }
    }
    if is_judged {
        mistakes.reached = Stage::Equilibrium;
    }
    mistakes.told(not_checked)
}

/// Sort key of a report: source, position in the source, and position in a table. A table has the position of the key that names its file.
pub(crate) type Order = (usize, usize, usize);

struct Mistakes {
    found: Vec<(Order, Report)>,
    /// Paths of replaced values.
    spoilt: Vec<KeyPath>,
    /// Number of replacements of each path.
    tried: HashMap<KeyPath, u32>,
    /// Unknown keys with their parent and value. One of them may be a misspelt missing key.
    strays: Vec<(KeyPath, Step, Value)>,
    /// Missing keys.
    lacking: Vec<Step>,
    /// Sections with invalid names of parts. References to unknown parts of such a section are follow-on errors.
    misnamed: Vec<Step>,
    /// Number of bytes read again.
    work: usize,
    /// First stage that was not completed.
    reached: Stage,
    /// Whether the run starts from an equilibrium, as far as is known.
    balances: bool,
}

impl Default for Mistakes {
    fn default() -> Self {
        Self {
            found: Vec::new(),
            spoilt: Vec::new(),
            tried: HashMap::new(),
            strays: Vec::new(),
            lacking: Vec::new(),
            misnamed: Vec::new(),
            work: 0,
            reached: Stage::Form,
            balances: true,
        }
    }
}

impl Mistakes {
    /// Reads the scenario again and returns its first error. Returns `None` if the limit of bytes is reached.
    fn judge(&mut self, document: &mut Document) -> Option<Result<(), Fault>> {
        if self.work >= WORK {
            return None;
        }
        // Tables count, because they are read again, too.
        let bytes = document.sources.iter().map(|source| source.text.len()).sum();
        self.work += LEAST_WORK.max(bytes);
        document.forget_tables();
        let form = formed(document);
        self.reached = if form.is_ok() { Stage::Meaning } else { Stage::Form };
        let meaning = form.and_then(|form| meant(document, form)).map(|interpreted| interpreted.meaning);
        self.balances = meaning.as_ref().map_or(true, |meaning| meaning.scene.start != Start::Given);
        Some(meaning.and_then(|meaning| meaning::start(&meaning)))
    }

    /// Records an error unless it is a follow-on error, and replaces the invalid value. Returns false if no replacement is possible.
    fn take(&mut self, document: &mut Document, mut fault: Fault) -> bool {
        if !self.follows(&fault) {
            if self.strayed(document, &fault) {
                return true;
            }
            self.found.push((document.order(&fault), document.report(fault.clone())));
        }
        if let Some(table) = document.table(&fault.path) {
            fault.bearing.mend = Mend::Around(table.clone());
        }
        self.mend(&mut document.value, &fault)
    }

    /// Returns whether an error may be a follow-on error.
    fn follows(&self, fault: &Fault) -> bool {
        let subject = fault.subject();
        let ends_like = |key: &Step| subject.0.last() == Some(key);
        match &fault.bearing.mend {
            Mend::Name { section, .. } if self.misnamed.contains(&Step::Key((*section).to_owned())) => {
                return true;
            }
            Mend::Stray if self.lacking.iter().any(ends_like) => return true,
            _ => {}
        }
        self.spoilt.iter().any(|spoilt| {
            spoilt.holds(&subject)
                || (fault.bearing.inside && subject.holds(spoilt))
                || fault.bearing.against.iter().any(|other| spoilt.holds(other) || spoilt.lies_in(other))
        })
    }

    /// Returns whether the value of a missing key was found elsewhere or under an unknown name, and repairs the scenario in this case.
    fn strayed(&mut self, document: &mut Document, fault: &Fault) -> bool {
        if !matches!(fault.bearing.mend, Mend::Add(_)) {
            return false;
        }
        let subject = fault.subject();
        let Some(missing) = subject.0.last() else { return false };
        for i in 0..self.strays.len() {
            let (parent, key, value) = &self.strays[i];
            let is_here = *parent == fault.path;
            if key == missing || (is_here && KIN.contains(&(word(key), word(missing)))) {
                self.strays.swap_remove(i);
                self.spoilt.push(subject);
                return self.mend(&mut document.value, fault);
            }
            if !is_here || !set(&mut document.value, &subject, value.clone()) {
                continue;
            }
            let judged = self.judge(document);
            if judged
                .is_some_and(|judged| judged.map_or_else(|next| !subject.holds(&next.subject()), |()| true))
            {
                self.strays.swap_remove(i);
                self.spoilt.push(subject);
                return true;
            }
            remove(&mut document.value, &subject);
        }
        self.lacking.push(missing.clone());
        false
    }

    /// Replaces the value of an error by a valid one. If no replacement fits, the parent of the value is replaced.
    fn mend(&mut self, root: &mut Value, fault: &Fault) -> bool {
        let mut target = fault.subject();
        match &fault.bearing.mend {
            Mend::Nothing => return false,
            Mend::Leave(meant) => {
                self.spoilt.extend(meant.clone());
                return true;
            }
            Mend::Rename(name) => return self.rename(root, target, name),
            Mend::Stray => {
                let mut parent = target.clone();
                let key = parent.0.pop();
                self.strays
                    .extend(key.zip(at(root, &target)).map(|(key, value)| (parent, key, value.clone())));
            }
            Mend::Name { section, name, instead } => {
                let part = KeyPath(vec![Step::Key((*section).to_owned()), Step::Key(name.clone())]);
                if instead.is_none() {
                    target = part;
                } else {
                    self.spoilt.push(part);
                }
            }
            Mend::Around(whole) => target = whole.clone(),
            Mend::Misnamed => {
                self.misnamed.extend(target.0.first().cloned());
                return self.rename(root, target, "other name");
            }
            Mend::Example | Mend::Add(_) | Mend::With(_) => {}
        }
        let blamed = target.clone();
        loop {
            self.spoilt.push(target.clone());
            let tried = self.tried.entry(target.clone()).or_insert(0);
            while *tried < TRIES {
                *tried += 1;
                let key_goes = fault.goes() && target == blamed;
                if attempt(root, fault, &target, (*tried == 1, key_goes)) {
                    return true;
                }
            }
            if target.0.pop().is_none() {
                return false;
            }
        }
    }

    /// Moves a value to the intended key unless that key exists.
    fn rename(&mut self, root: &mut Value, target: KeyPath, name: &str) -> bool {
        let mut meant = target.clone();
        meant.0.pop();
        meant.0.push(Step::Key(name.to_owned()));
        if let (Some(value), None) = (at(root, &target).cloned(), at(root, &meant)) {
            set(root, &meant, value);
        }
        let mended = remove(root, &target);
        self.spoilt.extend([target, meant]);
        mended
    }

    /// Returns the errors in the order of the file.
    fn told(mut self, not_checked: bool) -> ScenarioError {
        self.found.sort_by_key(|(order, _)| *order);
        let more = self.found.len() > TOLD;
        let is_asked = |stage: &Stage| *stage != Stage::Equilibrium || self.balances;
        let left_out =
            Stage::ALL.into_iter().filter(|stage| *stage >= self.reached).filter(is_asked).collect();
        let mut reports = self.found.into_iter().map(|(_, report)| report).take(TOLD);
        let first = reports.next();
        ScenarioError::several(
            first.unwrap_or_default(),
            reports.collect(),
            Beyond { more, not_checked: not_checked && !more, left_out },
        )
    }
}

/// Replaces an invalid value by the value known to the check or by an example, or removes it. If the key is wrong, removal is tried first.
fn attempt(root: &mut Value, fault: &Fault, target: &KeyPath, (is_first, key_goes): (bool, bool)) -> bool {
    match &fault.bearing.mend {
        Mend::With(value) if is_first => return set(root, target, value.clone()),
        Mend::Name { instead: Some(name), .. } if is_first => {
            return set(root, target, Value::String(name.clone()));
        }
        Mend::Name { section, instead: None, .. } if !root.get(*section).is_some_and(Value::is_object) => {
            let section = KeyPath(vec![Step::Key((*section).to_owned())]);
            set(root, &section, Value::Object(serde_json::Map::new()));
        }
        _ => {}
    }
    let shown = |root: &mut Value| example(target).is_some_and(|example| set(root, target, example));
    if is_first == key_goes {
        return remove(root, target) || shown(root);
    }
    shown(root) || remove(root, target)
}

/// Returns the example of the schema for a path.
fn example(path: &KeyPath) -> Option<Value> {
    let guide = Guide::get();
    guide.example(guide.at(path)?).cloned()
}

fn word(step: &Step) -> &str {
    match step {
        Step::Key(key) => key,
        Step::Index(_) => "",
    }
}

fn step<'a>(value: &'a mut Value, step: &Step) -> Option<&'a mut Value> {
    match step {
        Step::Key(key) => value.get_mut(key),
        Step::Index(index) => value.get_mut(index),
    }
}

fn at<'a>(root: &'a mut Value, path: &KeyPath) -> Option<&'a mut Value> {
    path.0.iter().try_fold(root, step)
}

/// Sets the value at a path. Returns false if that is impossible or changes nothing.
fn set(root: &mut Value, path: &KeyPath, value: Value) -> bool {
    if let Some(here) = at(root, path) {
        let differs = *here != value;
        *here = value;
        return differs;
    }
    let (Some(Step::Key(key)), parent) = (path.0.last(), &path.0[..path.0.len().saturating_sub(1)]) else {
        return false;
    };
    match parent.iter().try_fold(root, step) {
        Some(Value::Object(entries)) => entries.insert(key.clone(), value).is_none(),
        _ => false,
    }
}

/// Removes an entry from an object with at least two entries. Returns false if there is no such entry.
fn remove(root: &mut Value, path: &KeyPath) -> bool {
    let Some((Step::Key(key), parent)) = path.0.split_last() else { return false };
    match parent.iter().try_fold(root, step) {
        Some(Value::Object(entries)) => entries.len() > 1 && entries.shift_remove(key).is_some(),
        _ => false,
    }
}
