//! How the memory of a contact changes.
//!
//! What a memory curve answers with is F_x = G\*∫(u - p)dm over its springs, so all that counts of its change is by how much the
//! anchor of the springs at a height moves. Between two knots that is a straight function of the height: an edge of slope σκ
//! moves as a whole, by δu - σκδd of the apex that led it, and turns about that where κ changes. Knots lie where two lines meet, and their own motion is of second order in the force.
//!
//! A dragging edge takes the place of what it cuts, and of that below nothing changes: the lines of a memory are those of before,
//! from the centre up, and one more.

use crate::contact::Contact;
use stickslip_contact::{Curve, Memory, Profile};

/// Knots that a path of growth is led between.
const KNOTS: usize = 4;

/// By how much anchors of a memory move, δp(h) = a + bh on each of its pieces, by each number.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Anchors {
    count: usize,
    /// [a, b] of all numbers, piece by piece from the centre.
    lines: Vec<[f64; 2]>,
    /// Heights of some knots of a path of growth under way, m, the one at which it began first …
    heights: Vec<f64>,
    /// … and δp there, of all numbers, knot by knot.
    grown: Vec<f64>,
    /// Pieces that are as they were when they were laid out last.
    kept: usize,
}

impl Anchors {
    /// Of a memory that changes by `lines`, piece by piece from the centre, each by all `count` numbers.
    pub(crate) fn new(count: usize, lines: Vec<[f64; 2]>) -> Self {
        Self { count, lines, ..Self::default() }
    }

    /// The line of a piece by number `j`.
    pub(crate) fn line(&self, piece: usize, j: usize) -> Option<[f64; 2]> {
        self.lines.get(piece * self.count + j).copied()
    }

    fn pieces(&self) -> usize {
        self.lines.len().checked_div(self.count).unwrap_or(0)
    }

    /// Follows a memory that has moved over an interval, its apex by `moved`: (δu, δd) by each number, of which the last may make edges
    /// `steeper`, δκ. Without an edge its last piece is one of before.
    pub(super) fn follow(
        &mut self,
        (contact, memory): (&Contact, &Memory),
        (moved, steeper): (&[(f64, f64)], &[f64]),
        has_edge: bool,
    ) {
        let Memory::Curve(curve) = memory else { return };
        let d = memory.apex().d;
        let Some((top, sense)) = curve.last_piece(&contact.interface) else {
            return self.keep(0);
        };
        // Pieces, one less than knots, and those below the last one.
        let pieces = curve.knot_count() - 1;
        let below = pieces - 1;
        self.end_growth(curve);
        if !has_edge && self.pieces() >= pieces {
            return self.keep(pieces);
        }
        self.keep(below);
        // What comes to be below the last piece without having been followed moves with it: pieces of rounding.
        let mut missing = below.saturating_sub(self.pieces());
        let first = moved.len() - steeper.len();
        let turn = |j: usize| {
            sense.zip(j.checked_sub(first)).map_or(0.0, |(sense, parameter)| sense * steeper[parameter])
        };
        loop {
            let line = |(j, (du, dd)): (usize, &(f64, f64))| [du - top * dd - turn(j) * d, turn(j)];
            self.lines.extend(moved.iter().enumerate().map(line));
            if missing == 0 {
                break;
            }
            missing -= 1;
        }
    }

    /// Keeps so many pieces, those nearest to the centre.
    fn keep(&mut self, pieces: usize) {
        self.lines.truncate(pieces * self.count);
        self.kept = self.kept.min(pieces);
    }

    /// A path of growth begins at a height (m) with the slope dp/dh.
    pub(super) fn begin_growth(&mut self, height: f64, slope: f64, moved: &[(f64, f64)]) {
        self.heights.clear();
        self.grown.clear();
        self.grow(height, slope, moved);
    }

    /// It has come to a knot; what is no higher than the last one is that. By no number nothing moves.
    pub(super) fn grow(&mut self, height: f64, slope: f64, moved: &[(f64, f64)]) {
        if moved.is_empty() || self.heights.last().is_some_and(|last| height <= *last) {
            return;
        }
        self.heights.push(height);
        self.grown.extend(moved.iter().map(|(du, dd)| du - slope * dd));
    }

