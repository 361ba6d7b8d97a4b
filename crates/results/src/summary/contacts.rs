//! Contacts, and the quantities of their last cycle.

use crate::contact_path::contact_path;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::parts::Parts;
use crate::periods::Periods;
use crate::real::Real;
use crate::series::Series;
use serde::Serialize;
use stickslip_analysis::{Cycle, Regime, Thresholds};
use stickslip_contact::{Interface, Profile};
use stickslip_drive::NaturalScale;

/// Thresholds below this are those of a flat punch, which are 0.
const ROUNDING: f64 = 1e-12;

/// A contact. Forces and work are those of all identical contacts together unless they say otherwise.
#[derive(Debug, Serialize)]
pub struct ContactSummary {
    /// Number of identical contacts.
    count: u32,
    /// Displacement at which gross slip starts, at t = 0.
    #[serde(rename = "gross_slip_displacement_m")]
    gross_slip_displacement: Real,
    /// What the stepper's tolerance is relative to.
    scales: Scales,
    /// Loads at t = 0.
    one: Load,
    all: Load,
    #[serde(rename = "peak_fx_N")]
    peak_tangential: Real,
    #[serde(rename = "peak_fn_N")]
    peak_normal: Real,
    /// Of a coupled contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    normal: Option<NormalMotion>,
    #[serde(rename = "friction_J")]
    friction: Real,
    /// Quantities of the last whole cycle; none where there is none, or where it does not come back to its start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fretting: Option<Fretting>,
}

#[derive(Debug, Serialize)]
struct Load {
    #[serde(rename = "normal_force_N")]
    normal: Real,
    /// μF_N.
    #[serde(rename = "limit_force_N")]
    limit: Real,
}

/// Natural scales at the deepest indentation that the scenario names.
#[derive(Debug, Serialize)]
struct Scales {
    /// u_c.
    #[serde(rename = "displacement_m")]
    displacement: Real,
    /// μF_N.
    #[serde(rename = "force_N")]
    force: Real,
    /// u_c ω.
    #[serde(rename = "velocity_m_s")]
    velocity: Real,
}

/// What the bodies' motion does to a contact along the normal, over all rows and events.
#[derive(Debug, PartialEq, Serialize)]
struct NormalMotion {
    /// Least and largest normal force.
    #[serde(rename = "fn_N")]
    force: [Real; 2],
    /// Least and largest indentation; negative: open.
    #[serde(rename = "d_m")]
    indentation: [Real; 2],
    /// Share of the time in which the contact is open.
    open_share: Real,
}

/// A fretting cycle.
#[derive(Debug, Serialize)]
pub struct Fretting {
    /// Start and end of the cycle.
    #[serde(rename = "cycle_s")]
    cycle: [Real; 2],
    /// δ*, half of peak to peak.
    #[serde(rename = "displacement_amplitude_m")]
    displacement_amplitude: Real,
    /// Q*, half of peak to peak.
    #[serde(rename = "force_amplitude_N")]
    force_amplitude: Real,
    /// δ₀, half opening at F_x = 0.
    #[serde(rename = "half_opening_m", skip_serializing_if = "Option::is_none")]
    half_opening: Option<Real>,
    /// E_d, loop area.
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
    /// Tangential stiffness after the reversal at the largest u.
    #[serde(rename = "stiffness_after_maximum_N_m", skip_serializing_if = "Option::is_none")]
    stiffness_after_maximum: Option<Real>,
    /// Tangential stiffness after the reversal at the smallest u.
    #[serde(rename = "stiffness_after_minimum_N_m", skip_serializing_if = "Option::is_none")]
    stiffness_after_minimum: Option<Real>,
    /// Against the thresholds of this profile on a rigid rig; only under a constant load and without damping.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regime: Option<&'static str>,
}

/// All contacts.
pub(super) fn of(job: &Job, outcome: &Outcome, notes: &mut Vec<String>) -> Parts<ContactSummary> {
    let contacts = job.model.contacts().enumerate();
    Parts(
        contacts
            .map(|(c, (name, law))| (name.to_owned(), contact(job, outcome, (c, name, law), notes)))
            .collect(),
    )
}

fn contact(
    job: &Job,
    outcome: &Outcome,
    (c, name, law): (usize, &str, &Interface),
    notes: &mut Vec<String>,
) -> ContactSummary {
    let (gross_slip, normal) = job.contact_scale(c);
    let load = |normal: f64| Load { normal: Real(normal), limit: Real(law.friction() * normal) };
    let series = &outcome.kept.series;
    let peak = |quantity| Real(series.column(name, quantity).iter().fold(0.0, |peak, f| f.abs().max(peak)));
    let count = job.count(c);
    ContactSummary {
        count,
        gross_slip_displacement: Real(gross_slip),
        scales: scales(job, c),
        one: load(normal),
        all: load(f64::from(count) * normal),
        peak_tangential: peak("fx_N"),
        peak_normal: peak("fn_N"),
        normal: if job.is_coupled(c) { normal_motion(series, name) } else { None },
        friction: Real(outcome.books.friction_of(c)),
        fretting: fretting(job, outcome, (c, name, law), notes),
    }
}

