//! Allowed differences of a comparison.

use super::error::CompareError;
use super::results::{Exactness, Results};
use super::scales::Scales;
use super::terms::Terms;
use stickslip_quantity::names::{owner, unit};
use stickslip_scenario::{quantity, suggestion};

/// Relative tolerance between runs with the same integrator and the same tolerance or step.
///
/// Runs with the same integrator and tolerance perform the same arithmetic. `SAME_RUN` only allows for a different rounding of sums.
const SAME_RUN: f64 = 1e-10;
/// Maximum time tolerance between runs with the same integrator and the same tolerance or step, s.
const SAME_MOMENT: f64 = 1e-10;
/// Ratio of global to local error. Example scenarios at tolerances of 1e-6 to 1e-10 differ from runs at 1e-12 by less than this ratio.
const GLOBAL: f64 = 100.0;
/// Relative tolerance if the integrators differ and at least one integrator has a fixed step.
const FIXED_STEP: f64 = 1e-4;
/// Default factor of the absolute tolerance: absolute tolerance = factor × relative tolerance × natural scale of the model.
///
/// Changes of a channel below one per cent of the natural scale count as rest.
const AT_REST: f64 = 1e-2;

/// Tolerances of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Allowance {
    /// Tolerance relative to the largest magnitude of a channel.
    pub relative: f64,
    /// Tolerance of event times, s.
    pub time: f64,
    /// Whether both runs used the same integrator with the same tolerance or step.
    pub is_same_run: bool,
    /// Relative accuracy that the integrators of the runs provide.
    pub promised: f64,
    /// Absolute tolerances of single channels and summary values, in their units.
    absolute: Vec<(String, f64)>,
    /// Names of ignored channels, bodies, contacts and waveforms.
    ignored: Vec<String>,
    scales: Scales,
}

impl Allowance {
    /// Returns the tolerances that `terms` gives. Otherwise, the integrators of both runs determine the tolerances.
    ///
    /// `span` is the compared time, s.
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

    /// Adds the absolute tolerances and the ignored names of `terms`.
    ///
    /// # Errors
    /// Fails if a name is not among `known`, or a tolerance is not a quantity of 0 or more.
    pub(super) fn refine(&mut self, terms: &Terms, known: &[String]) -> Result<(), CompareError> {
        for (name, text) in &terms.absolute {
            if !known.contains(name) {
                let help = suggestion(name, known.iter().map(String::as_str));
                return Err(unknown("absolute", "channel or summary value", name, help));
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

    /// Returns whether a channel or summary value is ignored, by its own name or by the name of its body, contact or waveform.
    pub(super) fn ignores(&self, name: &str) -> bool {
        self.ignored.iter().any(|ignored| ignored == name || ignored == owner(name))
    }

    /// Returns the allowed difference of two values: max(absolute, relative × nominal), in the unit of the channel or summary value.
    ///
    /// `largest` is the largest magnitude of the value in both runs.
    pub(super) fn of(&self, name: &str, largest: f64) -> f64 {
        let given = self.absolute.iter().rev().find(|(given, _)| given == name).map(|(_, value)| *value);
        let absolute = given.unwrap_or_else(|| AT_REST * self.relative * self.scales.natural(name));
        absolute.max(self.relative * self.scales.nominal(name, largest))
    }
}

fn unknown(term: &'static str, what: &'static str, name: &str, help: Option<String>) -> CompareError {
    CompareError::UnknownName { term, what, name: name.to_owned(), help }
}
