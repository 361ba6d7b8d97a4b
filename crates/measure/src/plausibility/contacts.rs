//! Plausibility of materials, contact pressures and geometry.

use super::{Implausible, told};
use std::f64::consts::PI;
use stickslip_contact::Interface;
use stickslip_scenario::substance;

/// Factor by which a modulus may lie outside of the range of its material, because materials may be porous, rolled or alloyed.
const APART: f64 = 3.0;
/// Mean pressure at which a ball begins to yield below its surface, in yield stresses.
///
/// p_max = 1.6 Y and p = ⅔ p_max (Johnson, *Contact Mechanics*, section 6.1).
const ONSET: f64 = 1.07;
/// Largest pressure that hard ceramics withstand, Pa.
const PRESSURE: f64 = 10e9;
/// Contact radius, in radii of the ball, above which paraboloid and half-space are poor approximations.
///
/// At 0.2, the height of a sphere exceeds that of its paraboloid by 1 %; at 0.4, by 4 %.
const FLAT: f64 = 0.2;

impl Implausible<'_> {
    /// Checks that the moduli fit the names of the materials.
    pub(super) fn materials(&mut self) {
        let setting = self.setting;
        for (name, modulus) in setting.scenario.materials() {
            let Some(kind) = substance(name) else { continue };
            let (low, high) = kind.modulus;
            if (low / APART..=high * APART).contains(&modulus) {
                continue;
            }
            // Either the name or the modulus is wrong, so the strength is unknown as well.
            self.misnamed.push(name);
            let path = format!("materials.{name}.youngs_modulus");
            // The scenario has a separate warning about a modulus below that of any solid.
            if setting.scenario.warnings.iter().any(|odd| odd.kind == "modulus" && odd.path == path) {
                continue;
            }
            let [own, low, high] = [modulus, low, high].map(|e| told(e, "Pa"));
            let message = format!("{own} is outside the range of {}, {low} to {high}", kind.name);
            self.find(
                "modulus",
                &path,
                message,
                "a number without a unit is in Pa; check the unit prefix and the name of the material",
            );
        }
    }

    /// Checks friction coefficients, contact pressures and the indentation of balls.
    pub(super) fn contacts(&mut self) {
        let setting = self.setting;
        for (c, (name, law)) in setting.model.contacts().enumerate() {
            let d = self.depth(c);
            let path = format!("contacts.{name}.friction");
            let given = setting
                .scenario
                .scene
                .contacts
                .get(c)
                .map_or(0.0, |contact| contact.part.interface.friction());
            if given > law.friction() {
                let message = format!(
                    "a friction coefficient of {given:e} gives forces below the rounding error of the other forces: it is treated as 0"
                );
                self.find(
                    "friction",
                    &path,
                    message,
                    "give a larger coefficient, or 0 for a contact without friction",
                );
            } else if law.friction() == 0.0 && !setting.is_coupled(c) {
                // A contact that is pressed by its bodies supports them even without friction.
                let message = "without friction this contact slides under any force and dissipates nothing";
                self.find(
                    "friction",
                    &path,
                    message.to_owned(),
                    "check that a friction coefficient of 0 is intended",
                );
            }
            if d > 0.0 {
                self.pressures(c, (name, law), d);
                self.ball(c, (name, law), d);
            }
        }
    }

    fn pressures(&mut self, c: usize, (name, law): (&str, &Interface), d: f64) {
        // A contact that is given by a list of spring heights has no contact area.
        let Some(peak) = law.peak_pressure(d) else { return };
        let mean = law.normal_force(d) / (PI * law.profile().radius(d).powi(2));
        let setting = self.setting;
        let materials = setting.scenario.materials_of(c).unwrap_or_default();
        let weaker = materials
            .into_iter()
            .filter(|name| !self.misnamed.contains(name))
            .filter_map(substance)
            .min_by(|a, b| a.strength.total_cmp(&b.strength));
        let path = format!("contacts.{name}.normal");
        let help = "reduce the normal force or use a larger radius: the contact theory is elastic";
        if let Some(kind) = weaker.filter(|kind| mean > ONSET * kind.strength) {
            let [mean, onset, strength] = [mean, ONSET * kind.strength, kind.strength].map(|p| told(p, "Pa"));
            let message = format!(
                "a mean contact pressure of {mean}; {}, with a yield stress of up to {strength}, begins to yield at about {onset}",
                kind.name
            );
            let stronger = kind.strongest().map_or_else(String::new, |other| {
                let onset = told(ONSET * other.strength, "Pa");
                format!("; {} begins to yield at {onset}: give that name if it is the material", other.name)
            });
            self.find("pressure", &path, message, &format!("{help}{stronger}"));
        } else if peak.is_finite() && peak > PRESSURE {
            let message = format!(
                "a maximum contact pressure of {}, more than hard ceramics withstand",
                told(peak, "Pa")
            );
            self.find("pressure", &path, message, help);
        }
    }

    fn ball(&mut self, c: usize, (name, law): (&str, &Interface), d: f64) {
        let setting = self.setting;
        let Some((radius, is_paraboloid)) = setting.scenario.ball_of(c) else { return };
        let share = law.profile().radius(d) / radius;
        if share > FLAT {
            let (theory, word) = if is_paraboloid {
                ("the paraboloid is no longer a good approximation of a ball", "paraboloid")
            } else {
                ("the body is no longer well approximated by a half-space", "sphere")
            };
            let a = told(law.profile().radius(d), "m");
            let message = format!("the contact radius, {a}, is {share:.2} of the ball's radius: {theory}");
            let path = format!("contacts.{name}.profile.{word}.radius");
            self.find("geometry", &path, message, "check the unit of the radius");
        }
    }
}
