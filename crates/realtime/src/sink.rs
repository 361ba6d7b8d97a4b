//! Where outputs go.

use crate::intake::Client;
use crate::region::Region;
use crate::tape::Tape;
use crate::wire::{self, MOST_VALUES, Stamp};
use std::net::{SocketAddr, UdpSocket};
use std::sync::Arc;

/// Where outputs go; told once after each frame, and it never waits.
pub enum Sink {
    /// Packets over UDP to an address, or to whoever has the inputs.
    Udp {
        /// Sent from here.
        socket: UdpSocket,
        /// To here.
        to: Option<SocketAddr>,
    },
    /// The record of outputs in shared memory.
    Memory(Arc<Region>),
    /// Packets, one after the other, in a file.
    File(Tape),
}

impl Sink {
    /// From now on outputs wait until there is room for them, where they go into a file.
    pub(crate) fn wait(&mut self) {
        if let Self::File(tape) = self {
            tape.wait();
        }
    }

    /// Sends where the drive stands; whether it went out.
    pub fn send(&mut self, scenario: u64, stamp: Stamp, values: &[f64], owner: Option<Client>) -> bool {
        match self {
            Self::Udp { socket, to } => {
                let to = match (*to, owner) {
                    (Some(to), _) | (None, Some(Client::Address(to))) => to,
                    // Nobody has spoken yet.
                    _ => return true,
                };
                let mut bytes = [0; wire::length(MOST_VALUES)];
                let bytes = &mut bytes[..wire::length(values.len())];
                wire::encode(bytes, scenario, stamp, values);
                socket.send_to(bytes, to).is_ok()
            }
            Self::Memory(region) => region.write(stamp, values),
            Self::File(tape) => {
                let before = tape.lost();
                tape.put(wire::words(scenario, stamp, values));
                tape.lost() == before
            }
        }
    }
}
