//! Outlines of bodies and shapes of contacts, in px of the drawing, y up.

use super::{Fixture, Scene};
use crate::thin::Point;

/// Model with the scale of its drawing.
#[derive(Clone, Copy)]
pub(super) struct Draft<'s, 'a> {
    pub(super) scene: &'s Scene<'a>,
    /// Px per metre along x and z.
    pub(super) scale: Point,
    /// Scale of symbols, at most 1.
    pub(super) unit: f64,
}

/// Rectangle, y up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rect {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
    pub(super) top: f64,
}

/// Shape of a contact: half of it, from its lowest point outwards.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tip {
    /// Side of the contact that has the shape.
    pub(super) side: usize,
    /// Distances from the axis and heights.
    pub(super) half: Vec<Point>,
    /// Whether the shape is the profile to scale instead of a marker.
    pub(super) is_true: bool,
}

/// Half width of a body without points along the slide, for up to `FEW` bodies and for more; margin of other bodies around their points.
const HALF_WIDTH: f64 = 205.0;
const NARROW: f64 = 100.0;
const FEW: usize = 4;
const RIM: f64 = 45.0;
/// Height of a body without points normal to the slide, and minimum height of other bodies.
pub(super) const HEIGHT: f64 = 110.0;
/// Distance of contacts on a body without given points, and of bodies on such contacts.
const SLOT: f64 = 260.0;
const GAP: f64 = 50.0;
/// Minimum height of a foot, which leaves room for a name.
const LEG: f64 = 64.0;
/// Marker of a contact whose profile cannot be drawn: radius and height.
const MARKER: Point = (11.0, 15.0);
/// Minimum radius, maximum radius and minimum height of a profile in the drawing.
const PROFILE: (f64, f64, f64) = (7.0, 90.0, 4.0);
/// Relative tolerance of the curvature for a body that is drawn as a ball.
const ROUND: f64 = 0.03;

impl Rect {
    /// Returns the rectangle of zero size at a point.
    pub(super) fn of((x, y): Point) -> Self {
        Self { left: x, right: x, bottom: y, top: y }
    }

    pub(super) fn include(self, (x, y): Point) -> Self {
        let Self { left, right, bottom, top } = self;
        Self { left: left.min(x), right: right.max(x), bottom: bottom.min(y), top: top.max(y) }
    }

    pub(super) fn union(self, other: Self) -> Self {
        self.include((other.left, other.bottom)).include((other.right, other.top))
    }

    pub(super) fn moved(self, (x, y): Point) -> Self {
        let Self { left, right, bottom, top } = self;
        Self { left: left + x, right: right + x, bottom: bottom + y, top: top + y }
    }

    pub(super) fn centre(self) -> Point {
        (f64::midpoint(self.left, self.right), f64::midpoint(self.bottom, self.top))
    }

    pub(super) fn corners(self) -> [Point; 4] {
        let Self { left, right, bottom, top } = self;
        [(left, bottom), (right, bottom), (right, top), (left, top)]
    }
}

impl Tip {
    pub(super) fn radius(&self) -> f64 {
        self.half.last().map_or(0.0, |end| end.0)
    }

    pub(super) fn height(&self) -> f64 {
        self.half.last().map_or(0.0, |end| end.1)
    }

    /// Returns the part of the shape below a height.
    pub(super) fn below(&self, height: f64) -> Vec<Point> {
        let mut points = Vec::new();
        for &(r, h) in &self.half {
            if h > height {
                if let Some(&(near, low)) = points.last() {
                    points.push((near + (r - near) * (height - low) / (h - low), height));
                }
                break;
            }
            points.push((r, h));
        }
        points
    }
}

impl Draft<'_, '_> {
    pub(super) fn px(&self, (x, z): Point) -> Point {
        (self.scale.0 * x, self.scale.1 * z)
    }

    /// Returns the contacts of a body: index of the contact and side of the body, 0 if the body is below.
    pub(super) fn contacts_of(&self, body: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        let of = move |side: usize| move |fixture: &Fixture| (fixture.body == Some(body)).then_some(side);
        self.scene.contacts.iter().enumerate().flat_map(move |(place, contact)| {
            let sides = contact.between.iter().enumerate();
            sides.filter_map(move |(side, fixture)| of(side)(fixture).map(|side| (place, side)))
        })
    }

