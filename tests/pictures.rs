//! Pictures drawn again from results on disk.

use crate::program::{code, listing, reseal, run, run_example, scenario, stderr, stdout, stickslip};
use std::path::{Path, PathBuf};
use std::process::Output;
use tempfile::tempdir;

/// `stickslip plot` of a folder.
fn plot(folder: &Path, options: &[&str]) -> Output {
    stickslip().arg("plot").arg(folder).args(options).output().unwrap()
}

/// Pictures in a folder.
fn pictures(folder: &Path) -> Vec<String> {
    let is_picture = |name: &String| name.ends_with(".png") || name.ends_with(".svg");
    listing(folder).into_iter().filter(is_picture).collect()
}

/// All pictures, with few springs.
const ALL: [&str; 2] = [
    r#"plots=["layout", "loop", "trajectory", "energy", "phase", "events", "state", "memory"]"#,
    "output.springs.count=40",
];

#[test]
fn plot_draws_what_run_drew_to_the_bit() {
    let verlet = "run.stepper={\"verlet\":{\"step\":\"1 us\"}}";
    let cases: [(&str, &[&str]); 5] = [
        // Corners, jumps and rows at the same moments.
        ("p1", &["run.cycles=3", "output.every=0.1 ms", "waveforms.drive.sawtooth.flyback=0"]),
        ("piezo_stack", &["title=", "run.limits.steps=3000", verlet, "output.memory.every=20 us"]),
        ("oblique_loading", &[]),
        ("rocking_slider", &["run.cycles=2"]),
        ("fretting_sphere", &["run.duration=1 s", "output.every=20 ms"]),
    ];
    for (name, set) in cases {
        let (out, again) = (tempdir().unwrap(), tempdir().unwrap());
        let ran = run(&scenario(name), out.path(), &[set, &ALL].concat());
        assert!([0, 3].contains(&code(&ran)), "{name}: {}", stderr(&ran));
        let folder = out.path().join(name);
        let drawn = plot(&folder, &["--out", again.path().to_str().unwrap()]);
        assert_eq!((code(&drawn), stderr(&drawn)), (0, String::new()), "{name} {set:?}");
        let again = again.path().join(name);
        assert_eq!((pictures(&folder).len(), pictures(&folder)), (8, pictures(&again)));
        for picture in pictures(&folder) {
            let [first, second] = [&folder, &again].map(|f| std::fs::read(f.join(&picture)).unwrap());
            assert!(first == second, "{name} {set:?}: {picture}");
        }
    }
}

#[test]
fn pictures_come_in_the_forms_asked_for_beside_the_others() {
    let out = tempdir().unwrap();
    let folder = run_example("quickstart", out.path(), &["run.duration=20 ms", "plots=[\"loop\"]"]);
    let drawn = plot(&folder, &["--plots", "trajectory,loop", "--format", "svg,png", "--scale", "2"]);
    assert_eq!(code(&drawn), 0, "{}", stderr(&drawn));
    let names = ["loop.png", "loop@2x.png", "loop@2x.svg", "trajectory@2x.png", "trajectory@2x.svg"];
    assert_eq!(pictures(&folder), names);
    assert!(
        stdout(&drawn)
            .ends_with("quickstart: loop@2x.svg, loop@2x.png, trajectory@2x.svg, trajectory@2x.png\n")
    );
    let svg = std::fs::read_to_string(folder.join("loop@2x.svg")).unwrap();
    assert!(svg.contains("width=\"3200\""));
    let png = std::fs::read(folder.join("loop@2x.png")).unwrap();
    // Width in the header chunk.
    assert_eq!(png[16..20], 3200_u32.to_be_bytes());
    let dark = plot(&folder, &["--plots", "loop", "--theme", "dark"]);
    assert!(stdout(&dark).ends_with("quickstart: loop-dark.png\n"), "{}", stderr(&dark));
    assert!(
        std::fs::read(folder.join("loop.png")).unwrap()
            != std::fs::read(folder.join("loop-dark.png")).unwrap()
    );
    let [light, dark] = ["loop.png", "loop-dark.png"].map(|name| std::fs::read(folder.join(name)).unwrap());
    let both = plot(&folder, &["--plots", "loop", "--theme", "light,dark,light"]);
    assert!(stdout(&both).ends_with("quickstart: loop.png, loop-dark.png\n"), "{}", stderr(&both));
    assert!(std::fs::read(folder.join("loop.png")).unwrap() == light);
    assert!(std::fs::read(folder.join("loop-dark.png")).unwrap() == dark);
    // Another run takes all pictures of this one away.
    run_example("quickstart", out.path(), &["run.duration=20 ms", "plots=[\"trajectory\"]"]);
    assert_eq!(pictures(&folder), ["trajectory.png"]);
}

