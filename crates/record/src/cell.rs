//! Reads one field of a table: a number, a clock time or a missing value.

use std::borrow::Cow;

/// Words for a missing value, in lower case.
const MISSING: [&str; 14] = [
    "nan", "na", "n/a", "#n/a", "null", "none", "over", "overload", "overflow", "ovfl", "inf", "-inf",
    "error", "err",
];
pub(crate) const DAY: f64 = 86400.0;

/// Number format of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Digits {
    pub(crate) decimal: char,
    pub(crate) thousands: Option<char>,
}

/// Content of one field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Cell {
    Number(f64),
    /// Clock time: days of the date (0 without a date) and seconds of the day.
    Clock(f64, f64),
    Missing,
    Word,
}

/// Magnitude from which a number counts as missing. Instruments write 9.9e37 for infinity and 9.91e37 for NaN (SCPI 1999).
const OVERRANGE: f64 = 9.9e37;

impl Cell {
    pub(crate) fn read(field: &str, digits: Digits, missing: &[String]) -> Self {
        let field = trimmed(field);
        if missing.iter().any(|word| word == field) {
            return Self::Missing;
        }
        if let Some(value) = number(field, digits) {
            return if value.abs() < OVERRANGE { Self::Number(value) } else { Self::Missing };
        }
        let is_missing = field.chars().all(|c| matches!(c, '-' | '.' | '*' | '?' | '/'))
            || MISSING.contains(&field.to_lowercase().as_str());
        match clock(field) {
            _ if is_missing => Self::Missing,
            Some((days, seconds)) => Self::Clock(days, seconds),
            None => Self::Word,
        }
    }

    /// Returns whether the field is a number or a clock time.
    pub(crate) fn is_value(self) -> bool {
        matches!(self, Self::Number(_) | Self::Clock(..))
    }
}

/// Returns a field without surrounding blanks and quotes.
pub(crate) fn trimmed(field: &str) -> &str {
    field.trim().trim_matches('"').trim()
}

