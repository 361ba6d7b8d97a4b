//! `stickslip measure`: evaluates measured loops and compares them with a simulated loop.

use crate::arguments::{MeasureArguments, RigStiffness};
use serde_json::json;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_console::answer::{complain, say, say_json};
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_figures::FigureError;
use stickslip_figures::measured::{self as picture, Course, Curve, Loops};
use stickslip_measure::{Cycle, Interval, reversal_stiffness};
use stickslip_run::complaint::words;
use stickslip_run::folder::{Folder, sweep};
use stickslip_run::measured::{
    Account, Evaluated, Measured, MeasuredCycle, MeasuredError, Stage, middle, simulated, table,
};
use stickslip_run::synopsis::Synopsis;
use stickslip_run::{Real, Results, ResultsError, quantity};
use stickslip_scenario::PlotName;
use thiserror::Error;

/// Maximum number of stages that are printed.
const MOST_STAGES: usize = 12;
/// Number of cycles from which on plots of their evolution are drawn.
const MANY: usize = 5;
/// Maximum number of rows of cycles before the last that are drawn.
const MOST_DRAWN: usize = 100_000;
/// Name of the output table.
const CYCLES: &str = "cycles.csv";

/// Error that stops the command.
#[derive(Debug, Error)]
enum LoopFailure {
    /// The table cannot be read or evaluated.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// The simulated results cannot be read.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// The contact of the simulated results is invalid.
    #[error("--contact  {folder}: {words}")]
    Contact { folder: String, words: String },
    /// A fit of the rig stiffness requires a simulated loop.
    #[error(
        "--rig-stiffness fit  expected --beside with a simulated contact that has a closed last cycle: the rig stiffness follows from the difference between the measured and the simulated loop"
    )]
    Rig,
    /// A plot fails.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The files cannot be written.
    #[error("{}: the files cannot be written: {}", .folder.display(), words(.source))]
    Write { folder: PathBuf, source: io::Error },
}

/// A simulated loop.
struct Simulated {
    name: String,
    u: Vec<f64>,
    force: Vec<f64>,
    cycle: Cycle,
    /// Results of the cycle from the summary of the run, by name.
    exact: Vec<(&'static str, f64)>,
    /// Tangent stiffness at the reversals, N/m.
    tangent: Option<f64>,
    /// u_c (m) and μF_N (N), and F_N (N), if the load is constant.
    scale: Option<[f64; 2]>,
    normal: Option<f64>,
}

/// Evaluates the loops of a table.
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
    let beside = arguments.beside.as_deref().map(|folder| find(folder, arguments)).transpose()?;
    if arguments.rig_stiffness == Some(RigStiffness::Fit)
        && beside.as_ref().is_none_or(|beside| beside.tangent.is_none())
    {
        return Err(LoopFailure::Rig);
    }
    let evaluated = measured.evaluate(&arguments.how(beside.as_ref().and_then(|beside| beside.tangent)))?;
    let own = evaluated.mean_load();
    let normal = arguments.normal_force.or(own).or_else(|| beside.as_ref()?.normal);
    let notes = evaluated.notes(&measured);
    for note in notes.iter().filter(|_| !arguments.quiet) {
        complain(format_args!("{}: note: {note}", arguments.file.display()));
    }
    if !arguments.quiet && !arguments.json {
        tell(&evaluated, beside.as_ref(), normal);
    }
    let stem = arguments.file.file_stem().unwrap_or_default().to_string_lossy();
    let out = arguments.out.clone().unwrap_or_else(|| Path::new("results").join(format!("{stem}-loop")));
    let pictures = draw(&stem, (&measured, &evaluated), beside.as_ref(), arguments)?;
    let names = write(
        &out,
        &table(&evaluated.cycles, arguments.normal_force.or(normal.filter(|_| own.is_none()))),
        &pictures,
    )
    .map_err(|source| LoopFailure::Write { folder: out.clone(), source })?;
    if arguments.json {
        let mut told = evaluated.json(&measured);
        told["files"] = json!(names);
        say_json(&told.to_string());
    } else if !arguments.quiet {
        tell_stages(&evaluated.stages);
        tell_account(&evaluated.account);
        say(format_args!("\n{}: {}", out.display(), names.join(", ")));
    }
    Ok(())
}

