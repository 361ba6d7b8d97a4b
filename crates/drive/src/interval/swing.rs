//! The swing of a single slider between two events, in closed form but for one smooth quadrature.
//!
//! Where nothing but contacts of closed form acts on a single slider and all of them slide over the same straight follower, the
//! displacement q between the two counts alone: q̈ = b(q), falling as slip spreads. Its first integral is known,
//! q̇² = ν² = ν₀² + 2∫b dq, concave in q, with one zero before and one after the motion: the turning points q₁ < q₂ of an
//! oscillation of which the interval is an arc. With
//!
//! q = (q₁+q₂)/2 - (q₂-q₁)/2 cos θ,   ν² = 2 (q-q₁)(q₂-q) K,   K = (b̄[q₁,q] - b̄[q,q₂])/(q₂-q₁),
//!
//! b̄ the mean of b over a range, time is T = ∫dθ/√(2K): K is ω²/2 for a spring and changes slowly for a contact, so that a
//! few nodes of Gauss and Legendre give all digits, whatever the number of periods in a second. Where a piece of memory ends
//! long before the motion would turn, T = ∫dq/ν is as smooth, and no turning point is sought.
//!
//! Closed forms are there for cones, paraboloids, powers r³ and r⁴, and the exact sphere: b = b₀ + Σ αM(h), h = h₀ - λq. Means
//! of M are taken over roots of heights, so that no swing is too small for its digits.
//!
//! Source: Landau, Lifshitz, *Mechanics*, 3rd ed., section 11 (motion in one dimension); the mean of the force in place of
//! the difference of the potential is the discrete gradient of Gonzalez, J. Nonlinear Sci. 6 (1996) 449.

mod course;
mod slip;
mod sway;
mod time;
mod turning;

use super::Interval;
use crate::Model;
use crate::contact::{NEARNESS, Press};
use crate::model::Free;
use slip::PartialSlip;
use std::f64::consts::PI;
use stickslip_contact::RootSeries;
use sway::Sway;
use turning::{EXACT, ROUGH, softer};

/// Part of its height at the start below which a slip front comes so near to the centre that its branch point is felt.
// At 1 all time would be integrated in the root of the way left: 60 % more evaluations on P1 at 1e-6, for a tenth of an error
// that is a thousandth of the tolerance. At 0.01 nothing changes but last places.
const BRANCH: f64 = 0.1;
/// Part of the way to the nearer turning point up to which motion is a passage: its time is as smooth as can be.
// A tenth costs P1 8 % more evaluations at 1e-6 and the same error; ten times as much changes no run.
const FAR: f64 = 0.25;
/// Swings smaller than this share of the natural length are left to the stepper: it knows rest from rounding.
const SMALLEST: f64 = 1e-9;

/// Motion of the slider until its next event. Scratch: made anew after each event.
#[derive(Debug, Clone, Default)]
pub(crate) struct Swing<'a> {
    /// Direction of the slide along the coordinate, ±1.
    sense: f64,
    /// Speed of the followers along the coordinate, m/s: q̇ = ±(ẋ + drift).
    drift: f64,
    /// What takes its place where they follow sines: in gross slip.
    sway: Option<Sway<'a>>,
    /// Where and when it begins.
    start: PhasePoint,
    mobility: f64,
    /// Constant force on the slider, N.
    load: f64,
    /// b₀ along the slide, m/s².
    push: f64,
    /// By contact: the closed form of its energy, if it has one.
    laws: Vec<Option<RootSeries>>,
    slips: Vec<PartialSlip>,
    /// Where the first piece of memory ends, m; ∞ if none does.
    reach: f64,
    /// Turning points before and after, m, of an arc between them.
    low: f64,
    high: f64,
    /// What time is an integral over, and its values at the start and at the end.
    clock: Clock,
    from: f64,
    to: f64,
    /// Duration until the event, s; ∞ if there is none.
    pub(crate) duration: f64,
    /// Whether the slide turns at the end; otherwise a piece of memory ends.
    pub(crate) turns: bool,
    /// Whether the slide ends near the centre of a contact.
    nears: bool,
    /// Error allowed of places, in natural lengths.
    tolerance: f64,
    /// Last step to a turning point that leaves no more, relative to its distance.
    last: f64,
    /// Last step to a moment, as a part of the whole way, that leaves no more.
    near: f64,
    /// How far beyond the end of a piece an arc may turn and count as turning there, in parts of its width.
    grazing: f64,
    /// Relative error allowed of times.
    allowed: f64,
    pub(crate) evaluations: u64,
}

