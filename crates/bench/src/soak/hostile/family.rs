//! Families of extreme scenarios: one parameter of a simple drive with extreme values.

use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// Family of scenarios with the values of its parameter.
pub(super) struct Family {
    /// Name in tables and plots.
    pub(super) name: &'static str,
    /// Name of the parameter with its unit.
    pub(super) axis: &'static str,
    /// Values in ascending order.
    pub(super) values: Vec<f64>,
    /// Returns the scenario of a value, without stepper and limits.
    pub(super) scene: fn(f64) -> Value,
}

impl Family {
    /// Returns whether the values lie closely around 1.
    fn is_fine(&self) -> bool {
        self.values.contains(&1.0) && self.values.iter().all(|value| (value - 1.0).abs() <= 0.1 + 1e-12)
    }

    /// Returns the position of a value in a plot: its power of ten, or for values around 1 the power of ten of the distance from 1.
    pub(super) fn place(&self, value: f64) -> f64 {
        if self.is_fine() {
            let distance = math::log10((value - 1.0).abs()).max(-10.0);
            return (10.0 + distance).round() * (value - 1.0).signum();
        }
        // Zero has the position before the smallest value.
        if value > 0.0 { math::log10(value) } else { math::log10(self.values[1]) - 1.0 }
    }

    /// Returns the axis label of the positions n.
    pub(super) fn label(&self) -> &'static str {
        if self.is_fine() { "n of 1 ± 10^(|n|−10)" } else { "power of ten" }
    }
}

/// Simple drive: a slider of 20 g on a steel ball of 1 mm radius and an oscillating foot.
struct Plain {
    mass: f64,
    radius: f64,
    modulus: f64,
    friction: f64,
    force: f64,
    period: f64,
    stroke: f64,
    /// Constant load on the slider, N.
    load: f64,
    cycles: f64,
}

/// Effective moduli divided by E for equal bodies with ν = 0.3: E\* = E/(2(1-ν²)), G\* = 4G/(2(2-ν)) = E/((1+ν)(2-ν)).
const NORMAL: f64 = 1.0 / (2.0 * (1.0 - 0.09));
const TANGENTIAL: f64 = 1.0 / (1.3 * 1.7);

const PLAIN: Plain = Plain {
    mass: 0.02,
    radius: 1e-3,
    modulus: 210e9,
    friction: 0.15,
    force: 1.0,
    period: 1e-3,
    stroke: 0.5e-6,
    load: 0.0,
    cycles: 2.3,
};

impl Plain {
    /// Returns the Hertzian indentation from F = (4/3)E\*√R d^{3/2}, m.
    fn depth(&self) -> f64 {
        math::powf(0.75 * self.force / (NORMAL * self.modulus * self.radius.sqrt()), 2.0 / 3.0)
    }

    /// Returns u_c = μ(E\*/G\*)d, m.
    fn slip(&self) -> f64 {
        self.friction * NORMAL / TANGENTIAL * self.depth()
    }

    /// Returns the tangential stiffness 2G\*a, N/m.
    fn stiffness(&self) -> f64 {
        2.0 * TANGENTIAL * self.modulus * (self.radius * self.depth()).sqrt()
    }

    fn scene(&self) -> Value {
        let mut scene = json!({
            "stickslip": 1,
            "materials": { "steel": { "youngs_modulus": self.modulus, "poisson_ratio": 0.3 } },
            "waveforms": { "drive": { "sawtooth":
                { "stroke": self.stroke, "period": self.period, "flyback": 0.1 * self.period, "phase": 0.5 * PI } } },
            "bodies": { "foot": { "x": { "follows": "drive" } }, "slider": { "mass": self.mass, "x": "free" } },
            "contacts": { "ball": {
                "between": ["foot", "slider"], "materials": ["steel", "steel"], "friction": self.friction,
                "profile": { "paraboloid": { "radius": self.radius } }, "normal": { "force": self.force } } },
            "run": { "duration": self.cycles * self.period },
        });
        if self.load != 0.0 {
            scene["loads"] = json!([{ "on": "slider", "x": self.load }]);
        }
        scene
    }

