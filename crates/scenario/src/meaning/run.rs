//! Evaluated waveform and body, and the plan of the run.

use super::{Builder, Figures, names, range, refused};
use crate::fault::Fault;
use crate::form::{Form, LimitsForm, StepperForm};
use crate::path::At;
use stickslip_drive::scene::Freedom;
use stickslip_drive::{Accuracy, Limits, Plan, Shape, Stepper, UntilSteady};

/// Range of tolerances of the time integrators.
const TOLERANCE: (f64, f64) = (1e-13, 1e-2);
/// Range of the accuracy of frames.
const FRAME_ACCURACY: (f64, f64) = (1e-9, 1e-1);
/// Range of the relative change of the step length for `until_steady`.
const CHANGE: (f64, f64) = (1e-12, 0.1);

/// Paths on which the choice of the evaluated waveform and body depends.
const MOVING: [&str; 8] = [
    "waveforms",
    "figures",
    "bodies.*.x",
    "bodies.*.z",
    "actuators.*.stroke",
    "actuators.*.voltage",
    "contacts.*.normal",
    "loads",
];
/// Returns the paths of the keys that determine the duration of a run.
pub(super) fn duration(form: &Form) -> &'static [&'static str] {
    let all = &["run.duration", "run.cycles", "waveforms", "figures"];
    if form.run.duration.is_some() { &all[..2] } else { all }
}

impl Builder<'_> {
    /// Returns the evaluated waveform and body: as named in `figures`, otherwise unique candidates.
    pub(super) fn figures(&self) -> Result<Figures, Fault> {
        let form = &self.form.figures;
        let root = At::ROOT;
        let at = root.key("figures");
        let waveform = match &form.waveform {
            Some(name) => Some(self.periodic(&at.key("waveform"), name)?),
            None => (self.scene.waveforms.len() == 1).then_some(0),
        };
        let body = match &form.body {
            Some(name) => {
                let at = at.key("body");
                Some(self.moving_body(&at, self.body(&at, name)?)?)
            }
            None => self.only_body(),
        };
        Ok(Figures { waveform, body })
    }

    /// Returns the index of a waveform with a period.
    fn periodic(&self, at: &At<'_>, name: &str) -> Result<usize, Fault> {
        let waveforms = &self.form.waveforms;
        let index = waveforms
            .find(name)
            .ok_or_else(|| names::unknown(at, ("waveform", "waveforms"), name, waveforms))?;
        let waveform = &self.scene.waveforms[index].part;
        if waveform.period().is_some() {
            return Ok(index);
        }
        let which = match (waveform.interpolation(), waveform.generator(), waveform.shape()) {
            (_, Some(_), _) => "a generator, which waits for commands,",
            (Some(_), None, _) => "an input",
            (None, None, Shape::Chirp(_)) => "a chirp, whose frequency changes,",
            (None, None, Shape::Step { .. }) => "a step",
            (None, None, _) => "a table",
        };
        let fault = at.expected("a waveform with a period");
        Err(fault
            .against_path(At::ROOT.key("waveforms").key(name).path())
            .help(format!("{which} has no period, so it determines no steps")))
    }

    /// Returns the only free body, or the only body.
    fn only_body(&self) -> Option<usize> {
        let bodies = &self.scene.bodies;
        let mut free = (0..bodies.len()).filter(|&i| bodies[i].part.x.freedom == Freedom::Free);
        match (free.next(), free.next()) {
            (Some(only), None) => Some(only),
            (None, _) if bodies.len() == 1 => Some(0),
            _ => None,
        }
    }

    /// Returns the plan: duration, time integrator, limits and row interval.
    pub(super) fn plan(&self, figures: Figures) -> Result<Plan, Fault> {
        let form = &self.form.run;
        let root = At::ROOT;
        let at = root.key("run");
        let duration = match (form.duration, form.cycles) {
            (Some(duration), None) => duration.si,
            (None, Some(cycles)) => self.cycles(&at.key("cycles"), cycles, figures)?,
            (None, None) => {
                let fault = at.missing("duration").against(["run.cycles"]);
                return Err(fault.help("a run has a duration or a number of cycles"));
            }
            (Some(_), Some(_)) => {
                return Err(at
                    .key("cycles")
                    .fault("the duration is already given")
                    .on_key()
                    .help("keep one of them"));
            }
        };
        let every = self.form.output.every.map(|every| every.si);
        let stepper = stepper(&at.key("stepper"), &form.stepper)?;
        let until_steady = form
            .until_steady
            .map(|change| self.until_steady(&at.key("until_steady"), change, figures))
            .transpose()?;
        let limits = limits(&at.key("limits"), &form.limits)?;
        let plan = Plan { duration, stepper, limits, every, until_steady };
        // Checks the plan before its numbers are compared.
        plan.check().map_err(|error| refused::fault(&self.scene, plan, &error))?;
        within_run(&at.key("stepper"), plan, self.form)?;
        Ok(plan)
    }

    /// Returns the memory limit of the run, B.
    pub(super) fn memory_limit(&self) -> Result<Option<f64>, Fault> {
        let root = At::ROOT;
        let (run, limits) = (root.key("run"), &self.form.run.limits);
        let at = run.key("limits");
        limits.memory.map(|memory| range::above_zero(&at.key("memory"), memory)).transpose()
    }

    fn until_steady(&self, at: &At<'_>, change: f64, figures: Figures) -> Result<UntilSteady, Fault> {
        let change = range::number_between(at, change, CHANGE.0, CHANGE.1)?;
        let none = |message: String, help: &str| Err(at.fault(message).on_key().help(help).against(MOVING));
        let Some(waveform) = figures.waveform else {
            let message = "there is no single waveform with a period that determines steps";
            return none(message.to_owned(), "name one in figures.waveform");
        };
        let named = &self.scene.waveforms[waveform];
        if named.part.period().is_none() {
            let message = format!("the waveform \"{}\" has no period, so it determines no steps", named.name);
            return none(message, "name another in figures.waveform");
        }
        let Some(body) = figures.body else {
            let message = "there is no single free body that makes steps";
            return none(message.to_owned(), "name one in figures.body");
        };
        let named = &self.scene.bodies[body];
        if named.part.x.freedom != Freedom::Free {
            let message = format!("the body \"{}\" is not free along x, so it makes no steps", named.name);
            return none(message, "name a free one in figures.body");
        }
        Ok(UntilSteady { waveform, body, change })
    }

    fn cycles(&self, at: &At<'_>, cycles: f64, figures: Figures) -> Result<f64, Fault> {
        let cycles = range::number_above_zero(at, cycles)?;
        let Some(index) = figures.waveform else {
            let fault =
                at.fault("there is no single waveform with a period that determines the cycles").on_key();
            let fault = fault.against(MOVING);
            return Err(fault.help("name one in figures.waveform, or give run.duration"));
        };
        let named = &self.scene.waveforms[index];
        let Some(period) = named.part.period() else {
            let fault = at.fault(format!("the waveform \"{}\" has no period", named.name)).on_key();
            let fault = fault.against(MOVING);
            return Err(fault.help("name another in figures.waveform, or give run.duration"));
        };
        let duration = self.courses[index].delay + cycles * period;
        let fewer = || at.expected("fewer cycles").against(MOVING);
        if duration.is_finite() { Ok(duration) } else { Err(fewer()) }
    }
}

