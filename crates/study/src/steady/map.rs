//! Poincaré map of a period. The Jacobian of the map is in [`gradient`].
//!
//! Unknowns are measured in natural scales: the gross slip displacement u_c of a coordinate's contacts, and u_c ω for its velocity.

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

/// Tolerance for whole numbers of periods, which allows for rounding errors.
const WHOLE: f64 = 1e-6;

/// Poincaré map of a period.
pub(super) struct Map<'m> {
    model: &'m Model,
    period: f64,
    plan: Plan,
    section: Option<Section<'m>>,
    scales: DVector<f64>,
    options: &'m Options<'m>,
    /// Number of simulated periods.
    work: f64,
    /// Number of time steps and events in the last period.
    steps: u64,
    /// Number of time steps that the search may still take.
    left: u64,
}

/// Image of a state under the Poincaré map.
#[derive(Clone)]
pub(super) struct Image {
    /// State after a period, with time and drifts reset to the Poincaré section.
    pub(super) state: State,
    /// Displacement of each free coordinate in the period, m or rad.
    pub(super) way: Vec<f64>,
    /// Event counts of the period, if recorded.
    pub(super) happened: Option<Tally>,
}

/// Returns the number of accepted and rejected time steps.
fn tried(state: &State) -> u64 {
    state.counts().steps + state.counts().rejected
}

impl Image {
    /// Returns which of two disturbed images, ahead of and behind this image, are used for finite differences.
    ///
    /// Images with the event counts of the undisturbed image are preferred. If no image has these counts, all images are used.
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
    /// Creates the map, without a Poincaré section.
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

    /// Sets the Poincaré section.
    pub(super) fn set(&mut self, section: Section<'m>) {
        self.scales = DVector::from_vec(section.scales());
        self.section = Some(section);
    }

    /// Returns the Poincaré section; `None` before the first [`Self::set`].
    pub(super) fn section(&self) -> Option<&Section<'m>> {
        self.section.as_ref()
    }

    pub(super) fn model(&self) -> &'m Model {
        self.model
    }

    /// Returns the period, s.
    pub(super) fn period(&self) -> f64 {
        self.period
    }

    /// Returns the number of periods that were simulated or started.
    pub(super) fn work(&self) -> u32 {
        // Sums of fractions of a period have rounding errors.
        (self.work - WHOLE).ceil() as u32
    }

    /// Returns whether the search may simulate more periods.
    pub(super) fn may_go_on(&self) -> bool {
        self.work() < self.options.periods
    }

    /// Returns the number of unknowns of the Poincaré map.
    pub(super) fn unknowns(&self) -> usize {
        self.scales.len()
    }

    /// Returns the number of periods that are simulated before Newton's method starts.
    pub(super) fn settling(&self) -> u32 {
        self.options.settling
    }

    /// Returns the tolerance of the local error per time step.
    pub(super) fn tolerance(&self) -> f64 {
        self.options.tolerance
    }

    /// Returns the number of time steps and events in the last period.
    pub(super) fn steps(&self) -> u64 {
        self.steps
    }

    /// Returns a displacement, m, relative to the smallest natural scale of a position. Returns 0 if no position is an unknown.
    pub(super) fn natural(&self, way: f64) -> f64 {
        let Some(section) = &self.section else { return 0.0 };
        let places = section.unknowns().iter().zip(self.scales.iter());
        let of_places = places.filter(|(unknown, _)| matches!(unknown, Unknown::Place(_)));
        of_places.map(|(_, scale)| way / scale).fold(0.0, f64::max)
    }

    /// Returns the largest displacement of a coordinate in a period, in natural scales.
    pub(super) fn reach(&self, image: &Image) -> f64 {
        let lengths = self.section.as_ref().map(Section::lengths).unwrap_or_default();
        image.way.iter().zip(lengths).map(|(way, length)| (way / length).abs()).fold(0.0, f64::max)
    }

    /// Simulates a state until a time, s, and then commits the slip memories.
    ///
    /// # Errors
    /// Fails if the run fails or is interrupted.
    pub(super) fn lead(
        &mut self,
        state: State,
        until: f64,
        record: &mut dyn Record,
    ) -> Result<State, SteadyError> {
        self.count(((until - state.time()) / self.period).max(0.0));
        self.run(state, until, self.plan, record)
    }

    /// Returns a run that starts at a state.
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
        // A short period may end before the run calls `goes_on`.
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

    /// Returns the image of a state after a period, with the tolerance of the runs multiplied by `finer`.
    pub(super) fn image(&mut self, state: &State, finer: f64) -> Result<Image, SteadyError> {
        let mut happened = Tally::default();
        let end = self.a_period_on(state, finer, &mut happened)?;
        Ok(Image { happened: Some(happened), ..self.brought_back(end) })
    }

    /// Simulates a state for one period.
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

    /// Resets a state after a period to the Poincaré section.
    fn brought_back(&self, end: State) -> Image {
        let (state, way) = match &self.section {
            Some(section) => section.back(end),
            None => (end, Vec::new()),
        };
        Image { state, way, happened: None }
    }

    /// Returns the deviation of unknowns and displacements from the fixed point after some periods, in natural scales.
    ///
    /// If a slip memory has another number of breakpoints, only displacements are compared, because a breakpoint may be due to rounding.
    pub(super) fn missed_after(&self, state: State, (fixed, periods): (&Fixed, f64)) -> f64 {
        let Some(section) = &self.section else { return 0.0 };
        let (state, way) = section.back(state);
        let numbers = self.difference(&state, &fixed.state).map_or(0.0, |off| off.amax());
        let scales = section.lengths();
        let ways = way.iter().zip(&fixed.image.way).zip(&scales);
        ways.map(|((way, one), scale)| (way - periods * one).abs() / scale).fold(numbers, f64::max)
    }

    /// Returns the difference of the unknowns of two states, in natural scales. Returns `None` if the slip memories of the states have
    /// different numbers of breakpoints.
    pub(super) fn difference(&self, of: &State, less: &State) -> Option<DVector<f64>> {
        let numbers = DVector::from_vec(self.section.as_ref()?.difference(of, less)?);
        Some(numbers.component_div(&self.scales))
    }

    /// Returns a state with its unknowns changed by `by`, in natural scales.
    pub(super) fn moved(&self, state: &State, by: &DVector<f64>) -> Option<State> {
        self.section.as_ref()?.moved(state, by.component_mul(&self.scales).as_slice())
    }
}
