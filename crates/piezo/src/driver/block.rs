//! Implementation of the block interface for the driver.
//!
//! The states are the voltage, the work of the source, the losses and, with a low-pass, output and output rate of the low-pass. Without a
//! resistance, the voltage in the mode [`Output::Free`] equals the followed signal exactly, and the voltage state has the rate of this
//! signal. The memory stores the difference between voltage and state as an offset, which is added when a current limit begins.

use super::course::{ABOVE, BELOW, FALLING, FREE, INSIDE, RISING};
use super::stage::{At, LOST, LOW, LOW_RATE, Now, ROUNDING, VOLTAGE, WORK};
use super::{Course, Driver, Output, Window};
use crate::figures::{Kept, last};
use crate::pace::Pace;
use stickslip_drive::component::{Block, Component, Input, Passage, Powers, Refused, States};
use stickslip_drive::{EventKind, Sample};

/// Smallest change of voltage between two events, as a fraction of the range; smaller changes count as chattering.
const CHATTER: f64 = 1e-6;
/// Largest difference between the voltage state and the followed signal at which they count as equal, as a fraction of the range.
const NEAR: f64 = 1e-8;

/// Smallest error scale of a state, as a fraction of the range. A smaller scale would be below rounding at the tightest tolerances.
const LEAST_LAG: f64 = 1e-2;

impl Driver {
    /// Returns the error scale of the voltage as a fraction of its range: the lag due to RC at the fastest command. Without a resistance
    /// the error scale is 1.
    fn lag(&self) -> f64 {
        let (down, up) = self.spec.slew();
        let fastest = (up.min(down) / self.span).min(self.quickest.recip());
        self.spec.time().map_or(1.0, |time| (time * fastest).clamp(LEAST_LAG, 1.0))
    }

    /// Returns the error scale of the low-pass output as a fraction of its range, from its lag 2ζ/ω at the fastest command.
    fn lag_of_low(&self) -> f64 {
        let fastest = self.quickest.recip();
        self.spec.low.map_or(1.0, |low| (2.0 * low.ratio / self.spec.omega() * fastest).clamp(LEAST_LAG, 1.0))
    }

    /// Returns whether the current is continuous except at jumps of the command. A continuous current requires a resistance, or a low-pass
    /// without current limits.
    fn goes_on(&self) -> bool {
        self.spec.resistance.is_some() || self.spec.low.is_some() && self.spec.current.is_none()
    }

    /// Returns the time derivatives of the current, as a stroke rate in m/s, and of the source power in W.
    ///
    /// The acceleration of the elongation is taken as 0.
    fn slopes_of(&self, followed: Sample, voltage: Sample) -> [f64; 2] {
        let flow = self.flow(voltage.acceleration, 0.0);
        let power = self.source(followed, flow)
            + self.source(Sample { value: followed.rate, ..followed }, voltage.rate);
        [flow, power]
    }

    /// Adds one step to the totals of the driver.
    ///
    /// `given` is the charge moved in the step, as a stroke in m, and the work of the source in J. `end` contains current and source power
    /// at the end of the step. `slopes` contains the time derivatives of current and source power at the end.
    fn count(
        &self,
        kept: &mut Kept,
        passage: &Passage,
        given: [f64; 2],
        (end, slopes): ([f64; 2], [f64; 2]),
    ) {
        let (time, begin) = (passage.duration, [kept.flow, kept.power]);
        (kept.flow, kept.power) = (end[0], end[1]);
        kept.fastest = kept.fastest.max(end[0].abs());
        if !passage.located {
            // In a step across a corner, the current at the end of the step does not determine the current at its start.
            kept.way += given[0].abs();
            kept.drawn += given[1].max(0.0);
            return;
        }
        // A continuous current is known at both ends of the step. Otherwise the slope of the current at the end is used, if strain causes
        // no charge. A step longer than the time constant of a stage uses linear interpolation.
        let is_known = time * self.spec.rate() < 1.0 && (self.goes_on() || self.strain.is_none());
        let paces = [0, 1].map(|i| {
            let (given, last) = (given[i], time * end[i]);
            match self.goes_on() {
                true if is_known => Pace::between(given, time * begin[i], last),
                false if is_known => Pace::ending(given, last, time * time * slopes[i]),
                _ => Pace::straight(given, last),
            }
        });
        let [way, drawn] = paces.map(Pace::risen);
        kept.way += 2.0 * way - given[0];
        kept.drawn += drawn;
        if is_known && self.goes_on() {
            kept.fastest = kept.fastest.max(paces[0].most() / time);
        }
    }
}

