//! Plausibility of loads, damping and stiffness of stacks, and masses.

use super::{Implausible, told};
use std::f64::consts::TAU;
use stickslip_drive::scene::{Freedom, Side, Varying};

/// Range of plausible masses, kg: from a grain of dust to the largest mass that may be lifted by hand (ISO 11228-1).
const MASSES: (f64, f64) = (1e-9, 25.0);
/// Range of plausible stiffnesses of piezo actuators, N/m: from lever actuators with 0.2 N/µm to thick rings below 10 kN/µm.
const STIFFNESSES: (f64, f64) = (2e5, 1e10);
/// Range of plausible capacitances of piezo actuators, F: from chips with some 10 nF to low-voltage stacks with some 100 µF.
const CAPACITANCES: (f64, f64) = (1e-11, 1e-3);
/// Quality factor of a mounted piezo stack, from which the warning computes a proposed damping.
const QUALITY: f64 = 30.0;

/// Forces on a body along x and their support.
#[derive(Clone)]
struct Pull {
    /// Smallest and largest force, N.
    range: (f64, f64),
    /// Sum of the friction limits μF_N of the contacts of the body, N. `None` without contacts, or if other parts hold the body.
    holds: Option<f64>,
    /// Whether the body is massless, so that the forces on it must be in equilibrium.
    is_balanced: bool,
    /// Largest force, N, and the index of its load. The index is `None` for gravity.
    cause: (f64, Option<usize>),
}

