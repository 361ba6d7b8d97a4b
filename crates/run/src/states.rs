//! Contact states in tables, as words or digits.

use stickslip_drive::state_name;

/// Codes of the states in a row, and their digits.
const STATES: [(f64, &str); 4] = [(0.0, "0"), (1.0, "1"), (2.0, "2"), (3.0, "3")];

/// Returns the code of a contact state for its word or digit. Returns `None` for other texts.
pub(crate) fn state_code(text: &str) -> Option<f64> {
    let found = STATES.iter().find(|(code, digit)| text == *digit || text == state_name(*code));
    found.map(|(code, _)| *code)
}

/// Returns the digit for the code of a contact state.
pub(crate) fn state_digit(code: f64) -> &'static str {
    STATES.iter().find(|(known, _)| *known == code).map_or("3", |(_, digit)| digit)
}

/// Returns the digits of all contact states with their words.
pub(crate) fn legend() -> Vec<(String, &'static str)> {
    STATES.iter().map(|(code, digit)| ((*digit).to_owned(), state_name(*code))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_digits_have_one_code() {
        for (word, digit) in [("open", "0"), ("stick", "1"), ("partial", "2"), ("slip", "3")] {
            let code = state_code(word).unwrap();
            assert_eq!((Some(code), state_digit(code), state_name(code)), (state_code(digit), digit, word));
        }
        assert_eq!(["", "4", "00", "Slip", "1.0"].map(state_code), [None; 5]);
    }
}
