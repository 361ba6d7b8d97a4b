//! A table of points (r, f): transformed once, by (4.20), and charted.

use super::chart::{Chart, Ends, rising_cubic, value};
use super::outline::Outline;
use super::{Profile, ProfileError, Shape};
use std::sync::Arc;

/// What a panel may miss of the transform, relative to g at the last point, or more: as much as the points leave open of g themselves.
// What 200 points leave of a sphere or a fourth power. Of points that scatter by a hundredth it would take 43 panels per cell.
const TOLERANCE: f64 = 1e-10;

/// Parts between two kinks at most that a quadrature over g is parted into.
// What is not smooth at the other points is the second derivative of cubics that meet, which a part of several cells takes well; 4000
// parts take as many quadratures for the pressure at one place.
const PARTS: usize = 16;

/// Most halvings of a cell. Behind a kink and nowhere else are some needed.
const HALVINGS: u32 = 8;

impl Profile {
    /// Most points of a table: its transform takes their number squared.
    pub const MAX_POINTS: usize = 4000;

    /// A profile f(r) given by points (r, f), m, the first (0, 0), r rising and f not falling, with kinks at the radii named, each
    /// of them a point: g by the numerical transform (4.20).
    ///
    /// Between two kinks f must be smooth. It stands up to g of the last point ([`Self::reach`]). 200 even points give g of
    /// paraboloid, cone, sphere, fourth power and truncated cone to 1e-9 of its last value ([`Self::transform_error`]).
    ///
    /// # Errors
    ///
    /// With the index of the first point or kink that does not fit, or where g falls: f is too far from convex.
    pub fn table(points: &[(f64, f64)], kinks: &[f64]) -> Result<Self, ProfileError> {
        let outline = Outline::new(points, kinks)?;
        let panels = panels(&outline)?;
        let borders = borders(&outline, panels.first().map_or(0.0, |panel| panel.radius[0]));
        Ok(Self { shape: Shape::Chart(Arc::new(Chart::new(&panels, borders, Some(outline)))) })
    }

    /// How far g of a table may be off because of the distance of its points, m: an estimate from every second of them. None of
    /// every other profile.
    pub fn transform_error(&self) -> Option<f64> {
        match &self.shape {
            Shape::Chart(chart) => chart.outline().map(Outline::error),
            _ => None,
        }
    }
}

/// g at a place √(b²+w²): value and derivative to w.
#[derive(Debug, Clone, Copy)]
struct At {
    w: f64,
    /// g, m.
    height: f64,
    /// dg/dw.
    slope: f64,
}

/// A stretch of the foundation behind one kink.
struct Stretch<'a> {
    outline: &'a Outline,
    /// b, m.
    border: f64,
    /// Largest error of a panel, m.
    tolerance: f64,
}

/// The panels of all cells whose foundation does not lie flat at 0.
fn panels(outline: &Outline) -> Result<Vec<Ends>, ProfileError> {
    let radii = outline.radii();
    let end = radii[radii.len() - 1];
    let tolerance = (TOLERANCE * outline.foundation(0.0, end)[0]).max(outline.error());
    let mut panels = Vec::with_capacity(radii.len());
    let mut last = 0.0;
    for (cell, pair) in radii.windows(2).enumerate() {
        let stretch = Stretch { outline, border: outline.kink_below(cell), tolerance };
        let [from, to] = [pair[0], pair[1]].map(|x| stretch.at(stretch.w(x)));
        if to.height == 0.0 {
            continue;
        }
        if to.height <= last {
            return Err(ProfileError::NotRising { index: cell + 1, radius: pair[1] });
        }
        // As the panel before ended: by a formula behind another kink its last digit may differ.
        stretch.fill(At { height: last, ..from }, to, HALVINGS, &mut panels);
        last = to.height;
    }
    Ok(panels)
}

/// Where a quadrature over g is to be parted: at the end of the flat, at the kinks, and at some of the points between.
fn borders(outline: &Outline, flat: f64) -> Vec<f64> {
    let radii = outline.radii();
    let every = radii.len().div_ceil(PARTS);
    let last = radii.len() - 1;
    let is_kept = |(i, r): &(usize, &f64)| {
        **r > 0.0
            && *i < last
            && **r >= flat
            && (**r == flat || i % every == 0 || outline.kink_below(*i) == **r)
    };
    radii.iter().enumerate().filter(is_kept).map(|(_, r)| *r).collect()
}

