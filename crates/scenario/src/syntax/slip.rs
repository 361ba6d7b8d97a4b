//! Messages for common errors in JSON, derived from the text around the position of the error.

use super::bracket;
use crate::document::shown;
use crate::excerpt::is_invisible;
use jsonc_parser::errors::{ParseError, ParseErrorKind};
use std::ops::Range;

/// Syntax error with its range, message and help.
#[derive(Debug, PartialEq)]
pub(super) struct Slip {
    pub(super) range: Range<usize>,
    pub(super) message: String,
    pub(super) help: Option<String>,
}

fn slip(range: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Slip {
    Slip { range, message: message.into(), help: Some(help.into()) }
}

/// Returns the message for an error of the parser.
pub(super) fn of(text: &str, error: &ParseError) -> Slip {
    let at = error.range().start.min(text.len());
    at_character(text, at)
        .or_else(|| at_number(text, at))
        .or_else(|| at_bracket(text, at, error.kind()))
        .or_else(|| at_word(text, at))
        .unwrap_or_else(|| wording(text, error.range().start..error.range().end, error.kind()))
}

/// Returns the error of a character that is not allowed outside strings.
pub(super) fn at_character(text: &str, at: usize) -> Option<Slip> {
    let c = text.get(at..)?.chars().next()?;
    let range = at..at + c.len_utf8();
    let line_end = text[at..].find('\n').map_or(text.len(), |i| at + i);
    Some(match c {
        '#' => slip(at..line_end, "a comment begins with //", "or is between /* and */"),
        '/' if text[at..].starts_with("/*") || text[at..].starts_with("//") => return None,
        ';' => slip(range, "expected a comma, got a semicolon", "entries are separated by commas"),
        '=' => slip(range, "expected a colon, got an equals sign", "write \"key\": value"),
        '“' | '”' | '„' | '«' | '»' | '‘' | '’' | '`' | '´' | '＂' => {
            slip(range, "strings are in plain double quotes", format!("write \"text\" without {c}"))
        }
        '(' | ')' => slip(range, "round brackets have no meaning here", "lists are in [ ], objects in { }"),
        '\u{2212}' | '\u{2013}' => slip(range, "this is not a minus sign", "write -"),
        c if is_invisible(c) || (c.is_whitespace() && !c.is_ascii()) || is_stray(c) => slip(
            range,
            format!("an invisible character, U+{:04X}", c as u32),
            "delete it; only spaces, tabs and line ends are possible between values",
        ),
        c if !c.is_ascii() && !c.is_alphabetic() => {
            slip(range, format!("the character {c} is outside of quotes"), "texts are in double quotes")
        }
        _ => return None,
    })
}

/// Returns whether a character is a control character other than the blanks of JSON.
fn is_stray(c: char) -> bool {
    c.is_control() && !matches!(c, '\t' | '\n' | '\r')
}

/// Returns the error of a number with a unit, or of a number that JSON does not allow.
fn at_number(text: &str, at: usize) -> Option<Slip> {
    let bytes = text.as_bytes();
    let numeric = |b: &u8| b.is_ascii_digit() || matches!(b, b'.' | b'+' | b'-' | b'e' | b'E');
    // Skips blanks and the number backwards.
    let gap = text[..at].trim_end_matches([' ', '\t']).len();
    let start = gap - bytes[..gap].iter().rev().take_while(|b| numeric(b)).count();
    let before = &text[start..gap];
    let here = text[at..].chars().next()?;
    let has_digit = |text: &str| text.bytes().any(|b| b.is_ascii_digit());
    let line_end = text[at..].find(['\n', ',', '}', ']', '"']).map_or(text.len(), |i| at + i);
    let whole = &text[start..line_end].trim_end();
    let range = start..start + whole.len();
    if has_digit(before) && (here.is_alphabetic() || matches!(here, '°' | '%' | 'µ')) {
        let help = format!("write \"{}\"", shown(whole));
        return Some(slip(range, "a quantity with a unit is in double quotes", help));
    }
    if has_digit(before) && matches!(here, '/' | '*' | '^') {
        return Some(slip(range, "a calculation is not a number", "write its result as a decimal number"));
    }
    if before == "0" && here.is_ascii_digit() {
        let plain = whole.trim_start_matches('0');
        let zero = if plain.starts_with(|c: char| c.is_ascii_digit()) { "" } else { "0" };
        return Some(slip(range, "a number with a leading zero", format!("write {zero}{plain}")));
    }
    if here.is_ascii_digit() && before.is_empty() && text[..gap].ends_with(',') {
        let integer = bytes[..gap - 1].iter().rev().take_while(|b| b.is_ascii_digit()).count();
        let digits = bytes[at..].iter().take_while(|b| b.is_ascii_digit()).count();
        if integer > 0 && gap == at {
            let (first, second) = (&text[gap - 1 - integer..gap - 1], &text[at..at + digits]);
            let help = format!("the decimal sign is a point: {first}.{second}");
            return Some(slip(gap - 1 - integer..at + digits, "a number with a comma in it", help));
        }
    }
    let range = at..at + text[at..].bytes().take_while(numeric).count().max(1);
    match here {
        '.' => {
            let help = format!("write 0{}", shown(&text[range.clone()]));
            Some(slip(range, "a number that starts with a point", help))
        }
        '+' => Some(slip(range, "a number with a plus sign", "write the number without it")),
        _ => None,
    }
}

/// Returns the error of an unexpected bracket, comma or colon, or of a missing closing bracket.
fn at_bracket(text: &str, at: usize, kind: &ParseErrorKind) -> Option<Slip> {
    if matches!(kind, ParseErrorKind::UnterminatedObject | ParseErrorKind::UnterminatedArray) {
        let range = bracket::unclosed(text);
        let (what, closing) =
            if text[range.clone()].starts_with('[') { ("list", ']') } else { ("object", '}') };
        return Some(slip(range, format!("this {what} is never closed"), format!("a {closing} is missing")));
    }
    if matches!(kind, ParseErrorKind::TrailingCommasNotAllowed) {
        return None;
    }
    let here = text[at..].chars().next()?;
    if matches!(kind, ParseErrorKind::MultipleRootJsonValues) {
        let message = "there is text after the end of the scenario";
        let help = match here {
            ',' | '}' | ']' => "there is one closing bracket too many before this",
            _ => "a file has one object",
        };
        return Some(slip(at..at + here.len_utf8(), message, help));
    }
    let before = text[..at].trim_end();
    let list = bracket::closes_list(text, at)?;
    match here {
        '}' | ']' if (here == ']') != list => {
            let (what, closing) = if list { ("list", ']') } else { ("object", '}') };
            let message = format!("expected {closing} to close this {what}, got {here}");
            Some(slip(at..at + 1, message, "brackets close in the reverse order of their opening"))
        }
        '}' | ']' | ',' if before.ends_with(':') => {
            Some(slip(at..at + 1, "a value is missing here", "write \"key\": value"))
        }
        ':' if list => {
            let help = "a ] is missing before this, or the list is an object { }";
            Some(slip(at..at + 1, "a colon inside a list", help))
        }
        ',' if !matches!(kind, ParseErrorKind::ExpectedColonAfterObjectKey) => {
            let help = "entries are separated by one comma";
            Some(slip(at..at + 1, "a value is missing before this comma", help))
        }
        _ => None,
    }
}

/// Returns the error of a word without quotes.
fn at_word(text: &str, at: usize) -> Option<Slip> {
    let rest = &text[at..];
    let length =
        rest.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '-' | '+'))).unwrap_or(rest.len());
    let word = &rest[..length];
    let bare = word.trim_start_matches(['-', '+']);
    if !bare.starts_with(char::is_alphabetic) {
        return None;
    }
    let range = at..at + length;
    let before = text[..at].trim_end();
    if before.is_empty() {
        let message = "a scenario is a JSON object { … }";
        return Some(slip(range, message, "it starts with { \"stickslip\": 1, the version of the format"));
    }
    let after = text[at + length..].trim_start();
    if before.ends_with(['{', ',']) && after.starts_with(':') {
        return Some(slip(range, "keys are in double quotes", format!("write \"{}\":", shown(word))));
    }
    let lower = bare.to_lowercase();
    Some(match lower.as_str() {
        "nan" | "inf" | "infinity" => {
            slip(range, "NaN and infinities are not numbers of a scenario", "write a finite number")
        }
        "true" | "false" => slip(range, "expected true or false in small letters", format!("write {lower}")),
        "none" | "null" | "nil" | "undefined" => {
            slip(range, "this is not a value of a scenario", "leave the key out for its default")
        }
        _ => slip(range, "a word without quotes", format!("write \"{}\"", shown(word))),
    })
}

