//! Slopes that variations tell: how places and speeds change with numbers of the scenario is led along with its own run, or with a
//! period of its steady motion, and no variant of it is run.
//!
//! Models beside a quantity's value say how constants move with it (`stickslip_drive::Parameter`), all quantities are led along in one
//! pass. What the result may be off by is told by a second pass, at a coarser tolerance and with models at another distance.

use super::figure::{Figure, Reading};
use super::quantity::Quantity;
use super::sample;
use crate::each::each;
use crate::interruptible::Interruptible;
use crate::steady::{self, Options, Steady};
use stickslip_drive::scene::{Axis, Freedom};
use stickslip_drive::{Model, Parameter, Plan, Run, VariationError};
use stickslip_results::{Job, Periods};

/// How far models are beside the value of a quantity, as a share of it, and what a step of the run may miss, in tolerances: by the
/// first of two passes and by the second.
const PASSES: [(f64, f64); 2] = [(5e-5, 1.0), (1.25e-4, 10.0)];
/// Places of the models, in distances.
const BESIDE: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];
/// Errors in what both passes differ by: some steps are as long in both, at corners and where waves are.
const APART: f64 = 10.0;
/// What rounding leaves of a slope, as a share of it or of figure over quantity: differences of constants over the first distance.
const ROUNDING: f64 = 3e-11;

/// What a variation tells of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Told {
    /// A coordinate of a body at the end of the run, or its rate.
    End { body: usize, axis: Axis, is_rate: bool },
    /// How far the figures' body comes in the last whole period.
    Last,
    /// The same in the mean of all whole periods, over their time.
    MeanSpeed,
    /// The same in the whole run.
    Travel,
    /// Step of steady motion.
    SteadyStep,
    /// Its speed.
    SteadySpeed,
}

/// Moments of a run, s: its beginning, the beginning of the first whole period of the figures' waveform, beginning and end of the last,
/// the end of the run; and how many such periods there are.
#[derive(Debug, Clone, Copy)]
struct Course {
    moments: [f64; 5],
    periods: usize,
}

/// Where in [`Course::moments`] they are.
const BEGINNING: usize = 0;
const FIRST: usize = 1;
const LAST: [usize; 2] = [2, 3];
const END: usize = 4;

/// Scenarios beside a quantity's value, and how far, as a share of it: derivatives are led by that share, since a variation takes its
/// numbers for such as are in natural scales. By one metre of a stroke it took steps as short as a metre asks for.
struct Neighbours {
    jobs: [Job; 4],
    distance: f64,
}

/// How a coordinate moves at a moment with each quantity, and its rate, m and m/s; and the rate itself.
struct Look {
    moved: Vec<(f64, f64)>,
    rate: f64,
}

/// Slopes of some figures by each of some quantities; none of a quantity of which no variation is known.
type Slopes = Vec<Option<Vec<f64>>>;

/// Whether all figures are such as variations tell.
pub(super) fn tells(job: &Job, figures: &[Figure]) -> bool {
    told(job, figures).is_some()
}

fn told(job: &Job, figures: &[Figure]) -> Option<Vec<Told>> {
    figures.iter().map(|figure| Told::of(job, figure)).collect()
}

