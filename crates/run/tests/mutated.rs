//! Results from unknown sources: randomly changed tables and summaries give a comparison or an error, quickly and with limited memory.
//!
//! The gate runs a part. `STICKSLIP_MUTATIONS=100000 cargo test -p stickslip-run --test mutated -- --nocapture` runs all. The test is a
//! separate binary, because it measures the peak memory of its process.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking, as the tests do")]

use serde_json::{Value, json};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use stickslip_compare::{self, Comparison, Terms};
use stickslip_run::folder::Folder;
use stickslip_run::{Job, Recorder, Results, Summary, curves, hash, springs};
use stickslip_scenario::PlotName;

/// Default number of mutations.
const MUTATIONS: u64 = 500;
/// Maximum time for a folder, with a margin for busy machines.
const HANG: Duration = Duration::from_secs(5);
/// Maximum memory of the test, bytes.
const MOST_MEMORY: u64 = 500 << 20;

const FILES: [&str; 5] = ["trace.csv", "events.csv", "springs.csv", "memory.csv", "summary.json"];

/// Byte sequences that are inserted into files.
const PIECES: [&[u8]; 26] = [
    b",",
    b"\n",
    b"\r\n",
    b"\"",
    b"\"\"",
    b"NaN",
    b"inf",
    b"-",
    b"1e999",
    b"-1e308",
    b"0",
    b"1e-320",
    b"\0",
    b"\x1b[2J",
    b"\xff\xfe",
    b"slip",
    b"ball",
    b"{",
    b"}",
    b"[",
    b"]",
    b"null",
    b"time_s",
    b":",
    b"999999999999999999999",
    b" ",
];

/// Pseudo-random numbers from a seed (Knuth's linear congruential generator).
struct Draw(u64);

impl Draw {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % end.max(1)
    }

    fn piece(&mut self) -> Vec<u8> {
        match self.below(40) {
            0 => b"x".repeat(1 << self.below(22)),
            1 => b"0,".repeat(1 << self.below(18)),
            2 => b"[".repeat(1 << self.below(18)),
            _ => PIECES[self.below(PIECES.len())].to_vec(),
        }
    }
}

/// Changes bytes, lines or cells of a file.
fn edited(mut bytes: Vec<u8>, draw: &mut Draw) -> Vec<u8> {
    let (at, length) = (draw.below(bytes.len() + 1), draw.below(24));
    let end = (at + length).min(bytes.len());
    match draw.below(9) {
        0 => drop(bytes.drain(at..end)),
        1 => drop(bytes.splice(at..at, draw.piece())),
        2 => drop(bytes.splice(at..end, draw.piece())),
        3 => bytes.truncate(at),
        4 => {
            let part = bytes[at..end].to_vec();
            drop(bytes.splice(at..at, part.repeat(1 + draw.below(30))));
        }
        _ => return edited_lines(&bytes, draw),
    }
    bytes
}

fn edited_lines(bytes: &[u8], draw: &mut Draw) -> Vec<u8> {
    let mut lines: Vec<Vec<u8>> = bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
    if lines.is_empty() {
        return Vec::new();
    }
    let (first, second) = (draw.below(lines.len()), draw.below(lines.len()));
    match draw.below(6) {
        0 => drop(lines.remove(first)),
        1 => lines.insert(first, lines[second].clone()),
        2 => lines.swap(first, second),
        3 => lines.truncate(first + 1),
        4 => lines[first.min(second)..=first.max(second)].reverse(),
        _ => {
            // Another cell is copied.
            let line = &mut lines[first];
            let commas: Vec<usize> = (0..line.len()).filter(|&i| line[i] == b',').collect();
            if let Some(&start) = commas.get(draw.below(commas.len())) {
                let end = commas.iter().find(|&&comma| comma > start).copied().unwrap_or(line.len() - 1);
                drop(line.splice((start + 1).min(end)..end, draw.piece()));
            }
        }
    }
    lines.concat()
}

/// Replaces a value in a summary.
fn edited_tree(bytes: &[u8], draw: &mut Draw) -> Option<Vec<u8>> {
    let mut tree: Value = serde_json::from_slice(bytes).ok()?;
    let mut here = &mut tree;
    loop {
        let count = here.as_object().map(|o| o.len()).or(here.as_array().map(Vec::len)).unwrap_or(0);
        if count == 0 || draw.below(4) == 0 {
            break;
        }
        let place = draw.below(count);
        here = match here {
            Value::Object(entries) => entries.iter_mut().nth(place)?.1,
            Value::Array(entries) => entries.get_mut(place)?,
            _ => break,
        };
    }
    let values = [
        json!(null),
        json!(-1),
        json!(1e308),
        json!("x"),
        json!([]),
        json!({}),
        json!(true),
        json!(0.02),
        json!([[1]]),
    ];
    *here = values[draw.below(values.len())].clone();
    Some(tree.to_string().into_bytes())
}

