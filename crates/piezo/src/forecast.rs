//! What a driver will make of a periodic command, before any run.

use crate::driver::Spec;
use stickslip_drive::Waveform;

/// Looks at a smooth piece for where it is steepest.
const LOOKS: u32 = 64;
/// Most pieces of a period that are looked at.
const PIECES: usize = 10_000;
/// Steps of a period of what is walked through …
const STEPS: u32 = 8000;
/// … after which its range is looked at, and most periods of it.
const PERIODS: u32 = 400;
/// Change of the range from period to period, as a part of the command's, at which it has settled.
const SETTLED: f64 = 1e-6;
/// Part of 1/ω that one step of the low-pass takes at most, and most of them in a step of the walk.
const FINE: f64 = 0.1;
const MOST_FINE: f64 = 50.0;

/// The part of a period that asks most of the current.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steepest {
    /// From when to when, s from the start of a period.
    pub between: (f64, f64),
    /// From which voltage to which, V.
    pub volts: (f64, f64),
    /// Current that it needs, A, at its steepest; infinite for a jump; negative out of the stack.
    pub current: f64,
    /// Current that there is in that sense, A; infinite without a limit.
    pub available: f64,
}

/// What a driver will make of a command, from figures and a coarse walk through it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// Where the most current is asked for, as a part of what there is.
    pub steepest: Steepest,
    /// The commanded strokes, m.
    pub asked: (f64, f64),
    /// What is left of them when periods repeat, to about a thousandth of the command, m.
    pub left: (f64, f64),
    /// Periods until then.
    pub periods: u32,
}

impl Steepest {
    /// Whether the driver cannot follow there.
    #[must_use]
    pub fn is_too_steep(&self) -> bool {
        self.current.abs() > self.available
    }

    /// Rate of the voltage that there is, V/s.
    #[must_use]
    pub fn slew(&self, spec: &Spec) -> f64 {
        self.available / spec.capacitance
    }

    /// Time that it will take for its change of voltage, s.
    #[must_use]
    pub fn takes(&self, spec: &Spec) -> f64 {
        (self.volts.1 - self.volts.0).abs() / self.slew(spec)
    }
}

/// What a driver will make of a command (as a stroke, m); none of one without a period.
#[must_use]
pub fn forecast(spec: &Spec, command: &Waveform) -> Option<Forecast> {
    let period = command.period()?;
    let start = command.timing().delay;
    let (left, periods) = walk(spec, command, (start, period));
    Some(Forecast {
        steepest: steepest(spec, command, (start, period))?,
        asked: command.range(),
        left,
        periods,
    })
}

fn steepest(spec: &Spec, command: &Waveform, (start, period): (f64, f64)) -> Option<Steepest> {
    let (sink, source) = spec.current.unwrap_or((f64::INFINITY, f64::INFINITY));
    let volts = |value: f64| value / spec.gain;
    let mut most: Option<Steepest> = None;
    // The largest part of what there is, and without a limit the largest current.
    let weight = |it: &Steepest| {
        if it.available.is_finite() { it.current.abs() / it.available } else { it.current.abs() }
    };
    let mut take = |it: Steepest| {
        if most.is_none_or(|known| weight(&it) > weight(&known)) {
            most = Some(it);
        }
    };
    let mut piece = command.piece_at(start);
    for _ in 0..PIECES {
        let (from, to) = (piece.start.max(start), piece.end.min(start + period));
        if from >= to {
            break;
        }
        let ends = [from, to].map(|t| volts(command.sample(&piece, t).value));
        let rates = (0..=LOOKS).map(|k| {
            let t = from + (to - from) * f64::from(k) / f64::from(LOOKS);
            command.sample(&piece, t).rate
        });
        let rate = rates.fold(0.0, |most: f64, rate| if rate.abs() > most.abs() { rate } else { most });
        take(Steepest {
            between: (from - start, to - start),
            volts: (ends[0], ends[1]),
            current: spec.capacitance * volts(rate),
            available: if rate < 0.0 { sink } else { source },
        });
        let jump = command.jump_after(&piece);
        if jump != 0.0 {
            take(Steepest {
                between: (to - start, to - start),
                volts: (ends[1], ends[1] + volts(jump)),
                current: jump.signum() * f64::INFINITY,
                available: if jump < 0.0 { sink } else { source },
            });
        }
        piece = command.after(&piece);
    }
    most
}

