//! Overhead of the library compared with a bare loop.
//!
//! A hundred variants of the quickstart run by [`Job::run`], and by `stickslip_drive::run` with a minimal record of the same rows. Both
//! alternate in one process.
//!
//! `cargo bench -p stickslip-run --bench variants`
#![allow(clippy::print_stdout, reason = "a measurement is to be read")]

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;
use stickslip_drive::{Entry, Record};
use stickslip_run::Job;
use stickslip_scenario::Scenario;

const QUICKSTART: &str = include_str!("../../../scenarios/quickstart.json");
const VARIANTS: u32 = 100;
const TURNS: usize = 15;

/// A record of the columns that the library keeps, for rows and states after events.
struct Bare<'a> {
    places: &'a [usize],
    columns: Vec<Vec<f64>>,
}

impl Bare<'_> {
    fn keep(&mut self, values: &[f64]) {
        for (column, place) in self.columns.iter_mut().zip(self.places) {
            column.extend(values.get(*place));
        }
    }
}

impl Record for Bare<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        match entry {
            Entry::Row(values) => self.keep(values),
            Entry::Event(_, values) => self.keep(values),
            _ => {}
        }
    }
}

fn variant(number: u32) -> Result<Job, Box<dyn Error>> {
    let stroke = format!("{} nm", 50 + 10 * number);
    let overrides = [("waveforms.drive.sawtooth.stroke", stroke.as_str()), ("plots", "[]")];
    let scenario = Scenario::from_str_with(QUICKSTART, "quickstart", "", &overrides)?;
    Ok(Job::new(scenario, stroke, "".into())?)
}

/// Runs all variants in the bare loop and returns the number of stored values.
fn bare(jobs: &[Job], places: &[Vec<usize>]) -> usize {
    let run = |(job, places): (&Job, &Vec<usize>)| {
        let mut record = Bare { places, columns: vec![Vec::new(); places.len()] };
        let mut state = job.start.clone();
        let _ = black_box(stickslip_drive::run(&job.model, &job.scenario.plan, &mut state, &mut record));
        record.columns.iter().map(Vec::len).sum::<usize>()
    };
    jobs.iter().zip(places).map(run).sum()
}

/// Runs all variants by the library and returns the number of stored values.
fn library(jobs: &[Job]) -> usize {
    jobs.iter().map(|job| black_box(job.run(&())).kept.series.size() as usize).sum()
}

fn main() -> Result<(), Box<dyn Error>> {
    let jobs = (0..VARIANTS).map(variant).collect::<Result<Vec<_>, _>>()?;
    let kept = |job: &Job| {
        let series = job.run(&()).kept.series;
        let channels = job.model.channels();
        (0..channels.len()).filter(|place| series.has(&channels[*place].name)).collect::<Vec<_>>()
    };
    let places: Vec<Vec<usize>> = jobs.iter().map(kept).collect();
    assert_eq!(bare(&jobs, &places), library(&jobs), "both keep the same");
    let (mut ratios, mut best) = (Vec::new(), [f64::INFINITY; 2]);
    for _ in 0..TURNS {
        let begun = Instant::now();
        black_box(bare(&jobs, &places));
        let middle = Instant::now();
        black_box(library(&jobs));
        let times = [(middle - begun).as_secs_f64(), middle.elapsed().as_secs_f64()];
        best = [best[0].min(times[0]), best[1].min(times[1])];
        ratios.push(times[0] / times[1]);
    }
    ratios.sort_by(f64::total_cmp);
    let [bare, library] = best.map(|time| 1e3 * time / f64::from(VARIANTS));
    println!("bare loop {bare:.3} ms a run, library {library:.3} ms a run");
    println!(
        "throughput of the library over that of the bare loop: {:.3} of the best turns, {:.3} in the median of {TURNS}",
        bare / library,
        ratios[TURNS / 2]
    );
    Ok(())
}
