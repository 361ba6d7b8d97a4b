//! Periods of a waveform within a run.

use crate::Setting;
use stickslip_drive::Waveform;
use stickslip_drive::scene::{Direction, Freedom, Scene, Side, Varying};

/// Distance of a time from a period end, in periods, below which both count as equal.
const SAME: f64 = 1e-9;

/// The whole periods of a waveform within a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Periods {
    /// Start of the first period, s.
    pub start: f64,
    /// Length of a period, s.
    pub length: f64,
    /// Number of whole periods, at least 1.
    pub count: usize,
}

impl Periods {
    /// Returns the whole periods of a waveform until the time `end`, s. Returns `None` if there is no period or none is complete.
    pub fn until(waveform: &Waveform, end: f64) -> Option<Self> {
        let (length, timing) = (waveform.period()?, waveform.timing());
        let cycles = timing.cycles.unwrap_or(f64::INFINITY);
        // A repeated table may start before the run. Its first period is then the first one that starts within the run.
        let before = (-timing.delay / length - SAME).ceil().max(0.0);
        let start = if before > 0.0 { timing.delay + before * length } else { timing.delay };
        let count = ((end - start) / length).min(cycles - before) + SAME;
        // The bound exceeds the number of periods of any run.
        let count = count.floor().min(1e9);
        (count >= 1.0).then_some(Self { start, length, count: count as usize })
    }

    /// Returns the periods of the excitation of contact `c` until the time `end`, s.
    ///
    /// The excitation is the only waveform that the bodies of the contact follow, or else the waveform named in `figures`.
    pub fn of_contact(setting: &Setting, c: usize, end: f64) -> Option<Self> {
        let mut followed = followed(setting, c);
        let waveform = match (followed.next(), followed.next()) {
            (Some(only), None) => only,
            _ => setting.scenario.figures.waveform?,
        };
        Self::until(&setting.scenario.scene.waveforms.get(waveform)?.part, end)
    }

    /// Returns the end of period k, s, which is the start of period k + 1. The periods are numbered from 1.
    pub fn end_of(&self, k: usize) -> f64 {
        self.start + k as f64 * self.length
    }

    /// Returns start and end of the first period, s.
    pub fn first(&self) -> (f64, f64) {
        (self.start, self.end_of(1))
    }

    /// Returns start and end of the last period, s.
    pub fn last(&self) -> (f64, f64) {
        (self.end_of(self.count - 1), self.end_of(self.count))
    }

    /// Returns the tolerance of times that count as the end of period k, s.
    fn hair(&self, k: usize) -> f64 {
        // After many periods, the rounding of t is larger.
        (SAME * self.length).max(4.0 * f64::EPSILON * self.end_of(k).abs())
    }
}

/// Detects period ends in a sequence of ascending times. Of several times within the tolerance, the first counts as the period end.
#[derive(Debug, Clone, Copy)]
pub struct Tracker {
    periods: Periods,
    /// Number of the next period end.
    next: usize,
    is_over: bool,
}

impl Tracker {
    /// Creates a detector at the start of the first period.
    pub fn new(periods: Periods) -> Self {
        Self { periods, next: 0, is_over: false }
    }

    /// Returns the number of the period that ends at time t, s, or 0 at the start of the first period. Times must ascend.
    ///
    /// If the sequence of times skips a period end, no further period ends are reported.
    pub fn pass(&mut self, t: f64) -> Option<usize> {
        if self.is_over {
            return None;
        }
        let (end, hair) = (self.periods.end_of(self.next), self.periods.hair(self.next));
        if t < end - hair {
            return None;
        }
        let found = (t <= end + hair).then_some(self.next);
        self.next += 1;
        self.is_over = found.is_none() || self.next > self.periods.count;
        found
    }

    /// Returns whether there are no further period ends.
    pub fn is_over(&self) -> bool {
        self.is_over
    }
}

