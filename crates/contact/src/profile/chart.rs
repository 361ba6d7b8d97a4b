//! A profile in panels: contact radius and height are cubics of one parameter, panel by panel, and all that follows from them
//! is exact: M = 2∫a dh and N = ∫M dh are polynomials of the same parameter.
//!
//! A table of points and a normal law come to this. With the three integrals in step with each other forces, energies and
//! friction work close like those of a closed form, whatever the panels miss of the true shape.

use super::Sums;
use super::kind::{Kind, Peak};
use super::newton::between;
use super::outline::Outline;
use crate::ContactError;
use crate::quadrature::GAUSS;

/// Panels by ascending height, from the height 0 on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chart {
    /// Height at which each begins, m, ascending.
    heights: Vec<f64>,
    /// Radius at which each ends, m, not falling.
    ends: Vec<f64>,
    panels: Vec<Panel>,
    /// What stands at the end of the last.
    last: Sums,
    /// Its height, m.
    reach: f64,
    /// Radii above 0 at which a quadrature is to be parted, m, ascending.
    borders: Vec<f64>,
    /// Whether the radius jumps from one panel to the next.
    has_jumps: bool,
    /// The shape in three dimensions, where there is one.
    outline: Option<Outline>,
}

/// A panel: cubics of s in [0, 1] and what follows from them, lowest power first.
#[derive(Debug, Clone, PartialEq)]
struct Panel {
    /// a, m.
    radius: [f64; 4],
    /// h, m.
    height: [f64; 4],
    /// M, m².
    force: [f64; 7],
    /// N, m³.
    energy: [f64; 10],
}

/// Both ends of a panel, each with the derivatives to s, 0 ≤ s ≤ 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ends {
    /// a, m.
    pub(super) radius: [f64; 2],
    pub(super) radius_slope: [f64; 2],
    /// h, m.
    pub(super) height: [f64; 2],
    pub(super) height_slope: [f64; 2],
}

/// The cubic with these values and slopes at 0 and 1, its slopes cut so that it does not fall between values that do not (Fritsch and
/// Carlson, SIAM J. Numer. Anal. 17, 1980).
pub(super) fn rising_cubic([from, to]: [f64; 2], slopes: [f64; 2]) -> [f64; 4] {
    let rise = to - from;
    let [start, end] = slopes.map(|slope| slope.clamp(0.0, 3.0 * rise));
    [from, start, 3.0 * rise - 2.0 * start - end, start + end - 2.0 * rise]
}

/// Σ cₖsᵏ.
pub(super) fn value<const N: usize>(c: &[f64; N], s: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

/// Its derivative.
fn slope<const N: usize>(c: &[f64; N], s: f64) -> f64 {
    (1..N).rev().fold(0.0, |sum, k| sum * s + k as f64 * c[k])
}

/// ∫ factor · p · h′ ds from a start on, h a cubic.
fn integral<const P: usize, const I: usize>(start: f64, factor: f64, p: &[f64; P], h: &[f64; 4]) -> [f64; I] {
    let mut result = [0.0; I];
    for (i, p) in p.iter().enumerate() {
        for (k, h) in h.iter().enumerate().skip(1) {
            // k h sᵏ⁻¹ p sⁱ, integrated.
            let power = i + k;
            result[power] += factor * p * h * k as f64 / power as f64;
        }
    }
    result[0] = start;
    result
}

/// The s in [0, 1] at which a rising cubic takes a value between those at its ends.
fn solve(c: &[f64; 4], wanted: f64) -> f64 {
    let rise = wanted - c[0];
    if rise <= 0.0 {
        return 0.0;
    }
    // Of the parabola: the cubic's part is small in a panel.
    let guess = 2.0 * rise / (c[1] + (c[1] * c[1] + 4.0 * c[2] * rise).max(0.0).sqrt());
    between(guess, |s| (((c[3] * s + c[2]) * s + c[1]) * s - rise, slope(c, s)))
}

impl Chart {
    /// Panels in ascending order, each beginning where the one before ends, the first at the height 0; at least one. Neither
    /// radius nor height falls, and heights rise. `borders` are radii above 0 at which a quadrature is to be parted, m, ascending.
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
        // Rounding is no jump.
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

    /// Fails where an indentation lies beyond the last point.
    #[inline(never)]
    pub(super) fn check_end(&self, d: f64) -> Result<(), ContactError> {
        // What a unit, a waveform at its crest and the inverses of M and g may leave of the last point. There all goes on straight.
        const ROUNDING: f64 = 1e-12;
        let reach = self.reach;
        if d > reach * (1.0 + ROUNDING) { Err(ContactError::Beyond { d, reach }) } else { Ok(()) }
    }

    /// The panel of a height and the place in it; none beyond the last.
    fn at(&self, h: f64) -> Option<(&Panel, f64)> {
        if h >= self.reach {
            return None;
        }
        let panel = self.panels.get(self.heights.partition_point(|start| *start <= h).checked_sub(1)?)?;
        Some((panel, solve(&panel.height, h)))
    }

    /// ∫ w m dh between two heights, w straight from a value with a slope: panel by panel, in which m is smooth.
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

    /// The panel of a radius within those reached and the place in it.
    fn of_radius(&self, a: f64) -> Option<(&Panel, f64)> {
        let panel = self.panels.get(self.ends.partition_point(|end| *end < a))?;
        Some((panel, solve(&panel.radius, a)))
    }

    /// Number of panels.
    #[cfg(test)]
    pub(super) fn count(&self) -> usize {
        self.panels.len()
    }

    /// The shape in three dimensions, where there is one.
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

    /// By halves among the panels and then in one of them: dM/ds = 2a dh/ds.
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
        // Inside a flat there is no g to have a slope.
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

    /// Where the radius rises from 0 on throughout.
    fn is_strictly_convex(&self) -> bool {
        let mut before = 0.0;
        let starts = self.panels.first().is_some_and(|panel| panel.radius[0] == 0.0);
        let rises = |end: &f64| *end > std::mem::replace(&mut before, *end);
        starts && self.ends.iter().all(rises)
    }

    /// Of the first powers of s in the first panel: a ∝ sⁱ and h ∝ sᵏ make a ∝ h^{i/k}.
    fn first_power(&self) -> f64 {
        let first = |c: &[f64; 4]| (0..4).find(|i| c[*i] != 0.0).unwrap_or(0) as f64;
        let Some(panel) = self.panels.first() else { return 1.0 };
        let (radius, height) = (first(&panel.radius), first(&panel.height));
        if height > 0.0 { 1.0 + radius / height } else { 1.0 }
    }

    fn has_kinks(&self) -> bool {
        self.has_jumps
    }

    /// A normal law does at its points.
    fn has_bends(&self) -> bool {
        self.outline.is_none() && !self.borders.is_empty()
    }

    fn reach(&self) -> Option<f64> {
        Some(self.reach)
    }
}
