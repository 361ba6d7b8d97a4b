//! Figures as PNG, with what they come from in text chunks.

use crate::figure::{Figure, PlotError};
use crate::layout::Layout;
use crate::paint::paint;
use crate::raster::Raster;
use std::io::Cursor;

/// Centimetres in print for the width of a figure, whatever its pixels.
const PRINT_WIDTH_CM: f64 = 16.0;

/// Draws a figure and encodes it. The title (unless the provenance has one) and the provenance become text chunks:
/// `tEXt` where Latin-1 suffices, else `iTXt`. The same figure gives the same bytes.
///
/// # Errors
/// A figure that cannot be drawn, see [`PlotError`]; a provenance key that PNG does not allow.
pub fn draw_png(figure: &Figure<'_>) -> Result<Vec<u8>, PlotError> {
    let layout = Layout::new(figure)?;
    let (width, height) = figure.size;
    let mut raster = Raster::new(figure.size).ok_or(PlotError::Size { width, height })?;
    paint(&mut raster, figure, &layout)?;
    encode(&raster.rgb(), figure)
}

/// The text chunks of a PNG, in order.
///
/// # Errors
/// Bytes that are no PNG.
pub fn read_text(bytes: &[u8]) -> Result<Vec<(String, String)>, PlotError> {
    let failed = |e: png::DecodingError| PlotError::Png(e.to_string());
    let reader = png::Decoder::new(Cursor::new(bytes)).read_info().map_err(failed)?;
    let info = reader.info();
    let latin =
        info.uncompressed_latin1_text.iter().map(|chunk| Ok((chunk.keyword.clone(), chunk.text.clone())));
    let wide =
        info.utf8_text.iter().map(|chunk| Ok((chunk.keyword.clone(), chunk.get_text().map_err(failed)?)));
    latin.chain(wide).collect()
}

fn encode(rgb: &[u8], figure: &Figure<'_>) -> Result<Vec<u8>, PlotError> {
    let failed = |e: png::EncodingError| PlotError::Png(e.to_string());
    let (width, height) = figure.size;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_adaptive_filter(png::AdaptiveFilterType::Adaptive);
    let per_metre = (f64::from(width) / (PRINT_WIDTH_CM / 100.0)).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    for (key, text) in texts(figure) {
        check_key(&key)?;
        // NUL ends a chunk's text early.
        let text = text.replace('\0', " ");
        if text.chars().all(|c| u32::from(c) < 256) {
            encoder.add_text_chunk(key, text).map_err(failed)?;
        } else {
            encoder.add_itxt_chunk(key, text).map_err(failed)?;
        }
    }
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(rgb).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// The figure's title and provenance.
pub(crate) fn texts(figure: &Figure<'_>) -> Vec<(String, String)> {
    let titled = figure.provenance.iter().any(|(key, _)| key == "Title");
    let title = (!titled && !figure.title.is_empty()).then(|| ("Title".to_owned(), figure.title.text()));
    title.into_iter().chain(figure.provenance.iter().cloned()).collect()
}

/// PNG's rule for keywords: 1 to 79 printable Latin-1 characters, no blanks at the ends or in a row.
fn check_key(key: &str) -> Result<(), PlotError> {
    let printable = |c: char| matches!(u32::from(c), 0x20..=0x7E | 0xA1..=0xFF);
    let blanks = key.starts_with(' ') || key.ends_with(' ') || key.contains("  ");
    if (1..=79).contains(&key.chars().count()) && key.chars().all(printable) && !blanks {
        return Ok(());
    }
    Err(PlotError::Key(key.to_owned()))
}
