//! UDP socket for the inputs. The socket receives from all addresses until a client owns the inputs, and then only from this client.

use crate::intake::{Client, Intake};
use crate::wire::{self, MOST_VALUES};
use std::io;
use std::net::{SocketAddr, UdpSocket};

/// Maximum number of packets that are read in a frame. The limit bounds the time that a flood of packets costs.
const MOST_PACKETS: usize = 32;

/// UDP socket of the inputs.
///
/// While a client owns the inputs, Linux drops the packets of other clients, so that a flood cannot fill the receive buffer. On other
/// systems all packets are read and validated.
pub struct Door {
    socket: UdpSocket,
    /// Address of the only client whose packets are received. `None` receives all packets.
    guest: Option<SocketAddr>,
    /// Whether a packet of this client has arrived since the socket was restricted to it.
    heard: bool,
    /// Address of a client whose packets were lost when the socket was restricted to it.
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
                // Such an error may concern an output that no receiver accepted. The next input packet may be valid.
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
        // A socket bound to all addresses of a machine gets one of these addresses when it is connected. Packets of a client to other
        // addresses are then lost.
        if owner.is_none() && !self.heard {
            self.unheard = self.guest;
        }
        // If the connection fails, all packets are received and validated.
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
