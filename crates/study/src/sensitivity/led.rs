//! Slopes that variations tell: how places, speeds and energies change with numbers of the scenario is led along with its own run, or
//! with a period of its steady motion, and no variant of it is run.
//!
//! In reading order: `told`, what is told of which figure; `course`, the moments of the run and the models beside it; `turning`, what is seen
//! where contacts turn.
//!
//! Models beside a quantity's value say how constants move with it (`stickslip_drive::Parameter`), all quantities are led along in one
//! pass. What the result may be off by is told by a second pass, at another tolerance and with models at another distance.

mod course;
mod told;
mod turning;

use super::figure::Figure;
use super::quantity::Quantity;
use super::{other_tolerance, sample};
use crate::each::each;
use crate::interruptible::Interruptible;
use crate::steady::{self, Options};
use course::{Course, Neighbours};
use stickslip_drive::{EnergyRates, Parameter, Plan, Run, State, Variation, VariationError};
use stickslip_run::summary::load;
use stickslip_run::{Extreme, Job, Watcher};
use told::Told;
use turning::{Turning, Turns};

/// How far models are beside the value of a quantity, as a share of it: in the pass whose slopes are told, and in the one that tells what
/// these may be off by.
const SHARES: [f64; 2] = [5e-5, 1.25e-4];
/// Errors in what both passes differ by, where the other one is finer and where it is coarser: some steps of the run are as long in both, at
/// corners and where waves are.
const APART: [f64; 2] = [2.0, 3.0];
/// What rounding leaves of a slope, as a share of it or of figure over quantity: differences of constants over the first distance.
const ROUNDING: f64 = 3e-11;

/// A quantity that moves a model.
struct Known {
    parameter: Parameter,
    /// How it moves the moments of the run, s, and the constant load on the figures' body, N.
    moves: [f64; 5],
    load: Option<f64>,
}

/// A moment of the run: the coordinate of each figure that has one, and how energies change, J, by each quantity, and with the time, W.
struct Look {
    places: Vec<Option<Place>>,
    energies: Vec<Option<EnergyRates>>,
    powers: EnergyRates,
}

/// A coordinate, its rate and acceleration, and how coordinate and rate move with each quantity, m and m/s.
struct Place {
    value: f64,
    rate: f64,
    acceleration: f64,
    moved: Vec<(f64, f64)>,
}

/// A run that has been led along.
struct Led {
    course: Course,
    /// What is seen at the moments of the course.
    looks: Vec<Look>,
    turns: Turns,
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
    let (other, is_finer) = other_tolerance(tolerance);
    // The equations of the finer pass go in halves of the run's steps. In the same steps both missed the same: of 400 slopes of 200
    // drawn drives 22 were off by 1 to 700 times what they told.
    let ways = [(tolerance, !is_finer), (other, is_finer)];
    let passes = each(SHARES.len(), cores, |pass| {
        let (share, (tolerance, is_halved)) = (SHARES[pass], ways[pass]);
        let own = sample::ready(job.scenario.clone(), &job.name, tolerance).ok()?;
        let values: Vec<f64> = figures.iter().map(|figure| figure.value).collect();
        let pass = Pass { job: own, given: job, told: &told, values, tolerance, is_halved, goes_on };
        Some(pass.slopes(quantities, share))
    });
    let [Some(own), Some(others)] = &passes[..] else { return vec![None; quantities.len()] };
    let apart = APART[usize::from(!is_finer)];
    let both = own.iter().zip(others).zip(quantities);
    both.map(|((own, others), quantity)| {
        let each = own.as_ref()?.iter().zip(others.as_ref()?).zip(figures);
        let told = each.map(|((own, other), figure)| {
            let rounding = ROUNDING * (figure.value / quantity.value).abs().max(own.abs());
            (*own, apart * (own - other).abs() + rounding)
        });
        let told: Vec<(f64, f64)> = told.collect();
        told.iter().all(|(slope, error)| slope.is_finite() && error.is_finite()).then_some(told)
    })
    .collect()
}

/// A watcher who is asked alone.
struct Asking<'a>(&'a (dyn Fn() -> bool + Sync));

impl Watcher for Asking<'_> {
    fn reached(&self, _: f64) {}
    fn goes_on(&self) -> bool {
        (self.0)()
    }
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
    is_halved: bool,
    goes_on: &'a (dyn Fn() -> bool + Sync),
}

