//! Output of the inner state of contacts: springs, memory curves and stresses, and its times.

use super::contact::MAX_SPRINGS;
use super::{Builder, Figures, range, run};
use crate::PlotName;
use crate::fault::Fault;
use crate::form::{FieldsOutputForm, MemoryOutputForm};
use crate::guide::Help;
use crate::path::At;
use crate::quantity::Time;
use stickslip_drive::scene::{Contact, EngineChoice, Named};
use stickslip_drive::{Moments, Plan, Waveform};

/// Maximum number of springs written per contact.
const MAX_COUNT: u64 = 1_000_000;
/// Maximum number of radii. The friction work is integrated at each radius along every path.
const MAX_RADII: u64 = 10_000;
/// Number of samples of the spring states in a run without rows.
const STATES: f64 = 400.0;
/// Default number of samples of memory curves and stresses.
const CURVES: u32 = 6;
/// Number of periods after which most motions are steady, for runs with `until_steady`.
const SETTLING: u32 = 100;

/// Output of the states of springs over time.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringsOutput {
    /// Number of springs written for a contact with the curve engine.
    pub count: usize,
    /// Sample times.
    pub moments: Moments,
    /// Key path of the key or plot that requires this output.
    pub asked_by: String,
}

/// Output of memory curves.
#[derive(Debug, Clone, PartialEq)]
pub struct MemoryOutput {
    /// Sample times.
    pub moments: Moments,
    /// Key path of the key or plot that requires this output.
    pub asked_by: String,
}

/// Output of stresses and displacements under the contacts, and of the distribution of friction work.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldsOutput {
    /// Number of distances from the axis.
    pub radii: usize,
    /// Largest distance, m, if given.
    pub extent: Option<f64>,
    /// Sample times.
    pub moments: Moments,
    /// Key path of the key or plot that requires this output.
    pub asked_by: String,
}

