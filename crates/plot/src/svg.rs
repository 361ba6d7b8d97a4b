//! Figures as SVG.

use crate::figure::{Figure, PlotError};
use crate::layout::Layout;
use crate::paint::{UNITS, paint};
use crate::png::texts;
use plotters::backend::SVGBackend;

/// Draws a figure as an SVG document; title and provenance become its `<title>` and `<desc>`. Texts stay texts, in
/// `DejaVu` Sans or what the viewer has instead.
///
/// # Errors
/// A figure that cannot be drawn, see [`PlotError`].
pub fn draw_svg(figure: &Figure<'_>) -> Result<String, PlotError> {
    let layout = Layout::new(figure)?;
    let (width, height) = figure.size;
    let mut drawing = String::new();
    {
        let mut backend = SVGBackend::with_string(&mut drawing, (width * UNITS, height * UNITS));
        paint(&mut backend, figure, &layout)?;
    }
    // Plotters writes the size in units and knows no joins; the rest of its document stays.
    let body = drawing.split_once('>').map(|(_, body)| body);
    let body = body.ok_or_else(|| PlotError::Draw("plotters wrote no SVG".to_owned()))?;
    let (wide, high) = (width * UNITS, height * UNITS);
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {wide} {high}\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>{}</title>\n<desc>{}</desc>{body}",
        escaped(&figure.title.text()),
        texts(figure).iter().map(|(key, text)| escaped(&format!("{key}: {text}\n"))).collect::<String>(),
    ))
}

/// Text between tags; characters that XML does not allow become blanks.
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
