//! Plot of the model, to scale.

use super::{Kind, Sources, Undrawn};
use crate::look::{Pen, Picture};
use stickslip_contact::Profile;
use stickslip_drive::scene::{
    Actuator, Body, Contact, Direction, Freedom, Gravity, Load, Named, Normal, Point, Scene, Side, Spring,
    Varying,
};
use stickslip_plot as plot;
use stickslip_plot::{
    Amount, Fixture, LinkKind, Mobility, Press, SceneBody, SceneContact, SceneGravity, SceneLink, SceneLoad,
    layout_figure,
};
use stickslip_scenario::PlotName;

pub(super) const KIND: Kind = Kind {
    shows: "bodies, contacts, springs and forces, to scale; free bodies are blue, bodies that follow a waveform are orange; double arrows show the directions of motion; a vertical slide is drawn upright",
    needs: |_| Vec::new(),
    draw,
};

/// Draws the model in its initial state.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let job = sources.job;
    Ok(pen.draw(PlotName::Layout, layout_figure(job.title(), &Sketch(&job.scenario.scene).scene()))?)
}

/// Returns the gravity of a scenario; `None` if 0.
pub(super) fn gravity(scene: &Scene) -> Option<SceneGravity> {
    let Gravity { acceleration, incline } = scene.gravity;
    (acceleration != 0.0).then_some(SceneGravity { acceleration, incline })
}

/// Converts the scenario's model to the plot's model.
struct Sketch<'a>(&'a Scene);

impl<'a> Sketch<'a> {
    fn scene(&self) -> plot::Scene<'a> {
        let Self(scene) = self;
        let springs = scene.springs.iter().map(|spring| self.spring(spring));
        let actuators = scene.actuators.iter().map(|actuator| self.actuator(actuator));
        plot::Scene {
            bodies: scene.bodies.iter().map(|body| self.body(body)).collect(),
            contacts: scene.contacts.iter().map(|contact| self.contact(contact)).collect(),
            links: springs.chain(actuators).collect(),
            loads: scene.loads.iter().map(|load| self.load(load)).collect(),
            gravity: gravity(scene),
        }
    }

    fn body(&self, Named { name, part }: &'a Named<Body>) -> SceneBody<'a> {
        let mobility = |freedom: Freedom| match freedom {
            Freedom::Fixed => Mobility::Fixed,
            Freedom::Free => Mobility::Free,
            Freedom::Balanced => Mobility::Balanced,
            Freedom::Follows(place) => Mobility::Follows(self.waveform(place)),
        };
        let has_weight = [part.x, part.z].iter().any(|coordinate| coordinate.freedom == Freedom::Free);
        SceneBody {
            name,
            mass: part.mass.filter(|_| has_weight),
            x: mobility(part.x.freedom),
            z: mobility(part.z.freedom),
            pitch: mobility(part.pitch.freedom),
        }
    }

    fn contact(&self, Named { name, part }: &'a Named<Contact>) -> SceneContact<'a> {
        SceneContact {
            name,
            between: fixtures(part.between, part.at),
            profile: shape(part.interface.profile()),
            press: match part.normal {
                Normal::Force(force) => Press::Force(self.amount(force)),
                Normal::Indentation(depth) => Press::Indentation(self.amount(depth)),
                Normal::Radius(radius) => Press::Radius(self.amount(radius)),
                Normal::Coupled => Press::Coupled,
            },
            count: part.count,
        }
    }

    fn spring(&self, Named { name, part }: &'a Named<Spring>) -> SceneLink<'a> {
        SceneLink {
            name,
            between: fixtures(part.between, part.at),
            is_upright: part.direction == Direction::Z,
            kind: LinkKind::Spring { is_stiff: part.stiffness > 0.0, is_damped: part.damping > 0.0 },
            preload: part.preload,
        }
    }

    fn actuator(&self, Named { name, part }: &'a Named<Actuator>) -> SceneLink<'a> {
        SceneLink {
            name,
            between: fixtures(part.between, part.at),
            is_upright: part.direction == Direction::Z,
            kind: LinkKind::Stack(self.amount(part.stroke)),
            preload: 0.0,
        }
    }

    fn load(&self, load: &Load) -> SceneLoad<'a> {
        SceneLoad {
            body: load.on,
            at: (load.at.x, load.at.z),
            x: self.amount(load.x),
            z: self.amount(load.z),
            pitch: self.amount(load.pitch),
        }
    }

    fn amount(&self, value: Varying) -> Amount<'a> {
        match value {
            Varying::Constant(value) => Amount::Constant(value),
            Varying::Follows(place) => Amount::Follows(self.waveform(place)),
        }
    }

    fn waveform(&self, place: usize) -> &'a str {
        let waveform = self.0.waveform_of(place).and_then(|place| self.0.waveforms.get(place));
        waveform.map_or("", |waveform| &waveform.name)
    }
}

fn fixtures(between: [Side; 2], at: [Point; 2]) -> [Fixture; 2] {
    let fixture = |side: Side, at: Point| Fixture {
        body: match side {
            Side::Ground => None,
            Side::Body(place) => Some(place),
        },
        at: (at.x, at.z),
    };
    [fixture(between[0], at[0]), fixture(between[1], at[1])]
}

/// Number of intervals of a profile.
const STEPS: u32 = 24;
/// Minimum and maximum radius in the search for the end of a profile, m.
const RADII: (f64, f64) = (1e-9, 10.0);

/// Returns the points of a profile up to the radius r at which its height is r/2; for a paraboloid this is its radius of curvature. A flat
/// punch ends with a vertical wall. Cones and lists of springs have no such radius and return no points.
fn shape(profile: &Profile) -> Vec<(f64, f64)> {
    let is_low = |r: f64| profile.gap(r).is_some_and(|gap| gap < r / 2.0);
    let (mut low, mut high) = RADII;
    if !is_low(low) || is_low(high) {
        return Vec::new();
    }
    while high - low > 1e-9 * high {
        let middle = (low * high).sqrt();
        if is_low(middle) { low = middle } else { high = middle }
    }
    let radius = |step: u32| low * f64::from(step) / f64::from(STEPS);
    let points = (0..=STEPS).filter_map(|step| Some((radius(step), profile.gap(radius(step))?)));
    let mut points: Vec<(f64, f64)> = points.collect();
    if points.last().is_some_and(|end| end.1 == 0.0) {
        points.push((low, low / 2.0));
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_end_where_they_are_half_as_high_as_wide() {
        let end = |profile: Profile| shape(&profile).last().copied().unwrap_or_default();
        let near = |(r, gap): (f64, f64), want: (f64, f64)| {
            assert!((r - want.0).abs() < 1e-8 * want.0 && (gap - want.1).abs() < 1e-8 * want.0, "{r} {gap}");
        };
        near(end(Profile::paraboloid(2e-3).unwrap()), (2e-3, 1e-3));
        // R - √(R² - r²) = r/2 at r = 4R/5.
        near(end(Profile::sphere(5e-3).unwrap()), (4e-3, 2e-3));
        near(end(Profile::flat(3e-6).unwrap()), (3e-6, 1.5e-6));
        // A r⁴ = r/2 at r³ = 1/2A.
        near(end(Profile::power(4e9, 4.0).unwrap()), (0.5e-3, 0.25e-3));
        for shapeless in [
            Profile::cone(0.1).unwrap(),
            Profile::cone(2.0).unwrap(),
            Profile::foundation(&[0.0, 1e-6], &[1e-6, 1e-6]).unwrap(),
        ] {
            assert!(shape(&shapeless).is_empty());
        }
    }
}
