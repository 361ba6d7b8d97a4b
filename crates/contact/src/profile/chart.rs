//! Profile as a sequence of panels (cells of the interpolation), for tables of points and normal laws.
//!
//! In each panel, contact radius and height are cubic polynomials of one parameter. M = 2∫a dh and N = ∫M dh are then exact polynomials of
//! the same parameter. Because m, M and N are consistent, the energy balance is satisfied to rounding.

use super::Sums;
use super::kind::{Kind, Peak};
use super::newton::between;
use super::outline::Outline;
use crate::ContactError;
use crate::quadrature::GAUSS;

/// Panels in order of height, from height 0.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chart {
    /// Height at the start of each panel, m, ascending.
    heights: Vec<f64>,
    /// Radius at the end of each panel, m, not decreasing.
    ends: Vec<f64>,
    panels: Vec<Panel>,
    /// Integrals m, M and N at the end of the last panel.
    last: Sums,
    /// Height at the end of the last panel, m.
    reach: f64,
    /// Radii above 0 at which a quadrature must be split, m, ascending.
    borders: Vec<f64>,
    /// Whether the radius jumps from one panel to the next.
    has_jumps: bool,
    /// Shape in three dimensions; `None` for a normal law.
    outline: Option<Outline>,
}

/// Panel: cell of the interpolation, given by polynomials of s in [0, 1] with coefficients from the lowest power on.
#[derive(Debug, Clone, PartialEq)]
struct Panel {
    /// Contact radius a, m.
    radius: [f64; 4],
    /// Height h, m.
    height: [f64; 4],
    /// Reduced force M, m².
    force: [f64; 7],
    /// Reduced energy N, m³.
    energy: [f64; 10],
}

/// Values at both ends of a panel, with derivatives with respect to s.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ends {
    /// Contact radii a, m.
    pub(super) radius: [f64; 2],
    pub(super) radius_slope: [f64; 2],
    /// Heights h, m.
    pub(super) height: [f64; 2],
    pub(super) height_slope: [f64; 2],
}

/// Returns the cubic polynomial with given values and slopes at 0 and 1. The slopes are limited so that the polynomial does not
/// decrease (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980).
pub(super) fn rising_cubic([from, to]: [f64; 2], slopes: [f64; 2]) -> [f64; 4] {
    let rise = to - from;
    let [start, end] = slopes.map(|slope| slope.clamp(0.0, 3.0 * rise));
    [from, start, 3.0 * rise - 2.0 * start - end, start + end - 2.0 * rise]
}

