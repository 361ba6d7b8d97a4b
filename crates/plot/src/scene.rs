//! The scene of a drive, drawn to scale: bodies, what joins them and what acts on them.

mod arrange;
mod attach;
mod draw;
mod fit;
mod outline;
mod sheet;
pub(crate) mod symbols;

use crate::figure::Figure;

/// What a drive consists of. Points are in metres from their body's reference point: x along the slide, z normal to it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene<'a> {
    /// Bodies beside the ground.
    pub bodies: Vec<SceneBody<'a>>,
    /// Contacts.
    pub contacts: Vec<SceneContact<'a>>,
    /// Springs, dampers and piezo stacks.
    pub links: Vec<SceneLink<'a>>,
    /// Forces and moments.
    pub loads: Vec<SceneLoad<'a>>,
    /// Gravity, if there is any.
    pub gravity: Option<SceneGravity>,
}

/// What a coordinate may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mobility<'a> {
    /// Nothing.
    Fixed,
    /// Obey Newton.
    Free,
    /// Be where forces balance, without a mass.
    Balanced,
    /// Follow the waveform of this name.
    Follows(&'a str),
}

/// A quantity, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount<'a> {
    /// It has this value.
    Constant(f64),
    /// It follows the waveform of this name.
    Follows(&'a str),
}

/// A rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneBody<'a> {
    /// Name.
    pub name: &'a str,
    /// Mass, kg, where it matters.
    pub mass: Option<f64>,
    /// Along the slide.
    pub x: Mobility<'a>,
    /// Normal to the slide.
    pub z: Mobility<'a>,
    /// Rotation, positive from x towards z.
    pub pitch: Mobility<'a>,
}

/// Where something is fastened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fixture {
    /// Place of the body in the list of bodies; none: the ground.
    pub body: Option<usize>,
    /// The point of the body, m; of the ground, which lies where its contacts are, it says nothing.
    pub at: (f64, f64),
}

/// A contact.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneContact<'a> {
    /// Name.
    pub name: &'a str,
    /// The lower and the upper side.
    pub between: [Fixture; 2],
    /// Distances from the axis, ascending from 0, and gaps there, m; none where it has no shape to be drawn.
    pub profile: Vec<(f64, f64)>,
    /// What presses it.
    pub press: Press<'a>,
    /// Identical contacts in this place.
    pub count: u32,
}

/// What presses a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Press<'a> {
    /// A force on each, N.
    Force(Amount<'a>),
    /// A given indentation, m.
    Indentation(Amount<'a>),
    /// A given contact radius, m.
    Radius(Amount<'a>),
    /// The motion of its bodies.
    Coupled,
}

/// A spring, damper or piezo stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLink<'a> {
    /// Name.
    pub name: &'a str,
    /// Its ends; it pushes the second away from the first, along x or z.
    pub between: [Fixture; 2],
    /// Along z, not along x.
    pub is_upright: bool,
    /// What it is.
    pub kind: LinkKind<'a>,
    /// Force on the second side as drawn, N.
    pub preload: f64,
}

/// What joins two bodies beside contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LinkKind<'a> {
    /// A spring, a damper or both side by side.
    Spring {
        /// Whether it has stiffness.
        is_stiff: bool,
        /// Whether it has damping.
        is_damped: bool,
    },
    /// A piezo stack and its free stroke, m.
    Stack(Amount<'a>),
}

/// Force and moment on a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLoad<'a> {
    /// Place of the body in the list of bodies.
    pub body: usize,
    /// The point of the body, m.
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
    /// Angle from the horizontal to the x axis, rad.
    pub incline: f64,
}

impl SceneGravity {
    /// Whether the x axis goes up by more than 45 degrees: such a slide is drawn upright, its height normal to it to the right.
    pub fn is_upright(&self) -> bool {
        // Of 45 degrees themselves rounding says nothing.
        self.acceleration > 0.0 && math::sin(self.incline) > std::f64::consts::FRAC_1_SQRT_2 + 1e-9
    }
}

/// More bodies, contacts, links and loads than this make no picture that could be read.
const MOST_PARTS: usize = 200;

/// The scene in the plane of x and z. To scale are the points of the bodies and, where they are large enough to be
/// seen, the profiles of the contacts; bodies have no shape of their own: their outlines go around their points, and a
/// body whose points all lie in its reference point stands where its contacts are. Symbols, arrows and outlines keep
/// their size on paper. Axes count from the reference point of the first group of bodies that hang together, and from
/// the ground; both have one scale, unless the scene would be a sliver. Where the slide goes up by more than 45 degrees x is drawn
/// upwards.
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
    /// Whether it is nothing, always.
    fn is_nothing(self) -> bool {
        self == Self::Constant(0.0)
    }
}
