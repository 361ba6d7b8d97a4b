//! Valid scenarios: their meaning, their resolved form, and overrides.

use proptest::prelude::*;
use std::fs;
use std::path::Path;
use stickslip_contact::{Interface, Material, Pair, Profile};
use stickslip_drive::scene::{
    ContactStart, Coordinate, Direction, EngineChoice, Freedom, Normal, Point, Side, Start, Varying,
};
use stickslip_drive::{
    Command, Cycle, Generator, Harmonic, Heading, Interpolation, Model, Moments, Section, Shape, Stepper,
    Steps, Sweep, Timing, Waveform,
};
use stickslip_scenario::{PlotName, Scenario};

const QUICKSTART: &str = "../../scenarios/quickstart.json";

/// Scenario with every key.
const FULL: &str = include_str!("../good/full.json");

/// Scenario with every key that only bodies in the plane have.
const PLANAR: &str = include_str!("../good/planar.json");

fn full() -> Scenario {
    Scenario::from_str(FULL, "full.json", "tests/good").unwrap_or_else(|error| panic!("{error}"))
}

fn planar() -> Scenario {
    Scenario::from_str(PLANAR, "planar.json", "tests/good").unwrap_or_else(|error| panic!("{error}"))
}

fn waveforms() -> Scenario {
    let text = include_str!("../good/waveforms.json");
    Scenario::from_str(text, "waveforms.json", "tests/good").unwrap_or_else(|error| panic!("{error}"))
}

/// Returns a waveform of that file.
fn wave(name: &str) -> Waveform {
    let scenario = waveforms();
    let found = scenario.scene.waveforms.into_iter().find(|waveform| waveform.name == name);
    found.unwrap_or_else(|| panic!("there is no {name}")).part
}

fn is(name: &str, shape: Shape, timing: Timing) {
    assert_eq!(wave(name), Waveform::new(shape, timing).unwrap(), "{name}");
}

/// All kinds of waveforms that are not in `full.json`, with all their keys, in SI.
#[test]
fn every_waveform_means_what_its_keys_say() {
    let every = Timing::every;
    let turned = Timing { phase: std::f64::consts::FRAC_PI_2, ..every(1e-3) };
    is("par", Shape::Parabola { stroke: 2e-7, turn: 2e-5 }, turned);
    is("tra", Shape::Trapezoid { stroke: 2e-7, rise: 1e-3, hold: 3e-3, fall: 1e-3 }, every(1e-2));
    let thrice = Timing { cycles: Some(3.0), ..every(1e-2) };
    is("scu", Shape::SCurve { stroke: 2e-7, flyback: 1e-3, rounding: 1e-4 }, thrice);
    let term = |amplitude, order| Harmonic { amplitude, order, phase: 0.0 };
    let late = Timing { delay: 1e-3, ..every(1e-3) };
    is("two", Shape::Harmonics { terms: vec![term(1e-7, 1.0), term(-0.2 * 1e-7, 2.0)] }, late);
    let phase = std::f64::consts::FRAC_PI_2;
    let sweep = Sweep { amplitude: 1e-6, offset: 2e-6, phase, from: 100.0, to: 2000.0, duration: 0.05 };
    is("chi", Shape::Chirp(sweep), Timing { delay: 1e-3, ..every(1.0) });
    is("ste", Shape::Step { height: 1e-3, at: 0.0 }, Timing { delay: 5e-3, ..every(1.0) });
    is("lim", Shape::Limited { stroke: 2e-7, flyback: 1e-5, rate: 5e-4 }, every(1e-2));
    is("tun", Shape::Sawtooth { stroke: 2e-7, flyback: 2.5e-4 }, every(1e-2));
    is("jump", Shape::Limited { stroke: 2e-7, flyback: 0.0, rate: 5e-4 }, every(1e-2));
}

#[test]
fn bursts_and_sequences_are_patterns() {
    let every = Timing::every;
    let turned = Timing { phase: std::f64::consts::FRAC_PI_2, ..every(1e-3) };
    let pattern = |carrier: Shape, parts: &[Section]| Shape::Pattern {
        carrier: Box::new(carrier),
        parts: parts.to_vec(),
    };
    let run = |cycles| Section::Run { cycles, reversed: false };
    let triangle = Shape::Triangle { stroke: 2e-7 };
    is("bur", pattern(triangle.clone(), &[run(5), Section::Rest { duration: 0.02 - 0.005 }]), every(1e-3));
    is("full", pattern(triangle, &[run(5)]), every(1e-3));
    let sine = Shape::Sine { amplitude: 2e-7, phase: 0.0, offset: 0.0 };
    is("dwe", pattern(sine, &[run(5), Section::Rest { duration: 0.015 }]), turned);
    let parts = [run(10), Section::Rest { duration: 5e-3 }, Section::Run { cycles: 4, reversed: true }];
    is("seq", pattern(Shape::Cycloid { stroke: 2e-7, flyback: 5e-4 }, &parts), every(1e-3));
    assert_eq!(wave("seq").period(), Some(10.0 * 1e-3 + 5e-3 + 4.0 * 1e-3));
}

