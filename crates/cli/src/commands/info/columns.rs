//! Formats contacts as columns of a table.

use super::digits::digits;
use super::tables::{WIDTH, grid, unbroken};
use stickslip_run::Real;
use stickslip_run::info::{ContactInfo, DampingInfo, Loaded, Pressed};
use stickslip_run::quantity;

/// Padding of a column.
const PADDING: usize = 2;
/// Maximum number of contacts named in a warning.
const NAMED: usize = 4;

const ABOUT_STROKE: &str = "\
S₀ is the value of the quasi-static, damped limit: instant flyback, slow stroke, load against the
steps. In this limit, smaller strokes make no step. A real slider rings after the flyback, and its
steps near S₀ depend on the ringing.";

/// Returns the contacts as columns, as many per block as fit, with notes and warnings.
pub(super) fn contacts(contacts: &[(String, ContactInfo)]) -> String {
    let labels = cells_of(None);
    let label_width = labels.iter().map(|label| width(label)).max().unwrap_or(0) + PADDING;
    let columns: Vec<Vec<String>> = contacts.iter().map(|contact| cells_of(Some(contact))).collect();
    let mut blocks: Vec<Vec<&Vec<String>>> = Vec::new();
    let mut room = 0;
    for column in &columns {
        let needed = column.iter().map(|cell| width(cell)).max().unwrap_or(0) + PADDING;
        match blocks.last_mut().filter(|_| needed <= room) {
            Some(block) => block.push(column),
            None => {
                room = usize::from(WIDTH).saturating_sub(label_width);
                blocks.push(vec![column]);
            }
        }
        room = room.saturating_sub(needed);
    }
    let block = |block: &Vec<&Vec<String>>| {
        let row = |i: usize| -> Vec<String> {
            let label = std::iter::once(&labels[i]);
            label.chain(block.iter().map(|column| &column[i])).cloned().collect()
        };
        let rows = (1..labels.len()).map(row).filter(|row| row[1..].iter().any(|cell| !cell.is_empty()));
        grid(row(0), rows)
    };
    let mut sections: Vec<String> = blocks.iter().map(block).collect();
    if !sections.is_empty() {
        sections.push(ABOUT_STROKE.to_owned());
    }
    sections.extend(warnings(contacts));
    sections.join("\n\n")
}

/// Returns the cells of a contact's column, starting with its name. Without a contact it returns the row labels.
fn cells_of(contact: Option<&(String, ContactInfo)>) -> Vec<String> {
    let word = |label: &str, cell: &dyn Fn(&ContactInfo) -> String| match contact {
        None => label.to_owned(),
        Some((_, contact)) => cell(contact),
    };
    let pressed = |label: &str, unit: &str, value: &dyn Fn(&Pressed) -> Option<Real>| match contact {
        None => label.to_owned(),
        Some((_, contact)) => ranged(contact, unit, value),
    };
    vec![
        contact.map_or("CONTACTS".to_owned(), |(name, _)| name.clone()),
        word("between", &|c| unbroken(&c.between)),
        word("materials", &|c| unbroken(&c.materials)),
        word("profile", &|c| c.profile.clone()),
        word("number of identical contacts", &|c| c.count.to_string()),
        word("E*, effective modulus", &|c| quantity(c.normal_modulus, "Pa")),
        word("G*, effective shear modulus", &|c| quantity(c.tangential_modulus, "Pa")),
        word("Dundurs' β, 0 for similar pairs", &|c| {
            if c.elastically_similar { "0".to_owned() } else { digits(c.dundurs_beta.0) }
        }),
        word("μ, coefficient of friction", &|c| match c.kinetic_friction {
            Some(kinetic) => format!("{} static, {} kinetic", c.friction.0, kinetic.0),
            None => c.friction.0.to_string(),
        }),
        word("κ = μE*/G*", &|c| digits(c.stick_slope.0)),
        word("β, damping of the springs", &|c| damping_time(c, |it| it.tangential)),
        word("β over the shortest flank", &|c| damping(c, |it| it.flank_share)),
        word("βu̇/u_c at the largest speed", &|c| damping(c, |it| it.lead)),
        word("β, damping along the normal", &|c| damping_time(c, |it| it.normal)),
        pressed("F_N, normal force per contact", "N", &|p| Some(p.normal_force)),
        pressed("d, indentation", "m", &|p| Some(p.indentation)),
        pressed("a, contact radius", "m", &|p| Some(p.radius)),
        pressed("p_max, maximum pressure", "Pa", &|p| p.peak_pressure),
        pressed("u_c = κd, gross slip begins", "m", &|p| Some(p.gross_slip)),
        pressed("S₀, zero-step stroke", "m", &|p| Some(p.zero_step_stroke)),
        word("constant load, relative to μF_N", &|c| {
            let share = |load: Loaded| format!("{}, {}", quantity(load.force, "N"), digits(load.share.0));
            c.start.loaded.map_or(String::new(), share)
        }),
        pressed("S₀ against this load", "m", &|p| p.loaded?.zero_step_stroke),
        pressed("μF_N, friction limit of all", "N", &|p| Some(p.limit_force)),
        pressed("μ_kF_N, in gross slip", "N", &|p| p.kinetic_limit_force),
        pressed("tangential stiffness of all, stuck", "N/m", &|p| Some(p.tangential_stiffness)),
        pressed("normal stiffness of all", "N/m", &|p| Some(p.normal_stiffness)),
        pressed("contact resonance", "Hz", &|p| p.resonance),
    ]
}

