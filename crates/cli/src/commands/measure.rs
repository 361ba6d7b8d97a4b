//! `stickslip measure`: measured loops, and a simulated one beside them.

use crate::arguments::MeasureArguments;
use serde_json::json;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_console::answer::{complain, say, say_json};
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_figures::FigureError;
use stickslip_figures::measured::{self as picture, Curve, Loops};
use stickslip_measure::Cycle;
use stickslip_run::complaint::words;
use stickslip_run::folder::{Folder, sweep};
use stickslip_run::measured::{Account, Measured, MeasuredCycle, MeasuredError, simulated, table};
use stickslip_run::{Real, Results, ResultsError, quantity};
use stickslip_scenario::PlotName;
use thiserror::Error;

/// A deviation below this share of the mean is rounding.
const ROUNDING: f64 = 1e-12;
/// Most stages that are printed.
const MOST_STAGES: usize = 12;
/// Most rows of cycles before the last that are drawn.
const MOST_DRAWN: usize = 100_000;
/// Name of the table that is written.
const CYCLES: &str = "cycles.csv";

/// Why there are no loops.
#[derive(Debug, Error)]
enum LoopFailure {
    /// The table.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// What is to stand beside.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// Its contact.
    #[error("--contact  {folder}: {words}")]
    Contact { folder: String, words: String },
    /// The picture.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The folder.
    #[error("{}: the files cannot be written: {}", .folder.display(), words(.source))]
    Write { folder: PathBuf, source: io::Error },
}

/// A simulated loop.
struct Simulated {
    name: String,
    u: Vec<f64>,
    force: Vec<f64>,
    cycle: Cycle,
    /// u_c (m) and μF_N (N), and F_N (N) where the load is constant.
    scale: Option<[f64; 2]>,
    normal: Option<f64>,
}

/// Measures the loops of a table.
pub(crate) fn measure(arguments: &MeasureArguments) -> Verdict {
    match answer(arguments) {
        Ok(()) => Verdict::Done,
        Err(failure) => {
            complain(format_args!("{failure}"));
            failure.verdict()
        }
    }
}

fn answer(arguments: &MeasureArguments) -> Result<(), LoopFailure> {
    let mut measured =
        Measured::read(&arguments.file, &arguments.reading.recipe().map_err(MeasuredError::from)?)?;
    let cycles = measured.cycles(arguments.period)?;
    let beside = arguments.beside.as_deref().map(|folder| find(folder, arguments.contact.as_deref()));
    let beside = beside.transpose()?;
    let normal = arguments.normal_force.or_else(|| beside.as_ref()?.normal);
    for note in measured.notes.iter().filter(|_| !arguments.quiet) {
        complain(format_args!("{}: note: {note}", arguments.file.display()));
    }
    if measured.is_turned {
        complain(format_args!(
            "{}: note: the force resists the motion; its sign is turned",
            arguments.file.display()
        ));
    }
    let stages: Vec<&[MeasuredCycle]> = cycles.chunk_by(|a, b| a.stage == b.stage).collect();
    // The stage of most cycles, the last of equal ones.
    let longest = stages.iter().max_by_key(|stage| stage.len()).copied().unwrap_or_default();
    if !arguments.quiet && !arguments.json {
        tell((longest, cycles.len()), beside.as_ref(), normal);
    }
    let stem = arguments.file.file_stem().unwrap_or_default().to_string_lossy();
    let out = arguments.out.clone().unwrap_or_else(|| Path::new("results").join(format!("{stem}-loop")));
    let pictures = draw(&stem, (&measured, &cycles), beside.as_ref(), arguments)?;
    let names = write(&out, &table(&cycles, normal), &pictures)
        .map_err(|source| LoopFailure::Write { folder: out.clone(), source })?;
    let account = measured.account(&cycles);
    if arguments.json {
        let told = json!({
            "file": measured.file,
            "cycles": cycles.len(),
            "is_turned": measured.is_turned,
            "record": account,
            "stages": stages.iter().map(|stage| of_stage(stage)).collect::<Vec<_>>(),
            "notes": measured.notes,
            "files": names,
        });
        say_json(&told.to_string());
    } else if !arguments.quiet {
        tell_stages(&stages);
        tell_account(&account);
        say(format_args!("\n{}: {}", out.display(), names.join(", ")));
    }
    Ok(())
}

