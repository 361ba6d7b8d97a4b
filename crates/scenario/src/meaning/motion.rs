//! What moves what: parts that could do nothing, and figures of what does nothing.

use super::Builder;
use crate::fault::Fault;
use crate::path::At;
use stickslip_drive::Scene;
use stickslip_drive::scene::{Body, Coordinate, Freedom, Named, Side};

/// What names the bodies that something acts on.
const ACTING: [&str; 5] =
    ["contacts.*.between", "springs.*.between", "actuators.*.between", "loads.*.on", "gravity"];

impl Builder<'_> {
    /// Every free body has something that acts on it, and every spring something to do.
    pub(super) fn actions(&self) -> Result<(), Fault> {
        let root = At::ROOT;
        let at = root.key("bodies");
        let gravity = self.scene.gravity;
        let falls = gravity.components().0 != 0.0;
        for (body, named) in self.scene.bodies.iter().zip(named_bodies(&self.scene)) {
            let Coordinate { freedom, velocity, .. } = body.part.x;
            if freedom == Freedom::Free && velocity == 0.0 && !named && !falls {
                let at = at.key(&body.name);
                let fault = at.key("x").fault("nothing acts on this free body: it would never move");
                let fault = fault.against(ACTING).against_path(at.key("start").path());
                return Err(fault.help("name it in a contact, spring, actuator or load"));
            }
        }
        let at = root.key("springs");
        for spring in &self.scene.springs {
            let part = spring.part;
            if part.stiffness == 0.0 && part.damping == 0.0 && part.preload == 0.0 {
                let fault = at.key(&spring.name).fault("this spring does nothing").on_key();
                let fault = fault.against_path(at.key(&spring.name).path());
                return Err(fault.help("give it a \"stiffness\", a \"damping\" or a \"preload\""));
            }
        }
        Ok(())
    }

    /// The body whose motion makes steps does move.
    pub(super) fn moving_body(&self, at: &At<'_>, body: usize) -> Result<usize, Fault> {
        let moves = |body: &Named<Body>| body.part.x.freedom != Freedom::Fixed;
        if self.scene.bodies.get(body).is_some_and(moves) {
            return Ok(body);
        }
        let moving = self.scene.bodies.iter().filter(|body| moves(body)).map(|body| body.name.as_str());
        let moving: Vec<&str> = moving.collect();
        let fault = at.expected("a body that moves").against(["figures", "bodies"]);
        Err(match moving.as_slice() {
            [] => fault.help("here none is free or follows a waveform"),
            moving => fault.help(format!("here these do: {}", moving.join(", "))),
        })
    }
}

/// Whether a contact, spring, actuator or load names each body.
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