#[test]
fn tables_are_scaled_joined_and_repeated() {
    let every = Timing::every;
    let scenario = waveforms();
    let points = vec![(1e-3, 0.0), (2e-3, 5e-9), (4e-3, 0.0)];
    is("rep", Shape::Curve { points, smooth: false, repeated: true }, every(1.0));
    let plain = full().scene.waveforms[5].part.clone();
    let (Shape::Table { points }, Shape::Curve { points: scaled, smooth: true, repeated: false }) =
        (plain.shape(), wave("csv").shape().clone())
    else {
        panic!("{:?}", wave("csv"))
    };
    let expected: Vec<(f64, f64)> = points.iter().map(|(t, v)| (*t, -2.0 * v + 1e-6)).collect();
    assert_eq!(scaled, expected);
    assert_eq!(scenario.plots, [PlotName::Waveform]);
    // The resolved scenario has the same waveforms.
    let again = Scenario::from_str(&scenario.resolved(), "resolved.json", "").unwrap();
    assert_eq!(again.scene.waveforms, scenario.scene.waveforms);
}

fn refused(overrides: &[(&str, &str)]) -> String {
    Scenario::load_with(QUICKSTART, overrides).unwrap_err().to_string()
}

#[test]
fn the_example_means_what_the_contract_says() {
    let scenario = Scenario::load(QUICKSTART).unwrap();
    assert_eq!(scenario.title, "Sawtooth drive on three ruby balls");
    assert_eq!(scenario.plots, [PlotName::Loop, PlotName::Trajectory]);
    assert_eq!(scenario.plan.duration, 0.1);
    assert_eq!(scenario.plan.every, Some(1e-5));
    assert_eq!(scenario.plan.stepper, Stepper::Event { tolerance: 1e-8 });
    assert_eq!((scenario.figures.waveform, scenario.figures.body), (Some(0), Some(1)));
    let scene = &scenario.scene;
    let timing = Timing { period: 1e-2, delay: 0.0, phase: 0.0, cycles: None };
    let drive = Waveform::new(Shape::Sawtooth { stroke: 2e-7, flyback: 1e-5 }, timing).unwrap();
    assert_eq!(scene.waveforms[0].part, drive);
    assert_eq!(scene.bodies[0].part.x.freedom, Freedom::Follows(0));
    assert_eq!((scene.bodies[1].part.x, scene.bodies[1].part.mass), (Coordinate::FREE, Some(0.01)));
    let ball = &scene.contacts[0].part;
    let pair = Pair::new(Material::new(400e9, 0.27).unwrap(), Material::new(210e9, 0.30).unwrap());
    assert_eq!(ball.between, [Side::Body(0), Side::Body(1)]);
    assert_eq!(ball.interface, Interface::new(pair, Profile::paraboloid(5e-4).unwrap(), 0.2).unwrap());
    assert_eq!(ball.count, 3);
    assert_eq!(ball.normal, Normal::Force(Varying::Constant(0.3)));
    assert_eq!((ball.start, ball.engine), (ContactStart::Untouched, EngineChoice::Curve));
    assert_eq!((scene.loads[0].on, scene.loads[0].x), (1, Varying::Constant(-0.02)));
}

#[test]
fn every_part_of_the_form_arrives() {
    let scenario = full();
    let scene = &scenario.scene;
    assert_eq!(scene.start, Start::Equilibrium);
    assert_eq!(scene.gravity.acceleration, 9.81);
    assert_eq!(scene.gravity.incline, std::f64::consts::FRAC_PI_2);
    assert_eq!(scene.contacts.len(), 6);
    assert_eq!(scene.contacts[1].part.engine, EngineChoice::Springs { count: 512, span: Some(2e-5) });
    assert_eq!(scene.contacts[2].part.start, ContactStart::Force(-0.01));
    assert_eq!(scene.contacts[3].part.start, ContactStart::Displacement(3e-9));
    assert_eq!(
        scene.contacts[5].part.interface.profile(),
        &Profile::foundation(&[0.0, 1e-8, 2e-8], &[1e-6, 2e-6, 1e-6]).unwrap()
    );
    assert_eq!(scene.springs[0].part.stiffness, 2e6);
    assert_eq!(scene.actuators[0].part.stiffness, 2e7);
    // Named waveforms come first, then inline ones under their paths.
    let names: Vec<_> = scene.waveforms.iter().map(|waveform| waveform.name.as_str()).collect();
    assert_eq!(names[..9], ["saw", "tri", "sin", "har", "cyc", "tab", "csv", "inp", "gen"]);
    assert_eq!(
        names[9..],
        [
            "contacts.flat.normal.force.follows",
            "loads[1].x.follows",
            "loads[3].x.follows",
            "loads[5].x.follows"
        ]
    );
    assert_eq!(scene.waveforms[5].part, scene.waveforms[6].part, "the file holds the same points");
    // Three cycles of 2 kHz after a delay of 1 ms.
    assert_eq!(scenario.plan.duration, 1e-3 + 3.0 * (1.0 / 2e3));
    assert_eq!(scenario.channels.as_deref(), Some(&["slider.x_m".to_owned()][..]));
    let springs = scenario.springs.as_ref().unwrap();
    assert_eq!((springs.count, &springs.moments), (33, &Moments::Every(1e-5)));
    assert_eq!((scenario.figures.waveform, scenario.figures.body), (Some(2), Some(1)));
}

