//! Evaluation of the last period of a drive.

use super::losses::{self, FootMotion, Losses};
use crate::job::Job;
use crate::outcome::Outcome;
use crate::parts::Parts;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::scene::{Scene, Varying};
use stickslip_measure::Extreme;
use stickslip_measure::Stride;
use stickslip_measure::account::{Account, ContactAccount, Phases, RINGING};
use stickslip_quantity::Real;

/// Last whole period of the waveform named in `figures`. The forward stroke is the slower stroke of the waveform. If
/// both are equally slow, it is the stroke in the direction of the step.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LastPeriod {
    /// start time of the last whole period
    #[serde(rename = "from_s")]
    from: Real,
    /// end time of the last whole period
    #[serde(rename = "to_s")]
    to: Real,
    /// step length in the last whole period: displacement of the body
    #[serde(rename = "step_m")]
    pub(super) step: Real,
    /// Losses of the step.
    #[serde(flatten)]
    pub(super) losses: Losses,
    /// Motion of the foot, or the reason why it is not evaluated.
    #[serde(skip)]
    pub(super) foot: Result<FootMotion, &'static str>,
    /// Forward stroke.
    #[serde(rename = "forward")]
    pub(super) forth: Way,
    /// Return stroke.
    #[serde(rename = "return")]
    pub(super) back: Way,
    /// Energy balance of the period.
    pub(super) work: PeriodWork,
    /// Contacts of the body.
    #[schemars(extend("x-name" = "CONTACT"))]
    pub(super) contacts: Parts<ContactPeriod>,
}

/// Stroke of the waveform, forward or return.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Way {
    /// duration of the `forward` or `return` stroke of the waveform. `forward` is the slower stroke. If both are
    /// equally slow, it is the stroke in the direction of the step; without a step, the rising one.
    #[serde(rename = "time_s")]
    pub(super) time: Real,
    /// travel of the waveform during the stroke, with its sign. Absent if the waveform is no length.
    #[serde(rename = "stroke_m", skip_serializing_if = "Option::is_none")]
    pub(super) stroke: Option<Real>,
    /// travel of the body during the stroke. Travel while the waveform rests counts with the forward stroke.
    #[serde(rename = "travel_m")]
    pub(super) travel: Real,
}

/// Energy balance of a period: drive = load + friction + damping + stored, except for integration errors.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PeriodWork {
    /// energy that the drive supplied in the period: increase of energy.input_J, plus load_J. Absent if a load varies
    /// or acts on another body.
    #[serde(rename = "drive_J", skip_serializing_if = "Option::is_none")]
    pub(super) drive: Option<Real>,
    /// work of the body in the period against constant loads and its weight: -F·step, with their force F along x.
    /// Absent if a load varies or acts on another body.
    #[serde(rename = "load_J", skip_serializing_if = "Option::is_none")]
    pub(super) load: Option<Real>,
    /// friction work in the period
    #[serde(rename = "friction_J")]
    pub(super) friction: Real,
    /// energy dissipated in the period by dampers and contact damping
    #[serde(rename = "damping_J")]
    pub(super) damping: Real,
    /// increase of kinetic and elastic energy in the period
    #[serde(rename = "stored_J")]
    stored: Real,
    /// efficiency: load_J / drive_J. Absent unless both are above 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) efficiency: Option<Real>,
}

/// Behaviour of a contact of the body in the period.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ContactPeriod {
    /// fraction of the forward stroke in gross slip
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) slip_share_forward: Option<Real>,
    /// fraction of the return stroke in gross slip
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) slip_share_return: Option<Real>,
    /// number of reversals of u in the forward stroke, also in full stick. Reversals out of gross slip do not count.
    pub(super) reversals_forward: u32,
    /// settling time: from the start of the forward stroke to the last oscillation of F_x with an amplitude above 5 %
    /// of μF_N. 0 without such an oscillation. Absent if the last oscillation of the stroke is still above 5 %.
    #[serde(rename = "settling_s", skip_serializing_if = "Option::is_none")]
    pub(super) settling: Option<Real>,
    /// residual ringing: amplitude of the last oscillation of F_x in the forward stroke, divided by μF_N
    pub(super) ringing_left: Real,
}

