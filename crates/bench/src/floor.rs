//! Minimal code that simulates the benchmark drive P1 only, from event to event. The code shows how fast a simulation of this drive can
//! be.
//!
//! A slider of mass m stands on a foot that follows a sawtooth, with one Hertzian contact under constant load. The units are u_c, μF_N
//! and √(m u_c/μF_N). The displacement u = foot - slider satisfies ü = -φ(u) while the velocity of the foot is constant. The force φ
//! follows Mindlin's curve and Masing's rules.
//!
//! On a branch φ = φᵣ + sσ(1 - z^{3/2}) with z = 1 - σ(u - uᵣ)/s. The energy integral gives ν² = u̇² = A + Bz - Dz^{5/2} with B = 2s(s +
//! σφᵣ) and D = 4s²/5; a quadrature gives the time. With the roots z₁ < z₂ of ν², the substitution z = z₂ - (z₂-z₁) sin²(θ/2) gives dt =
//! s dθ/√(2K) with K = ν²/[2(z-z₁)(z₂-z)]. This integrand is smooth and has no cancellation. The variable t = tan(θ/4) avoids the sine.
//!
//! The code has no friction work, rows or error estimate; the number of nodes is given.
//!
//! Source: Mindlin, Deresiewicz, J. Appl. Mech. 20 (1953) 327; Landau, Lifshitz, *Mechanics*, 3rd ed., section 11.
//!
//! Reading order: `arc` (motion on one branch), `rule` (quadrature), `beside` (comparison with the program).

mod arc;
mod beside;
mod rule;

pub(crate) use beside::Ground;
pub use rule::Rule;

use crate::masing::Masing;
use arc::Arc;

/// Exponent p of a paraboloid.
const PARABOLOID: f64 = 1.5;

/// Drive with the parameters of `scenarios/p1.json`, or similar parameters.
#[derive(Debug, Clone, Copy)]
pub struct Floor {
    /// Mass of the slider, kg.
    pub mass: f64,
    /// Friction limit μF_N, N.
    pub limit: f64,
    /// Gross slip displacement u_c, m.
    pub length: f64,
    /// Stroke of the foot, m.
    pub stroke: f64,
    /// Period, s.
    pub period: f64,
    /// Duration of the flyback, s.
    pub flyback: f64,
}

impl Floor {
    /// Returns the drive P1: steel on steel, R = 1 mm, μ = 0.15, F_N = 1 N, mass 20 g. The stroke is 0.5 µm, the period 1 ms, the flyback
    /// 0.1 ms.
    ///
    /// d = (3F_N/(4E\*√R))^{2/3} (Hertz), u_c = μ(E\*/G\*)d (Cattaneo, Mindlin). For equal bodies E\* = E/(2(1-ν²)) and G\* =
    /// E/((1+ν)(2-ν)).
    pub fn p1() -> Self {
        let (young, poisson, radius, friction, normal) = (210e9, 0.3_f64, 1e-3_f64, 0.15, 1.0);
        let pressing = young / (2.0 * (1.0 - poisson * poisson));
        let sliding = young / ((1.0 + poisson) * (2.0 - poisson));
        let depth = math::powf(0.75 * normal / (pressing * radius.sqrt()), 2.0 / 3.0);
        let length = friction * pressing / sliding * depth;
        Self { mass: 0.02, limit: friction * normal, length, stroke: 0.5e-6, period: 1e-3, flyback: 1e-4 }
    }

    /// Returns the position of the slider after a number of periods, m.
    pub fn place<const N: usize>(&self, periods: u32, rule: &Rule<N>) -> f64 {
        // At the end of a period the foot is at 0.
        -self.slide(periods, rule, &[], |_| ()).memory.at * self.length
    }

    /// Simulates a number of periods. Calls `tell` with the position of the slider, m, at each of the ascending times, s.
    fn slide<const N: usize>(
        &self,
        periods: u32,
        rule: &Rule<N>,
        mut moments: &[f64],
        mut tell: impl FnMut(f64),
    ) -> Slide {
        let time = (self.mass * self.length / self.limit).sqrt();
        let stroke = self.stroke / self.length;
        let pieces = [self.period - self.flyback, self.flyback].map(|duration| duration / time);
        let rates = [stroke / pieces[0], -stroke / pieces[1]];
        let mut slide = Slide { rate: 0.0, memory: Masing::new(PARABOLOID), arcs: 0 };
        let (mut before, mut begun) = (0.0, 0.0);
        for _ in 0..periods {
            for (rate, duration, from) in [(rates[0], pieces[0], 0.0), (rates[1], pieces[1], stroke)] {
                slide.turn_corner(rate - before);
                before = rate;
                let mut passed = 0.0;
                while let [moment, rest @ ..] = moments
                    && moment / time <= begun + duration
                {
                    let until = moment / time - begun;
                    slide.pass(until - passed, rule);
                    tell((from + rate * until - slide.memory.at) * self.length);
                    (passed, moments) = (until, rest);
                }
                slide.pass(duration - passed, rule);
                begun += duration;
            }
        }
        slide
    }
}

/// State of the motion: velocity and contact memory.
struct Slide {
    /// Velocity u̇.
    rate: f64,
    memory: Masing,
    /// Number of branches passed so far.
    arcs: u64,
}

impl Slide {
    /// Changes the velocity of the foot by a jump.
    fn turn_corner(&mut self, jump: f64) {
        self.rate += jump;
        if self.rate * self.memory.sense < 0.0 {
            self.memory.turn();
        }
    }

    /// Advances by a time with constant velocity of the foot.
    fn pass<const N: usize>(&mut self, duration: f64, rule: &Rule<N>) {
        let mut left = duration;
        loop {
            let sense = self.memory.sense;
            if self.memory.gross {
                let speed = self.rate.abs();
                let time = speed.min(left);
                self.memory.at += sense * time * (speed - 0.5 * time);
                self.rate -= sense * time;
                if speed >= left {
                    return;
                }
                left -= time;
                self.rate = 0.0;
                self.memory.turn();
                continue;
            }
            self.arcs += 1;
            let branch = self.memory.branch();
            let arc = Arc::new(&branch, self.memory.at, self.rate.abs());
            let (from, end) = arc.span(branch.end);
            let to = end.unwrap_or(1.0);
            let time = arc.time((from, to), rule);
            if time >= left {
                let at = arc.at((left, time), (from, to), rule);
                self.memory.at += sense * arc.way(at);
                self.rate = sense * arc.speed(at);
                return;
            }
            left -= time;
            self.memory.at += sense * arc.way(to);
            if let Some(end) = end {
                self.rate = sense * arc.speed(end);
                self.memory.close();
            } else {
                self.rate = 0.0;
                self.memory.turn();
            }
        }
    }
}