/// Returns the indices of the waveforms that the bodies of contact `c` follow along x.
///
/// A massless body follows the waveforms of its loads and stacks, and those of massless bodies to which springs connect it.
pub fn followed(setting: &Setting, c: usize) -> impl Iterator<Item = usize> + use<> {
    let scene = &setting.scenario.scene;
    let mut bodies: Vec<usize> =
        scene.contacts.get(c).into_iter().flat_map(|it| sides(it.part.between)).collect();
    let (mut followed, mut next) = (Vec::new(), 0);
    while let Some(body) = bodies.get(next).copied() {
        next += 1;
        match scene.bodies.get(body).map(|body| body.part.x.freedom) {
            Some(Freedom::Follows(waveform)) => followed.push(waveform),
            Some(Freedom::Balanced) => pulls(scene, body, (&mut bodies, &mut followed)),
            _ => {}
        }
    }
    followed.into_iter()
}

/// Adds the sources of forces along x on a massless body: waveforms of loads and stacks, and bodies at the other ends of springs.
fn pulls(scene: &Scene, body: usize, (bodies, followed): (&mut Vec<usize>, &mut Vec<usize>)) {
    let varying = |value: Varying| match value {
        Varying::Follows(signal) => scene.waveform_of(signal),
        Varying::Constant(_) => None,
    };
    let loads = scene.loads.iter().filter(|load| load.on == body).filter_map(|load| varying(load.x));
    let is_here = |between: [Side; 2], direction: Direction| {
        direction == Direction::X && between.contains(&Side::Body(body))
    };
    let stacks = scene.actuators.iter().filter(|it| is_here(it.part.between, it.part.direction));
    for waveform in loads.chain(stacks.clone().filter_map(|it| varying(it.part.stroke))) {
        // A waveform that acts in several ways is listed once.
        if !followed.contains(&waveform) {
            followed.push(waveform);
        }
    }
    let springs = scene.springs.iter().filter(|it| is_here(it.part.between, it.part.direction));
    let ends = springs.map(|it| it.part.between).chain(stacks.map(|it| it.part.between));
    for other in ends.flat_map(sides) {
        if !bodies.contains(&other) {
            bodies.push(other);
        }
    }
}

/// Returns the bodies at both ends of a connection; the ground is no body.
fn sides(between: [Side; 2]) -> impl Iterator<Item = usize> {
    between.into_iter().filter_map(|side| match side {
        Side::Body(body) => Some(body),
        Side::Ground => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_drive::{Shape, Timing};

    fn triangle(delay: f64, cycles: Option<f64>) -> Waveform {
        let timing = Timing { period: 2.0, delay, phase: 0.0, cycles };
        Waveform::new(Shape::Triangle { stroke: 1.0 }, timing).unwrap()
    }

    #[test]
    fn only_whole_periods_count() {
        let until = |end| Periods::until(&triangle(1.0, Some(3.0)), end).map(|p| (p.start, p.count));
        assert_eq!(until(2.9), None);
        assert_eq!(until(5.0 - 1e-12), Some((1.0, 2)));
        assert_eq!(until(99.0), Some((1.0, 3)));
        // If a table started before the run, the first period that starts within the run counts, even at its very start.
        let early = |delay| Periods::until(&triangle(delay, Some(3.0)), 3.5).map(|p| (p.start, p.count));
        assert_eq!(early(-0.5), Some((1.5, 1)));
        assert_eq!(early(-2.0), Some((0.0, 1)));
        assert_eq!(early(-4.0), Some((0.0, 1)));
        assert_eq!(early(-6.0), None);
    }

    #[test]
    fn rounded_ends_are_found() {
        let t: Vec<f64> = (0..=30).map(|i| f64::from(i) * 0.1).collect();
        let periods = Periods { start: 0.0, length: 0.3, count: 10 };
        let ends = |periods: Periods| {
            let mut tracker = Tracker::new(periods);
            t.iter().map(|t| tracker.pass(*t)).collect::<Vec<_>>()
        };
        let wanted: Vec<Option<usize>> = (0..=30).map(|i| (i % 3 == 0).then_some(i / 3)).collect();
        assert_eq!(ends(periods), wanted);
        // After a missing period end, no further ones are reported.
        let found: Vec<usize> = ends(Periods { length: 0.25, ..periods }).into_iter().flatten().collect();
        assert_eq!(found, [0]);
    }
}
