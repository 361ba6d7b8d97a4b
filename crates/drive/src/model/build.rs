//! Construction of a [`Model`] from a [`Scene`]: bodies, links and loads.
//!
//! The steps are, in order: checks, bodies and coordinates, links, blocks and contacts. Displacements between bodies become constant rows
//! of the Jacobian. Then parts without effect are removed, and natural scales computed.

use super::contact::{self, Surroundings};
use super::{
    Binding, Body, Free, Link, Load, Measure, Model, Spared, Stroke, balanced, block, check, dampers, held,
    reach, scale, used,
};
use crate::linearised::Paces;
use crate::scene::{self, Axis, Coordinate, Direction, Freedom, Named, Point, Scene, Side, Start, Varying};
use crate::{Field, Part, SceneError, SceneFault};

/// Scratch memory of the construction of a model, reused for the next model.
#[derive(Debug, Default)]
pub(crate) struct Scaffold {
    /// Largest indentation of each contact, m.
    deepest: Vec<f64>,
    /// Largest force on each free coordinate, N or N m.
    pushes: Vec<f64>,
    /// Names of contacts.
    names: Vec<String>,
    /// Whether each waveform is used.
    used: Vec<bool>,
    scales: scale::Room,
}

impl Model {
    /// Checks a [`Scene`] and computes the constants of the model.
    ///
    /// # Errors
    ///
    /// [`SceneError`]: the first fault, with part and field. Faults are, for example, numbers out of range, references to missing parts,
    /// coordinates that nothing holds, and dampers that would have to follow a jump.
    pub fn new(scene: &Scene) -> Result<Self, SceneError> {
        let mut model = Self::blank();
        model.rebuild(scene, &mut Scaffold::default())?;
        Ok(model)
    }

    /// Rebuilds this model from another [`Scene`] and reuses the memory. If the structure is the same, with one free coordinate, nothing is
    /// allocated. After an error the model is invalid, but can be rebuilt.
    pub(crate) fn rebuild(&mut self, scene: &Scene, room: &mut Scaffold) -> Result<(), SceneError> {
        check::check(scene)?;
        (self.fastest, self.stiff, self.growing) = (0.0, false, 0);
        self.take_waveforms(scene);
        balanced::check_company(scene)?;
        let first = scene.waveforms.len() + scene.blocks.len();
        self.gather(scene)?;
        gather_links(scene, &self.bodies, &mut self.links);
        self.put_loads_on(scene);
        balanced::load(scene, &self.bodies, (first, &mut self.balanced));
        let stiffness = balanced::springs(&self.links, (first, &mut self.balanced));
        self.equilibrium = scene.start == Start::Equilibrium;
        self.blocks = block::wire(scene, &self.bodies)?;
        self.put_contacts(scene, room)?;
        dampers::check(scene, &self.links, &self.contacts, self.signals())?;
        held::check(&self.free, &self.contacts, &self.links)?;
        if !self.balanced.is_empty() {
            balanced::check_dampers(scene, (&self.links, &self.contacts), first)?;
            balanced::assign(&self.contacts, &stiffness, (first, &mut self.balanced))?;
        }
        self.spared = spared(scene, &self.bodies, &self.links);
        self.links.retain(Link::acts);
        for link in &self.links {
            link.elongation.free.iter().for_each(|(i, _)| self.free[*i].travels = false);
        }
        // Stops depend on the position itself.
        for stop in self.contacts.iter().filter(|contact| contact.stop) {
            let lengths = stop.coupling().into_iter().flat_map(|d| &d.free);
            lengths.for_each(|(i, _)| self.free[*i].travels = false);
        }
        used::hold_the_others(self, &mut room.used);
        let Scaffold { deepest, pushes, scales, .. } = room;
        scales.find_forces(scene);
        let (contacts, free) = (&mut self.contacts, &mut self.free);
        scale::assign(contacts, free, &self.links, &self.waveforms, (deepest, pushes), scales);
        self.sweep_balanced();
        self.moment = balanced::moment(&self.waveforms);
        self.settle_balanced();
        Paces { fastest: self.fastest, stiff: self.stiff, .. } = self.paces();
        Ok(())
    }

    fn take_waveforms(&mut self, scene: &Scene) {
        self.waveforms.truncate(scene.waveforms.len());
        let known = self.waveforms.len();
        self.waveforms.iter_mut().zip(&scene.waveforms).for_each(|(own, named)| own.copy(&named.part));
        self.waveforms.extend(scene.waveforms[known..].iter().map(|named| named.part.clone()));
    }

