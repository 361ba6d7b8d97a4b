//! Parts of a scene that feel nothing of each other.
//!
//! Bodies that move by forces are joined by the contacts, springs and actuators between them; the ground and what follows a
//! waveform join nothing, since nothing moves them. What has nothing free on either side, such as a contact that is walked
//! along a prescribed path, is a part of its own. Each part is a model as if there were nothing else in the scene, so that what
//! comes of it is what comes of it alone.

mod alone;
mod members;

use super::{Balanced, Binding, Body, Free, Model};
use crate::component::Component;
use crate::event::Source;
use crate::scene::{Scene, Side};
use crate::{Part as Place, SceneError};
use alone::{alone, read};
use members::{Members, members};

/// Energies at the end of a row.
pub(crate) const ENERGIES: usize = 6;

/// A part of a scene, and where what is in it lies in the whole.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Part {
    /// The part alone.
    pub(crate) model: Model,
    /// Of its waveforms, bodies and contacts the places in the scene.
    pub(crate) waveforms: Vec<usize>,
    pub(crate) bodies: Vec<usize>,
    pub(crate) contacts: Vec<usize>,
    /// Of its free coordinates the places among those of the whole.
    pub(crate) free: Vec<usize>,
    /// Of its components but for the work put in and what dampers have taken, their own place and that in the whole.
    pub(crate) components: Vec<(usize, usize)>,
    /// Of the channels that are its own, their own place and that in the whole.
    pub(crate) channels: Vec<(usize, usize)>,
}

impl Model {
    /// How many parts of its scene feel nothing of each other: a run between located events takes each for itself.
    #[must_use]
    pub fn part_count(&self) -> usize {
        self.parts.len().max(1)
    }

    /// The contacts of each part; none where the scene is one part.
    pub fn part_contacts(&self) -> impl Iterator<Item = &[usize]> {
        self.parts.iter().map(|part| part.contacts.as_slice())
    }

    /// Steps all parts together, as one: for a record that wants so many rows of its own ([`Record::next_mark`](crate::Record))
    /// that parts would have to wait for each other at every step.
    pub fn keep_together(&mut self) {
        self.parts.clear();
    }

    /// Values of a row.
    pub(crate) fn channel_count(&self) -> usize {
        let moving = self.bodies.iter().map(Body::columns).sum::<usize>();
        let contacts = self.contacts.iter().map(|c| c.columns().len()).sum::<usize>();
        let blocks = self.blocks.iter().map(|wired| wired.block().columns().len()).sum::<usize>();
        1 + moving + contacts + blocks + ENERGIES
    }

    /// A waveform as a part counts them.
    pub(crate) fn waveform_in(&self, part: usize, waveform: usize) -> Option<usize> {
        self.parts[part].waveforms.iter().position(|w| *w == waveform)
    }

    /// The part in which a body moves by forces, and its place there.
    pub(crate) fn part_of(&self, body: usize) -> Option<(usize, usize)> {
        let own = |part: &Part| part.bodies.iter().position(|b| *b == body);
        self.parts.iter().enumerate().find_map(|(k, part)| Some((k, own(part)?)))
    }
}

/// The parts of a scene; none where it is one, and where waveforms or blocks are not known beforehand: what callers supply and
/// command belongs to the state of the whole, and blocks know each other by their places in the scene.
pub(super) fn divide(scene: &Scene, whole: &Model) -> Vec<Part> {
    let commanded = |w: &crate::Waveform| w.interpolation().is_some() || w.generator().is_some();
    if is_single(scene) || !scene.blocks.is_empty() || whole.waveforms.iter().any(commanded) {
        return Vec::new();
    }
    let members = members(scene);
    if members.len() < 2 {
        return Vec::new();
    }
    let mut unread = vec![true; whole.bodies.len()];
    let parts: Option<Vec<Part>> =
        members.iter().map(|members| Part::new(scene, whole, members, &mut unread)).collect();
    // A part that is no scene by itself leaves the whole undivided.
    parts
        .filter(|parts| parts.iter().map(|part| part.free.len()).sum::<usize>() == whole.free.len())
        .unwrap_or_default()
}

/// Whether a single body moves and everything touches it, as in most drives: that is one part without a search.
fn is_single(scene: &Scene) -> bool {
    let mut moving =
        scene.bodies.iter().enumerate().filter(|(_, b)| b.part.is_free() || b.part.is_balanced());
    let (Some((only, _)), None) = (moving.next(), moving.next()) else { return false };
    let touches = |between: [Side; 2]| between.contains(&Side::Body(only));
    scene.contacts.iter().all(|c| touches(c.part.between))
        && scene.springs.iter().all(|s| touches(s.part.between))
        && scene.actuators.iter().all(|a| touches(a.part.between))
}

