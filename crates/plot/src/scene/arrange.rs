//! Positions of the bodies of a model in the drawing.

use super::outline::{Draft, Rect};
use crate::thin::Point;

/// Positions of bodies and contacts, px, y up.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Arrangement {
    pub(super) references: Vec<Point>,
    pub(super) outlines: Vec<Rect>,
    pub(super) contacts: Vec<Point>,
    /// Index of the group of connected bodies for each body.
    pub(super) groups: Vec<usize>,
}

/// Distance between bodies connected by a spring, and between groups of bodies.
pub(super) const LINK: f64 = 150.0;
const APART: f64 = 150.0;
/// Distance between a body and another body that it would otherwise overlap.
const RIGHT: f64 = 60.0;

/// Arranges the bodies. Touching bodies have common contact points. Bodies connected by a spring or stack are a fixed
/// distance apart. Groups of connected bodies stand side by side, with their lowest contact at ground level.
pub(super) fn arrange(draft: &Draft<'_, '_>) -> Arrangement {
    let count = draft.scene.bodies.len();
    let mut plan = Plan { draft, places: vec![None; count] };
    let mut groups = vec![usize::MAX; count];
    let mut right: Option<f64> = None;
    for (group, members) in members(draft).iter().enumerate() {
        let most = members.iter().max_by_key(|&&body| (plan.contacts(body), std::cmp::Reverse(body)));
        let Some(&root) = most else { continue };
        plan.places[root] = Some((0.0, 0.0));
        while let Some((body, at)) = plan.next_touching().or_else(|| plan.next_linked()) {
            plan.places[body] = Some(at);
        }
        let outline = |plan: &Plan<'_, '_, '_>, body: usize| {
            plan.places[body].map_or(Rect::of((0.0, 0.0)), |at| plan.outline(body).moved(at))
        };
        let whole = members.iter().map(|&body| outline(&plan, body)).reduce(Rect::union);
        let whole = whole.unwrap_or(Rect::of((0.0, 0.0)));
        let across = right.map_or(0.0, |right| right + APART * draft.unit - whole.left);
        let floor = plan.floor(members);
        for &body in members {
            groups[body] = group;
            plan.places[body] = plan.places[body].map(|(x, z)| (x + across, z - floor));
        }
        right = Some(whole.right + across);
    }
    let references: Vec<Point> = plan.places.iter().map(|place| place.unwrap_or_default()).collect();
    finished(draft, references, groups)
}

/// Returns the outlines and contact points of bodies at their positions.
fn finished(draft: &Draft<'_, '_>, references: Vec<Point>, groups: Vec<usize>) -> Arrangement {
    let of = |place: usize| {
        let sides = draft.scene.contacts[place].between;
        let mut at = (0.0, 0.0);
        let mut rank = (0, 0);
        for (side, body) in [0, 1].into_iter().filter_map(|side| Some((side, sides[side].body?))) {
            let (given_x, given_z) = draft.is_given(body);
            let own = draft.contact_point(body, place, side);
            let own = (own.0 + references[body].0, own.1 + references[body].1);
            // If both or neither body prescribes the coordinate, the second side counts.
            let weight = |given: bool| if given { 2 } else { 1 };
            if weight(given_x) >= rank.0 {
                (at.0, rank.0) = (own.0, weight(given_x));
            }
            if weight(given_z) >= rank.1 {
                (at.1, rank.1) = (own.1, weight(given_z));
            }
        }
        at
    };
    let contacts: Vec<Point> = (0..draft.scene.contacts.len()).map(of).collect();
    let outline = |(body, reference): (usize, &Point)| {
        let own = |(place, side): (usize, usize)| {
            (place, side, (contacts[place].0 - reference.0, contacts[place].1 - reference.1))
        };
        let own: Vec<_> = draft.contacts_of(body).map(own).collect();
        draft.outline(body, &own).moved(*reference)
    };
    let outlines = references.iter().enumerate().map(outline).collect();
    Arrangement { references, outlines, contacts, groups }
}

/// Groups of bodies that are connected by contacts and links, not by the ground.
fn members(draft: &Draft<'_, '_>) -> Vec<Vec<usize>> {
    let mut group: Vec<usize> = (0..draft.scene.bodies.len()).collect();
    let contacts = draft.scene.contacts.iter().map(|contact| contact.between);
    for sides in contacts.chain(draft.scene.links.iter().map(|link| link.between)) {
        if let [Some(a), Some(b)] = sides.map(|side| side.body) {
            let (kept, gone) = (group[a].min(group[b]), group[a].max(group[b]));
            group.iter_mut().filter(|of| **of == gone).for_each(|of| *of = kept);
        }
    }
    let of = |first: usize| (0..group.len()).filter(|&body| group[body] == first).collect::<Vec<_>>();
    (0..group.len()).map(of).filter(|members| !members.is_empty()).collect()
}

/// Positions during the arrangement; `None` for bodies not placed yet.
struct Plan<'d, 's, 'a> {
    draft: &'d Draft<'s, 'a>,
    places: Vec<Option<Point>>,
}

