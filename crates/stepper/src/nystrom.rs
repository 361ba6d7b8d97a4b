//! The Runge–Kutta–Nyström pair RKN8(6)9 for forces without velocities: order 8, error estimate of order 6.
//!
//! Where accelerations depend on time and positions alone, positions need no stages of their own for the velocities: a
//! step costs 8 evaluations instead of the 12 of [`Dop853`](crate::Dop853), and each carries half the components.
//!
//! Source: J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince, *High-order embedded Runge–Kutta–Nyström formulae*,
//! IMA Journal of Numerical Analysis 7 (1987) 423–430. The dense output is Hermite–Birkhoff: accelerations at seven
//! nodes of the step, those inside evaluated again on the interpolant of the stages.

mod lanes;
mod tableau;
mod track;

pub use lanes::{Lane, Lanes, Many, One};
pub use track::Track;

use crate::{Attempt, Completion, End, Method, Span, Step, Target};
use tableau::{
    END, NODES, POSITION_ERROR, POSITIONS, REFINED, REFINED_POSITIONS, SAMPLED, STAGES, VELOCITY,
    VELOCITY_ERROR,
};
use track::dot;

/// Power of the step with which the error estimate falls.
pub const ORDER: u32 = 7;

/// A system whose accelerations, and the rates of whose quadratures, depend on time and positions alone.
///
/// Its state has n positions, n velocities and then the quadratures.
pub trait Conservative {
    /// Accelerations (n) and then the rates of the quadratures at time `t` (s) and positions `x`; all to be filled.
    fn accelerations(&self, t: f64, x: &[f64], out: &mut [f64]);

    /// Whether accelerations and rates are the same at all times and positions of the coming step: then they are not
    /// asked for again.
    fn coasts(&self) -> bool {
        false
    }
}

/// One step of RKN8(6)9 at a time, as [`Dop853`](crate::Dop853) does it.
#[derive(Debug, Clone)]
pub struct Nystrom<L: Lanes = Many> {
    time: f64,
    end_time: f64,
    step: f64,
    begin: L::State,
    end: L::State,
    stage: L::Positions,
    rates: L::Rates,
    /// Of each position and then each quadrature.
    tracks: L::Tracks,
    constant: bool,
    first_known: bool,
    last_known: bool,
    dense_known: bool,
    evaluations: u64,
}

impl Nystrom {
    /// Workspace for `positions` positions and `quadratures` quadratures.
    #[must_use]
    pub fn new(positions: usize, quadratures: usize) -> Self {
        Self::with_room(positions, quadratures)
    }
}

impl Nystrom<One> {
    /// Workspace for one position and one quadrature.
    #[must_use]
    pub fn one() -> Self {
        Self::with_room(1, 1)
    }
}

impl<L: Lanes> Nystrom<L> {
    fn with_room(positions: usize, quadratures: usize) -> Self {
        let (rates, total) = (positions + quadratures, 2 * positions + quadratures);
        Self {
            time: 0.0,
            end_time: 0.0,
            step: 0.0,
            begin: Lane::of(total),
            end: Lane::of(total),
            stage: Lane::of(positions),
            rates: Lane::of(rates),
            tracks: Lane::of(rates),
            constant: false,
            first_known: false,
            last_known: false,
            dense_known: false,
            evaluations: 0,
        }
    }

    /// Number of positions.
    #[inline(always)]
    fn positions(&self) -> usize {
        self.stage.as_ref().len()
    }

    #[inline(always)]
    fn evaluate<S: Conservative + ?Sized>(&mut self, system: &S, t: f64, stage: usize) {
        system.accelerations(t, self.stage.as_ref(), self.rates.as_mut());
        self.evaluations += 1;
        for (track, rate) in self.tracks.as_mut().iter_mut().zip(self.rates.as_ref()) {
            track.k[stage] = *rate;
        }
    }

    /// Positions of stage `J`, and what acts there.
    #[inline(always)]
    fn advance<const J: usize, S: Conservative + ?Sized>(&mut self, system: &S, t: f64) {
        let h = self.step;
        // Of all that a position is made of only the stage before is new: it comes last, and nothing waits for it.
        let (before, last) = (&POSITIONS[J], J - 1);
        for (to, track) in self.stage.as_mut().iter_mut().zip(self.tracks.as_ref()) {
            let known = track.x + h * (NODES[J] * track.v + h * dot(before, &track.k, last));
            *to = if before[last] == 0.0 { known } else { known + h * h * before[last] * track.k[last] };
        }
        self.evaluate(system, t, J);
    }

