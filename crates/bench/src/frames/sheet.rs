//! Tables of the benchmark of frames.

use super::accuracy::{Rung, order};
use super::{Findings, STEPPERS};
use std::fmt::Write;
use stickslip_realtime::plant::{WORK, counted};
use stickslip_realtime::worst::kind;
use stickslip_realtime::{Histogram, Timing};

/// Counts that the table of loops contains.
pub(super) const SHOWN: [&str; 4] = ["steps", "evaluations", "knots", "merges"];

/// Returns median, 99.9 %, 99.99 % quantile and maximum, µs.
pub(super) fn quantiles(histogram: &Histogram) -> [f64; 4] {
    let at = |share| histogram.quantile(share) as f64 / 1e3;
    [at(0.5), at(0.999), at(0.9999), histogram.worst() as f64 / 1e3]
}

/// Returns the table of loops. The empty loop of each frame length has an empty scenario name.
pub(super) fn loops(findings: &Findings<'_>) -> String {
    let mut text = "scene,period_s,stepper,steps_per_frame,frames".to_owned();
    for end in ["execution", "paced_execution", "paced_latency"] {
        for share in ["median", "p99_9", "p99_99", "worst"] {
            let _ = write!(text, ",{end}_{share}_us");
        }
    }
    for which in ["median", "worst"] {
        SHOWN.iter().for_each(|name| text += &format!(",{which}_work_{name}"));
    }
    text += ",worst_work_frame,paced_frames,overruns,deadlines_skipped,error_u_c,error_strokes\n";
    for of in &findings.loops {
        let steps = of.steps.map_or_else(String::new, |steps| steps.to_string());
        let (name, length) = (field(findings.name(of)), findings.length(of));
        let _ = write!(text, "{name},{length:e},{},{steps},{}", STEPPERS[of.stepper], of.timing.frames());
        text += &times(&of.timing, of.paced.as_ref());
        for (_, work) in [of.works.at(0.5), of.works.at(1.0)] {
            SHOWN.iter().for_each(|name| text += &format!(",{}", counted(&work, name)));
        }
        let _ = write!(text, ",{}", of.works.at(1.0).0);
        text += &kept(of.paced.as_ref());
        let _ = writeln!(text, ",{:e},{:e}", of.off.natural, of.off.stroke);
    }
    for (length, floor) in findings.request.periods.iter().zip(&findings.floors) {
        let floor = (floor.frames() > 0).then_some(floor);
        let _ = write!(text, ",{length:e},empty,,{}", findings.empty.frames());
        text += &times(&findings.empty, floor);
        text += &",".repeat(2 * SHOWN.len() + 1);
        text += &kept(floor);
        text += ",,\n";
    }
    text
}

/// Returns twelve times as CSV fields. Without a paced loop, the fields of paced times are empty.
fn times(timing: &Timing, paced: Option<&Timing>) -> String {
    let mut text = String::new();
    let all =
        [Some(&timing.execution), paced.map(|paced| &paced.execution), paced.map(|paced| &paced.latency)];
    for histogram in all {
        match histogram {
            Some(histogram) => quantiles(histogram).iter().for_each(|time| text += &format!(",{time:.3}")),
            None => text += ",,,,",
        }
    }
    text
}

/// Returns the number of paced frames, overruns and skipped deadlines.
fn kept(paced: Option<&Timing>) -> String {
    paced.map_or(",,,".to_owned(), |paced| {
        format!(",{},{},{}", paced.frames(), paced.overruns, paced.left_out)
    })
}

/// Returns the slowest frames without pacing and the latest paced frames of each loop, with all counts.
pub(super) fn worst(findings: &Findings<'_>) -> String {
    let mut text =
        format!("scene,period_s,stepper,worst_by,frame,latency_us,execution_us,kind,{}\n", WORK.join(","));
    for of in &findings.loops {
        let usual = of.timing.usual();
        let slowest = of.timing.slowest.frames().iter().map(|slow| ("execution", slow));
        let latest = of.paced.iter().flat_map(|paced| paced.latest.frames());
        for (by, slow) in slowest.chain(latest.map(|slow| ("latency", slow))) {
            let work = slow.work.map(|count| count.to_string()).join(",");
            let _ = writeln!(
                text,
                "{},{:e},{},{by},{},{:.3},{:.3},{},{work}",
                field(findings.name(of)),
                findings.length(of),
                STEPPERS[of.stepper],
                slow.frame,
                slow.latency as f64 / 1e3,
                slow.execution as f64 / 1e3,
                kind(&slow.work, usual),
            );
        }
    }
    text
}

/// Returns the histograms: non-empty bins of 1 µs; the last bin contains all times above 20 ms.
pub(super) fn histograms(findings: &Findings<'_>) -> String {
    let mut text = "scene,period_s,stepper,what,from_us,frames\n".to_owned();
    let mut lines = |head: &str, what: &str, histogram: &Histogram| {
        let (bins, beyond) = histogram.microseconds();
        let longer = (beyond > 0).then_some((20_000, beyond));
        for (from, count) in bins.chain(longer) {
            let _ = writeln!(text, "{head},{what},{from},{count}");
        }
    };
    for of in &findings.loops {
        let head = format!("{},{:e},{}", field(findings.name(of)), findings.length(of), STEPPERS[of.stepper]);
        lines(&head, "execution", &of.timing.execution);
        if let Some(paced) = &of.paced {
            lines(&head, "paced_execution", &paced.execution);
            lines(&head, "paced_latency", &paced.latency);
        }
    }
    for (length, floor) in findings.request.periods.iter().zip(&findings.floors) {
        let head = format!(",{length:e},empty");
        lines(&head, "execution", &findings.empty.execution);
        lines(&head, "paced_execution", &floor.execution);
        lines(&head, "paced_latency", &floor.latency);
    }
    text
}

/// Returns the errors at all frame lengths, with the orders of convergence.
pub(super) fn accuracy(findings: &Findings<'_>) -> String {
    let mut text = "scene,frame_s,steps_per_frame,frames_error_u_c,frames_error_strokes,event_error_u_c,\
                    event_error_strokes,frames_order,event_order\n"
        .to_owned();
    for (scene, ladder) in findings.scenes.iter().zip(&findings.ladders) {
        let [frames, event] =
            orders(ladder).map(|order| order.map_or_else(String::new, |p| format!("{p:.3}")));
        for Rung { length, steps, off: [a, b] } in ladder {
            let _ = writeln!(
                text,
                "{},{length:e},{steps},{:e},{:e},{:e},{:e},{frames},{event}",
                field(&scene.job.name),
                a.natural,
                a.stroke,
                b.natural,
                b.stroke,
            );
        }
    }
    text
}

/// Returns the orders of convergence: of `frames` in its step length, of the event stepper in the frame length.
pub(super) fn orders(ladder: &[Rung]) -> [Option<f64>; 2] {
    [
        order(ladder.iter().map(|rung| (rung.length / rung.steps, rung.off[0].stroke))),
        order(ladder.iter().map(|rung| (rung.length, rung.off[1].stroke))),
    ]
}

/// Returns a name as a CSV field.
fn field(name: &str) -> String {
    if name.contains([',', '"', '\n']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_owned()
    }
}
