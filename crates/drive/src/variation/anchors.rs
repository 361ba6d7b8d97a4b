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
        let legs = curve.legs();
        let sense = legs.slopes.len().checked_sub(1).and_then(|last| legs.sense(&contact.interface, last));
        let (slopes, d) = (&legs.slopes, memory.apex().d);
        let Some((top, below)) = slopes.split_last() else {
            self.lines.clear();
            return;
        };
        self.end_growth(curve);
        if !has_edge && self.pieces() >= slopes.len() {
            return self.lines.truncate(slopes.len() * self.count);
        }
        self.lines.truncate(below.len() * self.count);
        // What comes to be below the last piece without having been followed moves with it: pieces of rounding.
        let mut missing = below.len().saturating_sub(self.pieces());
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

    /// A path of growth begins at a height (m) with the slope dp/dh.
    pub(super) fn begin_growth(&mut self, height: f64, slope: f64, moved: &[(f64, f64)]) {
        self.heights.clear();
        self.grown.clear();
        self.grow(height, slope, moved);
    }

    /// It has come to a knot; what is no higher than the last one is that.
    pub(super) fn grow(&mut self, height: f64, slope: f64, moved: &[(f64, f64)]) {
        if self.heights.last().is_some_and(|last| height <= *last) {
            return;
        }
        self.heights.push(height);
        self.grown.extend(moved.iter().map(|(du, dd)| du - slope * dd));
    }

    /// The path has ended: its pieces, up to the knots that the memory has of it, become lines.
    fn end_growth(&mut self, curve: &Curve) {
        let Some(base) = self.heights.first().copied() else { return };
        let (mut low, mut from) = (base, self.grown_at(base));
        for (high, _) in curve.knots().filter(|(h, _)| *h > base) {
            let to = self.grown_at(high);
            for (from, to) in from.iter().zip(&to) {
                let slope = (to - from) / (high - low);
                self.lines.push([from - slope * low, slope]);
            }
            (low, from) = (high, to);
        }
        self.heights.clear();
        self.grown.clear();
    }

    /// δp of the path at a height, m, by all numbers: the cubic through the four knots about it, or what there are.
    fn grown_at(&self, height: f64) -> Vec<f64> {
        let above = self.heights.partition_point(|h| *h < height);
        let first = above.saturating_sub(2).min(self.heights.len().saturating_sub(4));
        let about = first..self.heights.len().min(first + 4);
        let mut sum = vec![0.0; self.count];
        for k in about.clone() {
            let at = |i: usize| self.heights[i];
            let others = about.clone().filter(|i| *i != k);
            let share: f64 = others.map(|i| (height - at(i)) / (at(k) - at(i))).product();
            let grown = &self.grown[k * self.count..(k + 1) * self.count];
            sum.iter_mut().zip(grown).for_each(|(sum, grown)| *sum += share * grown);
        }
        sum
    }
}

/// What the anchors below a height hold, laid out for evaluations between two events.
#[derive(Debug, Clone, Default)]
pub(super) struct Held {
    count: usize,
    /// Height, m(h) and M(h) at the foot of each piece.
    feet: Vec<[f64; 3]>,
    lines: Vec<[f64; 2]>,
    /// ∫δp dm below the foot of each piece, of all numbers.
    sums: Vec<f64>,
}

impl Held {
    /// Of a contact.
    pub(super) fn of(anchors: &Anchors, contact: &Contact, memory: &Memory) -> Self {
        let Memory::Curve(curve) = memory else { return Self::default() };
        let (count, profile) = (anchors.count, contact.interface.profile());
        // A flat end has springs at the height 0, which the lowest piece holds.
        let foot = |h: f64| [h, profile.reduced_stiffness(h), profile.reduced_force(h)];
        let feet: Vec<[f64; 3]> = curve.knots().map(|(h, _)| foot(h)).take(anchors.pieces()).collect();
        let lines = anchors.lines[..feet.len() * count].to_vec();
        if lines.iter().all(|line| *line == [0.0; 2]) {
            return Self::default();
        }
        let mut held = Self { count, feet, lines, sums: vec![0.0; count] };
        for piece in 1..held.feet.len() {
            for j in 0..count {
                let sum = held.sums[(piece - 1) * count + j] + held.part(piece - 1, held.feet[piece], j);
                held.sums.push(sum);
            }
        }
        held
    }

    /// ∫δp dm = a Δm + b Δ(hm - M) from the foot of a piece to a height.
    fn part(&self, piece: usize, [h, m, force]: [f64; 3], j: usize) -> f64 {
        let ([low, least, below], [a, b]) = (self.feet[piece], self.lines[piece * self.count + j]);
        a * (m - least) + b * (h * m - low * least - (force - below))
    }

    /// ∫δp dm over the springs below a height, m², by number `j`.
    pub(super) fn below(&self, profile: &Profile, height: f64, j: usize) -> f64 {
        self.at(profile, height).map_or(0.0, |at| self.sum(&at, j))
    }

    /// Where a height lies, asked once for all numbers; none where nothing is held.
    pub(super) fn at(&self, profile: &Profile, height: f64) -> Option<Cut> {
        let piece = self.feet.partition_point(|[foot, ..]| *foot < height).checked_sub(1)?;
        let end = [height, profile.reduced_stiffness(height), profile.reduced_force(height)];
        Some(Cut { piece, end })
    }

    /// ∫δp dm up to there.
    #[inline]
    pub(super) fn sum(&self, at: &Cut, j: usize) -> f64 {
        self.sums[at.piece * self.count + j] + self.part(at.piece, at.end, j)
    }
}

/// Where a front cuts a memory.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut {
    piece: usize,
    /// Height, m(h), M(h).
    pub(super) end: [f64; 3],
}
