//! Pictures of a contact by itself.

use crate::look::{Look, Picture};
use crate::pictures::FigureError;
use stickslip_results::theory::{Sheet, Subject, Walk};

/// Names of the pictures.
const NAMES: [&str; 0] = [];

/// Names of all files that any look gives to them.
pub fn all_files() -> Vec<String> {
    Look::all_files_of(&NAMES)
}

/// Draws them.
pub fn draw(_subject: &Subject<'_>, _sheet: &Sheet, _walk: &Walk, _look: &Look) -> Vec<Result<Vec<Picture>, FigureError>> {
    Vec::new()
}
