//! Sentences that explain the length of a step.

use super::drivers::DriverSummary;
use super::losses::FootMotion;
use super::period::{ContactPeriod, LastPeriod, PeriodWork};
use crate::job::Job;
use crate::parts::Parts;
use stickslip_drive::facts::zero_step_stroke;
use stickslip_quantity::Real;
use stickslip_quantity::quantity;

/// A step below this fraction of the stroke counts as no step.
const NOTHING: f64 = 0.01;

/// Returns whether the body made no step in a period, or a step against the direction of the forward stroke.
pub(super) fn is_odd(last: &LastPeriod) -> bool {
    last.forth.stroke.is_some_and(|stroke| last.step.0 * stroke.0.signum() <= NOTHING * stroke.0.abs())
}

/// Returns the sentences that explain the step of a period.
pub(super) fn of(job: &Job, drivers: &Parts<DriverSummary>, last: &LastPeriod) -> Vec<String> {
    let mut lines = Vec::new();
    lines.extend(way(last));
    lines.extend(lost(last));
    lines.extend(drivers.0.iter().filter_map(|(name, driver)| driver.line(name)));
    lines.extend(last.contacts.0.iter().map(|(name, contact)| contact_line(name, contact)));
    lines.extend(short(job, last));
    lines.extend(work(&last.work));
    lines
}

fn length(value: f64) -> String {
    quantity(Real(value), "m")
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// Returns the sentence about stroke, motion of the body and step.
fn way(last: &LastPeriod) -> Option<String> {
    let stroke = last.forth.stroke?.0;
    let (step, fall) = (last.step.0 * stroke.signum(), last.losses.back_step_length.0);
    let stroke = stroke.abs();
    let forward = step.abs() + fall;
    let came = format!(
        "the body moved by {} in the direction of the step and by {} back",
        length(forward),
        length(fall)
    );
    let result = if step.abs() <= NOTHING * stroke {
        format!("the body made no step and moved by {} peak to peak", length(forward))
    } else if step < 0.0 {
        format!("{came}, which gives a step of {} opposite to the forward stroke", length(-step))
    } else {
        format!("{came}, which gives a step of {}, {} of the stroke", length(step), percent(step / stroke))
    };
    let times = |[forward, back]: [f64; 2]| {
        format!("in {} and back in {}", quantity(Real(forward), "s"), quantity(Real(back), "s"))
    };
    let command = format!("by {} {}", length(stroke), times([last.forth.time.0, last.back.time.0]));
    Some(match last.foot {
        Ok(FootMotion { travel, own_times: Some(own) }) => {
            let own = if last.forth.stroke?.0 > 0.0 { own } else { [own[1], own[0]] };
            let moved = format!("by {} {}", length(travel), times(own));
            format!("the stack moved the foot forward {moved} (commanded: {command}); {result}")
        }
        _ => format!("the drive was commanded to move forward {command}; {result}"),
    })
}

/// Returns the sentence about the lost stroke, or about the reason why it is unknown.
fn lost(last: &LastPeriod) -> Option<String> {
    last.forth.stroke?;
    Some(match (last.losses.lost_stroke, last.foot) {
        (Some(lost), _) if lost.0 < 0.0 => {
            format!("the step exceeds the travel of the foot by {}", length(-lost.0))
        }
        (Some(lost), _) => {
            format!("lost stroke: the step is {} shorter than the travel of the foot", length(lost.0))
        }
        (None, foot) => format!("lost stroke not computed: {}", foot.err()?),
    })
}

/// Returns the sentence about gross slip and ringing of a contact.
fn contact_line(name: &str, contact: &ContactPeriod) -> String {
    let share = |share: Option<Real>| share.map_or("0.0 %".to_owned(), |share| percent(share.0));
    let slip = format!(
        "{name}: gross slip lasts for {} of the forward stroke and for {} of the return stroke",
        share(contact.slip_share_forward),
        share(contact.slip_share_return)
    );
    let times = match contact.reversals_forward {
        1 => "the relative motion reverses once".to_owned(),
        times => format!("the relative motion reverses {times} times"),
    };
    let ringing = match contact.settling {
        _ if contact.reversals_forward == 0 => "the contact does not ring in the forward stroke".to_owned(),
        None => format!(
            "{times} in the forward stroke; at the end of the forward stroke, the tangential force still oscillates with an amplitude of \
             {} of μF_N, so the step length depends on the drive period",
            percent(contact.ringing_left.0)
        ),
        Some(settling) if settling.0 == 0.0 => {
            format!(
                "{times} in the forward stroke; the amplitude of the tangential force stays below 5 % of μF_N"
            )
        }
        Some(settling) => format!(
            "{times} in the forward stroke; the tangential force oscillates with an amplitude above 5 % of μF_N for {}",
            quantity(settling, "s")
        ),
    };
    format!("{slip}; {ringing}")
}

/// Returns a sentence if the stroke is below the zero-step stroke.
fn short(job: &Job, last: &LastPeriod) -> Option<String> {
    let stroke = last.forth.stroke?.0.abs();
    let laws = job.model.contacts().enumerate();
    let of_body = laws.filter(|(_, (name, _))| last.contacts.0.iter().any(|(own, _)| own == name));
    let idle = of_body.filter_map(|(c, (_, law))| {
        let natural = job.model.contact_natural(c)?;
        zero_step_stroke(law, natural.displacement / law.stick_slope(), 0.0)
    });
    let idle = idle.fold(f64::INFINITY, f64::min);
    (idle.is_finite() && stroke < idle).then(|| {
        format!(
            "the stroke of {} is below the zero-step stroke of {}; without ringing, partial slip takes up the whole stroke",
            length(stroke),
            length(idle)
        )
    })
}

/// Smallest fraction of the input work that is printed.
const UNSEEN: f64 = 5e-4;

/// Returns the sentence about the energy balance of the period.
fn work(work: &PeriodWork) -> Option<String> {
    let (drive, load) = (work.drive.filter(|drive| drive.0 > 0.0)?, work.load?);
    // A load in the direction of the step supplies work.
    let gave = Real((-load.0).max(0.0));
    let share = |part: Real| percent(part.0 / (drive.0 + gave.0));
    let load = if load.0 > 0.0 { format!("; the load received {}", share(load)) } else { String::new() };
    let gave = match gave.0 > UNSEEN * drive.0 {
        true => format!(", and the load supplied {}", quantity(gave, "J")),
        false => String::new(),
    };
    let friction = share(work.friction);
    Some(format!(
        "the drive supplied {} in the period{gave}; friction dissipated {friction} of the supplied energy; dampers dissipated {}{load}",
        quantity(drive, "J"),
        share(work.damping)
    ))
}
