//! Formats a comparison as text.

use serde_json::Value;
use stickslip_compare::{ChannelDifference, Comparison, FigureDifference, Lone, time};
use stickslip_console::table;

/// Number of events and summary values shown of each kind; `--json` has all.
const SHOWN: usize = 5;

/// Returns a table of channels, then events, summary values and the first difference.
pub(crate) fn text(comparison: &Comparison) -> String {
    let mut lines = vec![heading(comparison)];
    lines.extend(channels(comparison));
    lines.extend(events(comparison));
    lines.extend(figures(comparison));
    if comparison.one_stopped() {
        lines.push(format!("  status: {} in A, {} in B", comparison.a.status, comparison.b.status));
    }
    lines.extend(comparison.notes.iter().map(|note| format!("  {note}")));
    lines.extend([format!("  {}", comparison.finding()), comparison.verdict.word().to_owned()]);
    lines.join("\n")
}

fn heading(comparison: &Comparison) -> String {
    let (a, b, tolerance) = (&comparison.a, &comparison.b, &comparison.tolerance);
    let steppers = if tolerance.same_stepper {
        format!("both by {}", a.stepper)
    } else {
        format!("A by {}, B by {}", a.stepper, b.stepper)
    };
    let (relative, moment) = (tolerance.relative.0, tolerance.time.0);
    format!(
        "A {}\nB {}\n  {steppers}; allowed: {relative:e} relative, {moment:.1e} s for events\n  compared: {} of A's time, \
         {} of its rows",
        a.folder,
        b.folder,
        share(comparison.coverage.time.0),
        share(comparison.coverage.rows.0)
    )
}

/// Formats a fraction in per cent. Incomplete fractions are never shown as 100 %.
fn share(share: f64) -> String {
    let percent = 100.0 * share;
    if percent < 100.0 { format!("{:.1} %", percent.min(99.9)) } else { "all".to_owned() }
}

fn channels(comparison: &Comparison) -> Vec<String> {
    let mut table = table::plain(["channel", "worst", "at t", "allowed", ""]);
    for channel in &comparison.channels {
        let at = channel.at.map(|at| format!("{} s", time(at.0))).unwrap_or_default();
        let verdict = if channel.is_same() { "ok" } else { "DIFFERS" };
        let allowed = channel.allowed.map(|allowed| amount(allowed.0, channel.unit)).unwrap_or_default();
        table.add_row([&channel.name, &worst(channel), &at, &allowed, verdict]);
    }
    for name in &comparison.channels_missing {
        table.add_row([name, "", "", "", "MISSING in B"]);
    }
    table::to_the_right(&mut table, 1..=3);
    table.lines().map(|line| format!(" {}", line.trim_end())).collect()
}

fn worst(channel: &ChannelDifference) -> String {
    match (channel.worst, channel.rows) {
        (Some(worst), _) => amount(worst.0, channel.unit),
        (None, 0) => "0 rows".to_owned(),
        (None, 1) => "1 row".to_owned(),
        (None, rows) => format!("{rows} rows"),
    }
}

fn events(comparison: &Comparison) -> Vec<String> {
    let events = &comparison.events;
    let agree = events.a - events.missing.len() - events.moved.len();
    let worst = amount(events.worst.0, "s");
    let mut lines = if events.is_same() {
        vec![format!("  events: all {agree} agree, within {worst}")]
    } else {
        vec![format!(
            "  events: {} in A, {} in B; {agree} agree, within {worst}; DIFFERS",
            events.a, events.b
        )]
    };
    let event = |event: &Lone| format!("{}, \"{}\" at t = {:?} s", event.source, event.kind, event.time.0);
    let some = |lines: &mut Vec<String>, what: &str, all: Vec<String>| {
        lines.extend(all.iter().take(SHOWN).map(|text| format!("    {what}: {text}")));
        if all.len() > SHOWN {
            lines.push(format!("    {what}: {} more", all.len() - SHOWN));
        }
    };
    some(&mut lines, "missing in B", events.missing.iter().map(event).collect());
    some(&mut lines, "extra in B", events.extra.iter().map(event).collect());
    let moved = events.moved.iter().map(|moved| {
        format!(
            "{}, by {}{}",
            event(&moved.event),
            if moved.by.0 > 0.0 { "+" } else { "" },
            amount(moved.by.0, "s")
        )
    });
    some(&mut lines, "moved in B", moved.collect());
    lines
}

fn figures(comparison: &Comparison) -> Vec<String> {
    let figures = &comparison.figures;
    if figures.compared == 0 && figures.missing.is_empty() {
        return vec!["  summary values: none in common, none compared".to_owned()];
    }
    if figures.differ.is_empty() && figures.missing.is_empty() {
        return vec![format!("  summary values: all {} agree", figures.compared)];
    }
    let agree = figures.compared - figures.differ.len();
    let mut lines =
        vec![format!("  summary values: {agree} agree, {} differ; DIFFERS", figures.differ.len())];
    lines.extend(figures.differ.iter().take(SHOWN).map(figure));
    if figures.differ.len() > SHOWN {
        lines.push(format!("    {} more", figures.differ.len() - SHOWN));
    }
    lines.extend(figures.missing.iter().map(|name| format!("    missing in B: {name}")));
    lines
}

fn figure(figure: &FigureDifference) -> String {
    let FigureDifference { name, unit, a, b, .. } = figure;
    let space = if unit.is_empty() { "" } else { " " };
    let words = match (a.as_f64(), b.as_f64(), figure.allowed) {
        (Some(x), Some(y), Some(allowed)) => {
            format!("difference {}, allowed {}", amount((x - y).abs(), unit), amount(allowed.0, unit))
        }
        _ => String::new(),
    };
    let shown = |value: &Value| format!("{value}{space}{unit}");
    format!(
        "    {name}: {} in A, {} in B{}{words}",
        shown(a),
        shown(b),
        if words.is_empty() { "" } else { "; " }
    )
}

/// Formats a value with two digits.
fn amount(value: f64, unit: &str) -> String {
    let digits = if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") };
    format!("{digits} {unit}").trim_end().to_owned()
}
