//! Forecast of the effect of a driver on a periodic command, without a simulation of the drive.

use crate::driver::Spec;
use stickslip_drive::{Piece, Waveform};

/// Smallest number of samples of a smooth piece of the command, for the search for its largest rate.
const LOOKS: f64 = 64.0;
/// Number of samples in a quarter of the shortest wave, for the search for the largest rate.
const WAVE_LOOKS: f64 = 16.0;
/// Largest relative difference of the rates of a straight piece of the command, due to rounding.
const CURVED: f64 = 1e-9;
/// Largest number of pieces of a period in the search for the largest rate.
const PIECES: usize = 10_000;
/// Smallest number of integration steps: per period, per quarter of the shortest wave, and per piece of the command.
const STEPS: f64 = 8000.0;
const LOOKS_PER_WAVE: f64 = 50.0;
const FEWEST: f64 = 8.0;
/// Largest number of integration steps per period.
const MOST: f64 = 200_000.0;
/// Largest number of periods after which the range of the voltage must be steady.
const PERIODS: u32 = 400;
/// Change of the range from period to period at which the range counts as steady, as a fraction of the commanded range.
const SETTLED: f64 = 1e-6;
/// Longest substep of the low-pass in units of 1/ω, and largest number of substeps in a step. A step with more substeps gives no forecast.
const FINE: f64 = 0.1;
const MOST_FINE: f64 = 50.0;

/// Part of a period that needs the largest fraction of the available current.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steepest {
    /// Start and end of the part, s, measured from the start of the period.
    pub between: (f64, f64),
    /// Voltages at start and end of the part, V.
    pub volts: (f64, f64),
    /// Current at the largest rate of the part, A; infinite for a jump; negative for a current out of the stack.
    pub current: f64,
    /// Available current in the direction of `current`, A; infinite without a limit.
    pub available: f64,
    /// Whether the rate changes within the part. If the rate changes, `current` is needed only at one time.
    pub curved: bool,
}

/// Forecast of the voltage that a driver produces from a command.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// Part of a period that needs the largest fraction of the available current.
    pub steepest: Steepest,
    /// Range of the commanded strokes, m.
    pub asked: (f64, f64),
    /// Range of the strokes in periodic operation of the driver, m, and the number of periods after which this range is steady.
    ///
    /// The range is accurate to about a thousandth of the command. `None` if a coarse integration cannot determine the range.
    pub left: Option<((f64, f64), u32)>,
}

impl Steepest {
    /// Returns whether the command needs more current than the driver can supply.
    #[must_use]
    pub fn is_too_steep(&self) -> bool {
        self.current.abs() > self.available
    }

    /// Returns the largest available rate of the voltage, V/s.
    #[must_use]
    pub fn slew(&self, spec: &Spec) -> f64 {
        self.available / spec.capacitance
    }

    /// Returns the time in which the available current changes the voltage as commanded, s.
    #[must_use]
    pub fn takes(&self, spec: &Spec) -> f64 {
        (self.volts.1 - self.volts.0).abs() / self.slew(spec)
    }
}

/// Computes the forecast for a command given as a stroke in m. Returns `None` for a command without a period.
#[must_use]
pub fn forecast(spec: &Spec, command: &Waveform) -> Option<Forecast> {
    let period = command.period()?;
    // The second period is used if the command has one, because the first period may begin differently.
    let (first, end) = (command.timing().delay, command.window().1);
    let start = if first + 2.0 * period <= end { first + period } else { first };
    Some(Forecast {
        steepest: steepest(spec, command, (start, period))?,
        asked: command.range(),
        left: walk(spec, command, (start, period)),
    })
}

/// Returns the rate with the largest magnitude in a piece of the command, and whether the rate varies.
fn rates(command: &Waveform, piece: &Piece, (from, to): (f64, f64)) -> (f64, bool) {
    // The resolution of a straight piece is infinite.
    let looks = ((to - from) / command.resolution() * WAVE_LOOKS).ceil().clamp(LOOKS, MOST) as u32;
    let rate_at = |k: u32| command.sample(piece, from + (to - from) * f64::from(k) / f64::from(looks)).rate;
    let steeper = |most: f64, rate: f64| if rate.abs() > most.abs() { rate } else { most };
    let rate = (0..=looks).map(rate_at).fold(0.0, steeper);
    (rate, (0..=looks).any(|k| (rate_at(k) - rate).abs() > CURVED * rate.abs()))
}

