//! `stickslip explain NAME`: keys of scenarios from the schema, columns, numbers of reports and their symbols from what defines them.

use super::check;
use stickslip_console::answer::{complain, say};
use stickslip_console::verdict::Verdict;
use stickslip_quantity::{Definition, columns, page, report};
use stickslip_scenario::{explained, suggestion};

/// Explains every name, or says that nothing has it; without a name prints the page of all definitions.
pub(crate) fn explain(names: &[String]) -> Verdict {
    let all = definitions();
    if names.is_empty() {
        say(format_args!("{}", page(&all).trim_end()));
    }
    let known = names.iter().map(|name| explain_one(name, &all));
    if known.fold(true, |all, known| all && known) { Verdict::Done } else { Verdict::BadInput }
}

/// All that the program prints.
fn definitions() -> Vec<Definition> {
    let mut all = stickslip_study::definitions();
    all.extend(check::definitions());
    all.extend(columns::VALIDATE.definitions());
    all.extend(report::<stickslip_realtime::Report>("realtime.json"));
    all
}

/// Whether anything has a name: what is called so, else what holds others by that name, else symbols and states, which are names of
/// nothing.
fn explain_one(name: &str, all: &[Definition]) -> bool {
    let print = |fits: &dyn Fn(&Definition) -> bool| {
        let found = all.iter().filter(|definition| fits(definition));
        found.map(|one| say(format_args!("{}  {}\n    {}", one.file, one.name, one.text))).count() > 0
    };
    let mut found = print(&|definition| definition.is(name));
    for (path, text) in explained(name) {
        found = true;
        say(format_args!("scenario  {path}\n    {text}"));
    }
    found = found
        || print(&|definition| definition.is_within(name))
        || print(&|definition| definition.has_symbol(name))
        || print(&|definition| definition.says(name));
    if !found {
        let known = all.iter().filter_map(|definition| definition.name.rsplit('.').next());
        let help = suggestion(name, known).filter(|help| help.starts_with("did you mean"));
        let help = help.unwrap_or_else(|| {
            "stickslip explain lists columns and figures, stickslip schema the keys of scenarios".to_owned()
        });
        complain(format_args!("nothing is called \"{}\"\n   help: {help}", name.escape_debug()));
    }
    found
}
