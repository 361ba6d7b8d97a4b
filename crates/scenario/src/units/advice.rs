//! Suggestions for unknown units.

use super::{Kind, UNITS, find, normalise, symbols};
use crate::suggest;

/// Names of units that users spell out, in the singular.
const NAMES: &[(&str, &str)] = &[
    ("metre", "m"),
    ("meter", "m"),
    ("micron", "um"),
    ("second", "s"),
    ("sec", "s"),
    ("minute", "min"),
    ("gramme", "g"),
    ("gram", "g"),
    ("newton", "N"),
    ("hertz", "Hz"),
    ("pascal", "Pa"),
    ("degree", "deg"),
    ("radian", "rad"),
    ("volt", "V"),
    ("ampere", "A"),
    ("amp", "A"),
    ("farad", "F"),
    ("m/s/s", "m/s^2"),
    ("m/s2", "m/s^2"),
    ("kg m2", "kg m^2"),
];
/// Prefixes, spelt out or as symbols, as in "msec".
const PREFIXES: &[(&str, &str)] = &[
    ("", ""),
    ("nano", "n"),
    ("micro", "u"),
    ("milli", "m"),
    ("kilo", "k"),
    ("mega", "M"),
    ("giga", "G"),
    ("n", "n"),
    ("u", "u"),
    ("m", "m"),
    ("k", "k"),
];

/// Returns help for an unknown unit: the intended unit, or all units of the dimension.
pub(crate) fn advice(unit: &str, kind: Option<Kind>) -> String {
    let plain = normalise(unit);
    if let Some((symbol, found)) = spelt_out(&plain) {
        return match kind {
            Some(kind) if kind != found => of_another(unit, found, kind),
            _ => meant(symbol, kind),
        };
    }
    match same_letters(&plain, kind).or_else(|| nearest(&plain, kind)) {
        Some(symbol) => meant(symbol, kind),
        None => here(kind),
    }
}

/// Returns help for a unit of another dimension.
pub(crate) fn of_another(unit: &str, found: Kind, wanted: Kind) -> String {
    format!("{} is a unit of {}; {}", unit.trim(), found.article(), here(Some(wanted)))
}

fn meant(symbol: &str, kind: Option<Kind>) -> String {
    match kind {
        Some(_) if symbols(kind).count() > 1 => format!("did you mean \"{symbol}\"? {}", here(kind)),
        _ => format!("did you mean \"{symbol}\"?"),
    }
}

fn here(kind: Option<Kind>) -> String {
    match kind {
        Some(_) => format!("units here: {}", symbols(kind).collect::<Vec<_>>().join(", ")),
        None => "the unit is that of the following part, such as nm, um, mN, N or V".to_owned(),
    }
}

/// Returns the symbol of a unit that is spelt out, such as "micrometers" or "msec".
fn spelt_out(plain: &str) -> Option<(&'static str, Kind)> {
    let lower = plain.to_lowercase();
    let singular = lower.strip_suffix('s').filter(|rest| !rest.ends_with('/')).unwrap_or(&lower);
    [lower.as_str(), singular].into_iter().find_map(|word| {
        NAMES.iter().find_map(|(name, symbol)| {
            let before = word.strip_suffix(name)?;
            let (_, prefix) = PREFIXES.iter().find(|(prefix, _)| *prefix == before)?;
            let whole = format!("{prefix}{symbol}");
            let (kind, _) = find(&whole)?;
            UNITS.iter().find(|(known, ..)| *known == whole).map(|(known, ..)| (*known, kind))
        })
    })
}

/// Returns the only unit with the same letters in another case or with other blanks: "khz", "Ns/m". The prefixes m and M are not
/// interchanged, because they differ by nine orders of magnitude.
fn same_letters(plain: &str, kind: Option<Kind>) -> Option<&'static str> {
    let folded = |text: &str| text.replace([' ', '.', '-'], "").to_lowercase();
    let large = |text: &str| text.starts_with('M');
    only(symbols(kind).filter(|symbol| folded(symbol) == folded(plain) && large(symbol) == large(plain)))
}

/// Returns the only similar unit. Texts of one or two letters are not compared, because all units of that length are similar.
fn nearest(plain: &str, kind: Option<Kind>) -> Option<&'static str> {
    if plain.chars().count() < 3 {
        return None;
    }
    only(symbols(kind).filter(|symbol| suggest::nearest(plain, [*symbol]).is_some()))
}

fn only(mut symbols: impl Iterator<Item = &'static str>) -> Option<&'static str> {
    symbols.next().filter(|_| symbols.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_in_units_are_understood() {
        for (unit, kind, symbol) in [
            ("Mhz", Kind::Frequency, "MHz"),
            ("khz", Kind::Frequency, "kHz"),
            ("hertz", Kind::Frequency, "Hz"),
            ("microns", Kind::Length, "um"),
            ("Micrometers", Kind::Length, "um"),
            ("µmetre", Kind::Length, "um"),
            ("mmm", Kind::Length, "mm"),
            ("grams", Kind::Mass, "g"),
            ("kilogram", Kind::Mass, "kg"),
            ("msec", Kind::Time, "ms"),
            ("seconds", Kind::Time, "s"),
            ("mins", Kind::Time, "min"),
            ("gpa", Kind::Pressure, "GPa"),
            ("Ns/m", Kind::Damping, "N s/m"),
            ("N*s/M", Kind::Damping, "N s/m"),
            ("n/µm", Kind::Stiffness, "N/um"),
            ("m/s/s", Kind::Acceleration, "m/s^2"),
            ("m/s2", Kind::Acceleration, "m/s^2"),
            ("degrees", Kind::Angle, "deg"),
            ("N.m", Kind::Moment, "N m"),
        ] {
            let help = advice(unit, Some(kind));
            assert!(help.starts_with(&format!("did you mean \"{symbol}\"?")), "{unit}: {help}");
        }
    }

    #[test]
    fn other_units_are_not_guessed() {
        assert_eq!(advice("cm", Some(Kind::Length)), "units here: nm, um, mm, m");
        assert_eq!(advice("N/nm", Some(Kind::Stiffness)), "units here: N/m, N/mm, N/um, kN/m");
        assert_eq!(advice("MN", Some(Kind::Force)), "units here: uN, mN, N, kN");
        assert_eq!(advice("M", Some(Kind::Force)), "units here: uN, mN, N, kN");
        assert_eq!(
            advice("grams", Some(Kind::Length)),
            "grams is a unit of a mass; units here: nm, um, mm, m"
        );
        assert!(advice("parsec", None).starts_with("the unit is that of the following part"));
        assert_eq!(advice("Mhz", None), "did you mean \"MHz\"?");
    }
}