/// Prints the stages if there are several.
fn tell_stages(stages: &[Stage]) {
    if stages.len() < 2 {
        return;
    }
    for (stage, number) in stages.iter().zip(1..).take(MOST_STAGES) {
        let [from, to] = stage.time.map(|time| quantity(Real(time), "s"));
        let shown = |name, unit| shown(stage.result(name).map(|interval| interval.value), unit);
        say(format_args!(
            "stage {number}: {}, from {from} to {to}, \u{3b4}* {}, E_d {}",
            counted(stage.cycles.len()),
            shown("displacement_amplitude_m", "m"),
            shown("dissipated_J", "J")
        ));
    }
    if stages.len() > MOST_STAGES {
        say(format_args!("{} more stages: cycles.csv has all of them", stages.len() - MOST_STAGES));
    }
}

/// Prints rows and work inside and outside of cycles.
fn tell_account(account: &Account) {
    let Account { rows, rows_in_cycles, rows_outside, work, work_in_cycles, work_outside } = account;
    say(format_args!("rows: {rows_in_cycles} in cycles, {rows_outside} outside, {rows} in total"));
    let [within, outside, all] = [work_in_cycles, work_outside, work].map(|work| quantity(Real(*work), "J"));
    say(format_args!("work of the force: {within} in cycles, {outside} outside, {all} in total"));
}

/// Names of results, with the names of the same values in the summary of a run.
const EXACT: [(&str, &str); 9] = [
    ("displacement_amplitude_m", "displacement_amplitude_m"),
    ("force_amplitude_N", "force_amplitude_N"),
    ("dissipated_J", "dissipated_J"),
    ("half_opening_m", "half_opening_m"),
    ("half_opening_at_zero_force_m", "half_opening_m"),
    ("energy_ratio", "energy_ratio"),
    ("system_free_ratio", "system_free_ratio"),
    ("slip_ratio", "slip_ratio"),
    ("stiffness_N_m", "stiffness_after_maximum_N_m"),
];
/// Results that do not depend on the choice of displacement.
const OF_FORCE: [&str; 2] = ["force_amplitude_N", "dissipated_J"];

/// Returns the simulated contact for the comparison.
fn find(folder: &Path, arguments: &MeasureArguments) -> Result<Simulated, LoopFailure> {
    let Results { job, kept, .. } = Results::read(folder, &[PlotName::Loop])?;
    let failed = |words: String| LoopFailure::Contact { folder: folder.display().to_string(), words };
    let names: Vec<String> = job.model.contacts().map(|(name, _)| name.to_owned()).collect();
    let place = match &arguments.contact {
        Some(name) => names.iter().position(|own| own == name),
        None => Some(0).filter(|_| names.len() == 1),
    };
    let known = || failed(format!("expected the name of one of its contacts: {}", names.join(", ")));
    let place = place.ok_or_else(known)?;
    let channel = arguments.beside_displacement.as_deref();
    let loop_of = simulated(&job, place, &kept, channel);
    let (u, force, cycle) = loop_of.ok_or_else(|| {
        let channel = channel.map_or_else(String::new, |channel| format!(" along {channel}"));
        failed(format!("contact {} has no closed cycle{channel}", names[place]))
    })?;
    let count = f64::from(job.count(place));
    let friction = job.model.contacts().nth(place).map_or(0.0, |(_, law)| law.friction());
    let scale = job.model.contact_scale(place).filter(|_| job.has_constant_load(place));
    let normal = scale.map(|(_, normal)| count * normal);
    let scale = scale.map(|(u_c, normal)| [u_c, count * friction * normal]);
    let synopsis = Synopsis::read(folder).map_err(ResultsError::from)?;
    let place_of = |key: &str| {
        format!("/contacts/{}/fretting/{key}", names[place].replace('~', "~0").replace('/', "~1"))
    };
    // If the loop is not centred at zero force, the opening at mean force differs from that in the summary.
    let is_centred = middle(&force).abs() < 1e-6 * cycle.force_amplitude;
    let known = EXACT.into_iter().filter(|(name, _)| {
        (channel.is_none() || OF_FORCE.contains(name)) && (is_centred || *name != "half_opening_m")
    });
    let exact = known.filter_map(|(name, key)| Some((name, synopsis.number(&place_of(key))?))).collect();
    let tangent = synopsis.number(&place_of("stiffness_after_maximum_N_m"));
    Ok(Simulated { name: names[place].clone(), u, force, cycle, exact, tangent, scale, normal })
}

