//! The fixed point of the map of a period.
//!
//! Plain periods as long as they come nearer by themselves; else Newton's method on the defect, its gradient by differences, mended by
//! Broyden's rule from period to period and made anew where that no longer helps. Where a step leads away it is halved.
//! Directions along which nothing changes, as in a shakedown, are left alone: the nearest fixed point is the one.

use super::SteadyError;
use super::map::{Gradient, Map, near};
use nalgebra::{DMatrix, DVector};
use stickslip_drive::State;
use stickslip_drive::section::Section;

/// A defect this many times the tolerance is none.
const GOAL: f64 = 10.0;
/// A defect below this, in natural scales, that gets no smaller is one of rounding.
const ROUNDING: f64 = 1e-8;
/// Plain periods that come nearer by this are let go on.
const BY_ITSELF: f64 = 0.05;
/// A gradient that brings less than this is made anew, unless it takes fewer periods to the end than that.
const WORN: f64 = 0.1;
/// Halvings of a step.
const HALVINGS: u32 = 4;
/// Differences are taken so many times as far apart, up to that many natural scales, where a step by a new gradient brings nothing: of a heavy
/// slider, whose speed is nearly the same after a period, near by they tell what rounding leaves. So often that is tried in vain; where a plain
/// period changes the defect by less than this share they are taken that far apart at once.
const WIDER: f64 = 100.0;
const WIDEST: f64 = 1e-2;
const IN_VAIN: u32 = 4;
const SLOW: f64 = 1e-3;
/// Plain periods after a step that nothing has helped.
const PLAIN: u32 = 8;
/// Plain periods in a row that add the same to a state, after which none is waited for that does not.
const SAME: u32 = 32;
/// How far what they add may differ, as a share of it, and how large it is at least, in tolerances.
const ALIKE: f64 = 1e-6;
const LARGE: f64 = 1e4;
/// Singular values below this, as a part of the largest, are directions of no change.
const FLAT: f64 = 1e-7;

/// How a period's state was found from the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// It is where that one got to.
    Plain,
    /// By Newton's method.
    Newton,
}

/// What a period left to be wished for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Defect {
    /// Largest change of a number in the period, in natural scales.
    pub size: f64,
    /// How its state was found.
    pub way: Way,
}

/// A fixed point.
#[derive(Clone)]
pub(super) struct Fixed {
    pub(super) state: State,
    pub(super) image: super::map::Image,
    /// P(s) - s, in natural scales.
    pub(super) defect: DVector<f64>,
    /// On the way.
    pub(super) defects: Vec<Defect>,
}

/// Finds the fixed point of a map, from where its section was taken.
pub(super) fn fixed_point(map: &mut Map<'_>, from: &State) -> Result<Fixed, SteadyError> {
    let mut search = Search::new(map, from)?;
    loop {
        let size = search.size();
        if search.is_done() {
            return Ok(search.end());
        }
        if !map.may_go_on() {
            return Err(SteadyError::NoConvergence { best: search.least(), periods: map.work() });
        }
        let by_itself = search.gradient.is_none()
            && search.was_plain()
            && search.before.is_some_and(|before| size < BY_ITSELF * before);
        let never = search.before.is_none();
        if by_itself || never || map.unknowns() == 0 || !search.newton(map)? {
            let count = if by_itself || never { 1 } else { PLAIN };
            for _ in 0..count {
                search.plain(map)?;
            }
            search.check_gains(map)?;
        }
    }
}

/// A search under way.
struct Search {
    state: State,
    image: super::map::Image,
    /// None where the image has other knots.
    defect: Option<DVector<f64>>,
    /// Of the state before.
    before: Option<f64>,
    gradient: Option<Gradient>,
    goal: f64,
    defects: Vec<Defect>,
    /// The defect since when plain periods have added the same, and how many have.
    same: Option<(DVector<f64>, u32)>,
    /// Whether the last Newton step has brought nothing.
    stalled: bool,
    /// How far apart differences are taken, in natural scales, and how often that was tried farther in vain.
    apart: f64,
    in_vain: u32,
    /// What a period makes of what its steps miss, in natural scales: no defect gets smaller for sure.
    magnified: f64,
}

impl Search {
    fn new(map: &mut Map<'_>, from: &State) -> Result<Self, SteadyError> {
        let image = map.image(from, 1.0)?;
        let defect = map.difference(&image.state, from);
        let goal = GOAL * map.tolerance();
        let mut search = Self {
            state: from.clone(),
            image,
            defect,
            before: None,
            gradient: None,
            goal,
            defects: Vec::new(),
            same: None,
            stalled: false,
            apart: near(map.tolerance()),
            in_vain: 0,
            magnified: 0.0,
        };
        search.note(Way::Plain);
        Ok(search)
    }

    fn size(&self) -> f64 {
        self.defect.as_ref().map_or(f64::INFINITY, DVector::amax)
    }

    fn was_plain(&self) -> bool {
        self.defects.last().is_some_and(|defect| defect.way == Way::Plain)
    }

    fn least(&self) -> f64 {
        self.defects.iter().map(|defect| defect.size).fold(f64::INFINITY, f64::min)
    }

    fn note(&mut self, way: Way) {
        self.defects.push(Defect { size: self.size(), way });
    }

    fn is_done(&self) -> bool {
        let size = self.size();
        size <= self.goal || self.stalled && size <= self.least_sure()
    }

    /// A defect that is one of rounding, or of what the runs miss, where it gets no smaller.
    fn least_sure(&self) -> f64 {
        ROUNDING.max(self.magnified)
    }

    fn end(self) -> Fixed {
        let Self { state, image, defect, defects, .. } = self;
        let defect = defect.unwrap_or_else(|| DVector::zeros(0));
        Fixed { state, image, defect, defects }
    }

