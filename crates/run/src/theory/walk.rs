//! Solution of a contact along a load history.

use super::history::History;
use super::loading::worked;
use super::route::{refused, route};
use super::state::LoadedSpring;
use super::{BEYOND, Subject, TheoryError};
use crate::limits::check_history;
use stickslip_contact::{
    Apex, ContactState, Curve, Field, Fields, FirstLoadingError, FrictionMap, Interface, Memory, NormalGiven,
    Segment, Springs, Zone,
};
use stickslip_measure::Warning;
use stickslip_quantity::Real;
use stickslip_quantity::quantity;

/// Displacement, relative to the contact radius, above which the unit was probably forgotten.
const FAR: f64 = 100.0;
/// Number of rows of the table per section between two corners.
const ROWS: usize = 64;
/// Number of steps per section between two corners for the friction work per area.
const STEPS: usize = 24;
/// Number of radii of the fields, up to [`BEYOND`] times the largest contact radius.
const RADII: usize = 241;
/// Number of radii for the friction work per area.
const MAP_RADII: usize = 81;
/// A value below this fraction of the largest value of the history counts as a rounding error.
const ROUNDING: f64 = 1e-12;
/// Relative difference of stick radius and contact radius below which both count as equal.
const AT_EDGE: f64 = 1e-9;
/// Number of animation frames per section, and number of sections at the end of the history that are animated.
const FRAMES: usize = 12;
const FRAMED: usize = 5;
/// Number of springs of a spring row that extends as far as the fields.
const SPRINGS: usize = 121;

/// Solution along a load history.
#[derive(Debug, Clone)]
pub struct Walk {
    /// Points from the start to the last corner, a fixed number per section.
    pub stops: Vec<Stop>,
    /// States of the contact at the start and at the corners.
    pub moments: Vec<Moment>,
    /// States of the springs in the last sections for an animation. Empty unless requested.
    pub frames: Vec<Frame>,
    /// Friction work per area. `None` for lists of springs.
    pub friction: Option<FrictionCourse>,
    /// Largest indentation of the history, m.
    pub deepest: f64,
}

/// State of the contact at a point of the load history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Number of the corner at the end of the section, 0 for the start.
    pub corner: usize,
    /// Completed fraction of the section.
    pub share: f64,
    /// Indentation and displacement.
    pub apex: Apex,
    /// Normal force, N.
    pub normal_force: f64,
    /// Tangential force, N.
    pub force: f64,
    /// Contact radius, m.
    pub a: f64,
    /// Stick radius, m.
    pub c: f64,
    /// State of the contact.
    pub state: ContactState,
    /// Elastic energy of the tangential deformation, J.
    pub elastic: f64,
    /// Friction work since the start, J.
    pub friction: f64,
}

/// State of a contact at a corner.
#[derive(Debug, Clone)]
pub struct Moment {
    /// Forces, radii and energies at the corner.
    pub stop: Stop,
    /// Fields from the centre outwards. Empty for lists of springs.
    pub fields: Vec<Field>,
    /// Concentric zones of stick and slip.
    pub zones: Vec<Zone>,
    /// Row of springs.
    pub springs: Vec<LoadedSpring>,
    /// Breakpoints (h, p) of the slip memory curve, m, from the centre to the edge. Empty while the contact is open.
    pub knots: Vec<(f64, f64)>,
}

/// Springs of a contact at a point of the history.
#[derive(Debug, Clone)]
pub struct Frame {
    /// State of the contact at a point of the load history.
    pub stop: Stop,
    /// Row of springs.
    pub springs: Vec<LoadedSpring>,
}

/// Friction work per area along the history.
#[derive(Debug, Clone)]
pub struct FrictionCourse {
    /// Distances from the axis, m.
    pub radii: Vec<f64>,
    /// Points of the history, a fixed number per section.
    pub steps: Vec<FrictionStep>,
}

/// Friction work per area up to a point of the history.
#[derive(Debug, Clone)]
pub struct FrictionStep {
    /// Number of the corner at the end of the section.
    pub corner: usize,
    /// Completed fraction of the section.
    pub share: f64,
    /// Friction work per area at each radius, J/m².
    pub work: Vec<f64>,
    /// Slip path at each radius, m.
    pub way: Vec<f64>,
}

