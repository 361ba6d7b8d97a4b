//! Motion after leaving an unstable periodic orbit.
//!
//! All unknowns of the orbit are disturbed slightly and the drive is simulated until its states repeat. The resulting motion is an orbit of
//! the same or a multiple period (period doubling), an oscillation that never repeats, or irregular motion.

use super::map::Map;
use super::{Options, Steady, SteadyError};
use nalgebra::DVector;
use stickslip_drive::scene::Axis;
use stickslip_drive::section::Section;
use stickslip_drive::{RunError, State};
use stickslip_measure::{Bounds, Settling};
use stickslip_run::{Job, Real, quantity};

/// Disturbances of every unknown, in natural scales. Smaller disturbances are used if a slip memory does not allow larger ones.
const DISTURBED: [f64; 3] = [1e-2, 1e-4, 1e-6];
/// Distance from the unstable orbit, in units of the disturbance, at which the run counts as having left the orbit.
const LEFT: f64 = 10.0;
/// Longest period of a repeating motion, in drive periods.
const MOST: usize = 64;
/// Largest difference of states that count as repeated, in natural scales.
const NEAR: f64 = 1e-7;
/// Limit of the simulation: number of time constants of the disturbance, plus a number of periods.
const FOLDS: f64 = 10.0;
const THEN: f64 = 1e3;
/// Largest ratio of successive differences that counts as decay towards a repeating motion.
const FALLING: f64 = 0.9;
/// Relative change of the oscillation amplitude over the simulated steps above which the motion is not settled.
const GROWN: f64 = 0.01;
/// Differences below this value, in natural scales, are rounding errors.
const ROUNDING: f64 = 1e-9;
/// Tolerance of the runs, coarser than that of the orbit search.
const TOLERANCE: f64 = 1e-9;

/// Type of motion at the end of the simulation.
#[derive(Debug, Clone, PartialEq)]
pub enum Ending {
    /// The motion repeats itself after this number of periods.
    Repeats(usize),
    /// The motion oscillates with this period in drive periods, or a fraction of this period, and never repeats.
    Beats(f64),
    /// It is irregular.
    Irregular,
    /// It has not settled.
    Underway,
    /// The run stopped with an error.
    Stops(RunError),
}

/// Result of the simulation after leaving an unstable orbit.
#[derive(Debug, Clone, PartialEq)]
pub struct Aftermath {
    /// Type of motion at the end.
    pub ending: Ending,
    /// Number of simulated periods.
    pub periods: usize,
    /// Step lengths of the repeating pattern, m, or of the last half of the periods without repetition. Empty if no body makes steps.
    pub steps: Vec<f64>,
}

impl Aftermath {
    /// Returns mean, smallest and largest step length, m.
    #[must_use]
    pub fn range(&self) -> Option<[f64; 3]> {
        let [least, most] = [f64::min, f64::max].map(|pick| self.steps.iter().copied().reduce(pick));
        let mean = self.steps.iter().sum::<f64>() / self.steps.len() as f64;
        Some([mean, least?, most?])
    }

    /// Returns a description of the motion.
    #[must_use]
    pub fn words(&self) -> String {
        let after = format!("after {} periods", self.periods);
        let length = |x: f64| quantity(Real(x), "m");
        let steps = self.range().map_or_else(String::new, |[mean, least, most]| match self.ending {
            Ending::Repeats(1) => format!(", {} per period", length(mean)),
            _ => format!(", {} to {}, {} on average", length(least), length(most), length(mean)),
        });
        match &self.ending {
            Ending::Repeats(1) => format!("another periodic orbit{steps}, {after}"),
            Ending::Repeats(count) => {
                format!("a periodic orbit of {count} drive periods{steps}, {after}")
            }
            Ending::Beats(period) => {
                format!("a motion that oscillates with a period of {period:.2} drive periods{steps}, {after}")
            }
            Ending::Irregular => format!("irregular motion{steps}, {after}"),
            Ending::Underway => format!("not settled {after}{steps}"),
            Ending::Stops(error) => format!("an early end of the run {after}: {error}"),
        }
    }
}

impl Ending {
    /// Returns the name in output files.
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
    /// Simulates the motion after a small disturbance of this orbit, within the periods of the options. Returns `None`
    /// if the orbit is stable or no unknown can be disturbed.
    ///
    /// # Errors
    ///
    /// Returns [`SteadyError::Interrupted`] if the search is interrupted.
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
        // The run continues to the end of a drive period, so that step lengths are those of whole periods.
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

/// Periods simulated so far.
struct Way {
    /// The last states at period ends, each reset to the Poincaré section.
    states: Vec<State>,
    /// All step lengths, m.
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

    /// Returns the number of periods after which the states repeat, away from the orbit that was left.
    ///
    /// All states of two successive cycles must agree, because a decaying oscillation repeats single states occasionally.
    fn repeats(&self, map: &Map<'_>, (left, far): (&State, f64)) -> Option<usize> {
        let last = self.states.len() - 1;
        let apart = |k: usize, back: usize| -> Option<f64> {
            Some(map.difference(&self.states[k], &self.states[k.checked_sub(back)?])?.amax())
        };
        let has_left = |k: usize| map.difference(&self.states[k], left).is_none_or(|off| off.amax() > far);
        // The remaining difference of states is extrapolated geometrically from the last two differences.
        let to_come = |k: usize, back: usize| -> Option<f64> {
            let [now, before] = [apart(k, back)?, apart(k.checked_sub(back)?, back)?];
            Some(if now <= ROUNDING { 0.0 } else { now / (1.0 - now / before).max(0.0) })
        };
        let comes_back = |back: usize| {
            (0..back)
                .all(|k| last.checked_sub(k).and_then(|k| to_come(k, back)).is_some_and(|left| left <= NEAR))
        };
        let back = (1..=MOST).find(|back| comes_back(*back))?;
        // A decaying disturbance that alternates in sign nearly repeats after two periods before it repeats after one. The same holds for a
        // decaying oscillation and its period.
        let widest = |before: usize, part: usize| -> Option<f64> {
            let moments = (0..MOST).map(|k| apart(last.checked_sub(before + k)?, part));
            moments.collect::<Option<Vec<_>>>().map(|apart| apart.into_iter().fold(0.0, f64::max))
        };
        let is_falling = |part: usize| match (widest(0, part), widest(MOST, part)) {
            (Some(now), Some(before)) => now > ROUNDING && now < FALLING * before,
            // There are too few periods for a decision.
            _ => true,
        };
        let shorter = (1..back).any(|part| back % part == 0 && is_falling(part));
        (!shorter && (0..back).any(|k| has_left(last - k))).then_some(back)
    }
}

/// Classifies step lengths that do not repeat.
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
