//! What every column of every table and every key of `summary.json` is: one table, for `stickslip explain` and for the page
//! `docs/definitions.md`, which is made from it.

mod columns;
mod keys;

use std::fmt::Write;

/// What a column or a key is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Definition {
    /// The file, such as `trace.csv`.
    pub file: &'static str,
    /// Its name there: `ACTUATOR`, `BODY`, `CODE`, `CONTACT`, `FILE` and `SCALE` stand for names that the scenario or the run gives.
    pub name: &'static str,
    /// What it is, with its formula; the name ends with the unit.
    pub text: &'static str,
}

/// Names that are not the same in every run.
const PLACEHOLDERS: [&str; 6] = ["ACTUATOR", "BODY", "CODE", "CONTACT", "FILE", "SCALE"];

/// Everything that is defined, file by file.
pub fn definitions() -> impl Iterator<Item = &'static Definition> {
    columns::COLUMNS.iter().chain(keys::KEYS)
}

impl Definition {
    /// Whether it is what a name means: `slider.x_m` is `BODY.x_m`, `x_m` and `steady.step_m` are ends of names.
    pub fn is(&self, asked: &str) -> bool {
        let known: Vec<&str> = self.name.split('.').collect();
        let asked: Vec<&str> = asked.split('.').collect();
        let fits =
            |known: &str, asked: &str| known == asked || (PLACEHOLDERS.contains(&known) && !asked.is_empty());
        asked.len() <= known.len()
            && known.iter().rev().zip(asked.iter().rev()).all(|(known, asked)| fits(known, asked))
            && !PLACEHOLDERS.contains(known.last().unwrap_or(&""))
    }

    /// Whether it is the definition of this column or key of its file, written out.
    pub fn defines(&self, file: &str, name: &str) -> bool {
        self.file == file && self.name.split('.').count() == name.split('.').count() && {
            let known = self.name.split('.').zip(name.split('.'));
            known.into_iter().all(|(known, given)| known == given || PLACEHOLDERS.contains(&known))
        }
    }
}

/// The page, in Markdown.
pub fn definitions_page() -> String {
    let mut page = String::from(
        "# Definitions\n\nEvery column of every table and every key of `summary.json`, as `stickslip explain NAME` tells them; \
         this page is made\nfrom the same table, and a test finds whatever lacks an entry. Names end with their unit. BODY and \
         CONTACT stand for names\nof the scenario. How the figures of steps and loops are found, and how exact they are, is told \
         on [their page](figures.md);\nwhat the contacts obey, on [the page of the physics](physics.md). Keys of scenarios are \
         told by `stickslip explain`, too.\n",
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
        assert!(found("nothing").is_empty() && found("BODY").is_empty() && found("").is_empty());
    }
}
