//! The command line of a loop in real time.

use crate::arguments::assignment;
use crate::arguments::look::LookArguments;
use clap::{Args, ValueEnum};
use std::net::{SocketAddr, ToSocketAddrs};
use std::path::PathBuf;
use stickslip_realtime::intake::Silence;
use stickslip_realtime::system::Favours;
use stickslip_realtime::{Overrun, region};

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Run a drive in real time with inputs and outputs over UDP or shared memory

A frame is one --period of simulated time. Deadlines are multiples of --period on the monotonic clock. After each deadline the loop \
takes the newest input, computes one frame and sends the outputs. Latency is the time from the deadline until the loop wakes. \
Execution time is the time from waking until the outputs are sent. Both are counted in bins of 1 µs. A frame that ends after the next \
deadline is an overrun. Before the run, an empty loop with the same period shows the limits of the machine.

Inputs are the waveforms of kind \"input\". A held input takes a new value at the start of a frame. A linear input reaches a new \
value at the end of a frame. A waveform of kind \"generator\" has four inputs: NAME.stroke, NAME.frequency (Hz), NAME.heading (1 or \
-1) and NAME.steps (-1 for no limit). Without --inputs, all inputs keep their initial values. All values are in SI. \
docs/real_time_interface.md describes packets, shared memory and recordings byte by byte, with clients in C and Python.

Before the start, the command computes 500 frames, but for at most 0.5 s. A --period shorter than the median computing time of these \
frames is refused unless --force is given. If the operating system refuses the priority, the processor or locked memory, the loop \
runs without the refused setting, and the report says so.

Writes to DIR/NAME: realtime.json, histogram.csv, frames.csv (the slowest frames and their work), realtime.png and timeline.png. Exit \
codes: 0 all frames were computed; 2 bad input, no input arrived, or a port is in use; 3 the run stopped early, --overrun stop or \
--silence stop ended the loop, or a file cannot be written; 130 interrupted. Results so far are written.";

/// Examples under the long help.
pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip realtime scenarios/p1.json --period \"50 us\" --for \"10 s\"
  stickslip realtime drive.json --period \"100 us\" --for \"10 s\" --cpu 1 --priority 80 --lock
  stickslip realtime stage.json --period \"100 us\" --for \"1 min\" --inputs udp:127.0.0.1:5005 --outputs udp:127.0.0.1:5006
  stickslip realtime stage.json --period \"100 us\" --for \"1 min\" --inputs shm:stage --outputs shm:stage
  stickslip realtime stage.json --period \"100 us\" --for \"10 s\" --inputs udp:127.0.0.1:5005 --outputs udp --record-inputs a.rec
  stickslip realtime stage.json --period \"100 us\" --inputs replay:a.rec --unpaced --outputs file:b.bin";

