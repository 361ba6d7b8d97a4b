//! A part of a scene as a scene of its own.

use super::Members;
use crate::scene::{
    Actuator, Body as Drawn, Contact, Coordinate, Freedom, Load, Named, Normal, Scene, Side, Spring, Varying,
};

/// The waveforms that a part follows.
pub(super) fn read(scene: &Scene, members: &Members) -> Vec<usize> {
    let mut followed: Vec<usize> = Vec::new();
    let mut varies = |value: Varying| {
        if let Varying::Follows(w) = value {
            followed.push(w);
        }
    };
    for &body in &members.bodies {
        for (_, coordinate) in scene.bodies[body].part.coordinates() {
            if let Freedom::Follows(w) = coordinate.freedom {
                varies(Varying::Follows(w));
            }
        }
    }
    for &contact in &members.contacts {
        match scene.contacts[contact].part.normal {
            Normal::Force(v) | Normal::Indentation(v) | Normal::Radius(v) => varies(v),
            Normal::Coupled => {}
        }
    }
    members.actuators.iter().for_each(|i| varies(scene.actuators[*i].part.stroke));
    for &load in &members.loads {
        let Load { x, z, pitch, .. } = scene.loads[load];
        [x, z, pitch].into_iter().for_each(&mut varies);
    }
    followed.sort_unstable();
    followed.dedup();
    followed
}

/// The scene in which there is nothing but a part.
pub(super) fn alone(scene: &Scene, members: &Members, waveforms: &[usize]) -> Option<Scene> {
    let place = |list: &[usize], item: usize| list.binary_search(&item).ok();
    let body = |body: usize| place(&members.bodies, body);
    let side = |side: Side| match side {
        Side::Ground => Some(Side::Ground),
        Side::Body(b) => body(b).map(Side::Body),
    };
    let between = |[a, b]: [Side; 2]| Some([side(a)?, side(b)?]);
    let varying = |value: Varying| match value {
        Varying::Follows(w) => place(waveforms, w).map(Varying::Follows),
        constant @ Varying::Constant(_) => Some(constant),
    };
    let coordinate = |c: Coordinate| match c.freedom {
        Freedom::Follows(w) => Some(Coordinate { freedom: Freedom::Follows(place(waveforms, w)?), ..c }),
        Freedom::Fixed | Freedom::Free | Freedom::Balanced => Some(c),
    };
    let drawn = |b: &Drawn| {
        let (x, z, pitch) = (coordinate(b.x)?, coordinate(b.z)?, coordinate(b.pitch)?);
        Some(Drawn { x, z, pitch, ..b.clone() })
    };
    let contact = |c: &Contact| {
        let normal = match c.normal {
            Normal::Force(v) => Normal::Force(varying(v)?),
            Normal::Indentation(v) => Normal::Indentation(varying(v)?),
            Normal::Radius(v) => Normal::Radius(varying(v)?),
            Normal::Coupled => Normal::Coupled,
        };
        Some(Contact { between: between(c.between)?, normal, ..c.clone() })
    };
    let spring = |s: &Spring| Some(Spring { between: between(s.between)?, ..*s });
    let actuator =
        |a: &Actuator| Some(Actuator { between: between(a.between)?, stroke: varying(a.stroke)?, ..*a });
    let load = |l: &Load| {
        Some(Load { on: body(l.on)?, x: varying(l.x)?, z: varying(l.z)?, pitch: varying(l.pitch)?, ..*l })
    };
    // What a guide carries acts on nobody.
    let loads = members.loads.iter().filter(|i| body(scene.loads[**i].on).is_some());
    Some(Scene {
        waveforms: waveforms.iter().map(|w| scene.waveforms[*w].clone()).collect(),
        bodies: picked(&members.bodies, &scene.bodies, drawn)?,
        contacts: picked(&members.contacts, &scene.contacts, contact)?,
        blocks: Vec::new(),
        springs: picked(&members.springs, &scene.springs, spring)?,
        actuators: picked(&members.actuators, &scene.actuators, actuator)?,
        loads: loads.map(|i| load(&scene.loads[*i])).collect::<Option<_>>()?,
        gravity: scene.gravity,
        start: scene.start,
    })
}

/// Some of a list, as a part counts its places.
fn picked<T>(places: &[usize], all: &[Named<T>], alone: impl Fn(&T) -> Option<T>) -> Option<Vec<Named<T>>> {
    let named = |i: &usize| Some(Named { name: all[*i].name.clone(), part: alone(&all[*i].part)? });
    places.iter().map(named).collect()
}
