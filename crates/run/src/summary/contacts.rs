//! Results of the contacts, including those of their last cycle.

use super::fretting::Fretting;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::parts::Parts;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_contact::Interface;
use stickslip_drive::NaturalScale;
use stickslip_measure::tally::ContactTally;
use stickslip_quantity::Real;

/// Results of a contact. Forces and work are totals of all identical contacts, except in `one`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ContactSummary {
    /// number of identical contacts
    count: u32,
    /// u_c, gross slip displacement at t = 0: `u_c = μE*d/G*`. At this displacement the last spring begins to slip in a
    /// first loading.
    #[serde(rename = "gross_slip_displacement_m")]
    gross_slip_displacement: Real,
    /// Natural scales, to which the tolerance is relative.
    scales: Scales,
    /// Loads of one contact at t = 0.
    one: Load,
    /// Loads of all identical contacts at t = 0.
    all: Load,
    /// largest |F_x| of rows, events and period ends, total of all identical contacts. With contact damping or a
    /// varying normal force, the true peak may lie between them and be larger.
    #[serde(rename = "peak_fx_N")]
    peak_tangential: Real,
    /// largest F_N of rows, events and period ends, total of all identical contacts
    #[serde(rename = "peak_fn_N")]
    peak_normal: Real,
    /// Motion along the normal. Absent unless the contact is coupled.
    #[serde(skip_serializing_if = "Option::is_none")]
    normal: Option<NormalMotion>,
    /// friction work of the run, total of all identical contacts
    #[serde(rename = "friction_J")]
    friction: Real,
    /// time since which the contact has neither slipped grossly nor been open. Absent if it does so at the end of the
    /// run, or never did.
    #[serde(rename = "at_rest_since_s", skip_serializing_if = "Option::is_none")]
    pub at_rest_since: Option<Real>,
    similarity: SimilaritySummary,
    /// Hysteresis loop of the last whole cycle. Absent if u does not return to its start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fretting: Option<Fretting>,
}

/// Elastic similarity of the two bodies.
#[derive(Debug, Serialize, JsonSchema)]
struct SimilaritySummary {
    /// β, Dundurs' constant: `β = [(1-2ν₁)/G₁ - (1-2ν₂)/G₂] / [2(1-ν₁)/G₁ + 2(1-ν₂)/G₂]`. 0 for elastically similar
    /// bodies.
    dundurs_beta: Real,
    /// largest relative amount by which the normal stiffness is too low, because the coupling of normal and tangential
    /// contact is neglected: artanh(β)/β - 1
    neglected_stiffness: Real,
    /// sentence about dundurs_beta and neglected_stiffness
    #[serde(rename = "text")]
    means: String,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Load {
    /// F_N, normal force at t = 0. `one`: of one contact, `all`: total of all identical contacts.
    #[serde(rename = "normal_force_N")]
    normal: Real,
    /// friction limit μF_N at t = 0. `one`: of one contact, `all`: total of all identical contacts.
    #[serde(rename = "limit_force_N")]
    limit: Real,
}

/// Natural scales at the largest indentation that the scenario defines.
#[derive(Debug, Serialize, JsonSchema)]
struct Scales {
    /// natural scale of displacements, to which the tolerance is relative: u_c at the largest load that the scenario
    /// defines
    #[serde(rename = "displacement_m")]
    displacement: Real,
    /// natural scale of forces, to which the tolerance is relative: μF_N at the largest load that the scenario defines,
    /// total of all identical contacts
    #[serde(rename = "force_N")]
    force: Real,
    /// natural scale of velocities, to which the tolerance is relative. It follows from the scales of displacement and
    /// force and from the moving mass.
    #[serde(rename = "velocity_m_s")]
    velocity: Real,
}

/// Ranges of a coupled contact along the normal, over all rows and events.
#[derive(Debug, PartialEq, Serialize, JsonSchema)]
struct NormalMotion {
    /// smallest and largest F_N of a coupled contact, at rows and events
    #[serde(rename = "fn_N")]
    force: [Real; 2],
    /// smallest and largest indentation d of a coupled contact, at rows and events
    #[serde(rename = "d_m")]
    indentation: [Real; 2],
    /// fraction of the time in which a coupled contact is open
    open_share: Real,
}

/// Returns the results of all contacts.
pub(super) fn of(job: &Job, outcome: &Outcome) -> Parts<ContactSummary> {
    let contacts = job.model.contacts().enumerate();
    Parts(contacts.map(|(c, (name, law))| (name.to_owned(), contact(job, outcome, (c, law)))).collect())
}

fn contact(job: &Job, outcome: &Outcome, (c, law): (usize, &Interface)) -> ContactSummary {
    let (gross_slip, normal) = job.contact_scale(c);
    let load = |normal: f64| Load { normal: Real(normal), limit: Real(law.friction() * normal) };
    let tally = outcome.tally.contact(c);
    let [tangential, normal_peak] = tally.map_or([0.0; 2], |tally| tally.peaks).map(Real);
    let count = job.count(c);
    ContactSummary {
        count,
        gross_slip_displacement: Real(gross_slip),
        scales: scales(job, c),
        one: load(normal),
        all: load(f64::from(count) * normal),
        peak_tangential: tangential,
        peak_normal: normal_peak,
        normal: tally.filter(|_| job.is_coupled(c)).and_then(NormalMotion::of),
        friction: Real(outcome.books.friction_of(c)),
        at_rest_since: tally.and_then(|tally| tally.at_rest_since).map(Real),
        similarity: SimilaritySummary::of(law),
        fretting: outcome.cycles.get(c).and_then(|cycles| Fretting::of(cycles, job.is_damped(c))),
    }
}

impl SimilaritySummary {
    fn of(law: &Interface) -> Self {
        let similarity = law.pair().similarity();
        Self {
            dundurs_beta: Real(similarity.dundurs_beta()),
            neglected_stiffness: Real(similarity.neglected_stiffness()),
            means: similarity.to_string(),
        }
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

impl NormalMotion {
    /// Returns the ranges of normal force and indentation, or `None` if the run has no rows.
    fn of(tally: &ContactTally) -> Option<Self> {
        let [force, indentation] = tally.ranges.map(|range| range.map(Real));
        Some(Self { force, indentation, open_share: Real(tally.open_share()?) })
    }
}
