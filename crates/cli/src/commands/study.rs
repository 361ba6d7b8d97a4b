//! `stickslip study`: many runs of one scenario with different parameters.

mod optimise;

use crate::arguments::study::{
    CheckStudyArguments, IndicesStudyArguments, MergeStudyArguments, PlaceArguments, PlanStudyArguments,
    RunStudyArguments, StatusStudyArguments, StudyCommand,
};
use optimise::optimise;
use serde::Serialize;
use serde_json::json;
use std::path::{Path, PathBuf};
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_quantity::names;
use stickslip_run::{Real, quantity};
use stickslip_study::sweep::{Forecast, Indices, Ran, Shard, Statistics, Status, Study, StudyError};

/// Runs one of the subcommands.
pub(crate) fn study(command: &StudyCommand) -> Verdict {
    let verdict = match command {
        StudyCommand::Check(arguments) => check(arguments),
        StudyCommand::Plan(arguments) => plan(arguments),
        StudyCommand::Run(arguments) => run(arguments),
        StudyCommand::Status(arguments) => status(arguments),
        StudyCommand::Merge(arguments) => merge(arguments),
        StudyCommand::Indices(arguments) => indices(arguments),
        StudyCommand::Optimise(arguments) => optimise(arguments),
    };
    verdict.unwrap_or_else(|error| {
        complain(format_args!("{error}"));
        match error {
            StudyError::Interrupted => Verdict::Interrupted,
            error if error.is_input() => Verdict::BadInput,
            _ => Verdict::Stopped,
        }
    })
}

fn check(arguments: &CheckStudyArguments) -> Result<Verdict, StudyError> {
    let study = Study::load(&arguments.place.file)?;
    study.status(&folder(&arguments.place, &study))?;
    if !arguments.quiet {
        warn(&study.job);
        say(format_args!(
            "{}: ok, {} in {}",
            arguments.place.file.display(),
            counted(study.cases(), "case"),
            counted(study.parts(), "part")
        ));
    }
    Ok(Verdict::Done)
}

fn plan(arguments: &PlanStudyArguments) -> Result<Verdict, StudyError> {
    let (study, interrupt) = (Study::load(&arguments.place.file)?, Interrupt::install());
    study.status(&folder(&arguments.place, &study))?;
    let progress = Progress::new(!arguments.json);
    let forecast =
        study.forecast(arguments.threads.count(), &progress.count(&study.job.name, "", &interrupt))?;
    if arguments.json {
        json(&forecast);
        return Ok(Verdict::Done);
    }
    let Forecast { cases, chunks, expected_s, case_s, bytes, threads, failed } = forecast;
    say(format_args!(
        "{} in {} of up to {}",
        counted(cases, "case"),
        counted(chunks, "part"),
        study.part(0).end
    ));
    let each = quantity(case_s, "s");
    say(format_args!(
        "expected time: {} on {} ({each} per case)",
        duration(expected_s),
        counted(threads as u64, "thread")
    ));
    say(format_args!(
        "expected size: {} in {}",
        quantity(Real(bytes as f64), "B"),
        folder(&arguments.place, &study).display()
    ));
    for (case, why) in failed {
        say(format_args!("case {case} fails: {why}"));
    }
    Ok(Verdict::Done)
}

fn run(arguments: &RunStudyArguments) -> Result<Verdict, StudyError> {
    let RunStudyArguments { place, shard, quiet, .. } = arguments;
    let (study, interrupt) = (Study::load(&place.file)?, Interrupt::install());
    let shard = match shard.as_deref() {
        None => Shard::WHOLE,
        Some("auto") => Shard::from_environment(&|name| std::env::var(name).ok())?,
        Some(text) => text.parse().map_err(|why| StudyError::Shard(format!("--shard {text}: {why}")))?,
    };
    if !quiet {
        warn(&study.job);
    }
    if !(0..study.parts()).any(|part| shard.takes(part)) {
        complain(format_args!(
            "warning: this shard has no part, the study has {}\n   help: use fewer shards, or a smaller chunk",
            counted(study.parts(), "part")
        ));
    }
    let out = folder(place, &study);
    if arguments.fresh {
        study.remove(&out)?;
    }
    let Some(ran) = compute(&study, &out, (shard, arguments.threads.count()), (!quiet, &interrupt))? else {
        return Err(StudyError::Interrupted);
    };
    let status = study.status(&out)?;
    if !status.missing.is_empty() {
        if arguments.json {
            json(&json!({ "computed": ran.computed, "parts": status.parts, "of": status.of }));
        } else if !quiet {
            say(format_args!("{}: {} of {} parts", out.display(), status.parts, status.of));
        }
        return Ok(Verdict::Done);
    }
    let statistics = study.statistics(&out)?;
    if arguments.json {
        json(&statistics);
    } else if !quiet {
        tell(&study, &statistics);
        say(format_args!("{}: {}, {} computed now", out.display(), counted(status.of, "part"), ran.computed));
    }
    if statistics.failed == statistics.cases {
        complain(format_args!("{}: all cases failed", study.job.name));
        return Ok(Verdict::Stopped);
    }
    Ok(Verdict::Done)
}

