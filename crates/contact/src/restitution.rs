//! Restitution of an impact on a contact with damping along the normal.
//!
//! The contact is that of the elastic one pressed by d + βḋ: mz̈ = -E\*M(d + βḋ) from d = 0 with the speed v, until d + βḋ = 0. The
//! contact then opens, and the bodies part with the speed ev, where e is the coefficient of restitution.

use crate::Interface;

/// Number of time steps in which the undamped impact reaches its largest indentation, about.
const STEPS: f64 = 400.0;
/// Largest number of time steps.
const MOST: u32 = 1_000_000;
/// Number of bisections of the damping time.
const BISECTIONS: u32 = 100;
/// Relative accuracy of the damping time.
const ACCURACY: f64 = 1e-9;

impl Interface {
    /// Returns the coefficient of restitution of an impact of a mass (kg) at a speed (m/s) with a damping time β (s) along the normal.
    ///
    /// No other force acts. For weak damping of a paraboloid e = 1 - 1.7302 β(K/m)^{2/5}v^{1/5} with F_N = K d^{3/2}.
    pub fn restitution(&self, (mass, speed): (f64, f64), damping: f64) -> f64 {
        let step = self.impact_depth(mass, speed) / speed / STEPS;
        let pull = |d: f64, v: f64| -self.normal_force(d + damping * v) / mass;
        let (mut d, mut v) = (0.0, speed);
        for _ in 0..MOST {
            let (a1, v2) = (pull(d, v), v + 0.5 * step * pull(d, v));
            let (d2, d3) = (d + 0.5 * step * v, d + 0.5 * step * v2);
            let a2 = pull(d2, v2);
            let v3 = v + 0.5 * step * a2;
            let a3 = pull(d3, v3);
            let (d4, v4) = (d + step * v3, v + step * a3);
            let a4 = pull(d4, v4);
            let end =
                [d + step * (v + 2.0 * (v2 + v3) + v4) / 6.0, v + step * (a1 + 2.0 * (a2 + a3) + a4) / 6.0];
            if end[1] < 0.0 && end[0] + damping * end[1] <= 0.0 {
                // The force vanishes here, so that the velocity is that of the crossing to second order.
                let [before, after] = [d + damping * v, end[0] + damping * end[1]];
                let share = before / (before - after);
                return ((v + share * (end[1] - v)) / -speed).max(0.0);
            }
            [d, v] = end;
        }
        0.0
    }

    /// Returns the damping time β along the normal (s) that gives an impact of a mass (kg) at a speed (m/s) a coefficient of restitution.
    ///
    /// Returns `None` for a coefficient out of (0, 1] and for a mass or speed that is not above 0.
    pub fn damping_of_restitution(&self, (mass, speed): (f64, f64), restitution: f64) -> Option<f64> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !(restitution > 0.0 && restitution <= 1.0 && positive(mass) && positive(speed)) {
            return None;
        }
        if restitution == 1.0 {
            return Some(0.0);
        }
        let time = self.impact_depth(mass, speed) / speed;
        if !positive(time) {
            return None;
        }
        let (mut low, mut high) = (0.0, time);
        while self.restitution((mass, speed), high) > restitution {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            *(if self.restitution((mass, speed), middle) > restitution { &mut low } else { &mut high }) =
                middle;
            if high - low <= ACCURACY * high {
                break;
            }
        }
        Some(0.5 * (low + high))
    }

    /// Returns the indentation at which the elastic energy is the kinetic energy of an impact, m.
    fn impact_depth(&self, mass: f64, speed: f64) -> f64 {
        let energy = 0.5 * mass * speed * speed;
        let mut depth = f64::MIN_POSITIVE.sqrt();
        while self.normal_energy(depth) < energy && depth < 1e3 {
            depth *= 2.0;
        }
        let (mut low, mut high) = (0.5 * depth, depth);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if self.normal_energy(middle) < energy { &mut low } else { &mut high }) = middle;
        }
        high
    }
}
