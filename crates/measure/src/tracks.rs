//! Event times of a run by source and kind.

use std::collections::HashMap;

/// Event times of all sources and kinds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tracks {
    tracks: Vec<Track>,
    /// Indices of the tracks of each source.
    places: HashMap<String, Vec<usize>>,
    /// Total number of events.
    size: u64,
}

/// Event times of one source and kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// Name of the contact or waveform.
    pub source: String,
    /// Kind of the events.
    pub kind: String,
    /// Times, s, in ascending order.
    pub times: Vec<f64>,
}

impl Tracks {
    /// Adds an event.
    pub fn push(&mut self, [source, kind]: [&str; 2], time: f64) {
        self.size += 1;
        let places = self.places.get(source).map_or(&[][..], |places| places);
        if let Some(place) = places.iter().find(|place| self.tracks[**place].kind == kind) {
            self.tracks[*place].times.push(time);
            return;
        }
        self.places.entry(source.to_owned()).or_default().push(self.tracks.len());
        self.tracks.push(Track { source: source.to_owned(), kind: kind.to_owned(), times: vec![time] });
    }

    /// Returns the number of events.
    pub fn size(&self) -> u64 {
        self.size
    }

    /// Returns all tracks in the order of their first events.
    pub fn all(&self) -> &[Track] {
        &self.tracks
    }
}
