//! The data model of a figure.

use crate::layout::{Layout, Placed};
use crate::{Label, Panel, PlotError, Theme};

/// Least height of a frame in print, em of its numbers, and of one alone as a share of its width.
const LEAST_FRAME: f64 = 6.0;
const LEAST_ALONE: f64 = 0.6;

/// A figure: what it shows, not yet how many pixels apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure<'a> {
    /// Title above the panels; none where empty.
    pub title: Label,
    /// Panels in order.
    pub panels: Vec<Panel<'a>>,
    /// How the panels are arranged.
    pub arrangement: Arrangement,
    /// Width and height, px. The texts keep their share of the width, unless it has a size in print.
    pub size: (u32, u32),
    /// Width in print, mm, in which letters and lines are as large and thick as in one of 16 cm; none: 1600 px are meant for
    /// 16 cm, whatever they become.
    pub print_width: Option<f64>,
    /// Colours and sizes.
    pub theme: Theme,
    /// Keys and values that the file carries unseen: PNG text chunks, the description of an SVG.
    pub provenance: Vec<(String, String)>,
}

/// How panels are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arrangement {
    /// Side by side.
    Row,
    /// One above the other.
    Column {
        /// One x axis for all, with numbers below the last panel only.
        share_x: bool,
    },
    /// Row by row.
    Grid {
        /// Panels in a row, at least 1.
        columns: usize,
        /// The same axes for all, with numbers left of the first column and below the last row only.
        share: bool,
    },
    /// Row by row, one x axis for the panels of each column, with numbers below the last row only.
    Columns {
        /// Panels in a row, at least 1.
        columns: usize,
    },
}

impl Figure<'_> {
    /// Least width and height, px.
    pub const LEAST: u32 = 200;
    /// Most width and height, px.
    pub const MOST: u32 = 8000;
    /// Default size, px.
    pub const DEFAULT_SIZE: (u32, u32) = (1600, 1000);

    /// Width in print for which the sizes of the theme are made, mm.
    pub const PRINT_WIDTH: f64 = 160.0;
    /// Pixels to the inch of a figure with a size in print.
    pub const PRINT_DENSITY: f64 = 600.0;
    const INCH: f64 = 25.4;

    /// The figure for print in a width, mm: letters and lines keep their size in points, the frames become smaller. It is as much
    /// lower as it is narrower, unless legends take more rows or frames would be lower than letters leave to see.
    #[must_use]
    pub fn printed(mut self, width: f64) -> Self {
        let across = width / Self::INCH * Self::PRINT_DENSITY;
        let high = across * f64::from(self.size.1) / f64::from(self.size.0);
        self.size = (across.round() as u32, high.round() as u32);
        self.print_width = Some(width);
        self = self.with_room_for_legends();
        while self.size.1 < Self::MOST && has_low_frames(&self) {
            self.size.1 = (self.size.1 + self.size.1 / 10).min(Self::MOST);
        }
        self
    }

    /// Px of this figure per px of one 1600 px wide for 16 cm.
    pub(crate) fn scale(&self) -> f64 {
        let share = self.print_width.map_or(1.0, |width| Self::PRINT_WIDTH / width);
        f64::from(self.size.0) / f64::from(Self::DEFAULT_SIZE.0) * share
    }

    /// The default width, and a height for a heading and a number of things below each other, px.
    pub(crate) fn size_for(head: u32, each: u32, count: usize) -> (u32, u32) {
        let most = u32::try_from(count).unwrap_or(u32::MAX).saturating_mul(each).saturating_add(head);
        (Self::DEFAULT_SIZE.0, most.min(Self::MOST))
    }

    /// A figure that says that there is nothing to show.
    pub(crate) fn without_data(title: &str, words: &str) -> Self {
        let panel = Panel { absence: Label::plain(words), ..Panel::default() };
        Self {
            title: Label::plain(title),
            panels: vec![panel],
            size: Self::size_for(400, 0, 0),
            ..Self::default()
        }
    }

    /// The columns' shares of the width and the rows' shares of the height; either sum to 1.
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

    /// Checks what the types do not.
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

/// Whether a frame is too low for its letters; one of an aspect of its own is as high as it is.
fn has_low_frames(figure: &Figure<'_>) -> bool {
    match Layout::new(figure) {
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
    /// Panels side by side, of a number of panels.
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
