//! Escapes characters that would control the terminal.

use std::borrow::Cow;
use std::fmt::Write;

/// Notation of an escaped character.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spelling {
    /// Rust notation: `\u{1b}`.
    Text,
    /// JSON notation: `\u009b`.
    Json,
}

/// Returns a text in which control characters, invisible characters and characters that change the writing direction are escaped.
///
/// Line ends are kept. Escaping is necessary because names and texts from files may contain such characters.
pub fn visible(text: &str, spelling: Spelling) -> Cow<'_, str> {
    if !text.contains(is_obeyed) {
        return Cow::Borrowed(text);
    }
    Cow::Owned(text.chars().fold(String::new(), |mut spelled, c| {
        match spelling {
            _ if !is_obeyed(c) => spelled.push(c),
            Spelling::Text => spelled.extend(c.escape_unicode()),
            Spelling::Json => c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| {
                // Writing to a string cannot fail.
                let _ = write!(spelled, "\\u{unit:04x}");
            }),
        }
        spelled
    }))
}

fn is_obeyed(c: char) -> bool {
    (c.is_control() && c != '\n')
        || matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_spelled_out() {
        let plain = "µ = 0.2 \u{2502} \u{fc}\nnext";
        assert_eq!(visible(plain, Spelling::Text), plain);
        let said = visible("a\u{1b}[2J\u{7f}\u{9b}\u{202e}b\r", Spelling::Text);
        assert_eq!(said, "a\\u{1b}[2J\\u{7f}\\u{9b}\\u{202e}b\\u{d}");
        let text = "\u{9b}\u{202e}\u{7f}";
        let json = serde_json::to_string(text).unwrap();
        let spelled = visible(&json, Spelling::Json);
        assert_eq!(spelled, r#""\u009b\u202e\u007f""#);
        assert_eq!(serde_json::from_str::<String>(&spelled).unwrap(), text);
    }
}
