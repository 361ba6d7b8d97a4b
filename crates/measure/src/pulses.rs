//! Single pulses of a burst or a sequence: the displacement of the body in each of them.

use crate::Setting;
use crate::periods::Periods;
use stickslip_drive::scene::Freedom;

/// Distance of two times, in pulses, below which both count as equal.
const SAME: f64 = 1e-9;

/// A pulse with the step that it makes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// Number of the pulse, from 1.
    pub number: u64,
    /// Start and end, s.
    pub span: [f64; 2],
    /// 1, or -1 for a pulse that is reversed in time.
    pub direction: i32,
    /// Position of the body at the end minus that at the start, m.
    pub step: f64,
    /// Whether the pulse before had the other direction.
    pub after_turn: bool,
}

/// Times of the pulses of a run in order, and the pulse in progress.
#[derive(Debug, Clone)]
pub struct Pulses {
    periods: Periods,
    /// Start of each pulse within a period, s, and whether it is reversed.
    pulses: Vec<(f64, bool)>,
    /// Duration of a pulse, s.
    length: f64,
    /// Index of the column of the body's position.
    column: usize,
    /// Number of the pulse that has begun or begins next, from 0, and the position at its start, m.
    next: u64,
    from: Option<f64>,
    /// Number of the pulse whose start or end is the next sampling time, and whether it is the end.
    due: (u64, bool),
}

impl Pulses {
    /// Returns the pulses of the waveform in `figures`, if it is a burst or a sequence and the body is free.
    pub fn of(setting: &Setting) -> Option<Self> {
        let (scene, figures) = (&setting.scenario.scene, setting.scenario.figures);
        let waveform = &scene.waveforms.get(figures.waveform?)?.part;
        let body = scene.bodies.get(figures.body?).filter(|body| body.part.x.freedom == Freedom::Free)?;
        let (pulses, length) = waveform.pulses().filter(|_| waveform.timing().phase == 0.0)?;
        let name = format!("{}.x_m", body.name);
        let column = setting.model.channels().iter().position(|channel| channel.name == name)?;
        let periods = Periods::until(waveform, f64::INFINITY)?;
        Some(Self { periods, pulses, length, column, next: 0, from: None, due: (0, false) })
    }

    /// Returns start and end of a pulse, s, and whether it is reversed. `None` after the last pulse.
    fn pulse(&self, number: u64) -> Option<([f64; 2], bool)> {
        let count = self.pulses.len() as u64;
        let (period, place) = (number / count, (number % count) as usize);
        let (start, reversed) = *self.pulses.get(place).filter(|_| period < self.periods.count as u64)?;
        let start = self.periods.end_of(period as usize) + start;
        Some(([start, start + self.length], reversed))
    }

    /// Returns the next sampling time, s.
    pub(crate) fn due(&self) -> Option<f64> {
        let (number, ends) = self.due;
        self.pulse(number).map(|(span, _)| span[usize::from(ends)])
    }

    /// Moves on to the first sampling time after t, s.
    pub(crate) fn pass(&mut self, t: f64) {
        while self.due().is_some_and(|due| due <= t + SAME * self.length) {
            self.due = if self.due.1 { (self.due.0 + 1, false) } else { (self.due.0, true) };
        }
    }

    /// Takes a sample. Returns the pulse that ends there.
    pub fn sample(&mut self, values: &[f64]) -> Option<Pulse> {
        let (t, x) = (*values.first()?, *values.get(self.column)?);
        let (span, reversed) = self.pulse(self.next)?;
        let is_near = |time: f64| (t - time).abs() <= SAME * self.length + 4.0 * f64::EPSILON * t.abs();
        let mut ended = None;
        if let Some(from) = self.from.filter(|_| is_near(span[1])) {
            let before = self.next.checked_sub(1).and_then(|before| self.pulse(before));
            ended = Some(Pulse {
                number: self.next + 1,
                span,
                direction: if reversed { -1 } else { 1 },
                step: x - from,
                after_turn: before.is_some_and(|(_, before)| before != reversed),
            });
            self.next += 1;
            self.from = None;
        }
        if self.pulse(self.next).is_some_and(|(span, _)| is_near(span[0])) {
            self.from = Some(x);
        }
        ended
    }
}
