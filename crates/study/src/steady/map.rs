//! The map of a period. Its gradient: [`gradient`].
//!
//! Numbers are counted in natural scales: u_c of a coordinate's contacts, u_c ω of its speed.

mod gradient;

pub(super) use gradient::{Gradient, near};

use super::newton::Fixed;
use super::tally::Tally;
use super::{Options, SteadyError};
use crate::interruptible::Interruptible;
use nalgebra::DVector;
use stickslip_drive::section::{Section, Unknown};
use stickslip_drive::{Limits, Model, Plan, Record, Run, RunError, State, Stepper};
use stickslip_run::Job;

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
    /// What has happened on the way, where that was noted.
    pub(super) happened: Option<Tally>,
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
            both.is_none_or(|(one, other)| one == other)
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
        Image { state, way, happened: None }
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
}
