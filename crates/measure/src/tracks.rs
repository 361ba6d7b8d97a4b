//! Moments of the events of a run, by source and kind.

use std::collections::HashMap;

/// All events.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tracks {
    tracks: Vec<Track>,
    /// Places of the tracks by source.
    places: HashMap<String, Vec<usize>>,
    /// Number of moments.
    size: u64,
}

/// The events of one kind from one source.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// Name of a contact or waveform.
    pub source: String,
    /// What happened.
    pub kind: String,
    /// Moments, s, ascending.
    pub times: Vec<f64>,
}

impl Tracks {
    /// Takes the next event.
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

    /// Number of moments.
    pub fn size(&self) -> u64 {
        self.size
    }

    /// In the order of the first event of each.
    pub fn all(&self) -> &[Track] {
        &self.tracks
    }
}
