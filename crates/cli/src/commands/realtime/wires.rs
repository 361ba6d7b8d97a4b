//! Inputs and outputs of a real-time loop.

use super::failure::Failure;
use super::files::Drafts;
use super::stage::Stage;
use crate::arguments::realtime::{Inputs, Outputs, WireArguments};
use std::io::{BufReader, Write, stdin};
use std::net::{SocketAddr, UdpSocket};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use stickslip_realtime::intake::Patience;
use stickslip_realtime::region::Region;
use stickslip_realtime::session::Wiring;
use stickslip_realtime::source::{Door, Lines, MemorySource, Recording, recording_head, socket};
use stickslip_realtime::tape::{Form, Reel, tape};
use stickslip_realtime::wire;
use stickslip_realtime::{Intake, Sink, Source};

/// First line of a log.
const LOG_HEAD: &[u8] = b"frame,latency_ns,execution_ns,deadlines_skipped\n";
/// Number of columns of a log.
const LOG_WIDTH: usize = 4;

/// All open inputs and outputs.
pub(super) struct Wires {
    pub(super) wiring: Wiring,
    /// Writers of recordings and logs.
    pub(super) reels: Vec<Reel<'static>>,
    /// Number of frames of a recording to be replayed.
    pub(super) recorded: Option<u64>,
}

/// Opens everything that the command line names.
pub(super) fn open(stage: &Stage<'_>, drafts: &mut Drafts) -> Result<Wires, Failure> {
    let wires = &stage.arguments.wires;
    let region = region(stage)?;
    let (mut recorded, mut own) = (None, None);
    let source = match &wires.inputs {
        None => Source::None,
        Some(Inputs::Udp(address)) => {
            let failed = |source| Failure::Address { address: *address, source };
            let socket = socket(*address).map_err(failed)?;
            own = Some(socket.try_clone().map_err(failed)?);
            Source::Udp(Door::new(socket))
        }
        Some(Inputs::Memory(_)) => match &region {
            Some(region) => Source::Memory(MemorySource::new(Arc::clone(region))),
            None => Source::None,
        },
        Some(Inputs::Stdin) => {
            Source::Lines(Lines::read(BufReader::new(stdin()), stage.number, &stage.inputs))
        }
        Some(Inputs::Replay(path)) => {
            let recording = Recording::read(path, stage.number, stage.arguments.period, &stage.inputs)?;
            recorded = Some(recording.frames());
            Source::Recording(recording)
        }
    };
    let mut reels = Vec::new();
    let sinks = sinks(stage, (own, region), drafts, &mut reels)?;
    let mut log = None;
    if let Some(path) = &wires.log {
        let mut file = drafts.begin(path)?;
        file.write_all(LOG_HEAD)?;
        let (tape, reel) = tape(LOG_WIDTH, Form::Csv, file);
        log = Some(tape);
        reels.push(reel);
    }
    let mut recording = None;
    if let Some(path) = &wires.record_inputs {
        let mut file = drafts.begin(path)?;
        let head = recording_head(stage.number, stage.arguments.period, stage.inputs.len());
        head.iter().try_for_each(|word| file.write_all(&word.to_le_bytes()))?;
        let (tape, reel) = tape(stage.inputs.len(), Form::Binary, file);
        recording = Some(tape);
        reels.push(reel);
    }
    let intake = Intake::new(stage.number, &stage.inputs, patience(stage));
    Ok(Wires { wiring: Wiring { source, intake, sinks, log, recording }, reels, recorded })
}

/// Returns warnings for addresses that other machines can reach.
pub(super) fn exposed(wires: &WireArguments) -> Vec<String> {
    let is_beyond = |address: &&SocketAddr| !address.ip().to_canonical().is_loopback();
    let reached = match &wires.inputs {
        Some(Inputs::Udp(address)) => Some(address).filter(is_beyond),
        _ => None,
    };
    let sent = wires.outputs.iter().filter_map(|outputs| match outputs {
        Outputs::Udp(to) => to.as_ref().filter(is_beyond),
        _ => None,
    });
    let reached = reached.map(|at| {
        format!(
            "--inputs udp:{at}: other machines on the network can reach this port, and the first client \
             controls the inputs; only this machine can reach udp:127.0.0.1:{}",
            at.port()
        )
    });
    let sent =
        sent.map(|to| format!("--outputs udp:{to}: outputs are sent to the network without encryption"));
    reached.into_iter().chain(sent).collect()
}

/// Converts times to numbers of frames, at least one.
fn patience(stage: &Stage<'_>) -> Patience {
    let wires = &stage.arguments.wires;
    let frames = |time: f64| (time / stage.arguments.period).ceil().max(1.0) as u64;
    Patience {
        silence: wires.silence.silence(),
        silent_after: frames(wires.silent_after),
        owner: frames(wires.takeover),
    }
}

/// Returns the shared memory of inputs and outputs, if one of them uses it.
fn region(stage: &Stage<'_>) -> Result<Option<Arc<Region>>, Failure> {
    let wires = &stage.arguments.wires;
    let named: Vec<&PathBuf> = wires
        .outputs
        .iter()
        .filter_map(|outputs| if let Outputs::Memory(path) = outputs { Some(path) } else { None })
        .chain(if let Some(Inputs::Memory(path)) = &wires.inputs { Some(path) } else { None })
        .collect();
    let Some(path) = named.first() else { return Ok(None) };
    if named.iter().any(|other| other != path) {
        return Err(Failure::TwoMemories);
    }
    let known = (stage.number, stage.arguments.period);
    Ok(Some(Region::make(Path::new(path), known, stage.inputs.len(), &stage.outputs)?))
}

fn sinks(
    stage: &Stage<'_>,
    (own, region): (Option<UdpSocket>, Option<Arc<Region>>),
    drafts: &mut Drafts,
    reels: &mut Vec<Reel<'static>>,
) -> Result<Vec<Sink>, Failure> {
    let mut sinks = Vec::new();
    for outputs in &stage.arguments.wires.outputs {
        match outputs {
            Outputs::Udp(to) => {
                let socket = match (&own, to) {
                    // The socket of the inputs only reaches its own network.
                    (_, Some(to)) => sender(*to)?,
                    (Some(own), None) => own.try_clone()?,
                    (None, None) => return Err(Failure::NobodyToAnswer),
                };
                sinks.push(Sink::Udp { socket, to: *to });
            }
            Outputs::Memory(_) => sinks.extend(region.clone().map(Sink::Memory)),
            Outputs::File(path) => {
                let width = wire::length(stage.outputs.len()) / size_of::<u64>();
                let (tape, reel) = tape(width, Form::Binary, drafts.begin(path)?);
                sinks.push(Sink::File(tape));
                reels.push(reel);
            }
        }
    }
    Ok(sinks)
}

/// Returns a socket on any port that can reach an address.
fn sender(to: SocketAddr) -> Result<UdpSocket, Failure> {
    let any: SocketAddr = if to.is_ipv4() { ([0; 4], 0).into() } else { ([0; 16], 0).into() };
    socket(any).map_err(|source| Failure::Address { address: to, source })
}
