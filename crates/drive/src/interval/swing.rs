//! Closed-form oscillation of a single slider between two events, by one smooth numerical quadrature.
//!
//! All contacts have closed-form forces and slip over the same linear prescribed motion. The relative displacement q satisfies q̈ = b(q),
//! where b decreases as slip spreads. The first integral q̇² = ν² = ν₀² + 2∫b dq is concave in q. Its zeros q₁ < q₂ are the turning points
//! of an oscillation, of which the interval is an arc. The oscillation is written as
//!
//! q = (q₁+q₂)/2 - (q₂-q₁)/2 cos θ,   ν² = 2 (q-q₁)(q₂-q) K,   K = (b̄[q₁,q] - b̄[q,q₂])/(q₂-q₁),
//!
//! where b̄ is the mean of b over a range. The time is T = ∫dθ/√(2K). K is ω²/2 for a spring and varies slowly for a contact, so few
//! Gauss–Legendre nodes reach rounding accuracy. If a segment of slip memory ends long before the turning point, T = ∫dq/ν is as smooth and
//! needs no turning points.
//!
//! Closed forms exist for cones, paraboloids, powers r³ and r⁴, and the exact sphere: b = b₀ + Σ αM(h), h = h₀ - λq. Means of the reduced
//! force M are computed from roots of heights, without cancellation for small amplitudes.
//!
//! Source: Landau, Lifshitz, *Mechanics*, 3rd ed., section 11 (motion in one dimension). The mean of the force, in place of a difference of
//! the potential, is the discrete gradient of Gonzalez, J. Nonlinear Sci. 6 (1996) 449.

mod course;
mod slip;
mod sway;
mod time;
mod turning;

use super::Interval;
use crate::Model;
use crate::contact::Press;
use crate::model::Free;
use slip::PartialSlip;
use std::f64::consts::PI;
use stickslip_contact::{NEARNESS, RootSeries};
use sway::Sway;
use turning::{EXACT, ROUGH, softer};

/// Ratio of final to initial height of a slip front below which the branch point of M at the contact centre affects the quadrature.
const BRANCH: f64 = 0.1;
/// Fraction of the distance to the nearer turning point up to which the displacement q is the integration variable.
const FAR: f64 = 0.25;
/// Smallest amplitude, relative to the natural length. Smaller motions may be rounding and are integrated numerically.
const SMALLEST: f64 = 1e-9;

/// Closed-form motion of a single slider until its next event. Scratch memory, recomputed after each event.
#[derive(Debug, Clone, Default)]
pub(crate) struct Swing<'a> {
    /// Direction of slip along the coordinate, ±1.
    sense: f64,
    /// Prescribed velocity along the coordinate, m/s; the velocity of slip is q̇ = ±(ẋ + drift).
    drift: f64,
    /// Sinusoidal prescribed motion that replaces `drift` in gross slip.
    sway: Option<Sway<'a>>,
    /// Initial time, position and velocity.
    start: PhasePoint,
    mobility: f64,
    /// Constant force on the slider, N.
    load: f64,
    /// Constant part b₀ of the acceleration along the slip direction, m/s².
    push: f64,
    /// Closed form of each contact's normal-energy function, if it exists.
    laws: Vec<Option<RootSeries>>,
    slips: Vec<PartialSlip>,
    /// Displacement until the first segment of slip memory ends, m; ∞ if no segment ends.
    reach: f64,
    /// Turning points q₁ and q₂ before and after the motion, m.
    low: f64,
    high: f64,
    /// Integration variable of the quadrature for time, and its values at the start and at the end.
    clock: Clock,
    from: f64,
    to: f64,
    /// Time until the next event, s; ∞ if there is none.
    pub(crate) duration: f64,
    /// Whether the next event is a turning point; otherwise a segment of slip memory ends.
    pub(crate) turns: bool,
    /// Whether a slip front ends near the centre of a contact.
    nears: bool,
    /// Tolerance of positions, in natural lengths.
    tolerance: f64,
    /// Relative size of the last Halley step to a turning point.
    last: f64,
    /// Relative size of the last Newton step to a time, as a fraction of the whole integration range.
    near: f64,
    /// Distance beyond the end of a memory segment at which a turning point counts as this end, relative to the width of the arc.
    grazing: f64,
    /// Relative tolerance of computed times.
    allowed: f64,
    pub(crate) evaluations: u64,
}

