//! f(r) through points, and its transform g(x) = |x|∫₀^|x| f′(r)/√(x²-r²) dr (4.20).
//!
//! Between two kinks f is smooth: cubics through the points, their slopes those of the polynomial through five points, cut to
//! what keeps f rising and, where the points are convex, between the secants on both sides. With r = x sinθ the integral is
//! ∫f′(x sinθ) dθ: the root singularity is gone, and of a cubic's f′ the integral is known. So g has the error of f′ alone, third
//! order in the distance of the points.

use super::ProfileError;

/// f between points, in cells.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Outline {
    /// Radii of the points, m, from 0 on, ascending.
    radii: Vec<f64>,
    /// f there, m.
    gaps: Vec<f64>,
    /// f′ at both ends of each cell.
    slopes: Vec<[f64; 2]>,
    /// Indices of the points at which f has a kink, ascending, neither end among them.
    kinks: Vec<usize>,
    /// How far g may be off at the points, m.
    error: f64,
}

/// Points of the polynomial whose slope is taken.
// With 200 points three leave g of a sphere up to a/R = 1/2 off by 3e-7 of its last value, five by 1.3e-10; seven gain nothing, for
// between the points f is a cubic.
const STENCIL: usize = 5;

/// What a slope is at most, of the mean slope, that is rounding.
const ROUNDING: f64 = 1e-9;

/// Share of a slope in the middle, or of its jump, by which every second point alone would have it otherwise, or every fourth, where the points
/// do not hold it: r^{4/3} and smoother, what is left of the cubics' error, and what rounding has made of measured points.
const FADES: f64 = 0.25;

