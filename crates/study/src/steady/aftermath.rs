//! What a run ends on that leaves an unstable motion.
//!
//! All numbers of the motion are disturbed a little, and plain periods follow until their states come back: after one period, that
//! is another steady motion, or after several, as where a period has doubled. What never comes back beats or is irregular.

use super::map::Map;
use super::{Options, Steady, SteadyError};
use nalgebra::DVector;
use stickslip_drive::scene::Axis;
use stickslip_drive::section::Section;
use stickslip_drive::{RunError, State};
use stickslip_measure::{Bounds, Settling};
use stickslip_run::{Job, Real, quantity};

/// By how much every number is disturbed, in natural scales; less where that would take a memory apart.
const DISTURBED: [f64; 3] = [1e-2, 1e-4, 1e-6];
/// A run this many disturbances away has left.
const LEFT: f64 = 10.0;
/// Most periods after which a state is looked for again.
const MOST: usize = 64;
/// How near it must be in the end, in natural scales: twice as long a pattern may differ by little.
const NEAR: f64 = 1e-7;
/// Times that the disturbance grows by e until it is as large as the motion, twice, and periods to find a pattern then.
const FOLDS: f64 = 10.0;
const THEN: f64 = 1e3;
/// What is that much nearer after a pattern is on its way there.
const FALLING: f64 = 0.9;
/// A beat that changes by more than this share, from its first step to its last, is on its way.
const GROWN: f64 = 0.01;
/// What is rounding.
const ROUNDING: f64 = 1e-9;
/// Coarser than the search: what is looked for are patterns.
const TOLERANCE: f64 = 1e-9;

/// What a run comes to.
#[derive(Debug, Clone, PartialEq)]
pub enum Ending {
    /// It repeats itself after so many periods.
    Repeats(usize),
    /// It beats with this many periods, or a part of them, and never repeats itself.
    Beats(f64),
    /// It has no pattern.
    Irregular,
    /// It is still on its way: away from the motion, or to whatever it ends on.
    Underway,
    /// It stops.
    Stops(RunError),
}

/// Where a run has got to that leaves a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Aftermath {
    /// What it does at the end.
    pub ending: Ending,
    /// Periods until then.
    pub periods: usize,
    /// The steps that repeat themselves, m, else those of the last half; none where no body steps.
    pub steps: Vec<f64>,
}

impl Aftermath {
    /// Mean, shortest and longest step, m.
    #[must_use]
    pub fn range(&self) -> Option<[f64; 3]> {
        let [least, most] = [f64::min, f64::max].map(|pick| self.steps.iter().copied().reduce(pick));
        let mean = self.steps.iter().sum::<f64>() / self.steps.len() as f64;
        Some([mean, least?, most?])
    }

    /// In words: `steps that repeat themselves every 5 periods, …`.
    #[must_use]
    pub fn words(&self) -> String {
        let after = format!("after {} periods", self.periods);
        let length = |x: f64| quantity(Real(x), "m");
        let steps = self.range().map_or_else(String::new, |[mean, least, most]| match self.ending {
            Ending::Repeats(1) => format!(", {} a period", length(mean)),
            _ => format!(", {} to {}, {} on average", length(least), length(most), length(mean)),
        });
        match &self.ending {
            Ending::Repeats(1) => format!("another steady motion{steps}, {after}"),
            Ending::Repeats(count) => {
                format!("a motion that repeats itself every {count} periods{steps}, {after}")
            }
            Ending::Beats(period) => {
                format!("a motion that oscillates with a period of {period:.2} drive periods{steps}, {after}")
            }
            Ending::Irregular => format!("irregular motion{steps}, {after}"),
            Ending::Underway => format!("not settled {after}{steps}"),
            Ending::Stops(error) => format!("a run that stops {after}: {error}"),
        }
    }
}

impl Ending {
    /// Its word in files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Repeats(_) => "repeats",
            Self::Beats(_) => "oscillates",
            Self::Irregular => "irregular",
            Self::Underway => "not_settled",
            Self::Stops(_) => "stops",
        }
    }
}