fn steepest(spec: &Spec, command: &Waveform, (start, period): (f64, f64)) -> Option<Steepest> {
    let (sink, source) = spec.current.unwrap_or((f64::INFINITY, f64::INFINITY));
    let volts = |value: f64| value / spec.gain;
    let mut most: Option<Steepest> = None;
    // Parts are compared by the needed fraction of the available current or, without a limit, by the current.
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
        let (rate, curved) = rates(command, &piece, (from, to));
        take(Steepest {
            between: (from - start, to - start),
            volts: (ends[0], ends[1]),
            current: spec.capacitance * volts(rate),
            available: if rate < 0.0 { sink } else { source },
            curved,
        });
        let jump = command.jump_after(&piece);
        if jump != 0.0 {
            take(Steepest {
                between: (to - start, to - start),
                volts: (ends[1], ends[1] + volts(jump)),
                current: jump.signum() * f64::INFINITY,
                available: if jump < 0.0 { sink } else { source },
                curved: false,
            });
        }
        piece = command.after(&piece);
    }
    most
}

/// Divides one period of the command into steps. Returns the length of each step, s, and the command at its end.
///
/// Corners of the command are ends of steps. Returns `None` if a period needs too many steps.
fn course(spec: &Spec, command: &Waveform, (start, period): (f64, f64)) -> Option<Vec<(f64, f64)>> {
    let (low, high) = spec.reach();
    let mut steps = Vec::new();
    let mut piece = command.piece_at(start);
    while piece.start < start + period {
        let (from, to) = (piece.start.max(start), piece.end.min(start + period));
        // A straight piece does not need the short steps of a wave.
        let (_, curved) = rates(command, &piece, (from, to));
        let wave = if curved { command.resolution() / LOOKS_PER_WAVE } else { period };
        let n = ((to - from) / wave.min(period / STEPS)).ceil().max(FEWEST);
        if steps.len() as f64 + n > MOST {
            return None;
        }
        let h = (to - from) / n;
        let ends = (1..=n as u32).map(|k| command.sample(&piece, from + h * f64::from(k)).value);
        steps.extend(ends.map(|value| (h, value.clamp(low, high))));
        piece = command.after(&piece);
    }
    Some(steps)
}

