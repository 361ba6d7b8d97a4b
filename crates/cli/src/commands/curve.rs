//! `stickslip curve`: curves of a drive.

mod holding;

use super::output::{Output, OutputFailure};
use crate::arguments::CurveArguments;
use crate::arguments::curve::CurveName;
use std::path::Path;
use std::sync::Arc;
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::interrupt::{Interrupt, Interrupted};
use stickslip_console::progress::Progress;
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_figures::curve as picture;
use stickslip_run::{Job, Real, Warning, quantity};
use stickslip_study::curve::{self, Curve, CurveError, Kind, Point, Range, Traced, Way};
use thiserror::Error;

/// Smallest error relative to the step length that is shown.
const SHOWN: f64 = 1e-4;

/// Error that stops the command.
#[derive(Debug, Error)]
enum CurveFailure {
    /// The request is invalid.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// A range is invalid.
    #[error("{option}  {message}")]
    Range { option: &'static str, message: String },
    /// A named curve was requested together with a parameter.
    #[error(
        "--vary  cannot be used with --curve {0}, which has its own parameter; only holding-force takes both options"
    )]
    VariesItself(&'static str),
    /// Holding forces were requested with reversed waveforms.
    #[error("--both  cannot be used with --curve holding-force, which always gives both directions")]
    HeldBothWays,
    /// The files cannot be written.
    #[error(transparent)]
    Output(#[from] OutputFailure),
}

/// Computes a curve and writes the results.
pub(crate) fn curve(arguments: &CurveArguments) -> Verdict {
    answer(arguments).unwrap_or_else(|failure| {
        complain(format_args!("{failure}"));
        match failure {
            CurveFailure::Curve(_)
            | CurveFailure::Range { .. }
            | CurveFailure::VariesItself(_)
            | CurveFailure::HeldBothWays => Verdict::BadInput,
            CurveFailure::Output(failure) => failure.verdict(),
        }
    })
}

fn answer(arguments: &CurveArguments) -> Result<Verdict, CurveFailure> {
    match (&arguments.curve, &arguments.vary) {
        (Some(CurveName::HoldingForce), _) if arguments.both => Err(CurveFailure::HeldBothWays),
        (Some(CurveName::HoldingForce), _) => holding::trace(arguments),
        (Some(CurveName::Of(kind)), Some(_)) => Err(CurveFailure::VariesItself(kind.name())),
        (Some(CurveName::Of(kind)), None) => trace(arguments, kind.clone()),
        (None, vary) => {
            trace(arguments, Kind::Vary(vary.as_ref().map_or(String::new(), |(path, _)| path.clone())))
        }
    }
}

/// Computes a curve of the steady motion, for one or both directions of the waveforms, and writes it.
fn trace(arguments: &CurveArguments, kind: Kind) -> Result<Verdict, CurveFailure> {
    let job = prepared(arguments)?;
    let mut curves = match arguments.both {
        true => Vec::from(Curve::both(job, &kind)?),
        false => vec![Curve::new(job, kind)?],
    };
    let first = &curves[0];
    if !arguments.quiet {
        warn(&first.job);
        let stacks = stickslip_run::info::piezos(&first.job).0;
        stacks
            .iter()
            .flat_map(|(_, stack)| &stack.words)
            .for_each(|text| complain(format_args!("note: {text}")));
    }
    let asked = range(arguments, first)?;
    let output = place(arguments, &first.job, first.kind.name())?;
    let out = output.path.clone();
    let journal = Arc::new(output.journal("curve", &first.job.hash, arguments.work.fresh)?);
    for curve in &mut curves {
        curve.journal = Arc::clone(&journal);
    }
    let first = &curves[0];
    let (interrupt, progress) = (Interrupt::install(), Progress::new(!arguments.quiet));
    let (name, what) = (&first.job.name, first.kind.name());
    let count = arguments.points * curves.len();
    progress.tell(format_args!("{name}: {what}, {count} points"));
    let Some(values) = values(arguments, (&curves, asked), (&progress, &interrupt))? else {
        return Ok(Verdict::Interrupted);
    };
    let mut all = Vec::new();
    for curve in &curves {
        all.push((curve, followed(arguments, (curve, &values), (&progress, &interrupt))?));
    }
    let ways: Vec<Way<'_>> = all.iter().map(|(curve, traced)| (*curve, traced)).collect();
    let done: usize = ways.iter().map(|(_, traced)| traced.done()).sum();
    let count: usize = ways.iter().map(|(_, traced)| traced.points.len()).sum();
    progress.tell(format_args!("{name}: {what}, {done} of {count} points done"));
    if done == 0 {
        return Ok(Verdict::Interrupted);
    }
    let names = write(arguments, &ways, output)?;
    if arguments.json {
        say_json(&curve::json(&ways));
    } else if !arguments.quiet {
        ways.iter().for_each(|(curve, traced)| tell(curve, traced, shows_rows(arguments, values.len())));
        say(format_args!("\n{}: {}", out.display(), names.join(", ")));
    }
    let verdict = verdict(&ways);
    if verdict != Verdict::Interrupted {
        journal.remove();
    }
    // If there is no result at all, the reason is an error and not a note.
    if verdict == Verdict::Stopped && (arguments.quiet || arguments.json) {
        ways.iter().take(1).for_each(|(curve, traced)| complain_of_faults(curve, traced));
    }
    Ok(verdict)
}

fn prepared(arguments: &CurveArguments) -> Result<Job, CurveFailure> {
    Job::prepare(&arguments.file, &arguments.set, Path::new(""))
        .map_err(|refusal| CurveError::from(refusal).into())
}

/// Returns the values of the points. Returns `None` if the search for a default range was interrupted.
fn values(
    arguments: &CurveArguments,
    (curves, asked): (&[Curve], Option<Range>),
    (progress, interrupt): (&Progress, &Interrupt),
) -> Result<Option<Vec<f64>>, CurveFailure> {
    if let Some(range) = asked {
        return Ok(Some(range.values()?));
    }
    let name = &curves[0].job.name;
    progress.tell(format_args!("{name}: searching for a range"));
    let found = wide(curves, interrupt);
    // An interrupted search gives no range.
    if interrupt.is_raised() {
        complain(format_args!("{name}: interrupted during the search for a range; no point is done"));
        return Ok(None);
    }
    Ok(Some(found.map(|range| of(arguments, range).values()).transpose()?.unwrap_or_default()))
}

/// Returns a default range that covers those of all curves.
fn wide(curves: &[Curve], interrupt: &Interrupt) -> Option<[f64; 2]> {
    let ranges = curves.iter().map(|curve| curve.range(&Interrupted(interrupt)));
    let all: Vec<[f64; 2]> = ranges.collect::<Option<_>>()?;
    all.into_iter().reduce(|[from, to], [other, beyond]| [from.min(other), to.max(beyond)])
}

/// Computes the points and landmarks of a curve.
fn followed(
    arguments: &CurveArguments,
    (curve, values): (&Curve, &[f64]),
    (progress, interrupt): (&Progress, &Interrupt),
) -> Result<Traced, CurveFailure> {
    let sense = curve.sense.map_or(String::new(), |sense| format!(" {}", sense.name()));
    let bar = progress.budget(&format!("{}{sense}", curve.kind.name()), values.len() as f64, interrupt);
    let mut traced = curve.trace(values, arguments.work.threads.count(), &bar);
    drop(bar);
    let bar = progress.budget(&format!("stall, S\u{2080} and maxima{sense}"), 1.0, interrupt);
    curve.mark(&mut traced, arguments.tolerance, arguments.work.threads.count(), &bar)?;
    Ok(traced)
}

/// Returns the requested range, or `None` if a default range must be found.
fn range(arguments: &CurveArguments, curve: &Curve) -> Result<Option<Range>, CurveFailure> {
    let asked = ends(arguments, curve.variation.unit)?;
    let known = || curve.variation.range.ok_or_else(|| curve.no_range());
    let range = of(arguments, asked.map_or_else(known, Ok)?);
    range.values().map_err(|error| said(arguments, curve.variation.unit, error))?;
    Ok(asked.map(|_| range))
}

/// Adds the option and the unit to the message of an invalid range.
fn said(arguments: &CurveArguments, unit: &str, error: CurveError) -> CurveFailure {
    let own = if arguments.vary.is_some() { "--vary" } else { "--range" };
    let shown = |end: f64| if end.is_finite() { shown(end, unit) } else { end.to_string() };
    let (option, message) = match error {
        CurveError::Range { from, to } => (
            own,
            format!(
                "expected a range that rises from one finite value to another, got {} to {}",
                shown(from),
                shown(to)
            ),
        ),
        CurveError::Decades { from, to } => (
            "--log",
            format!("expected a range above 0 for logarithmic spacing, got {} to {}", shown(from), shown(to)),
        ),
        CurveError::Points { .. } => ("--points", error.to_string()),
        other => return other.into(),
    };
    CurveFailure::Range { option, message }
}

/// Returns the ends of the requested range, SI.
fn ends(arguments: &CurveArguments, unit: &str) -> Result<Option<[f64; 2]>, CurveFailure> {
    let (option, text) = match (&arguments.vary, &arguments.range) {
        (Some((_, range)), _) => ("--vary", Some(range.as_str())),
        (None, range) => ("--range", range.as_deref()),
    };
    let refused = |message: String| CurveFailure::Range { option, message };
    text.map(|text| Range::ends(text, unit).map_err(refused)).transpose()
}

fn of(arguments: &CurveArguments, [from, to]: [f64; 2]) -> Range {
    Range { from, to, points: arguments.points, decades: arguments.log }
}

/// Returns the output folder. It is checked before the first point, which may take long.
fn place(arguments: &CurveArguments, job: &Job, curve: &str) -> Result<Output, OutputFailure> {
    Output::ready(arguments.out.as_deref(), &format!("{}-{curve}", job.name))
}

fn write(arguments: &CurveArguments, ways: &[Way<'_>], output: Output) -> Result<Vec<String>, OutputFailure> {
    let pictures = picture::draw(ways, arguments.log, &arguments.look.look())?;
    let stale = picture::all_files(ways.iter().any(|(_, traced)| traced.is_cut()));
    output.write(curve::all_files(), stale, |folder, stale| curve::write(folder, ways, &pictures, stale))
}

/// Maximum number of points whose table is printed by default.
const MOST_ROWS: usize = 20;

/// Returns whether the table of points is printed.
fn shows_rows(arguments: &CurveArguments, points: usize) -> bool {
    arguments.rows || points <= MOST_ROWS
}

/// Prints the landmarks, the table of points if requested, and notes on points without results.
fn tell(curve: &Curve, traced: &Traced, rows: bool) {
    if let Some(sense) = curve.sense {
        say(format_args!("{}", sense.name()));
    }
    if rows {
        tell_rows(curve, traced);
    }
    tell_landmarks(curve, traced);
    if !rows {
        say(format_args!("{} points in curve.csv, --rows prints them", traced.points.len()));
    }
    if !traced.is_known {
        complain(format_args!("note: the step direction without load is not known; loads act against +x"));
    }
    complain_of_faults(curve, traced);
    complain_of_warnings(&curve.job, traced.points.iter().map(|point| point.warnings.as_slice()));
}

/// Prints how many points have warnings of each kind, except for kinds that the scenario itself has.
fn complain_of_warnings<'a>(job: &Job, points: impl Iterator<Item = &'a [Warning]>) {
    let (own, all): (_, Vec<&[Warning]>) = (job.warnings(), points.collect());
    let mut kinds: Vec<&str> = all.iter().flat_map(|warnings| warnings.iter().map(|it| it.kind)).collect();
    kinds.sort_unstable();
    kinds.dedup();
    kinds.retain(|kind| own.iter().all(|odd| odd.kind != *kind));
    for kind in kinds {
        let warned = all.iter().filter(|warnings| warnings.iter().any(|it| it.kind == kind)).count();
        complain(format_args!(
            "warning: {kind} at {warned} of {} points; curve.json has the messages",
            all.len()
        ));
    }
}

/// Prints the points as a table.
fn tell_rows(curve: &Curve, traced: &Traced) {
    let heads = [curve.variation.name.as_str(), "step", "\u{b1}", "oscillates by", "mean speed"].into_iter();
    let mut table = table::plain(heads.chain(curve.kind.is_of_load().then_some("power")).chain(["motion"]));
    for (place, point) in traced.points.iter().enumerate() {
        table.add_row(row(curve, traced, (place, point)));
    }
    table::to_the_right(&mut table, 0..=if curve.kind.is_of_load() { 5 } else { 4 });
    say(format_args!("{table}"));
}

fn tell_landmarks(curve: &Curve, traced: &Traced) {
    for landmark in &traced.landmarks {
        match &landmark.at {
            Ok(at) => {
                let there = landmark.value.map(|value| shown(value, landmark.unit()) + " at ");
                say(format_args!(
                    "{}: {}{} \u{b1} {} ({} points)",
                    landmark.words(&curve.variation.name),
                    there.unwrap_or_default(),
                    shown(*at, curve.variation.unit),
                    shown(landmark.half_width, curve.variation.unit),
                    landmark.runs
                ));
            }
            Err(why) => say(format_args!("{}: {why}", landmark.words(&curve.variation.name))),
        }
    }
}

/// Prints the number of points without a result and the first reason.
fn complain_of_faults(curve: &Curve, traced: &Traced) {
    let first = traced.points.iter().find_map(|point| Some((point.value, point.motion.as_ref().err()?)));
    if let Some((value, fault)) = first {
        let (count, all) = (traced.faults(), traced.points.len());
        let at = shown(value, curve.variation.unit);
        complain(format_args!("note: {count} of {all} points have no result; at {at}: {fault}"));
    }
}

fn row(curve: &Curve, traced: &Traced, (place, point): (usize, &Point)) -> Vec<String> {
    let value = shown(point.value, curve.variation.unit);
    let nothing = || [const { String::new() }; 4];
    let length = |length| shown(length, "m");
    let ([step, error, spread, speed], word) = match &point.motion {
        Ok(motion) if motion.stands() => {
            ([length(0.0), String::new(), String::new(), shown(0.0, "m/s")], motion.word())
        }
        Ok(motion) => {
            let error = Some(motion.error).filter(|error| *error > SHOWN * motion.step.abs());
            let spread = Some(motion.spread).filter(|spread| *spread > 0.0);
            let [error, spread] = [error, spread].map(|some| some.map(length).unwrap_or_default());
            ([length(motion.step), error, spread, shown(motion.speed(), "m/s")], motion.word())
        }
        Err(fault) => (nothing(), fault.kind()),
    };
    let power = |place| traced.power(curve, place).map_or(String::new(), |power| shown(power, "W"));
    let power = curve.kind.is_of_load().then(|| power(place));
    [value, step, error, spread, speed].into_iter().chain(power).chain([word.to_owned()]).collect()
}

fn shown(value: f64, unit: &str) -> String {
    // A number without a unit has no prefix.
    if unit.is_empty() { format!("{value:.4}") } else { quantity(Real(value), unit) }
}

/// Returns the exit status of the command.
fn verdict(ways: &[Way<'_>]) -> Verdict {
    match () {
        () if ways.iter().any(|(_, traced)| traced.is_cut()) => Verdict::Interrupted,
        () if ways.iter().all(|(_, traced)| traced.faults() == traced.points.len()) => Verdict::Stopped,
        () => Verdict::Done,
    }
}
