//! Draws, saves and parses figures for the tests. Every picture is saved in Cargo's folder for temporary test files.

use std::path::Path;
use stickslip_plot::{Colour, Figure, Theme, draw_png, draw_svg};
use ttf_parser::Face;

/// Decoded picture.
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) rgb: Vec<u8>,
}

/// Text of a drawing with its rectangle, px: left, top, right, bottom.
#[derive(Debug, Clone)]
pub(crate) struct Text {
    pub(crate) text: String,
    pub(crate) area: [f64; 4],
}

/// Draws and saves both formats, and checks what every figure must fulfil.
pub(crate) fn draw(name: &str, figure: &Figure<'_>) -> Vec<u8> {
    let bytes = draw_png(figure).unwrap();
    let drawing = draw_svg(figure).unwrap();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(folder.join(format!("{name}.png")), &bytes).unwrap();
    std::fs::write(folder.join(format!("{name}.svg")), &drawing).unwrap();
    assert_eq!(bytes, draw_png(figure).unwrap(), "the same figure gives the same bytes");
    let picture = decode(&bytes);
    assert_eq!((picture.width, picture.height), (figure.size.0 as usize, figure.size.1 as usize));
    assert_clear_border(&picture);
    bytes
}

/// Draws a figure in several themes and sizes, and checks that texts are complete and do not overlap. With the
/// variable `SPECIMENS` all six combinations are drawn, otherwise two.
pub(crate) fn draw_everywhere(name: &str, figure: &Figure<'_>) {
    let (light, dark) = (("light", Theme::light()), ("dark", Theme::dark()));
    let mut looks = vec![(&dark, 1), (&light, 2)];
    if std::env::var_os("SPECIMENS").is_some() {
        looks.extend([(&light, 1), (&dark, 2), (&light, 4), (&dark, 4)]);
    }
    for ((word, theme), halves) in looks {
        let size = (figure.size.0 * halves / 2, figure.size.1 * halves / 2);
        let figure = Figure { size, theme: theme.clone(), ..figure.clone() };
        draw(&format!("{name}-{word}-{}", size.0), &figure);
        assert_texts_apart(&figure);
    }
    assert_texts_apart(&Figure { size: (2 * figure.size.0, 2 * figure.size.1), ..figure.clone() });
}

/// Checks that texts are complete, inside the picture and do not overlap.
pub(crate) fn assert_texts_apart(figure: &Figure<'_>) {
    let texts = texts(&draw_svg(figure).unwrap());
    let (width, height) = (f64::from(figure.size.0), f64::from(figure.size.1));
    for (i, text) in texts.iter().enumerate() {
        let [left, top, right, bottom] = text.area;
        let inside = left >= 0.0 && top >= 0.0 && right <= width && bottom <= height;
        assert!(inside, "{text:?} in {width} x {height}");
        assert!(!text.text.contains('…'), "{text:?} is cut");
        for other in &texts[..i] {
            let [l, t, r, b] = other.area;
            let apart = left >= r - 1.0 || right <= l + 1.0 || top >= b - 1.0 || bottom <= t + 1.0;
            assert!(apart, "{text:?} and {other:?}");
        }
    }
}

/// Texts of a drawing, measured with the font's advances; heights are those of capital letters.
pub(crate) fn texts(drawing: &str) -> Vec<Text> {
    let face = Face::parse(dejavu::sans::regular(), 0).unwrap();
    let scale = 1.0 / 8.0;
    let measure = |tag: &str| {
        let (head, rest) = tag.split_once(">\n").unwrap();
        let text = rest.split_once("\n</text>").unwrap().0;
        let text = text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&").replace("&#39;", "'");
        let number = |key: &str| value(head, key).parse::<f64>().unwrap();
        // The font size in the file is the em; plotters divides its size by 1.24.
        let em = number("font-size") * scale;
        let glyph = |c| face.glyph_index(c).and_then(|id| face.glyph_hor_advance(id)).unwrap_or(0);
        let width =
            text.chars().map(|c| f64::from(glyph(c))).sum::<f64>() * em / f64::from(face.units_per_em());
        let start = match value(head, "text-anchor") {
            "start" => 0.0,
            "middle" => -width / 2.0,
            _ => -width,
        };
        let (x, y, baseline) = (number("x") * scale, number("y") * scale, 0.76 * em);
        let area = if head.contains("rotate(270") {
            [x + baseline - 0.73 * em, y - start - width, x + baseline, y - start]
        } else {
            [x + start, y + baseline - 0.73 * em, x + start + width, y + baseline]
        };
        Text { text, area }
    };
    drawing.split("<text ").skip(1).map(measure).collect()
}

