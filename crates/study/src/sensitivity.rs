//! Sensitivities: derivatives of a run's results with respect to parameters of its scenario.
//!
//! A [`Sensitivity`] contains a scenario, some [`Figure`]s (results) and some [`Quantity`]s (parameters). [`Sensitivity::take`] computes
//! the [`Derivative`] of each result with respect to each parameter, with its error. If a derivative does not exist, the analysis gives the
//! reason and the slopes on both sides.
//!
//! Modules in reading order:
//! * `figure`: results; `quantity`: parameters; `sample`: run of a variant.
//! * `ladder`: parameter values of the variants; `bench`: parallel runs.
//! * `five`: slope from four runs; `stencil`: slope by extrapolation from many runs; `derivative`: evaluation of both
//!   sides.
//! * `table`: output.

mod bench;
mod derivative;
mod error;
mod figure;
mod five;
mod ladder;
mod quantity;
mod sample;
mod stencil;
mod table;

pub use derivative::{Derivative, Slope, Split};
pub use error::SensitivityError;
pub use figure::Figure;
pub use quantity::Quantity;
pub use sample::Missing;
pub(crate) use table::definitions;
pub use table::{all_files, csv, json, write};

use crate::journal::Journal;
use bench::{Bench, Silent};
use derivative::Near;
use figure::Reading;
use five::Five;
use ladder::Tried;
use sample::{Happened, Ran, Sample};
use std::sync::atomic::AtomicUsize;
use stickslip_run::{Job, Watcher};

/// Request for derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// Names of results; empty for the default results.
    pub of: Vec<String>,
    /// Key paths of parameters; empty for all parameters of the model.
    pub to: Vec<String>,
    /// Adds the step length and velocity of the periodic orbit to the results.
    pub steady: bool,
    /// Tolerance of the local error per time step, relative to natural scales: 1e-13 to 1e-6. Runs use this tolerance and locate events.
    pub tolerance: f64,
}

impl Default for Asked {
    fn default() -> Self {
        Self { of: Vec::new(), to: Vec::new(), steady: false, tolerance: 1e-12 }
    }
}

/// Results and parameters of a scenario, with all data for the derivatives.
pub struct Sensitivity {
    /// The unchanged scenario.
    pub job: Job,
    /// Results to be differentiated.
    pub figures: Vec<Figure>,
    /// Parameters.
    pub quantities: Vec<Quantity>,
    /// Tolerance of the local error per time step.
    pub tolerance: f64,
    /// Journal of the runs.
    pub journal: Journal,
    happened: Happened,
}

/// Computed derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct Taken {
    /// Derivatives by result, then by parameter, in the order of the figures and quantities of [`Sensitivity`].
    pub derivatives: Vec<Vec<Derivative>>,
    /// Standard deviation of the numerical noise of each result, if measured.
    pub noise: Vec<Option<f64>>,
    /// Number of runs in addition to the run of the unchanged scenario.
    pub runs: usize,
}

/// Number of distances on one side that is sufficient without closer distances.
const ENOUGH: usize = 4;
/// Relative noise of a result if it could not be measured, as a multiple of the tolerance.
const UNMEASURED: f64 = 100.0;
/// Ratio of the two tolerances whose slopes are compared, and smallest tolerance. A ratio of 10 is not enough: quadratures may have the
/// same nodes and the same error.
const DECADES: f64 = 100.0;
const FINEST: f64 = 1e-13;
/// Error of a slope, as a fraction of the difference between the slopes at both tolerances: if the other tolerance is finer, or coarser.
const MISSED: [f64; 2] = [2.0, 0.1];
/// Tolerance of the runs at large distances, unless a larger tolerance is requested.
const COARSE: f64 = 1e-9;
/// Relative error that all runs have in common, as a multiple of the tolerance.
const MISSED_ALIKE: f64 = 1e3;
/// Sufficient relative error of a slope, and smallest elasticity to which this error refers.
const ENOUGH_OF: f64 = 1e-4;
const ELASTICITY: f64 = 0.1;

