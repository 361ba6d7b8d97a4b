//! Variants of a scene by the thousand: how many a second, and where their instructions go.
//!
//! `batch COUNT CORES FILE.json KEY=VALUE…` runs so many variants of a scene whose first body with a mass, first coefficient of
//! friction and first waveform vary, and prints the time. Without arguments 10 000 of P1 at 1e-6 on one core and on two, and whether
//! both tell the same. `batch phases FILE.json KEY=VALUE…` does by hand what a user of the library did before there were batches, for
//! a profiler: reading, model, start, workspace and run, each a function of its own, beside the same variants in one room
//! (`valgrind --tool=callgrind BINARY phases …`, `callgrind_annotate --inclusive=yes`).
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark prints, and fails by panicking")]

use std::time::Instant;
use stickslip_drive::{Model, Plan, Run, Scene, State, Variants};
use stickslip_scenario::Scenario;
use stickslip_study::{Batch, Figure, Lines};

/// What is set, as pairs of key path and value.
type Settings = Vec<(String, String)>;

/// Variants that a profiler counts.
const COUNTED: u32 = 10;

#[inline(never)]
fn read(file: &str, set: &Settings) -> Scenario {
    let set: Vec<(&str, &str)> = set.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    let mut scenario = Scenario::load_with(file, &set).unwrap();
    scenario.plan.every = None;
    scenario
}

#[inline(never)]
fn assemble(scene: &Scene) -> Model {
    Model::new(scene).unwrap()
}

#[inline(never)]
fn start(model: &Model, plan: &Plan) -> State {
    model.start(plan).unwrap()
}

#[inline(never)]
fn make_room<'m>(model: &'m Model, plan: &Plan, state: State) -> Run<'m> {
    Run::new(model, plan, state).unwrap()
}

#[inline(never)]
fn go(run: &mut Run<'_>) {
    run.finish(&mut ()).unwrap();
}

#[inline(never)]
fn in_one_room(variants: &mut Variants, scene: &Scene, plan: &Plan) {
    variants.run(scene, plan, &mut ()).unwrap();
}

fn phases(file: &str, set: &Settings) {
    let mut scenario = read(file, set);
    let mut variants = Variants::new();
    in_one_room(&mut variants, &scenario.scene, &scenario.plan);
    for _ in 0..COUNTED {
        let masses = scenario.scene.bodies.iter_mut().filter_map(|body| body.part.mass.as_mut());
        masses.for_each(|mass| *mass *= 1.001);
        in_one_room(&mut variants, &scenario.scene, &scenario.plan);
        let model = assemble(&scenario.scene);
        let state = start(&model, &scenario.plan);
        let mut run = make_room(&model, &scenario.plan, state);
        go(&mut run);
        assert_eq!(run.state(), variants.state(), "both do the same");
    }
}

/// Mass, friction and stroke within a few per cent, by the place of the variant.
fn batch(scenario: &Scenario, cores: usize, count: usize) -> (Lines, f64) {
    let mut batch = Batch::of(scenario).unwrap();
    let scene = &scenario.scene;
    let body = scene.bodies.iter().find(|body| body.part.is_free()).unwrap();
    batch.vary(&format!("bodies.{}.mass", body.name)).unwrap();
    batch.vary(&format!("contacts.{}.friction", scene.contacts[0].name)).unwrap();
    let stroke = scene.waveforms.first().map(|named| format!("waveforms.{}.sawtooth.stroke", named.name));
    let varies_stroke = stroke.is_some_and(|path| batch.vary(&path).is_ok());
    batch.tell(Figure::End(format!("{}.x_m", body.name))).unwrap();
    batch.on(cores);
    let base: Vec<f64> = batch.numbers().collect();
    let begun = Instant::now();
    let lines = batch.run(
        count,
        |i, numbers| {
            let part = |k: f64| 0.95 + 0.1 * (k * i as f64 * 0.618_033_988_749_894_9).fract();
            (numbers[0], numbers[1]) = (base[0] * part(1.0), base[1] * part(2.0));
            if varies_stroke {
                numbers[2] = base[2] * part(3.0);
            }
        },
        |_| true,
    );
    (lines, begun.elapsed().as_secs_f64())
}

fn report(count: usize, cores: usize, (lines, took): &(Lines, f64)) {
    let failed = lines.iter().filter(|line| line.end.is_err()).count();
    println!(
        "{count} variants on {cores} cores: {took:.3} s, {:.0} a second and core, {failed} failed",
        count as f64 / took / cores as f64
    );
}

fn main() {
    // Cargo's own arguments begin with dashes.
    let asked: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let (set, asked): (Vec<String>, Vec<String>) = asked.into_iter().partition(|a| a.contains('='));
    let pair = |set: &String| set.split_once('=').map(|(path, value)| (path.to_owned(), value.to_owned()));
    let mut set: Settings = set.iter().filter_map(pair).collect();
    let p1 = format!("{}/../../scenarios/p1.json", env!("CARGO_MANIFEST_DIR"));
    match asked.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["phases", file] => phases(file, &set),
        [count, cores, file] => {
            let (count, cores) = (count.parse().unwrap(), cores.parse().unwrap());
            report(count, cores, &batch(&read(file, &set), cores, count));
        }
        _ => {
            set.push(("run.stepper.event.tolerance".to_owned(), "1e-6".to_owned()));
            let scenario = read(&p1, &set);
            let [one, two] = [1, 2].map(|cores| batch(&scenario, cores, 10_000));
            [(1, &one), (2, &two)].into_iter().for_each(|(cores, run)| report(10_000, cores, run));
            assert_eq!(one.0.to_string(), two.0.to_string(), "the same on one core and on two");
        }
    }
}
