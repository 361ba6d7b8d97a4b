//! Where inputs come from.

mod lines;
mod recording;

pub use lines::Lines;
pub use recording::{Recording, RecordingError, head as recording_head};

use crate::intake::{Client, Intake};
use crate::region::Region;
use crate::seqlock::Found;
use crate::wire::{self, MOST_VALUES};
use std::io;
use std::net::UdpSocket;
use std::sync::Arc;

/// Most packets that are taken off a socket in a frame: a flood costs no more than this.
const MOST_PACKETS: usize = 32;

/// Where inputs come from; asked once before each frame, and it never waits.
pub enum Source {
    /// From nowhere: the initial values stay.
    None,
    /// Packets over UDP; the newest counts.
    Udp(UdpSocket),
    /// A record in shared memory.
    Memory(MemorySource),
    /// Lines of text.
    Lines(Lines),
    /// What was recorded in another run.
    Recording(Recording),
}

/// The record of inputs of a [`Region`].
pub struct MemorySource {
    region: Arc<Region>,
    seen: u64,
    record: Vec<u64>,
    /// The odd counter that was found last, and how often in a row.
    busy: (u64, u64),
}

impl MemorySource {
    /// Reads from here.
    pub fn new(region: Arc<Region>) -> Self {
        let record = vec![0; region.input_words()];
        Self { region, seen: 0, record, busy: (0, 0) }
    }

    fn poll(&mut self, intake: &mut Intake) {
        match self.region.read(self.seen, &mut self.record) {
            Found::Same => {}
            Found::Torn(counter) => {
                intake.note_torn();
                self.free(counter, intake.patience());
            }
            Found::New(counter) => {
                self.seen = counter;
                let writer = Client::Writer(self.record[0]);
                intake.offer_words(writer, self.record[1..].iter().copied());
            }
        }
    }

    /// Frees the record where the same client has been writing for longer than one may be silent until another takes over.
    fn free(&mut self, counter: u64, patience: u64) {
        let times = if self.busy.0 == counter { self.busy.1 + 1 } else { 1 };
        self.busy = (counter, times);
        if times >= patience && counter & 1 == 1 && self.region.free(counter) {
            // Half written as it is.
            self.seen = counter.wrapping_add(1);
        }
    }
}

/// A socket that takes packets at an address and never waits.
///
/// # Errors
/// What the system says, such as a port in use.
pub fn socket(address: std::net::SocketAddr) -> io::Result<UdpSocket> {
    let socket = UdpSocket::bind(address)?;
    socket.set_nonblocking(true)?;
    Ok(socket)
}

impl Source {
    /// Looks what has come, and has it judged.
    pub fn poll(&mut self, intake: &mut Intake) {
        match self {
            Self::None => {}
            Self::Udp(socket) => receive(socket, intake),
            Self::Memory(memory) => memory.poll(intake),
            Self::Lines(lines) => lines.poll(intake),
            Self::Recording(recording) => recording.poll(intake),
        }
    }
}

fn receive(socket: &UdpSocket, intake: &mut Intake) {
    // One byte more than any packet has: what is longer is cut to a length that is wrong.
    let mut bytes = [0; wire::length(MOST_VALUES) + 1];
    for _ in 0..MOST_PACKETS {
        match socket.recv_from(&mut bytes) {
            Ok((length, address)) => intake.offer(Client::Address(address), &bytes[..length]),
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => return,
            // Such as the echo of an output that nobody was there to take: the next packet may be good.
            Err(_) => {}
        }
    }
}
