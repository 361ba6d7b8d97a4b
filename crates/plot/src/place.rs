//! Frames and scales of the panels: frames of one figure are aligned and share what the labels leave.

use crate::figure::{Arrangement, Panel, PlotError};
use crate::layout::{Area, Placed, Sizes};
use crate::legend::Legend;
use crate::range::{Extent, extents};
use crate::scale::{Along, Scale};

/// A panel to be placed.
pub(crate) struct Request<'f, 'a> {
    pub(crate) panel: &'f Panel<'a>,
    pub(crate) legend: Legend,
}

/// Share of the data range left free at both ends of an axis.
const MARGIN: f64 = 0.04;
/// A frame smaller than this, em of the tick labels, shows nothing.
const LEAST_FRAME: f64 = 3.0;
/// Heights of a line of tick labels and of an axis label, em.
const TICK_LINE: f64 = 1.45;
const LABEL_LINE: f64 = 1.4;
/// Between two panels, em of the tick labels.
const GAP: f64 = 0.8;

/// Places panels in a row or a column of the body.
pub(crate) fn panels<'f, 'a>(
    requests: Vec<Request<'f, 'a>>,
    (arrangement, shares): (Arrangement, Vec<f64>),
    sizes: Sizes,
    body: Area,
) -> Result<Vec<Placed<'f, 'a>>, PlotError> {
    let mut placer = Placer {
        placed: with_scales(requests, arrangement),
        row: arrangement == Arrangement::Row,
        shares,
        sizes,
        body,
    };
    placer.set_heights()?;
    placer.set_widths()?;
    placer.set_legends()?;
    let placed = placer.placed;
    for (panel, place) in placed.iter().enumerate() {
        let Area { width, height, .. } = place.frame;
        if width.min(height) < LEAST_FRAME * sizes.tick {
            return Err(PlotError::NoRoom { panel, width, height });
        }
    }
    Ok(placed)
}

fn with_scales<'f, 'a>(requests: Vec<Request<'f, 'a>>, arrangement: Arrangement) -> Vec<Placed<'f, 'a>> {
    let share_x = arrangement == Arrangement::Column { share_x: true };
    let extents: Vec<(Extent, Extent)> = requests.iter().map(|request| extents(request.panel)).collect();
    let shared = extents.iter().fold(Extent::default(), |union, (x, _)| union.union(*x));
    let last = requests.len().saturating_sub(1);
    let margin = |tight: bool| if tight { 0.0 } else { MARGIN };
    let place = |(i, (Request { panel, legend }, (x, y))): (usize, (Request<'f, 'a>, (Extent, Extent)))| {
        let x = if share_x { shared } else { x };
        Placed {
            panel,
            frame: Area::default(),
            cell: Area::default(),
            x: Scale::new(&panel.x, x.range(margin(panel.x.tight))),
            y: Scale::new(&panel.y, y.range(margin(panel.y.tight))),
            numbers_left: 0.0,
            legend: (legend, (0.0, 0.0)),
            numbered: !share_x || i == last,
            empty: panel.series.iter().all(|series| series.points().flatten().next().is_none()),
        }
    };
    requests.into_iter().zip(extents).enumerate().map(place).collect()
}

/// The panels on their way to their places.
struct Placer<'f, 'a> {
    placed: Vec<Placed<'f, 'a>>,
    /// Side by side; else one above the other.
    row: bool,
    shares: Vec<f64>,
    sizes: Sizes,
    body: Area,
}

impl Placer<'_, '_> {
    /// Tops and heights of frames and cells, ticks of the y axes.
    fn set_heights(&mut self) -> Result<(), PlotError> {
        let (sizes, body, gap) = (self.sizes, self.body, self.gap());
        let mut above: Vec<f64> = self.placed.iter().map(|place| above(place, sizes)).collect();
        let mut below: Vec<f64> = self.placed.iter().map(|place| below(place, sizes)).collect();
        if self.row {
            level(&mut above);
            level(&mut below);
        }
        let gaps = gap * (self.placed.len() as f64 - 1.0);
        let free = body.height - above.iter().sum::<f64>() - below.iter().sum::<f64>() - gaps;
        let mut top = body.top;
        for (i, place) in self.placed.iter_mut().enumerate() {
            let height = if self.row { body.height - above[i] - below[i] } else { free * self.shares[i] };
            (place.frame.top, place.frame.height) = ((top + above[i]).round(), height.floor());
            (place.cell.top, place.cell.height) = (top, above[i] + height + below[i]);
            if !self.row {
                top += place.cell.height + gap;
            }
            place.y.set_ticks(Along::Height(place.frame.height), sizes.tick)?;
        }
        Ok(())
    }

