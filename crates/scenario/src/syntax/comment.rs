//! Comments `// …` and `/* … */`, as editors of JSON allow them. Comments are replaced by blanks, so that positions do not change and the
//! remaining text is strict JSON. A comma before a closing bracket stays an error, because other JSON readers refuse it.

use std::borrow::Cow;
use std::ops::Range;

/// Replaces comments by blanks. The error is the range of an unterminated comment.
pub(super) fn blanked(text: &str) -> Result<Cow<'_, str>, Range<usize>> {
    if !text.contains("//") && !text.contains("/*") {
        return Ok(Cow::Borrowed(text));
    }
    let bytes = text.as_bytes();
    let mut plain = bytes.to_vec();
    let (mut at, mut in_string) = (0, false);
    while at < bytes.len() {
        let end = match (&bytes[at..], in_string) {
            ([b'\\', _, ..], true) => {
                at += 2;
                continue;
            }
            // A string ends at its line end, so that a missing quote is reported instead of the rest of the file.
            ([b'"', ..], _) => {
                in_string = !in_string;
                None
            }
            ([b'\n', ..], _) => {
                in_string = false;
                None
            }
            ([b'/', b'/', ..], false) => Some(text[at..].find('\n').map_or(text.len(), |length| at + length)),
            ([b'/', b'*', ..], false) => {
                Some(text[at + 2..].find("*/").map(|length| at + length + 4).ok_or(at..at + 2)?)
            }
            _ => None,
        };
        let Some(end) = end else {
            at += 1;
            continue;
        };
        for byte in &mut plain[at..end] {
            if !matches!(byte, b'\n' | b'\r') {
                *byte = b' ';
            }
        }
        at = end;
    }
    // Only whole characters became blanks.
    Ok(String::from_utf8(plain).map_or(Cow::Borrowed(text), Cow::Owned))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_become_blanks_and_strings_stay() {
        for (text, plain) in [
            ("{} // ü end", "{}          "),
            ("// a\r\n{/* b\n c */}", "    \r\n{    \n     }"),
            (r#"{"a": "http://x/*y*/ \" // z"}"#, r#"{"a": "http://x/*y*/ \" // z"}"#),
            ("\"open // is no string\n// here", "\"open // is no string\n       "),
            ("1 /**/ 2 /* // */ 3", "1      2          3"),
        ] {
            assert_eq!(blanked(text).unwrap(), plain);
        }
        assert_eq!(blanked("1 /* 2 *").unwrap_err(), 2..4);
        assert_eq!(blanked("1 /*/").unwrap_err(), 2..4);
    }
}
