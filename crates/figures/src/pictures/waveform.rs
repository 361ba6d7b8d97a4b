//! Plot of the waveforms of a scenario, computed from their definitions.

use super::{Kind, Sources, Undrawn};
use crate::look::{Pen, Picture};
use stickslip_drive::scene::Varying;
use stickslip_drive::{Piece, Waveform};
use stickslip_plot::{WaveformCourse, waveform_figure};
use stickslip_scenario::{Piezo, PlotName};

pub(super) const KIND: Kind = Kind {
    shows: "waveforms and their rates over two periods, or from start to end; corners are dots",
    needs: |_| Vec::new(),
    draw,
};

/// Maximum number of waveforms.
const MOST: usize = 12;
/// Number of points per curved piece, and per oscillation in it.
const POINTS: f64 = 60.0;
/// Maximum number of points per piece, and maximum number of pieces.
const MOST_POINTS: f64 = 20_000.0;
const MOST_PIECES: usize = 20_000;
/// Number of corners above which corners are not marked.
const MANY_CORNERS: usize = 100;
/// Margin before and after a non-periodic waveform, as a fraction of its duration.
const MARGIN: f64 = 0.1;

fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let job = sources.job;
    let scene = &job.scenario.scene;
    let stacks = &job.scenario.stacks;
    let drawn: Vec<Drawn> = scene
        .waveforms
        .iter()
        .enumerate()
        .take(MOST)
        .map(|(place, waveform)| {
            let drawn = Drawn::of(&waveform.part, span(&waveform.part, job.scenario.plan.duration));
            match volt(stacks, place) {
                Some(volt) => drawn.in_units_of(volt),
                None => drawn,
            }
        })
        .collect();
    let courses: Vec<WaveformCourse<'_>> = scene
        .waveforms
        .iter()
        .zip(&drawn)
        .enumerate()
        .map(|(place, (waveform, drawn))| WaveformCourse {
            name: &waveform.name,
            unit: if volt(stacks, place).is_some() { "V" } else { scene.waveform_unit(place) },
            time: &drawn.time,
            value: &drawn.value,
            rate: &drawn.rate,
            corners: &drawn.corners,
            corner_values: &drawn.corner_values,
        })
        .collect();
    Ok(pen.draw(PlotName::Waveform, waveform_figure(job.title(), &courses))?)
}

/// Returns the time range in s: two periods, or from start to end with a margin, or the whole run.
fn span(waveform: &Waveform, duration: f64) -> (f64, f64) {
    let (start, end) = waveform.window();
    match waveform.period() {
        Some(period) => (start, (start + 2.0 * period).min(end + MARGIN * period)),
        None if end > start && end.is_finite() => {
            (start - MARGIN * (end - start), end + MARGIN * (end - start))
        }
        None => (0.0, duration.max(2.0 * end)),
    }
}

/// Returns the free stroke per volt, m, if stacks follow the waveform as their voltage; `None` otherwise.
fn volt(stacks: &[Piezo], place: usize) -> Option<f64> {
    let followed = |piezo: &&Piezo| piezo.by_voltage && piezo.command == Varying::Follows(place);
    stacks.iter().find(followed)?.stack.stroke_per_volt
}

/// Points of a waveform.
#[derive(Debug, Default, PartialEq)]
struct Drawn {
    time: Vec<f64>,
    value: Vec<f64>,
    rate: Vec<f64>,
    corners: Vec<f64>,
    corner_values: Vec<f64>,
}

impl Drawn {
    /// Computes the points: ends of straight pieces, and enough points to resolve curved ones.
    fn of(waveform: &Waveform, (from, to): (f64, f64)) -> Self {
        let mut drawn = Self::default();
        let mut piece = waveform.piece_at(from);
        for _ in 0..MOST_PIECES {
            let end = piece.end.min(to);
            drawn.piece(waveform, &piece, (piece.start.max(from), end));
            if piece.end >= to {
                break;
            }
            drawn.corners.push(piece.end);
            drawn.corner_values.push(waveform.sample(&piece, piece.end).value);
            piece = waveform.after(&piece);
        }
        if drawn.corners.len() > MANY_CORNERS {
            (drawn.corners, drawn.corner_values) = (Vec::new(), Vec::new());
        }
        drawn
    }

    /// Divides the values by a unit.
    fn in_units_of(mut self, unit: f64) -> Self {
        let Self { value, rate, corner_values, .. } = &mut self;
        value.iter_mut().chain(rate).chain(corner_values).for_each(|number| *number /= unit);
        self
    }

    fn piece(&mut self, waveform: &Waveform, piece: &Piece, (from, to): (f64, f64)) {
        // A sine may have zero acceleration at both ends and in the middle.
        let straight = [0.0, 0.137, 0.59, 1.0]
            .iter()
            .all(|part| waveform.sample(piece, from + part * (to - from)).acceleration == 0.0);
        let waves = (to - from) / (4.0 * waveform.resolution());
        let points = if straight { 1.0 } else { (POINTS * waves.max(1.0)).min(MOST_POINTS) }.ceil();
        for k in 0..=points as u32 {
            // The last point is exactly the end.
            let t = if f64::from(k) < points { from + (to - from) * (f64::from(k) / points) } else { to };
            let sample = waveform.sample(piece, t);
            self.time.push(t);
            self.value.push(sample.value);
            self.rate.push(sample.rate);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_drive::{Shape, Timing};

    #[test]
    fn straight_pieces_are_two_points_and_curved_ones_many() {
        let saw = Waveform::new(Shape::Sawtooth { stroke: 1.0, flyback: 0.25 }, Timing::every(1.0)).unwrap();
        let drawn = Drawn::of(&saw, span(&saw, 9.0));
        assert_eq!(drawn.time, [0.0, 0.75, 0.75, 1.0, 1.0, 1.75, 1.75, 2.0]);
        assert_eq!(drawn.value, [0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0]);
        assert_eq!((drawn.corners, drawn.corner_values), (vec![0.75, 1.0, 1.75], vec![1.0, 0.0, 1.0]));
        let parabola = Waveform::new(Shape::Parabola { stroke: 1.0, turn: 0.0 }, Timing::every(1.0)).unwrap();
        let drawn = Drawn::of(&parabola, span(&parabola, 9.0));
        assert!(drawn.time.len() > 200 && drawn.value.iter().all(|value| (0.0..=1.0).contains(value)));
        let sine = Shape::Sine { amplitude: 1.0, phase: 0.0, offset: 0.0 };
        let sine = Waveform::new(sine, Timing::every(1.0)).unwrap();
        // Two oscillations in one piece.
        assert!(Drawn::of(&sine, span(&sine, 9.0)).time.len() > 100);
        // Stack with 20 nm/V.
        let volts = Drawn::of(&saw, span(&saw, 9.0)).in_units_of(2e-8);
        assert!((volts.value[1] - 5e7).abs() < 1.0 && (volts.rate[7] + 2e8).abs() < 1.0);
        // A step is shown with its values before and after it.
        let step = Waveform::new(Shape::Step { height: 2.0, at: 3.0 }, Timing::every(1.0)).unwrap();
        let drawn = Drawn::of(&step, span(&step, 9.0));
        assert_eq!((drawn.time, drawn.value), (vec![0.0, 3.0, 3.0, 9.0], vec![0.0, 0.0, 2.0, 2.0]));
    }
}