/// Value of an attribute.
pub(crate) fn value<'t>(tag: &'t str, key: &str) -> &'t str {
    tag.split_once(&format!("{key}=\"")).unwrap().1.split_once('"').unwrap().0
}

/// Points of all polylines of a colour, px.
pub(crate) fn polylines(drawing: &str, colour: &str) -> Vec<Vec<(f64, f64)>> {
    let tags = drawing.split("<polyline ").skip(1).filter(|tag| value(tag, "stroke") == colour);
    tags.map(|tag| points(value(tag, "points"))).collect()
}

/// Points of all polygons of a colour, px.
pub(crate) fn polygons(drawing: &str, colour: &str) -> Vec<Vec<(f64, f64)>> {
    let tags = drawing.split("<polygon ").skip(1).filter(|tag| value(tag, "fill") == colour);
    tags.map(|tag| points(value(tag, "points"))).collect()
}

/// Rectangles of a colour: left, top, width, height, px.
pub(crate) fn rectangles(drawing: &str, colour: &str) -> Vec<[f64; 4]> {
    let tags =
        drawing.split("<rect ").skip(1).filter(|tag| tag.starts_with("x=") && value(tag, "fill") == colour);
    let number = |tag: &str, key: &str| value(tag, key).parse::<f64>().unwrap() / 8.0;
    tags.map(|tag| ["x", "y", " width", "height"].map(|key| number(tag, key))).collect()
}

fn points(list: &str) -> Vec<(f64, f64)> {
    let number = |text: &str| text.parse::<f64>().unwrap() / 8.0;
    list.split_whitespace()
        .map(|pair| pair.split_once(',').map(|(x, y)| (number(x), number(y))).unwrap())
        .collect()
}

/// Colour in the notation of plotters.
pub(crate) fn hex(Colour(r, g, b): Colour) -> String {
    format!("#{r:02X}{g:02X}{b:02X}")
}

pub(crate) fn decode(bytes: &[u8]) -> Picture {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    // Palette indices are expanded to colours.
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut rgb = vec![0; reader.output_buffer_size()];
    let info = reader.next_frame(&mut rgb).unwrap();
    Picture { width: info.width as usize, height: info.height as usize, rgb }
}

impl Picture {
    pub(crate) fn pixel(&self, x: usize, y: usize) -> [u8; 3] {
        let at = 3 * (y * self.width + x);
        [self.rgb[at], self.rgb[at + 1], self.rgb[at + 2]]
    }

    /// Number of pixels of exactly this colour.
    pub(crate) fn count(&self, colour: [u8; 3]) -> usize {
        self.rgb.chunks_exact(3).filter(|pixel| **pixel == colour).count()
    }
}

/// Checks that the outermost pixels all have the background colour.
pub(crate) fn assert_clear_border(picture: &Picture) {
    let (w, h) = (picture.width, picture.height);
    let corner = picture.pixel(0, 0);
    let (mut rows, mut columns) =
        ((0..w).flat_map(|x| [(x, 0), (x, h - 1)]), (0..h).flat_map(|y| [(0, y), (w - 1, y)]));
    assert!(
        rows.all(|(x, y)| picture.pixel(x, y) == corner)
            && columns.all(|(x, y)| picture.pixel(x, y) == corner)
    );
}
