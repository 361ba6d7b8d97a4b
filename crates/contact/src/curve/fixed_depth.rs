//! Branch of the hysteresis at constant indentation.

use super::Branch;
use crate::Profile;

/// Branch at constant indentation: F_x = F₀ + G\*σ(γ-κ) M(h_c), a function of u alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedDepthBranch {
    /// Direction σ.
    sense: f64,
    /// Level of the breakpoint below the piece, minus the level of the apex at u = 0, m.
    level: f64,
    /// Factor 1/(κ-σk); 0 in gross slip.
    flow: f64,
    /// Height of the breakpoint below the piece, m.
    height: f64,
    /// Force F₀ with the slip front in the centre, N.
    base: f64,
    /// Factor G\*σ(γ-κ); 0 in gross slip.
    gain: f64,
}

impl FixedDepthBranch {
    /// Returns h₀ (m) and s of the slip front as a linear function of u: h_c = h₀ + su.
    pub fn front(&self) -> (f64, f64) {
        (self.height + self.level * self.flow, -self.sense * self.flow)
    }

    /// Returns F₀ (N) and g (N/m²) of the force as a linear function of M at the slip front: F = F₀ + gM. In gross slip g = 0.
    pub fn forces(&self) -> (f64, f64) {
        (self.base, self.gain)
    }

    /// Returns the slip direction: +1 forward, -1 backward.
    #[inline(always)]
    pub fn sense(&self) -> f64 {
        self.sense
    }

    /// Returns whether the branch is gross slip.
    #[inline(always)]
    pub fn is_gross(&self) -> bool {
        self.gain == 0.0
    }

    /// Returns the distance that the limit line can move at u until the end of the piece, m; in gross slip the value is -σu.
    #[inline(always)]
    pub fn margin(&self, u: f64) -> f64 {
        self.level - self.sense * u
    }

    /// Returns the tangential force F_x at u, N.
    #[inline(always)]
    pub fn force(&self, profile: &Profile, u: f64) -> f64 {
        let front = self.height + self.margin(u) * self.flow;
        self.base + self.gain * profile.reduced_force(front)
    }
}

impl Branch {
    /// Returns the branch at a constant indentation d (m). `reduced_force` is M(d), m².
    pub fn at_depth(&self, d: f64, reduced_force: f64) -> FixedDepthBranch {
        let limit = self.slope * reduced_force;
        if self.is_gross() {
            let base = self.factor * limit;
            return FixedDepthBranch {
                sense: self.sense(),
                level: 0.0,
                flow: 0.0,
                height: 0.0,
                base,
                gain: 0.0,
            };
        }
        FixedDepthBranch {
            sense: self.sense(),
            level: self.piece.level + self.slope * d,
            flow: self.piece.flow,
            height: self.piece.height,
            base: self.factor * (self.piece.offset + limit),
            gain: self.factor * self.piece.excess,
        }
    }
}
