//! Plot of events over time.

use super::period::LastPeriod;
use super::{Kind, Sources, Undrawn, whole_title};
use crate::look::{Pen, Picture};
use std::collections::HashMap;
use stickslip_plot::{EventTrack, enlarged_below, events_figure};
use stickslip_run::Track;
use stickslip_scenario::PlotName;

pub(super) const KIND: Kind =
    Kind { shows: "events over time; for many periods also the last one", needs: |_| Vec::new(), draw };

/// Draws one lane per kind of event of each contact and waveform, contacts first.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let (job, kept) = (sources.job, sources.kept);
    let contacts = job.model.contacts().map(|(name, _)| name);
    let waveforms = job.scenario.scene.waveforms.iter().map(|waveform| waveform.name.as_str());
    let sources: HashMap<&str, usize> = contacts.chain(waveforms).zip(0..).collect();
    let mut tracks: Vec<&Track> = kept.tracks.iter().flat_map(|tracks| tracks.all()).collect();
    tracks.sort_by_key(|track| sources.get(track.source.as_str()));
    let tracks = tracks.into_iter().map(|Track { source, kind, times }| EventTrack {
        source,
        kind,
        times: times.clone(),
    });
    let tracks: Vec<EventTrack<'_>> = tracks.collect();
    let [from, to] = job.scenario.written.window;
    let start = kept.series.time().first().copied().unwrap_or(0.0).max(from);
    // Later events are thinned, so the plot ends where they are complete.
    let (title, end) = (whole_title(job, kept), kept.whole_until().min(to));
    let figure = events_figure(&title, (start, end), &tracks);
    let Some(LastPeriod { number, span }) = LastPeriod::of_many(job, kept) else {
        return Ok(pen.draw(PlotName::Events, figure)?);
    };
    let words = format!("period {number} (shaded above)");
    let figure = enlarged_below(figure, events_figure("", span, &tracks), span, &words);
    Ok(pen.draw(PlotName::Events, figure)?)
}
