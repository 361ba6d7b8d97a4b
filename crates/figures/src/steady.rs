//! Plot of a periodic orbit.

use crate::look::{Look, Pen, Picture};
use crate::pictures::{FigureError, alike, trajectory::tracks_of};
use stickslip_drive::scene::Axis;
use stickslip_plot::{OrbitCourse, Track, orbit_figure};
use stickslip_run::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_run::{Job, Series};
use stickslip_study::steady::Steady;

/// Name of the plot.
pub const NAME: &str = "steady";
/// Number of rows of the period that is drawn.
pub const ROWS: u32 = 1024;
/// Forces below this fraction of the normal force are rounding errors.
const ROUNDING: f64 = 1e-12;

/// Returns all possible file names of the plot.
pub fn all_files() -> Vec<String> {
    Look::all_files_of(&[NAME])
}

/// Draws one period of a periodic orbit and its Floquet multipliers.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn draw(job: &Job, found: &Steady, series: &Series, look: &Look) -> Result<Vec<Picture>, FigureError> {
    let entries = [
        (TITLE, job.title().to_owned()),
        (PROGRAM, job.program.clone()),
        (HASH, job.hash.clone()),
        (SCENARIO, job.resolved.clone()),
    ];
    let provenance = entries.map(|(key, text)| (key.to_owned(), text)).to_vec();
    let pen = Pen { look, provenance, kept: None };
    let start = series.time().first().copied().unwrap_or(0.0);
    let time: Vec<f64> = series.time().iter().map(|t| t - start).collect();
    let (feet, sliders) = tracks_of(job, series, (Axis::X, "x_m"));
    let (_, speeds) = tracks_of(job, series, (Axis::X, "vx_m_s"));
    let [feet, sliders] = [feet, sliders].map(|tracks| returning(&time, &tracks));
    let contacts: Vec<&str> = job.model.contacts().map(|(name, _)| name).collect();
    let forces: Vec<Vec<f64>> =
        contacts.iter().enumerate().map(|(c, name)| force(job, series, (c, name))).collect();
    let forces: Vec<Vec<&[f64]>> = forces.iter().map(|force| vec![force.as_slice()]).collect();
    let groups = alike::groups(&forces);
    let named = |group: &Vec<usize>| alike::name(&group.iter().map(|&c| contacts[c]).collect::<Vec<_>>());
    let names: Vec<String> = groups.iter().map(named).collect();
    let forces = groups.iter().zip(&names).map(|(group, name)| Track { name, values: forces[group[0]][0] });
    let both = found.multipliers.iter().flat_map(|multiplier| {
        let pair = (multiplier.im != 0.0).then_some((multiplier.re, -multiplier.im));
        [Some((multiplier.re, multiplier.im)), pair].into_iter().flatten()
    });
    let course = OrbitCourse {
        time: &time,
        feet: feet.iter().map(|(name, values)| Track { name, values }).collect(),
        sliders: sliders.iter().map(|(name, values)| Track { name, values }).collect(),
        speeds,
        forces: forces.collect(),
        multipliers: both.collect(),
    };
    let title = format!("{}: one period of the periodic orbit", job.title());
    pen.draw_as(NAME, orbit_figure(&title, &course))
        .map_err(|source| FigureError::Plot { plot: NAME, source })
}

/// Returns the tangential force of a contact; zeros if the force is within rounding errors.
fn force(job: &Job, series: &Series, (c, name): (usize, &str)) -> Vec<f64> {
    let force = series.column(name, "fx_N");
    let least = ROUNDING * job.contact_scale(c).1;
    let is_some = force.iter().any(|force| force.abs() > least);
    if is_some { force.to_vec() } else { vec![0.0; force.len()] }
}

/// Returns the positions relative to their start, without the drift over the period.
fn returning<'a>(time: &[f64], tracks: &[Track<'a>]) -> Vec<(&'a str, Vec<f64>)> {
    let length = time.last().copied().unwrap_or(0.0);
    let of = |track: &Track<'a>| {
        let first = track.values.first().copied().unwrap_or(0.0);
        let way = track.values.last().copied().unwrap_or(first) - first;
        let drift = if length > 0.0 { way / length } else { 0.0 };
        let values = track.values.iter().zip(time).map(|(x, t)| x - first - drift * t);
        (track.name, values.collect())
    };
    tracks.iter().map(of).collect()
}
