//! Destinations of the outputs.

use crate::intake::Client;
use crate::region::Region;
use crate::tape::Tape;
use crate::wire::{self, MOST_VALUES, Stamp};
use std::net::{SocketAddr, UdpSocket};
use std::sync::Arc;

/// Destination of the outputs. Every frame sends one packet and does not wait for the receiver.
pub enum Sink {
    /// UDP packets to an address, or to the client that owns the inputs.
    Udp {
        /// Socket that sends the packets.
        socket: UdpSocket,
        /// Address of the receiver. `None` sends to the owner of the inputs.
        to: Option<SocketAddr>,
    },
    /// The output record in shared memory.
    Memory(Arc<Region>),
    /// Consecutive packets in a file.
    File(Tape),
}

impl Sink {
    /// Makes the loop wait until outputs to a file can be written.
    pub(crate) fn wait(&mut self) {
        if let Self::File(tape) = self {
            tape.wait();
        }
    }

    /// Sends the output values of a frame. Returns whether the packet was sent.
    pub fn send(&mut self, scenario: u64, stamp: Stamp, values: &[f64], owner: Option<Client>) -> bool {
        match self {
            Self::Udp { socket, to } => {
                let to = match (*to, owner) {
                    (Some(to), _) | (None, Some(Client::Address(to))) => to,
                    // No client has sent an input yet, so there is no receiver.
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