impl Steady {
    /// What a run ends on that is disturbed a little from this motion, within the periods of the options; none where it is stable,
    /// or where no number of it can be disturbed.
    ///
    /// # Errors
    ///
    /// An interruption.
    pub fn aftermath(&self, job: &Job, options: &Options<'_>) -> Result<Option<Aftermath>, SteadyError> {
        if self.is_stable() {
            return Ok(None);
        }
        let options = Options { tolerance: options.tolerance.max(TOLERANCE), ..*options };
        let mut map = Map::new(&self.model, self.period, job, &options);
        map.set(Section::new(&self.model, self.state.clone()));
        let all = DVector::from_element(map.unknowns(), 1.0);
        let disturbed = DISTURBED.iter().find_map(|by| Some((map.moved(&self.state, &(&all * *by))?, *by)));
        let Some((state, by)) = disturbed else { return Ok(None) };
        // Steps are those of whole periods, as a run tells them.
        let start = self.start(job)?;
        let periods = ((state.time() - start.time()) / self.period).ceil();
        let state = map.lead(state, start.time() + periods * self.period, &mut ())?;
        let section = Section::new(&self.model, state.clone());
        let (start, _) = section.back(start);
        map.set(section);
        let folds = self.multipliers.first().and_then(super::Multiplier::periods).unwrap_or(f64::INFINITY);
        let enough = (FOLDS * folds + THEN).min(f64::from(u32::MAX)) as u32;
        let mut way = Way { states: vec![state], steps: Vec::new() };
        let ending = loop {
            if let Some(repeats) = way.repeats(&map, (&start, LEFT * by)) {
                way.steps.drain(..way.steps.len().saturating_sub(repeats));
                break Ending::Repeats(repeats);
            }
            let has_time = map.work() < enough;
            if !has_time || !map.may_go_on() {
                way.steps.drain(..way.steps.len() / 2);
                break if has_time { Ending::Underway } else { judged(&way.steps) };
            }
            match way.go_on(&mut map, job.scenario.figures.body) {
                Ok(()) => (),
                Err(SteadyError::Run(error)) => break Ending::Stops(error),
                Err(error) => return Err(error),
            }
        };
        Ok(Some(Aftermath { ending, periods: map.work() as usize, steps: way.steps }))
    }
}

/// Plain periods so far.
struct Way {
    /// The last few, as if each stood at the section.
    states: Vec<State>,
    /// All, m.
    steps: Vec<f64>,
}

impl Way {
    fn go_on(&mut self, map: &mut Map<'_>, body: Option<usize>) -> Result<(), SteadyError> {
        let Some(last) = self.states.last() else { return Ok(()) };
        let image = map.image(last, 1.0)?;
        let step = body.zip(map.section()).and_then(|(body, at)| at.of_body(&image.way, body, Axis::X));
        self.steps.extend(step);
        self.states.push(image.state);
        if self.states.len() > 4 * MOST {
            self.states.drain(..2 * MOST);
        }
        Ok(())
    }

    /// After how many periods the states come back, away from the motion that has been left: all of one round, each to where it
    /// was a round before. A beat that fades passes near itself now and then.
    fn repeats(&self, map: &Map<'_>, (left, far): (&State, f64)) -> Option<usize> {
        let last = self.states.len() - 1;
        let apart = |k: usize, back: usize| -> Option<f64> {
            Some(map.difference(&self.states[k], &self.states[k.checked_sub(back)?])?.amax())
        };
        let has_left = |k: usize| map.difference(&self.states[k], left).is_none_or(|off| off.amax() > far);
        // What is still to come of the way there, by its last two parts.
        let to_come = |k: usize, back: usize| -> Option<f64> {
            let [now, before] = [apart(k, back)?, apart(k.checked_sub(back)?, back)?];
            Some(if now <= ROUNDING { 0.0 } else { now / (1.0 - now / before).max(0.0) })
        };
        let comes_back = |back: usize| {
            (0..back)
                .all(|k| last.checked_sub(k).and_then(|k| to_come(k, back)).is_some_and(|left| left <= NEAR))
        };
        let back = (1..=MOST).find(|back| comes_back(*back))?;
        // What changes sides on its way comes back after two periods before it does after one, and a beat after as many as it has
        // before it has faded.
        let widest = |before: usize, part: usize| -> Option<f64> {
            let moments = (0..MOST).map(|k| apart(last.checked_sub(before + k)?, part));
            moments.collect::<Option<Vec<_>>>().map(|apart| apart.into_iter().fold(0.0, f64::max))
        };
        let is_falling = |part: usize| match (widest(0, part), widest(MOST, part)) {
            (Some(now), Some(before)) => now > ROUNDING && now < FALLING * before,
            // Too early to tell.
            _ => true,
        };
        let shorter = (1..back).any(|part| back % part == 0 && is_falling(part));
        (!shorter && (0..back).any(|k| has_left(last - k))).then_some(back)
    }
}

/// What steps do that have not come back.
fn judged(steps: &[f64]) -> Ending {
    match Settling::of(steps, Bounds { least: 0.0, most: f64::INFINITY, error: 0.0 }) {
        Settling::Beats { period, growth: Some(growth), .. }
            if (math::ln(growth) * steps.len() as f64).abs() < GROWN =>
        {
            Ending::Beats(period)
        }
        Settling::Irregular { .. } => Ending::Irregular,
        _ => Ending::Underway,
    }
}
