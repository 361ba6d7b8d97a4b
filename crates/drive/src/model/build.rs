//! From a scene to a model: all checks of meaning that concern the physics.

use super::{Body, Contact, Free, Link, Load, Model, Place, Press, Stroke, check, scale};
use crate::scene::{self, ContactStart, EngineChoice, Freedom, Named, Normal, Scene, Side, Start, Varying};
use crate::{SceneError, Waveform};
use std::sync::Arc;
use stickslip_contact::{
    Engine, FirstLoading, Interface, NormalGiven, Springs, SpringsError, TangentialGiven,
};

impl Model {
    /// Checks a scene and assembles its constants. Errors name the key path of what is wrong.
    pub fn new(scene: &Scene) -> Result<Self, SceneError> {
        check::check(scene)?;
        let waveforms: Vec<Waveform> = scene.waveforms.iter().map(|w| w.part.clone()).collect();
        let (bodies, mut free) = bodies(scene)?;
        let start = |place: Place| match place {
            Place::Held(x) => x,
            Place::Free(i) => free[i].start.0,
            Place::Driven(w) => value_at_start(&waveforms[w]),
        };
        let mut contacts = Vec::with_capacity(scene.contacts.len());
        let mut deepest = Vec::with_capacity(scene.contacts.len());
        let mut growing = 0;
        for named in &scene.contacts {
            let (mut contact, deep) = contact(named, &bodies, &waveforms)?;
            contact.offset = start(contact.first) - start(contact.second) - contact.start;
            if !contact.is_constant() && !contact.inert && contact.engine == Engine::Curve {
                contact.slot = Some(growing);
                growing += 1;
            }
            contacts.push(contact);
            deepest.push(deep);
        }
        let links = links(scene, &bodies)?;
        no_jumps_through_dampers(scene, &links, &waveforms)?;
        let loads = loads(scene, &bodies, &mut free);
        scale::assign(&mut contacts, &mut free, &links, &waveforms, &deepest);
        let equilibrium = scene.start == Start::Equilibrium;
        Ok(Self { waveforms, bodies, free, contacts, links, loads, growing, equilibrium })
    }
}

fn value_at_start(waveform: &Waveform) -> f64 {
    waveform.sample(&waveform.piece_at(0.0), 0.0).value
}

fn bodies(scene: &Scene) -> Result<(Vec<Body>, Vec<Free>), SceneError> {
    let mut bodies = Vec::with_capacity(scene.bodies.len());
    let mut free = Vec::new();
    let down = -scene.gravity.acceleration * scene.gravity.incline.sin();
    for (body, Named { name, part }) in scene.bodies.iter().enumerate() {
        let place = match part.x {
            Freedom::Fixed => Place::Held(part.start_x),
            Freedom::Follows(waveform) => Place::Driven(waveform),
            Freedom::Free => {
                let mass = part.mass.ok_or_else(|| {
                    SceneError::new(format!("bodies.{name}"), "a body with a free coordinate needs a mass")
                        .help("add \"mass\": \"10 g\", or make x \"fixed\"")
                })?;
                if !(mass > 0.0 && mass.is_finite()) {
                    let message = format!("expected a mass above 0 kg, got {mass}");
                    return Err(SceneError::new(format!("bodies.{name}.mass"), message));
                }
                free.push(Free {
                    body,
                    mass,
                    mobility: 1.0 / mass,
                    force: mass * down,
                    start: (part.start_x, part.start_vx),
                    scale: (0.0, 0.0),
                });
                Place::Free(free.len() - 1)
            }
        };
        bodies.push(Body { name: name.clone(), place });
    }
    Ok((bodies, free))
}

fn place(side: Side, bodies: &[Body]) -> Place {
    match side {
        Side::Ground => Place::Held(0.0),
        Side::Body(i) => bodies[i].place,
    }
}

