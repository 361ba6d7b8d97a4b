//! What the variation of a run costs beside the run itself, in instructions.
//!
//! `gradient plain FILE.json KEY=VALUE…` runs a scene, `gradient varied FILE.json KEY=VALUE… PATH…` leads numbers of it along, each a
//! function of its own for a profiler:
//!
//! `valgrind --tool=callgrind --toggle-collect='gradient::plain' BINARY plain FILE.json`
//!
//! Without arguments the ratio of their times, for the drives of `docs/numerics.md`, "Variations", by four numbers at 1e-12.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark prints, and fails by panicking")]

use std::hint::black_box;
use std::time::Instant;
use stickslip_drive::{Model, Parameter, Plan, Run};
use stickslip_scenario::Scenario;

/// What is set, as pairs of key path and value.
type Settings = Vec<(String, String)>;

/// A scene as it is run, and how numbers move it.
struct Case {
    model: Model,
    plan: Plan,
    parameters: Vec<Parameter>,
}

/// How far models are beside a number's value, as a share of it.
const SHARE: f64 = 5e-5;
/// Drives and the numbers by which they are led.
const DRIVES: [(&str, [&str; 4]); 4] = [
    ("p1", ["bodies.slider.mass", "contacts.ball.friction", "contacts.ball.normal.force", STROKE]),
    (
        "sine_drive",
        [
            "bodies.slider.mass",
            "contacts.ball.friction",
            "waveforms.drive.sine.amplitude",
            "waveforms.press.sine.amplitude",
        ],
    ),
    ("three_ball_stage", ["bodies.stage.mass", "contacts.front.friction", "bodies.stage.inertia", STROKE]),
    ("ruby_drive", ["bodies.slider.mass", "contacts.ball.friction", "contacts.ball.normal.force", STROKE]),
];
const STROKE: &str = "waveforms.drive.sawtooth.stroke";
/// Turns, of which the shortest counts.
const TURNS: usize = 5;

fn load(file: &str, set: &Settings) -> Scenario {
    let set: Vec<(&str, &str)> = set.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    Scenario::load_with(file, &set).unwrap()
}

impl Case {
    fn new(file: &str, set: &Settings, paths: &[&str]) -> Self {
        let scenario = load(file, set);
        let model = |scenario: &Scenario| Model::new(&scenario.scene).unwrap();
        let own = model(&scenario);
        let parameter = |path: &&str| {
            let number = scenario.parameter(path).unwrap();
            let value = number.value.unwrap();
            let beside = [-2.0, -1.0, 1.0, 2.0].map(|k| {
                let mut set = set.clone();
                set.push(((*path).to_owned(), format!("{:e} {}", value * (1.0 + k * SHARE), number.unit)));
                model(&load(file, &set))
            });
            Parameter::new(&own, beside, SHARE).unwrap()
        };
        let parameters = paths.iter().map(parameter).collect();
        let plan = Plan { every: None, ..scenario.plan };
        Self { model: own, plan, parameters }
    }

    fn begun(&self) -> Run<'_> {
        let start = self.model.start(&self.plan).unwrap();
        Run::new(&self.model, &self.plan, start).unwrap()
    }
}

#[inline(never)]
fn plain(case: &Case) {
    let mut run = case.begun();
    run.advance(case.plan.duration, &mut ()).unwrap();
    black_box(run.state());
}

#[inline(never)]
fn varied(case: &Case) {
    let mut run = case.begun();
    let mut variation = case.model.variation((&case.plan, run.state()), &case.parameters).unwrap();
    run.advance(case.plan.duration, &mut variation).unwrap();
    run.stop(&mut ());
    variation.finish(run.state()).unwrap();
    black_box(variation.count());
}

/// Shortest of some turns, s.
fn time(of: impl Fn()) -> f64 {
    let turn = |_| {
        let begun = Instant::now();
        of();
        begun.elapsed().as_secs_f64()
    };
    (0..TURNS).map(turn).fold(f64::INFINITY, f64::min)
}

fn main() {
    // Cargo's own arguments begin with dashes.
    let asked: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let (set, asked): (Vec<String>, Vec<String>) = asked.into_iter().partition(|a| a.contains('='));
    let pair = |set: &String| set.split_once('=').map(|(path, value)| (path.to_owned(), value.to_owned()));
    let set: Settings = set.iter().filter_map(pair).collect();
    match &asked.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["plain", file] => plain(&Case::new(file, &set, &[])),
        ["varied", file, paths @ ..] => varied(&Case::new(file, &set, paths)),
        _ => {
            let set = vec![("run.stepper.event.tolerance".to_owned(), "1e-12".to_owned())];
            for (name, paths) in DRIVES {
                let file = format!("{}/../../scenarios/{name}.json", env!("CARGO_MANIFEST_DIR"));
                let case = Case::new(&file, &set, &paths);
                let [alone, led] = [time(|| plain(&case)), time(|| varied(&case))];
                println!(
                    "{name:18} {:8.2} ms alone, {:8.2} ms led, {:5.2} times",
                    1e3 * alone,
                    1e3 * led,
                    led / alone
                );
            }
        }
    }
}