#[derive(Debug, Args)]
pub(crate) struct RealtimeArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Length of a frame, such as "50 us"
    #[arg(long, value_name = "TIME", value_parser = frame)]
    pub(crate) period: f64,
    /// Simulated time [default: duration of the replayed recording, or of the scenario]
    #[arg(long = "for", value_name = "TIME", value_parser = above_zero)]
    pub(crate) duration: Option<f64>,
    /// Method of time integration. The default `frames[:ACCURACY]` has bounded work per frame; ACCURACY is 1e-3 of a stroke by default.
    /// `event[:TOLERANCE]` is fast on average. `verlet[:STEP]` and `rk4[:STEP]` have a fixed STEP, by default a fifth of the stability
    /// limit. A frame has at most 100 000 time steps
    #[arg(long, value_name = "NAME[:VALUE]")]
    pub(crate) stepper: Option<String>,
    /// Set a value of the scenario, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Folder for the report: the report on NAME.json is written to DIR/NAME/
    #[arg(long, value_name = "DIR", default_value = "realtime")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) wires: WireArguments,
    #[command(flatten)]
    pub(crate) clock: ClockArguments,
    /// Print the report to stdout as one line of JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only: no progress, no report
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// What goes in and out.
#[derive(Debug, Args)]
pub(crate) struct WireArguments {
    /// Source of the inputs: udp:HOST:PORT, shm:NAME (a file of /dev/shm, or a path), stdin (lines of numbers), or replay:FILE (a recording
    /// by --record-inputs). With a HOST other than 127.0.0.1, the program accepts packets from the network and prints a warning
    #[arg(long, value_name = "WHERE", value_parser = inputs)]
    pub(crate) inputs: Option<Inputs>,
    /// Destination of the outputs: udp:HOST:PORT, udp (the client that sends the inputs), shm:NAME, or file:PATH (packets). The option can
    /// be repeated
    #[arg(long, value_name = "WHERE", value_parser = outputs)]
    pub(crate) outputs: Vec<Outputs>,
    /// Channels to output [default: time, positions and velocities of bodies]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    pub(crate) channels: Option<Vec<String>>,
    /// Names of additional values that the client sends after the inputs, such as a setpoint. These values do not act on the drive, but
    /// are recorded and drawn in timeline.png. Each name ends with a unit, as in target.x_m
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', requires = "inputs")]
    pub(crate) notes: Vec<String>,
    /// Maximum waiting time for the first input; with 0 the loop starts at once
    #[arg(long, value_name = "TIME", default_value = "10 s", value_parser = not_negative)]
    pub(crate) wait: f64,
    /// Action after --silent-after without a valid input: hold the last values, return to the initial values, or stop the loop
    #[arg(long, value_name = "WHAT", default_value = "hold")]
    pub(crate) silence: SilenceArgument,
    /// Time without a valid input after which --silence acts
    #[arg(long, value_name = "TIME", default_value = "1 s", value_parser = above_zero)]
    pub(crate) silent_after: f64,
    /// Time without input after which the inputs of another client are accepted
    #[arg(long, value_name = "TIME", default_value = "100 ms", value_parser = above_zero)]
    pub(crate) takeover: f64,
    /// Record the inputs of every frame in FILE, for --inputs replay:FILE
    #[arg(long, value_name = "FILE")]
    pub(crate) record_inputs: Option<PathBuf>,
    /// Log every frame in FILE: number, latency and execution time in ns, number of deadlines skipped after the frame
    #[arg(long, value_name = "FILE")]
    pub(crate) log: Option<PathBuf>,
}

/// When frames are computed.
#[derive(Debug, Args)]
pub(crate) struct ClockArguments {
    /// Number of the processor to run on, counted from 0
    #[arg(long, value_name = "N")]
    pub(crate) cpu: Option<usize>,
    /// Real-time priority (SCHED_FIFO), 1 to 99
    #[arg(long, value_name = "P", value_parser = clap::value_parser!(u8).range(1..=99))]
    pub(crate) priority: Option<u8>,
    /// Lock all memory of the program, so that no page is swapped out
    #[arg(long)]
    pub(crate) lock: bool,
    /// Action on an overrun. skip: the next frame waits for the next deadline; all frames are computed, and simulated time falls behind
    /// the clock. stop: the loop ends (exit code 3)
    #[arg(long, value_name = "WHAT", default_value = "skip")]
    pub(crate) overrun: OverrunArgument,
    /// Wake earlier than each deadline by this time and poll the clock; reduces latency but keeps the processor busy
    #[arg(long, value_name = "TIME", default_value = "0", value_parser = not_negative)]
    pub(crate) spin: f64,
    /// Compute frames as fast as possible, without waiting for deadlines
    #[arg(long)]
    pub(crate) unpaced: bool,
    /// Duration of the empty loop, at most the duration of the run
    #[arg(long, value_name = "TIME", default_value = "2 s", value_parser = not_negative)]
    pub(crate) floor: f64,
    /// Start even if the machine is too slow for --period
    #[arg(long)]
    pub(crate) force: bool,
}

/// Where inputs come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Inputs {
    Udp(SocketAddr),
    Memory(PathBuf),
    Stdin,
    Replay(PathBuf),
}