impl Pass<'_> {
    /// Slopes by quantities, their models at a share of the value.
    fn slopes(self, quantities: &[Quantity], share: f64) -> Slopes {
        let neighbours = |quantity: &Quantity| Neighbours::of(self.given, quantity, share, self.tolerance);
        let neighbours: Vec<Option<Neighbours>> = quantities.iter().map(neighbours).collect();
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
            let parameter = neighbours.parameter(&self.job.model)?;
            Some(Known { parameter, moves: neighbours.course(&course)?, load: neighbours.rate(load) })
        };
        let known: Vec<_> = neighbours.iter().map(|it| it.as_ref().and_then(known)).collect();
        let swings = self.swings();
        led(&known, |known: &[&Known]| {
            let parameters: Vec<Parameter> = known.iter().map(|known| known.parameter.clone()).collect();
            let Some(run) = self.run((&course, &swings), &parameters)? else { return Ok(None) };
            let slopes = known.iter().enumerate().map(|(j, known)| {
                let slope = |f: usize| self.told[f].slope(f, (&run, known, j), self);
                (0..self.told.len()).map(slope).collect()
            });
            Ok(Some(slopes.collect()))
        })
    }

    /// The last swing of each figure that is one: a run of its own tells.
    fn swings(&self) -> Vec<Option<[Extreme; 2]>> {
        let contact = |told: &Told| match told {
            Told::Ringing { contact, .. } => Some(*contact),
            _ => None,
        };
        let contacts: Vec<Option<usize>> = self.told.iter().map(contact).collect();
        if contacts.iter().all(Option::is_none) {
            return contacts.iter().map(|_| None).collect();
        }
        let outcome = self.job.run(&Asking(self.goes_on));
        contacts.into_iter().map(|contact| outcome.last_swing(contact?)).collect()
    }

    /// Leads quantities along a run; none where it stops itself.
    fn run(
        &self,
        (course, swings): (&Course, &[Option<[Extreme; 2]>]),
        parameters: &[Parameter],
    ) -> Result<Option<Led>, VariationError> {
        let model = &self.job.model;
        let plan = Plan { every: None, until_steady: None, ..self.job.scenario.plan };
        let Ok(start) = model.start(&plan) else { return Ok(None) };
        let mut variation = model.variation((&plan, &start), parameters)?;
        if self.told.iter().any(|told| told.is_energy()) {
            variation = variation.with_energies();
        }
        if self.is_halved {
            variation = variation.in_halves();
        }
        let Ok(mut run) = Run::new(model, &plan, start) else { return Ok(None) };
        let mut looks = Vec::new();
        let mut turns = Turns::of(self.told, swings, parameters.len());
        let stands = turns.stands();
        for moment in course.moments {
            let now = run.state().time();
            let stands = stands.iter().copied().filter(|t| (now..moment).contains(t));
            for stop in stands.chain([moment.max(now)]) {
                let mut record = Turning { variation: &mut variation, turns: &mut turns };
                let mut record = Interruptible { record: &mut record, goes_on: self.goes_on };
                if run.advance(stop, &mut record).is_err() {
                    return Ok(None);
                }
                turns.look(&variation, run.state(), true);
            }
            looks.push(self.look(&variation, run.state(), parameters.len()));
        }
        run.stop(&mut ());
        variation.finish(run.state())?;
        Ok(Some(Led { course: *course, looks, turns }))
    }

    /// What is seen at a moment.
    fn look(&self, variation: &Variation<'_>, state: &State, count: usize) -> Look {
        let place = |told: &Told| {
            let (body, axis) = told.coordinate(&self.job)?;
            let (value, rate) = state.coordinate(&self.job.model, body, axis)?;
            let acceleration = variation.acceleration(state, body, axis)?;
            let moved = (0..count).filter_map(|j| variation.coordinate(body, axis, j)).collect();
            Some(Place { value, rate, acceleration, moved })
        };
        Look {
            places: self.told.iter().map(place).collect(),
            energies: (0..count).map(|j| variation.energies(state, j)).collect(),
            powers: variation.powers(state),
        }
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
            let slopes = steady.step_slopes(&self.job, (&parameters, self.is_halved), &goes_on)?;
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
    if all.is_empty() {
        return known.iter().map(|_| None).collect();
    }
    let mut found = match lead(&all) {
        Ok(Some(slopes)) => slopes.into_iter().map(Some).collect(),
        Err(VariationError::MovesApart { .. } | VariationError::NotSmooth { .. } | VariationError::Form)
            if all.len() > 1 =>
        {
            let alone = |one: &&T| lead(&[*one]).ok().flatten().and_then(|slopes| slopes.into_iter().next());
            all.iter().map(alone).collect::<Vec<_>>()
        }
        _ => vec![None; all.len()],
    }
    .into_iter();
    known.iter().map(|known| known.as_ref().and_then(|_| found.next().flatten())).collect()
}
