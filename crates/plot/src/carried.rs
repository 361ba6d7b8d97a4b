//! Metadata in picture files: the origin of a figure.

use crate::png::read_png;
use crate::svg::read_svg;
use crate::{Figure, PlotError};

/// Texts longer than this (bytes) are compressed in a PNG and left out of the SVG description.
pub(crate) const LONG_TEXT: usize = 1024;
/// Maximum size of an uncompressed text, bytes; limits memory use for foreign files.
pub(crate) const MOST_TEXT: usize = 64 << 20;
/// Signature of a PNG.
const PNG: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Returns the keys and texts in a drawn figure: its title and provenance.
///
/// # Errors
/// If the bytes are neither PNG nor SVG, if a text is damaged, or if one exceeds 64 MiB.
pub fn read_text(bytes: &[u8]) -> Result<Vec<(String, String)>, PlotError> {
    if bytes.starts_with(&PNG) {
        return read_png(bytes);
    }
    match std::str::from_utf8(bytes) {
        Ok(text) if text.trim_start().starts_with('<') => read_svg(text),
        _ => Err(PlotError::NoPicture),
    }
}

/// Returns the title and provenance of a figure.
pub(crate) fn texts(figure: &Figure<'_>) -> Vec<(String, String)> {
    let titled = figure.provenance.iter().any(|(key, _)| key == "Title");
    let title = (!titled && !figure.title.is_empty()).then(|| ("Title".to_owned(), figure.title.text()));
    title.into_iter().chain(figure.provenance.iter().cloned()).collect()
}
