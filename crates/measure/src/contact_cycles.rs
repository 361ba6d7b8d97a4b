//! Hysteresis cycles of a contact, evaluated from sampled states and, between the samples, from the contact law.
//!
//! A cycle is evaluated when it ends. Therefore only the samples of the current cycle are stored. If a table without a period drives the
//! contact, the cycles extend between reversals and are evaluated at the end of the run.
//!
//! The results do not depend on the rows that are written. Cycle ends are sampling times, reversals are events. If the contact law does not
//! depend on time, it is evaluated again between the samples. Otherwise the samples are dense, and extremes are computed from interpolating
//! polynomials. The mean of a prescribed load is computed by integration of its waveform.

mod judged;
mod load;
mod loops;
mod peak;
mod walk;

pub use judged::ContactCycles;
pub use judged::JudgedCycle;
pub use loops::Loops;

use crate::Cycle;
use crate::Setting;
use crate::cycles::CLOSED;
use crate::periods::followed;
use crate::series::extent;
use load::Load;
use std::ops::Range;
use stickslip_contact::Interface;
use stickslip_drive::Waveform;
use stickslip_drive::scene::Side;
use walk::{Question, Walk};

/// Change of a force, relative to the friction limit, below which it counts as a rounding error.
const ROUNDING: f64 = 1e-9;
/// Amplitude of u, relative to the natural displacement, below which a contact counts as at rest. `FIXED` is for fixed time steps.
const STILL: f64 = 1e-12;
const FIXED: f64 = 1e-9;
/// Fraction of the displacement range over which a secant stiffness is computed.
const WINDOW: f64 = crate::fretting::STIFFNESS_WINDOW;

/// Evaluated cycle of a contact whose displacement u returns to its initial value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleFigures {
    /// Start and end, s.
    pub time: [f64; 2],
    /// Whether the tangential force returns to its initial value, too. Otherwise the loop is open and has no ratios.
    pub is_closed: bool,
    /// Amplitudes, opening, dissipated energy and stiffnesses. The dissipated energy E_d includes known damping losses. The stiffnesses are
    /// those of the contact law in full stick, not fitted values.
    pub cycle: Cycle,
    /// Energy dissipated by the damping of the contact, J; 0 without damping. `None` if it cannot be separated from other damping losses.
    pub damping: Option<f64>,
    /// Secant stiffnesses over the first tenth of the displacement range, after the maximum and after the minimum of u, N/m.
    pub secants: [Option<f64>; 2],
    /// Mean normal force, N.
    pub normal: f64,
    /// Indentation at the start, m.
    pub depth: f64,
    /// Whether the range of u is below the resolution, so that the contact is at rest and there is no loop.
    pub is_still: bool,
}

impl CycleFigures {
    /// Returns the friction work, J.
    pub fn friction(&self) -> f64 {
        self.cycle.dissipated - self.damping.unwrap_or(0.0)
    }

    /// Returns the dissipated energy `E_d`, J. Returns `None` if the damping losses are unknown.
    pub fn dissipated(&self) -> Option<f64> {
        self.damping.map(|_| self.cycle.dissipated)
    }

    /// Returns `value` for a closed loop, and `None` for an open loop.
    pub fn of_loop(&self, value: Option<f64>) -> Option<f64> {
        value.filter(|_| self.is_closed)
    }

    /// Returns the ratio `value`, which contains `E_d`, for a closed loop whose losses are all known, and `None` otherwise.
    pub fn ratio(&self, value: Option<f64>) -> Option<f64> {
        self.of_loop(value).filter(|_| self.damping.is_some())
    }
}

/// Samples of a contact since the start of the current cycle, or since the start of the run if cycles are evaluated at the end of the run.
#[derive(Debug, Clone, Default)]
struct Track {
    t: Vec<f64>,
    u: Vec<f64>,
    d: Vec<f64>,
    force: Vec<f64>,
    normal: Vec<f64>,
    friction: Vec<f64>,
    damping: Vec<f64>,
    /// Whether the sample is an event, at which the time history may have a kink.
    bends: Vec<bool>,
}

/// Sample of a contact: displacement u and indentation d, m, forces, N, and energies dissipated by friction and damping so far, J.
#[derive(Debug, Clone, Copy)]
struct Moment {
    u: f64,
    d: f64,
    force: f64,
    normal: f64,
    friction: f64,
    damping: f64,
    bends: bool,
}