impl Stretch<'_> {
    /// √(x²-b²), m.
    fn w(&self, x: f64) -> f64 {
        ((x - self.border) * (x + self.border)).sqrt()
    }

    fn at(&self, w: f64) -> At {
        if w == 0.0 && self.border == 0.0 {
            return At { w, height: 0.0, slope: self.outline.tip() };
        }
        let [height, slope] = self.outline.foundation(self.border, w);
        At { w, height, slope }
    }

    /// Both ends of a panel.
    fn ends(&self, from: At, to: At) -> Ends {
        let (b, width) = (self.border, to.w - from.w);
        let radius = [math::hypot(b, from.w), math::hypot(b, to.w)];
        Ends {
            radius,
            radius_slope: [width * from.w / radius[0].max(f64::MIN_POSITIVE), width * to.w / radius[1]]
                .map(|slope| if b == 0.0 { width } else { slope }),
            height: [from.height, to.height],
            height_slope: [width * from.slope, width * to.slope],
        }
    }

    /// One panel, or the panels of both halves where it misses too much in its middle.
    fn fill(&self, from: At, to: At, halvings: u32, panels: &mut Vec<Ends>) {
        let ends = self.ends(from, to);
        let middle = self.at(0.5 * (from.w + to.w));
        let height = value(&rising_cubic(ends.height, ends.height_slope), 0.5);
        let radius = value(&rising_cubic(ends.radius, ends.radius_slope), 0.5);
        let missed = (height - middle.height).abs();
        let aside = (radius - math::hypot(self.border, middle.w)).abs() * (to.slope * (to.w - from.w)).abs()
            / (ends.radius[1] - ends.radius[0]);
        let is_between = from.height < middle.height && middle.height < to.height;
        if halvings == 0 || missed.max(aside) <= self.tolerance || !is_between {
            panels.push(ends);
        } else {
            self.fill(from, middle, halvings - 1, panels);
            self.fill(middle, to, halvings - 1, panels);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Panels of a table.
    fn count(table: &Profile) -> usize {
        let Shape::Chart(chart) = &table.shape else { unreachable!() };
        chart.count()
    }

    #[test]
    fn points_that_scatter_take_hardly_more_panels_than_cells_and_few_borders() {
        let mut draws = 5_u64;
        let mut draw = || {
            draws = draws.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (draws >> 11) as f64 / (1_u64 << 53) as f64
        };
        for (points, scatter) in [(60, 0.01), (400, 0.1), (4000, 0.02)] {
            // A ball whose slope scatters from cell to cell.
            let (mut gap, mut table) = (0.0, vec![(0.0, 0.0)]);
            for k in 1..points {
                let r = f64::from(k) / f64::from(points);
                gap += (f64::from(k) - 0.5) * (1.0 + scatter * (draw() - 0.5)) / f64::from(points * points);
                table.push((r, gap));
            }
            let profile = Profile::table(&table, &[]).unwrap();
            let (cells, panels) = (table.len() - 1, count(&profile));
            assert!(panels >= cells && panels <= cells + cells / 20, "{cells}: {panels}");
            assert!(profile.borders().len() <= PARTS, "{}", profile.borders().len());
            // And it is still the ball: g = x² with f = r²/2.
            let error = (profile.depth(0.5) / 0.25 - 1.0).abs();
            assert!(error < 0.3 * scatter, "{points}: {error:e}");
        }
        // A kink and the end of a flat are borders, however many points there are.
        let at = |k: u32| f64::from(k) / 1000.0;
        let worn: Vec<(f64, f64)> = (0..=1000).map(|k| (at(k), (at(k) - 0.203).max(0.0))).collect();
        let worn = Profile::table(&worn, &[0.203]).unwrap();
        assert!(worn.borders().contains(&0.203) && worn.borders()[0] == 0.203, "{:?}", worn.borders());
    }
}
