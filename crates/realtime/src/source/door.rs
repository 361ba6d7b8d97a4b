//! UDP socket that receives from all addresses until a client owns the inputs, and then from this client only.

use crate::intake::{Client, Intake};
use crate::wire::{self, MOST_VALUES};
use std::io;
use std::net::{SocketAddr, UdpSocket};

/// Maximum number of packets that are read in a frame, which limits the cost of a flood of packets.
const MOST_PACKETS: usize = 32;

/// UDP socket of the inputs.
///
/// While a client owns the inputs, the system drops the packets of others. Otherwise a flood could fill the receive buffer. This works on
/// Linux; on other systems all packets are read and validated.
pub struct Door {
    socket: UdpSocket,
    /// Address of the only client that is received.
    guest: Option<SocketAddr>,
    /// Whether a packet of this client has arrived since.
    heard: bool,
    /// Address of a client that could not be received exclusively.
    unheard: Option<SocketAddr>,
}

impl Door {
    /// Creates a receiver for all addresses.
    pub fn new(socket: UdpSocket) -> Self {
        Self { socket, guest: None, heard: false, unheard: None }
    }

    /// Reads the received packets and passes them to the validator.
    pub(super) fn poll(&mut self, intake: &mut Intake) {
        self.admit(intake);
        // The buffer is one byte longer than any packet, so that longer packets have a wrong length.
        let mut bytes = [0; wire::length(MOST_VALUES) + 1];
        for _ in 0..MOST_PACKETS {
            match self.socket.recv_from(&mut bytes) {
                Ok((length, address)) => {
                    self.heard |= Some(address) == self.guest;
                    intake.offer(Client::Address(address), &bytes[..length]);
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => break,
                // Such an error may report an output that no receiver accepted. The next packet may be valid.
                Err(_) => {}
            }
        }
        self.admit(intake);
    }

    /// Restricts the socket to the owner of the inputs, or opens it to all if another client may take over.
    fn admit(&mut self, intake: &Intake) {
        let owner = match intake.holder() {
            Some(Client::Address(address)) => Some(address),
            _ => None,
        };
        if owner == self.guest || (owner.is_some() && owner == self.unheard) {
            return;
        }
        // A socket bound to all addresses of a machine is assigned one of them when it is connected. Packets of a client to another of
        // these addresses are then lost.
        if owner.is_none() && !self.heard {
            self.unheard = self.guest;
        }
        // If the system refuses, all packets are received and validated.
        if connect(&self.socket, owner).is_ok() {
            (self.guest, self.heard) = (owner, false);
        }
    }
}

/// Connects the socket to one address, or disconnects it.
#[cfg(target_os = "linux")]
fn connect(socket: &UdpSocket, to: Option<SocketAddr>) -> io::Result<()> {
    match to {
        Some(address) => socket.connect(address),
        None => Ok(rustix::net::connect_unspec(socket)?),
    }
}

/// On other systems, a connected socket may not send to other addresses, which the outputs need.
#[cfg(not(target_os = "linux"))]
fn connect(_: &UdpSocket, _: Option<SocketAddr>) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