    /// The path has ended: its pieces, up to the knots that the memory has of it, become lines.
    fn end_growth(&mut self, curve: &Curve) {
        let Some(base) = self.heights.first().copied() else { return };
        let (mut low, mut from, mut to) = (base, vec![0.0; self.count], vec![0.0; self.count]);
        let mut above = 0;
        self.grown_at(base, above, &mut from);
        for high in curve.heights_from(curve.above(base)) {
            // Both ascend.
            above += self.heights[above..].iter().take_while(|h| **h < high).count();
            self.grown_at(high, above, &mut to);
            let rise = high - low;
            let line = |(from, to): (&f64, &f64)| {
                let slope = (to - from) / rise;
                [from - slope * low, slope]
            };
            self.lines.extend(from.iter().zip(&to).map(line));
            low = high;
            std::mem::swap(&mut from, &mut to);
        }
        self.heights.clear();
        self.grown.clear();
    }

    /// δp of the path at a height, m, by all numbers: the cubic through the four knots about it, or what there are. So many of them are
    /// below it.
    fn grown_at(&self, height: f64, below: usize, to: &mut [f64]) {
        let first = below.saturating_sub(2).min(self.heights.len().saturating_sub(KNOTS));
        let count = self.count;
        let grown = &self.grown[first * count..];
        match &self.heights[first..] {
            [a, b, c, d, ..] => {
                let shares = cubic([*a, *b, *c, *d], height);
                let (left, right) = grown.split_at(2 * count);
                let ((a, b), (c, d)) = (left.split_at(count), right.split_at(count));
                let knots = a.iter().zip(b).zip(c.iter().zip(d));
                for (to, ((a, b), (c, d))) in to.iter_mut().zip(knots) {
                    *to = shares[0] * a + shares[1] * b + shares[2] * c + shares[3] * d;
                }
            }
            few => {
                to.fill(0.0);
                for ((k, at), grown) in few.iter().enumerate().zip(grown.chunks_exact(count)) {
                    let others = few.iter().enumerate().filter(|(i, _)| *i != k);
                    let share: f64 = others.map(|(_, other)| (height - other) / (at - other)).product();
                    to.iter_mut().zip(grown).for_each(|(to, grown)| *to += share * grown);
                }
            }
        }
    }
}

/// Lagrange's shares of four knots in what the cubic through them is at x.
fn cubic([a, b, c, d]: [f64; KNOTS], x: f64) -> [f64; KNOTS] {
    let (left, right) = ((x - a) * (x - b), (x - c) * (x - d));
    [
        (x - b) * right / ((a - b) * (a - c) * (a - d)),
        (x - a) * right / ((b - a) * (b - c) * (b - d)),
        left * (x - d) / ((c - a) * (c - b) * (c - d)),
        left * (x - c) / ((d - a) * (d - b) * (d - c)),
    ]
}

/// What the anchors below a height hold, laid out for evaluations between two events.
#[derive(Debug, Clone, Default)]
pub(super) struct Held {
    count: usize,
    /// How many lines stand still below the first that moves.
    still: usize,
    /// Height, m(h) and M(h) at the foot of each piece.
    feet: Vec<[f64; 3]>,
    lines: Vec<[f64; 2]>,
    /// ∫δp dm below the foot of each piece, of all numbers.
    sums: Vec<f64>,
}

impl Held {
    /// Of a contact.
    pub(super) fn of(anchors: &Anchors, contact: &Contact, memory: &Memory) -> Self {
        let mut held = Self::default();
        held.lay_out(anchors, 0, (contact, memory));
        held
    }

    /// Of the contact as it now is, laid out before: what has stayed as it was stays.
    pub(super) fn renew(&mut self, anchors: &mut Anchors, of: (&Contact, &Memory)) {
        self.lay_out(anchors, anchors.kept, of);
        anchors.kept = anchors.pieces();
    }

