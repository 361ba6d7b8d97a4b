//! Positions and scales of panels. Frames are aligned and share the area that the labels leave.

use crate::PlotError;
use crate::beside::Beside;
use crate::figure::{Arrangement, Figure};
use crate::label::Label;
use crate::lanes::Names;
use crate::layout::{Area, Placed, Sizes};
use crate::legend::Legend;
use crate::panel::{Axis, Panel};
use crate::range::{Extent, extents};
use crate::scale::{Along, Scale};

/// Panel to be placed.
pub(crate) struct Request<'f, 'a> {
    pub(crate) panel: &'f Panel<'a>,
    /// Lines of its heading.
    pub(crate) heading: Vec<Label>,
    pub(crate) legend: Legend,
}

/// Margin at both ends of an axis, as a fraction of the data range.
const MARGIN: f64 = 0.04;
/// Minimum size of a frame and minimum height of a lane, em of the tick labels.
const LEAST_FRAME: f64 = 3.0;
const LEAST_LANE: f64 = 1.5;
/// Heights of a line of tick labels and of an axis label, em.
pub(crate) const TICK_LINE: f64 = 1.45;
pub(crate) const LABEL_LINE: f64 = 1.4;
/// Height of a heading line, em of the tick labels.
pub(crate) const HEADING_LINE: f64 = 1.35;
/// Gap between two panels, and between a lane and its note, em of the tick labels.
const GAP: f64 = 0.8;
pub(crate) const NOTE_GAP: f64 = 0.5;
/// Maximum width of lane names, as a fraction of the figure's width.
const LANE_NAMES: f64 = 0.3;

/// Places panels in rows and columns of the body.
pub(crate) fn panels<'f, 'a>(
    requests: Vec<Request<'f, 'a>>,
    figure: &Figure<'_>,
    sizes: Sizes,
    body: Area,
) -> Result<Vec<Placed<'f, 'a>>, PlotError> {
    let (wide, high) = figure.shares();
    let placed = with_scales(requests, figure.arrangement);
    let mut placer = Placer { placed, wide, high, sizes, body };
    placer.set_heights()?;
    placer.set_widths()?;
    placer.set_legends()?;
    let placed = placer.placed;
    for (panel, place) in placed.iter().enumerate() {
        let Area { width, height, .. } = place.frame;
        // The height of a lane must fit its name.
        let lanes = placed[panel].panel.lanes.len();
        let least = if lanes > 0 { (lanes as f64 * LEAST_LANE).min(LEAST_FRAME) } else { LEAST_FRAME };
        if width < LEAST_FRAME * sizes.tick || height < least * sizes.tick {
            return Err(PlotError::NoRoom { panel, width, height });
        }
    }
    Ok(placed)
}

fn with_scales<'f, 'a>(requests: Vec<Request<'f, 'a>>, arrangement: Arrangement) -> Vec<Placed<'f, 'a>> {
    let (share_x, share_y) = match arrangement {
        Arrangement::Row => (false, false),
        Arrangement::Column { share_x } => (share_x, false),
        Arrangement::Grid { share, .. } => (share, share),
        Arrangement::Columns { .. } => (true, false),
    };
    let columns = arrangement.columns(requests.len());
    // Panels with a common x axis: every `group`-th one.
    let group = if matches!(arrangement, Arrangement::Columns { .. }) { columns } else { 1 };
    let last_row = requests.len().saturating_sub(columns);
    let extents: Vec<(Extent, Extent)> = requests.iter().map(|request| extents(request.panel)).collect();
    let none = (Extent::default(), Extent::default());
    let of = |place: usize| {
        let group = extents.iter().skip(place % group).step_by(group);
        group.fold(none, |all, (x, y)| (all.0.union(*x), all.1.union(*y)))
    };
    let all: Vec<(Extent, Extent)> = (0..group).map(of).collect();
    let margin = |tight: bool| if tight { 0.0 } else { MARGIN };
    let place = |(i, (request, (x, y))): (usize, (Request<'f, 'a>, (Extent, Extent)))| {
        let (panel, all) = (request.panel, all[i % group]);
        let (x, y) = (if share_x { all.0 } else { x }, if share_y { all.1 } else { y });
        let scale = |axis: &Axis, extent: Extent| {
            let is_nothing = extent.is_nothing() && !axis.logarithmic;
            Scale::new(axis, extent.range(margin(axis.tight))).of_nothing(is_nothing)
        };
        let (x, y) = (scale(&panel.x, x), scale(&panel.y, y));
        Placed {
            panel,
            frame: Area::default(),
            cell: Area::default(),
            beside: Beside::new((panel.top.as_ref(), panel.right.as_ref()), (&x, &y)),
            x,
            y,
            names: Names::default(),
            numbers_left: 0.0,
            heading: (request.heading, (0.0, 0.0)),
            legend: (request.legend, (0.0, 0.0)),
            notes: Vec::new(),
            lost: 0,
            numbered: (!share_x || i >= last_row, !share_y || i % columns == 0),
            empty: panel.is_empty(),
        }
    };
    requests.into_iter().zip(extents.clone()).enumerate().map(place).collect()
}

