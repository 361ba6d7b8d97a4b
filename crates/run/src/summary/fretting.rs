//! Fretting loops.

use schemars::JsonSchema;
use serde::Serialize;
use stickslip_measure::contact_cycles::{ContactCycles, JudgedCycle};
use stickslip_quantity::Real;

/// The last cycle of a contact that comes back along u.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Fretting {
    /// number of whole cycles; what follows is of the last
    cycles: usize,
    /// its start and end
    #[serde(rename = "cycle_s")]
    cycle: [Real; 2],
    /// whether F_x comes back within a hundredth of its range: only then it is a loop
    pub closed: bool,
    /// δ* = (u_max - u_min)/2
    #[serde(rename = "displacement_amplitude_m")]
    displacement_amplitude: Real,
    /// Q* = (F_max - F_min)/2
    #[serde(rename = "force_amplitude_N")]
    force_amplitude: Real,
    /// δ₀, half of the way between the places where F_x passes the middle of its range
    #[serde(rename = "half_opening_m", skip_serializing_if = "Option::is_none")]
    half_opening: Option<Real>,
    /// E_d, all that the contact loses in the cycle: friction work, and of a damped contact what its damping takes; left out where other parts lose energy as well, for their share cannot be separated
    #[serde(rename = "dissipated_J", skip_serializing_if = "Option::is_none")]
    pub dissipated: Option<Real>,
    /// friction's part of E_d, of a damped contact
    #[serde(rename = "friction_J", skip_serializing_if = "Option::is_none")]
    friction: Option<Real>,
    /// damping's part of E_d, of a damped contact
    #[serde(rename = "damping_J", skip_serializing_if = "Option::is_none")]
    pub damping: Option<Real>,
    /// A = E_d/(4Q*δ*)
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_ratio: Option<Real>,
    /// B = E_d/(4Q*δ₀); left out where δ₀ is rounding, as in full stick
    #[serde(skip_serializing_if = "Option::is_none")]
    system_free_ratio: Option<Real>,
    /// D = δ₀/δ*
    #[serde(skip_serializing_if = "Option::is_none")]
    slip_ratio: Option<Real>,
    /// μ_e = E_d/(4Pδ₀), P the mean normal force; left out where δ₀ is rounding
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_coefficient_of_friction: Option<Real>,
    /// tangent right after the reversal at the largest u: count · 2G*a
    #[serde(rename = "stiffness_after_maximum_N_m", skip_serializing_if = "Option::is_none")]
    stiffness_after_maximum: Option<Real>,
    /// the same at the smallest u
    #[serde(rename = "stiffness_after_minimum_N_m", skip_serializing_if = "Option::is_none")]
    stiffness_after_minimum: Option<Real>,
    /// secant over the first tenth of the displacement range after the largest u
    #[serde(rename = "secant_after_maximum_N_m", skip_serializing_if = "Option::is_none")]
    secant_after_maximum: Option<Real>,
    /// the same from the smallest u
    #[serde(rename = "secant_after_minimum_N_m", skip_serializing_if = "Option::is_none")]
    secant_after_minimum: Option<Real>,
    /// A, B and D of this profile at the limit between partial and gross slip on a rigid rig; only under a constant load and
    /// without damping.
    #[serde(skip_serializing_if = "Option::is_none")]
    thresholds: Option<Limits>,
    /// `still` where u moves by no more than can be told from rest, `gross` where F_x comes both ways to the limit of friction,
    /// `stick` where A is below 5e-4, else `partial`; but for `still` of a loop under a constant load without damping
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regime: Option<&'static str>,
}

/// Where gross slip begins.
#[derive(Debug, Serialize, JsonSchema)]
struct Limits {
    /// A of this profile where gross slip begins, on a rigid rig
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_ratio: Option<Real>,
    /// B there; B of small loops is near 2/3 on any smooth profile, above the threshold of a worn one
    #[serde(skip_serializing_if = "Option::is_none")]
    system_free_ratio: Option<Real>,
    /// D there
    #[serde(skip_serializing_if = "Option::is_none")]
    slip_ratio: Option<Real>,
}

impl Fretting {
    /// The last of the cycles; of a contact that `is_damped` with the parts of what it loses.
    pub(super) fn of(cycles: &ContactCycles, is_damped: bool) -> Option<Self> {
        let JudgedCycle { figures: last, regime } = cycles.last?;
        let cycle = last.cycle;
        let of_loop = |value: Option<f64>| last.of_loop(value).map(Real);
        let ratio = |value: Option<f64>| last.ratio(value).map(Real);
        Some(Fretting {
            cycles: cycles.count,
            cycle: last.time.map(Real),
            closed: last.is_closed,
            displacement_amplitude: Real(cycle.displacement_amplitude),
            force_amplitude: Real(cycle.force_amplitude),
            half_opening: of_loop(cycle.half_opening),
            dissipated: last.dissipated().map(Real),
            friction: is_damped.then(|| Real(last.friction())),
            damping: last.damping.filter(|_| is_damped).map(Real),
            energy_ratio: ratio(cycle.energy_ratio()),
            system_free_ratio: ratio(cycle.system_free_ratio()),
            slip_ratio: of_loop(cycle.slip_ratio()),
            energy_coefficient_of_friction: ratio(cycle.friction_coefficient(last.normal)),
            stiffness_after_maximum: cycle.stiffness_after_maximum.map(Real),
            stiffness_after_minimum: cycle.stiffness_after_minimum.map(Real),
            secant_after_maximum: of_loop(last.secants[0]),
            secant_after_minimum: of_loop(last.secants[1]),
            thresholds: cycles.thresholds.map(|limits| Limits {
                energy_ratio: limits.energy_ratio.map(Real),
                system_free_ratio: limits.system_free_ratio.map(Real),
                slip_ratio: limits.slip_ratio.map(Real),
            }),
            regime,
        })
    }

    /// What friction takes in the cycle, J.
    pub fn friction_work(&self) -> Real {
        self.friction.or(self.dissipated).unwrap_or(Real(0.0))
    }
}
