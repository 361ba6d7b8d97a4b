//! From the form to a scene and a plan, and from what these are refused for back to the form.

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

/// Whose period and whose motion make steps and speeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Figures {
    /// Place in [`Scene::waveforms`]; none where there are none, or several and none is named.
    pub waveform: Option<usize>,
    /// Place in [`Scene::bodies`]; none where there are none, or several and none is named.
    pub body: Option<usize>,
}

/// What a form means.
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
    /// Most memory, B.
    pub(crate) memory_limit: Option<f64>,
    pub(crate) plots: Vec<PlotName>,
    pub(crate) own_plots: Vec<OwnPlot>,
    pub(crate) stacks: Vec<Piezo>,
}

/// A scene under construction.
struct Builder<'a> {
    form: &'a Form,
    scene: Scene,
    /// What the scene's waveforms do not tell themselves.
    courses: Vec<Course>,
    /// Terms of all sums of sines so far.
    terms: usize,
    /// Springs of all rows so far.
    springs: u64,
    /// What is known of each actuator.
    stacks: Vec<Piezo>,
}

/// What is known of a waveform from its form alone.
struct Course {
    /// Dimension of its values, where its numbers tell.
    kind: Option<Kind>,
    /// Delay, s.
    delay: f64,
    /// Stroke per volt of the stack whose voltage it is, m/V: its values are strokes.
    gain: Option<f64>,
}

/// Makes of a meaning what a run starts from, as far as that can be done at once: what is refused there is known before it.
pub(crate) fn start(meaning: &Meaning) -> Result<(), Fault> {
    let Meaning { scene, plan, .. } = meaning;
    let refused = |error: SceneError| refused::fault(scene, *plan, &error);
    let model = Model::new(scene).map_err(refused)?;
    if scene.start == Start::Given {
        // An equilibrium is searched for, and found or not by all that there is.
        model.start(plan).map_err(refused)?;
    }
    let names = meaning.channels.as_deref().unwrap_or_default();
    let channels = model.channels();
    channels::places(names, &channels)?;
    plots::check(&meaning.own_plots, &channels)
}

/// Gives a form its meaning; the files of its tables are already points.
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
