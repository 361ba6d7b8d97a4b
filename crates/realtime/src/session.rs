//! A plant in its loop, with the outside world on both sides of it.

use crate::film::Film;
use crate::intake::{Client, Intake};
use crate::pace::{self, Cycle, Overrun, Pace, Stop, Timing};
use crate::plant::{Empty, Plant, Work};
use crate::sink::Sink;
use crate::source::Source;
use crate::system::{Denied, Favours, now, sleep_until};
use crate::tape::{self, Reel, Tape};
use crate::wire::Stamp;
use crate::worst::Slow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use stickslip_drive::Watcher;

/// How often the outputs of the start are sent until an input comes, ns.
const HELLO: u64 = 10_000_000;
const NANO: f64 = 1e9;

/// What goes in and out of a loop.
pub struct Wiring {
    /// Where inputs come from …
    pub source: Source,
    /// … and who judges them.
    pub intake: Intake,
    /// Where outputs go.
    pub sinks: Vec<Sink>,
    /// A record of frame, latency (ns), execution (ns) and deadlines left out, of every frame.
    pub log: Option<Tape>,
    /// The inputs applied in every frame.
    pub recording: Option<Tape>,
}

impl Wiring {
    /// Fails where shared memory is not what it was made as.
    fn check_memory(&self) -> Result<(), Stop> {
        let read = if let Source::Memory(memory) = &self.source { Some(memory.region()) } else { None };
        let written = self.sinks.iter().filter_map(|sink| match sink {
            Sink::Memory(region) => Some(&**region),
            _ => None,
        });
        let cut = read.into_iter().chain(written).find(|region| !region.is_whole());
        cut.map_or(Ok(()), |region| Err(Stop::Cut(region.path().to_owned())))
    }

    /// From now on what is written down waits for room: nothing is due, so that nothing has to be lost.
    fn wait(&mut self) {
        self.sinks.iter_mut().for_each(Sink::wait);
        self.log.iter_mut().chain(&mut self.recording).for_each(Tape::wait);
    }
}

/// How a loop is run.
#[derive(Debug, Clone, Copy)]
pub struct Order {
    /// When frames are computed.
    pub pace: Pace,
    /// How many.
    pub frames: u64,
    /// What is asked of the system.
    pub favours: Favours,
    /// Frames of the empty loop before it.
    pub floor: u64,
    /// How long the first input is waited for, s; not at all where 0.
    pub wait: f64,
}

/// What came of a loop.
pub struct Ended {
    /// Why it ended before its last frame.
    pub outcome: Result<(), Stop>,
    /// Whether the first input never came, and nothing was computed.
    pub waited_in_vain: bool,
    /// How long everything took.
    pub timing: Timing,
    /// The same of the empty loop.
    pub floor: Timing,
    /// What the system did not grant.
    pub denied: Vec<Denied>,
    /// What it looked like.
    pub film: Film,
    /// What went in and out.
    pub wiring: Wiring,
    /// Outputs that the system did not take or for which there was no room.
    pub unsent: u64,
}

/// A frame of a plant: look for inputs, note them, compute, tell.
struct Live<'a, P> {
    plant: &'a mut P,
    wiring: &'a mut Wiring,
    outputs: Vec<f64>,
    film: &'a mut Film,
    period: f64,
    unsent: u64,
    frame: &'a AtomicU64,
    observer: &'a (dyn Watcher + Sync),
}

impl<P: Plant> Cycle for Live<'_, P> {
    fn act(&mut self, frame: u64) -> Result<Work, Stop> {
        if !self.observer.goes_on() {
            return Err(Stop::Interrupted);
        }
        self.wiring.check_memory()?;
        let Wiring { source, intake, sinks, recording, .. } = &mut *self.wiring;
        source.poll(intake);
        intake.settle()?;
        if let Some(recording) = recording {
            recording.put(intake.values().iter().map(|value| value.to_bits()));
        }
        let work = self.plant.frame(intake.values(), &mut self.outputs)?;
        let stamp = Stamp { sequence: frame + 1, time: (frame + 1) as f64 * self.period };
        for sink in sinks {
            self.unsent += u64::from(!sink.send(intake.scenario(), stamp, &self.outputs, intake.owner()));
        }
        Ok(work)
    }

    fn goes_on(&self) -> bool {
        self.observer.goes_on()
    }

    fn timed(&mut self, slow: &Slow, left_out: u64) {
        let Slow { frame, latency, execution, .. } = *slow;
        if let Some(log) = &mut self.wiring.log {
            log.put([frame, latency, execution, left_out].into_iter());
        }
        let time = (frame + 1) as f64 * self.period;
        self.film.look(frame, time, (latency, execution), (self.wiring.intake.values(), &self.outputs));
        self.frame.store(frame + 1, Ordering::Relaxed);
    }
}

