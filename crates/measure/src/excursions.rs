//! Detects rotation, rolling and falling of bodies beyond the validity of the model's kinematics.
//!
//! The model assumes small angles and contact points that are fixed on their bodies. For bodies that can rotate or lift off, the extremes
//! over all rows and events are kept.

use crate::Setting;
use crate::warning::Warning;
use std::collections::HashMap;
use stickslip_drive::scene::{Freedom, SMALL_ANGLE, Scene, Side};
use stickslip_quantity::Real;
use stickslip_quantity::quantity;

/// Channel indices by name.
type Places<'a> = HashMap<&'a str, usize>;

/// Extremes of rotation, rolling and falling during a run.
pub struct Excursions {
    turns: Vec<Turn>,
    rolls: Vec<Roll>,
    falls: Vec<Fall>,
}

/// A body that rotates.
struct Turn {
    body: usize,
    /// Channel index of the pitch of the body.
    place: usize,
    /// Largest magnitude of the pitch, rad.
    most: f64,
}

/// A contact with a rotating body.
struct Roll {
    contact: usize,
    /// Channel indices of `d_m` and `a_m`.
    places: [usize; 2],
    /// Channel indices of the pitches of both bodies. `None` for a body that does not rotate.
    pitches: [Option<usize>; 2],
    /// Smallest and largest angle between both bodies since the contact closed, rad.
    range: [f64; 2],
    /// Largest indentation since the contact closed, m, and contact radius at this time, m.
    deepest: [f64; 2],
    /// Rolled distance between closing and opening of the contact, m, and contact radius, m, for the largest ratio of both.
    worst: [f64; 2],
}

/// A body that is supported by contacts only.
struct Fall {
    body: usize,
    /// Channel index of z, and sign of the direction of gravity along z: 1 down, -1 up.
    place: usize,
    down: f64,
    contacts: Vec<Catch>,
    /// Height of the reference point of the body above the contact points, or the largest contact radius if it is larger, m.
    height: f64,
    /// Largest distance of the body below the position at which its contacts close, while all contacts are open, m.
    farthest: f64,
}

/// A supporting contact of a body.
struct Catch {
    /// Channel indices of `d_m` and `a_m`.
    places: [usize; 2],
    /// Channel index of z of the supporting body. `None` if the supporting body does not move.
    other: Option<usize>,
    /// Height of the body relative to the supporting body when the contact closes, m.
    level: f64,
}

impl Excursions {
    /// Creates the detection for a model.
    pub fn new(setting: &Setting, places: &Places<'_>) -> Self {
        let scene = &setting.scenario.scene;
        let place = |name: &str, quantity: &str| places.get(format!("{name}.{quantity}").as_str()).copied();
        let pitch = |body: usize| scene.bodies.get(body).and_then(|body| place(&body.name, "pitch_rad"));
        let turns =
            (0..scene.bodies.len()).filter_map(|body| Some(Turn { body, place: pitch(body)?, most: 0.0 }));
        let depths = |c: usize| {
            let name = &scene.contacts.get(c)?.name;
            Some([place(name, "d_m")?, place(name, "a_m")?])
        };
        let rolls = scene.contacts.iter().enumerate().filter_map(|(contact, it)| {
            let pitches = it.part.between.map(|side| body_of(side).and_then(pitch));
            pitches.iter().any(Option::is_some).then_some(())?;
            Some(Roll::new(contact, depths(contact)?, pitches))
        });
        let falls = (0..scene.bodies.len()).filter_map(|body| {
            let caught = scene.contacts.iter().enumerate().filter_map(|(c, it)| {
                let own = it.part.between.iter().position(|side| *side == Side::Body(body))?;
                let other = body_of(it.part.between[1 - own]).and_then(|other| scene.bodies.get(other));
                let other = other.and_then(|other| place(&other.name, "z_m"));
                let level = if own == 0 { it.part.gap } else { -it.part.gap };
                Some((Catch { places: depths(c)?, other, level }, it.part.at[own].z.abs()))
            });
            Fall::of(scene, body, place(&scene.bodies.get(body)?.name, "z_m")?, caught)
        });
        Self { turns: turns.collect(), rolls: rolls.collect(), falls: falls.collect() }
    }

    /// Adds a row of all channels.
    pub fn row(&mut self, values: &[f64]) {
        let at = |place: usize| values.get(place).copied().unwrap_or(0.0);
        for turn in &mut self.turns {
            turn.most = turn.most.max(at(turn.place).abs());
        }
        self.rolls.iter_mut().for_each(|roll| roll.row(at));
        self.falls.iter_mut().for_each(|fall| fall.row(at));
    }

    /// Returns at most one warning each about rotation, rolling and falling, for the body or contact with the largest excess.
    pub fn warnings(&self, setting: &Setting) -> impl Iterator<Item = Warning> {
        [self.angle(setting), self.rolling(setting), self.fall(setting)].into_iter().flatten()
    }

