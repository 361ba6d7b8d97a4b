//! Inputs, outputs and parameters that another program sees.

use crate::error::ScenarioError;
use crate::meaning;
use crate::parameter::Parameter;
use crate::scenario::Scenario;
use crate::suggest;
use std::collections::HashSet;
use stickslip_drive::{Channel, Shape};

/// What a program sees that runs the scenario as a part of its own model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Interface {
    /// Indices of the waveforms of kind `input` or `generator`.
    pub inputs: Vec<usize>,
    /// Indices of the channels.
    pub outputs: Vec<usize>,
    /// Numbers that may be set before the start.
    pub parameters: Vec<Parameter>,
}

impl Scenario {
    /// Returns the interface, with places in the model and its channels.
    ///
    /// # Errors
    /// A name is unknown, is named twice or is not that of an input; a path is not that of a continuous number with a value.
    pub fn interface(&self, channels: &[Channel]) -> Result<Interface, ScenarioError> {
        let form = &self.form.interface;
        let inputs = match &form.inputs {
            None => (0..self.scene.waveforms.len()).filter(|place| self.is_input(*place)).collect(),
            Some(names) => self.chosen_inputs(names)?,
        };
        let outputs = match &form.outputs {
            None => (0..channels.len()).collect(),
            Some(names) => meaning::channels::places(["interface", "outputs"], names, channels)
                .map_err(|fault| self.fault(fault))?,
        };
        let mut parameters: Vec<Parameter> = Vec::new();
        for (i, path) in form.parameters.iter().enumerate() {
            let known = parameters.iter().any(|known| known.path == *path);
            parameters.push(self.settable((i, path), known)?);
        }
        Ok(Interface { inputs, outputs, parameters })
    }

    fn is_input(&self, place: usize) -> bool {
        let shape = self.scene.waveforms.get(place).map(|waveform| waveform.part.shape());
        matches!(shape, Some(Shape::Input { .. } | Shape::Generator(_)))
    }

    fn chosen_inputs(&self, names: &[String]) -> Result<Vec<usize>, ScenarioError> {
        let waveforms = &self.scene.waveforms;
        let mut taken = HashSet::new();
        let place = |(i, name): (usize, &String)| {
            let refused =
                |message: String, help| self.locate(&format!("interface.inputs[{i}]"), message, help);
            let Some(place) = waveforms.iter().position(|waveform| waveform.name == *name) else {
                let known = waveforms.iter().map(|waveform| waveform.name.as_str());
                return Err(refused(format!("there is no waveform {name:?}"), suggest::help(name, known)));
            };
            if !self.is_input(place) {
                let message = format!("waveform {name:?} is neither of kind `input` nor `generator`");
                return Err(refused(message, Some("only these are set by another program".to_owned())));
            }
            match taken.insert(place) {
                true => Ok(place),
                false => Err(refused("this waveform is already in the list".to_owned(), None)),
            }
        };
        names.iter().enumerate().map(place).collect()
    }

    fn settable(&self, (i, path): (usize, &str), is_known: bool) -> Result<Parameter, ScenarioError> {
        let refused =
            |message: &str, help| Err(self.locate(&format!("interface.parameters[{i}]"), message, help));
        if is_known {
            return refused("this path is already in the list", None);
        }
        let parameter = match self.number(path) {
            Ok(parameter) => parameter,
            Err(error) => {
                let report = error.into_first();
                return refused(&format!("{path:?}: {}", report.message), report.help);
            }
        };
        match parameter.value {
            _ if parameter.is_whole => {
                refused(&format!("{path:?}: this is a count; expected a continuous number"), None)
            }
            None => refused(
                &format!("{path:?}: the scenario gives no value"),
                Some("write the value, which is then that of the parameter by default".to_owned()),
            ),
            Some(_) => Ok(parameter),
        }
    }
}
