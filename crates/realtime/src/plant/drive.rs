//! A simulated drive as a plant.

use super::channels::Reading;
use super::{Input, Output, Plant, PlantError, Work, between, done};
use stickslip_drive::inputs::{Commanded, Feed};
use stickslip_drive::{Limits, Model, Plan, Run, RunError, State};
use stickslip_drive::{Unrecorded, Watcher};

/// A simulated drive: a run that is advanced from one multiple of the frame length to the next.
pub struct Drive<'m> {
    run: Run<'m>,
    /// Length of a frame, s.
    period: f64,
    /// Number of frames since t = 0.
    frame: u64,
    feeds: Vec<Feed>,
    generators: Vec<Commanded>,
    readings: Vec<Reading>,
    /// Row of all channels. The row is computed only if an output needs it.
    row: Vec<f64>,
    model: &'m Model,
    /// Watcher that can end the run within a frame.
    observer: &'m (dyn Watcher + Sync),
}

impl<'m> Drive<'m> {
    /// Creates a drive at the start of frame `frame`. The time of its state must be the start of this frame.
    ///
    /// Frame k extends from k·T to (k+1)·T, times computed by multiplication, not by summation. Only the integrator of the plan is used.
    ///
    /// # Errors
    /// The integrator cannot run in frames, or its fixed time step is too long for the model.
    pub fn new(
        model: &'m Model,
        plan: &Plan,
        (state, frame): (State, u64),
        period: f64,
        (inputs, outputs): (&[Input], &[Output]),
    ) -> Result<Self, RunError> {
        let plan = Self::plan(plan);
        let run = if frame == 0 { Run::new(model, &plan, state)? } else { Run::resume(model, &plan, state)? };
        // An input that no part of the model follows has no effect.
        let is_spared = |place: &usize| model.spared().waveforms.contains(place);
        let feed = |input: &Input| match input.feed {
            Feed::Hold(place) | Feed::Lead(place) | Feed::Command(place, _) if is_spared(&place) => {
                Feed::Note
            }
            feed => feed,
        };
        let feeds: Vec<Feed> = inputs.iter().map(feed).collect();
        let generators = Commanded::all(feeds.iter().copied());
        let initial: Vec<f64> = inputs.iter().map(|input| input.initial).collect();
        let drive = Self {
            run,
            period,
            frame,
            feeds,
            generators,
            readings: outputs.iter().map(|output| output.reading).collect(),
            row: Vec::with_capacity(model.channels().len()),
            model,
            observer: &(),
        };
        Ok(drive.after(&initial))
    }

    /// Returns the drive with a watcher that can end a long frame.
    #[must_use]
    pub fn heeding(self, observer: &'m (dyn Watcher + Sync)) -> Self {
        Self { observer, ..self }
    }

    /// Returns the drive after a frame with these inputs: equal commands in the next frame are then not given again.
    ///
    /// A new drive has the initial values as last inputs. A resumed drive needs this call, because its state contains the number of
    /// remaining cycles but not the commanded number.
    #[must_use]
    pub fn after(mut self, inputs: &[f64]) -> Self {
        self.hear(inputs);
        self.generators.iter_mut().for_each(Commanded::know);
        self
    }

    /// Passes the input values to the generators.
    #[inline]
    fn hear(&mut self, inputs: &[f64]) {
        for (feed, value) in self.feeds.iter().zip(inputs) {
            self.generators.iter_mut().for_each(|generator| generator.hear(*feed, *value));
        }
    }

    /// Returns the plan of a real-time run: without rows and without limits on counts or wall time.
    fn plan(plan: &Plan) -> Plan {
        let limits = Limits { steps: u64::MAX, events: u64::MAX, wall: None };
        Plan { every: None, until_steady: None, limits, ..*plan }
    }

    /// Returns the current state.
    pub fn state(&self) -> &State {
        self.run.state()
    }

    /// Writes the output values of the current state.
    pub fn tell(&mut self, outputs: &mut [f64]) {
        if self.readings.iter().any(|reading| matches!(reading, Reading::Row(_))) {
            self.run.row(&mut self.row);
        }
        let state = self.run.state();
        for (output, reading) in outputs.iter_mut().zip(&self.readings) {
            *output = match *reading {
                Reading::Time => state.time(),
                Reading::Row(place) => self.row[place],
                Reading::Coordinate { body, axis, is_rate } => {
                    // The channel exists, therefore the coordinate does.
                    let (value, rate) = state.coordinate(self.model, body, axis).unwrap_or_default();
                    if is_rate { rate } else { value }
                }
            };
        }
    }
}

impl Plant for Drive<'_> {
    fn frame(&mut self, inputs: &[f64], outputs: &mut [f64]) -> Result<Work, PlantError> {
        let before = done(&self.run);
        self.frame += 1;
        let until = self.frame as f64 * self.period;
        for (feed, value) in self.feeds.iter().zip(inputs) {
            match *feed {
                Feed::Hold(place) => self.run.hold(place, *value)?,
                Feed::Lead(place) => self.run.lead(place, until, *value)?,
                Feed::Command(..) | Feed::Note => {}
            }
        }
        if !self.generators.is_empty() {
            self.hear(inputs);
            for generator in &mut self.generators {
                generator.command(&mut self.run)?;
            }
        }
        self.run.advance(until, &mut Unrecorded(self.observer))?;
        self.tell(outputs);
        Ok(between(&before, &done(&self.run)))
    }
}