impl Sensitivity {
    /// Prepares the derivatives by a run of the unchanged scenario.
    ///
    /// # Errors
    /// Fails if the tolerance is out of range, the run stops early, or a result or parameter does not exist.
    pub fn new(job: Job, asked: &Asked, watcher: &dyn Watcher) -> Result<Self, SensitivityError> {
        let tolerance = asked.tolerance;
        if !(1e-13..=1e-6).contains(&tolerance) {
            return Err(SensitivityError::Tolerance(tolerance));
        }
        let quantities = match asked.to.is_empty() {
            true => Quantity::all(&job),
            false => once(&asked.to)?.map(|path| Quantity::of(&job, path)).collect::<Result<_, _>>()?,
        };
        if quantities.is_empty() {
            return Err(SensitivityError::NoQuantity(job.name));
        }
        let (figures, happened) = figures(&job, asked, &Silent(watcher))?;
        Ok(Self { job, figures, quantities, tolerance, journal: Journal::default(), happened })
    }

    /// Returns the approximate number of runs. The number is a lower bound, because events near the parameter value need more runs.
    #[must_use]
    pub fn runs(&self) -> usize {
        let of = |quantity: &Quantity| match quantity.value {
            0.0 => ladder::probes().count() + ladder::pairs(ladder::PAIRS[0]).count(),
            _ => ladder::pairs(ladder::PAIRS[0]).count(),
        };
        self.quantities.iter().map(of).sum()
    }