    fn lay_out(&mut self, anchors: &Anchors, kept: usize, (contact, memory): (&Contact, &Memory)) {
        let Memory::Curve(curve) = memory else { return *self = Self::default() };
        let (count, pieces) = (anchors.count, anchors.pieces());
        // An edge may have come back to a knot but for rounding, and a knot may have moved below others: heights tell.
        let alike =
            self.feet.iter().zip(curve.heights_from(0)).take(kept).take_while(|(foot, h)| foot[0] == *h);
        let kept = alike.count();
        self.count = count;
        self.feet.truncate(kept);
        self.lines.truncate(kept * count);
        self.sums.truncate(kept * count);
        // A flat end has springs at the height 0, which the lowest piece holds.
        let profile = contact.interface.profile();
        for h in curve.heights_from(kept).take(pieces.saturating_sub(kept)) {
            self.add([h, profile.reduced_stiffness(h), profile.reduced_force(h)], anchors);
        }
        let is_still = |line: &&[f64; 2]| **line == [0.0; 2];
        let still = self.still.min(kept * count);
        self.still = still + self.lines[still..].iter().take_while(is_still).count();
    }

    /// Adds the next piece of anchors by its foot.
    fn add(&mut self, foot: [f64; 3], anchors: &Anchors) {
        let (piece, count) = (self.feet.len(), self.count);
        match piece.checked_sub(1) {
            Some(below) => {
                let part = Part::between(self.feet[below], foot);
                let (from, lines) = (below * count, &self.lines[below * count..]);
                self.sums.extend_from_within(from..);
                self.sums[piece * count..]
                    .iter_mut()
                    .zip(lines)
                    .for_each(|(sum, line)| *sum += part.of(line));
            }
            None => self.sums.resize(count, 0.0),
        }
        self.lines.extend_from_slice(&anchors.lines[piece * count..(piece + 1) * count]);
        self.feet.push(foot);
    }

    /// ∫δp dm over the springs below a height, m², by number `j`.
    pub(super) fn below(&self, profile: &Profile, height: f64, j: usize) -> f64 {
        self.at(profile, height).map_or(0.0, |at| self.sum(&at, j))
    }

    /// Place of the piece at a height, m; none where nothing is held.
    pub(super) fn piece(&self, height: f64) -> Option<usize> {
        let below = || self.feet.partition_point(|[foot, ..]| *foot < height).checked_sub(1);
        (self.still < self.lines.len()).then(below).flatten()
    }

    /// δp = a + bh on a piece, by number `j`.
    pub(super) fn line(&self, piece: usize, j: usize) -> [f64; 2] {
        self.lines[piece * self.count + j]
    }

    /// Where a height lies, asked once for all numbers; none where nothing is held.
    pub(super) fn at(&self, profile: &Profile, height: f64) -> Option<Cut> {
        let piece = self.piece(height)?;
        let end = [height, profile.reduced_stiffness(height), profile.reduced_force(height)];
        Some(Cut { piece, part: Part::between(self.feet[piece], end) })
    }

    /// ∫δp dm up to there.
    #[inline]
    pub(super) fn sum(&self, at: &Cut, j: usize) -> f64 {
        let place = at.piece * self.count + j;
        self.sums[place] + at.part.of(&self.lines[place])
    }
}

/// Where a front cuts a memory.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut {
    piece: usize,
    /// Of that piece, up to the front.
    part: Part,
}

/// A part of a piece: ∫δp dm over it is a Δm + b Δ(hm - M).
#[derive(Debug, Clone, Copy)]
struct Part {
    /// Δm and Δ(hm - M).
    sums: [f64; 2],
}

impl Part {
    /// From a height to another, with m and M there.
    fn between([low, least, below]: [f64; 3], [h, m, force]: [f64; 3]) -> Self {
        Self { sums: [m - least, h * m - low * least - (force - below)] }
    }

    #[inline]
    fn of(&self, [a, b]: &[f64; 2]) -> f64 {
        a * self.sums[0] + b * self.sums[1]
    }
}