/// Integration variable of the quadrature for time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
enum Clock {
    /// Angle θ between two turning points.
    #[default]
    Angle,
    /// Displacement q, if both turning points are far.
    Way,
}

/// Time (s), position (m) and velocity (m/s).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct PhasePoint {
    pub(crate) t: f64,
    pub(crate) x: f64,
    pub(crate) v: f64,
}

impl<'a> Swing<'a> {
    /// Returns an empty motion for a model. The `tolerance` of positions is relative to the natural length.
    pub(crate) fn of(model: &Model, tolerance: f64) -> Self {
        Self::default().renewed(model, tolerance)
    }

    /// Reuses the allocated memory for another model.
    pub(crate) fn renewed(self, model: &Model, tolerance: f64) -> Self {
        let Self { mut laws, mut slips, .. } = self;
        let last = (0.1 * math::cbrt(tolerance)).clamp(EXACT, ROUGH);
        let near = (0.1 * tolerance.sqrt()).clamp(1e-7, 1e-2);
        let grazing = (NEARNESS * tolerance).sqrt();
        laws.clear();
        laws.extend(model.contacts.iter().map(|contact| match contact.press {
            Press::Constant { d, .. } => contact.interface.profile().root_series(d),
            _ => None,
        }));
        slips.clear();
        slips.reserve(model.contacts.len());
        Self { tolerance, last, near, grazing, laws, slips, ..Self::default() }
    }

