//! Runs one job and writes its files.

use super::pace::Paced;
use super::report::Report;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_figures::{Look, Sources};
use stickslip_run::checkpoint::{CheckpointError, Keeper, Resumption};
use stickslip_run::complaint::words;
use stickslip_run::files::{CYCLES, EVENTS, INSIDES, InsideTables, PULSES, SCENARIO, STEPS, SUMMARY, TRACE};
use stickslip_run::folder::{Folder, is_complete, sweep};
use stickslip_run::summary::Status;
use stickslip_run::{Draft, Job, Outcome, Recorder, Summary, Watcher};

/// Disk space reserved for the summary in addition to the scenario, bytes.
const RESERVE: usize = 1 << 16;

/// Returns the disk space needed for the last files, without plots.
fn reserve(job: &Job) -> usize {
    RESERVE + 8 * job.resolved.len()
}

/// Settings for runs and plots.
pub(crate) struct Conduct<'a> {
    pub(crate) look: &'a Look,
    pub(crate) interrupt: &'a Interrupt,
    pub(crate) progress: &'a Progress,
    /// Whether runs keep step with wall time.
    pub(crate) realtime: bool,
}

/// Kind of start of a run.
pub(crate) enum Beginning {
    /// From the initial state.
    Plain,
    /// From the initial state, with checkpoints at this interval of wall time, s.
    Checkpoints(f64),
    /// From a checkpoint, with further checkpoints; at this interval of wall time, s, if given.
    Resumed(Box<Resumption>, Option<f64>),
}

/// Runs a job and writes its results, even if the run stops early.
pub(crate) fn run(
    job: &Job,
    beginning: Beginning,
    Conduct { look, interrupt, progress, realtime }: &Conduct<'_>,
) -> Report {
    let mut folder = match Folder::make(&job.folder) {
        Ok(folder) => folder,
        Err(error) => return Report::no_folder(job, &error),
    };
    if let Err(error) = folder.reserve(reserve(job)) {
        return Report::not_written(job, &error);
    }
    // An interrupted run may have left temporary files.
    let names = [TRACE, EVENTS, CYCLES, STEPS, PULSES, SCENARIO, SUMMARY]
        .into_iter()
        .chain(INSIDES)
        .map(str::to_owned);
    sweep(&job.folder, &names.chain(Look::all_files()).collect::<Vec<_>>());
    let from = if let Beginning::Resumed(resumption, _) = &beginning { resumption.reached() } else { 0.0 };
    let bar = progress.start(&job.name, [from, job.scenario.plan.duration], interrupt);
    let paced = realtime.then(|| Paced::new(&bar, from));
    let watcher: &dyn Watcher = paced.as_ref().map_or(&bar, |paced| paced);
    let recorder = Recorder::new(job, watcher);
    let recorder = if job.scenario.plots.is_empty() { recorder } else { recorder.fingerprinted() };
    let goes_on = || !interrupt.is_raised();
    let report = recorder.with_tables(&folder).and_then(|mut recorder| {
        let keeper = match beginning {
            Beginning::Plain => None,
            Beginning::Checkpoints(every) => Some(Keeper::begin(job, every)?),
            Beginning::Resumed(resumption, every) => match resumption.tell(job, every, &mut recorder) {
                Ok(keeper) => Some(keeper),
                Err(CheckpointError::Write { source, .. }) => return Err(source),
                Err(error) => return Ok(Report::refused(&error)),
            },
        };
        let Some(keeper) = keeper else {
            folder.forget_checkpoint();
            let (outcome, drafts) = job.run_recorded(recorder)?;
            return write(job, (look, &goes_on), folder, (&outcome, drafts));
        };
        let (outcome, drafts) = job.run_kept(recorder, keeper)?;
        Ok(write(job, (look, &goes_on), folder, (&outcome, drafts))?.resumable(job, &outcome))
    });
    let report = report.unwrap_or_else(|error| Report::not_written(job, &error));
    report.with_pace(paced.map(|paced| paced.words()))
}

