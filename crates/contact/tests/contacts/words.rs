//! Tests of serialization: memories and branches are restored exactly, and invalid words cause no failure.

use proptest::prelude::*;
use std::sync::Arc;
use stickslip_contact::{
    Apex, Branch, Curve, Engine, Interface, Memory, Motion, Move, Pair, Profile, Segment, Springs, Words,
};

/// Indentations of all histories, m.
const SCALE: f64 = 1e-6;

fn profile(kind: usize) -> Profile {
    let heights: Vec<f64> = (0..40).map(|i| SCALE * 0.03 * f64::from((i * 7) % 40)).collect();
    match kind {
        0 => Profile::flat(1e-4),
        1 => Profile::cone(0.01),
        2 => Profile::paraboloid(1e-3),
        3 => Profile::sphere(5e-3),
        4 => Profile::power(0.3, 1.7),
        _ => Profile::foundation(&heights, &[1e-6; 40]),
    }
    .unwrap()
}

fn laws() -> impl Strategy<Value = Interface> {
    let frictions = prop::sample::select(vec![0.0, 0.01, 0.15, 1.0, 1000.0]);
    (0usize..6, frictions).prop_map(|(kind, friction)| {
        Interface::new(Pair::from_moduli(1.15e11, 0.95e11).unwrap(), profile(kind), friction).unwrap()
    })
}

/// Both engines for an interface.
fn engines(law: &Interface) -> [Engine; 2] {
    let span = 2.0 * law.profile().radius(3.0 * SCALE).max(1e-4);
    [Engine::Curve, Engine::Row(Arc::new(Springs::new(law.profile(), 37, span).unwrap()))]
}

/// Moves: a kind and a target.
type Throws = Vec<(u8, f64, f64)>;

fn throws() -> impl Strategy<Value = Throws> {
    prop::collection::vec((0u8..6, -1.0..1.0, -1.0..1.0), 0..60)
}

/// One move of a history.
fn segment(law: &Interface, memory: &Memory, (kind, x, y): (u8, f64, f64)) -> Segment {
    let (at, slide) = (memory.apex(), 2.0 * law.stick_slope() * SCALE);
    let to = match kind {
        0 => Apex { d: SCALE * x, u: slide * y },
        1 | 2 => Apex { u: slide * y, ..at },
        3 => Apex { d: SCALE * x.abs(), ..at },
        _ => Apex { d: at.d.max(0.0) + 0.3 * SCALE * x.abs(), u: at.u + 0.1 * slide * y * x.abs() },
    };
    match kind {
        4 if to.d < 2.0 * SCALE => {
            Segment::Grown { to, force: 0.1 * y, energy: 1e-9 * x.abs(), joins: x > 0.0 }
        }
        2 => Segment::Jump(to),
        _ => Segment::Straight(to),
    }
}

/// Memory after a history; moves that exceed a row are skipped.
fn remembered(law: &Interface, mut memory: Memory, throws: &Throws) -> Memory {
    for throw in throws {
        let segment = segment(law, &memory, *throw);
        let _ = memory.commit(law, segment);
    }
    memory
}

fn written(memory: &Memory) -> Vec<u64> {
    let mut words = Vec::new();
    memory.write(&mut words);
    words
}

