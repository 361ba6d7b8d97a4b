//! How loops in real time end, and which do not begin. No time on the wall is asserted but that something ends at all.

use crate::program::{code, listing, scenario, stderr, stdout, stickslip};
use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::net::UdpSocket;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::tempdir;

/// Longest that anything is waited for: a machine may be busy.
const PATIENCE: Duration = Duration::from_secs(120);

/// The stage that a controller moves.
fn stage() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/realtime/stage.json")
}

fn call(file: &Path, period: &str, out: &Path) -> Command {
    let mut command = stickslip();
    command.arg("realtime").arg(file).args(["--period", period]).arg("--out").arg(out);
    command
}

fn report(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("realtime.json")).unwrap()).unwrap()
}

fn free_port() -> u16 {
    UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port()
}

fn waits_until(what: &str, is_so: impl Fn() -> bool) {
    let begun = Instant::now();
    while !is_so() {
        assert!(begun.elapsed() < PATIENCE, "{what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// The end of a child, which must come.
fn end_of(mut child: Child, what: &str) -> Output {
    let begun = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begun.elapsed() > PATIENCE {
            child.kill().unwrap();
            panic!("{what}: it goes on");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().unwrap()
}

#[test]
fn a_step_that_makes_too_many_steps_a_frame_is_refused_before_the_start() {
    let out = tempdir().unwrap();
    let step = |step: &str, more: &[&str]| {
        let mut command = call(&scenario("p1"), "100 ms", out.path());
        command
            .args(["--for", "100 ms", "--floor", "0", "--force", "--stepper", step])
            .args(more)
            .output()
            .unwrap()
    };
    for more in [&["--unpaced"][..], &[]] {
        let output = step("rk4:0.999 us", more);
        assert_eq!((code(&output), stdout(&output), listing(out.path()).len()), (2, String::new(), 0));
        let told = "--stepper rk4:0.999 us: time steps of 999.0 ns give 100101 time steps per frame of 100.0 ms, expected at most 100000\n   \
                    help: a step of 1.000 µs or more, or a period of 99.90 ms or less\n";
        assert_eq!(stderr(&output), told);
    }
    let output = step("verlet:0.1 ns", &["--unpaced"]);
    assert!(stderr(&output).contains("give 1000000000 time steps per frame"), "{}", stderr(&output));
    // As many as are allowed.
    let output = step("verlet:1 us", &["--unpaced"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(report(&out.path().join("p1"))["frames"], 1);
}

/// A loop that gets a signal: what is asked for, and how it is known that the moment has come.
#[cfg(unix)]
struct Told<'a> {
    what: &'a str,
    file: PathBuf,
    arguments: &'a [&'a str],
    period: &'a str,
    signal: &'a str,
    /// It has told where it stands.
    heard: Option<&'a UdpSocket>,
}

#[cfg(unix)]
impl Told<'_> {
    /// Ends it, before its first frame is whole.
    fn ends(&self) {
        let out = tempdir().unwrap();
        let mut command = call(&self.file, self.period, out.path());
        command.args(self.arguments).stdout(Stdio::null()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut said = BufReader::new(child.stderr.take().unwrap());
        let mut line = String::new();
        while !line.contains("outputs: ") {
            line.clear();
            assert!(said.read_line(&mut line).unwrap() > 0, "{}: it does not begin", self.what);
        }
        if let Some(heard) = self.heard {
            heard.set_read_timeout(Some(PATIENCE)).unwrap();
            heard.recv(&mut [0; 2000]).unwrap();
        }
        let signal = [self.signal, &child.id().to_string()];
        assert!(Command::new("kill").args(signal).status().unwrap().success());
        let output = end_of(child, self.what);
        let mut rest = String::new();
        said.read_to_string(&mut rest).unwrap();
        assert_eq!(code(&output), 130, "{}: {rest}", self.what);
        let report = report(&out.path().join(self.file.file_stem().unwrap()));
        assert_eq!(
            (&report["ended"], &report["frames"]),
            (&"interrupted".into(), &0.into()),
            "{}",
            self.what
        );
    }
}

/// Without it each would go on for an hour, or for as long as a frame of minutes takes.
#[cfg(unix)]
#[test]
fn one_signal_ends_a_loop_wherever_it_is() {
    let heard = UdpSocket::bind("127.0.0.1:0").unwrap();
    let inputs = format!("udp:127.0.0.1:{}", free_port());
    let outputs = format!("udp:{}", heard.local_addr().unwrap());
    let rows = "contacts.ball.engine={\"springs\":{\"count\":100000}}";
    let long = [
        "--for",
        "60 min",
        "--unpaced",
        "--force",
        "--stepper",
        "rk4:1 us",
        "--set",
        rows,
        "--set",
        "plots=[]",
    ];
    let waiting =
        ["--for", "60 min", "--floor", "0", "--wait", "60 min", "--inputs", &inputs, "--outputs", &outputs];
    let told =
        |what, file, arguments, period| Told { what, file, arguments, period, signal: "-TERM", heard: None };
    let p1 = || scenario("p1");
    told("within a frame", p1(), &long, "100 ms").ends();
    Told { signal: "-INT", ..told("within a frame", p1(), &long, "100 ms") }.ends();
    told("in the empty loop", p1(), &["--for", "60 min", "--floor", "60 min"], "1 ms").ends();
    told("before a long frame", p1(), &["--for", "60 min", "--floor", "0"], "1 s").ends();
    Told { heard: Some(&heard), ..told("waiting for an input", stage(), &waiting, "1 ms") }.ends();
}

/// A pipe that nobody writes to would be waited for, and no signal would end that.
#[cfg(unix)]
#[test]
fn a_recording_that_is_a_pipe_is_refused() {
    let out = tempdir().unwrap();
    let pipe = out.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let mut command = call(&stage(), "1 ms", &out.path().join("out"));
    command.arg(format!("--inputs=replay:{}", pipe.display()));
    let output = end_of(command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap(), "a pipe");
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("pipe: not a recording of inputs"), "{}", stderr(&output));
}

#[test]
fn an_address_beyond_this_machine_is_warned_of() {
    let out = tempdir().unwrap();
    let warnings = |arguments: &[&str]| {
        let mut command = call(&stage(), "1 ms", out.path());
        let output =
            command.args(["--for", "2 ms", "--floor", "0", "--wait", "0"]).args(arguments).output().unwrap();
        let said = stderr(&output);
        (
            code(&output),
            said.lines().filter(|line| line.starts_with("warning:")).map(str::to_owned).collect::<Vec<_>>(),
        )
    };
    let at = |ip: &str| format!("udp:{ip}:{}", free_port());
    assert_eq!(warnings(&["--inputs", &at("127.0.0.1")]), (0, Vec::new()));
    let (code, told) = warnings(&["--inputs", &at("0.0.0.0")]);
    assert!(
        code == 0 && told.len() == 1 && told[0].starts_with("warning: --inputs udp:0.0.0.0:"),
        "{told:?}"
    );
    assert!(told[0].contains("other machines on the network can reach this port"), "{told:?}");
    // Nothing is sent there: what is replayed is not there.
    let nothing = format!("replay:{}", out.path().join("nothing").display());
    let (code, told) =
        warnings(&["--inputs", &nothing, "--outputs", "udp:192.0.2.1:9", "--outputs", &at("127.0.0.9")]);
    assert!(code == 2 && told.len() == 1, "{told:?}");
    assert!(
        told[0].starts_with("warning: --outputs udp:192.0.2.1:9: outputs are sent to the network"),
        "{told:?}"
    );
}

/// The system would end the process (SIGBUS).
#[cfg(target_os = "linux")]
#[test]
fn shared_memory_that_another_process_cuts_ends_the_loop_with_a_sentence() {
    for (k, (length, more)) in
        [(0, &["--wait", "0"][..]), (0, &["--wait", "60 min"]), (100, &["--wait", "0", "-q"])]
            .iter()
            .enumerate()
    {
        let out = tempdir().unwrap();
        let memory = out.path().join("memory");
        let name = format!("shm:{}", memory.display());
        let mut command = call(&stage(), "1 ms", out.path());
        command.args(["--for", "60 min", "--floor", "0", "--inputs", &name, "--outputs", &name]).args(*more);
        let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // A record of outputs is whole once somebody has told where the drive stands.
        let word = |bytes: &[u8], at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
        waits_until("the loop does not begin", || {
            fs::read(&memory)
                .is_ok_and(|bytes| bytes.len() > 64 && word(&bytes, word(&bytes, 40) as usize) >= 2)
        });
        fs::OpenOptions::new().write(true).open(&memory).unwrap().set_len(*length).unwrap();
        let output = end_of(child, "the memory was cut");
        assert_eq!(code(&output), 3, "{k}: {}", stderr(&output));
        let told = "another process truncated the shared memory";
        assert!(stderr(&output).contains(told), "{k}: {}", stderr(&output));
        let report = report(&out.path().join("stage"));
        assert!(report["ended"] == "memory" && report["error"].as_str().unwrap().contains(told), "{report}");
    }
}