/// Formats a damping time of a contact.
fn damping_time(contact: &ContactInfo, value: impl Fn(&DampingInfo) -> Option<Real>) -> String {
    contact.damping.as_ref().and_then(value).map_or(String::new(), |time| quantity(time, "s"))
}

/// Formats a number of the damping of a contact.
fn damping(contact: &ContactInfo, value: impl Fn(&DampingInfo) -> Option<Real>) -> String {
    contact.damping.as_ref().and_then(value).map_or(String::new(), |value| digits(value.0))
}

/// Formats a value at the start, with its range if the load varies.
fn ranged(contact: &ContactInfo, unit: &str, value: &dyn Fn(&Pressed) -> Option<Real>) -> String {
    let Some(start) = value(&contact.start) else { return String::new() };
    let ends = (contact.least.as_ref().and_then(value), contact.most.as_ref().and_then(value));
    let range = match ends {
        (Some(low), Some(high)) => span(low, high, unit),
        _ => String::new(),
    };
    format!("{}{range}", bounded(start, unit))
}

pub(super) fn span(low: Real, high: Real, unit: &str) -> String {
    format!(" ({} … {})", bounded(low, unit), bounded(high, unit))
}

fn bounded(value: Real, unit: &str) -> String {
    if value.0.is_infinite() { "unbounded".to_owned() } else { quantity(value, unit) }
}

/// Breaks a sentence into lines of the maximum width.
pub(crate) fn broken(text: &str) -> String {
    let (mut lines, mut room) = (String::new(), usize::from(WIDTH));
    for word in text.split(' ') {
        let needed = width(word) + 1;
        if lines.is_empty() {
            room += 1;
        } else if needed > room {
            lines.push('\n');
            room = usize::from(WIDTH) + 1;
        } else {
            lines.push(' ');
        }
        lines += word;
        room = room.saturating_sub(needed);
    }
    lines
}

/// Returns warnings for material pairs for which the theory is not exact, one per pair.
fn warnings(contacts: &[(String, ContactInfo)]) -> Vec<String> {
    let mut pairs: Vec<(String, Vec<&str>)> = Vec::new();
    for (name, contact) in contacts.iter().filter(|(_, contact)| !contact.elastically_similar) {
        let [first, second] = &contact.materials;
        let pair = broken(&format!("warning: {first} and {second} are {}.", contact.similarity));
        match pairs.iter_mut().find(|(known, _)| *known == pair) {
            Some((_, names)) => names.push(name),
            None => pairs.push((pair, vec![name])),
        }
    }
    let told = |(pair, names): (String, Vec<&str>)| {
        let more = names.len().saturating_sub(NAMED);
        let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
        let word = if names.len() == 1 { "Contact" } else { "Contacts" };
        format!("{pair}\n{word}: {}{rest}", names[..names.len() - more].join(", "))
    };
    pairs.into_iter().map(told).collect()
}

fn width(text: &str) -> usize {
    text.chars().count()
}
