//! Times at which the evaluations of a run need samples: period ends, and further times within periods.

use crate::Setting;
use crate::account::Phases;
use crate::contact_cycles::{is_integrated, table_of};
use crate::contact_path::is_walked;
use crate::foot::Foot;
use crate::periods::{Periods, followed};
use crate::pulses::Pulses;
use stickslip_drive::Waveform;
use stickslip_drive::scene::{Direction, Freedom, Normal, Side, Varying};

/// Number of samples per period for contacts whose force does not follow from the path of u alone.
///
/// The extremes and kinks of the loops of these contacts are not events.
const PARTS: f64 = 512.0;
/// Number of samples per period of a normal load with a shorter period. The relative error of the extremes of a sine is then 3e-8.
const LOAD_PARTS: f64 = 64.0;
/// Number of samples per period of the natural oscillation (ringing) of the bodies of a contact.
const RING_PARTS: f64 = 24.0;
/// Number of samples over the full range of a waveform, in pieces that are fast compared with the other samples of the period.
const WAY_PARTS: f64 = 128.0;
/// Maximum number of samples in fast pieces per period. A waveform that needs more, such as a noise table, gets no such samples.
const MOST_WAY_PARTS: usize = 4096;
/// Maximum number of samples per period. The limit bounds the memory for one cycle.
const MOST_PARTS: f64 = 65_536.0;
/// Number of samples over the duration of a table.
const TABLE_PARTS: f64 = 4096.0;
/// Distance of a time from a period end, in periods, below which both count as equal.
const SAME: f64 = 1e-9;

/// Iterator over the sampling times of a run.
pub struct Marks {
    grids: Vec<Grid>,
    /// Number of grids, from the first, with samples for all evaluations. Other grids are only for the evaluation of drive periods.
    common: usize,
    /// Stepping body, whose displacement in each period is evaluated.
    pub body: Option<usize>,
    /// Foot that a stack moves below the stepping body. The displacement of the foot is evaluated, too.
    pub foot: Option<usize>,
    /// Periods of the waveform in `figures`.
    figures: Option<Periods>,
    /// Pulses of that waveform, if it is a burst or a sequence.
    pub pulses: Option<Pulses>,
    /// End of the run, s.
    end: f64,
}

/// Equally spaced sampling times.
struct Grid {
    start: f64,
    interval: f64,
    /// Index of the next sampling time, and index of the last sampling time.
    next: f64,
    last: f64,
}

impl Marks {
    /// Returns the sampling times for a setting.
    pub fn of(setting: &Setting) -> Self {
        let (scene, figures, end) =
            (&setting.scenario.scene, setting.scenario.figures, setting.scenario.plan.duration);
        // The sampling times do not depend on the planned end of the run, so that a resumed run has the same sampling times.
        let for_ever = f64::INFINITY;
        let is_free =
            |body: &usize| scene.bodies.get(*body).is_some_and(|b| b.part.x.freedom == Freedom::Free);
        let body = figures.body.filter(is_free);
        let of_figures = || Periods::until(&scene.waveforms.get(figures.waveform?)?.part, for_ever);
        let figures = body.and_then(|_| of_figures());
        let mut grids: Vec<Grid> = figures.iter().map(|periods| Grid::of(periods, 1.0)).collect();
        for c in 0..scene.contacts.len() {
            let is_dense = are_dense(setting, c);
            let grids_of_contact = match (Periods::of_contact(setting, c, for_ever), table_of(setting, c)) {
                (Some(periods), _) => {
                    let load = load_of(setting, c).filter(|_| is_dense);
                    let parts = if is_dense {
                        parts_of(&periods, load).max(of_ringing(setting, c, &periods))
                    } else {
                        1.0
                    };
                    let of_load = load.into_iter().flat_map(peaks_of_load);
                    let drives =
                        followed(setting, c).filter_map(|w| scene.waveforms.get(w)).map(|it| &it.part);
                    let fast = drives.chain(load).filter(|_| is_dense);
                    let fast = fast.flat_map(|waveform| fast_pieces(waveform, periods.length / parts));
                    let jumping = followed(setting, c).filter_map(|w| scene.waveforms.get(w));
                    let jumps = jumping.flat_map(|waveform| jumps_of(&waveform.part));
                    [Grid::of(&periods, parts)].into_iter().chain(of_load).chain(fast).chain(jumps).collect()
                }
                (None, Some(table)) => Grid::along(table, !is_dense, end),
                (None, None) => Vec::new(),
            };
            for grid in grids_of_contact {
                if !grids.iter().any(|other| other.is_same(&grid)) {
                    grids.push(grid);
                }
            }
        }
        let common = grids.len();
        grids.extend(figures.iter().flat_map(|periods| turns(setting, periods)));
        let body = body.filter(|_| figures.is_some());
        let foot = body.and_then(|_| Foot::of(setting)?.driven());
        let pulses = Pulses::of(setting);
        Self { grids, common, body, foot, figures, pulses, end }
    }

