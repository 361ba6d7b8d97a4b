//! `stickslip plot --over`: plots of several results in one diagram.

use super::{PlotFailure, write};
use crate::arguments::PlotArguments;
use std::path::{Path, PathBuf};
use stickslip_console::answer::{complain, say};
use stickslip_console::verdict::Verdict;
use stickslip_figures::Sources;
use stickslip_figures::overlay::{self, OVERLAID};
use stickslip_run::Results;
use stickslip_scenario::PlotName;

/// Draws each kind of plot with the results of all folders.
pub(super) fn plot(arguments: &PlotArguments) -> Verdict {
    let mut worst = Verdict::Done;
    for failure in draw(arguments).unwrap_or_else(|failure| vec![failure]) {
        complain(format_args!("{failure}"));
        worst = worst.max(failure.verdict());
    }
    worst
}

/// Draws the plots and returns the errors.
fn draw(arguments: &PlotArguments) -> Result<Vec<PlotFailure>, PlotFailure> {
    let [first, others @ ..] = &arguments.folders[..] else { return Ok(Vec::new()) };
    if others.is_empty() {
        return Err(PlotFailure::Over("expected several folders of results, got one".to_owned()));
    }
    let first_results = Results::read(first, &arguments.plots)?;
    let plots = plots(&first_results.job.scenario.plots, !arguments.plots.is_empty())?;
    let mut results = vec![first_results];
    for folder in others {
        results.push(Results::read(folder, &plots)?);
    }
    let named = names(&arguments.folders).into_iter().zip(&results);
    let sources: Vec<(String, Sources<'_>)> = named.map(|(name, results)| (name, sources(results))).collect();
    let (mut pictures, mut failures) = (Vec::new(), Vec::new());
    for plot in plots {
        match overlay::draw(&sources, plot, &arguments.look.look()) {
            Ok(files) => pictures.extend(files),
            Err(source) => failures.push(PlotFailure::figure(first, source)),
        }
    }
    let out = arguments.out.clone().unwrap_or_default();
    match write(&out, &pictures) {
        Ok(names) if !arguments.quiet && !names.is_empty() => {
            say(format_args!("{}: {}", out.display(), names.join(", ")));
        }
        Ok(_) => {}
        Err(source) => failures.push(PlotFailure::Write { folder: out, source }),
    }
    Ok(failures)
}

fn sources(results: &Results) -> Sources<'_> {
    let Results { job, kept, insides } = results;
    Sources { job, kept, insides: insides.clone() }
}

/// Returns the plots that can be overlaid. If plots are requested, all of them must be of this kind; other plots of a
/// scenario are skipped.
fn plots(named: &[PlotName], are_asked_for: bool) -> Result<Vec<PlotName>, PlotFailure> {
    let can = || OVERLAID.map(PlotName::name).join(", ");
    if let Some(other) = named.iter().find(|plot| are_asked_for && !OVERLAID.contains(plot)) {
        let words = format!("the plot {} cannot be overlaid; these plots can: {}", other.name(), can());
        return Err(PlotFailure::Over(words));
    }
    let plots: Vec<PlotName> = OVERLAID.into_iter().filter(|plot| named.contains(plot)).collect();
    if plots.is_empty() {
        let words = format!(
            "the scenario of the first folder names no such plots\n   help: name some with --plots: {}",
            can()
        );
        return Err(PlotFailure::Over(words));
    }
    Ok(plots)
}

/// Returns the shortest ends of the folder paths that differ from each other.
fn names(folders: &[PathBuf]) -> Vec<String> {
    let end = |folder: &Path, parts: usize| {
        let all: Vec<_> = folder.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        all[all.len().saturating_sub(parts)..].join("/")
    };
    let longest = folders.iter().map(|folder| folder.iter().count()).max().unwrap_or(1);
    let of = |parts: usize| folders.iter().map(|folder| end(folder, parts)).collect::<Vec<_>>();
    let are_different = |names: &Vec<String>| (1..names.len()).all(|i| !names[..i].contains(&names[i]));
    (1..=longest).map(of).find(are_different).unwrap_or_else(|| of(longest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_as_long_as_it_takes() {
        let said = |folders: &[&str]| names(&folders.iter().map(PathBuf::from).collect::<Vec<_>>());
        assert_eq!(said(&["results/a", "results/b"]), ["a", "b"]);
        assert_eq!(said(&["old/p1", "new/p1", "p1"]), ["old/p1", "new/p1", "p1"]);
        assert_eq!(said(&["p1", "p1"]), ["p1", "p1"]);
    }
}
