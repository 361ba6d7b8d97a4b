//! The page of frames, in Markdown.

use super::picture::micro;
use super::sheet::{orders, quantiles};
use super::{ACCURACY, Findings, HISTOGRAMS, Loop, PICTURE, STEPPERS, TABLE, WORST};
use crate::machine;
use crate::page::{grouped, parent, shown};
use std::fmt::Write;
use std::io;
use std::path::Path;
use stickslip_realtime::plant::{Work, counted};
use stickslip_realtime::{Histogram, Timing};
use stickslip_run::folder;
use stickslip_run::markdown::{link, plain, relative, word};
use stickslip_run::program::this_program;

const CHOICE: &str = "\
**Loops.** Each computes its frames one after the other, nothing waits; then some seconds of frames after a clock. `frames` has an
accuracy of 1e-3, `event` a tolerance of 1e-8. Inputs of a scene change in every frame: seeded walks that go by at most 2 % of half
their range. What is drawn, counted and looked at for the measurement's sake is no part of a frame's time; looking at the clock is.
The empty loop is the same without a drive: what it takes, and how late it wakes, is the machine's.

**No bound on time.** All times are as seen, on a machine that others share: without a real-time kernel and a processor of its own
any frame may take milliseconds, the empty loop's, too. Counted work is the same on every machine and in every run.";

const LOOPS: &str = "\
## Frames

Execution times in µs without waiting: half, 99.9 % and 99.99 % of the frames took no longer, and none longer than the worst. Work as
steps / evaluations / turning points made or given up / turning points for which there was no room, of a frame of median
work and of the worst (evaluations and twice the turning points). Errors: the largest of any free coordinate against the event stepper at
1e-11, under the same inputs, in the smallest u_c of the contacts and in strokes (or largest travels).";

const PACED: &str = "\
## After a clock

The same loops, each frame after its deadline, no favours asked: wake-up latency and execution time in µs, frames that ended after
the next deadline, and deadlines left out for them.";

const PICTURED: &str = "\
Logarithmic counts, in bins of a tenth of a decade. Marked are the ten slowest frames of each loop, by what was counted in them, the
first of these that fits: *merge*, turning points for which there was no room; *event*, located by the event stepper;
*turning point or growth*, a memory got or gave up some; *corner or cut step*, more steps than in a frame of median work;
*plain*, none of these: what took the time is not to be looked for in the drive. Right the latest frames after a clock.";

const ERRORS: &str = "\
## Accuracy in frames

Errors over lengths of frames, against the whole run by the event stepper at 1e-11, moment by moment (each millisecond), in u_c. Inputs
go straight from millisecond to millisecond, so that all lengths have one problem. The order is the slope of least squares in the
logarithms: of `frames` over the lengths of its steps, of `event` over those of frames, whose errors follow its tolerance.";

/// Writes the page.
///
/// # Errors
/// A file that cannot be written, or whose place cannot be told from that of the tables.
pub(super) fn write(findings: &Findings<'_>, file: &Path) -> io::Result<()> {
    let home = relative(&findings.request.out, parent(file))?;
    let at = |name: &str| link(&home.join(name));
    let mut page = format!(
        "# Frames in real time\n\nHow long frames of drives take, what is counted in them, and what they lose. This page, its tables \
         and pictures are written by\n\n```sh\n{}\n```\n\non {}, by {}, built with `{}`. What is promised in real time, and \
         what is not: `docs/realtime.md`.\n\n{CHOICE}\n\n{LOOPS}\n\n",
        command(findings),
        machine::words(),
        this_program(),
        if cfg!(debug_assertions) { "--profile dev" } else { "--release" },
    );
    loops(&mut page, findings);
    let _ = writeln!(
        page,
        "\n{PICTURED}\n\n{}\nAll figures: [loops]({}), [worst frames]({}), [counts]({}), [errors]({}), [SVG]({}).",
        shown(
            (&at(&format!("{PICTURE}.png")), &at(&format!("{PICTURE}-dark.png"))),
            "how long frames take, a row for each scene"
        ),
        at(TABLE),
        at(WORST),
        at(HISTOGRAMS),
        at(ACCURACY),
        at(&format!("{PICTURE}.svg")),
    );
    if findings.request.paced > 0.0 {
        let _ = writeln!(page, "\n{PACED}\n");
        paced(&mut page, findings);
    }
    let _ = writeln!(page, "\n{ERRORS}\n");
    errors(&mut page, findings);
    scenes(&mut page, findings, parent(file))?;
    folder::write(file, page.as_bytes())
}

