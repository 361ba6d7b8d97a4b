//! Gap f(r) through points, and its transform g(x) = |x|∫₀^|x| f′(r)/√(x²-r²) dr (4.20).
//!
//! Between two kinks f is a smooth sequence of cubics. The slopes at the points are those of a polynomial through five points, limited so
//! that f does not decrease. Where the points are convex, each slope is between the secants on both sides. With r = x sinθ the transform is
//! ∫f′(x sinθ) dθ, which has a closed form for a cubic. The error of g is that of f′, of third order in the distance of the points.

use super::ProfileError;

/// Gap f(r) between points, as one cubic per cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Outline {
    /// Radii of the points, m, from 0, ascending.
    radii: Vec<f64>,
    /// Gap f at the points, m.
    gaps: Vec<f64>,
    /// Slopes f′ at both ends of each cell.
    slopes: Vec<[f64; 2]>,
    /// Indices of the inner points at which f has a kink, ascending.
    kinks: Vec<usize>,
    /// Estimated error of g at the points, m.
    error: f64,
}

/// Number of points of the polynomial that gives the slope.
// Three points are less accurate; seven are no better, because f is a cubic between the points.
const STENCIL: usize = 5;

/// Slope, relative to the mean slope, below which a slope is treated as rounding.
const ROUNDING: f64 = 1e-9;

/// Relative change at which a tip or an edge counts as an artefact of the interpolation.
///
/// The slope in the centre, or the jump of the slope at a kink, is compared with the value from every second or every fourth point.
const FADES: f64 = 0.25;

impl Outline {
    /// Creates the interpolation of points (r, f), m, with kinks at some of them.
    pub(super) fn new(points: &[(f64, f64)], kinks: &[f64]) -> Result<Self, ProfileError> {
        check(points)?;
        let (radii, gaps): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        let mut at: Vec<usize> = Vec::with_capacity(kinks.len());
        for (index, &kink) in kinks.iter().enumerate() {
            // A kink must equal a radius of the list, except for rounding.
            let near = |r: &f64| (r - kink).abs() <= 1e-12 * kink.abs();
            match radii.iter().position(near) {
                Some(place) if place > 0 && place + 1 < radii.len() => at.push(place),
                _ => return Err(ProfileError::Kink { index, value: kink }),
            }
        }
        at.sort_unstable();
        at.dedup();
        let slopes = slopes(&radii, &gaps, &at);
        let mut outline = Self { radii, gaps, slopes, kinks: at, error: 0.0 };
        let thinned = outline.thinned();
        // With few points this comparison is not possible.
        let twice = (outline.radii.len() > 4 * STENCIL).then(|| thinned.thinned());
        outline.smooth(&[Some(&thinned), twice.as_ref()]);
        outline.error = outline.distance(&thinned);
        Ok(outline)
    }

    /// Removes tips and edges that are artefacts of the interpolation.
    ///
    /// A slope in the centre or a jump at a kink is an artefact if its size is within rounding. A slope is also an artefact if every second
    /// or fourth point gives a much different value.
    // A remaining artefact would cause an unbounded pressure, although g has only a small error.
    fn smooth(&mut self, thinned: &[Option<&Self>; 2]) {
        let mean = self.gaps[self.gaps.len() - 1] / self.radii[self.radii.len() - 1];
        // Half the distance changes the slope of rⁿ by a factor 2ⁿ⁻¹, but not that of a real tip.
        let fades = |own: f64, coarse: &dyn Fn(&Self) -> f64| {
            let differs = |other: &Self| (coarse(other) - own).abs() >= FADES * own.abs();
            own.abs() <= ROUNDING * mean || thinned.iter().flatten().any(|other| differs(other))
        };
        let (_, secant, [tip, _]) = self.cell(0);
        // If the points bend down from the first one, the tip is real.
        let bends_up = self.gaps.len() > 2 && self.cell(1).1 >= secant;
        if bends_up && fades(tip, &|other| other.slopes[0][0]) {
            self.slopes[0][0] = 0.0;
        }
        for i in 0..self.kinks.len() {
            let kink = self.kinks[i];
            let coarse = |other: &Self| other.kinks.get(i).map_or(0.0, |kink| other.jump(*kink));
            if fades(self.jump(kink), &coarse) {
                let limit = 3.0 * self.cell(kink - 1).1.min(self.cell(kink).1);
                let slope = (0.5 * (self.slopes[kink - 1][1] + self.slopes[kink][0])).min(limit);
                (self.slopes[kink - 1][1], self.slopes[kink][0]) = (slope, slope);
            }
        }
    }

