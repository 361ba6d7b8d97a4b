//! Evaluates a hysteresis block with ten plays; the first argument is the number of evaluations.
//!
//! The cost of one evaluation follows from two instruction counts, for example by `valgrind --tool=callgrind` with 0 and 1000000.

use std::error::Error;
use std::hint::black_box;
use stickslip_drive::Sample;
use stickslip_drive::component::{Block, Moment, Standing};
use stickslip_piezo::Reading;
use stickslip_piezo::hysteresis::{PlayBlock, Plays};

fn main() -> Result<(), Box<dyn Error>> {
    let count: u64 = std::env::args().nth(1).unwrap_or_default().parse()?;
    let reading = Reading { signal: 0, span: 1.0, swings: 1.0, turns: 1.0, column: "stroke_m" };
    let plays = Plays::of_loop(0.12, 1.0, 10)?;
    let memory = plays.start(0.3);
    let block: Box<dyn Block> = Box::new(PlayBlock::new(plays, reading));
    let (mut sum, mut slopes, mut efforts): (f64, [f64; 0], _) = (0.0, [], [0.0; 8]);
    for k in 0..count {
        let inputs = [Sample { value: black_box(0.3), rate: 1.0, acceleration: 0.0 }];
        let (law, at): (_, Moment<[Sample]>) = (
            black_box(2 * (k as usize % 11)),
            Moment { t: 0.0, inputs: &inputs[..], states: &[], located: true },
        );
        let standing = Standing { law: &law, memory: &memory };
        let block: &dyn Block = black_box(&*block);
        // A time step evaluates slopes and signal.
        block.slopes(standing, &at, &mut slopes, &mut efforts);
        sum += block.signal(standing, &at).value;
    }
    black_box(sum);
    Ok(())
}
