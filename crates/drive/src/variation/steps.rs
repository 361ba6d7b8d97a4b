//! Steps of a variation: the linear equations led along the steps of the run.

use super::tangent::{Laws, Stand};
use super::{Variation, VariationError};
use crate::contact::Mode;
use crate::equations::Equations;
use crate::record::Stride;
use crate::state::State;
use stickslip_stepper::{Components, Gauss, NODES};

/// What a step of the variation may miss, in natural scales, in tolerances of the run's own steps: multipliers of the impact drive, the
/// climber and the three-ball stage by 1e-10 are those by 1e-12 to ten digits.
const ALLOWED: f64 = 100.0;
/// What a step of a swing misses whose slopes have the last Legendre coefficient c, in natural scales, is 1.25e-3 c^2.2: a swing by one
/// radian 1e-10.
const MISSED: (f64, f64) = (1.25e-3, 2.2);
/// Where roots are near it is this part of the tenth coefficient that the others let expect. More would be spent on swings, whose
/// coefficients fall the faster the later they come.
const ROOT: f64 = 0.1;
/// It falls with the power 11 of the step. Part of the step that would just do, the strongest shortening at once, and the shortest step
/// that is tried, as a part of the run's.
const FALLS: f64 = 1.0 / 11.0;
const SAFETY: f64 = 0.9;
const SHRINK: f64 = 0.2;
const SHORTEST: f64 = 1e-3;

/// Part of the height at which it begins to which a front has to fall that nodes crowd; and what goes slower than this at an end, as a part
/// of what it does half way, crowds there by itself.
const LOW: f64 = 0.5;
const SLOW: f64 = 0.25;

/// How nodes lie in a stride: evenly in the root of a height that goes evenly with the part.
#[derive(Debug, Clone, Copy)]
struct Grade {
    /// The roots of the height at its ends, and which they are: the n-th.
    roots: [f64; 2],
    n: f64,
}

impl Grade {
    const EVEN: Self = Self { roots: [0.0, 1.0], n: 1.0 };

    /// For a height that goes between these.
    fn between(heights: [f64; 2], n: f64) -> Self {
        Self { roots: heights.map(|height| math::powf(height.max(0.0), n.recip())), n }
    }

    /// Part of the stride where the roots have gone so far, and how steeply it moves with that.
    fn part(self, gone: f64) -> (f64, f64) {
        let [from, to] = self.roots;
        if self.n == 1.0 {
            return (gone, 1.0);
        }
        let (rise, all) = (to - from, math::powf(to, self.n) - math::powf(from, self.n));
        let root = from + rise * gone;
        (
            (math::powf(root, self.n) - math::powf(from, self.n)) / all,
            self.n * math::powf(root, self.n - 1.0) * rise / all,
        )
    }
}

/// The motion at a node of a step, where numbers of the scene need it.
#[derive(Debug, Clone, Default)]
pub(super) struct Passed {
    /// Time by which the run tells it, and that of the variation, s.
    pub(super) t: f64,
    pub(super) now: f64,
    pub(super) y: Vec<f64>,
    /// Where the contacts stand that act.
    pub(super) stands: Vec<Stand>,
    /// Rates of all components, where a mass moves.
    pub(super) slopes: Vec<f64>,
}