    /// Returns the allocated memory of the motion, empty.
    pub(crate) fn emptied(self) -> Swing<'static> {
        Swing { laws: self.laws, slips: self.slips, ..Swing::default() }
    }

    /// Sets up the motion for an interval and an initial state. Returns false if the motion has no such closed form.
    pub(crate) fn begin(&mut self, interval: &Interval<'a>, slider: &Free, start: PhasePoint) -> bool {
        let Some(first) = interval.closed.first() else { return false };
        // The slider does not move this contact.
        if first.arm == 0.0 {
            return false;
        }
        self.sense = (first.sense() * first.arm).signum();
        self.start = start;
        (self.mobility, self.load) = (slider.mobility, slider.force);
        self.sway = None;
        let Some(pull) = &interval.slider else { return self.begin_swayed(interval) };
        let Some(rate) = first.constant_rate() else { return false };
        self.drift = rate / first.arm;
        self.push = self.sense * pull.acceleration;
        self.reach = f64::INFINITY;
        for steady in &interval.closed {
            if steady.sense() * steady.arm * self.sense <= 0.0
                || steady.constant_rate() != Some(self.drift * steady.arm)
            {
                return false;
            }
            // The segment of slip memory that ends first, of any contact, determines the interval.
            self.reach = self.reach.min(steady.reach(start.t, start.x));
        }
        self.slips.clear();
        for pull in &interval.pulls {
            let Some(law) = self.laws[pull.index] else { return false };
            let height = pull.height(start.t, start.x);
            let (gain, lean) = (self.sense * pull.acceleration, -self.sense * pull.lean);
            // Spreading slip must reduce the acceleration.
            if !(gain > 0.0 && lean > 0.0 && height > 0.0) {
                return false;
            }
            self.slips.push(PartialSlip::new(law, gain, lean, height));
        }
        true
    }

    /// Returns the initial time, position and velocity of the slider.
    pub(crate) fn start(&self) -> PhasePoint {
        self.start
    }

    /// Returns whether all contacts are in gross slip, so that the motion is a parabola.
    pub(crate) fn is_free(&self) -> bool {
        self.slips.is_empty()
    }

    /// Returns whether a velocity of the coordinate (m/s) is opposite to the slip. The slider's velocity may change its sign within an arc.
    pub(crate) fn leads_back(&self, velocity: f64) -> bool {
        self.sense * velocity < 0.0
    }

    /// Returns the initial velocity of slip, m/s.
    fn speed(&self) -> f64 {
        self.sense * (self.start.v + self.drift_at(self.start.t))
    }

    /// Returns the prescribed velocity along the coordinate at time t, m/s.
    #[inline(always)]
    fn drift_at(&self, t: f64) -> f64 {
        match &self.sway {
            None => self.drift,
            Some(sway) => sway.at(t).rate,
        }
    }

    /// Computes the event that ends the motion. Returns false if there is no such event in closed form. `length` is the natural length, m.
    pub(crate) fn aim(&mut self, length: f64) -> bool {
        self.evaluations = 0;
        let speed = self.speed();
        // If slip has reversed or the segment of memory is used up, the motion is integrated numerically.
        if speed.is_nan() || speed < 0.0 || self.reach <= 0.0 {
            return false;
        }
        if self.slips.is_empty() {
            return self.aim_free(speed, length);
        }
        let [pull, bend, softening] = self.force_at_start();
        // From rest without acceleration, or without a restoring force, there is no arc.
        if speed == 0.0 && pull <= 0.0 || bend >= 0.0 {
            return false;
        }
        // Velocity scale of a spring with the initial stiffness.
        let swing = (pull * pull - bend * speed * speed).sqrt();
        // Roots of a parabola; the nearer one as a quotient, without cancellation.
        let (short, long) = (speed * speed / (swing + pull.abs()), (swing + pull.abs()) / -bend);
        let (before, after) = if pull > 0.0 { (-short, long) } else { (-long, short) };
        // Far from both turning points 1/ν is smooth.
        if self.reach < FAR * short && !self.nears_centre(self.reach) {
            self.pass();
        } else {
            let guesses = [softer(before, swing, bend, softening), softer(after, -swing, bend, softening)];
            if !self.swing_between(speed, guesses, length) {
                return false;
            }
        }
        self.set_out(bend, self.tolerance * length)
    }

    /// Sets a motion far from turning points that ends where a segment of slip memory ends.
    fn pass(&mut self) {
        (self.clock, self.turns, self.nears) = (Clock::Way, false, false);
        (self.from, self.to) = (0.0, self.reach);
    }

    /// Sets a motion between two turning points near two guesses. Returns false if there are no such turning points.
    ///
    /// The final angle is π at a turning point, and smaller where a segment of slip memory ends.
    fn swing_between(&mut self, speed: f64, guesses: [f64; 2], length: f64) -> bool {
        let Some([low, high]) = self.turning(speed, guesses) else { return false };
        // Smaller motions may be rounding.
        if !(high > 0.0 && low <= 0.0 && high - low > SMALLEST * length) {
            return false;
        }
        (self.low, self.high) = (low, high);
        self.slips.iter_mut().for_each(|slip| slip.swing_between(low, high));
        // As a function of the angle the integrand is smooth at both ends, where 1/ν diverges. A loop that closes almost at the turning
        // point, as in periodic motions, ends there: the laws differ by the square of the distance, and the time to its end is inaccurate.
        (self.clock, self.turns) = (Clock::Angle, high <= self.reach + self.grazing * (high - low));
        // From rest the angle is exactly 0.
        self.from = if low < 0.0 { self.angle(0.0) } else { 0.0 };
        self.to = if self.turns { PI } else { self.angle(self.reach) };
        self.nears = self.nears_centre(self.reach.min(high));
        true
    }

    /// Returns whether a slip front comes near the contact centre up to displacement q.
    fn nears_centre(&self, q: f64) -> bool {
        let nears = |slip: &PartialSlip| slip.height - slip.lean * q < BRANCH * slip.height;
        self.slips.iter().any(|slip| !slip.ends_smoothly() && nears(slip))
    }

    /// Computes the time of the next event.
    fn set_out(&mut self, bend: f64, allowed: f64) -> bool {
        let span = self.to - self.from;
        // Displacement caused by a relative error of time.
        let (way, time) = match self.clock {
            Clock::Angle => (0.5 * span * (self.high - self.low), span / (-bend).sqrt()),
            Clock::Way => (span, span / self.speed()),
        };
        // Includes the displacement of fast prescribed motions.
        self.allowed = allowed / way.max(self.drift.abs() * time);
        let (duration, is_good) = self.time_between(self.from, self.to, self.allowed, 1.0);
        self.duration = duration;
        is_good && duration > 0.0
    }

    /// Computes the next event in gross slip, where the motion is a parabola.
    fn aim_free(&mut self, speed: f64, length: f64) -> bool {
        if let Some(sway) = self.sway {
            return self.aim_swayed(&sway, length);
        }
        self.turns = self.push < 0.0;
        let way = 0.5 * speed * speed / -self.push;
        self.duration = if self.turns { speed / -self.push } else { f64::INFINITY };
        // From rest the stepper decides what follows.
        speed > 0.0 && (way > SMALLEST * length || !self.turns)
    }

    /// Returns the acceleration b at the start and its first two derivatives with respect to q; m/s², 1/s², 1/(m s²).
    fn force_at_start(&self) -> [f64; 3] {
        let mut sum = [self.push, 0.0, 0.0];
        for slip in &self.slips {
            let start = slip.start();
            (0..3).for_each(|k| sum[k] += start[k]);
        }
        sum
    }

    /// Returns the mean of the acceleration b from the start to q, b at q (m/s²) and its derivative there (1/s²).
    #[inline(always)]
    fn force<const N: usize>(&self, q: [f64; N]) -> [[f64; N]; 3] {
        let mut sum = [[self.push; N], [self.push; N], [0.0; N]];
        for slip in &self.slips {
            let pull = slip.pull(q);
            (0..3).for_each(|k| (0..N).for_each(|i| sum[k][i] += pull[k][i]));
        }
        sum
    }

    /// Returns the factor K of ν² at q, 1/s².
    #[inline(always)]
    fn stiffness<const N: usize>(&self, q: [f64; N]) -> [f64; N] {
        let mut sum = [0.0; N];
        for slip in &self.slips {
            let stiffness = slip.stiffness(q);
            (0..N).for_each(|i| sum[i] += stiffness[i]);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Motion with an initial velocity against one contact with N = h^{2+1/n} and unit constants, whose memory segment ends in the centre.
    fn swing(root: u32, push: f64, speed: f64) -> Swing<'static> {
        let law = RootSeries { root, factor: 1.0, curvature: 0.0, terms: &[1.0] };
        Swing {
            sense: 1.0,
            start: PhasePoint { t: 0.0, x: 0.0, v: speed },
            mobility: 1.0,
            push,
            slips: vec![PartialSlip::new(law, 1.0, 1.0, 1.0)],
            reach: 1.0,
            tolerance: 1e-12,
            last: EXACT,
            near: 1e-7,
            ..Swing::default()
        }
    }

    /// Every start has a solution, whose time agrees to 1e-5 with a midpoint rule of dq/ν over the root of the remaining displacement.
    #[test]
    fn every_start_has_its_swing() {
        for (root, push, k) in all() {
            let speed = 0.05 * f64::from(k);
            let mut swing = swing(root, push, speed);
            assert!(swing.aim(1.0), "{root} {push} {speed}");
            let end = if swing.turns { swing.high } else { swing.reach };
            let power = 2.0 + f64::from(root).recip();
            let slowness = |q: f64| {
                let work = push * q + (1.0 - (1.0 - q).powf(power));
                (speed * speed + 2.0 * work).sqrt().recip()
            };
            let strips = 20_000;
            let middle = |k: i32| (f64::from(k) + 0.5) / f64::from(strips);
            let part = |s: f64| 2.0 * s * end * slowness(end * (1.0 - s * s));
            let time = (0..strips).map(|k| part(middle(k))).sum::<f64>() / f64::from(strips);
            let off = (swing.duration / time - 1.0).abs();
            assert!(off < 1e-5, "{root} {push} {speed}: off by {off:e}");
        }
    }

    fn all() -> impl Iterator<Item = (u32, f64, i32)> {
        let pushes = |root| [-2.5, -1.0, -0.5, -0.1].map(|push| (root, push));
        (1..=4).flat_map(pushes).flat_map(|(root, push)| (1..=240).map(move |k| (root, push, k)))
    }
}