/// Returns the error of a string without an end on its line: the range where a quote is probably missing.
pub(super) fn quote_missing(text: &str, line_end: usize) -> Slip {
    let line_start = text[..line_end].rfind('\n').map_or(0, |i| i + 1);
    let line = text[line_start..line_end].trim_end();
    let quotes = quotes(line);
    let slipped = |range: Range<usize>| {
        let range = line_start + range.start..line_start + range.end;
        slip(range, "a double quote is missing", "strings and quantities with a unit are in double quotes")
    };
    for pair in quotes.chunks(2) {
        let before = line[..pair[0]].trim_end();
        if !before.is_empty() && !before.ends_with(['{', '[', ',', ':']) {
            // A word before the quote probably belongs inside.
            let word = before.rfind(['{', '[', ',', ':']).map_or(0, |i| i + 1);
            let word = word + line[word..].len() - line[word..].trim_start().len();
            return slipped(word..pair[0] + 1);
        }
        let Some(close) = pair.get(1) else { break };
        let after = line[close + 1..].trim_start();
        if !after.is_empty() && !after.starts_with(['}', ']', ',', ':']) {
            return slipped(pair[0]..close + 1);
        }
    }
    slipped(quotes.last().map_or(0, |quote| *quote)..line.len())
}

/// Returns the positions of quotes in a line that are not escaped.
fn quotes(line: &str) -> Vec<usize> {
    let (mut places, mut escaped) = (Vec::new(), false);
    for (i, byte) in line.bytes().enumerate() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if places.len() % 2 == 1 => escaped = true,
            b'"' => places.push(i),
            _ => {}
        }
    }
    places
}

