//! Finds unmatched brackets by the indentation of lines.

use std::ops::Range;

/// Opening bracket.
struct Open {
    place: usize,
    /// Number of blanks at the start of its line.
    indent: usize,
}

/// Returns the bracket that is probably not closed, found by indentation; otherwise the last open one.
pub(super) fn unclosed(text: &str) -> Range<usize> {
    let mut open: Vec<Open> = Vec::new();
    let mut suspect = None;
    let (mut string, mut escaped, mut indent, mut first) = (false, false, 0, true);
    for (place, byte) in text.bytes().enumerate() {
        match byte {
            b'\n' => (indent, first, string, escaped) = (0, true, false, false),
            _ if string => match (escaped, byte) {
                (true, _) => escaped = false,
                (false, b'\\') => escaped = true,
                (false, b'"') => string = false,
                _ => {}
            },
            b' ' | b'\t' if first => indent += 1,
            b'\r' => {}
            b'"' => (string, first) = (true, false),
            b'{' | b'[' => {
                open.push(Open { place, indent });
                first = false;
            }
            b'}' | b']' => {
                // A bracket that closes a block has the indentation of the line that opens the block.
                if let Some(closed) = open.pop()
                    && first
                    && closed.indent > indent
                    && suspect.is_none()
                {
                    suspect = Some(closed.place);
                }
                first = false;
            }
            _ => first = false,
        }
    }
    let place = suspect.or(open.last().map(|open| open.place)).unwrap_or(0);
    place..place + 1
}

/// Returns whether a closing bracket at this position closes a list (true) or an object (false); `None` at top level.
pub(super) fn closes_list(text: &str, place: usize) -> Option<bool> {
    let mut open = Vec::new();
    let (mut string, mut escaped) = (false, false);
    for byte in text.bytes().take(place) {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if string => escaped = true,
            b'"' => string = !string,
            b'{' | b'[' if !string => open.push(byte),
            b'}' | b']' if !string => {
                open.pop();
            }
            _ => {}
        }
    }
    open.last().map(|bracket| *bracket == b'[')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unclosed_bracket_is_found_by_indentation() {
        let place = |text: &str| unclosed(text).start;
        let text = "{\n  \"a\": {\n    \"b\": {\n      \"c\": 1\n  },\n  \"d\": \"}{\"\n}\n";
        assert_eq!(place(text), text.find("{\n      \"c\"").unwrap());
        let text = "{\n  \"a\": [\n    1,\n  \"d\": {\n    \"e\": 1\n  }\n}\n";
        assert_eq!(place(text), text.find('[').unwrap());
        assert_eq!(place("{ \"a\": [1, 2 }"), 0);
        assert_eq!(place("{\n  \"a\": 1\n"), 0);
        assert_eq!(place("{\n  \"a\": {\n"), 9);
    }

    #[test]
    fn what_a_bracket_closes_is_known() {
        let text = "{ \"[\": [1, {}, 2}";
        assert_eq!(closes_list(text, text.len() - 1), Some(true));
        assert_eq!(closes_list("{]", 1), Some(false));
        assert_eq!(closes_list("{}}", 2), None);
    }
}
