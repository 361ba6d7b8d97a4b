//! Fixed point of the Poincaré map by Newton's method.
//!
//! Periods are simulated as long as they reduce the defect quickly. Otherwise Newton's method follows, with a Jacobian by finite
//! differences. Broyden's update corrects the Jacobian after each step; a new Jacobian is computed if the convergence is slow. Newton steps
//! that do not reduce the defect are halved. Singular directions, as in a shakedown, are excluded, so the nearest fixed point is found.

use super::SteadyError;
use super::map::{Gradient, Map, near};
use nalgebra::{DMatrix, DVector};
use stickslip_drive::State;
use stickslip_drive::section::Section;

/// Factor on the tolerance below which the defect counts as zero.
const GOAL: f64 = 10.0;
/// Defect in natural scales that is accepted as rounding error if it does not decrease further.
const ROUNDING: f64 = 1e-8;
/// Largest ratio of successive defects at which periods are simulated instead of using Newton's method.
const BY_ITSELF: f64 = 0.05;
/// Largest ratio of defects for which an updated Jacobian is kept. An updated Jacobian is also kept if a new one needs more periods.
const WORN: f64 = 0.1;
/// Number of fractions of a Newton step that are tried; each fraction is half of the previous one.
const HALVINGS: u32 = 4;
/// Enlargement of finite differences, if a step with a new Jacobian does not reduce the defect.
///
/// The distance of finite differences is multiplied by `WIDER` up to `WIDEST` natural scales; at most `IN_VAIN` times without success. If a
/// simulated period changes the defect by less than the fraction `SLOW`, the distance is `WIDEST` from the start. An example is a heavy
/// slider, for which rounding errors would dominate smaller differences.
const WIDER: f64 = 100.0;
const WIDEST: f64 = 1e-2;
const IN_VAIN: u32 = 4;
const SLOW: f64 = 1e-3;
/// Number of simulated periods after an unsuccessful Newton step.
const PLAIN: u32 = 8;
/// Number of consecutive periods with the same increase of the state after which the search ends.
const SAME: u32 = 32;
/// Relative tolerance for equal increases, and their minimum size as a multiple of the tolerance.
const ALIKE: f64 = 1e-6;
const LARGE: f64 = 1e4;
/// Singular values below this fraction of the largest singular value are treated as zero.
const FLAT: f64 = 1e-7;

/// Method that computed the state at the start of a period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Simulation: the state is the end state of the previous period.
    Plain,
    /// Newton's method.
    Newton,
}

/// Defect of one period of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Defect {
    /// Largest change of an unknown in the period, in natural scales.
    pub size: f64,
    /// Method that computed the state at the start of the period.
    pub way: Way,
}

/// A fixed point of the Poincaré map.
#[derive(Clone)]
pub(super) struct Fixed {
    pub(super) state: State,
    pub(super) image: super::map::Image,
    /// P(s) - s, in natural scales.
    pub(super) defect: DVector<f64>,
    /// Defects of all periods of the search.
    pub(super) defects: Vec<Defect>,
}

/// Finds a fixed point of a Poincaré map, starting from the state of its section.
///
/// # Errors
/// Fails if the iteration does not converge within the allowed periods, every period adds the same amount to the state,
/// or a run fails.
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

/// State of the iteration.
struct Search {
    state: State,
    image: super::map::Image,
    /// Defect P(s) - s. `None` if the image has another number of breakpoints of the slip memory.
    defect: Option<DVector<f64>>,
    /// Size of the defect in the previous period.
    before: Option<f64>,
    gradient: Option<Gradient>,
    goal: f64,
    defects: Vec<Defect>,
    /// Increase of the state that is the same in successive simulated periods, and number of these periods.
    same: Option<(DVector<f64>, u32)>,
    /// True if the last Newton step did not reduce the defect.
    stalled: bool,
    /// Distance of finite differences in natural scales, and number of unsuccessful enlargements.
    apart: f64,
    in_vain: u32,
    /// Integration error after a period, in natural scales. The defect cannot be reliably reduced below this error.
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

    /// Returns the defect that is accepted if it does not decrease further: the larger of rounding and integration error.
    fn least_sure(&self) -> f64 {
        ROUNDING.max(self.magnified)
    }

    fn end(self) -> Fixed {
        let Self { state, image, defect, defects, .. } = self;
        let defect = defect.unwrap_or_else(|| DVector::zeros(0));
        Fixed { state, image, defect, defects }
    }

    /// Simulates a period from the image. If the image has another number of breakpoints of the slip memory, the map gets a new section
    /// with other unknowns.
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

    /// Fails if every period adds the same amount to the state: a load exceeds friction, or an undamped vibration is in resonance. In these
    /// cases Newton's method cannot converge, because A r = r.
    fn check_gains(&self, map: &Map<'_>) -> Result<(), SteadyError> {
        match (&self.same, map.section()) {
            (Some((defect, periods)), Some(section)) if *periods >= SAME => {
                let number = section.unknowns()[defect.iamax()];
                Err(SteadyError::Gains { number: section.name(number), periods: *periods })
            }
            _ => Ok(()),
        }
    }

    /// Takes a Newton step, halved until it reduces the defect. Returns `false` if no fraction of the step reduces the defect.
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
            // The updated Jacobian, not the step size, may be the cause of the failure.
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

    /// Returns the number of periods to convergence if each period reduces the defect by `rate`. A new Jacobian takes one per unknown.
    fn lasts(&self, rate: f64, size: f64) -> f64 {
        math::ln(size / self.goal).max(0.0) / -math::ln(rate)
    }

    /// Tries a fraction of a Newton step. Accepts the step if the defect decreases by at least a quarter of the fraction.
    fn try_step(
        &mut self,
        map: &mut Map<'_>,
        (gradient, step): (&Gradient, &DVector<f64>),
        (defect, share): (&DVector<f64>, f64),
    ) -> Result<bool, SteadyError> {
        // Memory outside of the Poincaré map is taken from the image, which is the state one period later.
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

/// Returns whether two defects are equal within the tolerance and sufficiently large for a comparison.
fn is_alike(first: &DVector<f64>, other: &DVector<f64>, tolerance: f64) -> bool {
    let size = first.amax();
    first.len() == other.len()
        && size > LARGE * tolerance
        && (first - other).amax() <= ALIKE * size + tolerance
}

/// Returns the Newton step (1 - A)⁻¹ r, or the shortest of several solutions.
fn step(gradient: &DMatrix<f64>, defect: &DVector<f64>) -> Option<DVector<f64>> {
    let count = defect.len();
    let matrix = DMatrix::identity(count, count) - gradient;
    let step = solve(matrix, defect)?;
    step.iter().all(|x| x.is_finite()).then_some(step)
}

/// Returns the minimum-norm solution of a linear system, without singular directions.
pub(super) fn solve(matrix: DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let svd = matrix.svd(true, true);
    let flat = FLAT * svd.singular_values.max();
    svd.solve(right, flat).ok()
}

/// Applies Broyden's update: the new Jacobian agrees with the last step and differs least from the old one. With the Jacobian A of P and r
/// = P - s, the condition is Δr = (A - 1) Δs.
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
