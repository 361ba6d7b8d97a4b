//! Texts, plain or with subscripts.

use crate::PlotError;
use crate::font;

/// Line of text. Line breaks and control characters count as blanks.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Label {
    runs: Vec<Run>,
}

/// Part of a text with one font size.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) text: String,
    pub(crate) subscript: bool,
}

/// Size of a subscript relative to its line.
pub(crate) const SUBSCRIPT: f64 = 0.72;
/// Distance of a subscript's baseline below the baseline of its line, em of the line.
pub(crate) const SUBSCRIPT_DROP: f64 = 0.20;
/// Minimum shrink factor of a long axis label; axis labels then keep 8 pt in print.
const LEAST_SHRINK: f64 = 0.9;
const ELLIPSIS: &str = "…";
/// Characters after which a word that is too long may be broken, as in key paths and file names.
const JOINTS: [char; 4] = ['.', '_', '-', '/'];

impl Label {
    /// Creates a label from plain text, without markup; for names given by users.
    pub fn plain(text: &str) -> Self {
        let text = clean(text);
        let text = text.trim();
        if text.is_empty() {
            return Self::default();
        }
        Self { runs: vec![Run { text: text.to_owned(), subscript: false }] }
    }

    /// Creates a label from markup: `_x` is a subscript of one character, `_{text}` one of several, `\_` an underscore.
    pub fn markup(text: &str) -> Self {
        let mut label = Self::default();
        let text = clean(text);
        let mut rest = text.chars().peekable();
        while let Some(c) = rest.next() {
            match (c, rest.peek()) {
                ('\\', Some('_')) => label.push('_', rest.next().is_none()),
                ('_', Some('{')) => {
                    rest.next();
                    rest.by_ref().take_while(|&c| c != '}').for_each(|c| label.push(c, true));
                }
                ('_', Some(_)) => rest.next().into_iter().for_each(|c| label.push(c, true)),
                _ => label.push(c, false),
            }
        }
        label
    }

    /// Returns whether the label has no text.
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Returns the text without formatting.
    pub fn text(&self) -> String {
        self.runs.iter().map(|run| run.text.as_str()).collect()
    }

    /// Appends plain text.
    pub fn followed_by(mut self, text: &str) -> Self {
        clean(text).chars().for_each(|c| self.push(c, false));
        self
    }

    /// Appends another label.
    pub(crate) fn joined(mut self, other: &Self) -> Self {
        for run in &other.runs {
            run.text.chars().for_each(|c| self.push(c, run.subscript));
        }
        self
    }

    pub(crate) fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// Returns the width in px at a font size in px per em.
    pub(crate) fn width(&self, em: f64) -> Result<f64, PlotError> {
        self.runs.iter().map(|run| Ok(font::advance(&run.text)? * run.scale() * em)).sum()
    }

    /// Returns the label with its unit and the font size at which both are at most `most` wide. The size shrinks
    /// slightly first. Then the label is cut with an ellipsis; the unit stays.
    pub(crate) fn fitted(&self, unit: &Self, em: f64, most: f64) -> Result<(Self, f64), PlotError> {
        let whole = self.clone().joined(unit);
        let width = whole.width(em)?;
        if width <= most {
            return Ok((whole, em));
        }
        let small = em * (most / width).max(LEAST_SHRINK);
        let room = most - unit.width(small)?;
        if room < small {
            // Not even an ellipsis fits next to the unit.
            return Ok((whole.cut(small, most)?, small));
        }
        Ok((self.cut(small, room)?.joined(unit), small))
    }

