//! Construction of a contact's constants.
//!
//! First the normal load is built. The largest expected indentation shows whether the contact can carry a force, and determines the width
//! of a row of springs and the natural scales. The engine (memory curve or row of springs) and the initial displacement follow. Indices of
//! growing contacts and natural scales are set when all contacts are known.

use super::reach::{self, Pile};
use super::{Body, Free, Link, Load, Measure, Signals};
use crate::contact::{Contact, Natural, Press};
use crate::scene::{
    self, ContactStart, Direction, EngineChoice, Named, Normal, NormalDamping, Point, Side, Stop, Varying,
};
use crate::{Field, Part, SceneError, SceneFault};
use std::sync::Arc;
use stickslip_contact::{
    Engine, FirstLoading, FirstLoadingError, Interface, NormalGiven, Pair, Profile, Springs, SpringsError,
    TangentialGiven,
};

/// Other parts of the model, for the construction of a contact.
pub(super) struct Surroundings<'a> {
    pub(super) signals: Signals<'a>,
    pub(super) contacts: &'a [Named<scene::Contact>],
    pub(super) bodies: &'a [Body],
    pub(super) free: &'a [Free],
    pub(super) links: &'a [Link],
    pub(super) loads: &'a [Load],
    /// Free z coordinates of other bodies that contacts connect with each free coordinate; the weight of these bodies may rest on it.
    pub(super) piled: &'a [Vec<usize>],
    /// Whether the bodies start in equilibrium.
    pub(super) equilibrium: bool,
}

/// Known properties of the normal load.
#[derive(Debug, Clone, Copy)]
struct Pressed {
    /// Largest indentation, m; for a coupled contact an estimate from initial loads and motions.
    deepest: f64,
    /// Indentation at t = 0, m.
    first: f64,
    /// Normal force at t = 0, N; identical to the input value if the input is a force.
    force: f64,
}

/// Ratio of friction limit to other forces below which the friction force is lost in rounding.
const UNRESOLVED: f64 = 1e-12;

/// Largest number of times that a row of springs is widened.
const WIDENED: usize = 16;

/// Field of a contact and fault in it.
type Refused = (Field, SceneFault);

/// Returns the constants of a contact, and its largest indentation. Name, growth index and natural scales are set later.
pub(super) fn build(
    place: usize,
    part: &scene::Contact,
    around: &Surroundings<'_>,
) -> Result<(Contact, f64), SceneError> {
    along(place, part, Direction::Z, around).map_err(|(field, fault)| fault.of(Part::Contact(place), field))
}