/// Stages by their cycles, where there are several.
fn tell_stages(stages: &[&[MeasuredCycle]]) {
    if stages.len() < 2 {
        return;
    }
    for stage in stages.iter().take(MOST_STAGES) {
        let Some((first, last)) = stage.first().zip(stage.last()) else { continue };
        let amplitude =
            stage.iter().map(|cycle| cycle.cycle.displacement_amplitude).sum::<f64>() / stage.len() as f64;
        let lost = stage.iter().map(|cycle| cycle.cycle.dissipated).sum::<f64>() / stage.len() as f64;
        let open = stage.iter().filter(|cycle| cycle.is_open).count();
        let open = if open > 0 { format!(", {open} open") } else { String::new() };
        say(format_args!(
            "stage {}: cycles {}, from {} to {}, \u{3b4}* {}, E_d {}{open}",
            first.stage,
            stage.len(),
            quantity(Real(first.time[0]), "s"),
            quantity(Real(last.time[1]), "s"),
            quantity(Real(amplitude), "m"),
            quantity(Real(lost), "J")
        ));
    }
    if stages.len() > MOST_STAGES {
        say(format_args!("{} more stages: cycles.csv has all of them", stages.len() - MOST_STAGES));
    }
}

/// A stage for machines.
fn of_stage(stage: &[MeasuredCycle]) -> serde_json::Value {
    let from = stage.first().map(|cycle| cycle.time[0]);
    let to = stage.last().map(|cycle| cycle.time[1]);
    json!({ "cycles": stage.len(), "from_s": from, "to_s": to })
}

/// What lies in the cycles, and what outside.
fn tell_account(account: &Account) {
    let Account { rows, rows_in_cycles, rows_outside, work, work_in_cycles, work_outside } = account;
    say(format_args!("rows: {rows_in_cycles} in cycles, {rows_outside} outside, {rows} in all"));
    let [within, outside, all] = [work_in_cycles, work_outside, work].map(|work| quantity(Real(*work), "J"));
    say(format_args!("work of the force: {within} in cycles, {outside} outside, {all} in all"));
}

/// The contact of results that stands beside.
fn find(folder: &Path, name: Option<&str>) -> Result<Simulated, LoopFailure> {
    let Results { job, kept, .. } = Results::read(folder, &[PlotName::Loop])?;
    let failed = |words: String| LoopFailure::Contact { folder: folder.display().to_string(), words };
    let names: Vec<String> = job.model.contacts().map(|(name, _)| name.to_owned()).collect();
    let place = match name {
        Some(name) => names.iter().position(|own| own == name),
        None => Some(0).filter(|_| names.len() == 1),
    };
    let known = || failed(format!("expected the name of one of its contacts: {}", names.join(", ")));
    let place = place.ok_or_else(known)?;
    let loop_of = simulated(&job, place, &kept);
    let (u, force, cycle) =
        loop_of.ok_or_else(|| failed(format!("contact {} has no cycle that comes back", names[place])))?;
    let count = f64::from(job.count(place));
    let friction = job.model.contacts().nth(place).map_or(0.0, |(_, law)| law.friction());
    let scale = job.model.contact_scale(place).filter(|_| job.has_constant_load(place));
    let normal = scale.map(|(_, normal)| count * normal);
    let scale = scale.map(|(u_c, normal)| [u_c, count * friction * normal]);
    Ok(Simulated { name: names[place].clone(), u, force, cycle, scale, normal })
}

/// What is told of a cycle.
fn rows(cycle: &Cycle, normal: Option<f64>) -> [(&'static str, &'static str, Option<f64>); 10] {
    [
        ("displacement amplitude \u{3b4}*", "m", Some(cycle.displacement_amplitude)),
        ("force amplitude Q*", "N", Some(cycle.force_amplitude)),
        ("lost per cycle E_d", "J", Some(cycle.dissipated)),
        ("half opening \u{3b4}\u{2080}", "m", cycle.half_opening),
        ("A = E_d/(4Q*\u{3b4}*)", "", cycle.energy_ratio()),
        ("B = E_d/(4Q*\u{3b4}\u{2080})", "", cycle.system_free_ratio()),
        ("D = \u{3b4}\u{2080}/\u{3b4}*", "", cycle.slip_ratio()),
        (
            "\u{3bc}_e = E_d/(4P\u{3b4}\u{2080})",
            "",
            normal.and_then(|normal| cycle.friction_coefficient(normal)),
        ),
        ("stiffness, first tenth after maximum", "N/m", cycle.stiffness_after_maximum),
        ("stiffness, first tenth after minimum", "N/m", cycle.stiffness_after_minimum),
    ]
}

