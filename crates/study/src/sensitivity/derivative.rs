//! Derivative of a result with respect to a parameter, or the reason why the derivative does not exist.

use super::ladder::{self, Tried};
use super::sample::{Happened, Missing};
use super::stencil::{Estimate, Level, Wanted, bends_near_by, estimate};

/// A slope with its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// Change of the result per change of the parameter, SI.
    pub value: f64,
    /// Error of the slope, in the unit of the slope.
    pub error: f64,
    /// Largest change of the parameter from which the slope was computed, in the unit of the parameter.
    pub reach: f64,
}

/// Derivative of a result.
#[derive(Debug, Clone, PartialEq)]
pub enum Derivative {
    /// The result is smooth.
    Known(Slope),
    /// The two sides differ.
    Split {
        /// Slope below the value of the parameter.
        below: Result<Slope, Missing>,
        /// Slope above the value of the parameter.
        above: Result<Slope, Missing>,
        /// Kind of difference.
        why: Split,
    },
    /// There is no slope.
    Unknown(Missing),
}

/// Difference between slopes, results or events on both sides of a parameter value.
#[derive(Debug, Clone, PartialEq)]
pub enum Split {
    /// The slopes differ.
    Kink,
    /// The result jumps by these amounts, immediately below and immediately above the parameter value.
    Jump([f64; 2]),
    /// The events differ: descriptions of events with their numbers in the unchanged scenario and close to it.
    Events(Vec<String>),
    /// The result has a slope on one side only.
    OneSided,
}

/// Factor on the errors above which two numbers count as different.
const APART: f64 = 2.0;
/// Smallest relevant jump relative to the result; smaller jumps are within the accuracy of runs.
const LEAST_JUMP: f64 = 1e-9;

/// Runs on one side of a parameter value.
struct Half<'a> {
    /// Runs on this side, beginning with the largest distance: distance, value of the result, events.
    runs: Vec<(f64, f64, &'a Happened)>,
    /// Events close to the parameter value, if these events do not depend on the distance.
    settled: Option<&'a Happened>,
    /// Reason why the nearest run without the result lacks it.
    missing: Option<Missing>,
}

/// Data of a result near a parameter value.
pub(super) struct Near<'a> {
    /// Variants of the scenario with their results.
    pub(super) tried: &'a [Tried],
    /// Index of the result.
    pub(super) figure: usize,
    /// Value of the result and events of the unchanged scenario. `None` as events for results that are not from a run.
    pub(super) own: (f64, Option<&'a Happened>),
    /// Standard deviation of the numerical noise.
    pub(super) noise: f64,
}

impl Near<'_> {
    /// Returns the derivative.
    pub(super) fn derivative(&self) -> Derivative {
        let halves = [-1.0, 1.0].map(|sense| self.half(sense));
        let levels = halves.each_ref().map(|half| self.levels(half, &halves));
        let jumps = levels.each_ref().map(|levels| self.jump(levels));
        let place = [0, 1];
        let slopes = place.map(|side| {
            let is_whole = jumps[side].is_none()
                && halves[side].settled.is_none_or(|settled| Some(settled) == self.own.1);
            let own = is_whole.then_some(self.own.0);
            let found = estimate(&levels[side], own, Wanted::Slope, self.noise).map(Slope::from);
            found.ok_or_else(|| halves[side].missing.clone().unwrap_or(Missing::Rough))
        });
        let both = estimate(&pairs(&levels[0], &levels[1]), None, Wanted::Slope, self.noise);
        match (&slopes, both) {
            ([Err(one), Err(other)], _) => {
                let is_cut = *one == Missing::NotRun;
                Derivative::Unknown(if is_cut { one } else { other }.clone())
            }
            ([Err(_), _] | [_, Err(_)], _) => split(slopes, Split::OneSided),
            ([Ok(below), Ok(above)], both) => {
                let apart = (below.value - above.value).abs();
                let changes = self.changes(&halves);
                match both {
                    _ if jumps.iter().any(Option::is_some) => {
                        split(slopes, Split::Jump(jumps.map(Option::unwrap_or_default)))
                    }
                    _ if !changes.is_empty() => split(slopes, Split::Events(changes)),
                    Some(found) if apart <= APART * (below.error + above.error) => {
                        Derivative::Known(found.into())
                    }
                    _ => split(slopes, Split::Kink),
                }
            }
        }
    }

    /// Returns whether the result is still nonlinear near the closest variants.
    pub(super) fn bends_near_by(&self) -> bool {
        let halves = [-1.0, 1.0].map(|sense| self.half(sense));
        halves.iter().any(|half| {
            let is_whole = half.settled.is_none_or(|settled| Some(settled) == self.own.1);
            bends_near_by(&self.levels(half, &halves), is_whole.then_some(self.own.0), self.noise)
        })
    }

    fn half(&self, sense: f64) -> Half<'_> {
        let levels = ladder::levels(self.tried, sense);
        Half {
            runs: levels.iter().filter_map(|tried| tried.figure(self.figure).ok()).collect(),
            settled: self.own.1.and(ladder::settled(self.tried, sense)),
            missing: levels.iter().rev().find_map(|tried| tried.figure(self.figure).err()),
        }
    }

    /// Returns the runs on one side with the same events as close to the parameter value.
    ///
    /// If the events depend on the distance, all runs are returned. An example are small loops that close or not depending on rounding; the
    /// effect of such loops is visible in the result.
    fn levels(&self, half: &Half<'_>, halves: &[Half<'_>; 2]) -> Vec<Level> {
        let is_settled = halves.iter().all(|half| half.settled.is_some() || half.runs.is_empty());
        let wanted = half.settled.filter(|_| is_settled);
        let belongs = |happened: &Happened| wanted.is_none_or(|wanted| wanted == happened);
        let runs = half.runs.iter().filter(|(_, _, happened)| belongs(happened));
        runs.map(|(at, value, _)| vec![(*at, *value)]).collect()
    }

    /// Returns the jump of the result on one side of the parameter value, if there is a jump.
    fn jump(&self, levels: &[Level]) -> Option<f64> {
        let limit = estimate(levels, None, Wanted::Value, self.noise)?;
        let jump = limit.value - self.own.0;
        let least = (APART * limit.error).max(LEAST_JUMP * self.own.0.abs());
        (jump.abs() > least).then_some(jump)
    }

    /// Returns the differences between the events immediately below and immediately above the parameter value.
    fn changes(&self, halves: &[Half<'_>; 2]) -> Vec<String> {
        match (self.own.1, [halves[0].settled, halves[1].settled]) {
            (Some(own), [Some(below), Some(above)]) if below != above => {
                let told = [("below", below), ("above", above)].into_iter();
                told.flat_map(|(side, happened)| differences(side, own, happened)).collect()
            }
            _ => Vec::new(),
        }
    }
}