    /// Builds the contacts, and computes their largest indentations and the largest forces on free coordinates.
    fn put_contacts(&mut self, scene: &Scene, room: &mut Scaffold) -> Result<(), SceneError> {
        let mut contacts = std::mem::take(&mut self.contacts);
        room.names.clear();
        room.names.reserve(scene.contacts.len());
        room.names.extend(contacts.drain(..).rev().map(|contact| contact.name));
        room.deepest.clear();
        room.pushes.clear();
        let piled = reach::piled(scene, &self.free);
        let around = Surroundings {
            signals: self.signals(),
            contacts: &scene.contacts,
            bodies: &self.bodies,
            free: &self.free,
            links: &self.links,
            loads: &self.loads,
            piled: &piled,
            equilibrium: self.equilibrium,
        };
        let mut growing = 0;
        for (place, named) in scene.contacts.iter().enumerate() {
            let (mut contact, deepest) = contact::build(place, &named.part, &around)?;
            contact.name = room.names.pop().unwrap_or_default();
            contact.name.clone_from(&named.name);
            if !contact.is_constant() && !contact.inert {
                contact.slot = Some(growing);
                growing += 1;
            }
            contacts.push(contact);
            room.deepest.push(deepest);
        }
        for (place, named) in scene.stops.iter().enumerate() {
            for end in 0..2 {
                let index = contacts.len();
                if let Some((contact, deepest)) = contact::stop((place, named), end, (index, &around))? {
                    contacts.push(contact);
                    room.deepest.push(deepest);
                }
            }
        }
        room.pushes.extend((0..self.free.len()).map(|i| reach::pressing(i, &around)));
        (self.contacts, self.growing) = (contacts, growing);
        Ok(())
    }

    /// Builds the bodies with their free and quasi-static coordinates.
    ///
    /// On an incline of angle α, gravity g gives the forces -mg sin α along x and -mg cos α along z. Fails if a free coordinate has no mass
    /// or moment of inertia.
    fn gather(&mut self, scene: &Scene) -> Result<(), SceneError> {
        let nowhere = || Body { name: String::new(), bindings: [Binding::Held(0.0); 3] };
        self.bodies.resize_with(scene.bodies.len(), nowhere);
        self.free.clear();
        self.balanced.clear();
        let signals = scene.waveforms.len() + scene.blocks.len();
        let (along, normal) = scene.gravity.components();
        for (body, Named { name, part }) in scene.bodies.iter().enumerate() {
            let known = &mut self.bodies[body];
            known.name.clone_from(name);
            for (place, (axis, coordinate)) in known.bindings.iter_mut().zip(part.coordinates()) {
                *place = match coordinate.freedom {
                    Freedom::Fixed => Binding::Held(coordinate.position),
                    Freedom::Follows(waveform) => Binding::Driven(waveform),
                    Freedom::Balanced => balanced::bind((body, part), axis, (signals, &mut self.balanced))?,
                    Freedom::Free => {
                        let mass = inertia(body, part, axis)?;
                        let force = match axis {
                            Axis::X => -mass * along,
                            Axis::Z => -mass * normal,
                            Axis::Pitch => 0.0,
                        };
                        self.free.push(free_coordinate(body, axis, mass, force, coordinate));
                        Binding::Free(self.free.len() - 1)
                    }
                };
            }
        }
        Ok(())
    }

    /// Adds constant loads to free coordinates and stores the varying loads. Guides carry loads on other coordinates. A force at (X, Z)
    /// from the reference point has the moment X F_z - Z F_x.
    fn put_loads_on(&mut self, scene: &Scene) {
        self.loads.clear();
        for load in &scene.loads {
            let [x, z, pitch] = self.bodies[load.on].bindings;
            let parts = [
                (x, 1.0, load.x),
                (z, 1.0, load.z),
                (pitch, 1.0, load.pitch),
                (pitch, -load.at.z, load.x),
                (pitch, load.at.x, load.z),
            ];
            for (place, arm, value) in parts {
                match (place, value) {
                    (Binding::Free(i), Varying::Constant(force)) => self.free[i].force += arm * force,
                    (Binding::Free(free), Varying::Follows(waveform)) if arm != 0.0 => {
                        self.loads.push(Load { free, arm, waveform });
                    }
                    _ => {}
                }
            }
        }
    }
}

/// Returns a free coordinate. Along x its origin may move until a spring is found that acts on it; natural scales are assigned later.
fn free_coordinate(body: usize, axis: Axis, mass: f64, force: f64, coordinate: Coordinate) -> Free {
    let start = (coordinate.position, coordinate.velocity);
    Free { body, axis, mass, mobility: 1.0 / mass, force, start, travels: axis == Axis::X, scale: (0.0, 0.0) }
}

/// Returns mass or moment of inertia of a free coordinate. Fails if the value is missing.
fn inertia(place: usize, body: &scene::Body, axis: Axis) -> Result<f64, SceneError> {
    let value = match axis {
        Axis::X | Axis::Z => body.mass,
        Axis::Pitch => body.inertia,
    };
    value.ok_or_else(|| SceneFault::NoInertia(axis).of(Part::Body(place), Field::Whole))
}

/// Adds springs and then actuators. The elongation is the displacement of the second side minus that of the first; a spring is stored as an
/// actuator with zero stroke.
fn gather_links(scene: &Scene, bodies: &[Body], links: &mut Vec<Link>) {
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
    links.clear();
    links.extend(springs.chain(actuators));
}

/// Returns the springs, actuators and loads without effect.
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

/// Returns the indices of loads on bodies that cannot move.
fn spared_loads(scene: &Scene, bodies: &[Body]) -> Vec<usize> {
    let is_held = |load: &scene::Load| {
        let moves = bodies[load.on].bindings.iter().any(|p| matches!(p, Binding::Free(_)));
        !moves && !scene.bodies[load.on].part.is_balanced()
    };
    scene.loads.iter().enumerate().filter(|(_, load)| is_held(load)).map(|(i, _)| i).collect()
}