/// Writes all files except tables and gives them their names. `goes_on` is called during the search for the periodic orbit.
pub(crate) fn write(
    job: &Job,
    (look, goes_on): (&Look, &dyn Fn() -> bool),
    mut folder: Folder,
    (outcome, drafts): (&Outcome, Vec<Draft>),
) -> io::Result<Report> {
    let (mut summary, gave_up) = stickslip_study::summary(job, outcome, goes_on);
    summary.set_tables(drafts.iter().map(|draft| (draft.name.to_owned(), draft.seal.clone())).collect());
    drafts.into_iter().try_for_each(|draft| folder.stage(draft.name, draft.file))?;
    if summary.status == Status::Interrupted && is_complete(&job.folder) {
        folder.divert(&aside(&job.folder))?;
    }
    let place = folder.path().to_owned();
    if outcome.failure.is_some() {
        folder.release();
    }
    folder.write(SCENARIO, job.resolved.as_bytes())?;
    let undrawn = if outcome.failure.is_none() {
        draw(job, look, &mut folder, (outcome, &mut summary))
    } else {
        summary.note("no plots were drawn, because the results could not be written completely".to_owned());
        None
    };
    folder.release();
    let optional = INSIDES.into_iter().chain([CYCLES, STEPS, PULSES]).map(str::to_owned);
    folder.forget(optional.chain(Look::all_files()).collect());
    let names = folder.names().into_iter().chain([SUMMARY.to_owned()]).collect();
    summary.set_files(names);
    folder.write(SUMMARY, summary.pretty()?.as_bytes())?;
    folder.publish()?;
    let report = Report::ended(job, (outcome, &summary), &place)?.without_pictures(job, undrawn);
    Ok(if gave_up { report.without_outlook(job) } else { report })
}

/// Returns the folder of an interrupted run if complete results exist: NAME.interrupted, or NAME.interrupted-2 etc. if it is in use.
fn aside(folder: &Path) -> PathBuf {
    let name = |k: u32| {
        let mut name = folder.to_owned().into_os_string();
        name.push(if k == 1 { ".interrupted".to_owned() } else { format!(".interrupted-{k}") });
        PathBuf::from(name)
    };
    let is_free = |path: &PathBuf| match path.symlink_metadata() {
        Ok(found) => found.is_dir() && !is_complete(path),
        Err(_) => true,
    };
    (1..1000).map(name).find(is_free).unwrap_or_else(|| name(1000))
}

/// Draws the plots. Returns the first write error, which does not affect other results.
fn draw(
    job: &Job,
    look: &Look,
    folder: &mut Folder,
    (outcome, summary): (&Outcome, &mut Summary),
) -> Option<io::Error> {
    let sources = Sources { job, kept: &outcome.kept, insides: InsideTables::drafted(folder) };
    let mut failure = None;
    for pictures in stickslip_figures::draw(&sources, look) {
        match pictures {
            Ok(pictures) => {
                for (name, bytes) in pictures {
                    if let Err(error) = folder.write(&name, &bytes) {
                        summary.note(format!("{name} could not be written: {}", words(&error)));
                        failure.get_or_insert(error);
                    }
                }
            }
            Err(error) => summary.note(error.to_string()),
        }
    }
    failure
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_console::verdict::Verdict;
    use stickslip_study::report::GIVEN_UP;

    #[test]
    fn a_steady_motion_that_nobody_waits_for_is_told() {
        let root = tempfile::tempdir().unwrap();
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/p1.json");
        let set = [("plots", "[]"), ("figures.steady_motion", "true")];
        let set = set.map(|(path, value)| (path.to_owned(), value.to_owned()));
        let job = Job::prepare(&file, &set, root.path()).unwrap();
        let look = Look::default();
        let written = |goes_on: &dyn Fn() -> bool| {
            let folder = Folder::make(&job.folder).unwrap();
            let recorder = Recorder::new(&job, &()).with_tables(&folder).unwrap();
            let (outcome, drafts) = job.run_recorded(recorder).unwrap();
            let report = write(&job, (&look, goes_on), folder, (&outcome, drafts)).unwrap();
            (report, std::fs::read_to_string(job.folder.join(SUMMARY)).unwrap())
        };
        let (report, summary) = written(&|| true);
        assert!(report.verdict == Verdict::Done && report.error.is_empty() && !summary.contains(GIVEN_UP));
        let (report, summary) = written(&|| false);
        assert_eq!(report.verdict, Verdict::Interrupted);
        assert!(
            report.error.contains("interrupted during the search for the periodic orbit"),
            "{}",
            report.error
        );
        assert!(summary.contains(GIVEN_UP) && summary.contains(r#""status": "done""#));
    }
}