/// A contact, without offset, slot and scales, and its largest indentation.
fn contact(
    Named { name, part }: &Named<scene::Contact>,
    bodies: &[Body],
    waveforms: &[Waveform],
) -> Result<(Contact, f64), SceneError> {
    let path = |key: &str| format!("contacts.{name}.{key}");
    let [first, second] = part.between;
    if first == second {
        return Err(SceneError::new(path("between"), "a contact needs two different bodies"));
    }
    let law = Interface::new(part.pair, part.profile.clone(), part.friction)
        .map_err(|e| SceneError::new(path("friction"), e.to_string()))?;
    let (press, range) = press(name, part, &law, waveforms)?;
    let deepest = range.1;
    if let Some(reach) = law.profile().reach().filter(|reach| deepest >= *reach) {
        let message =
            format!("the indentation {deepest:e} m reaches beyond the sphere, which allows {reach:e} m");
        return Err(SceneError::new(path("normal"), message).help("lower the load or enlarge the radius"));
    }
    let engine = match part.engine {
        EngineChoice::Curve => Engine::Curve,
        // Never pressed: there is nothing for a row to span.
        EngineChoice::Springs { .. } if deepest <= 0.0 => Engine::Curve,
        EngineChoice::Springs { count, span } => {
            let span = span.unwrap_or_else(|| 2.0 * law.profile().radius(deepest));
            Engine::Row(Arc::new(row(&path("engine.springs"), &law, (count, span), range.2)?))
        }
    };
    let start = match part.start {
        ContactStart::Untouched => 0.0,
        ContactStart::Displacement(u) => u,
        ContactStart::Force(force) => {
            let d = NormalGiven::Indentation(range.2);
            FirstLoading::solve(&law, d, TangentialGiven::Force(force))
                .map_err(|e| SceneError::new(path("start.force"), e.to_string()))?
                .u
        }
    };
    let contact = Contact {
        name: name.clone(),
        first: place(first, bodies),
        second: place(second, bodies),
        offset: 0.0,
        law,
        engine,
        press,
        count: f64::from(part.count.max(1)),
        start,
        inert: part.friction == 0.0 || deepest <= 0.0,
        slot: None,
        natural: (0.0, 0.0),
    };
    Ok((contact, deepest))
}

const WIDE: &str = "leave the span out: the row is then as wide as the contact ever is";

/// A row of springs that is wide enough for the contact's first indentation.
fn row(path: &str, law: &Interface, (count, span): (usize, f64), first: f64) -> Result<Springs, SceneError> {
    let springs = Springs::new(law.profile(), count, span).map_err(|error| {
        let key = if matches!(error, SpringsError::Count(_)) { "count" } else { "span" };
        SceneError::new(format!("{path}.{key}"), error.to_string()).help(WIDE)
    })?;
    if first <= springs.reach() {
        return Ok(springs);
    }
    let width = 2.0 * law.profile().radius(first);
    let message =
        format!("expected at least the contact's width at the start, {width:.3e} m, got {span:e} m");
    Err(SceneError::new(format!("{path}.span"), message).help(WIDE))
}