    /// Returns the drive with a sine instead of the sawtooth.
    fn smooth(&self) -> Value {
        let mut scene = self.scene();
        let sine = json!({ "amplitude": 0.5 * self.stroke, "period": self.period, "phase": 1.0 });
        scene["waveforms"] = json!({ "drive": { "sine": sine } });
        scene
    }
}

/// Returns values with equal ratios between two powers of ten.
fn decades(from: i32, to: i32, count: usize) -> Vec<f64> {
    let step = f64::from(to - from) / (count - 1) as f64;
    (0..count).map(|i| math::powf(10.0, f64::from(from) + step * i as f64)).collect()
}

/// Returns 1 ± 10^-k in ascending order.
fn hairs() -> Vec<f64> {
    let below = (1..=9).map(|k| 1.0 - 10_f64.powi(-k));
    let above = (1..=9).rev().map(|k| 1.0 + 10_f64.powi(-k));
    below.chain([1.0]).chain(above).collect()
}

/// Returns a ball of 4 g that falls onto a plate from a height.
fn dropped(height: f64, damping: f64) -> Value {
    // Fall, contact and two bounces: √(8h/g) is one flight; 50 µs is about the longest contact.
    let duration = 2.5 * (8.0 * height / 9.81).sqrt() + 1e-4;
    let mut scene = json!({
        "stickslip": 1,
        "materials": { "steel": { "youngs_modulus": 210e9, "poisson_ratio": 0.3 } },
        "bodies": { "ball": { "mass": 4e-3, "x": "free", "z": "free", "start": { "z": height, "vx": 1e-3 } } },
        "contacts": { "foot": {
            "between": ["ground", "ball"], "materials": ["steel", "steel"], "friction": 0.15, "normal": "coupled",
            "profile": { "paraboloid": { "radius": 5e-3 } } } },
        "gravity": {},
        "run": { "duration": duration },
    });
    if damping > 0.0 {
        scene["springs"] =
            json!({ "damper": { "between": ["ground", "ball"], "direction": "z", "damping": damping } });
    }
    scene
}

/// Returns a symmetric slider on two equal contacts of a foot that oscillates along x and z.
fn twins(lift: f64) -> Value {
    let sine = |amplitude: f64| json!({ "sine": { "amplitude": amplitude, "period": 1e-3 } });
    let contact = |x: f64| {
        json!({ "between": ["foot", "slider"], "materials": ["steel", "steel"], "friction": 0.2, "normal": "coupled",
            "profile": { "paraboloid": { "radius": 1e-3 } }, "at": { "slider": { "x": x } } })
    };
    json!({
        "stickslip": 1,
        "materials": { "steel": { "youngs_modulus": 210e9, "poisson_ratio": 0.3 } },
        "waveforms": { "along": sine(30e-9), "up": sine(lift) },
        "bodies": {
            "foot": { "x": { "follows": "along" }, "z": { "follows": "up" } },
            "slider": { "mass": 0.02, "inertia": 1e-6, "x": "free", "z": "free", "pitch": "free" } },
        "contacts": { "left": contact(-5e-3), "right": contact(5e-3) },
        "loads": [{ "on": "slider", "z": -2.0 }],
        "run": { "duration": 2.3e-3, "start": "equilibrium" },
    })
}

/// Returns the simple drive with a normal force that starts at 0 and returns to 0.
fn breathing(force: f64) -> Value {
    let mut scene = Plain { force, ..PLAIN }.scene();
    scene["waveforms"]["press"] = json!({ "triangle": { "stroke": force, "period": 0.7e-3 } });
    scene["contacts"]["ball"]["normal"] = json!({ "force": { "follows": "press" } });
    scene
}

