//! Input: values that a caller supplies during the run, held or linear.

use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{finite, smooth};
use crate::waveform::{Timing, WaveformError};

/// Interpolation of an input between values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// Held: the value is constant until the caller gives another one, which is a jump.
    ///
    /// In a jump contacts follow a straight path in zero time, and its work counts. The model refuses dampers whose length would jump.
    #[default]
    Held,
    /// Linear from the present value to the value and time given by the caller, then constant.
    Linear,
}

/// Returns a chain of supplied pieces with the initial value before them.
pub(super) fn course(
    initial: f64,
    range: (f64, f64),
    interpolation: Interpolation,
    timing: &Timing,
) -> Result<Course, WaveformError> {
    timing.check_supplied()?;
    check(initial, range)?;
    Ok(Course {
        chain: Chain::Supplied(interpolation),
        ends: Some((initial, initial)),
        period: None,
        range,
        wave: f64::INFINITY,
        has_jumps: interpolation == Interpolation::Held && range.0 < range.1,
    })
}

fn check(initial: f64, (low, high): (f64, f64)) -> Result<(), WaveformError> {
    finite("initial", initial)?;
    finite("range", low)?;
    finite("range", high)?;
    if low > high {
        return Err(WaveformError::Range { low, high });
    }
    // Largest possible jump or rise.
    smooth("range", high, high - low)?;
    if initial < low || initial > high {
        return Err(WaveformError::Initial { low, high, got: initial });
    }
    Ok(())
}
