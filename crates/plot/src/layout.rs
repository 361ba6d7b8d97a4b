//! Layout of a figure: title, legends and panels.

use crate::PlotError;
use crate::beside::Beside;
use crate::figure::Figure;
use crate::label::Label;
use crate::lanes::Names;
use crate::legend::{Entry, Legend, ROW, entries};
use crate::notes::{self, PlacedNote};
use crate::panel::Panel;
use crate::place::{self, Request};
use crate::scale::Scale;
use crate::thin::Point;

/// Rectangle in the picture, px.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Area {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

/// Panel with its position.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Placed<'f, 'a> {
    pub(crate) panel: &'f Panel<'a>,
    /// Frame around the data.
    pub(crate) frame: Area,
    /// Area of the whole panel: heading, legend, frame, numbers and labels.
    pub(crate) cell: Area,
    pub(crate) x: Scale,
    pub(crate) y: Scale,
    /// Second axes in other units.
    pub(crate) beside: Beside,
    /// Names of the lanes, which replace the y axis.
    pub(crate) names: Names,
    /// Left edge of the numbers of the y axis, px. The axis label is further left.
    pub(crate) numbers_left: f64,
    /// Lines of the heading above the frame, and its top left corner.
    pub(crate) heading: (Vec<Label>, Point),
    /// Legend between heading and frame, and its top left corner.
    pub(crate) legend: (Legend, Point),
    /// Whether the x axis and the y axis have numbers and a label.
    pub(crate) numbered: (bool, bool),
    /// Notes inside the frame, and the number of notes left out.
    pub(crate) notes: Vec<PlacedNote>,
    pub(crate) lost: usize,
    /// Whether the panel has no data.
    pub(crate) empty: bool,
}

/// Figure with the positions of its parts.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layout<'f, 'a> {
    /// Lines of the centred title, and their baselines.
    pub(crate) title: Vec<(Label, f64)>,
    /// Common legend of all panels, and its top left corner.
    pub(crate) legend: (Legend, Point),
    pub(crate) panels: Vec<Placed<'f, 'a>>,
    pub(crate) sizes: Sizes,
}

/// Lengths in px, scaled to the figure's width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sizes {
    /// Scale factor relative to a figure 1600 px wide.
    pub(crate) scale: f64,
    /// Px per em of the title.
    pub(crate) title: f64,
    /// Px per em of axis labels.
    pub(crate) label: f64,
    /// Px per em of tick labels and legends.
    pub(crate) tick: f64,
    /// Length of a tick.
    pub(crate) mark: f64,
    /// Margin around the figure.
    pub(crate) margin: f64,
}

/// Maximum fraction of the figure's height for a legend, and the number of rows that is always allowed. Further entries are only counted.
const LEGEND_SHARE: f64 = 0.4;
const LEGEND_ROWS: usize = 4;
/// Maximum number of lines of the title and of a panel heading.
const TITLE_LINES: usize = 3;
const HEADING_LINES: usize = 2;
/// Width of the numbers and label of an axis in print, em of the tick labels.
const NUMBERS: f64 = 5.5;

impl Sizes {
    fn of(figure: &Figure<'_>) -> Self {
        let scale = figure.scale();
        let theme = &figure.theme;
        Self {
            scale,
            title: scale * theme.title,
            label: scale * theme.label,
            tick: scale * theme.tick,
            mark: scale * 9.0,
            margin: scale * 20.0,
        }
    }
}

impl<'f, 'a> Layout<'f, 'a> {
    pub(crate) fn new(figure: &'f Figure<'a>) -> Result<Self, PlotError> {
        let mut layout = Self::framed(figure)?;
        for panel in &mut layout.panels {
            notes::place(panel, layout.sizes)?;
        }
        Ok(layout)
    }

