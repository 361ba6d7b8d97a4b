//! The map of a period, and its gradient: by the variation of a run where there is one, else by differences.
//!
//! Numbers are counted in natural scales: u_c of a coordinate's contacts, u_c ω of its speed.

use super::newton::Fixed;
use super::tally::Tally;
use super::{Options, SteadyError};
use crate::interruptible::Interruptible;
use nalgebra::{DMatrix, DVector};
use stickslip_drive::section::{Section, Unknown};
use stickslip_drive::{Limits, Model, Plan, Record, Run, RunError, State, Stepper};
use stickslip_results::Job;

/// Differences on the way, in natural scales: steps of 1e-12 leave an error of 1e-6, and so does a bend of 1.
const NEAR: f64 = 1e-6;
/// Differences to both sides at the end: an error of 1e-7 from steps, and of 1e-10 from a bend of 1.
const FINE: f64 = 1e-5;

/// Of periods that are less than this from a whole number of them the rest is rounding.
const WHOLE: f64 = 1e-6;

/// The map of a period.
pub(super) struct Map<'m> {
    model: &'m Model,
    period: f64,
    plan: Plan,
    section: Option<Section<'m>>,
    scales: DVector<f64>,
    options: &'m Options<'m>,
    /// In periods.
    work: f64,
    /// Steps and events of the last period.
    steps: u64,
    /// Steps that may still be taken.
    left: u64,
}

/// Where a state has got to in a period.
#[derive(Clone)]
pub(super) struct Image {
    /// As if it stood at the section.
    pub(super) state: State,
    /// Way of the free coordinates, m or rad.
    pub(super) way: Vec<f64>,
    /// How both change with the state that they came from, where that was led along.
    pub(super) gradient: Option<Gradient>,
    /// What has happened on the way, where that was noted.
    happened: Option<Tally>,
}

/// The gradient of a map.
#[derive(Clone)]
pub(super) struct Gradient {
    /// Of the numbers, in natural scales.
    pub(super) numbers: DMatrix<f64>,
    /// Of the way of each free coordinate, m or rad per natural scale.
    pub(super) way: DMatrix<f64>,
    /// Whether it is exact, but for the tolerance of the run.
    pub(super) is_exact: bool,
    /// Numbers whose columns are not known: disturbed by one of them memories come back with other knots.
    pub(super) unknown: Vec<usize>,
    /// What differences miss where the map bends between them, as a share of the size of all entries: of those to both sides in second
    /// order, of one to one side alone in first.
    pub(super) missed: f64,
}

/// What an image changes by with one number, by differences.
struct Slope {
    numbers: DVector<f64>,
    /// Of the way.
    way: Vec<f64>,
    /// Squares of a second difference and of the first one; none where there is one difference alone.
    bend: Option<[f64; 2]>,
}

impl Gradient {
    /// How far entries may be off by runs that are led by a tolerance: differences of images magnify that by their distance.
    // Of bouncing bodies that nothing damps along z, |λ| = 1 by differences was up to 1.8e-4 off at 1e-9, and 7e-3 at 1e-6.
    pub(super) fn noise(&self, tolerance: f64) -> f64 {
        if self.is_exact { 0.0 } else { 3.0 * tolerance / FINE }
    }
}

/// Accepted and rejected steps so far.
fn tried(state: &State) -> u64 {
    state.counts().steps + state.counts().rejected
}

impl Image {
    /// Whether a difference is taken of the images ahead and behind of this one: of those that there are, or of one alone where in the
    /// other something else has happened on the way.
    pub(super) fn sides(&self, beside: [Option<&Self>; 2]) -> [bool; 2] {
        let is_like = |other: &Self| {
            let both = self.happened.as_ref().zip(other.happened.as_ref());
            both.is_none_or(|(one, other)| one.is_like(other))
        };
        let alike = beside.map(|side| side.is_some_and(is_like));
        if alike == [false; 2] { beside.map(|side| side.is_some()) } else { alike }
    }
}

impl<'m> Map<'m> {
    /// The map of a model at no moment yet.
    pub(super) fn new(model: &'m Model, period: f64, job: &Job, options: &'m Options<'m>) -> Self {
        let limits = Limits { wall: None, ..job.scenario.plan.limits };
        let stepper = Stepper::Event { tolerance: options.tolerance };
        let plan = Plan { duration: f64::MAX, stepper, limits, every: None, until_steady: None };
        Self {
            model,
            period,
            plan,
            section: None,
            scales: DVector::zeros(0),
            options,
            work: 0.0,
            steps: 0,
            left: options.steps,
        }
    }

