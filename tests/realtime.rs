//! Drives after a clock. No time on the wall is asserted; what is sent goes over 127.0.0.1 and shared memory.

use crate::program::{code, listing, number, run, scenario, stderr, stdout, stickslip, summary};
use serde_json::Value;
use std::fs;
use std::io::Write;
use std::net::UdpSocket;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use tempfile::tempdir;

/// The stage that a controller moves.
fn stage() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/realtime/stage.json")
}

/// A call for a file with frames of 100 µs.
fn realtime(file: &Path, out: &Path) -> Command {
    let mut command = stickslip();
    command.arg("realtime").arg(file).args(["--period", "100 us", "--floor", "0"]).arg("--out").arg(out);
    command
}

fn report(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("realtime.json")).unwrap()).unwrap()
}

/// A port of 127.0.0.1 that nobody has, for the moment.
fn free_port() -> u16 {
    UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port()
}

#[test]
fn a_loop_leaves_its_report() {
    let out = tempdir().unwrap();
    let log = out.path().join("log.csv");
    let mut command = realtime(&scenario("p1"), out.path());
    let output =
        command.args(["--for", "0.2 s", "--stepper", "event:1e-6", "--log"]).arg(&log).output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let folder = out.path().join("p1");
    let files = ["frames.csv", "histogram.csv", "realtime.json", "realtime.png", "timeline.png"];
    assert_eq!(listing(&folder), files);
    let report = report(&folder);
    let count = |key: &str| report.pointer(key).and_then(Value::as_u64).unwrap();
    assert_eq!(
        (count("/frames"), &report["ended"], &report["paced"]),
        (2000, &"complete".into(), &true.into())
    );
    assert_eq!(report["kept"], count("/overruns") == 0);
    // An independent count.
    let log = fs::read_to_string(log).unwrap();
    let rows: Vec<Vec<u64>> =
        log.lines().skip(1).map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len() as u64 + count("/log_lost"), 2000);
    assert_eq!(rows.iter().filter(|row| row[1] + row[2] > 100_000).count() as u64, count("/overruns"));
    let histogram = fs::read_to_string(folder.join("histogram.csv")).unwrap();
    let counts =
        histogram.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse::<u64>().unwrap());
    assert_eq!(counts.sum::<u64>(), 2000);
    let said = stdout(&output);
    for words in [
        "2000 frames of 100 µs",
        "execution: median",
        "wake-up latency",
        "without a real-time kernel",
        "springs",
    ] {
        assert!(said.contains(words), "{words} in {said}");
    }
    assert!(stderr(&output).contains("scenario number"), "{}", stderr(&output));
}

/// Inputs come when they like; recorded and fed again without a clock they make the same outputs.
#[test]
fn what_a_clock_and_a_client_made_comes_again_without_either() {
    let out = tempdir().unwrap();
    let at = |name: &str| out.path().join(name);
    let mut command = realtime(&stage(), out.path());
    command
        .args(["--for", "0.3 s", "--inputs", "stdin", "--wait", "60 s", "--record-inputs"])
        .arg(at("a.rec"));
    let mut child = command.arg(format!("--outputs=file:{}", at("a.bin").display())).spawn_fed();
    let mut lines = child.stdin.take().unwrap();
    // Until the reader has gone, for the loop is over: how long it measures itself before is its own affair.
    for k in 0..12_000 {
        let line = format!("{:e}, 1000, {}, -1", 1e-9 * f64::from(k * k % 300), 1 - 2 * (k % 2));
        if writeln!(lines, "{line}\nnot a number").is_err() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    drop(lines);
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let first = report(&at("stage"));
    let good = first.pointer("/received/good").and_then(Value::as_u64).unwrap();
    assert!(
        good > 1 && first.pointer("/received/wrong_length").and_then(Value::as_u64).unwrap() > 0,
        "{first}"
    );
    let mut command = realtime(&stage(), out.path());
    command.args(["--unpaced", &format!("--inputs=replay:{}", at("a.rec").display())]);
    let output = command.arg(format!("--outputs=file:{}", at("b.bin").display())).output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let second = report(&at("stage"));
    assert_eq!((&second["frames"], &second["paced"]), (&3000.into(), &false.into()));
    let traces = ["a.bin", "b.bin"].map(|name| fs::read(at(name)).unwrap());
    assert!(traces[0].len() > 3000 * 40 && traces[0] == traces[1]);
    // Longer than the recording is no replay.
    let mut command = realtime(&stage(), out.path());
    command.args(["--unpaced", "--for", "1 s", &format!("--inputs=replay:{}", at("a.rec").display())]);
    let output = command.output().unwrap();
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("the recording has 3000 frames, 10000 are needed"),
        "{}",
        stderr(&output)
    );
}

