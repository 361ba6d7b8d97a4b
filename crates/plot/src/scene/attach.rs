//! Drawing of links and loads: springs, stacks, forces and moments.

use super::arrange::{Arrangement, LINK};
use super::draw::DIGITS;
use super::outline::{Draft, Rect};
use super::sheet::{FINE, FOLLOWS, FORCE, OUTLINE, Sheet, TIE, around, line};
use super::symbols::{Lines, arrow, spring, stack, stroke, turn, wall};
use super::{Amount, LinkKind, Press, SceneContact, SceneLink, SceneLoad};
use crate::scale::quantity;
use crate::theme::{Ink, Style};
use crate::thin::Point;

/// Length of a force arrow, and radius of a moment arrow.
const FORCE_ARROW: f64 = 85.0;
const MOMENT: f64 = 62.0;
/// Distance between two symbols on one face, and between a spring and the arrow of its preload.
const BETWEEN: f64 = 48.0;
const BESIDE: f64 = 36.0;
/// Minimum gap between bodies for a straight link; otherwise the link goes around them.
const NEAR: f64 = 40.0;

/// Face of a body's outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Face {
    Left,
    Right,
    Bottom,
    Top,
}

/// Attaches links and loads to placed bodies.
pub(super) struct Attacher<'d, 's, 'a> {
    draft: &'d Draft<'s, 'a>,
    plan: &'d Arrangement,
    sheet: &'d mut Sheet,
    /// Occupied positions on faces: body, face, position along it.
    taken: Vec<(usize, Face, f64)>,
}

impl Face {
    /// Returns the face in the positive or negative direction of the x or z axis.
    fn of(is_upright: bool, is_end: bool) -> Self {
        match (is_upright, is_end) {
            (false, false) => Self::Left,
            (false, true) => Self::Right,
            (true, false) => Self::Bottom,
            (true, true) => Self::Top,
        }
    }

    /// Returns the point at a position along the face and a distance `off` it.
    fn point(self, rect: Rect, along: f64, off: f64) -> Point {
        let (x, y) = (along.max(rect.left).min(rect.right), along.max(rect.bottom).min(rect.top));
        match self {
            Self::Left => (rect.left - off, y),
            Self::Right => (rect.right + off, y),
            Self::Bottom => (x, rect.bottom - off),
            Self::Top => (x, rect.top + off),
        }
    }

    /// Returns the coordinate of a point along the face.
    fn along(self, (x, y): Point) -> f64 {
        if matches!(self, Self::Left | Self::Right) { y } else { x }
    }

    /// Returns whether the face is in the positive direction of its axis.
    fn is_end(self) -> bool {
        matches!(self, Self::Right | Self::Top)
    }
}

impl<'d, 's, 'a> Attacher<'d, 's, 'a> {
    pub(super) fn new(draft: &'d Draft<'s, 'a>, plan: &'d Arrangement, sheet: &'d mut Sheet) -> Self {
        Self { draft, plan, sheet, taken: Vec::new() }
    }

    /// Draws a spring, damper or stack with its preload.
    pub(super) fn link(&mut self, link: &SceneLink<'_>) {
        let [first, second] = link.between.map(|side| side.body);
        match (first, second) {
            (Some(a), Some(b)) => self.between(link, [a, b]),
            (None, Some(body)) => self.grounded(link, body, 1),
            (Some(body), None) => self.grounded(link, body, 0),
            (None, None) => {}
        }
    }

    /// Draws a normal force, or an indentation or radius that follows a waveform.
    pub(super) fn press(&mut self, contact: &SceneContact<'_>, at: Point) {
        let (amount, symbol, unit) = match contact.press {
            Press::Force(force) => (force, "F", "N"),
            Press::Indentation(depth @ Amount::Follows(_)) => (depth, "d", "m"),
            Press::Radius(radius @ Amount::Follows(_)) => (radius, "a", "m"),
            Press::Indentation(_) | Press::Radius(_) | Press::Coupled => return,
        };
        let [below, above] = contact.between.map(|side| side.body);
        let (body, face) = match (below, above) {
            (_, Some(above)) => (above, Face::Top),
            (Some(below), None) => (below, Face::Bottom),
            (None, None) => return,
        };
        let words = match (amount, contact.count) {
            (Amount::Constant(_), 1) | (Amount::Follows(_), _) => said(symbol, amount, unit),
            (Amount::Constant(_), count) => format!("{count} × {}", said(symbol, amount, unit)),
        };
        self.force(body, at, face, Push::of(amount, true), &words);
    }

