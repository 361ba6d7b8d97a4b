//! What moves: bodies, waveforms, normal modes.

use crate::job::Job;
use crate::parts::Parts;
use serde::Serialize;
use stickslip_drive::Waveform;
use stickslip_drive::facts::{self, Follower, Mode, followers};
use stickslip_drive::scene::{Axis, Coordinate, Freedom, Scene};
use stickslip_quantity::Real;

/// A body.
#[derive(Debug, Serialize)]
pub struct BodyInfo {
    /// Mass; none of a body that needs none.
    #[serde(rename = "mass_kg", skip_serializing_if = "Option::is_none")]
    pub mass: Option<Real>,
    /// What each coordinate does, by name.
    pub coordinates: Parts<Freed>,
}

/// What a coordinate does, in the scenario's words.
#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Freed {
    /// Stays where it was drawn.
    Fixed,
    /// Moves by its equation of motion.
    Free,
    /// Has no mass and is where forces balance.
    Balanced,
    /// Follows this waveform.
    Follows(String),
}

/// A waveform.
#[derive(Debug, Serialize)]
pub struct WaveformInfo {
    /// Period; none of a waveform that does not repeat.
    #[serde(rename = "period_s", skip_serializing_if = "Option::is_none")]
    pub period: Option<Real>,
    /// Smallest and largest frequency that may be commanded; none of a waveform that nobody commands.
    #[serde(rename = "commanded_Hz", skip_serializing_if = "Option::is_none")]
    pub commanded: Option<[Real; 2]>,
    /// Smallest and largest value over all time, where it drives lengths …
    #[serde(rename = "range_m", skip_serializing_if = "Option::is_none")]
    pub lengths: Option<[Real; 2]>,
    /// … and where it drives forces.
    #[serde(rename = "range_N", skip_serializing_if = "Option::is_none")]
    pub forces: Option<[Real; 2]>,
    /// What follows it.
    pub drives: Vec<String>,
}

/// A normal mode with all contacts stuck.
#[derive(Debug, Serialize)]
pub struct ModeInfo {
    /// With all contacts as deep as at t = 0; 0: nothing holds this motion.
    #[serde(rename = "frequency_Hz")]
    pub frequency: Real,
    /// Of the mode of this place with all contacts at their smallest and largest indentation, where loads vary.
    #[serde(rename = "frequency_range_Hz", skip_serializing_if = "Option::is_none")]
    pub range: Option<[Real; 2]>,
    /// Share of critical damping.
    pub damping_ratio: Real,
    /// Displacements of the coordinates, the largest 1.
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
