//! CSV tables of a real-time loop.

use crate::pace::Timing;
use crate::plant::WORK;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Returns a table of the non-empty histogram bins of 1 µs, for execution time and latency of the loop and of an empty loop.
///
/// The last row contains all durations of 20 ms or more.
pub fn histogram_csv(timing: &Timing, floor: &Timing) -> String {
    let all = [&timing.execution, &timing.latency, &floor.execution, &floor.latency];
    let mut bins: BTreeMap<u64, [u64; 4]> = BTreeMap::new();
    let mut beyond = [0; 4];
    for (column, histogram) in all.into_iter().enumerate() {
        let (counts, longer) = histogram.microseconds();
        counts.for_each(|(bin, count)| bins.entry(bin).or_default()[column] = count);
        beyond[column] = longer;
    }
    if beyond != [0; 4] {
        bins.insert(20_000, beyond);
    }
    let mut text = "from_us,execution,latency,empty_execution,empty_latency\n".to_owned();
    for (bin, [a, b, c, d]) in bins {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{bin},{a},{b},{c},{d}");
    }
    text
}

/// Returns a table of the frames with the longest execution times and the longest latencies, with their work.
pub fn frames_csv(timing: &Timing, period: f64) -> String {
    let mut text = format!("worst_by,frame,time_s,latency_us,execution_us,{}\n", WORK.join(","));
    for (by, worst) in [("execution", &timing.slowest), ("latency", &timing.latest)] {
        for slow in worst.frames() {
            let work = slow.work.map(|count| count.to_string()).join(",");
            let (latency, execution) = (slow.latency as f64 / 1e3, slow.execution as f64 / 1e3);
            let _ = writeln!(
                text,
                "{by},{},{:e},{latency:.3},{execution:.3},{work}",
                slow.frame,
                slow.frame as f64 * period
            );
        }
    }
    text
}
