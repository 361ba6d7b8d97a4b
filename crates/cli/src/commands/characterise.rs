//! `stickslip characterise`: a curve of a machine.

use crate::arguments::{CharacteriseArguments, span};
use crate::console::answer::{complain, say, say_json, warn};
use crate::console::interrupt::{Interrupt, Interrupted};
use crate::console::progress::Progress;
use crate::console::table;
use crate::console::verdict::Verdict;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_figures::{FigureError, curve as picture};
use stickslip_results::complaint::words;
use stickslip_results::files::CURVE;
use stickslip_results::folder::{Folder, sweep};
use stickslip_results::{Real, Watcher, quantity};
use stickslip_study::curve::{self, Curve, CurveError, Kind, Point, Range, Traced};
use thiserror::Error;

/// Why there is no curve.
#[derive(Debug, Error)]
enum CurveFailure {
    /// What is asked for.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// A range that is none.
    #[error("{option}  {message}")]
    Range { option: &'static str, message: String },
    /// The picture.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The files.
    #[error("{}: {}", .path.display(), words(.source))]
    Write { path: PathBuf, source: io::Error },
}

/// Traces a curve and writes it.
pub(crate) fn characterise(arguments: &CharacteriseArguments) -> Verdict {
    answer(arguments).unwrap_or_else(|failure| {
        complain(format_args!("{failure}"));
        match failure {
            CurveFailure::Curve(_) | CurveFailure::Range { .. } => Verdict::BadInput,
            CurveFailure::Figure(_) | CurveFailure::Write { .. } => Verdict::Stopped,
        }
    })
}

fn answer(arguments: &CharacteriseArguments) -> Result<Verdict, CurveFailure> {
    let vary = || arguments.vary.as_ref().map_or(String::new(), |(path, _)| path.clone());
    let kind = arguments.curve.clone().unwrap_or_else(|| Kind::Vary(vary()));
    let curve = Curve::new(&arguments.file, &arguments.set, kind)?;
    if !arguments.quiet {
        warn(&curve.job);
    }
    let interrupt = Interrupt::install();
    let values = range(arguments, &curve, &Interrupted(&interrupt))?.values()?;
    let progress = Progress::new(!arguments.quiet);
    let bar = progress.budget(curve.kind.name(), values.len() as f64, &interrupt);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut traced = curve.trace(&values, arguments.threads.map_or(cores, usize::from), &bar);
    drop(bar);
    // Of half a curve nobody knows where it is best.
    if !interrupt.is_raised() {
        curve.mark(&mut traced, arguments.tolerance, &Interrupted(&interrupt))?;
    }
    let names = write(arguments, &curve, &traced)?;
    if arguments.json {
        say_json(&curve::json(&curve, &traced));
    } else if !arguments.quiet {
        tell(&curve, &traced);
        say(format_args!("\n{}: {}", folder(arguments, &curve).display(), names.join(", ")));
    }
    Ok(verdict(&traced, interrupt.is_raised()))
}

/// The range asked for, or what is worth looking at.
fn range(
    arguments: &CharacteriseArguments,
    curve: &Curve,
    watcher: &dyn Watcher,
) -> Result<Range, CurveFailure> {
    let (option, text) = match (&arguments.vary, &arguments.range) {
        (Some((_, range)), _) => ("--vary", Some(range.as_str())),
        (None, range) => ("--range", range.as_deref()),
    };
    let refused = |message: String| CurveFailure::Range { option, message };
    let [from, to] = match text {
        None => curve.range(watcher).ok_or_else(|| CurveError::NoRange(curve.variation.name.clone()))?,
        Some(text) => span(text, curve.variation.unit).map_err(refused)?,
    };
    Ok(Range { from, to, points: arguments.points, decades: arguments.log })
}

/// Where the files go.
fn folder(arguments: &CharacteriseArguments, curve: &Curve) -> PathBuf {
    let own = || Path::new("results").join(format!("{}-{}", curve.job.name, curve.kind.name()));
    arguments.out.clone().unwrap_or_else(own)
}

fn write(
    arguments: &CharacteriseArguments,
    curve: &Curve,
    traced: &Traced,
) -> Result<Vec<String>, CurveFailure> {
    let out = folder(arguments, curve);
    let pictures = picture::draw((curve, traced), arguments.log, &arguments.look.look())?;
    let failed = |source| CurveFailure::Write { path: out.clone(), source };
    let folder = Folder::make(&out).map_err(failed)?;
    // A command that was killed has left its drafts.
    let stale = picture::all_files();
    let own = [curve::TABLE, CURVE].map(str::to_owned).into_iter();
    sweep(&out, &own.chain(stale.iter().cloned()).collect::<Vec<_>>());
    curve::write(folder, (curve, traced), &pictures, stale).map_err(failed)
}

/// The points as a table, and what is wrong with some of them.
fn tell(curve: &Curve, traced: &Traced) {
    let heads = [curve.variation.name.as_str(), "step", "mean speed"].into_iter();
    let mut table = table::plain(heads.chain(curve.kind.is_of_load().then_some("power")).chain(["motion"]));
    for (place, point) in traced.points.iter().enumerate() {
        table.add_row(row(curve, traced, (place, point)));
    }
    table::to_the_right(&mut table, 0..=if curve.kind.is_of_load() { 3 } else { 2 });
    say(format_args!("{table}"));
    for landmark in &traced.landmarks {
        match &landmark.at {
            Ok(at) => {
                let off = 100.0 * landmark.half_width / at.abs();
                say(format_args!(
                    "{}: {} \u{b1} {off:.2e} %, {} points",
                    landmark.words(),
                    shown(*at, curve.variation.unit),
                    landmark.runs
                ));
            }
            Err(why) => say(format_args!("{}: {why}", landmark.words())),
        }
    }
    if !traced.is_known {
        complain(format_args!(
            "note: which way the drive steps without load is not known; loads act against +x"
        ));
    }
    let first = traced.points.iter().find_map(|point| Some((point.value, point.motion.as_ref().err()?)));
    if let Some((value, fault)) = first {
        let (count, all) = (traced.faults(), traced.points.len());
        let at = shown(value, curve.variation.unit);
        complain(format_args!("note: {count} of {all} points have no motion; at {at}: {fault}"));
    }
}

fn row(curve: &Curve, traced: &Traced, (place, point): (usize, &Point)) -> Vec<String> {
    let value = shown(point.value, curve.variation.unit);
    let power = |place| traced.power(curve, place).map_or(String::new(), |power| shown(power, "W"));
    let power = curve.kind.is_of_load().then(|| power(place));
    let (step, speed, word) = match &point.motion {
        Ok(motion) if motion.is_still() => (shown(0.0, "m"), shown(0.0, "m/s"), "no step"),
        Ok(motion) => (shown(motion.step, "m"), shown(motion.speed(), "m/s"), motion.course.word()),
        Err(fault) => (String::new(), String::new(), fault.kind()),
    };
    [value, step, speed].into_iter().chain(power).chain([word.to_owned()]).collect()
}

fn shown(value: f64, unit: &str) -> String {
    // A prefix belongs to a unit.
    if unit.is_empty() { format!("{value:.4}") } else { quantity(Real(value), unit) }
}

/// How the command ends.
fn verdict(traced: &Traced, is_interrupted: bool) -> Verdict {
    match () {
        () if is_interrupted => Verdict::Interrupted,
        () if traced.faults() == traced.points.len() => Verdict::Stopped,
        () => Verdict::Done,
    }
}
