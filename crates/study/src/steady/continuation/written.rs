//! Stored form of an orbit in the journal. A continuation that resumes from a stored orbit gives identical bits.

use super::happened::Happened;
use super::place::{Bench, Place, Slopes};
use super::standing::{Point, Standing};
use crate::journal::pairs;
use crate::steady::map::Image;
use crate::steady::newton::Fixed;
use crate::steady::tally::Tally;
use nalgebra::DVector;
use serde::{Deserialize, Serialize};
use stickslip_drive::{Model, State};

/// Key of stored states, without meaning here: the states belong to the model at the stored parameter value.
const KEY: [u8; 32] = [0; 32];

/// An orbit in the journal.
#[derive(Serialize, Deserialize)]
pub(super) struct Written {
    value: f64,
    /// State and its image as hexadecimal bytes.
    states: [String; 2],
    way: Vec<f64>,
    tally: Option<Tally>,
    defect: DVector<f64>,
    slopes: Slopes,
    tangent: DVector<f64>,
    #[serde(with = "pairs")]
    happened: Happened,
    margin: f64,
    is_loose: bool,
    point: Point,
}

impl Written {
    pub(super) fn of(standing: &Standing) -> Self {
        let Standing { place, slopes, tangent, happened, margin, is_loose, point } = standing.clone();
        let Fixed { state, image, defect, .. } = place.fixed;
        let model = &place.variant.drive.model;
        let states = [&state, &image.state].map(|state| digits(&state.to_bytes(model, &KEY)));
        let (value, way, tally) = (place.variant.value, image.way, image.happened);
        Self { value, states, way, tally, defect, slopes, tangent, happened, margin, is_loose, point }
    }

    /// Restores the orbit. Returns `None` if the stored states do not belong to the model.
    pub(super) fn read(self, bench: &Bench<'_>) -> Option<Standing> {
        let variant = bench.variant(self.value).ok()?;
        let [state, image] = self.states.map(|text| state(&variant.drive.model, &text));
        let image = Image { state: image?, way: self.way, happened: self.tally };
        let fixed = Fixed { state: state?, image, defect: self.defect, defects: Vec::new() };
        let Self { slopes, tangent, happened, margin, is_loose, point, .. } = self;
        let place = Place { variant, fixed };
        Some(Standing { place, slopes, tangent, happened, margin, is_loose, point })
    }
}

fn digits(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn state(model: &Model, text: &str) -> Option<State> {
    let byte = |k: usize| u8::from_str_radix(text.get(k..k + 2)?, 16).ok();
    let bytes: Option<Vec<u8>> = (0..text.len()).step_by(2).map(byte).collect();
    State::from_bytes(model, &KEY, &bytes?).ok()
}
