//! "Did you mean" texts: the nearest of the allowed names.

use crate::document::shown;
use std::collections::HashSet;

/// Maximum number of listed names.
const LISTED: usize = 30;
/// Maximum length of compared words, characters. The cost grows with the product of the lengths.
const LONGEST: usize = 100;
/// Common names of keys, the names in the file, and an explanation if the meaning differs.
const SYNONYMS: &[(&str, &str, &str)] = &[
    ("mu", "friction", ""),
    ("µ", "friction", ""),
    ("coefficient_of_friction", "friction", ""),
    ("e", "youngs_modulus", ""),
    ("modulus", "youngs_modulus", ""),
    ("elastic_modulus", "youngs_modulus", ""),
    ("nu", "poisson_ratio", ""),
    ("v", "poisson_ratio", ""),
    ("m", "mass", ""),
    ("k", "stiffness", ""),
    ("c", "damping", ""),
    ("g", "acceleration", ""),
    ("angle", "incline", ""),
    ("normal_force", "normal", "such as \"normal\": {\"force\": \"0.3 N\"}"),
    ("preload", "normal", "such as \"normal\": {\"force\": \"2 N\"}, the force of one contact"),
    ("mu", "friction", ""),
    ("force", "x", "the force along the slide"),
    ("body", "on", ""),
    ("bodies", "between", ""),
    ("amplitude", "stroke", "it is the peak-to-peak value, twice the amplitude"),
    ("stroke", "amplitude", "it is half the peak-to-peak value, half the stroke"),
    ("diameter", "radius", "half the diameter"),
    ("interval", "every", ""),
    ("dt", "every", ""),
    ("step", "tolerance", "this stepper controls its time step"),
    ("tolerance", "step", "this stepper has a fixed time step"),
    ("time", "duration", ""),
    ("t_end", "duration", ""),
    ("version", "stickslip", ""),
    ("name", "title", ""),
    ("hertz", "paraboloid", "Hertz's contact is that of a paraboloid"),
    ("hertzian", "paraboloid", "Hertz's contact is that of a paraboloid"),
    ("ball", "sphere", ""),
    ("cylinder", "flat", "the flat face of a round punch"),
    ("punch", "flat", ""),
    ("sin", "sine", ""),
    ("cos", "sine", "with \"phase\": \"90 deg\""),
    ("cosine", "sine", "with \"phase\": \"90 deg\""),
    ("saw", "sawtooth", ""),
    ("ramp", "sawtooth", ""),
    ("square", "table", "two points at the same time are a jump"),
    ("points", "table", ""),
    ("file", "table", ""),
    ("rk45", "dopri5", ""),
    ("adaptive", "event", ""),
    ("driven", "follows", ""),
    ("prescribed", "follows", ""),
];

/// Returns the nearest candidate, if the difference is small enough for a typing error.
pub(crate) fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let short = |word: &str| word.chars().nth(LONGEST).is_none();
    if !short(word) {
        return None;
    }
    let lower = word.to_lowercase();
    candidates
        .into_iter()
        .filter(|candidate| short(candidate))
        .map(|candidate| (strsim::osa_distance(&lower, &candidate.to_lowercase()), candidate))
        .filter(|&(distance, candidate)| {
            let length = candidate.chars().count().max(word.chars().count());
            // At most a third of the letters may differ. Any two units of two letters differ by little.
            distance <= (length / 3).max(1) && distance < length
        })
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// Returns help for an unknown name: the nearest name, or a list of all names.
pub fn help<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let mut seen = HashSet::new();
    let all: Vec<&str> = candidates.into_iter().filter(|name| seen.insert(*name)).collect();
    match nearest(word, all.iter().copied()) {
        Some(near) => Some(format!("did you mean \"{}\"?", shown(near))),
        None if all.is_empty() => None,
        None => {
            let listed: Vec<String> = all.iter().take(LISTED).map(|name| shown(name)).collect();
            let more = match all.len() - listed.len() {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            Some(format!("known here: {}{more}", listed.join(", ")))
        }
    }
}

/// Returns the key that was probably intended: a synonym or the nearest key.
pub(crate) fn meant<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let lower = word.to_lowercase();
    let synonym = SYNONYMS.iter().find(|(other, name, _)| *other == lower && known.contains(name));
    let synonym = synonym.and_then(|(_, name, _)| known.iter().copied().find(|known| known == name));
    synonym.or_else(|| nearest(word, known.iter().copied()))
}

/// Returns help for a key with another name in the file, or for a misspelt key.
pub(crate) fn slip(word: &str, known: &[&str]) -> Option<String> {
    let lower = word.to_lowercase();
    let synonym = SYNONYMS.iter().find(|(other, name, _)| *other == lower && known.contains(name));
    match synonym {
        Some((_, name, "")) => Some(format!("did you mean \"{name}\"?")),
        Some((_, name, why)) => Some(format!("did you mean \"{name}\"? ({why})")),
        None => nearest(word, known.iter().copied()).map(|near| format!("did you mean \"{}\"?", shown(near))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_found_and_strangers_are_not() {
        let names = ["friction", "profile", "normal"];
        assert_eq!(nearest("fricton", names), Some("friction"));
        assert_eq!(nearest("Profile", names), Some("profile"));
        assert_eq!(nearest("gravity", names), None);
        assert_eq!(help("zz", ["loop"]).unwrap(), "known here: loop");
        assert_eq!(slip("mu", &names).unwrap(), "did you mean \"friction\"?");
        assert_eq!(slip("fricton", &names).unwrap(), "did you mean \"friction\"?");
        assert_eq!(slip("mu", &["mass"]), None);
    }

    #[test]
    fn a_help_has_an_end_and_stays_on_its_line() {
        let names: Vec<String> = (0..10_000).map(|i| format!("body {i}")).collect();
        let all = help("slider", names.iter().map(String::as_str)).unwrap();
        assert!(
            all.starts_with("known here: body 0, body 1, ") && all.ends_with(", body 29 and 9970 more"),
            "{all}"
        );
        assert_eq!(help("zz", ["a\u{1b}[2Jb"]).unwrap(), "known here: a\u{fffd}[2Jb");
        assert_eq!(help("a\u{1b}b", ["a\u{1b}c"]).unwrap(), "did you mean \"a\u{fffd}c\"?");
    }

    /// The comparison of two names of a million letters would take hours.
    #[test]
    fn endless_words_are_no_slips() {
        let [long, longer] = [1_000_000, 1_000_001].map(|count| "a".repeat(count));
        assert_eq!(nearest(&long, [longer.as_str(), "loop"]), None);
        assert_eq!(nearest("lop", [longer.as_str(), "loop"]), Some("loop"));
    }
}
