//! `stickslip fit`: fits parameters of a scenario to measured data.

use super::output::{Output, OutputFailure};
use crate::arguments::FitArguments;
use std::path::Path;
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_figures::fit as picture;
use stickslip_run::measured::{How, Measured, MeasuredError};
use stickslip_run::{Job, Real, Watcher, quantity};
use stickslip_study::fit::{Asked, Fit, FitError, fit as search};
use thiserror::Error;

/// Correlation above which two parameters are reported as strongly correlated.
const TOGETHER: f64 = 0.95;
/// Name of the file with the results.
const FIT: &str = "fit.json";

/// Error that stops the command.
#[derive(Debug, Error)]
enum FitFailure {
    /// The fit fails.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The files cannot be written.
    #[error(transparent)]
    Output(#[from] OutputFailure),
}

/// Fits parameters and writes the results.
pub(crate) fn fit(arguments: &FitArguments) -> Verdict {
    match answer(arguments) {
        Ok(()) => Verdict::Done,
        Err(failure) => {
            complain(format_args!("{failure}"));
            match failure {
                FitFailure::Fit(FitError::Interrupted) => Verdict::Interrupted,
                FitFailure::Fit(_) => Verdict::BadInput,
                FitFailure::Output(failure) => failure.verdict(),
            }
        }
    }
}

fn answer(arguments: &FitArguments) -> Result<(), FitFailure> {
    let job = Job::prepare(&arguments.file, &arguments.set, Path::new("")).map_err(FitError::from)?;
    let (recipe, [displacement, force]) =
        arguments.reading.meeting().map_err(MeasuredError::from).map_err(FitError::from)?;
    let mut measured = Measured::read(&arguments.data, &recipe).map_err(FitError::from)?;
    if !arguments.quiet {
        warn(&job);
        for note in &measured.notes {
            complain(format_args!("{}: note: {note}", arguments.data.display()));
        }
    }
    let asked = Asked {
        free: arguments.free.clone(),
        contact: arguments.contact.clone(),
        displacement,
        force,
        noise: arguments.noise,
        bootstrap: arguments.bootstrap,
    };
    let interrupt = Interrupt::install();
    let progress = Progress::new(!arguments.quiet && asked.bootstrap > 0);
    let bar = progress.budget(&job.name, asked.bootstrap as f64, &interrupt);
    let work = (arguments.threads.count(), &bar as &(dyn Watcher + Sync));
    let fit = search(&job, (&mut measured, &How::default()), &asked, work)?;
    drop(bar);
    let output = Output::ready(arguments.out.as_deref(), &format!("{}-fit", job.name))?;
    let out = output.path.clone();
    let pictures = picture::draw((&job, &fit), &arguments.look.look()).map_err(OutputFailure::from)?;
    let text = serde_json::to_string_pretty(&fit.json()).unwrap_or_default() + "\n";
    let names = output.write(
        picture::all_files().into_iter().chain([FIT.to_owned()]),
        Vec::new(),
        |mut folder, _| {
            folder.write(FIT, text.as_bytes())?;
            pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes))?;
            let names = folder.names();
            folder.publish()?;
            Ok(names)
        },
    )?;
    if arguments.json {
        say_json(&fit.json().to_string());
    } else if !arguments.quiet {
        tell(&fit);
        say(format_args!("{}: {}", out.display(), names.join(", ")));
    }
    Ok(())
}

fn tell(fit: &Fit) {
    let mut page = table::plain(["parameter", "start", "value", "standard deviation", "95 %", ""]);
    for fitted in &fit.parameters {
        // Two digits of the error, and as many decimal places of the value.
        let places = (1.0 - math::log10(fitted.sd.abs().max(f64::MIN_POSITIVE)).floor()).clamp(0.0, 12.0);
        let shown = |value: f64| match fitted.unit {
            "" => format!("{value:.*}", places as usize),
            unit => quantity(Real(value), unit),
        };
        let cells = [fitted.start, fitted.value, fitted.sd, fitted.low, fitted.high].map(shown);
        page.add_row([fitted.path.clone()].into_iter().chain(cells));
    }
    table::to_the_right(&mut page, 1..=5);
    say(format_args!("{page}"));
    for (i, row) in fit.correlations.iter().enumerate() {
        for (j, correlation) in row.iter().enumerate().take(i).filter(|(_, value)| value.abs() > TOGETHER) {
            let [a, b] = [i, j].map(|k| &fit.parameters[k].path);
            say(format_args!(
                "{a} and {b} are strongly correlated: the correlation of their errors is {correlation:.3}"
            ));
        }
    }
    let noise = quantity(Real(fit.noise), "N");
    let (chi, freedom) = (fit.chi_squared, fit.degrees_of_freedom);
    say(format_args!(
        "\u{3c7}\u{b2} = {chi:.1} with {freedom} degrees of freedom, noise {noise}, {} runs",
        fit.runs
    ));
    if !fit.model_fits {
        say(format_args!("the model does not fit: the residual is larger than the noise (fit.png)"));
    }
    say(format_args!("--set {}\n", fit.assignments().join(" --set ")));
}
