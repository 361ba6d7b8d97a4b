//! Bursts and sequences: a periodic waveform with rests.

use super::range;
use crate::fault::Fault;
use crate::form::{BurstForm, Periodic, SectionForm};
use crate::path::At;
use stickslip_drive::{Section, Shape};

/// Maximum number of cycles of all runs in a sequence.
const MOST_CYCLES: u64 = 10_000;
/// Maximum number of entries of a sequence, which are runs of cycles or rests.
const MOST_SECTIONS: usize = 1000;

/// Returns the runs and rests of a waveform with this period, s, or `None` if the waveform has no rests.
pub(super) fn sections(at: &At<'_>, form: &Periodic, period: f64) -> Result<Option<Vec<Section>>, Fault> {
    match (&form.burst, &form.sequence) {
        (None, None) => Ok(None),
        (Some(burst), None) => of_burst(&at.key("burst"), *burst, (at, period)).map(Some),
        (None, Some(list)) => of_sequence(&at.key("sequence"), list).map(Some),
        (Some(_), Some(_)) => {
            let fault =
                at.key("burst").fault("the sequence already determines when the waveform runs").on_key();
            Err(fault.against_path(at.key("sequence").path()).help("keep one of them"))
        }
    }
}

/// Returns the waveform of a shape with runs and rests. Shapes with a limited rate, and reversed shapes with jumps, are refused.
pub(super) fn of(at: &At<'_>, shape: Shape, parts: Vec<Section>) -> Result<Shape, Fault> {
    if let Shape::Limited { .. } = shape {
        let fault = at.key("rate").fault("a limited rate would extend into the rests").on_key();
        return Err(fault
            .help("give the flyback instead of the rate, or remove the burst or sequence")
            .against_path(at.path()));
    }
    let back = parts.iter().any(|part| matches!(part, Section::Run { reversed: true, .. }));
    let jumps = match shape {
        Shape::Sawtooth { flyback, .. } => flyback == 0.0,
        Shape::Trapezoid { rise, fall, .. } => rise == 0.0 || fall == 0.0,
        _ => false,
    };
    if back && jumps {
        let fault = at.key("sequence").fault("a waveform that jumps cannot be reversed");
        let help = "give it a short flyback: two jumps at the same time cancel";
        return Err(fault.help(help).against_path(at.path()));
    }
    Ok(Shape::Pattern { carrier: Box::new(shape), parts })
}

fn of_burst(at: &At<'_>, form: BurstForm, (waveform, period): (&At<'_>, f64)) -> Result<Vec<Section>, Fault> {
    let cycles = range::count_between(&at.key("cycles"), form.cycles.0, 1, MOST_CYCLES)?;
    let busy = cycles as f64 * period;
    let rest = match (form.period, form.dwell) {
        (None, Some(dwell)) => range::above_zero(&at.key("dwell"), dwell)?,
        (Some(whole), None) => {
            let rest = range::above_zero(&at.key("period"), whole)? - busy;
            // A difference of the order of rounding errors means no rest.
            if rest.abs() <= 1e-12 * busy { 0.0 } else { rest }
        }
        (None, None) => {
            let fault = at.missing("period").against_path(at.key("dwell").path());
            return Err(
                fault.help("a burst has a period, from start to start, or a dwell between two bursts")
            );
        }
        (Some(_), Some(_)) => {
            let fault = at.key("dwell").fault("the period of the burst already determines it").on_key();
            return Err(fault.help("keep one of them"));
        }
    };
    if rest < 0.0 {
        let busy = range::short(busy);
        let fault =
            at.key("period").expected(format_args!("a time of at least its {cycles} cycles, {busy} s"));
        let paths = ["period", "frequency"].map(|key| waveform.key(key).path());
        return Err(paths.into_iter().fold(fault, Fault::against_path));
    }
    let run = Section::Run { cycles: cycles as u32, reversed: false };
    Ok(if rest > 0.0 { vec![run, Section::Rest { duration: rest }] } else { vec![run] })
}

fn of_sequence(at: &At<'_>, list: &[SectionForm]) -> Result<Vec<Section>, Fault> {
    if list.len() > MOST_SECTIONS {
        return Err(at.fault(format!("expected at most {MOST_SECTIONS} runs and rests, got {}", list.len())));
    }
    let mut cycles = 0;
    let mut sections = Vec::with_capacity(list.len());
    for (i, section) in list.iter().enumerate() {
        let here = at.index(i);
        sections.push(match (section.cycles, section.dwell) {
            (Some(count), None) => {
                let count = range::count_between(&here.key("cycles"), count.0, 1, MOST_CYCLES)?;
                cycles += count;
                Section::Run { cycles: count as u32, reversed: section.reversed }
            }
            (None, Some(dwell)) if !section.reversed => {
                Section::Rest { duration: range::above_zero(&here.key("dwell"), dwell)? }
            }
            (None, Some(_)) => {
                let fault = here.key("reversed").fault("a rest has no direction").on_key();
                return Err(fault.help("leave it out"));
            }
            (None, None) => {
                let fault = here.missing("cycles").against_path(here.key("dwell").path());
                return Err(fault.help("a sequence has runs with \"cycles\" and rests with \"dwell\""));
            }
            (Some(_), Some(_)) => {
                let fault = here.key("dwell").fault("this entry is already a run").on_key();
                return Err(fault.help("write the rest as a separate entry after it"));
            }
        });
    }
    if cycles == 0 {
        return Err(at.fault("expected a run of at least one cycle").help("such as {\"cycles\": 10}"));
    }
    if cycles > MOST_CYCLES {
        let message = format!("expected at most {MOST_CYCLES} cycles in all runs, got {cycles}");
        return Err(at.fault(message).help("a sequence repeats automatically"));
    }
    Ok(sections)
}
