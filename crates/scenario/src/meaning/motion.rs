//! Checks for parts without effect.

use super::Builder;
use crate::fault::Fault;
use crate::path::At;
use stickslip_drive::Scene;
use stickslip_drive::scene::{Body, Coordinate, Freedom, Named, Side};

/// Paths of the keys by which parts act on bodies.
const ACTING: [&str; 5] =
    ["contacts.*.between", "springs.*.between", "actuators.*.between", "loads.*.on", "gravity"];

impl Builder<'_> {
    /// Checks that some part acts on every free body, and that every spring has an effect.
    pub(super) fn actions(&self) -> Result<(), Fault> {
        let root = At::ROOT;
        let at = root.key("bodies");
        let gravity = self.scene.gravity;
        let falls = gravity.components().0 != 0.0;
        for (body, named) in self.scene.bodies.iter().zip(named_bodies(&self.scene)) {
            let Coordinate { freedom, velocity, .. } = body.part.x;
            if freedom == Freedom::Free && velocity == 0.0 && !named && !falls {
                let at = at.key(&body.name);
                let fault = at.key("x").fault("no part acts on this free body, so it never moves");
                let fault = fault.against(ACTING).against_path(at.key("start").path());
                return Err(fault.help("name it in a contact, spring, actuator or load"));
            }
        }
        let at = root.key("springs");
        for spring in &self.scene.springs {
            let part = spring.part;
            if part.stiffness == 0.0 && part.damping == 0.0 && part.preload == 0.0 {
                let fault = at.key(&spring.name).fault("this spring has no effect").on_key();
                let fault = fault.against_path(at.key(&spring.name).path());
                return Err(fault.help("give it a \"stiffness\", a \"damping\" or a \"preload\""));
            }
        }
        Ok(())
    }

    /// Checks that the body whose steps are evaluated is not fixed.
    pub(super) fn moving_body(&self, at: &At<'_>, body: usize) -> Result<usize, Fault> {
        let moves = |body: &Named<Body>| body.part.x.freedom != Freedom::Fixed;
        if self.scene.bodies.get(body).is_some_and(moves) {
            return Ok(body);
        }
        let moving = self.scene.bodies.iter().filter(|body| moves(body)).map(|body| body.name.as_str());
        let moving: Vec<&str> = moving.collect();
        let fault = at.expected("a body that moves").against(["figures", "bodies"]);
        Err(match moving.as_slice() {
            [] => fault.help("no body is free or follows a waveform"),
            moving => fault.help(format!("these bodies move: {}", moving.join(", "))),
        })
    }
}

/// Returns for each body whether a contact, spring, actuator or load names it.
pub(super) fn named_bodies(scene: &Scene) -> Vec<bool> {
    let contacts = scene.contacts.iter().map(|contact| contact.part.between);
    let springs = scene.springs.iter().map(|spring| spring.part.between);
    let actuators = scene.actuators.iter().map(|actuator| actuator.part.between);
    let loads = scene.loads.iter().map(|load| Side::Body(load.on));
    let mut named = vec![false; scene.bodies.len()];
    for side in contacts.chain(springs).chain(actuators).flatten().chain(loads) {
        if let Side::Body(body) = side {
            named[body] = true;
        }
    }
    named
}
