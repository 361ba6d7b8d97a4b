//! Formats the properties of a scenario as tables. The width does not depend on the terminal.

use super::columns::{self, span};
use super::digits::{bytes, digits, mass, two_digits, whole};
use comfy_table::{ContentArrangement, LineStyle, Table, TableStyle};
use stickslip_run::Real;
use stickslip_run::info::Item;
use stickslip_run::info::{BodyInfo, Freed, ModeInfo, PiezoInfo, WaveformInfo};
use stickslip_run::outlook::Outlook;
use stickslip_run::quantity;
use stickslip_study::Info;

/// Maximum line width.
pub(super) const WIDTH: u16 = 100;
/// Table style with a line below the header only.
const STYLE: TableStyle = TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));
/// Non-breaking space, printed as an ordinary space.
const KEPT_SPACE: char = '\u{a0}';
/// Smallest displacement in a vibration mode, relative to the largest, that is shown.
const SHOWN: f64 = 5e-4;

/// Returns all tables.
pub(super) fn text(info: &Info) -> String {
    let head = if info.title.is_empty() {
        info.scenario.clone()
    } else {
        format!("{}: {}", info.scenario, info.title)
    };
    let modes = if info.modes.is_empty() { String::new() } else { modes(info) };
    let sections = [
        head,
        bodies(info),
        waveforms(info),
        columns::contacts(&info.contacts.0),
        modes,
        actuators(info),
        lasting(info),
        run(info),
        usage(info),
    ];
    sections.into_iter().filter(|section| !section.is_empty()).collect::<Vec<_>>().join("\n\n")
}

fn bodies(info: &Info) -> String {
    let row = |(name, body): &(String, BodyInfo)| {
        let coordinates = body.coordinates.0.iter().map(|(axis, freed)| format!("{axis} {}", words(freed)));
        vec![name.clone(), body.mass.map_or(String::new(), mass), coordinates.collect::<Vec<_>>().join(", ")]
    };
    grid(["BODIES", "mass", "coordinates"], info.bodies.0.iter().map(row))
}

fn waveforms(info: &Info) -> String {
    let row = |(name, waveform): &(String, WaveformInfo)| {
        let range = |range: Option<[Real; 2]>, unit| {
            range.map_or(String::new(), |[low, high]| {
                format!("{} … {}", quantity(low, unit), quantity(high, unit))
            })
        };
        let mut period = waveform.period.map_or("none".to_owned(), |period| quantity(period, "s"));
        if let Some([low, high]) = waveform.commanded {
            period += &format!(", commanded {} … {}", quantity(low, "Hz"), quantity(high, "Hz"));
        }
        let ranges = [range(waveform.lengths, "m"), range(waveform.forces, "N")];
        vec![name.clone(), joined(&ranges), period, unbroken(&waveform.drives)]
    };
    grid(["WAVEFORMS", "range", "period", "drive"], info.waveforms.0.iter().map(row))
}

fn modes(info: &Info) -> String {
    let row = |mode: &ModeInfo| {
        let range = mode.range.map_or(String::new(), |[low, high]| span(low, high, "Hz"));
        let period = Real(1.0 / mode.frequency.0);
        let moves = mode.shape.0.iter().filter(|(_, x)| x.0.abs() >= SHOWN);
        let shape: Vec<String> = moves.map(|(name, x)| format!("{name} {}", digits(x.0))).collect();
        if mode.frequency.0 == 0.0 && mode.range.is_none_or(|[_, high]| high.0 == 0.0) {
            return vec!["not held".to_owned(), String::new(), String::new(), unbroken(&shape)];
        }
        vec![
            format!("{}{range}", quantity(mode.frequency, "Hz")),
            if period.0.is_finite() { quantity(period, "s") } else { String::new() },
            digits(mode.damping_ratio.0),
            unbroken(&shape),
        ]
    };
    grid(["MODES, all contacts stuck", "period", "damping ratio", "shape"], info.modes.iter().map(row))
}

fn actuators(info: &Info) -> String {
    let row = |(name, piezo): &(String, PiezoInfo)| {
        let mut numbers = vec![
            format!("k {}", quantity(piezo.stiffness, "N/m")),
            format!("c {}", quantity(piezo.damping, "N s/m")),
        ];
        numbers.extend(
            piezo.quality.map(|quality| format!("(Q {}, typical of a soft ceramic)", digits(quality.0))),
        );
        numbers.extend(piezo.mass.map(|own| format!("own mass {}", mass(own))));
        numbers.extend(piezo.stroke_per_volt.map(|gain| quantity(gain, "m/V")));
        numbers.extend(piezo.capacitance.map(|farads| quantity(farads, "F")));
        numbers.extend(piezo.resolution.map(|step| format!("{} per count", quantity(step, "m"))));
        numbers.extend(piezo.coupling.map(|part| format!("kα²/C {}", digits(part.0))));
        let force = piezo.command.blocking_force;
        let [low, high] = piezo.command.stroke.map(|end| quantity(end, "m"));
        let command = format!("{low} … {high}, blocking force {}", quantity(force, "N"));
        vec![name.clone(), command, unbroken(&numbers)]
    };
    if info.actuators.0.is_empty() {
        return String::new();
    }
    let table = grid(["ACTUATORS", "commanded stroke", "stack"], info.actuators.0.iter().map(row));
    let said = info.actuators.0.iter().flat_map(|(_, piezo)| &piezo.words);
    std::iter::once(table).chain(said.map(|words| paragraph(words))).collect::<Vec<_>>().join("\n\n")
}