/// Returns the evaluation of the last whole period, if there is one. `stride` is the motion of the body in this period; a step below
/// `error`, m, counts as no step.
pub(super) fn of(
    job: &Job,
    outcome: &Outcome,
    (stride, error): (Stride, f64),
    is_length: bool,
) -> Option<LastPeriod> {
    let accounts = outcome.tally.accounts()?;
    let account = accounts.last()?;
    let forth = forth(account);
    let [from, to] = account.span.map(Real);
    let step: f64 = account.travel.iter().sum();
    let way = |side: usize| Way {
        time: Real(account.time[side]),
        stroke: is_length.then(|| Real(stroke(accounts.phases(), side))),
        // Travel while the waveform rests counts with the forward stroke.
        travel: Real(account.travel[side] + if side == forth { account.travel[2] } else { 0.0 }),
    };
    let names: Vec<&str> = job.model.contacts().map(|(name, _)| name).collect();
    let contacts = account
        .contacts
        .iter()
        .filter_map(|it| Some(((*names.get(it.c)?).to_owned(), contact(it, account.time, forth))));
    let [forth_way, back_way] = [way(forth), way(1 - forth)];
    let foot = losses::foot(job, outcome, [&forth_way, &back_way]);
    let travel = foot.ok().map(|foot| foot.travel);
    Some(LastPeriod {
        from,
        to,
        step: Real(step),
        losses: Losses::of([step, error], stride.back_step(), travel),
        foot,
        forth: forth_way,
        back: back_way,
        work: work(account, load(job)),
        contacts: Parts(contacts.collect()),
    })
}

/// Smallest step, relative to the travel in both strokes, that makes the falling stroke the forward stroke if both strokes are equally
/// slow.
const STEP: f64 = 1e-3;

/// Returns the index of the forward (slower) stroke: 0 if it is the rising stroke, 1 if it is the falling stroke.
fn forth(account: &Account) -> usize {
    let [rising, falling] = account.time;
    if (rising - falling).abs() > 1e-3 * (rising + falling) {
        return usize::from(falling > rising);
    }
    // Without this threshold, rounding would decide if the step is 0.
    let step: f64 = account.travel.iter().sum();
    usize::from(step < -STEP * (account.travel[0].abs() + account.travel[1].abs()))
}

/// Returns the change of the waveform in a stroke.
fn stroke(phases: &Phases, side: usize) -> f64 {
    let [rise, fall] = phases.ways();
    if side == 0 { rise } else { -fall }
}

fn contact(it: &ContactAccount, time: [f64; 2], forth: usize) -> ContactPeriod {
    let share = |side: usize| (time[side] > 0.0).then(|| Real(it.slip[side] / time[side]));
    let swing = it.swing[forth];
    let still = swing > RINGING;
    ContactPeriod {
        slip_share_forward: share(forth),
        slip_share_return: share(1 - forth),
        reversals_forward: it.reversals[forth],
        settling: (!still).then(|| Real(it.rings[forth].unwrap_or(0.0))),
        ringing_left: Real(swing),
    }
}

fn work(account: &Account, load: Option<f64>) -> PeriodWork {
    let [input, kinetic, elastic, friction, damping] = account.energies;
    let step: f64 = account.travel.iter().sum();
    // A load in the direction of the step does work on the body, so the efficiency is absent.
    let load = load.map(|force| -force * step);
    let drive = load.map(|load| input + load);
    let efficiency = load.zip(drive).filter(|(load, drive)| *load > 0.0 && *drive > 0.0);
    PeriodWork {
        drive: drive.map(Real),
        load: load.map(Real),
        friction: Real(friction),
        damping: Real(damping),
        stored: Real(kinetic + elastic),
        efficiency: efficiency.map(|(load, drive)| Real(load / drive)),
    }
}

impl Outcome {
    /// Returns both reversals of the last oscillation of the tangential force of a contact in the forward stroke of the
    /// last whole period.
    #[must_use]
    pub fn last_swing(&self, contact: usize) -> Option<[Extreme; 2]> {
        let account = self.tally.accounts()?.last()?;
        account.contacts.iter().find(|it| it.c == contact)?.turns[forth(account)]
    }
}

/// Returns the constant force along x on the body named in `figures`, from loads and weight, N. Returns `None` if a
/// load on it varies or if another body is loaded.
pub fn load(job: &Job) -> Option<f64> {
    let (scene, b) = (&job.scenario.scene, job.scenario.figures.body?);
    let body = &scene.bodies.get(b)?.part;
    let (along, _) = scene.gravity.components();
    let mut force = -body.mass.unwrap_or(0.0) * along;
    for load in scene.loads.iter().filter(|load| load.on == b) {
        match load.x {
            Varying::Constant(constant) => force += constant,
            Varying::Follows(_) => return None,
        }
    }
    // The input contains the work of loads on other bodies, which cannot be separated.
    let elsewhere = scene.loads.iter().any(|load| load.on != b && load.x != Varying::Constant(0.0));
    (!elsewhere && !has_other_weight(scene, b)).then_some(force)
}

/// Returns whether another free body has a weight along x.
fn has_other_weight(scene: &Scene, b: usize) -> bool {
    let (along, _) = scene.gravity.components();
    let others = scene.bodies.iter().enumerate().filter(|(k, _)| *k != b);
    along != 0.0 && others.into_iter().any(|(_, body)| body.part.is_free())
}
