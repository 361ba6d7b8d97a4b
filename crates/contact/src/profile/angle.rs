//! Functions of a profile with a border, a circle of radius b at which f is not smooth.
//!
//! With w = √(x²-b²): φ = arctan(w/b) = arccos(b/x), its complement ψ = arcsin(b/x), and y = arsinh(w/b). φ is the Gudermannian of y.

use std::f64::consts::FRAC_PI_2;

/// Position x ≥ b beyond a border b, stored as w = √(x²-b²), because x - b loses digits near the border.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Radius b of the border, m.
    pub(super) border: f64,
    /// Distance w = √(x²-b²), m.
    pub(super) w: f64,
    /// Position x, m.
    pub(super) x: f64,
    /// Angle φ = arctan(w/b).
    pub(super) angle: f64,
}

impl Place {
    /// Creates the position from w.
    pub(super) fn beyond(border: f64, w: f64) -> Self {
        Self { border, w, x: math::hypot(border, w), angle: math::atan2(w, border) }
    }

    /// Creates the position from x > b.
    pub(super) fn at(border: f64, x: f64) -> Self {
        let w = ((x - border) * (x + border)).sqrt();
        Self { border, w, x, angle: math::atan2(w, border) }
    }

    /// Returns ψ = π/2 - φ.
    pub(super) fn complement(&self) -> f64 {
        math::atan2(self.border, self.w)
    }

    /// Returns x - b, m.
    pub(super) fn excess(&self) -> f64 {
        self.w * (self.w / (self.x + self.border))
    }

    /// Returns y = arsinh(w/b).
    pub(super) fn hyperbolic(&self) -> f64 {
        math::asinh(self.w / self.border)
    }
}

/// Largest y of the power series, with a truncation error of 1e-17.
const SERIES_END: f64 = 0.8;

/// Coefficients E₂ₖ/(2k+2)! of ∫₀^y gd = Σ E₂ₖ y^{2k+2}/(2k+2)!, |y| < π/2, with the Euler numbers Eₙ (DLMF 24.2).
const EULER: [f64; 24] = [
    0.5,
    -0.041666666666666664,
    0.006944444444444444,
    -0.0015128968253968254,
    0.0003816688712522046,
    -0.00010547146397840842,
    3.100272972544798e-05,
    -9.528412896520122e-06,
    3.0288004162660843e-06,
    -9.88481931191038e-07,
    3.2951151995233036e-07,
    -1.1177218637264587e-07,
    3.846978093762961e-08,
    -1.3405145134354533e-08,
    4.721003356157127e-09,
    -1.6780393297661573e-09,
    6.012861448897684e-10,
    -2.170020089674344e-10,
    7.881506260510816e-11,
    -2.8789239531754574e-11,
    1.0570168008853525e-11,
    -3.899008224674882e-12,
    1.4443258489819693e-12,
    -5.371018891649653e-13,
];

/// Catalan's constant.
const CATALAN: f64 = 0.915_965_594_177_219;

/// Returns the integral of the Gudermannian function K(y) = ∫₀^y gd(t) dt = ∫₀^φ t/cos t dt, y ≥ 0.
///
/// For large y, gd(t) = π/2 - 2 arctan e⁻ᵗ. Hence K = πy/2 - 2G + 2Ti₂(e⁻ʸ), where G is Catalan's constant and Ti₂(z) =
/// Σ(-1)ᵏz^{2k+1}/(2k+1)² the inverse tangent integral (Lewin, *Polylogarithms*, 1981, chapter 2).
pub(super) fn gudermann_integral(y: f64) -> f64 {
    if y <= SERIES_END {
        let square = y * y;
        return square * EULER.iter().rev().fold(0.0, |sum, c| sum * square + c);
    }
    let z = math::exp(-y);
    let (square, mut power, mut sum, mut odd) = (z * z, z, 0.0, 1.0);
    // At most 21 terms.
    while f64::abs(power) > 1e-18 {
        sum += power / (odd * odd);
        power *= -square;
        odd += 2.0;
    }
    FRAC_PI_2 * y - 2.0 * CATALAN + 2.0 * sum
}

/// Returns N R²/b⁵ of a profile with f″ = 1/R beyond a border b.
///
/// The profile has g = x(w + bα)/R and M = [(4/3)w³ + b²w + bx²α]/R with dα/dx = -b/(xw). α = -φ for a flat inside the border, and
/// α = ψ for a cone of slope b/R. Three integrations by parts of N = ∫M dg give (8/15)x⁵ - (5/6)x³ + (5/12)x - 7/60 + x³α²/3 + αP +
/// (yφ - K)/12 with P = (5/6)x³w - xw/4 + y/12, in units of b. Valid for w ≥ b; below, terms cancel for α = -φ.
pub(super) fn curved_beyond(place: &Place, alpha: f64) -> f64 {
    let (x, w, y) = (place.x / place.border, place.w / place.border, place.hyperbolic());
    let square = x * x;
    let sum = x * (5.0 / 12.0 + square * (8.0 / 15.0 * square - 5.0 / 6.0)) - 7.0 / 60.0;
    let part = x * w * (5.0 / 6.0 * square - 0.25) + y / 12.0;
    sum + alpha * (square * x * alpha / 3.0 + part) + (y * place.angle - gudermann_integral(y)) / 12.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_integral_agrees_with_40_digits() {
        // mpmath: quad(lambda t: 2*atan(tanh(t/2)), [0, y]).
        let table = [
            (0.001, 4.999999583333403e-07),
            (0.3, 0.04466746543794691),
            (0.79, 0.29731024920719795),
            (0.8, 0.30453482972643475),
            (0.81, 0.31183418016389713),
            (1.5, 0.9680981118116941),
            (4.0, 4.487884031386958),
            (40.0, 60.999921883441424),
        ];
        for (y, want) in table {
            approx::assert_relative_eq!(gudermann_integral(y), want, max_relative = 4e-15);
        }
        // For small y the integral is y²/2, for large y it is πy/2 - 2G.
        approx::assert_relative_eq!(gudermann_integral(1e-9), 0.5e-18, max_relative = 1e-15);
        approx::assert_relative_eq!(gudermann_integral(1e9), 1e9 * FRAC_PI_2, max_relative = 1e-8);
    }
}
