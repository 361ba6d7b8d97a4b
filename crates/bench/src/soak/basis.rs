//! First contact of a random scenario, which sets the scales of all other parts.

use super::draw::Draw;
use serde_json::{Map, Value, json};
use stickslip_contact::{Interface, Material, Pair, Profile};

/// Materials: name, Young's modulus (Pa), Poisson's ratio.
const MATERIALS: [(&str, f64, f64); 5] = [
    ("steel", 210e9, 0.30),
    ("ruby", 400e9, 0.27),
    ("glass", 70e9, 0.22),
    ("brass", 100e9, 0.34),
    ("ptfe", 0.5e9, 0.46),
];
/// Smallest and largest number of springs of a list of heights.
const HEIGHTS: (u64, u64) = (12, 80);

/// Contact with its scales at the mean load.
#[derive(Debug, Clone)]
pub(super) struct Basis {
    pub(super) materials: [&'static str; 2],
    pub(super) profile: Value,
    pub(super) name: &'static str,
    pub(super) friction: f64,
    pub(super) interface: Interface,
    /// Normal force of one contact, N.
    pub(super) force: f64,
    /// Indentation at this force, m.
    pub(super) depth: f64,
    /// Natural displacement along the slide, m: u_c, at most ten times the indentation; without friction the indentation.
    pub(super) length: f64,
    /// Tangential stiffness of one sticking contact, N/m.
    pub(super) stick: f64,
    /// Normal stiffness of one contact, N/m.
    pub(super) normal: f64,
}

impl Basis {
    /// Draws a contact. Returns `None` if the numbers are invalid, which happens in a few of a thousand draws.
    pub(super) fn draw(draw: &mut Draw) -> Option<Self> {
        let materials = [0, 1].map(|_| MATERIALS[draw.below(MATERIALS.len() as u64) as usize]);
        let [first, second] = materials.map(|(_, modulus, ratio)| Material::new(modulus, ratio).ok());
        let pair = Pair::new(first?, second?);
        let radius = draw.spread(3e-6, 1e-4);
        // Strains of 1e-5 to 1e-2: valid half-space theory, and spheres far from their equator.
        let force = pair.normal_modulus() * radius * radius * draw.spread(2e-5, 2e-2);
        let (name, profile, shape) = profile(draw, radius, force / pair.normal_modulus())?;
        let friction = friction(draw);
        let interface = Interface::new(pair, shape, friction).ok()?;
        let depth = interface.indentation(force);
        let slip = interface.gross_slip_displacement(depth);
        let length = if slip > 0.0 { slip.min(10.0 * depth) } else { depth };
        let (stick, normal) = (interface.stick_stiffness(depth), interface.normal_stiffness(depth));
        let materials = materials.map(|(name, ..)| name);
        let good = [depth, length, stick, normal].iter().all(|x| *x > 0.0 && x.is_finite());
        good.then_some(Self {
            materials,
            profile,
            name,
            friction,
            interface,
            force,
            depth,
            length,
            stick,
            normal,
        })
    }

    /// Returns the materials of the contacts as JSON of a scenario.
    pub(super) fn materials(contacts: &Map<String, Value>) -> Value {
        let named = |name: &str| {
            contacts
                .values()
                .filter_map(|contact| contact["materials"].as_array())
                .flatten()
                .any(|m| m == name)
        };
        let used = MATERIALS.iter().filter(|(name, ..)| named(name)).map(|(name, modulus, ratio)| {
            ((*name).to_owned(), json!({ "youngs_modulus": modulus, "poisson_ratio": ratio }))
        });
        Value::Object(used.collect())
    }

    /// Returns the friction limit, N.
    pub(super) fn hold(&self) -> f64 {
        self.friction * self.force
    }
}

/// Draws a friction coefficient: common values, zero, and extremes.
fn friction(draw: &mut Draw) -> f64 {
    match draw.below(20) {
        0 => 0.0,
        1 | 2 => draw.spread(1e-3, 0.05),
        3 | 4 => draw.spread(1.0, 30.0),
        _ => draw.between(0.05, 0.8),
    }
}

/// Draws a profile whose contact radius is about `radius`, m, at a force divided by E\*, m².
fn profile(draw: &mut Draw, radius: f64, reduced: f64) -> Option<(&'static str, Value, Profile)> {
    // F = 2E*ad n/(n+1) for the exponent n.
    let depth = |n: f64| reduced * (n + 1.0) / (2.0 * n * radius);
    Some(match draw.below(7) {
        0 => ("flat", json!({ "flat": { "radius": radius } }), Profile::flat(radius).ok()?),
        1 => {
            let slope = depth(1.0) / radius;
            ("cone", json!({ "cone": { "slope": slope } }), Profile::cone(slope).ok()?)
        }
        2 | 3 => {
            let ball = radius * radius / depth(2.0);
            ("paraboloid", json!({ "paraboloid": { "radius": ball } }), Profile::paraboloid(ball).ok()?)
        }
        4 => {
            let ball = radius * radius / depth(2.0);
            ("sphere", json!({ "sphere": { "radius": ball } }), Profile::sphere(ball).ok()?)
        }
        5 => {
            let n = [1.5, 2.5, 3.0, 4.0, 6.0][draw.below(5) as usize];
            let coefficient = depth(n) / math::powf(radius, n);
            let shape = Profile::power(coefficient, n).ok()?;
            ("power", json!({ "power": { "coefficient": coefficient, "exponent": n } }), shape)
        }
        _ => {
            let count = HEIGHTS.0 + draw.below(HEIGHTS.1 - HEIGHTS.0);
            let highest = 2.5 * depth(2.0);
            let heights: Vec<f64> = (0..count).map(|_| draw.between(0.0, highest)).collect();
            let length = 4.0 * radius / count as f64;
            let shape = Profile::foundation(&heights, &vec![length; heights.len()]).ok()?;
            ("heights", json!({ "foundation": { "heights": heights, "length": length } }), shape)
        }
    })
}
