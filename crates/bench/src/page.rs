//! Markdown page of the benchmark of time integrators.

use crate::contestant::Stepping;
use crate::error::BenchError;
use crate::family::{Family, Method};
use crate::front::{Cost, Front};
use crate::measurement::TABLE;
use crate::problem::{CHECK, Problem};
use crate::request::Request;
use crate::work::Work;
use crate::{growth, machine, picture};
use std::fmt::Write;
use std::io;
use std::path::Path;
use stickslip_run::markdown::{link, plain, relative, word};
use stickslip_run::program::this_program;
use stickslip_run::{Job, folder};

/// Errors at which methods are compared.
const ERRORS: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// Groups of methods that are compared with the event stepper on the exact memory curve: name, and test for the methods of the group.
const RIVALS: [Rival; 7] = [
    ("loop over springs", |method| matches!(method, Method::Loop { springs: Some(_), .. })),
    ("ode_solvers with events", |method| method == Method::Outside),
    ("rk4", |method| method == own(Stepping::Rk4) || method == Method::Loop { springs: None, staged: true }),
    ("verlet", |method| {
        method == own(Stepping::Verlet) || method == Method::Loop { springs: None, staged: false }
    }),
    ("dopri5", |method| method == own(Stepping::Dopri5)),
    ("frames", |method| method == own(Stepping::Frames)),
    (FLOOR, |method| matches!(method, Method::Floor { .. })),
];

/// Name of the minimal code, which simulates only P1 and similar drives.
const FLOOR: &str = "floor";