/// Slopes of figures by quantities, each with its error, on so many cores; none of a quantity of which a variation does not tell them all.
pub(super) fn slopes(
    job: &Job,
    (figures, quantities): (&[Figure], &[Quantity]),
    (tolerance, cores): (f64, usize),
    goes_on: &(dyn Fn() -> bool + Sync),
) -> Vec<Option<Vec<(f64, f64)>>> {
    let Some(told) = told(job, figures) else { return vec![None; quantities.len()] };
    let passes = each(PASSES.len(), cores, |pass| {
        let (share, coarser) = PASSES[pass];
        let own = sample::ready(job.scenario.clone(), &job.name, coarser * tolerance).ok()?;
        let values: Vec<f64> = figures.iter().map(|figure| figure.value).collect();
        let pass =
            Pass { job: own, given: job, told: &told, values, tolerance: coarser * tolerance, goes_on };
        Some(pass.slopes(quantities, share))
    });
    let [Some(fine), Some(coarse)] = &passes[..] else { return vec![None; quantities.len()] };
    let both = fine.iter().zip(coarse).zip(quantities);
    both.map(|((fine, coarse), quantity)| {
        let each = fine.as_ref()?.iter().zip(coarse.as_ref()?).zip(figures);
        let told = each.map(|((fine, coarse), figure)| {
            let rounding = ROUNDING * (figure.value / quantity.value).abs().max(fine.abs());
            (*fine, APART * (fine - coarse).abs() + rounding)
        });
        let told: Vec<(f64, f64)> = told.collect();
        told.iter().all(|(slope, error)| slope.is_finite() && error.is_finite()).then_some(told)
    })
    .collect()
}

/// A run with its variation, or a period of steady motion.
struct Pass<'a> {
    /// The scenario at the tolerance of the pass, and as it is given.
    job: Job,
    given: &'a Job,
    told: &'a [Told],
    /// The figures' values.
    values: Vec<f64>,
    tolerance: f64,
    goes_on: &'a (dyn Fn() -> bool + Sync),
}