    /// Computes the derivatives on `cores` threads. The result does not depend on the number of threads.
    ///
    /// Four runs per parameter are sufficient if results are smooth, eight if events occur between the first four runs. Otherwise a series
    /// of decreasing distances is used, and runs at another tolerance give the integration error. The watcher receives the number of
    /// finished runs. If the watcher interrupts, missing derivatives are [`Missing::NotRun`].
    pub fn take(&self, cores: usize, watcher: &(dyn Watcher + Sync)) -> Taken {
        let has_rows = self.figures.iter().any(Figure::needs_rows);
        let done = AtomicUsize::new(0);
        let bench = Bench { asked: self, tolerance: self.tolerance, cores, watcher, has_rows, done: &done };
        let scales = bench.scales();
        let count = self.quantities.len();
        let by = |bench: &Bench<'_>, of: &dyn Fn(usize) -> Vec<(f64, bool)>| {
            let variants = (0..count).flat_map(|q| of(q).into_iter().map(move |one| (q, one)));
            bench.run(&scales, &variants.collect::<Vec<_>>())
        };
        let all = |of: &dyn Fn(usize) -> Vec<(f64, bool)>| by(&bench, of);
        // At large distances noise has little effect, so runs at a coarser tolerance are sufficient.
        let coarse = Bench { tolerance: self.tolerance.max(COARSE), ..bench };
        // If the requested tolerance is coarser, only the series of distances gives an error estimate.
        let pairs = |place: usize| ladder::pairs(ladder::PAIRS[place]).collect::<Vec<_>>();
        let is_asked = self.tolerance <= COARSE;
        let four = by(&coarse, &|_| if is_asked { pairs(0) } else { Vec::new() });
        let mut near = self.smooth(&four, (&coarse.own(), coarse.tolerance));
        let open: Vec<bool> = (0..count).map(|q| self.is_open(&near, q)).collect();
        let mut tried = all(&|q| if is_asked && open[q] { pairs(1) } else { Vec::new() });
        let own: Vec<Option<f64>> = self.figures.iter().map(|figure| Some(figure.value)).collect();
        let found = self.smooth(&tried, (&own, self.tolerance));
        for (slopes, found) in near.iter_mut().zip(found) {
            for q in (0..count).filter(|q| open[*q]) {
                slopes[q] = agreed(slopes[q], found[q]);
            }
        }
        let is_open = |q: usize| near.iter().any(|slopes| slopes[q].is_none());
        let further = |q: usize| ladder::further(&tried[q]).collect();
        let more = all(&|q| if is_open(q) { further(q) } else { Vec::new() });
        tried.iter_mut().zip(more).for_each(|(tried, more)| tried.extend(more));
        let more = all(&|q| {
            let is_needed = is_open(q) && (self.needs_finer(&tried[q]) || self.bends_near_by(&tried, q));
            if is_needed { ladder::finer().collect() } else { Vec::new() }
        });
        tried.iter_mut().zip(more).for_each(|(tried, finer)| tried.extend(finer));
        let noise = self.noises(&tried);
        let (tolerance, is_finer) = other_tolerance(self.tolerance);
        let other = Bench { tolerance, ..bench };
        let open = (0..self.quantities.len()).filter(|q| is_open(*q));
        let variants: Vec<_> = open.flat_map(|q| ladder::farthest().map(move |one| (q, one))).collect();
        let others = other.run(&scales, &variants);
        let derivative = |f: usize, q: usize| match near[f][q] {
            Some(slope) => Derivative::Known(slope),
            None => {
                let missed = MISSED[usize::from(!is_finer)] * missed(&tried[q], &others[q], f);
                self.near(&tried[q], f, noise[f]).derivative().less_sure(missed)
            }
        };
        let of = |f: usize| (0..self.quantities.len()).map(|q| derivative(f, q)).collect();
        let derivatives = (0..self.figures.len()).map(of).collect();
        Taken { derivatives, noise, runs: done.into_inner() }
    }

    /// Returns whether a slope with respect to a parameter is unknown or not accurate enough.
    fn is_open(&self, near: &[Vec<Option<Slope>>], q: usize) -> bool {
        let quantity = self.quantities[q].value;
        near.iter().zip(&self.figures).any(|(slopes, figure)| {
            let large = (ELASTICITY * figure.value / quantity).abs();
            slopes[q].is_none_or(|slope| slope.error > ENOUGH_OF * slope.value.abs().max(large))
        })
    }

    /// Returns the slopes from four runs, for each result and parameter, if the result is smooth.
    fn smooth(
        &self,
        tried: &[Vec<Tried>],
        (own, tolerance): (&[Option<f64>], f64),
    ) -> Vec<Vec<Option<Slope>>> {
        let of = |f: usize| {
            let of_run = |tried: &Vec<Tried>| self.five((f, own.get(f).copied().flatten()?), tried);
            let stencils: Vec<Option<Five>> = tried.iter().map(of_run).collect();
            let mut noises: Vec<f64> = stencils.iter().flatten().map(Five::noise).collect();
            noises.sort_by(f64::total_cmp);
            // Median of the noise in the runs of all parameters, but at least the rounding error.
            let noise = noises.get(noises.len() / 2).copied().unwrap_or(0.0);
            let noise = noise.max(f64::EPSILON * self.figures[f].value.abs());
            let slope = |(stencil, quantity): (&Option<Five>, &Quantity)| {
                let stencil = stencil.as_ref()?;
                // Roughness with respect to one parameter only is not noise of the result, but an error of the slope for this parameter.
                let slope = stencil.slope(noise.max(stencil.noise()))?;
                // Integration error that all runs have in common.
                let missed = MISSED_ALIKE * tolerance * (self.figures[f].value / quantity.value).abs();
                Some(Slope { error: slope.error + if quantity.value == 0.0 { 0.0 } else { missed }, ..slope })
            };
            stencils.iter().zip(&self.quantities).map(slope).collect()
        };
        (0..self.figures.len()).map(of).collect()
    }

    /// Returns the stencil of a result: its values at four neighbouring parameter values and at the parameter value itself. Returns `None`
    /// if the events on both sides differ.
    fn five(&self, (f, own): (usize, f64), tried: &[Tried]) -> Option<Five> {
        let [below, above, near_below, near_above] = tried else { return None };
        let all = [below, above, near_below, near_above].map(|tried| tried.figure(f).ok());
        let [below, above, near_below, near_above] = all;
        let (below, above, near_below, near_above) = (below?, above?, near_below?, near_above?);
        // Small loops close or not depending on rounding, at any distance. The effect of such loops is visible in the result.
        let is_settled = below.2 == near_below.2 && above.2 == near_above.2;
        if self.figures[f].reading.is_of_run() && is_settled && below.2 != above.2 {
            return None;
        }
        let point = |(offset, value, _): (f64, f64, &Happened)| (offset, value);
        Some(Five::new([(0.0, own), point(below), point(above), point(near_below), point(near_above)]))
    }

    /// Returns whether a result is still nonlinear near the closest variants.
    fn bends_near_by(&self, tried: &[Vec<Tried>], q: usize) -> bool {
        let noise = self.noises(tried);
        (0..self.figures.len()).any(|f| self.near(&tried[q], f, noise[f]).bends_near_by())
    }

    /// Returns whether events on one side change before there are enough distances with unchanged events.
    fn needs_finer(&self, tried: &[Tried]) -> bool {
        let is_alike =
            |tried: &&Tried| tried.sample.as_ref().is_ok_and(|sample| sample.happened == self.happened);
        [-1.0, 1.0].into_iter().any(|sense| {
            let levels = ladder::levels(tried, sense);
            let has_any = levels.iter().any(|tried| tried.sample.is_ok());
            has_any && levels.into_iter().filter(is_alike).count() < ENOUGH
        })
    }

    /// Returns the noise of a result near a parameter value. Only runs with the same events as the unchanged scenario are used, or all runs
    /// if no distances have the same events.
    fn own_noise(&self, f: usize, tried: &[Tried]) -> Option<f64> {
        let is_of_run = self.figures[f].reading.is_of_run();
        let flickers = [-1.0, 1.0].into_iter().any(|sense| ladder::settled(tried, sense).is_none());
        let value = |tried: &Tried| {
            let sample = tried.sample.as_ref().ok()?;
            let belongs = flickers || !is_of_run || sample.happened == self.happened;
            sample.figures.get(f).copied().flatten().filter(|_| belongs)
        };
        ladder::neighbours(tried, self.figures[f].value, value).and_then(|values| stencil::noise(&values))
    }

    /// Collects the data of a result near a parameter value. `noise` is the noise of the result over all parameters.
    fn near<'a>(&'a self, tried: &'a [Tried], f: usize, noise: Option<f64>) -> Near<'a> {
        let figure = &self.figures[f];
        let common = noise.unwrap_or(UNMEASURED * self.tolerance * figure.value.abs());
        let own = self.own_noise(f, tried).unwrap_or(common);
        let noise = own.max(common).max(f64::EPSILON * figure.value.abs());
        // Events belong to a run of the scenario. The events of a periodic orbit are not compared.
        let happened = figure.reading.is_of_run().then_some(&self.happened);
        Near { tried, figure: f, own: (figure.value, happened), noise }
    }

    /// Returns the noise of all results.
    fn noises(&self, tried: &[Vec<Tried>]) -> Vec<Option<f64>> {
        (0..self.figures.len()).map(|f| self.noise(f, tried)).collect()
    }

    /// Returns the noise of a result: the median over all parameters.
    fn noise(&self, f: usize, tried: &[Vec<Tried>]) -> Option<f64> {
        let mut all: Vec<f64> = tried.iter().filter_map(|tried| self.own_noise(f, tried)).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied()
    }
}

