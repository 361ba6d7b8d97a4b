//! A drive as a plant.

use super::channels::{Feed, Reading};
use super::commanded::Commanded;
use super::{Input, Output, Plant, PlantError, Work, between, done};
use stickslip_drive::{Limits, Model, Plan, Run, RunError, State};
use stickslip_drive::{Unrecorded, Watcher};

/// A drive: a run that goes on from one multiple of the frame to the next.
pub struct Drive<'m> {
    run: Run<'m>,
    /// Length of a frame, s.
    period: f64,
    /// Frames since t = 0.
    frame: u64,
    feeds: Vec<Feed>,
    generators: Vec<Commanded>,
    readings: Vec<Reading>,
    /// All channels, where any of them is told that lies nowhere else.
    row: Vec<f64>,
    model: &'m Model,
    /// Who may end it within a frame.
    observer: &'m (dyn Watcher + Sync),
}

impl<'m> Drive<'m> {
    /// A drive at the start of frame `frame`, whose state lies there; frame k goes from k·T to (k+1)·T, multiplied and not
    /// summed. Of the plan its stepper counts: a run in real time has no other end than its frames, and no rows.
    ///
    /// # Errors
    /// A stepper that cannot be held, or a fixed step too long for the scene.
    pub fn new(
        model: &'m Model,
        plan: &Plan,
        (state, frame): (State, u64),
        period: f64,
        (inputs, outputs): (&[Input], &[Output]),
    ) -> Result<Self, RunError> {
        let plan = Self::plan(plan);
        let run = if frame == 0 { Run::new(model, &plan, state)? } else { Run::resume(model, &plan, state)? };
        // What nothing follows is no input of the model.
        let is_spared = |place: &usize| model.spared().waveforms.contains(place);
        let feed = |input: &Input| match input.feed {
            Feed::Hold(place) | Feed::Lead(place) | Feed::Command(place, _) if is_spared(&place) => {
                Feed::Note
            }
            feed => feed,
        };
        let feeds: Vec<Feed> = inputs.iter().map(feed).collect();
        let mut generators: Vec<Commanded> = Vec::new();
        for feed in &feeds {
            match *feed {
                Feed::Command(place, _) if !generators.iter().any(|known| known.is_at(place)) => {
                    generators.push(Commanded::new(place));
                }
                _ => {}
            }
        }
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

    /// The same, ended within a frame that takes long as soon as an observer wants it.
    #[must_use]
    pub fn heeding(self, observer: &'m (dyn Watcher + Sync)) -> Self {
        Self { observer, ..self }
    }

    /// The same after a frame of these inputs: what generators were told then is not commanded anew. Before the first frame these
    /// are the initial values; a drive that is taken up later has to be told, for its state knows the steps that are left and not how
    /// many were asked for.
    #[must_use]
    pub fn after(mut self, inputs: &[f64]) -> Self {
        self.hear(inputs);
        self.generators.iter_mut().for_each(Commanded::know);
        self
    }

    /// Lets generators hear their values.
    #[inline]
    fn hear(&mut self, inputs: &[f64]) {
        for (feed, value) in self.feeds.iter().zip(inputs) {
            let Feed::Command(place, part) = *feed else { continue };
            for generator in self.generators.iter_mut().filter(|generator| generator.is_at(place)) {
                generator.hear(part, *value);
            }
        }
    }

    /// The plan that a run in real time has: no rows, no guards by counts or by the clock.
    fn plan(plan: &Plan) -> Plan {
        let limits = Limits { steps: u64::MAX, events: u64::MAX, wall: None };
        Plan { every: None, until_steady: None, limits, ..*plan }
    }

    /// Where it stands.
    pub fn state(&self) -> &State {
        self.run.state()
    }

    /// The values told where it stands.
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
                    // The channel is there, so the coordinate is.
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