    /// Computes the layout without notes, because placing notes takes most of the time.
    pub(crate) fn framed(figure: &'f Figure<'a>) -> Result<Self, PlotError> {
        figure.check()?;
        let sizes = Sizes::of(figure);
        let width = f64::from(figure.size.0) - 2.0 * sizes.margin;
        let mut top = sizes.margin;
        let mut title = Vec::new();
        for line in figure.title.wrapped(sizes.title, width, TITLE_LINES)? {
            title.push((line, top + 0.9 * sizes.title));
            top += 1.35 * sizes.title;
        }
        let most = (LEGEND_SHARE * f64::from(figure.size.1) / (ROW * sizes.tick)) as usize;
        let (legend, legends) = legends(figure, sizes, most.max(LEGEND_ROWS))?;
        let left = sizes.margin + (width - legend.width(sizes.tick)?) / 2.0;
        let legend_at = (left, top);
        if !legend.rows.is_empty() {
            top += legend.height(sizes.tick) + 0.5 * sizes.tick;
        }
        let height = f64::from(figure.size.1) - sizes.margin - top;
        let body = Area { left: sizes.margin, top, width, height };
        let mut requests = Vec::new();
        for (i, (panel, legend)) in figure.panels.iter().zip(legends).enumerate() {
            let heading = panel.heading.wrapped(sizes.tick, width_above(figure, sizes, i), HEADING_LINES)?;
            requests.push(Request { panel, heading, legend });
        }
        let panels = place::panels(requests, figure, sizes, body)?;
        Ok(Self { title, legend: (legend, legend_at), panels, sizes })
    }
}

impl Figure<'_> {
    /// Increases the height by the rows of the legends beyond one each, so that long legends do not shrink the panels.
    pub(crate) fn with_room_for_legends(mut self) -> Self {
        let more: usize = self.legend_rows().into_iter().map(|rows| rows.saturating_sub(1)).sum();
        let height = f64::from(self.size.1) + more as f64 * ROW * Sizes::of(&self).tick;
        self.size.1 = (height.ceil() as u32).min(Self::MOST);
        self
    }

    /// Returns the number of rows of the common legend, then of the tallest legend in each row of panels.
    fn legend_rows(&self) -> Vec<usize> {
        let Ok((common, own)) = legends(self, Sizes::of(self), usize::MAX) else { return Vec::new() };
        let columns = self.arrangement.columns(self.panels.len());
        let tallest =
            own.chunks(columns).map(|row| row.iter().map(|legend| legend.rows.len()).max().unwrap_or(0));
        std::iter::once(common.rows.len()).chain(tallest).collect()
    }

    /// Returns the fraction of the height that all legends take.
    pub(crate) fn legend_share(&self) -> f64 {
        let rows: usize = self.legend_rows().into_iter().sum();
        rows as f64 * ROW * Sizes::of(self).tick / f64::from(self.size.1)
    }
}

/// Returns the common legend and the legends of the panels, wrapped to the available width.
fn legends(figure: &Figure<'_>, sizes: Sizes, most: usize) -> Result<(Legend, Vec<Legend>), PlotError> {
    let mut lists: Vec<_> = figure.panels.iter().map(|panel| entries(panel, &figure.theme)).collect();
    let width = f64::from(figure.size.0) - 2.0 * sizes.margin;
    let common = Legend::new(&common(&mut lists), width, sizes.tick, most)?;
    let own = lists.iter().enumerate();
    let own = own.map(|(i, list)| Legend::new(list, width_above(figure, sizes, i), sizes.tick, most));
    Ok((common, own.collect::<Result<_, _>>()?))
}

/// Returns the width for heading and legend of a panel, px.
fn width_above(figure: &Figure<'_>, sizes: Sizes, panel: usize) -> f64 {
    let (wide, _) = figure.shares();
    let cell = (f64::from(figure.size.0) - 2.0 * sizes.margin) * wide[panel % wide.len()];
    // In a narrow column the numbers take a larger fraction of the width.
    let beside = if figure.print_width.is_some() { NUMBERS * sizes.tick } else { 0.0 };
    (cell - beside).min(0.75 * cell)
}

/// Returns the longest list if it contains all entries of the other panels, as a common legend, and empties all lists. Returns nothing if
/// fewer than two panels have entries, or if a panel has other entries.
fn common(lists: &mut [Vec<Entry>]) -> Vec<Entry> {
    let longest = lists.iter().max_by_key(|list| list.len()).cloned().unwrap_or_default();
    let serves_all = lists.iter().all(|list| list.iter().all(|entry| longest.contains(entry)));
    let users = lists.iter().filter(|list| !list.is_empty()).count();
    if !serves_all || users < 2 {
        return Vec::new();
    }
    lists.iter_mut().for_each(Vec::clear);
    longest
}
