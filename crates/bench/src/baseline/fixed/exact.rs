//! Exact contact law under constant load, for a fixed-step loop.

use super::walk::Contact;
use crate::baseline::Tie;
use crate::masing::Masing;
use pulp::Simd;

/// Contact of the profile |x|ⁿ.
#[derive(Debug, Clone)]
pub(crate) struct Exact {
    memory: Masing,
    /// Initial displacement u, m; then 1/u_c, 1/m, and the friction limit μF_N, N.
    origin: f64,
    scale: f64,
    limit: f64,
}

impl Exact {
    /// Returns the contact in its initial state. The error names an unsupported feature.
    pub(in crate::baseline) fn new(tie: &Tie) -> Result<Self, String> {
        let (law, apex) = (&tie.law, tie.start.apex());
        if tie.press.is_some() {
            return Err("loads that vary".to_owned());
        }
        let exponent = law.profile().exponent().ok_or("profiles other than power laws")?;
        if tie.start.knots().any(|(_, anchor)| anchor != apex.u) {
            return Err("contacts with a loading history".to_owned());
        }
        Ok(Self {
            memory: Masing::new((exponent + 1.0) / exponent),
            origin: apex.u,
            scale: law.gross_slip_displacement(apex.d).recip(),
            limit: law.friction() * law.normal_force(apex.d),
        })
    }
}

impl Contact for Exact {
    const WIDE: bool = false;

    #[inline(always)]
    fn force<S: Simd, const KEEP: bool>(&mut self, _: S, u: f64, _: f64) -> (f64, f64) {
        let u = (u - self.origin) * self.scale;
        if KEEP {
            self.memory.slide(u);
        }
        (self.limit * self.memory.look(u), 0.0)
    }
}
