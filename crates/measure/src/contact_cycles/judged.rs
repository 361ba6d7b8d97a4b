//! Classification of the cycles of a contact by slip regime.

use super::CycleFigures;
use crate::Setting;
use crate::Thresholds;
use stickslip_contact::{Interface, Profile};

/// Thresholds below this value are set to 0, as for a flat punch.
const ROUNDING: f64 = 1e-12;
/// Relative distance of a force from the friction limit below which the force counts as equal to the limit.
// In partial slip of a sphere, the displacement (1 - 1e-6) u_c gives a force at this distance from the limit.
const AT_LIMIT: f64 = 1e-9;

/// Results and slip regime of a cycle. An open loop or a varying load has no regime except "still".
#[derive(Debug, Clone, Copy)]
pub struct JudgedCycle {
    /// Results of the cycle.
    pub figures: CycleFigures,
    /// Slip regime: "still" (at rest within the resolution), "stick", "partial" or "gross".
    pub regime: Option<&'static str>,
}

/// Classified cycles of a contact.
#[derive(Debug, Clone, Default)]
pub struct ContactCycles {
    /// Number of cycles.
    pub count: usize,
    /// Last cycle.
    pub last: Option<JudgedCycle>,
    /// All cycles, if the run is kept in memory.
    pub all: Vec<JudgedCycle>,
    /// Thresholds between partial and gross slip for the profile and the initial indentation. `None` for varying loads and damped contacts.
    pub thresholds: Option<Thresholds>,
}

impl ContactCycles {
    /// Classifies the next cycle of contact `c`.
    pub fn take(
        &mut self,
        setting: &Setting,
        (c, law): (usize, &Interface),
        figures: CycleFigures,
    ) -> JudgedCycle {
        if self.count == 0 {
            let limits = thresholds(law.profile(), figures.depth);
            self.thresholds = limits.filter(|_| setting.has_law_without_time(c));
        }
        let is_loop = self.thresholds.is_some() && figures.is_closed;
        let regime = match figures.is_still {
            true => Some("still"),
            false => is_loop.then(|| regime(&figures, law.friction() * figures.normal)),
        };
        let judged = JudgedCycle { figures, regime };
        (self.count, self.last) = (self.count + 1, Some(judged));
        judged
    }
}

/// Returns the thresholds between partial and gross slip of a profile at indentation d, for a rigid rig.
///
/// By Masing's rule, the loop of amplitude u_c has `E_d = 4μE*κ(Md - 2N)` and crosses F_x = 0 where M(h) = M(d)/2. Hence A = 1 - 2N/(Md)
/// and D = 2h/d - 1. For f ~ rⁿ these are 1/(2n+1) and 2^{1/(n+1)} - 1. Returns `None` for an open contact.
fn thresholds(profile: &Profile, d: f64) -> Option<Thresholds> {
    let reduced_force = profile.reduced_force(d);
    let energy = 1.0 - 2.0 * profile.reduced_energy(d) / (reduced_force * d);
    let slip = 2.0 * profile.height_of_reduced_force(0.5 * reduced_force) / d - 1.0;
    let positive = |value: f64| value > ROUNDING;
    (reduced_force > 0.0 && d > 0.0).then(|| Thresholds {
        energy_ratio: Some(energy),
        system_free_ratio: (positive(energy) && positive(slip)).then(|| energy / slip),
        slip_ratio: Some(slip),
    })
}

/// Returns the slip regime of a loop. Gross slip means that the force amplitude reaches the friction limit `limit`, N.
///
/// This criterion holds for any profile and for a row of few springs. The ratios A, B and D serve for loops with an unknown friction limit.
/// For small loops, B is near 2/3 for any profile and would exceed the threshold of a worn (flat) profile.
fn regime(figures: &CycleFigures, limit: f64) -> &'static str {
    let cycle = &figures.cycle;
    if cycle.force_amplitude >= (1.0 - AT_LIMIT) * limit {
        "gross"
    } else if cycle.energy_ratio().is_none_or(|a| a < Thresholds::RESOLUTION) {
        "stick"
    } else {
        "partial"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds_are_those_of_the_closed_form() {
        let powers = [
            (Profile::cone(0.1).unwrap(), 1.0),
            (Profile::paraboloid(1e-3).unwrap(), 2.0),
            (Profile::power(1e6, 4.0).unwrap(), 4.0),
        ];
        for (profile, n) in powers {
            let (got, want) = (thresholds(&profile, 1e-6).unwrap(), Thresholds::of_profile(n).unwrap());
            let pairs = [
                (got.energy_ratio, want.energy_ratio),
                (got.system_free_ratio, want.system_free_ratio),
                (got.slip_ratio, want.slip_ratio),
            ];
            for (got, want) in pairs {
                assert!((got.unwrap() - want.unwrap()).abs() < 1e-12, "n = {n}: {got:?}, {want:?}");
            }
        }
    }

    #[test]
    fn a_shallow_sphere_has_those_of_the_paraboloid_and_a_punch_none() {
        // a/R = 1.4e-2: the profiles differ by (a/R)² in order of magnitude.
        let sphere = thresholds(&Profile::sphere(5e-3).unwrap(), 1e-6).unwrap();
        assert!((sphere.energy_ratio.unwrap() - 0.2).abs() < 2e-4);
        assert!((sphere.slip_ratio.unwrap() - 0.25992).abs() < 2e-4);
        let flat = thresholds(&Profile::flat(1e-3).unwrap(), 1e-6).unwrap();
        assert!(flat.system_free_ratio.is_none() && flat.energy_ratio.unwrap().abs() < 1e-12);
        assert!(thresholds(&Profile::flat(1e-3).unwrap(), -1e-6).is_none());
    }
}
