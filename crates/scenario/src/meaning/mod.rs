//! Converts the keys of a scenario to model and plan, and errors of model and plan to errors of the file.

mod actuator;
mod body;
mod ceramic;
pub(crate) mod channels;
mod contact;
mod coupling;
mod data_sheet;
mod driver;
mod generator;
mod input;
mod measured;
mod motion;
mod names;
mod output;
mod pattern;
pub(crate) mod plots;
mod point;
mod profile;
mod range;
pub(crate) mod refused;
mod run;
mod shapes;
pub(crate) mod shown;
mod table;
pub(crate) mod warnings;
mod waveform;
mod written;

pub use actuator::Piezo;
pub use ceramic::{Ceramic, Hysteresis};
pub use output::{FieldsOutput, MemoryOutput, SpringsOutput};
pub use plots::OwnPlot;
pub use written::{Written, WrittenEvents};

use crate::PlotName;
use crate::fault::Fault;
use crate::form::{Form, PlotForm};
use crate::units::Kind;
use stickslip_drive::scene::Start;
use stickslip_drive::{Model, Plan, Scene, SceneError};

/// Waveform and body that define the periods and steps of the results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Figures {
    /// Index in [`Scene::waveforms`] of the named waveform, or of the only waveform; `None` if there is neither.
    pub waveform: Option<usize>,
    /// Index in [`Scene::bodies`] of the named body, or of the only candidate; `None` if there is neither.
    pub body: Option<usize>,
}

/// Model, plan and output of a scenario.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Meaning {
    pub(crate) scene: Scene,
    pub(crate) plan: Plan,
    pub(crate) figures: Figures,
    pub(crate) channels: Option<Vec<String>>,
    pub(crate) springs: Option<SpringsOutput>,
    pub(crate) memory: Option<MemoryOutput>,
    pub(crate) fields: Option<FieldsOutput>,
    pub(crate) written: Written,
    /// Memory limit, B.
    pub(crate) memory_limit: Option<f64>,
    pub(crate) plots: Vec<PlotName>,
    pub(crate) own_plots: Vec<OwnPlot>,
    pub(crate) stacks: Vec<Piezo>,
}

/// Builder of the model.
struct Builder<'a> {
    form: &'a Form,
    scene: Scene,
    /// Data of each waveform in addition to those in the model.
    courses: Vec<Course>,
    /// Number of terms of all sums of sines so far.
    terms: usize,
    /// Number of springs of all rows so far.
    springs: u64,
    /// Data of each actuator.
    stacks: Vec<Piezo>,
}

/// Data of a waveform from its keys.
struct Course {
    /// Dimension of the values, if units give it.
    kind: Option<Kind>,
    /// Delay, s.
    delay: f64,
    /// Stroke per volt of the stack that this waveform of voltages drives, m/V. The model contains the waveform as strokes.
    gain: Option<f64>,
}

/// Builds the model and its initial state, and checks channels. An equilibrium is not computed.
pub(crate) fn start(meaning: &Meaning) -> Result<(), Fault> {
    let Meaning { scene, plan, .. } = meaning;
    let refused = |error: SceneError| refused::fault(scene, *plan, &error);
    let model = Model::new(scene).map_err(refused)?;
    if scene.start == Start::Given {
        // An equilibrium is computed only after all other checks.
        model.start(plan).map_err(refused)?;
    }
    let names = meaning.channels.as_deref().unwrap_or_default();
    let channels = model.channels();
    channels::places(["output", "channels"], names, &channels)?;
    plots::check(&meaning.own_plots, &channels)
}

/// Converts the keys of a scenario, whose tables already contain points.
pub(crate) fn of(form: &Form) -> Result<Meaning, Fault> {
    let mut builder = Builder {
        form,
        scene: Scene::default(),
        courses: Vec::new(),
        terms: 0,
        springs: 0,
        stacks: Vec::new(),
    };
    names::check(form)?;
    builder.stacks()?;
    builder.waveforms()?;
    builder.materials()?;
    builder.bodies()?;
    builder.contacts()?;
    builder.springs()?;
    builder.actuators()?;
    builder.loads()?;
    builder.stops()?;
    builder.chains()?;
    builder.gravity()?;
    builder.actions()?;
    let figures = builder.figures()?;
    let plan = builder.plan(figures)?;
    builder.start()?;
    builder.plots()?;
    let (springs, memory) = (builder.springs_output(plan)?, builder.memory_output(plan, figures)?);
    let fields = builder.fields_output(plan, figures)?;
    let (written, memory_limit) = (builder.written(plan, figures)?, builder.memory_limit()?);
    Ok(Meaning {
        plan,
        figures,
        channels: form.output.channels.clone(),
        springs,
        memory,
        fields,
        written,
        memory_limit,
        plots: form.plots.iter().map(PlotForm::name).collect(),
        own_plots: builder.own_plots(plan)?,
        scene: builder.scene,
        stacks: builder.stacks,
    })
}
