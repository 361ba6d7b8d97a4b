//! Mechanical symbols as polylines, in px of the drawing, y up.

use crate::thin::Point;

/// Polylines of a symbol.
pub(crate) type Lines = Vec<Vec<Point>>;

/// Local coordinates of a line: along the line, and across it to the left.
struct Way {
    from: Point,
    ahead: Point,
    length: f64,
}

impl Way {
    fn new(from: Point, to: Point) -> Self {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let length = math::hypot(x, y);
        let ahead = if length > 0.0 { (x / length, y / length) } else { (1.0, 0.0) };
        Self { from, ahead, length }
    }

    fn at(&self, (along, across): Point) -> Point {
        let (x, y) = self.ahead;
        (self.from.0 + along * x - across * y, self.from.1 + along * y + across * x)
    }

    fn line(&self, points: &[Point]) -> Vec<Point> {
        points.iter().map(|&point| self.at(point)).collect()
    }
}

/// Length of the leads at both ends of a symbol, relative to its length.
const LEAD: f64 = 0.16;
/// Number of turns of a spring, and half its width.
const TURNS: usize = 5;
const COIL: f64 = 15.0;
/// Half width of a piezo stack, and its number of plates.
const STACK: f64 = 20.0;
const PLATES: usize = 7;
/// Length and half width of an arrowhead.
const HEAD: Point = (15.0, 7.5);
/// Half width of a wall; depth and distance of hatches.
const WALL: f64 = 42.0;
pub(super) const HATCH: f64 = 15.0;

/// Returns the symbol of a spring, a damper, or both in parallel.
pub(super) fn spring(from: Point, to: Point, (is_stiff, is_damped): (bool, bool), unit: f64) -> Lines {
    let way = Way::new(from, to);
    let (start, end) = (LEAD * way.length, (1.0 - LEAD) * way.length);
    let mut lines = vec![way.line(&[(0.0, 0.0), (start, 0.0)]), way.line(&[(end, 0.0), (way.length, 0.0)])];
    let aside = if is_stiff && is_damped { 24.0 * unit } else { 0.0 };
    if aside > 0.0 {
        lines.push(way.line(&[(start, -aside), (start, aside)]));
        lines.push(way.line(&[(end, -aside), (end, aside)]));
    }
    if is_stiff {
        let turn = (end - start) / TURNS as f64;
        let coil = COIL * unit;
        let zigzag = (0..TURNS).flat_map(|k| {
            let at = start + k as f64 * turn;
            [(at + 0.25 * turn, aside + coil), (at + 0.75 * turn, aside - coil)]
        });
        let points: Vec<Point> =
            std::iter::once((start, aside)).chain(zigzag).chain([(end, aside)]).collect();
        lines.push(way.line(&points));
    }
    if is_damped {
        lines.extend(damper(&way, (start, end), -aside, 13.0 * unit));
    }
    if !is_stiff && !is_damped {
        lines.push(way.line(&[(start, 0.0), (end, 0.0)]));
    }
    lines
}

/// Returns the symbol of a dashpot: a cup with a piston.
fn damper(way: &Way, (start, end): Point, aside: f64, half: f64) -> Lines {
    let along = |share: f64| start + share * (end - start);
    let (back, rim, piston) = (along(0.3), along(0.8), along(0.55));
    let cup = [(rim, aside + half), (back, aside + half), (back, aside - half), (rim, aside - half)];
    vec![
        way.line(&[(start, aside), (back, aside)]),
        way.line(&cup),
        way.line(&[(piston, aside + 0.7 * half), (piston, aside - 0.7 * half)]),
        way.line(&[(piston, aside), (end, aside)]),
    ]
}

/// Returns the symbol of a piezo stack.
pub(super) fn stack(from: Point, to: Point, unit: f64) -> Lines {
    let way = Way::new(from, to);
    let (start, end) = (LEAD * way.length, (1.0 - LEAD) * way.length);
    let half = STACK * unit;
    let corners = [(start, -half), (end, -half), (end, half), (start, half), (start, -half)];
    let mut lines = vec![
        way.line(&[(0.0, 0.0), (start, 0.0)]),
        way.line(&[(end, 0.0), (way.length, 0.0)]),
        way.line(&corners),
    ];
    for k in 1..PLATES {
        let at = start + k as f64 / PLATES as f64 * (end - start);
        lines.push(way.line(&[(at, -half), (at, half)]));
    }
    lines
}

/// Returns an arrow next to a piezo stack that follows a waveform.
pub(super) fn stroke(from: Point, to: Point, unit: f64) -> Lines {
    let way = Way::new(from, to);
    let beside = -(STACK + HEAD.0) * unit;
    let ends = [LEAD, 1.0 - LEAD].map(|share| way.at((share * way.length, beside)));
    arrow(ends[0], ends[1], true, unit)
}

/// Returns an arrow with one arrowhead or, if `is_double`, with two.
pub(crate) fn arrow(from: Point, to: Point, is_double: bool, unit: f64) -> Lines {
    let mut lines = vec![vec![from, to], head(from, to, unit)];
    if is_double {
        lines.push(head(to, from, unit));
    }
    lines
}

fn head(from: Point, to: Point, unit: f64) -> Vec<Point> {
    let way = Way::new(from, to);
    let (back, half) = (way.length - HEAD.0 * unit, HEAD.1 * unit);
    way.line(&[(back, half), (way.length, 0.0), (back, -half)])
}

/// Returns an arrow along an arc between two angles, rad, counter-clockwise from the x axis.
pub(super) fn turn(centre: Point, radius: f64, (from, to): (f64, f64), is_double: bool, unit: f64) -> Lines {
    let on = |angle: f64| (centre.0 + radius * math::cos(angle), centre.1 + radius * math::sin(angle));
    let arc = (0..=32).map(|k| on(from + (to - from) * f64::from(k) / 32.0));
    // The axis of an arrowhead is a chord, so that it lies on the arc.
    let back = HEAD.0 * unit / radius * (to - from).signum();
    let mut lines = vec![arc.collect(), head(on(to - back), on(to), unit)];
    if is_double {
        lines.push(head(on(from + back), on(from), unit));
    }
    lines
}

/// Returns a wall at the end of a line from a point.
pub(super) fn wall(from: Point, at: Point, unit: f64) -> Lines {
    let way = Way::new(from, at);
    hatched(way.at((way.length, WALL * unit)), way.at((way.length, -WALL * unit)), unit)
}

/// Returns a line of a fixed surface, with hatches on its left.
pub(crate) fn hatched(from: Point, to: Point, unit: f64) -> Lines {
    let way = Way::new(from, to);
    let step = HATCH * unit;
    let mut lines = vec![vec![from, to]];
    let count = (way.length / step).floor().max(1.0) as usize;
    for k in 0..count {
        let at = (k as f64 + 0.5) / count as f64 * way.length;
        lines.push(way.line(&[(at + 0.5 * step, 0.0), (at - 0.5 * step, step)]));
    }
    lines
}

/// Returns an ellipse as a polygon with 96 corners.
pub(super) fn ellipse((x, y): Point, (wide, high): Point) -> Vec<Point> {
    let corner = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / 96.0;
        (x + wide * math::cos(angle), y + high * math::sin(angle))
    };
    (0..=96).map(corner).collect()
}