#[test]
fn every_part_of_a_planar_body_arrives() {
    let scenario = planar();
    let scene = &scenario.scene;
    let foot = &scene.bodies[0].part;
    assert_eq!([foot.x, foot.z, foot.pitch], [0, 1, 2].map(Coordinate::follows));
    assert_eq!(scene.waveforms[2].part.range(), (-2e-4, 2e-4));
    let slider = &scene.bodies[1].part;
    let free = |position, velocity| Coordinate { freedom: Freedom::Free, position, velocity };
    assert_eq!((slider.mass, slider.inertia), (Some(0.02), Some(2.5e-7)));
    assert_eq!((slider.x, slider.z, slider.pitch), (free(1e-6, 2e-3), free(2e-5, -1e-3), free(1e-4, 3.0)));
    assert_eq!(scene.bodies[2].part.z, Coordinate { position: 2e-6, ..Coordinate::default() });
    assert_eq!(scene.bodies[3].part.pitch, Coordinate::FREE);
    let ball = &scene.contacts[0].part;
    assert_eq!((ball.normal, ball.gap, ball.interface.damping()), (Normal::Coupled, -2e-8, 1e-6));
    assert_eq!(ball.at, [Point { x: 1e-3, z: 0.0 }, Point { x: 5e-3, z: -3e-3 }]);
    assert_eq!(scene.contacts[1].part.at, [Point::default(), Point { x: 0.0, z: -0.02 }]);
    let (press, jack) = (&scene.springs[0].part, &scene.actuators[0].part);
    assert_eq!((press.direction, jack.direction), (Direction::Z, Direction::Z));
    assert_eq!(press.at, [Point::default(), Point { x: 4e-3, z: 0.0 }]);
    assert_eq!(jack.at, [Point { x: 0.0, z: -1e-3 }, Point { x: 8e-3, z: 0.0 }]);
    let load = scene.loads[0];
    assert_eq!((load.on, load.at, load.x), (1, Point { x: 2e-3, z: 0.0 }, Varying::default()));
    assert_eq!((load.z, load.pitch), (Varying::Constant(-1.0), Varying::Constant(5e-4)));
    assert_eq!((scene.loads[1].at, scene.loads[1].pitch), (Point::default(), Varying::Follows(3)));
    Model::new(scene).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn inputs_arrive_held_unless_they_say_otherwise() {
    let scenario = full();
    let named = |name: &str| &scenario.scene.waveforms.iter().find(|wave| wave.name == name).unwrap().part;
    let input = |initial, range, interpolation| {
        Waveform::new(Shape::Input { initial, range, interpolation }, Timing::every(1.0)).unwrap()
    };
    assert_eq!(*named("inp"), input(0.7e-3, (-2e-3, 0.1), Interpolation::Held));
    assert_eq!(*named("loads[3].x.follows"), input(0.0, (-3.0, 0.3), Interpolation::Linear));
    // Resolved: in SI, with the default.
    let resolved: serde_json::Value = serde_json::from_str(&scenario.resolved()).unwrap();
    let written = serde_json::json!({ "initial": 0.7e-3, "range": [-2e-3, 0.1], "interpolation": "held" });
    assert_eq!(resolved["waveforms"]["inp"]["input"], written);
}

#[test]
fn generators_arrive_with_what_may_be_commanded() {
    let scenario = full();
    let named = |name: &str| &scenario.scene.waveforms.iter().find(|wave| wave.name == name).unwrap().part;
    let of = |generator| Waveform::new(Shape::Generator(generator), Timing::every(1.0)).unwrap();
    let initial =
        Command { stroke: 1e-4, frequency: 200.0, heading: Heading::Backward, steps: Steps::Left(1000) };
    let cycle = Cycle::Sawtooth { flyback: 1e-5 };
    let commanded = Generator { cycle, initial, strokes: (-5e-4, 1e-3), frequencies: (0.0, 5e3) };
    assert_eq!(*named("gen"), of(commanded));
    let initial = Command { stroke: 0.0, frequency: 0.0, heading: Heading::Forward, steps: Steps::Endless };
    let frequencies = (0.0, 2.0);
    let rest = Generator { cycle: Cycle::Triangle, initial, strokes: (0.0, 1e-3), frequencies };
    assert_eq!(*named("loads[5].x.follows"), of(rest));
    let resolved: serde_json::Value = serde_json::from_str(&scenario.resolved()).unwrap();
    let written = serde_json::json!({
        "shape": { "sawtooth": { "flyback": 1e-5 } }, "stroke": 1e-4, "frequency": 200.0, "heading": "backward",
        "steps": 1000, "range": { "stroke": [-5e-4, 1e-3], "frequency": [0.0, 5e3] }
    });
    assert_eq!(resolved["waveforms"]["gen"]["generator"], written);
}

/// A drive by a generator has the plan of the drive by the corresponding sawtooth. A generator at rest has no steps.
#[test]
fn a_generated_drive_is_planned_as_the_sawtooth_is() {
    let load = |drive: &str, run: &str| {
        let set = [("waveforms.drive", drive), ("run", run)];
        Scenario::load_with(QUICKSTART, &set).unwrap_or_else(|error| panic!("{error}"))
    };
    let saw = load(
        r#"{"sawtooth": {"stroke": "200 nm", "frequency": "100 Hz", "flyback": "10 us", "cycles": 7}}"#,
        r#"{"cycles": 9}"#,
    );
    let generated = |more: &str, run: &str| {
        let of = r#"{"generator": {"shape": {"sawtooth": {"flyback": "10 us"}}, "stroke": "200 nm", "frequency": "100 Hz",
            "range": {"stroke": [0, "300 nm"], "frequency": [0, "2 kHz"]}MORE}}"#;
        load(&of.replace("MORE", more), run)
    };
    let seven = generated(r#", "steps": 7"#, r#"{"cycles": 9}"#);
    assert_eq!(
        (seven.figures, seven.plan, seven.warnings.len()),
        (saw.figures, saw.plan, saw.warnings.len())
    );
    let idle = generated(r#", "steps": 0"#, r#"{"duration": "1 ms"}"#);
    assert_eq!(idle.scene.waveforms[0].part.period(), None);
    let model = Model::new(&idle.scene).unwrap_or_else(|error| panic!("{error}"));
    model.start(&idle.plan).unwrap_or_else(|error| panic!("{error}"));
}

/// A waveform without a period is not the evaluated waveform unless `figures` names it.
#[test]
fn a_drive_by_an_input_loads_as_one_by_a_table_does() {
    let load = |drive: &str| {
        let set = [("waveforms.drive", drive)];
        Scenario::load_with(QUICKSTART, &set).unwrap_or_else(|error| panic!("{error}"))
    };
    let table = load(r#"{"table": {"points": [[0, 0], ["5 ms", "200 nm"]]}}"#);
    let input = load(r#"{"input": {"initial": "20 nm", "range": [0, "200 nm"], "interpolation": "linear"}}"#);
    assert_eq!(input.figures, table.figures);
    assert_eq!((input.warnings.len(), input.plan), (table.warnings.len(), table.plan));
    let model = Model::new(&input.scene).unwrap_or_else(|error| panic!("{error}"));
    model.start(&input.plan).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn a_resolved_scenario_means_the_same_to_the_last_bit() {
    for scenario in [Scenario::load(QUICKSTART).unwrap(), full(), planar()] {
        let text = scenario.resolved();
        // Without a folder, no files are read.
        let again = Scenario::from_str(&text, "resolved", "/nowhere")
            .unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(again.scene, scenario.scene);
        assert_eq!(again.plan, scenario.plan);
        assert_eq!(again.figures, scenario.figures);
        assert_eq!(again.channels, scenario.channels);
        assert_eq!(again.plots, scenario.plots);
        assert_eq!(again.springs, scenario.springs);
        assert_eq!(again.title, scenario.title);
        assert_eq!(again.resolved(), text);
        assert!(!text.contains(" um\"") && !text.contains("\"file\":"), "{text}");
    }
}

#[test]
fn the_error_of_the_contract_comes_out() {
    let text = "{\n  \"stickslip\": 1,\n  \"materials\": { \"a\": { \"youngs_modulus\": 1e9, \"poisson_ratio\": 0.3 } },\n  \
                \"bodies\": {\n    \"slider\": { \"mass\": 1, \"x\": \"free\" }\n  },\n  \"contacts\": {\n    \"ball\": {\n      \
                \"between\": [\"ground\", \"slider\"],\n      \"materials\": [\"a\", \"a\"],\n      \"profile\": {\n        \
                \"paraboloid\": { \"radius\": 1 }\n      },\n      \"friction\": -0.2,\n      \
                \"normal\": { \"force\": 1 }\n    }\n  },\n  \"run\": { \"duration\": 1 }\n}\n";
    let expected = "\
scenarios/mine.json:14:19  contacts.ball.friction: expected a number between 0 and 1000, got -0.2
   14 |       \"friction\": -0.2,
                          ^^^^
   help: the Coulomb coefficient of the pair; typical 0.05 to 0.6";
    let error = Scenario::from_str(text, "scenarios/mine.json", "").unwrap_err();
    assert_eq!(error.to_string(), expected);
    assert_eq!((error.path.as_str(), error.file.as_str()), ("contacts.ball.friction", "scenarios/mine.json"));
}

#[test]
fn overrides_change_add_and_are_checked_like_the_file() {
    let with = |overrides: &[(&str, &str)]| {
        Scenario::load_with(QUICKSTART, overrides).unwrap_or_else(|error| panic!("{error}"))
    };
    assert_eq!(with(&[("run.duration", "20 ms")]).plan.duration, 0.02);
    assert_eq!(with(&[("contacts.ball.friction", "0.3")]).scene.contacts[0].part.interface.friction(), 0.3);
    assert_eq!(with(&[("loads[0].x", "1e-3")]).scene.loads[0].x, Varying::Constant(1e-3));
    assert_eq!(with(&[("run.limits.steps", "1e6")]).plan.limits.steps, 1_000_000);
    assert_eq!(with(&[("gravity.incline", "90 deg")]).scene.gravity.acceleration, 9.80665);
    assert_eq!(
        with(&[("run.stepper", r#"{"verlet": {"step": "1 us"}}"#)]).plan.stepper,
        Stepper::Verlet { step: 1e-6 }
    );
    assert_eq!(with(&[("bodies.slider.x", "fixed")]).scene.bodies[1].part.x.freedom, Freedom::Fixed);
    let resolved = with(&[("run.duration", "20 ms")]).resolved();
    assert!(resolved.contains("\"duration\": 0.02"), "{resolved}");
}

#[test]
fn a_bad_override_is_blamed_itself() {
    assert_eq!(
        refused(&[("run.duration", "-5 ms")]),
        "\
--set run.duration=-5 ms  run.duration: expected a time above 0 s, got -5 ms
      | run.duration=-5 ms
                     ^^^^^
   help: simulated time, s, above 0; give either this or \"cycles\"; typical 1 ms to 10 s"
    );
    assert_eq!(
        refused(&[("contacts.bal.friction", "0.3")]),
        "\
--set contacts.bal.friction=0.3  contacts.bal: the scenario has no value at this path
      | contacts.bal.friction=0.3
        ^^^^^^^^^^^^^^^^^^^^^
   help: did you mean \"ball\"?"
    );
    assert_eq!(
        refused(&[("contacts.ball.fricton", "0.3")]),
        "\
--set contacts.ball.fricton=0.3  contacts.ball.fricton: unknown key
      | contacts.ball.fricton=0.3
        ^^^^^^^^^^^^^^^^^^^^^
   help: did you mean \"friction\"?"
    );
    assert_eq!(
        refused(&[("loads[3].x", "0.3")]),
        "\
--set loads[3].x=0.3  loads: the list has one entry, [0]
      | loads[3].x=0.3
        ^^^^^^^^^^"
    );
    assert!(refused(&[("run.duration", "{\"a\":")]).contains("not JSON"));
    assert!(refused(&[("", "1")]).contains("expected a key path"));
    assert!(refused(&[("contacts.ball.friction.x", "1")]).contains("this value has no keys"));
    assert!(refused(&[("stickslip", "2")]).contains("expected 1, got 2"));
    assert!(refused(&[("run.stepper", r#"{"event": {}, "verlet": {}}"#)]).contains("got event, verlet"));
    assert!(refused(&[("wavforms.drive.sawtooth.stroke", "1 um")]).contains("did you mean \"waveforms\"?"));
}

#[test]
fn a_later_check_points_into_the_file() {
    let scenario = Scenario::load(QUICKSTART).unwrap();
    let error =
        scenario.locate("contacts.ball.engine.springs.span", "too short", Some("a longer one".to_owned()));
    let expected = "\
../../scenarios/quickstart.json:15:5  contacts.ball.engine.springs.span: too short
   15 |     \"ball\": {
            ^^^^^^
   help: a longer one";
    assert_eq!(error.to_string(), expected);
    let error = scenario.locate("output.every", "too fine", None);
    assert!(error.to_string().starts_with("../../scenarios/quickstart.json:23:24  output.every: too fine\n"));
    assert!(scenario.locate("", "odd", None).to_string().contains(":1:1  odd"));
}

#[test]
fn files_are_found_below_the_folder_only() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).unwrap();
    fs::write(folder.path().join("outside.csv"), "t,x\n0,0\n1,1\n").unwrap();
    fs::write(inner.join("good.csv"), "t,x\n0,0\n1,1\n").unwrap();
    fs::write(inner.join("word.csv"), "t,x\n0,0\n1,far\n").unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(folder.path().join("outside.csv"), inner.join("link.csv")).unwrap();
    let load = |file: &str, base: &Path| {
        let text = format!(
            r#"{{ "stickslip": 1, "run": {{ "duration": 1 }},
               "waveforms": {{ "w": {{ "table": {{ "file": "{file}", "time": "t", "value": "x" }} }} }} }}"#
        );
        Scenario::from_str(&text, "t.json", base).map(|_| ()).map_err(|error| error.message.clone())
    };
    assert_eq!(load("good.csv", &inner), Ok(()));
    assert_eq!(load("../inner/good.csv", &inner), Ok(()), "below is below, however it is written");
    assert_eq!(load("inner/good.csv", folder.path()), Ok(()));
    assert!(load("../outside.csv", &inner).unwrap_err().contains("outside the scenario's folder"));
    #[cfg(unix)]
    assert!(load("link.csv", &inner).unwrap_err().contains("outside the scenario's folder"));
    assert!(load("/etc/passwd", &inner).unwrap_err().contains("outside the scenario's folder"));
    assert!(load("none.csv", &inner).unwrap_err().contains("there is no file"));
    assert!(load(".", &inner).unwrap_err().contains("is not a file"));
    assert_eq!(load("word.csv", &inner).unwrap_err(), "expected a number, got \"far\"");
    // The error does not reveal whether a file outside exists.
    for outside in ["../outside.csv", "../missing.csv", "/etc/passwd", "/etc/missing", "../../missing/x.csv"]
    {
        let told = load(outside, &inner).unwrap_err();
        assert_eq!(told, format!("\"{outside}\" lies outside the scenario's folder"));
    }
}

#[test]
fn files_that_are_no_scenarios_are_refused_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.json");
    let told = |path: &Path| Scenario::load(path).unwrap_err().to_string();
    assert!(told(&path).ends_with("s.json: there is no such file"), "{}", told(&path));
    fs::write(folder.path().join("drive.json"), "").unwrap();
    let near = told(&folder.path().join("drvie.json"));
    assert!(
        near.ends_with("drvie.json: there is no such file\n   help: did you mean \"drive.json\"?"),
        "{near}"
    );
    let whole = told(folder.path());
    assert!(whole.contains(": this is a folder, not a scenario\n   help: name its files: "), "{whole}");
    fs::write(&path, b"{ \"stickslip\": 1,\n \"title\": \"\xff\" }").unwrap();
    assert!(
        Scenario::load(&path)
            .unwrap_err()
            .to_string()
            .contains("s.json:2:12  expected UTF-8 text, got the byte 0xFF")
    );
    fs::write(&path, vec![b' '; (4 << 20) + 1]).unwrap();
    assert!(Scenario::load(&path).unwrap_err().to_string().contains("at most 4194304 bytes"));
    fs::write(&path, "[".repeat(4 << 20)).unwrap();
    assert!(Scenario::load(&path).unwrap_err().to_string().contains("nested more than 64 deep"));
    // Some editors write a byte order mark; Windows ends lines with two characters.
    let text = fs::read_to_string(QUICKSTART).unwrap().replace('\n', "\r\n");
    fs::write(&path, format!("\u{feff}{text}")).unwrap();
    assert!(Scenario::load(&path).is_ok());
    fs::write(&path, format!("\u{feff}{}", text.replace("\"slider\", \"x\"", "\"slyder\", \"x\""))).unwrap();
    let error = Scenario::load(&path).unwrap_err();
    assert_eq!(error.excerpt.as_ref().map(|e| (e.line, e.column)), Some((21, 22)));
    assert!(!error.to_string().contains('\r'));
}

#[test]
fn markers_count_characters_not_bytes() {
    let text = "{ \"stickslip\": 1, \"title\": \"µµµ\", \"run\": { \"duration\": \"5 µm\" } }";
    let error = Scenario::from_str(text, "t.json", "").unwrap_err();
    let excerpt = error.excerpt.clone().unwrap();
    assert_eq!(excerpt.column, text.chars().position(|c| c == '5').unwrap());
    assert_eq!(excerpt.marker.len(), "\"5 µm\"".chars().count());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Replaces every value of a scenario by every other kind of value.
    #[test]
    fn an_override_of_anything_never_panics(path in path(), value in value()) {
        for text in [FULL, PLANAR] {
            let scenario = Scenario::from_str_with(text, "good.json", "tests/good", &[(&path, &value)]);
            // An accepted scenario gives a model, or an error with a position in the file.
            let Ok(scenario) = scenario else { continue };
            let model = Model::new(&scenario.scene).and_then(|model| model.start(&scenario.plan));
            if let Err(error) = model {
                let error = scenario.refusal(&error);
                prop_assert!(error.excerpt.is_some(), "{}", error);
            }
        }
    }
}

fn path() -> impl Strategy<Value = String> {
    let step = prop::sample::select(vec![
        "contacts",
        "ball",
        "sphere",
        "friction",
        "normal",
        "force",
        "bodies",
        "slider",
        "x",
        "follows",
        "run",
        "stepper",
        "event",
        "loads[0]",
        "loads[1]",
        "waveforms",
        "saw",
        "sawtooth",
        "period",
        "tab",
        "table",
        "points[0]",
        "points",
        "output",
        "figures",
        "waveform",
        "gravity",
        "materials",
        "start",
        "z",
        "pitch",
        "inertia",
        "at",
        "gap",
        "damping",
        "loads[2]",
        "springs",
        "press",
    ]);
    prop::collection::vec(step, 1..5).prop_map(|steps| steps.join("."))
}

fn value() -> impl Strategy<Value = String> {
    let value = prop::sample::select(vec![
        "0",
        "-1",
        "1e300",
        "1e-300",
        "5 um",
        "5 N",
        "3 mrad",
        "free",
        "coupled",
        "fixed",
        "saw",
        "{}",
        "[]",
        "[1, 2]",
        "true",
        "null",
        "",
        "{\"follows\": \"saw\"}",
        "{\"follows\": {\"sine\": {\"amplitude\": 1, \"period\": 1}}}",
        "{\"sine\": {}}",
        "\"",
        "{\"sphere\": {\"radius\": 1e-300}}",
        "{\"force\": 1e300}",
        "{\"a\": {\"a\": 1, \"a\": 2}}",
    ]);
    value.prop_map(str::to_owned)
}

/// Units in column headers must be applied: 1.3 µm must not become 1.3 m.
#[test]
fn units_in_the_heads_of_a_table_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let points = |head: &str, time: &str, value: &str| {
        fs::write(folder.path().join("t.csv"), format!("{head}\n0,0\n10,1.3\n20,-0.7e-1\n")).unwrap();
        let text = format!(
            r#"{{"stickslip":1,"waveforms":{{"w":{{"table":{{"file":"t.csv","time":"{time}","value":"{value}"}}}}}},
                "bodies":{{"foot":{{"x":{{"follows":"w"}}}}}},"run":{{"duration":1}}}}"#
        );
        let scenario =
            Scenario::from_str(&text, "t", folder.path()).unwrap_or_else(|error| panic!("{error}"));
        match scenario.scene.waveforms[0].part.shape() {
            Shape::Table { points } => points.clone(),
            other => panic!("{other:?}"),
        }
    };
    let micro = [(0.0, 0.0), (10e-3, 1.3e-6), (20e-3, -0.7e-7)];
    for (head, time, value) in [
        ("t [ms],disp (µm)", "t [ms]", "disp (µm)"),
        ("t [ms],disp (µm)", "t", "disp"),
        ("time/ms,disp_um", "time/ms", "disp_um"),
        ("time / ms,disp [um]", "time", "disp"),
    ] {
        assert_eq!(points(head, time, value), micro, "{head}");
    }
    let si = [(0.0, 0.0), (10.0, 1.3), (20.0, -0.07)];
    for head in ["t,disp", "time_s,disp_m", "t (s),disp (m)"] {
        let (time, value) = head.split_once(',').unwrap();
        assert_eq!(points(head, time, value), si, "{head}");
    }
    // A full header takes precedence over a name without a unit.
    assert_eq!(points("t [ms],t", "t [ms]", "t")[1], (10e-3, 1.3));
}

/// A column in volts is a voltage that a stack may follow, here with 4.6 µm/120 V. A body cannot follow it.
#[test]
fn a_column_of_volts_is_a_voltage() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("u.csv"), "t [ms],U [V]\n0,0\n10,60\n").unwrap();
    let table = r#"{ "table": { "file": "u.csv", "time": "t", "value": "U" } }"#;
    let sine = r#"{ "sine": { "amplitude": "40 V", "offset": "40 V", "period": "10 ms" } }"#;
    let text = fs::read_to_string("tests/odd/window_cuts.json").unwrap();
    assert!(text.contains(sine));
    let text = text.replace(sine, table);
    let base = folder.path().to_str().unwrap();
    let scenario = Scenario::from_str(&text, "volts.json", base).unwrap();
    assert_eq!(scenario.warnings, []);
    let Shape::Table { points } = scenario.scene.waveforms[0].part.shape() else { panic!("no table") };
    assert_eq!(points[1].0, 10e-3);
    assert!((points[1].1 / (60.0 * 4.6e-6 / 120.0) - 1.0).abs() < 1e-15);
    let moved = text
        .replace(r#""foot":   { "mass": "5 g", "x": "free" }"#, r#""foot": { "x": { "follows": "drive" } }"#);
    assert!(moved != text && Scenario::from_str(&moved, "moved.json", base).is_err());
}

/// An equilibrium in which only rounding errors act on a body must be found, for a range of radii.
#[test]
fn an_equilibrium_is_not_refused_for_rounding() {
    let beside = (0..40).map(|k| 2e-3 * (1.0 + f64::from(k) * 2.75e-6));
    for radius in [0.002_000_122_070_312_5, 0.002_000_22].into_iter().chain(beside) {
        let radius = format!("{radius:e}");
        let set = [("contacts.front.profile.paraboloid.radius", radius.as_str())];
        let read = Scenario::load_with("../../scenarios/impact_drive.json", &set);
        let scenario = read.unwrap_or_else(|error| panic!("{error}"));
        let begun = Model::new(&scenario.scene).and_then(|model| model.start(&scenario.plan));
        assert!(begun.is_ok(), "{radius}: {:?}", begun.err());
    }
}

/// Tables of an oscilloscope, of a logger and in plain form give the same motion. The tables have units in the second header line,
/// semicolons and decimal commas, and a recipe in a file.
#[test]
fn tables_of_instruments_are_the_plain_ones() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("plain.csv", "t (ms),x (um)\n0,0\n1,0.5\n2,0\n");
    write("scope.csv", "x-axis,1\nms,um\n0.0,0.0\n1.0,0.5\n2.0,0.0\n");
    write("logger.csv", "Messung 7;\n\nZeit [ms];Weg [um]\n0,0;0,0\n1,0;0,5\n2,0;0,0\n");
    write("bare.dat", "0 0\n1 50\n2 0\n");
    write(
        "recipe.json",
        r#"{"columns": {"time": {"column": 1, "unit": "ms"}, "displacement": {"column": 2, "unit": "nm", "gain": 10}}}"#,
    );
    let read = |table: &str| {
        let text = format!(
            r#"{{ "stickslip": 1, "waveforms": {{ "w": {{ "table": {table} }} }}, "bodies": {{ "rig": {{ "x": {{ "follows": "w" }} }} }},
                "contacts": {{ "c": {{ "between": ["rig", "ground"], "materials": ["steel", "steel"], "friction": 0.3,
                    "profile": {{ "sphere": {{ "radius": "1 mm" }} }}, "normal": {{ "force": "1 N" }} }} }}, "run": {{ "duration": 1 }} }}"#
        );
        Scenario::from_str(&text, "s.json", folder.path()).map(|scenario| scenario.resolved())
    };
    let plain = read(r#"{ "file": "plain.csv", "time": "t", "value": "x" }"#).unwrap();
    for table in [
        r#"{ "file": "scope.csv", "time": "x-axis", "value": "1" }"#,
        r#"{ "file": "logger.csv", "recipe": {} }"#,
        r#"{ "file": "bare.dat", "recipe": "recipe.json" }"#,
    ] {
        assert_eq!(read(table).unwrap(), plain, "{table}");
    }
    let gone = read(r#"{ "file": "bare.dat", "recipe": "gone.json" }"#).unwrap_err().to_string();
    assert!(gone.contains("there is no file \"gone.json\""), "{gone}");
    // For equidistant values, the parabola through a window is that of Savitzky and Golay 1964: (-3, 12, 17, 12, -3)/35.
    let points = "[[0, 0], [1, 1], [2, 5], [3, 2], [4, 0]]";
    let smooth: serde_json::Value =
        serde_json::from_str(&read(&format!(r#"{{ "points": {points}, "smooth": 4 }}"#)).unwrap()).unwrap();
    let middle = smooth["waveforms"]["w"]["table"]["points"][2][1].as_f64().unwrap();
    assert!((middle - (12.0 + 17.0 * 5.0 + 12.0 * 2.0) / 35.0).abs() < 1e-12, "{middle}");
}