/// Returns a stop as a contact without friction along its axis, with the force k(p + cṗ/k): a flat punch of the stiffness k with damping
/// along the normal. `end` is 0 for the lowest and 1 for the highest position. Also returns the largest penetration.
pub(super) fn stop(
    (place, named): (usize, &Named<Stop>),
    end: usize,
    (index, around): (usize, &Surroundings<'_>),
) -> Result<Option<(Contact, f64)>, SceneError> {
    let part = &named.part;
    let Some(position) = part.ends[end] else { return Ok(None) };
    let refused = |fault: SceneFault| fault.of(Part::Stop(place), Field::End(end));
    // The stiffness of a flat punch is 2aE*, here with a = 0.5 m.
    let pair = Pair::from_moduli(part.stiffness, part.stiffness);
    let law =
        pair.ok().zip(Profile::flat(0.5).ok()).map(|(pair, profile)| Interface::new(pair, profile, 0.0));
    let Some(Ok(interface)) = law else { return Err(refused(SceneFault::NotFinite(part.stiffness))) };
    let body = Side::Body(part.on);
    let (between, gap) =
        if end == 0 { ([Side::Ground, body], -position) } else { ([body, Side::Ground], position) };
    let contact = scene::Contact {
        between,
        at: [Point::default(); 2],
        interface,
        normal: Normal::Coupled,
        gap,
        normal_damping: NormalDamping::Time(part.damping / part.stiffness),
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    };
    let (mut contact, deepest) =
        along(index, &contact, part.direction, around).map_err(|(_, fault)| refused(fault))?;
    if contact.coupling().is_some_and(|d| around.at_start(d) > 0.0) {
        return Err(refused(SceneFault::InsideStop(position)));
    }
    contact.stop = true;
    contact.name = format!("{}_{}", named.name, ["low", "high"][end]);
    Ok(Some((contact, deepest)))
}

/// Returns the constants of a contact whose normal is along an axis, and its largest indentation.
fn along(
    place: usize,
    part: &scene::Contact,
    axis: Direction,
    around: &Surroundings<'_>,
) -> Result<(Contact, f64), Refused> {
    let [first, second] = part.between;
    let mut law = part.interface.clone();
    let (mut pressed, mut known) = press(part, &law, (axis, around))?;
    let across = if axis == Direction::Z { Direction::X } else { Direction::Z };
    let mut u = Measure::between([(first, part.at[0]), (second, part.at[1])], across, around.bodies);
    if around.is_rounding(&law, f64::from(part.count.max(1)), (&u, known.deepest)) {
        law = law.frictionless();
    }
    let inert = law.friction() == 0.0 || known.deepest <= 0.0;
    let engine = engine(part, &pressed, known, around)?;
    if let Engine::Row(springs) = &engine {
        // The row's own normal force applies; natural scales remain those of the profile.
        law = law.on_springs(Arc::clone(springs));
        let (again, first) = press(part, &law, (axis, around))?;
        (pressed, known) = (again, Pressed { deepest: known.deepest, ..first });
    }
    let start = start(part, &law, known)?;
    u.constant -= around.at_start(&u) - start;
    let balanced = around.is_balanced(&u) || matches!(&pressed, Press::Coupled(d) if around.is_balanced(d));
    let mut contact = Contact {
        name: String::new(),
        place,
        u,
        interface: law,
        engine,
        press: pressed,
        normal_damping: 0.0,
        stop: false,
        count: f64::from(part.count.max(1)),
        start,
        rest: if let ContactStart::Rest(time) = part.start { time } else { 0.0 },
        inert,
        unguarded: known.deepest <= 0.0 || inert && part.normal != Normal::Coupled,
        balanced,
        slot: None,
        natural: Natural::default(),
    };
    contact.normal_damping = around.normal_damping(part, &contact)?;
    Ok((contact, known.deepest))
}

impl Surroundings<'_> {
    /// Returns whether a linear form depends on a quasi-static coordinate.
    pub(super) fn is_balanced(&self, measure: &Measure) -> bool {
        measure.driven.iter().any(|(signal, _)| self.signals.balanced(*signal).is_some())
    }

    /// Returns whether the friction limit is below the rounding of other forces on the contact's bodies. These forces are loads, and forces
    /// of sticking contacts at displacements as large as the waveforms.
    fn is_rounding(&self, law: &Interface, count: f64, (u, deepest): (&Measure, f64)) -> bool {
        if law.friction() == 0.0 || deepest <= 0.0 {
            return false;
        }
        let widest = |w: usize| {
            let (low, high) = self.signals.range(w);
            low.abs().max(high.abs())
        };
        let away: f64 =
            u.driven.iter().map(|(w, a)| a.abs() * widest(*w)).filter(|away| away.is_finite()).sum();
        let pushes = u.free.iter().map(|(i, a)| reach::pressing(*i, self) / a.abs()).fold(0.0, f64::max);
        let force = pushes + count * law.stick_stiffness(deepest) * away;
        count * law.friction() * law.normal_force(deepest) < UNRESOLVED * force
    }

    /// Returns the damping time of a contact along the normal, s.
    ///
    /// Fails if the coefficient of restitution or its speed is out of range, or if the normal load is a force or a radius.
    fn normal_damping(&self, part: &scene::Contact, contact: &Contact) -> Result<f64, Refused> {
        let moved = matches!(part.normal, Normal::Coupled | Normal::Indentation(_));
        match part.normal_damping {
            NormalDamping::None => Ok(0.0),
            _ if !moved => Err((Field::NormalDamping, SceneFault::UndampedLoad)),
            NormalDamping::Time(time) => Ok(time),
            NormalDamping::Restitution { coefficient, speed } => {
                let free = |d: &Measure| d.mobility(|i| self.free[i].mobility);
                let mobility = contact.coupling().map_or(0.0, free);
                let impact = (1.0 / (mobility * contact.count), speed);
                // A row of springs is as wide as the scene needs, and the impact may be harder.
                let time = part.interface.damping_of_restitution(impact, coefficient);
                time.ok_or((Field::Restitution, SceneFault::Restitution(coefficient)))
            }
        }
    }

    /// Returns interface, count and indentation of all coupled contacts of the model.
    fn pressed(&self) -> impl Iterator<Item = (&Interface, f64, Measure)> {
        let coupled = self.contacts.iter().map(|named| &named.part);
        coupled.filter(|part| part.normal == Normal::Coupled).map(|part| {
            (&part.interface, f64::from(part.count.max(1)), indentation(part, Direction::Z, self.bodies))
        })
    }

    /// Returns the value of a linear form at t = 0.
    pub(super) fn at_start(&self, measure: &Measure) -> f64 {
        measure.value(|i| self.free[i].start.0, |w| self.signals.first(w).value)
    }
}

