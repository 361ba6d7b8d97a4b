//! From the form to a scene and a plan, and from what these are refused for back to the form.

mod body;
mod contact;
mod coupling;
mod generator;
mod input;
mod measured;
mod motion;
mod names;
mod output;
mod point;
mod profile;
mod range;
pub(crate) mod refused;
mod run;
pub(crate) mod warnings;
mod waveform;
mod written;

pub use output::{FieldsOutput, MemoryOutput, SpringsOutput};
pub use written::{Written, WrittenEvents};

use crate::PlotName;
use crate::fault::Fault;
use crate::form::Form;
use crate::units::Kind;
use stickslip_drive::{Plan, Scene};

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
}

/// What is known of a waveform from its form alone.
struct Course {
    /// Dimension of its values, where its numbers tell.
    kind: Option<Kind>,
    /// Delay, s.
    delay: f64,
}

/// Gives a form its meaning; the files of its tables are already points.
pub(crate) fn of(form: &Form) -> Result<Meaning, Fault> {
    let mut builder = Builder { form, scene: Scene::default(), courses: Vec::new(), terms: 0, springs: 0 };
    names::check(form)?;
    builder.waveforms()?;
    builder.materials()?;
    builder.bodies()?;
    builder.contacts()?;
    builder.springs()?;
    builder.actuators()?;
    builder.loads()?;
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
        plots: form.plots.clone(),
        scene: builder.scene,
    })
}
