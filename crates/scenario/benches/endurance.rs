//! Runs the benchmark drive P1 for a million periods, or for the number of periods given as `-- 1000000`. The benchmark prints the spread
//! of the step lengths, the error of the energy balance and the memory use.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark prints, and fails by panicking")]

use stickslip_drive::{Channel, Entry, Model, Record, Wants, run};
use stickslip_scenario::Scenario;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/p1.json");
/// Period of P1, s.
const PERIOD: f64 = 1e-3;
/// Number of periods before the step length is steady.
const SETTLED: u64 = 10;

/// Recorder that reads the slider position at the end of each period and keeps only extremes of the step length.
struct Watcher {
    columns: [usize; 3],
    period: u64,
    last: f64,
    least: f64,
    most: f64,
    /// Input energy and error of the energy balance at the end, J.
    books: [f64; 2],
    resident: Vec<u64>,
    every: u64,
}

impl Record for Watcher {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Row(values) = entry {
            let [x, input, error] = self.columns.map(|column| values[column]);
            let step = x - self.last;
            if self.period > SETTLED {
                (self.least, self.most) = (self.least.min(step), self.most.max(step));
            }
            (self.last, self.books) = (x, [input, error]);
            if self.period % self.every == self.every / 2 {
                self.resident.push(resident());
            }
            self.period += 1;
        }
    }

    fn wants(&self) -> Wants {
        Wants::no_events()
    }
}

/// Returns the resident memory of this process, kB, or 0 if the system does not report it.
fn resident() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|line| line.trim().trim_end_matches("kB").trim().parse().ok()).unwrap_or(0)
}

fn main() {
    let periods: u64 = std::env::args().filter_map(|a| a.parse().ok()).next().unwrap_or(1_000_000);
    let cycles = periods.to_string();
    let set = [("run.cycles", cycles.as_str()), ("run.stepper.event.tolerance", "1e-8")];
    let mut scenario = Scenario::load_with(FILE, &set).unwrap();
    scenario.plan.every = Some(PERIOD);
    let model = Model::new(&scenario.scene).unwrap();
    let mut state = model.start(&scenario.plan).unwrap();
    let names: Vec<Channel> = model.channels();
    let column = |name: &str| names.iter().position(|channel| channel.name == name).unwrap();
    let columns = ["slider.x_m", "energy.input_J", "energy.error_J"].map(column);
    let mut watcher = Watcher {
        columns,
        period: 0,
        last: 0.0,
        least: f64::INFINITY,
        most: f64::NEG_INFINITY,
        books: [0.0; 2],
        resident: Vec::with_capacity(16),
        every: (periods / 10).max(1),
    };
    let begun = std::time::Instant::now();
    run(&model, &scenario.plan, &mut state, &mut watcher).unwrap();
    let took = begun.elapsed().as_secs_f64();
    let mean = 0.5 * (watcher.least + watcher.most);
    let [input, error] = watcher.books;
    println!("{periods} periods, {took:.1} s of wall time, x = {:.6} m", watcher.last);
    println!(
        "  steps {:.9} nm, from the tenth on within {:.2e} of it",
        1e9 * mean,
        (watcher.most - watcher.least) / mean
    );
    println!("  energy put in {input:.6e} J, missing {:.2e} of it", error / input);
    println!("  resident memory, kB: {:?}", watcher.resident);
}
