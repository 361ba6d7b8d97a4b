//! The page of a measurement, in Markdown.

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

/// What is compared with the event stepper on the exact curve: a name and the methods whose front counts.
const RIVALS: [Rival; 6] = [
    ("loop over springs", |method| matches!(method, Method::Loop { springs: Some(_), .. })),
    ("ode_solvers with events", |method| method == Method::Outside),
    ("rk4", |method| method == own(Stepping::Rk4) || method == Method::Loop { springs: None, staged: true }),
    ("verlet", |method| {
        method == own(Stepping::Verlet) || method == Method::Loop { springs: None, staged: false }
    }),
    ("dopri5", |method| method == own(Stepping::Dopri5)),
    ("floor", |method| matches!(method, Method::Floor { .. })),
];

type Rival = (&'static str, fn(Method) -> bool);

const fn own(stepping: Stepping) -> Method {
    Method::Own { stepping, springs: None }
}

/// What the page says of one scenario.
pub struct Chapter {
    name: String,
    work: Work,
    /// Lines of the table of ratios.
    ratios: String,
    /// Where others are faster, in words.
    losses: Vec<String>,
    /// Everything else.
    text: String,
}

impl Chapter {
    /// The chapter of a measurement; `page` is the file that it is for, the pictures are written already.
    pub(crate) fn new(
        (job, file): (&Job, &Path),
        problem: &Problem,
        (families, work): (&[Family<'_>], Work),
        page: &Path,
    ) -> io::Result<Self> {
        let folder = relative(&job.folder, parent(page))?;
        let scenario = link(&relative(file, parent(page))?);
        let at = |name: &str| link(&folder.join(name));
        let (title, name) = (plain(job.title()), job.name.replace('`', "'"));
        let (light, dark) =
            (at(&format!("{}.png", picture::NAME)), at(&format!("{}-dark.png", picture::NAME)));
        let svg = at(&format!("{}.svg", picture::NAME));
        let mut text = format!("\n## {title}\n\n[`{name}`]({scenario}), {} of it; ", time(problem.duration));
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "errors in parts of {}, {}. {} [All runs]({}), [SVG]({svg}).\n\n{}\n",
            plain(&problem.norm.of),
            length(problem.norm.length),
            trust(problem),
            at(TABLE),
            shown((&light, &dark), &format!("work-precision: {title}")),
        );
        runs(&mut text, problem, families);
        if let Err(what) = &problem.mechanism {
            let _ = writeln!(text, "\nThe loops and ode_solvers are not here: they know no {what}.");
        }
        text.push_str(&work.against_floor(digits));
        let (ratios, losses) = ratios(&name, problem, families);
        Ok(Self { ratios, losses, name, work, text })
    }
}

/// How sure the reference is.
fn trust(problem: &Problem) -> String {
    let doubt = problem.doubt;
    let mut words = format!(
        "The reference differs from a run at {CHECK:e} by {:.0e} at the end and {:.0e} along the way.",
        doubt.end, doubt.trajectory
    );
    for (i, known) in &problem.known {
        let coordinate = &problem.norm.coordinates[*i];
        let off = problem.norm.against(*i, problem.reference.end()[*i], *known);
        let _ =
            write!(words, " `{}` at the end is known from elsewhere: off by {off:.0e}.", coordinate.channel);
    }
    words
}

/// The runs of the event stepper on the exact curve.
fn runs(text: &mut String, problem: &Problem, families: &[Family<'_>]) {
    text.push_str(
        "| tolerance | error at the end | along the way | ms per simulated second | evaluations | steps | rejected | \
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

/// What the event stepper needs for errors along the way, and how many times as long others take.
///
/// The second list has those that take less.
fn ratios(name: &str, problem: &Problem, families: &[Family<'_>]) -> (String, Vec<String>) {
    let front = |is: &dyn Fn(Method) -> bool| {
        Front::of(families.iter().filter(|family| is(family.method)), |errors| errors.trajectory)
    };
    let event = front(&|method| method == own(Stepping::Event));
    let rivals = RIVALS.map(|(_, is)| front(&is));
    let (mut lines, mut losses) = (String::new(), Vec::new());
    for error in ERRORS {
        let Some(Cost::Measured(best)) = event.cost(error) else { continue };
        let _ = write!(lines, "| `{name}` | {error:e} | {} ms |", digits(1e3 * best / problem.duration));
        for (rival, (who, _)) in rivals.iter().zip(RIVALS) {
            if let Some(Cost::Measured(cost)) = rival.cost(error)
                && cost < best
            {
                losses.push(format!("`{name}` at {error:e} ({who} {} ×)", digits(cost / best)));
            }
            let ratio = match rival.cost(error) {
                Some(Cost::Measured(cost)) => format!("{} ×", digits(cost / best)),
                Some(Cost::Above(cost)) => format!("> {} ×", digits(cost / best)),
                None => "–".to_owned(),
            };
            let _ = write!(lines, " {ratio} |");
        }
        lines.push('\n');
    }
    (lines, losses)
}

/// Writes the page of all chapters.
///
/// # Errors
/// A file that cannot be written, or whose place cannot be told from that of the pictures.
pub fn write_page(chapters: &[Chapter], request: &Request, file: &Path) -> Result<(), BenchError> {
    let failed = |source| BenchError::File { path: file.to_owned(), source };
    let text = text(chapters, request, file).map_err(failed)?;
    folder::write(file, text.as_bytes()).map_err(failed)
}

/// The page.
fn text(chapters: &[Chapter], request: &Request, file: &Path) -> io::Result<String> {
    let mut page = format!(
        "# Performance\n\nWhat accuracy costs: every stepper on the exact curve and on rows of 64, 256 and 1 024 springs, \
         and what others would do.\nThis page and its pictures are written by\n\n```sh\n{}\n```\n\non {}, by {}, built with \
         `--release`.\n\n{}{TIMES}\n\n{NORM}\n\n{OTHERS}\n\n",
        command(request),
        machine::words(),
        this_program(),
        faster(chapters),
    );
    if !chapters.is_empty() {
        page.push_str(&work_table(chapters));
        page.push_str(&ratio_table(chapters));
    }
    chapters.iter().for_each(|chapter| page.push_str(&chapter.text));
    if request.growth {
        page.push_str(&grown(&relative(&request.out, parent(file))?));
    }
    Ok(page)
}

/// The table of what the event stepper takes.
fn work_table(chapters: &[Chapter]) -> String {
    let first = chapters.iter().find(|chapter| chapter.name == FIRST).map(|chapter| &chapter.work);
    let lines = chapters.iter().map(|chapter| chapter.work.lines(&chapter.name, first, digits));
    WORK.to_owned() + &lines.collect::<String>() + "\n"
}

/// The scene whose instructions those of others are told in.
const FIRST: &str = "p1";

const WORK: &str = "\
## What it takes

The event stepper on the exact contact. **Instructions** are those of a run with a record that keeps nothing, counted by
valgrind's callgrind: they do not depend on what else the machine does. Beside them those per simulated second in parts of P1's.

| scenario | tolerance | error at the end | along the way | million instructions | × P1 per second | ms per simulated second | steps | events |
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
";

/// The table of ratios of all scenarios.
fn ratio_table(chapters: &[Chapter]) -> String {
    let mut table = RATIOS.to_owned();
    let head = RIVALS.map(|(name, _)| format!(" {name} |")).concat();
    let rule = RIVALS.map(|_| " ---: |").concat();
    let _ = writeln!(table, "\n\n| scenario | error | event |{head}\n| --- | ---: | ---: |{rule}");
    chapters.iter().for_each(|chapter| table.push_str(&chapter.ratios));
    table.push('\n');
    table
}

/// Where others are faster.
fn faster(chapters: &[Chapter]) -> String {
    if chapters.is_empty() {
        return String::new();
    }
    let losses: Vec<&str> = chapters.iter().flat_map(|chapter| &chapter.losses).map(String::as_str).collect();
    let told = if losses.is_empty() { "nowhere here".to_owned() } else { losses.join("; ") };
    format!(
        "**Where simpler code is faster** than the event stepper, at the same error along the way: {told}.\n\n"
    )
}

/// The chapter of growth; `folder` is that of the picture.
fn grown(folder: &Path) -> String {
    let at = |name: &str| link(&folder.join(name));
    let name = |end: &str| at(&format!("{}{end}", growth::PICTURE));
    format!(
        "\n## What more costs\n\n{GROWTH} [Table]({}), [SVG]({}).\n\n{}",
        at(growth::TABLE),
        name(".svg"),
        shown((&name(".png"), &name("-dark.png")), "what more of something costs"),
    )
}

/// A picture, light and dark.
pub(crate) fn shown((light, dark): (&str, &str), words: &str) -> String {
    format!(
        "<picture>\n  <source media=\"(prefers-color-scheme: dark)\" srcset=\"{dark}\">\n  \
         <img src=\"{light}\" width=\"800\" alt=\"{words}\">\n</picture>\n"
    )
}

const GROWTH: &str = "\
P1 with more of one thing at a time: springs of its row, by velocity Verlet with 1 000 steps a period; all others by the event
stepper at 1e-6: contacts under the slider, no two alike, that share its load; sliders, no two alike, on the foot; simulated
time; rows written per period; corners of a memory, left by ever smaller swings of the foot, while a still smaller one goes on.
Events of things that are not alike do not coincide: twice as many contacts make twice as many events, each with the work of
twice as many.";

const TIMES: &str = "\
**Times** are processor times of the run alone, without building and output; on an idle machine they are wall times, which are
in the tables of all runs, too. All runs take turns, several rounds, and the shortest turn counts. On another machine they
differ; their ratios differ less.";

const NORM: &str = "\
**Errors** are the largest of any free coordinate, at the end or along the way (1 001 moments of the run), in parts of the
stroke of the scenario's waveform, or of the largest travel where nothing follows one; an angle counts as the way it makes at
the farthest contact point. They are against the event stepper at a tolerance of 1e-14, two orders finer than the finest run.";

const OTHERS: &str = "\
**What others would do**, in code that shares nothing with the program's rows and steppers. **loop** is what a researcher writes: a
fixed step over a row of springs, by velocity Verlet (`loop` in the tables of all runs) or by Runge and Kutta's method of order 4
(`loop-rk4`); tuned: half of the symmetric row, the widest vectors of the machine, driven places from a table. **rk4** and **verlet**
are the faster ones of the program's own and of a plain loop on the exact contact by memory of its turns (`exact-rk4`,
`exact-verlet`), which is there for powers under constant loads. **ode_solvers** is that crate's Dopri5 with the exact contact and
events by hand: looked for after every step, located on its dense output, then started anew with the last step. It is there where
all loads are constant. **floor** is the least code for P1 and its like alone, from event to event.";

const RATIOS: &str = "\
## How many times as long

Time per simulated second of the event stepper for an error along the way, and how many times as long the others take: between
measured runs by the straight line through their logarithms, and nothing beyond; > where the longest run that gains anything has a
larger error; – where others do not know the scene: the loops have up to six free coordinates, the events by hand up to three and
constant loads, and none of them springs, stacks or damped contacts.";

/// The command that writes the page.
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

/// The folder of a file.
pub(crate) fn parent(file: &Path) -> &Path {
    file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Two significant digits, three from 100 on.
fn digits(value: f64) -> String {
    let decimals = (1.0 - math::log10(value.abs().max(1e-9)).floor()).clamp(0.0, 9.0) as usize;
    let grain = if value >= 1000.0 { 10_f64.powi(math::log10(value).floor() as i32 - 1) } else { 1.0 };
    let shown = if value >= 1000.0 { (value / grain).round() * grain } else { value };
    let text = format!("{shown:.decimals$}");
    // A value of that size has no decimals.
    if value >= 1e4 { grouped(shown as u64) } else { text }
}

/// A number with its thousands apart.
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
