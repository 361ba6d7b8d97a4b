//! Warnings about a run or its scenario, printed on stderr and stored in the `warnings` of `summary.json`.
//!
//! [`Summary::new`](crate::Summary::new) collects the warnings of all modules, and the program prints them. With `--strict`, a run with
//! warnings counts as failed.

use crate::job::Job;
use crate::outcome::Outcome;
use crate::summary::flight;
use stickslip_drive::Stepper;
use stickslip_drive::scene::{Contact, Named};
use stickslip_measure::plausibility::multiplied;
use stickslip_measure::{Warning, books};
use stickslip_quantity::Real;
use stickslip_quantity::quantity;

/// Maximum number of contacts that a warning names.
const MOST: usize = 3;

/// Returns the warnings that the command `check` prints.
pub fn of_check(job: &Job) -> Vec<Warning> {
    job.warnings().iter().map(Warning::of_odd).collect()
}

/// Returns the warnings about the scenario of a job, sorted by key.
///
/// Warnings about the text of the file are omitted. Therefore a resumed run, which reads the resolved scenario, has the same warnings.
pub fn of_scenario(job: &Job) -> Vec<Warning> {
    let odd = job.warnings();
    let told = odd.iter().filter(|odd| odd.kind != stickslip_scenario::Warning::WORDING);
    let mut warnings: Vec<Warning> = told.map(Warning::of_odd).collect();
    warnings.sort_by(|a, b| (&a.path, a.kind, &a.message).cmp(&(&b.path, b.kind, &b.message)));
    warnings
}

/// Returns the rounding error of the initial positions, relative to the smallest natural displacement scale of a contact.
fn finest(job: &Job) -> f64 {
    let places = job.scenario.scene.bodies.iter().map(|body| body.part.x.position.abs());
    let contacts = 0..job.scenario.scene.contacts.len();
    let natural = contacts.filter_map(|c| job.model.contact_natural(c)).map(|scale| scale.displacement);
    let least = natural.filter(|length| *length > 0.0).fold(f64::INFINITY, f64::min);
    f64::EPSILON * places.fold(0.0, f64::max) / least
}

/// Returns the warnings about the run itself: energy balance, unknown errors, and motions beyond the validity of the model.
pub(crate) fn of_run(job: &Job, outcome: &Outcome) -> Vec<Warning> {
    let asked = job.scenario.plan.stepper;
    let stepper = job.model.effective(asked);
    let is_asked = stepper.name() == asked.name();
    let of_books = books::warning(&outcome.books, stepper, is_asked, finest(job));
    let mut warnings: Vec<Warning> = of_books.into_iter().collect();
    let missed = outcome.state.counts().missed;
    if missed > 0 {
        let all = outcome.state.counts().steps;
        let message = format!(
            "{missed} of {all} time steps exceed their tolerance: a contact breaks loose where events accumulate, and shorter time \
             steps have no effect"
        );
        warnings.push(
            Warning::new("error_estimate", message)
                .help("run the scenario again at another tolerance, and compare the results"),
        );
    }
    warnings.extend(impacts(job, outcome));
    if let Some(since) = flight(job, outcome) {
        let since = quantity(Real(since), "s");
        let message = format!(
            "the body whose steps are computed has had no contact since t = {since}, for at least one period: all contacts of the body \
             are open, so the displacement in a period is not a step"
        );
        let help = "press the body against its contacts by gravity, a spring or a load along z; check whether the initial position along z is too high or too low";
        warnings.push(Warning::new("flight", message).help(help));
    }
    warnings.extend(outcome.tally.excursions().warnings(job));
    warnings
}

/// Returns a warning if contacts between free bodies opened in a run with the stepper `frames`.
fn impacts(job: &Job, outcome: &Outcome) -> Option<Warning> {
    let Stepper::Frames { accuracy, .. } = job.model.effective(job.scenario.plan.stepper) else {
        return None;
    };
    let contacts = job.scenario.scene.contacts.iter().enumerate().filter(|(c, _)| job.is_pressed_freely(*c));
    let open = |(c, contact): (usize, &Named<Contact>)| {
        let share = outcome.tally.contact(c)?.open_share().filter(|share| *share > 0.0)?;
        Some(format!("{} was open for {:.2} % of the time", contact.name, 100.0 * share))
    };
    let parted: Vec<String> = contacts.filter_map(open).take(MOST).collect();
    let message = format!("{}: {}", parted.join(", "), multiplied(accuracy));
    let help = "run the scenario again with a smaller value of accuracy or with the stepper event, and compare the results";
    (!parted.is_empty()).then(|| Warning::new("frames_under_impacts", message).help(help))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_warning_is_words_for_people_and_a_kind_for_machines() {
        let warning = Warning::new("energy_balance", "20 % are missing").help("shorter steps");
        assert_eq!(warning.to_string(), "20 % are missing\n   help: shorter steps");
        let json = serde_json::to_string(&warning).unwrap();
        assert_eq!(json, r#"{"kind":"energy_balance","message":"20 % are missing","help":"shorter steps"}"#);
    }
}