impl Component for Driver {
    type Law = usize;
    type Memory = Vec<f64>;
    type Guard = usize;
    type Inputs = [Sample];
    type Segment = Passage;
    type Error = Refused;

    fn states(&self) -> States {
        let volts = self.span / self.spec.gain;
        let energy = self.spec.capacitance * volts * volts;
        let mut scales = vec![self.span * self.lag(), energy, energy];
        if self.spec.low.is_some() {
            let lag = self.span * self.lag_of_low();
            scales.extend([lag, lag * self.spec.omega()]);
        }
        if self.worked().is_some() {
            scales.push(energy);
        }
        States { scales, integrals: 0 }
    }

    fn guards(&self, law: &usize) -> &[usize] {
        self.guards.get(*law).map_or(&[], Vec::as_slice)
    }

    fn guard(&self, guard: usize, standing: Now<'_>, at: &At<'_>) -> f64 {
        let (low, high) = self.spec.reach();
        let (down, up) = self.spec.slew();
        let (course, followed, voltage) = self.now(standing, at);
        let command = at.inputs[0].value;
        match (guard, course.window) {
            (BELOW, _) => return command - low,
            (ABOVE, _) => return high - command,
            (INSIDE, Window::Below) => return low - command,
            (INSIDE, _) => return command - high,
            _ => {}
        }
        let wish = self.wish(followed, (at.states, self.elongation(at.inputs).rate));
        match (guard, course.output, self.spec.resistance) {
            (RISING, ..) => up - wish,
            (FALLING, ..) => wish + down,
            // A current limit ends when the followed signal meets the voltage or, with a resistance, when the unlimited current is within
            // the limits.
            (_, Output::Rising, None) => followed.value - voltage.value,
            (_, _, None) => voltage.value - followed.value,
            (_, Output::Rising, Some(_)) => wish - up,
            (_, _, Some(_)) => -wish - down,
        }
    }

    fn next(&self, guard: usize, standing: Now<'_>, at: &At<'_>) -> (EventKind, usize) {
        let (before, _, voltage) = self.now(standing, at);
        let mut course = before;
        match guard {
            INSIDE => course.window = Window::Inside,
            BELOW => course.window = Window::Below,
            ABOVE => course.window = Window::Above,
            RISING => course.output = Output::Rising,
            FALLING => course.output = Output::Falling,
            _ => {}
        }
        let followed = self.followed((course, at.located), at.inputs[0], at.states);
        let elongated = self.elongation(at.inputs).rate;
        let decided = match (guard, self.spec.resistance) {
            // The voltage equals the followed signal except for rounding, so the rate of this signal determines the next mode.
            (FREE, None) => {
                let met = Sample { value: voltage.value, ..followed };
                Some(self.output(met, (at.states, voltage.value, elongated)))
            }
            (FREE, Some(_)) => Some(Output::Free),
            // The rate of the limited command jumps at an end of the window, so the output mode is determined again.
            (INSIDE | BELOW | ABOVE, _) if before.output == Output::Free => {
                let met = if self.spec.resistance.is_none() {
                    Sample { value: voltage.value, ..followed }
                } else {
                    followed
                };
                Some(self.output(met, (at.states, voltage.value, elongated)))
            }
            _ => None,
        };
        course.output = decided.unwrap_or(course.output);
        (EventKind::Own(course.word(before)), course.law())
    }

