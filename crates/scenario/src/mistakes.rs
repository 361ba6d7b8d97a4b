//! Everything that is wrong with a scenario, and no consequence of it.
//!
//! Reading ends at the first fault. Where there is one, what is to blame is mended by something that fits, and the scenario is
//! read again, until nothing is wrong. A fault that was judged by what was mended is a consequence of it, or may be one, and is
//! not told. So a file in which one thing is wrong is told what it always was, a good one costs nothing, and no check needs to
//! know what to do with half a scenario.

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

/// Most that are told of.
const TOLD: usize = 20;
/// Most that are looked for: those told are the first in the file.
const SOUGHT: usize = 64;
/// How often a value is mended before what it stands in is.
const TRIES: u32 = 2;
/// Most bytes that are read again, all readings together, and the fewest that one counts for. It is counted and not timed: the
/// same file is told the same on every machine.
const WORK: usize = 8 << 20;
const LEAST_WORK: usize = 64 << 10;

/// Keys that are given in the place of one that is missing.
const KIN: [(&str, &str); 3] = [("period", "frequency"), ("frequency", "period"), ("duration", "length")];

/// All that is wrong, beginning with these faults.
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
        // A fault that says itself that nothing else can be judged needs no more words.
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

/// Where a report stands: its source, or the one that names it, the place there and the place in a table.
pub(crate) type Order = (usize, usize, usize);

struct Mistakes {
    found: Vec<(Order, Report)>,
    /// What was mended.
    spoilt: Vec<KeyPath>,
    /// How often.
    tried: HashMap<KeyPath, u32>,
    /// Keys that are not known, by the object that they stood in: one may be what is missing there.
    strays: Vec<(KeyPath, Step, Value)>,
    /// Keys that were missing.
    lacking: Vec<Step>,
    /// Sections with parts that cannot have the names they have: what refers to a part that is not there means one of them.
    misnamed: Vec<Step>,
    /// Bytes that were read again.
    work: usize,
    /// The stage that judging got to, and was not through with.
    reached: Stage,
    /// Whether an equilibrium is asked for, as far as is known.
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
    /// What is wrong with a scenario that may have been mended; none where enough has been read.
    fn judge(&mut self, document: &mut Document) -> Option<Result<(), Fault>> {
        if self.work >= WORK {
            return None;
        }
        // Tables count, too: they are read again with the rest.
        let bytes = document.sources.iter().map(|source| source.text.len()).sum();
        self.work += LEAST_WORK.max(bytes);
        document.forget_tables();
        let form = formed(document);
        self.reached = if form.is_ok() { Stage::Meaning } else { Stage::Form };
        let meaning = form.and_then(|form| meant(document, form)).map(|interpreted| interpreted.meaning);
        self.balances = meaning.as_ref().map_or(true, |meaning| meaning.scene.start != Start::Given);
        Some(meaning.and_then(|meaning| meaning::start(&meaning)))
    }

    /// Notes a fault, if it is one by itself, and mends it; false where nothing can.
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

    /// Whether a fault may be the consequence of one before.
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

    /// Whether a key that is missing stands elsewhere, or there under a name that nobody knows: then its value fits.
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

    /// Puts something that fits where a fault is; what it stands in gives way where nothing does.
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

    /// The value under the key that was meant, if nothing stands there.
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

    /// In the order of the file.
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

/// Mends a value in the first or the second way: what the check knows, or else an example, or nothing in its place. Where the
/// key is to blame it goes first.
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

/// What the schema shows for a path.
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

/// Puts a value under a path; false where it cannot stand there, or stands there already.
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

/// Takes an entry out of an object that has others; false where there is none.
fn remove(root: &mut Value, path: &KeyPath) -> bool {
    let Some((Step::Key(key), parent)) = path.0.split_last() else { return false };
    match parent.iter().try_fold(root, step) {
        Some(Value::Object(entries)) => entries.len() > 1 && entries.shift_remove(key).is_some(),
        _ => false,
    }
}
