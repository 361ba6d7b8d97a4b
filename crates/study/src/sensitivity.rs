//! By how much figures of a run change with the numbers of its scenario: which number matters?
//!
//! A [`Sensitivity`] is of a scenario, some [`Figure`]s and some [`Quantity`]s; [`Sensitivity::take`] tells the [`Derivative`] of
//! each figure with respect to each quantity, with how far it may be off. Where no number is true it tells why, and both sides.
//!
//! In reading order: `figure` and `quantity`, what is asked; `sample`, what a
//! variant comes to; `ladder`, which variants are run; `bench`, where; `stencil`, slopes from their values; `derivative`, what these mean; `table`, what
//! is told of them.

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

/// What derivatives are asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// Names of figures; those that stand out where there are none.
    pub of: Vec<String>,
    /// Key paths of quantities; all that say what there is and what drives it where there are none.
    pub to: Vec<String>,
    /// Whether step and speed of steady motion are among the figures.
    pub steady: bool,
    /// Local error per step of the runs, relative to natural scales, whatever the scenario's own stepper is: 1e-13 to 1e-6.
    pub tolerance: f64,
}

impl Default for Asked {
    fn default() -> Self {
        Self { of: Vec::new(), to: Vec::new(), steady: false, tolerance: 1e-12 }
    }
}

/// Figures of a scenario and what they may depend on.
pub struct Sensitivity {
    /// The scenario as it stands.
    pub job: Job,
    /// What derivatives are of.
    pub figures: Vec<Figure>,
    /// What they are with respect to.
    pub quantities: Vec<Quantity>,
    /// Local error per step of the runs.
    pub tolerance: f64,
    /// Where runs are looked up and written down.
    pub journal: Journal,
    happened: Happened,
}

/// Derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct Taken {
    /// Of each figure with respect to each quantity, in their orders.
    pub derivatives: Vec<Vec<Derivative>>,
    /// Standard deviation of each figure's noise, where it was measured.
    pub noise: Vec<Option<f64>>,
    /// Runs that were done beside that of the scenario as it stands.
    pub runs: usize,
}

/// Levels on a side that make finer ones needless.
const ENOUGH: usize = 4;
/// Noise where none could be measured, in tolerances.
const UNMEASURED: f64 = 100.0;
/// How far the tolerance lies from that of the slopes by which it is told what these miss, and from where on it is finer: the finest is 1e-13. What
/// is missed may be the same a decade away, where quadratures have the same nodes: of 89 slopes of the quickstart at 1e-7 27 differed by up
/// to 200 times what was told. Over two it falls by 30 to 100.
const DECADES: f64 = 100.0;
const FINEST: f64 = 1e-13;
/// Part of what slopes by differences differ by that is missed, where the other tolerance is finer and where it is coarser.
const MISSED: [f64; 2] = [2.0, 0.1];
/// Tolerance of the runs that are farthest, unless a larger one is asked for.
const COARSE: f64 = 1e-9;
/// What all runs miss alike, in tolerances of the figure per share of the quantity.
const MISSED_ALIKE: f64 = 1e3;
/// Relative error of a slope that is enough, and the elasticity below which it is taken as a share of that.
const ENOUGH_OF: f64 = 1e-4;
const ELASTICITY: f64 = 0.1;

impl Sensitivity {
    /// The derivatives of a scenario. Runs it as it stands.
    ///
    /// # Errors
    /// A run of its own that stops, figures or quantities that it does not have.
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

    /// How many runs it takes, about: fewer are not done, more where something happens near by.
    #[must_use]
    pub fn runs(&self) -> usize {
        let of = |quantity: &Quantity| match quantity.value {
            0.0 => ladder::probes().count() + ladder::pairs(ladder::PAIRS[0]).count(),
            _ => ladder::pairs(ladder::PAIRS[0]).count(),
        };
        self.quantities.iter().map(of).sum()
    }

