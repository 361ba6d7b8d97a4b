//! The whole summary of a run: what was recorded of it, and what the drive would settle on.

use crate::steady::outlook;
use stickslip_drive::Wall;
use stickslip_run::outlook::Outlook;
use stickslip_run::summary::{Status, Summary};
use stickslip_run::{Job, Outcome};

/// Why there is no steady motion where somebody did not want to wait for it.
pub const GIVEN_UP: &str = "no steady motion: interrupted while it was looked for";

/// All that `summary.json` says of a run but its files, which are known once they are written; and whether the search for the steady
/// motion was given up, since `goes_on`, which is asked before every period, said so.
///
/// A run that did not come to its end has no such search. It takes what the run has left of its limit of wall time, and no more.
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
