//! P1 and nothing else, from event to event: how little its motion could cost.
//!
//! A slider of mass m on a foot that follows a sawtooth, between them one Hertzian contact under a constant load. In units of u_c,
//! μF_N and √(m u_c/μF_N) the displacement u = foot - slider obeys ü = -φ(u) wherever the foot goes at a constant rate, with
//! Mindlin's φ = σ[1 - (1 - σu)^{3/2}] on first loading and, by Masing's rules, φ = φᵣ + 2σ[1 - z^{3/2}], z = 1 - σ(u - uᵣ)/2, after
//! a turn at (uᵣ, φᵣ). The energy gives u̇² = ν² = ν₀² - 2∫φ, a quadrature the time. Where ν² has two roots q₁ < q₂ in the way q,
//! q = q₁ + (q₂-q₁) sin²(θ/2) leaves dt = dθ/√(2K) with K = ν²/[2(q-q₁)(q₂-q)], smooth and without a difference.
//!
//! No friction, no work, no rows, no error estimate: the number of nodes is given.
//!
//! Source: Mindlin, Deresiewicz, J. Appl. Mech. 20 (1953) 327; Landau, Lifshitz, *Mechanics*, 3rd ed., section 11.

mod beside;
mod rule;

pub(crate) use beside::Beside;
pub use rule::Rule;
use std::f64::consts::PI;

/// Newton's steps at most, to a turning point or a place: four reach the last place.
const STEPS: usize = 20;

/// The drive: the numbers of `scenarios/p1.json`.
#[derive(Debug, Clone, Copy)]
pub struct Floor {
    /// Mass of the slider, kg.
    pub mass: f64,
    /// μF_N, N.
    pub limit: f64,
    /// u_c, m.
    pub length: f64,
    /// Stroke of the foot, m.
    pub stroke: f64,
    /// Period, s.
    pub period: f64,
    /// How long the foot takes back, s.
    pub flyback: f64,
}

/// Where the slide is, and what the contact remembers.
struct Slide {
    /// u and u̇.
    u: f64,
    rate: f64,
    /// Sense of the slide, ±1.
    sense: f64,
    /// Turns (u, φ) that are not passed yet; of first loading also the opposite one.
    turns: Vec<[f64; 2]>,
    /// Whether all springs slip, and whether they never have.
    gross: bool,
    virgin: bool,
}

/// A slide on one branch, q ≥ 0: b = push + gain h^{3/2} with h = z - lean q.
struct Arc {
    speed: f64,
    push: f64,
    gain: f64,
    lean: f64,
    height: f64,
    /// Where the branch ends.
    reach: f64,
    /// Turning points and the roots of their heights.
    low: f64,
    high: f64,
    roots: [f64; 2],
}

impl Floor {
    /// P1: steel on steel, R = 1 mm, μ = 0.15, F_N = 1 N; 20 g; 0.5 µm in 1 ms, 0.1 ms of it back.
    ///
    /// d = (3F_N/(4E\*√R))^{2/3} (Hertz), u_c = μ(E\*/G\*)d (Cattaneo, Mindlin), E\* = E/(2(1-ν²)), G\* = E/((1+ν)(2-ν)) of equal
    /// bodies.
    pub fn p1() -> Self {
        let (young, poisson, radius, friction, normal) = (210e9, 0.3_f64, 1e-3_f64, 0.15, 1.0);
        let pressing = young / (2.0 * (1.0 - poisson * poisson));
        let sliding = young / ((1.0 + poisson) * (2.0 - poisson));
        let depth = (0.75 * normal / (pressing * radius.sqrt())).powf(2.0 / 3.0);
        let length = friction * pressing / sliding * depth;
        Self { mass: 0.02, limit: friction * normal, length, stroke: 0.5e-6, period: 1e-3, flyback: 1e-4 }
    }

