//! Waveforms: prescribed courses in time.

use super::shapes::{
    ChirpForm, CycloidForm, HarmonicsForm, ParabolaForm, SCurveForm, SawtoothForm, SineForm, StepForm,
    TrapezoidForm, TriangleForm, TwoHarmonicsForm,
};
use super::{GeneratorForm, InputForm, Periodic, TableForm};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// A prescribed course in time. Peak-to-peak values are called stroke, half of it amplitude.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum WaveformForm {
    /// Starts at 0, rises linearly to the stroke, falls linearly to 0 in the flyback that ends the period.
    #[schemars(example = json!({ "sawtooth": { "stroke": "200 nm", "period": "10 ms", "flyback": "10 us" } }))]
    Sawtooth(SawtoothForm),
    /// Rises linearly from 0 to the stroke in half a period and falls back.
    #[schemars(example = json!({ "triangle": { "stroke": "200 nm", "period": "10 ms" } }))]
    Triangle(TriangleForm),
    /// offset + amplitude · sin(ωt + phase).
    #[schemars(example = json!({ "sine": { "amplitude": "100 nm", "frequency": "100 Hz" } }))]
    Sine(SineForm),
    /// Sum of amplitude · sin(order · ωt + phase).
    #[schemars(example = json!({ "harmonics": { "terms": [{ "amplitude": "100 nm", "order": 1 }, { "amplitude": "25 nm", "order": 2 }], "period": "10 ms" } }))]
    Harmonics(HarmonicsForm),
    /// Rises by the cycloidal law stroke · (τ - sin(2πτ)/2π), falls by the same law in the flyback that ends the period.
    #[schemars(example = json!({ "cycloid": { "stroke": "200 nm", "period": "10 ms" } }))]
    Cycloid(CycloidForm),
    /// Straight, or by cubics, between given points, held before the first and after the last, or again and again.
    #[schemars(example = json!({ "table": { "points": [[0, 0], ["1 ms", "200 nm"], ["2 ms", 0]] } }))]
    Table(TableForm),
    /// Given by a caller while it runs, held or straight from value to value; `stickslip run` holds the initial value. It
    /// has no period: steps per period are not evaluated.
    #[schemars(example = json!({ "input": { "initial": 0, "range": ["-1 um", "1 um"] } }))]
    Input(InputForm),
    /// Made inside: cycles whose stroke, frequency, heading and number a caller commands while they run. `stickslip run` takes
    /// the values given here.
    #[schemars(example = json!({ "generator": { "shape": { "sawtooth": { "flyback": "10 us" } }, "stroke": "200 nm", "frequency": "100 Hz", "range": { "stroke": [0, "300 nm"], "frequency": [0, "2 kHz"] } } }))]
    Generator(GeneratorForm),
    /// amplitude · (sin ωt + second · sin 2ωt): smooth, and faster one way than the other.
    #[schemars(example = json!({ "two_harmonics": { "amplitude": "100 nm", "second": -0.25, "frequency": "1 kHz" } }))]
    TwoHarmonics(TwoHarmonicsForm),
    /// From rest at 0 by a constant acceleration, over a turn (a cusp by default) at the stroke, back along its mirror image.
    #[schemars(example = json!({ "parabola": { "stroke": "200 nm", "period": "1 ms" } }))]
    Parabola(ParabolaForm),
    /// Rises linearly from 0 to the stroke, holds it, falls linearly, and rests until the period ends.
    #[schemars(example = json!({ "trapezoid": { "stroke": "200 nm", "period": "10 ms", "rise": "1 ms", "hold": "3 ms" } }))]
    Trapezoid(TrapezoidForm),
    /// Rises and, in the flyback that ends the period, falls from rest to rest with a limited jerk.
    #[schemars(example = json!({ "s_curve": { "stroke": "200 nm", "period": "10 ms", "flyback": "1 ms", "rounding": "100 us" } }))]
    SCurve(SCurveForm),
    /// A sine whose frequency goes linearly from one value to another, once.
    #[schemars(example = json!({ "chirp": { "amplitude": "10 nm", "from": "100 Hz", "to": "10 kHz", "duration": "100 ms" } }))]
    Chirp(ChirpForm),
    /// 0, and from a time on another value: a jump, which a contact goes through straight and in no time.
    #[schemars(example = json!({ "step": { "height": "100 nm", "at": "1 ms" } }))]
    Step(StepForm),
}

impl WaveformForm {
    /// The word of a periodic waveform and what all of them share; none of what has no period.
    pub(crate) fn periodic(&self) -> Option<(&'static str, Periodic)> {
        match self {
            Self::Sawtooth(form) => Some(("sawtooth", form.periodic())),
            Self::Triangle(form) => Some(("triangle", form.periodic())),
            Self::Sine(form) => Some(("sine", form.periodic())),
            Self::Harmonics(form) => Some(("harmonics", form.periodic())),
            Self::Cycloid(form) => Some(("cycloid", form.periodic())),
            Self::TwoHarmonics(form) => Some(("two_harmonics", form.periodic())),
            Self::Parabola(form) => Some(("parabola", form.periodic())),
            Self::Trapezoid(form) => Some(("trapezoid", form.periodic())),
            Self::SCurve(form) => Some(("s_curve", form.periodic())),
            Self::Table(_) | Self::Input(_) | Self::Generator(_) | Self::Chirp(_) | Self::Step(_) => None,
        }
    }
}