impl Variation<'_> {
    /// Whether anything acts on the derivatives: else velocities stay as they are.
    pub(super) fn acts(&self) -> bool {
        !self.acting.is_empty() || !self.model.links.is_empty() || !self.parameters.is_empty()
    }

    /// Leads the derivatives over a time in which nothing acts on them, s.
    pub(super) fn drift(&mut self, time: f64) {
        let free = self.layout.free;
        for column in self.columns.chunks_exact_mut(self.layout.dimension().max(1)) {
            let (x, rest) = column.split_at_mut(free);
            x.iter_mut().zip(rest).for_each(|(x, v)| *x += time * *v);
        }
    }

    /// How many components a step tells: the forces of growing contacts are some of them; no leap has any.
    fn known(&self, from: &State) -> usize {
        if self.components(from).rates > self.layout.free {
            self.layout.dimension()
        } else {
            2 * self.layout.free
        }
    }

    /// Leads the derivatives along a step of the run, in as many steps as it takes.
    pub(super) fn follow(&mut self, from: &State, stride: &mut dyn Stride) -> Result<(), VariationError> {
        if !self.acts() || self.leap(from, stride) {
            return Ok(());
        }
        let (grade, begin) = self.grade(from, stride);
        self.time = begin;
        let (mut at, mut length) = (0.0, self.longest);
        while at < 1.0 {
            // No stub is left for the last step.
            let to = if at + 1.01 * length >= 1.0 { 1.0 } else { at + length };
            let missed = self.attempt(from, stride, (at, to), grade) / (ALLOWED * self.tolerance);
            if missed <= 1.0 {
                self.grow(from, stride, (at, to));
                self.work(from);
                self.columns.copy_from_slice(self.method.end());
                self.time += self.length;
                at = to;
                continue;
            }
            let shorter = (SAFETY * math::powf(missed, -FALLS)).max(SHRINK) * (to - at);
            if shorter.is_nan() || shorter < SHORTEST {
                return Err(VariationError::NotSmooth { t: from.t });
            }
            // As many steps as it takes, of one length.
            length = (1.0 - at) / ((1.0 - at) / shorter).ceil();
        }
        Ok(())
    }

    /// Adds up works over the step just tried.
    fn work(&mut self, from: &State) {
        if !self.works.are_led() {
            return;
        }
        let mut works = std::mem::take(&mut self.works);
        let laws = self.laws(from);
        for (passed, powers) in self.passed.iter().zip(&mut works.powers) {
            laws.lay_out_powers(passed, powers);
        }
        let (powers, sums) = works.sums();
        self.method.integrate(powers, laws.components, &self.columns, sums);
        self.works = works;
    }

    /// The linear equations of an interval.
    pub(super) fn laws<'a>(&'a self, from: &'a State) -> Laws<'a> {
        Laws {
            eq: Equations::on(self.model, from, self.layout, false),
            held: &self.held,
            acting: &self.acting,
            links: &self.links,
            components: self.components(from),
            count: self.count(),
            parameters: self.parameters,
            moving: &self.moving,
            shifts: &from.shifts,
        }
    }

    /// The components of an interval: the forces of growing contacts are led along as far as any of these grows.
    pub(super) fn components(&self, from: &State) -> Components {
        let growing = self.model.contacts.iter().zip(&from.modes).filter(|(_, mode)| **mode == Mode::Grow);
        let highest = growing.filter_map(|(contact, _)| contact.slot).max();
        let free = self.layout.free;
        let rates = highest.map_or(free, |slot| self.layout.force(slot) + 1 - free);
        Components { positions: free, rates, stride: self.layout.dimension() }
    }

    /// How nodes lie in a stride. The stiffness of a contact goes as a root of the height of its slip front ([`Contact::root`]): where
    /// that comes near the centre nodes lie evenly in the root. Also when it begins, s.
    fn grade(&mut self, from: &State, stride: &mut dyn Stride) -> (Grade, f64) {
        let (mut y, mut heights) = (std::mem::take(&mut self.y), std::mem::take(&mut self.heights));
        let laws = self.laws(from);
        let mut rate = |part: f64, y: &mut [f64]| stride.at(part, &mut y[..2 * self.layout.free]);
        // Parts of the depth.
        let height = |c: usize, t: f64, y: &[f64]| {
            let (contact, (memory, mode)) = (&self.model.contacts[c], laws.eq.law(c));
            match mode {
                Mode::Slip(branch) if !branch.is_gross() => {
                    let motion = laws.eq.motion(contact, t, |i| y[i]);
                    contact.front(memory, branch, &motion).max(0.0) / motion.d
                }
                _ => 1.0,
            }
        };
        let ([_, middle], [begin, first]) = (rate(0.5, &mut y), rate(0.0, &mut y));
        heights.clear();
        heights.extend(self.acting.iter().map(|c| height(*c, begin, &y)));
        let [end, last] = rate(1.0, &mut y);
        let ends = self.acting.iter().zip(&heights).map(|(c, from)| (*c, [*from, height(*c, end, &y)]));
        let is_even = first.min(last) > SLOW * middle && laws.components.rates == self.layout.free;
        let low: Vec<_> = ends.filter(|(_, [from, to])| *to < LOW * from).collect();
        let lowest = low.iter().map(|(_, ends)| *ends).min_by(|[_, a], [_, b]| a.total_cmp(b));
        (self.y, self.heights) = (y, heights);
        let grade = match lowest {
            // What is smooth in a root is hardly less so in a higher one.
            Some(ends) if is_even => {
                let roots = low.iter().map(|(c, _)| self.model.contacts[*c].root());
                Grade::between(ends, roots.fold(1.0, f64::max))
            }
            _ => Grade::EVEN,
        };
        (grade, begin)
    }

    /// Tries one step between two places of a graded stride and tells what it misses, in natural scales.
    fn attempt(
        &mut self,
        from: &State,
        stride: &mut dyn Stride,
        (begin, end): (f64, f64),
        grade: Grade,
    ) -> f64 {
        let (mut nodes, mut passed) = (std::mem::take(&mut self.nodes), std::mem::take(&mut self.passed));
        let mut y = std::mem::take(&mut self.y);
        let laws = self.laws(from);
        let components = laws.components;
        let known = self.known(from);
        let (mut paces, is_moved) = ([0.0; NODES], !self.parameters.is_empty());
        let each = nodes.iter_mut().zip(&mut passed);
        for ((place, pace), (node, passed)) in Gauss::places().into_iter().zip(&mut paces).zip(each) {
            let (part, steep) = grade.part(begin + place * (end - begin));
            let [t, rate] = stride.at(part, &mut y[..known]);
            *pace = rate * steep * (end - begin);
            laws.lay_out((t, &y), node, &mut passed.stands);
            if is_moved {
                passed.t = t;
                passed.y.clone_from(&y);
            }
        }
        // A leap tells places by a time of its own.
        let (times, length) = Gauss::times(paces);
        for ((time, passed), node) in times.iter().zip(&mut passed).zip(&mut nodes).filter(|_| is_moved) {
            passed.now = self.time + time;
            laws.move_by_numbers(passed, node);
        }
        let tail = self.method.attempt((paces, &nodes), components, &self.columns, &self.scale);
        (self.nodes, self.passed, self.y, self.length) = (nodes, passed, y, length);
        (MISSED.0 * math::powf(tail.last, MISSED.1)).max(ROOT * tail.rest)
    }
}