/// A table on the terminal: means over the cycles, how far they scatter, and what was simulated.
fn tell((cycles, all): (&[MeasuredCycle], usize), beside: Option<&Simulated>, normal: Option<f64>) {
    let count = match cycles.len() {
        count if count == all => format!("measured, {count} cycles"),
        count => format!("measured, {count} of {all} cycles"),
    };
    let simulated = beside.map(|beside| format!("simulated, {}", beside.name));
    let heads = ["", count.as_str(), "\u{b1}"].into_iter().chain(simulated.as_deref());
    let mut page = table::plain(heads);
    let all: Vec<_> = cycles.iter().map(|cycle| rows(&cycle.cycle, normal)).collect();
    let other = beside.map(|beside| rows(&beside.cycle, normal));
    for (k, (name, unit, _)) in all.first().into_iter().flatten().enumerate() {
        let values: Vec<f64> = all.iter().filter_map(|row| row[k].2).collect();
        let beside = other.as_ref().map(|rows| rows[k].2);
        if values.is_empty() && beside.flatten().is_none() {
            continue;
        }
        let (mean, scatter) = spread(&values);
        let cells = [(*name).to_owned(), shown(mean, unit), shown(scatter, unit)];
        page.add_row(cells.into_iter().chain(beside.map(|value| shown(value, unit))));
    }
    table::to_the_right(&mut page, 1..=if beside.is_some() { 3 } else { 2 });
    say(format_args!("{page}"));
}

/// Mean and standard deviation; none of nothing, and of one value no deviation.
fn spread(values: &[f64]) -> (Option<f64>, Option<f64>) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
    let deviation = (squares / (count - 1.0)).sqrt();
    let deviation = if deviation > ROUNDING * mean.abs() { deviation } else { 0.0 };
    (Some(mean).filter(|_| count > 0.0), Some(deviation).filter(|_| count > 1.0))
}

fn shown(value: Option<f64>, unit: &str) -> String {
    match value {
        None => String::new(),
        Some(value) if unit.is_empty() => format!("{value:.4}"),
        Some(value) => quantity(Real(value), unit),
    }
}

fn draw(
    title: &str,
    (measured, cycles): (&Measured, &[MeasuredCycle]),
    beside: Option<&Simulated>,
    arguments: &MeasureArguments,
) -> Result<Vec<(String, Vec<u8>)>, FigureError> {
    let Some(last) = cycles.last() else { return Ok(Vec::new()) };
    // Of a long record the last cycles are drawn, and nobody could tell more of them apart.
    let is_drawn = |cycle: &&MeasuredCycle| last.span.start - cycle.span.start <= MOST_DRAWN;
    let first = cycles.iter().find(is_drawn).unwrap_or(last);
    let curve = |name, from: usize, to: usize| Curve {
        name,
        u: &measured.u[from..to],
        force: &measured.force[from..to],
    };
    let simulated = beside.map(|beside| format!("simulated, {}", beside.name));
    let name = simulated.as_deref().unwrap_or_default();
    let simulated = beside.map(|beside| (Curve { name, u: &beside.u, force: &beside.force }, beside.scale));
    let loops = Loops {
        title,
        before: (cycles.len() > 1).then(|| curve("measured before", first.span.start, last.span.start + 1)),
        measured: curve("measured, last cycle", last.span.start, last.span.end),
        simulated,
    };
    picture::draw(&loops, &arguments.look.look())
}

/// Writes the table and the pictures, all or none.
fn write(out: &Path, cycles: &str, pictures: &[(String, Vec<u8>)]) -> io::Result<Vec<String>> {
    let mut folder = Folder::make(out)?;
    // A command that was killed has left its drafts.
    sweep(out, &picture::all_files().into_iter().chain([CYCLES.to_owned()]).collect::<Vec<_>>());
    folder.write(CYCLES, cycles.as_bytes())?;
    pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes))?;
    let names = folder.names();
    folder.publish()?;
    Ok(names)
}

impl LoopFailure {
    fn verdict(&self) -> Verdict {
        match self {
            Self::Write { .. } | Self::Figure(_) => Verdict::Stopped,
            Self::Measured(_) | Self::Results(_) | Self::Contact { .. } => Verdict::BadInput,
        }
    }
}