    /// Place of the slider after so many periods, m.
    pub fn place<const N: usize>(&self, periods: u32, rule: &Rule<N>) -> f64 {
        let time = (self.mass * self.length / self.limit).sqrt();
        let stroke = self.stroke / self.length;
        let pieces = [self.period - self.flyback, self.flyback].map(|duration| duration / time);
        let rates = [stroke / pieces[0], -stroke / pieces[1]];
        let mut slide = Slide {
            u: 0.0,
            rate: 0.0,
            sense: 1.0,
            turns: Vec::with_capacity(64),
            gross: false,
            virgin: true,
        };
        let mut before = 0.0;
        for _ in 0..periods {
            for (rate, duration) in rates.into_iter().zip(pieces) {
                slide.turn_corner(rate - before);
                before = rate;
                slide.pass(duration, rule);
            }
        }
        // The foot is back where it began.
        -slide.u * self.length
    }
}

impl Slide {
    /// The foot changes its rate.
    fn turn_corner(&mut self, jump: f64) {
        self.rate += jump;
        if self.rate * self.sense < 0.0 {
            self.turn();
        }
    }

    /// φ at u on the present branch.
    fn force(&self, u: f64) -> f64 {
        let (scale, from, force) = self.branch();
        let height = (1.0 - self.sense * (u - from) / scale).max(0.0);
        force + self.sense * scale * (1.0 - height * height.sqrt())
    }

    /// Scale, u and φ of where the present branch begins.
    fn branch(&self) -> (f64, f64, f64) {
        match self.turns.last() {
            Some([u, force]) => (2.0, *u, *force),
            None => (1.0, 0.0, 0.0),
        }
    }

    /// The sense of sliding turns round here.
    fn turn(&mut self) {
        if self.gross {
            self.turns.push([self.u, self.sense]);
        } else {
            let force = self.force(self.u);
            if self.turns.is_empty() {
                self.turns.push([-self.u, -force]);
            }
            self.turns.push([self.u, force]);
        }
        (self.gross, self.sense) = (false, -self.sense);
    }

    /// The present branch is used up: the one before it goes on, or all springs slip.
    fn close(&mut self) {
        let passed = self.turns.len();
        self.turns.truncate(passed.saturating_sub(2));
        // Beyond the outermost loop lies first loading, or the gross slip from which it turned back.
        self.gross = passed < 2 || passed == 2 && !self.virgin;
        self.virgin &= !self.gross;
    }

    /// A piece of the waveform.
    fn pass<const N: usize>(&mut self, duration: f64, rule: &Rule<N>) {
        let mut left = duration;
        loop {
            if self.gross {
                let speed = self.rate.abs();
                let time = speed.min(left);
                self.u += self.sense * time * (speed - 0.5 * time);
                self.rate -= self.sense * time;
                if speed >= left {
                    return;
                }
                left -= time;
                self.rate = 0.0;
                self.turn();
                continue;
            }
            let arc = self.arc();
            let turns = arc.high <= arc.reach;
            let [from, to] = [arc.angle(0.0), if turns { PI } else { arc.angle(arc.reach) }];
            let time = arc.time(from, to, rule);
            if time >= left {
                let way = arc.at(left, [from, to], time, rule);
                self.u += self.sense * way;
                self.rate = self.sense * arc.rate(way);
                return;
            }
            left -= time;
            if turns {
                self.u += self.sense * arc.high;
                self.rate = 0.0;
                self.turn();
            } else {
                self.u += self.sense * arc.reach;
                self.rate = self.sense * arc.rate(arc.reach);
                self.close();
            }
        }
    }

    fn arc(&self) -> Arc {
        let (scale, from, force) = self.branch();
        let height = 1.0 - self.sense * (self.u - from) / scale;
        let reach = match self.turns.len() {
            0 | 1 => scale * height,
            n => self.sense * (self.turns[n - 2][0] - self.u),
        };
        let arc = Arc {
            speed: self.rate.abs(),
            push: -(self.sense * force + scale),
            gain: scale,
            lean: scale.recip(),
            height,
            reach,
            low: 0.0,
            high: 0.0,
            roots: [0.0; 2],
        };
        arc.between()
    }
}

