//! Measured points plotted over a map.

use super::{Map, MapError};
use std::path::Path;
use stickslip_quantity::names::with_unit;
use stickslip_scenario::quantity;

/// Maximum number of classes of points.
const CLASSES: usize = 12;

/// Measured points by class.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Overlay {
    /// Name and points of each class, SI; the name is empty if the table has no classes.
    pub classes: Vec<(String, Vec<[f64; 2]>)>,
}

impl Overlay {
    /// Reads a CSV table. Columns are named `x` and `y`, or like the key paths of the map with or without unit. An
    /// optional third column gives the class. Numbers are in SI or have a unit.
    ///
    /// # Errors
    /// Fails if the table cannot be read, lacks a column or contains an invalid number.
    pub fn load(path: &Path, map: &Map) -> Result<Self, MapError> {
        let refused = |message: String| MapError::Overlay { path: path.to_owned(), message };
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .comment(Some(b'#'))
            .from_path(path)
            .map_err(|error| refused(words(&error)))?;
        let heads = reader.headers().map_err(|error| refused(words(&error)))?.clone();
        let mut places = [0; 2];
        for ((place, axis), short) in places.iter_mut().zip(&map.axes).zip(["x", "y"]) {
            let known = [short.to_owned(), axis.path.clone(), with_unit(&axis.path, axis.unit)];
            *place =
                heads.iter().position(|head| known.iter().any(|known| known == head)).ok_or_else(|| {
                    refused(format!("there is no column {short} or {}", with_unit(&axis.path, axis.unit)))
                })?;
        }
        let class = (0..heads.len()).find(|place| !places.contains(place));
        let mut overlay = Self::default();
        for record in reader.records() {
            let record = record.map_err(|error| refused(words(&error)))?;
            let line = record.position().map_or(0, csv::Position::line);
            let mut point = [0.0; 2];
            for ((value, place), axis) in point.iter_mut().zip(places).zip(&map.axes) {
                let text = record.get(place).unwrap_or_default();
                let read = quantity(text, axis.unit).ok().filter(|value| value.is_finite());
                *value = read.ok_or_else(|| {
                    let head = heads.get(place).unwrap_or_default();
                    refused(format!("line {line}, column {head}: expected a number, got \"{text}\""))
                })?;
            }
            let word = class.and_then(|place| record.get(place)).unwrap_or_default();
            overlay.push(word, point);
        }
        match overlay.classes.len() {
            0 => Err(refused("the table has no points".to_owned())),
            1..=CLASSES => Ok(overlay),
            many => Err(refused(format!("expected at most {CLASSES} classes of points, got {many}"))),
        }
    }

    fn push(&mut self, word: &str, point: [f64; 2]) {
        match self.classes.iter_mut().find(|(known, _)| known == word) {
            Some((_, points)) => points.push(point),
            None => self.classes.push((word.to_owned(), vec![point])),
        }
    }
}

/// Returns the message of a CSV error.
fn words(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Io(error) => stickslip_run::complaint::words(error),
        _ => error.to_string(),
    }
}