/// Reads a finite number. Exponents in Fortran notation (`D`) are accepted.
fn number(field: &str, Digits { decimal, thousands }: Digits) -> Option<f64> {
    let first = field.chars().next()?;
    if !(first.is_ascii_digit()
        || matches!(first, '+' | '-' | '\u{2212}')
        || first == decimal
        || first == '.')
    {
        return None;
    }
    let mut plain = Cow::Borrowed(field);
    if let Some(sign) = thousands.filter(|sign| field.contains(*sign)) {
        if !is_grouped(field, sign, decimal) {
            return None;
        }
        plain = Cow::Owned(plain.replace(sign, ""));
    }
    if decimal != '.' {
        if plain.contains('.') {
            return None;
        }
        plain = Cow::Owned(plain.replace(decimal, "."));
    }
    if plain.contains(['D', 'd', '\u{2212}']) {
        plain = Cow::Owned(plain.replace(['D', 'd'], "e").replace('\u{2212}', "-"));
    }
    let text = plain.strip_prefix('+').unwrap_or(&plain);
    text.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Returns whether the thousands separators divide the number into groups of three digits.
fn is_grouped(field: &str, sign: char, decimal: char) -> bool {
    let whole = field.split(decimal).next().unwrap_or_default().trim_start_matches(['+', '-']);
    let mut groups = whole.split(sign);
    let first = groups.next().unwrap_or_default();
    (1..=3).contains(&first.len())
        && groups.all(|group| group.len() == 3 && group.bytes().all(|b| b.is_ascii_digit()))
}

/// Reads a clock time such as `12:00:00.010`, `12:00`, `2020-01-01 12:00:00`, `01.02.2020 12:00:00,5` or `2020-01-01T12:00:00Z`.
///
/// Returns the days of the date and the seconds of the day.
fn clock(field: &str) -> Option<(f64, f64)> {
    let field = field.trim_end_matches('Z');
    let (date, time) = match field.rsplit_once([' ', 'T']) {
        Some((date, time)) => (Some(date.trim()), time),
        None => (None, field),
    };
    let parts: Vec<f64> =
        time.split(':').map(|part| part.replace(',', ".").parse().ok()).collect::<Option<_>>()?;
    let seconds = match parts[..] {
        [hours, minutes] => 3600.0 * hours + 60.0 * minutes,
        [hours, minutes, seconds] => 3600.0 * hours + 60.0 * minutes + seconds,
        _ => return None,
    };
    let is_time = parts.iter().all(|part| (0.0..3600.0).contains(part));
    let days = date.map_or(Some(0.0), days)?;
    is_time.then_some((days, seconds))
}

/// Returns the number of days of a date since a fixed day. The year is first or last.
///
/// With slashes, an ambiguous date has the month before the day.
fn days(date: &str) -> Option<f64> {
    let parts: Vec<i64> = date.split(['-', '.', '/']).map(|part| part.parse().ok()).collect::<Option<_>>()?;
    let [a, b, c] = parts[..] else { return None };
    let (year, month, day) = match () {
        () if a > 31 => (a, b, c),
        () if date.contains('/') && a <= 12 => (c, a, b),
        () => (c, b, a),
    };
    if !((1..=12).contains(&month) && (1..=31).contains(&day) && (0..10_000).contains(&year)) {
        return None;
    }
    // Calendar that begins in March (C. F. Gauss), so that leap days are at the end of the year.
    let (year, month) = if month > 2 { (year, month - 3) } else { (year - 1, month + 9) };
    Some((365 * year + year / 4 - year / 100 + year / 400 + (153 * month + 2) / 5 + day) as f64)
}

/// Adds a day to clock times after midnight, so that they ascend. Returns whether a day was added.
pub(crate) fn unwind(times: &mut [f64]) -> bool {
    let (mut days, mut last) = (0.0, f64::NEG_INFINITY);
    for time in times.iter_mut().filter(|time| !time.is_nan()) {
        // A decrease of more than half a day is a new day; a smaller one is a correction of the clock.
        if *time + days < last - 0.5 * DAY {
            days += DAY;
        }
        *time += days;
        last = *time;
    }
    days > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINT: Digits = Digits { decimal: '.', thousands: None };

    #[test]
    fn numbers_are_read_as_they_are_written() {
        let read = |field| Cell::read(field, POINT, &[]);
        assert_eq!(
            (read("1.2D-03"), read(" +5e3 "), read("\"0.5\"")),
            (Cell::Number(1.2e-3), Cell::Number(5e3), Cell::Number(0.5))
        );
        let comma = Digits { decimal: ',', thousands: Some('.') };
        assert_eq!(Cell::read("-1.234,5", comma, &[]), Cell::Number(-1234.5));
        assert_eq!(Cell::read("-9,9E+37", comma, &[]), Cell::Missing);
        assert_eq!(Cell::read("1.23,5", comma, &[]), Cell::Word);
        for missing in ["", "NaN", "OVER", "---", "n/a", "-99"] {
            assert_eq!(Cell::read(missing, POINT, &["-99".to_owned()]), Cell::Missing, "{missing}");
        }
        assert_eq!(
            (read("0x10"), read("infinity"), read("1e999"), read("day 1")),
            (Cell::Word, Cell::Word, Cell::Word, Cell::Word)
        );
    }

    #[test]
    fn clocks_go_over_midnight() {
        let read = |field| match Cell::read(field, POINT, &[]) {
            Cell::Clock(days, seconds) => DAY * days + seconds,
            other => panic!("{field}: {other:?}"),
        };
        assert_eq!(read("00:01:00.5"), 60.5);
        assert_eq!(read("2024-03-01 00:00") - read("2024-02-28 00:00:00"), 2.0 * DAY);
        assert_eq!(read("01.03.2023 00:00,5") - read("28/02/2023 00:00"), DAY + 30.0);
        let mut times = ["23:59:59.9", "00:00:00.1", "00:00:00.3"].map(read);
        assert!(unwind(&mut times) && (times[2] - times[0] - 0.4).abs() < 1e-9, "{times:?}");
    }
}
