//! The account of the last period of a drive.

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

/// The last whole period of the waveform of the figures. Forth is the way on which the waveform takes longer; of two that take
/// as long, the way of the step.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LastPeriod {
    /// start of the last whole period
    #[serde(rename = "from_s")]
    from: Real,
    /// its end
    #[serde(rename = "to_s")]
    to: Real,
    /// how far the body came in it
    #[serde(rename = "step_m")]
    pub(super) step: Real,
    /// What the step loses.
    #[serde(flatten)]
    pub(super) losses: Losses,
    /// How its foot moved, or why a step is not measured by that.
    #[serde(skip)]
    pub(super) foot: Result<FootMotion, &'static str>,
    /// While the waveform goes forward.
    #[serde(rename = "forward")]
    pub(super) forth: Way,
    /// While it returns.
    #[serde(rename = "return")]
    pub(super) back: Way,
    /// Where the work of the drive went.
    pub(super) work: PeriodWork,
    /// The contacts of the body.
    #[schemars(extend("x-name" = "CONTACT"))]
    pub(super) contacts: Parts<ContactPeriod>,
}

/// One way of the waveform.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Way {
    /// duration of this stroke of the waveform. `forward` is its slower stroke, of two as slow that of the step, or without a step
    /// the rising one; `return` is the other
    #[serde(rename = "time_s")]
    pub(super) time: Real,
    /// travel of the waveform in it, with its sign
    #[serde(rename = "stroke_m", skip_serializing_if = "Option::is_none")]
    pub(super) stroke: Option<Real>,
    /// travel of the body in it; what the waveform rests counts with the forward stroke
    #[serde(rename = "travel_m")]
    pub(super) travel: Real,
}

/// Work of a period: drive = load + friction + damping + stored, but for the errors of integration.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PeriodWork {
    /// what the drive put in: growth of energy.input_J, plus load_J; left out where a load varies
    #[serde(rename = "drive_J", skip_serializing_if = "Option::is_none")]
    pub(super) drive: Option<Real>,
    /// -F·step, work against the constant loads and the weight of the body, F their force along x
    #[serde(rename = "load_J", skip_serializing_if = "Option::is_none")]
    pub(super) load: Option<Real>,
    /// work of friction
    #[serde(rename = "friction_J")]
    pub(super) friction: Real,
    /// work of dampers
    #[serde(rename = "damping_J")]
    pub(super) damping: Real,
    /// growth of kinetic and stored energy
    #[serde(rename = "stored_J")]
    stored: Real,
    /// load_J / drive_J, where both are above 0
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) efficiency: Option<Real>,
}

/// What a contact of the body did.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ContactPeriod {
    /// share of the forward stroke in which the whole contact slips
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) slip_share_forward: Option<Real>,
    /// the same of the return stroke
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) slip_share_return: Option<Real>,
    /// number of reversals of u on the forward stroke, in full stick, too; out of gross slip they do not count
    pub(super) reversals_forward: u32,
    /// from the beginning of the forward stroke until the force's last swing beyond 5 % of the limit of friction; left out where it
    /// swings on
    #[serde(rename = "settling_s", skip_serializing_if = "Option::is_none")]
    pub(super) settling: Option<Real>,
    /// last swing of the force on the forward stroke, half of peak to peak, over the limit of friction, the mean of that at both
    /// turns of u
    pub(super) ringing_left: Real,
}

/// The last period, with the stride that the body made in it; none of a run without one. A step below `error`, m, is none.
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
        // What it goes while the waveform rests is of the way that led there: forth.
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

/// Of two ways as slow the rising one is forth where the step is less than this share of what the body goes on both, or leads that way.
const STEP: f64 = 1e-3;

/// Which of two ways is forth.
fn forth(account: &Account) -> usize {
    let [rising, falling] = account.time;
    if (rising - falling).abs() > 1e-3 * (rising + falling) {
        return usize::from(falling > rising);
    }
    // Without a step rounding would say which.
    let step: f64 = account.travel.iter().sum();
    usize::from(step < -STEP * (account.travel[0].abs() + account.travel[1].abs()))
}

/// How far a waveform goes on one of its ways.
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
    // A load that pulls along does work on the body: it is no load then.
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
    /// The last swing of a contact's force while the waveform of the figures went forth in its last whole period: both of its turns.
    #[must_use]
    pub fn last_swing(&self, contact: usize) -> Option<[Extreme; 2]> {
        let account = self.tally.accounts()?.last()?;
        account.contacts.iter().find(|it| it.c == contact)?.turns[forth(account)]
    }
}

/// Constant force along x on the body of the figures, its loads and its weight, N; none where a load on it varies, or where others
/// bear one.
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
    // Another body's load is put in with the drive: it cannot be told from it either.
    let elsewhere = scene.loads.iter().any(|load| load.on != b && load.x != Varying::Constant(0.0));
    (!elsewhere && !has_other_weight(scene, b)).then_some(force)
}

/// Whether another free body has a weight along x.
fn has_other_weight(scene: &Scene, b: usize) -> bool {
    let (along, _) = scene.gravity.components();
    let others = scene.bodies.iter().enumerate().filter(|(k, _)| *k != b);
    along != 0.0 && others.into_iter().any(|(_, body)| body.part.is_free())
}