fn stepper(at: &At<'_>, form: &StepperForm) -> Result<Stepper, Fault> {
    let stepper = form.asked();
    if let Accuracy::Tolerance(tolerance) = stepper.accuracy() {
        range::number_between(&at.key(stepper.name()).key("tolerance"), tolerance, TOLERANCE.0, TOLERANCE.1)
            .map_err(|fault| fault.help("relative to u_c and μF_N; 1e-8 suits most models"))?;
    }
    if let Accuracy::Frame { error, .. } = stepper.accuracy() {
        range::number_between(
            &at.key(stepper.name()).key("accuracy"),
            error,
            FRAME_ACCURACY.0,
            FRAME_ACCURACY.1,
        )
        .map_err(|fault| {
            fault.help("the error per stroke relative to the stroke; 1e-3 suits most controllers")
        })?;
    }
    Ok(stepper)
}

/// Checks that a fixed time step or frame is not longer than the run.
fn within_run(at: &At<'_>, plan: Plan, form: &Form) -> Result<(), Fault> {
    let name = plan.stepper.name();
    let (key, step) = match plan.stepper.accuracy() {
        Accuracy::Step(step) => ("step", step),
        Accuracy::Frame { length, .. } => ("length", length),
        Accuracy::Tolerance(_) => return Ok(()),
    };
    if step <= plan.duration {
        return Ok(());
    }
    let duration = range::short(plan.duration);
    let what = format!("a time up to the duration of the run, {duration} s");
    Err(at.key(name).key(key).expected(what).against(self::duration(form).iter().copied()))
}

fn limits(at: &At<'_>, form: &LimitsForm) -> Result<Limits, Fault> {
    Ok(Limits {
        steps: range::count_between(&at.key("steps"), form.steps.0, 1, u64::MAX)?,
        events: range::count_between(&at.key("events"), form.events.0, 1, u64::MAX)?,
        wall: form.wall.map(|wall| range::above_zero(&at.key("wall"), wall)).transpose()?,
    })
}
