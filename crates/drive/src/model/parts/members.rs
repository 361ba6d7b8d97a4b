//! What belongs together in a scene.

use crate::scene::{Body, Freedom, Scene, Side, Varying};

/// Parts of a scene that belong together, by their places there.
#[derive(Default)]
pub(super) struct Members {
    pub(super) bodies: Vec<usize>,
    pub(super) contacts: Vec<usize>,
    pub(super) springs: Vec<usize>,
    pub(super) actuators: Vec<usize>,
    pub(super) loads: Vec<usize>,
}

/// Gathers what belongs together, in the order of the bodies; last what moves along prescribed paths.
pub(super) fn members(scene: &Scene) -> Vec<Members> {
    let (part_of, count) = groups(scene);
    // The last one for what no moving body touches.
    let mut parts: Vec<Members> = (0..=count).map(|_| Members::default()).collect();
    let moving = |side: Side| match side {
        Side::Body(body) => part_of[body],
        Side::Ground => None,
    };
    let owner = |between: [Side; 2]| between.into_iter().find_map(moving).unwrap_or(count);
    for (i, contact) in scene.contacts.iter().enumerate() {
        parts[owner(contact.part.between)].contacts.push(i);
    }
    for (i, spring) in scene.springs.iter().enumerate() {
        parts[owner(spring.part.between)].springs.push(i);
    }
    for (i, actuator) in scene.actuators.iter().enumerate() {
        parts[owner(actuator.part.between)].actuators.push(i);
    }
    for (i, load) in scene.loads.iter().enumerate() {
        parts[part_of[load.on].unwrap_or(count)].loads.push(i);
    }
    if !parts[count].act(scene) {
        parts.pop();
    }
    for (body, own) in part_of.into_iter().enumerate() {
        seat(scene, body, own, &mut parts);
    }
    parts
}

/// The group of each body that moves by forces, joined by what acts between two of them, and the number of groups.
fn groups(scene: &Scene) -> (Vec<Option<usize>>, usize) {
    let moving = |side: Side| match side {
        Side::Body(body) => {
            let part = &scene.bodies[body].part;
            (part.is_free() || part.is_balanced()).then_some(body)
        }
        Side::Ground => None,
    };
    let contacts = scene.contacts.iter().map(|c| c.part.between);
    let springs = scene.springs.iter().map(|s| s.part.between);
    let actuators = scene.actuators.iter().map(|a| a.part.between);
    let mut first: Vec<usize> = (0..scene.bodies.len()).collect();
    for between in contacts.chain(springs).chain(actuators) {
        if let [Some(a), Some(b)] = between.map(moving) {
            join(&mut first, a, b);
        }
    }
    let (mut groups, mut count) = (vec![None; scene.bodies.len()], 0);
    for body in (0..scene.bodies.len()).filter(|body| moving(Side::Body(*body)).is_some()) {
        let root = root(&mut first, body);
        let group = *groups[root].get_or_insert_with(|| {
            count += 1;
            count - 1
        });
        groups[body] = Some(group);
    }
    (groups, count)
}

impl Members {
    /// Whether anything happens among them: springs between bodies at rest are looked at by nobody, and loads that guides carry act
    /// on nobody.
    fn act(&self, scene: &Scene) -> bool {
        let moves = |side: Side| match side {
            Side::Body(body) => follows(&scene.bodies[body].part),
            Side::Ground => false,
        };
        let springs = self.springs.iter().map(|i| scene.springs[*i].part.between);
        let actuators = self.actuators.iter().map(|i| &scene.actuators[*i].part);
        !self.contacts.is_empty()
            || springs.flatten().any(moves)
            || actuators.clone().any(|a| matches!(a.stroke, Varying::Follows(_)))
            || actuators.flat_map(|a| a.between).any(moves)
    }
}

fn follows(body: &Body) -> bool {
    body.coordinates().iter().any(|(_, coordinate)| matches!(coordinate.freedom, Freedom::Follows(_)))
}

/// Puts a body into every part that it touches; into the first one where it touches none, for its columns.
fn seat(scene: &Scene, body: usize, own: Option<usize>, parts: &mut [Members]) {
    let mut seated = false;
    for (k, part) in parts.iter_mut().enumerate() {
        let touches = |between: [Side; 2]| between.contains(&Side::Body(body));
        let is_there = match own {
            Some(own) => own == k,
            None => {
                part.contacts.iter().any(|i| touches(scene.contacts[*i].part.between))
                    || part.springs.iter().any(|i| touches(scene.springs[*i].part.between))
                    || part.actuators.iter().any(|i| touches(scene.actuators[*i].part.between))
            }
        };
        if is_there {
            part.bodies.push(body);
            seated = true;
        }
    }
    if let Some(first) = parts.first_mut().filter(|_| !seated) {
        first.bodies.push(body);
    }
}

/// The first of a body's group.
fn root(group: &mut [usize], mut body: usize) -> usize {
    while group[body] != body {
        group[body] = group[group[body]];
        body = group[body];
    }
    body
}

fn join(group: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(group, a), root(group, b));
    group[a.max(b)] = a.min(b);
}
