//! Where everything goes: title, legends, panels.

use crate::PlotError;
use crate::figure::Figure;
use crate::label::Label;
use crate::legend::{Entry, Legend, entries};
use crate::panel::Panel;
use crate::place::{self, Request};
use crate::scale::Scale;
use crate::thin::Point;

/// A rectangle of the picture, px.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Area {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

/// A panel with its place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Placed<'f, 'a> {
    pub(crate) panel: &'f Panel<'a>,
    /// The frame around the data.
    pub(crate) frame: Area,
    /// All that belongs to the panel: legend, frame, numbers, labels.
    pub(crate) cell: Area,
    pub(crate) x: Scale,
    pub(crate) y: Scale,
    /// Size of the numbers of the y axis, or of the lanes' names, px per em.
    pub(crate) y_em: f64,
    /// Left edge of the numbers of the y axis; its label stands further left, px.
    pub(crate) numbers_left: f64,
    /// Lines of the heading above the frame; its top left corner.
    pub(crate) heading: (Vec<Label>, Point),
    /// Legend between heading and frame; its top left corner.
    pub(crate) legend: (Legend, Point),
    /// Whether the x and the y axis carry numbers and a label.
    pub(crate) numbered: (bool, bool),
    /// Whether there is nothing to show.
    pub(crate) empty: bool,
}

/// The whole figure with its places.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layout<'f, 'a> {
    /// Lines of the title, centred, with their baselines.
    pub(crate) title: Vec<(Label, f64)>,
    /// Legend of all panels; its top left corner.
    pub(crate) legend: (Legend, Point),
    pub(crate) panels: Vec<Placed<'f, 'a>>,
    pub(crate) sizes: Sizes,
}

/// Lengths in px, scaled to the figure's width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sizes {
    /// Px of this figure per px of one 1600 px wide.
    pub(crate) scale: f64,
    /// Px per em of the title.
    pub(crate) title: f64,
    /// Px per em of axis labels.
    pub(crate) label: f64,
    /// Px per em of tick labels and legends.
    pub(crate) tick: f64,
    /// Length of a tick.
    pub(crate) mark: f64,
    /// Around the figure.
    pub(crate) margin: f64,
}

/// Rows of a legend before entries are only counted.
const LEGEND_ROWS: usize = 4;
/// Lines of a title and of a panel's heading before they are cut.
const TITLE_LINES: usize = 2;
const HEADING_LINES: usize = 2;

impl Sizes {
    fn of(figure: &Figure<'_>) -> Self {
        let scale = f64::from(figure.size.0) / f64::from(Figure::DEFAULT_SIZE.0);
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
        figure.check()?;
        let sizes = Sizes::of(figure);
        let width = f64::from(figure.size.0) - 2.0 * sizes.margin;
        let mut top = sizes.margin;
        let mut title = Vec::new();
        for line in figure.title.wrapped(sizes.title, width, TITLE_LINES)? {
            title.push((line, top + 0.9 * sizes.title));
            top += 1.35 * sizes.title;
        }
        let mut lists: Vec<_> = figure.panels.iter().map(|panel| entries(panel, &figure.theme)).collect();
        let common = common(&mut lists);
        let legend = Legend::new(&common, width, sizes.tick, LEGEND_ROWS)?;
        let left = sizes.margin + (width - legend.width(sizes.tick)?) / 2.0;
        let legend_at = (left, top);
        if !legend.rows.is_empty() {
            top += legend.height(sizes.tick) + 0.5 * sizes.tick;
        }
        let height = f64::from(figure.size.1) - sizes.margin - top;
        let body = Area { left: sizes.margin, top, width, height };
        let (wide, _) = figure.shares();
        let mut requests = Vec::new();
        for (i, (panel, list)) in figure.panels.iter().zip(&lists).enumerate() {
            // The place of a panel is wider than this by the numbers of its axis.
            let width = 0.75 * width * wide[i % wide.len()];
            let legend = Legend::new(list, width, sizes.tick, LEGEND_ROWS)?;
            let heading = panel.heading.wrapped(sizes.tick, width, HEADING_LINES)?;
            requests.push(Request { panel, heading, legend });
        }
        let panels = place::panels(requests, figure, sizes, body)?;
        Ok(Self { title, legend: (legend, legend_at), panels, sizes })
    }
}

/// The longest list, where it names everything that the other panels name: one legend then serves all, and the
/// panels' own are emptied. Nothing for a single panel or panels that show different things.
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
