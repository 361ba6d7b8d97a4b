//! Line of a report, with a marker below it.

use std::ops::Range;
use unicode_width::UnicodeWidthChar;

/// Line of the file with the marked range.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// Line number, from 1.
    pub line: usize,
    /// Column of the marker, from 1, counted in Unicode scalar values. A tab counts as one column.
    pub column: usize,
    /// Whole line without its line end.
    pub text: String,
    /// Marked characters of [`Self::text`], from 0; never empty.
    pub marker: Range<usize>,
}

/// Maximum number of terminal cells shown of a line.
const WIDTH: usize = 100;
/// Number of terminal cells shown before the marker if the line is cut.
const BEFORE: usize = 40;

impl Excerpt {
    /// Returns the line around a byte range of a text.
    pub(crate) fn of(text: &str, range: Range<usize>) -> Self {
        let start = floor_boundary(text, range.start);
        let end = floor_boundary(text, range.end).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |i| i + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |i| start + i);
        let line = text[line_start..line_end].trim_end_matches('\r');
        let column = text[line_start..start].chars().count();
        // The marker ends at the end of its line. A position beyond the end gives one caret.
        let most = line_start + line.len().max(start - line_start);
        let width = text[start..end.clamp(start, most)].chars().count();
        Self {
            line: text[..start].matches('\n').count() + 1,
            column: column + 1,
            text: line.to_owned(),
            marker: column..column + width.max(1),
        }
    }

    /// Returns the shown part of the line and the marked range in terminal cells.
    pub(crate) fn window(&self) -> (String, Range<usize>) {
        let cells: Vec<(char, usize)> = self.text.chars().map(cell).collect();
        let width = |cells: &[(char, usize)]| cells.iter().map(|(_, width)| width).sum::<usize>();
        let marked = self.marker.start.min(cells.len());
        let mut start = 0;
        if width(&cells) > WIDTH {
            start = marked - fitting(cells[..marked].iter().rev(), BEFORE);
            // Near the end of the line there is room for more text before the marker.
            start = start.min(cells.len() - fitting(cells.iter().rev(), WIDTH));
        }
        let end = start + fitting(cells[start..].iter(), WIDTH);
        let mut shown: String = cells[start..end].iter().map(|(c, _)| c).collect();
        let mut shift = 0;
        if start > 0 {
            shown.insert(0, '…');
            shift = 1;
        }
        if end < cells.len() {
            shown.push('…');
        }
        let left = shift + width(&cells[start..marked]);
        let right = self.marker.end.clamp(marked, end.max(marked));
        let length = width(&cells[marked..right]).max(1);
        (shown, left..left + length)
    }
}

fn floor_boundary(text: &str, index: usize) -> usize {
    let mut index = index.min(text.len());
    while !text.is_char_boundary(index) {
        index -= 1;
    }
    index
}

/// Returns the number of characters that fit into the given number of terminal cells.
fn fitting<'a>(cells: impl Iterator<Item = &'a (char, usize)>, room: usize) -> usize {
    let mut taken = 0;
    cells
        .take_while(|(_, width)| {
            taken += width;
            taken <= room
        })
        .count()
}

/// Returns a character as shown, and its width: two cells for wide characters, none for combining ones.
fn cell(c: char) -> (char, usize) {
    let shown = visible(c);
    (shown, shown.width().unwrap_or(1))
}

/// Replaces characters that would shift the marker, hide text or change the text direction.
pub(crate) fn visible(c: char) -> char {
    match c {
        '\t' | '\r' => ' ',
        c if c.is_control() || is_invisible(c) => '\u{fffd}',
        c => c,
    }
}

/// Returns whether a character is an invisible format character, such as a joiner, direction mark or byte order mark.
pub(crate) fn is_invisible(c: char) -> bool {
    matches!(c,
        '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the cells above the marker of a line, as a terminal shows them.
    fn marked(text: &str, range: Range<usize>) -> String {
        let (shown, marker) = Excerpt::of(text, range).window();
        let mut at = 0;
        let mut under = String::new();
        for c in shown.chars() {
            if marker.contains(&at) && c.width() != Some(0) {
                under.push(c);
            }
            at += c.width().unwrap();
        }
        under
    }

    #[test]
    fn the_marker_stands_under_its_word_whatever_stands_before_it() {
        let fillers =
            ["", "\t\t", "日本語", "😀", "e\u{301}e\u{301}", "\u{202e}\u{200b}", "µm²Ω", "ｆｕｌｌ"];
        for before in fillers {
            for length in [0, 30, 200, 4000] {
                for after in ["", " and on", &"和".repeat(300)] {
                    let start = format!("first\n{}{before} ", "x語".repeat(length));
                    let text = format!("{start}word{after}\nlast");
                    assert_eq!(marked(&text, start.len()..start.len() + 4), "word", "{text}");
                }
            }
        }
    }

    #[test]
    fn columns_count_characters() {
        let text = "a\n\t\t日😀e\u{301}!";
        let excerpt = Excerpt::of(text, text.len() - 1..text.len());
        assert_eq!((excerpt.line, excerpt.column), (2, 7));
    }

    #[test]
    fn a_line_is_cut_around_its_marker() {
        let text = format!("{}word{}", "a".repeat(500), "b".repeat(500));
        let (shown, marker) = Excerpt::of(&text, 500..504).window();
        assert_eq!(shown.chars().count(), 102);
        assert_eq!(marker, 41..45);
        let (shown, marker) = Excerpt::of(&text, 100..900).window();
        assert_eq!((shown.chars().count(), marker), (102, 41..101));
        let (shown, marker) = Excerpt::of("short", 9..12).window();
        assert_eq!((shown.as_str(), marker), ("short", 5..6));
    }

    #[test]
    fn what_turns_or_hides_text_is_shown_as_such() {
        assert_eq!(
            Excerpt::of("a\u{202e}b\tc\u{feff}\u{7}", 0..1).window().0,
            "a\u{fffd}b c\u{fffd}\u{fffd}"
        );
    }
}
