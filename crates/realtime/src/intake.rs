//! What is let in: packets are judged one by one, and whatever comes, every frame has good values.
//!
//! * A packet of the wrong length, that is no packet, of another scenario, with a value that is not finite or out of its range,
//!   or with a time stamp that is not finite, is refused and counted; the last good values stay.
//! * Sequence numbers of a client ascend: the same again, or a smaller one, is refused and counted. Gaps are no fault.
//! * Of several good packets within a frame the last counts; the others are counted as superseded.
//! * The first client that says something good has the inputs, until it has been silent for the patience: what others say is
//!   refused and counted. After that the first good packet, whoever sends it and whatever its number, takes over.
//! * A frame without a good packet is stale: the last values are held. After the silence allowed they stay all the same, go
//!   back to their initial values until the next good packet, or end the loop.

use crate::pace::Stop;
use crate::plant::{Input, Takes};
use crate::wire::{self, Misfit, Stamp};
use schemars::JsonSchema;
use serde::Serialize;
use std::net::SocketAddr;

/// Who speaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Client {
    /// From an address of the network.
    Address(SocketAddr),
    /// By the number that it writes into shared memory.
    Writer(u64),
    /// The only one that can.
    Only,
}

/// What happens when no good packet has come for long.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Silence {
    /// The last values stay.
    #[default]
    Hold,
    /// The initial values come back.
    Initial,
    /// The loop ends.
    Stop,
}

/// How long is waited for whom, in frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Patience {
    /// What happens after …
    pub silence: Silence,
    /// … so many frames without a good packet.
    pub silent_after: u64,
    /// After how many another client may take over.
    pub owner: u64,
}

/// What came.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, JsonSchema)]
pub struct Received {
    /// packets or lines that were taken, or that a later one of the same frame followed
    pub good: u64,
    /// of these, followed by another one in the same frame
    pub superseded: u64,
    /// refused: too long or too short
    pub wrong_length: u64,
    /// refused: no packet, another version, or another number of values
    pub foreign: u64,
    /// refused: another scenario's
    pub other_scenario: u64,
    /// refused: the number of the last one again
    pub repeated: u64,
    /// refused: a smaller number than the last one's
    pub out_of_order: u64,
    /// refused: a value or time stamp that is not finite, or a value out of its range
    pub out_of_range: u64,
    /// refused: of another client than the one that has the inputs
    pub other_client: u64,
    /// frames in which somebody was writing into shared memory whenever it was looked at
    pub torn_frames: u64,
    /// frames in which nothing good came
    pub stale_frames: u64,
    /// most of them in a row
    pub most_stale: u64,
    /// clients that had the inputs, one after the other
    pub owners: u64,
    /// times that `--silence` came into force
    pub silences: u64,
}

impl Received {
    /// What was refused, in words; none where nothing was.
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

/// The values for the next frame, and what was judged.
#[derive(Debug)]
pub struct Intake {
    scenario: u64,
    initial: Vec<f64>,
    takes: Vec<Takes>,
    patience: Patience,
    values: Vec<f64>,
    candidate: Vec<f64>,
    owner: Option<(Client, u64)>,
    /// Good packets since the last frame.
    fresh: u64,
    /// Frames since the last good packet.
    stale: u64,
    received: Received,
}

impl Intake {
    /// Initial values, and nobody yet.
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

    /// The scenario's number.
    pub fn scenario(&self) -> u64 {
        self.scenario
    }

    /// Number of values.
    pub fn width(&self) -> usize {
        self.initial.len()
    }

    /// Values for the next frame.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// What came so far.
    pub fn received(&self) -> &Received {
        &self.received
    }

    /// After how many frames of silence another client may take over.
    pub(crate) fn patience(&self) -> u64 {
        self.patience.owner
    }

    /// Who has the inputs.
    pub fn owner(&self) -> Option<Client> {
        self.owner.map(|(client, _)| client)
    }

    /// The same unless another client may take over.
    pub(crate) fn holder(&self) -> Option<Client> {
        self.owner().filter(|_| !self.has_lapsed())
    }

    /// Whether nothing good has come for so long that another client may take over.
    fn has_lapsed(&self) -> bool {
        self.stale >= self.patience.owner
    }

    /// Judges a packet.
    pub fn offer(&mut self, client: Client, bytes: &[u8]) {
        let mut candidate = std::mem::take(&mut self.candidate);
        let stamp = wire::decode(bytes, self.scenario, &mut candidate);
        self.judge(client, stamp, candidate);
    }

    /// Judges a packet that comes as words.
    pub(crate) fn offer_words(&mut self, client: Client, words: impl Iterator<Item = u64>) {
        let mut candidate = std::mem::take(&mut self.candidate);
        let stamp = wire::read(words, self.scenario, &mut candidate);
        self.judge(client, stamp, candidate);
    }

    /// Notes that something came that is none.
    pub(crate) fn note_foreign(&mut self, length: bool) {
        *(if length { &mut self.received.wrong_length } else { &mut self.received.foreign }) += 1;
    }

    /// Notes that so many came with values that are none of an input's.
    pub(crate) fn note_out_of_range(&mut self, count: u64) {
        self.received.out_of_range += count;
    }

    /// Notes that so many good ones were followed by another one before anybody looked.
    pub(crate) fn note_superseded(&mut self, count: u64) {
        self.received.good += count;
        self.received.superseded += count;
    }

    /// Notes a frame in which somebody was always writing.
    pub(crate) fn note_torn(&mut self) {
        self.received.torn_frames += 1;
    }

    /// Takes values that were judged before.
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

    /// Ends the looking for packets of a frame.
    ///
    /// # Errors
    /// Where silence is the end, and there was too much of it.
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
