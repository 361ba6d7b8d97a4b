//! `stickslip curve --curve holding-force`: holding force of the drive at rest.

use super::{CurveFailure, complain_of_warnings, ends, of, place, prepared, said, shown, shows_rows};
use crate::arguments::CurveArguments;
use crate::commands::output::OutputFailure;
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_figures::curve::{self as pictures, holding as picture};
use stickslip_study::curve::all_files;
use stickslip_study::curve::holding::{self, Held, Holding, NAME, Point};

/// Computes holding forces and writes the results.
pub(super) fn trace(arguments: &CurveArguments) -> Result<Verdict, CurveFailure> {
    let over = arguments.vary.as_ref().map(|(path, _)| path.as_str());
    let holding = Holding::new(prepared(arguments)?, over)?;
    if !arguments.quiet {
        warn(&holding.job);
    }
    let ends = match ends(arguments, holding.variation.unit)? {
        Some(ends) => ends,
        None => holding.range()?,
    };
    let values =
        of(arguments, ends).values().map_err(|error| said(arguments, holding.variation.unit, error))?;
    let output = place(arguments, &holding.job, NAME)?;
    let out = output.path.clone();
    let (interrupt, progress) = (Interrupt::install(), Progress::new(!arguments.quiet));
    let name = &holding.job.name;
    progress.tell(format_args!("{name}: {NAME}, {} points", values.len()));
    let bar = progress.budget(NAME, values.len() as f64, &interrupt);
    let points = holding.trace(&values, arguments.tolerance, arguments.work.threads.count(), &bar)?;
    drop(bar);
    let (done, all) = (points.iter().filter(|point| point.is_done()).count(), points.len());
    progress.tell(format_args!("{name}: {NAME}, {done} of {all} points done"));
    if done == 0 {
        return Ok(Verdict::Interrupted);
    }
    let drawn = picture::draw((&holding, &points), arguments.log, &arguments.look.look())
        .map_err(OutputFailure::from)?;
    let names = output.write(all_files(), pictures::all_files(done < all), |folder, stale| {
        holding::write(folder, (&holding, &points), &drawn, stale)
    })?;
    if arguments.json {
        say_json(&holding::json(&holding, &points));
    } else if !arguments.quiet {
        tell(&holding, &points, shows_rows(arguments, points.len()));
        say(format_args!("\n{}: {}", out.display(), names.join(", ")));
    }
    let stopped = points.iter().all(|point| point.ways.iter().all(Result::is_err));
    // If there is no result at all, the reason is an error and not a note.
    if stopped && (arguments.quiet || arguments.json) {
        complain_of_faults(&holding, &points);
    }
    Ok(match done < all {
        true => Verdict::Interrupted,
        false if stopped => Verdict::Stopped,
        false => Verdict::Done,
    })
}

/// Prints the table of points or the range of holding forces, and notes on points without results.
fn tell(holding: &Holding, points: &[Point], rows: bool) {
    say(format_args!("holding force of {}", holding.on()));
    if rows {
        tell_rows(holding, points);
    } else {
        tell_extremes(points);
        say(format_args!("{} points in curve.csv, --rows prints them", points.len()));
    }
    complain_of_faults(holding, points);
    complain_of_warnings(&holding.job, points.iter().map(|point| point.warnings.as_slice()));
}

/// Prints the smallest and largest holding force in each direction.
fn tell_extremes(points: &[Point]) {
    for (way, sense) in ["+x", "\u{2212}x"].into_iter().enumerate() {
        let forces = points.iter().filter_map(|point| Some(point.ways[way].as_ref().ok()?.force));
        let [least, most] = forces.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], force| {
            [least.min(force), most.max(force)]
        });
        if least <= most {
            say(format_args!("along {sense}: {} to {}", shown(least, "N"), shown(most, "N")));
        }
    }
}

/// Prints the points as a table.
fn tell_rows(holding: &Holding, points: &[Point]) {
    let heads = ["load along +x", "\u{b1}", "beyond", "load along \u{2212}x", "\u{b1}", "beyond"];
    let mut table = table::plain([holding.variation.name.as_str()].into_iter().chain(heads));
    for point in points {
        let ways = point.ways.iter().flat_map(|way| match way {
            Ok(Held { force, half_width, lost, .. }) => {
                [shown(*force, "N"), shown(*half_width, "N"), lost.words()]
            }
            Err(fault) => [String::new(), String::new(), fault.kind().to_owned()],
        });
        table.add_row([shown(point.value, holding.variation.unit)].into_iter().chain(ways));
    }
    [0..=2, 4..=5].into_iter().for_each(|columns| table::to_the_right(&mut table, columns));
    say(format_args!("{table}"));
}

/// Prints the number of missing holding forces and the first reason.
fn complain_of_faults(holding: &Holding, points: &[Point]) {
    let faults = points
        .iter()
        .flat_map(|point| point.ways.iter().filter_map(|way| Some((point.value, way.as_ref().err()?))));
    let faults: Vec<_> = faults.collect();
    if let Some((value, fault)) = faults.first() {
        let at = shown(*value, holding.variation.unit);
        let all = 2 * points.len();
        complain(format_args!(
            "note: {} of {all} holding forces were not found; at {at}: {fault}",
            faults.len()
        ));
    }
}
