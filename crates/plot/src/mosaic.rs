//! Mosaics as images: cells of a few classes, mixed by area where a pixel contains several.

use crate::palette::{Word, word};
use crate::panel::{Axis, Mosaic};
use crate::scale::Scale;
use crate::theme::{Colour, Theme};

/// RGB image, row by row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Image {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Red, green and blue of each pixel.
    pub(crate) rgb: Vec<u8>,
}

impl Image {
    /// Returns the colour of each pixel, row by row.
    pub(crate) fn colours(&self) -> impl Iterator<Item = Word> + Clone + '_ {
        self.rgb.chunks_exact(3).map(|c| word([c[0], c[1], c[2]]))
    }
}

/// Linear-light red, green and blue, and the covered area.
type Light = [f64; 4];

impl Mosaic<'_> {
    /// Returns the edges of the columns in axis coordinates, one more than columns.
    pub(crate) fn column_edges(&self, axis: &Axis) -> Vec<f64> {
        edges(&laid_off(&self.xs, axis), 0.0)
    }

    /// Returns the edges of the rows in axis coordinates, one more than rows.
    pub(crate) fn row_edges(&self, axis: &Axis) -> Vec<f64> {
        edges(&laid_off(&self.ys, axis), 0.5)
    }

    /// Renders the mosaic for a frame. A pixel that several cells share mixes their colours in linear light by area,
    /// which avoids aliasing.
    pub(crate) fn image(
        &self,
        [(across, x), (upwards, y)]: [(&Axis, &Scale); 2],
        (width, height): (usize, usize),
        theme: &Theme,
    ) -> Image {
        let (w, h) = (width as f64, height as f64);
        let columns = parts(&pixels(&self.column_edges(across), |edge| w * x.place(edge), w), width);
        let rows = parts(&pixels(&self.row_edges(upwards), |edge| h * (1.0 - y.place(edge)), h), height);
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

/// Returns the positions in axis coordinates.
fn laid_off(places: &[f64], axis: &Axis) -> Vec<f64> {
    places.iter().map(|place| axis.measure(*place)).collect()
}

/// Returns the cell borders: midpoints between positions, and two outer borders at `beyond` times the distance of the next two positions.
fn edges(places: &[f64], beyond: f64) -> Vec<f64> {
    let [first, second, ..] = places else { return [places, places].concat() };
    let [.., before, last] = places else { return Vec::new() };
    let middles = places.windows(2).map(|pair| pair[0] / 2.0 + pair[1] / 2.0);
    let start = first - beyond * (second - first);
    std::iter::once(start).chain(middles).chain([last + beyond * (last - before)]).collect()
}

/// Returns the edges in pixels. A single cell without width fills the frame.
fn pixels(edges: &[f64], place: impl Fn(f64) -> f64, size: f64) -> Vec<f64> {
    match edges {
        [start, .., end] if start == end => {
            std::iter::once(0.0).chain(edges[1..].iter().map(|_| size)).collect()
        }
        _ => edges.iter().map(|&edge| place(edge)).collect(),
    }
}

/// Returns for each pixel of a line the cells that cover it, with the covered fractions.
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

/// Applies the transfer function of sRGB (IEC 61966-2-1), from a value in 0 to 1 to linear light.
fn linear(value: f64) -> f64 {
    if value <= 0.040_45 { value / 12.92 } else { math::powf((value + 0.055) / 1.055, 2.4) }
}

/// Inverse of the transfer function, to the nearest of 256 values.
struct Code([f64; 255]);

impl Code {
    fn new() -> Self {
        Self(std::array::from_fn(|i| linear((i as f64 + 0.5) / 255.0)))
    }

    fn of(&self, light: f64) -> u8 {
        self.0.partition_point(|&limit| limit < light) as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ink, Label};
    use proptest::prelude::*;

    fn mosaic(columns: usize, rows: usize, cells: Vec<u8>) -> Mosaic<'static> {
        let places = |count: usize| (0..count).map(|i| i as f64).collect::<Vec<f64>>().into();
        let classes = (0..4).map(|i| (Label::default(), Ink::Shade(i))).collect();
        Mosaic { xs: places(columns), ys: places(rows), cells: cells.into(), classes }
    }

    /// Renders a mosaic that exactly fills the frame.
    fn image(mosaic: &Mosaic<'_>, size: (usize, usize)) -> Image {
        let scale = |edges: Vec<f64>| {
            let ends = edges.first().copied().zip(edges.last().copied());
            Scale::new(&Axis::default(), ends.map(|(a, b)| if a < b { (a, b) } else { (a - 1.0, b + 1.0) }))
        };
        let (axis, [x, y]) =
            (Axis::default(), [mosaic.column_edges(&Axis::default()), mosaic.row_edges(&Axis::default())]);
        mosaic.image([(&axis, &scale(x)), (&axis, &scale(y))], size, &Theme::light())
    }

    fn pixels(image: &Image, shade: usize) -> usize {
        let Colour(r, g, b) = Theme::light().shades[shade];
        image.rgb.chunks_exact(3).filter(|pixel| **pixel == [r, g, b]).count()
    }

    #[test]
    fn cells_of_whole_pixels_are_counted_in_pixels() {
        // Five positions span four distances: inner columns are 30 px wide, outer ones 15 px. Three rows of 20 px.
        let cells = [[0, 1, 2], [1, 1, 2], [3, 3, 3], [0, 0, 2], [2, 0, 1]].concat();
        let image = image(&mosaic(5, 3, cells), (120, 60));
        let counted = [0, 1, 2, 3].map(|shade| pixels(&image, shade));
        assert_eq!(counted, [15 + 30 + 30 + 15, 15 + 60 + 15, 15 + 30 + 30 + 15, 90].map(|width| 20 * width));
        // The first row lies at the bottom.
        let Colour(r, g, b) = Theme::light().shades[2];
        assert_eq!(image.rgb[..3], [r, g, b]);
    }

    #[test]
    fn a_train_finer_than_pixels_shows_neither_beats_nor_gaps() {
        // Stick and slip alternate 7.3 times per pixel: all pixels have the same mixture, and none has a pure class colour.
        let columns = 7300;
        let cells = (0..columns).map(|i| 1 + u8::from(i % 2 == 0)).collect();
        let image = image(&mosaic(columns, 1, cells), (1000, 1));
        for channel in 0..3 {
            let values = image.rgb.chunks_exact(3).map(|pixel| pixel[channel]);
            let (low, high) = values.fold((255, 0), |(low, high), v| (v.min(low), v.max(high)));
            assert!(high - low <= 20, "{low} to {high}");
        }
        assert_eq!(pixels(&image, 1) + pixels(&image, 2), 0);
    }

    #[test]
    fn one_moment_fills_the_frame() {
        let image = image(&mosaic(1, 2, vec![3, 1]), (50, 40));
        assert_eq!([pixels(&image, 3), pixels(&image, 1)], [1000, 1000]);
    }

    proptest! {
        /// The total light equals that of the cells by area, for any pixel grid.
        #[test]
        fn light_is_kept(
            (columns, rows, cells) in (2..60_usize, 2..20_usize)
                .prop_flat_map(|(c, r)| (Just(c), Just(r), proptest::collection::vec(0..4_u8, c * r))),
            size in (5..90_usize, 5..40_usize),
        ) {
            let mosaic = mosaic(columns, rows, cells.clone());
            let drawn = image(&mosaic, size);
            let shades = Theme::light().shades.map(light);
            for channel in 0..3 {
                let sum: f64 = drawn.rgb.chunks_exact(3).map(|pixel| linear(f64::from(pixel[channel]) / 255.0)).sum();
                let area = |column: usize| if column == 0 || column == columns - 1 { 0.5 } else { 1.0 };
                let lit = cells.iter().enumerate().map(|(i, &class)| area(i / rows) * shades[usize::from(class)][channel]);
                let expected = lit.sum::<f64>() / (rows * (columns - 1)) as f64;
                // One code step is at most 0.009 of full light; rounding errors are half of that.
                prop_assert!((sum / (size.0 * size.1) as f64 - expected).abs() < 0.0045);
            }
        }
    }
}
