//! Lists of the computations that a run performs for a model, and of omitted computations.

use super::name;
use crate::Job;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::scene::{Body, EngineChoice, Freedom, Named, Side};
use stickslip_drive::{Expected, Method, Pressing, Treatment, Why};

/// Computations of a run, and omitted ones.
#[derive(Debug, Default, Serialize, JsonSchema)]
pub struct Usage {
    /// Computations of a run.
    pub used: Vec<Item>,
    /// Omitted computations.
    pub skipped: Vec<Item>,
}

/// A computation with the parts of the model that it concerns.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Item {
    /// computation or part of the model, such as motion, memory or waveform. `used` lists what a run computes,
    /// `skipped` what it omits.
    pub what: &'static str,
    /// names of the parts of the scenario that it concerns. Absent if it concerns the whole scenario.
    #[serde(rename = "parts", skip_serializing_if = "Vec::is_empty")]
    pub of: Vec<String>,
    /// reason for the computation or omission, or its method, in words
    pub why: String,
}

impl Usage {
    /// Returns the computations of a run. The run itself uses the same functions for these decisions.
    pub fn of(job: &Job) -> Self {
        let mut usage = Self::default();
        let expected = job.model.expected(&job.start, job.scenario.plan.stepper);
        usage.motion(job, &expected);
        usage.contacts(job, &expected);
        usage.couplings(job);
        usage.unused(job);
        usage.output(job);
        usage
    }

    fn uses(&mut self, what: &'static str, of: &str, why: impl Into<String>) {
        add(&mut self.used, what, of, why.into());
    }

    fn skips(&mut self, what: &'static str, of: &str, why: impl Into<String>) {
        add(&mut self.skipped, what, of, why.into());
    }

    fn motion(&mut self, job: &Job, expected: &Expected) {
        let names = job.model.linearised(&job.start, |d| d.start).coordinates().to_vec();
        let (stepper, _, _) = job.stepper();
        if names.is_empty() {
            let asked = if job.scenario.plan.stepper.locates_events() {
                ""
            } else {
                ", independent of the chosen stepper"
            };
            let balanced = balanced(job);
            let why = if balanced.is_empty() { Why::NothingFree } else { Why::Balanced };
            self.skips("equations of motion", "", format!("{why}{asked}"));
            for name in balanced {
                self.uses("place", &name, "balanced: follows from loads, springs and contacts");
            }
            return;
        }
        names.iter().for_each(|name| self.uses("motion", name, format!("free, stepper {stepper}")));
        if !is_located(expected) {
            return;
        }
        for (method, why) in &expected.methods {
            self.uses("method", "", format!("{}: {why}", method.name()));
        }
        for name in job.model.travellers() {
            self.uses(
                "position",
                &format!("{name}.x"),
                "relative to the contact: only contacts depend on it",
            );
        }
        if expected.takes(Method::Swing) {
            self.skips("steps between events", "", Why::OneQuadrature.to_string());
        } else if expected.takes(Method::Nystrom) {
            self.skips("stages for velocities", "", Why::NoVelocities.to_string());
        }
        if expected.takes(Method::Parabola) {
            self.skips("evaluations", "", format!("{}: the motion is a parabola", Why::ConstantForces));
        }
    }

    fn contacts(&mut self, job: &Job, expected: &Expected) {
        let located = is_located(expected);
        for (c, contact) in job.scenario.scene.contacts.iter().enumerate() {
            let name = &contact.name;
            if job.model.indentations(&job.start, c).is_some_and(|d| d.most <= 0.0) {
                self.skips("contact", name, Why::NeverPressed.to_string());
                continue;
            }
            if contact.part.interface.friction() == 0.0 {
                self.skips("tangential force", name, Why::NoFriction.to_string());
                continue;
            }
            match contact.part.engine {
                EngineChoice::Curve => self.uses("memory", name, "the exact curve"),
                EngineChoice::Springs { count, .. } => {
                    self.uses("memory", name, format!("a row of {count} springs, linear between springs"));
                }
            }
            self.pressing(job, c, name);
            if let Some(asked) = &job.scenario.fields
                && contact.part.interface.profile().has_shape()
            {
                let why = "radii for output.fields; fast while the normal load is constant";
                self.uses("friction work per area", name, format!("{} {why}", asked.radii));
            }
            if let Some(why) = expected.treats(c, Treatment::Apart).filter(|_| job.is_coupled(c)) {
                self.skips("forces", name, why.to_string());
            }
            if located && job.model.grows(c) {
                self.uses("tangential force", name, "integrated while the contact grows in full stick");
            }
            if let Some(why) = expected.treats(c, Treatment::Closed) {
                self.skips("memory between events", name, why.to_string());
            }
        }
    }