/// Where outputs go.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Outputs {
    /// To an address, or to whoever has the inputs.
    Udp(Option<SocketAddr>),
    Memory(PathBuf),
    File(PathBuf),
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum OverrunArgument {
    /// Skip the deadlines that have passed
    Skip,
    /// End the loop
    Stop,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum SilenceArgument {
    /// Hold the last values
    Hold,
    /// Return to the initial values
    Initial,
    /// End the loop
    Stop,
}

impl SilenceArgument {
    pub(crate) fn silence(self) -> Silence {
        match self {
            Self::Hold => Silence::Hold,
            Self::Initial => Silence::Initial,
            Self::Stop => Silence::Stop,
        }
    }
}

impl ClockArguments {
    /// What is done about overruns; none where nothing is paced.
    pub(crate) fn overrun(&self) -> Option<Overrun> {
        let overrun = match self.overrun {
            OverrunArgument::Skip => Overrun::Skip,
            OverrunArgument::Stop => Overrun::Stop,
        };
        (!self.unpaced).then_some(overrun)
    }

    /// What is asked of the system.
    pub(crate) fn favours(&self) -> Favours {
        Favours { cpu: self.cpu, priority: self.priority, lock: self.lock }
    }
}

/// Reads a time above 0, s.
fn above_zero(text: &str) -> Result<f64, String> {
    let seconds = stickslip_scenario::quantity(text, "s")?;
    if seconds > 0.0 { Ok(seconds) } else { Err("expected a time above 0, such as \"50 us\"".to_owned()) }
}

/// Reads the length of a frame, s: a number without a unit is one of seconds.
fn frame(text: &str) -> Result<f64, String> {
    let seconds = above_zero(text)?;
    if seconds <= 1.0 {
        Ok(seconds)
    } else {
        Err("expected a frame of at most 1 s, such as \"50 us\"".to_owned())
    }
}

/// Reads a time that may be 0, s.
fn not_negative(text: &str) -> Result<f64, String> {
    if text.trim() == "0" {
        return Ok(0.0);
    }
    let seconds = stickslip_scenario::quantity(text, "s")?;
    if seconds >= 0.0 { Ok(seconds) } else { Err("expected 0 or a time above 0".to_owned()) }
}

fn address(text: &str) -> Result<SocketAddr, String> {
    let refuse = |why: String| format!("{why}; expected HOST:PORT, such as 127.0.0.1:5005");
    let mut found = text.to_socket_addrs().map_err(|error| refuse(format!("\"{text}\": {error}")))?;
    // Port 0 is whichever the system likes: nobody would know it.
    found.find(|address| address.port() != 0).ok_or_else(|| refuse(format!("\"{text}\" is not an address")))
}

fn name(text: &str, what: &str) -> Result<PathBuf, String> {
    if text.is_empty() { Err(format!("expected {what} after the colon")) } else { Ok(PathBuf::from(text)) }
}

fn memory(text: &str) -> Result<PathBuf, String> {
    name(text, "a name").map(|_| region::path(text))
}

/// Reads where inputs come from.
fn inputs(text: &str) -> Result<Inputs, String> {
    match text.split_once(':') {
        Some(("udp", to)) => Ok(Inputs::Udp(address(to)?)),
        Some(("shm", name)) => Ok(Inputs::Memory(memory(name)?)),
        Some(("replay", file)) => Ok(Inputs::Replay(name(file, "a file")?)),
        None if text == "stdin" => Ok(Inputs::Stdin),
        _ => Err("expected udp:HOST:PORT, shm:NAME, stdin or replay:FILE".to_owned()),
    }
}

/// Reads where outputs go.
fn outputs(text: &str) -> Result<Outputs, String> {
    match text.split_once(':') {
        Some(("udp", to)) => Ok(Outputs::Udp(Some(address(to)?))),
        Some(("shm", name)) => Ok(Outputs::Memory(memory(name)?)),
        Some(("file", file)) => Ok(Outputs::File(name(file, "a file")?)),
        None if text == "udp" => Ok(Outputs::Udp(None)),
        _ => Err("expected udp:HOST:PORT, udp, shm:NAME or file:PATH".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_read() {
        assert_eq!(inputs("udp:127.0.0.1:5005"), Ok(Inputs::Udp(([127, 0, 0, 1], 5005).into())));
        assert_eq!(outputs("udp:[::1]:5006"), Ok(Outputs::Udp(Some("[::1]:5006".parse().unwrap()))));
        assert_eq!(inputs("shm:stage"), Ok(Inputs::Memory("/dev/shm/stage".into())));
        assert_eq!(inputs("shm:/tmp/stage"), Ok(Inputs::Memory("/tmp/stage".into())));
        assert_eq!((inputs("stdin"), outputs("udp")), (Ok(Inputs::Stdin), Ok(Outputs::Udp(None))));
        for wrong in [
            "udp",
            "udp:5005",
            "udp:127.0.0.1",
            "udp:127.0.0.1:70000",
            "udp:127.0.0.1:0",
            "shm:",
            "tcp:a:1",
            "replay:",
            "",
        ] {
            assert!(inputs(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn times_have_units() {
        assert_eq!(
            (above_zero("50 us"), not_negative("0"), not_negative("1 s")),
            (Ok(50e-6), Ok(0.0), Ok(1.0))
        );
        assert!(above_zero("0 s").is_err() && above_zero("-1 s").is_err() && not_negative("-1 s").is_err());
    }
}