    /// Returns the label, cut with an ellipsis if it is wider than `most`.
    pub(crate) fn cut(&self, em: f64, most: f64) -> Result<Self, PlotError> {
        // Tolerance for sizes that were chosen to fit exactly.
        if self.width(em)? <= most * (1.0 + 1e-9) {
            return Ok(self.clone());
        }
        let ellipsis = Self::default().followed_by(ELLIPSIS);
        let mut room = most - ellipsis.width(em)?;
        if room < 0.0 {
            return Ok(Self::default());
        }
        let mut kept = Self::default();
        for (c, subscript) in self.characters() {
            let mut one = Self::default();
            one.push(c, subscript);
            room -= one.width(em)?;
            if room < 0.0 {
                break;
            }
            kept.push(c, subscript);
        }
        if let Some(last) = kept.runs.last_mut() {
            last.text.truncate(last.text.trim_end().len());
        }
        kept.runs.retain(|run| !run.text.is_empty());
        Ok(kept.followed_by(ELLIPSIS))
    }

    /// Breaks the label into at most `lines` lines no wider than `most`, between words, and inside words that are wider. The last line is
    /// cut if necessary.
    pub(crate) fn wrapped(&self, em: f64, most: f64, lines: usize) -> Result<Vec<Self>, PlotError> {
        let mut done: Vec<Self> = Vec::new();
        let mut line = Self::default();
        for (word, gap) in self.pieces(em, most)? {
            let longer =
                if line.is_empty() { word.clone() } else { line.clone().followed_by(gap).joined(&word) };
            if line.is_empty() || longer.width(em)? <= most || done.len() + 1 >= lines {
                line = longer;
            } else {
                done.push(std::mem::replace(&mut line, word));
            }
        }
        if !line.is_empty() {
            done.push(line);
        }
        done.iter().map(|line| line.cut(em, most)).collect()
    }

    /// Returns the words with the separator before each. Words wider than `most` are broken, if possible after the last fitting character
    /// of [`JOINTS`].
    fn pieces(&self, em: f64, most: f64) -> Result<Vec<(Self, &'static str)>, PlotError> {
        let mut pieces = Vec::new();
        for word in self.words() {
            let mut gap = " ";
            let mut piece = Self::default();
            for (c, subscript) in word.characters() {
                let mut longer = piece.clone();
                longer.push(c, subscript);
                if !piece.is_empty() && longer.width(em)? > most {
                    let (head, mut tail) = piece.parted();
                    pieces.push((head, std::mem::take(&mut gap)));
                    tail.push(c, subscript);
                    piece = tail;
                } else {
                    piece = longer;
                }
            }
            pieces.push((piece, gap));
        }
        Ok(pieces)
    }

    /// Splits a word after its last character of [`JOINTS`]. Without such a character, the first part is the whole word.
    fn parted(&self) -> (Self, Self) {
        let characters: Vec<(char, bool)> = self.characters().collect();
        let joint = characters.iter().rposition(|(c, subscript)| JOINTS.contains(c) && !subscript);
        let (head, tail) = characters.split_at(joint.map_or(characters.len(), |joint| joint + 1));
        let whole = |characters: &[(char, bool)]| {
            let mut label = Self::default();
            characters.iter().for_each(|(c, subscript)| label.push(*c, *subscript));
            label
        };
        (whole(head), whole(tail))
    }

    fn words(&self) -> Vec<Self> {
        let mut words = vec![Self::default()];
        for (c, subscript) in self.characters() {
            match words.last_mut() {
                Some(word) if c != ' ' || subscript => word.push(c, subscript),
                _ => words.push(Self::default()),
            }
        }
        words.retain(|word| !word.is_empty());
        words
    }

    /// Returns the characters of the label, each with a flag for subscripts.
    fn characters(&self) -> impl Iterator<Item = (char, bool)> + '_ {
        self.runs.iter().flat_map(|run| run.text.chars().map(|c| (c, run.subscript)))
    }

    fn push(&mut self, c: char, subscript: bool) {
        match self.runs.last_mut() {
            Some(run) if run.subscript == subscript => run.text.push(c),
            _ => self.runs.push(Run { text: c.to_string(), subscript }),
        }
    }
}

