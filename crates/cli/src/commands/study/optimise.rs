//! `stickslip study optimise`: finds the maximum or minimum of a result.

use super::{json, shown};
use crate::arguments::study::OptimiseStudyArguments;
use std::fs;
use std::io;
use std::path::Path;
use stickslip_console::answer::{say, warn};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_figures::Look;
use stickslip_figures::curve::optimum as picture;
use stickslip_quantity::names;
use stickslip_run::files::OPTIMUM;
use stickslip_run::{Real, folder};
use stickslip_scenario::quantity;
use stickslip_study::optimum::{Best, Optimum, Report};
use stickslip_study::sweep::StudyError;

/// File with one sampled period of the waveform, for a signal generator.
const SAMPLES: &str = "waveform.csv";
/// File with the waveform in the form of a scenario.
const WAVEFORM: &str = "waveform.json";

pub(super) fn optimise(arguments: &OptimiseStudyArguments) -> Result<Verdict, StudyError> {
    let OptimiseStudyArguments { file, out, gain, quiet, work, .. } = arguments;
    let rate = arguments.rate.as_deref().map(sample_rate).transpose()?;
    if !(gain.is_finite() && *gain != 0.0) {
        return Err(StudyError::Unasked(format!("--gain {gain}: expected a finite number other than 0")));
    }
    let (optimum, interrupt) = (Optimum::load(file)?, Interrupt::install());
    if !quiet {
        warn(&optimum.job);
    }
    let stem =
        file.file_stem().map_or_else(|| optimum.job.name.clone(), |stem| stem.to_string_lossy().into_owned());
    let out = out.clone().unwrap_or_else(|| Path::new("results").join(format!("{stem}-optimum")));
    let progress = Progress::new(!quiet && !arguments.json);
    progress.tell(format_args!(
        "{}: {} variables, at most {} evaluations",
        optimum.job.name,
        optimum.dimensions(),
        optimum.most_evaluations()
    ));
    let bar = progress.budget(&optimum.job.name, optimum.most_evaluations() as f64, &interrupt);
    let best = optimum.run(&out, (work.threads.count(), work.fresh), &bar)?;
    drop(bar);
    let report = optimum.report(&best);
    let files = write(&out, (&optimum, &best, &report), (rate, *gain), &arguments.look.look())?;
    if arguments.json {
        json(&report);
    } else if !quiet {
        tell(&report);
        say(format_args!("{}: {}", out.display(), files.join(", ")));
    }
    Ok(Verdict::Done)
}

/// Reads a sample rate in Hz, with or without a unit.
fn sample_rate(text: &str) -> Result<f64, StudyError> {
    let refused = |why: &str| StudyError::Unasked(format!("--rate {text}: {why}"));
    let rate = match text.parse::<f64>() {
        Ok(rate) => rate,
        Err(_) => quantity(text, "Hz").map_err(|why| refused(&why))?,
    };
    if rate > 0.0 && rate.is_finite() { Ok(rate) } else { Err(refused("expected a frequency above 0")) }
}

/// Writes all files, `optimum.json` last. Returns their names.
fn write(
    out: &Path,
    (optimum, best, report): (&Optimum, &Best, &Report),
    (rate, gain): (Option<f64>, f64),
    look: &Look,
) -> Result<Vec<String>, StudyError> {
    let disk = |name: &str, source| StudyError::Disk { path: out.join(name), source };
    let pictures = picture::draw(&optimum.job, &report.result, &best.sections, look);
    let mut files = pictures.map_err(|error| disk(picture::NAME, io::Error::other(error)))?;
    files.extend(optimum.samples(best, rate, gain).map(|text| (SAMPLES.to_owned(), text.into_bytes())));
    files.extend(optimum.waveform(best).map(|text| (WAVEFORM.to_owned(), text.into_bytes())));
    let mut json =
        serde_json::to_vec_pretty(report).map_err(|error| disk(OPTIMUM, io::Error::other(error)))?;
    json.push(b'\n');
    files.push((OPTIMUM.to_owned(), json));
    // Delete files of an earlier search.
    for stale in Look::all_files_of(&[picture::NAME]).iter().map(String::as_str).chain([SAMPLES, WAVEFORM]) {
        drop(fs::remove_file(out.join(stale)));
    }
    for (name, bytes) in &files {
        folder::write(&out.join(name), bytes).map_err(|source| disk(name, source))?;
    }
    Ok(files.into_iter().map(|(name, _)| name).collect())
}

/// Relative difference of local searches above which it is reported.
const DISAGREE: f64 = 0.01;

fn tell(report: &Report) {
    let unit = names::unit(&report.result);
    let Report { goal, result, best, .. } = report;
    say(format_args!("{goal} of {result}: {}", shown(best.value, unit)));
    for period in report.periods.iter().filter(|_| report.periods.len() > 1) {
        say(format_args!("  at {} times the period: {}", period.factor.0, shown(period.value, unit)));
    }
    let mut numbers = table::plain(["number", "optimum", "within 0.1 %", "within 1 %"]);
    for flat in &report.flatness {
        let one = |value: Real| shown(value, flat.unit);
        let range = |[low, high]: [Option<Real>; 2]| {
            let end = |end: Option<Real>| end.map_or_else(|| "bound".to_owned(), one);
            format!("{} to {}", end(low), end(high))
        };
        numbers.add_row([
            flat.number.clone(),
            one(flat.best),
            range(flat.within_0_1_percent),
            range(flat.within_1_percent),
        ]);
    }
    say(format_args!("{numbers}"));
    for limit in &report.limits {
        say(format_args!("limit: {limit}"));
    }
    let ends: Vec<String> = report.starts.iter().map(|start| shown(start.to, unit)).collect();
    say(format_args!("results of the local searches: {}", ends.join(", ")));
    say(format_args!("{} evaluations, {} without a result", report.evaluations, report.failed));
    // The waveform is the last entry and has its own file.
    let numbers = best.set.len() - usize::from(report.waveform.is_some());
    let mut set: Vec<String> = best.set.iter().take(numbers).map(|set| format!("--set {set}")).collect();
    set.extend(report.waveform.as_ref().map(|_| format!("the waveform of {WAVEFORM}")));
    say(format_args!("options for `stickslip steady` and `run`: {}", set.join(" ")));
    let (low, high) = (fold(report, f64::min), fold(report, f64::max));
    if high - low > DISAGREE * high.abs().max(low.abs()) {
        say(format_args!(
            "the local searches disagree by {:.0} %: more \"starts\" may find a better optimum",
            100.0 * (high - low) / high.abs().max(low.abs())
        ));
    }
}

/// Returns the smallest or largest result of the local searches.
fn fold(report: &Report, of: impl Fn(f64, f64) -> f64) -> f64 {
    report.starts.iter().map(|start| start.to.0).reduce(of).unwrap_or(f64::NAN)
}