    /// The derivatives, on so many cores; the same for any number. The watcher is told how many runs are done; where it wants an
    /// end, what hangs on others is [`Missing::NotRun`].
    ///
    /// Four runs for each quantity are enough where figures are smooth on both sides of its value, or four more near by where something
    /// happens between them; elsewhere a ladder of distances is climbed down, and the same at another tolerance tells what the runs miss.
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
        // Far out noise is divided by a large distance: cheaper runs serve as well.
        let coarse = Bench { tolerance: self.tolerance.max(COARSE), ..bench };
        // Of looser runs nothing is known but what the ladder tells.
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

    /// Whether a slope by a quantity is not known, or not well enough.
    fn is_open(&self, near: &[Vec<Option<Slope>>], q: usize) -> bool {
        let quantity = self.quantities[q].value;
        near.iter().zip(&self.figures).any(|(slopes, figure)| {
            let large = (ELASTICITY * figure.value / quantity).abs();
            slopes[q].is_none_or(|slope| slope.error > ENOUGH_OF * slope.value.abs().max(large))
        })
    }

    /// Slopes of each figure by each quantity from four runs, where the figure is smooth between them.
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
            // The middle of what the runs beside each quantity tell, and no less than what rounding leaves.
            let noise = noises.get(noises.len() / 2).copied().unwrap_or(0.0);
            let noise = noise.max(f64::EPSILON * self.figures[f].value.abs());
            let slope = |(stencil, quantity): (&Option<Five>, &Quantity)| {
                let stencil = stencil.as_ref()?;
                // What is rough beside one quantity alone is no noise of the figure, and no less an error.
                let slope = stencil.slope(noise.max(stencil.noise()))?;
                // All runs miss alike by their tolerance.
                let missed = MISSED_ALIKE * tolerance * (self.figures[f].value / quantity.value).abs();
                Some(Slope { error: slope.error + if quantity.value == 0.0 { 0.0 } else { missed }, ..slope })
            };
            stencils.iter().zip(&self.quantities).map(slope).collect()
        };
        (0..self.figures.len()).map(of).collect()
    }

    /// A figure at the four nearest values of a quantity and at its own; none where something else happens on one side than on the other.
    fn five(&self, (f, own): (usize, f64), tried: &[Tried]) -> Option<Five> {
        let [below, above, near_below, near_above] = tried else { return None };
        let all = [below, above, near_below, near_above].map(|tried| tried.figure(f).ok());
        let [below, above, near_below, near_above] = all;
        let (below, above, near_below, near_above) = (below?, above?, near_below?, near_above?);
        // Loops that are too small for the tolerance close or do not, however near: what such events matter is seen in the figure.
        let is_settled = below.2 == near_below.2 && above.2 == near_above.2;
        if self.figures[f].reading.is_of_run() && is_settled && below.2 != above.2 {
            return None;
        }
        let point = |(offset, value, _): (f64, f64, &Happened)| (offset, value);
        Some(Five::new([(0.0, own), point(below), point(above), point(near_below), point(near_above)]))
    }

    /// Whether a figure still bends where the nearest variants of a quantity are.
    fn bends_near_by(&self, tried: &[Vec<Tried>], q: usize) -> bool {
        let noise = self.noises(tried);
        (0..self.figures.len()).any(|f| self.near(&tried[q], f, noise[f]).bends_near_by())
    }

    /// Whether something else happens on a side of a quantity before there are enough levels.
    fn needs_finer(&self, tried: &[Tried]) -> bool {
        let is_alike =
            |tried: &&Tried| tried.sample.as_ref().is_ok_and(|sample| sample.happened == self.happened);
        [-1.0, 1.0].into_iter().any(|sense| {
            let levels = ladder::levels(tried, sense);
            let has_any = levels.iter().any(|tried| tried.sample.is_ok());
            has_any && levels.into_iter().filter(is_alike).count() < ENOUGH
        })
    }

    /// Noise of a figure near a quantity: of runs in which the same happens, or in which that is never the same.
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

    /// What is known about a figure near a quantity, by the noise that it has elsewhere.
    fn near<'a>(&'a self, tried: &'a [Tried], f: usize, noise: Option<f64>) -> Near<'a> {
        let figure = &self.figures[f];
        let common = noise.unwrap_or(UNMEASURED * self.tolerance * figure.value.abs());
        let own = self.own_noise(f, tried).unwrap_or(common);
        let noise = own.max(common).max(f64::EPSILON * figure.value.abs());
        // Events beside a steady motion are those of the run that stands beside it, and end where that does.
        let happened = figure.reading.is_of_run().then_some(&self.happened);
        Near { tried, figure: f, own: (figure.value, happened), noise }
    }

    /// Noise of all figures.
    fn noises(&self, tried: &[Vec<Tried>]) -> Vec<Option<f64>> {
        (0..self.figures.len()).map(|f| self.noise(f, tried)).collect()
    }

    /// Noise of a figure: the middle of what it is near each quantity.
    fn noise(&self, f: usize, tried: &[Vec<Tried>]) -> Option<f64> {
        let mut all: Vec<f64> = tried.iter().filter_map(|tried| self.own_noise(f, tried)).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied()
    }
}

