//! What may differ by how much.

use super::error::CompareError;
use super::results::{Exactness, Results};
use super::scales::Scales;
use super::terms::Terms;
use stickslip_quantity::names::{owner, unit};
use stickslip_scenario::{quantity, suggestion};

/// Relative tolerance between runs by the same stepper at the same tolerance or step. They do the same arithmetic, so
/// that builds of all optimisation levels agree to the last bit; what is left is room for another rounding of a sum.
const SAME_RUN: f64 = 1e-10;
/// Largest time tolerance between such runs, s.
const SAME_MOMENT: f64 = 1e-10;
/// Global over local error: runs of the examples at tolerances from 1e-6 to 1e-10 lie within this multiple of the
/// tolerance of the same runs at 1e-12.
const GLOBAL: f64 = 100.0;
/// Relative tolerance where one of two different steppers has a fixed step and promises none.
const FIXED_STEP: f64 = 1e-4;
/// The default absolute tolerance over the relative one times the scene's natural scale: below one per cent of its
/// scale a channel is at rest, and what moves in it is rounding.
const AT_REST: f64 = 1e-2;

/// The tolerances of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Allowance {
    /// Of a channel's largest magnitude.
    pub relative: f64,
    /// Of events, s.
    pub time: f64,
    /// Whether both runs did the same arithmetic.
    pub is_same_run: bool,
    /// What the runs themselves promise.
    pub promised: f64,
    /// Given for one channel or figure, in its unit.
    absolute: Vec<(String, f64)>,
    /// Names of channels, bodies, contacts and waveforms that are left out.
    ignored: Vec<String>,
    scales: Scales,
}

impl Allowance {
    /// What the terms ask for; where they are silent the steppers of both runs decide. `span` is the time
    /// compared, s.
    pub(super) fn new(a: &Results, b: &Results, span: f64, terms: &Terms) -> Self {
        let is_same_run = a.stepper == b.stepper;
        let (promised, moment) = match (a.stepper.exactness, b.stepper.exactness) {
            (Exactness::Tolerance(a), Exactness::Tolerance(b)) => (GLOBAL * a.max(b), a.max(b) * span),
            (Exactness::Step(step), Exactness::Tolerance(_))
            | (Exactness::Tolerance(_), Exactness::Step(step)) => (FIXED_STEP, step),
            (Exactness::Step(a), Exactness::Step(b)) => (FIXED_STEP, a.max(b)),
        };
        let same_moment = SAME_MOMENT.min(SAME_RUN * span);
        let (relative, time) = if is_same_run {
            (SAME_RUN, same_moment)
        } else {
            (promised.max(SAME_RUN), moment.max(same_moment))
        };
        Self {
            relative: terms.tolerance.unwrap_or(relative),
            time: terms.time_tolerance.unwrap_or(time),
            is_same_run,
            promised,
            absolute: Vec::new(),
            ignored: Vec::new(),
            scales: Scales::new(&a.summary, &b.summary),
        }
    }

    /// Takes what is allowed for single channels and what is ignored, whose names must be among `known`.
    pub(super) fn refine(&mut self, terms: &Terms, known: &[String]) -> Result<(), CompareError> {
        for (name, text) in &terms.absolute {
            if !known.contains(name) {
                let help = suggestion(name, known.iter().map(String::as_str));
                return Err(unknown("absolute", "channel or figure", name, help));
            }
            let refuse = |message| CompareError::Absolute { name: name.clone(), text: text.clone(), message };
            let value = quantity(text, unit(name)).map_err(refuse)?;
            if value < 0.0 {
                return Err(refuse("expected a value of 0 or more".to_owned()));
            }
            self.absolute.push((name.clone(), value));
        }
        for name in &terms.ignore {
            let mut owners: Vec<&str> = known.iter().map(|known| owner(known)).collect();
            if !known.contains(name) && !owners.contains(&name.as_str()) {
                owners.sort_unstable();
                owners.dedup();
                let help = suggestion(name, owners);
                return Err(unknown("ignore", "channel, body, contact or waveform", name, help));
            }
            self.ignored.push(name.clone());
        }
        Ok(())
    }

    /// Whether a channel or figure is left out: by its own name or with its owner.
    pub(super) fn ignores(&self, name: &str) -> bool {
        self.ignored.iter().any(|ignored| ignored == name || ignored == owner(name))
    }

    /// How far two values may lie apart: max(absolute, relative × nominal), in the unit of the channel or figure;
    /// `largest` is its largest magnitude in either run.
    pub(super) fn of(&self, name: &str, largest: f64) -> f64 {
        let given = self.absolute.iter().rev().find(|(given, _)| given == name).map(|(_, value)| *value);
        let absolute = given.unwrap_or_else(|| AT_REST * self.relative * self.scales.natural(name));
        absolute.max(self.relative * self.scales.nominal(name, largest))
    }
}

fn unknown(term: &'static str, what: &'static str, name: &str, help: Option<String>) -> CompareError {
    CompareError::UnknownName { term, what, name: name.to_owned(), help }
}
