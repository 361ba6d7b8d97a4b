//! Units in headings of measured tables: units of scenarios and usual units of instruments.

use crate::recipe::Role;

/// Kind of quantity that a unit measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Time.
    Time,
    /// Length.
    Length,
    /// Force.
    Force,
    /// Mass. Scales display forces as masses.
    Mass,
    /// Voltage.
    Voltage,
}

/// Standard gravity, m/s² (CGPM 1901).
const G: f64 = 9.80665;
const POUND: f64 = 0.453_592_37;

/// Units with their spellings and SI factors. Masses are converted to forces by standard gravity.
const UNITS: &[(&[&str], Kind, f64)] = &[
    (&["ns"], Kind::Time, 1e-9),
    (&["us", "microsecond", "microseconds"], Kind::Time, 1e-6),
    (&["ms", "msec", "millisecond", "milliseconds"], Kind::Time, 1e-3),
    (&["s", "sec", "secs", "second", "seconds", "sek"], Kind::Time, 1.0),
    (&["min", "minute", "minutes"], Kind::Time, 60.0),
    (&["h", "hour", "hours"], Kind::Time, 3600.0),
    (&["nm", "nanometer", "nanometre", "nanometers"], Kind::Length, 1e-9),
    (&["um", "micrometer", "micrometre", "micrometers", "micron", "microns"], Kind::Length, 1e-6),
    (&["mil", "mils", "thou"], Kind::Length, 2.54e-5),
    (&["mm", "millimeter", "millimetre", "millimeters"], Kind::Length, 1e-3),
    (&["cm", "centimeter", "centimetre"], Kind::Length, 1e-2),
    (&["in", "inch", "inches"], Kind::Length, 2.54e-2),
    (&["m", "meter", "metre", "meters"], Kind::Length, 1.0),
    (&["uN"], Kind::Force, 1e-6),
    (&["mN"], Kind::Force, 1e-3),
    (&["N", "newton", "newtons"], Kind::Force, 1.0),
    (&["daN"], Kind::Force, 10.0),
    (&["kN", "kilonewton"], Kind::Force, 1e3),
    (&["MN"], Kind::Force, 1e6),
    (&["gf", "p"], Kind::Force, 1e-3 * G),
    (&["kgf", "kp"], Kind::Force, G),
    (&["lbf"], Kind::Force, POUND * G),
    (&["mg"], Kind::Mass, 1e-6 * G),
    (&["g", "gram", "grams"], Kind::Mass, 1e-3 * G),
    (&["kg"], Kind::Mass, G),
    (&["lb", "lbs"], Kind::Mass, POUND * G),
    (&["mV"], Kind::Voltage, 1e-3),
    (&["V", "volt", "volts"], Kind::Voltage, 1.0),
];

/// Finds a unit by its spelling. Returns its kind and its number of SI units.
pub(crate) fn find(text: &str) -> Option<(Kind, f64)> {
    let plain: String =
        text.trim().chars().map(|c| if matches!(c, '\u{b5}' | '\u{3bc}') { 'u' } else { c }).collect();
    let is = |spelling: &&&str| match spelling.len() {
        // The case of symbols matters: mN and MN differ.
        0..=3 => **spelling == plain,
        _ => spelling.eq_ignore_ascii_case(&plain),
    };
    // Some spellings, such as "Sec" and "MM", are unambiguous in any case.
    let exact = UNITS.iter().find(|(spellings, ..)| spellings.iter().any(|one| is(&one)));
    let loose = || {
        let lower = plain.to_lowercase();
        UNITS.iter().find(|(spellings, ..)| {
            ["sec", "mm", "um", "cm"].contains(&lower.as_str()) && spellings.contains(&lower.as_str())
        })
    };
    exact.or_else(loose).map(|(_, kind, factor)| (*kind, *factor))
}

/// Returns the number of SI units of a unit. Returns `None` if the unit does not fit the role.
pub(crate) fn of_role(role: Role, text: &str) -> Option<f64> {
    let (kind, factor) = find(text)?;
    fits(role, kind).then_some(factor)
}

/// Returns whether a column with this kind of unit can have the role.
pub(crate) fn fits(role: Role, kind: Kind) -> bool {
    match role {
        Role::Time => kind == Kind::Time,
        Role::Displacement | Role::Position => kind == Kind::Length,
        Role::Value => true,
        Role::Force | Role::Normal => matches!(kind, Kind::Force | Kind::Mass),
    }
}

/// Returns the unit symbols of a role.
pub(crate) fn symbols(role: Role) -> String {
    let all = UNITS.iter().filter(|(_, kind, _)| fits(role, *kind)).map(|(spellings, ..)| spellings[0]);
    all.collect::<Vec<_>>().join(", ")
}

/// Splits a heading into name and unit: `disp [um]`, `disp (um)`, `disp / um`, `disp_um`, `t in ms`, `Lateral um`, or a unit alone.
pub(crate) fn part(head: &str) -> (String, Option<String>) {
    let head = head.trim().trim_matches('"').trim();
    let is_unit = |text: &str| find(text).is_some();
    if is_unit(head) {
        return (String::new(), Some(head.to_owned()));
    }
    let bracketed = [('[', ']'), ('(', ')'), ('{', '}')].into_iter().find_map(|(open, close)| {
        let (name, unit) = head.strip_suffix(close)?.rsplit_once(open)?;
        Some((name, unit.trim()))
    });
    if let Some((name, unit)) = bracketed {
        return (name.trim().to_owned(), Some(unit.to_owned()));
    }
    for between in [" in ", "/", ",", "_", " "] {
        let Some((name, unit)) = head.rsplit_once(between) else { continue };
        // "min" usually means a minimum, not minutes.
        let is_least = unit.trim() == "min" && between != " in ";
        if is_unit(unit) && !is_least && !name.trim().is_empty() {
            return (name.trim().to_owned(), Some(unit.trim().to_owned()));
        }
    }
    (head.to_owned(), None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_are_parted_however_they_are_written() {
        for (head, name, unit) in [
            ("disp [um]", "disp", Some("um")),
            ("Weg [\u{b5}m]", "Weg", Some("\u{b5}m")),
            ("t in ms", "t", Some("ms")),
            ("Lateral um", "Lateral", Some("um")),
            ("F_mN", "F", Some("mN")),
            ("disp/\u{3bc}m", "disp", Some("\u{3bc}m")),
            ("second", "", Some("second")),
            ("t_min", "t_min", None),
            ("Analog 1", "Analog 1", None),
            ("Actuator Force ", "Actuator Force", None),
        ] {
            assert_eq!(part(head), (name.to_owned(), unit.map(str::to_owned)), "{head}");
        }
    }

    #[test]
    fn factors_are_those_of_the_definitions() {
        assert_eq!(of_role(Role::Displacement, "mil"), Some(2.54e-5));
        assert_eq!(of_role(Role::Force, "lbf"), Some(0.453_592_37 * 9.80665));
        assert_eq!(of_role(Role::Normal, "g"), Some(1e-3 * 9.80665));
        assert_eq!((of_role(Role::Force, "MN"), of_role(Role::Force, "mN")), (Some(1e6), Some(1e-3)));
        assert_eq!((of_role(Role::Time, "mm"), of_role(Role::Force, "furlong")), (None, None));
    }
}