fn split([below, above]: [Result<Slope, Missing>; 2], why: Split) -> Derivative {
    Derivative::Split { below, above, why }
}

/// Returns pairs of runs at the same distance on both sides of the parameter value.
fn pairs(below: &[Level], above: &[Level]) -> Vec<Level> {
    let distance = |level: &Level| level.first().map_or(0.0, |(at, _)| at.abs());
    let opposite = |level: &Level| {
        let own = distance(level);
        // Distances differ slightly, because parameter values are rounded.
        below.iter().find(|other| (distance(other) / own - 1.0).abs() < 0.25)
    };
    above.iter().filter_map(|level| Some([opposite(level)?.as_slice(), level.as_slice()].concat())).collect()
}

/// Returns descriptions of the events whose number differs from that of the unchanged scenario.
fn differences(side: &str, own: &Happened, other: &Happened) -> Vec<String> {
    let mut all: Vec<_> = own.keys().chain(other.keys()).collect();
    all.sort();
    all.dedup();
    let count = |happened: &Happened, what| happened.get(what).copied().unwrap_or(0);
    let told = all.into_iter().filter(|what| count(own, what) != count(other, what));
    told.map(|what| {
        let (source, kind) = what;
        format!("{side}: {source} {kind} {} → {}", count(own, what), count(other, what))
    })
    .collect()
}

impl From<Estimate> for Slope {
    fn from(found: Estimate) -> Self {
        Self { value: found.value, error: found.error, reach: found.reach }
    }
}

impl Split {
    /// Returns the name in output files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Kink => "kink",
            Self::Jump(_) => "jump",
            Self::Events(_) => "events",
            Self::OneSided => "one_sided",
        }
    }
}

impl Derivative {
    /// Adds an error to all slopes.
    pub(super) fn less_sure(self, by: f64) -> Self {
        let wider = |slope: Slope| Slope { error: slope.error + by, ..slope };
        match self {
            Self::Known(slope) => Self::Known(wider(slope)),
            Self::Split { below, above, why } => {
                Self::Split { below: below.map(wider), above: above.map(wider), why }
            }
            Self::Unknown(missing) => Self::Unknown(missing),
        }
    }

    /// Returns the slopes with the names of their sides. The name is `None` if one derivative holds on both sides.
    #[must_use]
    pub fn sides(&self) -> Vec<(Option<&'static str>, Result<Slope, Missing>)> {
        match self {
            Self::Known(slope) => vec![(None, Ok(*slope))],
            Self::Split { below, above, .. } => {
                vec![(Some("below"), below.clone()), (Some("above"), above.clone())]
            }
            Self::Unknown(why) => vec![(None, Err(why.clone()))],
        }
    }

    /// Returns the largest absolute slope, or `None` without a slope.
    #[must_use]
    pub fn steepest(&self) -> Option<f64> {
        let slopes = self.sides().into_iter().filter_map(|(_, slope)| Some(slope.ok()?.value.abs()));
        slopes.reduce(f64::max)
    }

