//! Validation of received input packets. The validation guarantees valid input values in every frame.
//!
//! * A packet is refused and counted if its length, format or scenario number is wrong. Packets with values or time stamps that are not
//!   finite or out of range are refused, too. The last valid values remain.
//! * The sequence numbers of a client must ascend. Packets with the same or a smaller number are refused and counted. Gaps are allowed.
//! * Of several accepted packets within a frame, the last packet is used. The other packets are counted as superseded.
//! * The first client with an accepted packet owns the inputs until it has been silent for a given number of frames. Packets of other
//!   clients are refused and counted. Afterwards any client can take over by a valid packet with any sequence number.
//! * A frame without an accepted packet is stale and uses the last values. After too many stale frames, [`Silence`] determines whether
//!   these values are held, the initial values are restored, or the loop ends.

use crate::pace::Stop;
use crate::plant::{Input, Takes};
use crate::wire::{self, Misfit, Stamp};
use schemars::JsonSchema;
use serde::Serialize;
use std::net::SocketAddr;

/// Sender of a packet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Client {
    /// Client with a network address.
    Address(SocketAddr),
    /// Client that writes into shared memory, with its client number.
    Writer(u64),
    /// The only possible client, for sources such as lines of text.
    Only,
}

/// Action of the loop after a long time without an accepted packet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Silence {
    /// The last values are held.
    #[default]
    Hold,
    /// The initial values are restored.
    Initial,
    /// The loop ends.
    Stop,
}

/// Time limits for silent clients, in frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Patience {
    /// Action after `silent_after` frames without an accepted packet.
    pub silence: Silence,
    /// Number of frames without an accepted packet until the action `silence` is taken.
    pub silent_after: u64,
    /// Number of frames without an accepted packet until another client may take over.
    pub owner: u64,
}

/// Numbers of accepted and refused inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, JsonSchema)]
pub struct Received {
    /// number of accepted packets or lines, including superseded ones
    pub good: u64,
    /// number of accepted packets that a later one in the same frame replaced
    pub superseded: u64,
    /// number of refused packets of wrong length
    pub wrong_length: u64,
    /// number of refused packets of another format or version, or with another number of values
    pub foreign: u64,
    /// number of refused packets with another scenario number
    pub other_scenario: u64,
    /// number of refused packets with the same sequence number as the last one
    pub repeated: u64,
    /// number of refused packets with a smaller sequence number than the last one
    pub out_of_order: u64,
    /// number of refused packets with a value outside its range, or a value or time stamp that is not finite
    pub out_of_range: u64,
    /// number of refused packets of another client than the owner of the inputs
    pub other_client: u64,
    /// number of frames in which the shared memory was being written at every attempt to read it
    pub torn_frames: u64,
    /// number of frames without an accepted input
    pub stale_frames: u64,
    /// largest number of frames in succession without an accepted input
    pub most_stale: u64,
    /// number of clients that owned the inputs, one after the other
    pub owners: u64,
    /// number of times that `--silence` took effect
    pub silences: u64,
}

impl Received {
    /// Returns the numbers of refused packets as text. Returns `None` if no packet was refused.
    #[must_use]
    pub fn refused(&self) -> Option<String> {
        let counts = [
            (self.wrong_length, "of wrong length"),
            (self.foreign, "no packets"),
            (self.other_scenario, "of another scenario"),
            (self.repeated, "repeated"),
            (self.out_of_order, "out of order"),
            (self.out_of_range, "out of range"),
            (self.other_client, "of another client"),
        ];
        let told = counts.into_iter().filter(|(count, _)| *count > 0);
        let told: Vec<String> = told.map(|(count, what)| format!("{count} {what}")).collect();
        (!told.is_empty()).then(|| told.join(", "))
    }
}

/// Validator of packets, with the input values for the next frame.
#[derive(Debug)]
pub struct Intake {
    scenario: u64,
    initial: Vec<f64>,
    takes: Vec<Takes>,
    patience: Patience,
    values: Vec<f64>,
    candidate: Vec<f64>,
    owner: Option<(Client, u64)>,
    /// Number of packets accepted since the last frame.
    fresh: u64,
    /// Number of stale frames since the last accepted packet.
    stale: u64,
    received: Received,
}

impl Intake {
    /// Creates a validator with the initial values and no owner.
    pub fn new(scenario: u64, inputs: &[Input], patience: Patience) -> Self {
        let initial: Vec<f64> = inputs.iter().map(|input| input.initial).collect();
        Self {
            scenario,
            takes: inputs.iter().map(|input| input.takes).collect(),
            patience,
            values: initial.clone(),
            candidate: initial.clone(),
            initial,
            owner: None,
            fresh: 0,
            stale: 0,
            received: Received::default(),
        }
    }

