//! The file's form: what may stand where, before anybody asks what it means. The doc comments become the schema.

mod body;
mod contact;
mod coupling;
mod lengths;
mod material;
mod output;
mod plain;
mod run;
mod value;
mod waveform;

pub(crate) use body::{BodyForm, BodyStartForm, FreedomForm};
pub(crate) use contact::{ContactForm, ContactStartForm, EngineForm, NormalForm, ProfileForm};
pub(crate) use coupling::{ActuatorForm, DirectionForm, GravityForm, LoadForm, SpringForm};
pub(crate) use lengths::Lengths;
pub(crate) use material::MaterialForm;
pub(crate) use output::{MemoryOutputForm, OutputForm};
pub(crate) use plain::{Count, Reserved, Two};
pub(crate) use run::{FiguresForm, LimitsForm, RunForm, RunStartForm, StepperForm};
pub(crate) use value::{Moving, Parts, WaveformRef};
pub(crate) use waveform::{HarmonicsForm, Periodic, Point, TableForm, WaveformForm};

use crate::PlotName;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A stick-slip drive: bodies, contacts, waveforms, and how to run them. A quantity is a number in SI or a string with
/// a unit, such as "5 um".
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "stickslip scenario, version 1")]
pub(crate) struct Form {
    /// Where an editor finds the schema; ignored.
    #[serde(rename = "$schema", default, skip_serializing)]
    #[expect(dead_code, reason = "the key is allowed, and of no meaning here")]
    pub(crate) schema: Option<String>,
    /// Version of this form.
    #[schemars(extend("const" = 1))]
    pub(crate) stickslip: Count,
    /// A line for people.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(crate) title: String,
    /// Materials by name.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    pub(crate) materials: Parts<MaterialForm>,
    /// Prescribed courses in time by name; `{"follows": name}` refers to them.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    pub(crate) waveforms: Parts<WaveformForm>,
    /// Bodies by name. `ground` is always there, fixed.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    pub(crate) bodies: Parts<BodyForm>,
    /// Frictional contacts by name.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    pub(crate) contacts: Parts<ContactForm>,
    /// Linear springs with dampers by name.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    pub(crate) springs: Parts<SpringForm>,
    /// Piezo stacks by name.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    pub(crate) actuators: Parts<ActuatorForm>,
    /// Forces on bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) loads: Vec<LoadForm>,
    /// Gravity; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) gravity: Option<GravityForm>,
    /// How long, from where and by which stepper.
    pub(crate) run: RunForm,
    /// Whose period and whose motion make steps and speeds.
    #[serde(default, skip_serializing_if = "FiguresForm::is_empty")]
    pub(crate) figures: FiguresForm,
    /// What is written down.
    #[serde(default, skip_serializing_if = "OutputForm::is_empty")]
    pub(crate) output: OutputForm,
    /// Pictures to draw.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) plots: Vec<PlotName>,
}
