//! How the end of an arc moves with what the arc is made of.
//!
//! From a moment on, Δ being the way since, ν² = ν₀² + 2W with W = b₀Δ - Σ α[N'(h₀)Δ - (N(h₀) - N(h))/λ] and h = h₀ - λΔ. Each quantity
//! p out of ν₀, b₀ and, of every contact, ln α, ln λ and h₀ changes ν²/2 at a given way by w = ∂(ν²/2)/∂p in closed form. A turning
//! point moves by δq = -w/b. At a given angle q moves with both of them, so that with r = w + b δq the time T = ∫g dθ changes by
//!
//! ∂T = -∫g (r/ν² - δ(q₂-q₁)/(q₂-q₁)) dθ,
//!
//! one smooth quadrature for all of them; what is left follows from T = const. No equation is integrated.

use super::stretch::Stretch;
use super::{Clock, Swing};
use crate::quadrature::{self, ARCS, LANES, Lanes, Nodes, RULES, total};
use std::array;
use std::f64::consts::PI;

/// Quantities that are those of no contact: the speed ν₀ and the acceleration b₀ along the slide.
pub(crate) const SPEED: usize = 0;
pub(crate) const PUSH: usize = 1;
/// Where those of a contact begin, by its place among the contacts in partial slip: ln α, ln λ and h₀.
pub(crate) const EACH: usize = 3;
const FIRST: usize = 2;

/// How much more than c² an integral may be off whose last coefficients are c, in parts of the mean size of what is summed up.
const CAUTION: f64 = 10.0;
/// So near to a turning point, as a part of the arc, without being there, its speed has lost its digits.
const LOST: f64 = 1e-9;

/// By quantity: changes of the way (m) and of the speed (m/s) at the end, at the time at which it is reached. Scratch.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rates {
    pub(crate) ends: Vec<[f64; 2]>,
    /// Both turning points' changes, w at a place and at four, and the sums of ∂T, node by node: its value, two coefficients, its size.
    low: Vec<f64>,
    high: Vec<f64>,
    works: Vec<[f64; 1]>,
    lanes: Vec<Lanes>,
    sums: Vec<[Lanes; 4]>,
    firsts: Vec<First>,
}

/// A contact where the arc begins: the height of its front, m, and αN there with its first two derivatives.
#[derive(Debug, Clone, Copy)]
struct First {
    height: f64,
    sums: [f64; 3],
}

/// Where the quantity of a contact stands.
pub(crate) fn place(slip: usize, quantity: usize) -> usize {
    FIRST + EACH * slip + quantity
}

/// An arc as it is at the moment from which changes are counted.
struct Origin<'s> {
    swing: &'s Swing<'s>,
    firsts: &'s [First],
    way: f64,
    speed: f64,
    push: f64,
    /// The way between both turning points, m; 1 where none is sought.
    range: f64,
}

impl Origin<'_> {
    /// w of all quantities at ways q of the swing, m, and b there.
    #[inline(always)]
    fn works<const L: usize>(&self, q: [f64; L], works: &mut Vec<[f64; L]>) -> [f64; L] {
        let ways = q.map(|q| q - self.way);
        works.clear();
        works.extend([[self.speed; L], ways]);
        let mut push = [self.push; L];
        for (slip, First { height, sums: [n0, p0, s0] }) in self.swing.slips.iter().zip(self.firsts) {
            let [n, p, _] = slip.sums(ways.map(|way| height - slip.lean * way));
            let (means, falls) = (n.map(|n| (n0 - n) / slip.lean), p.map(|p| p0 - p));
            (0..L).for_each(|i| push[i] -= falls[i]);
            works.extend([
                array::from_fn(|i| means[i] - p0 * ways[i]),
                array::from_fn(|i| p[i] * ways[i] - means[i]),
                array::from_fn(|i| falls[i] / slip.lean - s0 * ways[i]),
            ]);
        }
        push
    }

    /// Shares of both turning points in the way at an angle.
    #[inline(always)]
    fn share(&self, q: f64) -> [f64; 2] {
        match self.swing.clock {
            Clock::Way => [0.0; 2],
            Clock::Angle => [(self.swing.high - q) / self.range, (q - self.swing.low) / self.range],
        }
    }
}

impl Rates {
    /// Those of an arc; false where the quadrature of no rule serves, or its end has no digits.
    pub(crate) fn find(&mut self, arc: &Stretch<'_>, allowed: f64) -> bool {
        let mut firsts = std::mem::take(&mut self.firsts);
        firsts.clear();
        let begin = arc.swing.way(arc.clock[0]);
        firsts.extend(arc.swing.slips.iter().map(|slip| {
            let height = slip.height - slip.lean * begin;
            First { height, sums: slip.sums([height]).map(|[sum]| sum) }
        }));
        let is_found = self.find_from(arc, (begin, &firsts), allowed);
        self.firsts = firsts;
        is_found
    }

