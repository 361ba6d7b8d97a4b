//! Real-time session: a simulated system (plant) in a real-time loop, connected to inputs and outputs.

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

/// Interval at which the initial outputs are sent until the first input arrives, ns.
const HELLO: u64 = 10_000_000;
const NANO: f64 = 1e9;

/// Inputs and outputs of a loop.
pub struct Wiring {
    /// Source of the inputs.
    pub source: Source,
    /// Validator of the inputs.
    pub intake: Intake,
    /// Destinations of the outputs.
    pub sinks: Vec<Sink>,
    /// Log with the number, latency, ns, execution time, ns, and number of skipped deadlines of every frame.
    pub log: Option<Tape>,
    /// Recording of the inputs of every frame.
    pub recording: Option<Tape>,
}

impl Wiring {
    /// Checks that the shared memory was not truncated.
    ///
    /// # Errors
    /// [`Stop::Cut`] if the file was truncated.
    fn check_memory(&self) -> Result<(), Stop> {
        let read = if let Source::Memory(memory) = &self.source { Some(memory.region()) } else { None };
        let written = self.sinks.iter().filter_map(|sink| match sink {
            Sink::Memory(region) => Some(&**region),
            _ => None,
        });
        let cut = read.into_iter().chain(written).find(|region| !region.is_whole());
        cut.map_or(Ok(()), |region| Err(Stop::Cut(region.path().to_owned())))
    }

    /// Makes a loop without pacing wait until records can be written, so that no record is lost.
    fn wait(&mut self) {
        self.sinks.iter_mut().for_each(Sink::wait);
        self.log.iter_mut().chain(&mut self.recording).for_each(Tape::wait);
    }
}

/// Settings of a loop.
#[derive(Debug, Clone, Copy)]
pub struct Order {
    /// Timing of the frames.
    pub pace: Pace,
    /// Number of frames.
    pub frames: u64,
    /// Requested privileges of the loop thread.
    pub favours: Favours,
    /// Number of frames of the empty loop that measures the timing of the machine before the start.
    pub floor: u64,
    /// Maximum time to wait for the first input, s. 0 means no waiting.
    pub wait: f64,
}

/// Results of a loop.
pub struct Ended {
    /// Reason for an early end.
    pub outcome: Result<(), Stop>,
    /// Whether the first input did not arrive in time, so that no frame was computed.
    pub waited_in_vain: bool,
    /// Timing of the loop.
    pub timing: Timing,
    /// Timing of the empty loop.
    pub floor: Timing,
    /// Privileges that the system denied.
    pub denied: Vec<Denied>,
    /// Time history of the loop, reduced to a limited number of points.
    pub film: Film,
    /// Inputs and outputs of the loop after its end.
    pub wiring: Wiring,
    /// Number of outputs that were not sent.
    pub unsent: u64,
}

/// Cycle of the real-time loop: reads and records the inputs, computes a frame of the plant, and sends the outputs.
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

/// Cycle of the empty loop, which computes nothing.
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

/// Runs a plant in a new thread, while the calling thread writes the records of the tapes to files. `start` contains the outputs at t = 0.
///
/// The privileges are requested for the loop thread; only locked memory remains afterwards. A loop without pacing waits until records are
/// written. Therefore `reels` must contain the receivers of all tapes.
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
        // An interrupt ends the empty loop, and then the loop itself before its first frame.
        let empty = Pace { overrun: order.pace.overrun.map(|_| Overrun::Skip), ..order.pace };
        let _ = pace::run(&empty, order.floor, &mut Idle(observer), &mut floor);
        let heard = live.wait(order.wait);
        let outcome =
            if heard { pace::run(&order.pace, order.frames, &mut live, &mut timing) } else { Ok(()) };
        (denied, outcome, !heard, live.unsent)
    };
    let (denied, outcome, waited_in_vain, unsent) = thread::scope(|scope| {
        let turn = scope.spawn(|| {
            // Dropping this value ends the writing of the tapes, even after a panic.
            let _over = Over(&over);
            turn()
        });
        let look = || observer.reached(frame.load(Ordering::Relaxed) as f64 * order.pace.period);
        tape::write_down(reels, &over, &look);
        turn.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    });
    Ended { outcome, waited_in_vain, timing, floor, denied, film, wiring, unsent }
}

/// Signals the end of the loop when it is dropped.
struct Over<'a>(&'a AtomicBool);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

impl<P: Plant> Live<'_, P> {
    /// Waits for the first accepted input and sends the initial outputs meanwhile.
    ///
    /// Returns whether an input arrived or no input is needed.
    fn wait(&mut self, seconds: f64) -> bool {
        let waits = matches!(self.wiring.source, Source::Udp(_) | Source::Memory(_) | Source::Lines(_));
        if !waits || self.wiring.intake.width() == 0 || seconds <= 0.0 {
            return true;
        }
        let end = now().saturating_add((NANO * seconds) as u64);
        loop {
            // In both cases the loop ends before its first frame.
            if !self.observer.goes_on() || self.wiring.check_memory().is_err() {
                return true;
            }
            let Wiring { source, intake, sinks, .. } = &mut *self.wiring;
            for sink in &mut *sinks {
                let stamp = Stamp { sequence: 0, time: 0.0 };
                // The output file contains only outputs of frames, not the initial outputs.
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