impl Body {
    /// Values of a row that are its own: a place and a rate of every coordinate that is not held.
    fn columns(&self) -> usize {
        2 * self.bindings.iter().filter(|binding| !matches!(binding, Binding::Held(_))).count()
    }
}

impl Part {
    fn new(scene: &Scene, whole: &Model, members: &Members, unread: &mut [bool]) -> Option<Self> {
        let waveforms = read(scene, members);
        let model = Model::new(&alone(scene, members, &waveforms)?).ok()?;
        let Members { bodies, contacts, .. } = members;
        let place = |free: &Free| match whole.bodies[bodies[free.body]].bindings[free.axis as usize] {
            Binding::Free(i) => Some(i),
            Binding::Held(_) | Binding::Driven(_) => None,
        };
        let free = model.free.iter().map(place).collect::<Option<Vec<_>>>()?;
        let components = components((&model, bodies, contacts), whole, &free)?;
        let channels = channels((&model, bodies, contacts), whole, unread);
        let (bodies, contacts) = (bodies.clone(), contacts.clone());
        Some(Self { model, waveforms, bodies, contacts, free, components, channels })
    }

    /// Where an event comes from, as the whole counts its places.
    pub(crate) fn source(&self, source: Source) -> Source {
        match source {
            Source::Contact(c) => Source::Contact(self.contacts[c]),
            Source::Waveform(w) => Source::Waveform(self.waveforms[w]),
            Source::Block(k) => Source::Block(k),
        }
    }

    /// What is wrong with the part, by its place in the whole scene.
    pub(crate) fn in_the_whole(&self, error: SceneError) -> SceneError {
        let part = match error.part {
            Place::Body(body) => Place::Body(self.bodies[body]),
            Place::Contact(contact) => Place::Contact(self.contacts[contact]),
            other => other,
        };
        SceneError { part, ..error }
    }
}

/// The components of a part, and where they lie in the whole; none where the whole counts others.
fn components(
    (model, bodies, contacts): (&Model, &[usize], &[usize]),
    whole: &Model,
    free: &[usize],
) -> Option<Vec<(usize, usize)>> {
    let (own, all) = (model.layout(), whole.layout());
    let mut places = Vec::with_capacity(own.total());
    for (i, &place) in free.iter().enumerate() {
        places.extend([(i, place), (own.velocity(i), all.velocity(place))]);
    }
    for (contact, &c) in model.contacts.iter().zip(contacts) {
        match (contact.slot, whole.contacts[c].slot) {
            (Some(a), Some(b)) => places.extend([
                (own.force(a), all.force(b)),
                (own.elastic(a), all.elastic(b)),
                (own.friction(a), all.friction(b)),
            ]),
            (None, None) => {}
            _ => return None,
        }
    }
    for balanced in &model.balanced {
        let is_it = |b: &&Balanced| b.body == bodies[balanced.body] && b.axis == balanced.axis;
        match (balanced.slot, whole.balanced.iter().find(is_it)?.slot) {
            (Some(a), Some(b)) => places.push((own.balanced(a), all.balanced(b))),
            (None, None) => {}
            _ => return None,
        }
    }
    (places.len() + 2 == own.total()).then_some(places)
}

/// The channels of a part that no part before it has, and where they lie in the whole: those of a follower are in every part that
/// it touches.
fn channels(
    (model, bodies, contacts): (&Model, &[usize], &[usize]),
    whole: &Model,
    unread: &mut [bool],
) -> Vec<(usize, usize)> {
    let starts = |model: &Model| {
        // Time comes first.
        let counts =
            model.bodies.iter().map(Body::columns).chain(model.contacts.iter().map(|c| c.columns().len()));
        let from = |next: &mut usize, count: usize| Some(std::mem::replace(next, *next + count));
        counts.scan(1, from).collect::<Vec<usize>>()
    };
    let (own, all) = (starts(model), starts(whole));
    let mut places = Vec::new();
    for (i, &body) in bodies.iter().enumerate().filter(|(_, body)| std::mem::take(&mut unread[**body])) {
        places.extend((0..model.bodies[i].columns()).map(|k| (own[i] + k, all[body] + k)));
    }
    for (i, contact) in model.contacts.iter().enumerate() {
        let (from, to) = (own[bodies.len() + i], all[whole.bodies.len() + contacts[i]]);
        places.extend((0..contact.columns().len()).map(|k| (from + k, to + k)));
    }
    places
}
