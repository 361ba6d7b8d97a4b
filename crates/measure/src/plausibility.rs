//! Warnings about implausible scenarios, with the implausible number and the reason. A warning never rejects a scenario.
//!
//! Warnings of the crate `scenario` concern single values of the file. Warnings of this module concern pressures, forces and frequencies
//! that follow from these values. In reading order: `contacts` (materials, pressures, geometry), `forces` (loads, stacks, masses), `motion`
//! (strokes, resonances, tolerances), `drivers` (their computing time).

mod contacts;
mod drivers;
mod forces;
mod motion;

pub use motion::{damping_shares, multiplied};

use crate::Setting;
use stickslip_drive::Stepper;
use stickslip_drive::scene::{Freedom, Side};
use stickslip_quantity::Real;
use stickslip_quantity::quantity;
use stickslip_scenario::Warning;

/// Maximum number of warnings shown.
const MOST: usize = 20;
/// Maximum number of contacts for which expensive checks are made.
const ASKED: usize = 256;

/// Returns all plausibility warnings about a setting.
pub fn of(setting: &Setting) -> Vec<Warning> {
    let mut odd = Implausible { setting, found: Vec::new(), left_out: 0, misnamed: Vec::new() };
    odd.materials();
    odd.contacts();
    odd.loads();
    odd.actuators();
    odd.stacks();
    odd.masses();
    odd.strokes();
    odd.damping_times();
    odd.flanks();
    odd.resonances();
    odd.tolerance();
    odd.steps();
    odd.endless();
    let stepper = setting.model.effective(setting.scenario.plan.stepper);
    odd.frames(stepper);
    odd.drivers(stepper);
    odd.chatter(stepper);
    let Implausible { mut found, left_out, .. } = odd;
    if let (Some(last), 1..) = (found.last_mut(), left_out) {
        let (more, help) = (format!("{left_out} more warnings are not shown"), &mut last.report.help);
        *help = Some(help.take().map_or(more.clone(), |help| format!("{help}; {more}")));
    }
    found
}

/// Returns warnings if the error is unbounded when `stepper`, instead of the integrator of the scenario, simulates a setting in frames.
pub fn of_frames(setting: &Setting, stepper: Stepper) -> Vec<Warning> {
    let mut odd = Implausible { setting, found: Vec::new(), left_out: 0, misnamed: Vec::new() };
    odd.frames(stepper);
    odd.drivers(stepper);
    odd.chatter(stepper);
    odd.found
}

struct Implausible<'a> {
    setting: &'a Setting,
    found: Vec<Warning>,
    left_out: usize,
    /// Materials whose moduli do not fit their names.
    misnamed: Vec<&'a str>,
}

impl Implausible<'_> {
    fn find(&mut self, kind: &'static str, path: &str, message: String, help: &str) {
        if self.found.len() < MOST {
            self.found.push(self.setting.scenario.warning(kind, path, message, help));
        } else {
            self.left_out += 1;
        }
    }

    /// Returns an indentation of contact `c` that certainly occurs, m.
    ///
    /// If bodies press the contact, the result is the initial indentation, otherwise the largest prescribed indentation.
    fn depth(&self, c: usize) -> f64 {
        let depths = self.setting.model.indentations(&self.setting.start, c);
        depths.map_or(0.0, |d| if self.setting.is_coupled(c) { d.start } else { d.most })
    }

    /// Returns whether a side of a contact is a body that is free along x or z.
    fn is_free(&self, side: Side) -> bool {
        let Side::Body(body) = side else { return false };
        let body = self.setting.scenario.scene.bodies.get(body);
        body.is_some_and(|body| [body.part.x, body.part.z].iter().any(|c| c.freedom == Freedom::Free))
    }

    /// Returns the mass of the body on a side of a contact, kg, if it is free along x or z.
    fn free_mass(&self, side: Side) -> Option<f64> {
        let Side::Body(body) = side else { return None };
        self.setting.scenario.scene.bodies.get(body).filter(|_| self.is_free(side))?.part.mass
    }
}

/// Returns a number with four digits and its unit.
fn told(value: f64, unit: &str) -> String {
    quantity(Real(value), unit)
}
