//! Sample rows at times that a record requests, and the extents of body motions between them.
//!
//! Sample rows and extents come from time steps like regular rows, but do not depend on the interval of the regular rows.

use crate::Model;
use crate::equations::Equations;
use crate::model::Binding;
use crate::record::{self, Due, Entry, Extent, Record};
use crate::scene::Axis;
use crate::state::State;

/// Largest relative distance between a time and the requested time that counts as rounding.
pub(in crate::run) const SAME: f64 = 4.0 * f64::EPSILON;

/// Time (s), position (m) and velocity (m/s) of a body.
pub(in crate::run) type Point = [f64; 3];

/// Next sample row, and the extents of the watched bodies since the last sample row.
pub(in crate::run) struct Marks {
    /// Time of the next sample row, s; ∞ if there is none.
    due: f64,
    /// Time from which on the time `due` counts as reached, s.
    nearly: f64,
    /// Free coordinates whose extents the record requests.
    watched: [Option<Watched>; 2],
    row: Vec<f64>,
}

/// Free coordinate whose extent the record requests.
#[derive(Clone, Copy)]
struct Watched {
    coordinate: usize,
    /// Last point of the current step that has been included in the extent.
    inside: Option<Point>,
    /// Extent since the last sample row, including the shift of the origin.
    extent: Extent,
}

impl Marks {
    /// Creates a state without any request, before a run.
    pub(in crate::run) const fn none() -> Self {
        let never = f64::INFINITY;
        Self { due: never, nearly: never, watched: [None; 2], row: Vec::new() }
    }

    /// Returns a value without any request in the storage of this one.
    pub(in crate::run) fn renewed(self) -> Self {
        Self { row: self.row, ..Self::none() }
    }

    /// Requests the first sample row and writes sample rows that are due now, unless the run is resumed.
    pub(in crate::run) fn begin(
        &mut self,
        equations: &Equations<'_>,
        (model, state): (&Model, &State),
        resumed: bool,
        record: &mut dyn Record,
    ) {
        self.watched =
            record.wants().watched.map(|body| match model.bodies.get(body?)?.bindings[Axis::X as usize] {
                Binding::Free(i) => {
                    let extent = Extent::at(state.shifts[i] + state.y[i], state.t);
                    Some(Watched { coordinate: i, inside: None, extent })
                }
                _ => None,
            });
        self.due = f64::NEG_INFINITY;
        self.ask(record);
        while self.due < state.t || resumed && self.due(state.t).is_some() {
            self.ask(record);
        }
        while self.due(state.t).is_some() {
            self.write(equations, state, state.t, &|i| state.y[i], record);
        }
        self.end_step();
    }

    /// Returns the time of the next sample row, if that is at or before `t`. A time that agrees with `t` within rounding is `t` itself.
    #[inline(always)]
    pub(in crate::run) fn due(&self, t: f64) -> Option<f64> {
        (t >= self.nearly).then(|| self.due.min(t))
    }

    /// Whether the record requests the extent of any body, so that every step is evaluated.
    #[inline(always)]
    pub(in crate::run) fn watches(&self) -> bool {
        self.watched.iter().any(Option::is_some)
    }

    /// Passes the sample row at time t in the current step to the record and requests the next sample row.
    pub(in crate::run) fn write(
        &mut self,
        equations: &Equations<'_>,
        state: &State,
        t: f64,
        y: &impl Fn(usize) -> f64,
        record: &mut dyn Record,
    ) {
        if self.watches() {
            let point = |i: usize| [t, state.shifts[i] + y(i), y(equations.layout.velocity(i))];
            self.pass(state, point);
            self.hand_over(record);
            for watched in self.watched.iter_mut().flatten() {
                let [t, x, _] = point(watched.coordinate);
                watched.extent = Extent::at(x, t);
            }
        }
        record::fill(equations, state, t, y, &mut self.row);
        record.take(Entry::Mark(&self.row));
        self.ask(record);
    }

    /// Extends the extents up to a point in the current step, which starts at `state`. `point` returns this point of a coordinate.
    pub(in crate::run) fn pass(&mut self, state: &State, point: impl Fn(usize) -> Point) {
        for watched in self.watched.iter_mut().flatten() {
            let (i, to) = (watched.coordinate, point(watched.coordinate));
            let start = || [state.t, state.shifts[i] + state.y[i], state.y[state.shifts.len() + i]];
            let from = watched.inside.replace(to).unwrap_or_else(start);
            watched.extent = watched.extent.join(extent(from, to));
        }
    }