    /// A plain period: the state is where the last one got to. Where that has other knots, the map has other numbers.
    fn plain(&mut self, map: &mut Map<'_>) -> Result<(), SteadyError> {
        self.before = Some(self.size());
        if self.defect.is_none() {
            let section = Section::new(map.model(), self.image.state.clone());
            map.set(section);
        }
        self.gradient = None;
        self.state = self.image.state.clone();
        self.image = map.image(&self.state, 1.0)?;
        self.defect = map.difference(&self.image.state, &self.state);
        let is_slow = self.before.is_some_and(|before| (self.size() / before - 1.0).abs() < SLOW);
        self.apart = if is_slow { WIDEST } else { near(map.tolerance()) };
        self.note(Way::Plain);
        self.same = self.defect.clone().map(|defect| match self.same.take() {
            Some((first, count)) if is_alike(&first, &defect, map.tolerance()) => (first, count + 1),
            _ => (defect, 1),
        });
        Ok(())
    }

    /// Fails where every period adds the same to the state: what pulls is more than what holds, or an undamped swing is shaken at
    /// its own frequency. Ar = r, and no Newton step leads anywhere.
    fn check_gains(&self, map: &Map<'_>) -> Result<(), SteadyError> {
        match (&self.same, map.section()) {
            (Some((defect, periods)), Some(section)) if *periods >= SAME => {
                let number = section.unknowns()[defect.iamax()];
                Err(SteadyError::Gains { number: section.name(number), periods: *periods })
            }
            _ => Ok(()),
        }
    }

    /// A step of Newton's method, halved until it brings something; false where it does not.
    fn newton(&mut self, map: &mut Map<'_>) -> Result<bool, SteadyError> {
        let Some(defect) = self.defect.clone() else { return Ok(false) };
        let fresh = self.gradient.is_none();
        let gradient = match self.gradient.take() {
            Some(gradient) => gradient,
            None => map.near_gradient((&self.state, &self.image), self.apart)?,
        };
        let Some(step) = step(&gradient.numbers, &defect) else { return Ok(false) };
        let mut share = 1.0;
        for _ in 0..HALVINGS {
            if self.try_step(map, (&gradient, &step), (&defect, share))? {
                return Ok(true);
            }
            // A gradient that has been mended may be at fault, and not the length.
            if !fresh {
                return self.newton(map);
            }
            share *= 0.5;
        }
        if self.in_vain < IN_VAIN && self.apart * WIDER <= WIDEST {
            self.apart *= WIDER;
            return self.newton(map);
        }
        self.in_vain += 1;
        self.stalled = true;
        self.magnified = self.goal * gradient.numbers.norm();
        Ok(self.size() <= self.least_sure())
    }

    /// How many more periods it takes where each leaves so much of a defect; a gradient made anew takes one for each number.
    fn lasts(&self, rate: f64, size: f64) -> f64 {
        math::ln(size / self.goal).max(0.0) / -math::ln(rate)
    }

    /// Tries a part of a step; taken if the defect gets smaller by a part of that.
    fn try_step(
        &mut self,
        map: &mut Map<'_>,
        (gradient, step): (&Gradient, &DVector<f64>),
        (defect, share): (&DVector<f64>, f64),
    ) -> Result<bool, SteadyError> {
        // What is carried along comes from the image: it is newer.
        let along = step * share;
        let Some(state) = map.moved(&self.image.state, &(&along - defect)) else { return Ok(false) };
        let image = match map.image(&state, 1.0) {
            Ok(image) => image,
            Err(SteadyError::Run(_)) => return Ok(false),
            Err(error) => return Err(error),
        };
        let Some(after) = map.difference(&image.state, &state) else { return Ok(false) };
        let (size, before) = (after.amax(), defect.amax());
        if size.is_nan() || size > (1.0 - 0.25 * share) * before {
            return Ok(false);
        }
        let pays = size <= WORN * before || self.lasts(size / before, size) <= defect.len() as f64;
        self.gradient = pays.then(|| mended(gradient, (&along, defect, &after)));
        (self.state, self.image, self.defect) = (state, image, Some(after));
        self.before = Some(before);
        self.same = None;
        self.note(Way::Newton);
        Ok(true)
    }
}

/// Whether two defects are one, large enough to tell.
fn is_alike(first: &DVector<f64>, other: &DVector<f64>, tolerance: f64) -> bool {
    let size = first.amax();
    first.len() == other.len()
        && size > LARGE * tolerance
        && (first - other).amax() <= ALIKE * size + tolerance
}

/// (1 - A)⁻¹ r, the smallest where there are several.
fn step(gradient: &DMatrix<f64>, defect: &DVector<f64>) -> Option<DVector<f64>> {
    let count = defect.len();
    let matrix = DMatrix::identity(count, count) - gradient;
    let step = solve(matrix, defect)?;
    step.iter().all(|x| x.is_finite()).then_some(step)
}

/// The smallest solution of a linear system, its flat directions left out.
pub(super) fn solve(matrix: DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let svd = matrix.svd(true, true);
    let flat = FLAT * svd.singular_values.max();
    svd.solve(right, flat).ok()
}

/// Broyden's rule: the gradient that agrees with the last step and changes least. A of P, r = P - s: Δr = (A - 1)Δs.
fn mended(
    gradient: &Gradient,
    (along, before, after): (&DVector<f64>, &DVector<f64>, &DVector<f64>),
) -> Gradient {
    let mut mended = gradient.clone();
    let length = along.norm_squared();
    if length > 0.0 {
        let missed = after - before - (&gradient.numbers * along - along);
        mended.numbers += missed * along.transpose() / length;
    }
    mended
}