/// Printed rows: label, name of the result, unit.
const ROWS: [(&str, &str, &str); 10] = [
    ("displacement amplitude \u{3b4}*", "displacement_amplitude_m", "m"),
    ("force amplitude Q*", "force_amplitude_N", "N"),
    ("dissipated energy E_d", "dissipated_J", "J"),
    ("half opening \u{3b4}\u{2080} at mean force", "half_opening_m", "m"),
    ("half opening at zero force", "half_opening_at_zero_force_m", "m"),
    ("A = E_d/(4Q*\u{3b4}*)", "energy_ratio", ""),
    ("B = E_d/(4Q*\u{3b4}\u{2080})", "system_free_ratio", ""),
    ("D = \u{3b4}\u{2080}/\u{3b4}*", "slip_ratio", ""),
    ("\u{3bc}_e = E_d/(4P\u{3b4}\u{2080})", "friction_force_N", ""),
    ("stiffness at the reversal", "stiffness_N_m", "N/m"),
];

/// Prints the results of the stage with most cycles and their confidence intervals. If the rig stiffness is
/// known, values with and without the rig are shown; a simulated loop is added if given.
fn tell(evaluated: &Evaluated, beside: Option<&Simulated>, normal: Option<f64>) {
    let Some(stage) = evaluated.longest() else { return };
    let count = match stage.cycles.len() {
        count if count == evaluated.cycles.len() => format!("measured, {}", counted(count)),
        count => format!("measured, {count} of {}", counted(evaluated.cycles.len())),
    };
    let mut columns = vec![(count, stage)];
    if let Some((whole, rig)) = &evaluated.with_rig {
        columns[0].0 = format!("without the rig of {}", quantity(Real(rig.value), "N/m"));
        columns.insert(
            0,
            (format!("{}, included", columns[0].0.replace("without the rig of", "rig of")), whole),
        );
    }
    let simulated = beside.map(|beside| format!("simulated, {}", beside.name));
    let heads = columns.iter().flat_map(|(head, _)| [head.as_str(), "95 % interval"]);
    let mut page = table::plain([""].into_iter().chain(heads).chain(simulated.as_deref()));
    for (words, name, unit) in ROWS {
        let scale = match (name, normal) {
            ("friction_force_N", None) => continue,
            ("friction_force_N", Some(normal)) => 1.0 / normal,
            _ => 1.0,
        };
        let beside = beside.map(|beside| beside.result(name));
        let measured: Vec<Option<Interval>> = columns.iter().map(|(_, stage)| stage.result(name)).collect();
        if measured.iter().all(Option::is_none) && beside.flatten().is_none() {
            continue;
        }
        let cells = measured.iter().flat_map(|interval| {
            let ends = interval.map(|interval| [scale * interval.low, scale * interval.high]);
            let ends = ends.filter(|ends| ends.iter().all(|end| end.is_finite()));
            let ends = ends.map(|ends| ends.map(|end| shown(Some(end), unit)).join(" to "));
            [shown(interval.map(|interval| scale * interval.value), unit), ends.unwrap_or_default()]
        });
        let simulated = beside.map(|value| shown(value.map(|own| scale * own), unit));
        page.add_row([words.to_owned()].into_iter().chain(cells).chain(simulated));
    }
    let blank = std::iter::repeat_n("", 2 * (columns.len() - 1));
    page.add_row(["slip regime"].into_iter().chain(blank).chain([stage.regime.unwrap_or("needs --profile")]));
    table::to_the_right(&mut page, 1..=2 * columns.len() + usize::from(beside.is_some()));
    say(format_args!("{page}"));
}