/// Range of the voltage, as a stroke, in the last of as many periods as it takes to settle.
fn walk(spec: &Spec, command: &Waveform, (start, period): (f64, f64)) -> ((f64, f64), u32) {
    let (low, high) = spec.reach();
    let (down, up) = spec.slew();
    let step = period / f64::from(STEPS);
    let omega = spec.omega();
    let fine = (step * omega / FINE).ceil().clamp(1.0, MOST_FINE);
    let first = command.sample(&command.piece_at(start), start).value.clamp(low, high);
    let (mut voltage, mut passed, mut rate) = (first, first, 0.0);
    let asked = command.range();
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    for periods in 1..=PERIODS {
        let mut own = (f64::INFINITY, f64::NEG_INFINITY);
        let mut piece = command.piece_at(start);
        for k in 1..=STEPS {
            let t = start + step * f64::from(k);
            while piece.end < t {
                piece = command.after(&piece);
            }
            let cut = command.sample(&piece, t).value.clamp(low, high);
            match spec.low {
                None => passed = cut,
                Some(low) => {
                    // The rate first: then it stays as it is where nothing damps.
                    for _ in 0..fine as u32 {
                        rate += step / fine * omega * (omega * (cut - passed) - 2.0 * low.ratio * rate);
                        passed += step / fine * rate;
                    }
                }
            }
            let wish = match spec.time() {
                None => passed - voltage,
                Some(time) => -(passed - voltage) * (-step / time).exp_m1(),
            };
            voltage += wish.clamp(-down * step, up * step);
            own = (own.0.min(voltage), own.1.max(voltage));
        }
        let changed = (own.0 - range.0).abs().max((own.1 - range.1).abs());
        range = own;
        if changed <= SETTLED * (asked.1 - asked.0) {
            return (range, periods - 1);
        }
    }
    (range, PERIODS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::driver::Control;
    use stickslip_drive::{Shape, Timing};

    /// The stage: 4.6 µm at 120 V, 7.2 µF, 2 A, back in 20 µs.
    fn of(period: f64) -> (Spec, Forecast) {
        let spec = Spec {
            capacitance: 7.2e-6,
            gain: 4.6e-6 / 120.0,
            window: None,
            current: Some((2.0, 2.0)),
            resistance: None,
            low: None,
            control: Control::Voltage,
        };
        let saw = Shape::Sawtooth { stroke: 4.6e-6, flyback: 20e-6 };
        (spec, forecast(&spec, &Waveform::new(saw, Timing::every(period)).unwrap()).unwrap())
    }

    /// 7.2 µF · 120 V/20 µs = 43.2 A; 2 A/7.2 µF = 0.278 V/µs, which take 432 µs; meeting the next rise leaves 2/C against
    /// 120 V/980 µs.
    #[test]
    fn the_flyback_of_a_large_stack_is_cut_short() {
        let (spec, forecast) = of(1e-3);
        let steepest = forecast.steepest;
        assert!((steepest.current + 43.2).abs() < 1e-6 && steepest.is_too_steep(), "{steepest:?}");
        assert!((steepest.slew(&spec) / (2.0 / 7.2e-6) - 1.0).abs() < 1e-12);
        assert!((steepest.takes(&spec) - 432e-6).abs() < 1e-9);
        let (fall, rise) = (2.0 / 7.2e-6, 120.0 / 980e-6);
        let lowest: f64 = rise * (120.0 - fall * 20e-6) / (fall + rise);
        assert!((forecast.left.0 / spec.gain - lowest).abs() < 0.2, "{forecast:?} {lowest}");
        assert!((forecast.left.1 - 4.6e-6).abs() < 1e-9);
    }

    /// At 2 kHz it rises at 0.25 V/µs: what falls at 0.278 V/µs meets that at 54.2 V.
    #[test]
    fn a_faster_saw_leaves_a_part_of_the_stroke() {
        let (spec, forecast) = of(0.5e-3);
        let (fall, rise) = (2.0 / 7.2e-6, 120.0 / 480e-6);
        let lowest: f64 = rise * (120.0 - fall * 20e-6) / (fall + rise);
        assert!(
            (lowest - 54.2).abs() < 0.1 && (forecast.left.0 / spec.gain - lowest).abs() < 0.2,
            "{lowest}"
        );
    }
}