    /// Returns whether a sample at this time is for all evaluations, not only for the evaluation of drive periods.
    pub fn is_common(&self, t: f64) -> bool {
        self.common == self.grids.len() && self.pulses.is_none()
            || self.grids.iter().take(self.common).any(|grid| grid.has(t))
    }

    /// Returns the next sampling time, s.
    pub fn take_next(&mut self) -> Option<f64> {
        let of_pulses = self.pulses.iter().filter_map(Pulses::due);
        let next = self.grids.iter().filter_map(Grid::due).chain(of_pulses).fold(f64::INFINITY, f64::min);
        for grid in &mut self.grids {
            // Times that differ by rounding errors only count as one time.
            let same = if grid.interval.is_finite() { SAME * grid.interval } else { 0.0 };
            while grid.due().is_some_and(|due| due <= next + same) {
                grid.next += 1.0;
            }
        }
        if let Some(pulses) = &mut self.pulses {
            pulses.pass(next);
        }
        // A period end may differ from the end of the run by a rounding error.
        let end = self.end;
        (next < f64::INFINITY).then_some(if next > end && next < end * (1.0 + SAME) { end } else { next })
    }

    /// Returns the periods of the waveform in `figures`.
    pub fn figures(&self) -> Option<Periods> {
        self.figures
    }

    /// Returns the number of the period that ends at time t, from 1. Returns 0 for the start of the first period.
    pub fn period_ended(&self, t: f64) -> Option<u64> {
        let periods = self.figures?;
        let place = (t - periods.start) / periods.length;
        // After many periods, the rounding of t is larger.
        let same = SAME.max(4.0 * f64::EPSILON * place.abs());
        ((place - place.round()).abs() <= same && place > -0.5).then(|| place.round() as u64)
    }
}

/// Returns whether a contact is sampled several times per period or per table.
///
/// Contacts are sampled if their force depends on more than the path of u, except contacts on which the stepping body slides. Contacts
/// between two free bodies are sampled, too, because the bodies may step together.
pub fn are_dense(setting: &Setting, c: usize) -> bool {
    if is_walked(setting, c) {
        return false;
    }
    let is_free = |body: &usize| {
        setting.scenario.scene.bodies.get(*body).is_some_and(|b| b.part.x.freedom == Freedom::Free)
    };
    let sides = setting.scenario.scene.contacts.get(c).map(|contact| contact.part.between);
    let tells_turns = setting.model.effective(setting.scenario.plan.stepper).locates_events();
    let steps = setting.scenario.figures.body.filter(is_free).zip(sides).is_some_and(|(body, sides)| {
        let frees = |side: &Side| matches!(side, Side::Body(other) if *other != body && is_free(other));
        // A contact with the ground has loops. With fixed time steps, its reversals are not events.
        let is_untold = sides.contains(&Side::Ground) && !tells_turns;
        sides.contains(&Side::Body(body)) && !sides.iter().any(frees) && !is_untold && !is_held(setting, body)
    });
    match Periods::of_contact(setting, c, f64::INFINITY) {
        Some(_) => !steps,
        None => table_of(setting, c).is_some(),
    }
}

/// Returns whether a spring or a stack along x connects a body to the ground or to a body that is not free.
fn is_held(setting: &Setting, body: usize) -> bool {
    let scene = &setting.scenario.scene;
    let own = |side: &Side| *side == Side::Body(body);
    let stays = |side: &Side| match side {
        Side::Body(other) => {
            *other != body && scene.bodies.get(*other).is_some_and(|it| it.part.x.freedom != Freedom::Free)
        }
        Side::Ground => true,
    };
    let springs = scene.springs.iter().filter(|spring| spring.part.stiffness > 0.0);
    let springs = springs.map(|spring| (spring.part.between, spring.part.direction));
    let stacks = scene.actuators.iter().map(|stack| (stack.part.between, stack.part.direction));
    springs.chain(stacks).any(|(between, direction)| {
        direction == Direction::X && between.iter().any(own) && between.iter().any(stays)
    })
}

/// Returns the waveform of the normal load of a contact.
fn load_of(setting: &Setting, c: usize) -> Option<&Waveform> {
    match setting.scenario.scene.contacts.get(c)?.part.normal {
        Normal::Force(Varying::Follows(w))
        | Normal::Indentation(Varying::Follows(w))
        | Normal::Radius(Varying::Follows(w)) => Some(&setting.scenario.scene.waveforms.get(w)?.part),
        _ => None,
    }
}

/// Returns the number of samples per period of a contact. More samples are needed if its normal load has a shorter period.
fn parts_of(periods: &Periods, load: Option<&Waveform>) -> f64 {
    let loads = load.and_then(Waveform::period).map_or(0.0, |period| periods.length / period);
    (LOAD_PARTS * loads).ceil().clamp(PARTS, MOST_PARTS)
}

/// Returns the number of samples per period for a damped contact whose bodies ring. Without damping, reversals are events.
fn of_ringing(setting: &Setting, c: usize, periods: &Periods) -> f64 {
    let rings = setting.is_damped(c) && is_integrated(setting, c);
    let frequency = setting.model.contact_frequency(c).filter(|_| rings).unwrap_or(0.0);
    (RING_PARTS * periods.length * frequency / std::f64::consts::TAU).ceil().min(MOST_PARTS)
}