/// Of twelve periods the last one is shown enlarged beside the motion and below the events; of five periods with little ringing it is not.
#[test]
fn the_last_period_of_a_long_run_is_enlarged() {
    for (cycles, periods) in [(5, 0), (12, 1)] {
        let out = tempdir().unwrap();
        let set = [format!("run.cycles={cycles}"), r#"plots=["trajectory", "events", "energy"]"#.to_owned()];
        let set = set.iter().map(String::as_str).collect::<Vec<_>>();
        assert_eq!(code(&run(&scenario("p1"), out.path(), &set)), 0);
        let folder = out.path().join("p1");
        assert_eq!(code(&plot(&folder, &["--format", "svg"])), 0);
        for name in ["trajectory", "events", "energy"] {
            let drawing = std::fs::read_to_string(folder.join(format!("{name}.svg"))).unwrap();
            assert_eq!(drawing.matches("\nperiod 12").count(), periods, "{name} of {cycles}");
            // Both or none of the axes are of the period.
            assert_eq!(drawing.matches("time t (ms)").count(), 1 + periods, "{name} of {cycles}");
        }
    }
}

/// Channels over a channel are drawn by `run` and again by `plot`, in the order of the list; units are the axes', and what lies
/// before the span is not in it.
#[test]
fn channels_over_a_channel_are_drawn_as_asked() {
    let out = tempdir().unwrap();
    let own = r#"plots=["layout", {"x": "ball.u_m", "y": "ball.fx_N", "from": "2 ms"},
        {"x": "time_s", "y": ["ball.fx_N", "ball.fn_N", "slider.vx_m_s"], "from": "1 ms", "to": "2 ms"}]"#;
    let ran = run(&scenario("p1"), out.path(), &[own, "run.cycles=3"]);
    assert_eq!(code(&ran), 0, "{}", stderr(&ran));
    let folder = out.path().join("p1");
    assert_eq!(pictures(&folder), ["layout.png", "xy-1.png", "xy-2.png"]);
    let drawn = std::fs::read(folder.join("xy-1.png")).unwrap();
    assert_eq!(code(&plot(&folder, &["--format", "svg,png"])), 0);
    assert_eq!(std::fs::read(folder.join("xy-1.png")).unwrap(), drawn);
    let svg = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let has = |name: &str, words: &str| svg(name).contains(&format!(">\n{words}\n</text>"));
    assert!(has("xy-1.svg", "ball u (µm)") && has("xy-1.svg", "ball fx (mN)"));
    // Three channels of two units: two panels over one axis of time, from 1 to 2 ms.
    assert!(has("xy-2.svg", "time (ms)") && has("xy-2.svg", "slider vx (mm/s)"));
    assert!(has("xy-2.svg", "ball fx") && has("xy-2.svg", "ball fn"));
    assert!(has("xy-2.svg", "1.0") && has("xy-2.svg", "2.0") && !has("xy-2.svg", "3.0"));
    // By their name all of them, and of a scenario without any a word of advice.
    assert_eq!(code(&plot(&folder, &["--plots", "xy", "--theme", "dark"])), 0);
    assert!(pictures(&folder).contains(&"xy-2-dark.png".to_owned()));
    assert_eq!(code(&run(&scenario("p1"), out.path(), &["run.cycles=1"])), 0);
    let none = plot(&folder, &["--plots", "xy"]);
    assert_eq!(code(&none), 2);
    assert!(stderr(&none).contains("names no channels for it"), "{}", stderr(&none));
}

