//! Hysteresis loops of the contacts.

use super::{Kind, Sources, Undrawn, of_contacts};
use crate::look::{Pen, Picture};
use stickslip_plot::{HysteresisLoop, Ink, loop_figure};
use stickslip_results::Job;
use stickslip_results::Kept;
use stickslip_results::Periods;
use stickslip_results::Trail;
use stickslip_results::contact_path;
use stickslip_scenario::PlotName;

pub(super) const KIND: Kind = Kind {
    shows: "tangential force over displacement, in newtons and as shares of μF_N and u_c",
    needs: |job| of_contacts(job, &["u_m", "d_m", "fx_N"]),
    draw,
};

/// A curve in the figure of loops.
struct Curve {
    name: String,
    path: Trail,
    gross_slip: Option<f64>,
    limit: Option<f64>,
    /// Stands behind the others.
    is_muted: bool,
}

/// Force over displacement. A contact that comes back to its start in every cycle is shown all the way. One that
/// travels on, as in a drive, would smear its loops over the picture: of it the last period is shown, and behind it,
/// if it is the only contact, the first in grey; u counts from the start of the period.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let (job, kept) = (sources.job, sources.kept);
    let curves: Vec<Curve> = (0..job.model.contacts().count()).flat_map(|c| curves(job, kept, c)).collect();
    let loops: Vec<HysteresisLoop<'_>> = curves
        .iter()
        .map(|curve| HysteresisLoop {
            name: &curve.name,
            u: &curve.path.x,
            force: &curve.path.y,
            gross_slip: curve.gross_slip,
            limit: curve.limit,
        })
        .collect();
    let mut figure = loop_figure(job.title(), &loops);
    let inks = inks(&curves);
    for (place, series) in figure.panels.iter_mut().flat_map(|panel| panel.series.iter_mut().enumerate()) {
        // The panel of normalised loops leaves out those without limits; its series say whose they are.
        let place = if let Some(Ink::Palette(curve)) = series.style.ink { curve } else { place };
        series.style.ink = inks.get(place).copied();
    }
    Ok(pen.draw(PlotName::Loop, figure)?)
}

/// Grey for what stands behind, the palette for the others.
fn inks(curves: &[Curve]) -> Vec<Ink> {
    let mut place = 0;
    let ink = |curve: &Curve| {
        if curve.is_muted {
            return Ink::Muted;
        }
        place += 1;
        Ink::Palette(place - 1)
    };
    curves.iter().map(ink).collect()
}

fn curves(job: &Job, kept: &Kept, c: usize) -> Vec<Curve> {
    let Some((name, law)) = job.model.contacts().nth(c) else { return Vec::new() };
    let count = job.count(c);
    let is_alone = job.model.contacts().count() == 1;
    let name = if count > 1 { format!("{name} × {count}") } else { name.to_owned() };
    let scale = job.model.contact_scale(c).filter(|_| job.has_constant_load(c));
    let curve = |words: &str, path: Trail, is_muted: bool| Curve {
        name: match (is_alone, words) {
            (_, "") => name.clone(),
            (true, words) => words.to_owned(),
            (false, words) => format!("{name}, {words}"),
        },
        path,
        gross_slip: scale.map(|(u_c, _)| u_c),
        limit: scale.map(|(_, normal)| f64::from(count) * law.friction() * normal),
        is_muted,
    };
    // Beyond, turning points are missing.
    let end = kept.whole_until();
    let path = contact_path(job, c, &kept.series);
    let path = if end < kept.end() { path.part((f64::NEG_INFINITY, end)) } else { path };
    let Some(periods) = Periods::of_contact(job, c, end) else { return vec![curve("", path, false)] };
    let last = path.part(periods.last());
    if last.is_closed() {
        return vec![curve("", path, false)];
    }
    let mut curves = Vec::new();
    if periods.count > 1 && is_alone {
        curves.push(curve("first period", path.part(periods.first()).counted_from_start(), true));
    }
    let words =
        if periods.count > 1 { format!("period {}", periods.count) } else { "first period".to_owned() };
    curves.push(curve(&words, last.counted_from_start(), false));
    curves
}
