//! What moves: bodies, waveforms, normal modes.

use crate::job::Job;
use crate::parts::Parts;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::Waveform;
use stickslip_drive::facts::{self, Follower, Mode, followers};
use stickslip_drive::scene::{Axis, Coordinate, Freedom, Scene};
use stickslip_quantity::Real;

/// A body.
#[derive(Debug, Serialize, JsonSchema)]
pub struct BodyInfo {
    /// m, mass; left out for a body that needs none
    #[serde(rename = "mass_kg", skip_serializing_if = "Option::is_none")]
    pub mass: Option<Real>,
    /// What each coordinate does, by name.
    #[schemars(extend("x-name" = "AXIS"))]
    pub coordinates: Parts<Freed>,
}

/// what `x`, `z` and `pitch` do: `fixed`, `free` (by an equation of motion), `balanced` (where forces balance, without mass)
#[derive(Debug, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Freed {
    /// Stays where it was drawn.
    Fixed,
    /// Moves by its equation of motion.
    Free,
    /// Has no mass and is where forces balance.
    Balanced,
    /// the waveform that the coordinate follows
    Follows(String),
}

/// A waveform.
#[derive(Debug, Serialize, JsonSchema)]
pub struct WaveformInfo {
    /// T, period; left out for what does not repeat
    #[serde(rename = "period_s", skip_serializing_if = "Option::is_none")]
    pub period: Option<Real>,
    /// smallest and largest frequency that may be commanded of a generator
    #[serde(rename = "commanded_Hz", skip_serializing_if = "Option::is_none")]
    pub commanded: Option<[Real; 2]>,
    /// smallest and largest value over all time, where it drives lengths
    #[serde(rename = "range_m", skip_serializing_if = "Option::is_none")]
    pub lengths: Option<[Real; 2]>,
    /// smallest and largest value over all time, where it drives forces
    #[serde(rename = "range_N", skip_serializing_if = "Option::is_none")]
    pub forces: Option<[Real; 2]>,
    /// what follows it
    pub drives: Vec<String>,
}

/// A normal mode with all contacts stuck.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ModeInfo {
    /// frequency of a normal mode with all contacts stuck, as deep as at t = 0; 0: nothing holds this motion
    #[serde(rename = "frequency_Hz")]
    pub frequency: Real,
    /// of the mode of this place at the smallest and the largest indentations, where loads vary
    #[serde(rename = "frequency_range_Hz", skip_serializing_if = "Option::is_none")]
    pub range: Option<[Real; 2]>,
    /// share of critical damping, φᵀCφ/(2ω φᵀMφ) of the undamped shape φ: exact where damping does not couple the modes, else
    /// an estimate, which may be above 1
    pub damping_ratio: Real,
    /// displacements in the mode, the largest of them 1
    #[schemars(extend("x-name" = "COORDINATE"))]
    pub shape: Parts<Real>,
}

/// All bodies.
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

/// All waveforms.
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

/// All normal modes.
pub fn modes(job: &Job) -> Vec<ModeInfo> {
    let mode = |mode: Mode| ModeInfo {
        frequency: Real(mode.frequency),
        range: mode.range.map(|(low, high)| [Real(low), Real(high)]),
        damping_ratio: Real(mode.damping_ratio),
        shape: Parts(mode.shape.into_iter().map(|(name, x)| (name, Real(x))).collect()),
    };
    facts::modes(job.setup()).into_iter().map(mode).collect()
}
