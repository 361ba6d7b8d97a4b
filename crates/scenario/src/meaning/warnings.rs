//! Warnings about values that are allowed but implausible.

use super::{Meaning, motion};
use crate::PlotName;
use crate::Warning;
use crate::fault::Fault;
use crate::form::{Form, FreedomForm, Parts, PlotForm, ProfileForm, RoughForm, RunStartForm, WaveformForm};
use crate::path::{At, KeyPath};
use std::collections::HashSet;
use std::f64::consts::TAU;
use stickslip_drive::Scene;
use stickslip_drive::scene::{Axis, Body, ContactStart, Coordinate, Freedom, Named, Normal, Side, Varying};

/// Plausible range of Young's modulus, Pa: from the softest gels to above diamond.
const MODULUS: (f64, f64) = (1e3, 2e12);
/// Largest plausible phase, rad. Larger numbers probably are degrees without a unit.
const TURN: f64 = TAU * (1.0 + 1e-9);
/// Largest plausible friction coefficient, above that of rubber on clean glass.
const FRICTION: f64 = 4.0;

/// Minimum number of values for warnings about noise and tilt.
const ROWS: usize = 20;
/// Largest noise of a measured motion relative to its range. More noise would move the contact back and forth.
const NOISE: f64 = 5e-4;
/// Largest height difference by tilt, relative to the range of the levelled heights.
const TILT: f64 = 1.0;

/// Returns minimum and maximum of values.
fn range(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
}

/// Warning: category (see [`Warning`](crate::Warning)) and message.
#[derive(Debug)]
pub(crate) struct Oddity {
    pub(crate) kind: &'static str,
    pub(crate) fault: Fault,
}

/// Returns all warnings of a scenario. `is_written` returns whether the file contains a value.
pub(crate) fn of(form: &Form, meaning: &Meaning, is_written: impl Fn(&KeyPath) -> bool) -> Vec<Oddity> {
    let mut odd = Oddities { form, meaning, scene: &meaning.scene, found: Vec::new() };
    odd.unused();
    odd.materials();
    odd.bodies(is_written);
    odd.contacts();
    odd.idle_links();
    odd.run();
    odd.waveforms_too_late();
    odd.phases();
    odd.measured();
    let cuts = meaning.stacks.iter().filter_map(|piezo| super::driver::cut(piezo, &meaning.scene));
    cuts.for_each(|fault| odd.find("window", fault));
    for (piezo, (_, actuator)) in meaning.stacks.iter().zip(form.actuators.iter()) {
        if let Some(fault) = super::driver::beyond(piezo, &meaning.scene) {
            odd.find("beyond_data_sheet", fault);
        }
        if let Some(fault) = super::driver::idle_ratio(&piezo.name, actuator) {
            odd.find("no_effect", fault);
        }
    }
    odd.found
}

struct Oddities<'a> {
    form: &'a Form,
    meaning: &'a Meaning,
    scene: &'a Scene,
    found: Vec<Oddity>,
}

