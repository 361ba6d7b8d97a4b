//! Converts errors of model and plan to errors with messages for the file.

use super::range;
use crate::address;
use crate::fault::Fault;
use crate::path::{KeyPath, Step};
use stickslip_contact::FirstLoadingError;
use stickslip_drive::scene::{Axis, Normal, Scene, Varying};
use stickslip_drive::{Field, Part, Plan, SceneError, SceneFault};

/// Converts an error of the model or the plan.
pub(crate) fn fault(scene: &Scene, plan: Plan, error: &SceneError) -> Fault {
    let path = address::path(scene, plan, error.part, error.field);
    let fault = worded(scene, path, error);
    let part = address::path(scene, plan, error.part, Field::Whole);
    let pressed = pressing(scene, error.part);
    let inside = |key: &str| KeyPath(part.0.iter().cloned().chain([Step::Key(key.to_owned())]).collect());
    match (&error.fault, pressed) {
        // The check depends on a single number.
        (SceneFault::NotFinite(_) | SceneFault::BelowZero(_) | SceneFault::NotAboveZero(_), _)
        | (SceneFault::NoContact | SceneFault::BalancedPitch, _) => fault,
        (SceneFault::NoInertia(_) | SceneFault::BalancedMass(_), _) => fault.against_path(part),
        (SceneFault::DampedJump(name), _) => {
            fault.against_path(part.clone()).against_path(waveform(name)).against(["bodies", "actuators"])
        }
        (SceneFault::UnlocatedJump, _) => fault.against(["waveforms", "run.stepper"]),
        (SceneFault::Loading(reason), Some((value, normal))) => {
            let fault = follow(fault, scene, value).against_path(inside("normal"));
            match (reason, normal) {
                (FirstLoadingError::NormalForce(low) | FirstLoadingError::Radius(low), _) if *low < 0.0 => {
                    fault
                }
                (FirstLoadingError::TangentialForce { .. }, Normal::Force(_)) => {
                    fault.against_path(inside("friction"))
                }
                _ => fault.against_path(part).against(["materials"]),
            }
        }
        (SceneFault::Springs(_) | SceneFault::Narrow { .. }, Some((value, _))) => {
            follow(fault, scene, value).against_path(part).against(["materials"])
        }
        _ => fault.against_all(),
    }
}

fn waveform(name: &str) -> KeyPath {
    KeyPath(vec![Step::Key("waveforms".to_owned()), Step::Key(name.to_owned())])
}

/// Adds the waveform that a value follows to the paths on which the check depends.
fn follow(fault: Fault, scene: &Scene, value: Varying) -> Fault {
    match value {
        Varying::Constant(_) => fault,
        Varying::Follows(w) => match scene.waveforms.get(w) {
            Some(named) => fault.against_path(waveform(&named.name)),
            None => fault,
        },
    }
}

/// Converts an error of the model to an error with a message for the file.
fn worded(scene: &Scene, path: KeyPath, error: &SceneError) -> Fault {
    match &error.fault {
        SceneFault::NotAboveZero(_) => {
            Fault::expected(path, address::kind(error).map_or(range::ABOVE.to_owned(), range::above))
        }
        SceneFault::BelowZero(_) => match address::kind(error) {
            Some(kind) => Fault::expected(path, range::at_least(kind)),
            None => plain(path, error),
        },
        SceneFault::NoInertia(axis) => no_inertia(path, *axis),
        SceneFault::Loading(reason) => loading(scene, path, error, *reason),
        SceneFault::DampedJump(name) if jumps_as_input(scene, |waveform| waveform == name) => {
            Fault::new(path, error.fault.to_string()).help(LINEAR)
        }
        SceneFault::UnlocatedJump if jumps_as_input(scene, |_| true) => {
            let help = format!("use the stepper `event`, or {LINEAR}");
            Fault::new(path, error.fault.to_string()).help(help)
        }
        SceneFault::DampedJump(_) if matches!(error.part, Part::Actuator(_)) => {
            Fault::new(path, error.fault.to_string()).help(STACK)
        }
        _ => plain(path, error),
    }
}

/// Help for a stack that follows a waveform with jumps.
const STACK: &str = "give the waveform a flyback above 0, or the stack a \"driver\" with a current, a \
                     resistance or a bandwidth, or \"damping\": 0; the default damping of a stack is that of \
                     Q = 50";

/// Help for an input with jumps.
const LINEAR: &str = "make the input \"linear\": a held input jumps to each new value";

/// Returns whether all waveforms with jumps among those selected are inputs.
fn jumps_as_input(scene: &Scene, named: impl Fn(&str) -> bool) -> bool {
    let mut jumping = scene
        .waveforms
        .iter()
        .filter(|waveform| named(&waveform.name) && waveform.part.has_jumps())
        .peekable();
    jumping.peek().is_some() && jumping.all(|waveform| waveform.part.interpolation().is_some())
}