    /// Returns the interpolation through every second point between two kinks.
    fn thinned(&self) -> Self {
        let mut ends = vec![0];
        ends.extend(&self.kinks);
        ends.push(self.radii.len() - 1);
        let mut kept = vec![0];
        for span in ends.windows(2) {
            kept.extend((span[0] + 1..=span[1]).filter(|i| (i - span[0]) % 2 == 0 || *i == span[1]));
        }
        let (radii, gaps): (Vec<f64>, Vec<f64>) = kept.iter().map(|&i| (self.radii[i], self.gaps[i])).unzip();
        let kinks: Vec<usize> = self.kinks.iter().filter_map(|kink| kept.binary_search(kink).ok()).collect();
        let slopes = slopes(&radii, &gaps, &kinks);
        Self { radii, gaps, slopes, kinks, error: 0.0 }
    }

    /// Returns the radii of the points, m.
    pub(super) fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// Returns the radius of the last kink at or below the start of a cell, m; 0 if there is none.
    pub(super) fn kink_below(&self, cell: usize) -> f64 {
        self.kinks.iter().rev().find(|kink| **kink <= cell).map_or(0.0, |kink| self.radii[*kink])
    }

    /// Returns the gap f(r), m; `None` beyond the last point.
    pub(super) fn gap(&self, r: f64) -> Option<f64> {
        let end = *self.radii.last()?;
        if r > end {
            return None;
        }
        let cell = self.radii.partition_point(|radius| *radius <= r).clamp(1, self.slopes.len()) - 1;
        let (width, rise, [start, end]) = self.cell(cell);
        let u = (r - self.radii[cell]) / width;
        let cubic = u * (3.0 * rise - 2.0 * start - end + u * (start + end - 2.0 * rise));
        Some(self.gaps[cell] + width * u * (start + cubic))
    }

    /// Returns dg/dx in the centre: (π/2)f′(0).
    pub(super) fn tip(&self) -> f64 {
        std::f64::consts::FRAC_PI_2 * self.slopes[0][0]
    }

    /// Returns whether f has a tip or an edge: a slope in the centre, or an upward jump of the slope.
    pub(super) fn has_edges(&self) -> bool {
        self.slopes[0][0] > 0.0 || self.kinks.iter().any(|&kink| self.jump(kink) > 0.0)
    }

    /// Returns the jump of f′ at a kink.
    fn jump(&self, kink: usize) -> f64 {
        self.slopes[kink][0] - self.slopes[kink - 1][1]
    }

    /// Returns width (m), secant and end slopes of a cell.
    fn cell(&self, cell: usize) -> (f64, f64, [f64; 2]) {
        let width = self.radii[cell + 1] - self.radii[cell];
        (width, (self.gaps[cell + 1] - self.gaps[cell]) / width, self.slopes[cell])
    }

    /// Returns g (m) at x = √(b²+w²) > 0 and its derivative with respect to w. b is the radius of the last kink below x, or 0.
    pub(super) fn foundation(&self, b: f64, w: f64) -> [f64; 2] {
        let x = math::hypot(b, w);
        let (mut mean, mut bend) = (0.0, 0.0);
        let mut from = (0.0, 1.0, 0.0);
        for (cell, &start) in self.radii.iter().enumerate().take(self.slopes.len()) {
            if start >= x {
                break;
            }
            let end = self.radii[cell + 1].min(x);
            // At the border, w is more accurate than x.
            let cosine = if end == b { w / x } else { ((x - end) * (x + end)).max(0.0).sqrt() / x };
            let (sine, angle) = (end / x, math::atan2(end / x, cosine));
            let to = (sine, cosine, angle);
            let (width, rise, [low, high]) = self.cell(cell);
            let (first, second) = (6.0 * rise - 4.0 * low - 2.0 * high, 3.0 * (low + high) - 6.0 * rise);
            // Integrals ∫dθ, ∫sinθ dθ and ∫sin²θ dθ.
            let whole = to.2 - from.2;
            let sines = from.1 - to.1;
            let squares = 0.5 * (whole - (to.0 * to.1 - from.0 * from.1));
            let (at, by) = (start / width, x / width);
            let once = by * sines - at * whole;
            let twice = by * (by * squares - 2.0 * at * sines) + at * at * whole;
            mean += low * whole + first * once + second * twice;
            bend += by * (first * sines + 2.0 * second * (by * squares - at * sines));
            from = to;
        }
        let mut slope = (mean + bend) * (w / x);
        for &kink in &self.kinks {
            let r = self.radii[kink];
            if r > b || r >= x {
                break;
            }
            // Derivative of x arccos(r/x) with respect to w: r/√(x²-r²) w/x.
            let share = if r == b { 1.0 } else { w / ((x - r) * (x + r)).sqrt() };
            slope += self.jump(kink) * (r / x) * share;
        }
        [x * mean, slope]
    }

