//! A socket that is open to all until somebody has the inputs, and then to that client alone.

use crate::intake::{Client, Intake};
use crate::wire::{self, MOST_VALUES};
use std::io;
use std::net::{SocketAddr, UdpSocket};

/// Most packets that are taken off a socket in a frame: a flood costs no more than this.
const MOST_PACKETS: usize = 32;

/// A socket that takes packets. While a client has the inputs the system drops what others send: a flood would fill the room that the
/// system has for packets, and those of the client would find none. (Linux; elsewhere all are read and judged.)
pub struct Door {
    socket: UdpSocket,
    /// The one client that is let in.
    guest: Option<SocketAddr>,
    /// Whether anything came from it since.
    heard: bool,
    /// One that could not be heard while it was the only one.
    unheard: Option<SocketAddr>,
}

impl Door {
    /// Open to all.
    pub fn new(socket: UdpSocket) -> Self {
        Self { socket, guest: None, heard: false, unheard: None }
    }

    /// Reads what has come, and has it judged.
    pub(super) fn poll(&mut self, intake: &mut Intake) {
        self.admit(intake);
        // One byte more than any packet has: what is longer is cut to a length that is wrong.
        let mut bytes = [0; wire::length(MOST_VALUES) + 1];
        for _ in 0..MOST_PACKETS {
            match self.socket.recv_from(&mut bytes) {
                Ok((length, address)) => {
                    self.heard |= Some(address) == self.guest;
                    intake.offer(Client::Address(address), &bytes[..length]);
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => break,
                // Such as the echo of an output that nobody was there to take: the next packet may be good.
                Err(_) => {}
            }
        }
        self.admit(intake);
    }

    /// Shuts the others out while somebody has the inputs, and lets them in when that one has been silent for so long that another may
    /// take over.
    fn admit(&mut self, intake: &Intake) {
        let owner = match intake.holder() {
            Some(Client::Address(address)) => Some(address),
            _ => None,
        };
        if owner == self.guest || (owner.is_some() && owner == self.unheard) {
            return;
        }
        // The socket of an address that stands for all of a machine gets one of them when it is connected: a client that speaks to
        // another one of them is no longer heard.
        if owner.is_none() && !self.heard {
            self.unheard = self.guest;
        }
        // Where the system refuses, all are heard: what others say is still judged.
        if connect(&self.socket, owner).is_ok() {
            (self.guest, self.heard) = (owner, false);
        }
    }
}

/// Lets in what one address sends, or all.
#[cfg(target_os = "linux")]
fn connect(socket: &UdpSocket, to: Option<SocketAddr>) -> io::Result<()> {
    match to {
        Some(address) => socket.connect(address),
        None => Ok(rustix::net::connect_unspec(socket)?),
    }
}

/// Elsewhere a socket that is connected may send to nobody by address, as outputs are.
#[cfg(not(target_os = "linux"))]
fn connect(_: &UdpSocket, _: Option<SocketAddr>) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
