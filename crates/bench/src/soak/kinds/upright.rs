//! Scenarios in the plane with coupled normal motion.

use crate::soak::sketch::{GRAVITY, Sketch};
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;

/// Body with the load on its contacts.
struct Pressed {
    /// Mass, kg.
    mass: f64,
    /// Number of identical contacts that carry the body.
    count: u64,
}

impl Sketch {
    /// Adds weight, a load or a spring that press a body with the basis force on each contact.
    fn press(&mut self, name: &str, contacts: f64) -> Pressed {
        let count = 1 + self.draw.below(2);
        let carried = contacts * count as f64;
        let force = carried * self.basis.force;
        let heavy = self.draw.chance(0.3);
        let mass =
            if heavy { force / GRAVITY } else { Self::mass(carried * self.basis.normal, self.frequency) };
        if heavy {
            self.frequency = (carried * self.basis.normal / mass).sqrt() / TAU;
            self.period = self.draw.spread(0.3, 15.0) / self.frequency;
            self.gravity = Some(json!({}));
            return Pressed { mass, count };
        }
        if self.draw.chance(0.3) {
            self.gravity = Some(json!({}));
        }
        match self.draw.below(4) {
            0 => self.loads.push(json!({ "on": name, "z": -force })),
            1 => {
                let period = self.period * self.draw.spread(0.3, 3.0);
                let swing = self.draw.between(0.1, 1.1) * force;
                let sine = json!({ "amplitude": swing, "offset": -force, "period": period,
                    "phase": self.draw.phase() });
                Self::add(&mut self.waveforms, &format!("{name} weight"), json!({ "sine": sine }));
                self.loads.push(json!({ "on": name, "z": { "follows": format!("{name} weight") } }));
            }
            _ => {
                let stiffness = carried * self.basis.normal * self.draw.spread(1e-4, 0.1);
                let damping = if self.draw.chance(0.5) {
                    Self::damper(self.draw.spread(1e-3, 0.5), carried * self.basis.normal, mass)
                } else {
                    0.0
                };
                let spring = json!({ "between": ["ground", name], "direction": "z", "stiffness": stiffness,
                    "damping": damping, "preload": -force });
                Self::add(&mut self.springs, &format!("{name} press"), spring);
            }
        }
        Pressed { mass, count }
    }

    /// Draws the initial state along the normal: in touch, slightly above, pressed to a depth, or thrown.
    fn start_upright(&mut self, start: &mut Map<String, Value>) {
        if self.settled {
            return;
        }
        let depth = self.basis.depth;
        let speed = depth * TAU * self.frequency;
        let height = match self.draw.below(6) {
            0 | 1 => 0.0,
            2 => depth * self.draw.spread(1e-3, 2.0),
            3 => -depth * self.draw.spread(1e-3, 1.0),
            4 => -depth,
            _ => -1e-9,
        };
        if height != 0.0 {
            start.insert("z".to_owned(), json!(height));
        }
        if self.draw.chance(0.25) {
            start.insert("vz".to_owned(), json!(self.draw.between(-1.5, 0.7) * speed));
        }
    }

    /// Adds a body that is free in the plane.
    fn upright(&mut self, name: &str, mass: f64, inertia: Option<f64>) {
        let mut start = Map::new();
        self.start_along(&mut start);
        self.start_upright(&mut start);
        let mut body = json!({ "mass": mass, "x": "free", "z": "free" });
        if let Some(inertia) = inertia {
            body["inertia"] = json!(inertia);
            body["pitch"] = json!("free");
        }
        if !start.is_empty() {
            body["start"] = Value::Object(start);
        }
        Self::add(&mut self.bodies, name, body);
    }

    /// Sometimes adds a spring or damper along the slide, a load, or an incline.
    fn pushed(&mut self, name: &str, mass: f64, hold: f64) {
        let stuck = self.basis.stick;
        if self.draw.chance(0.25) {
            let damping = if self.draw.chance(0.5) {
                Self::damper(self.draw.spread(1e-3, 0.5), stuck, mass)
            } else {
                0.0
            };
            let tie = json!({ "between": ["ground", name], "direction": "x",
                "stiffness": stuck * self.draw.spread(0.01, 0.5), "damping": damping });
            Self::add(&mut self.springs, &format!("{name} tie"), tie);
        }
        if self.draw.chance(0.25) {
            self.loads.push(json!({ "on": name, "x": self.draw.between(-0.5, 0.5) * hold }));
        }
        if self.draw.chance(0.2) && hold > 0.0 {
            let period = self.period * self.draw.spread(0.3, 3.0);
            let stroke = self.draw.between(0.1, 1.5) * hold;
            let shaker = self.follows(&format!("{name} shaker"), stroke, period);
            self.loads.push(json!({ "on": name, "x": shaker }));
        }
        if let (Some(gravity), true) = (&mut self.gravity, self.draw.chance(0.3)) {
            gravity["incline"] = json!(self.draw.between(-0.5, 0.5) * self.basis.friction.min(1.0));
        }
    }

