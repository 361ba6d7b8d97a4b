//! Moments of the events of a run, by source and kind.

/// All events.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Tracks(Vec<Track>);

/// The events of one kind from one source.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Track {
    /// Name of a contact or waveform.
    pub(crate) source: String,
    pub(crate) kind: String,
    /// Moments, s, ascending.
    pub(crate) times: Vec<f64>,
}

impl Tracks {
    /// Takes the next event.
    pub(crate) fn push(&mut self, [source, kind]: [&str; 2], time: f64) {
        match self.0.iter_mut().find(|track| track.source == source && track.kind == kind) {
            Some(track) => track.times.push(time),
            None => {
                self.0.push(Track { source: source.to_owned(), kind: kind.to_owned(), times: vec![time] });
            }
        }
    }

    /// In the order of the first event of each.
    pub(crate) fn all(&self) -> &[Track] {
        &self.0
    }
}
