//! Fretting loops.

use schemars::JsonSchema;
use serde::Serialize;
use stickslip_measure::contact_cycles::{ContactCycles, JudgedCycle};
use stickslip_quantity::Real;

/// Last whole cycle of a contact whose displacement u returns to its start.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Fretting {
    /// number of whole cycles. All other results of `fretting` are those of the last one.
    cycles: usize,
    /// start and end time of the last cycle
    #[serde(rename = "cycle_s")]
    cycle: [Real; 2],
    /// whether F_x returns within 1 % of its range. Otherwise the cycle is no closed loop and has no ratios.
    pub closed: bool,
    /// δ*, displacement amplitude: (u_max - u_min)/2
    #[serde(rename = "displacement_amplitude_m")]
    displacement_amplitude: Real,
    /// Q*, tangential force amplitude: (F_max - F_min)/2
    #[serde(rename = "force_amplitude_N")]
    force_amplitude: Real,
    /// δ₀, half the width of the loop at the middle of the range of F_x
    #[serde(rename = "half_opening_m", skip_serializing_if = "Option::is_none")]
    half_opening: Option<Real>,
    /// E_d, energy dissipated by the contact in the cycle, by friction and contact damping. Absent if the contact is
    /// damped and other parts of the model dissipate, too.
    #[serde(rename = "dissipated_J", skip_serializing_if = "Option::is_none")]
    pub dissipated: Option<Real>,
    /// friction work in the cycle, part of E_d. Absent without contact damping.
    #[serde(rename = "friction_J", skip_serializing_if = "Option::is_none")]
    friction: Option<Real>,
    /// energy dissipated by contact damping in the cycle, part of E_d. Absent without contact damping.
    #[serde(rename = "damping_J", skip_serializing_if = "Option::is_none")]
    pub damping: Option<Real>,
    /// A, energy ratio: `A = E_d/(4Q*δ*)`. 0 for an elastic contact, 1 for a rectangular loop.
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_ratio: Option<Real>,
    /// B, system-free ratio: B = E_d/(4Q*δ₀), independent of the compliance of the rig. Absent if δ₀ is 0 within
    /// rounding, as in full stick.
    #[serde(skip_serializing_if = "Option::is_none")]
    system_free_ratio: Option<Real>,
    /// D, slip ratio: D = δ₀/δ*
    #[serde(skip_serializing_if = "Option::is_none")]
    slip_ratio: Option<Real>,
    /// μ_e, energy coefficient of friction: μ_e = E_d/(4Pδ₀), with the mean normal force P. Absent if δ₀ is 0 within
    /// rounding.
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_coefficient_of_friction: Option<Real>,
    /// tangent stiffness dF_x/du immediately after the reversal at the largest u, in full stick: count · 2G*a
    #[serde(rename = "stiffness_after_maximum_N_m", skip_serializing_if = "Option::is_none")]
    stiffness_after_maximum: Option<Real>,
    /// tangent stiffness dF_x/du immediately after the reversal at the smallest u, in full stick: count · 2G*a
    #[serde(rename = "stiffness_after_minimum_N_m", skip_serializing_if = "Option::is_none")]
    stiffness_after_minimum: Option<Real>,
    /// secant stiffness over the first tenth of the displacement range after the largest u, as evaluated in experiments
    #[serde(rename = "secant_after_maximum_N_m", skip_serializing_if = "Option::is_none")]
    secant_after_maximum: Option<Real>,
    /// secant stiffness over the first tenth of the displacement range after the smallest u, as evaluated in
    /// experiments
    #[serde(rename = "secant_after_minimum_N_m", skip_serializing_if = "Option::is_none")]
    secant_after_minimum: Option<Real>,
    /// A, B and D at the onset of gross slip on a rigid rig. Only with a constant normal force and without damping.
    #[serde(skip_serializing_if = "Option::is_none")]
    thresholds: Option<Limits>,
    /// slip regime: `still` (u does not move within the resolution), `gross` (F_x reaches +μF_N and -μF_N), `stick` (A
    /// below 5e-4), otherwise `partial`. Except for `still`, absent if the normal force varies or the contact is
    /// damped.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regime: Option<&'static str>,
}

/// Ratios at the onset of gross slip.
#[derive(Debug, Serialize, JsonSchema)]
struct Limits {
    /// A at the onset of gross slip for this profile on a rigid rig
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_ratio: Option<Real>,
    /// B at the onset of gross slip for this profile on a rigid rig. Small loops have B near 2/3 on any smooth profile,
    /// above the threshold of a worn one.
    #[serde(skip_serializing_if = "Option::is_none")]
    system_free_ratio: Option<Real>,
    /// D at the onset of gross slip for this profile on a rigid rig
    #[serde(skip_serializing_if = "Option::is_none")]
    slip_ratio: Option<Real>,
}

impl Fretting {
    /// Returns the results of the last cycle. If the contact `is_damped`, friction work and damping work are separate.
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

    /// Returns the friction work of the cycle, J.
    pub fn friction_work(&self) -> Real {
        self.friction.or(self.dissipated).unwrap_or(Real(0.0))
    }
}
