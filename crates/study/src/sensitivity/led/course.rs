//! Moments of a run that figures are taken at, and scenarios beside a quantity's value, which move them.

use crate::sensitivity::quantity::Quantity;
use crate::sensitivity::sample;
use stickslip_drive::{Model, Parameter};
use stickslip_run::{Job, Periods};

/// Places of models beside a quantity's value, in distances.
const BESIDE: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];

/// Moments of a run, s: its beginning, the beginning of the first whole period of the figures' waveform, beginning and end of the last,
/// the end of the run; and how many such periods there are.
#[derive(Debug, Clone, Copy)]
pub(super) struct Course {
    pub(super) moments: [f64; 5],
    periods: usize,
}

/// Where in [`Course::moments`] they are.
pub(super) const BEGINNING: usize = 0;
pub(super) const FIRST: usize = 1;
pub(super) const LAST: [usize; 2] = [2, 3];
pub(super) const END: usize = 4;

/// Scenarios beside a quantity's value, and how far, as a share of it: derivatives are led by that share, since a variation takes its
/// numbers for such as are in natural scales. By one metre of a stroke it took steps as short as a metre asks for.
pub(super) struct Neighbours {
    pub(super) jobs: [Job; 4],
    pub(super) distance: f64,
}

impl Course {
    /// Of a job; none where its end is that of steady steps.
    pub(super) fn of(job: &Job) -> Option<Self> {
        let (scenario, end) = (&job.scenario, job.scenario.plan.duration);
        if scenario.plan.until_steady.is_some() {
            return None;
        }
        let waveform = scenario.figures.waveform.and_then(|w| scenario.scene.waveforms.get(w));
        let periods = waveform.and_then(|waveform| Periods::until(&waveform.part, end));
        Some(match periods {
            Some(periods) => {
                let (from, to) = periods.last();
                Self { moments: [0.0, periods.start, from, to, end], periods: periods.count }
            }
            None => Self { moments: [0.0, 0.0, 0.0, 0.0, end], periods: 0 },
        })
    }
}

impl Neighbours {
    pub(super) fn of(job: &Job, quantity: &Quantity, share: f64, tolerance: f64) -> Option<Self> {
        let distance = share * quantity.value.abs();
        let at = |k: f64| {
            let job = sample::variant(job, &quantity.path, quantity.value + k * distance, tolerance).ok()?;
            Some(job)
        };
        let [a, b, c, d] = BESIDE.map(at);
        (distance > 0.0).then_some(Self { jobs: [a?, b?, c?, d?], distance: share })
    }

    /// The quantity as a number that moves a model.
    pub(super) fn parameter(&self, model: &Model) -> Option<Parameter> {
        Parameter::new(model, self.jobs.each_ref().map(|job| job.model.clone()), self.distance).ok()
    }

    /// How what a job has moves with a share of the quantity; none where one of them has it not.
    pub(super) fn rate(&self, of: impl Fn(&Job) -> Option<f64>) -> Option<f64> {
        let [a, b, c, d] = self.jobs.each_ref().map(of);
        Some(Parameter::rate([a?, b?, c?, d?], self.distance))
    }

    /// How the moments of a run move with a share of the quantity, s; none where their number does.
    pub(super) fn course(&self, own: &Course) -> Option<[f64; 5]> {
        let [a, b, c, d] = self.jobs.each_ref().map(Course::of);
        let beside = [a?, b?, c?, d?];
        if beside.iter().any(|course| course.periods != own.periods) {
            return None;
        }
        Some(std::array::from_fn(|moment| {
            Parameter::rate(beside.map(|course| course.moments[moment]), self.distance)
        }))
    }
}
