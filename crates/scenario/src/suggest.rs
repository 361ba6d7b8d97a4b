//! "Did you mean": the nearest of the names that would have been right.

/// The nearest candidate, where one is near enough to be a slip of the pen.
pub(crate) fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = word.to_lowercase();
    candidates
        .into_iter()
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
    let all: Vec<&str> = candidates.into_iter().collect();
    match nearest(word, all.iter().copied()) {
        Some(near) => Some(format!("did you mean \"{near}\"?")),
        None if all.is_empty() => None,
        None => Some(format!("known here: {}", all.join(", "))),
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
    }
}
