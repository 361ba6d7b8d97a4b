//! A contact led along a history.

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

/// Displacement in contact radii from which on a unit was forgotten: strokes of fretting in gross slip are a few of them.
const FAR: f64 = 100.0;
/// Rows of a leg.
const ROWS: usize = 64;
/// Steps of a leg in the map of friction work.
const STEPS: usize = 24;
/// Radii of the fields, out to [`BEYOND`] of the largest contact.
const RADII: usize = 241;
/// Radii of the map of friction work.
const MAP_RADII: usize = 81;
/// A value below this share of the largest on the way is rounding.
const ROUNDING: f64 = 1e-12;
/// A stick radius that misses the contact radius by less than this share of it is all of it.
const AT_EDGE: f64 = 1e-9;
/// Frames of a leg, and legs that have any: the last ones.
const FRAMES: usize = 12;
const FRAMED: usize = 5;
/// Springs of the row, out to as much.
const SPRINGS: usize = 121;

/// What happened on the way.
#[derive(Debug, Clone)]
pub struct Walk {
    /// From the start to the last corner, so many between two corners.
    pub stops: Vec<Stop>,
    /// The start and the corners.
    pub moments: Vec<Moment>,
    /// The springs on the last legs, step by step, where they were asked for.
    pub frames: Vec<Frame>,
    /// Where friction did its work; none for a list of springs.
    pub friction: Option<FrictionCourse>,
    /// Largest indentation on the way, m.
    pub deepest: f64,
}

/// A place on the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Number of the corner that the leg leads to; 0 at the start.
    pub corner: usize,
    /// Share of the leg behind.
    pub share: f64,
    /// Where the contact stands.
    pub apex: Apex,
    /// Normal force, N.
    pub normal_force: f64,
    /// `F_x`, N.
    pub force: f64,
    /// Contact radius, m.
    pub a: f64,
    /// Radius inside which no spring is at its limit, m.
    pub c: f64,
    /// State of the whole contact.
    pub state: ContactState,
    /// Elastic energy of the tangential deformation, J.
    pub elastic: f64,
    /// Friction work since the start, J.
    pub friction: f64,
}

/// A contact at a corner.
#[derive(Debug, Clone)]
pub struct Moment {
    /// Its last stop.
    pub stop: Stop,
    /// Fields from the centre outwards; none for a list of springs.
    pub fields: Vec<Field>,
    /// Its rings.
    pub zones: Vec<Zone>,
    /// The row of springs.
    pub springs: Vec<LoadedSpring>,
    /// Corners (h, p) of the memory curve, m, from the centre to the edge; none while open.
    pub knots: Vec<(f64, f64)>,
}

/// The springs of a contact on the way.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Where the contact stands.
    pub stop: Stop,
    /// The row of springs.
    pub springs: Vec<LoadedSpring>,
}

/// Friction work by place, along the way.
#[derive(Debug, Clone)]
pub struct FrictionCourse {
    /// Distances from the axis, m.
    pub radii: Vec<f64>,
    /// So many in each leg.
    pub steps: Vec<FrictionStep>,
}

/// Friction work by place, so far.
#[derive(Debug, Clone)]
pub struct FrictionStep {
    /// Number of the corner that the leg leads to.
    pub corner: usize,
    /// Share of the leg behind.
    pub share: f64,
    /// Friction work per area, J/m².
    pub work: Vec<f64>,
    /// Way that the surfaces have slid over each other, m.
    pub way: Vec<f64>,
}

impl Walk {
    /// Leads a contact that is pressed so, and was never pushed, along a history; with frames for those who animate them.
    ///
    /// # Errors
    /// A corner that cannot be reached, or more springs at more corners than fit in the memory.
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
            // As committed: a preview knows no state of a move that is none.
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
    /// What is said of a history that leads farther than a contact is wide: its bodies would have left each other.
    pub fn warning(&self, law: &Interface) -> Option<Warning> {
        // Of several the first.
        let stops = self.moments.iter().rev().map(|moment| moment.stop);
        let farthest = stops.max_by(|a, b| a.apex.u.abs().total_cmp(&b.apex.u.abs()))?;
        let (way, radius) = (farthest.apex.u.abs(), law.profile().radius(self.deepest));
        if way <= FAR * radius || radius == 0.0 {
            return None;
        }
        let (times, [way, radius]) = (way / radius, [way, radius].map(|length| quantity(Real(length), "m")));
        let message = format!(
            "corner {} of the history is at a displacement of {way}, {times:.0} contact radii of {radius}, beyond {FAR}: no contact \
             goes so far in one place",
            farthest.corner
        );
        Some(
            Warning::new("displacement", message)
                .help("a bare number is in m: twenty micrometres are \"20 um\""),
        )
    }

    /// A quantity of a stop as people are told it: 0 where it is rounding beside the largest on the way.
    pub fn told(&self, stop: &Stop, of: fn(&Stop) -> f64) -> f64 {
        let largest = self.stops.iter().map(|stop| of(stop).abs()).fold(0.0, f64::max);
        let value = of(stop);
        if value.abs() > ROUNDING * largest { value } else { 0.0 }
    }
}

/// So many places from 0 to an end, m.
fn grid(end: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| end * k as f64 / (count - 1) as f64).collect()
}

/// Middles of so many rings up to a radius, m: neither the tip nor the edge, where pressures may have no bound, is one.
fn rings(radius: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| radius * (k as f64 + 0.5) / count as f64).collect()
}

/// A point of a leg.
fn between(from: Apex, to: Apex, share: f64) -> Apex {
    if share == 1.0 {
        return to;
    }
    Apex { d: from.d + (to.d - from.d) * share, u: from.u + (to.u - from.u) * share }
}

/// The springs at stops of a leg, on a memory of their own.
fn framed(
    law: &Interface,
    memory: &Memory,
    stops: impl Iterator<Item = Stop>,
    row: Option<&Springs>,
) -> Vec<Frame> {
    let mut memory = memory.clone();
    let frame = |stop: Stop| {
        // The leg itself is committed after this, and says what is wrong with it.
        memory.commit(law, Segment::Straight(stop.apex)).ok()?;
        Some(Frame { stop, springs: LoadedSpring::of(law, &memory, row?) })
    };
    stops.filter_map(frame).collect()
}

/// Follows a leg in steps, on a memory of its own.
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
        // The leg itself is committed after this, and says what is wrong with it.
        if memory.commit(law, segment).is_err() {
            return;
        }
        told(share, map);
    }
}

impl Stop {
    /// Where a chord from the memory leads; `friction` (J) is the work before it.
    fn at(
        law: &Interface,
        memory: &Memory,
        apex: Apex,
        (corner, share, friction): (usize, f64, f64),
    ) -> Self {
        let outcome = memory.preview(law, apex);
        let a = law.profile().radius(apex.d);
        // Where springs that slipped are about to lose their contact, rounding leaves some of them.
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

    /// Pulled, and relieved of nearly all its load together with its force: it ends without either, at u = 0. Forces and places of 1e-17
    /// were told, and partial slip of a contact that sticks out to its edge.
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
