//! Variables that another program sees: outputs, inputs and parameters with names, units and numbers.

use crate::held::quantity_of;
use crate::job::Job;
use crate::seal::hash;
use stickslip_drive::inputs::{Input, Takes, inputs};
use stickslip_quantity::names;
use stickslip_scenario::Parameter;

/// A variable of the interface.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Name without unit: `slider.x`, `drive`, `contacts.ball.friction`. Parts that are not identifiers are in single quotes.
    pub name: String,
    /// Number by which the variable is read and set.
    pub reference: u32,
    /// SI unit; empty for plain numbers.
    pub unit: &'static str,
    /// Description.
    pub text: String,
    /// Role of the variable.
    pub role: Role,
    /// Whether the value is continuous in time; a continuous input changes linearly over a step.
    pub is_continuous: bool,
}

/// Role of a variable, with the place of its value.
#[derive(Debug, Clone, PartialEq)]
pub enum Role {
    /// Output: index of the channel, and whether it is a contact state (0 open, 1 stick, 2 partial slip, 3 gross slip).
    Output(usize, bool),
    /// Input: index among [`inputs`], with its initial and allowed values.
    Input(usize, f64, Takes),
    /// Parameter: index in [`Job::interface`], and its value in the scenario.
    Parameter(usize, f64),
}

/// References of inputs and parameters begin here; those of outputs are indices of channels.
const INPUTS: u32 = 1_000_000;
const PARAMETERS: u32 = 2_000_000;

impl Variable {
    /// Returns whether the values are integers: contact states, headings and numbers of steps.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        matches!(self.role, Role::Output(_, true) | Role::Input(_, _, Takes::Sign | Takes::Count))
    }
}

/// Returns the token by which the binary of an FMU recognises its scenario, from the text of the scenario.
#[must_use]
pub fn token(text: &str) -> String {
    let hash = hash(text);
    format!("{{{}-{}-{}-{}-{}}}", &hash[..8], &hash[8..12], &hash[12..16], &hash[16..20], &hash[20..32])
}

/// Returns the variables of a job: outputs, inputs, parameters. The time has the reference 0 and is not among them.
pub fn variables(job: &Job) -> Vec<Variable> {
    let channels = job.model.channels();
    let outputs = job.interface.outputs.iter().filter(|place| **place > 0).map(|&place| {
        let channel = channels[place].clone();
        let is_state = channel.is_state;
        let quantity = quantity_of(channel);
        Variable {
            name: structured(names::bare(&quantity.name)),
            reference: place as u32,
            unit: quantity.unit,
            text: quantity.text.to_owned(),
            role: Role::Output(place, is_state),
            is_continuous: !is_state,
        }
    });
    let is_chosen = |input: &Input| input.place().is_some_and(|place| job.interface.inputs.contains(&place));
    let chosen = inputs(&job.scenario.scene).into_iter().enumerate().filter(|(_, input)| is_chosen(input));
    let inputs = chosen.map(|(index, input)| Variable {
        text: format!("allowed: {} {}", input.takes, input.unit).trim_end().to_owned(),
        name: structured(&input.name),
        reference: INPUTS + index as u32,
        unit: input.unit,
        role: Role::Input(index, input.initial, input.takes),
        is_continuous: input.is_led(),
    });
    let parameter = |(index, parameter): (usize, &Parameter)| Variable {
        name: structured(&parameter.path),
        reference: PARAMETERS + index as u32,
        unit: parameter.unit,
        text: "number of the scenario".to_owned(),
        role: Role::Parameter(index, parameter.value.unwrap_or_default()),
        is_continuous: false,
    };
    outputs.chain(inputs).chain(job.interface.parameters.iter().enumerate().map(parameter)).collect()
}

/// Returns a name whose parts, separated by points, are identifiers or in single quotes.
fn structured(name: &str) -> String {
    let is_identifier = |part: &str| {
        let inner = part.split('[').next().unwrap_or(part);
        let rest = &part[inner.len()..];
        let starts = inner.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        let is_index = rest.is_empty()
            || rest.ends_with(']') && rest[1..rest.len() - 1].bytes().all(|digit| digit.is_ascii_digit());
        starts && is_index && inner.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    };
    let quoted = |part: &str| {
        if is_identifier(part) {
            part.to_owned()
        } else {
            format!("'{}'", part.replace('\\', "\\\\").replace('\'', "\\'"))
        }
    };
    name.split('.').map(quoted).collect::<Vec<_>>().join(".")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_structured() {
        for (name, wanted) in [
            ("slider.x", "slider.x"),
            ("800 nm.fx", "'800 nm'.fx"),
            ("loads[0].x", "loads[0].x"),
            ("it's.u", r"'it\'s'.u"),
            ("1a[2]", "'1a[2]'"),
            ("contacts.left pad.friction", "contacts.'left pad'.friction"),
        ] {
            assert_eq!(structured(name), wanted);
        }
    }
}