impl Builder<'_> {
    /// Returns the output of springs, if its key or its plot is given.
    pub(super) fn springs_output(&self, plan: Plan) -> Result<Option<SpringsOutput>, Fault> {
        let root = At::ROOT;
        let (output, plots) = (root.key("output"), root.key("plots"));
        let at = output.key("springs");
        let form = &self.form.output.springs;
        let Some(asked) = self.asked(form.as_ref().map(|_| at), &plots, &[PlotName::State])? else {
            return Ok(None);
        };
        let form = form.clone().unwrap_or_default();
        let every = match form.every {
            Some(every) => self.interval(&at.key("every"), every, plan)?,
            None => plan.every.unwrap_or(plan.duration / STATES),
        };
        let count = range::count_between(&at.key("count"), form.count.0, 1, MAX_COUNT)?;
        let contacts = &self.scene.contacts;
        let curves = contacts.iter().filter(|contact| contact.part.engine == EngineChoice::Curve).count();
        let springs = self.springs + count * curves as u64;
        if springs > MAX_SPRINGS {
            let message = format!("expected at most {MAX_SPRINGS} springs in all contacts, got {springs}");
            let fault = asked.fault(message).against_all();
            return Err(fault.help("reduce \"count\", the number of springs per contact"));
        }
        Ok(Some(SpringsOutput {
            count: count as usize,
            moments: Moments::Every(every),
            asked_by: asked.path().to_string(),
        }))
    }

    /// Returns the output of memory curves, if its key or one of its plots is given.
    pub(super) fn memory_output(&self, plan: Plan, figures: Figures) -> Result<Option<MemoryOutput>, Fault> {
        let root = At::ROOT;
        let (output, plots) = (root.key("output"), root.key("plots"));
        let at = output.key("memory");
        let form = &self.form.output.memory;
        let Some(asked) =
            self.asked(form.as_ref().map(|_| at), &plots, &[PlotName::Memory, PlotName::Substitute])?
        else {
            return Ok(None);
        };
        let on_row = |engine: &EngineChoice| matches!(engine, EngineChoice::Springs { .. });
        if let Some(row) = self.scene.contacts.iter().find(|contact| on_row(&contact.part.engine)) {
            let message = format!("the contact \"{}\" is a row of springs: it has no memory curve", row.name);
            let help = "use output.springs for a row; only the engine \"curve\" has a memory curve";
            let fault = asked.fault(message).against(["contacts.*.engine"]);
            return Err(fault.help(help));
        }
        let MemoryOutputForm { every, at: times } = form.clone().unwrap_or_default();
        let moments = self.moments(&at, (every, times.as_deref()), plan, figures)?;
        Ok(Some(MemoryOutput { moments, asked_by: asked.path().to_string() }))
    }

    /// Returns the output of stresses and displacements, if its key or one of its plots is given.
    pub(super) fn fields_output(&self, plan: Plan, figures: Figures) -> Result<Option<FieldsOutput>, Fault> {
        let root = At::ROOT;
        let (output, plots) = (root.key("output"), root.key("plots"));
        let at = output.key("fields");
        let form = &self.form.output.fields;
        let names = [PlotName::Fields, PlotName::Friction];
        let Some(asked) = self.asked(form.as_ref().map(|_| at), &plots, &names)? else {
            return Ok(None);
        };
        let shapeless = |contact: &Named<Contact>| !contact.part.interface.profile().has_shape();
        if self.scene.contacts.iter().all(shapeless) {
            let fault = asked.fault("no contact has a shape in three dimensions");
            let fault = fault.against(["contacts.*.profile"]);
            return Err(
                fault.help("lists of springs and normal laws have forces but no stresses; springs.csv has the force of each spring")
            );
        }
        let FieldsOutputForm { radii, extent, every, at: times } = form.clone().unwrap_or_default();
        let radii = range::count_between(&at.key("radii"), radii.0, 2, MAX_RADII)? as usize;
        let extent = extent.map(|extent| range::above_zero(&at.key("extent"), extent)).transpose()?;
        let moments = self.moments(&at, (every, times.as_deref()), plan, figures)?;
        Ok(Some(FieldsOutput { radii, extent, moments, asked_by: asked.path().to_string() }))
    }

    /// Returns the sample times: an interval, a list, or by default samples of the last period.
    fn moments(
        &self,
        at: &At<'_>,
        (every, times): (Option<Time>, Option<&[Time]>),
        plan: Plan,
        figures: Figures,
    ) -> Result<Moments, Fault> {
        Ok(match (every, times) {
            (Some(every), None) => Moments::Every(self.interval(&at.key("every"), every, plan)?),
            (None, Some(times)) => Moments::At(self.list(&at.key("at"), times, plan)?),
            (None, None) => self.last_period(plan, figures),
            (Some(_), Some(_)) => {
                let fault = at.key("at").fault("the interval of the times is already given").on_key();
                return Err(fault.help("keep one of them"));
            }
        })
    }

    /// Returns the key, or the first plot, that requires an output of contacts. Fails if there are no contacts.
    fn asked<'a>(
        &self,
        key: Option<At<'a>>,
        plots: &'a At<'a>,
        wanted_by: &[PlotName],
    ) -> Result<Option<At<'a>>, Fault> {
        let place = self.form.plots.iter().position(|plot| wanted_by.contains(&plot.name()));
        let asked = key.or(place.map(|place| plots.index(place)));
        match asked {
            Some(at) if self.scene.contacts.is_empty() => {
                Err(at.fault("the scenario has no contact").against(["contacts"]))
            }
            asked => Ok(asked),
        }
    }

    /// Returns equidistant times in the last period, its end included. The period is that of the waveform in `figures`, otherwise the
    /// longest period. If no period is shorter than the run, the times cover the run. With `until_steady`, samples of the first hundred
    /// periods are added, because each of them may be the last.
    fn last_period(&self, plan: Plan, figures: Figures) -> Moments {
        let waveforms = &self.scene.waveforms;
        let slowest = waveforms.iter().filter_map(|w| w.part.period()).reduce(f64::max);
        let named = figures.waveform.and_then(|w| waveforms.get(w)).and_then(|w| Waveform::period(&w.part));
        let span = named.or(slowest).filter(|period| *period < plan.duration).unwrap_or(plan.duration);
        let share = |k: u32| f64::from(k) / f64::from(CURVES);
        let first = if plan.until_steady.is_some() { CURVES * SETTLING } else { 0 };
        let first = (0..=first).skip(1).map(|k| share(k) * span).take_while(|t| *t <= plan.duration - span);
        let last = (0..CURVES).rev().map(|k| plan.duration - share(k) * span);
        Moments::At(first.chain(last).collect())
    }

    /// Returns an interval above 0 and at most the duration of the run.
    fn interval(&self, at: &At<'_>, every: Time, plan: Plan) -> Result<f64, Fault> {
        let every = range::above_zero(at, every)?;
        if every <= plan.duration { Ok(every) } else { Err(self.beyond(at, plan)) }
    }

    /// Returns times in ascending order within the run.
    fn list(&self, at: &At<'_>, times: &[Time], plan: Plan) -> Result<Vec<f64>, Fault> {
        if times.is_empty() {
            return Err(at.fault("expected at least one time").ask(Help::Shape));
        }
        let mut moments = Vec::with_capacity(times.len());
        for (i, time) in times.iter().enumerate() {
            let (before, at) = (at, at.index(i));
            let time = range::at_least_zero(&at, *time)?;
            if time > plan.duration {
                return Err(self.beyond(&at, plan));
            }
            if moments.last().is_some_and(|before| *before >= time) {
                let fault = at.expected("a time after the time before it");
                return Err(fault.against_path(before.path()));
            }
            moments.push(time);
        }
        Ok(moments)
    }

    fn beyond(&self, at: &At<'_>, plan: Plan) -> Fault {
        let fault = at.expected(format_args!("a time up to the duration of the run, {} s", plan.duration));
        fault.against(run::duration(self.form).iter().copied())
    }
}