    /// Returns the points of a body other than contacts, its reference point first.
    pub(super) fn inner_points(&self, body: usize) -> impl Iterator<Item = Point> + '_ {
        let ends = self.scene.links.iter().flat_map(|link| link.between);
        let links = ends.filter(move |fixture| fixture.body == Some(body)).map(|fixture| fixture.at);
        let loads = self.scene.loads.iter().filter(move |load| load.body == body).map(|load| load.at);
        std::iter::once((0.0, 0.0)).chain(links).chain(loads).map(|at| self.px(at))
    }

    /// Returns whether a body has points away from its reference point along x and along z.
    pub(super) fn is_given(&self, body: usize) -> (bool, bool) {
        let contacts =
            self.contacts_of(body).map(|(place, side)| self.scene.contacts[place].between[side].at);
        let mut given = (false, false);
        for (x, z) in contacts.chain(self.inner_points(body)) {
            given = (given.0 || x != 0.0, given.1 || z != 0.0);
        }
        given
    }

    /// Returns the shape of a contact: its profile if visible, otherwise a marker. The shape belongs to the side with a given point, or to
    /// the body with fewer contacts.
    pub(super) fn tip(&self, contact: usize) -> Tip {
        let contact = &self.scene.contacts[contact];
        let rank = |fixture: &Fixture| match fixture.body {
            None => (true, false, 0),
            Some(body) => (false, fixture.at == (0.0, 0.0), self.contacts_of(body).count()),
        };
        let side = usize::from(rank(&contact.between[1]) < rank(&contact.between[0]));
        let (least, most, visible) = PROFILE;
        let px = contact.profile.iter().map(|&point| self.px(point));
        let half: Vec<Point> = px.take_while(|point| point.0 <= most * self.unit).collect();
        let tip = Tip { side, half, is_true: true };
        if tip.radius() >= least && tip.height() >= visible {
            return tip;
        }
        let half = vec![(0.0, 0.0), (MARKER.0 * self.unit, MARKER.1 * self.unit)];
        Tip { side, half, is_true: false }
    }

    /// Returns the radius in m of a ball, a body with one contact and a profile curved around the reference point; `None` for other bodies.
    pub(super) fn ball(&self, body: usize) -> Option<f64> {
        let mut contacts = self.contacts_of(body);
        let (Some((place, side)), None) = (contacts.next(), contacts.next()) else { return None };
        let contact = &self.scene.contacts[place];
        let (x, z) = contact.between[side].at;
        let (radius, others) = (z.abs(), contact.between[1 - side]);
        let near = contact.profile.iter().rfind(|(r, _)| *r <= 0.2 * radius)?;
        let is_round = near.0 > 0.0 && (near.1 * 2.0 * radius / near.0.powi(2) - 1.0).abs() < ROUND;
        let inside = (self.scale.0 * radius).min(self.scale.1 * radius);
        let holds_all = self.inner_points(body).all(|(x, y)| math::hypot(x, y) <= inside);
        (x == 0.0 && others.at == (0.0, 0.0) && is_round && holds_all).then_some(radius)
    }

    /// Returns the height of a foot, from its contact to the face of the body.
    fn foot(&self, tip: &Tip) -> f64 {
        tip.height().max(LEG * self.unit)
    }

    /// Returns the half width of a body without points along the slide.
    fn half_width(&self) -> f64 {
        self.unit * if self.scene.bodies.len() > FEW { NARROW } else { HALF_WIDTH }
    }

    /// Returns the contact point relative to the body's reference point. Without given points, contacts are placed side by side on the
    /// upper or lower face.
    pub(super) fn contact_point(&self, body: usize, place: usize, side: usize) -> Point {
        let (given_x, given_z) = self.is_given(body);
        let (x, z) = self.px(self.scene.contacts[place].between[side].at);
        let tip = self.tip(place);
        let foot = if tip.side == side { self.foot(&tip) } else { 0.0 };
        let up = if side == 0 { 1.0 } else { -1.0 };
        let z = if given_z { z } else { up * (HEIGHT / 2.0 * self.unit + foot) };
        (if given_x { x } else { self.slot(body, place, side) }, z)
    }

    fn slot(&self, body: usize, place: usize, side: usize) -> f64 {
        let other = |contact: usize| self.scene.contacts[contact].between[1 - side].body;
        let says_nothing = |contact: usize| other(contact).is_none_or(|body| !self.is_given(body).0);
        let slots: Vec<usize> =
            self.contacts_of(body).filter(|of| of.1 == side && says_nothing(of.0)).map(|of| of.0).collect();
        let widest = slots.iter().map(|&contact| 2.6 * self.tip(contact).radius()).fold(0.0, f64::max);
        let are_several = slots.windows(2).any(|pair| other(pair[0]) != other(pair[1]));
        let bodies = 2.0 * self.half_width() + GAP * self.unit;
        let step = widest.max(if are_several { bodies } else { SLOT * self.unit });
        let at = slots.iter().position(|&contact| contact == place).unwrap_or(0) as f64;
        (at - (slots.len().max(1) - 1) as f64 / 2.0) * step
    }

    /// Returns the outline of a body around its reference point with its contacts on its faces. The outline is symmetric about the
    /// reference point as far as the contacts allow.
    pub(super) fn outline(&self, body: usize, contacts: &[(usize, usize, Point)]) -> Rect {
        if let Some(radius) = self.ball(body) {
            let (x, y) = self.px((radius, radius));
            return Rect { left: -x, right: x, bottom: -y, top: y };
        }
        let (given_x, given_z) = self.is_given(body);
        let inner = self.inner_points(body).fold(Rect::of((0.0, 0.0)), Rect::include);
        let rim = RIM * self.unit;
        let (mut left, mut right) = (inner.left - rim, inner.right + rim);
        let (mut floor, mut ceiling) = (None::<f64>, None::<f64>);
        for &(place, side, (x, y)) in contacts {
            let tip = self.tip(place);
            let (radius, foot) = if tip.side == side { (tip.radius(), self.foot(&tip)) } else { (0.0, 0.0) };
            let beside = radius + rim * if given_x { 0.5 } else { 1.5 };
            (left, right) = (left.min(x - beside), right.max(x + beside));
            if side == 0 {
                ceiling = Some(ceiling.unwrap_or(f64::MAX).min(y - foot));
            } else {
                floor = Some(floor.unwrap_or(f64::MIN).max(y + foot));
            }
        }
        let half = if given_x { rim } else { self.half_width() };
        let half = half.max(-left).max(right);
        let (bottom, top) = self.heights(given_z, inner, (floor, ceiling));
        Rect { left: -half, right: half, bottom, top }
    }

    fn heights(&self, given: bool, inner: Rect, faces: (Option<f64>, Option<f64>)) -> (f64, f64) {
        let (height, rim) = (HEIGHT * self.unit, RIM * self.unit);
        if !given {
            return match faces {
                (Some(floor), Some(ceiling)) => (floor.min(ceiling - height), ceiling.max(floor + height)),
                (Some(floor), None) => (floor, floor + height),
                (None, Some(ceiling)) => (ceiling - height, ceiling),
                (None, None) => (-height / 2.0, height / 2.0),
            };
        }
        let bottom = faces.0.map(|floor| floor.min(inner.bottom - rim / 4.0));
        let top = faces.1.map(|ceiling| ceiling.max(inner.top + rim / 4.0));
        let (low, high) = (inner.bottom - rim, inner.top + rim);
        match (bottom, top) {
            (Some(bottom), Some(top)) => (bottom, top.max(bottom + height)),
            (Some(bottom), None) => (bottom, high.max(-bottom).max(bottom + height)),
            (None, Some(top)) => (low.min(-top).min(top - height), top),
            (None, None) => (low.min(-height / 2.0), high.max(height / 2.0)),
        }
    }
}