type Rival = (&'static str, fn(Method) -> bool);

const fn own(stepping: Stepping) -> Method {
    Method::Own { stepping, springs: None }
}

/// Run time of the event stepper to reach an error.
#[derive(Debug, Clone, Copy)]
struct Speed {
    /// Run time in ms per simulated second.
    own: f64,
    /// Smallest ratio of another method's run time to this time, without the minimal code; a bound if no method reaches the error.
    least: f64,
}

/// Chapter of the page about one scenario.
pub struct Chapter {
    name: String,
    work: Work,
    /// Lines of the table of run time ratios.
    ratios: String,
    /// Lines of the table of methods that are faster than the event stepper.
    losses: String,
    /// Run times at the errors of [`ERRORS`]; `None` where the event stepper does not reach the error.
    speeds: [Option<Speed>; 3],
    /// Remaining text of the chapter.
    text: String,
}

impl Chapter {
    /// Returns the chapter of a benchmark, with links relative to the file `page` and its existing pictures.
    pub(crate) fn new(
        (job, file): (&Job, &Path),
        problem: &Problem,
        (families, work): (&[Family<'_>], Work),
        page: &Path,
    ) -> io::Result<Self> {
        let folder = relative(&job.folder, parent(page))?;
        let at = |name: &str| link(&folder.join(name));
        let (title, name) = (plain(job.title()), job.name.replace('`', "'"));
        let (light, dark) =
            (at(&format!("{}.png", picture::NAME)), at(&format!("{}-dark.png", picture::NAME)));
        let svg = at(&format!("{}.svg", picture::NAME));
        let mut text = format!("\n## {title}\n\n`{name}` (`{}`), {}. ", word(file), time(problem.duration));
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "Errors are relative to {}, {}. {} [All runs]({}), [SVG]({svg}).\n\n{}\n",
            plain(&problem.norm.of),
            length(problem.norm.length),
            trust(problem),
            at(TABLE),
            shown((&light, &dark), &format!("work–precision: {title}")),
        );
        runs(&mut text, problem, families);
        if let Err(what) = &problem.mechanism {
            let _ = writeln!(text, "\nThe loops and ode_solvers do not support {what}.");
        }
        text.push_str(&work.against_floor(digits));
        let Ratios { lines: ratios, losses, speeds } = Ratios::of(&name, problem, families);
        Ok(Self { ratios, losses, speeds, name, work, text })
    }
}

/// Returns sentences about the accuracy of the reference solution.
fn trust(problem: &Problem) -> String {
    let doubt = problem.doubt;
    let mut words = format!(
        "The reference differs from a run at {CHECK:e} by {:.0e} at the end and by {:.0e} at most.",
        doubt.end, doubt.trajectory
    );
    for (i, known) in &problem.known {
        let coordinate = &problem.norm.coordinates[*i];
        let off = problem.norm.against(*i, problem.reference.end()[*i], *known);
        let _ = write!(
            words,
            " `{}` at the end differs by {off:.0e} from an independent value.",
            coordinate.channel
        );
    }
    words
}

/// Adds the table of runs of the event stepper with exact contacts.
fn runs(text: &mut String, problem: &Problem, families: &[Family<'_>]) {
    text.push_str(
        "| tolerance | end error | maximum error | ms per simulated second | evaluations | steps | rejected | \
         events |\n| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
    );
    let event = families.iter().filter(|family| family.method == own(Stepping::Event));
    for (run, result) in event.flat_map(Family::measured) {
        let counts = result.counts;
        let _ = writeln!(
            text,
            "| {:e} | {:.1e} | {:.1e} | {} | {} | {} | {} | {} |",
            run.value,
            result.errors.end,
            result.errors.trajectory,
            digits(1e3 * result.cost.processor / problem.duration),
            grouped(counts.evaluations),
            grouped(counts.steps),
            grouped(counts.rejected),
            grouped(counts.events),
        );
    }
}

/// Run time of the event stepper for each error, and the run times of other methods relative to it.
struct Ratios {
    /// Lines of the table of run time ratios.
    lines: String,
    /// Lines of the table of methods that are faster.
    losses: String,
    speeds: [Option<Speed>; 3],
}

impl Ratios {
    fn of(name: &str, problem: &Problem, families: &[Family<'_>]) -> Self {
        let front = |is: &dyn Fn(Method) -> bool| {
            Front::of(families.iter().filter(|family| is(family.method)), |errors| errors.trajectory)
        };
        let event = front(&|method| method == own(Stepping::Event));
        let rivals = RIVALS.map(|(_, is)| front(&is));
        let mut faster = RIVALS.map(|_| [None; 3]);
        let (mut lines, mut speeds) = (String::new(), [None; 3]);
        for (at, error) in ERRORS.into_iter().enumerate() {
            let Some(Cost::Measured(best)) = event.cost(error) else { continue };
            let _ = write!(lines, "| `{name}` | {error:e} | {} ms |", digits(1e3 * best / problem.duration));
            let mut least = f64::INFINITY;
            for ((rival, (who, _)), faster) in rivals.iter().zip(RIVALS).zip(&mut faster) {
                let cost = rival.cost(error);
                if let Some(Cost::Measured(cost)) = cost
                    && cost < best
                {
                    faster[at] = Some(cost / best);
                }
                if let (Some(Cost::Measured(cost) | Cost::Above(cost)), true) = (cost, who != FLOOR) {
                    least = least.min(cost / best);
                }
                let ratio = match cost {
                    Some(Cost::Measured(cost)) => format!("{} ×", digits(cost / best)),
                    Some(Cost::Above(cost)) => format!("> {} ×", digits(cost / best)),
                    None => "–".to_owned(),
                };
                let _ = write!(lines, " {ratio} |");
            }
            speeds[at] = Some(Speed { own: 1e3 * best / problem.duration, least });
            lines.push('\n');
        }
        let mut losses = String::new();
        for ((who, _), faster) in RIVALS.iter().zip(faster) {
            if faster.iter().any(Option::is_some) {
                let cells = faster
                    .map(|ratio| ratio.map_or("–".to_owned(), |ratio| format!("{} ×", digits(ratio))));
                let _ = writeln!(losses, "| `{name}` | {who} | {} |", cells.join(" | "));
            }
        }
        Self { lines, losses, speeds }
    }
}

/// Writes the page of all chapters.
///
/// # Errors
/// A file that cannot be written, or without a relative path to the folder of the pictures.
pub fn write_page(chapters: &[Chapter], request: &Request, file: &Path) -> Result<(), BenchError> {
    let failed = |source| BenchError::File { path: file.to_owned(), source };
    let text = text(chapters, request, file).map_err(failed)?;
    folder::write(file, text.as_bytes()).map_err(failed)
}

/// Returns the text of the page.
fn text(chapters: &[Chapter], request: &Request, file: &Path) -> io::Result<String> {
    let mut page = format!(
        "# Performance\n\nThis page is generated by `stickslip-lab bench`. The section *Measurement* has the full command.\n{}",
        summary(chapters),
    );
    if !chapters.is_empty() {
        page.push_str(&faster(chapters));
        page.push_str(&ratio_table(chapters));
        page.push_str(&work_table(chapters));
    }
    if request.growth {
        page.push_str(&grown(&relative(&request.out, parent(file))?));
    }
    let _ = write!(
        page,
        "\n{METHOD}\n\nMeasured on {}, by {}, built with `--release`:\n\n```sh\n{}\n```\n",
        machine::words(),
        this_program(),
        command(request),
    );
    chapters.iter().for_each(|chapter| page.push_str(&chapter.text));
    Ok(page)
}

/// Returns the table of the cost of the event stepper.
fn work_table(chapters: &[Chapter]) -> String {
    let first = chapters.iter().find(|chapter| chapter.name == FIRST).map(|chapter| &chapter.work);
    let lines = chapters.iter().map(|chapter| chapter.work.lines(&chapter.name, first, digits));
    WORK.to_owned() + &lines.collect::<String>()
}

/// Scenario to which the instruction counts of other scenarios are relative.
const FIRST: &str = "p1";

const WORK: &str = "
## Work of the event stepper

The contact law is the exact one. Valgrind's callgrind counts the instructions of a run without output; they do not depend on the load of the
machine. The column `× P1 per second` gives the instructions per simulated second relative to P1.

| scenario | tolerance | end error | maximum error | million instructions | × P1 per second | ms per simulated second | steps | events |
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
";

/// Returns the table of run time ratios of all scenarios.
fn ratio_table(chapters: &[Chapter]) -> String {
    let mut table = RATIOS.to_owned();
    let head = RIVALS.map(|(name, _)| format!(" {name} |")).concat();
    let rule = RIVALS.map(|_| " ---: |").concat();
    let _ = writeln!(table, "\n\n| scenario | error | event |{head}\n| --- | ---: | ---: |{rule}");
    chapters.iter().for_each(|chapter| table.push_str(&chapter.ratios));
    table
}

/// Returns a summary of run time and error of the event stepper; empty if no scenario reaches both errors.
fn summary(chapters: &[Chapter]) -> String {
    let pairs = chapters.iter().filter_map(|chapter| chapter.speeds[0].zip(chapter.speeds[1]));
    let pairs: Vec<(Speed, Speed)> = pairs.collect();
    if pairs.is_empty() {
        return String::new();
    }
    let least = pairs.iter().map(|(_, fine)| fine.least).fold(f64::INFINITY, f64::min);
    let others = if least.is_finite() {
        format!(" At this error every other general method takes at least {} times as long.", digits(least))
    } else {
        String::new()
    };
    format!(
        "\n**Work–precision.** The event stepper reaches a relative error of {:e} in {} ms per simulated second.{others} A reduction \
         of the error from {:e} to {:e} multiplies its run time by {}.\n",
        ERRORS[1],
        range(pairs.iter().map(|(_, fine)| fine.own)),
        ERRORS[0],
        ERRORS[1],
        range(pairs.iter().map(|(coarse, fine)| fine.own / coarse.own)),
    )
}

/// Returns the range of values as text, from the smallest to the largest.
fn range(values: impl Iterator<Item = f64> + Clone) -> String {
    let (low, high) = (values.clone().fold(f64::INFINITY, f64::min), values.fold(0.0, f64::max));
    let (low, high) = (digits(low), digits(high));
    if low == high { low } else { format!("{low} to {high}") }
}

/// Returns the table of scenarios in which another method is faster.
fn faster(chapters: &[Chapter]) -> String {
    let losses: String = chapters.iter().map(|chapter| chapter.losses.as_str()).collect();
    if losses.is_empty() {
        return "\n**Where another method is faster** than the event stepper: in none of these scenarios.\n"
            .to_owned();
    }
    let heads = ERRORS.map(|error| format!(" error {error:e} |")).concat();
    format!(
        "\n**Where another method is faster** than the event stepper: run time relative to it at the same error. The sign – means \
         that it is not faster.\n\n| scenario | method |{heads}\n| --- | --- |{}\n{losses}",
        ERRORS.map(|_| " ---: |").concat(),
    )
}

/// Returns the chapter about the scaling of the run time; `folder` contains the picture.
fn grown(folder: &Path) -> String {
    let at = |name: &str| link(&folder.join(name));
    let name = |end: &str| at(&format!("{}{end}", growth::PICTURE));
    format!(
        "\n## Scaling\n\n{GROWTH} [Table]({}), [SVG]({}).\n\n{}",
        at(growth::TABLE),
        name(".svg"),
        shown((&name(".png"), &name("-dark.png")), "run time versus size"),
    )
}

/// Returns HTML that shows a picture in its light or dark version.
pub(crate) fn shown((light, dark): (&str, &str), words: &str) -> String {
    format!(
        "<picture>\n  <source media=\"(prefers-color-scheme: dark)\" srcset=\"{dark}\">\n  \
         <img src=\"{light}\" width=\"800\" alt=\"{words}\">\n</picture>\n"
    )
}

const GROWTH: &str = "\
Each curve increases one quantity of P1. The row of springs uses velocity Verlet with 1 000 steps per period, all others use the event
stepper at 1e-6. The contacts share the load of the slider. Contacts and sliders are all different, so their events do not
coincide. Twice as many contacts have twice as many events, each with twice the work. Frames of 20 µs with an accuracy of 1e-3 do a
limited work per contact instead. The corners (reversals) of the memory come from a foot motion of decreasing amplitude; the time is that of
a smaller motion after it.";

const METHOD: &str = "\
## Measurement

**Times** are processor times of the run alone, without set-up and output; the tables of all runs also give wall times. All runs are
repeated in several rounds, and the shortest time counts. Ratios depend less on the machine than times.

**Errors** are the maximum over all free coordinates, at the end or over 1 001 instants of the run. They are relative to the stroke of the
waveform, or to the maximum travel if nothing follows a waveform. An angle counts as the displacement of the farthest contact
point. The reference is the event stepper at a tolerance of 1e-14.

**Pictures** show the best runs of each method. The curve `dopri5` includes ode_solvers, `springs` the loops over springs. A dashed line
with a number is a fitted slope.

| method | description |
| --- | --- |
| event, rk4, verlet, dopri5, frames | steppers of stickslip, on the exact contact law and on rows of 64, 256 and 1 024 springs |
| loop over springs | fixed step over a row of 64 to 4 096 springs by velocity Verlet (`loop`) or RK4 (`loop-rk4`), vectorised, with the symmetry of the row |
| `exact-rk4`, `exact-verlet` | fixed step with the exact law of power-law profiles at constant load; the columns rk4 and verlet show the faster code |
| ode_solvers with events | Dopri5 of the crate `ode_solvers`; events are located on its dense output, and the integration restarts there |
| floor | minimal code for P1 and similar drives, from event to event; all other methods are general |

The loops support up to six free coordinates, ode_solvers up to three under constant loads. Neither supports springs, stacks or damped
contacts.";

const RATIOS: &str = "
## Run time at equal error

The column `event` gives the time of the event stepper per simulated second for a maximum error. The other columns give the run time of
other methods relative to it, interpolated between runs in logarithms. The sign > means that the method does not reach the error; its
longest useful run then gives the value. The sign – marks scenarios that the method does not support.";

/// Returns the command line that writes the page.
fn command(request: &Request) -> String {
    let mut command = "stickslip-lab bench".to_owned();
    request.files.iter().for_each(|file| command += &format!(" {}", word(file)));
    request.set.iter().for_each(|(path, value)| command += &format!(" --set {path}=\"{value}\""));
    for (name, known) in &request.known {
        command += &format!(" --known {name}:{}={:e}", known.channel, known.value);
    }
    command += &format!(" --budget \"{} s\" --out {}", request.budget, word(&request.out));
    command += if request.instructions { " --instructions" } else { "" };
    command += if request.growth { " --growth" } else { "" };
    request.page.iter().for_each(|page| command += &format!(" --page {}", word(page)));
    command
}

/// Returns the folder of a file.
pub(crate) fn parent(file: &Path) -> &Path {
    file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Formats a number with two significant digits, or three between 100 and 1000.
fn digits(value: f64) -> String {
    let decimals = (1.0 - math::log10(value.abs().max(1e-9)).floor()).clamp(0.0, 9.0) as usize;
    let grain = if value >= 1000.0 { 10_f64.powi(math::log10(value).floor() as i32 - 1) } else { 1.0 };
    let shown = if value >= 1000.0 { (value / grain).round() * grain } else { value };
    let text = format!("{shown:.decimals$}");
    // A value of that size has no decimals.
    if value >= 1e4 { grouped(shown as u64) } else { text }
}

/// Formats a number with blanks between groups of three digits, from five digits on.
pub(crate) fn grouped(number: u64) -> String {
    let text = number.to_string();
    if text.len() <= 4 {
        return text;
    }
    let grouped: Vec<String> =
        text.as_bytes().rchunks(3).rev().map(|group| String::from_utf8_lossy(group).into_owned()).collect();
    grouped.join(" ")
}

fn time(seconds: f64) -> String {
    format!("{} ms", digits(1e3 * seconds))
}

fn length(metres: f64) -> String {
    format!("{} µm", digits(1e6 * metres))
}

#[cfg(test)]
mod tests {
    use super::digits;

    #[test]
    fn numbers_have_the_digits_that_they_deserve() {
        let shown = [0.01234, 1.234, 12.34, 123.4, 1234.0, 123_456.0, 1.26e7].map(digits);
        assert_eq!(shown, ["0.012", "1.2", "12", "123", "1200", "120 000", "13 000 000"]);
    }
}
