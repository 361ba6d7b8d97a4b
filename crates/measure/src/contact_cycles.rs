//! The cycles of a contact, from the moments of a run and the contact's own law between them.
//!
//! Cycles are told as they end: of a run of any length no more is kept than the moments of the cycle under way. Those between
//! reversals of a table, which has no periods, are told at the end of the run.
//!
//! Nothing here is read off rows. Ends of cycles are marks, turning points are events; where the contact's law has no time in
//! it, the way from one to the next is walked once more, and what lies between is asked of the law. Elsewhere moments are dense:
//! peaks between them are those of polynomials, and the mean of a prescribed load is an integral of its waveform.

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

/// Change of a force below this share of the limit of friction is rounding.
const ROUNDING: f64 = 1e-9;
/// Amplitude of u in natural displacements that rounding alone makes; what a fixed step may make of rest.
const STILL: f64 = 1e-12;
const FIXED: f64 = 1e-9;
/// Share of the displacement range over which a secant is taken.
const WINDOW: f64 = crate::fretting::STIFFNESS_WINDOW;

/// One cycle of a contact that comes back along u.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleFigures {
    /// Start and end, s.
    pub time: [f64; 2],
    /// Whether the force comes back as well; otherwise there is no loop, and ratios say nothing.
    pub is_closed: bool,
    /// Amplitudes, opening, and as E_d what is lost, to friction and, as far as it is known, to damping; stiffnesses are the contact's
    /// own, of full stick.
    pub cycle: Cycle,
    /// What the contact's own damping has taken, J, 0 without any; none where other parts lose energy as well, from whose share it
    /// is not told apart.
    pub damping: Option<f64>,
    /// Secants of the first tenth of the way back, after the maximum and after the minimum of u, N/m.
    pub secants: [Option<f64>; 2],
    /// Mean normal force, N.
    pub normal: f64,
    /// Indentation at its start, m.
    pub depth: f64,
    /// Whether u moves by less than what can be told from rest: then there is no loop, however its ends lie.
    pub is_still: bool,
}

impl CycleFigures {
    /// Friction work, J.
    pub fn friction(&self) -> f64 {
        self.cycle.dissipated - self.damping.unwrap_or(0.0)
    }

    /// `E_d`, J: all that is lost; none where damping's part is not known.
    pub fn dissipated(&self) -> Option<f64> {
        self.damping.map(|_| self.cycle.dissipated)
    }

    /// A quantity that only a loop has.
    pub fn of_loop(&self, value: Option<f64>) -> Option<f64> {
        value.filter(|_| self.is_closed)
    }

    /// A quotient with `E_d`: only a loop has it, and one all of whose losses are known.
    pub fn ratio(&self, value: Option<f64>) -> Option<f64> {
        self.of_loop(value).filter(|_| self.damping.is_some())
    }
}

/// The moments of a contact, from the start of the cycle under way or, where cycles are told only at the end, from the first.
#[derive(Debug, Clone, Default)]
struct Track {
    t: Vec<f64>,
    u: Vec<f64>,
    d: Vec<f64>,
    force: Vec<f64>,
    normal: Vec<f64>,
    friction: Vec<f64>,
    damping: Vec<f64>,
    /// Whether something bends there: an event.
    bends: Vec<bool>,
}

/// A moment of a contact: u and d, m, forces, N, and what friction and damping have taken so far, J.
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