impl Pass<'_> {
    /// Slopes by quantities, their models at a share of the value.
    fn slopes(mut self, quantities: &[Quantity], share: f64) -> Slopes {
        let neighbours = |quantity: &Quantity| Neighbours::of(self.given, quantity, share, self.tolerance);
        let neighbours: Vec<Option<Neighbours>> = quantities.iter().map(neighbours).collect();
        self.job.model.keep_together();
        let of_run = self.told.iter().any(|told| !told.is_steady()).then(|| self.of_run(&neighbours));
        let of_steady = self.told.iter().any(|told| told.is_steady()).then(|| self.of_steady(&neighbours));
        let of = |q: usize, f: usize| {
            let slopes = if self.told[f].is_steady() { &of_steady } else { &of_run };
            Some(slopes.as_ref()?[q].as_ref()?[f] / quantities[q].value.abs())
        };
        (0..quantities.len()).map(|q| (0..self.told.len()).map(|f| of(q, f)).collect()).collect()
    }

    /// What the run tells of its figures.
    fn of_run(&self, neighbours: &[Option<Neighbours>]) -> Slopes {
        let Some(course) = Course::of(&self.job) else { return neighbours.iter().map(|_| None).collect() };
        let known = |neighbours: &Neighbours| {
            Some((neighbours.course(&course)?, neighbours.parameter(&self.job.model)?))
        };
        let known: Vec<_> = neighbours.iter().map(|it| it.as_ref().and_then(known)).collect();
        led(&known, |known: &[&([f64; 5], Parameter)]| {
            let parameters: Vec<Parameter> = known.iter().map(|(_, parameter)| parameter.clone()).collect();
            let Some(looks) = self.looks(&course, &parameters)? else { return Ok(None) };
            let slopes = known.iter().enumerate().map(|(j, (moves, _))| {
                (0..self.told.len()).map(|f| self.slope(f, &looks[f], (&course, moves), j)).collect()
            });
            Ok(Some(slopes.collect()))
        })
    }

    /// What a figure changes by with quantity `j`, which `moves` the moments of the run.
    fn slope(&self, f: usize, looks: &[Look], (course, moves): (&Course, &[f64; 5]), j: usize) -> f64 {
        let place = |moment: usize| looks[moment].moved[j].0 + looks[moment].rate * moves[moment];
        let [from, to] = LAST;
        match self.told[f] {
            // Where the end moves the rate goes on by an acceleration that nobody has asked for.
            Told::End { is_rate: true, .. } if moves[END] != 0.0 => f64::NAN,
            Told::End { is_rate: true, .. } => looks[END].moved[j].1,
            Told::End { is_rate: false, .. } => place(END),
            Told::Last => place(to) - place(from),
            Told::MeanSpeed => {
                let (time, longer) = (course.moments[to] - course.moments[FIRST], moves[to] - moves[FIRST]);
                (place(to) - place(FIRST) - self.values[f] * longer) / time
            }
            Told::Travel => place(END) - place(BEGINNING),
            Told::SteadyStep | Told::SteadySpeed => f64::NAN,
        }
    }

    /// The coordinate of each figure of the run at all moments; none where the run stops itself.
    fn looks(
        &self,
        course: &Course,
        parameters: &[Parameter],
    ) -> Result<Option<Vec<Vec<Look>>>, VariationError> {
        let model = &self.job.model;
        let plan = Plan { every: None, until_steady: None, ..self.job.scenario.plan };
        let Ok(start) = model.start(&plan) else { return Ok(None) };
        let mut variation = model.variation((&plan, &start), parameters)?;
        let Ok(mut run) = Run::new(model, &plan, start) else { return Ok(None) };
        let mut looks: Vec<Vec<Look>> = self.told.iter().map(|_| Vec::new()).collect();
        for moment in course.moments {
            let mut record = Interruptible { record: &mut variation, goes_on: self.goes_on };
            if run.advance(moment.max(run.state().time()), &mut record).is_err() {
                return Ok(None);
            }
            for (told, looks) in self.told.iter().zip(&mut looks) {
                let Some((body, axis)) = told.coordinate(&self.job) else { continue };
                let moved = (0..parameters.len()).filter_map(|j| variation.coordinate(body, axis, j));
                let rate = run.state().coordinate(model, body, axis).map_or(f64::NAN, |(_, rate)| rate);
                looks.push(Look { moved: moved.collect(), rate });
            }
        }
        run.stop(&mut ());
        variation.finish(run.state())?;
        Ok(Some(looks))
    }

    /// What a period of the steady motion tells.
    fn of_steady(&self, neighbours: &[Option<Neighbours>]) -> Slopes {
        let goes_on = || (self.goes_on)();
        let options = Options { tolerance: self.tolerance, goes_on: &goes_on, ..Options::default() };
        let nothing = || neighbours.iter().map(|_| None).collect();
        let Ok(steady) = steady::find(&self.job, &options) else { return nothing() };
        let parameter = |it: &Neighbours| steady.parameter(it.jobs.each_ref(), it.distance);
        let known: Vec<_> = neighbours.iter().map(|it| it.as_ref().and_then(parameter)).collect();
        led(&known, |known: &[&Parameter]| {
            let parameters: Vec<Parameter> = known.iter().map(|parameter| (*parameter).clone()).collect();
            let slopes = steady.step_slopes(&self.job, &parameters, &goes_on)?;
            let figures = |slope: f64| self.told.iter().map(|told| told.of_step(&steady, slope)).collect();
            Ok(slopes.map(|slopes| slopes.into_iter().map(figures).collect()))
        })
    }
}

/// Leads along all that is known at once, or each by itself where one of them has no derivative that others may have.
fn led<T>(
    known: &[Option<T>],
    lead: impl Fn(&[&T]) -> Result<Option<Vec<Vec<f64>>>, VariationError>,
) -> Slopes {
    let all: Vec<&T> = known.iter().flatten().collect();
    let mut found = match lead(&all) {
        Ok(Some(slopes)) => slopes.into_iter().map(Some).collect(),
        Err(VariationError::MovesApart { .. } | VariationError::NotSmooth { .. }) if all.len() > 1 => {
            let alone = |one: &&T| lead(&[*one]).ok().flatten().and_then(|slopes| slopes.into_iter().next());
            all.iter().map(alone).collect::<Vec<_>>()
        }
        _ => vec![None; all.len()],
    }
    .into_iter();
    known.iter().map(|known| known.as_ref().and_then(|_| found.next().flatten())).collect()
}