/// Returns the error with the message of the model.
fn plain(path: KeyPath, error: &SceneError) -> Fault {
    Fault::new(path, error.fault.to_string()).maybe_help(error.fault.advice())
}

/// Returns the error for a missing mass or moment of inertia.
fn no_inertia(path: KeyPath, axis: Axis) -> Fault {
    match axis {
        Axis::X | Axis::Z => {
            let help = format!("{} is free: a body with a free coordinate needs a mass", axis.key());
            Fault::missing(path, "mass").help(help)
        }
        Axis::Pitch => Fault::missing(path, "inertia")
            .help("pitch is free: a body that rotates needs a moment of inertia"),
    }
}

/// Returns the error for an initial state of a contact that is impossible.
fn loading(scene: &Scene, path: KeyPath, error: &SceneError, reason: FirstLoadingError) -> Fault {
    match reason {
        FirstLoadingError::TangentialForce { limit, .. } => {
            let limit = range::short(limit);
            Fault::expected(path, format_args!("a force below μF_N = {limit} N in magnitude"))
                .help("at μF_N the contact slips; this is the force of one contact, independent of \"count\"")
        }
        FirstLoadingError::Undetermined => {
            let message = "a contact radius does not determine the indentation of this profile";
            Fault::new(path, message).on_key().help("give \"force\" or \"indentation\"")
        }
        FirstLoadingError::NormalForce(low) | FirstLoadingError::Radius(low) if low < 0.0 => {
            below_zero(scene, path, error, low)
        }
        FirstLoadingError::Radius(_) | FirstLoadingError::BeyondProfile { .. } => {
            beyond_profile(scene, &path, error).unwrap_or_else(|| plain(path, error))
        }
        _ => plain(path, error),
    }
}

/// Returns the error for a normal load that is negative, always or at times.
fn below_zero(scene: &Scene, mut path: KeyPath, error: &SceneError, low: f64) -> Fault {
    let Some(kind) = address::kind(error) else { return plain(path, error) };
    let waveform = match pressing(scene, error.part) {
        Some((Varying::Constant(_), _)) => return Fault::expected(path, range::at_least(kind)),
        Some((Varying::Follows(w), _)) => scene.waveforms.get(w),
        None => None,
    };
    let is_input = waveform.is_some_and(|waveform| waveform.part.interpolation().is_some());
    let is_generated = waveform.is_some_and(|waveform| waveform.part.generator().is_some());
    path.0.push(Step::Key("follows".to_owned()));
    let message = format!(
        "expected {} at all times, but the {} to {} {}",
        range::at_least(kind),
        match (is_input, is_generated) {
            (true, _) => "range of the input extends down",
            (_, true) => "stroke range of the generator extends down",
            _ => "waveform falls",
        },
        range::short(low),
        kind.si()
    );
    let help = if is_input || is_generated {
        format!("let its range start at 0 {} or above", kind.si())
    } else {
        "add an offset, or reduce the amplitude".to_owned()
    };
    Fault::new(path, message).help(help)
}

/// Returns the error for a contact beyond the end of its profile: the equator of a sphere, or the last point of a table. Returns `None`
/// for a coupled contact, whose indentation depends on the whole model.
fn beyond_profile(scene: &Scene, path: &KeyPath, error: &SceneError) -> Option<Fault> {
    let (Part::Contact(i), Some((varying, normal))) = (error.part, pressing(scene, error.part)) else {
        return None;
    };
    let interface = &scene.contacts.get(i)?.part.interface;
    let reach = interface.profile().reach()?;
    let most = match normal {
        Normal::Force(_) => interface.normal_force(reach),
        Normal::Radius(_) => interface.profile().radius(reach),
        Normal::Indentation(_) | Normal::Coupled => reach,
    };
    let high = match varying {
        Varying::Constant(value) => value,
        Varying::Follows(w) => scene.waveforms.get(w)?.part.range().1,
    };
    let (most, high, unit) = (range::short(most), range::short(high), address::kind(error)?.si());
    let (within, end, help) = if interface.profile().ends_at_a_point() {
        (
            "at most",
            "the last point of its profile",
            "the contact circle must be smaller than the known range of the profile",
        )
    } else if interface.profile().has_shape() {
        (
            "less than",
            "the sphere's equator",
            "in half-space theory, the contact circle is much smaller than the sphere",
        )
    } else {
        (
            "less than",
            "the plane below all tips",
            "increase the number of tips, their heights or their radius",
        )
    };
    let message =
        format!("expected {within} {most} {unit}, at which the contact reaches {end}, got {high} {unit}");
    Some(Fault::new(path.clone(), message).help(help))
}

/// Returns the prescribed normal load of a contact.
fn pressing(scene: &Scene, part: Part) -> Option<(Varying, Normal)> {
    let Part::Contact(i) = part else { return None };
    let normal = scene.contacts.get(i)?.part.normal;
    match normal {
        Normal::Force(value) | Normal::Indentation(value) | Normal::Radius(value) => Some((value, normal)),
        Normal::Coupled => None,
    }
}