    /// Returns an explanation if the derivative does not exist or differs between both sides.
    #[must_use]
    pub fn words(&self) -> Option<String> {
        match self {
            Self::Known(_) => None,
            Self::Split { why, below, above } => Some(match why {
                Split::Kink => "the slopes on both sides differ".to_owned(),
                Split::Jump([below, above]) => {
                    format!("the result jumps by {below:.3e} below and by {above:.3e} above")
                }
                Split::Events(changes) => format!("the events differ; {}", changes.join(", ")),
                Split::OneSided => {
                    let missing = [("below", below), ("above", above)];
                    let mut missing = missing
                        .iter()
                        .filter_map(|(side, slope)| Some(format!("{side}: {}", slope.as_ref().err()?)));
                    format!("only one side; {}", missing.next().unwrap_or_default())
                }
            }),
            Self::Unknown(why) => Some(why.to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensitivity::sample::Sample;

    /// Derivative of a function with an event count, as from runs. `None` stands for an invalid scenario.
    fn derivative(f: impl Fn(f64) -> Option<(f64, usize)>) -> Derivative {
        let happened =
            |count: usize| -> Happened { [(("ball".to_owned(), "stick".to_owned()), count)].into() };
        let try_at = |share: f64, is_level: bool| {
            let sample = f(share)
                .map(|(value, count)| Sample { figures: vec![Some(value)], happened: happened(count) });
            Tried { share, offset: share, is_level, sample: sample.ok_or(Missing::Refused("no".to_owned())) }
        };
        let tried: Vec<Tried> =
            ladder::first().chain(ladder::finer()).map(|(share, is_level)| try_at(share, is_level)).collect();
        let (own, count) = f(0.0).unwrap();
        Near { tried: &tried, figure: 0, own: (own, Some(&happened(count))), noise: 1e-16 }.derivative()
    }

    #[test]
    fn what_is_smooth_has_one_slope() {
        let Derivative::Known(slope) = derivative(|x| Some(((2.0 * x).sin() + 1.0, 3))) else { panic!() };
        assert!((slope.value - 2.0).abs() <= slope.error && slope.error < 1e-9, "{slope:?}");
    }

    #[test]
    fn kinks_jumps_and_events_have_two() {
        let Derivative::Split { below: Ok(below), above: Ok(above), why } =
            derivative(|x| Some((x + x.abs(), 3)))
        else {
            panic!()
        };
        assert_eq!(why, Split::Kink);
        assert!(below.value.abs() <= below.error && (above.value - 2.0).abs() <= above.error);
        let step = |x: f64| Some((x.exp() + if x > 0.0 { 0.5 } else { 0.0 }, 3));
        let Derivative::Split { why: Split::Jump([below, above]), .. } = derivative(step) else { panic!() };
        assert!(below == 0.0 && (above - 0.5).abs() < 1e-9);
        // An event vanishes together with its force: the result remains smooth or has a corner.
        let grazing = |x: f64| Some((if x > 0.0 { x * x } else { 0.0 }, if x > 0.0 { 4 } else { 3 }));
        let found = derivative(grazing);
        let Derivative::Split { below: Ok(below), above: Ok(above), why: Split::Events(changes) } = found
        else {
            panic!()
        };
        assert!(below.value.abs() <= below.error && above.value.abs() <= above.error);
        assert_eq!(changes, ["above: ball stick 3 → 4"]);
    }

    /// Small loops that close or not depending on rounding: all runs count. Events that are equal on both sides and
    /// differ only in the scenario itself are a coincidence.
    #[test]
    fn events_without_a_side_leave_a_number() {
        let flickers = |x: f64| Some((x.exp(), 3 + usize::from((1e9 * x).sin() > 0.0)));
        let Derivative::Known(slope) = derivative(flickers) else { panic!() };
        assert!((slope.value - 1.0).abs() <= slope.error && slope.error < 1e-9, "{slope:?}");
        let coincides = |x: f64| Some((x.exp(), if x == 0.0 { 3 } else { 4 }));
        let Derivative::Known(slope) = derivative(coincides) else { panic!() };
        assert!((slope.value - 1.0).abs() <= slope.error && slope.error < 1e-9, "{slope:?}");
    }

    #[test]
    fn events_farther_away_are_not_looked_across() {
        let far =
            |x: f64| Some((x + if x > 1e-4 { 1e3 * (x - 1e-4) } else { 0.0 }, if x > 1e-4 { 4 } else { 3 }));
        let Derivative::Known(slope) = derivative(far) else { panic!() };
        assert!((slope.value - 1.0).abs() <= slope.error && slope.error < 1e-6, "{slope:?}");
    }

    #[test]
    fn where_one_side_is_refused_the_other_has_its_slope() {
        let found = derivative(|x| (x >= 0.0).then_some((x.exp(), 3)));
        assert!(
            found.words().is_some_and(|words| words == "only one side; below: refused: no"),
            "{:?}",
            found.words()
        );
        let Derivative::Split { below: Err(_), above: Ok(above), why: Split::OneSided } = found else {
            panic!()
        };
        assert!((above.value - 1.0).abs() <= above.error && above.error < 1e-6);
        let nothing = derivative(|x| (x == 0.0).then_some((1.0, 3)));
        assert_eq!(nothing, Derivative::Unknown(Missing::Refused("no".to_owned())));
    }
}
