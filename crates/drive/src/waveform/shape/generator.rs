//! Generator: cycles made inside, whose stroke, frequency, heading and number a caller commands while they run.
//!
//! A frame of a control loop is longer than a flyback: what is fed from outside piece by piece cannot carry it. A generator
//! makes its cycles itself, corners exact, and only their parameters come from outside. Each cycle takes those that are in
//! force when it begins and keeps them to its end.

use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{finite, within};
use crate::waveform::{Timing, WaveformError};

/// A waveform of cycles that a caller commands.
///
/// A cycle begins and ends at 0 and reaches its stroke between: the value stays in [0, stroke] and is continuous, whatever is
/// commanded. With nothing to do (no steps left, no frequency, no stroke) it rests at 0, and a command begins a cycle at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Generator {
    /// Form of a cycle.
    pub cycle: Cycle,
    /// In force from t = 0 on. In a run without a caller the waveform is the sawtooth, or triangle, of these numbers.
    pub initial: Command,
    /// Smallest and largest stroke that may be commanded, in the unit of what is driven; any sign. What is checked before a run
    /// holds for all of them.
    pub strokes: (f64, f64),
    /// Smallest and largest frequency that may be commanded, Hz; at least 0, and with room for the flyback.
    pub frequencies: (f64, f64),
}

/// Form of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cycle {
    /// From 0 straight to the stroke, straight back in the flyback; backward the other way round in time.
    Sawtooth {
        /// Time of the fast way, s, above 0 and below the shortest period.
        flyback: f64,
    },
    /// From 0 straight to the stroke in half a period, straight back: the same in both headings.
    Triangle,
}

/// What a generator does from its next cycle on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command {
    /// Peak to peak, in the unit of what is driven; 0 is rest.
    pub stroke: f64,
    /// Hz; 0 is rest.
    pub frequency: f64,
    /// Which way a slider is carried.
    pub heading: Heading,
    /// How many cycles begin.
    pub steps: Steps,
}

/// Which way in time a cycle runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Heading {
    /// Slowly up, fast back.
    #[default]
    Forward,
    /// The cycle reversed in time: fast up, slowly back.
    ///
    /// Refused was the cycle with its sign changed: it would leave [0, stroke], the window that the electronics have.
    Backward,
}

/// How many cycles are still to begin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Steps {
    /// One after the other.
    #[default]
    Endless,
    /// So many, then rest.
    Left(u64),
}

impl Command {
    /// Whether no cycle comes of it. A frequency whose period is beyond all numbers is none.
    pub(crate) fn is_idle(&self) -> bool {
        let none = self.steps == Steps::Left(0);
        none || self.stroke == 0.0 || !self.period().is_finite()
    }

    /// s; infinite at rest.
    pub(crate) fn period(&self) -> f64 {
        self.frequency.recip()
    }
}

impl Cycle {
    /// When after its start a cycle turns, s.
    pub(crate) fn top(self, command: &Command) -> f64 {
        let period = command.period();
        match (self, command.heading) {
            (Self::Sawtooth { flyback }, Heading::Forward) => period - flyback,
            (Self::Sawtooth { flyback }, Heading::Backward) => flyback,
            (Self::Triangle, _) => 0.5 * period,
        }
    }

    /// The shorter way of a cycle of this frequency (Hz), s.
    fn shortest(self, frequency: f64) -> f64 {
        let period = frequency.recip();
        match self {
            Self::Sawtooth { flyback } => flyback.min(period - flyback),
            Self::Triangle => 0.5 * period,
        }
    }
}

impl Generator {
    /// Whether a command is within its ranges. What is not a number is in none.
    pub(crate) fn takes(&self, command: &Command) -> bool {
        let within = |value: f64, (low, high): (f64, f64)| value >= low && value <= high;
        within(command.stroke, self.strokes) && within(command.frequency, self.frequencies)
    }

    /// The range of its values, whatever is commanded.
    fn range(&self) -> (f64, f64) {
        (self.strokes.0.min(0.0), self.strokes.1.max(0.0))
    }

    /// When it runs without a caller.
    pub(super) fn timing(&self) -> Timing {
        let cycles = match self.initial.steps {
            Steps::Endless => None,
            Steps::Left(steps) => Some(steps as f64),
        };
        Timing { cycles, ..Timing::every(self.initial.period()) }
    }

    /// What it does without a caller: the cycles of the initial command, or rest.
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
        within("range", high - low, "strokes that are reached at a finite rate", steepest.is_finite())
    }
}

/// A value in a range that is one.
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