/// Returns all families.
pub(super) fn all() -> Vec<Family> {
    let family = |name, axis, values, scene| Family { name, axis, values, scene };
    let plain: [Family; 8] = [
        family("mass", "mass, kg", decades(-12, 6, 19), |mass| Plain { mass, ..PLAIN }.scene()),
        family("radius", "radius, m", decades(-9, 1, 11), |radius| Plain { radius, ..PLAIN }.scene()),
        family("modulus", "Young's modulus, Pa", decades(6, 12, 13), |modulus| {
            Plain { modulus, ..PLAIN }.smooth()
        }),
        family("friction", "friction", [vec![0.0], decades(-6, 3, 12)].concat(), |friction| {
            Plain { friction, ..PLAIN }.scene()
        }),
        family("frequency", "frequency, Hz", decades(-1, 6, 15), |frequency| {
            Plain { period: 1.0 / frequency, ..PLAIN }.smooth()
        }),
        family("stroke", "stroke, m", decades(-12, -3, 13), |stroke| Plain { stroke, ..PLAIN }.scene()),
        family("load", "load over its limit", hairs(), |part| {
            Plain { load: part * PLAIN.friction * PLAIN.force, stroke: 20e-9, ..PLAIN }.scene()
        }),
        family("resonance", "resonance over drive", decades(-4, 4, 17), |ratio| {
            let mass = PLAIN.stiffness() * (PLAIN.period / (TAU * ratio)).powi(2);
            Plain { mass, ..PLAIN }.smooth()
        }),
    ];
    let others: [Family; 9] = [
        family("grazing", "amplitude over slip", hairs(), |part| {
            // The heavy mass stands still, so the foot moves the contact to the edge of gross slip and back.
            Plain { mass: 1e3, stroke: part * PLAIN.slip(), ..PLAIN }.scene()
        }),
        family("symmetry", "lift, m", decades(-12, -6, 13), twins),
        family("bouncing", "height, m", decades(-12, -2, 16), |height| dropped(height, 0.0)),
        family("coming to rest", "damping, N s/m", decades(-3, 4, 15), |damping| dropped(1e-7, damping)),
        family("springs", "springs of the row", decades(0, 6, 13), |count| {
            let mut scene = Plain { cycles: 1.0, ..PLAIN }.scene();
            scene["contacts"]["ball"]["engine"] = json!({ "springs": { "count": count.round() } });
            scene
        }),
        family("periods", "periods", decades(0, 6, 13), |cycles| Plain { cycles, ..PLAIN }.scene()),
        family("damper", "damping, N s/m", decades(-4, 9, 14), |damping| {
            let mut scene = PLAIN.smooth();
            scene["springs"] = json!({ "damper": { "between": ["ground", "slider"], "damping": damping } });
            scene
        }),
        family("breathing", "largest force, N", decades(-6, 3, 13), breathing),
        family("faint friction", "friction", decades(-14, -2, 13), |friction| {
            Plain { friction, ..PLAIN }.smooth()
        }),
    ];
    plain.into_iter().chain(others).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_scenario::Scenario;

    #[test]
    fn scales_are_those_of_the_contact_crate() {
        let read = Scenario::from_str_alone(&PLAIN.scene().to_string(), "plain").unwrap();
        let law = &read.scene.contacts[0].part.interface;
        let depth = law.indentation(PLAIN.force);
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
        assert!(close(PLAIN.depth(), depth));
        assert!(close(PLAIN.slip(), law.gross_slip_displacement(depth)));
        assert!(close(PLAIN.stiffness(), law.stick_stiffness(depth)));
    }

    #[test]
    fn every_scene_can_be_read() {
        for family in all() {
            for value in &family.values {
                let text = (family.scene)(*value).to_string();
                assert!(Scenario::from_str_alone(&text, "hostile").is_ok(), "{} {value}", family.name);
            }
        }
    }
}