    /// Returns the estimated error of g at the points, m. The estimate compares all points with every second point at third order.
    pub(super) fn error(&self) -> f64 {
        self.error
    }

    /// Computes the error estimate from a thinned interpolation.
    fn distance(&self, thinned: &Self) -> f64 {
        let at = |x: &f64| (self.foundation(0.0, *x)[0] - thinned.foundation(0.0, *x)[0]).abs();
        thinned.radii[1..].iter().map(at).fold(0.0, f64::max) / 7.0
    }
}

/// Returns the first error in a table of points.
fn check(points: &[(f64, f64)]) -> Result<(), ProfileError> {
    if points.len() < 2 {
        return Err(ProfileError::Points(points.len()));
    }
    if points.len() > super::Profile::MAX_POINTS {
        return Err(ProfileError::TooMany(points.len()));
    }
    if points[0] != (0.0, 0.0) {
        return Err(ProfileError::Origin { radius: points[0].0, value: points[0].1 });
    }
    for (i, pair) in points.windows(2).enumerate() {
        let (width, rise) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        if !(width > 0.0 && width.is_finite()) {
            return Err(ProfileError::Order { index: i + 1 });
        }
        if !(rise >= 0.0 && (rise / width).is_finite()) {
            return Err(ProfileError::Fall { index: i + 1 });
        }
    }
    // The gap must be above 0 somewhere.
    if points[points.len() - 1].1 > 0.0 { Ok(()) } else { Err(ProfileError::NoRise) }
}

/// Returns f′ at both ends of each cell.
fn slopes(radii: &[f64], gaps: &[f64], kinks: &[usize]) -> Vec<[f64; 2]> {
    let mut slopes = Vec::with_capacity(radii.len() - 1);
    let mut from = 0;
    for to in kinks.iter().copied().chain([radii.len() - 1]) {
        let at = in_span(&radii[from..=to], &gaps[from..=to]);
        slopes.extend(at.windows(2).map(|pair| [pair[0], pair[1]]));
        from = to;
    }
    slopes
}

/// Returns f′ at the points of a range without a kink inside.
fn in_span(radii: &[f64], gaps: &[f64]) -> Vec<f64> {
    let last = radii.len() - 1;
    let secant = |cell: usize| (gaps[cell + 1] - gaps[cell]) / (radii[cell + 1] - radii[cell]);
    let at = |i: usize| {
        let first = i.saturating_sub(STENCIL / 2).min((last + 1).saturating_sub(STENCIL));
        let window = first..(first + STENCIL).min(last + 1);
        let slope = derivative(&radii[window.clone()], &gaps[window], i - first);
        // A slope of at most three secants keeps f from decreasing within a cell.
        if i == 0 {
            let (own, next) = (secant(0), secant(1.min(last - 1)));
            return if next >= own { slope.clamp(0.0, own) } else { slope.clamp(own, 3.0 * own) };
        }
        if i == last {
            let (own, before) = (secant(last - 1), secant(last.saturating_sub(2)));
            return if before <= own { slope.clamp(own, 3.0 * own) } else { slope.clamp(0.0, own) };
        }
        let (left, right) = (secant(i - 1), secant(i));
        slope.clamp(left.min(right), left.max(right)).min(3.0 * left.min(right))
    };
    (0..=last).map(at).collect()
}

/// Returns the slope at point j of the polynomial through all points, by barycentric weights (Berrut and Trefethen, SIAM Review 46,
/// 2004).
fn derivative(x: &[f64], y: &[f64], j: usize) -> f64 {
    let weight = |k: usize| {
        let others = x.iter().enumerate().filter(|(i, _)| *i != k);
        1.0 / others.map(|(_, other)| x[k] - other).product::<f64>()
    };
    let own = weight(j);
    let part = |k: usize| weight(k) / own * (y[k] - y[j]) / (x[j] - x[k]);
    (0..x.len()).filter(|k| *k != j).map(part).sum()
}
