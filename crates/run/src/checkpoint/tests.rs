//! A replayed journal gives a recorder the same results as the original run.

use super::error::CheckpointError;
use super::journal::{Journal, Mark};
use super::playback::{self, Told};
use crate::folder::Folder;
use crate::job::Job;
use crate::kept::Kept;
use crate::record::Recorder;
use std::fs;
use std::path::Path;
use stickslip_drive::{Due, Entry, Record};
use stickslip_scenario::PlotName;

/// A recorder that also writes a journal.
struct Both<'a> {
    journal: Journal,
    recorder: Recorder<'a>,
    rows: usize,
    /// Number of rows until a mark is made, and the mark.
    marked: (usize, Option<Mark>),
}

impl Record for Both<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        self.journal.take(entry);
        self.recorder.take(entry);
        if let Entry::Row(_) = entry {
            self.rows += 1;
            if self.rows == self.marked.0 {
                self.marked.1 = Some(self.journal.mark().unwrap());
            }
        }
    }

    fn next(&mut self, due: Due) -> Option<f64> {
        match due {
            Due::Look => self.recorder.next(due),
            Due::Mark => None,
        }
    }
}

/// A job of an example with all outputs.
fn job(name: &str, set: &[(&str, &str)], out: &Path) -> Job {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name);
    let set: Vec<_> = set.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
    let mut job = Job::prepare(&file, &set, out).unwrap();
    job.scenario.plots = PlotName::ALL.to_vec();
    job
}

fn recorder<'a>(job: &'a Job, folder: &Folder) -> Recorder<'a> {
    Recorder::new(job, &()).fingerprinted().with_tables(folder).unwrap()
}