/// Data for the evaluation of a cycle, in addition to the samples.
struct Setup<'a> {
    law: &'a Interface,
    /// Number of identical contacts.
    count: f64,
    /// Range of u below which the contact is at rest, m.
    still: f64,
    load: Option<&'a Load>,
    /// Whether the samples are dense enough for interpolating polynomials.
    is_dense: bool,
    /// Whether the force is continuous at events.
    is_continuous: bool,
    /// Whether the damping losses of the contact are known.
    knows_damping: bool,
}

impl Track {
    fn push(&mut self, t: f64, moment: Moment) {
        let Moment { u, d, force, normal, friction, damping, bends } = moment;
        self.t.push(t);
        self.bends.push(bends);
        let values = [u, d, force, normal, friction, damping];
        self.columns().into_iter().zip(values).for_each(|(column, value)| column.push(value));
    }

    /// Returns the columns of the samples except time, in the order of the fields of [`Moment`].
    fn columns(&mut self) -> [&mut Vec<f64>; 6] {
        let Self { u, d, force, normal, friction, damping, .. } = self;
        [u, d, force, normal, friction, damping]
    }

    /// Removes all samples except the last sample.
    fn keep_last(&mut self) {
        let gone = self.t.len().saturating_sub(1);
        self.columns().into_iter().for_each(|column| drop(column.drain(..gone)));
        self.t.drain(..gone);
        self.bends.drain(..gone);
    }

    fn figures(&self, span: &Range<usize>, setup: &Setup<'_>, walk: Option<&mut Walk>) -> CycleFigures {
        let (a, b, Setup { law, count, still, .. }) = (span.start, span.end, setup);
        let (u, force) = (&self.u[a..=b], &self.force[a..=b]);
        let ((low, high), (least, most)) = (extent(u), extent(force));
        let middle = least + 0.5 * (most - least);
        let is_still = high - low <= *still;
        // Straight lines between events do not describe a loop.
        let is_known = walk.is_some() || setup.is_dense;
        let mut questions =
            if is_still || !is_known { Vec::new() } else { self.questions(span, (low, high), middle) };
        match walk {
            Some(walk) => walk.answer((self, law), span, (*count, middle), &mut questions),
            None => questions.iter_mut().for_each(|question| question.answer = self.chord(question, middle)),
        }
        let secant = |extreme: f64| {
            let found = questions.iter().find(|q| q.u.is_some() && q.extreme == extreme)?;
            let (from, way) = (self.at_extreme(span, extreme)?, found.u? - extreme);
            // Without displacement there is no secant stiffness.
            (way != 0.0).then(|| (found.answer - self.force[from]) / way)
        };
        let tangent = |extreme: f64| {
            self.at_extreme(span, extreme)
                .map(|i| count * law.stick_stiffness(self.d[i]))
                .filter(|k| *k > 0.0 && !is_still)
        };
        let time = [self.t[a], self.t[b]];
        let normal = match setup.load.filter(|_| time[1] > time[0]) {
            Some(load) => load.mean(law, time),
            None => mean_over_time(&self.t[a..=b], &self.normal[a..=b]),
        };
        // Force changes below the rounding error do not form a loop.
        let moves = most - least > ROUNDING * law.friction() * normal;
        let peaks = |values: &[f64]| {
            if setup.is_dense {
                self.peaks(span, values, setup.is_continuous)
            } else {
                extent(&values[a..=b])
            }
        };
        let ((left, right), (pulled, pushed)) = (peaks(&self.u), peaks(&self.force));
        // Near an event, an interpolating polynomial may exceed the friction limit. The force cannot exceed it.
        let grows = law.growth().is_some();
        let limit = if grows { f64::INFINITY } else { law.friction() * extent(&self.normal[a..=b]).1 };
        let (pulled, pushed) = (pulled.max(least.min(-limit)), pushed.min(most.max(limit)));
        let is_closed = !is_still && (force[force.len() - 1] - force[0]).abs() <= CLOSED * (most - least);
        let damping = setup.knows_damping.then(|| self.damping[b] - self.damping[a]);
        let cycle = Cycle {
            displacement_amplitude: 0.5 * (right - left),
            force_amplitude: 0.5 * (pushed - pulled),
            half_opening: self.half_opening(&questions, middle).filter(|_| moves && is_closed),
            // The friction work of a contact in full stick may be slightly below 0, within the tolerance of the integrator.
            dissipated: (self.friction[b] - self.friction[a]).max(0.0) + damping.unwrap_or(0.0).max(0.0),
            stiffness_after_maximum: tangent(high),
            stiffness_after_minimum: tangent(low),
        };
        CycleFigures {
            time,
            is_closed,
            cycle,
            damping,
            secants: [secant(high), secant(low)],
            normal,
            depth: self.d[a],
            is_still,
        }
    }