/// Returns the solver of a contact's tangential problem: the slip-memory curve, or a row of springs.
///
/// Without a given span, the row is wide enough for the given force or largest indentation, or for the initial energy of a coupled contact.
/// Fails if the row is invalid or too narrow at the start.
fn engine(
    part: &scene::Contact,
    press: &Press,
    known: Pressed,
    around: &Surroundings<'_>,
) -> Result<Engine, Refused> {
    let (law, deepest) = (&part.interface, known.deepest);
    match part.engine {
        EngineChoice::Curve => Ok(Engine::Curve),
        // A contact that is never pressed needs no row.
        EngineChoice::Springs { .. } if deepest <= 0.0 => Ok(Engine::Curve),
        EngineChoice::Springs { count, span } => {
            let reach = || match press {
                Press::Coupled(d) => {
                    let pile = Pile::of(d, around.pressed(), around);
                    reach::widest((law, f64::from(part.count.max(1))), d, deepest, (&pile, around))
                }
                _ => deepest,
            };
            let is_forced = matches!(press, Press::Constant { .. } | Press::Force(_));
            let springs = match span {
                Some(span) => row(law, (count, span), known.first)?,
                None if is_forced => bearing(law, count, known)?,
                None => row(law, (count, law.profile().reduced_stiffness(reach())), known.first)?,
            };
            Ok(Engine::Row(Arc::new(springs)))
        }
    }
}

/// Returns a row of springs that carries the largest force. A row softer than the profile has a larger indentation and must be wider.
fn bearing(law: &Interface, count: usize, known: Pressed) -> Result<Springs, Refused> {
    let width = |reach: f64| law.profile().reduced_stiffness(reach);
    let mut span = width(known.deepest);
    let mut springs = row(law, (count, span), known.first)?;
    for _ in 0..WIDENED {
        let borne = springs.height_of_reduced_force(law.reduced_force(known.deepest));
        // The springs of a wider row have other positions: add a little more than is missing.
        let wider = width(borne + (borne - springs.reach()));
        if borne <= springs.reach() || !(wider > span && wider.is_finite()) {
            break;
        }
        (span, springs) = (wider, row(law, (count, wider), known.first)?);
    }
    Ok(springs)
}

/// Returns a row of springs that is wide enough for the initial indentation.
fn row(law: &Interface, (count, span): (usize, f64), first: f64) -> Result<Springs, Refused> {
    let springs = Springs::new(law.profile(), count, span).map_err(|error| match error {
        SpringsError::Count(_) => (Field::SpringCount, error.into()),
        SpringsError::Span(_) | SpringsError::Narrow { .. } => (Field::Span, error.into()),
    })?;
    if first <= springs.reach() {
        return Ok(springs);
    }
    let width = law.profile().reduced_stiffness(first);
    Err((Field::Span, SceneFault::Narrow { width, span }))
}

/// Returns the displacement u of a contact at the start, m.
fn start(part: &scene::Contact, law: &Interface, known: Pressed) -> Result<f64, Refused> {
    let d = known.first;
    if part.start != ContactStart::Untouched && d <= 0.0 {
        return Err((Field::Start, SceneFault::Open));
    }
    match part.start {
        ContactStart::Untouched | ContactStart::Rest(_) => Ok(0.0),
        ContactStart::Displacement(u) => Ok(u),
        ContactStart::Force(force) => {
            let limit = law.friction() * known.force;
            // At the limit itself the contact would slip.
            if force != 0.0 && force.abs() >= limit {
                let slips = FirstLoadingError::TangentialForce { force, limit };
                return Err((Field::StartForce, slips.into()));
            }
            FirstLoading::solve(law, NormalGiven::Indentation(d), TangentialGiven::Force(force))
                .map(|loading| loading.u)
                .map_err(|error| (Field::StartForce, error.into()))
        }
    }
}

