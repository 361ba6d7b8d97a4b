//! Default output of scenarios without `output` or `plots`: rows for a plot, loops and trajectories.

use super::Meaning;
use crate::form::{Form, PlotForm};
use crate::plot_name::PlotName;
use crate::quantity::Time;
use stickslip_drive::scene::Freedom;

/// Number of rows per shortest period, and minimum and maximum number of rows of a run.
const ROWS_IN_PERIOD: f64 = 200.0;
const ROWS: (f64, f64) = (1000.0, 20_000.0);

/// Fills in `output.every` of a scenario without `output`, and the default plots of a scenario without `plots`. `has` returns whether the
/// file has a key. Returns whether anything was filled in.
pub(crate) fn fill(form: &mut Form, meaning: &Meaning, has: impl Fn(&str) -> bool) -> bool {
    let (blank, undrawn) = (!has("output"), !has("plots"));
    if blank {
        form.output.every = Some(Time::new(interval(meaning)));
    }
    if undrawn {
        let scene = &meaning.scene;
        let is_free = scene.bodies.iter().any(|body| body.part.x.freedom == Freedom::Free);
        let plots = [(!scene.contacts.is_empty(), PlotName::Loop), (is_free, PlotName::Trajectory)];
        form.plots =
            plots.into_iter().filter(|(shows, _)| *shows).map(|(_, name)| PlotForm::Named(name)).collect();
    }
    blank || undrawn
}

/// Returns an interval of 1, 2 or 5 times a power of ten seconds. The interval resolves the shortest period within the limits of the
/// number of rows.
fn interval(meaning: &Meaning) -> f64 {
    let duration = meaning.plan.duration;
    let periods = meaning.scene.waveforms.iter().filter_map(|waveform| waveform.part.period());
    let shortest = periods.fold(duration, f64::min);
    let rows = (ROWS_IN_PERIOD * duration / shortest).clamp(ROWS.0, ROWS.1);
    round_up(duration / rows)
}

/// Returns the next value of 1, 2 or 5 times a power of ten that is not smaller.
fn round_up(value: f64) -> f64 {
    let exponent = math::log10(value).floor() as i32;
    let candidates = [(1, exponent), (2, exponent), (5, exponent), (1, exponent + 1)];
    // Parsing a decimal number gives the value to the last bit.
    let read =
        candidates.into_iter().filter_map(|(digit, exponent)| format!("{digit}e{exponent}").parse().ok());
    read.filter(|candidate| *candidate >= value).fold(f64::INFINITY, f64::min).min(value * 10.0)
}

#[cfg(test)]
mod tests {
    use super::round_up;

    #[test]
    fn intervals_are_rounded_up_to_1_2_and_5() {
        let pairs = [(1e-6, 1e-6), (1.01e-6, 2e-6), (3e-3, 5e-3), (7.5, 10.0), (0.02, 0.02), (1.0, 1.0)];
        pairs.into_iter().for_each(|(value, wanted)| assert_eq!(round_up(value), wanted));
    }
}