/// What presses a contact, and its smallest, largest and first indentation.
fn press(
    name: &str,
    part: &scene::Contact,
    law: &Interface,
    waveforms: &[Waveform],
) -> Result<(Press, (f64, f64, f64)), SceneError> {
    let (key, value) = match part.normal {
        Normal::Force(v) => ("force", v),
        Normal::Indentation(v) => ("indentation", v),
        Normal::Radius(v) => ("radius", v),
    };
    let path = format!("contacts.{name}.normal.{key}");
    if key == "radius" && !law.profile().is_strictly_convex() {
        return Err(SceneError::new(
            path,
            "the contact radius does not tell the indentation of this profile",
        )
        .help("give the normal force or the indentation"));
    }
    let depth = |value: f64| match part.normal {
        Normal::Force(_) => law.indentation(value),
        Normal::Indentation(_) => value,
        Normal::Radius(_) => law.profile().depth(value),
    };
    let (low, high, first) = match value {
        Varying::Constant(v) => (v, v, v),
        Varying::Follows(w) => {
            let (low, high) = waveforms[w].range();
            (low, high, value_at_start(&waveforms[w]))
        }
    };
    if key != "indentation" && low < 0.0 {
        let message = format!("expected a normal {key} that never falls below 0, got down to {low:e}");
        return Err(SceneError::new(path, message));
    }
    let range = (depth(low), depth(high), depth(first));
    let press = match (value, part.normal) {
        (Varying::Constant(_), _) => Press::Constant { d: range.0, area: law.profile().area(range.0) },
        (Varying::Follows(w), Normal::Force(_)) => Press::Force(w),
        (Varying::Follows(w), Normal::Indentation(_)) => Press::Indentation(w),
        (Varying::Follows(w), Normal::Radius(_)) => Press::Radius(w),
    };
    Ok((press, range))
}

fn links(scene: &Scene, bodies: &[Body]) -> Result<Vec<Link>, SceneError> {
    let between = |[first, second]: [Side; 2], path: String| {
        if first == second {
            return Err(SceneError::new(path, "expected two different bodies"));
        }
        Ok((place(first, bodies), place(second, bodies)))
    };
    let mut links = Vec::with_capacity(scene.springs.len() + scene.actuators.len());
    for Named { name, part } in &scene.springs {
        let (first, second) = between(part.between, format!("springs.{name}.between"))?;
        let (stiffness, damping, preload) = (part.stiffness, part.damping, part.preload);
        links.push(Link { first, second, stiffness, damping, preload, stroke: Stroke::Constant(0.0) });
    }
    for Named { name, part } in &scene.actuators {
        let (first, second) = between(part.between, format!("actuators.{name}.between"))?;
        let stroke = match part.stroke {
            Varying::Constant(s) => Stroke::Constant(s),
            Varying::Follows(w) => Stroke::Driven(w),
        };
        links.push(Link {
            first,
            second,
            stiffness: part.stiffness,
            damping: part.damping,
            preload: 0.0,
            stroke,
        });
    }
    Ok(links)
}

/// A damper has no answer to a jump in no time: its impulse would be a matter of definition.
fn no_jumps_through_dampers(scene: &Scene, links: &[Link], waveforms: &[Waveform]) -> Result<(), SceneError> {
    for (i, link) in links.iter().enumerate().filter(|(_, link)| link.damping > 0.0) {
        let driven = |place: Place| match place {
            Place::Driven(w) => Some(w),
            Place::Held(_) | Place::Free(_) => None,
        };
        let stroke = match link.stroke {
            Stroke::Driven(w) => Some(w),
            Stroke::Constant(_) => None,
        };
        let mut moving = [driven(link.first), driven(link.second), stroke].into_iter().flatten();
        if let Some(w) = moving.find(|w| waveforms[*w].has_jumps()) {
            let path = match scene.springs.get(i) {
                Some(spring) => format!("springs.{}.damping", spring.name),
                None => format!("actuators.{}.damping", scene.actuators[i - scene.springs.len()].name),
            };
            let message =
                format!("a damper cannot follow the jumps of waveform `{}`", scene.waveforms[w].name);
            return Err(SceneError::new(path, message).help("give the waveform a flyback above 0"));
        }
    }
    Ok(())
}

/// Adds the constant loads to the free coordinates and returns the others. A load on a body that does not move
/// freely is carried by its guide.
fn loads(scene: &Scene, bodies: &[Body], free: &mut [Free]) -> Vec<Load> {
    let mut varying = Vec::new();
    for load in &scene.loads {
        if let Place::Free(i) = bodies[load.on].place {
            match load.x {
                Varying::Constant(force) => free[i].force += force,
                Varying::Follows(waveform) => varying.push(Load { free: i, waveform }),
            }
        }
    }
    varying
}
