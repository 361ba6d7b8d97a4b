//! Hysteresis loops of the contacts.

use super::{Kind, Sources, Undrawn, alike, of_contacts, whole_title};
use crate::look::{Pen, Picture};
use stickslip_plot::{HysteresisLoop, Ink, loop_figure};
use stickslip_run::Job;
use stickslip_run::Kept;
use stickslip_run::Periods;
use stickslip_run::Trail;
use stickslip_run::contact_path;
use stickslip_scenario::PlotName;

pub(super) const KIND: Kind = Kind {
    shows: "tangential force over displacement, in newtons and as shares of μF_N and u_c; the last period bold, those before it pale",
    needs: |job| of_contacts(job, &["u_m", "d_m", "fx_N"]),
    draw,
};

/// A curve in the figure of loops.
struct Curve {
    name: String,
    path: Trail,
    gross_slip: Option<f64>,
    limit: Option<f64>,
    /// Place of its colour.
    place: usize,
    /// Came before what is to be seen, and stands behind it.
    is_pale: bool,
}

/// A point this near to the end of a period, in periods, is the end.
const SAME: f64 = 1e-9;
/// Width of what is to be seen, and of what came before.
const BOLD: f64 = 1.15;
const FINE: f64 = 0.9;

/// Force over displacement. The last period is to be seen; the ones before it stand behind, pale. Of a contact that comes back to its
/// start in every cycle that is all the way. One that travels on, as in a drive, would smear its loops over the picture: if it is
/// the only contact, the first period stands behind; u counts from the start of the period. Contacts whose loops nobody
/// could tell apart are one curve.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let (job, kept) = (sources.job, sources.kept);
    let contacts: Vec<&str> = job.model.contacts().map(|(name, _)| name).collect();
    let columns = contacts.iter().map(|name| ["u_m", "fx_N"].map(|q| kept.series.column(name, q)).to_vec());
    let groups = alike::groups(&columns.collect::<Vec<_>>());
    let of_group =
        |(place, group): (usize, &Vec<usize>)| curves(job, kept, group, (place, groups.len() == 1));
    let mut curves: Vec<Curve> = groups.iter().enumerate().flat_map(of_group).collect();
    // What stands behind is drawn first.
    curves.sort_by_key(|curve| !curve.is_pale);
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
    let title = whole_title(job, kept);
    let mut figure = loop_figure(&title, &loops);
    for (place, series) in figure.panels.iter_mut().flat_map(|panel| panel.series.iter_mut().enumerate()) {
        // The panel of normalised loops leaves out those without limits; its series say whose they are.
        let place = if let Some(Ink::Palette(curve)) = series.style.ink { curve } else { place };
        let Some(curve) = curves.get(place) else { continue };
        let (ink, width) =
            if curve.is_pale { (Ink::Pale(curve.place), FINE) } else { (Ink::Palette(curve.place), BOLD) };
        (series.style.ink, series.style.width, series.directed) = (Some(ink), width, !curve.is_pale);
    }
    Ok(pen.draw(PlotName::Loop, figure)?)
}

/// The curves of contacts that are alike.
fn curves(job: &Job, kept: &Kept, group: &[usize], (place, is_alone): (usize, bool)) -> Vec<Curve> {
    let named = |c: &usize| {
        let (name, _) = job.model.contacts().nth(*c)?;
        let count = job.count(*c);
        Some(if count > 1 { format!("{name} × {count}") } else { name.to_owned() })
    };
    let names: Vec<String> = group.iter().filter_map(named).collect();
    let Some((c, (_, law))) = group.first().and_then(|&c| Some((c, job.model.contacts().nth(c)?))) else {
        return Vec::new();
    };
    let name = alike::name(&names.iter().map(String::as_str).collect::<Vec<_>>());
    let scale = job.model.contact_scale(c).filter(|_| job.has_constant_load(c));
    let curve = |words: &str, path: Trail, is_pale: bool| Curve {
        name: match (is_alone && group.len() == 1, words) {
            (_, "") => name.clone(),
            (true, words) => words.to_owned(),
            // Of several contacts each is named once: twice as many names would be cut, and pale tells what came before.
            (false, words) if is_alone => format!("{name}, {words}"),
            (false, _) if is_pale => String::new(),
            (false, _) => name.clone(),
        },
        path,
        gross_slip: scale.map(|(u_c, _)| u_c),
        limit: scale.map(|(_, normal)| f64::from(job.count(c)) * law.friction() * normal),
        place,
        is_pale,
    };
    // Beyond, turning points are missing.
    let end = kept.whole_until();
    let path = contact_path(job, c, &kept.series);
    let path = if end < kept.end() { path.part((f64::NEG_INFINITY, end)) } else { path };
    let written = &job.scenario.written;
    let path = if written.has_all_events() { path } else { windowed(&path, written.window) };
    let periods = Periods::of_contact(job, c, end).and_then(|periods| seen(&path, periods));
    let Some(periods) = periods else { return vec![curve("", path, false)] };
    let last = path.part(periods.last());
    let words = format!("period {}", periods.count);
    match (last.is_closed(), periods.count > 1) {
        (true, true) => vec![curve("before", path, true), curve(&words, last, false)],
        (true, false) => vec![curve("", path, false)],
        (false, true) => {
            let first = (is_alone && covers(&path, periods.first()))
                .then(|| curve("first period", path.part(periods.first()).counted_from_start(), true));
            first.into_iter().chain([curve(&words, last.counted_from_start(), false)]).collect()
        }
        (false, false) => vec![curve("first period", last.counted_from_start(), false)],
    }
}

/// The points of a window: between them and the rows at both ends of the run nothing is known without events.
fn windowed(path: &Trail, [from, to]: [f64; 2]) -> Trail {
    // Rows are rounded apart from the window.
    let hair = SAME * (to - from);
    path.within([from - hair, to + hair])
}

/// The periods up to the last of which there are points from its start to its end; none where there is no such period.
fn seen(path: &Trail, periods: Periods) -> Option<Periods> {
    let up_to = |count: usize| Periods { count, ..periods };
    (1..=periods.count).rev().map(up_to).find(|periods| covers(path, periods.last()))
}

/// Whether there are points of a path from one time to another.
fn covers(path: &Trail, (from, to): (f64, f64)) -> bool {
    let hair = SAME * (to - from);
    let ends = path.t.first().zip(path.t.last());
    ends.is_some_and(|(first, last)| *first <= from + hair && *last >= to - hair)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A window in the second period without events: u at the start of that period was read off a line from the first row of the run,
    /// and taken off all that was drawn.
    #[test]
    fn a_period_is_drawn_where_it_was_seen_whole() {
        let trail = |from: u32, to: u32| {
            let mut trail = Trail::default();
            (from..=to).for_each(|k| trail.push(0.1 * f64::from(k), f64::from(k), 0.0));
            trail
        };
        let periods = Periods { start: 0.0, length: 1.0, count: 3 };
        let count = |path: &Trail| seen(path, periods).map(|periods| periods.count);
        assert_eq!(
            [trail(0, 30), trail(5, 25), trail(12, 14)].map(|path| count(&path)),
            [Some(3), Some(2), None]
        );
        // With the rows at both ends of the run a gap would count as seen.
        let mut rows = trail(12, 14);
        for column in [&mut rows.t, &mut rows.x, &mut rows.y] {
            column.insert(0, 0.0);
        }
        rows.push(3.0, 0.0, 0.0);
        assert_eq!(windowed(&rows, [1.2, 1.4]), trail(12, 14));
    }
}
