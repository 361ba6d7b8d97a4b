//! Where inputs come from.

mod door;
mod lines;
mod recording;

pub use door::Door;
pub use lines::Lines;
pub use recording::{Recording, RecordingError, head as recording_head};

use crate::intake::{Client, Intake};
use crate::region::Region;
use crate::seqlock::Found;
use std::io;
use std::net::UdpSocket;
use std::sync::Arc;

/// Where inputs come from; asked once before each frame, and it never waits.
pub enum Source {
    /// From nowhere: the initial values stay.
    None,
    /// Packets over UDP; the newest counts.
    Udp(Door),
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

    pub(crate) fn region(&self) -> &Region {
        &self.region
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
    // A port that the system chooses is lost when the socket is opened to all again: it is asked for by its number.
    let address = if address.port() == 0 { UdpSocket::bind(address)?.local_addr()? } else { address };
    let socket = UdpSocket::bind(address)?;
    socket.set_nonblocking(true)?;
    Ok(socket)
}

impl Source {
    /// Looks what has come, and has it judged.
    pub fn poll(&mut self, intake: &mut Intake) {
        match self {
            Self::None => {}
            Self::Udp(door) => door.poll(intake),
            Self::Memory(memory) => memory.poll(intake),
            Self::Lines(lines) => lines.poll(intake),
            Self::Recording(recording) => recording.poll(intake),
        }
    }
}