/// Returns message and help for the remaining errors of the parser.
fn wording(text: &str, range: Range<usize>, kind: &ParseErrorKind) -> Slip {
    let (message, help) = match kind {
        ParseErrorKind::TrailingCommasNotAllowed => {
            ("a comma before a closing bracket", "remove the comma, or add the missing entry")
        }
        ParseErrorKind::ExpectedComma => ("expected a comma", "entries are separated by commas"),
        ParseErrorKind::ExpectedColonAfterObjectKey => {
            ("expected a colon after the key", "write \"key\": value")
        }
        ParseErrorKind::ExpectedStringObjectProperty => ("keys are in double quotes", "write \"key\": value"),
        ParseErrorKind::SingleQuotedStringsNotAllowed => {
            ("strings are in double quotes", "write \"text\" instead of 'text'")
        }
        ParseErrorKind::BareDecimalPointNumbersNotAllowed => {
            ("a number that ends with a point", "write a digit after the point")
        }
        ParseErrorKind::HexadecimalNumbersNotAllowed => ("a hexadecimal number", "write it in decimals"),
        ParseErrorKind::String(_) if text[range.start..].starts_with("\\u") => {
            ("this is not the code of a character", "write the character itself")
        }
        ParseErrorKind::String(_) if text[range.start..].starts_with('\\') => {
            ("a backslash without a meaning", "write \\\\ for a backslash")
        }
        ParseErrorKind::UnexpectedTokenInObject => {
            ("expected a key", "write \"key\": value; entries without keys are in [ ]")
        }
        _ => ("this is not a JSON value", "numbers are finite decimals; strings are in double quotes"),
    };
    slip(range, message, help)
}