    /// Returns the points of a cycle to be evaluated: crossings of F_x with the middle of its range, and ends of both secants.
    fn questions(&self, span: &Range<usize>, (low, high): (f64, f64), middle: f64) -> Vec<Question> {
        let changes = |i: &usize| (self.force[*i] < middle) != (self.force[*i + 1] < middle);
        let zeros =
            span.clone().filter(changes).map(|after| Question { after, u: None, extreme: 0.0, answer: 0.0 });
        let window = WINDOW * (high - low);
        let back = |(extreme, u): (f64, f64)| {
            let from = self.at_extreme(span, extreme)?;
            // The search continues at the start of the cycle, because the end of the secant may precede the extreme in time.
            let mut on = (from..span.end).chain(span.start..from);
            let after = on.find(|i| (self.u[*i + 1] - extreme).abs() >= window)?;
            Some(Question { after, u: Some(u), extreme, answer: 0.0 })
        };
        let secants = [(high, high - window), (low, low + window)].into_iter().filter_map(back);
        let mut questions: Vec<Question> = zeros.chain(secants).collect();
        questions.sort_by_key(|question| question.after);
        questions
    }

    /// Returns the last sample at an extreme of u before the reversal. At the end of the cycle, it is the last sample of the cycle.
    fn at_extreme(&self, span: &Range<usize>, extreme: f64) -> Option<usize> {
        (span.start..=span.end)
            .rfind(|i| self.u[*i] == extreme && (*i == span.end || self.u[*i + 1] != extreme))
    }

    /// Evaluates a point of a cycle by linear interpolation between two samples instead of the contact law.
    fn chord(&self, question: &Question, middle: f64) -> f64 {
        let (i, j) = (question.after, question.after + 1);
        match question.u {
            None => {
                let share = (self.force[i] - middle) / (self.force[i] - self.force[j]);
                self.u[i] + share * (self.u[j] - self.u[i])
            }
            Some(u) => {
                let share = (u - self.u[i]) / (self.u[j] - self.u[i]);
                self.force[i] + share * (self.force[j] - self.force[i])
            }
        }
    }

    /// Returns half the distance in u, m, between the points at which the falling and the rising force cross the middle of their range.
    ///
    /// Returns `None` unless the cycle has one falling and one rising crossing.
    fn half_opening(&self, questions: &[Question], middle: f64) -> Option<f64> {
        let zeros = questions.iter().filter(|question| question.u.is_none());
        let (falling, rising): (Vec<&Question>, Vec<&Question>) =
            zeros.partition(|zero| self.force[zero.after + 1] < middle);
        match (falling.as_slice(), rising.as_slice()) {
            ([falling], [rising]) => Some(0.5 * (falling.answer - rising.answer)),
            _ => None,
        }
    }
}

/// Returns whether the motion of a body of contact `c` is determined by integration of the equations of motion.
pub fn is_integrated(setting: &Setting, c: usize) -> bool {
    let scene = &setting.scenario.scene;
    let sides = scene.contacts.get(c).into_iter().flat_map(|contact| contact.part.between);
    let mut bodies = sides.filter_map(|side| match side {
        Side::Body(body) => scene.bodies.get(body),
        Side::Ground => None,
    });
    bodies.any(|body| body.part.is_free() || body.part.is_balanced())
}

/// Returns the range of u below which contact `c` counts as at rest, m.
///
/// This range is twice the natural displacement times the tolerance of the integrator, or times the rounding error for prescribed motion.
fn still(setting: &Setting, c: usize) -> f64 {
    let natural = setting.model.contact_natural(c).map_or(0.0, |natural| natural.displacement);
    let promised = match setting.stepper() {
        _ if !is_integrated(setting, c) => 0.0,
        (_, "tolerance", tolerance) => tolerance,
        _ => FIXED,
    };
    2.0 * natural * promised.max(STILL)
}

/// Returns the non-periodic waveform, such as a table, that a body of contact `c` follows.
pub fn table_of(setting: &Setting, c: usize) -> Option<&Waveform> {
    let waveforms = followed(setting, c).filter_map(|w| setting.scenario.scene.waveforms.get(w));
    waveforms.map(|waveform| &waveform.part).find(|waveform| waveform.period().is_none())
}

/// Returns the mean over time by the trapezoidal rule, or the first value if the duration is 0.
fn mean_over_time(t: &[f64], values: &[f64]) -> f64 {
    let spans = t.windows(2).zip(values.windows(2));
    let area: f64 = spans.map(|(t, v)| 0.5 * (v[0] + v[1]) * (t[1] - t[0])).sum();
    let time = t[t.len() - 1] - t[0];
    if time > 0.0 { area / time } else { values[0] }
}
