//! Plot of voltage, current, positions and contact forces over the last two periods.

use super::layout::gravity;
use super::trajectory::tracks;
use super::{Kind, Sources, Undrawn, alike};
use crate::look::{Pen, Picture};
use stickslip_drive::scene::{Axis, Varying};
use stickslip_plot::{DriveCourse, Supply, Track, drive_figure};
use stickslip_run::{Job, Kept, Periods, Series};
use stickslip_scenario::{Piezo, PlotName};

pub(super) const KIND: Kind = Kind {
    shows: "voltage, current, motion and contact forces over the last two periods; active driver limits are shaded",
    needs,
    draw,
};

/// Number of periods shown.
const PERIODS: usize = 2;
/// Relative tolerance within which a value is at a limit.
const AT_LIMIT: f64 = 1e-6;

fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let (job, kept) = (sources.job, sources.kept);
    let (span, words) = span(job, kept);
    let series = kept.series.part(span).counted_from_start(&["x_m"]);
    let strokes = strokes(job, &series);
    let (feet, bodies) = tracks(job, &series, Axis::X);
    let strokes = strokes.iter().map(|(name, values)| Track { name, values });
    let contacts: Vec<&str> = job.model.contacts().map(|(name, _)| name).collect();
    let forces: Vec<Vec<&[f64]>> = contacts.iter().map(|name| vec![series.column(name, "fx_N")]).collect();
    let groups = alike::groups(&forces);
    let named = |group: &Vec<usize>| alike::name(&group.iter().map(|&c| contacts[c]).collect::<Vec<_>>());
    let names: Vec<String> = groups.iter().map(named).collect();
    let forces = groups.iter().zip(&names).map(|(group, name)| Track { name, values: forces[group[0]][0] });
    let course = DriveCourse {
        time: series.time(),
        supplies: supplies(job, &series),
        feet: strokes.chain(feet).collect(),
        bodies,
        forces: forces.collect(),
        limit: limit(job),
        is_upright: gravity(&job.scenario.scene).is_some_and(|gravity| gravity.is_upright()),
    };
    let title = format!("{}{words}", job.title());
    Ok(pen.draw(PlotName::Drive, drive_figure(&title, &course))?)
}

/// Returns the time range of the last two complete periods, or of the whole run without periods; and a text for the title.
fn span(job: &Job, kept: &Kept) -> ((f64, f64), String) {
    let waveform = job.scenario.figures.waveform.and_then(|w| job.scenario.scene.waveforms.get(w));
    let periods = waveform.and_then(|waveform| Periods::until(&waveform.part, kept.end()));
    match periods {
        Some(periods) if periods.count > PERIODS => {
            let first = periods.count - PERIODS;
            let span = (periods.end_of(first), periods.end_of(periods.count));
            (span, format!(", periods {} and {}", first + 1, first + 2))
        }
        _ => ((0.0, kept.end()), String::new()),
    }
}

/// Returns the free strokes that follow a waveform, relative to the start of the range. Stacks with a driver are left out.
fn strokes(job: &Job, series: &Series) -> Vec<(String, Vec<f64>)> {
    let scene = &job.scenario.scene;
    let of = |(k, piezo): (usize, &Piezo)| {
        // With a driver the stroke does not follow a waveform.
        let Some(Varying::Follows(signal)) = scene.actuators.get(k).map(|it| it.part.stroke) else {
            return None;
        };
        let waveform = &scene.waveforms.get(signal)?.part;
        let at = |t: &f64| waveform.sample(&waveform.piece_at(*t), *t).value;
        let start = series.time().first().map_or(0.0, at);
        let values = series.time().iter().map(|t| at(t) - start).collect();
        Some((format!("{} (free stroke)", piezo.name), values))
    };
    job.scenario.stacks.iter().enumerate().filter_map(of).collect()
}

/// Returns the drivers of the stacks.
fn supplies<'a>(job: &'a Job, series: &'a Series) -> Vec<Supply<'a>> {
    let of = |piezo: &'a Piezo| {
        let (driver, _) = (piezo.driver?, piezo.block?);
        let voltage = series.column(&piezo.name, "voltage_V");
        let current = series.column(&piezo.name, "current_A");
        let time = series.time();
        let command = command(job, piezo, time);
        let limited = driver.current.map_or_else(Vec::new, |(sink, source)| {
            spans(time, |i| {
                let current = current.get(i).copied().unwrap_or(0.0);
                current >= source * (1.0 - AT_LIMIT) || current <= -sink * (1.0 - AT_LIMIT)
            })
        });
        let cut = driver.window.map_or_else(Vec::new, |(low, high)| {
            let hair = AT_LIMIT * (high - low);
            spans(time, |i| command.get(i).is_some_and(|volts| *volts < low - hair || *volts > high + hair))
        });
        Some(Supply { name: &piezo.name, command, voltage, current, cut, limited })
    };
    job.scenario.stacks.iter().filter_map(of).collect()
}

/// Returns the commanded voltage, V; empty if the voltage does not follow a waveform.
fn command(job: &Job, piezo: &Piezo, time: &[f64]) -> Vec<f64> {
    let (Varying::Follows(w), Some(gain)) = (piezo.command, piezo.stack.stroke_per_volt) else {
        return Vec::new();
    };
    let Some(waveform) = job.scenario.scene.waveforms.get(w) else { return Vec::new() };
    let at = |t: &f64| waveform.part.sample(&waveform.part.piece_at(*t), *t).value / gain;
    time.iter().map(at).collect()
}

/// Returns the time ranges in which a condition holds at all samples.
fn spans(time: &[f64], is: impl Fn(usize) -> bool) -> Vec<(f64, f64)> {
    let mut spans: Vec<(f64, f64)> = Vec::new();
    for i in 1..time.len() {
        if !(is(i - 1) && is(i)) {
            continue;
        }
        match spans.last_mut() {
            Some((_, to)) if *to == time[i - 1] => *to = time[i],
            _ => spans.push((time[i - 1], time[i])),
        }
    }
    spans
}

/// Returns the friction limit of the only contact, N; `None` unless its load is constant.
fn limit(job: &Job) -> Option<f64> {
    let is_only = job.model.contacts().count() == 1 && job.has_constant_load(0);
    let count = f64::from(job.scenario.scene.contacts.first()?.part.count);
    job.model.contact_natural(0).filter(|_| is_only).map(|natural| count * natural.force)
}

/// Returns the columns that the plot requires.
fn needs(job: &Job) -> Vec<String> {
    let drivers = job.scenario.stacks.iter().filter(|piezo| piezo.block.is_some() && piezo.driver.is_some());
    let supplies =
        drivers.flat_map(|piezo| ["voltage_V", "current_A"].map(|it| format!("{}.{it}", piezo.name)));
    let moving = super::trajectory::needs(job).into_iter().filter(|name| name.ends_with(".x_m"));
    supplies.chain(moving).chain(super::of_contacts(job, &["fx_N"])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_moments_make_a_span() {
        let time = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let at = [true, true, false, true, true, true];
        assert_eq!(spans(&time, |i| at[i]), [(0.0, 1.0), (3.0, 5.0)]);
    }
}