    /// Adds a foot that moves along the slide, sometimes also vertically.
    fn foot(&mut self) {
        let mut foot = Map::new();
        let drive = self.follows("drive", self.stroke, self.period);
        foot.insert("x".to_owned(), drive);
        if self.draw.chance(0.35) {
            let stroke = self.draw.spread(0.02, 1.5) * self.basis.depth;
            let period = self.period * self.draw.spread(0.5, 2.0);
            let lift = self.follows("lift", stroke, period);
            foot.insert("z".to_owned(), lift);
        }
        Self::add(&mut self.bodies, "foot", Value::Object(foot));
    }
}

/// Draws a slider on a moving foot, pressed by weight, load or spring.
pub(super) fn planar(sketch: &mut Sketch) {
    let Pressed { mass, count } = sketch.press("slider", 1.0);
    sketch.foot();
    let contact = sketch.contact(["foot", "slider"], &json!("coupled"), count);
    Sketch::add(&mut sketch.contacts, "ball", contact);
    sketch.upright("slider", mass, None);
    let hold = count as f64 * sketch.basis.hold();
    sketch.pushed("slider", mass, hold);
}

/// Draws a slider on two separate contacts, free to rock.
pub(super) fn rocking(sketch: &mut Sketch) {
    let Pressed { mass, count } = sketch.press("slider", 2.0);
    let grounded = sketch.draw.chance(0.3);
    if !grounded {
        sketch.foot();
    }
    let arm = sketch.draw.spread(1e-3, 2e-2);
    let below = -arm * sketch.draw.between(0.0, 1.5);
    let first = if grounded { "ground" } else { "foot" };
    for (name, side) in [("left", -1.0), ("right", 1.0)] {
        let mut contact = sketch.contact([first, "slider"], &json!("coupled"), count);
        // The arms differ in most scenarios, because events of symmetric contacts always coincide.
        let reach = if sketch.draw.chance(0.5) { arm } else { arm * sketch.draw.between(0.7, 1.3) };
        contact["at"] = json!({ "slider": { "x": side * reach, "z": below } });
        Sketch::add(&mut sketch.contacts, name, contact);
    }
    let inertia = mass * arm * arm * sketch.draw.spread(0.3, 3.0);
    sketch.upright("slider", mass, Some(inertia));
    let hold = 2.0 * count as f64 * sketch.basis.hold();
    sketch.pushed("slider", mass, hold);
}

/// Draws a body released above, on or in the ground, which bounces, rolls or comes to rest.
pub(super) fn ball(sketch: &mut Sketch) {
    let Pressed { mass, count } = sketch.press("ball", 1.0);
    let mut contact = sketch.contact(["ground", "ball"], &json!("coupled"), count);
    let inertia = sketch.draw.chance(0.4).then(|| {
        let radius = sketch.draw.spread(1e-3, 1e-2);
        contact["at"] = json!({ "ball": { "z": -radius } });
        0.4 * mass * radius * radius
    });
    Sketch::add(&mut sketch.contacts, "foot", contact);
    sketch.upright("ball", mass, inertia);
    let hold = count as f64 * sketch.basis.hold();
    sketch.pushed("ball", mass, hold);
}

/// Draws two bodies on top of each other on a moving foot.
pub(super) fn pile(sketch: &mut Sketch) {
    let Pressed { mass, count } = sketch.press("upper", 1.0);
    sketch.foot();
    let lower = mass * sketch.draw.spread(0.3, 3.0);
    for (name, between) in [("ball", ["foot", "lower"]), ("second ball", ["lower", "upper"])] {
        let contact = sketch.contact(between, &json!("coupled"), count);
        Sketch::add(&mut sketch.contacts, name, contact);
    }
    sketch.upright("lower", lower, None);
    sketch.upright("upper", mass, None);
    let hold = count as f64 * sketch.basis.hold();
    sketch.pushed("upper", mass, hold);
}
