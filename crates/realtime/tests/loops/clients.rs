//! Faulty and competing clients.

use crate::rig::{LINEAR, PERIOD, Rig, SCENARIO, order, wiring};
use std::net::{SocketAddr, UdpSocket};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use stickslip_drive::Stepper;
use stickslip_realtime::intake::{Client, Silence};
use stickslip_realtime::memory::MemoryError;
use stickslip_realtime::pace::Stop;
use stickslip_realtime::region::Region;
use stickslip_realtime::source::{Door, MemorySource, socket};
use stickslip_realtime::wire::{self, Stamp};
use stickslip_realtime::{Intake, Overrun, Sink, Source};
use tempfile::tempdir;

const VERLET: Stepper = Stepper::Verlet { step: 5e-6 };

fn rig() -> Rig {
    Rig::of("p1", Some(LINEAR), VERLET)
}

fn packet(sequence: u64, value: f64) -> Vec<u8> {
    let mut bytes = vec![0; wire::length(1)];
    wire::encode(&mut bytes, SCENARIO, Stamp { sequence, time: 0.0 }, &[value]);
    bytes
}

/// Returns a receiving socket and its address.
fn listening_at(at: &str) -> (UdpSocket, SocketAddr) {
    let server = socket(at.parse().unwrap()).unwrap();
    let to = server.local_addr().unwrap();
    (server, to)
}

fn listening() -> (Source, SocketAddr) {
    let (server, to) = listening_at("127.0.0.1:0");
    (Source::Udp(Door::new(server)), to)
}