/// Computes the missing parts. Returns `None` if interrupted.
fn compute(
    study: &Study,
    out: &Path,
    (shard, threads): (Shard, usize),
    (is_told, interrupt): (bool, &Interrupt),
) -> Result<Option<Ran>, StudyError> {
    let missing = study.status(out)?.missing.into_iter().filter(|part| shard.takes(*part));
    let due: u64 = missing.map(|part| study.part(part)).map(|cases| cases.end - cases.start).sum();
    let progress = Progress::new(is_told);
    if due > 0 {
        progress.tell(format_args!("{}: {due} cases", study.job.name));
    }
    let bar = progress.budget(&study.job.name, due as f64, interrupt);
    let ran = study.run(out, (shard, threads), &bar)?;
    Ok((!ran.interrupted).then_some(ran))
}

fn status(arguments: &StatusStudyArguments) -> Result<Verdict, StudyError> {
    let study = Study::load(&arguments.place.file)?;
    let out = folder(&arguments.place, &study);
    let Status { parts, of, missing, damaged } = study.status(&out)?;
    if arguments.json {
        json(&json!({ "parts": parts, "of": of, "missing": missing, "damaged": damaged }));
        return Ok(Verdict::Done);
    }
    let none = if out.exists() { "" } else { ", this folder does not exist yet" };
    say(format_args!("{}: {parts} of {of} parts{none}", out.display()));
    for (what, parts) in [("missing", &missing), ("damaged, will be computed again", &damaged)] {
        if !parts.is_empty() {
            say(format_args!("{what}: {}", ranges(parts)));
        }
    }
    Ok(Verdict::Done)
}

fn merge(arguments: &MergeStudyArguments) -> Result<Verdict, StudyError> {
    let study = Study::load(&arguments.place.file)?;
    study.write_csv(&folder(&arguments.place, &study), &arguments.csv)?;
    say(format_args!("{}: {} cases", arguments.csv.display(), study.cases()));
    Ok(Verdict::Done)
}

fn indices(arguments: &IndicesStudyArguments) -> Result<Verdict, StudyError> {
    let (asked, interrupt) = (Study::load(&arguments.place.file)?, Interrupt::install());
    let out = folder(&arguments.place, &asked);
    asked.status(&out)?;
    let (study, out) = asked.for_indices(&out)?;
    let threads = arguments.threads.count();
    if compute(&study, &out, (Shard::WHOLE, threads), (!arguments.quiet, &interrupt))?.is_none() {
        return Err(StudyError::Interrupted);
    }
    let found = study.indices(&out)?;
    if arguments.json {
        json(&found);
    } else if !arguments.quiet {
        tell_indices(&found);
        say(format_args!("{}: {} cases", out.display(), study.cases()));
    }
    Ok(Verdict::Done)
}

/// Prints a line of JSON.
fn json(told: &impl Serialize) {
    // The output consists of numbers and strings, for which JSON has no errors.
    say_json(&serde_json::to_string(told).unwrap_or_default());
}

/// Returns the folder of the parts.
fn folder(place: &PlaceArguments, study: &Study) -> PathBuf {
    let name = place
        .file
        .file_stem()
        .map_or_else(|| study.job.name.clone(), |stem| stem.to_string_lossy().into_owned());
    place.out.clone().unwrap_or_else(|| Path::new("results").join(format!("{name}-study")))
}

