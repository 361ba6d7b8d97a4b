//! The data model of a figure.

use crate::layout::{Layout, Placed};
use crate::{Label, Panel, PlotError, Theme};

/// Minimum frame height in print: in em of the tick labels, and for a single panel as a fraction of the frame width.
const LEAST_FRAME: f64 = 6.0;
const LEAST_ALONE: f64 = 0.6;
/// Minimum column width in print, em of the tick labels: without and with notes inside the frames.
const LEAST_COLUMN: f64 = 12.0;
const LEAST_NOTED_COLUMN: f64 = 18.0;
/// Maximum factor by which the height increases in print for notes, lane names and legends.
const GROWTH: f64 = 2.0;
/// Maximum fraction of the height for legends in print.
const LEGEND_SHARE: f64 = 0.15;

/// Figure: panels and their arrangement, independent of the output format.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure<'a> {
    /// Title above the panels; empty for none.
    pub title: Label,
    /// Panels in order.
    pub panels: Vec<Panel<'a>>,
    /// Arrangement of the panels.
    pub arrangement: Arrangement,
    /// Width and height, px. Text sizes are proportional to the width unless `print_width` is set.
    pub size: (u32, u32),
    /// Width in print, mm. Letters and lines then have the same size in points as in a figure 160 mm wide. `None`:
    /// the width stands for 160 mm.
    pub print_width: Option<f64>,
    /// Colours and sizes.
    pub theme: Theme,
    /// Metadata of the file as keys and values: PNG text chunks, or `<desc>` and `<metadata>` of an SVG.
    pub provenance: Vec<(String, String)>,
}

/// Arrangement of panels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arrangement {
    /// Side by side.
    Row,
    /// One above the other.
    Column {
        /// Whether all panels share one x axis, with numbers below the last panel only.
        share_x: bool,
    },
    /// Row by row.
    Grid {
        /// Panels in a row, at least 1.
        columns: usize,
        /// Whether all panels share both axes, with numbers left of the first column and below the last row only.
        share: bool,
    },
    /// Row by row. The panels of a column share one x axis, with numbers below the last row only.
    Columns {
        /// Panels in a row, at least 1.
        columns: usize,
    },
}