impl Walk {
    /// Computes a contact along a load history that starts with the normal value `normal`. `has_frames` adds the states for an animation.
    ///
    /// # Errors
    /// A corner cannot be reached, or the springs at all corners exceed the memory limit.
    pub fn of(
        subject: &Subject<'_>,
        normal: NormalGiven,
        history: &History,
        has_frames: bool,
    ) -> Result<Self, TheoryError> {
        let law = subject.law;
        let route = route(law, normal.indentation(law)?, history)?;
        let deepest = route.iter().map(|apex| apex.d).fold(0.0, f64::max);
        let reach = BEYOND * law.profile().radius(deepest);
        let row = Springs::new(law.profile(), SPRINGS, 2.0 * reach).ok();
        let legs = route.len() - 1;
        let framed_legs = if has_frames { FRAMED.min(legs) } else { 0 };
        let springs = row.as_ref().map_or(0, Springs::count);
        check_history(springs, route.len(), FRAMES * framed_legs).map_err(TheoryError::History)?;
        let mut memory = Memory::Curve(Curve::new(law, route[0]));
        let mut map = (Fields::of(law, &memory).is_some() && reach > 0.0)
            .then(|| FrictionMap::new(rings(reach / BEYOND, MAP_RADII)));
        let mut steps = Vec::new();
        let moment = |stop: Stop, memory: &Memory| Moment::at(law, memory, stop, (reach, row.as_ref()));
        let mut friction = 0.0;
        let start = Stop::at(law, &memory, route[0], (0, 1.0, friction));
        let (mut stops, mut moments) = (vec![start], vec![moment(start, &memory)]);
        let mut frames = Vec::new();
        for (corner, pair) in route.windows(2).enumerate().map(|(k, pair)| (k + 1, pair)) {
            let on = |share: f64| between(pair[0], pair[1], share);
            let shares = (1..=ROWS).map(|k| k as f64 / ROWS as f64);
            stops.extend(shares.map(|share| Stop::at(law, &memory, on(share), (corner, share, friction))));
            if corner + framed_legs > legs {
                let stop = |share: f64| Stop::at(law, &memory, on(share), (corner, share, friction));
                let stops = (1..=FRAMES).map(|k| stop(k as f64 / FRAMES as f64));
                frames.extend(framed(law, &memory, stops, row.as_ref()));
            }
            if let Some(map) = &mut map {
                follow(law, &memory, map, pair, |share, map| {
                    let (work, way) = (map.work().to_vec(), map.way().to_vec());
                    steps.push(FrictionStep { corner, share, work, way });
                });
            }
            let done = memory.commit(law, Segment::Straight(pair[1]));
            friction += done.map_err(|_| refused(corner, FirstLoadingError::Displacement(pair[1].u)))?;
            // The state is unknown after a path of length 0.
            let stop = Stop::at(law, &memory, pair[1], (corner, 1.0, friction));
            if let Some(last) = stops.last_mut() {
                *last = stop;
            }
            moments.push(moment(stop, &memory));
        }
        let friction = map.map(|map| FrictionCourse { radii: map.radii().to_vec(), steps });
        Ok(Self { stops, moments, frames, friction, deepest })
    }
}

impl Walk {
    /// Returns a warning if a displacement is much larger than the contact, so that a unit may be missing.
    pub fn warning(&self, law: &Interface) -> Option<Warning> {
        // Of several largest displacements, the first is used.
        let stops = self.moments.iter().rev().map(|moment| moment.stop);
        let farthest = stops.max_by(|a, b| a.apex.u.abs().total_cmp(&b.apex.u.abs()))?;
        let (way, radius) = (farthest.apex.u.abs(), law.profile().radius(self.deepest));
        if way <= FAR * radius || radius == 0.0 {
            return None;
        }
        let (times, [way, radius]) = (way / radius, [way, radius].map(|length| quantity(Real(length), "m")));
        let message = format!(
            "corner {} of the history is at a displacement of {way}, {times:.0} contact radii of {radius}: \
             the limit of a plausible displacement is {FAR}",
            farthest.corner
        );
        Some(
            Warning::new("displacement", message)
                .help("a number without a unit is in m; for twenty micrometres write \"20 um\""),
        )
    }

    /// Returns a quantity at a point for output. Values that are rounding errors compared with the largest value of the history become 0.
    pub fn told(&self, stop: &Stop, of: fn(&Stop) -> f64) -> f64 {
        let largest = self.stops.iter().map(|stop| of(stop).abs()).fold(0.0, f64::max);
        let value = of(stop);
        if value.abs() > ROUNDING * largest { value } else { 0.0 }
    }
}

/// Returns equidistant values from 0 to `end`, m.
fn grid(end: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| end * k as f64 / (count - 1) as f64).collect()
}

/// Returns the mid radii of `count` rings up to a radius, m. The centre and the edge are excluded, because pressures may be infinite there.
fn rings(radius: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| radius * (k as f64 + 0.5) / count as f64).collect()
}

/// Returns the point at a fraction `share` of the section between two points of the history.
fn between(from: Apex, to: Apex, share: f64) -> Apex {
    if share == 1.0 {
        return to;
    }
    Apex { d: from.d + (to.d - from.d) * share, u: from.u + (to.u - from.u) * share }
}