impl Arc {
    /// With its turning points.
    fn between(mut self) -> Self {
        let root = self.height.sqrt();
        let (pull, bend) = (self.push + self.gain * self.height * root, 1.5 * self.gain * self.lean * root);
        let swing = (pull * pull + bend * self.speed * self.speed).sqrt();
        self.high = self.turning((pull + swing) / bend);
        // From rest it begins at the turning point itself.
        self.low = if self.speed > 0.0 { self.turning((pull - swing) / bend) } else { 0.0 };
        self.roots = [self.low, self.high].map(|q| (self.height - self.lean * q).max(0.0).sqrt());
        self
    }

    /// Mean of b up to q, and b there.
    fn pull(&self, q: f64) -> [f64; 2] {
        let (a, h) = (self.height.sqrt(), (self.height - self.lean * q).max(0.0));
        let (b, share) = (h.sqrt(), (self.height - h) / (self.lean * q));
        let (a2, b2, ab) = (a * a, b * b, a * b);
        let mean = 0.4 * (a2 * a2 + b2 * b2 + ab * (a2 + ab + b2)) / (a + b);
        [self.push + self.gain * mean * if q == 0.0 { 1.0 } else { share }, self.push + self.gain * h * b]
    }

    /// The root of ν² next to a guess, by Newton's steps: ν² is concave.
    fn turning(&self, guess: f64) -> f64 {
        let mut q = guess;
        for _ in 0..STEPS {
            let [mean, pull] = self.pull(q);
            let step = (self.speed * self.speed + 2.0 * q * mean) / (2.0 * pull);
            q = if pull * guess > 0.0 { 2.0 * q } else { q - step };
            // The next step is the square of it.
            if step.abs() <= 1e-8 * q.abs() {
                break;
            }
        }
        q
    }

    fn angle(&self, q: f64) -> f64 {
        2.0 * (q - self.low).max(0.0).sqrt().atan2((self.high - q).max(0.0).sqrt())
    }

    fn way(&self, angle: f64) -> f64 {
        let sine = (0.5 * angle).sin();
        self.low + (self.high - self.low) * sine * sine
    }

    /// 2K at q: a second divided difference of h^{5/2}, of the roots of its heights; beyond the centre nothing is left.
    fn stiffness(&self, q: f64) -> f64 {
        let ([a, c], y) = (self.roots, (self.height - self.lean * q).max(0.0).sqrt());
        let beyond = self.height - self.lean * self.high;
        if beyond < 0.0 {
            let (a2, y2, ay) = (a * a, y * y, a * y);
            let inner = (a2 * a2 + y2 * y2 + ay * (a2 + ay + y2)) / (a + y);
            return 0.8 * self.gain * self.lean * (inner - y2 * y2 * y / (y2 - beyond)) / (a2 - beyond);
        }
        let (sum, product) = (a + c, a * c);
        let square = sum * sum - product;
        let cubic = ((sum * y + sum * sum) * y + sum * square) * y + product * square;
        0.8 * self.gain * self.lean * cubic / ((a + y) * (y + c) * sum)
    }

    fn slowness(&self, angle: f64) -> f64 {
        self.stiffness(self.way(angle)).sqrt().recip()
    }

    /// Time between two angles.
    fn time<const N: usize>(&self, from: f64, to: f64, rule: &Rule<N>) -> f64 {
        let Rule { nodes, weights } = rule;
        let slowness = nodes.map(|node| self.slowness(from + (to - from) * node));
        (to - from) * slowness.iter().zip(weights).map(|(slowness, weight)| weight * slowness).sum::<f64>()
    }

    /// Way after a time, of `whole` between two angles.
    fn at<const N: usize>(&self, time: f64, [from, to]: [f64; 2], whole: f64, rule: &Rule<N>) -> f64 {
        let (mut known, mut left, mut at) = (from, time, from + (to - from) * time / whole);
        for _ in 0..STEPS {
            left -= self.time(known, at, rule);
            let step = left / self.slowness(at);
            (known, at) = (at, at + step);
            if step.abs() <= 1e-7 {
                break;
            }
        }
        self.way(at)
    }

    /// ν at q.
    fn rate(&self, q: f64) -> f64 {
        ((q - self.low) * (self.high - q) * self.stiffness(q)).max(0.0).sqrt()
    }
}