impl Oddities<'_> {
    fn find(&mut self, kind: &'static str, fault: Fault) {
        self.found.push(Oddity { kind, fault });
    }

    /// Warns of noisy measured motions and tilted measured lines.
    fn measured(&mut self) {
        let root = At::ROOT;
        let at = root.key("waveforms");
        for (name, waveform) in self.form.waveforms.iter() {
            let WaveformForm::Table(table) = waveform else { continue };
            let values: Vec<f64> = table.points.iter().flatten().map(|point| point.1.si).collect();
            let (low, high) = range(&values);
            let noise = stickslip_record::noise(&values);
            if values.len() >= ROWS && noise > NOISE * (high - low) {
                let share = 100.0 * noise / (high - low);
                let fault = at
                    .key(name)
                    .key("table")
                    .fault(format!("its values have noise of {share:.2} % of their range"));
                let help = "noise moves the bodies that follow the waveform back and forth and falsifies contact loops: give \"smooth\", the time in which the motion is approximately a parabola";
                self.find("noise", fault.help(help));
            }
        }
        let at = root.key("contacts");
        for (name, contact) in self.form.contacts.iter() {
            let ProfileForm::Rough(RoughForm { heights: Some(heights), .. }) = &contact.profile else {
                continue;
            };
            let heights: Vec<f64> = heights.iter().map(|height| height.si).collect();
            let count = heights.len() as f64;
            let middle = 0.5 * (count - 1.0);
            let moment: f64 =
                heights.iter().enumerate().map(|(row, height)| (row as f64 - middle) * height).sum();
            let slope = 12.0 * moment / (count * (count * count - 1.0));
            let level: Vec<f64> =
                heights.iter().enumerate().map(|(row, height)| height - slope * row as f64).collect();
            let (low, high) = range(&level);
            if heights.len() >= ROWS && slope.abs() * count > TILT * (high - low) {
                let fault = at
                    .key(name)
                    .key("profile")
                    .key("rough")
                    .fault("the line is tilted: its tilt exceeds its roughness");
                self.find(
                    "tilt",
                    fault.help("give \"level\": \"line\" to remove the tilt; otherwise only one end touches"),
                );
            }
        }
    }

    /// Warns of parts to which nothing refers.
    fn unused(&mut self) {
        let (form, scene) = (self.form, self.scene);
        let contacts = form.contacts.iter();
        let materials: HashSet<&str> =
            contacts.flat_map(|(_, contact)| contact.materials.0.iter().map(String::as_str)).collect();
        let used = form.materials.names().map(|name| materials.contains(name)).collect();
        self.unnamed("materials", &form.materials, used, "no contact names this material");
        let mut used = followed(scene);
        if let (Some(waveform), Some(_)) = (self.meaning.figures.waveform, &form.figures.waveform) {
            used[waveform] = true;
        }
        self.unnamed("waveforms", &form.waveforms, used, "no part follows this waveform");
        let moves_alone = scene.bodies.iter().map(|body| body.part.is_free());
        let used = motion::named_bodies(scene).into_iter().zip(moves_alone).map(|(a, b)| a || b).collect();
        self.unnamed("bodies", &form.bodies, used, "no contact, spring, actuator or load names this body");
    }

    fn unnamed<T>(&mut self, key: &str, parts: &Parts<T>, used: Vec<bool>, message: &str) {
        let root = At::ROOT;
        let at = root.key(key);
        let unused = parts.names().zip(used).filter(|(_, used)| !used);
        for (name, _) in unused {
            let fault = at.key(name).fault(message).on_key();
            self.find("unused", fault.help("remove it, or check the spelling of the other names"));
        }
    }

    /// Warns of moduli that suggest a forgotten unit.
    fn materials(&mut self) {
        let root = At::ROOT;
        let at = root.key("materials");
        for (name, material) in self.form.materials.iter() {
            let (value, at) = (material.youngs_modulus.si, at.key(name));
            let at = at.key("youngs_modulus");
            if value < MODULUS.0 {
                let fault = at.fault(format!("{value} Pa is softer than any solid"));
                self.find("modulus", fault.help("a number without a unit is in Pa; steel has \"210 GPa\""));
            } else if value > MODULUS.1 {
                let fault = at.fault(format!("{value:e} Pa is stiffer than diamond"));
                self.find("modulus", fault.help("steel has \"210 GPa\""));
            }
        }
    }

    /// Warns of fixed bodies with a mass, and of loads on bodies that do not move.
    fn bodies(&mut self, is_written: impl Fn(&KeyPath) -> bool) {
        let root = At::ROOT;
        let at = root.key("bodies");
        for (name, body) in self.form.bodies.iter() {
            let at = at.key(name);
            if let (Some(_), FreedomForm::Fixed, FreedomForm::Fixed) = (body.mass, &body.x, &body.z)
                && !is_written(&at.key("x").path())
            {
                let fault = at.key("mass").fault("this body has a mass, but x is fixed: it does not move");
                // A resolved scenario contains "x" and gives no warning.
                self.find(Warning::WORDING, fault.on_key().help("write \"x\": \"free\""));
            }
        }
        let at = root.key("loads");
        for (i, load) in self.scene.loads.iter().enumerate() {
            let on = &self.scene.bodies[load.on];
            if !on.part.is_free() && !on.part.is_balanced() {
                let message = format!("this load has no effect: \"{}\" is not free", on.name);
                let help = "load a body that is free or balanced";
                self.find("no_effect", at.index(i).key("on").fault(message).help(help));
            }
        }
    }

    /// Warns of contacts with a large friction coefficient, and of contacts without a normal load.
    fn contacts(&mut self) {
        let root = At::ROOT;
        let at = root.key("contacts");
        for contact in &self.scene.contacts {
            let at = at.key(&contact.name);
            let friction = contact.part.interface.friction();
            if friction > FRICTION {
                let fault = at
                    .key("friction")
                    .fault(format!("{friction} exceeds the friction coefficient of any dry pair"));
                self.find("friction", fault.help("typical are 0.05 to 0.6; write 20 % as 0.2"));
            }
            let (key, value) = match contact.part.normal {
                Normal::Force(value) => ("force", value),
                Normal::Indentation(value) => ("indentation", value),
                Normal::Radius(value) => ("radius", value),
                Normal::Coupled => continue,
            };
            let highest = match value {
                Varying::Constant(value) => value,
                Varying::Follows(waveform) => self.scene.waveforms[waveform].part.range().1,
            };
            if highest <= 0.0 {
                let at = at.key("normal");
                let fault = at.key(key).fault("this contact is never pressed, so it transmits no force");
                self.find("no_effect", fault.help("press it with a value above 0"));
            }
        }
    }

    /// Warns of springs and actuators between bodies that do not move.
    fn idle_links(&mut self) {
        let scene = self.scene;
        let springs = scene.springs.iter().map(|spring| ("springs", &spring.name, spring.part.between));
        let actuators = scene.actuators.iter().map(|part| ("actuators", &part.name, part.part.between));
        let moves = |i: &usize| scene.bodies[*i].part.is_free() || scene.bodies[*i].part.is_balanced();
        let is_free = |side: &Side| matches!(side, Side::Body(i) if moves(i));
        for (key, name, between) in springs.chain(actuators) {
            if !between.iter().any(is_free) {
                let root = At::ROOT;
                let at = root.key(key);
                let fault = at
                    .key(name)
                    .key("between")
                    .fault("neither of the two bodies is free, so this has no effect on the motion");
                self.find("no_effect", fault.help("give one of them a mass and \"x\": \"free\""));
            }
        }
    }

    /// Warns of runs without motion and of output without effect.
    fn run(&mut self) {
        let (root, scene, plan) = (At::ROOT, self.scene, self.meaning.plan);
        if is_at_rest(scene) {
            let fault = root.key("run").fault("no part sets the model in motion").on_key();
            let help = "let a body or a load follow a waveform, or give a body a start away from rest";
            self.find("no_effect", fault.help(help));
        }
        let is_free = scene.bodies.iter().any(|body| body.part.is_free());
        if self.form.run.start == RunStartForm::Equilibrium && !is_free {
            let fault = root
                .key("run")
                .key("start")
                .fault("no coordinate is free, so there is no equilibrium to compute");
            self.find("no_effect", fault.help("leave it out"));
        }
        let lifted = scene.bodies.iter().any(|body| body.part.z.freedom == Freedom::Free);
        if scene.gravity.acceleration > 0.0 && scene.gravity.components().0 == 0.0 && !lifted {
            let fault =
                root.key("gravity").fault("on a level slide gravity has no component along x").on_key();
            let help = "give an \"incline\"; the normal load of contacts is in their key \"normal\"";
            self.find("no_effect", fault.help(help));
        }
        if plan.every.is_some_and(|every| every > plan.duration) {
            let at = root.key("output");
            let fault = at.key("every").fault(format!("longer than the run of {} s", plan.duration));
            self.find("output", fault.help("only the first and the last row are written"));
        }
        let plots = &self.form.plots;
        let names: Vec<_> = plots.iter().map(PlotForm::name).collect();
        let is_again = |i: &usize| names[*i] != PlotName::Xy && names[..*i].contains(&names[*i]);
        if let Some(i) = (0..plots.len()).find(is_again) {
            self.find("output", root.key("plots").index(i).fault("this plot is already in the list"));
        }
    }

    /// Warns of waveforms that start after the end of the run.
    fn waveforms_too_late(&mut self) {
        let root = At::ROOT;
        let at = root.key("waveforms");
        let used = followed(self.scene);
        for (i, name) in self.form.waveforms.names().enumerate() {
            let delay = self.scene.waveforms[i].part.timing().delay;
            if used[i] && delay >= self.meaning.plan.duration {
                let message = format!("this waveform starts at {delay} s, after the end of the run");
                let fault = at.key(name).fault(message).on_key();
                self.find("no_effect", fault.help("lengthen the run, or shorten the delay"));
            }
        }
    }

    /// Warns of phases that probably are in degrees.
    fn phases(&mut self) {
        let root = At::ROOT;
        let at = root.key("waveforms");
        for (name, waveform) in self.form.waveforms.iter() {
            let Some((kind, periodic)) = waveform.periodic() else { continue };
            let (at, phase) = (at.key(name), periodic.phase.si);
            if phase.abs() > TURN {
                let at = at.key(kind);
                let fault = at.key("phase").fault(format!("{phase} rad exceeds a full turn"));
                self.find(
                    "unit",
                    fault.help("a number without a unit is in rad; for degrees write \"90 deg\""),
                );
            }
        }
    }
}

