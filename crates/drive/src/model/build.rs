//! From a scene to a model: bodies, links and loads.
//!
//! In order: the scene is checked on its own; bodies get what their coordinates are bound to, free ones a place among the
//! coordinates; links, blocks and contacts become measures, the constant rows of the Jacobian; what cannot act is left out and
//! named; natural scales come last, for they ask for everything else.

use super::contact::{self, Surroundings};
use super::{
    Balanced, Binding, Body, Free, Link, Load, Measure, Model, Signals, Spared, Stroke, balanced, block,
    check, dampers, held, parts, reach, scale, used,
};
use crate::contact::Contact;
use crate::linearised::Paces;
use crate::scene::{self, Axis, Coordinate, Direction, Freedom, Named, Point, Scene, Side, Start, Varying};
use crate::{Field, Part, SceneError, SceneFault, Waveform};

impl Model {
    /// Checks a scene and assembles its constants.
    ///
    /// # Errors
    /// The first thing wrong, by part, field and fault: numbers out of their range, places that do not exist, coordinates that
    /// nothing holds, dampers that would have to follow a jump. Where these stand in a file is the file reader's to say.
    pub fn new(scene: &Scene) -> Result<Self, SceneError> {
        check::check(scene)?;
        let mut waveforms: Vec<Waveform> = scene.waveforms.iter().map(|w| w.part.clone()).collect();
        balanced::check_company(scene)?;
        let first = waveforms.len() + scene.blocks.len();
        let Moving { bodies, mut free, mut balanced } = bodies(scene)?;
        let mut links = links(scene, &bodies);
        let loads = loads(scene, &bodies, &mut free);
        balanced::load(scene, &bodies, (first, &mut balanced));
        let stiffness = balanced::springs(&links, (first, &mut balanced));
        let equilibrium = scene.start == Start::Equilibrium;
        let blocks = block::wire(scene, &bodies)?;
        let piled = reach::piled(scene, &free);
        let around = Surroundings {
            signals: Signals { waveforms: &waveforms, blocks: &blocks, balanced: &balanced },
            bodies: &bodies,
            free: &free,
            links: &links,
            loads: &loads,
            piled: &piled,
            equilibrium,
        };
        let Touching { mut contacts, deepest, growing } = touching(scene, &around)?;
        let pushes: Vec<f64> = (0..free.len()).map(|i| reach::pressing(i, &around)).collect();
        dampers::check(scene, &links, &contacts, around.signals)?;
        held::check(&free, &contacts, &links)?;
        if !balanced.is_empty() {
            balanced::check_dampers(scene, (&links, &contacts), first)?;
            balanced::assign(&contacts, &stiffness, (first, &mut balanced))?;
        }
        let mut spared = spared(scene, &bodies, &links);
        links.retain(Link::acts);
        for link in &links {
            link.elongation.free.iter().for_each(|(i, _)| free[*i].travels = false);
        }
        spared.waveforms =
            used::hold_the_others(&mut waveforms, (&bodies, &blocks), &contacts, &links, (&loads, &balanced));
        scale::assign(&mut contacts, &mut free, &links, &waveforms, (&deepest, &pushes));
        let moment = balanced::moment(&waveforms);
        let constants = Self {
            waveforms,
            bodies,
            free,
            contacts,
            blocks,
            balanced,
            links,
            loads,
            growing,
            equilibrium,
            spared,
            moment,
            fastest: 0.0,
            stiff: false,
            parts: Vec::new(),
        };
        let Paces { fastest, stiff } = constants.paces();
        let whole = Self { fastest, stiff, ..constants.settled() };
        Ok(Self { parts: parts::divide(scene, &whole), ..whole })
    }
}

/// The contacts of a scene.
struct Touching {
    contacts: Vec<Contact>,
    /// The largest indentation of each, m.
    deepest: Vec<f64>,
    /// Number of those whose force is a state while they grow.
    growing: usize,
}

fn touching(scene: &Scene, around: &Surroundings<'_>) -> Result<Touching, SceneError> {
    let count = scene.contacts.len();
    let mut all =
        Touching { contacts: Vec::with_capacity(count), deepest: Vec::with_capacity(count), growing: 0 };
    for (place, named) in scene.contacts.iter().enumerate() {
        let (mut contact, deepest) = contact::build(place, named, around)?;
        if !contact.is_constant() && !contact.inert {
            contact.slot = Some(all.growing);
            all.growing += 1;
        }
        all.contacts.push(contact);
        all.deepest.push(deepest);
    }
    Ok(all)
}

/// Bodies and what of them moves by forces.
struct Moving {
    bodies: Vec<Body>,
    free: Vec<Free>,
    balanced: Vec<Balanced>,
}

