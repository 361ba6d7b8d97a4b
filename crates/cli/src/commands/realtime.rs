//! `stickslip realtime`: runs a drive in real time.

mod failure;
mod files;
mod stage;
mod stepper;
mod wires;

use crate::arguments::RealtimeArguments;
use crate::arguments::realtime::Inputs;
use failure::Failure;
use files::Drafts;
use stage::Stage;
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::interrupt::{Interrupt, Interrupted};
use stickslip_console::progress::Progress;
use stickslip_console::verdict::Verdict;
use stickslip_realtime::Report;
use stickslip_realtime::pace::Stop;
use stickslip_realtime::report::{Subject, text};
use stickslip_realtime::session::{self, Ended};
use stickslip_run::Job;
use wires::Wires;

/// Runs a drive in real time.
pub(crate) fn realtime(arguments: &RealtimeArguments) -> Verdict {
    match run(arguments) {
        Ok(verdict) => verdict,
        Err(failure) => {
            complain(format_args!("{failure}"));
            failure.verdict()
        }
    }
}

fn run(arguments: &RealtimeArguments) -> Result<Verdict, Failure> {
    let (interrupt, progress) = (Interrupt::install(), Progress::new(!arguments.quiet));
    let job = Job::prepare(&arguments.file, &arguments.set, &arguments.out)?;
    let stage = Stage::new(arguments, &job)?;
    if !arguments.quiet {
        warn(&job);
        stage.warnings().iter().for_each(|odd| complain(format_args!("warning: {odd}")));
        wires::exposed(&arguments.wires).iter().for_each(|odd| complain(format_args!("warning: {odd}")));
        if cfg!(debug_assertions) {
            complain(format_args!(
                "this program was built without --release: its times do not apply to a release build"
            ));
        }
        complain(format_args!("{}", stage.introduction()));
    }
    let replayed = match &arguments.wires.inputs {
        Some(Inputs::Replay(path)) => Some(path.as_path()),
        _ => None,
    };
    // Check the output folder before the loop starts, because the run cannot be repeated.
    let folder = files::ready(&stage)?;
    let mut drafts = Drafts::beside(std::iter::once(arguments.file.as_path()).chain(replayed), &job.folder);
    let Wires { wiring, mut reels, recorded } = wires::open(&stage, &mut drafts)?;
    let order = stage.order(recorded)?;
    let asked = Interrupted(&interrupt);
    let (probe, rows) = stage.measure(!arguments.quiet, &asked)?;
    let mut drive = stage.drive(&asked)?;
    let mut outputs = vec![0.0; stage.outputs.len()];
    drive.tell(&mut outputs);
    let bar = progress.start(&job.name, [0.0, order.frames as f64 * order.pace.period], &interrupt);
    let ended = session::run(&mut drive, wiring, &outputs, &order, &mut reels, &bar);
    drop(bar);
    if ended.waited_in_vain {
        let refused = ended.wiring.intake.received().refused();
        let refused = refused.map_or_else(String::new, |refused| format!(" (refused: {refused})"));
        return Err(Failure::NoInput { wait: order.wait, refused });
    }
    let names = |names: Vec<&String>| names.into_iter().cloned().collect();
    let subject = Subject {
        scenario: job.name.clone(),
        number: stage.number,
        stepper: stage.stepper(),
        inputs: names(stage.inputs.iter().map(|input| &input.name).collect()),
        outputs: names(stage.outputs.iter().map(|output| &output.name).collect()),
        probe,
        rows,
    };
    let report = Report::new(subject, &order.pace, order.frames, &ended);
    let unwritten = reels.iter().find_map(|reel| reel.failure().map(ToString::to_string));
    drop(reels);
    // Write both, even if one fails.
    let (written, kept) = (files::write(folder, &stage, &report, &ended), drafts.keep());
    tell(arguments, &report, &ended, written.as_deref().ok())?;
    written?;
    if let Some(words) = unwritten {
        return Err(Failure::Cut(words));
    }
    kept.map(|()| verdict(&ended))
}

/// Prints the report, even if it could not be `written`.
fn tell(
    arguments: &RealtimeArguments,
    report: &Report,
    ended: &Ended,
    written: Option<&str>,
) -> Result<(), Failure> {
    // Refused requests to the operating system are reported even without a printed report.
    if arguments.quiet || arguments.json {
        ended.denied.iter().for_each(|denied| complain(format_args!("{denied}")));
    }
    report.error.iter().for_each(|error| complain(format_args!("{}: stopped: {error}", report.scenario)));
    if arguments.json {
        say_json(&report.line()?);
    } else if !arguments.quiet {
        let written = written.map(|written| format!("\n  {written}")).unwrap_or_default();
        say(format_args!("{}{written}", text(report, ended.timing.slowest.frames().first())));
    }
    Ok(())
}

/// Returns the exit status of the loop.
fn verdict(ended: &Ended) -> Verdict {
    match ended.outcome {
        Ok(()) => Verdict::Done,
        Err(Stop::Interrupted) => Verdict::Interrupted,
        Err(Stop::Overrun | Stop::Silence | Stop::Cut(_) | Stop::Plant(_)) => Verdict::Stopped,
    }
}
