//! `stickslip-lab soak`: runs random scenarios and checks their results.

use crate::arguments::SoakArguments;
use comfy_table::Table;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_bench::BenchError;
use stickslip_bench::soak::{self, Finding, Seeds, hostile};
use stickslip_console::answer::{complain, say};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_run::complaint::words;
use stickslip_run::folder::Folder;
use thiserror::Error;

/// Error that stops the command.
#[derive(Debug, Error)]
enum SoakFailure {
    /// The cell is outside the matrix.
    #[error("there is no cell {0}: the matrix has cells 0 to {1}")]
    NoCell(u64, usize),
    /// The stability record fails.
    #[error(transparent)]
    Record(#[from] BenchError),
    /// A file cannot be written.
    #[error("{}: {}", .path.display(), words(.source))]
    Unwritten { path: PathBuf, source: io::Error },
}

/// Checks random scenarios or the matrix, or writes their scenario files.
pub(crate) fn soak(arguments: &SoakArguments) -> Verdict {
    let done = match &arguments.write {
        Some(folder) => write(arguments, folder).map(|()| Verdict::Done),
        None => judge(arguments),
    };
    done.unwrap_or_else(|failure| {
        complain(format_args!("{failure}"));
        if matches!(failure, SoakFailure::NoCell(..)) { Verdict::BadInput } else { Verdict::Stopped }
    })
}

/// Returns the requested seeds or cells.
fn seeds(arguments: &SoakArguments) -> Result<Vec<u64>, SoakFailure> {
    let cells = hostile::size();
    match arguments.named.iter().find(|cell| arguments.hostile && **cell >= cells as u64) {
        Some(beyond) => Err(SoakFailure::NoCell(*beyond, cells - 1)),
        None if !arguments.named.is_empty() => Ok(arguments.named.clone()),
        None if arguments.hostile => Ok((0..cells as u64).collect()),
        None => Ok((arguments.from..).take(arguments.seeds.get() as usize).collect()),
    }
}

/// Writes scenario files of seeds or cells.
fn write(arguments: &SoakArguments, path: &Path) -> Result<(), SoakFailure> {
    let failed = |source| SoakFailure::Unwritten { path: path.to_owned(), source };
    let seeds = seeds(arguments)?;
    let mut folder = Folder::make(path).map_err(failed)?;
    for seed in seeds {
        let (word, text) = if arguments.hostile {
            ("cell", hostile::scenario(seed).unwrap_or_default())
        } else {
            ("seed", soak::scenario(seed).1)
        };
        folder.write(&format!("{word}-{seed}.json"), text.as_bytes()).map_err(failed)?;
    }
    folder.publish().map_err(failed)
}

fn judge(arguments: &SoakArguments) -> Result<Verdict, SoakFailure> {
    let (interrupt, progress) = (Interrupt::install(), Progress::new(!arguments.quiet));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = arguments.threads.map_or(cores, usize::from);
    let seeds = seeds(arguments)?;
    let bar = progress.budget("soak", seeds.len() as f64, &interrupt);
    let findings = if arguments.hostile {
        hostile::matrix(seeds, threads, &bar)
    } else {
        soak::soak(&Seeds { seeds, rows: arguments.rows, threads }, &bar)
    };
    drop(bar);
    match (&arguments.out, &arguments.page) {
        // An interrupted record would be incomplete.
        (Some(out), Some(page)) if !interrupt.is_raised() => hostile::write_record(&findings, page, out)?,
        (Some(out), None) => write_table(&findings, out)?,
        _ => {}
    }
    if !arguments.quiet {
        say(format_args!("{}", shares(&findings)));
        say(format_args!("{}", work(&findings)));
    }
    soak::exceptions(&findings).iter().for_each(|line| say(format_args!("{line}")));
    Ok(ending(interrupt.is_raised(), &findings))
}

fn write_table(findings: &[Finding], path: &Path) -> Result<(), SoakFailure> {
    let failed = |source| SoakFailure::Unwritten { path: path.to_owned(), source };
    let table = soak::table(findings).map_err(failed)?;
    let mut folder = Folder::make(path).map_err(failed)?;
    folder.write(soak::TABLE, &table).and_then(|()| folder.publish()).map_err(failed)
}

/// Returns the exit status of the command.
fn ending(interrupted: bool, findings: &[Finding]) -> Verdict {
    match (interrupted, findings.iter().any(|finding| finding.verdict.is_fault())) {
        (true, _) => Verdict::Interrupted,
        (false, true) => Verdict::Differs,
        (false, false) => Verdict::Done,
    }
}

/// Returns a table of the numbers of scenarios by kind and verdict.
fn shares(findings: &[Finding]) -> Table {
    let met = soak::Verdict::ALL.into_iter().filter(|verdict| soak::count(findings, None, *verdict) > 0);
    let verdicts: Vec<soak::Verdict> = met.collect();
    let heads = verdicts.iter().map(|verdict| verdict.name());
    let mut table = table::plain(["kind", "scenarios"].into_iter().chain(heads));
    let mut kinds: Vec<&str> = Vec::new();
    for finding in findings {
        if !kinds.contains(&finding.kind) {
            kinds.push(finding.kind);
        }
    }
    for kind in kinds.into_iter().map(Some).chain([None]) {
        let counts: Vec<usize> =
            verdicts.iter().map(|verdict| soak::count(findings, kind, *verdict)).collect();
        let all: usize = counts.iter().sum();
        let name = kind.unwrap_or("all").to_owned();
        let numbers = counts.iter().map(usize::to_string);
        table.add_row([name, all.to_string()].into_iter().chain(numbers));
    }
    table::to_the_right(&mut table, 1..=1 + verdicts.len());
    table
}

/// Describes the number of runs and their computing times.
fn work(findings: &[Finding]) -> String {
    let runs: u32 = findings.iter().map(|finding| finding.runs.0).sum();
    let wall: f64 = findings.iter().map(|finding| finding.runs.1).sum();
    let longest = findings.iter().map(|finding| finding.runs.2).fold(0.0, f64::max);
    let detours = findings.iter().filter(|finding| finding.detours > 0).count();
    let mean = wall / f64::from(runs.max(1));
    format!("{runs} runs, mean {mean:.3} s, maximum {longest:.1} s; step doubling in {detours} scenarios")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_end_in_a_difference() {
        let finding = |verdict| Finding {
            seed: 1,
            kind: "slider",
            verdict,
            note: String::new(),
            errors: [f64::NAN; 2],
            growth: 1.0,
            books: 0.0,
            row: [f64::NAN; 2],
            runs: (3, 0.1, 0.1),
            detours: 0,
        };
        use soak::Verdict::{Refused, Right, Stopped};
        assert_eq!(ending(false, &[finding(Right), finding(Refused)]), Verdict::Done);
        assert_eq!(ending(false, &[finding(Right), finding(Stopped)]), Verdict::Differs);
        assert_eq!(ending(true, &[finding(Stopped)]), Verdict::Interrupted);
    }
}
