//! Bodies, waveforms and normal modes.

use crate::job::Job;
use crate::parts::Parts;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::Waveform;
use stickslip_drive::facts::{self, Follower, Mode, followers};
use stickslip_drive::scene::{Axis, Coordinate, Freedom, Scene};
use stickslip_quantity::Real;

/// Properties of a body.
#[derive(Debug, Serialize, JsonSchema)]
pub struct BodyInfo {
    /// m, mass of the body. Absent if the scenario gives none.
    #[serde(rename = "mass_kg", skip_serializing_if = "Option::is_none")]
    pub mass: Option<Real>,
    /// Type of each coordinate, by its name.
    #[schemars(extend("x-name" = "AXIS"))]
    pub coordinates: Parts<Freed>,
}

/// type of the coordinate `x`, `z` or `pitch`: `fixed`, `free` (has inertia and obeys the equation of motion) or
/// `balanced` (no inertia, forces in equilibrium at all times). A coordinate that follows a waveform has the key
/// `follows` instead.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Freed {
    /// Does not move.
    Fixed,
    /// Has inertia and obeys the equation of motion.
    Free,
    /// Has no inertia; its forces are in equilibrium at all times.
    Balanced,
    /// name of the waveform that the coordinate follows
    Follows(String),
}

/// Properties of a waveform.
#[derive(Debug, Serialize, JsonSchema)]
pub struct WaveformInfo {
    /// T, period. Absent for waveforms that do not repeat.
    #[serde(rename = "period_s", skip_serializing_if = "Option::is_none")]
    pub period: Option<Real>,
    /// smallest and largest frequency that a generator accepts as a command. Absent for other waveforms.
    #[serde(rename = "commanded_Hz", skip_serializing_if = "Option::is_none")]
    pub commanded: Option<[Real; 2]>,
    /// smallest and largest value over all time, if the waveform drives lengths or angles. Absent otherwise.
    #[serde(rename = "range_m", skip_serializing_if = "Option::is_none")]
    pub lengths: Option<[Real; 2]>,
    /// smallest and largest value over all time, if the waveform drives forces. Absent otherwise.
    #[serde(rename = "range_N", skip_serializing_if = "Option::is_none")]
    pub forces: Option<[Real; 2]>,
    /// coordinates, actuators, loads and contacts that follow the waveform
    pub drives: Vec<String>,
}

/// Normal mode with all contacts in full stick.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ModeInfo {
    /// natural frequency of a normal mode with all contacts in full stick, at their indentations at t = 0. 0 for a
    /// rigid-body motion that nothing holds.
    #[serde(rename = "frequency_Hz")]
    pub frequency: Real,
    /// frequencies of the normal mode at the smallest and largest indentations of varying loads. Absent if no load
    /// varies.
    #[serde(rename = "frequency_range_Hz", skip_serializing_if = "Option::is_none")]
    pub range: Option<[Real; 2]>,
    /// damping ratio (1: critical damping): φᵀCφ/(2ω φᵀMφ), with the undamped mode shape φ. Exact if damping does not
    /// couple the modes; otherwise an estimate, which may exceed 1.
    pub damping_ratio: Real,
    /// mode shape: displacement of each coordinate, normalised to a largest value of 1
    #[schemars(extend("x-name" = "COORDINATE"))]
    pub shape: Parts<Real>,
}

/// Returns the properties of all bodies.
pub fn bodies(job: &Job) -> Parts<BodyInfo> {
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
            Freedom::Balanced => Self::Balanced,
            Freedom::Follows(w) => {
                Self::Follows(scene.waveforms.get(w).map(|w| w.name.clone()).unwrap_or_default())
            }
        }
    }
}

/// Returns the properties of all waveforms.
pub fn waveforms(job: &Job) -> Parts<WaveformInfo> {
    let followers = followers(&job.scenario.scene);
    let waveform = |(w, named): (usize, &stickslip_drive::scene::Named<Waveform>)| {
        let mine: Vec<&Follower> = followers.iter().filter(|follower| follower.waveform == w).collect();
        let (low, high) = named.part.range();
        let range = |is_force: bool| {
            mine.iter().any(|follower| follower.is_force == is_force).then_some([Real(low), Real(high)])
        };
        let info = WaveformInfo {
            period: named.part.period().map(Real),
            commanded: named.part.generator().map(|it| [Real(it.frequencies.0), Real(it.frequencies.1)]),
            lengths: range(false),
            forces: range(true),
            drives: mine.iter().map(|follower| follower.what.clone()).collect(),
        };
        (named.name.clone(), info)
    };
    Parts(job.scenario.scene.waveforms.iter().enumerate().map(waveform).collect())
}

/// Returns all normal modes.
pub fn modes(job: &Job) -> Vec<ModeInfo> {
    let mode = |mode: Mode| ModeInfo {
        frequency: Real(mode.frequency),
        range: mode.range.map(|(low, high)| [Real(low), Real(high)]),
        damping_ratio: Real(mode.damping_ratio),
        shape: Parts(mode.shape.into_iter().map(|(name, x)| (name, Real(x))).collect()),
    };
    facts::modes(job.setup()).into_iter().map(mode).collect()
}