    /// All stages at once where nothing changes: the end is the parabola's.
    #[inline(never)]
    fn advance_constant(&mut self) {
        let h = self.step;
        for track in self.tracks.as_mut() {
            track.k = [track.k[0]; STAGES];
        }
        for (to, track) in self.stage.as_mut().iter_mut().zip(self.tracks.as_ref()) {
            *to = track.x + h * (track.v + 0.5 * h * track.k[0]);
        }
    }

    /// The end of the step by the weights of order 8; the last stage has the end's positions.
    #[inline]
    fn conclude(&mut self) {
        let (h, n) = (self.step, self.positions());
        self.end.as_mut()[..n].copy_from_slice(self.stage.as_ref());
        for (to, track) in self.end.as_mut()[n..].iter_mut().zip(self.tracks.as_ref()) {
            *to = track.v + h * dot(&VELOCITY, &track.k, 8);
        }
    }

    /// Largest difference of the two orders in units of `scale`.
    #[inline]
    fn error(&self, scale: &[f64]) -> f64 {
        let (h, n) = (self.step, self.positions());
        let (positions, velocities) = scale.split_at(n);
        let (mut largest, mut sum) = (0.0_f64, 0.0);
        let mut add = |error: f64, scale: f64| {
            let error = (error / scale).abs();
            largest = if error > largest { error } else { largest };
            // A comparison drops NaN, a sum does not.
            sum += error;
        };
        for (track, scale) in self.tracks.as_ref().iter().zip(positions) {
            add(h * h * dot(&POSITION_ERROR, &track.k, 7), *scale);
        }
        for (track, scale) in self.tracks.as_ref().iter().zip(velocities) {
            add(h * dot(&VELOCITY_ERROR, &track.k, STAGES), *scale);
        }
        sum += self.end.as_ref().iter().sum::<f64>();
        if sum.is_finite() { largest } else { f64::INFINITY }
    }

    /// Component `i` at a fraction of the step.
    #[inline]
    fn at(&self, i: usize, share: f64) -> f64 {
        match i.checked_sub(self.positions()) {
            None => self.tracks.as_ref()[i].position(self.step, share),
            Some(i) => self.tracks.as_ref()[i].velocity(self.step, share),
        }
    }

    /// Evaluates the samples inside the step again: the stages there are of order 4 only.
    fn refine<S: Conservative + ?Sized>(&mut self, system: &S) {
        let (h, n) = (self.step, self.positions());
        for track in &mut self.tracks.as_mut()[..n] {
            for (r, sample) in REFINED.enumerate() {
                let node = NODES[SAMPLED[sample]];
                let bend: f64 =
                    REFINED_POSITIONS[r].iter().zip(SAMPLED).map(|(w, stage)| w * track.k[stage]).sum();
                track.refined[r] = track.x + node * h * (track.v + node * h * bend);
            }
        }
        for (r, sample) in REFINED.enumerate() {
            let stage = SAMPLED[sample];
            for (to, track) in self.stage.as_mut().iter_mut().zip(self.tracks.as_ref()) {
                *to = track.refined[r];
            }
            self.evaluate(system, self.time + NODES[stage] * h, stage);
        }
    }

    /// Takes the start of the step over into the tracks.
    #[inline]
    fn set_out(&mut self) {
        let (positions, velocities) = self.begin.as_ref().split_at(self.positions());
        for (track, v) in self.tracks.as_mut().iter_mut().zip(velocities) {
            track.v = *v;
        }
        for (track, x) in self.tracks.as_mut().iter_mut().zip(positions) {
            track.x = *x;
        }
    }

    fn forget_step(&mut self) {
        self.last_known = false;
        self.dense_known = false;
    }

    fn restart_slopes<S: Conservative + ?Sized>(&mut self, system: &S) {
        self.forget_step();
        self.set_out();
        let n = self.positions();
        self.stage.as_mut().copy_from_slice(&self.begin.as_ref()[..n]);
        self.evaluate(system, self.time, 0);
        self.constant = system.coasts();
        self.first_known = true;
    }

