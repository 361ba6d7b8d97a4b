//! State of the drive at a parameter value, and its image after a period.

use super::error::Trouble;
use crate::steady::endless::Endless;
use crate::steady::map::{Gradient, Map, near};
use crate::steady::newton::Fixed;
use crate::steady::{Options, fixed_point, moment, newton};
use nalgebra::DVector;
use serde::{Deserialize, Serialize};
use std::cell::Cell;
use std::path::PathBuf;
use std::rc::Rc;
use stickslip_drive::State;
use stickslip_drive::section::Section;
use stickslip_run::Job;
use stickslip_scenario::{Scenario, ScenarioError};

/// Target for the change of the defect in finite differences with respect to the parameter, as a multiple of the tolerance, and limit of
/// this target in natural scales.
///
/// Runs at neighbouring parameter values take the same time steps and have nearly the same error. At larger distances, ringing of the drive
/// makes the Poincaré map oscillate.
const SEEN: f64 = 1e5;
const MOST_SEEN: f64 = 1e-4;
/// Number of attempts to match the target within a factor of ten.
const TRIES: u32 = 6;
/// Smallest and largest distance of parameter values, as a fraction of the range.
const LEAST: f64 = 1e-10;
const MOST: f64 = 1e-3;
/// Maximum number of changes in the structure of the slip memories during a search.
const FORMS: u32 = 4;

/// Drive whose varied parameter has a certain value.
pub(super) struct Variant {
    pub(super) value: f64,
    pub(super) job: Job,
    pub(super) drive: Endless,
}

/// State of a variant of the drive, and the image of this state after a period.
#[derive(Clone)]
pub(super) struct Place {
    pub(super) variant: Rc<Variant>,
    pub(super) fixed: Fixed,
}

/// Derivatives of the Poincaré map.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Slopes {
    pub(super) gradient: Gradient,
    /// Derivative of the defect, in natural scales, with respect to the parameter as a fraction of its range.
    pub(super) by_value: DVector<f64>,
}

/// Builds and simulates drives at different parameter values.
pub(super) struct Bench<'a> {
    pub(super) job: &'a Job,
    pub(super) path: &'a str,
    /// Length of the parameter range.
    pub(super) span: f64,
    pub(super) options: Options<'a>,
    /// Distance of finite differences in the parameter, as a fraction of its range.
    pub(super) apart: Cell<f64>,
}

impl<'a> Bench<'a> {
    pub(super) fn new((job, path): (&'a Job, &'a str), span: f64, options: Options<'a>) -> Self {
        Self { job, path, span, options, apart: Cell::new(1e-6) }
    }

    /// Returns the drive at a parameter value.
    pub(super) fn variant(&self, value: f64) -> Result<Rc<Variant>, Trouble> {
        if !value.is_finite() {
            return Err(Trouble::Diverged);
        }
        let text = format!("{value:e}");
        // The resolved scenario contains default values and the points of tables.
        let made =
            Scenario::from_str_with(&self.job.resolved, &self.job.name, "", &[(self.path, text.as_str())]);
        let made = made.and_then(|mut scenario| {
            (scenario.springs, scenario.memory, scenario.fields) = (None, None, None);
            scenario.plan.every = None;
            Job::new(scenario, self.job.name.clone(), PathBuf::new())
        });
        let job = made.map_err(|error: ScenarioError| Trouble::Refused(error.to_string()))?;
        let drive = Endless::of(&job)?;
        Ok(Rc::new(Variant { value, job, drive }))
    }

    pub(super) fn map<'v>(&'v self, variant: &'v Variant) -> Map<'v> {
        Map::new(&variant.drive.model, variant.drive.period, &variant.job, &self.options)
    }

    /// Returns the Poincaré map at a state. Fails if the numbers of unknowns and of components of the defect differ.
    pub(super) fn map_at<'v>(&'v self, place: &'v Place) -> Result<Map<'v>, Trouble> {
        let section = Section::new(&place.variant.drive.model, place.fixed.state.clone());
        if section.unknowns().len() != place.fixed.defect.len() {
            return Err(Trouble::OtherForm);
        }
        let mut map = self.map(&place.variant);
        map.set(section);
        Ok(map)
    }

    /// Returns a state with its image after a period.
    pub(super) fn place(&self, variant: &Rc<Variant>, state: State) -> Result<Place, Trouble> {
        let mut map = self.map(variant);
        let section = Section::new(&variant.drive.model, state);
        let state = section.base().clone();
        map.set(section);
        let image = map.image(&state, 1.0)?;
        let defect = map.difference(&image.state, &state).ok_or(Trouble::OtherForm)?;
        let fixed = Fixed { state, image, defect, defects: Vec::new() };
        Ok(Place { variant: Rc::clone(variant), fixed })
    }