/// A line of a table for each loop that nothing paced.
fn loops(page: &mut String, findings: &Findings<'_>) {
    page.push_str(
        "| scene | period, µs | stepper | steps | frames | median | 99.9 % | 99.99 % | worst | median work | worst work | error, u_c | \
         strokes |\n| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
    );
    for of in &findings.loops {
        let steps = of.steps.map_or_else(|| "–".to_owned(), |steps| steps.to_string());
        let [median, worst] = [0.5, 1.0].map(|share| works(&of.works.at(share).1));
        let _ = writeln!(
            page,
            "| {} | {} | {steps} | {} | {} | {median} | {worst} | {:.1e} | {:.1e} |",
            head(findings, of),
            STEPPERS[of.stepper],
            grouped(of.timing.frames()),
            times(&of.timing.execution),
            of.off.natural,
            of.off.stroke,
        );
    }
    let empty = &findings.empty;
    let _ = writeln!(
        page,
        "| empty loop | – | – | – | {} | {} | – | – | – | – |",
        grouped(empty.frames()),
        times(&empty.execution)
    );
}

/// The same after a clock.
fn paced(page: &mut String, findings: &Findings<'_>) {
    page.push_str(
        "| scene | period, µs | stepper | frames | overruns | left out | latency: median | 99.9 % | 99.99 % | worst | execution: median | \
         99.9 % | 99.99 % | worst |\n| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
    );
    let mut line = |head: &str, stepper: &str, timing: &Timing| {
        let (latency, execution) = (times(&timing.latency), times(&timing.execution));
        let counts = [timing.frames(), timing.overruns, timing.left_out].map(grouped).join(" | ");
        let _ = writeln!(page, "| {head} | {stepper} | {counts} | {latency} | {execution} |");
    };
    for of in &findings.loops {
        of.paced.iter().for_each(|timing| line(&head(findings, of), STEPPERS[of.stepper], timing));
    }
    for (period, floor) in findings.request.periods.iter().zip(&findings.floors) {
        line(&format!("empty loop | {}", micro(*period)), "–", floor);
    }
}

/// Errors over lengths of frames: a line for each scene and stepper.
fn errors(page: &mut String, findings: &Findings<'_>) {
    let lengths: Vec<String> =
        super::accuracy::LENGTHS.iter().map(|length| format!(" {} µs |", micro(*length))).collect();
    let _ = writeln!(page, "| scene | stepper | order |{}", lengths.concat());
    let _ = writeln!(page, "| --- | --- | ---: |{}", " ---: |".repeat(lengths.len()));
    for (scene, ladder) in findings.scenes.iter().zip(&findings.ladders) {
        for (stepper, order) in orders(ladder).into_iter().enumerate() {
            let order = order.map_or_else(|| "–".to_owned(), |order| format!("{order:.1}"));
            let _ = write!(page, "| `{}` | {} | {order} |", name(&scene.job.name), STEPPERS[stepper]);
            ladder.iter().for_each(|rung| *page += &format!(" {:.1e} |", rung.off[stepper].natural));
            page.push('\n');
        }
    }
}

/// What the scenes are.
fn scenes(page: &mut String, findings: &Findings<'_>, folder: &Path) -> io::Result<()> {
    page.push_str("\n## Scenes\n\n");
    for (place, scene) in findings.scenes.iter().enumerate() {
        let file = link(&relative(findings.file(place), folder)?);
        let fed = if scene.inputs.is_empty() { "nothing is fed" } else { "fed in every frame" };
        let _ =
            writeln!(page, "* [`{}`]({file}): {}; {fed}.", name(&scene.job.name), plain(scene.job.title()));
    }
    Ok(())
}

/// Scene and period of a loop, as two cells.
fn head(findings: &Findings<'_>, of: &Loop) -> String {
    format!("`{}` | {}", name(findings.name(of)), micro(findings.length(of)))
}

/// A name inside of backticks, inside of a table.
fn name(name: &str) -> String {
    name.replace('`', "'").replace('|', "\\|")
}

/// Median, 99.9 %, 99.99 % and worst in µs, as four cells.
fn times(histogram: &Histogram) -> String {
    quantiles(histogram)
        .map(|time| if time < 100.0 { format!("{time:.2}") } else { format!("{time:.0}") })
        .join(" | ")
}

/// What a frame was counted to.
fn works(work: &Work) -> String {
    super::sheet::SHOWN.map(|name| counted(work, name).to_string()).join(" / ")
}

/// The command that writes the page.
fn command(findings: &Findings<'_>) -> String {
    let request = findings.request;
    let mut command = "stickslip-lab bench --realtime".to_owned();
    request.files.iter().for_each(|file| command += &format!(" {}", word(file)));
    request.set.iter().for_each(|(path, value)| command += &format!(" --set {path}=\"{value}\""));
    let periods: Vec<String> =
        request.periods.iter().map(|period| format!("{} us", micro(*period))).collect();
    let (frames, paced) = (request.frames, request.paced);
    command += &format!(" --period \"{}\" --frames {frames} --paced \"{paced} s\"", periods.join(","));
    command += &format!(" --out {}", word(&request.out));
    request.page.iter().for_each(|page| command += &format!(" --page {}", word(page)));
    command
}