impl Implausible<'_> {
    /// Warns about loads that exceed the total friction limit of the contacts of a body.
    pub(super) fn loads(&mut self) {
        for (body, pull) in self.pulls().into_iter().enumerate() {
            let (low, high) = pull.range;
            let counts = if pull.is_balanced {
                low.abs().max(high.abs())
            } else if low <= 0.0 && high >= 0.0 {
                // The mean of a load that changes its sign may be 0.
                0.0
            } else {
                low.abs().min(high.abs())
            };
            let Some(holds) = pull.holds.filter(|holds| counts > *holds) else { continue };
            let name = self.setting.scenario.scene.bodies[body].name.clone();
            let path = pull.cause.1.map_or("gravity".to_owned(), |i| format!("loads[{i}].x"));
            let [load, holds] = [counts, holds].map(|force| told(force, "N"));
            let then = if pull.is_balanced {
                "no force balances the load, and the run stops"
            } else {
                "the body slides away"
            };
            let message = format!(
                "a load of {load} on {name} exceeds the friction limit of its contacts, {holds} (μF_N): {then}"
            );
            self.find(
                "load",
                &path,
                message,
                "reduce the load, increase the normal force, or hold the body by a spring",
            );
        }
    }

    fn pulls(&self) -> Vec<Pull> {
        let scene = &self.setting.scenario.scene;
        let down = scene.gravity.components().0;
        let mut pulls: Vec<Pull> = scene
            .bodies
            .iter()
            .map(|body| {
                let weight = -body.part.mass.unwrap_or(0.0) * down;
                let is_balanced = body.part.x.freedom == Freedom::Balanced;
                Pull { range: (weight, weight), holds: None, is_balanced, cause: (weight.abs(), None) }
            })
            .collect();
        for (i, load) in scene.loads.iter().enumerate() {
            let Some(pull) = pulls.get_mut(load.on) else { continue };
            let (low, high) = match load.x {
                Varying::Constant(force) => (force, force),
                Varying::Follows(w) => scene.waveforms.get(w).map_or((0.0, 0.0), |w| w.part.range()),
            };
            let most = low.abs().max(high.abs());
            if most > pull.cause.0 {
                pull.cause = (most, Some(i));
            }
            pull.range = (pull.range.0 + low, pull.range.1 + high);
        }
        for (c, contact) in scene.contacts.iter().enumerate() {
            let law = &contact.part.interface;
            let d = self.depth(c);
            // If bodies press the contact and it is open at the start, its normal force is unknown.
            let unknown = d <= 0.0 && self.setting.is_coupled(c);
            let limit = f64::from(contact.part.count) * law.friction() * law.normal_force(d);
            let limit = if unknown { f64::INFINITY } else { limit };
            for side in contact.part.between {
                if let Side::Body(body) = side
                    && let Some(pull) = pulls.get_mut(body)
                {
                    pull.holds = Some(pull.holds.unwrap_or(0.0) + limit);
                }
            }
        }
        let springs = scene.springs.iter().filter(|spring| spring.part.stiffness > 0.0);
        let links = springs.map(|spring| spring.part.between);
        let links = links.chain(scene.actuators.iter().map(|actuator| actuator.part.between));
        for side in links.flatten() {
            if let Side::Body(body) = side
                && let Some(pull) = pulls.get_mut(body)
            {
                pull.holds = None;
            }
        }
        for (pull, body) in pulls.iter_mut().zip(&scene.bodies) {
            if !matches!(body.part.x.freedom, Freedom::Free | Freedom::Balanced) {
                pull.holds = None;
            }
        }
        pulls
    }

    /// Warns about stacks without damping.
    pub(super) fn actuators(&mut self) {
        let setting = self.setting;
        let scene = &setting.scenario.scene;
        let mut damped = vec![false; scene.bodies.len()];
        let dampers = scene.springs.iter().map(|spring| (spring.part.damping, spring.part.between));
        let dampers = dampers.chain(scene.actuators.iter().map(|a| (a.part.damping, a.part.between)));
        let contacts = scene.contacts.iter().map(|c| (c.part.interface.damping(), c.part.between));
        for (_, between) in dampers.chain(contacts).filter(|(damping, _)| *damping > 0.0) {
            for side in between.iter().filter(|side| self.is_free(**side)) {
                if let Side::Body(body) = side {
                    damped[*body] = true;
                }
            }
        }
        for actuator in &scene.actuators {
            let (part, name) = (&actuator.part, &actuator.name);
            let mobility: f64 =
                part.between.iter().filter_map(|side| self.free_mass(*side)).map(f64::recip).sum();
            let damped = part.between.iter().any(|side| matches!(side, Side::Body(body) if damped[*body]));
            if mobility == 0.0 || damped {
                continue;
            }
            let frequency = told((part.stiffness * mobility).sqrt() / TAU, "Hz");
            let proposed = (part.stiffness / mobility).sqrt() / QUALITY;
            let message = format!(
                "this stack has no damping: its ringing does not decay; the frequency is about {frequency} without a load"
            );
            let help = format!("a quality factor of {QUALITY} has \"damping\": {proposed:.2}, in N s/m");
            self.find("damping", &format!("actuators.{name}"), message, &help);
        }
    }

    /// Checks the stiffnesses and capacitances of stacks for a wrong unit prefix.
    pub(super) fn stacks(&mut self) {
        let setting = self.setting;
        for piezo in &setting.scenario.stacks {
            let numbers = [
                ("stiffness", Some(piezo.stack.stiffness), STIFFNESSES, "N/m", "\"100 N/um\""),
                ("capacitance", piezo.stack.capacitance, CAPACITANCES, "F", "\"7.2 uF\""),
            ];
            for (key, value, (low, high), unit, typical) in numbers {
                let Some(value) = value.filter(|value| !(low..=high).contains(value)) else { continue };
                let [said, low, high] = [value, low, high].map(|number| told(number, unit));
                let message =
                    format!("a {key} of {said} is outside the range of piezo actuators, {low} to {high}");
                let help = format!("typical of a stack: {typical}; a number without a unit is in {unit}");
                self.find(key, &setting.scenario.stack_path(&piezo.name, key), message, &help);
            }
        }
    }

    /// Checks the masses for a missing unit.
    pub(super) fn masses(&mut self) {
        let setting = self.setting;
        for (i, body) in setting.scenario.scene.bodies.iter().enumerate() {
            let Some(mass) = self.free_mass(Side::Body(i)) else { continue };
            let path = format!("bodies.{}.mass", body.name);
            let said = told(1e3 * mass, "g");
            if mass > MASSES.1 {
                let most = told(1e3 * MASSES.1, "g");
                let message =
                    format!("a mass of {said} exceeds the masses that stick-slip drives move, up to {most}");
                self.find("mass", &path, message, "a number without a unit is in kg; ten grams are \"10 g\"");
            } else if mass < MASSES.0 {
                let message = format!("a mass of {said} is less than the mass of a grain of dust");
                self.find("mass", &path, message, "a number without a unit is in kg; ten grams are \"10 g\"");
            }
        }
    }
}
