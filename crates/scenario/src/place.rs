//! Index from key paths to positions in the text. The parser builds this tree once.

use crate::path::{KeyPath, Step};

/// Byte range of a source text; source 0 is the file, others are overrides and tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) source: usize,
    pub(crate) start: usize,
    pub(crate) end: usize,
}

/// Position of a value, and of the values inside it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Place {
    /// Span of the key with its quotes; `None` for the root and for entries of lists.
    pub(crate) key: Option<Span>,
    pub(crate) value: Span,
    pub(crate) inner: Inner,
}

/// Positions of the values inside a value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Inner {
    Leaf,
    Object(Vec<(String, Place)>),
    List(Vec<Place>),
}

impl Place {
    /// Returns the position of the value one step deeper in the key path.
    pub(crate) fn step(&self, step: &Step) -> Option<&Self> {
        match (&self.inner, step) {
            (Inner::Object(entries), Step::Key(key)) => {
                entries.iter().find(|(name, _)| name == key).map(|(_, place)| place)
            }
            (Inner::List(entries), Step::Index(index)) => entries.get(*index),
            _ => None,
        }
    }

    fn step_mut(&mut self, step: &Step) -> Option<&mut Self> {
        match (&mut self.inner, step) {
            (Inner::Object(entries), Step::Key(key)) => {
                entries.iter_mut().find(|(name, _)| name == key).map(|(_, place)| place)
            }
            (Inner::List(entries), Step::Index(index)) => entries.get_mut(*index),
            _ => None,
        }
    }

    /// Returns the position of the deepest existing part of a path, and the number of steps to this part.
    pub(crate) fn deepest(&self, path: &KeyPath) -> (&Self, usize) {
        let mut here = self;
        for (i, step) in path.0.iter().enumerate() {
            match here.step(step) {
                Some(next) => here = next,
                None => return (here, i),
            }
        }
        (here, path.0.len())
    }

    /// Removes the position of the value at a path.
    pub(crate) fn clear(&mut self, path: &[Step]) {
        let Some((Step::Key(last), parent)) = path.split_last() else { return };
        let parent = parent.iter().try_fold(self, |here, step| here.step_mut(step));
        if let Some(Self { inner: Inner::Object(entries), .. }) = parent {
            entries.retain(|(name, _)| name != last);
        }
    }

    /// Sets the position of the value at a path. Missing parents become objects, or a list for index 0.
    pub(crate) fn put(&mut self, path: &[Step], place: Self) {
        let Some((first, rest)) = path.split_first() else {
            self.value = place.value;
            self.key = self.key.or(place.key);
            self.inner = place.inner;
            return;
        };
        if let (Step::Index(index), Inner::Object(entries)) = (first, &self.inner)
            && (*index, entries.len()) == (0, 0)
        {
            self.inner = Inner::List(Vec::new());
        }
        if let (Step::Index(index), Inner::List(entries)) = (first, &mut self.inner)
            && *index == entries.len()
        {
            entries.push(Self { key: place.key, value: place.value, inner: Inner::Object(Vec::new()) });
        }
        if self.step(first).is_none()
            && let Step::Key(key) = first
        {
            if !matches!(self.inner, Inner::Object(_)) {
                self.inner = Inner::Object(Vec::new());
            }
            if let Inner::Object(entries) = &mut self.inner {
                let new = Self { key: place.key, value: place.value, inner: Inner::Object(Vec::new()) };
                entries.push((key.clone(), new));
            }
        }
        if let Some(next) = self.step_mut(first) {
            next.put(rest, place);
        }
    }
}
