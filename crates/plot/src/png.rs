//! PNG output with metadata in text chunks.

use crate::carried::{LONG_TEXT, MOST_TEXT, texts};
use crate::layout::Layout;
use crate::mosaic::Image;
use crate::paint::{mosaics, paint};
use crate::palette::Indexed;
use crate::raster::Raster;
use crate::{Figure, PlotError};
use png::text_metadata::{ITXtChunk, TEXtChunk, ZTXtChunk};
use std::io::{Cursor, Write};

/// Compression level, 1 to 9. Higher levels take far longer for little gain.
const LEVEL: i32 = 4;

/// Draws a figure as PNG; the same figure gives the same bytes.
///
/// Title (unless the provenance has one) and provenance become text chunks: `tEXt` for Latin-1, otherwise `iTXt`.
/// Texts beyond 1 KiB are compressed (`zTXt`, `iTXt`).
///
/// # Errors
/// If the figure cannot be drawn, see [`PlotError`], or if PNG does not allow a provenance key.
pub fn draw_png(figure: &Figure<'_>) -> Result<Vec<u8>, PlotError> {
    let raster = pixels(figure)?;
    let (width, height) = figure.size;
    let indexed = Indexed::new(width as usize * height as usize, raster.colours());
    let mut bytes = Vec::new();
    let mut encoder = encoder(&mut bytes, (width, height), indexed.as_ref());
    print_size(&mut encoder, figure);
    let mut writer = encoder.write_header()?;
    write_texts(&mut writer, figure)?;
    match indexed {
        Some(Indexed { pixels, .. }) => write_image(&mut writer, &pixels, width as usize)?,
        None => write_image(&mut writer, &raster.rgb(), 3 * width as usize)?,
    }
    writer.finish()?;
    Ok(bytes)
}

/// Draws figures of the same size as an endless animated PNG with `delay` ms per frame. Viewers without animation show the first figure.
/// The animation has the metadata of the first figure.
///
/// # Errors
/// If there are no figures, if their sizes differ, or if one cannot be drawn.
pub fn draw_animation(figures: &[Figure<'_>], delay: u16) -> Result<Vec<u8>, PlotError> {
    let Some(first) = figures.first() else { return Err(PlotError::NoPanels) };
    if let Some(other) = figures.iter().find(|figure| figure.size != first.size) {
        let (width, height) = other.size;
        return Err(PlotError::Size { width, height });
    }
    let frames = figures.iter().map(pixels).collect::<Result<Vec<_>, _>>()?;
    let (width, height) = first.size;
    let count = frames.len() * width as usize * height as usize;
    // All frames share one palette.
    let indexed = Indexed::new(count, frames.iter().flat_map(Raster::colours));
    let mut bytes = Vec::new();
    let mut encoder = encoder(&mut bytes, first.size, indexed.as_ref());
    print_size(&mut encoder, first);
    encoder.set_animated(u32::try_from(frames.len()).unwrap_or(u32::MAX), 0)?;
    encoder.set_frame_delay(delay, 1000)?;
    let mut writer = encoder.write_header()?;
    write_texts(&mut writer, first)?;
    match indexed {
        Some(Indexed { pixels, .. }) => {
            let frames = pixels.chunks_exact(pixels.len() / frames.len());
            frames.into_iter().try_for_each(|frame| writer.write_image_data(frame))?;
        }
        None => frames.iter().try_for_each(|frame| writer.write_image_data(&frame.rgb()))?,
    }
    writer.finish()?;
    Ok(bytes)
}

/// Renders a figure as a bitmap.
fn pixels(figure: &Figure<'_>) -> Result<Raster, PlotError> {
    let layout = Layout::new(figure)?;
    let (width, height) = figure.size;
    let ground = figure.theme.background;
    let mut raster = Raster::new(figure.size, ground).ok_or(PlotError::Size { width, height })?;
    for (frame, image) in mosaics(&layout, &figure.theme, 1) {
        raster.paste(&image, (frame.left as usize, frame.top as usize));
    }
    paint(&mut raster, figure, &layout)?;
    Ok(raster)
}

/// Returns the text chunks: first uncompressed Latin-1 (`tEXt`), then compressed Latin-1 (`zTXt`), then Unicode (`iTXt`).
pub(crate) fn read_png(bytes: &[u8]) -> Result<Vec<(String, String)>, PlotError> {
    let mut options = png::DecodeOptions::default();
    // By default the decoder ignores damaged texts.
    options.set_skip_ancillary_crc_failures(false);
    let reader = png::Decoder::new_with_options(Cursor::new(bytes), options).read_info()?;
    let info = reader.info();
    let mut texts: Vec<(String, String)> = Vec::new();
    for chunk in &info.uncompressed_latin1_text {
        texts.push((chunk.keyword.clone(), chunk.text.clone()));
    }
    for mut chunk in info.compressed_latin1_text.iter().cloned() {
        chunk.decompress_text_with_limit(MOST_TEXT)?;
        texts.push((chunk.keyword.clone(), chunk.get_text()?));
    }
    for mut chunk in info.utf8_text.iter().cloned() {
        chunk.decompress_text_with_limit(MOST_TEXT)?;
        texts.push((chunk.keyword.clone(), chunk.get_text()?));
    }
    Ok(texts)
}

/// Encodes an image as PNG.
pub(crate) fn encoded(image: &Image) -> Result<Vec<u8>, PlotError> {
    let size = |side: usize| u32::try_from(side).map_err(|e| PlotError::Png(e.to_string()));
    let indexed = Indexed::new(image.width * image.height, image.colours());
    let mut bytes = Vec::new();
    let size = (size(image.width)?, size(image.height)?);
    let mut writer = encoder(&mut bytes, size, indexed.as_ref()).write_header()?;
    match indexed {
        Some(Indexed { pixels, .. }) => write_image(&mut writer, &pixels, image.width)?,
        None => write_image(&mut writer, &image.rgb, 3 * image.width)?,
    }
    writer.finish()?;
    Ok(bytes)
}

fn encoder<'b>(
    bytes: &'b mut Vec<u8>,
    (width, height): (u32, u32),
    indexed: Option<&Indexed>,
) -> png::Encoder<'static, &'b mut Vec<u8>> {
    let mut encoder = png::Encoder::new(bytes, width, height);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    match indexed {
        Some(Indexed { palette, .. }) => {
            encoder.set_color(png::ColorType::Indexed);
            encoder.set_palette(palette.concat());
        }
        None => encoder.set_color(png::ColorType::Rgb),
    }
    // These settings apply to animations only, whose frames the crate `png` compresses.
    encoder.set_compression(png::Compression::Default);
    encoder.set_filter(png::FilterType::NoFilter);
    encoder
}

