//! `stickslip-lab validate`: compares the program with known results.

use crate::arguments::ValidateArguments;
use std::io;
use std::path::PathBuf;
use stickslip_console::answer::{complain, say};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::verdict::Verdict;
use stickslip_drive::RunError;
use stickslip_plot::PlotError;
use stickslip_run::Watcher;
use stickslip_run::complaint::words;
use stickslip_run::folder::Folder;
use stickslip_validation::{Page, Subject, ValidationError, index};
use thiserror::Error;

/// File name of the index page.
const INDEX: &str = "index.md";

/// Error that stops the command.
#[derive(Debug, Error)]
enum ValidateFailure {
    /// A page cannot be computed.
    #[error("{name}: {source}")]
    Page { name: &'static str, source: ValidationError },
    /// A plot fails.
    #[error("{name}: {source}")]
    Picture { name: &'static str, source: PlotError },
    /// A file cannot be written.
    #[error("{}: cannot be written: {}\n   help: choose another folder with --out", .path.display(), words(.source))]
    File { path: PathBuf, source: io::Error },
}

/// Computes the pages and writes them.
pub(crate) fn validate(arguments: &ValidateArguments) -> Verdict {
    match write(arguments) {
        Ok(pages) => {
            let lost = pages.iter().flat_map(|page| page.checks.iter().map(move |check| (page, check)));
            let lost: Vec<_> = lost.filter(|(_, check)| !check.holds()).collect();
            for (page, check) in &lost {
                complain(format_args!("{}: not met: {check}", page.name()));
            }
            if !arguments.quiet {
                let asked: usize = pages.iter().map(|page| page.checks.len()).sum();
                let (out, kept) = (arguments.out.display(), asked - lost.len());
                say(format_args!("{out}: {} pages, {kept} of {asked} tolerances met", pages.len()));
            }
            if lost.is_empty() { Verdict::Done } else { Verdict::Differs }
        }
        Err(failure) => {
            complain(format_args!("{failure}"));
            failure.verdict()
        }
    }
}

fn write(arguments: &ValidateArguments) -> Result<Vec<Page>, ValidateFailure> {
    let failed = |source| ValidateFailure::File { path: arguments.out.clone(), source };
    let (interrupt, progress) = (Interrupt::install(), Progress::new(!arguments.quiet));
    let wanted = |subject: &Subject| arguments.pages.is_empty() || arguments.pages.contains(subject);
    let subjects: Vec<Subject> = Subject::ALL.into_iter().filter(wanted).collect();
    // Before the first computation.
    let mut folder = Folder::make(&arguments.out).map_err(failed)?;
    let bar = progress.budget("validate", subjects.len() as f64, &interrupt);
    let mut pages = Vec::new();
    for (done, subject) in subjects.iter().enumerate() {
        bar.reached(done as f64);
        let name = subject.name();
        let page = subject.page(&bar).map_err(|source| ValidateFailure::Page { name, source })?;
        let picture = page.picture().map_err(|source| ValidateFailure::Picture { name, source })?;
        folder.write(&format!("{name}.png"), &picture).map_err(failed)?;
        folder.write(&format!("{name}.md"), page.markdown().as_bytes()).map_err(failed)?;
        pages.push(page);
    }
    drop(bar);
    if subjects.len() == Subject::ALL.len() {
        folder.write(INDEX, index(&pages).as_bytes()).map_err(failed)?;
    }
    folder.publish().map_err(failed)?;
    Ok(pages)
}

impl ValidateFailure {
    fn verdict(&self) -> Verdict {
        match self {
            Self::Page { source: ValidationError::Run(RunError::Interrupted { .. }), .. } => {
                Verdict::Interrupted
            }
            Self::Page { .. } | Self::Picture { .. } | Self::File { .. } => Verdict::Stopped,
        }
    }
}
