//! The driver on the contract of blocks.
//!
//! States: the voltage, the work of the source, what is lost, and where there is a low-pass its output and that one's rate.
//! Without a resistance a voltage that follows is its command itself, exactly, and the state beside it goes along at the same
//! rate; what integration leaves between the two is the memory's offset, with which the state goes on where a limit begins.

use super::course::{ABOVE, BELOW, FALLING, FREE, INSIDE, RISING};
use super::stage::{At, LOST, LOW, LOW_RATE, Now, ROUNDING, VOLTAGE, WORK};
use super::{Course, Driver, Output, Window};
use crate::figures::{Kept, last};
use crate::pace::Pace;
use stickslip_drive::component::{Block, Component, Input, Passage, Powers, Refused, States};
use stickslip_drive::{EventKind, Sample};

/// A voltage that moves less than this part of its range between two events of the driver chatters.
const CHATTER: f64 = 1e-6;
/// Part of its range by which the state of a free voltage may lie beside what it follows: a thousandth of what one sees.
const NEAR: f64 = 1e-8;

/// Least part of its range that is a voltage's scale: of less rounding leaves nothing at the tightest tolerances.
const LEAST_LAG: f64 = 1e-2;

impl Driver {
    /// By how much a voltage lags through its resistance, as a part of its range. By the range itself a sine of 1 kHz at RC = 0.1 µs drew 28 %
    /// too much at a tolerance of 1e-3, and met a limit of four times its current.
    fn lag(&self) -> f64 {
        let (down, up) = self.spec.slew();
        let fastest = (up.min(down) / self.span).min(self.quickest.recip());
        self.spec.time().map_or(1.0, |time| (time * fastest).clamp(LEAST_LAG, 1.0))
    }

    /// The same of a low-pass, which lags by 2ζ/ω.
    // A bandwidth of 98 kHz behind a command of some milliseconds told currents at 1e-3 that were off by a third of their peak.
    fn lag_of_low(&self) -> f64 {
        let fastest = self.quickest.recip();
        self.spec.low.map_or(1.0, |low| (2.0 * low.ratio / self.spec.omega() * fastest).clamp(LEAST_LAG, 1.0))
    }

    /// Whether the current never jumps but with its command: behind a resistance, or a low-pass that no limit follows.
    fn goes_on(&self) -> bool {
        self.spec.resistance.is_some() || self.spec.low.is_some() && self.spec.current.is_none()
    }

    /// How its current, as a rate of the stroke, and the power of its source change, 1/s each; how the elongation accelerates is not
    /// known.
    fn slopes_of(&self, followed: Sample, voltage: Sample) -> [f64; 2] {
        let flow = self.flow(voltage.acceleration, 0.0);
        let power = self.source(followed, flow)
            + self.source(Sample { value: followed.rate, ..followed }, voltage.rate);
        [flow, power]
    }

    /// Counts what a step has `given`, the way of the voltage and the work of the source, by what both were at its `end`, and by their
    /// slopes there.
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
            // In a step over a corner what is at its end tells nothing of how it began.
            kept.way += given[0].abs();
            kept.drawn += given[1].max(0.0);
            return;
        }
        // Where the current goes on from step to step both ends are known, else its slope is where no strain acts back. Of a step in which a
        // stage settles neither tells how it began.
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
            // What it follows comes up with it, or through a resistance wishes for less.
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
            // It has met what it follows, but for rounding: its rate says how it goes on.
            (FREE, None) => {
                let met = Sample { value: voltage.value, ..followed };
                Some(self.output(met, (at.states, voltage.value, elongated)))
            }
            (FREE, Some(_)) => Some(Output::Free),
            // At an end of the window the rate of the command jumps.
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

    /// Memory follows where the voltage has gone; of a limited voltage whose command has just jumped it stays.
    fn commit(&self, memory: &mut Vec<f64>, passage: &Passage) -> Result<f64, Refused> {
        let Some(mut kept) = Kept::read(memory) else {
            return Err(Refused("its memory is of another kind".to_owned()));
        };
        let course = Course::of(passage.law);
        let Some(&command) = passage.inputs.first() else { return Ok(0.0) };
        let jumps = passage.duration == 0.0;
        if jumps && self.spec.current.is_some() && self.spec.resistance.is_none() {
            return Ok(0.0);
        }
        // After a jump the law is still the one before: the window cuts whatever that says.
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
        // A start is not told how long the stack is.
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
            // The law is the one before: no more flows than may. What nothing slows has flowed in no time.
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

    /// Nothing of the mechanical books: its own are columns.
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

    /// At rest at its command, which the scenario has seen to be inside the window.
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
        // Without a resistance a free voltage has jumped with its command; where it was is what the state says.
        let own = match (self.spec.resistance, self.spec.current) {
            (None, Some(_)) if at.located => at.states[VOLTAGE] + Self::offset(standing.memory),
            _ => voltage.value,
        };
        // A free voltage is what it follows, but for what integration leaves between its state and that.
        let near = (followed.value - own).abs() <= NEAR * self.span;
        let met = match (before.output, self.spec.resistance) {
            (Output::Free, None) if near => Sample { value: own, ..followed },
            _ => followed,
        };
        course.output = self.output(met, (at.states, own, self.elongation(at.inputs).rate));
        (course != before).then(|| (EventKind::Own(course.word(before)), course.law()))
    }

    /// A jump that it passes on charges the capacitance at once, ½C(V₂² - V₁²), held as long as the stack is. Nothing of that is
    /// lost: the source goes with it.
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

    /// A voltage that nothing slows jumps with its command.
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

    /// Works only count, and without a resistance a voltage that is free is what it follows.
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
        // Where the command has just turned the law is still the one before: no more flows than may.
        let (down, up) = self.spec.slew();
        let current = self.current(self.flow(voltage.rate, elongation.rate).clamp(-down, up));
        row.extend([volts, current, at.states[WORK], stored, at.states[LOST]]);
        row.extend(self.worked().map(|worked| at.states[worked]));
    }
}