/// Pictures for a column of a paper: their size is in the file, and letters keep theirs.
#[test]
fn pictures_are_as_wide_as_asked_for_in_print() {
    let out = tempdir().unwrap();
    assert_eq!(code(&run(&scenario("p1"), out.path(), &["run.cycles=3", r#"plots=["loop"]"#])), 0);
    let folder = out.path().join("p1");
    assert_eq!(code(&plot(&folder, &["--format", "svg,png", "--width", "85 mm"])), 0);
    let svg = std::fs::read_to_string(folder.join("loop-85mm.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg[..200].contains("width=\"85mm\""), "{}", &svg[..200]);
    // The title's letters, theme.title of 36 px where 1600 px are 160 mm: 10.2 pt, here 2008 px for 85 mm.
    let wide: f64 = svg.split_once("viewBox=\"0 0 ").unwrap().1.split_once(' ').unwrap().0.parse().unwrap();
    let size: f64 = svg.split_once("font-size=\"").unwrap().1.split_once('"').unwrap().0.parse().unwrap();
    let points = size / wide * 85.0 / 25.4 * 72.0;
    assert!((points - 36.0 / 1600.0 * 160.0 / 25.4 * 72.0).abs() < 0.1, "{points} pt");
    let png = std::fs::read(folder.join("loop-85mm.png")).unwrap();
    let chunk = png.windows(4).position(|name| name == b"pHYs").unwrap() + 4;
    let per_metre = u32::from_be_bytes(png[chunk..chunk + 4].try_into().unwrap());
    let across = u32::from_be_bytes(png[16..20].try_into().unwrap());
    assert_eq!((across, per_metre), (2008, 23624));
    for (width, word) in [
        ("85", "from 60mm to 300mm"),
        ("59mm", "from 60mm to 300mm"),
        ("1 m", "from 60mm to 300mm"),
        ("2 s", "length"),
    ] {
        let refused = plot(&folder, &["--width", width]);
        assert!(code(&refused) == 2 && stderr(&refused).contains(word), "{width}: {}", stderr(&refused));
    }
}

/// Two runs in one panel, each named at the end of its curve; what is no curve is refused, and so is one run.
#[test]
fn several_results_are_drawn_over_each_other() {
    let (out, over) = (tempdir().unwrap(), tempdir().unwrap());
    for (name, stroke) in [("weak", "0.3 um"), ("strong", "0.6 um")] {
        let stroke = format!("waveforms.drive.sawtooth.stroke={stroke}");
        let set = [stroke.as_str(), "run.cycles=3", r#"plots=["loop", "layout", "trajectory"]"#];
        assert_eq!(code(&run(&scenario("p1"), &out.path().join(name), &set)), 0);
    }
    let folders = ["weak", "strong"].map(|name| out.path().join(name).join("p1"));
    let drawn = |options: &[&str]| {
        let to = ["--over", "--out"];
        stickslip().arg("plot").args(&folders).args(to).arg(over.path()).args(options).output().unwrap()
    };
    let ran = drawn(&["--format", "svg"]);
    assert_eq!(code(&ran), 0, "{}", stderr(&ran));
    assert_eq!(pictures(over.path()), ["over-loop.svg", "over-trajectory.svg"]);
    let drawing = std::fs::read_to_string(over.path().join("over-loop.svg")).unwrap();
    let count = |words: &str| drawing.matches(&format!(">\n{words}\n</text>")).count();
    // The last periods alone, in two colours; the first periods behind them are left out.
    assert_eq!((count("weak/p1"), count("strong/p1"), count("first period")), (1, 1, 0));
    assert!(drawing.contains("#0072B2") && drawing.contains("#D55E00"));
    let refused = drawn(&["--plots", "layout"]);
    assert!(code(&refused) == 2 && stderr(&refused).contains("cannot be overlaid"));
    let one = stickslip().arg("plot").arg(&folders[0]).args(["--over", "--out"]).arg(over.path()).output();
    assert!(stderr(&one.unwrap()).contains("expected several folders of results, got one"));
}

#[test]
fn a_picture_carries_the_scenario_it_shows() {
    let out = tempdir().unwrap();
    let folder = run_example("quickstart", out.path(), &["run.duration=20 ms", "title=größer als Δ"]);
    let drawn = plot(&folder, &["--format", "svg"]);
    assert_eq!(code(&drawn), 0, "{}", stderr(&drawn));
    let resolved = std::fs::read_to_string(folder.join("scenario.json")).unwrap();
    let texts = stickslip_plot::read_text(&std::fs::read(folder.join("loop.png")).unwrap()).unwrap();
    assert!(texts.contains(&("Scenario".to_owned(), resolved)));
    assert!(texts.contains(&("Simulated/s".to_owned(), "0.02".to_owned())));
    let svg = std::fs::read_to_string(folder.join("loop.svg")).unwrap();
    assert!(svg.contains("key=\"Scenario\">{\n") && svg.contains("Simulated/s: 0.02"));
}

#[test]
fn columns_left_out_are_named() {
    let out = tempdir().unwrap();
    let set = ["run.duration=20 ms", "output.channels=[\"slider.x_m\", \"foot.x_m\", \"ball.u_m\"]"];
    let folder = run_example("quickstart", out.path(), &set);
    let drawn = plot(&folder, &[]);
    assert_eq!(code(&drawn), 2);
    assert!(stdout(&drawn).ends_with("quickstart: trajectory.png\n"), "{}", stdout(&drawn));
    let said = stderr(&drawn);
    let message = "loop was not drawn: output.channels leaves out ball.d_m, ball.fx_N\n   \
                   help: run the scenario with these channels, or without output.channels, to write all channels\n";
    assert_eq!(said, format!("{}: {message}", folder.display()));
}

#[test]
fn the_layout_shows_the_scene_of_the_file() {
    let out = tempdir().unwrap();
    let folder = run_example("three_ball_stage", out.path(), &["run.cycles=1", "plots=[\"layout\"]"]);
    assert_eq!(code(&plot(&folder, &["--format", "svg"])), 0);
    let svg = std::fs::read_to_string(folder.join("layout.svg")).unwrap();
    for text in
        ["foot", "x: drive", "stage", "50 g", "front", "rear × 2", "600 mN", "300 mN", "g = 9.807 m/s²"]
    {
        assert!(svg.contains(&format!(">\n{text}\n</text>")), "{text}");
    }
    let nothing = out.path().join("nothing.json");
    std::fs::write(&nothing, r#"{ "stickslip": 1, "run": { "duration": 1 }, "plots": ["layout"] }"#).unwrap();
    let checked = stickslip().arg("check").arg(&nothing).output().unwrap();
    assert_eq!(code(&checked), 2);
    assert!(stderr(&checked).contains("plots[0]: the scenario has no body to draw"), "{}", stderr(&checked));
}

#[test]
fn a_picture_without_its_columns_or_its_table_says_what_to_run() {
    let out = tempdir().unwrap();
    let set = ["run.duration=20 ms", "plots=[]", "output.channels=[\"energy.input_J\"]"];
    let folder = run_example("quickstart", out.path(), &set);
    let needs = [
        (
            "energy",
            "output.channels leaves out energy.kinetic_J, energy.elastic_J, energy.friction_J, energy.damping_J, energy.error_J\n",
        ),
        ("phase", "output.channels leaves out slider.x_m, slider.vx_m_s\n"),
        (
            "state",
            "the run did not write springs.csv\n   help: run the scenario with this plot in its key \"plots\"",
        ),
        ("memory", "the run did not write memory.csv"),
    ];
    for (picture, needed) in needs {
        let drawn = plot(&folder, &["--plots", picture]);
        assert_eq!((code(&drawn), stdout(&drawn)), (2, String::new()));
        assert!(
            stderr(&drawn).contains(&format!(": {picture} was not drawn: {needed}")),
            "{}",
            stderr(&drawn)
        );
    }
    let set =
        ["run.cycles=1", "plots=[]", "output.channels=[\"slider.x_m\", \"slider.vx_m_s\", \"slider.z_m\"]"];
    let planar = run_example("rocking_slider", out.path(), &set);
    let said = stderr(&plot(&planar, &["--plots", "phase"]));
    let rest = "leaves out slider.vz_m_s, slider.pitch_rad, slider.vpitch_rad_s\n";
    assert!(said.contains(rest), "{said}");
    // The events are in a table of their own, whatever its channels; the scene needs none.
    assert_eq!(code(&plot(&folder, &["--plots", "events,layout"])), 0);
    assert_eq!(pictures(&folder), ["events.png", "layout.png"]);
}

#[test]
fn damaged_insides_are_refused_with_file_and_line() {
    let root = tempdir().unwrap();
    let set = ["plots=[\"state\", \"memory\"]", "output.springs.count=4", "output.every=1 s"];
    let folder = run_example("oblique_loading", root.path(), &set);
    let springs = std::fs::read_to_string(folder.join("springs.csv")).unwrap();
    let memory = std::fs::read_to_string(folder.join("memory.csv")).unwrap();
    let lines: Vec<&str> = springs.lines().collect();
    assert_eq!(lines.len(), 1 + 4 * 8);
    let line = |n: usize, from: &str, to: &str| {
        let mut lines: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
        assert!(lines[n - 1].contains(from), "{from} in {}", lines[n - 1]);
        lines[n - 1] = lines[n - 1].replacen(from, to, 1);
        lines.join("\n") + "\n"
    };
    let without = |n: usize| [&lines[..n - 1], &lines[n..]].concat().join("\n") + "\n";
    let place = lines[6].split(',').nth(2).unwrap();
    let cases = [
        (
            "springs.csv",
            line(8, "stick", "stuck"),
            "springs.csv:8  state: expected open, stick, slip+ or slip-, got \"stuck\"",
        ),
        (
            "springs.csv",
            line(7, place, "7"),
            "springs.csv:7  x_m: expected the positions of the first time, got 7",
        ),
        ("springs.csv", line(7, place, "far"), "springs.csv:7  x_m: expected a number, got \"far\""),
        ("springs.csv", without(9), "springs.csv:9  expected 4 springs of \"ball\" at each time"),
        ("springs.csv", without(33), "springs.csv:32  expected 4 springs of \"ball\" at each time"),
        (
            "springs.csv",
            line(1, "stretch_m", "stretch"),
            "springs.csv:1  column 4: expected \"stretch_m\", got \"stretch\"",
        ),
        (
            "memory.csv",
            memory.replacen(",ball,", ",ball,,", 1),
            "memory.csv:2  expected 6 cells like the first line, got 7",
        ),
        (
            "memory.csv",
            memory.replacen(",p_m", ",p", 1),
            "memory.csv:1  column 6: expected \"p_m\", got \"p\"",
        ),
    ];
    for (name, text, message) in cases {
        std::fs::write(folder.join(name), text).unwrap();
        reseal(&folder);
        let drawn = plot(&folder, &[]);
        assert_eq!(code(&drawn), 2);
        let said = stderr(&drawn).replace(&format!("{}/", folder.display()), "");
        assert!(said.contains(&format!("was not drawn: {message}")), "{said}");
        std::fs::write(folder.join("springs.csv"), &springs).unwrap();
        std::fs::write(folder.join("memory.csv"), &memory).unwrap();
    }
    reseal(&folder);
    assert_eq!(code(&plot(&folder, &[])), 0);
}

/// Results of a short run, in which something is then spoiled.
struct Spoiled {
    _root: tempfile::TempDir,
    folder: PathBuf,
}

impl Spoiled {
    fn new() -> Self {
        let root = tempdir().unwrap();
        let folder = run_example("quickstart", root.path(), &["run.duration=20 ms"]);
        Self { _root: root, folder }
    }

    /// Replaces a text in a file.
    fn replace(&self, name: &str, from: &str, to: &str) {
        let path = self.folder.join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains(from), "{from} in {name}");
        std::fs::write(path, text.replacen(from, to, 1)).unwrap();
    }

    /// What `plot` says, without the folder; it draws nothing.
    fn message(&self) -> String {
        std::fs::remove_file(self.folder.join("loop.png")).unwrap();
        let drawn = plot(&self.folder, &[]);
        assert_eq!((code(&drawn), stdout(&drawn)), (2, String::new()), "{}", stderr(&drawn));
        assert!(!self.folder.join("loop.png").exists());
        stderr(&drawn).replace(&format!("{}/", self.folder.display()), "")
    }
}

#[test]
fn damaged_results_are_refused_with_file_and_line() {
    let after = |name: &str, from: &str, to: &str| {
        let spoiled = Spoiled::new();
        spoiled.replace(name, from, to);
        spoiled.message()
    };
    let other = "   help: the table is not of the scenario.json in its folder, or another version of the program wrote \
                 it; run the scenario again\n";
    let cases = [
        (
            after("trace.csv", "\n0.00002,", "\n0.00002x,"),
            "trace.csv:4  time_s: expected a number, got \"0.00002x\"\n".to_owned(),
        ),
        (
            after("trace.csv", ",partial,", ",partly,"),
            "trace.csv:3  ball.state: expected open, stick, partial or slip, got \"partly\"\n".to_owned(),
        ),
        (
            after("events.csv", "source,kind", "source,sort"),
            format!("events.csv:1  column 3: expected \"kind\", got \"sort\"\n{other}"),
        ),
        (
            after("trace.csv", ",energy.error_J", ""),
            format!("trace.csv:1  column 20: expected \"energy.error_J\", got nothing\n{other}"),
        ),
        (
            after("scenario.json", "Sawtooth", "Saw"),
            "scenario.json: was changed after the run: its SHA-256 differs from that in summary.json\n   help: run the \
             scenario again, or draw other plots with --plots\n"
                .to_owned(),
        ),
    ];
    for (got, want) in cases {
        assert_eq!(got, want);
    }
    let summary = after("summary.json", "\"program\"", "\"programme\"");
    assert_eq!(summary, "summary.json: is not the summary of a run: program.name is missing\n");
    let cut = after("trace.csv", "\n0.00004,", "\n0.00004,0.1\n0.00005,");
    assert_eq!(cut, "trace.csv:6  expected 20 cells like the first line, got 2\n");
    // What cannot be told from its own form is told from its seal.
    let other = after("trace.csv", "\n0.00004,", "\n0.000041,");
    let seal = "trace.csv: is not the table of its run: its SHA-256 differs from that in summary.json\n   help: the \
                file was changed after the run, or is of another run; run the scenario again\n";
    assert_eq!(other, seal);
}

#[test]
fn results_that_are_not_there_or_of_another_program_are_refused() {
    let spoiled = Spoiled::new();
    std::fs::remove_file(spoiled.folder.join("events.csv")).unwrap();
    assert_eq!(spoiled.message(), "events.csv: cannot be read: No such file or directory\n");
    let spoiled = Spoiled::new();
    std::fs::write(spoiled.folder.join("trace.csv"), "").unwrap();
    assert!(spoiled.message().starts_with("trace.csv:1  column 1: expected \"time_s\", got nothing"));
    let spoiled = Spoiled::new();
    let head = std::fs::read_to_string(spoiled.folder.join("trace.csv")).unwrap();
    std::fs::write(spoiled.folder.join("trace.csv"), head.lines().next().unwrap()).unwrap();
    assert_eq!(spoiled.message(), "trace.csv:1  expected 2001 rows by summary.json, got 0\n");
    let spoiled = Spoiled::new();
    spoiled.replace("summary.json", "\"version\": \"0.1.0\"", "\"version\": \"0.0.9\"");
    spoiled.replace("scenario.json", "\"friction\"", "\"rubbing\"");
    let said = spoiled.message();
    assert!(
        said.contains("rubbing")
            && said.ends_with("   note: written by stickslip 0.0.9, this is stickslip 0.1.0\n")
    );
    for none in ["no/such/folder", "src"] {
        let nothing = plot(Path::new(none), &[]);
        let message = "expected a folder of results, as `stickslip run` writes one for each scenario";
        assert_eq!((code(&nothing), stderr(&nothing)), (2, format!("{none}: {message}\n")));
    }
}

#[test]
fn results_of_another_version_are_drawn_still_and_those_without_a_summary_are_not() {
    let out = tempdir().unwrap();
    let folder = run_example("oblique_loading", out.path(), &[]);
    let first = std::fs::read(folder.join("loop.png")).unwrap();
    let summary = std::fs::read_to_string(folder.join("summary.json")).unwrap();
    std::fs::remove_file(folder.join("summary.json")).unwrap();
    let refused = plot(&folder, &[]);
    assert!(code(&refused) == 2 && stderr(&refused).contains(": incomplete: "), "{}", stderr(&refused));
    assert!(first == std::fs::read(folder.join("loop.png")).unwrap());
    let older = summary.replacen("\"version\": \"0.1.0\"", "\"version\": \"0.0.9\"", 1);
    std::fs::write(folder.join("summary.json"), older).unwrap();
    let drawn = plot(&folder, &[]);
    assert_eq!(code(&drawn), 0);
    assert_eq!(stderr(&drawn), format!("{}: note: computed by stickslip 0.0.9\n", folder.display()));
    let texts = stickslip_plot::read_text(&std::fs::read(folder.join("loop.png")).unwrap()).unwrap();
    assert!(texts.contains(&("Software".to_owned(), "stickslip 0.0.9".to_owned())));
}

#[test]
fn several_folders_are_drawn_whatever_is_wrong_with_one() {
    let out = tempdir().unwrap();
    let first = run_example("oblique_loading", out.path(), &[]);
    let second = run_example("fretting_sphere", out.path(), &["plots=[]", "run.duration=1 s"]);
    let output = stickslip().arg("plot").args([&second, &first]).output().unwrap();
    assert_eq!(code(&output), 2);
    let help = "the scenario names no plots\n   help: name some with --plots, such as --plots layout,loop,trajectory,energy,phase,events,state,memory";
    assert!(stderr(&output).contains(help), "{}", stderr(&output));
    assert!(stdout(&output).contains("oblique_loading: loop.png"));
    let unknown = plot(&first, &["--plots", "lop"]);
    assert_eq!(code(&unknown), 2);
    assert!(stderr(&unknown).contains("tip: a similar value exists: 'loop'"), "{}", stderr(&unknown));
}
