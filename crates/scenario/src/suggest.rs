//! "Did you mean": the nearest of the names that would have been right.

use crate::document::shown;
use std::collections::HashSet;

/// Most names that are listed.
const LISTED: usize = 30;
/// Longest words that are compared, characters: the work grows with the product of their lengths.
const LONGEST: usize = 100;
/// What people call a key, what it is called here, and why where that is no mere matter of names.
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
    ("step", "tolerance", "this stepper finds its steps itself"),
    ("tolerance", "step", "this stepper keeps its step"),
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
    ("square", "table", "two points at one time are a jump"),
    ("points", "table", ""),
    ("file", "table", ""),
    ("rk45", "dopri5", ""),
    ("adaptive", "event", ""),
    ("driven", "follows", ""),
    ("prescribed", "follows", ""),
];

/// The nearest candidate, where one is near enough to be a slip of the pen.
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
            // A third of the letters; two-letter units are one slip away from each other.
            distance <= (length / 3).max(1) && distance < length
        })
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// Help for a name that is not known: the nearest one, or all of them.
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

/// The key that was meant by another name, or by nearly its own.
pub(crate) fn meant<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let lower = word.to_lowercase();
    let synonym = SYNONYMS.iter().find(|(other, name, _)| *other == lower && known.contains(name));
    let synonym = synonym.and_then(|(_, name, _)| known.iter().copied().find(|known| known == name));
    synonym.or_else(|| nearest(word, known.iter().copied()))
}

/// Help for a key that goes by another name here, or by nearly the same.
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

    /// Two names of a million letters would be compared for hours.
    #[test]
    fn endless_words_are_no_slips() {
        let [long, longer] = [1_000_000, 1_000_001].map(|count| "a".repeat(count));
        assert_eq!(nearest(&long, [longer.as_str(), "loop"]), None);
        assert_eq!(nearest("lop", [longer.as_str(), "loop"]), Some("loop"));
    }
}