impl Simulated {
    /// Returns a result by its name.
    fn result(&self, name: &str) -> Option<f64> {
        if let Some((_, value)) = self.exact.iter().find(|(own, _)| *own == name) {
            return Some(*value);
        }
        match name {
            "displacement_amplitude_m" => Some(self.cycle.displacement_amplitude),
            "force_amplitude_N" => Some(self.cycle.force_amplitude),
            "dissipated_J" => Some(self.cycle.dissipated),
            "half_opening_m" => self.cycle.half_opening,
            "energy_ratio" => self.cycle.energy_ratio(),
            "system_free_ratio" => self.cycle.system_free_ratio(),
            "slip_ratio" => self.cycle.slip_ratio(),
            "friction_force_N" => self.cycle.friction_coefficient(1.0),
            "stiffness_N_m" => reversal_stiffness(&self.u, &self.force),
            _ => None,
        }
    }
}

fn counted(cycles: usize) -> String {
    format!("{cycles} cycle{}", if cycles == 1 { "" } else { "s" })
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
    (measured, evaluated): (&Measured, &Evaluated),
    beside: Option<&Simulated>,
    arguments: &MeasureArguments,
) -> Result<Vec<(String, Vec<u8>)>, FigureError> {
    let cycles = &evaluated.cycles;
    let Some(last) = cycles.last() else { return Ok(Vec::new()) };
    let [u, force] = evaluated.rows.as_ref().map_or([&measured.u, &measured.force], |[u, force]| [u, force]);
    // Only the last cycles of a long record are drawn.
    let is_drawn = |cycle: &&MeasuredCycle| last.span.start - cycle.span.start <= MOST_DRAWN;
    let first = cycles.iter().find(is_drawn).unwrap_or(last);
    let curve = |name, from: usize, to: usize| Curve { name, u: &u[from..to], force: &force[from..to] };
    let simulated = beside.map(|beside| format!("simulated, {}", beside.name));
    let name = simulated.as_deref().unwrap_or_default();
    let simulated = beside.map(|beside| (Curve { name, u: &beside.u, force: &beside.force }, beside.scale));
    let loops = Loops {
        title,
        before: (cycles.len() > 1)
            .then(|| curve("earlier cycles, measured", first.span.start, last.span.start + 1)),
        measured: curve("last cycle, measured", last.span.start, last.span.end),
        simulated,
    };
    let mut pictures = picture::draw(&loops, &arguments.look.look())?;
    if cycles.len() >= MANY {
        let number = |place: usize| place as f64 + 1.0;
        let of = |value: &dyn Fn(&MeasuredCycle) -> Option<f64>| {
            cycles.iter().map(|cycle| value(cycle).unwrap_or(f64::NAN)).collect::<Vec<f64>>()
        };
        let normal = arguments.normal_force;
        let course = Course {
            title,
            numbers: (0..cycles.len()).map(number).collect(),
            loops: cycles.iter().map(|cycle| curve("", cycle.span.start, cycle.span.end)).collect(),
            figures: vec![
                ("E_d", "J", of(&|cycle| Some(cycle.cycle.dissipated))),
                ("\u{3bc}_e", "", of(&|cycle| cycle.friction(normal))),
                ("Q*", "N", of(&|cycle| Some(cycle.cycle.force_amplitude))),
                ("k", "N/m", of(&|cycle| cycle.stiffness)),
            ],
        };
        pictures.extend(picture::draw_course(&course, &arguments.look.look())?);
    }
    Ok(pictures)
}

/// Writes table and plots, all or none.
fn write(out: &Path, cycles: &str, pictures: &[(String, Vec<u8>)]) -> io::Result<Vec<String>> {
    let mut folder = Folder::make(out)?;
    // An interrupted command may have left temporary files.
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
            Self::Measured(_) | Self::Results(_) | Self::Contact { .. } | Self::Rig => Verdict::BadInput,
        }
    }
}