/// The bodies, their free coordinates, with the weight that gravity gives each, and their balanced ones.
///
/// On an incline α gravity g pulls with -mg sin α along x and -mg cos α along z. Fails where a free
/// coordinate has no mass or moment of inertia.
fn bodies(scene: &Scene) -> Result<Moving, SceneError> {
    let mut bodies = Vec::with_capacity(scene.bodies.len());
    let (mut free, mut balanced) = (Vec::new(), Vec::new());
    let signals = scene.waveforms.len() + scene.blocks.len();
    let (along, normal) = scene.gravity.components();
    for (body, Named { name, part }) in scene.bodies.iter().enumerate() {
        let mut bindings = [Binding::Held(0.0); 3];
        for (place, (axis, coordinate)) in bindings.iter_mut().zip(part.coordinates()) {
            *place = match coordinate.freedom {
                Freedom::Fixed => Binding::Held(coordinate.position),
                Freedom::Follows(waveform) => Binding::Driven(waveform),
                Freedom::Balanced => balanced::bind((body, part), axis, (signals, &mut balanced))?,
                Freedom::Free => {
                    let mass = inertia(body, part, axis)?;
                    let force = match axis {
                        Axis::X => -mass * along,
                        Axis::Z => -mass * normal,
                        Axis::Pitch => 0.0,
                    };
                    free.push(free_coordinate(body, axis, mass, force, coordinate));
                    Binding::Free(free.len() - 1)
                }
            };
        }
        bodies.push(Body { name: name.clone(), bindings });
    }
    Ok(Moving { bodies, free, balanced })
}

/// A coordinate along x travels until a link is found on it; scales are assigned when contacts and links are
/// known.
fn free_coordinate(body: usize, axis: Axis, mass: f64, force: f64, coordinate: Coordinate) -> Free {
    let start = (coordinate.position, coordinate.velocity);
    Free { body, axis, mass, mobility: 1.0 / mass, force, start, travels: axis == Axis::X, scale: (0.0, 0.0) }
}

/// Mass or moment of inertia of a free coordinate.
fn inertia(place: usize, body: &scene::Body, axis: Axis) -> Result<f64, SceneError> {
    let value = match axis {
        Axis::X | Axis::Z => body.mass,
        Axis::Pitch => body.inertia,
    };
    value.ok_or_else(|| SceneFault::NoInertia(axis).of(Part::Body(place), Field::Whole))
}

/// Springs, then actuators. Their elongation is the displacement of the second side less that of the first; a
/// spring is an actuator of no stroke.
fn links(scene: &Scene, bodies: &[Body]) -> Vec<Link> {
    let elongation = |sides: [Side; 2], at: [Point; 2], direction: Direction| {
        Measure::between([(sides[1], at[1]), (sides[0], at[0])], direction, bodies)
    };
    let springs = scene.springs.iter().map(|Named { part, .. }| Link {
        elongation: elongation(part.between, part.at, part.direction),
        stiffness: part.stiffness,
        damping: part.damping,
        preload: part.preload,
        stroke: Stroke::Constant(0.0),
    });
    let actuators = scene.actuators.iter().map(|Named { part, .. }| Link {
        elongation: elongation(part.between, part.at, part.direction),
        stiffness: part.stiffness,
        damping: part.damping,
        preload: 0.0,
        stroke: match part.stroke {
            Varying::Constant(s) => Stroke::Constant(s),
            Varying::Follows(w) => Stroke::Driven(w),
        },
    });
    springs.chain(actuators).collect()
}

/// Adds the constant loads to the free coordinates and returns the others. A load on a coordinate that does not move
/// freely is carried by its guide. A force at (X, Z) from the reference point turns with the moment X F_z - Z F_x.
fn loads(scene: &Scene, bodies: &[Body], free: &mut [Free]) -> Vec<Load> {
    let mut varying = Vec::new();
    for load in &scene.loads {
        let [x, z, pitch] = bodies[load.on].bindings;
        let parts = [
            (x, 1.0, load.x),
            (z, 1.0, load.z),
            (pitch, 1.0, load.pitch),
            (pitch, -load.at.z, load.x),
            (pitch, load.at.x, load.z),
        ];
        for (place, arm, value) in parts {
            match (place, value) {
                (Binding::Free(i), Varying::Constant(force)) => free[i].force += arm * force,
                (Binding::Free(free), Varying::Follows(waveform)) if arm != 0.0 => {
                    varying.push(Load { free, arm, waveform });
                }
                _ => {}
            }
        }
    }
    varying
}

/// What acts on nobody, but for waveforms.
fn spared(scene: &Scene, bodies: &[Body], links: &[Link]) -> Spared {
    let mut spared = Spared { loads: spared_loads(scene, bodies), ..Spared::default() };
    for (i, _) in links.iter().enumerate().filter(|(_, link)| !link.acts()) {
        match i.checked_sub(scene.springs.len()) {
            None => spared.springs.push(i),
            Some(i) => spared.actuators.push(i),
        }
    }
    spared
}

/// Loads on bodies that nothing lets move.
/// By their places in the scene: for `info`, since no run looks at them.
fn spared_loads(scene: &Scene, bodies: &[Body]) -> Vec<usize> {
    let is_held = |load: &scene::Load| {
        let moves = bodies[load.on].bindings.iter().any(|p| matches!(p, Binding::Free(_)));
        !moves && !scene.bodies[load.on].part.is_balanced()
    };
    scene.loads.iter().enumerate().filter(|(_, load)| is_held(load)).map(|(i, _)| i).collect()
}