    /// Left edges and widths of frames and cells, ticks of the x axes.
    fn set_widths(&mut self) -> Result<(), PlotError> {
        let sizes = self.sizes;
        let numbers = self.numbers()?;
        let label = |place: &Placed<'_, '_>| {
            if place.y.label.is_empty() && place.y.unit.is_empty() { 0.0 } else { LABEL_LINE }
        };
        let mut left: Vec<f64> =
            self.placed.iter().zip(&numbers).map(|(p, n)| n + label(p) * sizes.label).collect();
        let mut right = vec![0.2 * sizes.tick; left.len()];
        // Numbers that stand out beyond the ends of an axis need room, which narrows the frames and moves the
        // ticks: the second round settles it but for a fraction of a digit.
        for _ in 0..3 {
            if !self.row {
                level(&mut left);
                level(&mut right);
            }
            self.assign_widths(&left, &right);
            for (i, place) in self.placed.iter_mut().enumerate() {
                fit_aspect(place, sizes)?;
                place.x.set_ticks(Along::Width(place.frame.width), sizes.tick)?;
                let beyond = place.x.overhang(place.frame.width, sizes.tick)?;
                left[i] = left[i].max(beyond.0);
                right[i] = right[i].max(beyond.1);
            }
        }
        for (place, numbers) in self.placed.iter_mut().zip(numbers) {
            place.numbers_left = place.frame.left - numbers;
        }
        Ok(())
    }

    fn assign_widths(&mut self, left: &[f64], right: &[f64]) {
        let (body, gap) = (self.body, self.gap());
        let gaps = gap * (self.placed.len() as f64 - 1.0);
        let free = body.width - left.iter().sum::<f64>() - right.iter().sum::<f64>() - gaps;
        let mut start = body.left;
        for (i, place) in self.placed.iter_mut().enumerate() {
            let width = if self.row { free * self.shares[i] } else { body.width - left[i] - right[i] };
            (place.frame.left, place.frame.width) = ((start + left[i]).round(), width.floor());
            (place.cell.left, place.cell.width) = (start, left[i] + width + right[i]);
            if self.row {
                start += place.cell.width + gap;
            }
        }
    }

    /// Legends above their frames, moved left where they are wider than that.
    fn set_legends(&mut self) -> Result<(), PlotError> {
        for place in &mut self.placed {
            let (frame, cell) = (place.frame, place.cell);
            let end = cell.left + cell.width - place.legend.0.width(self.sizes.tick)?;
            let left = frame.left.min(end).max(self.body.left);
            place.legend.1 = (left, frame.top - above(place, self.sizes));
        }
        Ok(())
    }

    /// Width of the numbers and ticks left of each frame, px; one for all in a column, to align the labels.
    fn numbers(&self) -> Result<Vec<f64>, PlotError> {
        let (tick, mark) = (self.sizes.tick, self.sizes.mark);
        let width = |place: &Placed<'_, '_>| Ok(mark + 0.4 * tick + place.y.label_width(tick)?);
        let mut widths = self.placed.iter().map(width).collect::<Result<Vec<f64>, PlotError>>()?;
        if !self.row {
            level(&mut widths);
        }
        Ok(widths)
    }

    fn gap(&self) -> f64 {
        GAP * self.sizes.tick
    }
}

/// Shrinks the frame to its aspect, centred in its place.
fn fit_aspect(place: &mut Placed<'_, '_>, sizes: Sizes) -> Result<(), PlotError> {
    let Some(aspect) = place.panel.aspect.filter(|aspect| *aspect > 0.0 && aspect.is_finite()) else {
        return Ok(());
    };
    let frame = &mut place.frame;
    let (width, height) =
        (frame.width.min(frame.height * aspect).floor(), frame.height.min(frame.width / aspect).floor());
    frame.left += ((frame.width - width) / 2.0).round();
    frame.top += ((frame.height - height) / 2.0).round();
    (frame.width, frame.height) = (width, height);
    place.y.set_ticks(Along::Height(height), sizes.tick)
}

/// Height of what stands below a frame, px.
fn below(place: &Placed<'_, '_>, sizes: Sizes) -> f64 {
    if !place.numbered {
        // The ticks, or half a number of the y axis.
        return 0.4 * sizes.tick;
    }
    let bare = place.x.label.is_empty() && place.x.unit.is_empty();
    sizes.mark + TICK_LINE * sizes.tick + if bare { 0.0 } else { LABEL_LINE * sizes.label }
}

/// Height of what stands above a frame, px: its own legend with a gap, or half a number of the y axis.
fn above(place: &Placed<'_, '_>, sizes: Sizes) -> f64 {
    let height = place.legend.0.height(sizes.tick);
    if height > 0.0 { height + 0.4 * sizes.tick } else { 0.4 * sizes.tick }
}

/// Raises every value to the largest.
fn level(values: &mut [f64]) {
    let most = values.iter().copied().fold(0.0, f64::max);
    values.fill(most);
}