    fn end_slopes<S: Conservative + ?Sized>(&mut self, system: &S) {
        if !self.last_known {
            let n = self.positions();
            self.stage.as_mut().copy_from_slice(&self.end.as_ref()[..n]);
            self.evaluate(system, self.end_time, END);
            self.last_known = true;
        }
    }

    fn interpolate<S: Conservative + ?Sized>(&mut self, system: &S) {
        if self.dense_known {
            return;
        }
        if !self.constant {
            self.refine(system);
        }
        self.tracks.as_mut().iter_mut().for_each(Track::interpolate);
        self.dense_known = true;
    }
}

impl<L: Lanes> Method for Nystrom<L> {
    /// Swings grow from 3.3 on; they fade fastest here.
    fn reach(&self) -> f64 {
        3.0
    }

    /// Never: the error of a parabola is its rounding, and its evaluations are spared all the same.
    fn coasts(&self) -> bool {
        false
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

impl<L: Lanes> Step for Nystrom<L> {
    fn span(&self) -> Span<'_> {
        Span { time: self.time, end_time: self.end_time, begin: self.begin.as_ref(), end: self.end.as_ref() }
    }

    fn slope(&self, i: usize, at: End) -> f64 {
        let stage = match at {
            End::Start => 0,
            End::End => END,
        };
        self.tracks.as_ref()[i - self.positions()].k[stage]
    }

    fn value(&self, i: usize, t: f64) -> f64 {
        self.at(i, (t - self.time) / self.step)
    }

    fn cut(&mut self, t: f64) {
        let share = (t - self.time) / self.step;
        for i in 0..self.end.as_ref().len() {
            self.end.as_mut()[i] = self.at(i, share);
        }
        self.end_time = t;
        self.last_known = false;
    }

    fn accept(&mut self) {
        std::mem::swap(&mut self.begin, &mut self.end);
        self.time = self.end_time;
        self.set_out();
        let known = self.last_known;
        if known {
            self.tracks.as_mut().iter_mut().for_each(|track| track.k[0] = track.k[END]);
        }
        self.forget_step();
        self.first_known = known;
    }
}

impl<S: Conservative + ?Sized, L: Lanes> Attempt<S> for Nystrom<L> {
    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        self.time = t;
        let begin = self.begin.as_mut();
        begin.copy_from_slice(&y[..begin.len()]);
        self.restart_slopes(system);
    }

    fn first_step(&mut self, _: &S, longest: f64, scale: &[f64]) -> f64 {
        // A step in which what acts at its start moves a body by its natural scale, or a hundredth of the longest.
        let n = self.positions();
        let bend = self.tracks.as_ref()[..n]
            .iter()
            .zip(&scale[n..])
            .map(|(track, scale)| track.k[0].abs() / scale)
            .fold(0.0, f64::max);
        let step = if bend > 0.0 {
            (1.0 / bend).powf(1.0 / f64::from(ORDER)) * longest.powf(1.0 - 1.0 / f64::from(ORDER))
        } else {
            longest
        };
        (0.01 * step).min(longest)
    }

    /// Stages lie evenly, whatever grade is asked for.
    fn attempt(&mut self, system: &S, Target { end, .. }: Target, scale: &[f64]) -> f64 {
        if !self.first_known {
            self.restart_slopes(system);
        }
        self.forget_step();
        let (t, h) = (self.time, end - self.time);
        (self.step, self.end_time) = (h, end);
        if self.constant {
            self.advance_constant();
        } else {
            self.advance::<1, S>(system, t + NODES[1] * h);
            self.advance::<2, S>(system, t + NODES[2] * h);
            self.advance::<3, S>(system, t + NODES[3] * h);
            self.advance::<4, S>(system, t + NODES[4] * h);
            self.advance::<5, S>(system, t + NODES[5] * h);
            self.advance::<6, S>(system, t + NODES[6] * h);
            self.advance::<7, S>(system, end);
            self.advance::<8, S>(system, end);
        }
        self.conclude();
        self.last_known = true;
        self.error(scale)
    }

    /// The slopes at the end are known already, but for a step that was cut; the dense output costs the samples inside.
    fn complete(&mut self, system: &S, what: Completion) {
        match what {
            Completion::EndSlopes => self.end_slopes(system),
            Completion::Dense => self.interpolate(system),
        }
    }
}