/// What time is an integral over.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
enum Clock {
    /// The angle θ between two turning points.
    #[default]
    Angle,
    /// The way q itself, where both are far.
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
    /// Room for the contacts of a model; places in parts of its natural length to a `tolerance`.
    pub(crate) fn of(model: &Model, tolerance: f64) -> Self {
        Self::default().renewed(model, tolerance)
    }

    /// The same in the room there is.
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

    /// The room that it takes: it knows no interval.
    pub(crate) fn emptied(self) -> Swing<'static> {
        Swing { laws: self.laws, slips: self.slips, ..Swing::default() }
    }

    /// Takes up what an interval has become; false where it has no such form.
    pub(crate) fn begin(&mut self, interval: &Interval<'a>, slider: &Free, start: PhasePoint) -> bool {
        let Some(first) = interval.closed.first() else { return false };
        // The slider does not move this contact: the followers alone end its pieces.
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
            // The first piece to end, of any contact, ends the interval.
            self.reach = self.reach.min(steady.reach(start.t, start.x));
        }
        self.slips.clear();
        for pull in &interval.pulls {
            let Some(law) = self.laws[pull.index] else { return false };
            let height = pull.height(start.t, start.x);
            let (gain, lean) = (self.sense * pull.acceleration, -self.sense * pull.lean);
            // Slip that spreads must hold back.
            if !(gain > 0.0 && lean > 0.0 && height > 0.0) {
                return false;
            }
            self.slips.push(PartialSlip::new(law, gain, lean, height));
        }
        true
    }

    /// Where it began.
    pub(crate) fn start(&self) -> PhasePoint {
        self.start
    }

    /// Whether no contact holds back: gross slip, a parabola.
    pub(crate) fn is_free(&self) -> bool {
        self.slips.is_empty()
    }

    /// Whether a velocity of the coordinate, m/s, is of the sign against which the slide goes: in the middle of an arc, where the
    /// slide is fastest, it may be another.
    pub(crate) fn leads_back(&self, velocity: f64) -> bool {
        self.sense * velocity < 0.0
    }

    /// Speed of the slide at the start, m/s.
    fn speed(&self) -> f64 {
        self.sense * (self.start.v + self.drift_at(self.start.t))
    }

    /// Speed of the followers along the coordinate at time t, m/s.
    #[inline(always)]
    fn drift_at(&self, t: f64) -> f64 {
        match &self.sway {
            None => self.drift,
            Some(sway) => sway.at(t).rate,
        }
    }

    /// Finds the event that ends the motion; false where that fails. `length` is the natural one, m.
    pub(crate) fn aim(&mut self, length: f64) -> bool {
        self.evaluations = 0;
        let speed = self.speed();
        // Where the slide has turned, or its piece is used up, no arc begins: the stepper takes over.
        if speed.is_nan() || speed < 0.0 || self.reach <= 0.0 {
            return false;
        }
        if self.slips.is_empty() {
            return self.aim_free(speed, length);
        }
        let [pull, bend, softening] = self.force_at_start();
        // At rest and not pushed on, or not held back by what it drags: no arc begins here.
        if speed == 0.0 && pull <= 0.0 || bend >= 0.0 {
            return false;
        }
        // Where a spring of the stiffness at the start would turn.
        let swing = (pull * pull - bend * speed * speed).sqrt();
        // The two roots of a parabola, the nearer one by a quotient: as a difference it would lose its digits
        // for slow starts.
        let (short, long) = (speed * speed / (swing + pull.abs()), (swing + pull.abs()) / -bend);
        let (before, after) = if pull > 0.0 { (-short, long) } else { (-long, short) };
        // Far from both turning points 1/ν is smooth itself, and the search for them is spared.
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

    /// The motion passes on to the end of a piece and is far from turning.
    fn pass(&mut self) {
        (self.clock, self.turns, self.nears) = (Clock::Way, false, false);
        (self.from, self.to) = (0.0, self.reach);
    }

    /// The motion is an arc between two turning points near two guesses; false where it is none.
    ///
    /// Takes up both, and the angles at which the motion begins and ends: at π where it turns, before it
    /// where a piece ends.
    fn swing_between(&mut self, speed: f64, guesses: [f64; 2], length: f64) -> bool {
        let Some([low, high]) = self.turning(speed, guesses) else { return false };
        // Smaller swings may be rounding: the stepper knows rest from it.
        if !(high > 0.0 && low <= 0.0 && high - low > SMALLEST * length) {
            return false;
        }
        (self.low, self.high) = (low, high);
        self.slips.iter_mut().for_each(|slip| slip.swing_between(low, high));
        // In the angle both ends of the arc are smooth, where 1/ν is infinite.
        // Where a loop closes as good as where it turns, as every turn of a motion does that repeats itself, it turns: the laws of
        // both pieces differ there by the square of what is left, and the moment at which so short a way is over by its root.
        (self.clock, self.turns) = (Clock::Angle, high <= self.reach + self.grazing * (high - low));
        // From rest it begins at the turning point itself, at the angle 0 to the last bit.
        self.from = if low < 0.0 { self.angle(0.0) } else { 0.0 };
        self.to = if self.turns { PI } else { self.angle(self.reach) };
        self.nears = self.nears_centre(self.reach.min(high));
        true
    }

    /// Whether a slip front comes near to the centre up to q.
    fn nears_centre(&self, q: f64) -> bool {
        let nears = |slip: &PartialSlip| slip.height - slip.lean * q < BRANCH * slip.height;
        self.slips.iter().any(|slip| !slip.ends_smoothly() && nears(slip))
    }

    /// Finds the time of the event.
    fn set_out(&mut self, bend: f64, allowed: f64) -> bool {
        let span = self.to - self.from;
        // What a relative error of time displaces.
        let (way, time) = match self.clock {
            Clock::Angle => (0.5 * span * (self.high - self.low), span / (-bend).sqrt()),
            Clock::Way => (span, span / self.speed()),
        };
        // Both: the slide's own way and what fast followers do in the time, of which a small error is a long
        // way.
        self.allowed = allowed / way.max(self.drift.abs() * time);
        let (duration, is_good) = self.time_between(self.from, self.to, self.allowed, 1.0);
        self.duration = duration;
        is_good && duration > 0.0
    }

    /// The same in gross slip: a parabola.
    fn aim_free(&mut self, speed: f64, length: f64) -> bool {
        if let Some(sway) = self.sway {
            return self.aim_swayed(&sway, length);
        }
        self.turns = self.push < 0.0;
        let way = 0.5 * speed * speed / -self.push;
        self.duration = if self.turns { speed / -self.push } else { f64::INFINITY };
        // At rest it is the stepper that knows what is next.
        speed > 0.0 && (way > SMALLEST * length || !self.turns)
    }

    /// b at the start and its first two derivatives; m/s², 1/s², 1/(m s²).
    fn force_at_start(&self) -> [f64; 3] {
        let mut sum = [self.push, 0.0, 0.0];
        for slip in &self.slips {
            let start = slip.start();
            (0..3).for_each(|k| sum[k] += start[k]);
        }
        sum
    }

    /// Mean of b from the start to q, b at q (m/s²) and its slope there (1/s²).
    #[inline(always)]
    fn force<const N: usize>(&self, q: [f64; N]) -> [[f64; N]; 3] {
        let mut sum = [[self.push; N], [self.push; N], [0.0; N]];
        for slip in &self.slips {
            let pull = slip.pull(q);
            (0..3).for_each(|k| (0..N).for_each(|i| sum[k][i] += pull[k][i]));
        }
        sum
    }

    /// K at q, 1/s².
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

    /// Sets out at a speed against one contact, N = h^{2+1/n} and all else 1, whose piece of memory ends in the centre.
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

    /// From creeping to far too fast to turn: no start is refused, and time is, to 1e-5, what 20 000 strips make of dq/ν,
    /// the way that is left counted by its root, which has neither of both ends' branch points.
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