impl Outline {
    /// Through points (r, f), m, with kinks at some of them.
    pub(super) fn new(points: &[(f64, f64)], kinks: &[f64]) -> Result<Self, ProfileError> {
        check(points)?;
        let (radii, gaps): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        let mut at: Vec<usize> = Vec::with_capacity(kinks.len());
        for (index, &kink) in kinks.iter().enumerate() {
            // As it stands in the list, but for the last digit of a unit.
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
        // Of fewer points no more is known.
        let twice = (outline.radii.len() > 4 * STENCIL).then(|| thinned.thinned());
        outline.smooth(&[Some(&thinned), twice.as_ref()]);
        outline.error = outline.distance(&thinned);
        Ok(outline)
    }

    /// Takes tips and edges away that are not in the points but in what is made of them: slopes that are rounding, or that every second or
    /// every fourth point would have quite different.
    // Left in, they are no more than the error of g, but a pressure without bound: that of a table of r²/2R at every second distance of
    // points, and of a sphere's at most.
    fn smooth(&mut self, thinned: &[Option<&Self>; 2]) {
        let mean = self.gaps[self.gaps.len() - 1] / self.radii[self.radii.len() - 1];
        // Of rⁿ half the distance takes 2ⁿ⁻¹ from the slope, of a tip it leaves what is there.
        let fades = |own: f64, coarse: &dyn Fn(&Self) -> f64| {
            let differs = |other: &Self| (coarse(other) - own).abs() >= FADES * own.abs();
            own.abs() <= ROUNDING * mean || thinned.iter().flatten().any(|other| differs(other))
        };
        let (_, secant, [tip, _]) = self.cell(0);
        // Where the points bend down from the first it is a tip they show.
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

    /// The same through every second point between two kinks.
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

    /// Radii of the points, m.
    pub(super) fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// Radius of the last kink at or below the start of a cell, m; 0 where there is none.
    pub(super) fn kink_below(&self, cell: usize) -> f64 {
        self.kinks.iter().rev().find(|kink| **kink <= cell).map_or(0.0, |kink| self.radii[*kink])
    }

    /// f(r), m; none beyond the last point.
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

    /// dg/dx in the middle: (π/2)f′(0).
    pub(super) fn tip(&self) -> f64 {
        std::f64::consts::FRAC_PI_2 * self.slopes[0][0]
    }

    /// Whether f has a tip or an edge: a slope in the middle, or one that jumps upwards.
    pub(super) fn has_edges(&self) -> bool {
        self.slopes[0][0] > 0.0 || self.kinks.iter().any(|&kink| self.jump(kink) > 0.0)
    }

    /// How much f′ jumps at a kink.
    fn jump(&self, kink: usize) -> f64 {
        self.slopes[kink][0] - self.slopes[kink - 1][1]
    }

    /// Width (m), secant and slopes of a cell.
    fn cell(&self, cell: usize) -> (f64, f64, [f64; 2]) {
        let width = self.radii[cell + 1] - self.radii[cell];
        (width, (self.gaps[cell + 1] - self.gaps[cell]) / width, self.slopes[cell])
    }

    /// g (m) at x = √(b²+w²) > 0 and its derivative to w, b the radius of a kink (or 0) below x and none between them.
    pub(super) fn foundation(&self, b: f64, w: f64) -> [f64; 2] {
        let x = math::hypot(b, w);
        let (mut mean, mut bend) = (0.0, 0.0);
        let mut from = (0.0, 1.0, 0.0);
        for (cell, &start) in self.radii.iter().enumerate().take(self.slopes.len()) {
            if start >= x {
                break;
            }
            let end = self.radii[cell + 1].min(x);
            // At the border itself w says more than x does.
            let cosine = if end == b { w / x } else { ((x - end) * (x + end)).max(0.0).sqrt() / x };
            let (sine, angle) = (end / x, math::atan2(end / x, cosine));
            let to = (sine, cosine, angle);
            let (width, rise, [low, high]) = self.cell(cell);
            let (first, second) = (6.0 * rise - 4.0 * low - 2.0 * high, 3.0 * (low + high) - 6.0 * rise);
            // ∫dθ, ∫sinθ dθ and ∫sin²θ dθ.
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
            // d/dw of a jump's x arccos(r/x): r/√(x²-r²) w/x.
            let share = if r == b { 1.0 } else { w / ((x - r) * (x + r)).sqrt() };
            slope += self.jump(kink) * (r / x) * share;
        }
        [x * mean, slope]
    }

    /// How far g may be off at the points, m: what is left of the difference to g through every second point, at third order.
    pub(super) fn error(&self) -> f64 {
        self.error
    }

    /// That of a thinned one.
    fn distance(&self, thinned: &Self) -> f64 {
        let at = |x: &f64| (self.foundation(0.0, *x)[0] - thinned.foundation(0.0, *x)[0]).abs();
        thinned.radii[1..].iter().map(at).fold(0.0, f64::max) / 7.0
    }
}

/// The first thing wrong with a table, if anything is.
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
    // It is 0 or rises: something must touch in the end.
    if points[points.len() - 1].1 > 0.0 { Ok(()) } else { Err(ProfileError::NoRise) }
}

/// f′ at both ends of each cell.
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

/// f′ at the points of a span without a kink inside.
fn in_span(radii: &[f64], gaps: &[f64]) -> Vec<f64> {
    let last = radii.len() - 1;
    let secant = |cell: usize| (gaps[cell + 1] - gaps[cell]) / (radii[cell + 1] - radii[cell]);
    let at = |i: usize| {
        let first = i.saturating_sub(STENCIL / 2).min((last + 1).saturating_sub(STENCIL));
        let window = first..(first + STENCIL).min(last + 1);
        let slope = derivative(&radii[window.clone()], &gaps[window], i - first);
        // Three secants at most keep f from falling inside a cell.
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

/// Slope at point j of the polynomial through all points, by its barycentric weights (Berrut and Trefethen, SIAM Review 46, 2004).
fn derivative(x: &[f64], y: &[f64], j: usize) -> f64 {
    let weight = |k: usize| {
        let others = x.iter().enumerate().filter(|(i, _)| *i != k);
        1.0 / others.map(|(_, other)| x[k] - other).product::<f64>()
    };
    let own = weight(j);
    let part = |k: usize| weight(k) / own * (y[k] - y[j]) / (x[j] - x[k]);
    (0..x.len()).filter(|k| *k != j).map(part).sum()
}