fn scales(job: &Job, c: usize) -> Scales {
    let natural = job.model.contact_natural(c);
    let of = |quantity: fn(NaturalScale) -> f64| Real(natural.map_or(0.0, quantity));
    Scales {
        displacement: of(|natural| natural.displacement),
        force: Real(f64::from(job.count(c)) * of(|natural| natural.force).0),
        velocity: of(|natural| natural.velocity),
    }
}

/// Ranges of F_N and d and the time open; none without rows. Touching and lifting off are events, so that between two
/// samples the contact is open or closed all the time.
fn normal_motion(series: &Series, name: &str) -> Option<NormalMotion> {
    let (t, d) = (series.time(), series.column(name, "d_m"));
    let range = |values: &[f64]| {
        let all = values.iter().copied();
        [all.clone().fold(f64::INFINITY, f64::min), all.fold(f64::NEG_INFINITY, f64::max)].map(Real)
    };
    let total = t.last()? - t.first()?;
    let spans = t.windows(2).zip(d.windows(2));
    let open = spans.filter(|(_, d)| d[0] + d[1] <= 0.0).fold(0.0, |sum, (t, _)| sum + (t[1] - t[0]));
    let open_share = if total > 0.0 { open / total } else { 0.0 };
    Some(NormalMotion {
        force: range(series.column(name, "fn_N")),
        indentation: range(d),
        open_share: Real(open_share),
    })
}

fn fretting(
    job: &Job,
    outcome: &Outcome,
    (c, name, law): (usize, &str, &Interface),
    notes: &mut Vec<String>,
) -> Option<Fretting> {
    let (from, to) = Periods::of_contact(job, c, outcome.state.time())?.last();
    let path = contact_path(job, c, &outcome.kept.series).part((from, to));
    if !path.is_closed() {
        return None;
    }
    let cycle = match Cycle::of_loop(&path.x, &path.y) {
        Ok(cycle) => cycle,
        Err(error) => {
            notes.push(format!("{name}: no fretting quantities: {error}"));
            return None;
        }
    };
    let normal = mean_over_time(&outcome.kept.series, name, (from, to));
    let d = outcome.kept.series.column(name, "d_m").first().copied().unwrap_or(0.0);
    let thresholds = thresholds(law.profile(), d).filter(|_| job.has_law_without_time(c));
    let regime = thresholds.map(|thresholds| word(thresholds.regime(&cycle)));
    Some(Fretting {
        cycle: [Real(from), Real(to)],
        displacement_amplitude: Real(cycle.displacement_amplitude),
        force_amplitude: Real(cycle.force_amplitude),
        half_opening: cycle.half_opening.map(Real),
        dissipated: Real(cycle.dissipated),
        energy_ratio: cycle.energy_ratio().map(Real),
        system_free_ratio: cycle.system_free_ratio().map(Real),
        slip_ratio: cycle.slip_ratio().map(Real),
        energy_coefficient_of_friction: normal.and_then(|n| cycle.friction_coefficient(n)).map(Real),
        stiffness_after_maximum: cycle.stiffness_after_maximum.map(Real),
        stiffness_after_minimum: cycle.stiffness_after_minimum.map(Real),
        regime,
    })
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

/// Mean normal force, N, by the trapezium rule between the samples inside the cycle.
fn mean_over_time(series: &Series, name: &str, (from, to): (f64, f64)) -> Option<f64> {
    let (t, normal) = (series.time(), series.column(name, "fn_N"));
    let inside: Vec<(f64, f64)> =
        t.iter().copied().zip(normal.iter().copied()).filter(|(t, _)| (from..=to).contains(t)).collect();
    let area: f64 = inside.windows(2).map(|w| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0)).sum();
    let time = inside.last()?.0 - inside.first()?.0;
    if time > 0.0 { Some(area / time) } else { inside.first().map(|first| first.1) }
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
    fn a_bouncing_contact_is_open_between_its_events() {
        use stickslip_drive::Channel;
        let channels =
            ["time_s", "foot.d_m", "foot.fn_N"].map(|n| Channel { name: n.to_owned(), is_state: false });
        let mut series = Series::new(&channels, &[]);
        assert_eq!(normal_motion(&series, "foot"), None);
        // Falls, touches at 2, rests until 3, lifts off, flies until 8, touches.
        let rows =
            [[0.0, -1.0, 0.0], [2.0, 1e-20, 0.0], [2.5, 3.0, 7.0], [3.0, -1e-20, 0.0], [5.0, -9.0, 0.0]];
        rows.iter().chain(&[[8.0, 1e-20, 0.0], [10.0, 2.0, 4.0]]).for_each(|row| series.push(row));
        let pair = |a: f64, b: f64| [Real(a), Real(b)];
        let open_share = Real(0.7);
        let wanted = NormalMotion { force: pair(0.0, 7.0), indentation: pair(-9.0, 3.0), open_share };
        assert_eq!(normal_motion(&series, "foot"), Some(wanted));
    }

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
