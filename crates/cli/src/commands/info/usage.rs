//! What a run computes of a scene, and what it skips and why.

use serde::Serialize;
use stickslip_drive::Stepper;
use stickslip_drive::facts::followers;
use stickslip_drive::scene::{Body, EngineChoice, Freedom, Named, Normal, Scene, Side, Varying};
use stickslip_results::Job;
use stickslip_results::info::name;

/// What is computed and what is not.
#[derive(Debug, Default, Serialize)]
pub(super) struct Usage {
    pub(super) used: Vec<Item>,
    pub(super) skipped: Vec<Item>,
}

/// Something of these parts, and why it is computed or not.
#[derive(Debug, Serialize)]
pub(super) struct Item {
    pub(super) what: &'static str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) of: Vec<String>,
    pub(super) why: String,
}

impl Usage {
    pub(super) fn of(job: &Job) -> Self {
        let mut usage = Self::default();
        usage.motion(job);
        usage.contacts(job);
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

    fn motion(&mut self, job: &Job) {
        let names = job.model.linearised(&job.start, |d| d.start).coordinates().to_vec();
        let (stepper, _, _) = job.stepper();
        if names.is_empty() {
            let asked = match job.scenario.plan.stepper {
                Stepper::Event { .. } => "",
                _ => ", whatever stepper is asked for",
            };
            self.skips(
                "equations of motion",
                "",
                format!("nothing is free: contacts are walked along their path{asked}"),
            );
        } else {
            names.iter().for_each(|name| self.uses("motion", name, format!("free, stepper {stepper}")));
        }
        if !names.is_empty() && is_located(job) {
            self.method(job);
        }
    }

    /// What the stepper with located events makes of the equations of motion.
    fn method(&mut self, job: &Job) {
        if job.model.swings() {
            self.uses(
                "method",
                "",
                "closed form from event to event; Runge–Kutta–Nyström 8(6) where it comes to rest",
            );
            let why = "one slider, paraboloids under constant load, straight waveforms: an interval is one quadrature";
            self.skips("steps between events", "", why);
        } else if job.model.is_conservative() {
            let what = "Runge–Kutta–Nyström 8(6), as no force depends on a velocity; Dormand–Prince 8(5,3) before singular events";
            self.uses("method", "", what);
            let why = "no force depends on one: a third of the evaluations is spared";
            self.skips("stages for velocities", "", why);
        } else {
            self.uses("method", "", "Dormand–Prince 8(5,3)");
        }
        for name in job.model.travellers() {
            self.uses("position", &format!("{name}.x"), "counted from near by: only contacts depend on it");
        }
    }

    fn contacts(&mut self, job: &Job) {
        let located = is_located(job);
        for (c, contact) in job.scenario.scene.contacts.iter().enumerate() {
            let name = &contact.name;
            if job.model.indentations(&job.start, c).is_some_and(|d| d.most <= 0.0) {
                self.skips(
                    "contact",
                    name,
                    "never pressed: it is not evaluated, and nothing looks out for it",
                );
                continue;
            }
            if contact.part.friction == 0.0 {
                self.skips("tangential force", name, "no friction");
                continue;
            }
            match contact.part.engine {
                EngineChoice::Curve => self.uses("memory", name, "the exact curve"),
                EngineChoice::Springs { count, .. } => {
                    self.uses("memory", name, format!("a row of {count} springs, asked at every evaluation"));
                }
            }
            if job.has_constant_load(c) {
                self.skips(
                    "normal motion",
                    name,
                    "constant load: the indentation is found once, nothing grows",
                );
                if located && contact.part.engine == EngineChoice::Curve && contact.part.damping == 0.0 {
                    self.steady(job, c);
                }
                continue;
            }
            let why = match contact.part.normal {
                Normal::Indentation(_) => "follows a waveform",
                Normal::Force(_) | Normal::Radius(_) => "solved from a waveform at every evaluation",
                Normal::Coupled => "from the motion of the bodies",
            };
            self.uses("indentation", name, why);
            if contact.part.normal == Normal::Coupled && located {
                self.skips("forces", name, "while apart: only the gap is watched");
            }
            if contact.part.engine == EngineChoice::Curve && located {
                self.uses(
                    "tangential force",
                    name,
                    "a state of its own while the contact grows in full stick",
                );
            }
        }
    }

    /// What need not be done of contact `c`, pressed by a constant load, between two events.
    fn steady(&mut self, job: &Job, c: usize) {
        let scene = &job.scenario.scene;
        let Some(contact) = scene.contacts.get(c) else { return };
        let is_straight = |side: &Side| match side {
            Side::Body(body) => scene.bodies.get(*body).is_none_or(|body| follows_lines(scene, &body.part)),
            Side::Ground => true,
        };
        if !contact.part.between.iter().all(is_straight) {
            return;
        }
        let name = &contact.name;
        let why = "steady: straight waveforms drag one edge through it, it moves at events only";
        self.skips("memory between events", name, why);
        let is_alone = scene.contacts.len() == 1 && scene.springs.is_empty() && scene.actuators.is_empty();
        if is_alone && job.model.is_conservative() {
            self.skips("evaluations", name, "in gross slip: the motion is a parabola");
        }
    }

    fn couplings(&mut self, job: &Job) {
        let scene = &job.scenario.scene;
        let is_free = |side: &Side| matches!(side, Side::Body(b) if scene.bodies.get(*b).is_some_and(|b| b.part.is_free()));
        let is_followed = |body: &Named<Body>| {
            body.part.coordinates().into_iter().any(|(_, c)| matches!(c.freedom, Freedom::Follows(_)))
        };
        let follows =
            |side: &Side| matches!(side, Side::Body(b) if scene.bodies.get(*b).is_some_and(is_followed));
        let springs = scene.springs.iter().map(|part| ("spring", &part.name, part.part.between, false));
        let actuators = scene.actuators.iter().map(|part| {
            let is_driven = matches!(part.part.stroke, Varying::Follows(_));
            ("actuator", &part.name, part.part.between, is_driven)
        });
        for (kind, part, between, is_driven) in springs.chain(actuators) {
            let [first, second] = between.map(|side| name(job, side));
            if between.iter().any(is_free) {
                self.uses(kind, part, format!("between {first} and {second}"));
            } else if between.iter().any(follows) || is_driven {
                self.uses(kind, part, format!("neither {first} nor {second} is free: for its energy alone"));
            } else {
                self.skips(kind, part, format!("neither {first} nor {second} is free: it moves nothing"));
            }
        }
        for (i, load) in scene.loads.iter().enumerate() {
            let (place, body) = (format!("loads[{i}]"), Side::Body(load.on));
            if is_free(&body) {
                self.uses("load", &place, format!("on {}", name(job, body)));
            } else {
                self.skips("load", &place, format!("{} is not free: its guide carries it", name(job, body)));
            }
        }
        if scene.gravity.acceleration != 0.0 {
            let (down, normal) = scene.gravity.incline.sin_cos();
            let along = scene.gravity.acceleration * down;
            let lifts = |body: &Named<Body>| body.part.z.freedom == Freedom::Free && normal != 0.0;
            if scene.bodies.iter().any(lifts) {
                self.uses("gravity", "", format!("{:.4} m/s² down", scene.gravity.acceleration));
            } else if along == 0.0 || !scene.bodies.iter().any(|body| body.part.is_free()) {
                self.skips("gravity", "", "nothing moves freely along it");
            } else {
                self.uses("gravity", "", format!("{along:.4} m/s² down the slide"));
            }
        }
    }

    fn unused(&mut self, job: &Job) {
        let scene = &job.scenario.scene;
        for material in job.scenario.unused_materials() {
            self.skips("material", material, "no contact is made of it");
        }
        let followers = followers(scene);
        for (w, waveform) in scene.waveforms.iter().enumerate() {
            if !followers.iter().any(|follower| follower.waveform == w) {
                self.skips("waveform", &waveform.name, "nothing follows it: its corners end no steps");
            }
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
            self.skips("rows", "", "no output.every: the first and the last row only");
        }
        if written < all {
            let why = format!("{} of {all} are not asked for in output.channels", all - written);
            self.skips("channels", "", why);
        }
        if job.scenario.plots.is_empty() {
            self.skips("pictures", "", "none asked for in plots");
        }
        job.scenario.plots.iter().for_each(|plot| self.uses("picture", plot.name(), "asked for in plots"));
    }
}

/// Whether events are located: they are crossed by all other steppers.
fn is_located(job: &Job) -> bool {
    matches!(job.model.effective(job.scenario.plan.stepper), Stepper::Event { .. })
}

/// Whether whatever a body follows is straight between its corners.
fn follows_lines(scene: &Scene, body: &Body) -> bool {
    body.coordinates().into_iter().all(|(_, coordinate)| match coordinate.freedom {
        Freedom::Follows(w) => scene.waveforms.get(w).is_none_or(|waveform| waveform.part.is_straight()),
        Freedom::Fixed | Freedom::Free => true,
    })
}

/// Adds to what stands there for the same reason, if anything does.
fn add(items: &mut Vec<Item>, what: &'static str, of: &str, why: String) {
    let of = (!of.is_empty()).then(|| of.to_owned());
    match items.iter_mut().find(|item| item.what == what && item.why == why) {
        Some(item) => item.of.extend(of),
        None => items.push(Item { what, of: of.into_iter().collect(), why }),
    }
}
