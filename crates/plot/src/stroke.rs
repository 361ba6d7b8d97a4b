//! Anti-aliased strokes with round ends and joins, from the distance of each pixel to the line.
//!
//! A pixel is blended by the fraction that the line covers. The fraction is exact for lines along the axes, otherwise accurate to a few
//! hundredths. For curves of thousands of points this is faster than filling outlines.

/// Number of coverage levels, kept small because each level is a colour of the palette.
const LEVELS: f32 = 16.0;

/// Coverage of the pixels by one line at a time.
pub(crate) struct Coverage {
    width: usize,
    /// Coverage levels, row by row; 0 everywhere between two lines.
    levels: Vec<u8>,
    /// First pixel that the line touches in each row, and the pixel after the last touched one.
    touched: Vec<(usize, usize)>,
}

impl Coverage {
    /// Creates the coverage for a picture size.
    pub(crate) fn new((width, height): (u32, u32)) -> Self {
        let (width, height) = (width as usize, height as usize);
        Self { width, levels: vec![0; width * height], touched: vec![NOWHERE; height] }
    }

    /// Draws a polyline of a width in px. Passes the index and covered fraction of each touched pixel to `blend`.
    pub(crate) fn draw(&mut self, points: &[(f32, f32)], width: f32, mut blend: impl FnMut(usize, f32)) {
        match points {
            [] => return,
            [only] => self.piece([*only, *only], width),
            _ => points.windows(2).for_each(|pair| self.piece([pair[0], pair[1]], width)),
        }
        for (row, touched) in self.touched.iter_mut().enumerate() {
            let (from, to) = std::mem::replace(touched, NOWHERE);
            if from < to {
                let start = row * self.width;
                for (place, level) in self.levels[start + from..start + to].iter_mut().enumerate() {
                    if *level > 0 {
                        blend(start + from + place, f32::from(*level) / LEVELS);
                        *level = 0;
                    }
                }
            }
        }
    }

    /// Adds one line segment. Where several segments cover a pixel, the largest coverage counts.
    fn piece(&mut self, [(x0, y0), (x1, y1)]: [(f32, f32); 2], width: f32) {
        let (dx, dy) = (x1 - x0, y1 - y0);
        let square = dx * dx + dy * dy;
        let (length, inverse) = (square.sqrt(), if square > 0.0 { square.recip() } else { 0.0 });
        // Pixels with centres farther away are not touched.
        let reach = width / 2.0 + 0.5;
        let rows = within((y0.min(y1) - reach, y0.max(y1) + reach), self.touched.len());
        let ends = (x0.min(x1) - reach, x0.max(x1) + reach);
        for row in rows.0..rows.1 {
            let y = row as f32 + 0.5 - y0;
            // Range of the row inside the strip along the line.
            let (mut from, mut to) = ends;
            if dy.abs() > 0.01 * length {
                let (middle, half) = (x0 + y * dx / dy, reach * length / dy.abs());
                (from, to) = (from.max(middle - half), to.min(middle + half));
            }
            let (from, to) = within((from, to), self.width);
            if from >= to {
                continue;
            }
            let touched = &mut self.touched[row];
            *touched = (touched.0.min(from), touched.1.max(to));
            let levels = &mut self.levels[row * self.width + from..row * self.width + to];
            for (place, level) in levels.iter_mut().enumerate() {
                let x = (from + place) as f32 + 0.5 - x0;
                let along = ((x * dx + y * dy) * inverse).clamp(0.0, 1.0);
                let (away_x, away_y) = (x - along * dx, y - along * dy);
                let distance = (away_x * away_x + away_y * away_y).sqrt();
                let covered = (reach - distance).min(width).clamp(0.0, 1.0);
                *level = (*level).max((covered * LEVELS + 0.5) as u8);
            }
        }
    }
}

/// Range without pixels.
const NOWHERE: (usize, usize) = (usize::MAX, 0);

/// Returns the range of the pixels with centres between two positions, of `count` pixels.
fn within((from, to): (f32, f32), count: usize) -> (usize, usize) {
    // Float-to-integer casts saturate.
    ((from - 0.5).ceil() as usize, (((to - 0.5).floor() + 1.0) as usize).min(count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    fn drawn(points: &[(f32, f32)], width: f32) -> HashMap<(usize, usize), f32> {
        let mut covered = HashMap::new();
        Coverage::new((40, 30)).draw(points, width, |place, share| {
            assert!(covered.insert((place % 40, place / 40), share).is_none(), "a pixel is blended once");
        });
        covered
    }

    #[test]
    fn a_level_line_covers_its_area() {
        // From y = 8.75 to 11.25: rows 9 and 10 are covered fully, rows 8 and 11 by a quarter.
        for points in [[(5.0, 10.0), (25.0, 10.0)], [(25.0, 10.0), (5.0, 10.0)]] {
            let covered = drawn(&points, 2.5);
            let column = |y| covered.get(&(15, y)).copied().unwrap_or(0.0);
            assert_eq!([7, 8, 9, 10, 11, 12].map(column), [0.0, 0.25, 1.0, 1.0, 0.25, 0.0]);
        }
        // Line thinner than a pixel, in the middle of one.
        let covered = drawn(&[(10.5, 5.0), (10.5, 20.0)], 0.25);
        assert_eq!([9, 10, 11].map(|x| covered.get(&(x, 12)).copied().unwrap_or(0.0)), [0.0, 0.25, 0.0]);
    }

    #[test]
    fn a_stroke_covers_as_much_as_its_outline_holds() {
        // Rectangle with a half disc at both ends: area wl + πw²/4 for any direction.
        for (x, y) in [(32.0, 9.0), (9.0, 25.0), (30.0, 27.0), (8.0, 24.0)] {
            let (from, width) = ((7.3_f32, 6.1_f32), 3.6_f32);
            let length = (x - from.0).hypot(y - from.1);
            let area = width * length + std::f32::consts::PI * width * width / 4.0;
            let covered: f32 = drawn(&[from, (x, y)], width).values().sum();
            assert!((covered / area - 1.0).abs() < 0.02, "{covered} of {area}");
        }
    }

    #[test]
    fn what_lies_outside_is_left_out_and_pieces_do_not_add_up() {
        assert!(drawn(&[(-50.0, -9.0), (-3.0, 70.0)], 3.0).is_empty());
        assert!(drawn(&[(-50.0, 15.0), (90.0, 15.0)], 3.0).keys().all(|&(x, y)| x < 40 && y < 30));
        let once = drawn(&[(5.0, 5.3), (30.0, 21.0)], 3.0);
        assert_eq!(once, drawn(&[(5.0, 5.3), (30.0, 21.0), (5.0, 5.3)], 3.0));
        assert_eq!(drawn(&[(10.0, 10.0)], 4.0).len(), drawn(&[(10.0, 10.0); 3], 4.0).len());
    }
}
