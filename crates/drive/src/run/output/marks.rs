//! Rows at moments that a record asks for itself, and how far bodies have moved between them.
//!
//! They are read off steps as rows are, but for the record's own figures: so that these do not depend on where rows lie.

use crate::Model;
use crate::equations::Equations;
use crate::model::Binding;
use crate::record::{self, Extent, Record};
use crate::scene::Axis;
use crate::state::State;

/// A moment this near before the one asked for, relative to the time, is it: ends of periods are rounded.
pub(in crate::run) const SAME: f64 = 4.0 * f64::EPSILON;

/// Time (s), place (m) and velocity (m/s) of a body.
pub(in crate::run) type Point = [f64; 3];

/// The marks ahead, and how far bodies went since the last one.
pub(in crate::run) struct Marks {
    /// The next moment, s; infinite where none is left.
    due: f64,
    /// From when on a moment is as good as that, s.
    nearly: f64,
    /// The free coordinates whose extents are asked for.
    watched: [Option<Watched>; 2],
    row: Vec<f64>,
}

/// A free coordinate whose extent is asked for.
#[derive(Clone, Copy)]
struct Watched {
    coordinate: usize,
    /// Where it was read last inside the present step.
    inside: Option<Point>,
    /// Its extent since the last mark, counted from the coordinate's origin.
    extent: Extent,
}

impl Marks {
    /// Before a run: nobody has asked yet.
    pub(in crate::run) const fn none() -> Self {
        let never = f64::INFINITY;
        Self { due: never, nearly: never, watched: [None; 2], row: Vec::new() }
    }

    /// None, in the room there is.
    pub(in crate::run) fn renewed(self) -> Self {
        Self { row: self.row, ..Self::none() }
    }

    /// Asks for the first moment after the state's, and takes one that is at hand. Of a run that is `resumed` that has been taken.
    pub(in crate::run) fn begin(
        &mut self,
        equations: &Equations<'_>,
        (model, state): (&Model, &State),
        resumed: bool,
        record: &mut dyn Record,
    ) {
        self.watched =
            record.watched().map(|body| match model.bodies.get(body?)?.bindings[Axis::X as usize] {
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

    /// The next moment, if it lies at `t` or before it; `t` itself where it is as good as there.
    #[inline(always)]
    pub(in crate::run) fn due(&self, t: f64) -> Option<f64> {
        (t >= self.nearly).then(|| self.due.min(t))
    }

    /// Whether the extent of a coordinate is asked for: then every step is read.
    #[inline(always)]
    pub(in crate::run) fn watches(&self) -> bool {
        self.watched.iter().any(Option::is_some)
    }

    /// Hands over the row at a moment of the present step, and asks for the next.
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
        record.mark(&self.row);
        self.ask(record);
    }

    /// Takes the motion up to a point of the present step, at whose start the state is; `point` reads a coordinate there.
    pub(in crate::run) fn pass(&mut self, state: &State, point: impl Fn(usize) -> Point) {
        for watched in self.watched.iter_mut().flatten() {
            let (i, to) = (watched.coordinate, point(watched.coordinate));
            let start = || [state.t, state.shifts[i] + state.y[i], state.y[state.shifts.len() + i]];
            let from = watched.inside.replace(to).unwrap_or_else(start);
            watched.extent = watched.extent.join(extent(from, to));
        }
    }

    /// The present step is over.
    pub(in crate::run) fn end_step(&mut self) {
        self.watched.iter_mut().flatten().for_each(|watched| watched.inside = None);
    }

    /// Hands over the extents so far.
    pub(in crate::run) fn hand_over(&mut self, record: &mut dyn Record) {
        let take = |watched: &mut Option<Watched>| {
            watched
                .as_mut()
                .map_or(Extent::NONE, |watched| std::mem::replace(&mut watched.extent, Extent::NONE))
        };
        let extents = self.watched.each_mut().map(take);
        if extents.iter().any(|extent| !extent.is_none()) {
            record.extents(extents);
        }
    }

    /// Moments that do not ascend end the marks.
    fn ask(&mut self, record: &mut dyn Record) {
        let next = record.next_mark().unwrap_or(f64::INFINITY);
        self.due = if next > self.due { next } else { f64::INFINITY };
        self.nearly = self.due * (1.0 - SAME);
    }
}

/// The extent of the cubic that has positions and velocities of both points.
fn extent([t0, x0, v0]: Point, [t1, x1, v1]: Point) -> Extent {
    let ends = || Extent::at(x0, t0).join(Extent::at(x1, t1));
    let h = t1 - t0;
    if h.is_nan() || h <= 0.0 {
        return ends();
    }
    // Slopes of one sign, none above thrice the mean one: it rises or falls all the way (Fritsch and Carlson 1980).
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
    // Either root without the difference of two nearly equal numbers.
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
        // x = t³ - 3t turns at -1 and 1, with 2 and -2.
        let (x, v) = (|t: f64| t.powi(3) - 3.0 * t, |t: f64| 3.0 * t * t - 3.0);
        let ends = |from, to| {
            let Extent { least: [least, _], most: [most, _], fall, rise } = extent(from, to);
            [least, most, fall, rise]
        };
        let between = |a: f64, b: f64| ends([a, x(a), v(a)], [b, x(b), v(b)]);
        assert_eq!(between(-1.5, 1.5), [-2.0, 2.0, 4.0, 2.0 - x(-1.5)]);
        assert_eq!(between(0.0, 1.5), [-2.0, 0.0, 2.0, x(1.5) + 2.0]);
        assert_eq!(between(1.5, 2.0), [x(1.5), 2.0, 0.0, 2.0 - x(1.5)]);
        // A parabola, thrown at 1 m/s against 2 m/s², a straight way, and rest.
        assert_eq!(ends([0.0, 0.0, 1.0], [1.0, 0.0, -1.0]), [0.0, 0.25, 0.25, 0.25]);
        assert_eq!(ends([0.0, 1.0, 2.0], [1.0, 3.0, 2.0]), [1.0, 3.0, 0.0, 2.0]);
        assert_eq!(ends([0.0, 1.0, 0.0], [1.0, 1.0, 0.0]), [1.0, 1.0, 0.0, 0.0]);
    }
}
