//! Fretting loops, and the regimes of their cycles.

use crate::cycles::{CycleFigures, cycles};
use crate::job::Job;
use crate::outcome::Outcome;
use crate::real::Real;
use serde::Serialize;
use stickslip_analysis::{Regime, Thresholds};
use stickslip_contact::{Interface, Profile};

/// Thresholds below this are those of a flat punch, which are 0.
const ROUNDING: f64 = 1e-12;

/// A cycle and, where it is a loop under a constant load, its regime on a rigid rig.
#[derive(Debug, Clone, Copy)]
pub struct JudgedCycle {
    /// Its quantities.
    pub figures: CycleFigures,
    /// "stick", "partial", "mixed" or "gross".
    pub regime: Option<&'static str>,
}

/// The last cycle of a contact that comes back along u.
#[derive(Debug, Serialize)]
pub struct Fretting {
    /// Number of whole cycles.
    cycles: usize,
    /// Start and end of the last.
    #[serde(rename = "cycle_s")]
    cycle: [Real; 2],
    /// Whether its force comes back as well: only then is it a loop, with ratios and a regime.
    pub closed: bool,
    /// δ*, half of peak to peak.
    #[serde(rename = "displacement_amplitude_m")]
    displacement_amplitude: Real,
    /// Q*, half of peak to peak.
    #[serde(rename = "force_amplitude_N")]
    force_amplitude: Real,
    /// δ₀, half opening at the middle of the force's range: at F_x = 0 of a loop about that.
    #[serde(rename = "half_opening_m", skip_serializing_if = "Option::is_none")]
    half_opening: Option<Real>,
    /// E_d, the friction work of the cycle.
    #[serde(rename = "dissipated_J")]
    pub dissipated: Real,
    /// A = E_d/E_t.
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_ratio: Option<Real>,
    /// B = E_d/(4Q*δ₀).
    #[serde(skip_serializing_if = "Option::is_none")]
    system_free_ratio: Option<Real>,
    /// D = δ₀/δ*.
    #[serde(skip_serializing_if = "Option::is_none")]
    slip_ratio: Option<Real>,
    /// μ_e = E_d/(4Pδ₀), P the mean normal force.
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_coefficient_of_friction: Option<Real>,
    /// Tangential stiffness of the contact right after the reversal at the largest u, where all of it sticks.
    #[serde(rename = "stiffness_after_maximum_N_m", skip_serializing_if = "Option::is_none")]
    stiffness_after_maximum: Option<Real>,
    /// The same at the smallest u.
    #[serde(rename = "stiffness_after_minimum_N_m", skip_serializing_if = "Option::is_none")]
    stiffness_after_minimum: Option<Real>,
    /// Secant over the first tenth of the displacement range after the largest u, which slip has softened.
    #[serde(rename = "secant_after_maximum_N_m", skip_serializing_if = "Option::is_none")]
    secant_after_maximum: Option<Real>,
    /// The same after the smallest u.
    #[serde(rename = "secant_after_minimum_N_m", skip_serializing_if = "Option::is_none")]
    secant_after_minimum: Option<Real>,
    /// A, B and D of this profile at the limit between partial and gross slip on a rigid rig; only under a constant load and
    /// without damping.
    #[serde(skip_serializing_if = "Option::is_none")]
    thresholds: Option<Limits>,
    /// Against these.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regime: Option<&'static str>,
}

/// Where gross slip begins.
#[derive(Debug, Serialize)]
struct Limits {
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_ratio: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    system_free_ratio: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    slip_ratio: Option<Real>,
}

impl Fretting {
    /// The last of the cycles.
    pub(super) fn of(cycles: &[JudgedCycle], thresholds: Option<Thresholds>) -> Option<Self> {
        let JudgedCycle { figures: last, regime } = cycles.last()?;
        let cycle = last.cycle;
        let if_closed = |value: Option<f64>| value.filter(|_| last.is_closed).map(Real);
        Some(Fretting {
            cycles: cycles.len(),
            cycle: last.time.map(Real),
            closed: last.is_closed,
            displacement_amplitude: Real(cycle.displacement_amplitude),
            force_amplitude: Real(cycle.force_amplitude),
            half_opening: if_closed(cycle.half_opening),
            dissipated: Real(cycle.dissipated),
            energy_ratio: if_closed(cycle.energy_ratio()),
            system_free_ratio: if_closed(cycle.system_free_ratio()),
            slip_ratio: if_closed(cycle.slip_ratio()),
            energy_coefficient_of_friction: if_closed(cycle.friction_coefficient(last.normal)),
            stiffness_after_maximum: cycle.stiffness_after_maximum.map(Real),
            stiffness_after_minimum: cycle.stiffness_after_minimum.map(Real),
            secant_after_maximum: if_closed(last.secants[0]),
            secant_after_minimum: if_closed(last.secants[1]),
            thresholds: thresholds.map(|limits| Limits {
                energy_ratio: limits.energy_ratio.map(Real),
                system_free_ratio: limits.system_free_ratio.map(Real),
                slip_ratio: limits.slip_ratio.map(Real),
            }),
            regime: *regime,
        })
    }
}

/// The cycles of a contact with their regimes, and the thresholds between these; none of them under a load that varies, or of a
/// damped contact.
pub(super) fn judged(
    job: &Job,
    outcome: &Outcome,
    (c, law): (usize, &Interface),
) -> (Vec<JudgedCycle>, Option<Thresholds>) {
    let cycles = cycles(job, c, &outcome.kept.moments, outcome.state.time());
    let depth = cycles.first().map_or(0.0, |first| first.depth);
    let thresholds = thresholds(law.profile(), depth).filter(|_| job.has_law_without_time(c));
    let judge = |figures: CycleFigures| JudgedCycle {
        figures,
        regime: thresholds.filter(|_| figures.is_closed).map(|limits| word(limits.regime(&figures.cycle))),
    };
    (cycles.into_iter().map(judge).collect(), thresholds)
}

/// The limit between partial and gross slip of any profile at indentation d, on a rigid rig. By Masing's rule the loop
/// of amplitude u_c has `E_d = 4μE*κ(Md - 2N)` and crosses F_x = 0 where M(h) = M(d)/2: A = 1 - 2N/(Md), D = 2h/d - 1; for
/// f ~ rⁿ these are 1/(2n+1) and 2^{1/(n+1)} - 1. None for an open contact.
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

fn word(regime: Regime) -> &'static str {
    match regime {
        Regime::Stick => "stick",
        Regime::Partial => "partial",
        Regime::Mixed => "mixed",
        Regime::Gross => "gross",
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