/// Calls all methods of a memory and moves it, with merges of its stack.
fn use_it(law: &Interface, mut memory: Memory) {
    let d = memory.apex().d.clamp(-SCALE, SCALE);
    memory.shift(1e-9);
    for k in 0..30 {
        let to = Apex { d: d + 0.01 * SCALE * f64::from(k % 7 - 3), u: 1e-8 * f64::from((k * 11) % 17 - 8) };
        memory.trial(law, Move::Chord(to));
        memory.preview(law, to);
        memory.course(law, to.d, -1.0, 1.0);
        if let Some(branching) = memory.branching() {
            for sense in [1.0, -1.0] {
                let branch = branching.branch(law, sense, 0.0);
                branch.force(law, to.d, to.u, law.profile().reduced_force(to.d));
                branch.drag(law, &Motion { d: to.d, u: to.u, dd: 1.0, du: -1.0 }, 0.0);
                branching.beside(to);
                if memory.apex().d > 0.0 {
                    branching.dragged(law, sense, to);
                }
            }
        }
        let _ = memory.commit(law, Segment::Straight(to));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_read_is_what_was_written(law in laws(), throws in throws(), more in throws()) {
        for engine in engines(&law) {
            let memory = remembered(&law, engine.memory(&law, Apex { d: 0.5 * SCALE, u: 0.0 }), &throws);
            let mut words = written(&memory);
            words.push(17);
            let mut reader = Words::new(&words);
            let read = Memory::read(&law, &engine, &mut reader).unwrap();
            prop_assert!(read == memory && reader.left() == 1);
            prop_assert_eq!(&written(&read)[..], &words[..words.len() - 1]);
            // The restored memory gives identical results for further moves.
            let (there, here) = (remembered(&law, read, &more), remembered(&law, memory, &more));
            prop_assert_eq!(written(&there), written(&here));
        }
    }

    #[test]
    fn a_stack_of_its_own_size_keeps_it(law in laws(), throws in throws()) {
        let small = Memory::Curve(Curve::with_capacity(&law, Apex { d: SCALE, u: 0.0 }, 8));
        let memory = remembered(&law, small, &throws);
        let words = written(&memory);
        prop_assert_eq!(Memory::read(&law, &Engine::Curve, &mut Words::new(&words)), Some(memory));
    }

    #[test]
    fn branches_are_read_as_they_were_written(law in laws(), throws in throws(), slack in 0.0..1e-9) {
        let memory = remembered(&law, Engine::Curve.memory(&law, Apex { d: 0.5 * SCALE, u: 0.0 }), &throws);
        for sense in [1.0, -1.0] {
            let branch = memory.branching().unwrap().branch(&law, sense, slack);
            let mut words = Vec::new();
            branch.write(&mut words);
            let mut reader = Words::new(&words);
            prop_assert_eq!(Branch::read(&law, &mut reader), Some(branch));
            prop_assert!(reader.is_empty());
            for cut in 0..words.len() {
                prop_assert_eq!(Branch::read(&law, &mut Words::new(&words[..cut])), None);
            }
        }
    }

    #[test]
    fn words_cut_short_are_no_memory(law in laws(), throws in throws(), part in 0.0..1.0) {
        for engine in engines(&law) {
            let words = written(&remembered(&law, engine.memory(&law, Apex { d: SCALE, u: 0.0 }), &throws));
            let cut = (part * words.len() as f64) as usize;
            prop_assert_eq!(Memory::read(&law, &engine, &mut Words::new(&words[..cut])), None);
        }
    }

    #[test]
    fn no_words_make_a_memory_that_stumbles(
        law in laws(),
        throws in throws(),
        slips in prop::collection::vec((any::<prop::sample::Index>(), any::<u64>(), 0u8..6), 1..4),
    ) {
        for engine in engines(&law) {
            let mut words = written(&remembered(&law, engine.memory(&law, Apex { d: SCALE, u: 0.0 }), &throws));
            for (place, word, kind) in &slips {
                let place = place.index(words.len());
                words[place] = match kind {
                    0 => *word,
                    1 => words[place].wrapping_add(1),
                    2 => (SCALE * (*word as f64 / u64::MAX as f64)).to_bits(),
                    3 => words[place] ^ 1 << 63,
                    4 => word % 20,
                    _ => (-1.0_f64).to_bits(),
                };
            }
            for engine in engines(&law) {
                if let Some(memory) = Memory::read(&law, &engine, &mut Words::new(&words)) {
                    use_it(&law, memory);
                }
            }
        }
    }

    #[test]
    fn random_words_are_no_trouble(law in laws(), words in prop::collection::vec(any::<u64>(), 0..40), tag in 0u64..2) {
        let words = [&[tag], &words[..]].concat();
        for engine in engines(&law) {
            if let Some(memory) = Memory::read(&law, &engine, &mut Words::new(&words)) {
                use_it(&law, memory);
            }
            let _ = Branch::read(&law, &mut Words::new(&words));
        }
    }
}