    /// Adds an entry about the method that determines the indentation of contact `c`.
    fn pressing(&mut self, job: &Job, c: usize, name: &str) {
        let why = match job.model.pressing(c) {
            None => return,
            Some(Pressing::Constant) => {
                let why = "constant load: the indentation is constant";
                return self.skips("normal motion", name, why);
            }
            Some(Pressing::Followed) => "follows a waveform",
            Some(Pressing::Solved) => "follows from a waveform at every evaluation",
            Some(Pressing::Bodies) => "from the motion of the bodies",
        };
        self.uses("indentation", name, why);
    }

    fn couplings(&mut self, job: &Job) {
        let scene = &job.scenario.scene;
        let is_free = |side: &Side| matches!(side, Side::Body(b) if scene.bodies.get(*b).is_some_and(|b| b.part.is_free() || b.part.is_balanced()));
        let spared = job.model.spared();
        let springs = scene.springs.iter().enumerate();
        let springs =
            springs.map(|(i, part)| ("spring", &part.name, part.part.between, spared.springs.contains(&i)));
        let actuators = scene.actuators.iter().enumerate();
        let actuators = actuators
            .map(|(i, part)| ("actuator", &part.name, part.part.between, spared.actuators.contains(&i)));
        for (kind, part, between, is_spared) in springs.chain(actuators) {
            let [first, second] = between.map(|side| name(job, side));
            if is_spared {
                self.skips(
                    kind,
                    part,
                    format!("neither {first} nor {second} is free: no effect on the motion"),
                );
            } else if between.iter().any(is_free) {
                self.uses(kind, part, format!("between {first} and {second}"));
            } else {
                self.uses(
                    kind,
                    part,
                    format!("neither {first} nor {second} is free: only its energy is computed"),
                );
            }
        }
        for (i, load) in scene.loads.iter().enumerate() {
            let (place, body) = (format!("loads[{i}]"), Side::Body(load.on));
            if spared.loads.contains(&i) {
                self.skips(
                    "load",
                    &place,
                    format!("{} is not free: its guide takes the load", name(job, body)),
                );
            } else {
                self.uses("load", &place, format!("on {}", name(job, body)));
            }
        }
        if scene.gravity.acceleration != 0.0 {
            let (along, normal) = scene.gravity.components();
            let lifts = |body: &Named<Body>| body.part.z.freedom == Freedom::Free && normal != 0.0;
            if scene.bodies.iter().any(lifts) {
                let slope =
                    if along == 0.0 { String::new() } else { format!(", {along:.4} m/s² down the slide") };
                self.uses("gravity", "", format!("{normal:.4} m/s² down{slope}"));
            } else if along == 0.0 || !scene.bodies.iter().any(|body| body.part.is_free()) {
                self.skips("gravity", "", "no body is free along gravity");
            } else {
                self.uses("gravity", "", format!("{along:.4} m/s² down the slide"));
            }
        }
    }

    fn unused(&mut self, job: &Job) {
        let scene = &job.scenario.scene;
        for material in job.scenario.unused_materials() {
            self.skips("material", material, "no contact has this material");
        }
        for waveform in job.model.spared().waveforms.iter().filter_map(|w| scene.waveforms.get(*w)) {
            self.skips("waveform", &waveform.name, "no part follows this waveform");
        }
        for body in &scene.bodies {
            if body.part.mass.is_some() && !body.part.is_free() {
                self.skips("mass", &body.name, "the body is not free");
            }
        }
    }

    fn output(&mut self, job: &Job) {
        let (written, all) = (job.columns.len(), job.model.channels().len());
        if job.scenario.plan.every.is_none() {
            self.skips("rows", "", "no output.every: only the first and the last row");
        }
        if written < all {
            let why = format!("output.channels leaves out {} of {all}", all - written);
            self.skips("channels", "", why);
        }
        if job.scenario.plots.is_empty() {
            self.skips("pictures", "", "the key plots is empty");
        }
        job.scenario
            .plots
            .iter()
            .for_each(|plot| self.uses("picture", plot.name(), "named in the key plots"));
    }
}

/// Returns whether the stepper locates events.
fn is_located(expected: &Expected) -> bool {
    !expected.takes(Method::AskedFor)
}

/// Returns the names of coordinates without mass, as `BODY.x`.
fn balanced(job: &Job) -> Vec<String> {
    let of = |body: &Named<Body>| {
        let balanced = body.part.coordinates().into_iter().filter(|(_, c)| c.freedom == Freedom::Balanced);
        balanced.map(|(axis, _)| format!("{}.{}", body.name, axis.key())).collect::<Vec<_>>()
    };
    job.scenario.scene.bodies.iter().flat_map(of).collect()
}

/// Adds a part to the item with the same computation and reason, or a new item.
fn add(items: &mut Vec<Item>, what: &'static str, of: &str, why: String) {
    let of = (!of.is_empty()).then(|| of.to_owned());
    match items.iter_mut().find(|item| item.what == what && item.why == why) {
        Some(item) => item.of.extend(of),
        None => items.push(Item { what, of: of.into_iter().collect(), why }),
    }
}