/// What a contact's figures are taken with, beside its moments.
struct Setup<'a> {
    law: &'a Interface,
    /// Number of identical contacts.
    count: f64,
    /// Range of u up to which it stands still, m.
    still: f64,
    load: Option<&'a Load>,
    /// Whether moments are so dense that extremes between them are those of polynomials.
    is_dense: bool,
    /// Whether its force never jumps at an event.
    is_continuous: bool,
    /// Whether what its own damping takes is known.
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

    /// All but time, in the order of a moment.
    fn columns(&mut self) -> [&mut Vec<f64>; 6] {
        let Self { u, d, force, normal, friction, damping, .. } = self;
        [u, d, force, normal, friction, damping]
    }

    /// Forgets all but the last moment.
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
        // Along straight lines from event to event a loop has no shape.
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
            // A contact at rest has no way back.
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
        // What moves in the last digits has no loop.
        let moves = most - least > ROUNDING * law.friction() * normal;
        let peaks = |values: &[f64]| {
            if setup.is_dense {
                self.peaks(span, values, setup.is_continuous)
            } else {
                extent(&values[a..=b])
            }
        };
        let ((left, right), (pulled, pushed)) = (peaks(&self.u), peaks(&self.force));
        // Polynomials beside an event know nothing of the limit of friction, beyond which nothing but damping bears.
        let limit =
            if law.damping() > 0.0 { f64::INFINITY } else { law.friction() * extent(&self.normal[a..=b]).1 };
        let (pulled, pushed) = (pulled.max(least.min(-limit)), pushed.min(most.max(limit)));
        let is_closed = !is_still && (force[force.len() - 1] - force[0]).abs() <= CLOSED * (most - least);
        let damping = setup.knows_damping.then(|| self.damping[b] - self.damping[a]);
        let cycle = Cycle {
            displacement_amplitude: 0.5 * (right - left),
            force_amplitude: 0.5 * (pushed - pulled),
            half_opening: self.half_opening(&questions, middle).filter(|_| moves && is_closed),
            // Less than nothing is what a tolerance leaves of a contact that sticks.
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

    /// Where F_x passes the middle of its range, and at u after a tenth of the way back from either extreme.
    fn questions(&self, span: &Range<usize>, (low, high): (f64, f64), middle: f64) -> Vec<Question> {
        let changes = |i: &usize| (self.force[*i] < middle) != (self.force[*i + 1] < middle);
        let zeros =
            span.clone().filter(changes).map(|after| Question { after, u: None, extreme: 0.0, answer: 0.0 });
        let window = WINDOW * (high - low);
        let back = |(extreme, u): (f64, f64)| {
            let from = self.at_extreme(span, extreme)?;
            // Round the loop: it is closed, and the way back may lie before the extreme.
            let mut on = (from..span.end).chain(span.start..from);
            let after = on.find(|i| (self.u[*i + 1] - extreme).abs() >= window)?;
            Some(Question { after, u: Some(u), extreme, answer: 0.0 })
        };
        let secants = [(high, high - window), (low, low + window)].into_iter().filter_map(back);
        let mut questions: Vec<Question> = zeros.chain(secants).collect();
        questions.sort_by_key(|question| question.after);
        questions
    }

    /// The last moment at an extreme before the motion turns; that at the end of the cycle is the one at its start.
    fn at_extreme(&self, span: &Range<usize>, extreme: f64) -> Option<usize> {
        (span.start..=span.end)
            .rfind(|i| self.u[*i] == extreme && (*i == span.end || self.u[*i + 1] != extreme))
    }

    /// The answer along a straight line between two moments.
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

    /// Half the distance between the places where a falling force and a rising one pass the middle of their range; none where
    /// they pass it more than once.
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

/// Whether a body of contact `c` moves as forces say.
pub fn is_integrated(setting: &Setting, c: usize) -> bool {
    let scene = &setting.scenario.scene;
    let sides = scene.contacts.get(c).into_iter().flat_map(|contact| contact.part.between);
    let mut bodies = sides.filter_map(|side| match side {
        Side::Body(body) => scene.bodies.get(body),
        Side::Ground => None,
    });
    bodies.any(|body| body.part.is_free() || body.part.is_balanced())
}

/// Range of u up to which contact `c` stands still, m: twice the amplitude that rounding may leave, and, where its bodies are
/// integrated, what the stepper promises, both of the natural displacement.
fn still(setting: &Setting, c: usize) -> f64 {
    let natural = setting.model.contact_natural(c).map_or(0.0, |natural| natural.displacement);
    let promised = match setting.stepper() {
        _ if !is_integrated(setting, c) => 0.0,
        (_, "tolerance", tolerance) => tolerance,
        _ => FIXED,
    };
    2.0 * natural * promised.max(STILL)
}

/// The waveform without a period that a body of a contact follows.
pub fn table_of(setting: &Setting, c: usize) -> Option<&Waveform> {
    let waveforms = followed(setting, c).filter_map(|w| setting.scenario.scene.waveforms.get(w));
    waveforms.map(|waveform| &waveform.part).find(|waveform| waveform.period().is_none())
}

/// Mean by the trapezium rule; of no time the first value.
fn mean_over_time(t: &[f64], values: &[f64]) -> f64 {
    let spans = t.windows(2).zip(values.windows(2));
    let area: f64 = spans.map(|(t, v)| 0.5 * (v[0] + v[1]) * (t[1] - t[0])).sum();
    let time = t[t.len() - 1] - t[0];
    if time > 0.0 { area / time } else { values[0] }
}
