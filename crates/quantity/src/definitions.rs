//! What every column of every table, every key of `summary.json` and every figure that a command prints is: one table, for
//! `stickslip explain` and for the page `docs/definitions.md`, which is made from it.

mod branch;
mod check;
mod columns;
mod contact;
mod curve;
mod info;
mod keys;
mod outlook;
mod realtime;
mod sensitivity;
mod steady;

use std::fmt::Write;

/// What a column or a key is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Definition {
    /// The file, such as `trace.csv`.
    pub file: &'static str,
    /// Its name there: words in capitals such as `BODY` stand for names that the scenario or the run gives.
    pub name: &'static str,
    /// What it is, with its formula; the name ends with the unit.
    pub text: &'static str,
}

/// Names that are not the same in every run.
const PLACEHOLDERS: [&str; 10] =
    ["ACTUATOR", "AXIS", "BODY", "CODE", "CONTACT", "COORDINATE", "FILE", "LOAD", "SCALE", "WAVEFORM"];

/// Everything that is defined, file by file.
pub fn definitions() -> impl Iterator<Item = &'static Definition> {
    let summary = columns::COLUMNS.iter().chain(keys::KEYS).chain(outlook::SUMMARY);
    let info = info::INFO.iter().chain(outlook::INFO);
    summary
        .chain(info)
        .chain(contact::CONTACT)
        .chain(steady::STEADY)
        .chain(check::CHECK)
        .chain(branch::BRANCH)
        .chain(curve::CURVE)
        .chain(sensitivity::SENSITIVITY)
        .chain(realtime::REALTIME)
}

impl Definition {
    /// Whether it is what a name means: `slider.x_m` is `BODY.x_m`, `x_m` and `steady.step_m` are ends of names.
    pub fn is(&self, asked: &str) -> bool {
        let mut known: Vec<&str> = self.name.split('.').collect();
        // What is the same for all names at its end is asked for without one.
        while known.last().is_some_and(|last| PLACEHOLDERS.contains(last)) {
            known.pop();
        }
        let asked: Vec<&str> = asked.split('.').collect();
        let fits =
            |known: &str, asked: &str| known == asked || (PLACEHOLDERS.contains(&known) && !asked.is_empty());
        asked.len() <= known.len()
            && known.iter().rev().zip(asked.iter().rev()).all(|(known, asked)| fits(known, asked))
    }

    /// Whether a name is that of something which holds it: `drivers`, `at_limit`.
    pub fn is_within(&self, asked: &str) -> bool {
        self.name.rsplit_once('.').is_some_and(|(holders, _)| {
            holders.split('.').any(|holder| holder == asked && !PLACEHOLDERS.contains(&holder))
        })
    }

    /// Whether its text begins with a symbol and what that is: `u_c = κd …` or `a, contact radius …`; digits may stand for those
    /// below the line.
    pub fn has_symbol(&self, asked: &str) -> bool {
        let Some((symbol, _)) = self.text.split_once([' ', ',']) else { return false };
        let rest = &self.text[symbol.len()..];
        let plain: String = symbol.chars().map(|c| lowered(c).unwrap_or(c)).collect();
        // Amplitudes, as in Q*, are asked for without their stars as well.
        let is = |symbol: &str| symbol == asked || symbol.strip_suffix('*') == Some(asked);
        (rest.starts_with(',') || rest.starts_with(" = ")) && (is(symbol) || is(&plain))
    }

    /// Whether a word is one of those that it may say, such as `partial` of a state.
    pub fn says(&self, asked: &str) -> bool {
        self.text.split('`').skip(1).step_by(2).any(|word| word == asked)
    }

    /// Whether it is the definition of this column or key of its file, written out.
    pub fn defines(&self, file: &str, name: &str) -> bool {
        self.file == file && self.name.split('.').count() == name.split('.').count() && {
            let known = self.name.split('.').zip(name.split('.'));
            known.into_iter().all(|(known, given)| known == given || PLACEHOLDERS.contains(&known))
        }
    }
}

/// The digit that stands below the line.
fn lowered(below: char) -> Option<char> {
    char::from_digit(u32::from(below).checked_sub(u32::from('₀'))?, 10)
}

/// The page, in Markdown.
pub fn definitions_page() -> String {
    let mut page = String::from(
        "# Definitions\n\nEvery column of the tables of runs and studies, every key of `summary.json`, and what `info`, `contact`, `steady`, `check`,\n`validate`, `characterise`, `sensitivity` and `realtime` print, as\n`stickslip explain NAME` tells them; this page is made from the same table, and a test finds whatever lacks an \
         entry. Names end\nwith their unit. BODY, CONTACT and other words in capitals stand for names of the scenario; LOAD is `start`, \
         or `least` and\n`most` of a load that varies. How the figures of steps and loops are found, and how exact they are, is told on \
         [their\npage](figures.md); what the contacts obey, on [the page of the physics](physics.md). Numbers in brackets such as (4.26) are \
         equations\nof the *Handbook of Contact Mechanics* (Popov, Heß, Willert 2019). `info` and `contact` print the same as tables for \
         people, with\nthe symbols that stand first here. Keys of scenarios are told by `stickslip explain`, too.\n",
    );
    let mut file = "";
    for definition in definitions() {
        if definition.file != file {
            file = definition.file;
            let _ = write!(page, "\n## {file}\n\n| name | what it is |\n| --- | --- |\n");
        }
        let _ = writeln!(page, "| `{}` | {} |", definition.name, definition.text.replace('|', "\\|"));
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_whole_and_by_their_ends() {
        let found = |asked: &str| {
            definitions()
                .filter(|definition| definition.is(asked))
                .map(|d| (d.file, d.name))
                .collect::<Vec<_>>()
        };
        assert_eq!(found("slider.x_m"), [("trace.csv", "BODY.x_m")]);
        assert_eq!(found("stick_m"), [("trace.csv", "CONTACT.stick_m")]);
        assert_eq!(found("steady.step_m"), [("summary.json", "steps.steady.step_m")]);
        assert_eq!(found("contacts.ball.peak_fx_N"), [("summary.json", "contacts.CONTACT.peak_fx_N")]);
        assert_eq!(found("states"), [("summary.json", "states.CODE")]);
        assert!(found("nothing").is_empty() && found("BODY").is_empty() && found("").is_empty());
    }

    /// States and regimes were called by nothing.
    #[test]
    fn words_of_states_are_found() {
        for (word, name) in [("slip", "CONTACT.state"), ("gross", "regime"), ("gross slip", "kind")] {
            assert!(
                definitions().any(|definition| definition.says(word) && definition.name == name),
                "{word}"
            );
        }
        assert!(!definitions().any(|definition| definition.says("") || definition.says("no word")));
    }

    #[test]
    fn symbols_are_found_where_a_text_begins_with_them() {
        let found = |asked: &str| definitions().filter(|definition| definition.has_symbol(asked)).count();
        for symbol in ["E*", "G*", "κ", "u_c", "S₀", "S0", "F_N", "μF_N", "a", "β", "c/a", "A", "δ₀", "δ0"]
        {
            assert!(found(symbol) > 0, "{symbol}");
        }
        let q = definitions().filter(|definition| definition.has_symbol("Q"));
        assert!(q.map(|definition| definition.name).any(|name| name.ends_with("force_amplitude_N")));
        // Words of sentences are none.
        for word in ["time", "displacement", "the", "₀", ""] {
            assert_eq!(found(word), 0, "{word}");
        }
    }
}
