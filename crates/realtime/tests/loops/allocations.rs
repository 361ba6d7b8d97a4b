//! The loop allocates no memory for frames, packets and log lines.

use crate::rig::{FRAMES, HELD, LINEAR, PERIOD, Rig, SCENARIO};
use std::net::UdpSocket;
use stickslip_drive::Stepper;
use stickslip_realtime::intake::Silence;
use stickslip_realtime::pace::{self, Cycle, Stop};
use stickslip_realtime::plant::Work;
use stickslip_realtime::source::{Door, socket};
use stickslip_realtime::tape::{Form, Tape, tape};
use stickslip_realtime::wire::{self, Stamp};
use stickslip_realtime::worst::Slow;
use stickslip_realtime::{Drive, Intake, Pace, Plant, Sink, Source, Timing};

/// Cycle of a session in this thread, with counted allocations.
struct Counted<'a> {
    drive: Drive<'a>,
    source: Source,
    intake: Intake,
    sink: Sink,
    log: Tape,
    outputs: Vec<f64>,
    client: UdpSocket,
    packet: Vec<u8>,
    to: std::net::SocketAddr,
}

impl Cycle for Counted<'_> {
    fn act(&mut self, frame: u64) -> Result<Work, Stop> {
        let value = 0.5e-6 * (0.7 * frame as f64).sin();
        wire::encode(&mut self.packet, SCENARIO, Stamp { sequence: frame + 1, time: 0.0 }, &[value]);
        self.client.send_to(&self.packet, self.to).unwrap();
        self.source.poll(&mut self.intake);
        self.intake.settle()?;
        let work = self.drive.frame(self.intake.values(), &mut self.outputs).map_err(Stop::Plant)?;
        let stamp = Stamp { sequence: frame + 1, time: 0.0 };
        self.sink.send(SCENARIO, stamp, &self.outputs, self.intake.owner());
        Ok(work)
    }

    fn timed(&mut self, slow: &Slow, left_out: u64) {
        self.log.put([slow.frame, slow.latency, slow.execution, left_out].into_iter());
    }
}

#[test]
fn the_loop_allocates_nothing() {
    let steppers = [FRAMES, Stepper::Event { tolerance: 1e-6 }, Stepper::Verlet { step: 1e-6 }];
    for (input, stepper) in steppers
        .map(|stepper| (LINEAR, stepper))
        .into_iter()
        .chain(steppers[..2].iter().map(|stepper| (HELD, *stepper)))
    {
        let rig = Rig::of("p1", Some(input), stepper);
        let server = socket("127.0.0.1:0".parse().unwrap()).unwrap();
        let to = server.local_addr().unwrap();
        let client = UdpSocket::bind("127.0.0.1:0").unwrap();
        let sink = Sink::Udp { socket: server.try_clone().unwrap(), to: None };
        let (log, _reel) = tape(4, Form::Csv, std::io::sink());
        let mut counted = Counted {
            drive: rig.drive((rig.start(), 0)),
            source: Source::Udp(Door::new(server)),
            intake: rig.intake(Silence::Hold, 100, 100),
            sink,
            log,
            outputs: vec![0.0; rig.width()],
            client,
            packet: vec![0; wire::length(1)],
            to,
        };
        let pace = Pace { period: PERIOD, overrun: None, spin: 0.0 };
        // The first frames start the run and allocate its memory.
        pace::run(&pace, 200, &mut counted, &mut Timing::new()).unwrap();
        let mut timing = Timing::new();
        // Sequence numbers start again: the last accepted values are held, or a new client would be needed. Neither allocates memory.
        let info = allocation_counter::measure(|| {
            pace::run(&pace, 3000, &mut counted, &mut timing).unwrap();
        });
        assert_eq!((info.count_total, timing.frames()), (0, 3000), "{stepper:?}");
        let received = *counted.intake.received();
        println!("{stepper:?}: {received:?}");
        assert!(received.good > 2000);
    }
}