    /// Draws forces and moment of a load.
    pub(super) fn load(&mut self, load: &SceneLoad<'_>) {
        let (x, y) = self.draft.px(load.at);
        let (from, unit) = (self.plan.references[load.body], self.draft.unit);
        let at = (from.0 + x, from.1 + y);
        for (force, is_upright) in [(load.x, false), (load.z, true)] {
            if force.is_nothing() {
                continue;
            }
            let is_forward = !matches!(force, Amount::Constant(value) if value < 0.0);
            // Vertical forces are drawn on top; horizontal ones pull at a face without other symbols, if there is one.
            let mut face = Face::of(is_upright, is_forward || is_upright);
            let other = Face::of(is_upright, !is_forward);
            if !is_upright && !self.is_free(load.body, face, at) && self.is_free(load.body, other, at) {
                face = other;
            }
            let is_push = face.is_end() != is_forward;
            self.force(load.body, at, face, Push::of(force, is_push), &said("F", force, "N"));
        }
        if !load.pitch.is_nothing() {
            let is_forward = !matches!(load.pitch, Amount::Constant(value) if value < 0.0);
            let angles = if is_forward { (-0.9, 3.6) } else { (3.6, -0.9) };
            let push = Push::of(load.pitch, true);
            let lines = turn(at, MOMENT * unit, angles, push.is_double, unit);
            let about = around(&lines);
            self.sheet.draw(lines, push.style);
            self.sheet.note(&[said("M", load.pitch, "N m")], about, None);
        }
    }

    /// Draws an arrow on a face, with a line to the point of application. The arrow may be shifted.
    fn force(&mut self, body: usize, at: Point, face: Face, push: Push, words: &str) {
        let (rect, unit) = (self.plan.outlines[body], self.draft.unit);
        let along = self.take(body, face, face.along(at));
        let near = face.point(rect, along, 4.0 * unit);
        let far = face.point(rect, along, FORCE_ARROW * unit);
        let (from, to) = if push.is_push { (far, near) } else { (near, far) };
        let lines = arrow(from, to, push.is_double, unit);
        let about = around(&lines);
        self.sheet.draw(lines, push.style);
        self.tie(body, at, face);
        self.sheet.note(&[words.to_owned()], about, None);
    }

    /// Draws a link to the ground, with a wall symbol.
    fn grounded(&mut self, link: &SceneLink<'_>, body: usize, side: usize) {
        let (rect, unit) = (self.plan.outlines[body], self.draft.unit);
        let at = self.point(link, body, side);
        let touches = |wanted: usize| self.draft.contacts_of(body).any(|(_, side)| side == wanted);
        // The order of the ends gives the side of the ground, except where the body rests on something.
        let mut is_end = side == 0;
        if link.is_upright && touches(usize::from(!is_end)) && !touches(usize::from(is_end)) {
            is_end = !is_end;
        }
        let face = Face::of(link.is_upright, is_end);
        let along = self.take(body, face, face.along(at));
        let (near, far) = (face.point(rect, along, 0.0), face.point(rect, along, LINK * unit));
        let ends = if side == 1 { (far, near) } else { (near, far) };
        self.symbol(link, ends, &[]);
        let mut lines = wall(near, far, unit);
        let surface = vec![lines.remove(0)];
        self.sheet.draw(lines, FINE);
        self.sheet.draw(surface, OUTLINE);
        self.tie(body, at, face);
        let preload = if side == 1 { link.preload } else { -link.preload };
        self.preload(body, (face, along), preload);
    }

    /// Draws a link between two bodies: straight if there is room, otherwise around their ends.
    fn between(&mut self, link: &SceneLink<'_>, [a, b]: [usize; 2]) {
        let unit = self.draft.unit;
        let [from, to] = [self.plan.outlines[a], self.plan.outlines[b]];
        let [start, end] = [self.point(link, a, 0), self.point(link, b, 1)];
        let ends = |rect: Rect| {
            if link.is_upright { (rect.bottom, rect.top) } else { (rect.left, rect.right) }
        };
        let room = |low: Rect, high: Rect| ends(high).0 - ends(low).1 >= NEAR * unit;
        let is_reversed = !room(from, to) && room(to, from);
        let is_straight = is_reversed || room(from, to);
        let faces = if is_straight { [!is_reversed, is_reversed] } else { [true, true] };
        let [face_a, face_b] = faces.map(|is_end| Face::of(link.is_upright, is_end));
        let along = [self.take(a, face_a, face_a.along(start)), self.take(b, face_b, face_b.along(end))];
        let (near, far) = (face_a.point(from, along[0], 0.0), face_b.point(to, along[1], 0.0));
        if is_straight {
            self.symbol(link, (near, far), &[]);
        } else {
            let out = ends(from).1.max(ends(to).1) + LINK * unit;
            let beside = |point: Point| if link.is_upright { (point.0, out) } else { (out, point.1) };
            self.symbol(link, (near, beside(near)), &[beside(far), far]);
        }
        self.tie(a, start, face_a);
        self.tie(b, end, face_b);
        self.preload(b, (face_b, along[1]), link.preload);
    }