    /// Updates the totals of the driver. A limited voltage does not follow a jump of the command.
    fn commit(&self, memory: &mut Vec<f64>, passage: &Passage) -> Result<f64, Refused> {
        let Some(mut kept) = Kept::read(memory) else {
            return Err(Refused("its memory belongs to another block".to_owned()));
        };
        let course = Course::of(passage.law);
        let Some(&command) = passage.inputs.first() else { return Ok(0.0) };
        let jumps = passage.duration == 0.0;
        if jumps && self.spec.current.is_some() && self.spec.resistance.is_none() {
            return Ok(0.0);
        }
        // After a jump of the command the mode has not changed yet. The window is therefore applied independently of the mode.
        let located = passage.located && !jumps;
        let followed = self.followed((course, located), command, &passage.states);
        let elongation = self.elongation(&passage.inputs);
        let voltage = if passage.located {
            self.voltage(course, followed, (&passage.states, kept.offset, elongation.rate))
        } else {
            self.saturated(followed, (&passage.states, memory.as_slice()), (passage.t, elongation))
        };
        if self.spec.resistance.is_none() && (course.output == Output::Free || !passage.located) {
            kept.offset = voltage.value - passage.states[VOLTAGE];
        }
        // At the start of a run the elongation is not known.
        let before = if kept.time > 0.0 { kept.elongation } else { elongation.value };
        let given = [
            self.flow(voltage.value - kept.last, elongation.value - before),
            passage.states[WORK] - kept.work,
        ];
        let flow = self.flow(voltage.rate, elongation.rate);
        let power = self.source(followed, flow);
        if jumps {
            kept.way += given[0].abs();
            kept.drawn += given[1].max(0.0);
            // The mode has not changed yet, so the current is limited here. Without R and low-pass the charge flows in zero time.
            let (down, up) = self.spec.slew();
            let after = if self.goes_on() { flow.clamp(-down, up) } else { 0.0 };
            (kept.flow, kept.power) = (after, self.source(followed, after));
            kept.fastest = kept.fastest.max(after.abs());
        } else {
            self.count(&mut kept, passage, given, ([flow, power], self.slopes_of(followed, voltage)));
        }
        (kept.last, kept.work) = (voltage.value, passage.states[WORK]);
        (kept.at, kept.elongation) = (passage.t, elongation.value);
        kept.time += passage.duration;
        let at = [
            course.output == Output::Rising,
            course.output == Output::Falling,
            course.window == Window::Below,
            course.window == Window::Above,
        ];
        for (time, _) in kept.limited.iter_mut().zip(at).filter(|(_, at)| *at) {
            *time += passage.duration;
        }
        memory.copy_from_slice(&kept.numbers());
        Ok(0.0)
    }

    /// Returns 0, because the driver has a separate energy balance, which is written as output columns.
    fn energy(&self, _: Now<'_>, _: &At<'_>) -> f64 {
        0.0
    }

    fn columns(&self) -> Vec<&'static str> {
        let mut columns = vec!["voltage_V", "current_A", "source_J", "stored_J", "lost_J"];
        columns.extend(self.strain.map(|_| "mechanical_J"));
        columns
    }
}

impl Block for Driver {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// Starts at rest. The voltage equals the command, which must be inside the window.
    fn start(&self, inputs: &[Sample]) -> (Vec<f64>, Vec<f64>) {
        let value = inputs.first().map_or(0.0, |command| command.value);
        let mut states = vec![value, 0.0, 0.0];
        if self.spec.low.is_some() {
            states.extend([value, 0.0]);
        }
        if self.worked().is_some() {
            states.push(0.0);
        }
        (states, Kept { last: value, ..Kept::default() }.numbers().to_vec())
    }

    fn slopes(&self, standing: Now<'_>, at: &At<'_>, slopes: &mut [f64], _: &mut [f64]) -> Powers {
        let (_, followed, voltage) = self.now(standing, at);
        let flow = self.flow(voltage.rate, self.elongation(at.inputs).rate);
        slopes[VOLTAGE] = voltage.rate;
        slopes[WORK] = self.source(followed, flow);
        slopes[LOST] = (followed.value - voltage.value) / self.spec.gain * self.current(flow);
        if self.spec.low.is_some() {
            (slopes[LOW], slopes[LOW_RATE]) = (followed.rate, followed.acceleration);
        }
        if let Some(worked) = self.worked() {
            slopes[worked] = self.power(voltage, at);
        }
        Powers::default()
    }

    fn signal(&self, standing: Now<'_>, at: &At<'_>) -> Sample {
        self.now(standing, at).2
    }

