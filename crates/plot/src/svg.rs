//! SVG output.

use crate::canvas::UNITS;
use crate::carried::{LONG_TEXT, texts};
use crate::layout::{Area, Layout};
use crate::mosaic::Image;
use crate::paint::{mosaics, paint};
use crate::png::encoded;
use crate::theme::Colour;
use crate::{Figure, PlotError};
use data_encoding::BASE64;
use plotters::backend::SVGBackend;
use roxmltree::{Document, Node};
use std::fmt::Write as _;

/// XML namespace of the metadata entries.
const NAMESPACE: &str = "urn:stickslip";
/// Minimum figure width for embedded images, px: 500 px per inch at 160 mm.
const EMBEDDED_WIDTH: u32 = 3200;

/// Draws a figure as an SVG document. The title becomes `<title>`. Title and provenance become entries of `<metadata>`, and short entries
/// also lines of `<desc>`. Texts stay texts in `DejaVu` Sans or a fallback font. Mosaics are embedded images in print resolution.
///
/// # Errors
/// If the figure cannot be drawn, see [`PlotError`].
pub fn draw_svg(figure: &Figure<'_>) -> Result<String, PlotError> {
    let layout = Layout::new(figure)?;
    let (width, height) = figure.size;
    let mut drawing = String::new();
    {
        let mut backend = SVGBackend::with_string(&mut drawing, (width * UNITS, height * UNITS));
        paint(&mut backend, figure, &layout)?;
    }
    // The root tag of plotters is replaced: its size is in units, and it has no line joins.
    let body = drawing.split_once('>').map(|(_, body)| body);
    let body = body.ok_or_else(|| PlotError::Draw("plotters wrote no SVG".to_owned()))?;
    let (wide, high) = (width * UNITS, height * UNITS);
    let Colour(r, g, b) = figure.theme.background;
    let mut ground = format!("<rect width=\"{wide}\" height=\"{high}\" fill=\"#{r:02X}{g:02X}{b:02X}\"/>\n");
    for (frame, image) in mosaics(&layout, &figure.theme, EMBEDDED_WIDTH.div_ceil(width) as usize) {
        ground += &embedded(frame, &image)?;
    }
    let texts = texts(figure);
    let short = texts.iter().filter(|(_, text)| text.len() <= LONG_TEXT);
    let description: String = short.map(|(key, text)| escaped(&format!("{key}: {text}\n"))).collect();
    let metadata: String = texts.iter().map(entry).collect();
    // The size is the print width, otherwise px, which viewers fit to their page.
    let (across, down) = match figure.print_width {
        Some(mm) => (format!("{mm}mm"), format!("{:.3}mm", mm * f64::from(height) / f64::from(width))),
        None => (width.to_string(), height.to_string()),
    };
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{across}\" height=\"{down}\" viewBox=\"0 0 {wide} {high}\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>{}</title>\n<desc>{description}</desc>\n\
         <metadata>\n{metadata}</metadata>\n{ground}{body}",
        escaped(&figure.title.text()),
    ))
}

fn entry((key, text): &(String, String)) -> String {
    let key = escaped(key).replace('"', "&quot;");
    format!("<entry xmlns=\"{NAMESPACE}\" key=\"{key}\">{}</entry>\n", escaped(text))
}

/// Returns the entries of the metadata.
pub(crate) fn read_svg(text: &str) -> Result<Vec<(String, String)>, PlotError> {
    let document = Document::parse(text).map_err(|e| PlotError::Svg(e.to_string()))?;
    let root = document.root_element();
    if !root.has_tag_name("svg") {
        return Err(PlotError::NoPicture);
    }
    let metadata = root.children().filter(|node| node.has_tag_name("metadata"));
    let entries = metadata.flat_map(|node| node.children()).filter(|n| n.has_tag_name((NAMESPACE, "entry")));
    let pair = |node: Node<'_, '_>| {
        Some((node.attribute("key")?.to_owned(), node.text().unwrap_or_default().to_owned()))
    };
    Ok(entries.filter_map(pair).collect())
}

/// Embeds an image over a frame. `xlink:href` also works in older viewers.
fn embedded(frame: Area, image: &Image) -> Result<String, PlotError> {
    let Area { left, top, width, height } = frame;
    let [x, y, w, h] = [left, top, width, height].map(|way| (way * f64::from(UNITS)).round());
    let mut tag =
        format!("<image x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" preserveAspectRatio=\"none\" ");
    let data = BASE64.encode(&encoded(image)?);
    writeln!(tag, "xlink:href=\"data:image/png;base64,{data}\"/>")
        .map_err(|e| PlotError::Draw(e.to_string()))?;
    Ok(tag)
}

/// Escapes text between tags. Characters that XML does not allow become blanks.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '\n' => out.push(c),
            c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
