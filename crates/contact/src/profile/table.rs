//! A table of points (r, f): transformed once, by (4.20), and charted.

use super::chart::{Chart, Ends, rising_cubic, value};
use super::outline::Outline;
use super::{Profile, ProfileError, Shape};
use std::sync::Arc;

/// What a panel may miss of the transform, relative to g at the last point.
// What 200 points leave of a sphere or a fourth power.
const TOLERANCE: f64 = 1e-10;

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
        Ok(Self { shape: Shape::Chart(Arc::new(Chart::new(&panels, Some(outline)))) })
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
    let tolerance = TOLERANCE * outline.foundation(0.0, end)[0];
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
        let radius = [b.hypot(from.w), b.hypot(to.w)];
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
        let aside = (radius - self.border.hypot(middle.w)).abs() * (to.slope * (to.w - from.w)).abs()
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
