//! Search space of an optimisation: conversion of a point of the unit cube to parameters of the scenario and a waveform.

use super::shape::{self, Drawing};
use crate::number::text;
use stickslip_run::Job;
use stickslip_scenario::{Goal, Parameter, Shaped};

/// Parameters and waveform of an optimisation. The coordinates are the parameters of `over`, then the period of the waveform if the study
/// varies the period, then the shape of the waveform.
#[derive(Debug, Clone)]
pub(crate) struct Space {
    over: Vec<(Parameter, [f64; 2])>,
    shaped: Option<Shaped>,
    /// Periods of named waveforms that are not optimised. A robust optimum includes variations of these periods by ± 1 %.
    periods: Vec<Parameter>,
}

impl Space {
    pub(crate) fn new(goal: &Goal, job: &Job) -> Self {
        let shaped = goal.shaped.clone();
        let mut periods = job.scenario.periods();
        periods.retain(|period| {
            let is_inside = |shaped: &Shaped| period.path.starts_with(&format!("{}.", shaped.path));
            period.value.is_some() && !shaped.as_ref().is_some_and(is_inside)
        });
        Self { over: goal.over.clone(), shaped, periods }
    }

    /// Returns whether the model has a period that can be varied.
    pub(crate) fn has_period(&self) -> bool {
        self.shaped.is_some() || !self.periods.is_empty()
    }

    pub(crate) fn shaped(&self) -> Option<&Shaped> {
        self.shaped.as_ref()
    }

    /// Returns the names, units and ranges of all coordinates except those of the waveform shape.
    pub(crate) fn numbers(&self) -> Vec<(String, &'static str, [f64; 2])> {
        let over = self.over.iter().map(|(number, range)| (number.path.clone(), number.unit, *range));
        let period = self.shaped.iter().filter(|shaped| shaped.period[0] < shaped.period[1]);
        over.chain(period.map(|shaped| (format!("{}.period", shaped.path), "s", shaped.period))).collect()
    }

    /// Returns the names of all coordinates.
    pub(crate) fn names(&self) -> Vec<String> {
        let numbers = self.numbers().into_iter().map(|(name, ..)| name);
        numbers.chain(self.shaped.iter().flat_map(shape::names)).collect()
    }

    /// Returns the value of a coordinate: a number in SI units, or the fraction `share` itself for a coordinate of the waveform shape.
    pub(crate) fn value(&self, coordinate: usize, share: f64) -> f64 {
        self.numbers().get(coordinate).map_or(share, |(.., range)| between(*range, share))
    }

    /// Returns the waveform at a point and its period, s.
    pub(crate) fn drawing(&self, point: &[f64]) -> Option<(Drawing, f64)> {
        let shaped = self.shaped.as_ref()?;
        let numbers = self.numbers().len();
        let period = match numbers > self.over.len() {
            true => self.value(numbers - 1, point[numbers - 1]),
            false => shaped.period[0],
        };
        Some((Drawing::new(shaped, period, &point[numbers..]), period))
    }

    /// Returns the overrides of the scenario for a point, with all periods multiplied by `stretch`.
    pub(crate) fn overrides(&self, point: &[f64], stretch: f64) -> Vec<(String, String)> {
        let stretched = |number: &Parameter, value: f64| match self.is_period(number) {
            true if number.unit == "s" => value * stretch,
            true => value / stretch,
            false => value,
        };
        let over = self.over.iter().enumerate().map(|(i, (number, range))| {
            (number.path.clone(), text(stretched(number, between(*range, point[i]))))
        });
        let searched = |period: &&Parameter| self.over.iter().all(|(number, _)| number.path != period.path);
        let rest =
            self.periods.iter().filter(|_| stretch != 1.0).filter(searched).map(|period| {
                (period.path.clone(), text(stretched(period, period.value.unwrap_or(f64::NAN))))
            });
        let waveform = self.shaped.iter().zip(self.drawing(point)).map(|(shaped, (drawing, period))| {
            (shaped.path.clone(), drawing.form(period * stretch).to_string())
        });
        over.chain(rest).chain(waveform).collect()
    }

    fn is_period(&self, number: &Parameter) -> bool {
        self.periods.iter().any(|period| period.path == number.path)
    }

    /// Returns the point nearest to the unchanged scenario. Parameters without a value are set to the middle of their range.
    pub(crate) fn present(&self, job: &Job) -> Vec<f64> {
        let share = |[low, high]: [f64; 2], value: f64| ((value - low) / (high - low)).clamp(0.0, 1.0);
        let over =
            self.over.iter().map(|(number, range)| number.value.map_or(0.5, |value| share(*range, value)));
        let mut point: Vec<f64> = over.collect();
        let Some(shaped) = &self.shaped else { return point };
        let waveform = job.scenario.scene.waveforms.get(shaped.waveform).map(|named| &named.part);
        if self.numbers().len() > self.over.len() {
            let period = waveform.and_then(|waveform| waveform.period());
            point.push(period.map_or(0.5, |period| share(shaped.period, period)));
        }
        let middle = || vec![0.5; shape::dimensions(shaped)];
        point.extend(waveform.and_then(|waveform| shape::nearest(shaped, waveform)).unwrap_or_else(middle));
        point
    }
}

/// Returns the value at a fraction of a range, without rounding error at both ends.
fn between([low, high]: [f64; 2], share: f64) -> f64 {
    if share >= 1.0 { high } else { low + (high - low) * share }
}