/// Panels during placement.
struct Placer<'f, 'a> {
    placed: Vec<Placed<'f, 'a>>,
    /// Fraction of the width of each column.
    wide: Vec<f64>,
    /// Fraction of the height of each row.
    high: Vec<f64>,
    sizes: Sizes,
    body: Area,
}

impl Placer<'_, '_> {
    /// Sets tops and heights of frames and cells, and the ticks of the y axes.
    fn set_heights(&mut self) -> Result<(), PlotError> {
        let (sizes, body, columns) = (self.sizes, self.body, self.wide.len());
        let row = |i: usize| i / columns;
        let above = most(self.high.len(), row, self.placed.iter().map(|place| above(place, sizes)));
        let below = most(self.high.len(), row, self.placed.iter().map(|place| below(place, sizes)));
        let gap = GAP * sizes.tick;
        let taken = gap * (self.high.len() as f64 - 1.0) + sum(&above) + sum(&below);
        let mut top = body.top;
        for (row, places) in self.placed.chunks_mut(columns).enumerate() {
            let height = (body.height - taken) * self.high[row];
            for place in places {
                (place.frame.top, place.frame.height) = ((top + above[row]).round(), height.floor());
                (place.cell.top, place.cell.height) = (top, above[row] + height + below[row]);
                set_y_ticks(place, sizes, body.width)?;
            }
            top += above[row] + height + below[row] + gap;
        }
        Ok(())
    }

    /// Sets left edges and widths of frames and cells, and the ticks of the x axes.
    fn set_widths(&mut self) -> Result<(), PlotError> {
        let (sizes, columns) = (self.sizes, self.wide.len());
        let column = |i: usize| i % columns;
        let numbers = self.placed.iter().map(|place| numbers(place, sizes)).collect::<Result<Vec<_>, _>>()?;
        let numbers = most(columns, column, numbers.into_iter());
        let labels = most(columns, column, self.placed.iter().map(|place| label_width(place, sizes)));
        let mut left: Vec<f64> = numbers.iter().zip(labels).map(|(numbers, label)| numbers + label).collect();
        let notes = self.placed.iter().map(|place| notes(place, sizes)).collect::<Result<Vec<_>, _>>()?;
        let mut right = most(columns, column, notes.into_iter());
        // Numbers beyond the ends of an axis need room, which narrows the frames and changes the ticks. The iteration converges quickly.
        for _ in 0..3 {
            self.assign_widths(&left, &right);
            for (i, place) in self.placed.iter_mut().enumerate() {
                fit_aspect(place, sizes)?;
                place.x.set_ticks(Along::Width(place.frame.width), sizes.tick)?;
                place.beside.set_top_ticks(place.frame.width, sizes.tick)?;
                let beyond = place.x.overhang(place.frame.width, sizes.tick)?;
                left[column(i)] = left[column(i)].max(beyond.0);
                right[column(i)] = right[column(i)].max(beyond.1);
            }
        }
        for (i, place) in self.placed.iter_mut().enumerate() {
            place.numbers_left = place.frame.left - numbers[column(i)];
        }
        Ok(())
    }

    fn assign_widths(&mut self, left: &[f64], right: &[f64]) {
        let (body, gap, columns) = (self.body, GAP * self.sizes.tick, self.wide.len());
        let free = body.width - sum(left) - sum(right) - gap * (columns as f64 - 1.0);
        let mut start = body.left;
        for column in 0..columns {
            let width = free * self.wide[column];
            for place in self.placed.iter_mut().skip(column).step_by(columns) {
                (place.frame.left, place.frame.width) = ((start + left[column]).round(), width.floor());
                (place.cell.left, place.cell.width) = (start, left[column] + width + right[column]);
            }
            start += left[column] + width + right[column] + gap;
        }
    }