fn tell(study: &Study, statistics: &Statistics) {
    let all = statistics.quantiles.iter().enumerate();
    let (words, numbers): (Vec<_>, Vec<_>) = all.partition(|(result, _)| study.codes(*result).is_some());
    if !numbers.is_empty() {
        let mut quantiles = table::plain([
            "result",
            "cases",
            "mean",
            "std. dev.",
            "least",
            "5 %",
            "25 %",
            "median",
            "75 %",
            "95 %",
            "largest",
        ]);
        for (_, one) in numbers {
            let unit = names::unit(&one.result);
            let numbers = [one.mean, one.standard_deviation].into_iter().chain(one.quantiles);
            let cells = numbers.map(|value| shown(value, unit));
            let head = [one.result.clone(), one.count.to_string()];
            quantiles.add_row(head.into_iter().chain(cells));
        }
        table::to_the_right(&mut quantiles, 1..=10);
        say(format_args!("{quantiles}"));
    }
    for (_, one) in words {
        let none = statistics.cases - one.count;
        let counts = one.words.iter().map(|(word, count)| format!("{word} {count}"));
        let counts = counts.chain((none > 0).then(|| format!("without a value {none}")));
        say(format_args!("{}: {}", one.result, counts.collect::<Vec<_>>().join(", ")));
    }
    if statistics.failed > 0 {
        say(format_args!("{} of {} cases failed:", statistics.failed, statistics.cases));
        for (reason, count) in &statistics.reasons {
            say(format_args!("  {count} {reason}"));
        }
    }
    let Some(extremes) = &statistics.extremes else { return };
    for (what, cases) in [("smallest", &extremes.lowest), ("largest", &extremes.highest)] {
        say(format_args!("{what} {}:", extremes.result));
        for (case, value) in cases {
            let set =
                study.overrides(*case).into_iter().map(|(path, value)| format!(" --set {path}={value}"));
            say(format_args!(
                "  {}  case {case}:{}",
                shown(*value, names::unit(&extremes.result)),
                set.collect::<String>()
            ));
        }
    }
}

fn tell_indices(indices: &Indices) {
    for (result, of) in &indices.indices.0 {
        let mut told = table::plain(["number", "first order", "\u{b1}", "total", "\u{b1}"]);
        for (path, index) in &of.0 {
            let cells = [index.first, index.first_error, index.total, index.total_error]
                .map(|value| format!("{:.3}", value.0));
            told.add_row(std::iter::once(path.clone()).chain(cells));
        }
        table::to_the_right(&mut told, 1..=4);
        say(format_args!("{result}\n{told}"));
        let left_out = indices.left_out.0.iter().find(|(name, count)| name == result && *count > 0);
        if let Some((_, count)) = left_out {
            say(format_args!(
                "{count} of {} base samples are left out: a case of each has no such result",
                indices.samples
            ));
        }
        say(format_args!(""));
    }
    say(format_args!("{}", indices.scheme));
}

fn shown(value: Real, unit: &str) -> String {
    // A number without a unit has no prefix.
    if value.0.is_nan() {
        return "\u{2013}".to_owned();
    }
    if unit.is_empty() { format!("{:.4}", value.0) } else { quantity(value, unit) }
}

/// Formats a count with a noun.
fn counted(count: u64, thing: &str) -> String {
    format!("{count} {thing}{}", if count == 1 { "" } else { "s" })
}

/// Formats a duration in suitable units.
fn duration(seconds: Real) -> String {
    let seconds = seconds.0;
    match seconds {
        _ if seconds < 120.0 => quantity(Real(seconds), "s"),
        _ if seconds < 7200.0 => format!("{:.0} min", seconds / 60.0),
        _ if seconds < 48.0 * 3600.0 => format!("{:.1} h", seconds / 3600.0),
        _ => format!("{:.1} days", seconds / 86400.0),
    }
}

/// Formats numbers with consecutive ones as ranges: `0-3, 7`.
fn ranges(numbers: &[u64]) -> String {
    let mut ranges: Vec<[u64; 2]> = Vec::new();
    for number in numbers {
        match ranges.last_mut() {
            Some([_, last]) if *last + 1 == *number => *last = *number,
            _ => ranges.push([*number; 2]),
        }
    }
    let text = ranges
        .iter()
        .map(|[first, last]| if first == last { first.to_string() } else { format!("{first}-{last}") });
    text.collect::<Vec<_>>().join(", ")
}
