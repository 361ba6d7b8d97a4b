//! Maps parts and fields of the model and the plan to key paths in the file.

use crate::path::{KeyPath, Step};
use crate::units::Kind;
use stickslip_drive::scene::{Axis, Direction, Named};
use stickslip_drive::{Accuracy, Field, Part, Plan, Scene, SceneError, Stepper};

/// Returns the key path of a field.
pub(crate) fn path(scene: &Scene, plan: Plan, part: Part, field: Field) -> KeyPath {
    let key = |key: &str| Step::Key(key.to_owned());
    let mut steps = match part {
        Part::Body(i) => named("bodies", &scene.bodies, i),
        Part::Contact(i) => named("contacts", &scene.contacts, i),
        Part::Spring(i) => named("springs", &scene.springs, i),
        Part::Actuator(i) => named("actuators", &scene.actuators, i),
        Part::Load(i) => vec![key("loads"), Step::Index(i)],
        Part::Stop(i) => {
            let mut steps = named("stops", &scene.stops, i);
            if let (Field::End(end), Some(stop)) = (field, scene.stops.get(i)) {
                let along = if stop.part.direction == Direction::X { "x" } else { "z" };
                steps.extend([key(along), Step::Index(end)]);
            }
            steps
        }
        // Blocks have no keys in the file.
        Part::Block(_) => Vec::new(),
        Part::Gravity => vec![key("gravity")],
        Part::Run if field == Field::Interval => vec![key("output")],
        Part::Run => vec![key("run")],
    };
    steps.extend(keys(field, plan.stepper).into_iter().map(key));
    KeyPath(steps)
}

fn named<T>(kind: &str, parts: &[Named<T>], i: usize) -> Vec<Step> {
    let name = parts.get(i).map(|part| part.name.clone());
    [kind.to_owned()].into_iter().chain(name).map(Step::Key).collect()
}

/// Returns the dimension of a field that is a quantity in the file.
pub(crate) fn kind(error: &SceneError) -> Option<Kind> {
    Some(match (error.part, error.field) {
        (Part::Contact(_), Field::Damping) => Kind::Time,
        (_, Field::Damping) => Kind::Damping,
        (_, Field::Mass) => Kind::Mass,
        (_, Field::Inertia) => Kind::Inertia,
        (_, Field::Stiffness) => Kind::Stiffness,
        (_, Field::NormalForce) => Kind::Force,
        (_, Field::NormalIndentation | Field::NormalRadius) => Kind::Length,
        (_, Field::Duration | Field::Interval | Field::Step) => Kind::Time,
        _ => return None,
    })
}

/// Returns the keys from a part to its field.
fn keys(field: Field, stepper: Stepper) -> Vec<&'static str> {
    let keys: &[&str] = match field {
        Field::Whole | Field::End(_) => &[],
        Field::Mass => &["mass"],
        Field::Inertia => &["inertia"],
        Field::Coordinate(Axis::X) | Field::Component(Axis::X) => &["x"],
        Field::Coordinate(Axis::Z) | Field::Component(Axis::Z) => &["z"],
        Field::Coordinate(Axis::Pitch) | Field::Component(Axis::Pitch) => &["pitch"],
        Field::Position(Axis::X) => &["start", "x"],
        Field::Position(Axis::Z) => &["start", "z"],
        Field::Position(Axis::Pitch) => &["start", "pitch"],
        Field::Velocity(Axis::X) => &["start", "vx"],
        Field::Velocity(Axis::Z) => &["start", "vz"],
        Field::Velocity(Axis::Pitch) => &["start", "vpitch"],
        Field::Between => &["between"],
        Field::Points => &["at"],
        Field::Normal => &["normal"],
        Field::NormalForce => &["normal", "force"],
        Field::NormalIndentation => &["normal", "indentation"],
        Field::NormalRadius => &["normal", "radius"],
        Field::Gap => &["gap"],
        Field::Friction => &["friction"],
        Field::Damping => &["damping"],
        Field::Start => &["start"],
        Field::StartForce => &["start", "force"],
        Field::StartDisplacement => &["start", "displacement"],
        Field::NormalDamping => &["damping", "normal"],
        Field::Restitution => &["damping", "restitution"],
        Field::StartRest => &["start", "rest"],
        Field::Engine => &["engine"],
        Field::SpringCount => &["engine", "springs", "count"],
        Field::Span => &["engine", "springs", "span"],
        Field::Count => &["count"],
        Field::Stiffness => &["stiffness"],
        Field::Preload => &["preload"],
        Field::Stroke => &["stroke"],
        Field::On => &["on"],
        Field::Acceleration => &["acceleration"],
        Field::Incline => &["incline"],
        Field::Duration => &["duration"],
        Field::Interval => &["every"],
        Field::SteadyChange => &["until_steady"],
        Field::Stepper => &["stepper"],
        Field::Tolerance | Field::Step | Field::Frame => &["stepper", stepper.name(), accuracy(stepper)],
        Field::FrameAccuracy => &["stepper", stepper.name(), "accuracy"],
    };
    keys.to_vec()
}

/// Returns the key of the accuracy of a time integrator.
fn accuracy(stepper: Stepper) -> &'static str {
    match stepper.accuracy() {
        Accuracy::Tolerance(_) => "tolerance",
        Accuracy::Step(_) => "step",
        Accuracy::Frame { .. } => "length",
    }
}
