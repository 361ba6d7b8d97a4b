//! Editable waveform. Parameters of the waveform are set individually and checked only when it is built, because intermediate combinations
//! may be invalid.

use stickslip_drive::{Shape, Timing, Waveform, WaveformError};

/// A parameter of a waveform with its key in the scenario.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// Stroke, peak to peak.
    Stroke,
    /// Amplitude, half of peak to peak.
    Amplitude,
    /// Mean value of a sine.
    Offset,
    /// Phase of a sine, rad.
    Phase,
    /// Duration of the return stroke, s.
    Flyback,
    /// Period, s.
    Period,
}

/// Shape and timing of a waveform before they are checked.
#[derive(Debug, Clone)]
pub(crate) struct Sketch {
    shape: Shape,
    timing: Timing,
}

impl Quantity {
    const ALL: [Self; 6] =
        [Self::Stroke, Self::Amplitude, Self::Offset, Self::Phase, Self::Flyback, Self::Period];

    /// Returns the key of the parameter in the scenario.
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Stroke => "stroke",
            Self::Amplitude => "amplitude",
            Self::Offset => "offset",
            Self::Phase => "phase",
            Self::Flyback => "flyback",
            Self::Period => "period",
        }
    }
}

impl Sketch {
    pub(crate) fn of(waveform: &Waveform) -> Self {
        Self { shape: waveform.shape().clone(), timing: *waveform.given() }
    }

    /// Returns the parameter with this key, if `kind` is the kind of this waveform.
    pub(crate) fn named(&self, kind: &str, key: &str) -> Option<Quantity> {
        let own = match self.shape {
            Shape::Sawtooth { .. } => "sawtooth",
            Shape::Triangle { .. } => "triangle",
            Shape::Sine { .. } => "sine",
            Shape::Cycloid { .. } => "cycloid",
            Shape::Parabola { .. } => "parabola",
            Shape::Trapezoid { .. } => "trapezoid",
            Shape::SCurve { .. } => "s_curve",
            Shape::Limited { .. } => "limited",
            _ => return None,
        };
        let named = Quantity::ALL.into_iter().find(|quantity| quantity.key() == key)?;
        (kind == own && self.get(named).is_some()).then_some(named)
    }

    pub(crate) fn get(&self, quantity: Quantity) -> Option<f64> {
        let mut copy = self.clone();
        copy.number(quantity).map(|number| *number)
    }

    /// Sets a parameter. Returns whether its value changed.
    pub(crate) fn set(&mut self, quantity: Quantity, value: f64) -> bool {
        let Some(number) = self.number(quantity) else { return false };
        std::mem::replace(number, value).to_bits() != value.to_bits()
    }

    /// Builds the waveform.
    ///
    /// # Errors
    /// Fails if the combination of parameters is invalid.
    pub(crate) fn draw(&self) -> Result<Waveform, WaveformError> {
        Waveform::new(self.shape.clone(), self.timing)
    }

    fn number(&mut self, quantity: Quantity) -> Option<&mut f64> {
        match (quantity, &mut self.shape) {
            (
                Quantity::Stroke,
                Shape::Sawtooth { stroke, .. }
                | Shape::Triangle { stroke }
                | Shape::Cycloid { stroke, .. }
                | Shape::Parabola { stroke, .. }
                | Shape::Trapezoid { stroke, .. }
                | Shape::SCurve { stroke, .. }
                | Shape::Limited { stroke, .. },
            ) => Some(stroke),
            (
                Quantity::Flyback,
                Shape::Sawtooth { flyback, .. }
                | Shape::Cycloid { flyback, .. }
                | Shape::SCurve { flyback, .. }
                | Shape::Limited { flyback, .. },
            ) => Some(flyback),
            (Quantity::Amplitude, Shape::Sine { amplitude, .. }) => Some(amplitude),
            (Quantity::Offset, Shape::Sine { offset, .. }) => Some(offset),
            (Quantity::Phase, Shape::Sine { phase, .. }) => Some(phase),
            (
                Quantity::Period,
                Shape::Sawtooth { .. }
                | Shape::Triangle { .. }
                | Shape::Sine { .. }
                | Shape::Cycloid { .. }
                | Shape::Parabola { .. }
                | Shape::Trapezoid { .. }
                | Shape::SCurve { .. }
                | Shape::Limited { .. },
            ) => Some(&mut self.timing.period),
            _ => None,
        }
    }
}
