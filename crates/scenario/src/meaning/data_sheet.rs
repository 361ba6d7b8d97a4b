//! Data of a stack from the actuator's keys and its data sheet.

use super::range;
use crate::fault::Fault;
use crate::form::{ActuatorForm, DataSheetForm};
use crate::path::{At, Step};
use crate::quantity::{Dimension, Quantity};
use stickslip_piezo::data_sheet::{Contradiction, DataSheet, Own, SheetError, Stack};

/// Returns stiffness, stroke per volt, capacitance and mass of a stack. Redundant numbers must agree.
pub(super) fn stack(at: &At<'_>, form: &ActuatorForm) -> Result<Stack, Fault> {
    let sheet = form.data_sheet.as_ref().map(|sheet| data_sheet(&at.key("data_sheet"), sheet)).transpose()?;
    let own = Own {
        stiffness: positive(at, "stiffness", form.stiffness)?,
        stroke_per_volt: positive(at, "stroke_per_volt", form.stroke_per_volt)?,
        capacitance: positive(at, "capacitance", form.capacitance)?,
        mass: positive(at, "mass", form.mass)?,
    };
    sheet.unwrap_or_default().stack(&own).map_err(|error| match error {
        SheetError::NoStiffness => {
            let fault = at.missing("stiffness").against_path(at.key("data_sheet").path());
            fault.help("such as \"20 N/um\", or a \"data_sheet\" with \"blocking_force\" and \"stroke\"")
        }
        SheetError::Contradiction(Contradiction { key, against, message }) => {
            let path = |keys: &[&str]| {
                let mut path = at.path();
                path.0.extend(keys.iter().map(|key| Step::Key((*key).to_owned())));
                path
            };
            let fault = Fault::new(path(key), message);
            let fault = against.into_iter().fold(fault, |fault, key| fault.against_path(path(key)));
            fault.help("redundant numbers may differ by 1 %; correct one of them, or leave it out")
        }
    })
}

fn data_sheet(at: &At<'_>, form: &DataSheetForm) -> Result<DataSheet, Fault> {
    Ok(DataSheet {
        stroke: positive(at, "stroke", form.stroke)?,
        voltage: positive(at, "voltage", form.voltage)?,
        stiffness: positive(at, "stiffness", form.stiffness)?,
        blocking_force: positive(at, "blocking_force", form.blocking_force)?,
        capacitance: positive(at, "capacitance", form.capacitance)?,
        free_resonance: positive(at, "free_resonance", form.free_resonance)?,
        held_resonance: positive(at, "held_resonance", form.held_resonance)?,
    })
}

/// Returns an optional quantity, checked to be above zero.
fn positive<D: Dimension>(
    at: &At<'_>,
    key: &'static str,
    value: Option<Quantity<D>>,
) -> Result<Option<f64>, Fault> {
    value.map(|value| range::above_zero(&at.key(key), value)).transpose()
}