impl Taken {
    /// Returns the elasticity: relative change of a result per relative change of a parameter. Returns `None` if result or parameter is 0.
    #[must_use]
    pub fn elasticity(asked: &Sensitivity, (f, q): (usize, usize), slope: f64) -> Option<f64> {
        let (figure, quantity) = (asked.figures[f].value, asked.quantities[q].value);
        let elasticity = slope * quantity / figure;
        (figure != 0.0 && quantity != 0.0 && elasticity.is_finite()).then_some(elasticity)
    }

    /// Returns the parameters ordered by elasticity of a result, the largest first. Parameters without elasticity are last.
    #[must_use]
    pub fn order(&self, asked: &Sensitivity, f: usize) -> Vec<usize> {
        let size = |q: usize| {
            let steepest = self.derivatives[f][q].steepest();
            steepest.and_then(|slope| Self::elasticity(asked, (f, q), slope)).map_or(-1.0, f64::abs)
        };
        let mut order: Vec<usize> = (0..self.derivatives[f].len()).collect();
        order.sort_by(|a, b| size(*b).total_cmp(&size(*a)));
        order
    }

    /// Returns the number of unknown derivatives.
    #[must_use]
    pub fn faults(&self) -> usize {
        self.derivatives
            .iter()
            .flatten()
            .filter(|derivative| matches!(derivative, Derivative::Unknown(_)))
            .count()
    }

    /// Returns whether the computation was interrupted, so that some derivatives lack runs.
    #[must_use]
    pub fn is_cut(&self) -> bool {
        let is_missing = |slope: &Result<Slope, Missing>| matches!(slope, Err(Missing::NotRun));
        self.derivatives.iter().flatten().any(|derivative| match derivative {
            Derivative::Known(_) => false,
            Derivative::Split { below, above, .. } => is_missing(below) || is_missing(above),
            Derivative::Unknown(missing) => *missing == Missing::NotRun,
        })
    }
}