    /// Finds the periodic orbit from the initial state of a drive.
    pub(super) fn found(&self, variant: &Rc<Variant>, options: &Options<'_>) -> Result<Place, Trouble> {
        let (model, job) = (&variant.drive.model, &variant.job);
        let mut map = Map::new(model, variant.drive.period, job, options);
        let mut fixed = fixed_point(&mut map, &variant.drive)?;
        for _ in 0..FORMS {
            let section = Section::new(model, fixed.state.clone());
            if section.unknowns().len() == fixed.defect.len() {
                return Ok(Place { variant: Rc::clone(variant), fixed });
            }
            // The slip memory of a contact appeared or vanished during the search; continue with the new unknowns.
            let section = Section::new(model, moment::again(&mut map, fixed.state)?.state);
            let from = section.base().clone();
            map.set(section);
            fixed = newton::fixed_point(&mut map, &from)?;
        }
        Err(Trouble::OtherForm)
    }

    /// Returns an orbit with its Poincaré section moved to the instant at which the slip memory is smallest.
    pub(super) fn moment(&self, place: &Place) -> Result<Place, Trouble> {
        let mut map = self.map_at(place)?;
        let state = moment::again(&mut map, place.fixed.state.clone())?.state;
        drop(map);
        self.place(&place.variant, state)
    }

    /// Transfers a state from one variant to another and changes its unknowns by `by`, in natural scales.
    pub(super) fn elsewhere(
        &self,
        (state, of): (&State, &Variant),
        to: &Variant,
        by: &DVector<f64>,
    ) -> Result<State, Trouble> {
        // The new state is at the same phase of the period.
        let t = state.time() * (to.drive.period / of.drive.period);
        let section = Section::new(&of.drive.model, state.clone());
        if section.unknowns().len() != by.len() {
            return Err(Trouble::OtherForm);
        }
        let by = DVector::from_vec(section.scales()).component_mul(by);
        section.elsewhere(state, by.as_slice(), &to.drive.model, t).ok_or(Trouble::OtherForm)
    }

    /// Returns the derivatives of the Poincaré map at a point.
    pub(super) fn slopes(&self, place: &Place) -> Result<Slopes, Trouble> {
        let Fixed { state, image, .. } = &place.fixed;
        let apart = near(self.options.tolerance);
        let gradient = self.map_at(place)?.near_gradient((state, image), apart)?;
        Ok(Slopes { gradient, by_value: self.by_value(place)? })
    }

    /// Returns the derivative of the defect with respect to the parameter by central differences. Differences are one-sided if one side has
    /// other events or another structure of the slip memory.
    pub(super) fn by_value(&self, place: &Place) -> Result<DVector<f64>, Trouble> {
        let mut why = Trouble::OtherForm;
        let seen = (SEEN * self.options.tolerance).min(MOST_SEEN);
        for _ in 0..TRIES {
            let by = self.apart.get();
            let [ahead, behind] = [by, -by].map(|by| self.beside(place, by));
            let here = &place.fixed;
            let sides =
                here.image.sides([&ahead, &behind].map(|side| side.as_ref().ok().map(|side| &side.image)));
            let (change, apart) = match (ahead, behind) {
                (Ok(ahead), Ok(behind)) if sides == [true; 2] => (ahead.defect - behind.defect, 2.0 * by),
                (Ok(ahead), Ok(_)) if sides[0] => (ahead.defect - &here.defect, by),
                (Ok(ahead), Err(_)) => (ahead.defect - &here.defect, by),
                (_, Ok(behind)) => (&here.defect - behind.defect, by),
                (Err(trouble), Err(_)) if trouble.is_final() => return Err(trouble),
                (Err(trouble), Err(_)) => {
                    why = trouble;
                    self.apart.set(0.1 * by);
                    continue;
                }
            };
            let share = change.amax() / seen;
            let better = if share > 0.0 { (by / share).clamp(LEAST, MOST) } else { by };
            self.apart.set(better);
            if (0.1..=10.0).contains(&(better / by)) {
                return Ok(change / apart);
            }
        }
        Err(why)
    }

    /// Returns a state transferred to another parameter value, with its image after a period.
    fn beside(&self, place: &Place, by: f64) -> Result<Fixed, Trouble> {
        let variant = self.variant(place.variant.value + by * self.span)?;
        let still = DVector::zeros(place.fixed.defect.len());
        let state = self.elsewhere((&place.fixed.state, &place.variant), &variant, &still)?;
        let fixed = self.place(&variant, state)?.fixed;
        if fixed.defect.len() == still.len() { Ok(fixed) } else { Err(Trouble::OtherForm) }
    }
}