    /// Draws the symbol of a link, and the line `onwards` from its end.
    fn symbol(&mut self, link: &SceneLink<'_>, (from, to): (Point, Point), onwards: &[Point]) {
        let unit = self.draft.unit;
        let (lines, words): (Lines, String) = match link.kind {
            LinkKind::Spring { is_stiff, is_damped } => {
                (spring(from, to, (is_stiff, is_damped), unit), String::new())
            }
            LinkKind::Stack(stroke) => (stack(from, to, unit), said("s", stroke, "m")),
        };
        let about = around(&lines);
        self.sheet.draw(lines, OUTLINE);
        if let LinkKind::Stack(Amount::Follows(_)) = link.kind {
            self.sheet.draw(stroke(from, to, unit), FOLLOWS);
        }
        if !onwards.is_empty() {
            self.sheet.draw(vec![std::iter::once(to).chain(onwards.iter().copied()).collect()], OUTLINE);
        }
        self.sheet.note(&[link.name.to_owned(), words], about, None);
    }

    /// Draws the arrow of a preload next to its spring.
    fn preload(&mut self, body: usize, (face, along): (Face, f64), force: f64) {
        if force == 0.0 {
            return;
        }
        let (rect, unit) = (self.plan.outlines[body], self.draft.unit);
        let along = self.take(body, face, along + BESIDE * unit);
        let near = face.point(rect, along, 4.0 * unit);
        let far = face.point(rect, along, FORCE_ARROW * unit);
        let (from, to) = if face.is_end() == (force > 0.0) { (near, far) } else { (far, near) };
        let lines = arrow(from, to, false, unit);
        let about = around(&lines);
        self.sheet.draw(lines, FORCE);
        self.sheet.note(&[quantity(force.abs(), "N", DIGITS)], about, None);
    }

    fn point(&self, link: &SceneLink<'_>, body: usize, side: usize) -> Point {
        let ((x, y), from) = (self.draft.px(link.between[side].at), self.plan.references[body]);
        (from.0 + x, from.1 + y)
    }

    /// Draws the line from a point of a body to a face; only for bodies with given points.
    fn tie(&mut self, body: usize, at: Point, face: Face) {
        if self.draft.is_given(body) == (false, false) {
            return;
        }
        let end = face.point(self.plan.outlines[body], face.along(at), 0.0);
        if math::hypot(end.0 - at.0, end.1 - at.1) > 2.0 * self.draft.unit {
            self.sheet.draw(vec![vec![at, end]], TIE);
        }
        self.sheet.draw(vec![vec![at]], line(Ink::Foreground, 0.9));
    }

    fn is_free(&self, body: usize, face: Face, at: Point) -> bool {
        let mut taken = self.taken.iter().filter(|taken| (taken.0, taken.1) == (body, face));
        taken.all(|taken| (taken.2 - face.along(at)).abs() >= BETWEEN * self.draft.unit * (1.0 - 1e-9))
    }

    /// Occupies the free position along a face that is nearest to `along`.
    fn take(&mut self, body: usize, face: Face, along: f64) -> f64 {
        let step = BETWEEN * self.draft.unit;
        let aside = (0..64).flat_map(|k| [f64::from(k) * step, -f64::from(k) * step]);
        let is_free = |at: &f64| self.is_free(body, face, (*at, *at));
        let along = aside.map(|aside| along + aside).find(is_free).unwrap_or(along);
        self.taken.push((body, face, along));
        along
    }
}

/// Direction and style of a force arrow.
#[derive(Debug, Clone, Copy)]
struct Push {
    is_push: bool,
    is_double: bool,
    style: Style,
}

impl Push {
    /// Returns the arrow of a force. Constant forces have one arrowhead, forces that follow a waveform two.
    fn of(amount: Amount<'_>, is_push: bool) -> Self {
        match amount {
            Amount::Constant(_) => Self { is_push, is_double: false, style: FORCE },
            Amount::Follows(_) => Self { is_push, is_double: true, style: FOLLOWS },
        }
    }
}

/// Returns the text of a quantity: its magnitude, or the name of the waveform it follows. The arrow shows the sign.
fn said(symbol: &str, amount: Amount<'_>, unit: &str) -> String {
    match amount {
        Amount::Constant(value) => quantity(value.abs(), unit, DIGITS),
        Amount::Follows(waveform) => format!("{symbol}: {waveform}"),
    }
}