impl Run {
    /// Returns the font size of a run relative to the font size of the line.
    pub(crate) fn scale(&self) -> f64 {
        if self.subscript { SUBSCRIPT } else { 1.0 }
    }
}

impl From<&str> for Label {
    fn from(text: &str) -> Self {
        Self::plain(text)
    }
}

impl From<String> for Label {
    fn from(text: String) -> Self {
        Self::plain(&text)
    }
}

fn clean(text: &str) -> String {
    text.chars().map(|c| if c.is_control() || c.is_whitespace() { ' ' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn runs(label: &Label) -> Vec<(&str, bool)> {
        label.runs().iter().map(|r| (r.text.as_str(), r.subscript)).collect()
    }

    #[test]
    fn markup_makes_subscripts_and_plain_text_does_not() {
        let label = Label::markup("μF_N over u_{max}\\_0");
        assert_eq!(
            runs(&label),
            [("μF", false), ("N", true), (" over u", false), ("max", true), ("_0", false)]
        );
        assert_eq!(runs(&Label::plain("ball_1\nleft")), [("ball_1 left", false)]);
        assert_eq!(Label::markup("_").text(), "_");
        assert_eq!(runs(&Label::markup("a_{b")), [("a", false), ("b", true)]);
        assert!(Label::plain(" \t").is_empty());
    }

    #[test]
    fn a_long_label_shrinks_then_is_cut_but_keeps_its_unit() {
        let (label, unit) =
            (Label::markup("a rather long label of F_x"), Label::default().followed_by(" (mN)"));
        let whole = label.clone().joined(&unit);
        let width = whole.width(30.0).unwrap();
        assert_eq!(label.fitted(&unit, 30.0, width).unwrap(), (whole.clone(), 30.0));
        let (same, em) = label.fitted(&unit, 30.0, 0.95 * width).unwrap();
        assert_eq!(same, whole);
        assert!((em - 28.5).abs() < 1e-9);
        let (cut, em) = label.fitted(&unit, 30.0, 0.5 * width).unwrap();
        assert!(cut.text().ends_with("… (mN)") && cut.width(em).unwrap() <= 0.5 * width, "{cut:?}");
        let (cut, em) = label.fitted(&unit, 30.0, 20.0).unwrap();
        assert!(cut.width(em).unwrap() <= 20.0);
        // Runs of one character each, down to nothing.
        let mixed = Label::markup("a_bc_de_f");
        for most in 0..100 {
            assert!(mixed.cut(30.0, f64::from(most)).unwrap().width(30.0).unwrap() <= f64::from(most) + 1e-6);
        }
    }

    #[test]
    fn wrapping_keeps_every_word_that_fits() {
        let label = Label::plain("one two three four five six");
        let most = Label::plain("one two three").width(30.0).unwrap() + 1.0;
        let lines = label.wrapped(30.0, most, 3).unwrap();
        assert_eq!(lines.iter().map(Label::text).collect::<Vec<_>>(), ["one two three", "four five six"]);
        // A word wider than the line continues in the next.
        let word = Label::plain("abcdefghijklmnopqrstuvwxyz").wrapped(30.0, 100.0, 9).unwrap();
        assert!(word.len() > 2 && word.iter().all(|line| line.width(30.0).unwrap() <= 100.0), "{word:?}");
        assert_eq!(word.iter().map(Label::text).collect::<String>(), "abcdefghijklmnopqrstuvwxyz");
        let lines = label.wrapped(30.0, most, 1).unwrap();
        assert!(lines.len() == 1 && lines[0].text().ends_with(ELLIPSIS));
        // A key path is broken at its dots.
        let path = Label::plain("contacts.front.profile.paraboloid.radius");
        let lines = path.wrapped(30.0, 0.97 * path.width(30.0).unwrap(), 2).unwrap();
        assert_eq!(
            lines.iter().map(Label::text).collect::<Vec<_>>(),
            ["contacts.front.profile.paraboloid.", "radius"]
        );
    }
}