/// Returns the more accurate of two slopes, from outer and inner runs. Returns `None` if the slopes contradict each other or the inner runs
/// give no slope.
fn agreed(far: Option<Slope>, near: Option<Slope>) -> Option<Slope> {
    let (Some(far), Some(near)) = (far, near) else { return near };
    let agree = (far.value - near.value).abs() <= far.error + near.error;
    agree.then_some(if near.error < far.error { near } else { far })
}

/// Returns the other tolerance for the estimate of the integration error, and whether the other tolerance is finer.
fn other_tolerance(tolerance: f64) -> (f64, bool) {
    let finer = tolerance / DECADES;
    // 1e-11 / 100 is not exactly 1e-13.
    if finer >= 0.99 * FINEST { (finer.max(FINEST), true) } else { (tolerance * DECADES, false) }
}

/// Returns the largest difference between slopes at two tolerances, from the same variants. If only one side has results, the difference of
/// these results counts entirely.
fn missed(tried: &[Tried], others: &[Tried], f: usize) -> f64 {
    let off = |other: &Tried| {
        let own = tried.iter().find(|own| own.share == other.share)?;
        let ((offset, other, _), (_, own, _)) = (other.figure(f).ok()?, own.figure(f).ok()?);
        Some((offset, other - own))
    };
    // Variants below and above the parameter value at the same distance are adjacent in the list.
    let slopes =
        others.chunks_exact(2).map(|both| match both.iter().filter_map(off).collect::<Vec<_>>()[..] {
            [(below, by), (above, more)] => (more - by) / (above - below),
            [(offset, by)] => by / offset,
            _ => 0.0,
        });
    slopes.map(f64::abs).fold(0.0, f64::max)
}

/// Returns the names, or an error if a name occurs twice.
fn once(names: &[String]) -> Result<impl Iterator<Item = &String>, SensitivityError> {
    match names.iter().enumerate().find(|(place, name)| names[..*place].contains(name)) {
        Some((_, twice)) => Err(SensitivityError::Twice(twice.clone())),
        None => Ok(names.iter()),
    }
}

/// Returns the requested results with their values, and the events of the unchanged scenario.
fn figures(
    job: &Job,
    asked: &Asked,
    watcher: &dyn Watcher,
) -> Result<(Vec<Figure>, Happened), SensitivityError> {
    let file = || job.name.clone();
    let steady =
        if asked.steady { figure::STEADY.map(|(name, _)| name.to_owned()).to_vec() } else { Vec::new() };
    let steady = steady.into_iter().filter(|name| !asked.of.contains(name));
    let own = sample::ready(job.scenario.clone(), &job.name, asked.tolerance)?;
    let runs = asked.of.is_empty() || asked.of.iter().any(|name| figure::steady(name).is_none());
    let ran = runs.then(|| Ran::of(&own, watcher)).transpose().map_err(|missing| match missing {
        Missing::NotRun => SensitivityError::Interrupted,
        other => SensitivityError::Stopped { file: file(), why: other.to_string() },
    })?;
    let default = ran.as_ref().map_or_else(Vec::new, |ran| figure::by_default(job, &ran.summary));
    let names: Vec<String> = match asked.of.is_empty() {
        true => default.into_iter().chain(steady).collect(),
        false => once(&asked.of)?.cloned().chain(steady).collect(),
    };
    if names.is_empty() {
        return Err(SensitivityError::NoDefault(file()));
    }
    let found = if names.iter().any(|name| figure::steady(name).is_some()) {
        let found = sample::find_steady(&own, asked.tolerance, watcher);
        found.map_err(|source| SensitivityError::NotSteady { file: file(), source })?
    } else {
        None
    };
    let of = |name: &String| -> Result<Figure, SensitivityError> {
        let (reading, value) = match (figure::steady(name), &ran, found) {
            (Some(Reading::SteadySpeed), _, Some([_, speed])) => (Reading::SteadySpeed, speed),
            (Some(reading), _, Some([step, _])) => (reading, step),
            (None, Some(ran), _) => figure::find(job, name, &ran.summary, &|channel| ran.at_end(channel))?,
            _ => return Err(SensitivityError::NotHere { name: name.clone(), file: file() }),
        };
        Ok(Figure { name: name.clone(), unit: figure::unit(name), value, reading })
    };
    let figures = names.iter().map(of).collect::<Result<_, _>>()?;
    Ok((figures, ran.map(Ran::happened).unwrap_or_default()))
}
