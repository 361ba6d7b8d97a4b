//! Systems with solutions in closed form.

use stickslip_stepper::System;

/// ẋ = v, v̇ = -ω² x, and the quadratures ∫v² dt, ∫x dt. From x = 1, v = 0.
pub(crate) struct Oscillator {
    pub(crate) omega: f64,
}

impl Oscillator {
    pub(crate) fn exact(&self, t: f64) -> [f64; 4] {
        let w = self.omega;
        let (sin, cos) = (w * t).sin_cos();
        [cos, -w * sin, w * w * (0.5 * t - 0.25 * (2.0 * w * t).sin() / w), sin / w]
    }
}

impl System for Oscillator {
    fn dimension(&self) -> usize {
        2
    }
    fn positions(&self) -> usize {
        1
    }
    fn total(&self) -> usize {
        4
    }
    fn slopes(&self, _t: f64, y: &[f64], dy: &mut [f64]) {
        dy.copy_from_slice(&[y[1], -self.omega * self.omega * y[0], y[1] * y[1], y[0]]);
    }
}

/// Explicit in time and nonlinear, from (1/2, 1, 0): ẏ = 2t y², ṗ = p cos t + (y (2 - t²) - 1) p, q̇ = 6 t y³ as a quadrature.
///
/// Solution y = 1/(2 - t²), p = e^{sin t} (its bracket vanishes on the solution only), q = (3/2)(y² - 1/4).
pub(crate) struct Forced;

impl Forced {
    pub(crate) fn exact(t: f64) -> [f64; 3] {
        let y = 1.0 / (2.0 - t * t);
        [y, t.sin().exp(), 1.5 * (y * y - 0.25)]
    }
}

impl System for Forced {
    fn dimension(&self) -> usize {
        2
    }
    fn positions(&self) -> usize {
        0
    }
    fn total(&self) -> usize {
        3
    }
    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        let [a, p] = [y[0], y[1]];
        dy[0] = 2.0 * t * a * a;
        dy[1] = p * t.cos() + (a * (2.0 - t * t) - 1.0) * p;
        dy[2] = 6.0 * t * a * a * a;
    }
}

/// Kepler's problem (μ = 1, a = 1) with eccentricity `e`, from the pericentre: positions, velocities.
pub(crate) struct Kepler {
    pub(crate) e: f64,
}

impl Kepler {
    pub(crate) fn start(&self) -> [f64; 4] {
        [1.0 - self.e, 0.0, 0.0, ((1.0 + self.e) / (1.0 - self.e)).sqrt()]
    }

    /// Position at time `t` by Kepler's equation E - e sin E = t, solved by Newton's method.
    pub(crate) fn exact(&self, t: f64) -> [f64; 2] {
        let mut anomaly = t;
        for _ in 0..60 {
            anomaly -= (anomaly - self.e * anomaly.sin() - t) / (1.0 - self.e * anomaly.cos());
        }
        [anomaly.cos() - self.e, (1.0 - self.e * self.e).sqrt() * anomaly.sin()]
    }
}

impl System for Kepler {
    fn dimension(&self) -> usize {
        4
    }
    fn positions(&self) -> usize {
        2
    }
    fn total(&self) -> usize {
        4
    }
    fn slopes(&self, _t: f64, y: &[f64], dy: &mut [f64]) {
        let r2 = y[0] * y[0] + y[1] * y[1];
        let g = -1.0 / (r2 * r2.sqrt());
        dy.copy_from_slice(&[y[2], y[3], g * y[0], g * y[1]]);
    }
}

/// Damped, driven oscillator: ẍ = -x - 0.2 ẋ + sin 2t as position and velocity, a further component ż = x - z, and the work ∫0.2
/// ẋ² dt. From rest at 0.
pub(crate) struct Driven;

impl Driven {
    /// x and v from x(0) = v(0) = 0.
    pub(crate) fn exact(t: f64) -> [f64; 2] {
        // Particular part P sin 2t + Q cos 2t: -3P - 0.4 Q = 1 and -3Q + 0.4 P = 0.
        let det = 9.0 + 0.16;
        let (p, q) = (-3.0 / det, -0.4 / det);
        let (decay, w) = (0.1_f64, 0.99_f64.sqrt());
        // x = e^{-0.1t}(A cos wt + B sin wt) + P sin 2t + Q cos 2t, x(0) = 0, v(0) = 0.
        let a = -q;
        let b = (decay * a - 2.0 * p) / w;
        let (s, c) = (w * t).sin_cos();
        let envelope = (-decay * t).exp();
        let (s2, c2) = (2.0 * t).sin_cos();
        let x = envelope * (a * c + b * s) + p * s2 + q * c2;
        let v = envelope * ((b * w - decay * a) * c - (a * w + decay * b) * s) + 2.0 * p * c2 - 2.0 * q * s2;
        [x, v]
    }
}

impl System for Driven {
    fn dimension(&self) -> usize {
        3
    }
    fn positions(&self) -> usize {
        1
    }
    fn total(&self) -> usize {
        4
    }
    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = -y[0] - 0.2 * y[1] + (2.0 * t).sin();
        dy[2] = y[0] - y[2];
        dy[3] = 0.2 * y[1] * y[1];
    }
}

/// Order fitted by least squares through (log h, log error).
pub(crate) fn order(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (sx, sy) = points.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0.ln(), s.1 + p.1.ln()));
    let (mx, my) = (sx / n, sy / n);
    let (num, den) = points.iter().fold((0.0, 0.0), |s, p| {
        let dx = p.0.ln() - mx;
        (s.0 + dx * (p.1.ln() - my), s.1 + dx * dx)
    });
    num / den
}
