//! Integration from event to event.

use super::stretch::{Held, Stretch};
use super::{Output, Outside};
use crate::contestant::Stop;
use crate::samples::Samples;
use nalgebra::SVector;
use ode_solvers::continuous_output_model::ContinuousOutputModel;
use ode_solvers::{Dopri5, OutputType, System};
use std::cell::Cell;
use std::time::Instant;
use stickslip_contact::{Apex, Segment};
use stickslip_drive::{Counts, Piece};

/// Velocity relative to the natural velocity below which a change of sign is rounding, not a reversal.
const REST: f64 = 1e-12;
/// Maximum number of steps between two events.
const STEPS: u32 = 10_000_000;

/// Run in natural lengths and velocities. D is twice the number of free coordinates.
pub(super) struct Trip<'a, const D: usize> {
    outside: &'a Outside,
    held: Vec<Held<'a>>,
    pieces: Vec<Piece>,
    t: f64,
    y: SVector<f64, D>,
    counts: Counts,
}

impl<'a, const D: usize> Trip<'a, D> {
    pub(super) fn new(outside: &'a Outside) -> Self {
        let (mechanism, scales) = (&outside.mechanism, &outside.scales);
        let pieces = mechanism.tracks.iter().map(|track| track.waveform.piece_at(0.0)).collect();
        let held = mechanism.ties.iter().map(|tie| {
            let d = tie.start.apex().d;
            let natural = tie.slide.free.iter().zip(scales).filter(|(factor, _)| **factor != 0.0);
            let rest = natural.map(|(_, (_, speed))| REST * speed).fold(f64::INFINITY, f64::min);
            let branch = tie.start.branch(&tie.law, 1.0, 0.0);
            let area = tie.law.profile().reduced_force(d);
            Held { tie, curve: tie.start.clone(), branch, d, area, origin: 0.0, rest }
        });
        let start = |i: usize| {
            let (free, (length, speed)) = (&mechanism.free[i % (D / 2)], scales[i % (D / 2)]);
            if i < D / 2 { free.start.0 / length } else { free.start.1 / speed }
        };
        let y = SVector::from_fn(|i, _| start(i));
        let mut trip = Self { outside, held: held.collect(), pieces, t: 0.0, y, counts: Counts::default() };
        for c in 0..trip.held.len() {
            let (u, _) = trip.motion(c);
            trip.held[c].origin = trip.held[c].curve.apex().u - u;
        }
        trip.set_out();
        trip
    }