fn lasting(info: &Info) -> String {
    let Some(outlook) = &info.steady_motion else { return String::new() };
    let rows = match outlook {
        Outlook::Found(motion) => {
            let speed = match motion.steps() {
                true => format!(", {}", quantity(motion.speed, "m/s")),
                false => String::new(),
            };
            vec![
                ["step", &format!("{}{speed}", motion.step_words())].map(str::to_owned),
                ["disturbance", &motion.words].map(str::to_owned),
            ]
        }
        Outlook::NotFound { fault } => vec![["none", fault.as_str()].map(str::to_owned)],
    };
    grid(["PERIODIC ORBIT", ""], rows.into_iter().map(Vec::from))
}

fn run(info: &Info) -> String {
    let (stepping, expected) = (&info.stepping, &info.expected);
    let stepper = match (stepping.tolerance, stepping.step, stepping.frame.zip(stepping.substeps)) {
        (Some(tolerance), ..) => format!("{}, tolerance {:e}", stepping.stepper, tolerance.0),
        (_, _, Some((frame, steps))) => format!(
            "{} of {}, {} time steps each, more at corners and contact events",
            stepping.stepper,
            quantity(frame, "s"),
            whole(steps.0)
        ),
        (_, Some(step), _) => format!("{}, step {}", stepping.stepper, quantity(step, "s")),
        _ => stepping.stepper.to_owned(),
    };
    let stable = |step: Option<Real>| step.map(|step| format!("below {}", quantity(step, "s")));
    let time = match stepping.until_steady {
        Some(change) => {
            format!(
                "at most {}, or until the relative change of steps is {:e}",
                quantity(stepping.duration, "s"),
                change.0
            )
        }
        None => quantity(stepping.duration, "s"),
    };
    let of_springs = |(lines, size): (Real, Real)| format!("{} lines, about {}", whole(lines.0), bytes(size));
    let events = &expected.events;
    let per_period = events
        .per_period
        .as_ref()
        .map(|per| format!("; about {} per period of {}", two_digits(per.estimate.0), per.waveform));
    let rows = [
        ("stepper", Some(stepper)),
        ("simulated time", Some(time)),
        ("steps", expected.steps.map(|steps| whole(steps.0))),
        ("stable fixed step, verlet", stable(stepping.longest_verlet)),
        ("stable fixed step, rk4", stable(stepping.longest_rk4)),
        (
            "events, rough estimate",
            Some(format!("about {}{}", two_digits(events.total()), per_period.unwrap_or_default())),
        ),
        ("rows × columns", Some(format!("{} × {}", whole(expected.rows.0), expected.columns))),
        (
            "trace.csv, events.csv",
            Some(format!("about {}, {}", bytes(expected.trace), bytes(expected.events_file))),
        ),
        ("springs.csv", expected.spring_lines.zip(expected.springs_file).map(of_springs)),
        ("fields.csv", expected.field_lines.map(|lines| format!("{} lines", whole(lines.0)))),
        ("memory.csv", expected.memory_curves.map(|curves| format!("{} curves", whole(curves.0)))),
        ("memory", Some(format!("about {}", bytes(expected.memory)))),
    ];
    let rows = rows.into_iter().filter_map(|(label, cell)| Some(vec![label.to_owned(), cell?]));
    grid(["RUN", ""], rows)
}

fn usage(info: &Info) -> String {
    let rows = |items: &[Item]| -> Vec<Vec<String>> {
        let row = |item: &Item| vec![item.what.to_owned(), unbroken(&item.of), item.why.clone()];
        items.iter().map(row).collect()
    };
    let tables = [("COMPUTED", &info.usage.used), ("SKIPPED", &info.usage.skipped)];
    let tables = tables.map(|(title, items)| grid([title, "of", "why"], rows(items)));
    tables.into_iter().filter(|table| !table.is_empty()).collect::<Vec<_>>().join("\n\n")
}

/// Describes the freedom of a coordinate.
fn words(freed: &Freed) -> String {
    match freed {
        Freed::Fixed => "fixed".to_owned(),
        Freed::Free => "free".to_owned(),
        Freed::Balanced => "balanced".to_owned(),
        Freed::Follows(waveform) => format!("follows {waveform}"),
    }
}

/// Returns a table with a header, or an empty string without rows.
pub(crate) fn grid(
    head: impl IntoIterator<Item = impl Into<String>>,
    rows: impl IntoIterator<Item = Vec<String>>,
) -> String {
    let mut table = Table::new();
    table.load_style(STYLE).set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH);
    table.set_header(head.into_iter().map(Into::into).collect::<Vec<String>>());
    table.add_rows(rows);
    if table.is_empty() {
        return String::new();
    }
    let text = table.trim_fmt().replace(KEPT_SPACE, " ");
    // Removes the padding at the left side.
    text.lines().map(|line| line.strip_prefix(' ').unwrap_or(line)).collect::<Vec<_>>().join("\n")
}

/// Breaks a sentence into lines of the maximum width.
fn paragraph(sentence: &str) -> String {
    let mut table = Table::new();
    table.load_style(TableStyle::new()).set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH);
    table.add_row([sentence]);
    table.trim_fmt().lines().map(str::trim).collect::<Vec<_>>().join("\n")
}

/// Joins names so that lines break only between them.
pub(super) fn unbroken(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| name.replace(' ', &KEPT_SPACE.to_string())).collect();
    names.join(", ")
}

fn joined(parts: &[String]) -> String {
    parts.iter().filter(|part| !part.is_empty()).cloned().collect::<Vec<_>>().join(", ")
}
