//! Numeric parameters of a scenario that sweeps set directly, without reading the scenario file again. [`stickslip_scenario::Parameter`] is
//! the general form for any key of the file.

use crate::sketch::{Quantity, Sketch};
use std::fmt;
use stickslip_contact::FrictionError;
use stickslip_drive::scene::{Axis, ContactStart, Load, Named, Normal, Varying};
use stickslip_drive::{Scene, WaveformError};
use thiserror::Error;

/// A parameter of a scenario in SI units, identified by the index of its part. The key path, such as `bodies.slider.mass`, is resolved
/// once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Number {
    /// `bodies.NAME.mass`, kg, including mass from attached piezo stacks.
    Mass(usize),
    /// `bodies.NAME.inertia`, kg m².
    Inertia(usize),
    /// `bodies.NAME.start.x`, `.z` and `.pitch`: initial position of a free coordinate, m or rad.
    Position(usize, Axis),
    /// `bodies.NAME.start.vx`, `.vz` and `.vpitch`: initial velocity, m/s or rad/s.
    Velocity(usize, Axis),
    /// `contacts.NAME.friction`: coefficient of friction.
    Friction(usize),
    /// `contacts.NAME.normal.force` (N), `.indentation` (m) or `.radius` (m): the constant key that the contact has.
    Normal(usize),
    /// `contacts.NAME.gap`, m.
    Gap(usize),
    /// `contacts.NAME.start.force` (N) or `.displacement` (m): the key that the contact has.
    Preload(usize),
    /// `springs.NAME.stiffness`, N/m.
    SpringStiffness(usize),
    /// `springs.NAME.damping`, N s/m.
    SpringDamping(usize),
    /// `springs.NAME.preload`, N.
    SpringPreload(usize),
    /// `actuators.NAME.stiffness`, N/m.
    ActuatorStiffness(usize),
    /// `actuators.NAME.damping`, N s/m.
    ActuatorDamping(usize),
    /// `loads[INDEX].x`, `.z` (N) and `.pitch` (N m), if constant.
    Load(usize, Axis),
    /// `gravity.acceleration`, m/s².
    Gravity,
    /// `gravity.incline`, rad.
    Incline,
    /// `waveforms.NAME.KIND.stroke`, `.amplitude`, `.flyback`, `.period` and others.
    Waveform(usize, Quantity),
}

/// Error: the key path does not name a parameter that variants can set.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("\"{path}\" is not a number that variants of this scenario can set: {why}")]
pub(crate) struct NumberError {
    /// Key path as given.
    pub path: String,
    /// Reason for the error, or the expected keys.
    pub why: String,
}

