//! Keys of waveforms, prescribed functions of time.

use super::shapes::{
    ChirpForm, CycloidForm, HarmonicsForm, ParabolaForm, SCurveForm, SawtoothForm, SineForm, StepForm,
    TrapezoidForm, TriangleForm, TwoHarmonicsForm,
};
use super::{GeneratorForm, InputForm, Periodic, TableForm};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Waveform, a prescribed function of time. The peak-to-peak value is called the stroke, and half of the stroke is called the amplitude.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum WaveformForm {
    /// Sawtooth: a linear rise from 0 to the stroke and a linear fall to 0 in the flyback that ends the period.
    #[schemars(example = json!({ "sawtooth": { "stroke": "200 nm", "period": "10 ms", "flyback": "10 us" } }))]
    Sawtooth(SawtoothForm),
    /// Triangle: a linear rise from 0 to the stroke in half a period and a linear fall.
    #[schemars(example = json!({ "triangle": { "stroke": "200 nm", "period": "10 ms" } }))]
    Triangle(TriangleForm),
    /// Sine: offset + amplitude · sin(ωt + phase).
    #[schemars(example = json!({ "sine": { "amplitude": "100 nm", "frequency": "100 Hz" } }))]
    Sine(SineForm),
    /// Harmonics: the sum of amplitude · sin(order · ωt + phase).
    #[schemars(example = json!({ "harmonics": { "terms": [{ "amplitude": "100 nm", "order": 1 }, { "amplitude": "25 nm", "order": 2 }], "period": "10 ms" } }))]
    Harmonics(HarmonicsForm),
    /// Cycloid: a rise by the cycloidal law stroke · (τ - sin(2πτ)/2π), 0 ≤ τ ≤ 1. The fall by the same law is the flyback that ends the
    /// period.
    #[schemars(example = json!({ "cycloid": { "stroke": "200 nm", "period": "10 ms" } }))]
    Cycloid(CycloidForm),
    /// Table: linear or cubic interpolation between given points. The first value is held before them, the last value after them, unless
    /// the table is repeated.
    #[schemars(example = json!({ "table": { "points": [[0, 0], ["1 ms", "200 nm"], ["2 ms", 0]] } }))]
    Table(TableForm),
    /// Input: values that a calling program gives during the run, held or ramped in between. `stickslip run` holds the initial value. An
    /// input has no period, so steps per period are not evaluated.
    #[schemars(example = json!({ "input": { "initial": 0, "range": ["-1 um", "1 um"] } }))]
    Input(InputForm),
    /// Generator: cycles made by the program, whose stroke, frequency, heading and number a calling program commands during the run.
    /// `stickslip run` uses the values given here.
    #[schemars(example = json!({ "generator": { "shape": { "sawtooth": { "flyback": "10 us" } }, "stroke": "200 nm", "frequency": "100 Hz", "range": { "stroke": [0, "300 nm"], "frequency": [0, "2 kHz"] } } }))]
    Generator(GeneratorForm),
    /// Two harmonics: amplitude · (sin ωt + second · sin 2ωt), a smooth waveform that is faster in one direction than in the other.
    #[schemars(example = json!({ "two_harmonics": { "amplitude": "100 nm", "second": -0.25, "frequency": "1 kHz" } }))]
    TwoHarmonics(TwoHarmonicsForm),
    /// Parabola: a rise from rest at 0 with constant acceleration, a turn at the stroke (a cusp by default), and the mirror image back.
    #[schemars(example = json!({ "parabola": { "stroke": "200 nm", "period": "1 ms" } }))]
    Parabola(ParabolaForm),
    /// Trapezoid: a linear rise from 0 to the stroke, a hold, a linear fall, and a rest until the period ends.
    #[schemars(example = json!({ "trapezoid": { "stroke": "200 nm", "period": "10 ms", "rise": "1 ms", "hold": "3 ms" } }))]
    Trapezoid(TrapezoidForm),
    /// S-curve: a rise and, in the flyback that ends the period, a fall, each from rest to rest with a limited jerk.
    #[schemars(example = json!({ "s_curve": { "stroke": "200 nm", "period": "10 ms", "flyback": "1 ms", "rounding": "100 us" } }))]
    SCurve(SCurveForm),
    /// Chirp: a sine whose frequency changes linearly from one value to another, once.
    #[schemars(example = json!({ "chirp": { "amplitude": "10 nm", "from": "100 Hz", "to": "10 kHz", "duration": "100 ms" } }))]
    Chirp(ChirpForm),
    /// Step: a jump from 0 to another value at a given time. In the jump, contacts move instantaneously on a straight path.
    #[schemars(example = json!({ "step": { "height": "100 nm", "at": "1 ms" } }))]
    Step(StepForm),
}

impl WaveformForm {
    /// Returns the key of a periodic waveform and the values that all periodic waveforms have; `None` for waveforms without a period.
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