/// Results of a recorder: contents of its tables, kept data, number of rows.
type Left = (Vec<(&'static str, Vec<u8>)>, Kept, u64);

fn left(recorder: Recorder<'_>) -> Left {
    let recorded = recorder.finish().unwrap();
    let tables = recorded.drafts.iter().map(|draft| (draft.name, fs::read(draft.file.path()).unwrap()));
    (tables.collect(), recorded.kept, recorded.rows)
}

/// The whole journal of a run with an unchanged end.
fn all(mark: Mark, reached: f64) -> Told {
    Told { mark, reached, same_end: true }
}

/// Runs a job with a journal. Returns the marks at its end and at a row, and the results of its recorder.
fn journalled(job: &Job, folder: &Folder, path: &Path, row: usize) -> (Mark, Option<Mark>, Left) {
    let journal = Journal::create(path).unwrap();
    let mut both = Both { journal, recorder: recorder(job, folder), rows: 0, marked: (row, None) };
    let mut state = job.start.clone();
    stickslip_drive::run(&job.model, &job.scenario.plan, &mut state, &mut both).unwrap();
    (both.journal.mark().unwrap(), both.marked.1, left(both.recorder))
}

const LOOKS: (&str, &str) = ("output.memory", r#"{"every": "0.4 ms"}"#);
const SPRINGS: (&str, &str) = ("output.springs", r#"{"every": "0.7 ms", "count": 9}"#);

#[test]
fn a_journal_told_to_a_fresh_recorder_makes_the_same_results() {
    let row_engine = ("contacts.ball.engine", r#"{"springs": {"count": 40}}"#);
    let cases: [(&str, &[(&str, &str)]); 4] = [
        ("p1.json", &[LOOKS, SPRINGS]),
        ("quickstart.json", &[SPRINGS, row_engine, ("run.duration", "10 ms")]),
        ("oblique_impact.json", &[]),
        ("three_ball_stage.json", &[("run.cycles", "2"), SPRINGS]),
    ];
    for (name, set) in cases {
        let root = tempfile::tempdir().unwrap();
        let (job, path) = (job(name, set, root.path()), root.path().join("journal"));
        let folder = Folder::make(&job.folder).unwrap();
        let (mark, _, (tables, kept, rows)) = journalled(&job, &folder, &path, 0);
        // Bytes after the mark are ignored.
        let more = [fs::read(&path).unwrap(), vec![0; 10_000]].concat();
        fs::write(&path, more).unwrap();
        playback::check(&path, &mark).unwrap();
        let mut again = recorder(&job, &folder);
        playback::tell(&path, all(mark, f64::MAX), &job, &mut again).unwrap();
        let (tables_again, kept_again, rows_again) = left(again);
        assert!(tables == tables_again, "{name}: tables");
        assert!(kept.series == kept_again.series && kept.tracks == kept_again.tracks, "{name}: series");
        assert_eq!((kept.fingerprint(), rows), (kept_again.fingerprint(), rows_again), "{name}");
    }
}

/// Only the journal up to the mark counts. The next snapshot that the recorder requests is that of the continued run.
#[test]
fn a_journal_counts_up_to_its_mark_and_goes_on_from_there() {
    let root = tempfile::tempdir().unwrap();
    let (job, path) = (job("p1.json", &[LOOKS], root.path()), root.path().join("journal"));
    let folder = Folder::make(&job.folder).unwrap();
    let (end, marked, _) = journalled(&job, &folder, &path, 1000);
    let whole = fs::read(&path).unwrap();
    let mark = marked.unwrap();
    assert!(mark.length < end.length && end.length == whole.len() as u64);
    let digest = playback::check(&path, &mark).unwrap();
    let mut again = recorder(&job, &folder);
    let reached = 999.0 * job.scenario.plan.every.unwrap();
    playback::tell(&path, all(mark, reached), &job, &mut again).unwrap();
    assert_eq!(again.next(Due::Look), Some(0.4e-3 * (reached / 0.4e-3).ceil()));
    assert_eq!(left(again).2, 1000);
    // The rest is truncated. Later records continue the digest.
    let mut journal = Journal::go_on(&path, mark.length, digest).unwrap();
    assert_eq!(journal.mark().unwrap(), mark);
    journal.take(Entry::Row(&[1.0, 2.0]));
    let longer = journal.mark().unwrap();
    assert_eq!(longer.length, mark.length + 17);
    playback::check(&path, &longer).unwrap();
    assert!(fs::read(&path).unwrap().starts_with(&whole[..mark.length as usize]));
}

#[test]
fn a_journal_that_was_cut_or_changed_is_refused() {
    let root = tempfile::tempdir().unwrap();
    let (job, path) = (job("p1.json", &[LOOKS], root.path()), root.path().join("journal"));
    let folder = Folder::make(&job.folder).unwrap();
    let (mark, ..) = journalled(&job, &folder, &path, 0);
    let whole = fs::read(&path).unwrap();
    fs::write(&path, &whole[..whole.len() - 1]).unwrap();
    assert!(matches!(playback::check(&path, &mark), Err(CheckpointError::Short { .. })));
    let mut changed = whole.clone();
    changed[whole.len() / 2] ^= 1;
    fs::write(&path, changed).unwrap();
    assert!(matches!(playback::check(&path, &mark), Err(CheckpointError::Journal(_))));
    fs::remove_file(&path).unwrap();
    assert!(matches!(playback::check(&path, &mark), Err(CheckpointError::Read { .. })));
}

/// Replaying an unchecked journal with arbitrary contents terminates.
#[test]
fn no_bytes_are_trouble() {
    let root = tempfile::tempdir().unwrap();
    let (job, path) = (job("p1.json", &[LOOKS], root.path()), root.path().join("journal"));
    let folder = Folder::make(&job.folder).unwrap();
    let (mark, ..) = journalled(&job, &folder, &path, 0);
    let whole = fs::read(&path).unwrap();
    for tag in 0..=3_u8 {
        for place in (0..2000).step_by(7) {
            let mut bytes = whole[place..place + 3000].to_vec();
            bytes[0] = tag;
            // The source is a contact. Other source names are looked up in the checked journal.
            bytes[1] = 0;
            fs::write(&path, &bytes).unwrap();
            let _ = playback::tell(
                &path,
                all(Mark { length: 3000, ..mark }, 0.0),
                &job,
                &mut recorder(&job, &folder),
            );
        }
    }
}
