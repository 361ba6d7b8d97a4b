//! Scenario under construction, as JSON.

use super::basis::Basis;
use super::course::{Course, waveform};
use super::draw::Draw;
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;

/// Maximum number of periods of the fastest oscillation in a run, which limits its cost.
const SWINGS: f64 = 30.0;
/// Standard gravity, m/s².
pub(super) const GRAVITY: f64 = 9.80665;

/// Scales of the scenario and parts of its file.
pub(super) struct Sketch {
    pub(super) draw: Draw,
    pub(super) basis: Basis,
    /// Frequency of small oscillations on the first contact, Hz.
    pub(super) frequency: f64,
    /// Period of the drive, s.
    pub(super) period: f64,
    /// Stroke of the drive, peak to peak, m.
    pub(super) stroke: f64,
    /// Whether the run starts from an equilibrium.
    pub(super) settled: bool,
    /// Restriction of waveforms: jumps are not allowed if a damper could follow them.
    pub(super) course: Course,
    pub(super) title: String,
    pub(super) waveforms: Map<String, Value>,
    pub(super) bodies: Map<String, Value>,
    pub(super) contacts: Map<String, Value>,
    pub(super) springs: Map<String, Value>,
    pub(super) actuators: Map<String, Value>,
    pub(super) loads: Vec<Value>,
    pub(super) gravity: Option<Value>,
}

impl Sketch {
    /// Returns a scenario without parts.
    pub(super) fn new(seed: u64) -> Self {
        let mut draw = Draw::new(seed);
        let basis = loop {
            if let Some(basis) = Basis::draw(&mut draw) {
                break basis;
            }
        };
        let frequency = draw.spread(300.0, 3e4);
        let period = draw.spread(0.3, 15.0) / frequency;
        let stroke = draw.spread(0.2, 8.0) * basis.length;
        let settled = draw.chance(0.35);
        let course = if draw.chance(0.5) { Course::Any } else { Course::Continuous };
        Self {
            title: format!("seed {seed}: {}", basis.name),
            draw,
            basis,
            frequency,
            period,
            stroke,
            settled,
            course,
            waveforms: Map::new(),
            bodies: Map::new(),
            contacts: Map::new(),
            springs: Map::new(),
            actuators: Map::new(),
            loads: Vec::new(),
            gravity: None,
        }
    }

    /// Adds a part to a map under a name.
    pub(super) fn add(map: &mut Map<String, Value>, name: &str, part: Value) {
        map.insert(name.to_owned(), part);
    }

    /// Adds a waveform of this stroke and returns the reference to it.
    pub(super) fn follows(&mut self, name: &str, stroke: f64, period: f64) -> Value {
        let form = waveform(&mut self.draw, self.course, stroke, period, 0.0);
        self.course_of(name, form)
    }

    /// Adds a waveform that is never negative and returns the reference to it.
    pub(super) fn follows_above(&mut self, name: &str, stroke: f64, period: f64, mean: f64) -> Value {
        let form = waveform(&mut self.draw, Course::Above, stroke, period, mean);
        self.course_of(name, form)
    }

    fn course_of(&mut self, name: &str, form: Value) -> Value {
        Self::add(&mut self.waveforms, name, form);
        json!({ "follows": name })
    }

    /// Returns the mass, kg, with a natural frequency, Hz, on a stiffness, N/m.
    pub(super) fn mass(stiffness: f64, frequency: f64) -> f64 {
        stiffness / (TAU * frequency).powi(2)
    }

    /// Returns the damping, N s/m, of a damping ratio on a stiffness, N/m, with a mass, kg.
    pub(super) fn damper(ratio: f64, stiffness: f64, mass: f64) -> f64 {
        2.0 * ratio * (stiffness * mass).sqrt()
    }

    /// Returns a contact between two bodies with a normal load, and with the pair and profile of the first contact.
    pub(super) fn contact(&mut self, between: [&str; 2], normal: &Value, count: u64) -> Value {
        let [first, second] = self.basis.materials;
        let mut contact = json!({
            "between": between,
            "materials": [first, second],
            "profile": self.basis.profile,
            "friction": self.basis.friction,
            "normal": normal,
            "count": count,
        });
        if self.draw.chance(0.2) {
            contact["damping"] = json!(self.draw.spread(1e-3, 0.3) / (TAU * self.frequency));
        }
        if self.draw.chance(0.25) {
            contact["engine"] = json!({ "springs": { "count": 16 + self.draw.below(241) } });
        }
        contact
    }

    /// Sometimes draws initial velocity and position along the slide, unless the run starts from an equilibrium.
    pub(super) fn start_along(&mut self, start: &mut Map<String, Value>) {
        if self.settled {
            return;
        }
        if self.draw.chance(0.3) {
            let speed = self.basis.length * TAU * self.frequency;
            start.insert("vx".to_owned(), json!(self.draw.sign() * self.draw.spread(0.05, 3.0) * speed));
        }
        if self.draw.chance(0.2) {
            start.insert("x".to_owned(), json!(self.draw.between(-2.0, 2.0) * self.basis.length));
        }
    }

    /// Returns the text of the file, with a duration of some drive periods.
    pub(super) fn text(mut self) -> String {
        let duration = (self.draw.between(1.2, 4.0) * self.period).min(SWINGS / self.frequency);
        let start = if self.settled { "equilibrium" } else { "given" };
        let mut scenario = json!({
            "stickslip": 1,
            "title": self.title,
            "materials": Basis::materials(&self.contacts),
            "waveforms": self.waveforms,
            "bodies": self.bodies,
            "contacts": self.contacts,
            "springs": self.springs,
            "actuators": self.actuators,
            "loads": self.loads,
            "run": { "duration": duration, "start": start, "stepper": { "event": { "tolerance": 1e-8 } } },
            "output": { "every": duration / 60.0 },
        });
        if let Some(gravity) = self.gravity {
            scenario["gravity"] = gravity;
        }
        format!("{scenario:#}\n")
    }
}