impl Told {
    /// Of a figure; none of one that is more than places and speeds.
    fn of(job: &Job, figure: &Figure) -> Option<Self> {
        let of_steps = |told: Self| {
            let scene = &job.scenario.scene;
            let body = scene.bodies.get(job.scenario.figures.body?)?;
            (body.part.x.freedom == Freedom::Free).then_some(told)
        };
        match (figure.reading, figure.name.as_str()) {
            (Reading::SteadyStep, _) => of_steps(Self::SteadyStep),
            (Reading::SteadySpeed, _) => of_steps(Self::SteadySpeed),
            (Reading::Summary, "steps.last_m") => of_steps(Self::Last),
            (Reading::Summary, "steps.mean_speed_m_s") => of_steps(Self::MeanSpeed),
            (Reading::Summary, "steps.net_travel_m") => of_steps(Self::Travel),
            (Reading::Summary, _) => None,
            (Reading::End, name) => Self::channel(job, name),
        }
    }

    /// A free coordinate at the end, or its rate, by the name of its channel.
    fn channel(job: &Job, name: &str) -> Option<Self> {
        let bodies = job.scenario.scene.bodies.iter().enumerate();
        bodies
            .filter_map(|(body, named)| {
                let channel = name.strip_prefix(named.name.as_str())?.strip_prefix('.')?;
                let mut coordinates =
                    named.part.coordinates().into_iter().filter(|(_, it)| it.freedom == Freedom::Free);
                coordinates.find_map(|(axis, _)| {
                    let (unit, key) = (if axis == Axis::Pitch { "rad" } else { "m" }, axis.key());
                    let is_rate = channel == format!("v{key}_{unit}_s");
                    (is_rate || channel == format!("{key}_{unit}")).then_some(Self::End {
                        body,
                        axis,
                        is_rate,
                    })
                })
            })
            .next()
    }

    fn is_steady(self) -> bool {
        matches!(self, Self::SteadyStep | Self::SteadySpeed)
    }

    /// The coordinate that a figure of a run is made of.
    fn coordinate(self, job: &Job) -> Option<(usize, Axis)> {
        match self {
            Self::End { body, axis, .. } => Some((body, axis)),
            Self::Last | Self::MeanSpeed | Self::Travel => Some((job.scenario.figures.body?, Axis::X)),
            Self::SteadyStep | Self::SteadySpeed => None,
        }
    }

    /// Slope of a figure of steady motion, from that of its step.
    fn of_step(self, steady: &Steady, slope: f64) -> f64 {
        match self {
            Self::SteadyStep => slope,
            // The period is the same.
            Self::SteadySpeed => slope / steady.period,
            Self::End { .. } | Self::Last | Self::MeanSpeed | Self::Travel => f64::NAN,
        }
    }
}

impl Course {
    /// Of a job; none where its end is that of steady steps.
    fn of(job: &Job) -> Option<Self> {
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
    fn of(job: &Job, quantity: &Quantity, share: f64, tolerance: f64) -> Option<Self> {
        let distance = share * quantity.value.abs();
        let at = |k: f64| {
            let mut job =
                sample::variant(job, &quantity.path, quantity.value + k * distance, tolerance).ok()?;
            job.model.keep_together();
            Some(job)
        };
        let [a, b, c, d] = BESIDE.map(at);
        (distance > 0.0).then_some(Self { jobs: [a?, b?, c?, d?], distance: share })
    }

    /// The quantity as a number that moves a model.
    fn parameter(&self, model: &Model) -> Option<Parameter> {
        Parameter::new(model, self.jobs.each_ref().map(|job| job.model.clone()), self.distance).ok()
    }

    /// How the moments of a run move with a share of the quantity, s; none where their number does.
    fn course(&self, own: &Course) -> Option<[f64; 5]> {
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