/// Sets the physical size: the print width of the figure, or 160 mm.
fn print_size<W: Write>(encoder: &mut png::Encoder<'_, W>, figure: &Figure<'_>) {
    let metres = figure.print_width.unwrap_or(Figure::PRINT_WIDTH) / 1000.0;
    let per_metre = (f64::from(figure.size.0) / metres).round() as u32;
    let unit = png::Unit::Meter;
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit }));
}

/// Writes the rows of an image, `row` bytes each, without filters. zlib-rs compresses them at once, which is faster
/// than row by row in the crate `png`.
fn write_image<W: Write>(writer: &mut png::Writer<W>, pixels: &[u8], row: usize) -> Result<(), PlotError> {
    let mut rows = Vec::with_capacity(pixels.len() + pixels.len() / row);
    for pixels in pixels.chunks_exact(row) {
        rows.push(png::FilterType::NoFilter as u8);
        rows.extend_from_slice(pixels);
    }
    let mut room = vec![0; zlib_rs::compress_bound(rows.len())];
    let (compressed, code) = zlib_rs::compress_slice(&mut room, &rows, zlib_rs::DeflateConfig::new(LEVEL));
    if code != zlib_rs::ReturnCode::Ok {
        return Err(PlotError::Png(format!("compression failed: {code:?}")));
    }
    Ok(writer.write_chunk(png::chunk::IDAT, compressed)?)
}

fn write_texts<W: Write>(writer: &mut png::Writer<W>, figure: &Figure<'_>) -> Result<(), PlotError> {
    for (key, text) in texts(figure) {
        check_key(&key)?;
        // NUL would end the text.
        write_text(writer, &key, &text.replace('\0', " "))?;
    }
    Ok(())
}

fn write_text<W: Write>(
    writer: &mut png::Writer<W>,
    key: &str,
    text: &str,
) -> Result<(), png::EncodingError> {
    let is_latin = text.chars().all(|c| u32::from(c) < 256);
    match (is_latin, text.len() > LONG_TEXT) {
        (true, false) => writer.write_text_chunk(&TEXtChunk::new(key, text)),
        (true, true) => {
            let mut chunk = ZTXtChunk::new(key, text);
            chunk.compress_text()?;
            writer.write_text_chunk(&chunk)
        }
        (false, is_long) => {
            let mut chunk = ITXtChunk::new(key, text);
            chunk.compressed = is_long;
            writer.write_text_chunk(&chunk)
        }
    }
}

/// Checks PNG's rule for keywords: 1 to 79 printable Latin-1 characters, without blanks at the ends and double blanks.
fn check_key(key: &str) -> Result<(), PlotError> {
    let printable = |c: char| matches!(u32::from(c), 0x20..=0x7E | 0xA1..=0xFF);
    let blanks = key.starts_with(' ') || key.ends_with(' ') || key.contains("  ");
    if (1..=79).contains(&key.chars().count()) && key.chars().all(printable) && !blanks {
        return Ok(());
    }
    Err(PlotError::Key(key.to_owned()))
}