impl Taken {
    /// Change of a figure per change of a quantity, both as shares of what they are; none of what is 0.
    #[must_use]
    pub fn elasticity(asked: &Sensitivity, (f, q): (usize, usize), slope: f64) -> Option<f64> {
        let (figure, quantity) = (asked.figures[f].value, asked.quantities[q].value);
        let elasticity = slope * quantity / figure;
        (figure != 0.0 && quantity != 0.0 && elasticity.is_finite()).then_some(elasticity)
    }

    /// Quantities by how much a figure changes with them, the largest elasticity first; those without one last, in their order.
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

    /// How many derivatives are not known at all.
    #[must_use]
    pub fn faults(&self) -> usize {
        self.derivatives
            .iter()
            .flatten()
            .filter(|derivative| matches!(derivative, Derivative::Unknown(_)))
            .count()
    }

    /// Whether it was interrupted: runs are missing that some of them hang on.
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

/// The better one of two slopes, from farther and from nearer runs; none where they contradict each other, or where the nearer ones have
/// none.
fn agreed(far: Option<Slope>, near: Option<Slope>) -> Option<Slope> {
    let (Some(far), Some(near)) = (far, near) else { return near };
    let agree = (far.value - near.value).abs() <= far.error + near.error;
    agree.then_some(if near.error < far.error { near } else { far })
}

/// The tolerance by which it is told what slopes by another one miss, and whether it is the finer one.
fn other_tolerance(tolerance: f64) -> (f64, bool) {
    let finer = tolerance / DECADES;
    // 1e-11 by 100 is not 1e-13 to the last bit.
    if finer >= 0.99 * FINEST { (finer.max(FINEST), true) } else { (tolerance * DECADES, false) }
}

/// By how much slopes by two tolerances differ at most, from the same variants on both sides. Where one side alone is known, what its figure
/// differs by is all of it.
fn missed(tried: &[Tried], others: &[Tried], f: usize) -> f64 {
    let off = |other: &Tried| {
        let own = tried.iter().find(|own| own.share == other.share)?;
        let ((offset, other, _), (_, own, _)) = (other.figure(f).ok()?, own.figure(f).ok()?);
        Some((offset, other - own))
    };
    // Both sides of a distance come one after the other.
    let slopes =
        others.chunks_exact(2).map(|both| match both.iter().filter_map(off).collect::<Vec<_>>()[..] {
            [(below, by), (above, more)] => (more - by) / (above - below),
            [(offset, by)] => by / offset,
            _ => 0.0,
        });
    slopes.map(f64::abs).fold(0.0, f64::max)
}

/// Names, none twice.
fn once(names: &[String]) -> Result<impl Iterator<Item = &String>, SensitivityError> {
    match names.iter().enumerate().find(|(place, name)| names[..*place].contains(name)) {
        Some((_, twice)) => Err(SensitivityError::Twice(twice.clone())),
        None => Ok(names.iter()),
    }
}

/// The figures asked for, with what they are, and what happens in the scenario's own run.
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