/// Adapts the summary to the tables.
fn forge(folder: &Path, draw: &mut Draw) {
    let Ok(Some(mut summary)) =
        fs::read(folder.join("summary.json")).map(|bytes| serde_json::from_slice::<Value>(&bytes).ok())
    else {
        return;
    };
    for name in &FILES[..4] {
        let bytes = fs::read(folder.join(name)).unwrap();
        let rows = bytes.iter().filter(|byte| **byte == b'\n').count().saturating_sub(1);
        let seal = json!({ "rows": rows, "sha256": hash(&String::from_utf8_lossy(&bytes)) });
        if let Some(place) = summary.pointer_mut(&format!("/tables/{name}")) {
            *place = seal;
        }
        let count = if *name == "trace.csv" { "/counts/rows" } else { "/counts/events" };
        if let Some(place) = summary.pointer_mut(count).filter(|_| !name.starts_with(['s', 'm'])) {
            *place = json!(rows);
        }
    }
    if draw.below(4) == 0 && summary.is_object() {
        summary[["excerpt", "cut"][draw.below(2)]] = json!(true);
    }
    fs::write(folder.join("summary.json"), summary.to_string()).unwrap();
}

/// Writes results with all tables to a folder.
fn results(root: &Path) -> PathBuf {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/p1.json");
    let set = [
        ("run.cycles", "2"),
        ("output.every", "40 us"),
        ("output.springs", r#"{"count": 5, "every": "0.5 ms"}"#),
        ("output.memory", r#"{"every": "0.5 ms"}"#),
        ("plots", r#"["loop"]"#),
    ];
    let set = set.map(|(path, value)| (path.to_owned(), value.to_owned()));
    let job = Job::prepare(&file, &set, root).unwrap();
    let mut folder = Folder::make(&job.folder).unwrap();
    let (outcome, drafts) = job.run_recorded(Recorder::new(&job, &()).with_tables(&folder).unwrap()).unwrap();
    let mut summary = Summary::new(&job, &outcome);
    summary.set_tables(drafts.iter().map(|draft| (draft.name.to_owned(), draft.seal.clone())).collect());
    drafts.into_iter().for_each(|draft| folder.stage(draft.name, draft.file).unwrap());
    folder.write("scenario.json", job.resolved.as_bytes()).unwrap();
    folder.write("summary.json", summary.pretty().unwrap().as_bytes()).unwrap();
    folder.publish().unwrap();
    job.folder
}

/// Reads a folder by all readers. Returns whether all comparing readers have rejected it.
fn read(folder: &Path, original: &stickslip_compare::Results) -> bool {
    let drawn = Results::read(folder, &[PlotName::Events]).map(|results| {
        let _ = (springs::read(&results.insides.springs), curves::read(&results.insides.memory, 100));
    });
    let compared = stickslip_compare::Results::read(folder).map(|results| {
        let _ = Comparison::new(original, &results, &Terms::default());
        Comparison::new(&results, original, &Terms::default()).is_ok()
    });
    // Error messages are printed on a terminal.
    let said =
        [drawn.as_ref().err().map(ToString::to_string), compared.as_ref().err().map(ToString::to_string)];
    said.iter().flatten().for_each(|said| assert!(said.len() < 10_000, "{said:.200}"));
    drawn.is_err() && compared.is_err()
}

/// Returns the peak memory of the process, bytes, if the system reports it.
fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix(" kB")?.parse::<u64>().ok()? << 10)
}

#[test]
#[allow(clippy::print_stdout, reason = "the numbers of a longer test")]
fn mutated_results_are_read_or_refused_at_once() {
    let count = std::env::var("STICKSLIP_MUTATIONS").map_or(MUTATIONS, |count| count.parse().unwrap());
    let root = tempfile::tempdir().unwrap();
    let (whole, folder) = (results(&root.path().join("a")), root.path().join("b"));
    let original = stickslip_compare::Results::read(&whole).unwrap();
    fs::create_dir(&folder).unwrap();
    let bytes = FILES.map(|name| fs::read(whole.join(name)).unwrap());
    fs::copy(whole.join("scenario.json"), folder.join("scenario.json")).unwrap();
    let (begun, mut longest, mut refused) = (Instant::now(), Duration::ZERO, 0);
    // At first all files are missing.
    let mut changed: Vec<usize> = (0..FILES.len()).collect();
    for seed in 0..count {
        let mut draw = Draw(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        for (name, bytes) in changed.drain(..).map(|place: usize| (FILES[place], &bytes[place])) {
            fs::write(folder.join(name), bytes).unwrap();
        }
        for _ in 0..=draw.below(3) {
            let place = draw.below(FILES.len());
            let name = FILES[place];
            changed.push(place);
            let old = fs::read(folder.join(name)).unwrap();
            let tree = if name == "summary.json" && draw.below(2) == 0 {
                edited_tree(&old, &mut draw)
            } else {
                None
            };
            fs::write(folder.join(name), tree.unwrap_or_else(|| edited(old, &mut draw))).unwrap();
        }
        if draw.below(3) > 0 {
            changed.push(FILES.len() - 1);
            forge(&folder, &mut draw);
        }
        let now = Instant::now();
        let answer = catch_unwind(AssertUnwindSafe(|| read(&folder, &original)));
        assert!(answer.is_ok(), "seed {seed} panics");
        assert!(now.elapsed() < HANG, "seed {seed} takes {:?}", now.elapsed());
        longest = longest.max(now.elapsed());
        refused += u64::from(answer.is_ok_and(|refused| refused));
    }
    let memory = peak();
    println!(
        "{count} mutated results in {:?}, the longest {longest:?}; {refused} refused; {memory:?} bytes",
        begun.elapsed()
    );
    assert!(memory.is_none_or(|memory| memory < MOST_MEMORY), "{memory:?} bytes");
    assert!(refused > count / 3, "only {refused} of {count} were refused");
}
