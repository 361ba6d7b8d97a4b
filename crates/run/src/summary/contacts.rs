//! Contacts, and the quantities of their last cycle.

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

/// A contact. Forces and work are those of all identical contacts together unless they say otherwise.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ContactSummary {
    /// number of identical contacts
    count: u32,
    /// u_c = μE*d/G* at t = 0: the displacement at which the last spring of a first loading slips
    #[serde(rename = "gross_slip_displacement_m")]
    gross_slip_displacement: Real,
    /// What the stepper's tolerance is relative to.
    scales: Scales,
    /// Loads of one contact at t = 0.
    one: Load,
    /// Loads of all of them.
    all: Load,
    /// largest |F_x| of all count contacts at rows, events and ends of periods; of a damped contact, or under a load that
    /// varies, its peak may lie between them
    #[serde(rename = "peak_fx_N")]
    peak_tangential: Real,
    /// largest F_N of all of them during the run
    #[serde(rename = "peak_fn_N")]
    peak_normal: Real,
    /// Of a coupled contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    normal: Option<NormalMotion>,
    /// friction work of all count contacts during the run
    #[serde(rename = "friction_J")]
    friction: Real,
    similarity: SimilaritySummary,
    /// Quantities of the last whole cycle; none where there is none, or where it does not come back to its start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fretting: Option<Fretting>,
}

/// How far the theory holds for the two bodies.
#[derive(Debug, Serialize, JsonSchema)]
struct SimilaritySummary {
    /// β = [(1-2ν₁)/G₁ - (1-2ν₂)/G₂] / [2(1-ν₁)/G₁ + 2(1-ν₂)/G₂]; 0 of similar bodies
    dundurs_beta: Real,
    /// artanh(β)/β - 1, by how much of itself the normal stiffness is too low at most
    neglected_stiffness: Real,
    /// both in words
    #[serde(rename = "text")]
    means: String,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Load {
    /// F_N at t = 0: of one contact, or of all count of them
    #[serde(rename = "normal_force_N")]
    normal: Real,
    /// μF_N at t = 0, of the same
    #[serde(rename = "limit_force_N")]
    limit: Real,
}

/// Natural scales at the deepest indentation that the scenario names.
#[derive(Debug, Serialize, JsonSchema)]
struct Scales {
    /// the length that the stepper's tolerance is relative to: u_c of the largest load known
    #[serde(rename = "displacement_m")]
    displacement: Real,
    /// the force that it is relative to: μF_N of that load, of all count contacts
    #[serde(rename = "force_N")]
    force: Real,
    /// the velocity that both make with the mass that moves
    #[serde(rename = "velocity_m_s")]
    velocity: Real,
}

/// What the bodies' motion does to a contact along the normal, over all rows and events.
#[derive(Debug, PartialEq, Serialize, JsonSchema)]
struct NormalMotion {
    /// smallest and largest F_N of a coupled contact
    #[serde(rename = "fn_N")]
    force: [Real; 2],
    /// smallest and largest d of it
    #[serde(rename = "d_m")]
    indentation: [Real; 2],
    /// share of the time in which it is open
    open_share: Real,
}

/// All contacts.
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
    /// None without rows.
    fn of(tally: &ContactTally) -> Option<Self> {
        let [force, indentation] = tally.ranges.map(|range| range.map(Real));
        Some(Self { force, indentation, open_share: Real(tally.open_share()?) })
    }
}