impl Plan<'_, '_, '_> {
    fn contacts(&self, body: usize) -> usize {
        self.draft.contacts_of(body).count()
    }

    fn outline(&self, body: usize) -> Rect {
        let at = |(place, side)| (place, side, self.draft.contact_point(body, place, side));
        let own: Vec<_> = self.draft.contacts_of(body).map(at).collect();
        self.draft.outline(body, &own)
    }

    /// Returns the placed and the new body of a pair, each with its side. Returns `None` unless exactly one of the two bodies is placed.
    fn pair(&self, sides: [Option<usize>; 2]) -> Option<[(usize, usize); 2]> {
        let [a, b] = [sides[0]?, sides[1]?];
        match (self.places[a].is_some(), self.places[b].is_some()) {
            (true, false) => Some([(a, 0), (b, 1)]),
            (false, true) => Some([(b, 1), (a, 0)]),
            _ => None,
        }
    }

    /// Returns the next body that touches a placed body, and its position.
    fn next_touching(&self) -> Option<(usize, Point)> {
        let scene = self.draft.scene;
        let sides = |place: usize| scene.contacts[place].between.map(|side| side.body);
        let (place, [(old, below), (new, above)]) =
            (0..scene.contacts.len()).find_map(|place| Some((place, self.pair(sides(place))?)))?;
        let (x, z) = self.places[old]?;
        let point = |body: usize, side: usize| self.draft.contact_point(body, place, side);
        let z = z + point(old, below).1 - point(new, above).1;
        // All contacts of the two bodies are centred on each other.
        let shared: Vec<usize> =
            (0..scene.contacts.len()).filter(|&other| sides(other) == sides(place)).collect();
        let given = (self.draft.is_given(old).0, self.draft.is_given(new).0);
        let middle = |body: usize, side: usize| {
            let xs = shared.iter().map(|&place| self.draft.contact_point(body, place, side).0);
            xs.sum::<f64>() / shared.len() as f64
        };
        let x = x + match given {
            (true, true) => point(old, below).0 - point(new, above).0,
            (true, false) => middle(old, below),
            (false, true) => middle(old, below) - middle(new, above),
            (false, false) => point(old, below).0 - point(new, above).0,
        };
        let way = if given == (true, true) { 0.0 } else { self.way_out(new, (x, z), Some(old)) };
        Some((new, (x + way, z)))
    }

    /// Returns the next body that is linked to a placed body, and its position.
    fn next_linked(&self) -> Option<(usize, Point)> {
        let (unit, scene) = (self.draft.unit, self.draft.scene);
        let (link, [(old, from), (new, to)]) = scene
            .links
            .iter()
            .find_map(|link| Some((link, self.pair(link.between.map(|side| side.body))?)))?;
        let at = self.places[old]?;
        let (outline, own) = (self.outline(old).moved(at), self.outline(new));
        let [start, end] = [from, to].map(|side| self.draft.px(link.between[side].at));
        let (x, z) = (at.0 + start.0 - end.0, at.1 + start.1 - end.1);
        let gap = LINK * unit;
        // The second side is further along the axis.
        if link.is_upright {
            let z = if to == 1 { outline.top + gap - own.bottom } else { outline.bottom - gap - own.top };
            return Some((new, (x + self.way_out(new, (x, z), None), z)));
        }
        let z = self.level(new).unwrap_or(z);
        let beyond = self.others(own.moved((0.0, z)), None);
        let x = if to == 1 {
            beyond.map(|other| other.right).fold(outline.right, f64::max) + gap - own.left
        } else {
            beyond.map(|other| other.left).fold(outline.left, f64::min) - gap - own.right
        };
        Some((new, (x, z)))
    }

    /// Returns the outlines of the placed bodies except `but` that overlap a rectangle in height.
    fn others(&self, at: Rect, but: Option<usize>) -> impl Iterator<Item = Rect> + '_ {
        let placed = self.places.iter().enumerate().filter(move |(body, _)| Some(*body) != but);
        let placed = placed.filter_map(|(body, place)| Some(self.outline(body).moved((*place)?)));
        placed.filter(move |other| other.bottom < at.top && other.top > at.bottom)
    }

    /// Returns the shift to the right by which a body avoids overlap with placed bodies other than `but`, which it touches.
    fn way_out(&self, body: usize, at: Point, but: Option<usize>) -> f64 {
        let own = self.outline(body).moved(at);
        let in_the_way = |other: &Rect| other.left < own.right && other.right > own.left;
        if !self.others(own, but).any(|other| in_the_way(&other)) {
            return 0.0;
        }
        let end = self.others(own, but).map(|other| other.right).fold(own.left, f64::max);
        end + RIGHT * self.draft.unit - own.left
    }

    /// Returns the height of a body on the ground, if another body of its group is on the ground.
    fn level(&self, body: usize) -> Option<f64> {
        let on_ground = |(place, side): &(usize, usize)| {
            *side == 1 && self.draft.scene.contacts[*place].between[0].body.is_none()
        };
        let foot = |body: usize| {
            let (place, side) = self.draft.contacts_of(body).find(on_ground)?;
            Some(self.draft.contact_point(body, place, side).1)
        };
        let own = foot(body)?;
        let placed = self.places.iter().enumerate();
        let ground = placed.filter_map(|(other, place)| Some((*place)?.1 + foot(other)?)).next()?;
        Some(ground - own)
    }

    /// Returns the ground level of a group: its lowest contact with the ground, otherwise its lowest contact, otherwise its first body.
    fn floor(&self, members: &[usize]) -> f64 {
        let (mut ground, mut any) = (f64::MAX, f64::MAX);
        for &body in members {
            let Some((_, z)) = self.places[body] else { continue };
            for (place, side) in self.draft.contacts_of(body) {
                let height = z + self.draft.contact_point(body, place, side).1;
                any = any.min(height);
                if self.draft.scene.contacts[place].between[1 - side].body.is_none() {
                    ground = ground.min(height);
                }
            }
        }
        let first = members.first().and_then(|&body| self.places[body]).map_or(0.0, |place| place.1);
        [ground, any, first].into_iter().find(|height| *height < f64::MAX).unwrap_or(0.0)
    }
}
