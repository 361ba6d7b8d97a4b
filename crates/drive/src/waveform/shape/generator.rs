//! Generator: cycles whose stroke, frequency, direction and number a caller commands during the run.
//!
//! Calls of a control loop are further apart than a flyback lasts, so an input cannot supply the corners of the flyback. A generator
//! computes exact cycles itself. Each cycle uses the parameters at its start until its end.

use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{finite, within};
use crate::waveform::{Timing, WaveformError};

/// Waveform of commanded cycles.
///
/// A cycle begins and ends at 0 and reaches its stroke in between. The value is continuous and within [0, stroke]. Without steps, frequency
/// or stroke the generator rests at 0; from rest, a command begins a cycle at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Generator {
    /// Form of a cycle.
    pub cycle: Cycle,
    /// Command from t = 0. Without later commands the waveform is the sawtooth or triangle with these parameters.
    pub initial: Command,
    /// Smallest and largest stroke that may be commanded, in the unit of the driven quantity, of any sign. Checks before a run cover this
    /// whole range.
    pub strokes: (f64, f64),
    /// Smallest and largest frequency that may be commanded, Hz; at least 0, and small enough for the flyback.
    pub frequencies: (f64, f64),
}

/// Form of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cycle {
    /// Sawtooth: linear from 0 to the stroke, linear return in the flyback; for the backward direction reversed in time.
    Sawtooth {
        /// Duration of the fast stroke, s, above 0 and below the shortest period.
        flyback: f64,
    },
    /// Triangle: linear from 0 to the stroke in half a period, linear return; the same in both directions.
    Triangle,
}

/// Parameters of a generator from its next cycle on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command {
    /// Peak-to-peak value, in the unit of the driven quantity; 0 means rest.
    pub stroke: f64,
    /// Frequency, Hz; 0 means rest.
    pub frequency: f64,
    /// Direction in which a slider moves.
    pub heading: Heading,
    /// Number of cycles to begin.
    pub steps: Steps,
}

/// Direction of a cycle in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Heading {
    /// Slow forward stroke, fast return.
    #[default]
    Forward,
    /// Cycle reversed in time: fast forward stroke, slow return. The value stays within [0, stroke], unlike with a reversed sign.
    Backward,
}

/// Number of cycles to begin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Steps {
    /// Unlimited.
    #[default]
    Endless,
    /// This number, then rest.
    Left(u64),
}

impl Command {
    /// Whether the command starts no cycle: no steps, no stroke, or an infinite period.
    pub(crate) fn is_idle(&self) -> bool {
        let none = self.steps == Steps::Left(0);
        none || self.stroke == 0.0 || !self.period().is_finite()
    }

    /// Returns the period, s; infinite at rest.
    pub(crate) fn period(&self) -> f64 {
        self.frequency.recip()
    }
}

impl Cycle {
    /// Returns the time from the start of a cycle to its turning point, s.
    pub(crate) fn top(self, command: &Command) -> f64 {
        let period = command.period();
        match (self, command.heading) {
            (Self::Sawtooth { flyback }, Heading::Forward) => period - flyback,
            (Self::Sawtooth { flyback }, Heading::Backward) => flyback,
            (Self::Triangle, _) => 0.5 * period,
        }
    }

    /// Returns the duration of the shorter stroke at this frequency (Hz), s.
    fn shortest(self, frequency: f64) -> f64 {
        let period = frequency.recip();
        match self {
            Self::Sawtooth { flyback } => flyback.min(period - flyback),
            Self::Triangle => 0.5 * period,
        }
    }
}

impl Generator {
    /// Whether a command is within the ranges of the generator; NaN is not.
    pub(crate) fn takes(&self, command: &Command) -> bool {
        let within = |value: f64, (low, high): (f64, f64)| value >= low && value <= high;
        within(command.stroke, self.strokes) && within(command.frequency, self.frequencies)
    }

    /// Returns the range of the generator's values for all commands.
    fn range(&self) -> (f64, f64) {
        (self.strokes.0.min(0.0), self.strokes.1.max(0.0))
    }

    /// Returns the timing of the generator without further commands.
    pub(super) fn timing(&self) -> Timing {
        let cycles = match self.initial.steps {
            Steps::Endless => None,
            Steps::Left(steps) => Some(steps as f64),
        };
        Timing { cycles, ..Timing::every(self.initial.period()) }
    }

    /// Returns the chain of pieces without further commands: cycles of the initial command, or rest.
    pub(super) fn course(&self, timing: &Timing) -> Result<Course, WaveformError> {
        timing.check_supplied()?;
        self.check()?;
        let Command { stroke, .. } = self.initial;
        let rest = self.initial.is_idle();
        let legs =
            [Leg::straight(0.0, (0.0, stroke)), Leg::straight(self.cycle.top(&self.initial), (stroke, 0.0))];
        let chain =
            if rest { Chain::Step(0.0) } else { Chain::Corners(Corners::periodic(&legs, &self.timing())) };
        Ok(Course {
            chain,
            ends: rest.then_some((0.0, 0.0)),
            period: (!rest).then(|| self.initial.period()),
            range: self.range(),
            wave: f64::INFINITY,
            has_jumps: false,
        })
    }

    fn check(&self) -> Result<(), WaveformError> {
        let Command { stroke, frequency, .. } = self.initial;
        bounds("stroke", stroke, self.strokes)?;
        bounds("frequency", frequency, self.frequencies)?;
        let (lowest, highest) = self.frequencies;
        within("frequency", lowest, "a range of frequencies of at least 0", lowest >= 0.0)?;
        if let Cycle::Sawtooth { flyback } = self.cycle {
            within("flyback", flyback, "a finite time above 0", flyback > 0.0)?;
            if highest.recip() - flyback <= 0.0 {
                return Err(WaveformError::Room { flyback, frequency: highest });
            }
        }
        let (low, high) = self.range();
        let steepest = (high - low) / self.cycle.shortest(highest);
        within("range", high - low, "strokes reached at a finite rate", steepest.is_finite())
    }
}

/// Checks a range, and whether it contains a value.
fn bounds(key: &'static str, value: f64, (low, high): (f64, f64)) -> Result<(), WaveformError> {
    finite(key, value)?;
    finite(key, low)?;
    finite(key, high)?;
    if low > high {
        return Err(WaveformError::Bounds { key, low, high });
    }
    if value < low || value > high {
        return Err(WaveformError::Outside { key, low, high, got: value });
    }
    Ok(())
}
