//! Scenarios along the slide with prescribed normal loads.

use crate::soak::basis::Basis;
use crate::soak::course::Course;
use crate::soak::sketch::{GRAVITY, Sketch};
use serde_json::{Map, Value, json};

/// Draws a normal load: constant or any waveform.
fn normal(sketch: &mut Sketch, name: &str) -> Value {
    let (force, depth) = (sketch.basis.force, sketch.basis.depth);
    let period = sketch.period * sketch.draw.spread(0.3, 3.0);
    // For a flat punch and a list of heights, a radius does not determine the indentation.
    let round = !matches!(sketch.basis.name, "flat" | "heights");
    match sketch.draw.below(20) {
        0..=8 => json!({ "force": force }),
        9 | 10 => json!({ "indentation": depth }),
        11 if round => json!({ "radius": sketch.basis.interface.profile().radius(depth) }),
        12..=15 => {
            // Sometimes the load falls to 0 and returns.
            let stroke = if sketch.draw.chance(0.15) { 2.0 } else { sketch.draw.between(0.1, 1.9) };
            json!({ "force": sketch.follows_above(name, stroke * force, period, force) })
        }
        16 | 17 => {
            let stroke = sketch.share() * depth;
            json!({ "indentation": sketch.follows_above(name, stroke, period, depth) })
        }
        18 => json!({ "indentation": sketch.follows(name, 2.0 * depth, period) }),
        19 if round => {
            let radius = sketch.basis.interface.profile().radius(depth);
            let stroke = sketch.share() * radius;
            json!({ "radius": sketch.follows_above(name, stroke, period, radius) })
        }
        _ => json!({ "force": force }),
    }
}

impl Sketch {
    /// Draws a peak-to-peak value relative to the mean.
    fn share(&mut self) -> f64 {
        self.draw.between(0.1, 1.8)
    }

    /// Adds a contact with a prescribed normal load, sometimes with an initial tangential load. Returns the number of identical contacts.
    fn pressed(&mut self, between: [&str; 2], name: &str) -> u64 {
        let count = 1 + self.draw.below(3);
        let normal = normal(self, &format!("{name} press"));
        let constant = normal.get("force").is_some_and(Value::is_number);
        let mut contact = self.contact(between, &normal, count);
        if constant && !self.settled && self.draw.chance(0.2) {
            contact["start"] = if self.draw.chance(0.5) {
                json!({ "force": self.draw.between(-0.8, 0.8) * self.basis.hold() })
            } else {
                json!({ "displacement": self.draw.between(-0.8, 0.8) * self.basis.length })
            };
        }
        Self::add(&mut self.contacts, name, contact);
        count
    }

    /// Adds a body that is free along the slide.
    fn free(&mut self, name: &str, mass: f64) {
        let mut start = Map::new();
        self.start_along(&mut start);
        let mut body = json!({ "mass": mass, "x": "free" });
        if !start.is_empty() {
            body["start"] = Value::Object(start);
        }
        Self::add(&mut self.bodies, name, body);
    }

    /// Sometimes adds a spring and damper to the ground, a constant or varying load, an incline, or a second contact with the ground.
    fn surroundings(&mut self, name: &str, mass: f64, stuck: f64, hold: f64) {
        if self.draw.chance(0.3) {
            let stiffness = if self.draw.chance(0.2) { 0.0 } else { stuck * self.draw.spread(0.01, 1.0) };
            let damping = if self.draw.chance(0.6) {
                Self::damper(self.draw.spread(1e-3, 0.7), stuck, mass)
            } else {
                0.0
            };
            if stiffness + damping > 0.0 {
                let preload = if self.draw.chance(0.3) { 0.2 * hold * self.draw.sign() } else { 0.0 };
                let tie = json!({ "between": ["ground", name], "direction": "x", "stiffness": stiffness,
                    "damping": damping, "preload": preload });
                Self::add(&mut self.springs, &format!("{name} tie"), tie);
            }
        }
        if self.draw.chance(0.3) {
            self.loads.push(json!({ "on": name, "x": self.draw.between(-0.6, 0.6) * hold }));
        }
        if self.draw.chance(0.2) {
            let period = self.period * self.draw.spread(0.3, 3.0);
            let stroke = self.draw.between(0.1, 1.5) * hold;
            let wind = self.follows(&format!("{name} wind"), stroke, period);
            self.loads.push(json!({ "on": name, "x": wind }));
        }
        if self.gravity.is_none() && hold > 0.0 && self.draw.chance(0.2) {
            // At most an incline on which friction holds the body.
            let most = math::asin((0.7 * hold / (mass * GRAVITY)).min(1.0));
            self.gravity = Some(json!({ "incline": self.draw.between(-1.0, 1.0) * most }));
        }
        if self.draw.chance(0.25) {
            self.guide(name, hold);
        }
    }

