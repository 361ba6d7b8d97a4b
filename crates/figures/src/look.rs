//! Look of plots: file formats, colours and size.

use std::sync::{Mutex, PoisonError};
use stickslip_plot::{Figure, Label, PlotError, Theme, draw_animation, draw_png, draw_svg};
use stickslip_scenario::PlotName;

/// Look of plots. The file names contain the settings that are not the default.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Look {
    /// File formats.
    pub formats: Vec<Format>,
    /// Colour themes; every plot is drawn in each. The dark theme is in `NAME-dark.png`.
    pub themes: Vec<Colours>,
    /// Scale: 1 for a width of 1600 px, 2 for twice as many (`NAME@2x.png`).
    pub scale: u32,
    /// Print width in tenths of a millimetre (`NAME-85mm.png`); letters and lines keep their size in points. `None`: no print width.
    pub width: Option<u32>,
    /// Whether the title is drawn.
    pub title: bool,
}

impl Default for Look {
    fn default() -> Self {
        Self { formats: vec![Format::Png], themes: vec![Colours::Light], scale: 1, width: None, title: true }
    }
}

/// File format of a plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// PNG.
    Png,
    /// SVG.
    Svg,
}

/// Colour theme of a plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colours {
    /// Dark on white.
    Light,
    /// Light on nearly black.
    Dark,
}

/// Picture file: its name and its content.
pub type Picture = (String, Vec<u8>);

/// Draws figures in a look, with metadata.
pub(crate) struct Pen<'a> {
    pub(crate) look: &'a Look,
    pub(crate) provenance: Vec<(String, String)>,
    /// If present, figures are collected here with their names instead of being drawn.
    pub(crate) kept: Option<Mutex<Vec<(String, Figure<'static>)>>>,
}

impl Format {
    fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Svg => "svg",
        }
    }
}

impl Look {
    /// Returns the file name of a plot.
    pub fn file(&self, plot: PlotName, theme: Colours, format: Format) -> String {
        self.file_of(plot.name(), theme, format)
    }

    /// Returns the file name of a plot given by its name.
    pub fn file_of(&self, plot: &str, theme: Colours, format: Format) -> String {
        let theme = match theme {
            Colours::Light => "",
            Colours::Dark => "-dark",
        };
        let scale = if self.scale == 1 { String::new() } else { format!("@{}x", self.scale) };
        let width = self.width_in_mm().map_or(String::new(), |mm| format!("-{mm}mm"));
        format!("{plot}{theme}{width}{scale}.{}", format.ending())
    }

    fn width_in_mm(&self) -> Option<f64> {
        self.width.map(|tenths| f64::from(tenths) / 10.0)
    }

    /// Returns the file names of all plots of a scenario in all formats, colours and scales, without a print width.
    pub fn all_files() -> Vec<String> {
        let own: Vec<String> = (1..=PlotName::MOST_OWN).map(own_name).collect();
        let names = PlotName::ALL.map(PlotName::name).into_iter().chain(own.iter().map(String::as_str));
        Self::all_files_of(&names.collect::<Vec<_>>())
    }

    /// Returns the file names of given plots in all formats, colours and scales, without a print width.
    pub fn all_files_of(plots: &[&str]) -> Vec<String> {
        let mut names = Vec::new();
        for theme in [Colours::Light, Colours::Dark] {
            for scale in [1, 2] {
                let look = Self { scale, ..Self::default() };
                for format in [Format::Png, Format::Svg] {
                    names.extend(plots.iter().map(|plot| look.file_of(plot, theme, format)));
                }
            }
        }
        names
    }
}

/// Returns the name of the plot of user-selected channels with this number, counted from 1.
pub(crate) fn own_name(number: usize) -> String {
    format!("{}-{number}", PlotName::Xy.name())
}

impl Pen<'_> {
    /// Draws a figure, one file per theme and format.
    pub(crate) fn draw(&self, plot: PlotName, figure: Figure<'_>) -> Result<Vec<Picture>, PlotError> {
        self.draw_as(plot.name(), figure)
    }

    /// Draws figures as an animated PNG with the given name; nothing if the look has no PNG.
    #[allow(
        clippy::needless_pass_by_value,
        reason = "a figure is drawn once, in all its themes, and handed over by its builder"
    )]
    pub(crate) fn animate(
        &self,
        plot: &str,
        figures: Vec<Figure<'_>>,
        delay: u16,
    ) -> Result<Vec<Picture>, PlotError> {
        if figures.is_empty() || !self.look.formats.contains(&Format::Png) {
            return Ok(Vec::new());
        }
        let film = |theme: &Colours| {
            let figures: Vec<Figure<'_>> =
                figures.iter().map(|figure| self.looking(figure.clone(), *theme)).collect();
            Ok((self.look.file_of(plot, *theme, Format::Png), draw_animation(&figures, delay)?))
        };
        self.look.themes.iter().map(film).collect()
    }

    /// Returns the figures that were collected.
    pub(crate) fn into_kept(self) -> Vec<(String, Figure<'static>)> {
        self.kept.map_or(Vec::new(), |kept| kept.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    /// Returns a figure in the look and a theme.
    fn looking<'f>(&self, mut figure: Figure<'f>, theme: Colours) -> Figure<'f> {
        if !self.look.title {
            figure.title = Label::default();
        }
        figure = match self.look.width_in_mm() {
            Some(mm) => figure.printed(mm),
            None => {
                let figure = figure.roomy();
                let (width, height) = figure.size;
                Figure { size: (width * self.look.scale, height * self.look.scale), ..figure }
            }
        };
        figure.theme = match theme {
            Colours::Light => Theme::light(),
            Colours::Dark => Theme::dark(),
        };
        figure.provenance.clone_from(&self.provenance);
        figure
    }

    /// Draws a figure under a given name, one file per theme and format.
    pub(crate) fn draw_as(&self, plot: &str, figure: Figure<'_>) -> Result<Vec<Picture>, PlotError> {
        if let Some(kept) = &self.kept {
            let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
            kept.push((plot.to_owned(), figure.into_owned()));
            return Ok(Vec::new());
        }
        let mut pictures = Vec::new();
        for &theme in &self.look.themes {
            let figure = self.looking(figure.clone(), theme);
            for &format in &self.look.formats {
                let bytes = match format {
                    Format::Png => draw_png(&figure)?,
                    Format::Svg => draw_svg(&figure)?.into_bytes(),
                };
                pictures.push((self.look.file_of(plot, theme, format), bytes));
            }
        }
        Ok(pictures)
    }
}