    /// The map at a section.
    pub(super) fn set(&mut self, section: Section<'m>) {
        self.scales = DVector::from_vec(section.scales());
        self.section = Some(section);
    }

    /// Its section; it has one from the first [`Self::set`] on.
    pub(super) fn section(&self) -> Option<&Section<'m>> {
        self.section.as_ref()
    }

    pub(super) fn model(&self) -> &'m Model {
        self.model
    }

    /// Period, s.
    pub(super) fn period(&self) -> f64 {
        self.period
    }

    /// Periods that were computed so far; one that was begun counts.
    pub(super) fn work(&self) -> u32 {
        // Sums of parts of a period are rounded.
        (self.work - WHOLE).ceil() as u32
    }

    /// Whether more may be computed.
    pub(super) fn may_go_on(&self) -> bool {
        self.work() < self.options.periods
    }

    /// How many numbers a state has.
    pub(super) fn unknowns(&self) -> usize {
        self.scales.len()
    }

    /// Plain periods before it is looked at.
    pub(super) fn settling(&self) -> u32 {
        self.options.settling
    }

    /// Local error per step.
    pub(super) fn tolerance(&self) -> f64 {
        self.options.tolerance
    }

    /// Steps and events of the last period whose image was computed.
    pub(super) fn steps(&self) -> u64 {
        self.steps
    }

    /// A way, m, in the smallest natural scale of a place; 0 where none is a number.
    pub(super) fn natural(&self, way: f64) -> f64 {
        let Some(section) = &self.section else { return 0.0 };
        let places = section.unknowns().iter().zip(self.scales.iter());
        let of_places = places.filter(|(unknown, _)| matches!(unknown, Unknown::Place(_)));
        of_places.map(|(_, scale)| way / scale).fold(0.0, f64::max)
    }

    /// How far anything goes in a period, in natural lengths.
    pub(super) fn reach(&self, image: &Image) -> f64 {
        let lengths = self.section.as_ref().map(Section::lengths).unwrap_or_default();
        image.way.iter().zip(lengths).map(|(way, length)| (way / length).abs()).fold(0.0, f64::max)
    }

    /// A state led on to a time, s, its memories where it stands.
    pub(super) fn lead(
        &mut self,
        state: State,
        until: f64,
        record: &mut dyn Record,
    ) -> Result<State, SteadyError> {
        self.count(((until - state.time()) / self.period).max(0.0));
        self.run(state, until, self.plan, record)
    }

    /// A run that stands at a state.
    pub(super) fn held(&self, state: State) -> Result<Run<'m>, SteadyError> {
        Ok(Run::new(self.model, &self.plan, state)?)
    }

    fn count(&mut self, periods: f64) {
        self.work += periods;
        (self.options.told)(self.work());
    }

    fn run(
        &mut self,
        state: State,
        until: f64,
        plan: Plan,
        record: &mut dyn Record,
    ) -> Result<State, SteadyError> {
        let before = tried(&state);
        let most = before.saturating_add(self.left);
        let costs = most < plan.limits.steps;
        let limits = Limits { steps: most.min(plan.limits.steps), ..plan.limits };
        let plan = Plan { limits, ..plan };
        let interrupted = |error: RunError| match error {
            RunError::Interrupted { .. } => SteadyError::Interrupted(self.work()),
            RunError::TooManySteps { .. } if costs => SteadyError::Costly { steps: self.options.steps },
            error => error.into(),
        };
        // A cheap period is over before its run asks.
        if !(self.options.goes_on)() {
            return Err(SteadyError::Interrupted(self.work()));
        }
        let mut asked = Interruptible { record, goes_on: self.options.goes_on };
        let mut run = Run::new(self.model, &plan, state).map_err(interrupted)?;
        run.advance(until, &mut asked).map_err(interrupted)?;
        run.stop(&mut ());
        let state = run.into_state();
        self.left = self.left.saturating_sub(tried(&state) - before);
        Ok(state)
    }

    /// Where a state of the section gets to in a period, by the tolerance times `finer`.
    pub(super) fn image(&mut self, state: &State, finer: f64) -> Result<Image, SteadyError> {
        let mut happened = Tally::default();
        let end = self.a_period_on(state, finer, &mut happened)?;
        Ok(Image { happened: Some(happened), ..self.brought_back(end) })
    }

    /// The same with its gradient, by the variation of the run, where that has one.
    pub(super) fn image_with_gradient(&mut self, state: &State) -> Result<Image, SteadyError> {
        let tolerance = self.options.tolerance;
        let made = self.section.as_ref().and_then(|section| section.variation((state, &[]), tolerance).ok());
        let Some(mut variation) = made else { return self.image(state, 1.0) };
        let end = self.a_period_on(state, 1.0, &mut variation)?;
        let outcome = variation.finish(&end);
        let mut image = self.brought_back(end);
        if let (Some(section), Ok(())) = (&self.section, outcome)
            && section.difference(&image.state, state).is_some()
        {
            let matrix = |rows: Vec<Vec<f64>>| {
                DMatrix::from_row_iterator(rows.len(), self.scales.len(), rows.into_iter().flatten())
            };
            image.gradient = section.gradient(&variation, &image.state).map(|gradient| Gradient {
                numbers: matrix(gradient.numbers),
                way: matrix(gradient.way),
                is_exact: true,
                unknown: Vec::new(),
                missed: 0.0,
            });
        }
        Ok(image)
    }

    /// A state led on by a period.
    fn a_period_on(
        &mut self,
        state: &State,
        finer: f64,
        record: &mut dyn Record,
    ) -> Result<State, SteadyError> {
        let until = state.time() + self.period;
        let stepper = Stepper::Event { tolerance: self.options.tolerance * finer };
        self.count(1.0);
        let end = self.run(state.clone(), until, Plan { stepper, ..self.plan }, record)?;
        let counts = [state, &end].map(|state| state.counts().steps + state.counts().events);
        self.steps = counts[1].saturating_sub(counts[0]);
        Ok(end)
    }

    /// A state of a period later at the section.
    fn brought_back(&self, end: State) -> Image {
        let (state, way) = match &self.section {
            Some(section) => section.back(end),
            None => (end, Vec::new()),
        };
        Image { state, way, gradient: None, happened: None }
    }

    /// By how much a state some periods after a fixed point is off, in natural scales: of its numbers, and of the way, which alone tells
    /// where a memory has a knot more or less: it may be no deeper than rounding.
    pub(super) fn missed_after(&self, state: State, (fixed, periods): (&Fixed, f64)) -> f64 {
        let Some(section) = &self.section else { return 0.0 };
        let (state, way) = section.back(state);
        let numbers = self.difference(&state, &fixed.state).map_or(0.0, |off| off.amax());
        let scales = section.lengths();
        let ways = way.iter().zip(&fixed.image.way).zip(&scales);
        ways.map(|((way, one), scale)| (way - periods * one).abs() / scale).fold(numbers, f64::max)
    }

    /// Numbers of one state less those of another, in natural scales; none where their memories have other knots.
    pub(super) fn difference(&self, of: &State, less: &State) -> Option<DVector<f64>> {
        let numbers = DVector::from_vec(self.section.as_ref()?.difference(of, less)?);
        Some(numbers.component_div(&self.scales))
    }

    /// A state with other numbers, each moved by as much, in natural scales.
    pub(super) fn moved(&self, state: &State, by: &DVector<f64>) -> Option<State> {
        self.section.as_ref()?.moved(state, by.component_mul(&self.scales).as_slice())
    }

    /// The gradient at a state by the variation of a run, if it has one: that of its image, if that has come with it.
    fn exact_gradient(&mut self, state: &State, image: &Image) -> Result<Option<Gradient>, SteadyError> {
        let tolerance = self.options.tolerance;
        let varies = |section: &Section<'_>| section.variation((state, &[]), tolerance).is_ok();
        match &image.gradient {
            Some(gradient) => Ok(Some(gradient.clone())),
            None if self.section.as_ref().is_some_and(varies) => {
                Ok(self.image_with_gradient(state)?.gradient)
            }
            None => Ok(None),
        }
    }

    /// The gradient at a state whose image is known, else by one difference for each number.
    pub(super) fn near_gradient(&mut self, state: &State, image: &Image) -> Result<Gradient, SteadyError> {
        if let Some(gradient) = self.exact_gradient(state, image)? {
            return Ok(gradient);
        }
        self.gradient(image, |map, j| {
            let beside = map.beside(state, (j, NEAR))?;
            Ok(beside.and_then(|beside| map.slope(([&beside, image], NEAR), None)))
        })
    }

    /// The gradient, else by differences to both sides, or to one, twice as far as well, where the other is of another kind: its memories
    /// have other knots, or something else happens on the way.
    pub(super) fn fine_gradient(&mut self, state: &State, image: &Image) -> Result<Gradient, SteadyError> {
        if let Some(gradient) = self.exact_gradient(state, image)? {
            return Ok(gradient);
        }
        self.gradient(image, |map, j| {
            let [ahead, behind] = [map.beside(state, (j, FINE))?, map.beside(state, (j, -FINE))?];
            let sides = image.sides([ahead.as_ref(), behind.as_ref()]);
            let [ahead, behind] =
                [(ahead, sides[0]), (behind, sides[1])].map(|(side, counts)| side.filter(|_| counts));
            let (one, by) = match (ahead, behind) {
                (Some(ahead), Some(behind)) => {
                    return Ok(map.slope(([&ahead, &behind], 2.0 * FINE), Some([&ahead, image])));
                }
                (Some(one), None) => (one, FINE),
                (None, Some(one)) => (one, -FINE),
                (None, None) => return Ok(None),
            };
            let far = map.beside(state, (j, 2.0 * by))?.filter(|far| image.sides([Some(far), None])[0]);
            Ok(match far {
                Some(far) => map.aside(image, [&one, &far], by),
                None => map.slope(([&one, image], by), None),
            })
        })
    }

    /// What a number changes by a difference of two images, ahead and behind, that lie so far apart; of one to both sides by how much its
    /// halves differ tells the difference of one of them.
    fn slope(
        &self,
        ([ahead, behind], apart): ([&Image; 2], f64),
        half: Option<[&Image; 2]>,
    ) -> Option<Slope> {
        let difference = self.difference(&ahead.state, &behind.state)?;
        let bend = half.and_then(|[ahead, image]| self.difference(&ahead.state, &image.state));
        let bend = bend.map(|half| [(&half * 2.0 - &difference).norm_squared(), difference.norm_squared()]);
        let way = ahead.way.iter().zip(&behind.way).map(|(ahead, behind)| (ahead - behind) / apart);
        Some(Slope { numbers: difference / apart, way: way.collect(), bend })
    }

    /// The same to one side alone, by an image so far off and one twice as far: (4f₁ - f₂ - 3f₀)/2h, which a bend does not move.
    fn aside(&self, image: &Image, [one, far]: [&Image; 2], by: f64) -> Option<Slope> {
        let near = self.slope(([one, image], by), None)?;
        let twice = self.slope(([far, image], by), None)?;
        let bent = &twice.numbers - &near.numbers * 2.0;
        let numbers = &near.numbers * 2.0 - &twice.numbers * 0.5;
        let way = near.way.iter().zip(&twice.way).map(|(near, twice)| 2.0 * near - 0.5 * twice);
        let bend = Some([bent.norm_squared(), (&numbers * 2.0).norm_squared()]);
        Some(Slope { numbers, way: way.collect(), bend })
    }

    /// A gradient from what each number changes. One that cannot be moved leaves nothing behind, and its column is not known.
    fn gradient(
        &mut self,
        image: &Image,
        mut slope: impl FnMut(&mut Self, usize) -> Result<Option<Slope>, SteadyError>,
    ) -> Result<Gradient, SteadyError> {
        let count = self.scales.len();
        let mut gradient = Gradient {
            numbers: DMatrix::zeros(count, count),
            way: DMatrix::zeros(image.way.len(), count),
            is_exact: false,
            unknown: Vec::new(),
            missed: 0.0,
        };
        let (mut bends, mut changes, mut order) = (0.0, 0.0, 2);
        for j in 0..count {
            let Some(Slope { numbers, way, bend }) = slope(self, j)? else {
                gradient.unknown.push(j);
                continue;
            };
            match bend {
                Some([bend, change]) => (bends, changes) = (bends + bend, changes + change),
                // One difference to one side alone tells nothing of a bend.
                None => order = 1,
            }
            gradient.numbers.set_column(j, &numbers);
            gradient.way.set_column(j, &DVector::from_vec(way));
        }
        // Second differences to first ones.
        gradient.missed = if changes > 0.0 { f64::sqrt(bends / changes).powi(order) } else { 0.0 };
        Ok(gradient)
    }

    /// The image of a state with one number moved, if both have the knots of the others.
    fn beside(&mut self, state: &State, (j, by): (usize, f64)) -> Result<Option<Image>, SteadyError> {
        let mut along = DVector::zeros(self.scales.len());
        along[j] = by;
        let Some(moved) = self.moved(state, &along) else { return Ok(None) };
        let image = self.image(&moved, 1.0)?;
        let alike = self.difference(&image.state, state).is_some();
        Ok(alike.then_some(image))
    }
}
