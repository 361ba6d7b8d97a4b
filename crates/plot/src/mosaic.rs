//! Mosaics in pixels: cells of few classes, mixed by area where a pixel holds several.

use crate::panel::Mosaic;
use crate::scale::Scale;
use crate::theme::{Colour, Theme};

/// Pixels, row by row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Image {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Red, green, blue of every pixel.
    pub(crate) rgb: Vec<u8>,
}

/// Light of a colour (linear in what the eye adds up) and the area it covers.
type Light = [f64; 4];

impl Mosaic<'_> {
    /// Ends of the columns, one more than columns.
    pub(crate) fn column_edges(&self) -> Vec<f64> {
        edges(&self.xs, 0.0)
    }

    /// Ends of the rows, one more than rows.
    pub(crate) fn row_edges(&self) -> Vec<f64> {
        edges(&self.ys, 0.5)
    }

    /// The mosaic as it shows through a frame. Of a pixel that several cells share, each colours its part of the
    /// area: neither a majority that hides a short slip nor a sample that falls in step with the motion.
    pub(crate) fn image(
        &self,
        (x, y): (&Scale, &Scale),
        (width, height): (usize, usize),
        theme: &Theme,
    ) -> Image {
        let (w, h) = (width as f64, height as f64);
        let columns = parts(&pixels(&self.column_edges(), |edge| w * x.place(edge), w), width);
        let rows = parts(&pixels(&self.row_edges(), |edge| h * (1.0 - y.place(edge)), h), height);
        let lights: Vec<Light> = self.classes.iter().map(|(_, ink)| light(theme.colour(*ink))).collect();
        let (behind, code) = (light(theme.background), Code::new());
        let mut rgb = vec![0; 3 * width * height];
        let mut mixed: Vec<Light> = vec![[0.0; 4]; self.ys.len()];
        for (px, cells) in columns.iter().enumerate() {
            mixed.fill([0.0; 4]);
            for &(column, share) in cells {
                let classes = self.cells[column * self.ys.len()..].iter();
                mixed
                    .iter_mut()
                    .zip(classes)
                    .for_each(|(sum, &class)| add(sum, lights[usize::from(class)], share));
            }
            for (py, cells) in rows.iter().enumerate() {
                let mut sum = [0.0; 4];
                cells.iter().for_each(|&(row, share)| add(&mut sum, mixed[row], share));
                let bare = (1.0 - sum[3]).max(0.0);
                add(&mut sum, behind, bare);
                let at = 3 * (py * width + px);
                rgb[at..at + 3].copy_from_slice(&[code.of(sum[0]), code.of(sum[1]), code.of(sum[2])]);
            }
        }
        Image { width, height, rgb }
    }
}

/// Middles between places, and beyond the first and the last a share of the way to their neighbours.
fn edges(places: &[f64], beyond: f64) -> Vec<f64> {
    let [first, second, ..] = places else { return [places, places].concat() };
    let [.., before, last] = places else { return Vec::new() };
    let middles = places.windows(2).map(|pair| pair[0] / 2.0 + pair[1] / 2.0);
    let start = first - beyond * (second - first);
    std::iter::once(start).chain(middles).chain([last + beyond * (last - before)]).collect()
}

/// Edges in pixels; a single cell without width fills the frame.
fn pixels(edges: &[f64], place: impl Fn(f64) -> f64, size: f64) -> Vec<f64> {
    match edges {
        [start, .., end] if start == end => {
            std::iter::once(0.0).chain(edges[1..].iter().map(|_| size)).collect()
        }
        _ => edges.iter().map(|&edge| place(edge)).collect(),
    }
}

/// For every pixel of a line the cells that share it, and their shares.
fn parts(edges: &[f64], pixels: usize) -> Vec<Vec<(usize, f64)>> {
    let mut parts = vec![Vec::new(); pixels];
    for (cell, pair) in edges.windows(2).enumerate() {
        let (from, to) = (pair[0].min(pair[1]).max(0.0), pair[0].max(pair[1]).min(pixels as f64));
        let first = from.floor() as usize;
        let touched = parts.iter_mut().enumerate().take(to.ceil() as usize).skip(first);
        for (pixel, part) in touched {
            let share = to.min(pixel as f64 + 1.0) - from.max(pixel as f64);
            if share > 0.0 {
                part.push((cell, share));
            }
        }
    }
    parts
}

fn add(sum: &mut Light, light: Light, share: f64) {
    sum.iter_mut().zip(light).for_each(|(sum, part)| *sum += share * part);
}

fn light(Colour(r, g, b): Colour) -> Light {
    [linear(f64::from(r) / 255.0), linear(f64::from(g) / 255.0), linear(f64::from(b) / 255.0), 1.0]
}

/// The curve of sRGB (IEC 61966-2-1), value 0 to 1.
fn linear(value: f64) -> f64 {
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// The way back from light to the nearest of 256 values.
struct Code([f64; 255]);

impl Code {
    fn new() -> Self {
        Self(std::array::from_fn(|i| linear((i as f64 + 0.5) / 255.0)))
    }

    fn of(&self, light: f64) -> u8 {
        self.0.partition_point(|&limit| limit < light) as u8
    }
}