impl Figure<'_> {
    /// Minimum width and height, px.
    pub const LEAST: u32 = 200;
    /// Maximum width and height, px.
    pub const MOST: u32 = 8000;
    /// Default size, px.
    pub const DEFAULT_SIZE: (u32, u32) = (1600, 1000);

    /// Print width for which the theme's sizes are defined, mm.
    pub const PRINT_WIDTH: f64 = 160.0;
    /// Resolution of figures with a print width, px per inch. The resolution is halved if the figure would exceed [`Figure::MOST`].
    pub const PRINT_DENSITY: f64 = 600.0;
    const LEAST_DENSITY: f64 = 300.0;
    const INCH: f64 = 25.4;

    /// Returns the figure for a print width in mm.
    ///
    /// Letters and lines keep their size in points, so the frames become smaller. Fewer panels stand side by side where columns would be
    /// too narrow for their labels. The height increases where legends, tick labels, lane names or notes need it.
    #[must_use]
    pub fn printed(mut self, width: f64) -> Self {
        let (lost, names) = (lost_notes(&self), least_names(&self));
        self.print_width = Some(width);
        let columns = self.columns_in_print(width);
        let rows = |columns: usize| self.panels.len().div_ceil(columns.max(1)) as f64;
        let longer = rows(columns) / rows(self.arrangement.columns(self.panels.len()));
        let shape = longer * f64::from(self.size.1) / f64::from(self.size.0);
        self.arrangement = self.arrangement.in_columns(columns);
        let mut density = Self::PRINT_DENSITY;
        while density > Self::LEAST_DENSITY && width / Self::INCH * density * shape > f64::from(Self::MOST) {
            density *= 0.5;
        }
        let across = width / Self::INCH * density;
        self.size = (across.round() as u32, (across * shape).round().min(f64::from(Self::MOST)) as u32);
        self = self.with_room_for_legends();
        let most = GROWTH * self.legend_share();
        while self.legend_share() > LEGEND_SHARE.max(most / GROWTH.powi(2)) && self.grow(&mut density) {}
        while has_low_frames(&self) && self.grow(&mut density) {}
        self.with_room_for_names(names, &mut density).with_room_for_notes(lost, density)
    }

    /// Increases the height until lane names are at least `share` times as large as tick labels. Keeps the height
    /// with the largest names, at most [`GROWTH`] times the original height.
    fn with_room_for_names(mut self, share: f64, density: &mut f64) -> Self {
        let shape = |size: (u32, u32)| f64::from(size.1) / f64::from(size.0);
        let most = GROWTH * shape(self.size);
        let mut best = (self.size, *density, least_names(&self));
        while best.2 < share && shape(self.size) < most && self.grow(density) {
            let names = least_names(&self);
            if names > best.2 {
                best = (self.size, *density, names);
            }
        }
        (self.size, *density) = (best.0, best.1);
        self
    }

    /// Increases the height by 10 %. Halves the resolution if the maximum size is reached. Returns false if neither is possible.
    fn grow(&mut self, density: &mut f64) -> bool {
        if self.size.1 >= Self::MOST {
            if *density <= Self::LEAST_DENSITY {
                return false;
            }
            *density *= 0.5;
            self.size = (self.size.0 / 2, self.size.1 / 2);
        }
        self.size.1 = (self.size.1 + self.size.1 / 10).min(Self::MOST);
        true
    }

    /// Increases the height until at most `lost` notes are left out. Keeps the height with the fewest notes left out,
    /// at most [`GROWTH`] times the original height.
    fn with_room_for_notes(mut self, lost: usize, mut density: f64) -> Self {
        let shape = |size: (u32, u32)| f64::from(size.1) / f64::from(size.0);
        let most = GROWTH * shape(self.size);
        let (mut best, mut least) = (self.size, lost_notes(&self));
        while least > lost && shape(self.size) < most && self.grow(&mut density) {
            let still = lost_notes(&self);
            if still < least {
                (best, least) = (self.size, still);
            }
        }
        Self { size: best, ..self }
    }

    /// Increases the height until every frame is high enough to be drawn.
    #[must_use]
    pub fn roomy(mut self) -> Self {
        let is_low = |figure: &Self| matches!(Layout::framed(figure), Err(PlotError::NoRoom { height, width, .. }) if height <= width);
        while self.size.1 < Self::MOST && is_low(&self) {
            self.size.1 = (self.size.1 + self.size.1 / 10).min(Self::MOST);
        }
        self
    }

    /// Returns the number of columns in print for which every panel is at least as wide as the minimum column width.
    fn columns_in_print(&self, width: f64) -> usize {
        let columns = self.arrangement.columns(self.panels.len());
        let ems = f64::from(Self::DEFAULT_SIZE.0) * width / Self::PRINT_WIDTH / self.theme.tick;
        let noted = self.panels.iter().any(|panel| !panel.notes.is_empty());
        let least = if noted { LEAST_NOTED_COLUMN } else { LEAST_COLUMN };
        columns.min((ems / least) as usize).max(1)
    }

    /// Returns the scale of lengths: px of this figure per px of a figure 1600 px wide, which stands for 160 mm.
    pub(crate) fn scale(&self) -> f64 {
        let share = self.print_width.map_or(1.0, |width| Self::PRINT_WIDTH / width);
        f64::from(self.size.0) / f64::from(Self::DEFAULT_SIZE.0) * share
    }

    /// Returns the default width and a height of `head` plus `count` times `each`, px, at most [`Figure::MOST`].
    pub(crate) fn size_for(head: u32, each: u32, count: usize) -> (u32, u32) {
        let most = u32::try_from(count).unwrap_or(u32::MAX).saturating_mul(each).saturating_add(head);
        (Self::DEFAULT_SIZE.0, most.min(Self::MOST))
    }

    /// Creates a figure with a message instead of data.
    pub(crate) fn without_data(title: &str, words: &str) -> Self {
        let panel = Panel { absence: Label::plain(words), ..Panel::default() };
        Self {
            title: Label::plain(title),
            panels: vec![panel],
            size: Self::size_for(400, 0, 0),
            ..Self::default()
        }
    }

    /// Returns the relative column widths and row heights; each sums to 1.
    pub(crate) fn shares(&self) -> (Vec<f64>, Vec<f64>) {
        let usable = |share: f64| if share > 0.0 && share.is_finite() { share.clamp(1e-3, 1e3) } else { 1.0 };
        let columns = self.arrangement.columns(self.panels.len());
        let (mut wide, mut high) =
            (vec![0.0_f64; columns], vec![0.0_f64; self.panels.len().div_ceil(columns)]);
        for (i, share) in self.panels.iter().map(|panel| usable(panel.share)).enumerate() {
            wide[i % columns] = wide[i % columns].max(share);
            high[i / columns] = high[i / columns].max(share);
        }
        let whole = |shares: Vec<f64>| {
            let sum: f64 = shares.iter().sum();
            shares.into_iter().map(|share| share / sum).collect()
        };
        (whole(wide), whole(high))
    }

    /// Checks the size and the panels.
    pub(crate) fn check(&self) -> Result<(), PlotError> {
        let (width, height) = self.size;
        if [width, height].iter().any(|side| !(Self::LEAST..=Self::MOST).contains(side)) {
            return Err(PlotError::Size { width, height });
        }
        if self.panels.is_empty() {
            return Err(PlotError::NoPanels);
        }
        self.panels.iter().enumerate().try_for_each(|(place, panel)| panel.check(place))
    }
}

