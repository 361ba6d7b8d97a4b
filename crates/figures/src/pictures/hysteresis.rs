//! Plot of the hysteresis loops of the contacts.

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
    shows: "tangential force over displacement, in newtons and relative to μF_N and u_c; the last period is bold, earlier periods are pale",
    needs: |job| of_contacts(job, &["u_m", "d_m", "fx_N"]),
    draw,
};

/// Curve of the plot.
struct Curve {
    name: String,
    path: Trail,
    gross_slip: Option<f64>,
    limit: Option<f64>,
    /// Palette index.
    place: usize,
    /// Whether the curve is an earlier period, drawn pale in the background.
    is_pale: bool,
}

/// Relative tolerance for the end of a period.
const SAME: f64 = 1e-9;
/// Line width of the last period and of earlier periods.
const BOLD: f64 = 1.15;
const FINE: f64 = 0.9;

/// Draws the tangential force over displacement. The last period is bold; earlier periods are pale in the background.
///
/// A contact whose displacement returns to its start in each period shows the whole run. For a travelling contact the
/// displacement counts from the start of the period. If it is the only contact, its first period is in the
/// background. Contacts with equal loops are drawn as one curve.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let (job, kept) = (sources.job, sources.kept);
    let contacts: Vec<&str> = job.model.contacts().map(|(name, _)| name).collect();
    let columns = contacts.iter().map(|name| ["u_m", "fx_N"].map(|q| kept.series.column(name, q)).to_vec());
    let groups = alike::groups(&columns.collect::<Vec<_>>());
    let of_group =
        |(place, group): (usize, &Vec<usize>)| curves(job, kept, group, (place, groups.len() == 1));
    let mut curves: Vec<Curve> = groups.iter().enumerate().flat_map(of_group).collect();
    // Background curves are drawn first.
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
        // The panel of normalised loops leaves out contacts without limits. Its series give the index of their curve.
        let place = if let Some(Ink::Palette(curve)) = series.style.ink { curve } else { place };
        let Some(curve) = curves.get(place) else { continue };
        let (ink, width) =
            if curve.is_pale { (Ink::Pale(curve.place), FINE) } else { (Ink::Palette(curve.place), BOLD) };
        (series.style.ink, series.style.width, series.directed) = (Some(ink), width, !curve.is_pale);
    }
    Ok(pen.draw(PlotName::Loop, figure)?)
}

/// Returns the curves of a group of equal contacts.
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
            // With several contacts each has one legend entry, without those of earlier periods.
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
    // Later turning points are missing.
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

/// Returns the points of a path inside the output window. Without events, the path between the window and the ends of the run is unknown.
fn windowed(path: &Trail, [from, to]: [f64; 2]) -> Trail {
    // The rows are rounded differently from the window.
    let hair = SAME * (to - from);
    path.within([from - hair, to + hair])
}

/// Returns the periods up to the last one that the points cover completely; `None` without such a period.
fn seen(path: &Trail, periods: Periods) -> Option<Periods> {
    let up_to = |count: usize| Periods { count, ..periods };
    (1..=periods.count).rev().map(up_to).find(|periods| covers(path, periods.last()))
}

/// Returns whether the points of a path cover a time range.
fn covers(path: &Trail, (from, to): (f64, f64)) -> bool {
    let hair = SAME * (to - from);
    let ends = path.t.first().zip(path.t.last());
    ends.is_some_and(|(first, last)| *first <= from + hair && *last >= to - hair)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An output window without events in the second period: only completely covered periods are used.
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
        // The first and the last row of the run must not make a gap count as covered.
        let mut rows = trail(12, 14);
        for column in [&mut rows.t, &mut rows.x, &mut rows.y] {
            column.insert(0, 0.0);
        }
        rows.push(3.0, 0.0, 0.0);
        assert_eq!(windowed(&rows, [1.2, 1.4]), trail(12, 14));
    }
}