    fn find_from(&mut self, arc: &Stretch<'_>, (begin, firsts): (f64, &[First]), allowed: f64) -> bool {
        let (swing, to) = (arc.swing, arc.clock[1]);
        let end = swing.way(to);
        let [first, last] = swing.speed_at([begin, end]);
        let [_, [push], _] = swing.force([begin]);
        let range = if swing.clock == Clock::Way { 1.0 } else { swing.high - swing.low };
        let origin = Origin { swing, firsts, way: begin, speed: first, push, range };
        let count = FIRST + EACH * swing.slips.len();
        let turns = swing.clock == Clock::Angle && to == PI;
        let is_lost = !turns && swing.clock == Clock::Angle && swing.high - end < LOST * range;
        if is_lost || !self.turn(&origin, count) || !self.times(arc, &origin, allowed) {
            return false;
        }
        let (start, finish) = (origin.share(begin), origin.share(end));
        let [bend] = origin.works([end], &mut self.works);
        self.ends.clear();
        for k in 0..count {
            let (low, high) = (self.low[k], self.high[k]);
            let moved = |[a, b]: [f64; 2]| a * low + b * high;
            // By how much the clock is late where it begins, s: from rest, where no turning point moves, by the speed alone.
            let late = match swing.clock {
                Clock::Way => 0.0,
                Clock::Angle if first > 0.0 => -moved(start) / first,
                Clock::Angle if k == SPEED => push.recip(),
                Clock::Angle => 0.0,
            };
            let late = late - total(self.sums[k][0]);
            // Where it turns it is at rest to the last bit, and goes along its turning point.
            let (way, speed) = if turns {
                (high, 0.0)
            } else {
                (moved(finish) + last * late, (self.works[k][0] + bend * moved(finish)) / last)
            };
            self.ends.push([way, speed + bend * late]);
        }
        self.ends.iter().flatten().all(|rate| rate.is_finite())
    }

    /// How both turning points move; false where one of them has no force.
    fn turn(&mut self, origin: &Origin<'_>, count: usize) -> bool {
        let swing = origin.swing;
        for (at, moved) in [(swing.low, &mut self.low), (swing.high, &mut self.high)] {
            moved.clear();
            moved.resize(count, 0.0);
            if swing.clock == Clock::Way {
                continue;
            }
            let [bend] = origin.works([at], &mut self.works);
            if bend == 0.0 {
                return false;
            }
            moved.iter_mut().zip(&self.works).for_each(|(moved, [work])| *moved = -work / bend);
        }
        true
    }

    /// ∂T by the coarsest rule that serves, s; false where none does.
    fn times(&mut self, arc: &Stretch<'_>, origin: &Origin<'_>, allowed: f64) -> bool {
        let rules = if arc.is_whole() { &ARCS } else { &RULES };
        quadrature::worth_trying(rules, allowed).any(|rule| {
            self.sums.clear();
            self.sums.resize(self.low.len(), [[0.0; LANES]; 4]);
            rule.nodes().for_each(|nodes| self.add(arc, origin, nodes));
            self.sums.iter().all(|sums| {
                let [value, second, first, size] = sums.map(total);
                let tail = (second.abs() + first.abs()) / size;
                value.is_finite() && (size == 0.0 || CAUTION * tail * tail <= allowed)
            })
        })
    }

    /// Adds what four nodes make of the sums.
    fn add(&mut self, arc: &Stretch<'_>, origin: &Origin<'_>, nodes: &Nodes) {
        let (ways, paces, squares) = arc.nodes(nodes.at);
        let bends = origin.works(ways, &mut self.lanes);
        let shares = ways.map(|way| origin.share(way));
        let near: [Lanes; 2] = array::from_fn(|end| array::from_fn(|i| shares[i][end] * bends[i]));
        let slower: Lanes = array::from_fn(|i| -paces[i] / squares[i]);
        let wider = paces.map(|pace| pace / origin.range);
        let moved = self.low.iter().zip(&self.high).zip(&self.lanes);
        for (sums, ((low, high), works)) in self.sums.iter_mut().zip(moved) {
            let gone: Lanes = array::from_fn(|i| works[i] + near[0][i] * low + near[1][i] * high);
            let rates: Lanes = array::from_fn(|i| wider[i] * (high - low) + slower[i] * gone[i]);
            for (sum, shares) in sums.iter_mut().zip(&nodes.shares) {
                (0..LANES).for_each(|i| sum[i] += shares[i] * rates[i]);
            }
            (0..LANES).for_each(|i| sums[3][i] += nodes.shares[0][i] * rates[i].abs());
        }
    }
}

impl Stretch<'_> {
    /// Whether it goes from turn to turn: then the places of nodes on the way are known.
    fn is_whole(&self) -> bool {
        self.swing.clock == Clock::Angle && !self.swing.nears && self.clock == [0.0, PI]
    }

    /// Ways at parts of the stretch, m, how fast time goes there per part, s, and ν².
    fn nodes(&self, parts: Lanes) -> (Lanes, Lanes, Lanes) {
        let (swing, [begin, end]) = (self.swing, self.clock);
        let (ways, paces) = if self.is_whole() {
            (parts.map(|part| swing.low + (swing.high - swing.low) * part), [PI; LANES])
        } else if swing.nears {
            let [first, last] = [begin, end].map(|at| (swing.to - at).max(0.0).sqrt());
            let left = parts.map(|part| first + part * (last - first));
            (left.map(|left| swing.way(swing.to - left * left)), left.map(|left| 2.0 * left * (first - last)))
        } else {
            (parts.map(|part| swing.way(begin + part * (end - begin))), [end - begin; LANES])
        };
        let speeds = swing.speed_at(ways);
        let slow = |i: usize| match swing.clock {
            Clock::Way => paces[i] / speeds[i],
            // dq/dθ is the root of both distances.
            Clock::Angle => {
                paces[i] * ((ways[i] - swing.low) * (swing.high - ways[i])).max(0.0).sqrt() / speeds[i]
            }
        };
        (ways, array::from_fn(slow), speeds.map(|speed| speed * speed))
    }
}