    fn range(&self, inputs: &[(f64, f64)]) -> (f64, f64) {
        let (low, high) = self.spec.reach();
        let (from, to) = inputs.first().copied().unwrap_or_default();
        let (from, to) = (from.clamp(low, high), to.clamp(low, high));
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from) * self.spec.overshoot());
        if self.spec.low.is_some() { (middle - half, middle + half) } else { (from, to) }
    }

    fn turn(&self, standing: Now<'_>, at: &At<'_>) -> Option<(EventKind, usize)> {
        let (before, _, voltage) = self.now(standing, at);
        let mut course = before;
        let (low, high) = self.spec.reach();
        let (command, rounding) = (at.inputs[0].value, ROUNDING * self.span);
        if self.spec.window.is_some() {
            course.window = match before.window {
                _ if command < low - rounding => Window::Below,
                _ if command > high + rounding => Window::Above,
                Window::Below if command <= low + rounding => Window::Below,
                Window::Above if command >= high - rounding => Window::Above,
                _ => Window::Inside,
            };
        }
        let followed = self.followed((course, at.located), at.inputs[0], at.states);
        // Without a resistance a free voltage jumps with its command. The state contains the voltage before the jump.
        let own = match (self.spec.resistance, self.spec.current) {
            (None, Some(_)) if at.located => at.states[VOLTAGE] + Self::offset(standing.memory),
            _ => voltage.value,
        };
        // Integration leaves a small difference between a free voltage and its state.
        let near = (followed.value - own).abs() <= NEAR * self.span;
        let met = match (before.output, self.spec.resistance) {
            (Output::Free, None) if near => Sample { value: own, ..followed },
            _ => followed,
        };
        course.output = self.output(met, (at.states, own, self.elongation(at.inputs).rate));
        (course != before).then(|| (EventKind::Own(course.word(before)), course.law()))
    }

    /// Adds the energy of a transmitted jump: ½C(V₂² - V₁²), with the capacitance of the held stack. A jump has no losses.
    fn jump(&self, standing: Now<'_>, at: &At<'_>, states: &mut [f64]) {
        if self.passes_jumps() {
            let course = Course::of(*standing.law);
            let from = last(standing.memory).stroke;
            let to = self.followed((course, false), at.inputs[0], at.states).value;
            let volts = [from, to].map(|stroke| stroke / self.spec.gain);
            let held = self.flow(self.spec.capacitance, 0.0);
            states[WORK] += 0.5 * held * (volts[1] + volts[0]) * (volts[1] - volts[0]);
            if let Some(worked) = self.worked() {
                let middle = 0.5 * (from + to) - self.elongation(at.inputs).value;
                states[worked] += self.stiffness() * middle * (to - from);
            }
        }
    }

    /// Returns whether the voltage jumps with its command: true for a driver without resistance, low-pass and current limits.
    fn passes_jumps(&self) -> bool {
        self.spec.current.is_none() && self.spec.resistance.is_none() && self.spec.low.is_none()
    }

    fn guard_scale(&self, guard: usize) -> f64 {
        let (down, up) = self.spec.slew();
        match (guard, self.spec.resistance) {
            (INSIDE | BELOW | ABOVE, _) | (FREE, None) => self.span,
            _ => up.min(down),
        }
    }

    fn rate(&self) -> f64 {
        let (down, up) = self.spec.slew();
        let slow = self.spec.time().map_or(0.0, f64::recip);
        (up.max(down) / (CHATTER * self.span)).max(slow).max(self.spec.omega())
    }

    /// Returns whether the output signal depends on a state. Energies have no effect on the signal, nor does the voltage state in the free
    /// mode without a resistance.
    fn depends(&self, law: usize, state: usize) -> bool {
        match state {
            VOLTAGE => self.spec.resistance.is_some() || Course::of(law).output != Output::Free,
            WORK | LOST => false,
            _ => Some(state) != self.worked(),
        }
    }

    fn count_from(&self, t: f64, states: &mut [f64], memory: &mut [f64]) {
        (states[WORK], states[LOST]) = (0.0, 0.0);
        if let Some(worked) = self.worked() {
            states[worked] = 0.0;
        }
        if let Some(Kept { offset, last, elongation, flow, power, .. }) = Kept::read(memory) {
            let kept = Kept { offset, last, elongation, flow, power, at: t, ..Kept::default() };
            memory.copy_from_slice(&kept.numbers());
        }
    }

    fn fill(&self, standing: Now<'_>, at: &At<'_>, row: &mut Vec<f64>) {
        let (_, _, voltage) = self.now(standing, at);
        let volts = voltage.value / self.spec.gain;
        let elongation = self.elongation(at.inputs);
        let stored = self.stored(voltage.value, elongation.value);
        // After a corner of the command the mode has not changed yet, so the current is limited here.
        let (down, up) = self.spec.slew();
        let current = self.current(self.flow(voltage.rate, elongation.rate).clamp(-down, up));
        row.extend([volts, current, at.states[WORK], stored, at.states[LOST]]);
        row.extend(self.worked().map(|worked| at.states[worked]));
    }
}
