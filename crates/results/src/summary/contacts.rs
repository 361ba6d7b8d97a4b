//! Contacts, and the quantities of their last cycle.

use super::fretting::{self, Fretting, JudgedCycle};
use crate::job::Job;
use crate::outcome::Outcome;
use crate::parts::Parts;
use crate::real::Real;
use crate::series::Series;
use serde::Serialize;
use stickslip_contact::Interface;
use stickslip_drive::NaturalScale;

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
    similarity: SimilaritySummary,
    /// Quantities of the last whole cycle; none where there is none, or where it does not come back to its start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fretting: Option<Fretting>,
    /// All cycles that come back along u; in a table of their own.
    #[serde(skip)]
    pub cycles: Vec<JudgedCycle>,
}

/// How far the theory holds for the two bodies.
#[derive(Debug, Serialize)]
struct SimilaritySummary {
    /// Dundurs' β; 0 for elastically similar bodies.
    dundurs_beta: Real,
    /// By how much of itself the normal stiffness at a given contact radius is too low if nothing slips.
    neglected_stiffness: Real,
    /// What that means, in words.
    means: String,
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

/// All contacts.
pub(super) fn of(job: &Job, outcome: &Outcome) -> Parts<ContactSummary> {
    let contacts = job.model.contacts().enumerate();
    Parts(contacts.map(|(c, (name, law))| (name.to_owned(), contact(job, outcome, (c, name, law)))).collect())
}

fn contact(job: &Job, outcome: &Outcome, (c, name, law): (usize, &str, &Interface)) -> ContactSummary {
    let (gross_slip, normal) = job.contact_scale(c);
    let load = |normal: f64| Load { normal: Real(normal), limit: Real(law.friction() * normal) };
    let series = &outcome.kept.series;
    let peak = |quantity| Real(series.column(name, quantity).iter().fold(0.0, |peak, f| f.abs().max(peak)));
    let count = job.count(c);
    let (cycles, thresholds) = fretting::judged(job, outcome, (c, law));
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
        similarity: SimilaritySummary::of(law),
        fretting: Fretting::of(&cycles, thresholds),
        cycles,
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
}
