//! What moves: bodies, waveforms, normal modes.

use serde::Serialize;
use std::f64::consts::TAU;
use stickslip_drive::Waveform;
use stickslip_drive::scene::{Axis, Coordinate, Freedom, Normal, Scene, Varying};
use stickslip_results::Job;
use stickslip_results::Parts;
use stickslip_results::Real;

/// A body.
#[derive(Debug, Serialize)]
pub(super) struct BodyInfo {
    #[serde(rename = "mass_kg", skip_serializing_if = "Option::is_none")]
    pub(super) mass: Option<Real>,
    /// What each coordinate does, by name.
    pub(super) coordinates: Parts<Freed>,
}

/// What a coordinate does, in the scenario's words.
#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Freed {
    Fixed,
    Free,
    Follows(String),
}

/// A waveform.
#[derive(Debug, Serialize)]
pub(super) struct WaveformInfo {
    #[serde(rename = "period_s", skip_serializing_if = "Option::is_none")]
    pub(super) period: Option<Real>,
    /// Smallest and largest value over all time, where it drives lengths …
    #[serde(rename = "range_m", skip_serializing_if = "Option::is_none")]
    pub(super) lengths: Option<[Real; 2]>,
    /// … and where it drives forces.
    #[serde(rename = "range_N", skip_serializing_if = "Option::is_none")]
    pub(super) forces: Option<[Real; 2]>,
    /// What follows it.
    pub(super) drives: Vec<String>,
}

/// A normal mode with all contacts stuck.
#[derive(Debug, Serialize)]
pub(super) struct ModeInfo {
    /// With all contacts as deep as at t = 0; 0: nothing holds this motion.
    #[serde(rename = "frequency_Hz")]
    pub(super) frequency: Real,
    /// Of the mode of this place with all contacts at their smallest and largest indentation, where loads vary.
    #[serde(rename = "frequency_range_Hz", skip_serializing_if = "Option::is_none")]
    pub(super) range: Option<[Real; 2]>,
    /// Share of critical damping.
    pub(super) damping_ratio: Real,
    /// Displacements of the coordinates, the largest 1.
    pub(super) shape: Parts<Real>,
}

/// Something that follows a waveform.
pub(super) struct Follower {
    pub(super) waveform: usize,
    pub(super) what: String,
    /// Whether it is a force.
    pub(super) is_force: bool,
}

/// All bodies.
pub(super) fn bodies(job: &Job) -> Parts<BodyInfo> {
    let scene = &job.scenario.scene;
    let body = |body: &stickslip_drive::scene::Named<stickslip_drive::scene::Body>| {
        let of = |(axis, coordinate): (Axis, Coordinate)| {
            (axis.key().to_owned(), Freed::of(coordinate.freedom, scene))
        };
        let moves = |(axis, coordinate): &(Axis, Coordinate)| {
            *axis == Axis::X || coordinate.freedom != Freedom::Fixed
        };
        let coordinates = Parts(body.part.coordinates().into_iter().filter(moves).map(of).collect());
        (body.name.clone(), BodyInfo { mass: body.part.mass.map(Real), coordinates })
    };
    Parts(scene.bodies.iter().map(body).collect())
}

impl Freed {
    fn of(freedom: Freedom, scene: &Scene) -> Self {
        match freedom {
            Freedom::Fixed => Self::Fixed,
            Freedom::Free => Self::Free,
            Freedom::Follows(w) => {
                Self::Follows(scene.waveforms.get(w).map(|w| w.name.clone()).unwrap_or_default())
            }
        }
    }
}

/// All waveforms.
pub(super) fn waveforms(job: &Job) -> Parts<WaveformInfo> {
    let followers = followers(&job.scenario.scene);
    let waveform = |(w, named): (usize, &stickslip_drive::scene::Named<Waveform>)| {
        let mine: Vec<&Follower> = followers.iter().filter(|follower| follower.waveform == w).collect();
        let (low, high) = named.part.range();
        let range = |is_force: bool| {
            mine.iter().any(|follower| follower.is_force == is_force).then_some([Real(low), Real(high)])
        };
        let info = WaveformInfo {
            period: named.part.period().map(Real),
            lengths: range(false),
            forces: range(true),
            drives: mine.iter().map(|follower| follower.what.clone()).collect(),
        };
        (named.name.clone(), info)
    };
    Parts(job.scenario.scene.waveforms.iter().enumerate().map(waveform).collect())
}

/// Everything that follows a waveform.
pub(super) fn followers(scene: &Scene) -> Vec<Follower> {
    let mut followers = Vec::new();
    let mut add = |waveform, what: String, is_force| followers.push(Follower { waveform, what, is_force });
    for body in &scene.bodies {
        for (axis, coordinate) in body.part.coordinates() {
            if let Freedom::Follows(w) = coordinate.freedom {
                add(w, format!("{}.{}", body.name, axis.key()), false);
            }
        }
    }
    for contact in &scene.contacts {
        let (value, word) = match contact.part.normal {
            Normal::Force(value) => (value, "force"),
            Normal::Indentation(value) => (value, "indentation"),
            Normal::Radius(value) => (value, "radius"),
            Normal::Coupled => continue,
        };
        if let Varying::Follows(w) = value {
            add(w, format!("{}.{word}", contact.name), word == "force");
        }
    }
    for actuator in &scene.actuators {
        if let Varying::Follows(w) = actuator.part.stroke {
            add(w, format!("{}.stroke", actuator.name), false);
        }
    }
    for load in &scene.loads {
        let Some(body) = scene.bodies.get(load.on) else { continue };
        for (axis, value) in [(Axis::X, load.x), (Axis::Z, load.z), (Axis::Pitch, load.pitch)] {
            if let Varying::Follows(w) = value {
                add(w, format!("load on {}.{}", body.name, axis.key()), true);
            }
        }
    }
    followers
}

/// All normal modes.
pub(super) fn modes(job: &Job) -> Vec<ModeInfo> {
    let linearised = job.model.linearised(&job.start, |d| d.start);
    let varies = (0..job.model.contacts().count()).any(|c| !job.has_constant_load(c));
    let frequencies = |modes: Vec<stickslip_drive::NormalMode>| -> Vec<f64> {
        modes.iter().map(|mode| mode.frequency / TAU).collect()
    };
    let least = frequencies(job.model.linearised(&job.start, |d| d.least).modes());
    let most = frequencies(job.model.linearised(&job.start, |d| d.most).modes());
    let names = linearised.coordinates();
    let mode = |(k, mode): (usize, stickslip_drive::NormalMode)| ModeInfo {
        frequency: Real(mode.frequency / TAU),
        range: least.get(k).zip(most.get(k)).filter(|_| varies).map(|(low, high)| [Real(*low), Real(*high)]),
        damping_ratio: Real(mode.damping_ratio),
        shape: Parts(names.iter().cloned().zip(mode.shape.into_iter().map(Real)).collect()),
    };
    linearised.modes().into_iter().enumerate().map(mode).collect()
}
