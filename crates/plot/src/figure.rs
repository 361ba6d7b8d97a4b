//! The data model of a figure.

use crate::layout::{Layout, Placed};
use crate::{Label, Panel, PlotError, Theme};

/// Least height of a frame in print, em of its numbers, and of one alone as a share of its width.
const LEAST_FRAME: f64 = 6.0;
const LEAST_ALONE: f64 = 0.6;
/// Least width of a column in print, em of its numbers, and of one with texts inside its frames.
const LEAST_COLUMN: f64 = 12.0;
const LEAST_NOTED_COLUMN: f64 = 18.0;
/// How many times as high a figure may become in print for texts that would be left out.
const GROWTH: f64 = 2.0;

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
    /// Pixels to the inch of a figure with a size in print, and at least of one that would have too many.
    pub const PRINT_DENSITY: f64 = 600.0;
    const LEAST_DENSITY: f64 = 300.0;
    const INCH: f64 = 25.4;

    /// The figure for print in a width, mm: letters and lines keep their size in points, the frames become smaller. It is as much
    /// lower as it is narrower, unless legends take more rows, frames would be lower than letters leave to see, or texts in them would be
    /// left out; fewer panels stand side by side where letters ask for it.
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
        while has_low_frames(&self) && self.grow(&mut density) {}
        self.with_room_for_names(names, &mut density).with_room_for_notes(lost, density)
    }

    /// Taller by what names of lanes need to be as large beside the letters of axes as this share; as it is where nothing helps.
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

    /// Taller by a tenth, with fewer pixels to the inch where there would be too many; tells whether it is.
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

    /// Taller by what the texts inside frames need, so that no more than so many are left out; as it is where nothing helps.
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

    /// The figure as high as its panels need to be drawn at all.
    #[must_use]
    pub fn roomy(mut self) -> Self {
        let is_low = |figure: &Self| matches!(Layout::framed(figure), Err(PlotError::NoRoom { height, width, .. }) if height <= width);
        while self.size.1 < Self::MOST && is_low(&self) {
            self.size.1 = (self.size.1 + self.size.1 / 10).min(Self::MOST);
        }
        self
    }

    /// How many panels stand side by side in print: no more than leave each its letters.
    fn columns_in_print(&self, width: f64) -> usize {
        let columns = self.arrangement.columns(self.panels.len());
        let ems = f64::from(Self::DEFAULT_SIZE.0) * width / Self::PRINT_WIDTH / self.theme.tick;
        let noted = self.panels.iter().any(|panel| !panel.notes.is_empty());
        let least = if noted { LEAST_NOTED_COLUMN } else { LEAST_COLUMN };
        columns.min((ems / least) as usize).max(1)
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

/// How many texts inside frames found no place.
fn lost_notes(figure: &Figure<'_>) -> usize {
    if figure.panels.iter().all(|panel| panel.notes.is_empty()) {
        return 0;
    }
    Layout::new(figure).map_or(usize::MAX, |layout| layout.panels.iter().map(|place| place.lost).sum())
}

/// How large the smallest names of lanes are beside the letters of axes; 1 without any.
fn least_names(figure: &Figure<'_>) -> f64 {
    if figure.panels.iter().all(|panel| panel.lanes.is_empty()) {
        return 1.0;
    }
    Layout::framed(figure).map_or(0.0, |layout| {
        let named = layout.panels.iter().filter(|place| !place.panel.lanes.is_empty());
        named.map(|place| place.names.em / layout.sizes.tick).fold(1.0, f64::min)
    })
}

/// Whether a frame is too low for its letters; one of an aspect of its own is as high as it is.
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
    /// The same with fewer columns.
    fn in_columns(self, columns: usize) -> Self {
        match self {
            Self::Column { .. } => self,
            Self::Row => Self::Grid { columns, share: false },
            Self::Grid { share, .. } => Self::Grid { columns, share },
            Self::Columns { .. } => Self::Columns { columns },
        }
    }

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