/// Computes the springs at points of a section, using a copy of the slip memory.
fn framed(
    law: &Interface,
    memory: &Memory,
    stops: impl Iterator<Item = Stop>,
    row: Option<&Springs>,
) -> Vec<Frame> {
    let mut memory = memory.clone();
    let frame = |stop: Stop| {
        // The caller commits the section afterwards and reports errors.
        memory.commit(law, Segment::Straight(stop.apex)).ok()?;
        Some(Frame { stop, springs: LoadedSpring::of(law, &memory, row?) })
    };
    stops.filter_map(frame).collect()
}

/// Moves a copy of the slip memory along a section in steps and passes the friction work after each step to `told`.
fn follow(
    law: &Interface,
    memory: &Memory,
    map: &mut FrictionMap,
    leg: &[Apex],
    mut told: impl FnMut(f64, &FrictionMap),
) {
    let mut memory = memory.clone();
    for step in 1..=STEPS {
        let share = step as f64 / STEPS as f64;
        let segment = Segment::Straight(between(leg[0], leg[1], share));
        map.follow(law, &memory, segment);
        // The caller commits the section afterwards and reports errors.
        if memory.commit(law, segment).is_err() {
            return;
        }
        told(share, map);
    }
}

impl Stop {
    /// Computes the state at the end of a straight path from the current slip memory. `friction` (J) is the friction work before this path.
    fn at(
        law: &Interface,
        memory: &Memory,
        apex: Apex,
        (corner, share, friction): (usize, f64, f64),
    ) -> Self {
        let outcome = memory.preview(law, apex);
        let a = law.profile().radius(apex.d);
        // By rounding, a few slipped springs at the edge may still be in contact just before they lift off.
        let sticks = outcome.state == ContactState::Partial && outcome.stick_radius >= (1.0 - AT_EDGE) * a;
        Self {
            corner,
            share,
            apex,
            normal_force: law.normal_force(apex.d),
            force: outcome.force,
            a,
            c: outcome.stick_radius,
            state: if sticks { ContactState::Stick } else { outcome.state },
            elastic: outcome.elastic,
            friction: friction + worked(&outcome),
        }
    }
}

impl Moment {
    fn at(law: &Interface, memory: &Memory, stop: Stop, (reach, row): (f64, Option<&Springs>)) -> Self {
        let fields = Fields::of(law, memory);
        let radii = if reach > 0.0 { grid(reach, RADII) } else { Vec::new() };
        let Memory::Curve(curve) = memory else {
            return Self {
                stop,
                fields: Vec::new(),
                zones: Vec::new(),
                springs: Vec::new(),
                knots: Vec::new(),
            };
        };
        Self {
            stop,
            zones: fields.as_ref().map(Fields::zones).unwrap_or_default(),
            fields: fields.map(|fields| radii.iter().map(|r| fields.at(*r)).collect()).unwrap_or_default(),
            springs: row.map(|row| LoadedSpring::of(law, memory, row)).unwrap_or_default(),
            knots: curve.knots().collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Job;
    use stickslip_scenario::Scenario;

    /// After a history that ends without force at u = 0, force and displacement are exactly 0. A contact that sticks up
    /// to its edge is in full stick.
    #[test]
    fn rounding_is_no_value_and_no_slip() {
        let text = include_str!("../../../../scenarios/fretting_sphere.json");
        let job = Job::new(Scenario::from_str(text, "sphere", "").unwrap(), "sphere".to_owned(), "".into())
            .unwrap();
        let subject = Subject::find(&job, Some("200 nm")).unwrap();
        let history =
            "0.5 N: 0 N, 2 N: 0.4 N, 2 N: -0.7 N, 1.2 N: -0.3 N, 1.2 N: 0.5 N, 2.5 N: 0.5 N, 0.1 N: 0 N";
        let walk = Walk::of(&subject, subject.pressed(), &History::parse(history).unwrap(), false).unwrap();
        for Moment { stop, .. } in &walk.moments {
            let told = [walk.told(stop, |stop| stop.apex.u), walk.told(stop, |stop| stop.force)];
            assert!(told[0] == 0.0 || told[0].abs() > 1e-9, "{told:?}");
            assert!(told[1] == 0.0 || told[1].abs() > 0.1, "{told:?}");
            let slips = stop.state == ContactState::Partial;
            assert_eq!(slips, stop.c < (1.0 - 1e-9) * stop.a, "{stop:?}");
        }
        let states: Vec<ContactState> = walk.moments.iter().map(|moment| moment.stop.state).collect();
        assert!(states.contains(&ContactState::Partial), "{states:?}");
        assert_eq!(states.last(), Some(&ContactState::Stick));
    }
}