    /// Ends the current step.
    pub(in crate::run) fn end_step(&mut self) {
        self.watched.iter_mut().flatten().for_each(|watched| watched.inside = None);
    }

    /// Passes the extents so far to the record and resets them.
    pub(in crate::run) fn hand_over(&mut self, record: &mut dyn Record) {
        let take = |watched: &mut Option<Watched>| {
            watched
                .as_mut()
                .map_or(Extent::NONE, |watched| std::mem::replace(&mut watched.extent, Extent::NONE))
        };
        let extents = self.watched.each_mut().map(take);
        if extents.iter().any(|extent| !extent.is_none()) {
            record.take(Entry::Extents(extents));
        }
    }

    /// Requests the next sample row. A requested time that is not later than the last one ends the sample rows.
    fn ask(&mut self, record: &mut dyn Record) {
        let next = record.next(Due::Mark).unwrap_or(f64::INFINITY);
        self.due = if next > self.due { next } else { f64::INFINITY };
        self.nearly = self.due * (1.0 - SAME);
    }
}

/// Returns the extent of the cubic Hermite interpolant of positions and velocities at two points.
fn extent([t0, x0, v0]: Point, [t1, x1, v1]: Point) -> Extent {
    let ends = || Extent::at(x0, t0).join(Extent::at(x1, t1));
    let h = t1 - t0;
    if h.is_nan() || h <= 0.0 {
        return ends();
    }
    // Sufficient condition for a monotone cubic (Fritsch and Carlson 1980).
    let mean = (x1 - x0) / h;
    if mean != 0.0
        && (0.0..=3.0 * mean.abs()).contains(&(v0 * mean.signum()))
        && (0.0..=3.0 * mean.abs()).contains(&(v1 * mean.signum()))
    {
        return ends();
    }
    // x(s) = x₀ + hv₀s + bs² + cs³, s from 0 to 1; its slope vanishes where hv₀ + 2bs + 3cs² = 0.
    let (slope, rise) = (h * v0, x1 - x0);
    let (b, c) = (3.0 * rise - 2.0 * slope - h * v1, slope + h * v1 - 2.0 * rise);
    let root = (b * b - 3.0 * c * slope).sqrt();
    // Both roots without cancellation.
    let q = -(b + root.copysign(b));
    let [mut first, mut second] = [q / (3.0 * c), slope / q];
    if second < first {
        std::mem::swap(&mut first, &mut second);
    }
    let turns = [first, second].into_iter().filter(|s| *s > 0.0 && *s < 1.0);
    let turns = turns.map(|s| Extent::at(x0 + s * (slope + s * (b + s * c)), t0 + s * h));
    turns.fold(Extent::at(x0, t0), Extent::join).join(Extent::at(x1, t1))
}

#[cfg(test)]
mod tests {
    use super::{Extent, extent};

    #[test]
    fn a_cubic_has_its_turning_points() {
        // x = t³ - 3t has the extrema 2 at t = -1 and -2 at t = 1.
        let (x, v) = (|t: f64| t.powi(3) - 3.0 * t, |t: f64| 3.0 * t * t - 3.0);
        let ends = |from, to| {
            let Extent { least: [least, _], most: [most, _], fall, rise } = extent(from, to);
            [least, most, fall, rise]
        };
        let between = |a: f64, b: f64| ends([a, x(a), v(a)], [b, x(b), v(b)]);
        assert_eq!(between(-1.5, 1.5), [-2.0, 2.0, 4.0, 2.0 - x(-1.5)]);
        assert_eq!(between(0.0, 1.5), [-2.0, 0.0, 2.0, x(1.5) + 2.0]);
        assert_eq!(between(1.5, 2.0), [x(1.5), 2.0, 0.0, 2.0 - x(1.5)]);
        // A parabola, a straight line, and rest.
        assert_eq!(ends([0.0, 0.0, 1.0], [1.0, 0.0, -1.0]), [0.0, 0.25, 0.25, 0.25]);
        assert_eq!(ends([0.0, 1.0, 2.0], [1.0, 3.0, 2.0]), [1.0, 3.0, 0.0, 2.0]);
        assert_eq!(ends([0.0, 1.0, 0.0], [1.0, 1.0, 0.0]), [1.0, 1.0, 0.0, 0.0]);
    }
}
