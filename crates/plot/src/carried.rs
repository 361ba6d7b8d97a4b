//! What a file carries unseen: where its figure comes from.

use crate::png::read_png;
use crate::svg::read_svg;
use crate::{Figure, PlotError};

/// Texts longer than this, bytes, are for programs: compressed in a PNG, left out of the description of an SVG.
pub(crate) const LONG_TEXT: usize = 1024;
/// Most that a text may unpack to, bytes: a stranger's picture does not fill the memory.
pub(crate) const MOST_TEXT: usize = 64 << 20;
/// How a PNG begins.
const PNG: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// The keys and texts that a drawn figure carries: its title and its provenance.
///
/// # Errors
/// Bytes that are neither PNG nor SVG; a damaged text; one beyond 64 MiB.
pub fn read_text(bytes: &[u8]) -> Result<Vec<(String, String)>, PlotError> {
    if bytes.starts_with(&PNG) {
        return read_png(bytes);
    }
    match std::str::from_utf8(bytes) {
        Ok(text) if text.trim_start().starts_with('<') => read_svg(text),
        _ => Err(PlotError::NoPicture),
    }
}

/// The figure's title and provenance.
pub(crate) fn texts(figure: &Figure<'_>) -> Vec<(String, String)> {
    let titled = figure.provenance.iter().any(|(key, _)| key == "Title");
    let title = (!titled && !figure.title.is_empty()).then(|| ("Title".to_owned(), figure.title.text()));
    title.into_iter().chain(figure.provenance.iter().cloned()).collect()
}
