//! `stickslip explain NAME`: keys of scenarios from the schema, columns, figures and their symbols from the table of definitions.

use stickslip_console::answer::{complain, say};
use stickslip_console::verdict::Verdict;
use stickslip_run::definitions;
use stickslip_scenario::{explained, suggestion};

/// Explains every name, or says that nothing has it.
pub(crate) fn explain(names: &[String]) -> Verdict {
    let mut verdict = Verdict::Done;
    for name in names {
        let mut found = false;
        for definition in definitions().filter(|definition| definition.is(name)) {
            found = true;
            say(format_args!("{}  {}\n    {}", definition.file, definition.name, definition.text));
        }
        for (path, text) in explained(name) {
            found = true;
            say(format_args!("scenario  {path}\n    {text}"));
        }
        // What holds others is explained by them.
        let held: Vec<_> = definitions().filter(|definition| !found && definition.is_within(name)).collect();
        for definition in held {
            found = true;
            say(format_args!("{}  {}\n    {}", definition.file, definition.name, definition.text));
        }
        // A symbol such as u_c or E* is none's name; what it is stands first.
        let symbols = definitions().filter(|definition| !found && definition.has_symbol(name));
        let symbols: Vec<_> = symbols.collect();
        for definition in &symbols {
            say(format_args!("{}  {}\n    {}", definition.file, definition.name, definition.text));
        }
        // Nor is a state such as slip; where it is told stands with it.
        let is_known = found || !symbols.is_empty();
        let sayers: Vec<_> = definitions().filter(|definition| !is_known && definition.says(name)).collect();
        for definition in &sayers {
            say(format_args!("{}  {}\n    {}", definition.file, definition.name, definition.text));
        }
        if !is_known && sayers.is_empty() {
            let known = definitions().filter_map(|definition| definition.name.rsplit('.').next());
            let help = suggestion(name, known).filter(|help| help.starts_with("did you mean"));
            let help = help.unwrap_or_else(|| {
                "docs/definitions.md lists columns and figures, stickslip schema the keys of scenarios"
                    .to_owned()
            });
            complain(format_args!("nothing is called \"{}\"\n   help: {help}", name.escape_debug()));
            verdict = Verdict::BadInput;
        }
    }
    verdict
}