/// Integrates the driver over periods until the range of the voltage is steady.
///
/// Returns the range of the last period as strokes, m, and the number of periods. Returns `None` if the range does not become steady
/// or the steps are too coarse for the low-pass.
fn walk(spec: &Spec, command: &Waveform, (start, period): (f64, f64)) -> Option<((f64, f64), u32)> {
    let (low, high) = spec.reach();
    let (down, up) = spec.slew();
    let omega = spec.omega();
    let steps = course(spec, command, (start, period))?;
    let fine = |h: f64| (h * omega / FINE).ceil().max(1.0);
    if steps.iter().any(|(h, _)| fine(*h) > MOST_FINE) {
        return None;
    }
    let first = command.sample(&command.piece_at(start), start).value.clamp(low, high);
    let (mut voltage, mut passed, mut rate) = (first, first, 0.0);
    let asked = command.range();
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    for periods in 1..=PERIODS {
        let mut own = (f64::INFINITY, f64::NEG_INFINITY);
        for &(h, cut) in &steps {
            match spec.low {
                None => passed = cut,
                Some(low) => {
                    let fine = fine(h);
                    // Symplectic Euler method: the rate is updated first, so that an undamped low-pass keeps its amplitude.
                    for _ in 0..fine as u32 {
                        rate += h / fine * omega * (omega * (cut - passed) - 2.0 * low.ratio * rate);
                        passed += h / fine * rate;
                    }
                }
            }
            let wish = match spec.time() {
                None => passed - voltage,
                Some(time) => -(passed - voltage) * math::exp_m1(-h / time),
            };
            voltage += wish.clamp(-down * h, up * h);
            own = (own.0.min(voltage), own.1.max(voltage));
        }
        let changed = (own.0 - range.0).abs().max((own.1 - range.1).abs());
        range = own;
        if changed <= SETTLED * (asked.1 - asked.0) {
            return Some((range, periods - 1));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::driver::Control;
    use stickslip_drive::{Section, Shape, Timing};

    /// Forecast for a stack of 4.6 µm at 120 V and 7.2 µF at 2 A, with a flyback of 20 µs.
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

    /// The flyback needs 7.2 µF · 120 V/20 µs = 43.2 A. At 2 A the voltage changes by 0.278 V/µs and needs 432 µs. The falling
    /// voltage meets the next rise of 120 V/980 µs.
    #[test]
    fn the_flyback_of_a_large_stack_is_cut_short() {
        let (spec, forecast) = of(1e-3);
        let steepest = forecast.steepest;
        assert!((steepest.current + 43.2).abs() < 1e-6 && steepest.is_too_steep(), "{steepest:?}");
        assert!((steepest.slew(&spec) / (2.0 / 7.2e-6) - 1.0).abs() < 1e-12);
        assert!((steepest.takes(&spec) - 432e-6).abs() < 1e-9);
        let (fall, rise) = (2.0 / 7.2e-6, 120.0 / 980e-6);
        let lowest: f64 = rise * (120.0 - fall * 20e-6) / (fall + rise);
        assert!((forecast.left.unwrap().0.0 / spec.gain - lowest).abs() < 0.2, "{forecast:?} {lowest}");
        assert!((forecast.left.unwrap().0.1 - 4.6e-6).abs() < 1e-9);
    }

    /// At 2 kHz the command rises at 0.25 V/µs. The voltage that falls at 0.278 V/µs meets it at 54.2 V.
    #[test]
    fn a_faster_saw_leaves_a_part_of_the_stroke() {
        let (spec, forecast) = of(0.5e-3);
        let (fall, rise) = (2.0 / 7.2e-6, 120.0 / 480e-6);
        let lowest: f64 = rise * (120.0 - fall * 20e-6) / (fall + rise);
        assert!(
            (lowest - 54.2).abs() < 0.1 && (forecast.left.unwrap().0.0 / spec.gain - lowest).abs() < 0.2,
            "{lowest}"
        );
    }

    fn told(shape: Shape, timing: Timing, low: Option<f64>) -> Forecast {
        let (spec, _) = of(1e-3);
        let low = low.map(|frequency| crate::driver::Low { frequency, ratio: 0.7 });
        let spec = Spec { low, current: low.map_or(spec.current, |_| None), ..spec };
        forecast(&spec, &Waveform::new(shape, timing).unwrap()).unwrap()
    }

    /// A low-pass of 10 kHz needs too many steps at a period of 10 s, so there is no forecast. At a period of 10 ms it leaves the
    /// full range.
    #[test]
    fn what_cannot_be_walked_through_is_not_told() {
        let sine = || Shape::Sine { amplitude: 2.3e-6, phase: 0.0, offset: 0.0 };
        assert_eq!(told(sine(), Timing::every(10.0), Some(1e4)).left, None);
        let ((low, high), _) = told(sine(), Timing::every(1e-2), Some(1e4)).left.unwrap();
        assert!((low + 2.3e-6).abs() < 1e-8 && (high - 2.3e-6).abs() < 1e-8);
    }

    /// A sine has its largest rate Aω at one time only.
    #[test]
    fn a_curve_is_told_by_its_rate() {
        let sine = Shape::Sine { amplitude: 2.3e-6, phase: 0.0, offset: 0.0 };
        let steepest = told(sine, Timing::every(1e-3), None).steepest;
        assert!(steepest.curved);
        // 7.2 µF · 60 V · 2π/1 ms.
        assert!(
            (steepest.current.abs() / (7.2e-6 * 60.0 * std::f64::consts::TAU / 1e-3) - 1.0).abs() < 1e-12
        );
        assert!(!of(1e-3).1.steepest.curved);
    }

    /// The peaks of a burst of three sines of 1 ms in 2 s are those of the command, and the rate is that of the sine.
    #[test]
    fn short_waves_in_a_long_pattern_keep_their_peaks() {
        let sine = Shape::Sine { amplitude: 0.5e-6, phase: 0.0, offset: 1e-6 };
        let parts = vec![Section::Run { cycles: 3, reversed: false }, Section::Rest { duration: 1.997 }];
        let burst = told(Shape::Pattern { carrier: Box::new(sine), parts }, Timing::every(1e-3), None);
        let ((low, high), _) = burst.left.unwrap();
        assert!((low - 0.5e-6).abs() < 1e-10 && (high - 1.5e-6).abs() < 1e-10, "{burst:?}");
        let rate = 0.5e-6 * std::f64::consts::TAU / 1e-3;
        let current = 7.2e-6 * rate * 120.0 / 4.6e-6;
        assert!((burst.steepest.current.abs() / current - 1.0).abs() < 1e-2, "{burst:?} {current}");
    }
}
