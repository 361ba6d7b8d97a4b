//! Input: what a caller gives while it runs, held or straight from value to value.

use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{finite, smooth};
use crate::waveform::{Timing, WaveformError};

/// How an input goes from one value to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// The value stays until the caller gives another one, which is a jump.
    ///
    /// A contact moves along its path straight and in no time, and the work of that is booked. A damper would need an
    /// infinite force: the model refuses one whose length would jump.
    #[default]
    Held,
    /// Straight from where it is to the value and the time that the caller gives; the value there is then held.
    Linear,
}

/// Pieces that are supplied; until then the initial value is held.
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
    // The largest jump, or rise.
    smooth("range", high, high - low)?;
    if initial < low || initial > high {
        return Err(WaveformError::Initial { low, high, got: initial });
    }
    Ok(())
}
