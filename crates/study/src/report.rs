//! Summary of a run, including the periodic orbit that the drive would approach.

use crate::steady::outlook;
use stickslip_drive::Wall;
use stickslip_run::outlook::Outlook;
use stickslip_run::summary::{Status, Summary};
use stickslip_run::{Job, Outcome};

/// Message of an interrupted search for the periodic orbit.
pub const GIVEN_UP: &str = "no periodic orbit: the search was interrupted";

/// Returns the content of `summary.json` without file names, and whether the search for a periodic orbit was interrupted.
///
/// `goes_on` is called before every period; `false` interrupts the search. Only complete runs are followed by a search. The search may use
/// the wall time that the run has left of its limit.
pub fn summary(job: &Job, outcome: &Outcome, goes_on: &dyn Fn() -> bool) -> (Summary, bool) {
    let mut summary = Summary::new(job, outcome);
    if summary.status != Status::Done {
        return (summary, false);
    }
    let limit = job.scenario.plan.limits.wall;
    let begun = Wall::begin(limit.is_some());
    let gave_up = std::cell::Cell::new(false);
    let asked = || {
        gave_up.set(!goes_on());
        !gave_up.get() && limit.is_none_or(|limit| outcome.wall + begun.elapsed() < limit)
    };
    summary.set_outlook(outlook(job, Some(outcome.state.counts()), &asked));
    if gave_up.get() {
        summary.set_outlook(Some(Outlook::NotFound { fault: GIVEN_UP.to_owned() }));
    }
    (summary, gave_up.get())
}