    /// Returns the number of the scenario.
    pub fn scenario(&self) -> u64 {
        self.scenario
    }

    /// Returns the number of input values.
    pub fn width(&self) -> usize {
        self.initial.len()
    }

    /// Returns the input values for the next frame.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns the counts of accepted and refused packets.
    pub fn received(&self) -> &Received {
        &self.received
    }

    /// Returns the number of silent frames after which another client may take over.
    pub(crate) fn patience(&self) -> u64 {
        self.patience.owner
    }

    /// Returns the client that owns the inputs.
    pub fn owner(&self) -> Option<Client> {
        self.owner.map(|(client, _)| client)
    }

    /// Returns the client that owns the inputs, unless another client may take over.
    pub(crate) fn holder(&self) -> Option<Client> {
        self.owner().filter(|_| !self.has_lapsed())
    }

    /// Returns whether the owner has been silent for so long that another client may take over.
    fn has_lapsed(&self) -> bool {
        self.stale >= self.patience.owner
    }

    /// Validates a packet and stores its values if it is accepted.
    pub fn offer(&mut self, client: Client, bytes: &[u8]) {
        let mut candidate = std::mem::take(&mut self.candidate);
        let stamp = wire::decode(bytes, self.scenario, &mut candidate);
        self.judge(client, stamp, candidate);
    }

    /// Validates a packet that consists of 64-bit words.
    pub(crate) fn offer_words(&mut self, client: Client, words: impl Iterator<Item = u64>) {
        let mut candidate = std::mem::take(&mut self.candidate);
        let stamp = wire::read(words, self.scenario, &mut candidate);
        self.judge(client, stamp, candidate);
    }

    /// Counts a refused packet: as a packet of wrong length if `length` is true, otherwise as a packet of another format.
    pub(crate) fn note_foreign(&mut self, length: bool) {
        *(if length { &mut self.received.wrong_length } else { &mut self.received.foreign }) += 1;
    }

    /// Counts refused packets with a value out of range.
    pub(crate) fn note_out_of_range(&mut self, count: u64) {
        self.received.out_of_range += count;
    }

    /// Counts accepted packets that were replaced by a later packet in the same frame.
    pub(crate) fn note_superseded(&mut self, count: u64) {
        self.received.good += count;
        self.received.superseded += count;
    }

    /// Counts a frame in which every attempt to read the shared memory met an unfinished write.
    pub(crate) fn note_torn(&mut self) {
        self.received.torn_frames += 1;
    }

    /// Sets input values that have already been validated.
    pub(crate) fn impose(&mut self, values: &[f64]) {
        self.values.copy_from_slice(values);
        (self.fresh, self.received.good) = (1, self.received.good + 1);
    }

    fn judge(&mut self, client: Client, stamp: Result<Stamp, Misfit>, candidate: Vec<f64>) {
        self.candidate = candidate;
        let lapsed = self.has_lapsed();
        let received = &mut self.received;
        let stamp = match stamp {
            Ok(stamp) => stamp,
            Err(Misfit::Length) => return received.wrong_length += 1,
            Err(Misfit::Foreign) => return received.foreign += 1,
            Err(Misfit::Scenario) => return received.other_scenario += 1,
        };
        match self.owner {
            Some((owner, _)) if owner != client && !lapsed => return received.other_client += 1,
            Some((_, last)) if !lapsed && stamp.sequence == last => return received.repeated += 1,
            Some((_, last)) if !lapsed && stamp.sequence < last => return received.out_of_order += 1,
            _ => {}
        }
        let fits = |(value, takes): (&f64, &Takes)| takes.has(*value);
        if !stamp.time.is_finite() || !self.candidate.iter().zip(&self.takes).all(fits) {
            return received.out_of_range += 1;
        }
        if self.owner.is_none() || lapsed {
            received.owners += 1;
        }
        received.good += 1;
        self.owner = Some((client, stamp.sequence));
        self.values.copy_from_slice(&self.candidate);
        self.stale = 0;
        self.fresh += 1;
    }

    /// Ends a frame and applies the action for silence.
    ///
    /// # Errors
    /// [`Stop::Silence`] if the silence exceeds its limit and the action for silence is to stop.
    pub fn settle(&mut self) -> Result<(), Stop> {
        let received = &mut self.received;
        received.superseded += self.fresh.saturating_sub(1);
        if std::mem::take(&mut self.fresh) > 0 || self.initial.is_empty() {
            self.stale = 0;
            return Ok(());
        }
        self.stale += 1;
        received.stale_frames += 1;
        received.most_stale = received.most_stale.max(self.stale);
        if self.stale == self.patience.silent_after {
            received.silences += 1;
            match self.patience.silence {
                Silence::Hold => {}
                Silence::Initial => self.values.copy_from_slice(&self.initial),
                Silence::Stop => return Err(Stop::Silence),
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