    /// Sets the positions of headings and legends above the frames. Legends wider than their frame start further left.
    fn set_legends(&mut self) -> Result<(), PlotError> {
        for place in &mut self.placed {
            let (frame, cell) = (place.frame, place.cell);
            let end = cell.left + cell.width - place.legend.0.width(self.sizes.tick)?;
            let left = frame.left.min(end).max(self.body.left);
            let top = frame.top - above(place, self.sizes);
            place.heading.1 = (frame.left, top);
            place.legend.1 = (left, top + heading_height(place, self.sizes));
        }
        Ok(())
    }
}

/// Sets the ticks of the y axis, or the names of the lanes.
fn set_y_ticks(place: &mut Placed<'_, '_>, sizes: Sizes, width: f64) -> Result<(), PlotError> {
    if place.panel.lanes.is_empty() {
        place.beside.set_right_ticks(place.frame.height, sizes.tick)?;
        return place.y.set_ticks(Along::Height(place.frame.height), sizes.tick);
    }
    let lane = (LANE_NAMES * width, place.frame.height / place.panel.lanes.len() as f64);
    place.names = Names::new(&place.panel.lanes, lane, sizes.tick)?;
    Ok(())
}

/// Shrinks the frame to its aspect ratio, centred in the available area.
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
    set_y_ticks(place, sizes, place.cell.width)
}

/// Returns the width of numbers and ticks left of a frame, px.
fn numbers(place: &Placed<'_, '_>, sizes: Sizes) -> Result<f64, PlotError> {
    if !place.numbered.1 {
        return Ok(sizes.mark);
    }
    let width = place.y.label_width(sizes.tick)?.max(place.names.width()?);
    Ok(sizes.mark + 0.4 * sizes.tick + width)
}

/// Returns the width of the label of the y axis, px.
fn label_width(place: &Placed<'_, '_>, sizes: Sizes) -> f64 {
    let bare = place.y.label.is_empty() && place.y.unit.is_empty();
    if bare || !place.numbered.1 { 0.0 } else { LABEL_LINE * sizes.label }
}

/// Returns the width of the notes or the second axis right of a frame, px, with a small minimum.
fn notes(place: &Placed<'_, '_>, sizes: Sizes) -> Result<f64, PlotError> {
    let least = place.beside.width(sizes)?.max(0.2 * sizes.tick);
    place.panel.lanes.iter().try_fold(least, |most: f64, lane| {
        let width = Label::plain(&lane.note).width(place.names.em)?;
        Ok(most.max(if width > 0.0 { width + NOTE_GAP * sizes.tick } else { 0.0 }))
    })
}

/// Returns the height of the labels below a frame, px.
fn below(place: &Placed<'_, '_>, sizes: Sizes) -> f64 {
    if !place.numbered.0 {
        // Room for the ticks, or for half a number of the y axis.
        return 0.4 * sizes.tick;
    }
    let bare = place.x.label.is_empty() && place.x.unit.is_empty();
    sizes.mark + TICK_LINE * sizes.tick + if bare { 0.0 } else { LABEL_LINE * sizes.label }
}

/// Returns the height above a frame, px: heading, legend, second axis, and a gap for half a number of the y axis.
fn above(place: &Placed<'_, '_>, sizes: Sizes) -> f64 {
    let texts = heading_height(place, sizes) + place.legend.0.height(sizes.tick);
    texts + place.beside.height(sizes) + 0.4 * sizes.tick
}

fn heading_height(place: &Placed<'_, '_>, sizes: Sizes) -> f64 {
    place.heading.0.len() as f64 * HEADING_LINE * sizes.tick
}

/// Returns the maximum of each group, at least 0.
fn most(groups: usize, group: impl Fn(usize) -> usize, values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut most = vec![0.0_f64; groups];
    for (i, value) in values.enumerate() {
        most[group(i)] = most[group(i)].max(value);
    }
    most
}

fn sum(values: &[f64]) -> f64 {
    values.iter().sum()
}
