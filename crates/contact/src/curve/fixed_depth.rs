//! A branch at constant indentation: what most contacts of most scenes are between two events.

use super::Branch;
use crate::Profile;

/// A branch at constant indentation: F_x = F₀ + G\*σ(γ-κ) M(h_c), a function of u alone.
// 3.6 ns for a force instead of 4.4 by the branch itself, and the same for its guards; more than the time counts that F is a
// function of u alone, which a swing in closed form lives on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedDepthBranch {
    /// σ.
    sense: f64,
    /// Level of the knot below the piece, over that of the apex at u = 0, m.
    level: f64,
    /// 1/(κ-σk); 0 in gross slip.
    flow: f64,
    /// Height of that knot, m.
    height: f64,
    /// Force with the slip front in the centre, N.
    base: f64,
    /// G\*σ(γ-κ); 0 in gross slip.
    gain: f64,
}

impl FixedDepthBranch {
    /// The slip front as a straight function of u, h_c = h₀ + su: (h₀ in m, s).
    pub fn front(&self) -> (f64, f64) {
        (self.height + self.level * self.flow, -self.sense * self.flow)
    }

    /// The force as a straight function of M at the slip front, F = F₀ + gM: (F₀ in N, g in N/m²), g = 0 in gross slip.
    pub fn forces(&self) -> (f64, f64) {
        (self.base, self.gain)
    }

    /// +1 forward, -1 backward.
    #[inline(always)]
    pub fn sense(&self) -> f64 {
        self.sense
    }

    /// Whether every spring slips.
    #[inline(always)]
    pub fn is_gross(&self) -> bool {
        self.gain == 0.0
    }

    /// How far the edge may still move at u before the piece is used up, m; 0 - σu in gross slip, where no piece ends.
    #[inline(always)]
    pub fn margin(&self, u: f64) -> f64 {
        self.level - self.sense * u
    }

    /// F_x at u, N.
    #[inline(always)]
    pub fn force(&self, profile: &Profile, u: f64) -> f64 {
        let front = self.height + self.margin(u) * self.flow;
        self.base + self.gain * profile.reduced_force(front)
    }
}

impl Branch {
    /// The branch at a constant indentation d (m), with M(d) at hand.
    pub fn at_depth(&self, d: f64, reduced_force: f64) -> FixedDepthBranch {
        let limit = self.slope * reduced_force;
        if self.is_gross() {
            let base = self.factor * limit;
            return FixedDepthBranch {
                sense: self.sense,
                level: 0.0,
                flow: 0.0,
                height: 0.0,
                base,
                gain: 0.0,
            };
        }
        FixedDepthBranch {
            sense: self.sense,
            level: self.level + self.slope * d,
            flow: self.flow,
            height: self.height,
            base: self.factor * (self.offset + limit),
            gain: self.factor * self.excess,
        }
    }
}