/// The empty loop.
struct Idle<'a>(&'a (dyn Watcher + Sync));

impl Cycle for Idle<'_> {
    fn act(&mut self, _: u64) -> Result<Work, Stop> {
        if !self.0.goes_on() {
            return Err(Stop::Interrupted);
        }
        Ok(Empty.frame(&[], &mut [])?)
    }

    fn goes_on(&self) -> bool {
        self.0.goes_on()
    }
}

/// Runs a plant in a thread of its own, while this one writes down what comes; `start` has the outputs at t = 0. Favours are
/// asked for that thread: locked memory alone stays after it. Without a pace the loop waits for what is written down, so every
/// tape's reel must be among these.
pub fn run<P: Plant + Send>(
    plant: &mut P,
    mut wiring: Wiring,
    start: &[f64],
    order: &Order,
    reels: &mut [Reel<'_>],
    observer: &(dyn Watcher + Sync),
) -> Ended {
    if order.pace.overrun.is_none() {
        wiring.wait();
    }
    let (over, frame) = (AtomicBool::new(false), AtomicU64::new(0));
    let mut film = Film::new(order.frames, wiring.intake.width(), start.len());
    let (mut timing, mut floor) = (Timing::new(), Timing::new());
    let mut live = Live {
        plant,
        wiring: &mut wiring,
        outputs: start.to_vec(),
        film: &mut film,
        period: order.pace.period,
        unsent: 0,
        frame: &frame,
        observer,
    };
    let mut turn = || {
        let denied = order.favours.ask();
        // The machine alone. An interruption ends it, and the loop that comes after it before its first frame.
        let empty = Pace { overrun: order.pace.overrun.map(|_| Overrun::Skip), ..order.pace };
        let _ = pace::run(&empty, order.floor, &mut Idle(observer), &mut floor);
        let heard = live.wait(order.wait);
        let outcome =
            if heard { pace::run(&order.pace, order.frames, &mut live, &mut timing) } else { Ok(()) };
        (denied, outcome, !heard, live.unsent)
    };
    let (denied, outcome, waited_in_vain, unsent) = thread::scope(|scope| {
        let turn = scope.spawn(|| {
            // However it ends, the one who writes down must not wait for ever.
            let _over = Over(&over);
            turn()
        });
        let look = || observer.reached(frame.load(Ordering::Relaxed) as f64 * order.pace.period);
        tape::write_down(reels, &over, &look);
        turn.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    });
    Ended { outcome, waited_in_vain, timing, floor, denied, film, wiring, unsent }
}

/// Tells that the loop is over when it is dropped.
struct Over<'a>(&'a AtomicBool);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

impl<P: Plant> Live<'_, P> {
    /// Waits for the first good input and sends the outputs of the start meanwhile; whether one came, or none is needed.
    fn wait(&mut self, seconds: f64) -> bool {
        let waits = matches!(self.wiring.source, Source::Udp(_) | Source::Memory(_) | Source::Lines(_));
        if !waits || self.wiring.intake.width() == 0 || seconds <= 0.0 {
            return true;
        }
        let end = now().saturating_add((NANO * seconds) as u64);
        loop {
            // What ends the wait without an input ends the loop before its first frame.
            if !self.observer.goes_on() || self.wiring.check_memory().is_err() {
                return true;
            }
            let Wiring { source, intake, sinks, .. } = &mut *self.wiring;
            for sink in &mut *sinks {
                let stamp = Stamp { sequence: 0, time: 0.0 };
                // The file has frames only.
                if !matches!(sink, Sink::File(_)) {
                    sink.send(intake.scenario(), stamp, &self.outputs, None::<Client>);
                }
            }
            source.poll(intake);
            if intake.owner().is_some() {
                return true;
            }
            if now() >= end {
                return false;
            }
            sleep_until(now() + HELLO);
        }
    }
}