/// Returns the values of a model that may vary in time.
fn varying(scene: &Scene) -> impl Iterator<Item = Varying> {
    let pressed = scene.contacts.iter().map(|contact| match contact.part.normal {
        Normal::Force(value) | Normal::Indentation(value) | Normal::Radius(value) => value,
        Normal::Coupled => Varying::default(),
    });
    let strokes = scene.actuators.iter().map(|actuator| actuator.part.stroke);
    pressed.chain(strokes).chain(scene.loads.iter().flat_map(|load| [load.x, load.z, load.pitch]))
}

/// Returns for each waveform whether anything follows it.
fn followed(scene: &Scene) -> Vec<bool> {
    let mut followed = vec![false; scene.waveforms.len()];
    for body in &scene.bodies {
        for (_, coordinate) in body.part.coordinates() {
            if let Freedom::Follows(waveform) = coordinate.freedom {
                followed[waveform] = true;
            }
        }
    }
    for value in varying(scene) {
        if let Varying::Follows(signal) = value
            && let Some(waveform) = scene.waveform_of(signal)
        {
            followed[waveform] = true;
        }
    }
    followed
}

/// Returns whether the model stays at rest: no waveform, no force, no stretched spring.
fn is_at_rest(scene: &Scene) -> bool {
    let gravity = scene.gravity;
    let nothing = Varying::Constant(0.0);
    let lifted = |body: &Named<Body>| gravity.acceleration != 0.0 && body.part.z.freedom == Freedom::Free;
    let is_still = |(_, c): (Axis, Coordinate)| c.position == 0.0 && c.velocity == 0.0;
    !followed(scene).contains(&true)
        && scene.loads.iter().all(|load| [load.x, load.z, load.pitch] == [nothing; 3])
        && (gravity.components().0 == 0.0 && !scene.bodies.iter().any(lifted))
        && scene.bodies.iter().all(|body| body.part.coordinates().into_iter().all(is_still))
        && scene.springs.iter().all(|spring| spring.part.preload == 0.0)
        && scene.actuators.iter().all(|actuator| actuator.part.stroke == Varying::Constant(0.0))
        && scene.contacts.iter().all(|contact| contact.part.start == ContactStart::Untouched)
}
