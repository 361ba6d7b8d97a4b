//! Types that mirror the keys of a scenario file. Their doc comments become the descriptions of the schema.

mod actuator;
mod body;
mod bordered;
mod ceramic;
mod contact;
mod coupling;
mod generator;
mod input;
mod interface;
mod lengths;
mod material;
mod measured;
mod output;
mod periodic;
mod plain;
mod plot;
mod point;
mod profile;
mod run;
mod shapes;
mod table;
mod value;
mod waveform;
mod written;

pub(crate) use actuator::{ActuatorForm, ControlForm, DataSheetForm, DriverForm};
pub(crate) use body::{BodyForm, BodyStartForm, FreedomForm};
pub(crate) use bordered::{
    PowersForm, RoundedFlatForm, TippedParaboloidForm, TruncatedConeForm, TruncatedParaboloidForm,
};
pub(crate) use ceramic::{BoucWenForm, CreepForm, HysteresisForm, LoopForm, PlaysForm};
pub(crate) use contact::{
    ContactForm, ContactStartForm, DampingForm, EngineForm, FrictionForm, GrowthForm, NormalForm, StaticForm,
};
pub(crate) use coupling::{DirectionForm, GravityForm, LoadForm, SpringForm, StopForm};
pub(crate) use generator::{CycleForm, GeneratorForm, HeadingForm};
pub(crate) use input::{Bounds, InputForm, InterpolationForm};
pub(crate) use interface::InterfaceForm;
pub(crate) use lengths::Lengths;
pub(crate) use material::MaterialForm;
pub(crate) use measured::{
    GapPoint, GapTableForm, LawPoint, LevelForm, NormalLawForm, RoughForm, SelfAffineForm,
};
pub(crate) use output::{FieldsOutputForm, MemoryOutputForm, OutputForm};
pub(crate) use periodic::{BurstForm, Periodic, SectionForm};
pub(crate) use plain::{Count, Two};
pub(crate) use plot::{OwnPlotForm, PlotForm};
pub(crate) use point::{PointForm, Points};
pub(crate) use profile::{FoundationForm, ProfileForm};
pub(crate) use run::{FiguresForm, LimitsForm, RunForm, RunStartForm, StepperForm};
pub(crate) use shapes::{
    ChirpForm, HarmonicsForm, ParabolaForm, SCurveForm, SawtoothForm, StepForm, TrapezoidForm,
    TwoHarmonicsForm,
};
pub(crate) use table::{JoinForm, Point, RecipeForm, TableForm};
pub(crate) use value::{Moving, Parts, WaveformRef};
pub(crate) use waveform::WaveformForm;
pub(crate) use written::{EventsOutputForm, KindForm, StatesForm, StepsOutputForm, WindowForm};

use crate::schema::{no_default, no_ground, no_trace_column};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Scenario of a stick-slip drive: bodies, contacts, waveforms and the settings of a run. A quantity is a number in SI or a string with a
/// unit, such as "5 um".
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "stickslip scenario, version 1")]
pub(crate) struct Form {
    /// Address of the JSON Schema for editors; nothing by default. The program ignores it.
    #[serde(rename = "$schema", default, skip_serializing)]
    #[schemars(example = &"../schema/scenario-1.json")]
    #[expect(dead_code, reason = "the key is allowed but ignored")]
    pub(crate) schema: Option<String>,
    /// Version of the scenario format.
    #[schemars(extend("const" = 1), example = 1)]
    pub(crate) stickslip: Count,
    /// Title of the scenario for its readers; empty by default.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    #[schemars(example = &"Sawtooth drive on three ruby balls")]
    pub(crate) title: String,
    /// Materials by name; none by default. Common materials need no entry: `stickslip materials` lists them with their sources.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    #[schemars(example = json!({ "ruby": { "youngs_modulus": "400 GPa", "poisson_ratio": 0.27 } }))]
    pub(crate) materials: Parts<MaterialForm>,
    /// Waveforms, prescribed functions of time, by name; none by default. `{"follows": name}` refers to one of them.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    #[schemars(example = json!({ "drive": { "sawtooth": { "stroke": "200 nm", "period": "10 ms", "flyback": "10 us" } } }))]
    pub(crate) waveforms: Parts<WaveformForm>,
    /// Bodies by name; none by default. The fixed body `ground` always exists.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    #[schemars(example = json!({ "slider": { "mass": "10 g", "x": "free" } }), transform = no_ground)]
    pub(crate) bodies: Parts<BodyForm>,
    /// Frictional contacts by name; none by default.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    #[schemars(
        example = json!({ "ball": {
            "between": ["foot", "slider"], "materials": ["ruby", "hardened steel"],
            "profile": { "paraboloid": { "radius": "0.5 mm" } }, "friction": 0.2, "normal": { "force": "0.3 N" }
        } }),
        transform = no_trace_column
    )]
    pub(crate) contacts: Parts<ContactForm>,
    /// Linear springs with dampers by name; none by default.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    #[schemars(example = json!({ "return": { "between": ["ground", "slider"], "stiffness": "2 N/um" } }))]
    pub(crate) springs: Parts<SpringForm>,
    /// Piezo stacks by name; none by default.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    #[schemars(example = json!({ "stack": { "between": ["ground", "foot"], "stiffness": "20 N/um", "stroke": { "follows": "drive" } } }))]
    pub(crate) actuators: Parts<ActuatorForm>,
    /// Forces and moments on bodies; none by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(example = json!([{ "on": "slider", "x": "-0.02 N" }]))]
    pub(crate) loads: Vec<LoadForm>,
    /// End stops of bodies by name; none by default.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    #[schemars(example = json!({ "travel": { "on": "slider", "x": ["-1 mm", "1 mm"], "stiffness": "100 N/um" } }))]
    pub(crate) stops: Parts<StopForm>,
    /// Gravity; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "acceleration": "9.81 m/s²", "incline": "90 deg" }))]
    pub(crate) gravity: Option<GravityForm>,
    /// Run of the simulation: its duration, initial state, stepper and limits.
    #[schemars(example = json!({ "duration": "100 ms" }))]
    pub(crate) run: RunForm,
    /// Waveform and body from which the steps and speeds of the drive are computed; by default the only waveform and the only free body of
    /// the scenario.
    #[serde(default, skip_serializing_if = "FiguresForm::is_empty")]
    #[schemars(example = json!({ "waveform": "drive", "body": "slider" }))]
    pub(crate) figures: FiguresForm,
    /// Output tables of a run. By default `trace.csv` has all channels and 400 to 20 000 rows. The shortest period of a waveform has 80 to
    /// 200 rows.
    #[serde(default)]
    #[schemars(example = json!({ "every": "10 us" }), transform = no_default)]
    pub(crate) output: OutputForm,
    /// Plots to draw: names of predefined plots, or channels over another channel. By default `loop` is drawn if there are contacts, and
    /// `trajectory` is drawn if a body is free along x.
    #[serde(default)]
    #[schemars(example = json!(["loop", "trajectory"]), example = json!([{ "x": "ball.u_m", "y": "ball.fx_N", "from": "90 ms" }]), transform = no_default)]
    pub(crate) plots: Vec<PlotForm>,
    /// Inputs, outputs and parameters for a program that runs the scenario as a part of its own model, such as the host of an FMU. By
    /// default these are all inputs and all columns.
    #[serde(default, skip_serializing_if = "InterfaceForm::is_empty")]
    #[schemars(example = json!({ "outputs": ["slider.x_m"], "parameters": ["contacts.ball.friction"] }))]
    pub(crate) interface: InterfaceForm,
}