    /// Adds a second contact between a body and the ground, with another profile and pair.
    fn guide(&mut self, name: &str, hold: f64) {
        let Some(other) = Basis::draw(&mut self.draw) else { return };
        let force = if other.friction > 0.0 && hold > 0.0 {
            self.draw.between(0.05, 0.5) * hold / other.friction
        } else {
            other.force
        };
        let [first, second] = other.materials;
        let contact = json!({ "between": ["ground", name], "materials": [first, second], "profile": other.profile,
            "friction": other.friction, "normal": { "force": force } });
        Self::add(&mut self.contacts, &format!("{name} guide"), contact);
    }
}

/// Draws a slider on one or two contacts of a foot that follows a waveform.
pub(super) fn slider(sketch: &mut Sketch) {
    let drive = sketch.follows("drive", sketch.stroke, sketch.period);
    Sketch::add(&mut sketch.bodies, "foot", json!({ "x": drive }));
    let count = sketch.pressed(["foot", "slider"], "ball") as f64;
    if sketch.draw.chance(0.25) {
        sketch.pressed(["foot", "slider"], "heel");
    }
    let stuck = count * sketch.basis.stick;
    let mass = Sketch::mass(stuck, sketch.frequency);
    sketch.free("slider", mass);
    let hold = count * sketch.basis.hold();
    sketch.surroundings("slider", mass, stuck, hold);
}

/// Draws a slider on a foot with mass, on a stack whose free stroke follows a waveform.
pub(super) fn stack(sketch: &mut Sketch) {
    let damped = sketch.draw.chance(0.6);
    if damped {
        sketch.course = Course::Continuous;
    }
    let drive = sketch.follows("drive", sketch.stroke, sketch.period);
    let count = sketch.pressed(["foot", "slider"], "ball") as f64;
    let stuck = count * sketch.basis.stick;
    let mass = Sketch::mass(stuck, sketch.frequency);
    let foot = mass * sketch.draw.spread(0.2, 3.0);
    let stiffness = stuck * sketch.draw.spread(0.5, 30.0);
    let mut stack =
        json!({ "between": ["ground", "foot"], "direction": "x", "stiffness": stiffness, "stroke": drive });
    if damped {
        stack["damping"] = json!(Sketch::damper(sketch.draw.spread(0.01, 0.7), stiffness, foot));
    }
    Sketch::add(&mut sketch.actuators, "stack", stack);
    sketch.free("foot", foot);
    sketch.free("slider", mass);
    // The stack has a higher natural frequency than the contact, which shortens the run.
    sketch.frequency *= (stiffness / stuck * mass / foot).sqrt().max(1.0);
    let hold = count * sketch.basis.hold();
    sketch.surroundings("slider", mass, stuck, hold);
}

/// Draws a foot and one to three sliders, each on the previous body, or beside it and connected by a spring.
pub(super) fn chain(sketch: &mut Sketch) {
    let drive = sketch.follows("drive", sketch.stroke, sketch.period);
    Sketch::add(&mut sketch.bodies, "foot", json!({ "x": drive }));
    let mut last = "foot";
    for (place, name) in ["first", "second", "third"].into_iter().enumerate() {
        if place > 1 && sketch.draw.chance(0.5) {
            break;
        }
        let tied = place > 0 && sketch.draw.chance(0.4);
        let below = if tied { "foot" } else { last };
        let count = sketch.pressed([below, name], &format!("{name} ball")) as f64;
        let stuck = count * sketch.basis.stick;
        let mass = Sketch::mass(stuck, sketch.frequency) * sketch.draw.spread(0.5, 2.0);
        sketch.free(name, mass);
        if tied {
            let stiffness = stuck * sketch.draw.spread(0.01, 0.5);
            let damping = if sketch.draw.chance(0.5) { Sketch::damper(0.05, stiffness, mass) } else { 0.0 };
            let spring = json!({ "between": [last, name], "direction": "x", "stiffness": stiffness,
                "damping": damping });
            Sketch::add(&mut sketch.springs, &format!("{name} link"), spring);
        }
        let hold = count * sketch.basis.hold();
        if sketch.draw.chance(0.4) {
            sketch.surroundings(name, mass, stuck, hold);
        }
        last = name;
    }
}

/// Draws two bodies that follow waveforms, with one or two contacts between them.
pub(super) fn walk(sketch: &mut Sketch) {
    sketch.settled = false;
    let drive = sketch.follows("drive", sketch.stroke, sketch.period);
    let mut foot = json!({ "x": drive });
    let coupled = sketch.draw.chance(0.4);
    if coupled {
        let stroke = sketch.share() * sketch.basis.depth;
        let period = sketch.period * sketch.draw.spread(0.3, 3.0);
        foot["z"] = sketch.follows("lift", stroke, period);
    }
    Sketch::add(&mut sketch.bodies, "foot", foot);
    if coupled {
        let mut contact = sketch.contact(["foot", "ground"], &json!("coupled"), 1);
        contact["gap"] = json!(-sketch.basis.depth * sketch.draw.between(-0.3, 1.0));
        Sketch::add(&mut sketch.contacts, "ball", contact);
    } else {
        sketch.pressed(["foot", "ground"], "ball");
    }
}
