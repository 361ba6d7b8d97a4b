use super::*;
use crate::plant::{Feed, Takes};
use crate::wire::{Stamp, encode, length};

const SCENARIO: u64 = 42;
const A: Client = Client::Writer(1);
const B: Client = Client::Writer(2);

fn intake(silence: Silence) -> Intake {
    let input = |name: &str, initial| Input {
        name: name.to_owned(),
        unit: "",
        initial,
        takes: Takes::Range(-1.0, 1.0),
        feed: Feed::Hold(0),
    };
    let patience = Patience { silence, silent_after: 3, owner: 2 };
    Intake::new(SCENARIO, &[input("a", 0.25), input("b", 0.5)], patience)
}

fn packet(sequence: u64, values: &[f64]) -> Vec<u8> {
    let mut bytes = vec![0; length(values.len())];
    encode(&mut bytes, SCENARIO, Stamp { sequence, time: 0.0 }, values);
    bytes
}

#[test]
fn whatever_is_wrong_is_refused_counted_and_changes_nothing() {
    let mut intake = intake(Silence::Hold);
    intake.offer(A, &packet(5, &[0.1, 0.2]));
    intake.settle().unwrap();
    let mut other = packet(6, &[0.9, 0.9]);
    other[8] ^= 1;
    let mut late = packet(6, &[0.9, 0.9]);
    late[24..32].copy_from_slice(&f64::NAN.to_le_bytes());
    for wrong in [
        b"GET / HTTP/1.1".to_vec(),
        packet(6, &[0.9]),
        packet(6, &[0.9, 0.9, 0.9]),
        Vec::new(),
        other,
        packet(5, &[0.9, 0.9]),
        packet(4, &[0.9, 0.9]),
        packet(6, &[0.9, f64::NAN]),
        packet(6, &[0.9, f64::INFINITY]),
        packet(6, &[1.000_000_1, 0.9]),
        late,
    ] {
        intake.offer(A, &wrong);
    }
    intake.settle().unwrap();
    assert_eq!(intake.values(), [0.1, 0.2]);
    let expected = Received {
        good: 1,
        wrong_length: 3,
        foreign: 1,
        other_scenario: 1,
        repeated: 1,
        out_of_order: 1,
        out_of_range: 4,
        stale_frames: 1,
        most_stale: 1,
        owners: 1,
        ..Received::default()
    };
    assert_eq!(*intake.received(), expected);
}

#[test]
fn of_several_packets_in_a_frame_the_last_counts() {
    let mut intake = intake(Silence::Hold);
    (1..=4).for_each(|k| intake.offer(A, &packet(k, &[0.1 * k as f64, 0.0])));
    intake.settle().unwrap();
    assert_eq!((intake.values()[0], intake.received().superseded), (0.1 * 4.0, 3));
}

#[test]
fn the_first_client_has_the_inputs_until_it_has_been_silent() {
    let mut intake = intake(Silence::Hold);
    intake.offer(A, &packet(100, &[0.1, 0.1]));
    intake.offer(B, &packet(1, &[0.2, 0.2]));
    intake.settle().unwrap();
    // The patience is two stale frames.
    intake.settle().unwrap();
    intake.offer(B, &packet(2, &[0.2, 0.2]));
    intake.settle().unwrap();
    assert_eq!((intake.values()[0], intake.received().other_client, intake.owner()), (0.1, 2, Some(A)));
    // The first accepted packet takes over, whatever its number. Then the other client is refused.
    intake.offer(B, &packet(3, &[0.3, 0.3]));
    intake.offer(A, &packet(101, &[0.1, 0.1]));
    intake.settle().unwrap();
    assert_eq!((intake.values()[0], intake.owner()), (0.3, Some(B)));
    assert_eq!((intake.received().owners, intake.received().other_client), (2, 3));
}

#[test]
fn a_client_that_begins_anew_is_let_in_after_the_patience() {
    let mut intake = intake(Silence::Hold);
    intake.offer(A, &packet(100, &[0.1, 0.1]));
    for _ in 0..3 {
        intake.settle().unwrap();
        intake.offer(A, &packet(1, &[0.2, 0.2]));
    }
    intake.settle().unwrap();
    let received = intake.received();
    assert_eq!((received.out_of_order, received.owners, intake.values()[0]), (2, 2, 0.2));
}

#[test]
fn silence_holds_goes_back_or_ends() {
    for silence in [Silence::Hold, Silence::Initial, Silence::Stop] {
        let mut intake = intake(silence);
        intake.offer(A, &packet(1, &[0.9, 0.9]));
        intake.settle().unwrap();
        for _ in 0..2 {
            intake.settle().unwrap();
            assert_eq!(intake.values(), [0.9, 0.9]);
        }
        let third = intake.settle();
        assert_eq!(third.is_err(), silence == Silence::Stop);
        let expected = if silence == Silence::Initial { [0.25, 0.5] } else { [0.9, 0.9] };
        assert_eq!((intake.values(), intake.received().silences), (&expected[..], 1));
        // The next accepted packet ends the silence.
        intake.offer(A, &packet(2, &[0.3, 0.4]));
        intake.settle().unwrap();
        assert_eq!(intake.values(), [0.3, 0.4]);
    }
}

#[test]
fn a_scene_without_inputs_is_never_stale() {
    let patience = Patience { silence: Silence::Stop, silent_after: 1, owner: 1 };
    let mut intake = Intake::new(SCENARIO, &[], patience);
    (0..5).for_each(|_| intake.settle().unwrap());
    assert_eq!(intake.received().stale_frames, 0);
}
