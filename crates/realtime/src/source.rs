//! Sources of the inputs.

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

/// Source of the inputs. The loop polls the source once before each frame and never waits for it.
pub enum Source {
    /// No source: the initial values are used.
    None,
    /// UDP packets. The latest valid packet is used.
    Udp(Door),
    /// The input record in shared memory.
    Memory(MemorySource),
    /// Lines of text.
    Lines(Lines),
    /// The recorded inputs of another run.
    Recording(Recording),
}

/// Reader of the input record of a [`Region`].
pub struct MemorySource {
    region: Arc<Region>,
    seen: u64,
    record: Vec<u64>,
    /// Counter of the last incomplete record, and number of consecutive frames with this counter.
    busy: (u64, u64),
}

impl MemorySource {
    /// Creates a reader of the input record.
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

    /// Releases the record if the same write is incomplete for `patience` frames, because its writer was killed.
    fn free(&mut self, counter: u64, patience: u64) {
        let times = if self.busy.0 == counter { self.busy.1 + 1 } else { 1 };
        self.busy = (counter, times);
        if times >= patience && counter & 1 == 1 && self.region.free(counter) {
            // The released record is incomplete and must not be read.
            self.seen = counter.wrapping_add(1);
        }
    }
}

/// Opens a non-blocking UDP socket.
///
/// # Errors
/// The operating system returns an error, such as a port in use.
pub fn socket(address: std::net::SocketAddr) -> io::Result<UdpSocket> {
    // A port chosen by the system would be lost when the socket is disconnected. Therefore the socket is bound again by port number.
    let address = if address.port() == 0 { UdpSocket::bind(address)?.local_addr()? } else { address };
    let socket = UdpSocket::bind(address)?;
    socket.set_nonblocking(true)?;
    Ok(socket)
}

impl Source {
    /// Reads the received inputs and passes them to the validator.
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
