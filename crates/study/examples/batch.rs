//! A tolerance study of a drive: ten thousand slides of the quickstart with other balls, masses and strokes, on all cores.
//!
//! `cargo run --release -p stickslip-study --example batch`
#![allow(clippy::print_stdout, reason = "an example shows what comes out")]

use std::error::Error;
use stickslip_scenario::Scenario;
use stickslip_study::{Batch, Figure};

const QUICKSTART: &str = include_str!("../../../scenarios/quickstart.json");
const VARIANTS: usize = 10_000;

/// A number from 0 to 1 that belongs to a variant: the same on any core, in any order.
fn drawn(variant: usize, number: u32) -> f64 {
    (variant as f64 * f64::from(number).sqrt()).fract()
}

fn main() -> Result<(), Box<dyn Error>> {
    let scenario = Scenario::from_str(QUICKSTART, "quickstart", "")?;
    let mut batch = Batch::of(&scenario)?;
    batch
        .vary("bodies.slider.mass")?
        .vary("contacts.ball.friction")?
        .vary("waveforms.drive.sawtooth.stroke")?;
    batch.tell(Figure::End("slider.x_m".to_owned()))?;
    batch.tell(Figure::Step { channel: "slider.x_m".to_owned(), waveform: 0 })?;
    let base: Vec<f64> = batch.numbers().collect();
    let within = |number: u32, spread: f64, variant| 1.0 + spread * (2.0 * drawn(variant, number) - 1.0);
    let lines = batch.run(
        VARIANTS,
        |variant, numbers| {
            numbers[0] = base[0] * within(2, 0.02, variant);
            numbers[1] = base[1] * within(3, 0.20, variant);
            numbers[2] = base[2] * within(5, 0.05, variant);
        },
        // Every few lines, on this thread: `false` stops the batch.
        |done| {
            if done % 2000 < 32 {
                println!("{done} done");
            }
            true
        },
    );
    let mut steps: Vec<f64> =
        lines.iter().filter(|line| line.end.is_ok()).map(|line| line.figures[1]).collect();
    steps.sort_unstable_by(f64::total_cmp);
    let part = |share: f64| 1e9 * steps[(share * (steps.len() - 1) as f64) as usize];
    println!("{} of {VARIANTS} came to their end", steps.len());
    println!(
        "step: {:.2} nm in the median, nine in ten from {:.2} to {:.2} nm",
        part(0.5),
        part(0.05),
        part(0.95)
    );
    Ok(())
}