/// Error: the part rejects the value of a parameter.
#[derive(Debug, Clone, PartialEq, Error)]
pub(crate) enum ValueError {
    /// Invalid coefficient of friction.
    #[error(transparent)]
    Friction(#[from] FrictionError),
    /// Invalid waveform.
    #[error(transparent)]
    Waveform(#[from] WaveformError),
}

impl Number {
    /// Returns the parameter that a key path names in a scenario.
    ///
    /// # Errors
    /// Fails if the part does not exist, the key is not a number, or the scenario does not set the parameter to a
    /// constant.
    pub(crate) fn named(scene: &Scene, path: &str) -> Result<Self, NumberError> {
        let found = read(scene, path).and_then(|number| match number.get(scene) {
            Some(_) => Ok(number),
            None => Err("the part has no such number, or the number varies in time".to_owned()),
        });
        found.map_err(|why| NumberError { path: path.to_owned(), why })
    }

    /// Returns the value of the parameter, or `None` if the scenario does not have it.
    pub(crate) fn get(self, scene: &Scene) -> Option<f64> {
        let body = |b: usize| scene.bodies.get(b).map(|named| &named.part);
        let contact = |c: usize| scene.contacts.get(c).map(|named| &named.part);
        let spring = |s: usize| scene.springs.get(s).map(|named| &named.part);
        let actuator = |a: usize| scene.actuators.get(a).map(|named| &named.part);
        match self {
            Self::Mass(b) => body(b)?.mass,
            Self::Inertia(b) => body(b)?.inertia,
            Self::Position(b, axis) => Some(body(b)?.coordinates()[axis as usize].1.position),
            Self::Velocity(b, axis) => Some(body(b)?.coordinates()[axis as usize].1.velocity),
            Self::Friction(c) => Some(contact(c)?.interface.friction()),
            Self::Normal(c) => match contact(c)?.normal {
                Normal::Force(v) | Normal::Indentation(v) | Normal::Radius(v) => constant(v),
                Normal::Coupled => None,
            },
            Self::Gap(c) => Some(contact(c)?.gap),
            Self::Preload(c) => match contact(c)?.start {
                ContactStart::Force(value)
                | ContactStart::Displacement(value)
                | ContactStart::Rest(value) => Some(value),
                ContactStart::Untouched => None,
            },
            Self::SpringStiffness(s) => Some(spring(s)?.stiffness),
            Self::SpringDamping(s) => Some(spring(s)?.damping),
            Self::SpringPreload(s) => Some(spring(s)?.preload),
            Self::ActuatorStiffness(a) => Some(actuator(a)?.stiffness),
            Self::ActuatorDamping(a) => Some(actuator(a)?.damping),
            Self::Load(l, axis) => constant(along(scene.loads.get(l)?, axis)),
            Self::Gravity => Some(scene.gravity.acceleration),
            Self::Incline => Some(scene.gravity.incline),
            Self::Waveform(w, quantity) => Sketch::of(&scene.waveforms.get(w)?.part).get(quantity),
        }
    }

    /// Sets the parameter. Has no effect on waveforms, which an editable [`Sketch`] changes, or on parts without the parameter.
    ///
    /// # Errors
    /// Fails if the coefficient of friction is invalid.
    ///
    /// # Panics
    /// Panics if the part does not exist.
    pub(crate) fn set(self, scene: &mut Scene, value: f64) -> Result<(), ValueError> {
        match self {
            Self::Mass(b) => scene.bodies[b].part.mass = Some(value),
            Self::Inertia(b) => scene.bodies[b].part.inertia = Some(value),
            Self::Position(b, axis) => coordinate(scene, b, axis).position = value,
            Self::Velocity(b, axis) => coordinate(scene, b, axis).velocity = value,
            Self::Friction(c) => scene.contacts[c].part.interface.set_friction(value)?,
            Self::Normal(c) => match &mut scene.contacts[c].part.normal {
                Normal::Force(v) | Normal::Indentation(v) | Normal::Radius(v) => {
                    *v = Varying::Constant(value);
                }
                Normal::Coupled => {}
            },
            Self::Gap(c) => scene.contacts[c].part.gap = value,
            Self::Preload(c) => match &mut scene.contacts[c].part.start {
                ContactStart::Force(v) | ContactStart::Displacement(v) | ContactStart::Rest(v) => *v = value,
                ContactStart::Untouched => {}
            },
            Self::SpringStiffness(s) => scene.springs[s].part.stiffness = value,
            Self::SpringDamping(s) => scene.springs[s].part.damping = value,
            Self::SpringPreload(s) => scene.springs[s].part.preload = value,
            Self::ActuatorStiffness(a) => scene.actuators[a].part.stiffness = value,
            Self::ActuatorDamping(a) => scene.actuators[a].part.damping = value,
            Self::Load(l, Axis::X) => scene.loads[l].x = Varying::Constant(value),
            Self::Load(l, Axis::Z) => scene.loads[l].z = Varying::Constant(value),
            Self::Load(l, Axis::Pitch) => scene.loads[l].pitch = Varying::Constant(value),
            Self::Gravity => scene.gravity.acceleration = value,
            Self::Incline => scene.gravity.incline = value,
            Self::Waveform(..) => {}
        }
        Ok(())
    }
}

/// Formats a number for `--set` as the shortest decimal number with the same bits.
pub(crate) fn text(value: f64) -> String {
    format!("{value:?}").trim_end_matches(".0").to_owned()
}

fn constant(value: Varying) -> Option<f64> {
    match value {
        Varying::Constant(value) => Some(value),
        Varying::Follows(_) => None,
    }
}

fn along(load: &Load, axis: Axis) -> Varying {
    match axis {
        Axis::X => load.x,
        Axis::Z => load.z,
        Axis::Pitch => load.pitch,
    }
}

fn coordinate(scene: &mut Scene, body: usize, axis: Axis) -> &mut stickslip_drive::scene::Coordinate {
    let body = &mut scene.bodies[body].part;
    match axis {
        Axis::X => &mut body.x,
        Axis::Z => &mut body.z,
        Axis::Pitch => &mut body.pitch,
    }
}

/// Returns the index of a part by its name.
fn place<T>(parts: &[Named<T>], name: &str) -> Result<usize, String> {
    let known = || parts.iter().map(|part| part.name.as_str()).collect::<Vec<_>>().join(", ");
    parts.iter().position(|part| part.name == name).ok_or_else(|| format!("expected one of {}", known()))
}

/// Resolves a key path.
fn read(scene: &Scene, path: &str) -> Result<Number, String> {
    let keys: Vec<&str> = path.split('.').collect();
    let axis = |key: &str| [Axis::X, Axis::Z, Axis::Pitch].into_iter().find(|axis| axis.key() == key);
    Ok(match keys[..] {
        ["bodies", name, "mass"] => Number::Mass(place(&scene.bodies, name)?),
        ["bodies", name, "inertia"] => Number::Inertia(place(&scene.bodies, name)?),
        ["bodies", name, "start", key] => {
            let body = place(&scene.bodies, name)?;
            let rate = key.strip_prefix('v').and_then(axis).map(|axis| Number::Velocity(body, axis));
            rate.or(axis(key).map(|axis| Number::Position(body, axis))).ok_or_else(|| choice(&STARTS))?
        }
        ["contacts", name, "friction"] => Number::Friction(place(&scene.contacts, name)?),
        ["contacts", name, "normal", key] => {
            let c = place(&scene.contacts, name)?;
            let own = match scene.contacts[c].part.normal {
                Normal::Force(_) => "force",
                Normal::Indentation(_) => "indentation",
                Normal::Radius(_) => "radius",
                Normal::Coupled => "coupled",
            };
            if key == own { Number::Normal(c) } else { return Err(format!("its normal is \"{own}\"")) }
        }
        ["contacts", name, "gap"] => Number::Gap(place(&scene.contacts, name)?),
        ["contacts", name, "start", key] => {
            let c = place(&scene.contacts, name)?;
            match (scene.contacts[c].part.start, key) {
                (ContactStart::Force(_), "force")
                | (ContactStart::Displacement(_), "displacement")
                | (ContactStart::Rest(_), "rest") => Number::Preload(c),
                _ => return Err("the contact start is given by another key".to_owned()),
            }
        }
        ["springs", name, "stiffness"] => Number::SpringStiffness(place(&scene.springs, name)?),
        ["springs", name, "damping"] => Number::SpringDamping(place(&scene.springs, name)?),
        ["springs", name, "preload"] => Number::SpringPreload(place(&scene.springs, name)?),
        ["actuators", name, "stiffness"] => Number::ActuatorStiffness(place(&scene.actuators, name)?),
        ["actuators", name, "damping"] => Number::ActuatorDamping(place(&scene.actuators, name)?),
        ["gravity", "acceleration"] => Number::Gravity,
        ["gravity", "incline"] => Number::Incline,
        ["waveforms", name, kind, key] => {
            let w = place(&scene.waveforms, name)?;
            let sketch = Sketch::of(&scene.waveforms[w].part);
            Number::Waveform(w, sketch.named(kind, key).ok_or("the waveform has no such number")?)
        }
        [load, key] => match load.strip_prefix("loads[").and_then(|rest| rest.strip_suffix(']')) {
            Some(place) => {
                let place = place.parse().map_err(|_| "expected loads[0]")?;
                Number::Load(place, axis(key).ok_or_else(|| choice(&AXES))?)
            }
            None => return Err(choice(&KEYS)),
        },
        _ => return Err(choice(&KEYS)),
    })
}

/// Keys of `bodies.NAME.start`.
const STARTS: [&str; 6] = ["x", "z", "pitch", "vx", "vz", "vpitch"];
/// Keys of a load.
const AXES: [&str; 3] = ["x", "z", "pitch"];
/// Examples of key paths that can be set, for error messages.
const KEYS: [&str; 10] = [
    "bodies.NAME.mass",
    "bodies.NAME.start.x",
    "contacts.NAME.friction",
    "contacts.NAME.normal.force",
    "contacts.NAME.gap",
    "springs.NAME.stiffness",
    "actuators.NAME.stiffness",
    "loads[0].x",
    "gravity.incline",
    "waveforms.NAME.sawtooth.stroke",
];

fn choice(keys: &[&str]) -> String {
    format!("expected something like {}", keys.join(", "))
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}
