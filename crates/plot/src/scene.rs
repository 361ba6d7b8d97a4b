//! Model of a drive, drawn to scale: bodies, contacts, springs, actuators and loads.

mod arrange;
mod attach;
mod draw;
mod fit;
mod outline;
mod sheet;
pub(crate) mod symbols;

use crate::figure::Figure;

/// Model of a drive. Points are in metres from the reference point of their body: x along the slide, z normal to it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene<'a> {
    /// Bodies other than the ground.
    pub bodies: Vec<SceneBody<'a>>,
    /// Contacts.
    pub contacts: Vec<SceneContact<'a>>,
    /// Springs, dampers and piezo stacks.
    pub links: Vec<SceneLink<'a>>,
    /// Forces and moments.
    pub loads: Vec<SceneLoad<'a>>,
    /// Gravity; `None` without.
    pub gravity: Option<SceneGravity>,
}

/// Mobility of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mobility<'a> {
    /// The coordinate is fixed.
    Fixed,
    /// The coordinate follows from the equation of motion.
    Free,
    /// The coordinate has no mass and is in static equilibrium.
    Balanced,
    /// The coordinate follows the waveform of this name.
    Follows(&'a str),
}

/// Constant or time-dependent quantity, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount<'a> {
    /// Constant value.
    Constant(f64),
    /// Values of the waveform of this name.
    Follows(&'a str),
}

/// Rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneBody<'a> {
    /// Name of the body.
    pub name: &'a str,
    /// Mass, kg; `None` if the mass has no effect.
    pub mass: Option<f64>,
    /// Mobility along the slide.
    pub x: Mobility<'a>,
    /// Mobility normal to the slide.
    pub z: Mobility<'a>,
    /// Mobility of the rotation, positive from x towards z.
    pub pitch: Mobility<'a>,
}

/// Point to which a contact, spring or actuator is attached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fixture {
    /// Index of the body in [`Scene::bodies`]; `None` for the ground.
    pub body: Option<usize>,
    /// Point of the body, m. Ignored for the ground, which is drawn at its contacts.
    pub at: (f64, f64),
}

/// A contact.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneContact<'a> {
    /// Name of the contact.
    pub name: &'a str,
    /// Points on the lower and the upper side.
    pub between: [Fixture; 2],
    /// Profile as distances from the axis, ascending from 0, and heights, m. Empty if no profile can be drawn.
    pub profile: Vec<(f64, f64)>,
    /// Normal loading.
    pub press: Press<'a>,
    /// Number of identical contacts at this point.
    pub count: u32,
}

/// Normal loading of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Press<'a> {
    /// Normal force on each contact, N.
    Force(Amount<'a>),
    /// Prescribed indentation, m.
    Indentation(Amount<'a>),
    /// Prescribed contact radius, m.
    Radius(Amount<'a>),
    /// Indentation from the motion of the bodies.
    Coupled,
}

/// Spring, damper or piezo stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLink<'a> {
    /// Name of the link.
    pub name: &'a str,
    /// Ends of the link, which pushes its second end away from its first end, along x or z.
    pub between: [Fixture; 2],
    /// Whether the link acts along z instead of x.
    pub is_upright: bool,
    /// Type of the link.
    pub kind: LinkKind<'a>,
    /// Preload: force on the second end along the axis, N.
    pub preload: f64,
}

/// Connection of two bodies other than a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LinkKind<'a> {
    /// Spring, damper or both in parallel.
    Spring {
        /// Whether the link has a stiffness.
        is_stiff: bool,
        /// Whether the link has a damping.
        is_damped: bool,
    },
    /// Piezo stack with its free stroke, m.
    Stack(Amount<'a>),
}

/// Force and moment on a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLoad<'a> {
    /// Index of the body in [`Scene::bodies`].
    pub body: usize,
    /// Point of the body, m.
    pub at: (f64, f64),
    /// Force along x, N.
    pub x: Amount<'a>,
    /// Force along z, N.
    pub z: Amount<'a>,
    /// Moment, N m.
    pub pitch: Amount<'a>,
}

/// Gravity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneGravity {
    /// Acceleration, m/s².
    pub acceleration: f64,
    /// Incline: angle from the horizontal to the x axis, rad.
    pub incline: f64,
}

impl SceneGravity {
    /// Returns whether the x axis rises at more than 45 degrees. Such a slide is drawn upright, with the z axis to the right.
    pub fn is_upright(&self) -> bool {
        // The tolerance excludes 45 degrees with rounding errors.
        self.acceleration > 0.0 && math::sin(self.incline) > std::f64::consts::FRAC_1_SQRT_2 + 1e-9
    }
}

/// Maximum number of bodies, contacts, links and loads that are drawn.
const MOST_PARTS: usize = 200;

/// Draws the model in the x-z plane.
///
/// Points of bodies are to scale, and so are contact profiles that are large enough. Outlines of bodies only enclose their points. A body
/// whose points all coincide with its reference point is drawn at its contacts. Symbols, arrows and outlines have a fixed size.
///
/// The origin of the axes is the reference point of the first group of connected bodies, and the ground. Both axes have the same scale
/// unless the drawing would be very narrow. A slide that rises at more than 45 degrees is drawn upright.
pub fn layout_figure(title: &str, scene: &Scene<'_>) -> Figure<'static> {
    let parts = scene.bodies.len() + scene.contacts.len() + scene.links.len() + scene.loads.len();
    if scene.bodies.is_empty() {
        return Figure::without_data(title, "no bodies");
    }
    if parts > MOST_PARTS {
        return Figure::without_data(title, &format!("{parts} parts: too many to be drawn"));
    }
    fit::figure(title, scene)
}

impl Amount<'_> {
    /// Returns whether the amount is constantly 0.
    fn is_nothing(self) -> bool {
        self == Self::Constant(0.0)
    }
}
