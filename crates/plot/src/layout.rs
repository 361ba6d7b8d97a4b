//! Where everything goes: title, legends, panels.

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
    /// Both axes in other units.
    pub(crate) beside: Beside,
    /// Names of the lanes, in place of the y axis.
    pub(crate) names: Names,
    /// Left edge of the numbers of the y axis; its label stands further left, px.
    pub(crate) numbers_left: f64,
    /// Lines of the heading above the frame; its top left corner.
    pub(crate) heading: (Vec<Label>, Point),
    /// Legend between heading and frame; its top left corner.
    pub(crate) legend: (Legend, Point),
    /// Whether the x and the y axis carry numbers and a label.
    pub(crate) numbered: (bool, bool),
    /// Texts inside the frame, and how many have found no place.
    pub(crate) notes: Vec<PlacedNote>,
    pub(crate) lost: usize,
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

/// Share of the figure's height that a legend may take before entries are only counted, and the rows that it may
/// have in any case.
const LEGEND_SHARE: f64 = 0.4;
const LEGEND_ROWS: usize = 4;
/// Lines of a title and of a panel's heading before they are cut.
const TITLE_LINES: usize = 3;
const HEADING_LINES: usize = 2;
/// What numbers and label of an axis take beside a frame in print, em of the numbers.
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

    /// The same without texts inside the frames, which take the most time.
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
    /// Taller by what the legends need beyond a row each, so that many names do not press the panels.
    pub(crate) fn with_room_for_legends(mut self) -> Self {
        let sizes = Sizes::of(&self);
        let Ok((common, own)) = legends(&self, sizes, usize::MAX) else { return self };
        let columns = self.arrangement.columns(self.panels.len());
        let rows =
            own.chunks(columns).map(|row| row.iter().map(|legend| legend.rows.len()).max().unwrap_or(0));
        let more = |rows: usize| rows.saturating_sub(1);
        let more = more(common.rows.len()) + rows.map(more).sum::<usize>();
        let height = f64::from(self.size.1) + more as f64 * ROW * sizes.tick;
        self.size.1 = (height.ceil() as u32).min(Self::MOST);
        self
    }
}

/// One legend for all panels and the panels' own, in rows of the width there is.
fn legends(figure: &Figure<'_>, sizes: Sizes, most: usize) -> Result<(Legend, Vec<Legend>), PlotError> {
    let mut lists: Vec<_> = figure.panels.iter().map(|panel| entries(panel, &figure.theme)).collect();
    let width = f64::from(figure.size.0) - 2.0 * sizes.margin;
    let common = Legend::new(&common(&mut lists), width, sizes.tick, most)?;
    let own = lists.iter().enumerate();
    let own = own.map(|(i, list)| Legend::new(list, width_above(figure, sizes, i), sizes.tick, most));
    Ok((common, own.collect::<Result<_, _>>()?))
}

/// Width for heading and legend of a panel, px: its share of the figure, less the numbers of its axis.
fn width_above(figure: &Figure<'_>, sizes: Sizes, panel: usize) -> f64 {
    let (wide, _) = figure.shares();
    let cell = (f64::from(figure.size.0) - 2.0 * sizes.margin) * wide[panel % wide.len()];
    // In a narrow column the numbers take more of it.
    let beside = if figure.print_width.is_some() { NUMBERS * sizes.tick } else { 0.0 };
    (cell - beside).min(0.75 * cell)
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