/// A child that is fed.
trait Fed {
    fn spawn_fed(&mut self) -> Child;
}

impl Fed for Command {
    fn spawn_fed(&mut self) -> Child {
        self.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
    }
}

fn refused(arguments: &[&str], file: &Path) -> String {
    let out = tempdir().unwrap();
    let output = realtime(file, out.path()).args(arguments).output().unwrap();
    assert_eq!(code(&output), 2, "{arguments:?}: {}", stderr(&output));
    assert!(listing(out.path()).is_empty(), "{arguments:?}: {:?}", listing(out.path()));
    stderr(&output)
}

#[test]
fn what_cannot_be_is_refused_and_says_why() {
    let taken = UdpSocket::bind("127.0.0.1:0").unwrap();
    let in_use = format!("udp:{}", taken.local_addr().unwrap());
    let never = format!("udp:127.0.0.1:{}", free_port());
    let foreign = tempdir().unwrap();
    fs::write(foreign.path().join("a.rec"), "1,2,3").unwrap();
    let folder = foreign.path().display().to_string();
    let (log, foreign) = (format!("{folder}/log.csv"), format!("replay:{folder}/a.rec"));
    let (once, twice) = (format!("--outputs=file:{log}"), format!("--outputs=file:{folder}/./log.csv"));
    let cases: [(&[&str], &str); 15] = [
        (&["--log", &folder], "is a directory"),
        (&[&once, &twice], "two options name this file"),
        (&[&once, "--log", &log], "two options name this file"),
        (&["--channels", "stage.y_m"], "there is no channel \"stage.y_m\"; channels: time_s, "),
        (&["--channels", "stage.x_m,stage.x_m"], "twice"),
        (&["--inputs", &in_use], "ddress already in use"),
        (
            &["--inputs", &never, "--wait", "50 ms"],
            "no valid input arrived within 0.05 s; nothing was computed",
        ),
        (&["--inputs", "udp:nowhere"], "expected HOST:PORT"),
        (&["--inputs", &foreign], "not a recording of inputs"),
        (&["--outputs", "udp"], "the destination is not known"),
        (&["--inputs", "shm:one", "--outputs", "shm:two"], "give the same name for both"),
        (&["--stepper", "euler"], "expected frames"),
        (&["--stepper", "rk4:0"], "--stepper rk4:0: expected "),
        (&["--for", "10 us"], "expected a time of 1 to"),
        (&["--period", "1 ns"], "used multiple times"),
    ];
    for (arguments, words) in cases {
        let said = refused(arguments, &stage());
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
    let said = refused(&["--inputs", &never], &scenario("p1"));
    assert!(said.contains("--inputs: the scenario has no waveform of kind"), "{said}");
    let said = refused(&["--record-inputs", &log], &scenario("p1"));
    assert!(said.contains("--record-inputs: the scenario has no waveform of kind"), "{said}");
}

#[test]
fn a_period_below_what_the_machine_can_do_is_told_before_the_start() {
    let out = tempdir().unwrap();
    let call = |force: &[&str]| {
        let mut command = stickslip();
        command
            .arg("realtime")
            .arg(scenario("p1"))
            .args(["--period", "1 ns", "--for", "1 us", "--floor", "0"]);
        command.args(["--stepper", "event"]).args(force).arg("--out").arg(out.path()).output().unwrap()
    };
    let output = call(&[]);
    assert_eq!((code(&output), listing(out.path()).len()), (2, 0));
    assert!(stderr(&output).contains("this machine cannot keep 0.001 µs"), "{}", stderr(&output));
    let output: Output = call(&["--force"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let report = report(&out.path().join("p1"));
    assert_eq!((&report["frames"], &report["kept"]), (&1000.into(), &false.into()));
    assert!(stdout(&output).contains("not kept"), "{}", stdout(&output));
    // The same with an end at the first overrun.
    let output = call(&["--force", "--overrun", "stop"]);
    assert_eq!(code(&output), 3, "{}", stderr(&output));
}

/// Frames are as exact as the scenario's own, also where they are asked for by name.
#[test]
fn frames_by_name_have_the_accuracy_of_the_scenario() {
    let out = tempdir().unwrap();
    let own = r#"run.stepper={"frames": {"length": "20 us", "accuracy": 1e-6}}"#;
    for (asked, told) in [("frames", "accuracy 1e-6"), ("frames:1e-4", "accuracy 1e-4")] {
        let mut command = realtime(&scenario("p1"), out.path());
        command.args(["--for", "10 ms", "--force", "--set", own, "--stepper", asked]);
        let output = command.output().unwrap();
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let report = report(&out.path().join("p1"));
        assert!(report["stepper"].as_str().unwrap().contains(told), "{asked}: {report}");
    }
}

/// Inputs are heard at 127.0.0.1, outputs go elsewhere, and not from where inputs come in.
#[test]
#[allow(clippy::print_stdout, reason = "says what was not done")]
fn outputs_to_an_address_go_there_from_a_port_of_their_own() {
    let (out, inputs) = (tempdir().unwrap(), format!("127.0.0.1:{}", free_port()));
    for at in ["127.0.0.1:0", "[::1]:0"] {
        let Ok(heard) = UdpSocket::bind(at) else {
            println!("not to {at}: this machine has none");
            continue;
        };
        let mut command = realtime(&stage(), out.path());
        command.args(["--for", "2 ms", "--wait", "0", "--inputs", &format!("udp:{inputs}")]);
        let output = command.arg(format!("--outputs=udp:{}", heard.local_addr().unwrap())).output().unwrap();
        assert_eq!(code(&output), 0, "{at}: {}", stderr(&output));
        assert_eq!(report(&out.path().join("stage"))["outputs_unsent"], 0);
        heard.set_read_timeout(Some(std::time::Duration::from_secs(10))).unwrap();
        let (length, from) = heard.recv_from(&mut [0; 2000]).unwrap();
        assert!(length > 32 && from.to_string() != inputs, "{from}");
    }
}

#[test]
fn a_favour_that_is_not_granted_is_told_and_done_without() {
    let out = tempdir().unwrap();
    let output =
        realtime(&scenario("p1"), out.path()).args(["--for", "10 ms", "--cpu", "4000"]).output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).contains("staying on processor 4000 (--cpu)"), "{}", stdout(&output));
    assert_eq!(report(&out.path().join("p1"))["denied"].as_array().unwrap().len(), 1);
    // Nor does silence hide it.
    let quiet = ["--for", "10 ms", "--cpu", "4000", "-q"];
    let output = realtime(&scenario("p1"), out.path()).args(quiet).output().unwrap();
    assert_eq!((code(&output), stdout(&output)), (0, String::new()));
    assert!(stderr(&output).contains("staying on processor 4000 (--cpu)"), "{}", stderr(&output));
}

/// Frames of a contact that an input presses have no bound, also where they are the command's and not the scenario's.
#[test]
fn frames_under_a_normal_from_outside_are_warned_of() {
    let folder = tempdir().unwrap();
    let text = fs::read_to_string(scenario("quickstart")).unwrap();
    let text = text.replace(
        "\"waveforms\": {",
        "\"waveforms\": { \"press\": { \"input\": { \"initial\": \"0.3 N\", \"range\": [\"0.2 N\", \"0.4 N\"] } },",
    );
    let text = text.replace("{ \"force\": \"0.3 N\" }", "{ \"force\": { \"follows\": \"press\" } }");
    let file = folder.path().join("pressed.json");
    fs::write(&file, text).unwrap();
    let check = |set: &[&str]| stderr(&stickslip().arg("check").arg(&file).args(set).output().unwrap());
    let said = check(&["--set", "run.stepper.frames.length=20 us"]);
    assert!(
        said.contains("contacts.ball.normal.force: an input sets the normal load of this contact"),
        "{said}"
    );
    assert!(!check(&[]).contains("an input sets the normal load"), "{}", check(&[]));
    let output = realtime(&file, folder.path()).args(["--for", "10 ms", "--unpaced"]).output().unwrap();
    assert_eq!(
        stderr(&output).matches("an input sets the normal load of this contact").count(),
        1,
        "{}",
        stderr(&output)
    );
}

/// Frames lost 2 % of a stroke at any accuracy, and said nothing.
#[test]
fn frames_on_damped_springs_under_a_moving_normal_are_warned_of() {
    let folder = tempdir().unwrap();
    let text = fs::read_to_string(scenario("quickstart")).unwrap();
    let press = "\"waveforms\": { \"press\": { \"sine\": { \"amplitude\": \"0.1 N\", \"offset\": \"0.3 N\", \"frequency\": \"100 Hz\" } },";
    let text = text.replace("\"waveforms\": {", press);
    let text = text.replace("{ \"force\": \"0.3 N\" }", "{ \"force\": { \"follows\": \"press\" } }");
    let file = folder.path().join("pressed.json");
    fs::write(&file, text).unwrap();
    let check = |set: &[&str]| {
        let set = set.iter().flat_map(|set| ["--set", set]);
        stderr(&stickslip().arg("check").arg(&file).args(set).output().unwrap())
    };
    let (frames, damped) = ("run.stepper.frames.length=20 us", "contacts.ball.damping=0.1 ms");
    let words = "contacts.ball.damping: springs of this contact are damped, under a varying normal load";
    assert!(check(&[frames, damped]).contains(words), "{}", check(&[frames, damped]));
    for quiet in [&[frames][..], &[damped], &[frames, "contacts.ball.damping=1 ns"]] {
        assert!(!check(quiet).contains("under a varying normal load"), "{}", check(quiet));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_loop_leaves_what_it_has_come_to() {
    let out = tempdir().unwrap();
    let file = out.path().join("trace.bin");
    let mut command = realtime(&scenario("p1"), out.path());
    let outputs = format!("--outputs=file:{}", file.display());
    let child = command.args(["--for", "60 min", "--stepper", "event:1e-6", &outputs]).spawn_fed();
    // The draft of the trace grows as soon as frames are computed.
    let drawn = || {
        let entries = fs::read_dir(out.path()).unwrap().flatten();
        entries
            .filter_map(|entry| entry.metadata().ok())
            .any(|found| found.is_file() && found.len() > 100_000)
    };
    for _ in 0..6000 {
        if drawn() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    let report = report(&out.path().join("p1"));
    let frames = report["frames"].as_u64().unwrap();
    assert_eq!(report["ended"], "interrupted");
    let packet = 32 + 8 * report["outputs"].as_array().unwrap().len() as u64;
    let (length, lost) = (fs::metadata(file).unwrap().len(), report["outputs_unsent"].as_u64().unwrap());
    assert_eq!(length, packet * (frames - lost));
}

/// A client of the documentation: how it is called; none where what it needs is not there.
#[cfg(target_os = "linux")]
fn clients(folder: &Path) -> Vec<Vec<PathBuf>> {
    let mut clients = Vec::new();
    if Command::new("python3").arg("--version").output().is_ok() {
        clients.push(vec!["python3".into(), stage().with_file_name("client.py")]);
    }
    let program = folder.join("client");
    let mut compiler = Command::new("cc");
    compiler.args(["-O2", "-Wall", "-Wextra", "-Werror", "-o"]).arg(&program);
    // Only where there is no compiler at all it is left out.
    if let Ok(output) = compiler.arg(stage().with_file_name("client.c")).arg("-lm").output() {
        assert!(output.status.success(), "{}", stderr(&output));
        clients.push(vec![program]);
    }
    clients
}

/// The clients of the documentation, over UDP and shared memory; Python and a C compiler are wherever this is developed.
#[cfg(target_os = "linux")]
#[test]
#[allow(clippy::print_stdout, reason = "says what was not done")]
fn the_documented_clients_close_the_loop() {
    let folder = tempdir().unwrap();
    let clients = clients(folder.path());
    println!("{} of 2 clients", clients.len());
    clients.iter().for_each(|client| closes_the_loop(client));
}

#[cfg(target_os = "linux")]
fn closes_the_loop(client: &[PathBuf]) {
    let ports = [free_port(), free_port()].map(|port| port.to_string());
    let name = format!("stickslip-test-{}", std::process::id());
    let udp = (
        ["udp", "127.0.0.1", &ports[0], &ports[1]].to_vec(),
        [&ports[0], &ports[1]].map(|p| format!("udp:127.0.0.1:{p}")),
    );
    let memory = (["shm", &name].to_vec(), [(), ()].map(|()| format!("shm:{name}")));
    for (arguments, [inputs, outputs]) in [udp, memory] {
        let out = tempdir().unwrap();
        let controller = Command::new(&client[0]).args(&client[1..]).args(&arguments).spawn_fed();
        let mut command = realtime(&stage(), out.path());
        command.args(["--for", "0.4 s", "--channels", "stage.x_m", "--notes", "target.x_m,error_m"]);
        let output =
            command.args(["--wait", "60 s", "--inputs", &inputs, "--outputs", &outputs]).output().unwrap();
        let controller = controller.wait_with_output().unwrap();
        assert_eq!(code(&output), 0, "{inputs}: {}", stderr(&output));
        assert_eq!(code(&controller), 0, "{inputs}: {}", stderr(&controller));
        let report = report(&out.path().join("stage"));
        let count = |key: &str| report["received"][key].as_u64().unwrap();
        assert!(count("good") > 10 && count("owners") == 1, "{inputs}: {report}");
        let refused =
            ["wrong_length", "foreign", "other_scenario", "out_of_order", "out_of_range", "other_client"];
        assert!(refused.iter().all(|key| count(key) == 0), "{inputs}: {report}");
        assert!(stdout(&controller).contains("nm rms"), "{}", stdout(&controller));
        let inputs = report["inputs"].as_array().unwrap();
        assert_eq!((inputs.len(), &inputs[0]), (6, &"drive.stroke".into()), "{report}");
    }
}

#[test]
fn a_run_that_keeps_step_with_the_clock_has_the_same_results() {
    let out = tempdir().unwrap();
    let folders = [false, true].map(|paced| {
        let folder = out.path().join(if paced { "paced" } else { "plain" });
        let set = ["run.cycles=20", "plots=[]", r#"run.stepper={"event": {"tolerance": 1e-6}}"#];
        let output = if paced {
            let mut command = stickslip();
            command.args(["run", "--realtime"]).arg(scenario("p1")).arg("--out").arg(&folder);
            for set in set {
                command.args(["--set", set]);
            }
            command.output().unwrap()
        } else {
            run(&scenario("p1"), &folder, &set)
        };
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert_eq!(stdout(&output).contains("real time was "), paced, "{}", stdout(&output));
        folder.join("p1")
    });
    for name in ["trace.csv", "events.csv", "scenario.json"] {
        let [plain, paced] = folders.each_ref().map(|folder| fs::read(folder.join(name)).unwrap());
        assert!(plain == paced, "{name}");
    }
    // Sleeps are never too short: 20 ms of the drive take 20 ms, at least.
    let wall = number(&summary(&folders[1]), "/timing/wall_s");
    assert!(wall >= 0.02, "{wall}");
}
