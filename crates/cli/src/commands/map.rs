//! `stickslip map`: a result over two parameters.

use super::output::{Output, OutputFailure};
use crate::arguments::MapArguments;
use std::path::Path;
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::verdict::Verdict;
use stickslip_figures::map as picture;
use stickslip_run::{Job, Real, quantity};
use stickslip_study::map::{self, Asked, Field, Map, MapError, Overlay};
use stickslip_study::sweep::StudyError;
use thiserror::Error;

/// Maximum number of reasons that are printed.
const REASONS: usize = 3;

/// Error that stops the command.
#[derive(Debug, Error)]
enum MapFailure {
    /// The map fails.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The files cannot be written.
    #[error(transparent)]
    Output(#[from] OutputFailure),
}

/// Computes a map and writes the results.
pub(crate) fn map(arguments: &MapArguments) -> Verdict {
    answer(arguments).unwrap_or_else(|failure| {
        complain(format_args!("{failure}"));
        match failure {
            MapFailure::Map(MapError::Interrupted) => Verdict::Interrupted,
            MapFailure::Map(MapError::Nothing { .. }) => Verdict::Stopped,
            MapFailure::Map(MapError::Study(error)) if !error.is_input() => match error {
                StudyError::Interrupted => Verdict::Interrupted,
                _ => Verdict::Stopped,
            },
            MapFailure::Map(_) => Verdict::BadInput,
            MapFailure::Output(failure) => failure.verdict(),
        }
    })
}

fn answer(arguments: &MapArguments) -> Result<Verdict, MapFailure> {
    let interrupt = Interrupt::install();
    let MapArguments { file, set, x, y, of, .. } = arguments;
    let job = Job::prepare(file, set, Path::new("")).map_err(MapError::from)?;
    let asked = Asked {
        x: x.clone(),
        y: y.clone(),
        logarithmic: [arguments.log_x, arguments.log_y],
        of: of.clone(),
        points: arguments.points,
        by_runs: false,
    };
    let mut map = Map::new(job, (file, set), &asked)?;
    let overlay = arguments.overlay.as_deref().map(|path| Overlay::load(path, &map)).transpose()?;
    if !arguments.quiet {
        warn(&map.job);
    }
    let name = map.job.name.clone();
    // Before the first run.
    let output = Output::ready(arguments.out.as_deref(), &format!("{name}-map"))?;
    let out = output.path.clone();
    if map.is_of_regime() {
        let axes = [&map.axes[0], &map.axes[1]].map(|axis| (&axis.path, axis.range, axis.is_logarithmic));
        map.journal = output.journal("map", &(&map.job.hash, &map.of, axes), arguments.work.fresh)?;
    }
    let progress = Progress::new(!arguments.quiet);
    progress.tell(format_args!("{name}: map of {of}, {} points", map.cases()));
    let bar = progress.budget(&name, map.cases() as f64, &interrupt);
    if arguments.work.fresh {
        map.remove(&out.join("parts"))?;
    }
    let field = map.compute(&out.join("parts"), arguments.work.threads.count(), &bar)?;
    drop(bar);
    let pictures = picture::draw((&map, &field), overlay.as_ref(), &arguments.look.look())
        .map_err(OutputFailure::from)?;
    let names = output.write(map::all_files(), picture::all_files(), |folder, stale| {
        map::write(folder, (&map, &field), &pictures, stale)
    })?;
    if arguments.json {
        say_json(&map::json(&map, &field));
    } else if !arguments.quiet {
        tell(&map, &field);
        say(format_args!("{}: {}", out.display(), names.join(", ")));
    }
    map.journal.remove();
    Ok(Verdict::Done)
}

/// Prints a short description of the map.
fn tell(map: &Map, field: &Field) {
    let known = || field.values.iter().copied().filter(|value| value.is_finite());
    match &field.words {
        None => {
            let (low, high) =
                (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
            let shown = |value: f64| match map.unit {
                // A number without a unit has no prefix.
                "" => format!("{value:.4}"),
                unit => quantity(Real(value), unit),
            };
            say(format_args!("{}: {} to {}", map.of, shown(low), shown(high)));
        }
        Some(words) => {
            let count = |class: usize| known().filter(|value| *value == class as f64).count();
            let counts = words.iter().enumerate().map(|(class, word)| (word, count(class)));
            let counts =
                counts.filter(|(_, count)| *count > 0).map(|(word, count)| format!("{word} {count}"));
            say(format_args!("{}: points {}", map.of, counts.collect::<Vec<_>>().join(", ")));
        }
    }
    for border in &field.borders {
        let [lesser, greater] = border.between.map(map::Regime::word);
        say(format_args!("border between {lesser} and {greater}: {} points", border.points.len()));
    }
    if map.is_of_regime() {
        match field.runs {
            0 => say(format_args!("computed without runs: waveforms prescribe the motion")),
            runs => say(format_args!("{runs} runs")),
        }
    }
    let failed = field.values.iter().filter(|value| value.is_nan()).count();
    if failed > 0 {
        say(format_args!("{failed} of {} points have no result", map.cases()));
    }
    for (why, count) in field.faults.iter().take(REASONS) {
        say(format_args!("  {count}: {why}"));
    }
}