/// Returns the turning points of a normal load, at which the friction limit and the force of a sliding contact have extremes.
fn peaks_of_load(load: &Waveform) -> Vec<Grid> {
    let Some(periods) = Periods::until(load, f64::INFINITY) else { return Vec::new() };
    let Some(phases) = Phases::of(load).filter(|_| !load.is_straight()) else { return Vec::new() };
    let grid = |turn: f64| Grid { start: periods.start + turn, ..Grid::of(&periods, 1.0) };
    std::iter::once(0.0).chain(phases.turns()).map(grid).collect()
}

/// Returns the times just before the jumps of a waveform.
fn jumps_of(waveform: &Waveform) -> Vec<Grid> {
    if !waveform.has_jumps() {
        return Vec::new();
    }
    let Some(periods) = Periods::until(waveform, f64::INFINITY) else { return Vec::new() };
    let (from, to) = periods.first();
    let pieces = waveform.pieces_from(from).take_while(|piece| piece.start < to);
    let jumps = pieces.filter(|piece| waveform.jump_after(piece) != 0.0);
    jumps.map(|piece| Grid { start: piece.end, ..Grid::of(&periods, 1.0) }).take(MOST_WAY_PARTS).collect()
}

/// Returns sampling times within fast pieces of a waveform. `part` is the sampling interval in other pieces, s.
fn fast_pieces(waveform: &Waveform, part: f64) -> Vec<Grid> {
    let Some(periods) = Periods::until(waveform, f64::INFINITY) else { return Vec::new() };
    if waveform.generator().is_some() || waveform.interpolation().is_some() {
        return Vec::new();
    }
    let ((from, to), (low, high)) = (periods.first(), waveform.range());
    let mut grids = Vec::new();
    for piece in waveform.pieces_from(from).take_while(|piece| piece.start < to) {
        let [begin, end] = [piece.start, piece.end].map(|t| waveform.sample(&piece, t).value);
        let (parts, length) =
            ((WAY_PARTS * (end - begin).abs() / (high - low)).ceil(), piece.end - piece.start);
        if parts * part > length {
            let at = |k: u64| piece.start + length * (k as f64 / parts);
            let grid = |k: u64| Grid { start: at(k), ..Grid::of(&periods, 1.0) };
            grids.extend((1..parts as u64).map(grid));
        }
        if grids.len() > MOST_WAY_PARTS {
            return Vec::new();
        }
    }
    grids
}

/// Returns the turning points of the waveform in `figures` that are not events.
///
/// Turning points without a corner are not events. With fixed time steps, no turning point is an event.
fn turns(setting: &Setting, periods: &Periods) -> Vec<Grid> {
    let waveform = setting.scenario.figures.waveform.and_then(|w| setting.scenario.scene.waveforms.get(w));
    let tells_corners = setting.model.effective(setting.scenario.plan.stepper).locates_events();
    let untold = waveform.map(|it| &it.part).filter(|waveform| !(tells_corners && waveform.is_straight()));
    let Some(phases) = untold.and_then(Phases::of) else { return Vec::new() };
    let grid = |turn: f64| Grid { start: periods.start + turn, ..Grid::of(periods, 1.0) };
    phases.turns().map(grid).collect()
}

impl Grid {
    fn of(periods: &Periods, parts: f64) -> Self {
        let last = periods.count as f64 * parts;
        Self { start: periods.start, interval: periods.length / parts, next: 0.0, last }
    }

    /// Returns the sampling times for a non-periodic waveform: the start and the end of the run, and times along the waveform.
    ///
    /// Times along the waveform are needed only if the contact law cannot be evaluated between events.
    fn along(waveform: &Waveform, is_walked: bool, end: f64) -> Vec<Self> {
        let once = |start: f64| Self { start, interval: f64::INFINITY, next: 0.0, last: 0.0 };
        let (from, to) = waveform.window();
        let parts = Self { start: from, interval: (to - from) / TABLE_PARTS, next: 0.0, last: TABLE_PARTS };
        let parts = Some(parts).filter(|parts| !is_walked && parts.interval.is_finite());
        [Some(once(0.0)), Some(once(end)), parts].into_iter().flatten().collect()
    }

    fn due(&self) -> Option<f64> {
        let way = if self.next > 0.0 { self.next * self.interval } else { 0.0 };
        (self.next <= self.last).then_some(self.start + way)
    }

    /// Returns whether time t, s, is a sampling time of the grid.
    fn has(&self, t: f64) -> bool {
        if self.interval == f64::INFINITY {
            return t == self.start;
        }
        let place = (t - self.start) / self.interval;
        (place - place.round()).abs() <= SAME.max(4.0 * f64::EPSILON * place.abs())
    }

    fn is_same(&self, other: &Self) -> bool {
        self.start == other.start && self.interval == other.interval && self.last == other.last
    }
}