/// Returns the source of a contact's indentation and its known values.
///
/// The extreme values of a waveform are checked against the profile. Indentation increases with force and radius, so the largest value of
/// the waveform gives the deepest indentation.
fn press(
    part: &scene::Contact,
    law: &Interface,
    (axis, around): (Direction, &Surroundings<'_>),
) -> Result<(Press, Pressed), Refused> {
    let (field, value, given): (_, _, fn(f64) -> NormalGiven) = match part.normal {
        Normal::Force(v) => (Field::NormalForce, v, NormalGiven::Force),
        Normal::Indentation(v) => (Field::NormalIndentation, v, NormalGiven::Indentation),
        Normal::Radius(v) => (Field::NormalRadius, v, NormalGiven::Radius),
        Normal::Coupled => return coupled(part, law, (axis, around)),
    };
    let depth = |value: f64| match given(value) {
        NormalGiven::Force(force) => law.indentation(force),
        NormalGiven::Indentation(d) => d,
        NormalGiven::Radius(a) => law.profile().depth(a),
    };
    let (low, high, first) = match value {
        Varying::Constant(v) => (v, v, v),
        Varying::Follows(w) => {
            let (low, high) = around.signals.range(w);
            (low, high, around.signals.first(w).value)
        }
    };
    for value in [low, high] {
        given(value).indentation(law).map_err(|error| (field, error.into()))?;
    }
    let d = depth(first);
    let press = match (value, part.normal) {
        (Varying::Constant(_), _) => Press::Constant { d, reduced_force: law.reduced_force(d) },
        (Varying::Follows(w), Normal::Force(_)) => Press::Force(w),
        (Varying::Follows(w), Normal::Radius(_)) => Press::Radius(w),
        (Varying::Follows(w), _) => Press::Indentation(w),
    };
    let force = if field == Field::NormalForce { first } else { law.normal_force(d) };
    Ok((press, Pressed { deepest: depth(high), first: d, force }))
}

/// Returns the indentation d of a coupled contact as a linear form of the coordinates.
fn indentation(part: &scene::Contact, axis: Direction, bodies: &[Body]) -> Measure {
    let ends = [(part.between[0], part.at[0]), (part.between[1], part.at[1])];
    let mut d = Measure::between(ends, axis, bodies);
    d.constant -= part.gap;
    d
}

/// Returns the indentation of a contact pressed by the motion of bodies: d = z(first) - z(second) - gap at the contact point.
///
/// Fails if the bodies cannot change their distance, or if the expected indentation exceeds the profile.
fn coupled(
    part: &scene::Contact,
    law: &Interface,
    (axis, around): (Direction, &Surroundings<'_>),
) -> Result<(Press, Pressed), Refused> {
    let d = indentation(part, axis, around.bodies);
    // A constant indentation must be given as such.
    if d.is_constant() {
        return Err((Field::Normal, SceneFault::Unmoved));
    }
    let first = around.at_start(&d);
    let deepest = reach::deepest(law, f64::from(part.count.max(1)), &d, around);
    NormalGiven::Indentation(deepest).indentation(law).map_err(|error| (Field::Normal, error.into()))?;
    Ok((Press::Coupled(d), Pressed { deepest, first, force: law.normal_force(first) }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_contact::{Material, Pair, Profile};

    /// Rows of worn profiles are softer at their edge than the profile and must be wider than the contact.
    #[test]
    fn a_row_without_a_span_bears_its_force() {
        let soft = Material::new(1e9, 0.3).unwrap();
        let profiles = [
            Profile::truncated_paraboloid(5e-6, 1e-3).unwrap(),
            Profile::truncated_cone(5e-6, 0.05).unwrap(),
            Profile::paraboloid(1e-3).unwrap(),
        ];
        let mut widened = 0;
        for profile in profiles {
            let law = Interface::new(Pair::new(soft, soft), profile, 0.3).unwrap();
            for (count, force) in
                (0..60).flat_map(|k| [16, 64, 256].map(|count| (count, 1e-4 * 1.1_f64.powi(k))))
            {
                let d = law.indentation(force);
                let springs = bearing(&law, count, Pressed { deepest: d, first: d, force }).unwrap();
                assert!(springs.height_of_reduced_force(law.reduced_force(d)) <= springs.reach());
                let span = law.profile().reduced_stiffness(d);
                let as_wide = row(&law, (count, span), d).unwrap();
                let is_outgrown = as_wide.height_of_reduced_force(law.reduced_force(d)) > as_wide.reach();
                assert!(is_outgrown || springs == as_wide);
                widened += u32::from(is_outgrown);
                let cells = |row: &Springs| row.positions().last().copied().unwrap_or_default();
                assert!(cells(&springs) < 1.1 * cells(&as_wide));
            }
        }
        assert!(widened > 10, "{widened}");
    }
}