    fn angle(&self, setting: &Setting) -> Option<Warning> {
        let turn = self
            .turns
            .iter()
            .max_by(|a, b| a.most.total_cmp(&b.most))
            .filter(|turn| turn.most > SMALL_ANGLE)?;
        let name = &setting.scenario.scene.bodies.get(turn.body)?.name;
        let [angle, small] = [turn.most, SMALL_ANGLE].map(|angle| quantity(Real(angle), "rad"));
        let message = format!(
            "{name} rotates by {angle}, beyond the limit of small angles, {small}: its points move along \
             straight lines instead of arcs, with an error of θ²/2 of their lever arms"
        );
        let help = "reduce its initial velocity or its load, add a second contact or a spring, or simulate a shorter time";
        Some(Warning::new("angle", message).help(help))
    }

    fn rolling(&self, setting: &Setting) -> Option<Warning> {
        let all = self.rolls.iter().map(|roll| (roll.contact, roll.farthest()));
        let (contact, [way, radius]) = all.max_by(|a, b| ratio(a.1).total_cmp(&ratio(b.1)))?;
        let name = &setting.scenario.scene.contacts.get(contact).filter(|_| way > radius)?.name;
        let [way, radius] = [way, radius].map(|length| quantity(Real(length), "m"));
        let message = format!(
            "{name} rolls by {way}, more than its contact radius of {radius}: the model keeps the contact on \
             the same points of the bodies, so its slip memory is wrong"
        );
        Some(
            Warning::new("rolling", message)
                .help("tangential force and friction work are not reliable while the contact rolls"),
        )
    }

    fn fall(&self, setting: &Setting) -> Option<Warning> {
        let through = self.falls.iter().filter(|fall| fall.farthest > fall.height);
        let fall = through.max_by(|a, b| a.farthest.total_cmp(&b.farthest))?;
        let name = &setting.scenario.scene.bodies.get(fall.body)?.name;
        let [descent, height] = [fall.farthest, fall.height].map(|length| quantity(Real(length), "m"));
        let message = format!(
            "{name} falls through the ground or its support: it was {descent} below the position at which \
             its contacts close, more than its height of {height} above them, and all contacts were open"
        );
        let help = "bodies touch only at their contacts: add a contact below the body, or a spring; check its rotation";
        Some(Warning::new("through_ground", message).help(help))
    }
}

impl Roll {
    fn new(contact: usize, places: [usize; 2], pitches: [Option<usize>; 2]) -> Self {
        let range = [f64::INFINITY, f64::NEG_INFINITY];
        Self { contact, places, pitches, range, deepest: [0.0; 2], worst: [0.0; 2] }
    }

    fn row(&mut self, at: impl Fn(usize) -> f64) {
        let [d, a] = self.places.map(&at);
        if d <= 0.0 {
            *self = Self { worst: self.farthest(), ..Self::new(self.contact, self.places, self.pitches) };
            return;
        }
        let [first, second] = self.pitches.map(|place| place.map_or(0.0, &at));
        let angle = second - first;
        self.range = [self.range[0].min(angle), self.range[1].max(angle)];
        if d > self.deepest[0] {
            self.deepest = [d, a];
        }
    }

    /// Returns the largest rolled distance between closing and opening of the contact, m, and the contact radius, m.
    ///
    /// The distance is the angle times a²/d, the radius of curvature of a ball. For edges and tips, too, the contact has left its initial
    /// point when this distance equals a.
    fn farthest(&self) -> [f64; 2] {
        let [d, a] = self.deepest;
        let now = [(self.range[1] - self.range[0]) * a * a / d, a];
        if d > 0.0 && ratio(now) > ratio(self.worst) { now } else { self.worst }
    }
}

impl Fall {
    /// Creates the fall detection of a body that is free along z and on which gravity acts along z.
    ///
    /// Returns `None` if a spring or an actuator holds the body. `contacts` are the contacts of the body and their heights.
    fn of(
        scene: &Scene,
        body: usize,
        place: usize,
        contacts: impl Iterator<Item = (Catch, f64)>,
    ) -> Option<Self> {
        let springs = scene.springs.iter().map(|spring| spring.part.between);
        let mut links = springs.chain(scene.actuators.iter().map(|actuator| actuator.part.between));
        let (_, down) = scene.gravity.components();
        let is_free = scene.bodies.get(body)?.part.z.freedom == Freedom::Free && down != 0.0;
        let (contacts, heights): (Vec<_>, Vec<_>) = contacts.unzip();
        let can_fall =
            is_free && !contacts.is_empty() && !links.any(|between| between.contains(&Side::Body(body)));
        let height = heights.into_iter().fold(0.0, f64::max);
        let fall = Self { body, place, down: down.signum(), contacts, height, farthest: 0.0 };
        can_fall.then_some(fall)
    }

    fn row(&mut self, at: impl Fn(usize) -> f64) {
        let mut descent = f64::INFINITY;
        for Catch { places: [depth, radius], other, level } in &self.contacts {
            let below = self.down * (level + other.map_or(0.0, &at) - at(self.place));
            descent = descent.min(if at(*depth) > 0.0 { 0.0 } else { below });
            self.height = self.height.max(at(*radius));
        }
        self.farthest = self.farthest.max(descent);
    }
}

/// Returns a distance divided by a length, or 0 if the length is 0.
fn ratio([way, length]: [f64; 2]) -> f64 {
    if length > 0.0 { way / length } else { 0.0 }
}

fn body_of(side: Side) -> Option<usize> {
    match side {
        Side::Body(body) => Some(body),
        Side::Ground => None,
    }
}
