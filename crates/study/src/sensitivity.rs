//! By how much figures of a run change with the numbers of its scenario: which number matters?
//!
//! A [`Sensitivity`] is of a scenario, some [`Figure`]s and some [`Quantity`]s; [`Sensitivity::take`] tells the [`Derivative`] of
//! each figure with respect to each quantity, with how far it may be off. Where no number is true it tells why, and both sides.
//!
//! In reading order: `figure` and `quantity`, what is asked; `led`, slopes that variations of the scenario's own run tell; `sample`, what a
//! variant comes to; `ladder`, which variants are run; `bench`, where; `stencil`, slopes from their values; `derivative`, what these mean; `table`, what
//! is told of them.

mod bench;
mod derivative;
mod error;
mod figure;
mod ladder;
mod led;
mod quantity;
mod sample;
mod stencil;
mod table;

pub use derivative::{Derivative, Slope, Source, Split};
pub use error::SensitivityError;
pub use figure::Figure;
pub use quantity::Quantity;
pub use sample::Missing;
pub(crate) use table::definitions;
pub use table::{all_files, csv, json, write};

use bench::{Bench, Silent};
use derivative::Near;
use figure::Reading;
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
/// Share of what the slopes on both sides differ by that their mean may be off by. A variation is as one of the sides has it: where there
/// is a kink, the mean is off by half of it.
const BEND: f64 = 1.0 / 64.0;

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
        Ok(Self { job, figures, quantities, tolerance, happened })
    }

    /// How many runs it takes, about: fewer are not done, more where something happens near by, or where no variation is known.
    #[must_use]
    pub fn runs(&self) -> usize {
        let is_led = led::tells(&self.job, &self.figures);
        let of = |quantity: &Quantity| match quantity.value {
            0.0 => ladder::probes().count() + ladder::first().count(),
            _ if is_led => ladder::beside(ladder::NEAR[0]).count(),
            _ => ladder::first().count(),
        };
        self.quantities.iter().map(of).sum()
    }

    /// The derivatives, on so many cores; the same for any number. The watcher is told how many runs are done; where it wants an
    /// end, what hangs on others is [`Missing::NotRun`].
    pub fn take(&self, cores: usize, watcher: &(dyn Watcher + Sync)) -> Taken {
        let has_rows = !led::tells(&self.job, &self.figures);
        let done = AtomicUsize::new(0);
        let bench = Bench { asked: self, tolerance: self.tolerance, cores, watcher, has_rows, done: &done };
        let goes_on = || watcher.goes_on();
        let asked = (&self.figures[..], &self.quantities[..]);
        let led = led::slopes(&self.job, asked, (self.tolerance, cores), &goes_on);
        let scales = bench.scales();
        let all = |of: &dyn Fn(usize) -> Vec<(f64, bool)>| {
            let variants =
                (0..self.quantities.len()).flat_map(|q| of(q).into_iter().map(move |one| (q, one)));
            bench.run(&scales, &variants.collect::<Vec<_>>())
        };
        let mut tried = vec![Vec::new(); self.quantities.len()];
        let mut agreed = vec![false; self.quantities.len()];
        for power in ladder::NEAR {
            let is_asked = |q: usize| led[q].is_some() && !agreed[q];
            let more = all(&|q| if is_asked(q) { ladder::beside(power).collect() } else { Vec::new() });
            for (q, more) in more.into_iter().enumerate() {
                tried[q].extend(more);
                agreed[q] = led[q].as_ref().is_some_and(|slopes| agreed[q] || self.agree(&tried[q], slopes));
            }
        }
        let further = |q: usize| ladder::further(&tried[q]).collect();
        let more = all(&|q| if agreed[q] { Vec::new() } else { further(q) });
        tried.iter_mut().zip(more).for_each(|(tried, more)| tried.extend(more));
        let near = all(&|q| {
            let is_needed = !agreed[q] && (self.needs_finer(&tried[q]) || self.bends_near_by(&tried, q));
            if is_needed { ladder::finer().collect() } else { Vec::new() }
        });
        tried.iter_mut().zip(near).for_each(|(tried, finer)| tried.extend(finer));
        let noise = self.noises(&tried);
        let (tolerance, is_finer) = other_tolerance(self.tolerance);
        let other = Bench { tolerance, ..bench };
        let unled = (0..self.quantities.len()).filter(|q| !agreed[*q]);
        let variants: Vec<_> = unled.flat_map(|q| ladder::farthest().map(move |one| (q, one))).collect();
        let others = other.run(&scales, &variants);
        let by_differences = |f: usize, q: usize| {
            let missed = MISSED[usize::from(!is_finer)] * missed(&tried[q], &others[q], f);
            self.near(&tried[q], f, noise[f]).derivative().less_sure(missed)
        };
        let derivative = |f: usize, q: usize| match &led[q] {
            Some(slopes) if agreed[q] => Derivative::led(slopes[f]),
            Some(slopes) => by_differences(f, q).or_led(slopes[f]),
            None => by_differences(f, q),
        };
        let of = |f: usize| (0..self.quantities.len()).map(|q| derivative(f, q)).collect();
        let derivatives = (0..self.figures.len()).map(of).collect();
        Taken { derivatives, noise, runs: done.into_inner() }
    }

    /// Whether a figure still bends where the nearest variants of a quantity are.
    fn bends_near_by(&self, tried: &[Vec<Tried>], q: usize) -> bool {
        let noise = self.noises(tried);
        (0..self.figures.len()).any(|f| self.near(&tried[q], f, noise[f]).bends_near_by())
    }

    /// Whether the nearest runs on both sides of a quantity's value say of all figures what a variation does, its errors beside its slopes.
    fn agree(&self, tried: &[Tried], slopes: &[(f64, f64)]) -> bool {
        let beside = |sense: f64, f: usize| {
            let (offset, value, _) = ladder::levels(tried, sense).last()?.figure(f).ok()?;
            Some((offset.abs(), (value - self.figures[f].value) / offset))
        };
        self.figures.iter().zip(slopes).enumerate().all(|(f, (figure, (slope, error)))| {
            let (Some((distance, below)), Some((_, above))) = (beside(-1.0, f), beside(1.0, f)) else {
                return false;
            };
            let noise = UNMEASURED * self.tolerance * figure.value.abs() / distance;
            (0.5 * (below + above) - slope).abs() <= BEND * (above - below).abs() + noise + error
        })
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
