//! Key paths such as `contacts.ball.friction` or `loads[0].x`, which identify values of a scenario.

use crate::document::shown;
use crate::fault::Fault;
use std::fmt;

/// Step of a key path.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) enum Step {
    /// Key of an object.
    Key(String),
    /// Index in a list.
    Index(usize),
}

/// Key path; empty for the whole scenario.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub(crate) struct KeyPath(pub(crate) Vec<Step>);

impl KeyPath {
    /// Parses `contacts.ball.friction` or `loads[0].x`. Returns `None` for texts of another form.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let mut steps = Vec::new();
        if text.is_empty() {
            return Some(Self(steps));
        }
        for part in text.split('.') {
            let (key, indices) = part.split_at(part.find('[').unwrap_or(part.len()));
            if key.is_empty() || key.contains(']') {
                return None;
            }
            steps.push(Step::Key(key.to_owned()));
            let mut rest = indices;
            while !rest.is_empty() {
                let (index, tail) = rest.strip_prefix('[')?.split_once(']')?;
                steps.push(Step::Index(index.parse().ok()?));
                rest = tail;
            }
        }
        Some(Self(steps))
    }

    /// Returns whether the value at this path contains the value at another path, or is equal to it. A `*` in `other` matches any step.
    pub(crate) fn holds(&self, other: &Self) -> bool {
        let any = Step::Key("*".to_owned());
        self.0.len() <= other.0.len() && self.0.iter().zip(&other.0).all(|(a, b)| a == b || *b == any)
    }

    /// Returns whether this path lies in the value at another path, which may contain `*`.
    pub(crate) fn lies_in(&self, other: &Self) -> bool {
        let head = Self(self.0.iter().take(other.0.len()).cloned().collect());
        head.0.len() == other.0.len() && head.holds(other)
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, step) in self.0.iter().enumerate() {
            match step {
                Step::Key(key) if key.is_empty() => write!(f, "{}\"\"", if i == 0 { "" } else { "." })?,
                Step::Key(key) if i == 0 => write!(f, "{}", shown(key))?,
                Step::Key(key) => write!(f, ".{}", shown(key))?,
                Step::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}

/// Current key path of a conversion: a linked list on the call stack, copied only for a message.
#[derive(Debug, Clone, Copy)]
pub(crate) struct At<'a> {
    parent: Option<&'a At<'a>>,
    step: Option<StepRef<'a>>,
}

#[derive(Debug, Clone, Copy)]
enum StepRef<'a> {
    Key(&'a str),
    Index(usize),
}

impl<'a> At<'a> {
    /// Whole scenario.
    pub(crate) const ROOT: At<'static> = At { parent: None, step: None };

    /// Value at a key.
    pub(crate) fn key<'b>(&'b self, key: &'b str) -> At<'b> {
        At { parent: Some(self), step: Some(StepRef::Key(key)) }
    }

    /// Entry of a list.
    pub(crate) fn index(&self, index: usize) -> At<'_> {
        At { parent: Some(self), step: Some(StepRef::Index(index)) }
    }

    /// Returns the key path.
    pub(crate) fn path(&self) -> KeyPath {
        let mut steps = Vec::new();
        let mut here = Some(self);
        while let Some(at) = here {
            match at.step {
                Some(StepRef::Key(key)) => steps.push(Step::Key(key.to_owned())),
                Some(StepRef::Index(index)) => steps.push(Step::Index(index)),
                None => {}
            }
            here = at.parent;
        }
        steps.reverse();
        KeyPath(steps)
    }

    /// Returns an error at this position.
    pub(crate) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault::new(self.path(), message)
    }

    /// Returns the error for an unexpected value; the report adds the value in the file.
    pub(crate) fn expected(&self, what: impl fmt::Display) -> Fault {
        Fault::expected(self.path(), what)
    }

    /// Returns the error for a missing key.
    pub(crate) fn missing(&self, key: &str) -> Fault {
        Fault::missing(self.path(), key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Line ends in a key must not break the message into two lines.
    #[test]
    fn keys_with_control_characters_stay_on_one_line() {
        let path = KeyPath(vec![Step::Key("a\nb".to_owned())]);
        assert_eq!(path.to_string(), "a\u{fffd}b");
    }

    #[test]
    fn what_is_written_is_read_back() {
        for text in ["", "run", "contacts.ball.friction", "loads[0].x", "a[1][22].b"] {
            assert_eq!(KeyPath::parse(text).unwrap().to_string(), text);
        }
        for text in [".", "a.", "a[", "a[x]", "a[1]b", "[0]", "a]"] {
            assert_eq!(KeyPath::parse(text), None, "{text}");
        }
    }
}
