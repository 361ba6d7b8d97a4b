//! Report of a real-time loop as text.

use super::{Report, Times};
use crate::plant::WORK;
use crate::worst::Slow;

/// Note that the measured timing is not guaranteed.
pub const PROMISE: &str = "measured in this run, not guaranteed: without a real-time kernel (PREEMPT_RT), a \
reserved processor and locked memory, the operating system may delay the loop by milliseconds at any time";

/// Returns the report as text. `worst` is the slowest frame.
pub fn text(report: &Report, worst: Option<&Slow>) -> String {
    let mut lines = vec![head(report)];
    lines.push(times("execution", &report.execution, report));
    lines.extend(report.latency.as_ref().map(|latency| times("wake-up latency", latency, report)));
    if let Some(empty) = &report.empty_latency {
        lines.push(times(&format!("empty loop, {} frames: latency", report.empty_frames), empty, report));
    }
    if let Some(slow) = worst {
        let work: Vec<String> = WORK
            .iter()
            .zip(slow.work)
            .filter(|(_, n)| *n > 0)
            .map(|(name, n)| format!("{n} {name}"))
            .collect();
        let work = if work.is_empty() { "nothing counted".to_owned() } else { work.join(", ") };
        lines.push(format!(
            "  slowest frame: {} at {:.6} s: {work}",
            slow.frame,
            slow.frame as f64 * report.period_s
        ));
    }
    lines.extend(inputs(report));
    lines.extend(lost(report));
    lines.extend(report.denied.iter().map(|denied| format!("  {denied}")));
    lines.extend(springs(report));
    lines.push(format!("  {}", verdict(report)));
    if report.paced {
        lines.push(format!("  {PROMISE}"));
    }
    lines.join("\n")
}

fn head(report: &Report) -> String {
    let Report { scenario, stepper, frames, .. } = report;
    let (simulated, wall) = (report.simulated_s, report.wall_s);
    let period = 1e6 * report.period_s;
    format!(
        "{scenario}: {frames} frames of {period} µs, {stepper}: {simulated:.6} s simulated in {wall:.6} s"
    )
}

fn times(name: &str, times: &Times, report: &Report) -> String {
    let Times { median_us, p99_9_us, p99_99_us, worst_us, .. } = times;
    let share = 1e-4 * worst_us / report.period_s;
    format!(
        "  {name}: median {median_us:.2} µs, 99.9 % {p99_9_us:.2} µs, 99.99 % {p99_99_us:.2} µs, maximum \
         {worst_us:.2} µs ({share:.0} % of the period)"
    )
}

/// Returns a line about the received inputs. Returns `None` without inputs.
fn inputs(report: &Report) -> Option<String> {
    let received = &report.received;
    if report.inputs.is_empty() {
        return None;
    }
    let refused = received.refused();
    let refused = refused.map_or_else(|| "none refused".to_owned(), |refused| format!("refused: {refused}"));
    Some(format!(
        "  inputs: {} valid, {refused}; {} of {} frames had no new input, at most {} in a row",
        received.good, received.stale_frames, report.frames, received.most_stale
    ))
}

fn lost(report: &Report) -> Option<String> {
    let lost = [
        (report.outputs_unsent, "outputs"),
        (report.log_lost, "frames of the log"),
        (report.recording_lost, "frames of the recording"),
    ];
    let lost: Vec<String> =
        lost.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}")).collect();
    (!lost.is_empty()).then(|| format!("  lost: {}", lost.join(", ")))
}

fn springs(report: &Report) -> Option<String> {
    let Some(rows) = report.rows.as_ref() else { return Some("  rows of springs: not measured".to_owned()) };
    let measured: Vec<String> =
        rows.springs.iter().zip(&rows.p99_us).map(|(n, time)| format!("{n} springs {time:.2} µs")).collect();
    let fits = match rows.fit_in_period {
        Some(n) => format!("about {n} springs per contact fill the period"),
        None => "the number that fills the period was not measured".to_owned(),
    };
    Some(format!("  with rows of springs, 99 % of the frames took at most: {}; {fits}", measured.join(", ")))
}

/// Returns a line that reports whether all deadlines were met.
fn verdict(report: &Report) -> String {
    let share = 1e-4 * report.execution.p99_99_us / report.period_s;
    let Report { overruns, frames, deadlines_skipped, longest_skip, .. } = report;
    match report.ended {
        "stopped" | "memory" => format!("stopped: {}", report.error.as_deref().unwrap_or_default()),
        "no_input" => "not started: no input arrived".to_owned(),
        _ if !report.paced => {
            format!("not paced; 99.99 % of the frames took up to {share:.1} % of the period")
        }
        _ if report.kept => {
            format!(
                "kept: no overrun in {frames} frames; 99.99 % of the frames took up to {share:.1} % of the period"
            )
        }
        ended => {
            let ended = match ended {
                "interrupted" => ", interrupted",
                "silence" => ", ended by silence",
                _ => "",
            };
            let kept = if *overruns == 0 { "no overrun" } else { "not kept" };
            format!(
                "{kept}{ended}: {overruns} of {frames} frames overran, {deadlines_skipped} deadlines skipped, at most {longest_skip} \
                 in a row; 99.99 % of the frames took up to {share:.1} % of the period"
            )
        }
    }
}
