//! `stickslip explain NAME`: explains keys of scenarios, columns, results, symbols and terms.

use super::check;
use stickslip_console::answer::{complain, say};
use stickslip_console::verdict::Verdict;
use stickslip_quantity::terms::{TERMS, letter};
use stickslip_quantity::{Definition, columns, page, report};
use stickslip_scenario::{explained, suggestion};

/// Explains every name. Without a name it prints the page of all definitions.
pub(crate) fn explain(names: &[String]) -> Verdict {
    let all = definitions();
    if names.is_empty() {
        say(format_args!("{}", page(&all).trim_end()));
    }
    // An unknown name does not prevent the explanation of the others.
    let unknown = names.iter().filter(|name| !explain_either(name, &all)).count();
    if unknown == 0 { Verdict::Done } else { Verdict::BadInput }
}

/// Returns the definitions of all output.
fn definitions() -> Vec<Definition> {
    let mut all = stickslip_study::definitions();
    all.extend(check::definitions());
    all.extend(columns::VALIDATE.definitions());
    all.extend(report::<stickslip_realtime::Report>("realtime.json"));
    all
}

/// Maximum number of definitions shown if only their text contains the name.
const MOST: usize = 6;

/// Explains a name, or the key that is spelled like it with underscores: "slip ratio" is `slip_ratio`.
fn explain_either(name: &str, all: &[Definition]) -> bool {
    let key = name.trim().replace([' ', '-'], "_");
    let is_term = TERMS.iter().any(|term| term.names.contains(&name.to_lowercase().as_str()));
    // The name of a column ends with its unit.
    let is_it =
        |own: &&str| own.strip_prefix(&*key).is_some_and(|unit| unit.is_empty() || unit.starts_with('_'));
    let found = all.iter().filter_map(|one| one.name.rsplit('.').next()).find(is_it);
    match found.or_else(|| (!explained(&key).is_empty()).then_some(&key)) {
        Some(known) if !is_term && key != name => explain_one(known, all),
        _ => explain_one(name, all),
    }
}

/// Explains one name and returns whether there is an entry.
///
/// The order of the search is: terms, names of definitions and keys of scenarios; groups with this name; symbols;
/// states; texts that contain all of its words.
fn explain_one(name: &str, all: &[Definition]) -> bool {
    let print = |fits: &dyn Fn(&Definition) -> bool, most: usize| {
        let found = all.iter().filter(|definition| fits(definition)).take(most);
        found.map(|one| say(format_args!("{}  {}\n    {}", one.file, one.name, one.text))).count() > 0
    };
    let lower = name.to_lowercase();
    let terms = TERMS.iter().filter(|term| term.names.contains(&lower.as_str()));
    let mut found =
        terms.map(|term| say(format_args!("{name}\n    {}; see docs/{}", term.text, term.page))).count() > 0;
    found |= print(&|definition| definition.is(name), usize::MAX);
    for (path, text) in explained(name) {
        found = true;
        say(format_args!("scenario  {path}\n    {text}"));
    }
    let symbol = letter(name).unwrap_or(name);
    let words: Vec<&str> = lower.split([' ', '-', '_']).filter(|word| word.len() > 2).collect();
    let has_words = |definition: &Definition| {
        let text = format!("{} {}", definition.name, definition.text).to_lowercase();
        !words.is_empty() && words.iter().all(|word| text.contains(word))
    };
    found = found
        || print(&|definition| definition.is_within(name), usize::MAX)
        || print(&|definition| definition.has_symbol(symbol), usize::MAX)
        || print(&|definition| definition.says(name), usize::MAX);
    if !found {
        let known = all.iter().filter_map(|definition| definition.name.rsplit('.').next());
        let help = suggestion(name, known).filter(|help| help.starts_with("did you mean"));
        found = help.is_none() && print(&has_words, MOST);
        let help = help.unwrap_or_else(|| {
            "`stickslip explain` lists columns and results, `stickslip schema` prints the keys of scenarios".to_owned()
        });
        if !found {
            complain(format_args!("there is no entry \"{}\"\n   help: {help}", name.escape_debug()));
        }
    }
    found
}
