//! From a scene's contact to its constants.

use super::{Body, Contact, Free, Link, Load, Measure, Natural, Press, reach};
use crate::scene::{self, ContactStart, Direction, EngineChoice, Named, Normal, Varying};
use crate::{SceneError, Waveform};
use std::sync::Arc;
use stickslip_contact::{
    Engine, FirstLoading, Interface, NormalGiven, Springs, SpringsError, TangentialGiven,
};

/// What a contact is built among.
pub(super) struct Surroundings<'a> {
    pub(super) waveforms: &'a [Waveform],
    pub(super) bodies: &'a [Body],
    pub(super) free: &'a [Free],
    pub(super) links: &'a [Link],
    pub(super) loads: &'a [Load],
    /// Whether the bodies are set down before they start.
    pub(super) equilibrium: bool,
}

/// Indentations of a contact that are known beforehand, m.
#[derive(Debug, Clone, Copy)]
struct Indentations {
    /// The largest; of a coupled contact the one that the loads and motions at the start can be expected to reach.
    deepest: f64,
    /// At t = 0.
    first: f64,
}

/// A contact, without slot and scales, and its largest indentation.
pub(super) fn build(
    Named { name, part }: &Named<scene::Contact>,
    around: &Surroundings<'_>,
) -> Result<(Contact, f64), SceneError> {
    let path = |key: &str| format!("contacts.{name}.{key}");
    let [first, second] = part.between;
    if first == second {
        return Err(SceneError::new(path("between"), "a contact needs two different bodies"));
    }
    let law = Interface::new(part.pair, part.profile.clone(), part.friction)
        .map_err(|e| SceneError::new(path("friction"), e.to_string()))?;
    let (press, known) = press(name, part, &law, around)?;
    if let Some(reach) = law.profile().reach().filter(|reach| known.deepest >= *reach) {
        let deepest = known.deepest;
        let message =
            format!("the indentation {deepest:.3e} m reaches beyond the sphere, which allows {reach:.3e} m");
        return Err(SceneError::new(path("normal"), message).help("lower the load or enlarge the radius"));
    }
    let inert = part.friction == 0.0 || known.deepest <= 0.0;
    let engine = engine(name, part, &law, known)?;
    let start = start(name, part, &law, known.first)?;
    let mut u = Measure::between([(first, part.at[0]), (second, part.at[1])], Direction::X, around.bodies);
    u.constant -= around.at_start(&u) - start;
    let contact = Contact {
        name: name.clone(),
        u,
        law,
        engine,
        press,
        count: f64::from(part.count.max(1)),
        start,
        damping: part.damping,
        inert,
        unguarded: known.deepest <= 0.0 || inert && part.normal != Normal::Coupled,
        slot: None,
        natural: Natural::default(),
    };
    Ok((contact, known.deepest))
}

impl Surroundings<'_> {
    /// A measure at t = 0.
    pub(super) fn at_start(&self, measure: &Measure) -> f64 {
        measure.value(|i| self.free[i].start.0, |w| self.waveforms[w].first().value)
    }
}

fn engine(
    name: &str,
    part: &scene::Contact,
    law: &Interface,
    known: Indentations,
) -> Result<Engine, SceneError> {
    let deepest = known.deepest;
    match part.engine {
        EngineChoice::Curve => Ok(Engine::Curve),
        // Never pressed: there is nothing for a row to span.
        EngineChoice::Springs { .. } if deepest <= 0.0 => Ok(Engine::Curve),
        EngineChoice::Springs { count, span } => {
            let span = span.unwrap_or_else(|| 2.0 * law.profile().radius(deepest));
            let path = format!("contacts.{name}.engine.springs");
            Ok(Engine::Row(Arc::new(row(&path, law, (count, span), known.first)?)))
        }
    }
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

/// Displacement reached before the start, m.
fn start(name: &str, part: &scene::Contact, law: &Interface, d: f64) -> Result<f64, SceneError> {
    let path = || format!("contacts.{name}.start");
    if part.start != ContactStart::Untouched && d <= 0.0 {
        let message = "a contact that is open at the start cannot be loaded along x";
        return Err(SceneError::new(path(), message).help("press it at t = 0, or leave it \"untouched\""));
    }
    match part.start {
        ContactStart::Untouched => Ok(0.0),
        ContactStart::Displacement(u) => Ok(u),
        ContactStart::Force(force) => {
            FirstLoading::solve(law, NormalGiven::Indentation(d), TangentialGiven::Force(force))
                .map(|loading| loading.u)
                .map_err(|e| SceneError::new(format!("{}.force", path()), e.to_string()))
        }
    }
}

/// What presses a contact.
fn press(
    name: &str,
    part: &scene::Contact,
    law: &Interface,
    around: &Surroundings<'_>,
) -> Result<(Press, Indentations), SceneError> {
    let (key, value) = match part.normal {
        Normal::Force(v) => ("force", v),
        Normal::Indentation(v) => ("indentation", v),
        Normal::Radius(v) => ("radius", v),
        Normal::Coupled => return coupled(name, part, law, around),
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
        Normal::Indentation(_) | Normal::Coupled => value,
        Normal::Radius(_) => law.profile().depth(value),
    };
    let (low, high, first) = match value {
        Varying::Constant(v) => (v, v, v),
        Varying::Follows(w) => {
            let (low, high) = around.waveforms[w].range();
            (low, high, around.waveforms[w].first().value)
        }
    };
    if key != "indentation" && low < 0.0 {
        let message = format!("expected a normal {key} that never falls below 0, got down to {low:e}");
        return Err(SceneError::new(path, message));
    }
    let press = match (value, part.normal) {
        (Varying::Constant(v), _) => {
            Press::Constant { d: depth(v), reduced_force: law.profile().reduced_force(depth(v)) }
        }
        (Varying::Follows(w), Normal::Force(_)) => Press::Force(w),
        (Varying::Follows(w), Normal::Radius(_)) => Press::Radius(w),
        (Varying::Follows(w), _) => Press::Indentation(w),
    };
    Ok((press, Indentations { deepest: depth(high), first: depth(first) }))
}

/// A contact pressed by the bodies' motion.
fn coupled(
    name: &str,
    part: &scene::Contact,
    law: &Interface,
    around: &Surroundings<'_>,
) -> Result<(Press, Indentations), SceneError> {
    let ends = [(part.between[0], part.at[0]), (part.between[1], part.at[1])];
    let mut d = Measure::between(ends, Direction::Z, around.bodies);
    d.constant -= part.gap;
    if d.is_constant() {
        let message = "neither body moves along the normal: a coupled contact needs a z or a pitch that is free or \
                       follows a waveform";
        let help =
            "make z of one of the bodies \"free\", or give the contact a normal \"force\" or \"indentation\"";
        return Err(SceneError::new(format!("contacts.{name}.normal"), message).help(help));
    }
    let first = around.at_start(&d);
    let deepest = reach::deepest(law, f64::from(part.count.max(1)), &d, around);
    Ok((Press::Coupled(d), Indentations { deepest, first }))
}
