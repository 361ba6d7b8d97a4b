//! Test of inverse compensation: inverses and models in series return the input.

use super::parts::{PERIOD, SPAN, column, event, every, reading, scene, shared, table, trace};
use stickslip_drive::component::SharedBlock;
use stickslip_drive::scene::Named;
use stickslip_drive::{Harmonic, Shape, Waveform};
use stickslip_piezo::creep::{Creep, CreepBlock};
use stickslip_piezo::hysteresis::{PlayBlock, Plays};

fn plays() -> Plays {
    Plays::of_loop(0.15, SPAN, 10).unwrap()
}

fn creep() -> Creep {
    Creep::new(0.02, 1e-4, 3).unwrap()
}

/// Inverses in reverse order, followed by the models of the stack.
fn chain() -> Vec<Named<SharedBlock>> {
    vec![
        shared("uncreep", CreepBlock::inverse(creep(), reading(0))),
        shared("unplay", PlayBlock::new(plays().inverse(), reading(1))),
        shared("plays", PlayBlock::new(plays(), reading(2))),
        shared("creep", CreepBlock::new(creep(), reading(3))),
    ]
}

fn left(wave: &Waveform, duration: f64) -> (f64, f64) {
    let bare = vec![
        shared("plays", PlayBlock::new(plays(), reading(0))),
        shared("creep", CreepBlock::new(creep(), reading(1))),
    ];
    let rows = |blocks: Vec<Named<SharedBlock>>, name: &str| {
        let scene = scene(wave.clone(), blocks);
        let (model, _, trace) = trace(&scene, &event(duration), PERIOD / 711.3);
        let t = column(&model, &trace, "time_s");
        let y = column(&model, &trace, name);
        t.into_iter().zip(y).collect::<Vec<_>>()
    };
    let off = |rows: &[(f64, f64)]| {
        let asked = |t: f64| wave.sample(&wave.piece_at(t), t).value;
        rows.iter().map(|(t, y)| (y - asked(*t)).abs()).fold(0.0, f64::max)
    };
    (off(&rows(chain(), "foot.x_m")), off(&rows(bare, "foot.x_m")))
}

#[test]
fn the_inverses_leave_less_than_a_billionth_of_the_stroke() {
    let term = |amplitude, order, phase| Harmonic { amplitude, order, phase };
    let waves = [
        every(Shape::Harmonics { terms: vec![term(0.3 * SPAN, 1.0, 0.4), term(0.25 * SPAN, 5.0, 1.0)] }),
        every(Shape::Sawtooth { stroke: SPAN, flyback: 0.02 * PERIOD }),
        table(&[(0.0, 0.0), (0.4, 0.9), (0.4, 0.1), (0.9, 0.6), (1.3, 0.6), (1.3, 0.2), (3.0, 0.8)]),
    ];
    for (k, wave) in waves.into_iter().enumerate() {
        let (left, without) = left(&wave, 2.5 * PERIOD);
        assert!(left < 1e-9 * SPAN, "{k}: {left}");
        assert!(without > 0.02 * SPAN, "{k}: {without}");
    }
}
