//! A page: what is known, what the program makes of it, how far apart the two are.

use crate::check::Check;
use crate::table::{Table, wrapped};
use std::fmt::Write;
use stickslip_plot::{Figure, PlotError, draw_png};
use stickslip_run::markdown::plain;
use stickslip_run::program::this_program;
use stickslip_run::provenance;

/// What a reference is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Somebody measured it.
    Measurement,
    /// Another program computed it.
    OtherCode,
    /// A formula.
    ClosedForm,
}

/// Everything that a page says.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// Name of its files, without ending.
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    /// What is computed.
    pub(crate) setup: String,
    /// How a user gets the same.
    pub(crate) command: String,
    /// What it is compared with, and where that comes from.
    pub(crate) reference: String,
    pub(crate) kind: Vec<Kind>,
    /// What is asked.
    pub checks: Vec<Check>,
    pub(crate) figure: Figure<'static>,
    /// What the figure shows.
    pub(crate) shows: String,
    pub(crate) tables: Vec<Table>,
    /// What the comparison does not show.
    pub(crate) limits: String,
}

impl Kind {
    fn words(self) -> &'static str {
        match self {
            Self::Measurement => "measurement",
            Self::OtherCode => "another program",
            Self::ClosedForm => "closed form",
        }
    }
}

impl Page {
    /// Name of its files, without ending.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Whether all that is asked is kept.
    pub fn holds(&self) -> bool {
        self.checks.iter().all(Check::holds)
    }

    /// The picture, PNG.
    ///
    /// # Errors
    /// What cannot be drawn.
    pub fn picture(&self) -> Result<Vec<u8>, PlotError> {
        let provenance = vec![
            (provenance::TITLE.to_owned(), self.title.to_owned()),
            (provenance::PROGRAM.to_owned(), this_program()),
        ];
        draw_png(&Figure { provenance, ..self.figure.clone() })
    }

    /// The page.
    pub fn markdown(&self) -> String {
        let Self { name, title, setup, command, reference, shows, limits, .. } = self;
        let [setup, command, reference, shows, limits] =
            [setup, command, reference, shows, limits].map(|text| wrapped(text));
        let mut text = format!(
            "# {title}\n\n[All pages](README.md); this one is written by `stickslip-lab validate {name}`.\n\n\
             ## Set-up\n\n{setup}\n\n{command}\n\n## Reference: {}\n\n{reference}\n\n## Asked and found\n\n\
             | deviation | asked: at most | found | |\n| --- | ---: | ---: | --- |\n",
            self.kinds()
        );
        for check in &self.checks {
            let (what, allowed, found) = (&check.what, check.allowed_in_words(), check.found_in_words());
            // Writing to a string cannot fail.
            let _ = writeln!(text, "| {what} | {allowed} | {found} | {} |", mark(check.holds()));
        }
        let _ = write!(
            text,
            "\n<img src=\"{name}.png\" width=\"720\" alt=\"{}\">\n\n{shows}\n\n## Numbers\n\n",
            plain(title)
        );
        for table in &self.tables {
            text += &table.markdown();
            text.push('\n');
        }
        let _ = write!(text, "## Limits\n\n{limits}\n");
        text
    }

    fn kinds(&self) -> String {
        self.kind.iter().map(|kind| kind.words()).collect::<Vec<_>>().join(" and ")
    }
}

fn mark(holds: bool) -> &'static str {
    if holds { "kept" } else { "**not kept**" }
}

/// What stands above the list of pages.
const INDEX: &str = "# Validation

What is known, measured, computed by others or in closed form, beside what this program makes of it. Every page names its set-up, \
its reference and of what kind that is, what is asked, what came out, and what the comparison does not show. All pages and \
pictures are written by

```sh
stickslip-lab validate
```

which computes everything anew and ends with exit code 1 where something asked is not kept. A test of the project holds the pages \
to what the program computes.";

/// The page of all pages.
pub fn index(pages: &[Page]) -> String {
    let mut text = wrapped(INDEX);
    text += "\n\n| page | reference | asked: at most | found | |\n| --- | --- | --- | ---: | --- |\n";
    for page in pages {
        for (place, check) in page.checks.iter().enumerate() {
            let title =
                if place == 0 { format!("[{}]({}.md)", page.title, page.name) } else { String::new() };
            let kind = if place == 0 { page.kinds() } else { String::new() };
            let (what, allowed, found) = (&check.what, check.allowed_in_words(), check.found_in_words());
            let _ = writeln!(
                text,
                "| {title} | {kind} | {what}: {allowed} | {found} | {} |",
                mark(check.holds())
            );
        }
    }
    text
}
