//! Cell of the matrix: a scenario of a family with a stepper.

use super::family::{self, Family};
use crate::soak::trial::Trial;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use stickslip_scenario::Scenario;

/// Limits of steps and events of a cell, which are equal on all machines. The limit of events is lower, because an undamped oscillation
/// fills the contact memory and makes events expensive.
const STEPS: u64 = 1_000_000;
const EVENTS: u64 = 60_000;
/// Limits if the number of periods is varied.
const MANY: u64 = 100_000_000;
/// Number of rows of a run.
const ROWS: f64 = 40.0;
/// Minimum number of fixed steps per drive period, or per run without a drive. All corners of the drive lie on steps; otherwise the order
/// of convergence would be lower.
const LEAST: f64 = 1000.0;
/// Minimum number of fixed steps per period of the fastest oscillation, reached by halving.
const FINE: f64 = 60.0;

/// Stepper of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Column {
    /// Event stepper at a tolerance.
    Event(f64),
    /// Second method: fixed steps or `dopri5`, whose error is estimated by refinement.
    Plain(&'static str),
}

/// All steppers in the order of the plot, upwards; their positions are [`Column::place`].
pub(super) const COLUMNS: [Column; 10] = [
    Column::Plain("verlet"),
    Column::Plain("rk4"),
    Column::Plain("dopri5"),
    Column::Event(1e-2),
    Column::Event(1e-4),
    Column::Event(1e-6),
    Column::Event(1e-8),
    Column::Event(1e-10),
    Column::Event(1e-12),
    Column::Event(1e-14),
];

impl Column {
    /// Returns the position in the plot.
    pub(super) fn place(self) -> f64 {
        match self {
            Self::Event(tolerance) => -math::log10(tolerance).round(),
            Self::Plain("verlet") => -4.0,
            Self::Plain("rk4") => -2.0,
            Self::Plain(_) => 0.0,
        }
    }

    pub(super) fn name(self) -> String {
        match self {
            Self::Event(tolerance) => format!("{tolerance:e}"),
            Self::Plain(name) => name.to_owned(),
        }
    }
}

/// Scenario with its stepper.
pub(super) struct Cell<'a> {
    pub(super) family: &'a Family,
    pub(super) value: f64,
    pub(super) column: Column,
    /// Index of the scenario.
    pub(super) row: usize,
}

/// All cells.
pub(super) struct Cells(Vec<Family>);

impl Cells {
    pub(super) fn new() -> Self {
        Self(family::all())
    }

    pub(super) fn families(&self) -> &[Family] {
        &self.0
    }

    pub(super) fn count(&self) -> usize {
        COLUMNS.len() * self.0.iter().map(|family| family.values.len()).sum::<usize>()
    }

    /// Returns the cell of a number.
    pub(super) fn get(&self, number: u64) -> Option<Cell<'_>> {
        let number = usize::try_from(number).ok()?;
        let (row, column) = (number / COLUMNS.len(), COLUMNS[number % COLUMNS.len()]);
        let mut left = row;
        for family in &self.0 {
            if let Some(value) = family.values.get(left) {
                return Some(Cell { family, value: *value, column, row });
            }
            left -= family.values.len();
        }
        None
    }
}

impl Cell<'_> {
    /// Returns the scenario with the event stepper at a tolerance.
    pub(super) fn by_events(&self, tolerance: f64) -> Value {
        let mut scene = (self.family.scene)(self.value);
        let duration = scene["run"]["duration"].as_f64().unwrap_or(1.0);
        scene["output"] = json!({ "every": duration / ROWS });
        let [steps, events] = if self.family.name == "periods" { [MANY; 2] } else { [STEPS, EVENTS] };
        scene["run"]["limits"] =
            json!({ "steps": steps, "events": events, "wall": crate::soak::trial::PATIENCE });
        scene["run"]["stepper"] = json!({ "event": { "tolerance": tolerance } });
        scene["title"] = json!(format!("{} {:e}, {}", self.family.name, self.value, self.column.name()));
        scene
    }

    /// Returns the scenario as the text of a file.
    pub(super) fn text(&self) -> String {
        let scene = match self.column {
            Column::Event(tolerance) => self.by_events(tolerance),
            Column::Plain(name) => {
                let mut scene = self.by_events(1e-8);
                scene["run"]["stepper"] = match name {
                    "dopri5" => json!({ "dopri5": { "tolerance": 1e-6 } }),
                    name => json!({ name: { "step": self.step(&scene) } }),
                };
                scene
            }
        };
        format!("{scene:#}\n")
    }

    /// Returns the step of fixed-step methods, s.
    fn step(&self, scene: &Value) -> f64 {
        let Ok(scenario) = Scenario::from_str_alone(&scene.to_string(), "hostile") else { return 1.0 };
        let drive = scenario.scene.waveforms.first().and_then(|drive| drive.part.period());
        let mut step = drive.unwrap_or(scenario.plan.duration).min(scenario.plan.duration) / LEAST;
        let Ok(trial) = Trial::new(scenario.scene, scenario.plan) else { return step };
        let fastest = (0..trial.scene.contacts.len()).filter_map(|c| trial.model.contact_frequency(c));
        let fastest = fastest.fold(0.0, f64::max);
        while step * fastest > TAU / FINE {
            step *= 0.5;
        }
        step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_is_a_cell_of_its_own() {
        let cells = Cells::new();
        assert!(cells.count() >= 2000, "{}", cells.count());
        let texts: std::collections::HashSet<String> = (0..cells.count() as u64)
            .step_by(7)
            .filter_map(|number| cells.get(number))
            .map(|cell| format!("{} {:e} {}", cell.family.name, cell.value, cell.column.name()))
            .collect();
        assert_eq!(texts.len(), cells.count().div_ceil(7));
        assert!(cells.get(cells.count() as u64).is_none());
    }
}
