//! Profile given by a table of points (r, f), transformed numerically by (4.20).

use super::chart::{Chart, Ends, rising_cubic, value};
use super::outline::Outline;
use super::{Profile, ProfileError, Shape};
use std::sync::Arc;

/// Largest error of a panel, relative to g at the last point. A larger error of the points themselves replaces this limit.
// The value is the error of 200 points of a sphere. For noisy points it would need many panels per cell.
const TOLERANCE: f64 = 1e-10;

/// Largest number of parts between two kinks into which a quadrature over g is split.
// At other points only the second derivative of the cubics jumps, and a part may span several of them.
const PARTS: usize = 16;

/// Largest number of bisections of a cell, needed only beyond a kink.
const HALVINGS: u32 = 8;

impl Profile {
    /// Largest number of points of a table. The cost of the transform is proportional to its square.
    pub const MAX_POINTS: usize = 4000;

    /// Creates a profile f(r) from points (r, f), m, by the numerical transform (4.20).
    ///
    /// The first point is (0, 0); r increases and f does not decrease. `kinks` are radii of points at which f has a kink. Between two
    /// kinks f must be smooth. The profile ends at g of the last point ([`Self::reach`]). 200 equidistant points give g of a
    /// paraboloid, cone, sphere, fourth power and truncated cone to 1e-9 of its last value ([`Self::transform_error`]).
    ///
    /// # Errors
    ///
    /// Returns the index of the first invalid point or kink. Fails also if g decreases, because f is too far from convex.
    pub fn table(points: &[(f64, f64)], kinks: &[f64]) -> Result<Self, ProfileError> {
        let outline = Outline::new(points, kinks)?;
        let panels = panels(&outline)?;
        let borders = borders(&outline, panels.first().map_or(0.0, |panel| panel.radius[0]));
        Ok(Self { shape: Shape::Chart(Arc::new(Chart::new(&panels, borders, Some(outline)))) })
    }

    /// Returns the estimated error of g due to the distance of the points, m; `None` for a profile that is no table.
    pub fn transform_error(&self) -> Option<f64> {
        match &self.shape {
            Shape::Chart(chart) => chart.outline().map(Outline::error),
            _ => None,
        }
    }
}

/// Value of g at √(b²+w²) and its derivative with respect to w.
#[derive(Debug, Clone, Copy)]
struct At {
    w: f64,
    /// Height g, m.
    height: f64,
    /// Derivative dg/dw.
    slope: f64,
}

/// Part of the foundation beyond one kink.
struct Stretch<'a> {
    outline: &'a Outline,
    /// Radius b of the kink, m.
    border: f64,
    /// Largest error of a panel, m.
    tolerance: f64,
}

/// Returns the panels of all cells in which g is above 0.
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
        // The panel begins with the end height of the previous panel, which may differ in the last digit.
        stretch.fill(At { height: last, ..from }, to, HALVINGS, &mut panels);
        last = to.height;
    }
    Ok(panels)
}

/// Returns the radii at which a quadrature over g must be split: the end of the flat, the kinks, and some other points.
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
    /// Returns √(x²-b²), m.
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

    /// Returns the values at both ends of a panel.
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

    /// Adds one panel. If the error in the middle of the panel is too large, adds the panels of both halves instead.
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

    /// Number of panels of a table.
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
            // Paraboloid with a random slope error in each cell.
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
            // The table still approximates the paraboloid: g = x² with f = r²/2.
            let error = (profile.depth(0.5) / 0.25 - 1.0).abs();
            assert!(error < 0.3 * scatter, "{points}: {error:e}");
        }
        // A kink and the end of a flat are borders for any number of points.
        let at = |k: u32| f64::from(k) / 1000.0;
        let worn: Vec<(f64, f64)> = (0..=1000).map(|k| (at(k), (at(k) - 0.203).max(0.0))).collect();
        let worn = Profile::table(&worn, &[0.203]).unwrap();
        assert!(worn.borders().contains(&0.203) && worn.borders()[0] == 0.203, "{:?}", worn.borders());
    }
}
