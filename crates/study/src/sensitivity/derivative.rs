//! The derivative of a figure with respect to a quantity, or why there is none.

use super::ladder::{self, Tried};
use super::sample::{Happened, Missing};
use super::stencil::{Estimate, Level, Wanted, bends_near_by, estimate};

/// A slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// Change of the figure per change of the quantity, SI.
    pub value: f64,
    /// How far it may be off, of the same unit.
    pub error: f64,
    /// How far from its value the quantity was in the farthest run that counts, in its own unit.
    pub reach: f64,
}

/// The derivative of a figure.
#[derive(Debug, Clone, PartialEq)]
pub enum Derivative {
    /// The figure changes smoothly.
    Known(Slope),
    /// What is below and above is not the same.
    Split {
        /// Slope as the quantity gets smaller.
        below: Result<Slope, Missing>,
        /// Slope as it gets larger.
        above: Result<Slope, Missing>,
        /// What is not the same.
        why: Split,
    },
    /// Nothing is known.
    Unknown(Missing),
}

/// What is not the same on both sides.
#[derive(Debug, Clone, PartialEq)]
pub enum Split {
    /// The slopes.
    Kink,
    /// The figure itself: by how much it differs from that of the scenario close below and close above.
    Jump([f64; 2]),
    /// Events: which, and how often, in the scenario and close to it.
    Events(Vec<String>),
    /// One side alone has slopes.
    OneSided,
}

/// Errors by which two numbers differ that are not the same.
const APART: f64 = 2.0;
/// Jumps that matter, as shares of the figure: runs know no more of it.
const LEAST_JUMP: f64 = 1e-9;

/// One side of a quantity's value.
struct Half<'a> {
    /// What is known there, the outermost first: distance, figure, events.
    runs: Vec<(f64, f64, &'a Happened)>,
    /// What happens close to the value, where that is the same however near.
    settled: Option<&'a Happened>,
    /// What is wrong with the nearest that has no value.
    missing: Option<Missing>,
}

/// What is known about a figure near a quantity's value.
pub(super) struct Near<'a> {
    /// Variants.
    pub(super) tried: &'a [Tried],
    /// Place of the figure.
    pub(super) figure: usize,
    /// The figure in the scenario itself, and what happens there; none where it is of no run.
    pub(super) own: (f64, Option<&'a Happened>),
    /// Standard deviation of the figure's noise.
    pub(super) noise: f64,
}

impl Near<'_> {
    /// The derivative.
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

    /// Whether the figure still bends where the nearest variants are.
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

    /// The runs of a side that belong together: those where the same happens as close to the value. Where that is never the same, as
    /// loops too small for the tolerance close or do not, all do: what such events matter is seen in the figure.
    fn levels(&self, half: &Half<'_>, halves: &[Half<'_>; 2]) -> Vec<Level> {
        let is_settled = halves.iter().all(|half| half.settled.is_some() || half.runs.is_empty());
        let wanted = half.settled.filter(|_| is_settled);
        let belongs = |happened: &Happened| wanted.is_none_or(|wanted| wanted == happened);
        let runs = half.runs.iter().filter(|(_, _, happened)| belongs(happened));
        runs.map(|(at, value, _)| vec![(*at, *value)]).collect()
    }

    /// By how much the figure jumps on a side, where it does.
    fn jump(&self, levels: &[Level]) -> Option<f64> {
        let limit = estimate(levels, None, Wanted::Value, self.noise)?;
        let jump = limit.value - self.own.0;
        let least = (APART * limit.error).max(LEAST_JUMP * self.own.0.abs());
        (jump.abs() > least).then_some(jump)
    }

    /// What happens more or less often close below than close above.
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

/// Levels at the same distance on both sides.
fn pairs(below: &[Level], above: &[Level]) -> Vec<Level> {
    let distance = |level: &Level| level.first().map_or(0.0, |(at, _)| at.abs());
    let opposite = |level: &Level| {
        let own = distance(level);
        // Values of a quantity are rounded.
        below.iter().find(|other| (distance(other) / own - 1.0).abs() < 0.25)
    };
    above.iter().filter_map(|level| Some([opposite(level)?.as_slice(), level.as_slice()].concat())).collect()
}

/// What happens more or less often on one side than in the scenario.
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
    /// Its word in files.
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
    /// With more that its slopes may be off by.
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

    /// The slopes that it has, each with its side; the same on both has none.
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

    /// The largest magnitude of a slope; none without any.
    #[must_use]
    pub fn steepest(&self) -> Option<f64> {
        let slopes = self.sides().into_iter().filter_map(|(_, slope)| Some(slope.ok()?.value.abs()));
        slopes.reduce(f64::max)
    }

    /// What is to be said beside the numbers.
    #[must_use]
    pub fn words(&self) -> Option<String> {
        match self {
            Self::Known(_) => None,
            Self::Split { why, below, above } => Some(match why {
                Split::Kink => "the slopes on both sides differ".to_owned(),
                Split::Jump([below, above]) => {
                    format!("the figure jumps: by {below:.3e} below, by {above:.3e} above")
                }
                Split::Events(changes) => format!("other events; {}", changes.join(", ")),
                Split::OneSided => {
                    let missing = [("below", below), ("above", above)];
                    let mut missing = missing
                        .iter()
                        .filter_map(|(side, slope)| Some(format!("{side}: {}", slope.as_ref().err()?)));
                    format!("one side alone; {}", missing.next().unwrap_or_default())
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

    /// Values of a function with a count of what happens, as if they were of runs; none where it is refused.
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
        // An event vanishes where its force does: the figure goes on smoothly, or with another slope.
        let grazing = |x: f64| Some((if x > 0.0 { x * x } else { 0.0 }, if x > 0.0 { 4 } else { 3 }));
        let found = derivative(grazing);
        let Derivative::Split { below: Ok(below), above: Ok(above), why: Split::Events(changes) } = found
        else {
            panic!()
        };
        assert!(below.value.abs() <= below.error && above.value.abs() <= above.error);
        assert_eq!(changes, ["above: ball stick 3 → 4"]);
    }

    /// Loops that are too small for the tolerance close or do not, however near: all runs count. What happens alike on both sides, and only
    /// in the scenario itself not, is a coincidence.
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
            found.words().is_some_and(|words| words == "one side alone; below: refused: no"),
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
