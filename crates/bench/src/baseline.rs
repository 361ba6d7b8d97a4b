//! Reference implementations that a user might write: fixed-step loops over rows of springs or with the exact contact law, and an external
//! integrator with its own event location.
//!
//! All use a [`Mechanism`], which is made from a model. The reference implementations share no force law, time integration or event
//! location with the program. Moduli, profiles and the initial memory come from the program.

mod events;
mod fixed;
mod form;

pub(crate) use events::Outside;
pub(crate) use fixed::{Exact, Fixed, Half};

use crate::norm;
use form::Form;
use stickslip_contact::{Curve, Interface, Memory};
use stickslip_drive::scene::{Axis, Direction, Named, Normal, Varying};
use stickslip_drive::{Model, Scene, State, Waveform};

/// Model for the reference implementations: masses, constant forces and contacts.
#[derive(Debug, Clone)]
pub(crate) struct Mechanism {
    /// Free coordinates in their order.
    free: Vec<Free>,
    ties: Vec<Tie>,
    /// Prescribed quantities: first the waveforms in the order of the model, then indentations that follow a waveform.
    tracks: Vec<Track>,
}

/// Prescribed quantity: a waveform, or an indentation that follows a waveform.
#[derive(Debug, Clone)]
struct Track {
    waveform: Waveform,
    /// Contact law and normal load, if the quantity is an indentation.
    pressed: Option<(Interface, Normal)>,
}

/// Free coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Free {
    /// Mass, kg, or moment of inertia, kg m².
    mass: f64,
    /// Constant force, N, or moment, N m.
    force: f64,
    /// Initial position and velocity.
    start: (f64, f64),
}

/// Contact.
#[derive(Debug, Clone)]
struct Tie {
    law: Interface,
    /// Number of identical contacts.
    count: f64,
    /// Tangential displacement u.
    slide: Form,
    /// Indentation d, from the bodies or a prescribed quantity; `None` if constant.
    press: Option<Form>,
    /// Initial slip memory.
    start: Curve,
}

impl Mechanism {
    /// Converts a model in its initial state. The error names a feature that the reference implementations do not support.
    pub(crate) fn new(scene: &Scene, model: &Model, start: &State) -> Result<Self, String> {
        refuse(scene)?;
        let coordinates = norm::coordinates(scene);
        let places: Vec<(usize, Axis)> = coordinates.iter().map(|c| (c.body, c.axis)).collect();
        let mut free = Vec::new();
        for (body, axis) in &places {
            let part = &scene.bodies[*body].part;
            let mass = if *axis == Axis::Pitch { part.inertia } else { part.mass };
            let start = start.coordinate(model, *body, *axis).ok_or("a coordinate without a start")?;
            let mass = mass.ok_or("a body without mass")?;
            free.push(Free { mass, force: force(scene, *body, *axis, mass), start });
        }
        let track = |named: &Named<Waveform>| Track { waveform: named.part.clone(), pressed: None };
        let mut tracks: Vec<Track> = scene.waveforms.iter().map(track).collect();
        let mut ties = Vec::new();
        for ((named, (_, law)), memory) in scene.contacts.iter().zip(model.contacts()).zip(start.memories()) {
            let Memory::Curve(curve) = memory else { return Err("a row of springs".to_owned()) };
            let form = |direction| Form::new(scene, &places, &named.part, direction);
            let normal = named.part.normal;
            let press = match (normal, follows(normal)) {
                (Normal::Coupled, _) => Some(form(Direction::Z).less(named.part.gap)),
                (_, Some(w)) => {
                    let pressed = Some((law.clone(), normal));
                    tracks.push(Track { waveform: scene.waveforms[w].part.clone(), pressed });
                    Some(Form::follow(tracks.len() - 1, places.len()))
                }
                _ => None,
            };
            ties.push(Tie {
                law: law.clone(),
                count: f64::from(named.part.count),
                slide: form(Direction::X),
                press,
                start: curve.clone(),
            });
        }
        Ok(Self { free, ties, tracks })
    }

    /// Returns a row of springs for each contact. The number of springs is a multiple of 64. `spans` are the lengths of the rows, m; the
    /// default is the initial width of the contact.
    pub(crate) fn rows(&self, springs: usize, spans: &[Option<f64>]) -> Vec<Half> {
        let width = |tie: &Tie| 2.0 * tie.law.profile().radius(tie.start.apex().d);
        let row =
            |(tie, span): (&Tie, &Option<f64>)| Half::new(tie, springs, span.unwrap_or_else(|| width(tie)));
        self.ties.iter().zip(spans).map(row).collect()
    }

    /// Returns the exact law of each contact. The error names an unsupported feature.
    pub(crate) fn exact(&self) -> Result<Vec<Exact>, String> {
        self.ties.iter().map(Exact::new).collect()
    }

    /// Returns whether all indentations are constant.
    pub(crate) fn has_constant_loads(&self) -> bool {
        self.ties.iter().all(|tie| tie.press.is_none())
    }
}

/// Returns the waveform of the normal load.
fn follows(normal: Normal) -> Option<usize> {
    match normal {
        Normal::Force(Varying::Follows(w))
        | Normal::Indentation(Varying::Follows(w))
        | Normal::Radius(Varying::Follows(w)) => Some(w),
        _ => None,
    }
}

impl Track {
    /// Returns the value at time t, m.
    fn place(&self, t: f64) -> f64 {
        let value = self.waveform.sample(&self.waveform.piece_at(t), t).value;
        match &self.pressed {
            None | Some((_, Normal::Coupled | Normal::Indentation(_))) => value,
            Some((law, Normal::Force(_))) => law.indentation(value.max(0.0)),
            Some((law, Normal::Radius(_))) => law.profile().depth(value.max(0.0)),
        }
    }
}

/// Refuses features that the reference implementations do not support.
fn refuse(scene: &Scene) -> Result<(), String> {
    let varies = |value: Varying| matches!(value, Varying::Follows(_));
    let outside = [
        (!scene.springs.is_empty(), "springs"),
        (!scene.actuators.is_empty(), "actuators"),
        (
            scene.loads.iter().any(|load| [load.x, load.z, load.pitch].into_iter().any(varies)),
            "varying loads",
        ),
        (scene.contacts.iter().any(|contact| contact.part.interface.damping() != 0.0), "damped contacts"),
        (scene.waveforms.iter().any(|waveform| waveform.part.has_jumps()), "waveforms with jumps"),
    ];
    outside.into_iter().find(|(is, _)| *is).map_or(Ok(()), |(_, what)| Err(what.to_owned()))
}

/// Returns gravity and constant loads on a free coordinate, N or N m.
fn force(scene: &Scene, body: usize, axis: Axis, mass: f64) -> f64 {
    let weight = -mass * scene.gravity.acceleration;
    let (along, normal) = math::sin_cos(scene.gravity.incline);
    let constant = |value: Varying| if let Varying::Constant(value) = value { value } else { 0.0 };
    let loads = scene.loads.iter().filter(|load| load.on == body).map(|load| {
        let (x, z) = (constant(load.x), constant(load.z));
        match axis {
            Axis::X => x,
            Axis::Z => z,
            Axis::Pitch => constant(load.pitch) + load.at.x * z - load.at.z * x,
        }
    });
    let gravity = match axis {
        Axis::X => weight * along,
        Axis::Z => weight * normal,
        Axis::Pitch => 0.0,
    };
    gravity + loads.sum::<f64>()
}