/// Returns the polynomial Σ cₖsᵏ.
pub(super) fn value<const N: usize>(c: &[f64; N], s: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

/// Returns the derivative of the polynomial.
fn slope<const N: usize>(c: &[f64; N], s: f64) -> f64 {
    (1..N).rev().fold(0.0, |sum, k| sum * s + k as f64 * c[k])
}

/// Returns the polynomial start + factor · ∫ p · h′ ds, for a cubic h.
fn integral<const P: usize, const I: usize>(start: f64, factor: f64, p: &[f64; P], h: &[f64; 4]) -> [f64; I] {
    let mut result = [0.0; I];
    for (i, p) in p.iter().enumerate() {
        for (k, h) in h.iter().enumerate().skip(1) {
            // Integral of k h sᵏ⁻¹ p sⁱ.
            let power = i + k;
            result[power] += factor * p * h * k as f64 / power as f64;
        }
    }
    result[0] = start;
    result
}

/// Returns the s in [0, 1] at which an increasing cubic polynomial has a given value.
fn solve(c: &[f64; 4], wanted: f64) -> f64 {
    let rise = wanted - c[0];
    if rise <= 0.0 {
        return 0.0;
    }
    // Root of the quadratic part; the cubic part is small in a panel.
    let guess = 2.0 * rise / (c[1] + (c[1] * c[1] + 4.0 * c[2] * rise).max(0.0).sqrt());
    between(guess, |s| (((c[3] * s + c[2]) * s + c[1]) * s - rise, slope(c, s)))
}

impl Chart {
    /// Creates the profile from at least one panel.
    ///
    /// Each panel begins at the end of the previous panel; the first begins at height 0. Heights increase and radii do not decrease.
    /// `borders` are radii above 0 at which a quadrature must be split, m, ascending.
    pub(super) fn new(ends: &[Ends], borders: Vec<f64>, outline: Option<Outline>) -> Self {
        let (mut force, mut energy) = (0.0, 0.0);
        let panel = |ends: &Ends| {
            let radius = rising_cubic(ends.radius, ends.radius_slope);
            let height = rising_cubic(ends.height, ends.height_slope);
            let force_in: [f64; 7] = integral(force, 2.0, &radius, &height);
            let energy_in: [f64; 10] = integral(energy, 1.0, &force_in, &height);
            (force, energy) = (value(&force_in, 1.0), value(&energy_in, 1.0));
            Panel { radius, height, force: force_in, energy: energy_in }
        };
        let panels: Vec<Panel> = ends.iter().map(panel).collect();
        let (radius, reach) = ends.last().map_or((0.0, 0.0), |ends| (ends.radius[1], ends.height[1]));
        // Differences due to rounding are no jumps.
        let jumps = |pair: &[Ends]| pair[1].radius[0] > pair[0].radius[1] * (1.0 + 1e-6);
        Self {
            has_jumps: ends.windows(2).any(jumps),
            heights: ends.iter().map(|ends| ends.height[0]).collect(),
            ends: ends.iter().map(|ends| ends.radius[1]).collect(),
            panels,
            last: Sums { reduced_stiffness: 2.0 * radius, reduced_force: force, reduced_energy: energy },
            reach,
            borders,
            outline,
        }
    }

    /// Fails if an indentation is beyond the last point.
    #[inline(never)]
    pub(super) fn check_end(&self, d: f64) -> Result<(), ContactError> {
        // Tolerance for rounding in units, waveforms and inverse functions; the profile continues linearly there.
        const ROUNDING: f64 = 1e-12;
        let reach = self.reach;
        if d > reach * (1.0 + ROUNDING) { Err(ContactError::Beyond { d, reach }) } else { Ok(()) }
    }

    /// Returns the panel that contains a height, and the parameter s of the height; `None` beyond the last panel.
    fn at(&self, h: f64) -> Option<(&Panel, f64)> {
        if h >= self.reach {
            return None;
        }
        let panel = self.panels.get(self.heights.partition_point(|start| *start <= h).checked_sub(1)?)?;
        Some((panel, solve(&panel.height, h)))
    }

    /// Returns ∫ w m dh between two heights, for a linear w with start value and slope. Each panel is integrated separately.
    pub(super) fn moment(&self, [from, to]: [f64; 2], [start, slope]: [f64; 2]) -> f64 {
        let first = self.heights.partition_point(|height| *height <= from);
        let inside = self.heights[first..].iter().copied().take_while(|height| *height < to);
        let (mut at, mut sum) = (from, 0.0);
        for edge in inside.chain([to]) {
            let (middle, width) = (0.5 * (at + edge), edge - at);
            let node = |(x, weight): &(f64, f64)| {
                let h = middle + 0.5 * width * x;
                weight * (start + slope * (h - from)) * self.reduced_stiffness(h)
            };
            sum += width * GAUSS.iter().map(node).sum::<f64>();
            at = edge;
        }
        sum
    }

    /// Returns the panel that contains a radius, and the parameter s of the radius; `None` beyond the last panel.
    fn of_radius(&self, a: f64) -> Option<(&Panel, f64)> {
        let panel = self.panels.get(self.ends.partition_point(|end| *end < a))?;
        Some((panel, solve(&panel.radius, a)))
    }

    /// Returns the number of panels.
    #[cfg(test)]
    pub(super) fn count(&self) -> usize {
        self.panels.len()
    }

    /// Returns the shape in three dimensions; `None` for a normal law.
    pub(super) fn outline(&self) -> Option<&Outline> {
        self.outline.as_ref()
    }
}

impl Kind for Chart {
    fn reduced_stiffness(&self, h: f64) -> f64 {
        self.at(h).map_or(self.last.reduced_stiffness, |(panel, s)| 2.0 * value(&panel.radius, s))
    }

    fn reduced_force(&self, h: f64) -> f64 {
        match self.at(h) {
            Some((panel, s)) => value(&panel.force, s),
            None => self.last.at(h - self.reach).reduced_force,
        }
    }

    fn reduced_energy(&self, h: f64) -> f64 {
        match self.at(h) {
            Some((panel, s)) => value(&panel.energy, s),
            None => self.last.at(h - self.reach).reduced_energy,
        }
    }

    /// Finds the panel by bisection, then solves for s in this panel with dM/ds = 2a dh/ds.
    fn height_of_reduced_force(&self, force: f64) -> f64 {
        if force >= self.last.reduced_force {
            return self.reach + (force - self.last.reduced_force) / self.last.reduced_stiffness;
        }
        let index = self.panels.partition_point(|panel| panel.force[0] <= force).max(1) - 1;
        let Panel { radius, height, force: c, .. } = &self.panels[index];
        let s = between(0.5, |s| {
            let error = c[1..].iter().rev().fold(0.0, |sum, c| (sum + c) * s) - (force - c[0]);
            (error, 2.0 * value(radius, s) * slope(height, s))
        });
        value(height, s)
    }

    fn depth(&self, a: f64) -> f64 {
        self.of_radius(a).map_or(f64::INFINITY, |(panel, s)| value(&panel.height, s))
    }

    fn depth_slope(&self, a: f64) -> f64 {
        let Some((panel, s)) = self.of_radius(a) else { return f64::INFINITY };
        let (rise, width) = (slope(&panel.height, s), slope(&panel.radius, s));
        // Inside a flat the slope of g is not defined.
        if a <= panel.radius[0] && s == 0.0 || width == 0.0 { 0.0 } else { rise / width }
    }

    fn gap(&self, r: f64) -> Option<f64> {
        self.outline.as_ref()?.gap(r)
    }

    fn borders(&self) -> &[f64] {
        &self.borders
    }

    fn peak(&self) -> Option<Peak> {
        let outline = self.outline.as_ref()?;
        Some(if outline.has_edges() { Peak::Unbounded } else { Peak::Between })
    }

    /// Returns whether the radius begins at 0 and increases throughout.
    fn is_strictly_convex(&self) -> bool {
        let mut before = 0.0;
        let starts = self.panels.first().is_some_and(|panel| panel.radius[0] == 0.0);
        let rises = |end: &f64| *end > std::mem::replace(&mut before, *end);
        starts && self.ends.iter().all(rises)
    }

    /// Returns 1 + i/k from the first powers in the first panel: a ∝ sⁱ and h ∝ sᵏ give a ∝ h^{i/k}.
    fn first_power(&self) -> f64 {
        let first = |c: &[f64; 4]| (0..4).find(|i| c[*i] != 0.0).unwrap_or(0) as f64;
        let Some(panel) = self.panels.first() else { return 1.0 };
        let (radius, height) = (first(&panel.radius), first(&panel.height));
        if height > 0.0 { 1.0 + radius / height } else { 1.0 }
    }

    fn has_kinks(&self) -> bool {
        self.has_jumps
    }

    /// Returns whether the profile is a normal law with inner points.
    fn has_bends(&self) -> bool {
        self.outline.is_none() && !self.borders.is_empty()
    }

    fn reach(&self) -> Option<f64> {
        Some(self.reach)
    }
}