/// Polls until all packets have arrived. On 127.0.0.1 they arrive at once, except on a busy machine.
fn poll(source: &mut Source, intake: &mut Intake, packets: u64) {
    let told = |intake: &Intake| {
        let r = intake.received();
        r.good
            + r.wrong_length
            + r.foreign
            + r.other_scenario
            + r.repeated
            + r.out_of_order
            + r.out_of_range
            + r.other_client
    };
    for _ in 0..1000 {
        source.poll(intake);
        if told(intake) >= packets {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("{packets} packets did not come: {:?}", intake.received());
}

#[test]
fn over_udp_wrong_packets_are_counted_and_the_last_good_value_stays() {
    let (mut source, to) = listening();
    let mut intake = rig().intake(Silence::Hold, 1000, 1000);
    let client = UdpSocket::bind("127.0.0.1:0").unwrap();
    let mut other = packet(3, 0.1e-6);
    other[9] ^= 0x40;
    let long = [packet(3, 0.1e-6), vec![0; 5000]].concat();
    let all = [
        packet(2, 0.2e-6),
        packet(1, 0.1e-6),
        packet(2, 0.1e-6),
        packet(3, 5e-6),
        packet(3, f64::NAN),
        other,
        b"hello".to_vec(),
        packet(3, 0.1e-6)[..39].to_vec(),
        long,
        Vec::new(),
    ];
    for bytes in &all {
        client.send_to(bytes, to).unwrap();
    }
    poll(&mut source, &mut intake, all.len() as u64);
    intake.settle().unwrap();
    let r = intake.received();
    assert_eq!(intake.values(), [0.2e-6]);
    assert_eq!((r.good, r.out_of_order, r.repeated, r.out_of_range), (1, 1, 1, 2));
    assert_eq!((r.other_scenario, r.foreign, r.wrong_length), (1, 1, 3));
}

#[test]
fn over_udp_the_second_client_waits_until_the_first_is_silent() {
    let (mut source, to) = listening();
    let mut intake = rig().intake(Silence::Hold, 1000, 3);
    let [a, b] = [0, 1].map(|_| UdpSocket::bind("127.0.0.1:0").unwrap());
    a.send_to(&packet(10, 0.1e-6), to).unwrap();
    poll(&mut source, &mut intake, 1);
    intake.settle().unwrap();
    for sequence in 1..=3 {
        // The system drops the packet and may report this at the next one.
        let _ = b.send_to(&packet(sequence, 0.3e-6), to);
        source.poll(&mut intake);
        intake.settle().unwrap();
    }
    assert_eq!((intake.values()[0], intake.received().good), (0.1e-6, 1));
    assert_eq!(intake.owner(), Some(Client::Address(a.local_addr().unwrap())));
    // From the next poll on, all clients are received.
    source.poll(&mut intake);
    b.send_to(&packet(4, 0.3e-6), to).unwrap();
    poll(&mut source, &mut intake, 2);
    intake.settle().unwrap();
    assert_eq!((intake.values()[0], intake.received().owners), (0.3e-6, 2));
    // Now the first client is not received.
    let _ = a.send_to(&packet(11, 0.1e-6), to);
    b.send_to(&packet(5, 0.2e-6), to).unwrap();
    poll(&mut source, &mut intake, 3);
    assert_eq!((intake.values()[0], intake.received().good), (0.2e-6, 3));
}

/// The flood exceeds the receive buffer. Without the filter, later packets of the client would be dropped.
#[test]
fn over_udp_a_flood_takes_no_packet_of_the_client_that_has_the_inputs() {
    let (mut source, to) = listening();
    let mut intake = rig().intake(Silence::Hold, 1000, 1000);
    let [owner, stranger] = [0, 1].map(|_| UdpSocket::bind("127.0.0.1:0").unwrap());
    // Packets that arrived before a client owned the inputs are validated.
    stranger.send_to(b"hello", to).unwrap();
    owner.send_to(&packet(1, 0.1e-6), to).unwrap();
    poll(&mut source, &mut intake, 2);
    for sequence in 2..=20 {
        for _ in 0..500 {
            let _ = stranger.send_to(&packet(sequence, 0.5e-6), to);
        }
        owner.send_to(&packet(sequence, 0.2e-6), to).unwrap();
        poll(&mut source, &mut intake, 1 + sequence);
        intake.settle().unwrap();
    }
    let received = intake.received();
    assert_eq!((intake.values()[0], received.good, received.other_client), (0.2e-6, 20, 0));
    assert_eq!((received.foreign, received.owners), (1, 1));
}

/// A socket bound to all addresses of a machine is assigned one of them when it is connected. A client at another address is received
/// again.
#[test]
fn over_udp_a_client_at_another_address_of_the_machine_is_not_shut_out() {
    let (server, all) = listening_at("0.0.0.0:0");
    let (mut source, to) = (Source::Udp(Door::new(server)), SocketAddr::from(([127, 0, 0, 2], all.port())));
    let mut intake = rig().intake(Silence::Hold, 1000, 3);
    let client = UdpSocket::bind("127.0.0.1:0").unwrap();
    for sequence in 1..=100 {
        let _ = client.send_to(&packet(sequence, 0.1e-6), to);
        source.poll(&mut intake);
        intake.settle().unwrap();
    }
    let received = intake.received();
    println!("{received:?}");
    assert!(received.good > 90 && received.owners == 2, "{received:?}");
}

/// A client that controls the latest output proportionally and is killed in the middle: the last value is held.
#[test]
fn a_client_in_the_loop_over_udp_and_its_death() {
    let rig = rig();
    let (server, to) = listening_at("127.0.0.1:0");
    let sink = Sink::Udp { socket: server.try_clone().unwrap(), to: None };
    let source = Source::Udp(Door::new(server));
    let over = AtomicBool::new(false);
    let width = rig.width();
    let (ended, (answered, said)) = std::thread::scope(|scope| {
        let over = &over;
        let client = scope.spawn(move || {
            let client = UdpSocket::bind("127.0.0.1:0").unwrap();
            client.set_read_timeout(Some(Duration::from_millis(20))).unwrap();
            let (mut bytes, mut values, mut last) = (vec![0; 2000], vec![0.0; width], 0);
            // With the first packet, the loop knows the address of the client.
            let mut sequence = 1;
            while last < 300 && !over.load(Ordering::Relaxed) {
                client.send_to(&packet(sequence, 1e-9 * (sequence % 100) as f64), to).unwrap();
                sequence += 1;
                if let Ok(length) = client.recv(&mut bytes) {
                    last = wire::decode(&bytes[..length], SCENARIO, &mut values).unwrap().sequence;
                    assert!(values.iter().all(|value| value.is_finite()));
                }
            }
            (last, 1e-9 * ((sequence - 1) % 100) as f64)
        });
        let mut wiring = wiring(source, rig.intake(Silence::Hold, 500, 500));
        wiring.sinks.push(sink);
        let mut order = order(3000, Some(Overrun::Skip));
        order.wait = 20.0;
        let (ended, _) = rig.run(&mut rig.drive((rig.start(), 0)), wiring, &order);
        over.store(true, Ordering::Relaxed);
        (ended, client.join().unwrap())
    });
    let received = ended.wiring.intake.received();
    println!("answered until frame {answered}: {received:?}");
    assert_eq!((ended.outcome, ended.waited_in_vain, ended.timing.frames()), (Ok(()), false, 3000));
    assert!(received.good > 10 && received.owners == 1 && answered >= 300);
    // Every frame had a new value or was stale, and the last value is held.
    assert_eq!(received.good - received.superseded + received.stale_frames, 3000);
    assert_eq!(ended.wiring.intake.values(), [said]);
}

#[test]
fn an_input_that_never_comes_is_waited_for_and_no_longer() {
    let rig = rig();
    let (source, _) = listening();
    let wiring = wiring(source, rig.intake(Silence::Hold, 10, 10));
    let mut order = order(100, Some(Overrun::Skip));
    order.wait = 0.05;
    let (ended, bytes) = rig.run(&mut rig.drive((rig.start(), 0)), wiring, &order);
    assert!(ended.waited_in_vain && ended.timing.frames() == 0 && bytes.is_empty());
}

#[test]
fn silence_can_end_the_loop() {
    let rig = rig();
    let (source, _) = listening();
    let wiring = wiring(source, rig.intake(Silence::Stop, 25, 10));
    let (ended, _) = rig.run(&mut rig.drive((rig.start(), 0)), wiring, &order(1000, None));
    assert_eq!((ended.outcome, ended.timing.frames()), (Err(Stop::Silence), 24));
}

/// Writes to the shared memory like a client, according to the documented layout.
fn write(path: &Path, writer: u64, sequence: u64, value: f64, scenario: u64) {
    use std::os::unix::fs::FileExt;
    let file = std::fs::OpenOptions::new().read(true).write(true).open(path).unwrap();
    let mut word = [0; 8];
    let mut at = |place: u64| {
        file.read_exact_at(&mut word, place).unwrap();
        u64::from_le_bytes(word)
    };
    assert_eq!((at(0), at(8), at(16)), (u64::from_le_bytes(*b"sslpshm1"), SCENARIO, 1));
    let from = at(32);
    let counter = at(from) | 1;
    let put = |place: u64, word: u64| file.write_all_at(&word.to_le_bytes(), from + 8 * place).unwrap();
    put(0, counter);
    put(1, writer);
    put(2, 0x0001_0001_706c_7373);
    put(3, scenario);
    put(4, sequence);
    put(5, 0.0_f64.to_bits());
    put(6, value.to_bits());
    put(0, counter + 1);
}

fn memory(rig: &Rig, folder: &Path) -> (PathBuf, Arc<Region>) {
    let path = folder.join("loop");
    let region = Region::make(&path, (SCENARIO, PERIOD), rig.inputs.len(), &rig.outputs).unwrap();
    (path, region)
}

#[test]
fn over_shared_memory_the_same_is_refused() {
    let (rig, folder) = (rig(), tempdir().unwrap());
    let (path, region) = memory(&rig, folder.path());
    let mut source = Source::Memory(MemorySource::new(region));
    let mut intake = rig.intake(Silence::Hold, 1000, 3);
    let mut frame = |write: &dyn Fn()| {
        write();
        source.poll(&mut intake);
        intake.settle().unwrap();
        (intake.values()[0], *intake.received())
    };
    assert_eq!(frame(&|| {}).1.stale_frames, 1);
    assert_eq!(frame(&|| write(&path, 1, 5, 0.1e-6, SCENARIO)).0, 0.1e-6);
    assert_eq!(frame(&|| write(&path, 1, 5, 0.2e-6, SCENARIO)).1.repeated, 1);
    assert_eq!(frame(&|| write(&path, 1, 4, 0.2e-6, SCENARIO)).1.out_of_order, 1);
    // After two stale frames and a third one, the next client takes over.
    assert_eq!(frame(&|| write(&path, 2, 1, 0.3e-6, SCENARIO)).1.other_client, 1);
    assert_eq!(frame(&|| write(&path, 2, 2, 0.3e-6, SCENARIO)).0, 0.3e-6);
    assert_eq!(frame(&|| write(&path, 2, 3, 0.3e-6, SCENARIO + 1)).1.other_scenario, 1);
    let (value, received) = frame(&|| write(&path, 2, 3, f64::INFINITY, SCENARIO));
    assert_eq!((value, received.out_of_range, received.good, received.owners), (0.3e-6, 1, 2, 2));
    // A client that was killed while it wrote: the lowest bit of the counter stays 1.
    let torn = || {
        use std::os::unix::fs::FileExt;
        let file = std::fs::OpenOptions::new().write(true).open(&path).unwrap();
        file.write_all_at(&77_u64.to_le_bytes(), 64).unwrap();
    };
    let (value, received) = frame(&torn);
    assert_eq!((value, received.torn_frames), (0.3e-6, 1));
    // After the third frame another client can write. The incomplete record is not read.
    assert_eq!((frame(&|| {}).1.torn_frames, counter(&path)), (2, 77));
    assert_eq!((frame(&|| {}).1.torn_frames, counter(&path)), (3, 78));
    let received = frame(&|| {}).1;
    assert_eq!((received.torn_frames, received.good), (3, 2));
    assert_eq!(frame(&|| write(&path, 3, 1, 0.4e-6, SCENARIO)).0, 0.4e-6);
}

/// Returns the counter of the input record.
fn counter(path: &Path) -> u64 {
    u64::from_le_bytes(std::fs::read(path).unwrap()[64..72].try_into().unwrap())
}

#[test]
fn shared_memory_is_left_to_whom_it_belongs() {
    let (rig, folder) = (rig(), tempdir().unwrap());
    let (path, region) = memory(&rig, folder.path());
    let again = || Region::make(&path, (SCENARIO, PERIOD), 1, &rig.outputs).map(|_| ());
    assert!(matches!(again(), Err(MemoryError::InUse(_))));
    drop(region);
    assert!(!path.exists());
    std::fs::write(&path, "something else").unwrap();
    assert!(matches!(again(), Err(MemoryError::Foreign(_))));
    assert_eq!(std::fs::read(&path).unwrap(), b"something else");
    // The file that a killed run has left is reused.
    std::fs::write(&path, b"sslpshm1 and then some").unwrap();
    again().unwrap();
}

#[test]
fn a_port_in_use_is_refused() {
    let taken = UdpSocket::bind("127.0.0.1:0").unwrap();
    assert!(socket(taken.local_addr().unwrap()).is_err());
}