    fn stretch<'s>(&'s self, times: &'s Cell<(f64, f64)>, fired: &'s Cell<bool>) -> Stretch<'s, D> {
        let mechanism = &self.outside.mechanism;
        Stretch {
            free: &mechanism.free,
            scales: &self.outside.scales,
            held: &self.held,
            tracks: &mechanism.tracks,
            pieces: &self.pieces,
            times,
            fired,
        }
    }

    /// Returns the current u (m) and u̇ (m/s) of a contact.
    fn motion(&self, c: usize) -> (f64, f64) {
        let (times, fired) = (Cell::new((self.t, self.t)), Cell::new(false));
        self.stretch(&times, &fired).motion(&self.held[c], self.t, &self.y)
    }

    /// Selects the branches after a corner by the direction of sliding; for contacts at rest, by the direction of the acceleration.
    fn set_out(&mut self) {
        let (times, fired) = (Cell::new((self.t, self.t)), Cell::new(false));
        let stretch = self.stretch(&times, &fired);
        let mut dy = SVector::zeros();
        stretch.system(self.t, &self.y, &mut dy);
        let mut senses = Vec::with_capacity(self.held.len());
        for held in &self.held {
            let (_, du) = stretch.motion(held, self.t, &self.y);
            let form = &held.tie.slide;
            let pulled = |(i, (_, speed)): (usize, &(f64, f64))| form.free[i] * speed * dy[D / 2 + i];
            let pull: f64 = self.outside.scales.iter().enumerate().map(pulled).sum();
            senses.push(if du.abs() > held.rest { du } else { pull }.signum());
        }
        for (held, sense) in self.held.iter_mut().zip(senses) {
            if self.t == 0.0 || sense != held.branch.sense() {
                held.branch = held.curve.branch(&held.tie.law, sense, 0.0);
            }
        }
    }

    pub(super) fn run(mut self, tolerance: f64, output: &mut Output<'_>) -> Result<Counts, Stop> {
        let (mut step, duration) = (0.0, self.outside.duration);
        while self.t < duration {
            if !output.watcher.goes_on() {
                return Err(Stop::Interrupted);
            }
            if output.until.is_some_and(|until| Instant::now() > until) {
                return Err(Stop::Slow);
            }
            let corner = self.pieces.iter().map(|piece| piece.end).fold(duration, f64::min);
            step = self.cross(corner, tolerance, step, output)?;
            if self.t == corner {
                for (piece, track) in self.pieces.iter_mut().zip(&self.outside.mechanism.tracks) {
                    while piece.end <= corner {
                        *piece = track.waveform.after(piece);
                    }
                }
                self.set_out();
            }
        }
        if let Some(samples) = &mut output.samples {
            self.keep(samples, &self.y);
        }
        Ok(self.counts)
    }

    /// Integrates to the first event or to the next corner of a waveform. Returns the next step size, s.
    fn cross(
        &mut self,
        corner: f64,
        tolerance: f64,
        step: f64,
        output: &mut Output<'_>,
    ) -> Result<f64, Stop> {
        let begin = self.t;
        // In gross slip nothing limits the step, so it is limited by the resolution of the waveforms.
        let tracks = &self.outside.mechanism.tracks;
        let waves = tracks.iter().map(|track| track.waveform.resolution());
        let longest = waves.fold(corner - begin, f64::min);
        let (times, fired) = (Cell::new((begin, begin)), Cell::new(false));
        let stretch = self.stretch(&times, &fired);
        let mut dense = ContinuousOutputModel::new();
        // Safety 0.9, β 0.04 and the factors 0.2 and 10 are the crate's defaults.
        let mut solver = Dopri5::from_param(
            self.stretch(&times, &fired),
            begin,
            corner,
            longest,
            self.y,
            0.0,
            tolerance,
            0.9,
            0.04,
            0.2,
            10.0,
            longest,
            step.min(longest),
            STEPS,
            u32::MAX,
            OutputType::Continuous,
        );
        let stats = solver
            .integrate_with_continuous_output_model(&mut dense)
            .map_err(|error| Stop::Failed(error.to_string()))?;
        let end = solver.y_out().last().copied().unwrap_or(self.y);
        drop(solver);
        let (from, to) = times.get();
        let event = if fired.get() { stretch.first((from, to), &end, &dense) } else { None };
        let (t, y) = match event {
            Some((t, ..)) if t < to => (t, dense.evaluate(t).unwrap_or(end)),
            Some(_) => (to, end),
            None => (corner, end),
        };
        if let Some(samples) = &mut output.samples {
            self.sample(samples, t, |at| dense.evaluate(at).unwrap_or(self.y));
        }
        (self.t, self.y) = (t, y);
        self.counts.steps += u64::from(stats.accepted_steps);
        self.counts.rejected += u64::from(stats.rejected_steps);
        self.counts.evaluations += u64::from(stats.num_eval);
        self.remember(event.map(|(_, c, g)| (c, g)))?;
        // The last step may have been shortened by the corner, and the step before it may have been longer.
        Ok(if event.is_none() && from > begin { step.max(to - from) } else { to - from })
    }

    /// Updates the memories of all contacts. The contact with the event gets its next branch.
    fn remember(&mut self, event: Option<(usize, usize)>) -> Result<(), Stop> {
        for c in 0..self.held.len() {
            let (u, _) = self.motion(c);
            let held = &mut self.held[c];
            let to = Segment::Straight(Apex { d: held.d, u });
            held.curve.commit(&held.tie.law, to).map_err(|error| Stop::Failed(error.to_string()))?;
            if let Some((_, guard)) = event.filter(|(fallen, _)| *fallen == c) {
                let (sense, left) = (held.branch.sense(), held.branch.margin(held.d, u));
                held.branch = match guard {
                    0 => held.curve.branch(&held.tie.law, -sense, 0.0),
                    // The remainder of the piece after event location counts as used.
                    _ => held.curve.branch(&held.tie.law, sense, 2.0 * left.abs() + f64::EPSILON * held.d),
                };
                self.counts.events += 1;
            }
        }
        Ok(())
    }

    /// Records the samples up to time t, s. `at` returns the state at a time.
    fn sample(&self, samples: &mut Samples, t: f64, at: impl FnMut(f64) -> SVector<f64, D>) {
        let (mut at, interval) = (at, Samples::interval(self.outside.duration));
        while samples.len() + 1 < Samples::complete() && samples.len() as f64 * interval <= t {
            self.keep(samples, &at(samples.len() as f64 * interval));
        }
    }

    fn keep(&self, samples: &mut Samples, y: &SVector<f64, D>) {
        self.outside.scales.iter().enumerate().for_each(|(i, (length, _))| samples.push(length * y[i]));
    }
}