/// Returns the number of notes that are left out, summed over all panels.
fn lost_notes(figure: &Figure<'_>) -> usize {
    if figure.panels.iter().all(|panel| panel.notes.is_empty()) {
        return 0;
    }
    Layout::new(figure).map_or(usize::MAX, |layout| layout.panels.iter().map(|place| place.lost).sum())
}

/// Returns the smallest ratio of lane name size to tick label size; 1 without lanes.
fn least_names(figure: &Figure<'_>) -> f64 {
    if figure.panels.iter().all(|panel| panel.lanes.is_empty()) {
        return 1.0;
    }
    Layout::framed(figure).map_or(0.0, |layout| {
        let named = layout.panels.iter().filter(|place| !place.panel.lanes.is_empty());
        named.map(|place| place.names.em / layout.sizes.tick).fold(1.0, f64::min)
    })
}

/// Returns whether a frame is too low for its labels. Frames with lanes or a fixed aspect ratio are not checked.
fn has_low_frames(figure: &Figure<'_>) -> bool {
    match Layout::framed(figure) {
        Err(PlotError::NoRoom { height, width, .. }) => height <= width,
        Err(_) => false,
        Ok(layout) => {
            let alone = if layout.panels.len() == 1 { LEAST_ALONE } else { 0.0 };
            let is_low = |place: &Placed<'_, '_>| {
                let least = (LEAST_FRAME * layout.sizes.tick).max(alone * place.frame.width);
                place.panel.lanes.is_empty() && place.panel.aspect.is_none() && place.frame.height < least
            };
            layout.panels.iter().any(is_low)
        }
    }
}

impl Arrangement {
    /// Returns the same arrangement with another number of columns.
    fn in_columns(self, columns: usize) -> Self {
        match self {
            Self::Column { .. } => self,
            Self::Row => Self::Grid { columns, share: false },
            Self::Grid { share, .. } => Self::Grid { columns, share },
            Self::Columns { .. } => Self::Columns { columns },
        }
    }

    /// Returns the number of columns for a number of panels.
    pub(crate) fn columns(self, panels: usize) -> usize {
        match self {
            Self::Row => panels.max(1),
            Self::Column { .. } => 1,
            Self::Grid { columns, .. } | Self::Columns { columns } => columns.clamp(1, panels.max(1)),
        }
    }
}

impl Default for Figure<'_> {
    fn default() -> Self {
        Self {
            title: Label::default(),
            panels: Vec::new(),
            arrangement: Arrangement::Row,
            size: Self::DEFAULT_SIZE,
            print_width: None,
            theme: Theme::light(),
            provenance: Vec::new(),
        }
    }
}
